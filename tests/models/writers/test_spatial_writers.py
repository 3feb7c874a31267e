"""Explicit texts of a spatial mechanism: every engine has the mass matrix and bias that the theory proves."""

import math
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from furiko.engines.model_files.robot import ROBOT_READERS
from furiko.models import InvalidInput
from furiko.models.readers.model_file import model_from_text
from furiko.models.spatial import ZERO_INERTIAL, Inertial, from_quaternion
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from furiko.models.writers.spatial_mjcf import spatial_mjcf
from furiko.models.writers.spatial_urdf import spatial_urdf
from furiko.reference.truth.spatial import spatial_truth

SOLID = Inertial(1.5, np.array([0.1, -0.2, 0.3]), np.array([[1, 0.1, 0.2], [0.1, 1.2, 0.05], [0.2, 0.05, 1.3]]) / 10)
TILTED = np.array([0.9, 0.1, -0.2, 0.3])
ROD = Inertial(0.4, np.array([0.0, 0.0, 0.3]), np.diag([0.02, 0.02, 0.0]))
LEAN = from_quaternion([0.9, 0.1, -0.7, -0.9])  # its principal axes come out of eigh left-handed
LEANING = replace(ROD, tensor=LEAN @ ROD.tensor @ LEAN.T)
POINT = Inertial(0.3, np.array([0.2, -0.1, 0.3]), np.zeros((3, 3)))
DISC = Inertial(0.0, np.zeros(3), np.diag([0.1, 0.1, 0.2]))
EARTH = np.array([0.0, 0.0, -9.81])


def joint(name, kind="hinge", axis=(1, 2, 0), **more):
    return Joint(
        name, kind, axis=np.array(axis, dtype=float), anchor=np.array(more.pop("anchor", (0.1, 0.2, 0.3))), **more
    )


def body(name, parent, *joints, inertial=SOLID, turned=TILTED):
    return RigidBody(name, parent, np.array([0.3, -0.1, 0.2]), turned, joints, inertial)


def mechanism(*bodies, gravity=EARTH):
    return SpatialMechanism(bodies, gravity)


