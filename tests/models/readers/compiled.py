"""What MuJoCo makes of an MJCF text, as furiko's own spatial bodies: the other side of the reader's tests."""

from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from furiko.models.readers.mjcf.document import read_mjcf
from furiko.models.readers.xml_file import parse_xml
from furiko.models.spatial import from_quaternion

mujoco.set_mju_user_warning(lambda message: None)  # else it writes a file where the tests run
KINDS = {0: "free", 1: "ball", 2: "slide", 3: "hinge"}
# Of the larger number: MuJoCo turns vectors and tensors through quaternions, some tens of roundings.
ROUNDING = 1e-12
# Its own search for principal axes ends when a step turns by less than √2·1e-6 rad (c > 1 − 1e-12), and leaves products
# of inertia below 1e-12 kg m² where they are; so far may a tensor be off that it has to turn itself.
AXES, PRODUCTS = 2e-6, 2e-12


def read(text, rules=None, path="model.xml", others=()):
    return read_mjcf(parse_xml(text.encode(), str(path)), Path(path), rules, others)


@dataclass
class Numbers:
    """The numbers of one body and its joints, for comparison."""

    parent: int
    mass: float
    centre: np.ndarray
    tensor: np.ndarray
    position: np.ndarray
    rotation: np.ndarray
    joints: list


def ours(mechanism):
    return [
        Numbers(
            body.parent,
            body.inertial.mass,
            body.inertial.centre,
            body.inertial.tensor,
            body.position,
            from_quaternion(body.quaternion),
            [
                {
                    "kind": joint.kind,
                    "axis": joint.axis / np.linalg.norm(joint.axis) if joint.kind in ("hinge", "slide") else None,
                    "anchor": joint.anchor if joint.kind != "free" else None,
                    "ref": joint.ref,
                    "armature": joint.armature,
                    "damping": joint.damping,
                    "friction": joint.friction,
                    "stiffness": joint.stiffness,
                    "springref": joint.springref if joint.stiffness else 0.0,
                    "limits": joint.limits,
                }
                for joint in body.joints
            ],
        )
        for body in mechanism.bodies
    ]


def theirs(model):
    found = []
    for b in range(1, model.nbody):
        turn = from_quaternion(model.body_iquat[b])
        first = int(model.body_jntadr[b])
        joints = [_joint(model, j) for j in range(first, first + int(model.body_jntnum[b]))]
        tensor = turn @ np.diag(model.body_inertia[b]) @ turn.T
        found.append(
            Numbers(
                int(model.body_parentid[b]) - 1,
                float(model.body_mass[b]),
                model.body_ipos[b].copy(),
                tensor,
                model.body_pos[b].copy(),
                from_quaternion(model.body_quat[b]),
                joints,
            )
        )
    return found


def _joint(model, j):
    kind, dof, at = KINDS[int(model.jnt_type[j])], int(model.jnt_dofadr[j]), int(model.jnt_qposadr[j])
    single = kind in ("hinge", "slide")
    stiffness = float(np.ravel(model.jnt_stiffness[j])[0])
    return {
        "kind": kind,
        "axis": model.jnt_axis[j].copy() if single else None,
        "anchor": model.jnt_pos[j].copy() if kind != "free" else None,
        "ref": float(model.qpos0[at]) if single else 0.0,
        "armature": float(model.dof_armature[dof]),
        "damping": float(np.ravel(model.dof_damping[dof])[0]),
        "friction": float(model.dof_frictionloss[dof]),
        "stiffness": stiffness,
        "springref": float(model.qpos_spring[at]) if single and stiffness else 0.0,
        "limits": tuple(model.jnt_range[j]) if model.jnt_limited[j] else None,
    }


def assert_same(text, tmp_path=None, tolerance=ROUNDING):
    """Assert that the reader and MuJoCo have the same bodies. Returns the reading."""
    if tmp_path is None:
        found, model = read(text), mujoco.MjModel.from_xml_string(text)
    else:
        path = tmp_path / "model.xml"
        path.write_text(text)
        found, model = read(text, path=path), mujoco.MjModel.from_xml_path(str(path))
    assert_alike(found, model, tolerance)
    return found


def assert_alike(found, model, tolerance=ROUNDING):
    """Assert that a reading and a compiled model have the same bodies, joints and gravity."""
    mine, other = ours(found), theirs(model)
    assert len(mine) == len(other)
    for a, b in zip(mine, other, strict=True):
        assert a.parent == b.parent
        assert abs(a.mass - b.mass) <= tolerance * b.mass
        size = max(1.0, float(np.abs(b.centre).max()))
        np.testing.assert_allclose(a.centre, b.centre, rtol=0, atol=tolerance * size)
        spread = float(np.ptp(np.linalg.eigvalsh(b.tensor)))
        largest = float(np.abs(b.tensor).max())
        off = tolerance * largest + (AXES * spread + PRODUCTS if _turned_itself(b.tensor) else 0.0)
        np.testing.assert_allclose(a.tensor, b.tensor, rtol=0, atol=off)
        np.testing.assert_allclose(a.position, b.position, rtol=0, atol=tolerance * max(1.0, np.abs(b.position).max()))
        np.testing.assert_allclose(a.rotation, b.rotation, rtol=0, atol=tolerance)
        assert [j["kind"] for j in a.joints] == [j["kind"] for j in b.joints]
        for one, two in zip(a.joints, b.joints, strict=True):
            for name in ("axis", "anchor", "limits"):
                assert (one[name] is None) == (two[name] is None), name
                if one[name] is not None:
                    np.testing.assert_allclose(one[name], two[name], rtol=0, atol=tolerance * 10, err_msg=name)
            for name in ("ref", "armature", "damping", "friction", "stiffness", "springref"):
                assert abs(one[name] - two[name]) <= max(tolerance, ROUNDING) * max(1.0, abs(two[name])), name
    gravity = np.zeros(3) if model.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_GRAVITY) else model.opt.gravity
    np.testing.assert_array_equal(found.gravity, gravity)


def _turned_itself(tensor):
    return bool(np.abs(tensor - np.diag(np.diag(tensor))).max() > 0)
