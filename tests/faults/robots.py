"""One small fault in an engine's own model of a robot: what an engine would have that reads one number a little wrong.

MuJoCo's ``mjModel`` and Pinocchio's ``Model`` are changed after the engine has read the user's file. Relative size of
every fault: :data:`SIZE`, axes and orientations by so many radians, places by so much of the robot's size.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from furiko.engines.model_files.robot import RobotReader
from furiko.models.spatial import Pose, from_axis_angle, from_quaternion, to_quaternion

SIZE = 1e-6
PRODUCTS = ((0, 1), (0, 2), (1, 2))
# Kinds of faults, and the causes that name them. A body that is fixed to another has no joint to be named.
CAUSES = {
    "mass": {"mass"},
    "centre": {"com-displaced"},
    "moment": {"inertia"},
    "product": {"inertia"},
    "axis": {"joint-axis"},
    "position": {"joint-placement", "body-placement"},
    "orientation": {"joint-orientation", "body-orientation"},
    "armature": {"armature"},
    "damping": {"damping"},
}


@dataclass(frozen=True)
class Fault:
    """``kind``: of :data:`CAUSES`; ``which``: the component, or -1; ``body``, ``joint``: names, or nothing; ``plant``
    changes the engine's model."""

    kind: str
    which: int
    body: str
    joint: str
    plant: Callable[[Any], None]

    @property
    def causes(self):
        return CAUSES[self.kind]


@dataclass(frozen=True)
class PlantedReader(RobotReader):
    """A known engine, whose model is changed after it has read the file."""

    fault: Any = None

    def load(self, path, language, folders=()):
        engine = super().load(path, language, folders)
        self.fault.plant(engine._model)
        if self.name != "mujoco":  # Pinocchio's adapter has looked at the model already
            engine._parts = tuple(engine._all_parts())
        return engine


def planted(reader, fault):
    """The reader of an engine that has this fault."""
    return PlantedReader(**vars(reader), fault=fault)


def across(axis, rng):
    """A random unit vector across an axis (3,)."""
    vector = np.cross(axis, rng.normal(size=3))
    return vector / np.linalg.norm(vector)


def with_component(tensor, kind, which):
    """A tensor with one of its moments larger by the fault's size, or a product by so much of the largest moment.

    Seen in the tensor's principal axes, where products are zero. A moment that no body has so large is made smaller.
    """
    moments, axes = np.linalg.eigh(tensor)
    changed = np.diag(moments)
    if kind == "moment":
        changed[which, which] *= 1 + SIZE
        a, b, c = np.diag(changed)
        if 2 * max(a, b, c) > a + b + c:  # a thin rod or disc: the moment is made smaller
            changed[which, which] = moments[which] * (1 - SIZE)
    else:
        i, j = PRODUCTS[which]
        changed[i, j] += SIZE * moments.max()
        changed[j, i] = changed[i, j]
    return axes @ changed @ axes.T


# --- MuJoCo -----------------------------------------------------------------------------------------------------------


def mujoco_faults(engine, size, seed=1):
    """Every fault of every body and joint of MuJoCo's model; ``size``: the robot's [m]."""
    import mujoco

    model, rng = engine._model, np.random.default_rng(seed)
    moves = moving_bodies(model)
    names = engine.joints()
    for b in range(1, model.nbody):
        own = [j for j in range(model.njnt) if model.jnt_bodyid[j] == b]
        body, joint = model.body(b).name, names[own[0]] if own else ""
        free = any(model.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE for j in own)
        if moves[b] and model.body_mass[b] > 0:
            yield from _mujoco_inertial(model, b, body, size)
        if not free:
            for k in range(3):
                yield Fault("position", k, body, joint, _added(b, "body_pos", SIZE * size * np.eye(3)[k]))
                yield Fault("orientation", k, body, joint, _turned(b, np.eye(3)[k]))
        for j in own:
            kind = int(model.jnt_type[j])
            at = model.jnt_dofadr[j]
            freedoms = slice(at, at + {0: 6, 1: 3}.get(kind, 1))
            if kind in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE):
                axis = from_axis_angle(across(model.jnt_axis[j], rng), SIZE) @ model.jnt_axis[j]
                yield Fault("axis", -1, body, names[j], _set(j, "jnt_axis", axis))
            for kind in ("armature", "damping"):
                value = getattr(model, f"dof_{kind}")[freedoms]
                if value.any():
                    yield Fault(kind, -1, body, names[j], _set(freedoms, f"dof_{kind}", value * (1 + SIZE)))


def moving_bodies(model):
    """Whether each body is moved by some joint."""
    moves = np.zeros(model.nbody, dtype=bool)
    for b in range(1, model.nbody):
        moves[b] = moves[model.body_parentid[b]] or model.body_jntnum[b] > 0
    return moves


def _mujoco_inertial(model, b, body, size):
    yield Fault("mass", -1, body, "", _set(b, "body_mass", model.body_mass[b] * (1 + SIZE)))
    simple = int(model.body_simple[b])  # a free body that MuJoCo takes to be in its inertial's frame, for good
    for k in () if simple else range(3):
        yield Fault("centre", k, body, "", _added(b, "body_ipos", SIZE * size * np.eye(3)[k]))
    axes = from_quaternion(model.body_iquat[b])
    tensor = axes @ np.diag(model.body_inertia[b]) @ axes.T
    for kind in ("moment",) if simple else ("moment", "product"):
        for k in range(3):
            yield Fault(kind, k, body, "", _with_tensor(b, with_component(tensor, kind, k)))


