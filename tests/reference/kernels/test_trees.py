"""Accelerations of open mechanisms in O(n), against Kane's equations in balls, Pinocchio and the documents."""

import math
from dataclasses import replace

import numpy as np
import pytest
import spatial_trees

import furiko
from furiko.models import InvalidInput, NLegPendulum, RodChain, find_scene
from furiko.models.coordinates import to_absolute, to_relative
from furiko.models.spatial import Inertial, from_quaternion
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from furiko.models.trees.system import TreeJoint, TreeLink, TreeSystem
from furiko.reference.kernels.trees import dynamics, plain
from furiko.reference.kernels.trees.machine import machine
from furiko.reference.kernels.trees.springs import sprung
from furiko.reference.kernels.trees.table import PIECES, table
from furiko.reference.rounding.spatial import Magnitudes
from furiko.reference.truth.spatial import spatial_truth
from furiko.studies.stress.trees.mechanisms import gimbal

EPSILON = 2.0**-52
# Backward error: of each row of M a + bias - passive - torque, in balls, over the sum of its terms' magnitudes, over
# all bodies, along the joints (reference/rounding/spatial.py), in ε. A sum of k terms that are rounded k times may
# reach k in theory; 4 is what is asked, 0.6 the largest seen, with masses and lengths that differ by 1e8 and 1e3.
ALLOWED = 4.0
FORMS = ("plain", "4 lanes", "8 lanes")


def accelerations(form, mechanism, q, v, torque=None):
    """By one of the forms, whatever furiko would choose. The arrays are those of several states."""
    known, out = table(mechanism), np.empty(v.shape)
    forces = sprung(mechanism, q, torque)
    run = plain.run if form == "plain" else machine(int(form[0])).run
    run(known, *(np.ascontiguousarray(part) for part in (q, v)), forces, out)
    return out


def drawn(rng, mechanism, count):
    return tuple(
        np.stack(part) for part in zip(*(spatial_trees.state(rng, mechanism) for _ in range(count)), strict=True)
    )


def errors(mechanism, q, v, torque, found):
    """Backward error [ε], and forward error relative to the largest acceleration, of one state."""
    truth = spatial_truth(mechanism, q, v, torque)
    lengths = Magnitudes(mechanism, q, v, world=False)
    unit = lengths.residual(found, truth.mass_matrix.float, torque, factorised=False)
    residual = np.abs(truth.residual(found).float)
    true = truth.accelerations.float
    return float((residual / (EPSILON * unit)).max()), float(np.abs(found - true).max() / np.abs(true).max())


def held(form, mechanism, states):
    found = accelerations(form, mechanism, *states)
    for k, a in enumerate(found):
        backward, _ = errors(mechanism, *(part[k] for part in states), a)
        assert backward <= ALLOWED


@pytest.mark.slow
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("seed", range(8))
def test_trees_with_every_joint_are_exact_to_rounding(seed, form):
    """Slides, hinges, balls, a free base or none; anchors, armature, dampers, springs, fixed bodies, any gravity."""
    rng = np.random.default_rng(seed)
    mechanism = spatial_trees.tree(rng, 9, free=seed % 2 == 0)
    held(form, mechanism, drawn(rng, mechanism, 2))


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", ["acrobot", "arm-7", "cart-pole", "hopper", "humanoid", "quadruped"])
def test_the_catalogues_robots_are_exact_to_rounding(name, form):
    mechanism = find_scene(name).system.mechanism()
    held(form, mechanism, drawn(np.random.default_rng(3), mechanism, 2))


def unequal(rng, n, masses, lengths):
    """A chain on hinges in any directions, its bodies' masses and lengths apart by up to so much."""
    bodies = []
    for i in range(n):
        m, l = (float(np.exp(rng.uniform(-0.5, 0.5) * math.log(ratio))) for ratio in (masses, lengths))
        own = spatial_trees.inertial(rng, 0.5)
        inertial = Inertial(own.mass * m, own.centre * l, own.tensor * m * l * l)
        hinge = Joint(f"joint {i}", axis=rng.normal(size=3))
        bodies.append(
            RigidBody(f"body {i}", i - 1, rng.normal(size=3) * 0.3 * l, rng.normal(size=4), (hinge,), inertial)
        )
    return SpatialMechanism(tuple(bodies), np.array([0.0, 0.0, -9.81]))


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("masses", "lengths"), [(1e8, 1.0), (1.0, 1e3), (1e4, 1e3)])
def test_light_links_between_heavy_ones_need_no_refinement(masses, lengths, form):
    rng = np.random.default_rng(5)
    for n in (3, 12):
        mechanism = unequal(rng, n, masses, lengths)
        held(form, mechanism, drawn(rng, mechanism, 2))


