"""Invariants of trees: a right engine keeps them, one that rubs or pushes does not; which momenta are kept is told."""

import numpy as np
import pytest
from fake_tree_engines import Right, Rubbed

from furiko.checks.trees import invariants
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import TreeShape
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
        ([PIN], {"pin": False}),
        ([X], {"x": None}),
        ([X, Z, PIN], {"x": None, "z": None, "pin": True}),  # a free base in a plane
        ([Z, X, PIN], {"x": None, "z": None, "pin": True}),
        ([Y, PIN], {"y": None, "pin": False}),  # a screw's two motions
        ([X, PIN], {"x": None}),  # about no point is the angular momentum kept
        ([X, Z, TILTED], {"x": None, "z": None}),
        ([X, Y, Z, TILTED], {"x": None, "y": None, "z": None, "pin": True}),
        ([PIN, X], {"pin": False}),  # its direction turns
        ([X, Z, PIN, ("second", "hinge", (1, 0, 0))], {"x": None, "z": None, "pin": True}),
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
    kept = invariants.momenta(mechanism)
    assert {one.placed.joint.name: one.about_origin for one in kept} == expected
    rng = np.random.default_rng(1)
    q, v = rng.normal(size=(2, 1, mechanism.nv))
    later = moved_on(mechanism, q, v, 0.25, 25)
    for one in kept:
        number = one.of(mechanism)
        assert number(*later) == pytest.approx(number(q, v), abs=1e-8)
        assert np.abs(later[0] - q).max() > 0.05


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
    names = {one.placed.joint.name for one in invariants.momenta(mechanism)}
    assert names == ({"z"} if "stiffness" in fixed else {"x", "z"})


def test_exponentials_of_what_has_no_signs():
    """Of a nilpotent matrix 1 + x, of a number e^x, and of a rotation's magnitudes cosh and sinh."""
    assert invariants.exponential(np.array([[0.0, 3.0], [0.0, 0.0]])) == pytest.approx(
        np.array([[1.0, 3.0], [0.0, 1.0]])
    )
    assert invariants.exponential(np.array([[5.0]])) == pytest.approx(np.exp(5.0))
    found = invariants.exponential(np.array([[0.0, 2.0], [2.0, 0.0]]))
    assert found == pytest.approx(np.array([[np.cosh(2), np.sinh(2)], [np.sinh(2), np.cosh(2)]]))
