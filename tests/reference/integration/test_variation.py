"""The derivatives of the motion, its tangent flow and its growth, against closed forms and conservation laws."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from literal_growth import growth_along

from furiko.models import NLegPendulum, RodChain
from furiko.models.states import natural_rate
from furiko.reference import literal_accelerations, mass_matrix
from furiko.reference.integration.schemes import BUTCHER_6
from furiko.reference.integration.tangents import lyapunov_time
from furiko.reference.integration.taylor import simulate
from furiko.reference.integration.variation import (
    fastest_rate,
    growth,
    tangent_flow,
    variation,
)

lengths = st.floats(0.2, 3.0)


@st.composite
def systems(draw):
    n = draw(st.integers(1, 5))
    if draw(st.booleans()) or n == 1:
        return RodChain([draw(lengths) for _ in range(n)], draw(lengths), draw(st.sampled_from([0.0, 9.81])))
    return NLegPendulum([draw(lengths) for _ in range(n)], [draw(lengths) for _ in range(n)])


@settings(deadline=None, max_examples=40)
@given(systems(), st.integers(0, 2**32 - 1))
def test_derivatives_are_limits_of_difference_quotients(system, seed):
    generator = np.random.default_rng(seed)
    theta, omega = generator.uniform(-3, 3, (2, system.n)).astype(np.longdouble)
    found = variation(system, theta, omega)
    step = np.longdouble(2.0**-20)
    for derivative, turned in ((found.by_theta, (1, 0)), (found.by_omega, (0, 1))):
        for k in range(system.n):
            d = step * np.eye(system.n)[k]
            ends = [
                literal_accelerations(system, theta + s * turned[0] * d, omega + s * turned[1] * d) for s in (1, -1)
            ]
            quotient = (ends[0] - ends[1]) / (2 * step)
            # Central differences in extended precision: step² times third derivatives, 1e-12 of them, and 1e-13 of
            # rounding; third derivatives are at most some hundred times as large as the first.
            scale = float(np.abs(np.concatenate([found.by_theta, found.by_omega])).max()) + 1.0
            np.testing.assert_allclose(derivative[:, k].astype(float), quotient.astype(float), atol=1e-8 * scale)


def test_a_single_rod_in_closed_form():
    # θ̈ = -(3g/2l) sin θ
    system, theta = RodChain([0.7], gravity=9.81), np.array([[1.1], [-2.0]])
    found = variation(system, theta, np.ones_like(theta))
    stiffness = 1.5 * 9.81 / 0.7
    np.testing.assert_allclose(found.acceleration, -stiffness * np.sin(theta), rtol=1e-14)
    np.testing.assert_allclose(found.by_theta[..., 0], -stiffness * np.cos(theta), rtol=1e-14)
    np.testing.assert_array_equal(found.by_omega, 0)


def test_the_fastest_rate_bounds_a_single_rods_own():
    # Linearised about hanging, or about upright, it swings, or parts, with √(3g/2l).
    rate = np.sqrt(1.5 * 9.81 / 0.7)
    for angle in (0.0, np.pi):
        np.testing.assert_allclose(fastest_rate(RodChain([0.7]), np.array([angle]), np.zeros(1)), rate, rtol=1e-12)


def path(system, theta, omega, step, steps):
    states = [(np.array(theta), np.array(omega))]
    for _ in range(2 * steps):
        states.append(BUTCHER_6.step(lambda t, w: literal_accelerations(system, t, w), *states[-1], step / 2))
    return np.array([state[0] for state in states]), np.array([state[1] for state in states])


@pytest.mark.slow
@pytest.mark.parametrize(
    "system", [NLegPendulum([1.0, 1.0], [1.0, 1.0]), RodChain([1.0, 0.8, 0.6]), NLegPendulum([1, 0.5, 2], [1, 3, 2])]
)
def test_the_flow_keeps_the_volume_of_phase_space(system):
    # Liouville: (θ, p) keeps its volume, p = M ω; so (θ, ω) changes it by det M at the start over det M at the end.
    theta, omega = path(system, np.linspace(2.0, 1.0, system.n), np.zeros(system.n), 1e-3, 500)
    flow = tangent_flow(system, theta, omega, 1e-3)
    determinant = np.prod(np.linalg.det(flow))
    expected = np.linalg.det(mass_matrix(system, theta[0])) / np.linalg.det(mass_matrix(system, theta[-1]))
    # 500 steps of the Runge-Kutta scheme with an error of (0.02)⁵/120 each.
    np.testing.assert_allclose(determinant, expected, rtol=1e-7)


@pytest.mark.slow
def test_the_flow_carries_a_small_difference():
    system = NLegPendulum([1.0, 1.0], [1.0, 1.0])
    theta, omega = path(system, [2.0, 2.5], [0.0, 0.0], 1e-3, 1000)
    moved_theta, moved_omega = path(system, [2.0 + 1e-7, 2.5], [0.0, 0.0], 1e-3, 1000)
    difference = np.array([1.0, 0, 0, 0])
    for phi in tangent_flow(system, theta, omega, 1e-3):
        difference = phi @ difference
    got = np.concatenate([moved_theta[-1] - theta[-1], moved_omega[-1] - omega[-1]]) / 1e-7
    np.testing.assert_allclose(difference, got, atol=1e-5 * np.abs(got).max())  # 1e-7 of second order, grown fiftyfold


def test_an_upright_rod_falls_at_its_own_rate():
    rate = np.sqrt(1.5 * 9.81)
    found = growth_along(RodChain([1.0]), np.array([np.pi]), np.zeros(1), 20 / rate)
    # e^(rate·time), but for the difference's direction at the start: a factor below e.
    assert abs(found.logarithm[-1] - 20) < 1
    assert found.exponent == pytest.approx(rate, rel=0.05)
    assert lyapunov_time(RodChain([1.0]), np.array([np.pi]), np.zeros(1), 20 / rate) == pytest.approx(
        1 / rate, rel=0.05
    )


def test_nothing_grows_in_a_flow_that_only_turns():
    turn = np.array([[np.cos(0.1), np.sin(0.1)], [-np.sin(0.1), np.cos(0.1)]])
    found = growth(np.repeat(turn[None], 100, axis=0), 0.1, 1.0)
    np.testing.assert_allclose(found.logarithm, 0, atol=1e-13)


@pytest.mark.slow
def test_growth_of_the_chaotic_double_pendulum():
    # Measured before by another program: 1e9 in ten seconds (one digit).
    found = growth_along(NLegPendulum([1, 1], [1, 1]), np.array([2.0, 2.5]), np.zeros(2), 10.0)
    assert 8 < found.logarithm[-1] / np.log(10) < 10


@pytest.mark.slow
def test_growth_where_the_first_steps_are_too_long():
    """A heavy bob falls past the upright first rod and spins it, much faster than anything turned at the start.

    Against the differences of trajectories by furiko's Taylor series, which share no step with the tangent flow.
    """
    system, shift = NLegPendulum((0.838977468010664, 1.618437030735014), (1.13323050337828, 29.6509026957595)), 1e-8
    start, duration = np.array([2.971357001499368, 0.08137284095834563, 0.0, 0.0]), 0.6765867456017933
    ends = []
    for moved in [*(start + shift * np.eye(4)), *(start - shift * np.eye(4))]:
        found = simulate(system, moved[:2], moved[2:], [0.0, duration])
        ends.append(np.concatenate([found.theta[-1], found.omega[-1]]))
    flow = ((np.array(ends[:4]) - ends[4:]) / (2 * shift)).T
    unit = np.repeat([1.0, natural_rate(system)], 2)
    expected = np.log(np.linalg.norm(flow * (unit / unit[:, None]), 2))
    found = growth_along(system, start[:2], start[2:], duration)
    assert found.logarithm[-1] == pytest.approx(expected, abs=0.05)  # what it settles to
