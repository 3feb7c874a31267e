"""Invariants of trees: a right engine keeps them, one that rubs or pushes does not; which momenta are kept is told."""

import numpy as np
import pytest
from fake_tree_engines import FLOATING, Right, Rubbed
from score_trees import cells

from furiko.checks.motions import momenta
from furiko.checks.trees import invariants
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import TreeShape
from furiko.engines.trees.mujoco import MujocoTree
from furiko.models.scene import scene_from_toml
from furiko.models.spatial import Inertial
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from furiko.models.trees.states import tree_states

CART = """
[system]
kind = "tree"
gravity = 9.81
[[system.links]]
name = "cart"
mass = 1.25
[[system.links.joints]]
name = "track"
kind = "slide"
axis = [1.0, 0.0, 0.0]
armature = 0.5
damping = 0.25
[[system.links]]
name = "pole"
parent = "cart"
mass = 0.5
centre = [0.0, 0.0, -0.5]
inertia = [0.05, 0.05, 0.02]
[[system.links.joints]]
name = "pin"
axis = [0.0, 1.0, 0.0]
stiffness = 0.5
damping = 0.5
"""


class Pushed(Right):
    """Something pushes the cart with 1e-6 m/s²."""

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        time = step * steps
        return at + np.array([5e-7 * time**2, 0.0]), rates + np.array([1e-6 * time, 0.0])


class Diverges(Right):
    def trajectory(self, q, v, integrator, step, steps):
        return np.full_like(q, np.nan), v


class Heavier(Right):
    """Its own account of the energy grows along the motion: a millionth of the rail's place."""

    def energy(self, q, v):
        return super().energy(q, v) + 1e-6 * q[:, :1]


def compared(engine, text=CART):
    scene = scene_from_toml(text, "cart")
    states, mechanism = tree_states(scene, 3), scene.system.mechanism()
    facts = tree_facts(scene, states, motion=False, slopes=False)
    cell = TreeCell(scene, engine.info, TreeShape(engine(mechanism), engine.info, mechanism), states, facts)
    return {result.check.removeprefix("invariant "): result for result in invariants.compare(cell)}


def outcomes(engine):
    return {check: result.outcome for check, result in compared(engine).items()}


@pytest.mark.parametrize(
    ("engine", "wrong"),
    [
        (Right, set()),
        (Rubbed, {"energy RK4", "there and back RK4", "momentum along track RK4"}),
        (Pushed, {"energy RK4", "momentum along track RK4"}),  # back it is led as it came
        (Heavier, {"energy RK4"}),
    ],
)
def test_a_right_engine_keeps_them_and_each_fault_shows(engine, wrong):
    found = outcomes(engine)
    assert set(found) == {"energy RK4", "there and back RK4", "momentum along track RK4"}
    assert {check for check, outcome in found.items() if outcome == "differs"} == wrong
    assert set(found.values()) <= {"agrees", "differs"}


class Lighter(Right):
    """Gravity on the floating body is 1e-5 m/s² too small, or what hangs on it is held up."""

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        time = step * steps
        at[2], rates[2] = at[2] + 5e-6 * time**2, rates[2] + 1e-5 * time
        return at, rates


class Spun(Right):
    """The floating body is turned faster and faster about its own z axis, by 1e-5 rad/s²."""

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        rates[5] += 1e-5 * step * steps
        return at, rates


class Turned(Right):
    """The floating body is turned about its own z axis by 1e-5 rad a second more than its rates say."""

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        half = 5e-6 * step * steps
        w, x, y, z = at[3:7]
        at[3:7] = [w - half * z, x + half * y, y - half * x, z + half * w]
        return at, rates


class Inward(Right):
    """The other sign of each quaternion: the same rotations."""

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        at[3:11] *= -1
        return at, rates


FLOATS = {"energy RK4", "there and back RK4", "momentum of float RK4", "angular momentum of float RK4"}


@pytest.mark.parametrize(
    ("engine", "wrong"),
    [
        (Right, set()),
        (Inward, set()),
        (Rubbed, FLOATS),
        (Lighter, {"energy RK4", "momentum of float RK4"}),
        (Spun, {"energy RK4", "angular momentum of float RK4"}),  # the centre of mass is near the axis
        (Turned, FLOATS),
    ],
)
def test_what_a_floating_body_keeps_and_what_shows_that_it_does_not(engine, wrong):
    found = {check: result.outcome for check, result in compared(engine, FLOATING).items()}
    assert set(found) == FLOATS
    assert {check for check, outcome in found.items() if outcome == "differs"} == wrong
    assert set(found.values()) <= {"agrees", "differs"}


