"""A user's own file in Drake, an optional extra: held against MuJoCo's reading and closed forms."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from compared_robots import as_read, assert_same_dynamics, assert_same_numbers, states
from handwritten_robots import ALIKE, INERTIAL, LINK, URDFS, mjcf, urdf, urdf_joint

from furiko import diagnose
from furiko.engines.model_files.robot import ROBOT_READERS
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism

pytest.importorskip("pydrake", reason="Drake is not installed: pip install furiko[drake]")

# Without what Drake reads differently: armature without an actuator, a place of a body with several joints.
WITHOUT_ARMATURE = {
    kind: re.sub(r' armature="[^"]*"', "", body)
    for kind, body in ALIKE.items()
    if kind not in {"several joints a body", "ref"}
}
SEVERAL = {
    "several joints a body": f"""<body name="a"><joint name="x" type="slide" axis="1 0 0"/>
        <joint axis="0 1 0" pos="0.1 0 0.2"/><joint axis="0 1 1" pos="0 0.3 0"/>{INERTIAL.format(1.5)}
        <body name="b" pos="0 0.1 0"><joint name="j"/>{INERTIAL.format(1)}
        <body><joint axis="1 0 0"/><joint type="ball" pos="0 0.3 0.2"/>{INERTIAL.format(1)}</body></body></body>""",
    "ref": f"""<body name="a" pos="0 0.1 0"><joint name="x" axis="0 1 1" ref="0.4" pos="0.1 0 0"/>{INERTIAL.format(1.5)}
        <body name="b"><joint name="y" axis="1 0 0" ref="0.5"/><joint name="z" axis="0 1 0" ref="-0.3" pos="0 0.1 0"/>
        {INERTIAL.format(1)}<body name="c" pos="0.1 0 0"><joint name="s" type="slide" axis="0 1 2" ref="0.2"/>
        {INERTIAL.format(1)}</body></body></body>""",
}  # fmt: skip
MJCFS = {**WITHOUT_ARMATURE, **SEVERAL}


@pytest.fixture
def compared(read):
    def made(text):
        mujoco, drake = read("mujoco", text), read("drake", text)
        mechanism = as_read(mujoco.compiled())
        # A floating joint's origin is not read: its link starts in the world's.
        assert_same_numbers(mechanism, drake.compiled(mechanism), free="floating" not in text)
        assert_same_dynamics(mechanism, mujoco.bind(mechanism), drake.bind(mechanism))

    return made


@pytest.mark.parametrize("kind", MJCFS)
def test_mujoco_and_drake_read_and_move_a_mjcf_alike(compared, kind):
    compared(mjcf(MJCFS[kind]))


@pytest.mark.parametrize("kind", URDFS)
def test_mujoco_and_drake_read_and_move_a_urdf_alike(compared, kind):
    compared(urdf(URDFS[kind]))


@pytest.mark.parametrize("axis", ["1 0 0", "0 -1 0", "0 0 -1", "0.6 0 0.8", "0.48 0.64 0.6"])
def test_planar_joints_in_any_plane(compared, axis):
    compared(urdf([LINK.format("a", 2), urdf_joint("planar", "j", "world", "a", axis)]))


def test_other_directions_in_a_planar_joints_plane(read):
    """Along slides turned by 0.4 in the plane the same point is at x = R x', and M' = Rᵀ M R. The plane turns too."""
    joints = [urdf_joint("continuous", "h", "world", "a", "1 0 0"), urdf_joint("planar", "j", "a", "b", "0.6 0 0.8")]
    drake = read("drake", urdf([LINK.format("a", 2), LINK.format("b", 1), *joints]))
    mechanism = drake.compiled()
    root, body = mechanism.bodies
    along, across, hinge = body.joints
    c, s = math.cos(0.4), math.sin(0.4)
    turn = np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])
    one = replace(along, axis=c * along.axis + s * across.axis)
    other = replace(across, axis=c * across.axis - s * along.axis)
    turned = drake.bind(replace(mechanism, bodies=(root, replace(body, joints=(one, other, hinge)))))
    straight, (q, v, torque) = drake.bind(mechanism), states(mechanism, 5)
    straight_q, straight_v = q @ turn.T, v @ turn.T
    expected = straight.accelerations(straight_q, straight_v, torque @ turn.T) @ turn
    # Some roundings in numbers of up to a hundred.
    np.testing.assert_allclose(turned.accelerations(q, v, torque), expected, rtol=1e-12, atol=1e-12)
    matrix = turn.T @ straight.mass_matrix(straight_q) @ turn
    np.testing.assert_allclose(turned.mass_matrix(q), matrix, rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(turned.bias(q, v), straight.bias(straight_q, straight_v) @ turn, rtol=1e-12, atol=1e-12)


def test_a_place_of_a_body_with_several_joints_is_read_at_the_last(read):
    """Both hinges are 1 m above the world, and the first is in the world's origin for Drake: M₁₁ 0.21 for 1.21."""
    text = mjcf("""<body name="b" pos="0 0 1"><joint name="j1" axis="0 1 0"/><joint name="j2" axis="1 0 0"/>
        <inertial pos="0.1 0 -1" mass="1" diaginertia="0.1 0.2 0.3"/></body>""")
    matrices = []
    for engine in ("mujoco", "drake"):
        robot = read(engine, text)
        matrices.append(robot.bind(robot.compiled()).mass_matrix(np.zeros((1, 2)))[0, 0, 0])
    np.testing.assert_allclose(matrices, [0.2 + 0.01 + 1, 0.2 + 0.01], rtol=1e-14)