def in_pinocchio(mechanism):
    """A tree of hinges in Pinocchio, joint by joint."""
    pin = pytest.importorskip("pinocchio")
    model = pin.Model()
    model.gravity.linear = mechanism.gravity
    for i, body in enumerate(mechanism.bodies):
        (hinge,) = body.joints
        kind = pin.JointModelRevoluteUnaligned(hinge.axis / np.linalg.norm(hinge.axis))
        at = pin.SE3(from_quaternion(body.quaternion), body.position)
        assert model.addJoint(body.parent + 1, kind, at, hinge.name) == i + 1
        own = pin.Inertia(body.inertial.mass, body.inertial.centre, body.inertial.tensor)
        model.appendBodyToJoint(i + 1, own, pin.SE3.Identity())
    data = model.createData()
    return lambda q, v, torque: np.array([pin.aba(model, data, *each) for each in zip(q, v, torque, strict=True)])


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("n", [7, 30])
def test_no_further_from_the_truth_than_pinocchios_articulated_bodies(n, form):
    """The largest error of several states: at most three times Pinocchio's, which rounds as often, elsewhere."""
    rng = np.random.default_rng(n)
    mechanism = spatial_trees.chain(rng, n, branching=0.2)
    states = drawn(rng, mechanism, 6)
    ours, theirs = accelerations(form, mechanism, *states), in_pinocchio(mechanism)(*states)
    worst = [max(errors(mechanism, *(part[k] for part in states), a[k])[1] for k in range(6)) for a in (ours, theirs)]
    assert worst[0] <= 3 * worst[1]


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    "system", [RodChain((1.0, 0.5, 0.7, 1.2)), NLegPendulum((1.0, 0.5, 0.8), (1.0, 2.0, 0.5))], ids=["rods", "legs"]
)
def test_the_documents_mechanisms_move_as_the_documents_have_it(system, form):
    """To 1e-13 of the largest: angles are added up to relative ones and back, four roundings of numbers to 30."""
    rng = np.random.default_rng(1)
    theta, omega = rng.uniform(-3, 3, (9, system.n)), rng.uniform(-3, 3, (9, system.n))
    tree = system.tree()
    q, v = to_relative(tree.parents, theta), to_relative(tree.parents, omega)
    found = to_absolute(tree.parents, accelerations(form, system.mechanism(), q, v))
    wanted = furiko.accelerations(system, theta, omega)
    assert np.abs(found - wanted).max() <= 1e-13 * np.abs(wanted).max()


@pytest.mark.parametrize("form", FORMS)
def test_a_free_body_turns_as_euler_has_it(form):
    """I ω' = (I ω) × ω + torque about the centre, and the centre falls; a turned body, a quaternion of length 3."""
    inertia = np.diag([1.0, 2.0, 3.0])
    body = RigidBody("body", -1, joints=(Joint("free", "free"),), inertial=Inertial(2.0, np.zeros(3), inertia))
    mechanism = SpatialMechanism((body,), np.array([0.0, 0.0, -9.81]))
    q = np.array([[5.0, 6.0, 7.0, 0.0, 3.0, 0.0, 0.0]])  # half a turn about x
    v = np.array([[1.0, 2.0, 3.0, 0.5, -1.0, 2.0]])
    torque = np.array([[4.0, 0.0, 0.0, 1.0, 0.0, 0.0]])
    # (I ω) × ω = (0.5, -2, 6) × (0.5, -1, 2) = (-2·2 + 6·1, 6·0.5 - 0.5·2, -0.5 + 2·0.5) = (2, 2, 0.5)
    wanted = [2.0, 0.0, -9.81, (2.0 + 1.0) / 1.0, 2.0 / 2.0, 0.5 / 3.0]
    # terms of size 6 with some roundings each, 1.1e-16 of them
    np.testing.assert_allclose(accelerations(form, mechanism, q, v, torque)[0], wanted, rtol=2e-15, atol=2e-15)


