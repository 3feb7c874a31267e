"""A user's own file of any open mechanism in MuJoCo and Pinocchio: what they hold, and how it moves in one mapping.

Expected values are closed forms, or the other engine's, whose coordinates and algorithms are its own.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from compared_robots import as_read, assert_same_dynamics, assert_same_numbers, close, states
from handwritten_robots import ALIKE, INERTIAL, LINK, URDFS, mjcf, urdf, urdf_joint

from furiko.engines.model_files.robot_coordinates import Block, RobotCoordinates, roll_pitch_yaw
from furiko.models.spatial import Pose, from_quaternion, from_roll_pitch_yaw, to_quaternion
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism


def both(read, text):
    mujoco, pinocchio = read("mujoco", text), read("pinocchio-aba", text)
    mechanism = as_read(mujoco.compiled())
    return mechanism, mujoco.bind(mechanism), pinocchio.bind(mechanism)


@pytest.mark.parametrize("kind", ALIKE)
def test_mujoco_and_pinocchio_move_a_mjcf_alike(read, kind):
    assert_same_dynamics(*both(read, mjcf(ALIKE[kind])))


@pytest.mark.parametrize("kind", URDFS)
def test_mujoco_and_pinocchio_move_a_urdf_alike(read, kind):
    assert_same_dynamics(*both(read, urdf(URDFS[kind])))


@pytest.mark.parametrize("text", [*map(mjcf, ALIKE.values()), *map(urdf, URDFS.values())], ids=[*ALIKE, *URDFS])
def test_both_hold_the_same_numbers(read, text):
    like = as_read(read("mujoco", text).compiled())
    # Pinocchio 4.1 starts a free body whose MJCF turns it at 2 p − R p where the file says p.
    assert_same_numbers(like, read("pinocchio-aba", text).compiled(like), free="<freejoint" not in text)


def test_what_mujoco_holds_is_what_the_file_says(read):
    text = mjcf(
        """<body name="base" pos="1 2 3" quat="0 1 0 0"><inertial pos="0 0 1" mass="4" diaginertia="1 2 3"/>
        <joint name="h" axis="0 3 4" pos="1 0 0" ref="0.25" armature="0.5" damping="0.75" frictionloss="0.125"
         stiffness="2" springref="-0.5" range="-1 2"/>
        <body name="child" pos="0 0 1"><joint name="b" type="ball" range="0 1" stiffness="3"/>
        <inertial pos="0 0 1" mass="4" diaginertia="1 2 3"/></body></body>""",
        '<option gravity="1 2 3"/>',
    )
    compiled = read("mujoco", text).compiled()
    base, child = compiled.bodies
    assert (base.name, base.parent, child.name, child.parent) == ("base", -1, "child", 0)
    np.testing.assert_array_equal(base.position, [1, 2, 3])
    np.testing.assert_array_equal(base.quaternion, [0, 1, 0, 0])
    np.testing.assert_array_equal(base.inertial.centre, [0, 0, 1])
    np.testing.assert_allclose(base.inertial.tensor, np.diag([1, 2, 3]), rtol=1e-15)
    (hinge,), (ball,) = base.joints, child.joints
    np.testing.assert_allclose(hinge.axis, [0, 0.6, 0.8], rtol=1e-15)
    np.testing.assert_array_equal(hinge.anchor, [1, 0, 0])
    numbers = (hinge.ref, hinge.armature, hinge.damping, hinge.friction, hinge.stiffness, hinge.springref)
    assert numbers == (0.25, 0.5, 0.75, 0.125, 2, -0.5)
    assert (hinge.limits, ball.limits, ball.kind, ball.stiffness) == ((-1, 2), (0, 1), "ball", 3)
    np.testing.assert_array_equal(compiled.gravity, [1, 2, 3])


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba"])
def test_a_cart_with_a_pole(read, engine):
    cart, pole, length, inertia, armature = 1.2, 0.15, 0.45, 0.0101, 0.02
    text = mjcf(f"""<body name="cart"><joint name="x" type="slide" axis="1 0 0"/>
        <inertial pos="0 0 0" mass="{cart}" diaginertia="1 1 1"/><body name="pole">
        <joint name="turn" axis="0 1 0" armature="{armature}"/><inertial pos="0 0 {-length}" mass="{pole}"
        diaginertia="{inertia} {inertia} {inertia}"/></body></body>""")
    robot = read(engine, text)
    bound = robot.bind(robot.compiled())
    q, v, torque = np.array([[0.3, 0.7]]), np.array([[-0.4, 1.3]]), np.array([[2.0, -0.5]])
    c, s = math.cos(0.7), math.sin(0.7)
    # Positive angles about y take the hanging pole to -x: x_com = x - l sin, z_com = -l cos.
    matrix = np.array([[cart + pole, -pole * length * c], [-pole * length * c, inertia + pole * length**2 + armature]])
    bias = np.array([pole * length * s * 1.3**2, pole * 9.81 * length * s])
    np.testing.assert_allclose(bound.mass_matrix(q)[0], matrix, rtol=1e-14)
    np.testing.assert_allclose(bound.bias(q, v)[0], bias, rtol=1e-14)
    np.testing.assert_allclose(
        bound.accelerations(q, v, torque)[0], np.linalg.solve(matrix, torque[0] - bias), rtol=1e-13
    )


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba"])
def test_a_free_body_falls_and_its_coordinates_are_of_the_world_and_of_the_body(read, engine):
    """A free body's centre of mass falls with g; torque-free its spin obeys Euler's equations in the body's axes."""
    moments = np.array([0.1, 0.2, 0.25])
    text = mjcf("""<body name="a" pos="0.3 0.1 0.5" quat="0.6 0 0.8 0"><freejoint name="j"/>
        <inertial pos="0.1 0 0" mass="2" diaginertia="0.1 0.2 0.25"/></body>""")
    robot = read(engine, text)
    bound = robot.bind(robot.compiled())
    quaternion, spin, offset = np.array([0.5, -0.5, 0.1, 0.7]), np.array([1.0, -2.0, 0.5]), np.array([0.1, 0, 0])
    q = np.concatenate([[5.0, 6, 7], quaternion])[None]
    v = np.concatenate([[0.4, 0.5, 0.6], spin])[None]
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    turned = np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )
    spinning = -np.cross(spin, moments * spin) / moments
    inside = np.cross(spinning, offset) + np.cross(spin, np.cross(spin, offset))
    expected = np.concatenate([[0, 0, -9.81] - turned @ inside, spinning])
    np.testing.assert_allclose(bound.accelerations(q, v, np.zeros((1, 6)))[0], expected, rtol=1e-13, atol=1e-14)
    force = np.array([3.0, -1, 2])  # at the body's origin, in world axes: M a = force there
    pushed = bound.accelerations(q, v, np.concatenate([force, np.zeros(3)])[None])[0] - expected
    moment = np.cross(-offset, turned.T @ force) / moments
    at_origin = force / 2 - turned @ np.cross(moment, offset)
    np.testing.assert_allclose(pushed, [*at_origin, *moment], rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba"])
def test_quaternions_of_any_length_are_their_direction(read, engine):
    robot = read(engine, mjcf(ALIKE["free"] + ""))
    bound = robot.bind(robot.compiled())
    q, v, torque = states(robot.compiled(), 3)
    longer = q * np.array([1, 1, 1, 3, 3, 3, 3])
    close(bound.bias(longer, v), bound.bias(q, v), 100)
    close(bound.mass_matrix(longer), bound.mass_matrix(q), 10)
    close(bound.accelerations(longer, v, torque), bound.accelerations(q, v, torque), 1000)


def test_armature_of_a_free_joint_acts_in_the_world_in_mujoco_and_in_the_body_in_pinocchio(read):
    """Accelerations along the world's axes of a body with armature A that spins: A·(ω × v) is the difference."""
    body = """<body name="a"><joint name="j" type="free" armature="0.5"/>
        <inertial pos="0 0 0" mass="1.5" diaginertia="0.2 0.2 0.2"/></body>"""
    text = mjcf(body, '<option gravity="0 0 0"/>')
    _, mujoco, pinocchio = both(read, text)
    q = np.array([[0, 0, 0, 1.0, 0, 0, 0]])
    v = np.array([[1.0, 0, 0, 0, 0, 2]])
    np.testing.assert_allclose(mujoco.bias(q, v), 0, rtol=0, atol=1e-15)
    gravity = 9.81 * 1.5 * np.eye(6)[[2]]  # which Pinocchio does not read
    np.testing.assert_allclose(pinocchio.bias(q, v) - gravity, [[0, -0.5 * 2, 0, 0, 0, 0]], rtol=0, atol=1e-14)
    np.testing.assert_allclose(pinocchio.mass_matrix(q), mujoco.mass_matrix(q), rtol=1e-15)


def test_springs_and_dampers(read):
    text = mjcf(
        f"""<body name="a"><joint name="h" axis="0 1 0" damping="0.3" stiffness="5" springref="0.2" ref="0.1"/>
        {INERTIAL.format(1)}<body name="b"><joint name="s" type="slide" axis="1 0 0" damping="0.7" stiffness="4"/>
        {INERTIAL.format(1)}<body name="c"><joint name="b" type="ball" damping="0.9" stiffness="2" armature="1"/>
        {INERTIAL.format(1)}</body></body></body>"""
    )
    _, mujoco, pinocchio = both(read, text)
    angle = 0.8
    q = np.array([[0.5, 0.6, math.cos(angle / 2), 0, math.sin(angle / 2), 0]])
    v, torque = np.array([[1.0, -2, 0.5, 0.25, -0.5]]), np.array([[1.0, 2, 3, 4, 5]])
    expected = [-5 * 0.3 - 0.3, -4 * 0.6 + 1.4, -0.45, -2 * angle - 0.225, 0.45]
    np.testing.assert_allclose(mujoco.passive(q, v)[0], expected, rtol=1e-14)
    left = mujoco.mass_matrix(q)[0] @ mujoco.accelerations(q, v, torque)[0] + mujoco.bias(q, v)[0]
    np.testing.assert_allclose(left, torque[0] + expected, rtol=1e-12)
    # Pinocchio holds the damping of hinges and slides, and its articulated-body algorithm applies none.
    robot = read("pinocchio-aba", text)
    assert [placed.joint.damping for placed in robot.compiled().joints] == [0.3, 0.7, 0]
    assert not pinocchio.passive(q, v).any()
    left = pinocchio.mass_matrix(q)[0] @ pinocchio.accelerations(q, v, torque)[0] + pinocchio.bias(q, v)[0]
    np.testing.assert_allclose(left, torque[0], rtol=1e-12)


def test_the_files_own_flags_stay(read):
    body = f"""<body name="a"><joint name="h" axis="0 1 0" damping="0.3" stiffness="5"/>{INERTIAL.format(1)}</body>"""
    q, v = np.array([[0.5]]), np.array([[0.0]])
    for flag, zero in (("gravity", "bias"), ("spring", "passive")):
        robot = read("mujoco", mjcf(body, f'<option><flag {flag}="disable"/></option>'))
        assert not getattr(robot.bind(robot.compiled()), zero)(q, v).any()
    assert not read("mujoco", mjcf(body, '<option><flag gravity="disable"/></option>')).compiled().gravity.any()
    (joint,) = read("mujoco", mjcf(body, '<option><flag spring="disable"/></option>')).compiled().bodies[0].joints
    assert (joint.stiffness, joint.damping) == (0, 0.3)


PLAIN = f"""<body name="a" pos="0 0 0.2"><joint name="h" axis="0 1 0" damping="0.1" {{}}/>{INERTIAL.format(1)}
    <geom name="g" size="0.3" {{}}/><body name="b" pos="0.5 0 0" {{}}><joint name="s" type="slide"/>
    {INERTIAL.format(1)}<geom size="0.3"/></body></body><geom type="plane" size="1 1 1"/>"""
SWITCHED_OFF = {
    "contacts": (("", "", ""), "", ""),
    "limits": (('range="-0.01 0.01"', "", ""), "", ""),
    "dry friction": (('frictionloss="3"', "", ""), "", ""),
    "actuator": (("", "", ""), "", '<actuator><position joint="h" kp="50" armature="2" damping="3"/></actuator>'),
    "adhesion": (("", "", ""), "", '<actuator><adhesion body="b" gain="3" ctrlrange="0 1"/></actuator>'),
    "equality": (("", "", ""), "", '<equality><joint joint1="h" joint2="s"/></equality>'),
    "tendon": (("", "", ""), "", """<tendon><fixed name="t" stiffness="3" damping="2" armature="0.5" frictionloss="1"
        range="0 0.1"><joint joint="h" coef="1"/><joint joint="s" coef="2"/></fixed></tendon>"""),
    "fluid": (("", "", ""), '<option density="1000" viscosity="1" wind="1 0 0"/>', ""),
    "fluid of an ellipsoid": (("", 'fluidshape="ellipsoid"', ""), '<option density="1000" viscosity="1"/>', ""),
    "gravity compensation": (("", "", 'gravcomp="1"'), "", ""),
    "integrator": (("", "", ""), '<option integrator="discrete" timestep="0.1"/>', ""),
    "implicit integrator": (("", "", ""), '<option integrator="implicit" timestep="0.1"/>', ""),
}  # fmt: skip


@pytest.mark.parametrize("what", SWITCHED_OFF)
def test_what_is_not_compared_does_not_act_in_mujoco(read, what):
    fields, options, more = SWITCHED_OFF[what]
    compiler = "<compiler inertiafromgeom='false'/>"
    plain = read("mujoco", mjcf(PLAIN.format('frictionloss="0"', 'contype="0" conaffinity="0"', ""), compiler))
    q, v, torque = states(plain.compiled())
    with_it = read("mujoco", mjcf(PLAIN.format(*fields), compiler + options, more))
    one, other = (robot.bind(robot.compiled()) for robot in (plain, with_it))
    np.testing.assert_array_equal(other.mass_matrix(q), one.mass_matrix(q))
    np.testing.assert_array_equal(other.bias(q, v), one.bias(q, v))
    np.testing.assert_array_equal(other.passive(q, v), one.passive(q, v))
    np.testing.assert_array_equal(other.accelerations(q, v, torque), one.accelerations(q, v, torque))


def test_a_body_that_sleeps_in_mujoco_falls(read):
    """Where nothing has moved it yet: a centre of mass 5 cm beside a hinge about y."""
    body = f"""<body name="a" sleep="init"><joint name="h" axis="0 1 0"/>{INERTIAL.format(1)}</body>"""
    robot = read("mujoco", mjcf(body, '<option><flag sleep="enable"/></option>'))
    bound, zero = robot.bind(robot.compiled()), np.zeros((1, 1))
    moment = 0.2 + 0.05**2 + 0.2**2
    np.testing.assert_allclose(bound.accelerations(zero, zero, zero), 9.81 * 0.05 / moment, rtol=1e-14)


def test_a_centre_of_mass_that_mujoco_takes_for_the_bodys_origin(read):
    """It moves as if the centre were there, and that is what it is said to hold."""
    text = mjcf("""<body name="a"><joint name="h" axis="0 1 0"/>
        <inertial pos="5e-7 0 0" mass="2" diaginertia="0.1 0.2 0.25"/></body>""")
    robot = read("mujoco", text)
    assert not robot.compiled().bodies[0].inertial.centre.any()
    assert not robot.bind(robot.compiled()).bias(np.zeros((1, 1)), np.zeros((1, 1))).any()


def test_axes_of_inertia_that_mujoco_takes_for_the_bodys(read):
    """Moments about axes turned by half a millionth: a ball's mass matrix is the tensor that it uses."""
    text = mjcf("""<body name="a"><joint name="h" type="ball"/>
        <inertial pos="0 0 0" quat="1 0 0 2.5e-7" mass="2" diaginertia="0.25 0.2 0.1"/></body>""")
    robot = read("mujoco", text)
    compiled = robot.compiled()
    matrix = robot.bind(compiled).mass_matrix(np.array([[1.0, 0, 0, 0]]))[0]
    np.testing.assert_allclose(compiled.bodies[0].inertial.tensor, matrix, rtol=1e-15, atol=1e-17)


def test_a_floating_joint_of_pinocchio_is_placed_by_its_origin():
    """Its coordinates are the pose in a frame at (1, 2, 3), turned by a right angle about z."""
    body = RigidBody("a", -1, joints=(Joint("j", "free"),))
    origin = Pose(np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]), np.array([1.0, 2, 3]))
    mechanism = SpatialMechanism((body,), np.zeros(3))
    coordinates = RobotCoordinates(mechanism, [Block((0,), "free-in-body", 0, 0, origin)], 7)
    half = math.sqrt(0.5)
    state = coordinates.state(np.array([1.5, 2, 7, half, 0, 0, half]), np.array([0.25, 0.5, 0, 0, 0, 0]))
    np.testing.assert_allclose(state.positions, [0, -0.5, 4, 0, 0, 0, 1], rtol=0, atol=1e-15)
    np.testing.assert_allclose(state.rates, [0.5, -0.25, 0, 0, 0, 0], rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    "angles", [(0.3, -0.4, 0.5), (3, 1.5, -3), (0.7, math.pi / 2 - 1e-9, 2), (0.7, -math.pi / 2, 2)]
)
def test_roll_pitch_and_yaw_give_their_rotation_back(angles):
    """Where pitch is a right angle too, and the quaternion's roundings turn roll by any angle."""
    rotation = from_quaternion(to_quaternion(from_roll_pitch_yaw(angles)))
    np.testing.assert_allclose(from_roll_pitch_yaw(roll_pitch_yaw(rotation)), rotation, rtol=0, atol=1e-15)
    if abs(angles[1]) < 1.5:
        np.testing.assert_allclose(roll_pitch_yaw(rotation), angles, rtol=0, atol=1e-15)


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba"])
def test_joints_that_are_not_the_files_are_named(read, engine):
    robot = read(engine, mjcf(ALIKE["branches"]))
    compiled = robot.compiled()
    root = compiled.bodies[0]
    assert robot.joints() == ("j10", "j2", "j1")

    def with_joint(joint):
        return replace(compiled, bodies=(replace(root, joints=(joint,)), *compiled.bodies[1:]))

    with pytest.raises(ValueError, match=r"no joint 'other'; .* has a joint 'j10' that the file has not"):
        robot.bind(with_joint(Joint("other")))
    with pytest.raises(ValueError, match=r"joint 'j10' is a slide in the file, .* has a hinge"):
        robot.bind(with_joint(Joint("j10", "slide")))
    more = (*compiled.bodies, RigidBody("more", 0, joints=(Joint("another"),)))
    with pytest.raises(ValueError, match=r"has no joint 'another'$"):
        robot.bind(replace(compiled, bodies=more))