def test_a_massless_body_of_the_file_stays_one(read):
    """Drake would call the first of two joints' bodies ``a0``; ``a1`` alone is the file's own."""
    body = f"""<body name="a1"><joint name="x"/><body name="a"><joint name="y"/>{INERTIAL.format(1)}</body></body>"""
    compiled = read("drake", mjcf(body)).compiled()
    assert [(b.name, [joint.name for joint in b.joints]) for b in compiled.bodies] == [("a1", ["x"]), ("a", ["y"])]


def test_armature_needs_an_actuator(read):
    body = """<body name="a"><joint name="h" axis="0 1 0" armature="0.5" range="-0.1 0.1"/>
        <inertial pos="0 0 -1" mass="1" diaginertia="0.1 0.2 0.3"/></body>"""
    servo = '<actuator><position joint="h" kp="100"/></actuator>'
    zero, angle, torque = np.zeros((1, 1)), np.array([[0.7]]), np.array([[2.0]])
    for more, armature in (("", 0), (servo, 0.5)):
        robot = read("drake", mjcf(body, "", more))
        bound = robot.bind(robot.compiled())
        assert [placed.joint.armature for placed in robot.compiled().joints] == [armature]
        np.testing.assert_allclose(bound.mass_matrix(zero), 1.2 + armature, rtol=1e-14)
        # Beyond the limit, and with a servo that would pull back: gravity and the torque alone.
        expected = (2 - 9.81 * math.sin(0.7)) / (1.2 + armature)
        np.testing.assert_allclose(bound.accelerations(angle, zero, torque), expected, rtol=1e-14)


def test_damping_acts(read):
    text = mjcf(f"""<body name="a"><joint name="h" axis="0 1 0" damping="0.3" stiffness="5"/>{INERTIAL.format(1)}
        <body name="b"><joint name="s" type="slide" damping="0.7"/>{INERTIAL.format(1)}</body></body>""")
    robot = read("drake", text)
    mechanism = robot.compiled()
    assert [(placed.joint.damping, placed.joint.stiffness) for placed in mechanism.joints] == [(0.3, 0), (0.7, 0)]
    bound, (q, v, torque) = robot.bind(mechanism), states(mechanism, 3)
    passive = v * [-0.3, -0.7]
    np.testing.assert_allclose(bound.passive(q, v), passive, rtol=1e-15)
    left = np.einsum("bij,bj->bi", bound.mass_matrix(q), bound.accelerations(q, v, torque)) + bound.bias(q, v)
    np.testing.assert_allclose(left, torque + passive, rtol=1e-12, atol=1e-13)


