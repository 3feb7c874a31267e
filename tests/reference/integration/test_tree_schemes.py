"""Steps with quaternions: places by rotation matrices, orders by a top whose motion is known in closed form."""

import numpy as np
import pytest
from scipy.linalg import expm
from spatial_trees import state, tree

from furiko.models.spatial import Inertial
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from furiko.reference.integration import tree_places
from furiko.reference.integration.tree_schemes import lone_free_bodies, tree_schemes
from furiko.reference.integration.tree_variation import rate_slopes, slopes
from furiko.reference.spatial_kinematics import rotations

FREE = Joint("float", "free")
ACROSS, ALONG = 0.4, 0.7  # moments of inertia of a top [kg m²]
TOP = SpatialMechanism(
    (RigidBody("top", -1, joints=(FREE,), inertial=Inertial(1.5, np.zeros(3), np.diag([ACROSS, ACROSS, ALONG]))),),
    np.zeros(3),
)
Q = np.array([[0.1, 0.2, 0.3, 0.8, -0.4, 0.4, 0.2]])
V = np.array([[0.5, -0.2, 0.1, 1.5, 0.5, 2.0]])


def cross(x):
    return np.array([[0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]])


def turned(q):
    return rotations(np.atleast_2d(q)[:, 3:7])[0]


def test_a_rotation_is_the_exponential_of_the_move_in_the_moved_axes():
    by = np.array([[0.0, 0.0, 0.0, 0.7, -1.1, 0.3]])
    found = tree_places.moved(TOP, Q, by)
    assert turned(found) == pytest.approx(turned(Q) @ expm(cross(by[0, 3:])), abs=1e-15)
    assert np.linalg.norm(found[0, 3:]) == pytest.approx(1, abs=1e-15)


def test_the_difference_of_places_is_the_move():
    rng = np.random.default_rng(3)
    for _ in range(10):
        mechanism = tree(rng, 5, free=True)
        q, _, _ = state(rng, mechanism)
        by = rng.uniform(-1.5, 1.5, mechanism.nv)
        found = tree_places.difference(mechanism, q, tree_places.moved(mechanism, q, by))
        assert found == pytest.approx(by, abs=1e-13 * (1 + np.abs(q).max(initial=0)))


@pytest.mark.parametrize("size", [1e-6, 9e-3, 2.1e-2, 0.3, 2.0])
def test_rates_of_a_move_are_those_of_its_rotation(size):
    """R = exp(x) has R' = R ω: by central differences of the matrix exponential, whose error is the nudge's square."""
    rng = np.random.default_rng(4)
    x, omega = size * np.array([0.6, -0.0, 0.8]), rng.normal(size=3)
    by, v = np.concatenate([np.zeros(3), x]), np.concatenate([np.zeros(3), omega])
    rate = tree_places.rates_of_moves(TOP, by, v)[3:]
    nudge = 1e-5
    slope = (expm(cross(x + nudge * rate)) - expm(cross(x - nudge * rate))) / (2 * nudge)
    assert expm(cross(x)).T @ slope == pytest.approx(cross(omega), abs=1e-9)


def test_rates_of_coordinates_are_those_of_small_moves():
    nudge = 1e-6
    ahead, back = (tree_places.moved(TOP, Q, way * nudge * V) for way in (1, -1))
    found = tree_places.rates_of_coordinates(TOP, tree_places.normalised(TOP, Q), V)
    assert found == pytest.approx((ahead - back) / (2 * nudge), abs=1e-9)


def top_after(time):
    """R(t) = exp(L t/A) R exp(-λ t z), λ = (C - A) ω_z / A: it turns about its momentum, and about its own axis."""
    momentum = turned(Q) @ (np.array([ACROSS, ACROSS, ALONG]) * V[0, 3:])
    own = (ALONG - ACROSS) / ACROSS * V[0, 5]
    return expm(cross(momentum / ACROSS) * time) @ turned(Q) @ expm(-cross(np.array([0.0, 0.0, own])) * time)


def missed(scheme, steps, time=0.25):
    q, v = Q.astype(np.longdouble), V.astype(np.longdouble)
    for _ in range(steps):
        q, v = scheme.step(q, v, np.longdouble(time) / steps)
    return np.abs(turned(q.astype(float)) - top_after(time)).max()


SCHEMES = tree_schemes(TOP, np.diag([1.5] * 3 + [ACROSS, ACROSS, ALONG])[None])


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_each_scheme_has_its_order_on_a_top(scheme):
    steps = 2 if scheme.order > 4 else 4
    coarse, fine = missed(scheme, steps), missed(scheme, 2 * steps)
    order = np.log2(coarse / fine)
    assert order > scheme.order - 0.35
    if scheme.name.endswith("by means of rates"):
        assert order < 2.2


def test_a_free_body_is_alone_where_nothing_moves_on_it_and_bare_where_nothing_weighs():
    def of(*bodies):
        made = SpatialMechanism(bodies, np.zeros(3))
        return len(lone_free_bodies(made)), len(lone_free_bodies(made, bare=True))

    top = TOP.bodies[0]
    heavy, empty = RigidBody("load", 0, inertial=top.inertial), RigidBody("mark", 0)
    assert of(top) == of(top, empty) == (1, 1)
    assert of(top, heavy) == of(top, empty, RigidBody("load", 1, inertial=top.inertial)) == (1, 0)
    assert of(top, RigidBody("arm", 0, joints=(Joint("pin"),), inertial=top.inertial)) == (0, 0)
    assert of(top, RigidBody("beside", -1, inertial=top.inertial)) == (1, 1)


def test_slopes_by_rates_are_those_of_eulers_equations():
    """Of the top: A a_x = (A - C) ω_y ω_z, A a_y = (C - A) ω_z ω_x, and the place has none."""
    x, y, z = V[0, 3:]
    by_v = np.zeros((6, 6))
    by_v[3, 4], by_v[3, 5] = (ACROSS - ALONG) / ACROSS * z, (ACROSS - ALONG) / ACROSS * y
    by_v[4, 5], by_v[4, 3] = (ALONG - ACROSS) / ACROSS * x, (ALONG - ACROSS) / ACROSS * z
    assert rate_slopes(TOP, Q, V)[0].astype(float) == pytest.approx(by_v, abs=1e-15)
    of_q, of_v = slopes(TOP, Q, V)
    assert of_v[0] == pytest.approx(by_v, abs=1e-9)
    assert of_q[0] == pytest.approx(np.zeros((6, 6)), abs=1e-9)