# y × z: a quarter turn about −x takes z to y, so that the slides of a planar joint about y are along x and −z.
PLANAR = (joint("p_TX", "slide", (1, 0, 0)), joint("p_TY", "slide", (0, 0, -1)), joint("p_RZ", "hinge", (0, 1, 0)))
BOTH = {
    "hinges": mechanism(body("a", -1, joint("one")), body("b", 0, joint("two", axis=(0, 1, 1), limits=(-1.0, 2.0)))),
    "a slide": mechanism(body("a", -1, joint("one", "slide")), body("b", 0, joint("two"))),
    "ref": mechanism(body("a", -1, joint("one", ref=0.7)), body("b", 0, joint("two", "slide", ref=-0.4))),
    "damped": mechanism(body("a", -1, joint("one", damping=0.3, friction=0.1)), body("b", 0, joint("two"))),
    "limits of nothing": mechanism(body("a", -1, joint("one", limits=(0.0, 0.0))), body("b", 0, joint("two"))),
    "two roots": mechanism(body("a", -1, joint("one")), body("b", -1, joint("two", "slide"))),
    "a fixed first body": mechanism(body("a", -1), body("b", 0, joint("two"))),
    "a fixed body": mechanism(body("a", -1, joint("one")), body("b", 0), body("c", 1, joint("two"))),
    "bodies without mass": mechanism(
        body("a", -1, joint("one")), body("b", 0, inertial=ZERO_INERTIAL), body("c", 1, inertial=DISC)
    ),
    "fixed point masses": mechanism(
        body("a", -1, joint("one")), body("b", 0, inertial=POINT), body("c", 0, inertial=ROD)
    ),
    "impossible, where nothing moves": mechanism(
        body("a", -1, inertial=Inertial(1.0, np.zeros(3), -np.eye(3))),
        body("b", 0, inertial=DISC),
        body("c", 1, joint("two")),
    ),
    "a base without mass": mechanism(body("a", -1, inertial=DISC), body("b", 0, joint("two"))),
    "one called world": mechanism(body("world", -1, joint("one")), body("b", 0, joint("two"))),
    "one called like another": mechanism(body("a", -1, joint("one")), body("a", 0, joint("two"))),
    "free": mechanism(body("a", -1, Joint("one", "free")), body("b", 0, joint("two"))),
    "planar": mechanism(body("a", -1, *PLANAR), body("b", 0, joint("two"))),
    "a quarter turn up": mechanism(
        body("a", -1, joint("one"), turned=np.array([1.0, 0.0, 1.0, 0.0])), body("b", 0, joint("two"))
    ),
}
MJCF_ALONE = {
    "a ball": (mechanism(body("a", -1, joint("one", "ball")), body("b", 0, joint("two"))), "ball joint"),
    "armature": (mechanism(body("a", -1, joint("one", armature=0.4))), "armature 0.4"),
    "a spring": (mechanism(body("a", -1, joint("one", stiffness=2.0, springref=0.3))), "stiffness 2"),
    "a gravity": (mechanism(body("a", -1, joint("one")), gravity=np.array([1.0, 2.0, 3.0])), "gravity 1.0 2.0 3.0"),
    "several joints": (mechanism(body("a", -1, joint("one"), joint("two", "slide"))), "2 joints on one body"),
    "bodies called as others would be": (
        mechanism(
            body("a", -1, joint("one"), joint("two", "slide")), body("a0", 0, joint("three")), body("a_frame", 1)
        ),
        "2 joints on one body",
    ),
    "a moving rod": (mechanism(body("a", -1, joint("one", axis=(1, 0, 1)), inertial=ROD)), "a moment of inertia is 0"),
    "a leaning rod": (
        mechanism(body("a", -1, joint("one", axis=(1, 0, 1)), inertial=LEANING)),
        "a moment of inertia is 0",
    ),
    "a moving point mass": (
        mechanism(body("a", -1, joint("one", anchor=(0, 0, 0)), inertial=POINT)),
        "a moment of inertia is 0",
    ),
    "a damped planar joint": (
        mechanism(body("a", -1, *(replace(one, damping=0.1) for one in PLANAR))),
        "planar joint with ref or damping",
    ),
    "a damped free joint": (
        mechanism(body("a", -1, Joint("one", "free", damping=0.1))),
        "damping or friction of a free",
    ),
}
NEITHER = {
    "impossible": (
        body("a", -1, joint("one"), inertial=Inertial(1.0, np.zeros(3), np.diag([1.0, 1, 3]))),
        "no rigid body",
    ),
    "negative": (body("a", -1, joint("one"), inertial=Inertial(-1.0, np.zeros(3), np.eye(3))), "no rigid body"),
    "moving without mass": (body("a", -1, joint("one"), inertial=DISC), "an inertia without a mass"),
}


def state(found, seed=5):
    rng = np.random.default_rng(seed)
    q = rng.normal(size=found.nq)
    for placed in found.joints:
        if placed.joint.kind in ("ball", "free"):
            turn = q[placed.at_q + placed.joint.coordinates - 4 :][:4]
            turn /= math.hypot(*turn)
    return q, rng.normal(size=found.nv)


