"""The elliptic pendulum against quadruple precision, scipy, and itself; Bessel's chain against many rods."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.special import ellipj, ellipk

from furiko.models import RodChain
from furiko.reference import gravity_vector, mass_matrix
from furiko.reference.truth.closed_forms import Pendulum, hanging_chain_rates, point_pendulum, rod_pendulum
from furiko.reference.truth.enclosures import enclosed_accelerations
from furiko.reference.truth.quadruple import quadruple_trajectory

ROD = RodChain((0.7,), 2.0)
RATE = math.sqrt(1.5 * 9.81 / 0.7)
STATES = {
    "swinging from rest": (0.5, 0.0),
    "far out": (3.0, 0.0),
    "just not over": (3.0, 1.0),
    "turning": (1.0, 20.0),
    "turning back, turns away": (-40.0, -30.0),
    "swinging a turn away": (7.0, 2.0),
    "all but the separatrix": (0.0, 2 * RATE),
    "upright as well as doubles can": (math.pi, 0.0),
    "turning back": (3.0, -5.0),
}


@pytest.mark.parametrize("state", STATES.values(), ids=STATES)
def test_elliptic_functions_meet_quadruple_precision(state):
    times = np.linspace(0, 3, 7)
    theta, omega = rod_pendulum(ROD).motion(*state, times)
    truth = quadruple_trajectory(ROD, state[:1], state[1:], times)
    # both are the truth rounded to double; quadruple's own error, up to 1e-26, may turn a rounding
    np.testing.assert_allclose(theta, truth.theta[:, 0], rtol=2.0**-52, atol=1e-25)
    np.testing.assert_allclose(omega, truth.omega[:, 0], rtol=2.0**-52, atol=1e-25)


@given(k=st.floats(0.05, 0.99), phase=st.floats(-20, 20))
@settings(max_examples=40, deadline=None)
def test_scipys_elliptic_functions_agree(k, phase):
    unit = Pendulum(1.0, 1.0)
    theta, omega = unit.motion(0.0, 2 * k, [phase])
    sn, cn, dn, _ = ellipj(phase, k * k)
    # scipy's argument reduction costs ε times phase times up to some ten
    assert math.sin(theta[0] / 2) == pytest.approx(k * sn, abs=1e-13)
    assert math.cos(theta[0] / 2) == pytest.approx(dn, abs=1e-13)
    assert omega[0] == pytest.approx(2 * k * cn, abs=1e-13)
    assert unit.period(0.0, 2 * k) == pytest.approx(4 * ellipk(k * k), rel=1e-14)
    assert unit.period(0.0, 2 / k) == pytest.approx(2 * k * ellipk(k * k), rel=1e-14)


@given(theta=st.floats(-20, 20), omega=st.floats(-8, 8), time=st.floats(-10, 10))
@settings(max_examples=40, deadline=None)
def test_energy_stays_and_time_runs_back(theta, omega, time):
    pendulum = point_pendulum(0.9)
    rate2 = 9.81 / 0.9
    (there,), (there_omega,) = pendulum.motion(theta, omega, [time])
    before, after = omega**2 / 2 - rate2 * math.cos(theta), there_omega**2 / 2 - rate2 * math.cos(there)
    assert after == pytest.approx(before, abs=1e-13 * (1 + abs(theta) + omega**2 + rate2))
    (back,), (back_omega,) = pendulum.motion(there, there_omega, [-time])
    # the way back magnifies the rounding of where it starts by e^(Ωt) at the worst
    close = 1e-15 * (30 + abs(theta)) * math.exp(math.sqrt(rate2) * abs(time))
    assume(close < 0.1)
    assert back == pytest.approx(theta, abs=close)
    assert back_omega == pytest.approx(omega, abs=10 * close)


@given(theta=st.floats(-3, 3), omega=st.floats(-8, 8))
@settings(max_examples=30, deadline=None)
def test_a_period_later(theta, omega):
    pendulum = point_pendulum(0.9)
    period = pendulum.period(theta, omega)
    assume(period < 10)
    (later,), (later_omega,) = pendulum.motion(theta, omega, [period])
    turned = later - theta
    # a turn or none; a period rounded to double shifts the state by ε·period·rate
    assert min(abs(turned), abs(abs(turned) - 2 * math.pi)) < 1e-12
    assert later_omega == pytest.approx(omega, abs=1e-12)


def test_separatrix_goes_up_and_never_arrives():
    exactly = Pendulum(1.0, 1.5, 1.5)  # Ω = 1.5, and 2Ω = 3 is a double
    theta, omega = exactly.motion(0.0, 3.0, [0.0, 1.0, 20.0, -1.0])
    # Gudermann: θ = 2 atan(sinh Ωt), θ̇ = 2Ω / cosh Ωt
    np.testing.assert_allclose(
        theta[[0, 1, 3]], [0, 2 * math.atan(math.sinh(1.5)), -2 * math.atan(math.sinh(1.5))], rtol=1e-15
    )
    np.testing.assert_allclose(omega, [3, 3 / math.cosh(1.5), 3 / math.cosh(30), 3 / math.cosh(1.5)], rtol=1e-14)
    assert math.pi - 1e-12 < theta[2] <= math.pi
    assert exactly.period(0.0, 3.0) == math.inf


def test_without_gravity_and_at_rest():
    free = point_pendulum(1.0, gravity=0.0)
    theta, omega = free.motion(1.0, -2.0, [0.0, 3.0])
    np.testing.assert_array_equal(theta, [1.0, -5.0])
    np.testing.assert_array_equal(omega, [-2.0, -2.0])
    assert free.period(1.0, -2.0) == pytest.approx(math.pi, rel=1e-15)
    assert free.period(1.0, 0.0) == math.inf
    theta, omega = point_pendulum(1.0).motion(0.0, 0.0, [5.0])
    assert (theta[0], omega[0]) == (0.0, 0.0)


def test_second_derivative_is_the_true_acceleration():
    h = 1e-4
    theta, _ = rod_pendulum(ROD).motion(1.0, 2.0, [-h, 0.0, h])
    # central difference: h²/12 times θ'''' (some thousands), and ε/h²
    assert (theta[0] - 2 * theta[1] + theta[2]) / h**2 == pytest.approx(
        enclosed_accelerations(ROD, np.array([1.0]), np.array([2.0])).high[0], abs=1e-5
    )


def test_the_closed_form_is_for_one_rod():
    with pytest.raises(ValueError, match="one rod"):
        rod_pendulum(RodChain((1.0, 1.0)))


def test_many_rods_swing_like_bessels_chain():
    n = 200
    chain = RodChain((2.0 / n,) * n)
    still = np.zeros(n)
    stiffness = (gravity_vector(chain, 1e-6 * np.eye(n)) - gravity_vector(chain, still)) / 1e-6
    rates = np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(mass_matrix(chain, still), stiffness)).real)[:3])
    # rods are stiffer than a chain by (modes / n)²
    np.testing.assert_allclose(rates, hanging_chain_rates(2.0, 9.81, 3), rtol=1e-3)