@pytest.mark.parametrize("form", FORMS)
def test_a_pendulum_on_a_damped_sprung_hinge(form):
    """m l² + armature = 2·0.25 + 0.1 = 0.6; -m g l sin q - d v - k (q - rest) + torque, by hand at q = π/6."""
    hinge = Joint("hinge", axis=np.array([0.0, -2.0, 0.0]), armature=0.1, damping=0.3, stiffness=2.0, springref=0.1)
    point = Inertial(2.0, np.array([0.0, 0.0, -0.5]), np.zeros((3, 3)))
    mechanism = SpatialMechanism((RigidBody("bob", -1, joints=(hinge,), inertial=point),), np.array([0.0, 0.0, -10.0]))
    q, v, torque = np.array([[math.pi / 6]]), np.array([[4.0]]), np.array([[1.5]])
    wanted = (-2.0 * 10.0 * 0.5 * 0.5 - 0.3 * 4.0 - 2.0 * (math.pi / 6 - 0.1) + 1.5) / 0.6
    np.testing.assert_allclose(accelerations(form, mechanism, q, v, torque), [[wanted]], rtol=1e-15)


def test_dry_friction_is_left_out():
    """As in the theory that engines are held against: it is a constraint's, not the state's alone."""
    rng = np.random.default_rng(0)
    mechanism = spatial_trees.chain(rng, 3)
    bodies = [replace(body, joints=(replace(body.joints[0], friction=3.0),)) for body in mechanism.bodies]
    rough = SpatialMechanism(tuple(bodies), mechanism.gravity)
    states = drawn(rng, mechanism, 2)
    np.testing.assert_array_equal(furiko.accelerations(rough, *states), furiko.accelerations(mechanism, *states))


@pytest.fixture(params=["plain", "compiled"])
def either(request, monkeypatch):
    """furiko.accelerations in either form."""
    monkeypatch.setattr(dynamics, "_spent", 0.0 if request.param == "plain" else math.inf)
    monkeypatch.setattr(dynamics, "_worth_compiling", lambda *_: request.param == "compiled")


@pytest.mark.usefixtures("either")
@pytest.mark.parametrize("shape", [(0,), (1,), (7,), (8,), (9,), (17,), (), (2, 3)])
def test_shapes_go_in_and_come_out_and_a_state_does_not_depend_on_its_neighbours(shape):
    rng = np.random.default_rng(2)
    mechanism = spatial_trees.tree(rng, 5, free=True)
    q, v, torque = drawn(rng, mechanism, 17)
    alone = [furiko.accelerations(mechanism, *each) for each in zip(q, v, torque, strict=True)]
    count = math.prod(shape)
    given = [part[:count].reshape(*shape, -1) for part in (q, v, torque)] if count else [p[:0] for p in (q, v, torque)]
    found = furiko.accelerations(mechanism, *given)
    assert found.shape == (*shape, mechanism.nv)
    np.testing.assert_array_equal(found.reshape(-1, mechanism.nv), np.array(alone[:count]).reshape(-1, mechanism.nv))


@pytest.mark.usefixtures("either")
def test_one_torque_for_all_lists_strides_an_array_to_write_into_and_threads():
    rng = np.random.default_rng(2)
    mechanism = spatial_trees.chain(rng, 40)
    q, v, torque = drawn(rng, mechanism, 500)
    wanted = furiko.accelerations(mechanism, q, v, np.tile(torque[0], (500, 1)), threads=1)
    out = np.empty_like(v)
    assert furiko.accelerations(mechanism, q, v, torque[0], out=out, threads=2) is out
    np.testing.assert_array_equal(out, wanted)
    np.testing.assert_array_equal(furiko.accelerations(mechanism, q.T.copy().T, v, torque[0]), wanted)
    np.testing.assert_array_equal(
        furiko.accelerations(mechanism, q[0].tolist(), v[0].tolist(), torque[0].tolist()), wanted[0]
    )
    np.testing.assert_array_equal(
        furiko.accelerations(mechanism, q, v), furiko.accelerations(mechanism, q, v, np.zeros(40))
    )