def test_what_is_allowed_is_far_less_than_a_millionth_of_what_there_is():
    """RK4 in steps of an eighth of a quarter of the fastest rate leaves some 1e-9 of it, and its estimate less."""
    for check, result in compared(Right).items():
        assert 0 < result.allowed < 1e-7, check


def test_a_run_that_diverges_is_skipped_and_said():
    for result in compared(Diverges).values():
        assert result.outcome == "skipped"
        assert "diverges" in result.reason


def joint(name, kind, axis, **more):
    return Joint(name, kind, axis=np.array(axis, dtype=float), **more)


X, Y, Z = ("x", "slide", (1, 0, 0)), ("y", "slide", (0, 1, 0)), ("z", "slide", (0, 0, 1))
PIN = ("pin", "hinge", (0, 1, 0))
TILTED = ("pin", "hinge", (0, 1, 1))


@pytest.mark.parametrize(
    ("joints", "expected"),
    [
        ([PIN], {"pin": "pivot"}),
        ([X], {"x": None}),
        ([X, Z, PIN], {"x": None, "z": None, "pin": "origin"}),  # a free base in a plane
        ([Z, X, PIN], {"x": None, "z": None, "pin": "origin"}),
        ([Y, PIN], {"y": None, "pin": "pivot"}),  # a screw's two motions
        ([X, PIN], {"x": None}),  # about no point is the angular momentum kept
        ([X, Z, TILTED], {"x": None, "z": None}),
        ([X, Y, Z, TILTED], {"x": None, "y": None, "z": None, "pin": "origin"}),
        ([PIN, X], {"pin": "pivot"}),  # its direction turns
        ([X, Z, PIN, ("second", "hinge", (1, 0, 0))], {"x": None, "z": None, "pin": "origin"}),
    ],
)
def test_which_momenta_are_kept_and_that_they_are(joints, expected):
    """By furiko's own motion of two links, without gravity, in steps of 0.01 s, which leave some 1e-9 of a momentum."""
    made = tuple(joint(*one) for one in joints)
    link = RigidBody("link", -1, np.array([0.3, 0.1, 0.2]), joints=made, inertial=inertial(1.5))
    arm = RigidBody(
        "arm", 0, np.array([0.2, 0.3, 0.1]), joints=(joint("arm", "hinge", (1, 1, 0)),), inertial=inertial(0.7)
    )
    mechanism = SpatialMechanism((link, arm), np.zeros(3))
    kept = momenta.momenta(mechanism)
    assert {one.placed.joint.name: one.about for one in kept} == expected
    rng = np.random.default_rng(1)
    q, v = rng.normal(size=(2, 1, mechanism.nv))
    later = moved_on(mechanism, q, v, 0.25, 25)
    for one in kept:
        number = one.of(mechanism)
        assert number(*later) == pytest.approx(number(q, v), abs=1e-8)
        assert np.abs(later[0] - q).max() > 0.05


BALL, FREE = ("ball", "ball", (0, 0, 1)), ("free", "free", (0, 0, 1))


@pytest.mark.parametrize(
    ("joints", "more", "expected"),
    [
        ([BALL], {}, [("ball", "pivot")]),
        ([BALL], {"armature": 0.3}, [("ball", "pivot")]),
        ([BALL], {"stiffness": 0.3}, []),
        ([X, BALL], {}, [("x", None)]),
        ([X, Y, Z, BALL], {}, [("x", None), ("y", None), ("z", None), ("ball", "origin")]),
        ([FREE], {}, [("free", None), ("free", "centre")]),
        ([FREE], {"armature": 0.3}, [("free", None), ("free", "origin")]),
        ([FREE], {"stiffness": 0.3}, []),
    ],
)
def test_what_is_kept_where_a_body_turns_in_all_directions(joints, more, expected):
    """In MuJoCo's motion of two links, with gravity for what is kept then. Its errors are some 1e-10 of a momentum."""
    made = tuple(joint(*one, **(more if one in (BALL, FREE) else {})) for one in joints)
    pose = {"position": np.array([0.3, 0.1, 0.2]), "quaternion": np.array([0.8, 0.3, -0.1, 0.2])}
    link = RigidBody("link", -1, joints=made, inertial=inertial(1.5), **pose)
    arm = RigidBody(
        "arm", 0, np.array([0.2, 0.3, 0.1]), joints=(joint("arm", "hinge", (1, 1, 0)),), inertial=inertial(0.7)
    )
    mechanism = SpatialMechanism((link, arm), np.array([1.0, -2.0, -9.0]))
    weightless = SpatialMechanism((link, arm), np.zeros(3))
    kept = momenta.momenta(mechanism)
    assert [(one.placed.joint.name, one.about) for one in kept] == expected
    rng = np.random.default_rng(2)
    q, v = rng.normal(size=mechanism.nq), rng.normal(size=mechanism.nv)
    for one in kept:
        there = mechanism if one.falls else weightless
        later = MujocoTree(there).trajectory(q, v, "RK4", 1e-3, 250)
        before = one.of(there)(q[None], v[None])
        after = one.of(there, 0.25)(*(part[None] for part in later))
        assert after == pytest.approx(before, abs=1e-9)
        assert np.abs(before).max() > 1e-3
        assert np.abs(later[1] - v).max() > 1e-3