def assert_as_proved(tmp_path, text, language, engine, asked):
    path = tmp_path / f"model.{language}"
    path.write_text(text)
    bound = ROBOT_READERS[engine].load(path, language).bind(asked)
    q, v = state(asked)
    truth = spatial_truth(asked, q, v)
    mass_matrix, bias = truth.mass_matrix.float, truth.bias.float
    # A few bodies: some tens of roundings, of the largest of each. A moment of zero is written as 1e-15 kg m², which
    # is the least that MuJoCo takes.
    raised = 1.1e-15 if "boundinertia" in text else 0.0
    np.testing.assert_allclose(
        bound.mass_matrix(q[None])[0], mass_matrix, rtol=0, atol=2e-14 * np.abs(mass_matrix).max() + raised
    )
    if engine == "pinocchio-aba" and language == "mjcf" and tuple(asked.gravity) != tuple(EARTH):
        return  # it does not read gravity
    np.testing.assert_allclose(bound.bias(q[None], v[None])[0], bias, rtol=0, atol=5e-14 * np.abs(bias).max())


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba"])
@pytest.mark.parametrize("language", ["mjcf", "urdf"])
@pytest.mark.parametrize("case", BOTH)
def test_engines_read_the_theory_in_both_formats(tmp_path, case, language, engine):
    asked = BOTH[case]
    text = (spatial_mjcf if language == "mjcf" else spatial_urdf)(asked)
    assert_as_proved(tmp_path, text, language, engine, asked)


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba"])
@pytest.mark.parametrize("case", MJCF_ALONE)
def test_what_urdf_cannot_say_is_refused_there_and_said_in_mjcf(tmp_path, case, engine):
    asked, says = MJCF_ALONE[case]
    with pytest.raises(InvalidInput, match=says):
        spatial_urdf(asked)
    assert_as_proved(tmp_path, spatial_mjcf(asked), "mjcf", engine, asked)


@pytest.mark.parametrize("write", [spatial_mjcf, spatial_urdf])
@pytest.mark.parametrize("case", NEITHER)
def test_inertials_on_which_engines_do_not_agree_are_refused(case, write):
    bad, says = NEITHER[case]
    with pytest.raises(InvalidInput, match=says):
        write(mechanism(bad))


def test_no_body_is_called_as_drake_calls_those_that_it_makes_of_joints():
    """Of k joints on a body called b it makes bodies b0, b1, …, and the last moves b."""
    loose = [body(f"furiko_body_{i}", -1, Joint(f"free {i}", "free")) for i in range(1, 30)]
    root = ElementTree.fromstring(spatial_mjcf(mechanism(*loose)))
    names = []
    for element in root.iter("body"):
        names.append(element.get("name"))
        names += [f"{element.get('name')}{k}" for k in range(len(element.findall("joint")) - 1)]
    assert len(names) == 29 * (2 + 3) + 1
    assert len(set(names)) == len(names)


def test_what_mujoco_has_besides(tmp_path):
    import mujoco

    asked = mechanism(
        body(
            "a", -1, joint("one", damping=0.3, friction=0.1, stiffness=2.0, springref=0.4, ref=0.1, limits=(-1.0, 2.0))
        ),
        body("b", 0, joint("two", "slide", armature=0.2)),
    )
    model = mujoco.MjModel.from_xml_string(spatial_mjcf(asked))
    assert list(model.dof_damping) == [0.3, 0]
    assert list(model.dof_frictionloss) == [0.1, 0]
    assert list(model.dof_armature) == [0, 0.2]
    assert list(model.jnt_stiffness) == [2, 0]
    assert list(model.jnt_limited) == [1, 0]
    assert list(model.jnt_range[0]) == [-1, 2]
    assert (model.qpos_spring[0], model.qpos0[0]) == (0.4, 0.1)
    assert model.ngeom == 0


def test_what_is_written_as_urdf_is_read_back():
    for asked in (BOTH["hinges"], BOTH["damped"], BOTH["planar"], BOTH["free"]):
        found = model_from_text(spatial_urdf(asked)).spatial
        q, v = state(asked)
        assert found.joint_names == asked.joint_names
        got, wanted = (spatial_truth(one, q, v) for one in (found, asked))
        largest = np.abs(wanted.bias.float).max()
        np.testing.assert_allclose(got.bias.float, wanted.bias.float, rtol=0, atol=5e-14 * largest)
        np.testing.assert_array_equal(found.per_freedom("damping"), asked.per_freedom("damping"))


def test_a_mechanism_too_deep_is_refused():
    deep = [body(f"b{i}", i - 1, joint(f"j{i}")) for i in range(460)]
    with pytest.raises(InvalidInput, match="deep"):
        spatial_mjcf(mechanism(*deep))