def test_damping_of_a_free_joint_is_dropped(read):
    text = mjcf(f'<body name="a"><joint type="free" damping="0.3"/>{INERTIAL.format(1)}</body>')
    assert [placed.joint.damping for placed in read("drake", text).compiled().joints] == [0]


def test_a_pose_of_a_body_with_several_joints_is_the_only_cause(tmp_path):
    """Not the order of its joints: what is held and what is read with that mistake have the same bodies."""
    path = tmp_path / "a.xml"
    path.write_text(
        mjcf(f"""<body name="a" pos="0 0 1"><joint name="x" axis="1 0 0"/><joint name="y" axis="0 1 0"/>
        <joint name="z"/>{INERTIAL.format(1)}</body>""")
    )
    found = diagnose(path, engines=["drake"])
    assert [finding.cause for finding in found.findings] == ["pos-of-last-joint-for-all"], found.text()


def test_a_urdf_hangs_on_its_root_and_mimic_joints_are_independent(read):
    mimic = urdf_joint("continuous", "k", "base", "b", "0 1 0").replace("</joint>", '<mimic joint="j"/></joint>')
    links = [LINK.format("base", 3), LINK.format("a", 2), LINK.format("b", 1)]
    text = f"""<robot name="r">{"".join(links)}{urdf_joint("continuous", "j", "base", "a", "1 0 0")}{mimic}</robot>"""
    mujoco, drake = read("mujoco", text), read("drake", text)
    assert drake.joints() == ("j", "k")
    mechanism = mujoco.compiled()
    assert_same_dynamics(mechanism, mujoco.bind(mechanism), drake.bind(mechanism))


def test_a_file_of_another_suffix_and_without_a_name(tmp_path):
    body = f"""<body name="a"><joint name="h"/>{INERTIAL.format(1)}</body>"""
    for name, language, text in (
        ("m.mjcf", "mjcf", mjcf(body).replace("<mujoco>", '<mujoco model="m">')),
        ("m.xml", "mjcf", mjcf(body)),
        ("a b.xml", "mjcf", mjcf(body)),
        ("m.xml", "urdf", urdf([LINK.format("a", 1), urdf_joint("continuous", "h", "world", "a")])),
    ):
        (tmp_path / name).write_text(text)
        assert ROBOT_READERS["drake"].load(tmp_path / name, language).joints() == ("h",)


def test_joints_that_are_not_the_files_are_named(read):
    robot = read("drake", mjcf(ALIKE["branches"]))
    compiled = robot.compiled()
    root = compiled.bodies[0]
    other = (replace(root, joints=(Joint("other"),)), *compiled.bodies[1:])
    with pytest.raises(ValueError, match=r"no joint 'other'; Drake has a joint 'j10' that the file has not"):
        robot.bind(replace(compiled, bodies=other))
    slide = (replace(root, joints=(Joint("j10", "slide"),)), *compiled.bodies[1:])
    with pytest.raises(ValueError, match=r"joint 'j10' is a slide in the file, Drake has a hinge"):
        robot.bind(replace(compiled, bodies=slide))


def test_drake_says_nothing(read, capfd, caplog):
    """It warns of what it does not read."""
    body = f"""<body name="a"><joint name="h" stiffness="3" frictionloss="1"/>{INERTIAL.format(1)}</body>"""
    robot = read("drake", mjcf(body, '<option integrator="RK4"/>', '<equality><joint joint1="h"/></equality>'))
    mechanism = SpatialMechanism((RigidBody("a", -1, joints=(Joint("h"),)),), np.zeros(3))
    robot.bind(mechanism).accelerations(np.zeros((1, 1)), np.zeros((1, 1)), np.zeros((1, 1)))
    with pytest.raises(RuntimeError):
        read("drake", "<robot><nonsense>")
    assert capfd.readouterr() == ("", "")
    assert not caplog.records