@pytest.mark.usefixtures("either")
@pytest.mark.parametrize("length", [3.0, 1e-200, 1e200])
def test_a_quaternion_of_any_length_is_the_rotation_of_its_direction(length):
    rng = np.random.default_rng(4)
    mechanism = spatial_trees.tree(rng, 4, free=True)
    q, v, torque = drawn(rng, mechanism, 3)
    q[:, 3:7] /= np.linalg.norm(q[:, 3:7], axis=-1, keepdims=True)
    longer = q.copy()
    longer[1, 3:7] *= length
    wanted, found = (furiko.accelerations(mechanism, given, v, torque) for given in (q, longer))
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-13 * np.abs(wanted).max())  # one rounding of a quaternion


@pytest.mark.usefixtures("either")
@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda q, v, t: (q[:, 1:], v, t), "q: the last axis must hold 9 numbers"),
        (lambda q, v, t: (q, v[:, 1:], t), "v: the last axis must hold 8 numbers"),
        (lambda q, v, t: (q, v[1:], t), "v: one row for each of q"),
        (lambda q, v, t: (q, v, t[0:2]), "torque: v's shape"),
        (lambda q, v, t: (q, v, "pull"), "torque: an array of numbers is needed"),
        (lambda q, v, t: (changed(q, (2, 8), np.nan), v, t), r"q\[2, 8\]: must be finite"),
        (lambda q, v, t: (changed(q, (2, 0), np.inf), v, t), r"q\[2, 0\]: must be finite"),
        (lambda q, v, t: (changed(q, (2, 4), np.nan), v, t), r"q\[2, 4\]: must be finite"),
        (lambda q, v, t: (changed(q, (2, 7), 1e16), v, t), r"q\[2, 7\]: an angle must be at most 1e\+15 rad"),
        (lambda q, v, t: (q, changed(v, (1, 0), -np.inf), t), r"v\[1, 0\]: must be finite"),
        (lambda q, v, t: (q, changed(v, (1, 7), 1e200), t), "beyond the range of doubles"),
        (lambda q, v, t: (q, v, changed(t, (0, 6), np.nan)), r"torque\[0, 6\]: must be finite"),
        (lambda q, v, t: (changed(q, (2, slice(3, 7)), 0.0), v, t), "'free': its quaternion in q has length zero"),
    ],
)  # fmt: skip
def test_what_cannot_be_answered_is_refused(change, says):
    hinges = [RigidBody(f"arm {i}", i, np.ones(3), joints=(Joint(f"hinge {i}"),), inertial=ROD) for i in range(2)]
    base = RigidBody("base", -1, joints=(Joint("free", "free"),), inertial=ROD)
    mechanism = SpatialMechanism((base, *hinges), np.zeros(3))
    q, v, torque = drawn(np.random.default_rng(0), mechanism, 3)
    furiko.accelerations(mechanism, q, v, torque)  # as it is, there is nothing to refuse
    with pytest.raises(InvalidInput, match=says):
        furiko.accelerations(mechanism, *change(q, v, torque))


ROD = Inertial(1.0, np.array([0.1, 0.5, 0.0]), np.diag([0.1, 0.2, 0.15]))


def changed(array, place, number):
    array = array.copy()
    array[place] = number
    return array


@pytest.mark.usefixtures("either")
def test_a_joint_that_moves_no_mass_is_refused_unless_it_has_armature():
    def with_end(**joint):
        arm = RigidBody("arm", -1, joints=(Joint("arm"),), inertial=ROD)
        return SpatialMechanism(
            (arm, RigidBody("end", 0, joints=(Joint("end", **joint),))), np.array([0.0, -10.0, 0.0])
        )

    with pytest.raises(InvalidInput, match="mass matrix is singular"):
        furiko.accelerations(with_end(), np.zeros(2), np.zeros(2))
    # the second law: its own armature moves against the torque alone
    assert furiko.accelerations(with_end(armature=0.5), np.zeros(2), np.zeros(2), [0.0, 3.0])[1] == 6.0


