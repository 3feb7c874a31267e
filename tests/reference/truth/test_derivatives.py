"""Proved derivatives against differences of proved accelerations, and against closed forms."""

import numpy as np
import pytest

from furiko.models import InvalidInput, NLegPendulum, RodChain, find_scene
from furiko.reference.truth.derivatives import enclosed_derivatives
from furiko.reference.truth.enclosures import enclosed_accelerations
from furiko.reference.truth.spatial import spatial_truth
from furiko.reference.truth.spatial_derivatives import spatial_derivatives

STEP = 2.0**-20  # a central difference is off by STEP²/6 times the third derivative: some 1e-13 of the first
DIFFERENCE = 1e-10


def difference(accelerate, k, theta, omega):
    """Central differences of proved accelerations by θ_k and by ω_k."""
    step = np.zeros(theta.shape[-1])
    step[k] = STEP
    found = []
    for ahead, behind in (
        ((theta + step, omega), (theta - step, omega)),
        ((theta, omega + step), (theta, omega - step)),
    ):
        one, other = accelerate(*ahead), accelerate(*behind)
        found.append(((one.high - other.high) + (one.low - other.low)) / (2 * STEP))
    return found


def quantised(generator, n):
    """Angles or rates that stay exact when the step is added."""
    return np.round(generator.uniform(-2, 2, (3, n)) * 2**20) / 2**20


@pytest.mark.parametrize(
    "system",
    [
        RodChain((0.75,), 0.9),
        RodChain((0.8, 0.5, 0.65), 1.3),
        NLegPendulum((0.7, 0.45, 0.6, 0.9), (0.4, 0.25, 0.6, 0.35)),
        NLegPendulum((1.0, 0.5), (1.0, 2.0), 0.0),
    ],
)
def test_derivatives_are_those_of_the_proved_accelerations(system):
    generator = np.random.Generator(np.random.PCG64(11))
    theta, omega = quantised(generator, system.n), quantised(generator, system.n)
    found = enclosed_derivatives(system, theta, omega)
    for k in range(system.n):
        by_angle, by_rate = difference(lambda t, w: enclosed_accelerations(system, t, w), k, theta, omega)
        for got, expected in ((found.of_positions, by_angle), (found.of_rates, by_rate)):
            size = max(np.abs(got.high).max(), 1.0)
            assert np.abs(got.high[:, :, k] - expected).max() < DIFFERENCE * size
    assert max(each.relative_radius for each in (found.of_positions, found.inverse_mass)) < 2.0**-75


def test_one_rod_has_closed_forms():
    length, density, gravity, angle = 0.8, 1.5, 9.81, 0.6
    found = enclosed_derivatives(RodChain((length,), density, gravity), np.array([[angle]]), np.array([[2.0]]))
    mass = density * length
    assert found.of_positions.high.item() == pytest.approx(-1.5 * gravity / length * np.cos(angle), rel=1e-15)
    assert found.of_rates.high.item() == 0
    assert found.inverse_mass.high.item() == pytest.approx(3 / (mass * length**2), rel=1e-15)


def test_no_states_have_no_derivatives():
    nothing = np.empty((0, 3))
    assert enclosed_derivatives(RodChain((1.0, 1.0, 1.0)), nothing, nothing).of_rates.high.shape == (0, 3, 3)


@pytest.mark.parametrize("name", ["acrobot", "arm-7", "cart-pole", "hopper"])
def test_derivatives_in_space_are_those_of_the_proved_accelerations(name):
    """With dampers, springs, armatures, slides, and axes in all directions."""
    mechanism = find_scene(name).system.mechanism()
    generator = np.random.Generator(np.random.PCG64(12))
    q, v = quantised(generator, mechanism.nv)[0], quantised(generator, mechanism.nv)[0]
    found = spatial_derivatives(mechanism, q, v)
    for k in range(mechanism.nv):
        each = difference(lambda q, v: spatial_truth(mechanism, q, v).accelerations.enclosure, k, q, v)
        for got, expected in zip((found.of_positions, found.of_rates), each, strict=True):
            assert np.abs(got.high[:, k] - expected).max() < DIFFERENCE * np.abs(got.high).max()
    product = spatial_truth(mechanism, q, v).mass_matrix.float @ found.inverse_mass.high
    assert product == pytest.approx(np.eye(mechanism.nv), abs=1e-12)  # rounding of a product of condition 1e3


def test_balls_and_free_joints_are_refused():
    mechanism = find_scene("quadruped").system.mechanism()
    q = np.zeros(mechanism.nq)
    q[3] = 1
    with pytest.raises(InvalidInput, match="hinges and slides"):
        spatial_derivatives(mechanism, q, np.zeros(mechanism.nv))