def test_bodies_that_pinocchio_loses(read):
    roots = f"""<body name="a"><joint name="j"/>{INERTIAL.format(1)}</body>
        <body name="b"><joint name="k"/>{INERTIAL.format(1)}</body>"""
    mechanism = read("mujoco", mjcf(roots)).compiled()
    with pytest.raises(ValueError, match="Pinocchio has no joint 'k'"):
        read("pinocchio-aba", mjcf(roots)).bind(mechanism)


def test_of_two_unnamed_siblings_pinocchio_has_the_first_twice(read):
    """Its mass is doubled, the second joint moves nothing; the joints are matched by order, and M is singular."""
    siblings = f"""<body name="a"><joint name="j"/>{INERTIAL.format(1)}
        <body pos="1 0 0"><joint/>{INERTIAL.format(2)}</body>
        <body pos="0 1 0"><joint/>{INERTIAL.format(4)}</body></body>"""
    mechanism = as_read(read("mujoco", mjcf(siblings)).compiled())
    robot = read("pinocchio-aba", mjcf(siblings))
    compiled = robot.compiled(mechanism)
    assert [body.inertial.mass for body in compiled.bodies] == [1, 4, 0]
    assert compiled.joint_names == mechanism.joint_names
    assert np.linalg.matrix_rank(robot.bind(mechanism).mass_matrix(np.zeros((1, 3)))[0]) == 2


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba"])
def test_engines_say_nothing_and_write_nothing(read, engine, capfd, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = urdf([LINK.format("a", 1), urdf_joint("continuous", "j", "world", "a"), "<unknown/>"])
    robot = read(engine, text)
    robot.bind(robot.compiled()).accelerations(np.zeros((1, 1)), np.zeros((1, 1)), np.zeros((1, 1)))
    with pytest.raises((ValueError, RuntimeError)):
        read(engine, "<robot><nonsense>")
    # Two hinges about one axis: M is singular, of which MuJoCo warns.
    twice = (
        f"""<body name="a"><joint name="x" axis="0 1 0"/><joint name="y" axis="0 1 0"/>{INERTIAL.format(1)}</body>"""
    )
    robot = read(engine, mjcf(twice))
    robot.bind(robot.compiled()).accelerations(np.zeros((1, 2)), np.ones((1, 2)), np.ones((1, 2)))
    assert capfd.readouterr() == ("", "")
    assert {path.name for path in tmp_path.iterdir()} == {"model.urdf", "model.xml"}


def test_what_cannot_be_switched_off_is_refused(read):
    cloth = '<flexcomp name="f" type="grid" count="3 3 1" spacing="0.1 0.1 0.1" dim="2" mass="1"><edge/></flexcomp>'
    with pytest.raises(ValueError, match="flexible bodies"):
        read("mujoco", mjcf(cloth))