class PushedAside(Right):
    """The floating body, which has rotors, is led 1e-5 m/s faster along the world's x axis than it should move."""

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        at[0] += 1e-5 * step * steps
        return at, rates


ROTORS = FLOATING.replace('kind = "free"', 'kind = "free"\narmature = 0.3')
AROUND = "angular momentum about float RK4"


@pytest.mark.parametrize(
    ("engine", "wrong"),
    [(Right, set()), (Inward, set()), (Rubbed, FLOATS - {"angular momentum of float RK4"} | {AROUND})],
)
def test_what_a_floating_body_with_rotors_keeps(engine, wrong):
    found = {check: result.outcome for check, result in compared(engine, ROTORS).items()}
    assert set(found) == FLOATS - {"angular momentum of float RK4"} | {AROUND}
    assert {check for check, outcome in found.items() if outcome == "differs"} == wrong
    assert compared(PushedAside, ROTORS)[AROUND].outcome == "differs"


def moved_on(mechanism, q, v, time, steps):
    """Runge and Kutta's scheme, with the accelerations of the kernels."""
    from furiko.reference.integration.tree_variation import accelerations

    h = time / steps
    for _ in range(steps):
        a = accelerations(mechanism, q, v)
        b = accelerations(mechanism, q + h / 2 * v, v + h / 2 * a)
        c = accelerations(mechanism, q + h / 2 * v + h * h / 4 * a, v + h / 2 * b)
        d = accelerations(mechanism, q + h * v + h * h / 2 * b, v + h * c)
        q, v = q + h * v + h * h / 6 * (a + b + c), v + h / 6 * (a + 2 * b + 2 * c + d)
    return np.asarray(q, dtype=float), np.asarray(v, dtype=float)


def inertial(mass):
    return Inertial(mass, np.array([0.1, 0.2, -0.3]), np.diag([0.2, 0.3, 0.25]))


@pytest.mark.parametrize("fixed", [{"stiffness": 1.0}, {"armature": 1.0}])
def test_springs_and_rotors_of_slides_hold_the_angular_momentum(fixed):
    made = (joint(*X, **fixed), joint(*Z), joint(*PIN))
    mechanism = SpatialMechanism((RigidBody("link", -1, joints=made, inertial=inertial(1.0)),), np.zeros(3))
    names = {one.placed.joint.name for one in momenta.momenta(mechanism)}
    assert names == ({"z"} if "stiffness" in fixed else {"x", "z"})


def test_exponentials_of_what_has_no_signs():
    """Of a nilpotent matrix 1 + x, of a number e^x, and of a rotation's magnitudes cosh and sinh."""
    assert invariants.exponential(np.array([[0.0, 3.0], [0.0, 0.0]])) == pytest.approx(
        np.array([[1.0, 3.0], [0.0, 1.0]])
    )
    assert invariants.exponential(np.array([[5.0]])) == pytest.approx(np.exp(5.0))
    found = invariants.exponential(np.array([[0.0, 2.0], [2.0, 0.0]]))
    assert found == pytest.approx(np.array([[np.cosh(2), np.sinh(2)], [np.sinh(2), np.cosh(2)]]))


@pytest.mark.slow
@pytest.mark.parametrize("number", range(2001, 2031, 2))  # with balls and free joints
def test_a_right_engine_is_called_right_on_any_tree_that_turns_in_all_directions(number):
    """The smallest allowed over measured in 256 others was 2.2."""
    for one in cells(number, 4):
        if "trajectory" not in one.info.tree.missing:
            for result in invariants.compare(one):
                assert result.outcome == "agrees", result