def test_the_documents_mechanisms_take_no_torque():
    with pytest.raises(InvalidInput, match="torque"):
        furiko.accelerations(RodChain((1.0,)), [0.1], [0.0], [1.0])


def test_without_llvmlite_numpy_answers(monkeypatch):
    monkeypatch.setattr(dynamics, "_spent", math.inf)
    monkeypatch.setattr(dynamics, "_can_compile", lambda: False)
    rng = np.random.default_rng(0)
    mechanism = spatial_trees.chain(rng, 5)
    states = drawn(rng, mechanism, 9)
    np.testing.assert_array_equal(furiko.accelerations(mechanism, *states), accelerations("plain", mechanism, *states))


def shoulders(armature=0.0, apart=0.0):
    """A trunk that floats, with two arms on three hinges at right angles at one point each."""
    hinges = ("yaw", (0.0, 0.0, 1.0)), ("pitch", (0.0, 1.0, 0.0)), ("roll", (1.0, 0.0, 0.0))
    trunk = TreeLink("trunk", -1, mass=10.0, inertia=(0.4, 0.5, 0.3, 0, 0, 0), joints=(TreeJoint("float", "free"),))
    arms = [
        TreeLink(
            f"arm {k}",
            0,
            position=(0.2, 0.1, side * 0.3),
            quaternion=(0.8, 0.1 * side, 0.5, 0.3),
            mass=2.0,
            centre=(0.02, 0.01, -0.15),
            inertia=(0.02, 0.018, 0.004, 0.001, 0, -0.001),
            joints=tuple(
                TreeJoint(
                    f"{name} {k}",
                    axis=axis,
                    anchor=(0.0, 0.0, apart if name == "roll" else 0.0),
                    armature=armature,
                    damping=0.1,
                    stiffness=0.5,
                )
                for name, axis in hinges
            ),
        )
        for k, side in ((1, 1), (2, -1))
    ]
    return TreeSystem((trunk, *arms)).mechanism()


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("angle", [0.1, 1e-3, 1e-5, 1e-7])
def test_near_gimbal_lock_digits_are_lost_by_the_angle_not_by_its_square(form, angle):
    """Where axes are in line but for φ, they are known to ε of 1, the sine of φ to ε/φ: some dozens of these are
    allowed, and at 1e-5 rad ε/φ², what a plain elimination leaves, is a thousand times as much."""
    mechanism = shoulders()
    lock = math.pi / 2
    q = np.array([[0.1, -0.2, 0.3, 0.7, 0.1, -0.5, 0.4, 0.4, lock - angle, 0.2, -0.9, -lock + angle, 1.1]])
    v, torque = np.linspace(-1.0, 1.5, 12)[None], np.linspace(-0.5, 0.5, 12)[None]
    found = accelerations(form, mechanism, q, v, torque)
    backward, forward = errors(mechanism, q[0], v[0], torque[0], found[0])
    assert forward < 50 * EPSILON / angle
    assert backward <= ALLOWED


def test_three_hinges_at_one_point_without_armature_alone_are_eliminated_so():
    def pieces(mechanism):
        return {PIECES[number].__name__ for number in table(mechanism).program[:, 0]}

    assert "outer_within" in pieces(shoulders())
    assert "outer_within" in pieces(gimbal().mechanism())
    for other in (shoulders(armature=0.01), shoulders(apart=0.05), find_scene("arm-7").system.mechanism()):
        assert "outer_within" not in pieces(other)


def test_a_shoulder_on_the_world_is_eliminated_so_too():
    mechanism = gimbal().mechanism()
    q, v = np.array([[0.3, math.pi / 2 - 1e-5, 0.1, 0.4]]), np.array([[1.0, -0.5, 0.25, 2.0]])
    for form in FORMS:
        assert errors(mechanism, q[0], v[0], np.zeros(4), accelerations(form, mechanism, q, v)[0])[1] < 1e-9