def _set(index, name, value):
    def plant(model):
        getattr(model, name)[index] = value
        _changed(model)

    return plant


def _added(b, name, vector):
    def plant(model):
        getattr(model, name)[b] += vector
        _changed(model)

    return plant


def _turned(b, axis):
    def plant(model):
        turned = from_quaternion(model.body_quat[b]) @ from_axis_angle(axis, SIZE)
        model.body_quat[b] = to_quaternion(turned)
        _changed(model)

    return plant


def _with_tensor(b, tensor):
    def plant(model):
        moments, axes = np.linalg.eigh(tensor)
        axes[:, 0] *= np.sign(np.linalg.det(axes))
        model.body_inertia[b], model.body_iquat[b] = moments, to_quaternion(axes)
        _changed(model)

    return plant


def _changed(model):
    """What MuJoCo has worked out from the numbers: again; and no shortcut for inertials that are nearly in their frame,
    so that the fault acts."""
    import mujoco

    mujoco.mj_setConst(model, mujoco.MjData(model))
    model.body_sameframe[:] = int(mujoco.mjtSameFrame.mjSAMEFRAME_NONE)


# --- Pinocchio --------------------------------------------------------------------------------------------------------


def pinocchio_faults(engine, size, seed=1):
    """Every fault of every joint of Pinocchio's model and of what it carries."""
    model, rng = engine._model, np.random.default_rng(seed)
    for j in range(1, model.njoints):
        parts = [part for part in engine._parts if part.of == j]
        first = parts[0].held[0]
        body = model.frames[engine._bodies[j][0]].name if engine._bodies[j] else model.names[j]
        inertia = model.inertias[j]
        if inertia.mass > 0:
            yield from _pinocchio_inertial(inertia, j, body, size)
        if parts[0].type != "FreeFlyer":
            for k in range(3):
                place = Pose(np.eye(3), SIZE * size * np.eye(3)[k])
                turn = Pose(from_axis_angle(np.eye(3)[k], SIZE), np.zeros(3))
                yield Fault("position", k, body, first.shown, _placed(j, place))
                yield Fault("orientation", k, body, first.shown, _placed(j, turn))
        if len(parts) == 1 and parts[0].type in ("Revolute", "Prismatic", "Unbounded"):
            motion = np.asarray(parts[0].joint.createData().S).reshape(6)
            axis = motion[:3] if parts[0].type == "Prismatic" else motion[3:]
            turn = Pose(from_axis_angle(across(axis, rng), SIZE), np.zeros(3))
            yield Fault("axis", -1, body, first.shown, _axis_turned(j, turn))
        for part in parts:
            for name in ("armature", "damping"):
                freedoms = slice(part.at_v, part.at_v + part.joint.nv)
                value = np.array(getattr(model, name)[freedoms])
                if value.any():
                    yield Fault(name, -1, body, part.held[0].shown, _freedoms(name, freedoms, value * (1 + SIZE)))


def _pinocchio_inertial(inertia, j, body, size):
    mass, centre, tensor = inertia.mass, np.array(inertia.lever), np.array(inertia.inertia)
    yield Fault("mass", -1, body, "", _inertia(j, mass * (1 + SIZE), centre, tensor))
    for k in range(3):
        yield Fault("centre", k, body, "", _inertia(j, mass, centre + SIZE * size * np.eye(3)[k], tensor))
    for kind in ("moment", "product") if tensor.any() else ():
        for k in range(3):
            yield Fault(kind, k, body, "", _inertia(j, mass, centre, with_component(tensor, kind, k)))


def _inertia(j, mass, centre, tensor):
    def plant(model):
        import pinocchio

        model.inertias[j] = pinocchio.Inertia(float(mass), centre, tensor)

    return plant


def _placed(j, moved):
    """The joint placed otherwise, as its own frame has it."""

    def plant(model):
        model.jointPlacements[j] = model.jointPlacements[j] * _se3(moved)

    return plant


def _axis_turned(j, turn):
    """The joint's axis turned and nothing else: its frame is turned, and everything that it carries back."""

    def plant(model):
        there, back = _se3(turn), _se3(turn).inverse()
        model.jointPlacements[j] = model.jointPlacements[j] * there
        model.inertias[j] = back.act(model.inertias[j])
        for child in range(j + 1, model.njoints):
            if model.parents[child] == j:
                model.jointPlacements[child] = back * model.jointPlacements[child]
        for frame in model.frames:
            if frame.parentJoint == j:
                frame.placement = back * frame.placement

    return plant


def _freedoms(name, freedoms, value):
    def plant(model):
        numbers = np.array(getattr(model, name))
        numbers[freedoms] = value
        setattr(model, name, numbers)

    return plant


def _se3(pose):
    import pinocchio

    return pinocchio.SE3(pose.rotation, pose.translation)


FAULTS = {"mujoco": mujoco_faults, "pinocchio-aba": pinocchio_faults}
