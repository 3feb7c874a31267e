"""Rounding through steps of an integrator: against closed forms where errors only add up."""

import numpy as np
import pytest

from furiko.models import RodChain
from furiko.reference.integration.schemes import SCHEMES
from furiko.reference.rounding.bounds import amplitudes
from furiko.reference.rounding.monte_carlo import ONE_ROUNDING
from furiko.reference.rounding.stepped import stepped

EULER = next(scheme for scheme in SCHEMES if scheme.name == "explicit Euler")
FREE = RodChain((1.0,), 1.0, 0.0)  # one rod without gravity turns as it does
STEPS, H = 64, 2.0**-6
# A root mean square of 16 samples is off by 1 / √32 of itself, as often as not by less; three times that is enough.
SAMPLED = 3 / np.sqrt(32)


def test_errors_of_accelerations_are_the_same_all_the_way():
    off = np.array([[1e-12]])
    ends = stepped(
        EULER, FREE, amplitudes(FREE, "absolute"), (np.ones((1, 1)), np.zeros((1, 1))), H, STEPS, off, left=0 * off
    )
    np.testing.assert_array_equal(ends.exact.astype(float), [[[1.0]], [[0.0]]])
    time = STEPS * H
    assert ends.rounding[1, 0, 0] == pytest.approx(1e-12 * time, rel=SAMPLED, abs=0)
    assert ends.rounding[0, 0, 0] == pytest.approx(1e-12 * time * (time - H) / 2, rel=SAMPLED, abs=0)
    assert not ends.left.any()


def test_last_digits_are_independent_from_step_to_step():
    none = np.zeros((1, 1))
    ends = stepped(
        EULER, FREE, amplitudes(FREE, "absolute"), (np.full((1, 1), 3.0), none), H, STEPS, none, left=none, apart=1e-13
    )
    assert ends.rounding[1, 0, 0] == 0  # nothing is rounded where nothing turns
    size = np.hypot(3 * ONE_ROUNDING, 1e-13)
    assert ends.rounding[0, 0, 0] == pytest.approx(size * np.sqrt(STEPS), rel=SAMPLED, abs=0)


def test_what_iterations_leave_is_told_apart():
    none, left = np.zeros((1, 1)), np.array([[1e-9]])
    ends = stepped(EULER, FREE, amplitudes(FREE, "absolute"), (none, none), H, STEPS, none, left=left)
    assert ends.left[1, 0, 0] == pytest.approx(1e-9 * STEPS * H, rel=SAMPLED, abs=0)
    assert not ends.rounding.any()


def test_errors_grow_as_the_motion_makes_them():
    """Upside down, δ̈ = ν² δ, ν² = 3g/2l of a rod: a constant error s of the acceleration makes s (cosh νt - 1)/ν²."""
    upright = RodChain((1.0,), 1.0, 6.0)
    scheme = next(scheme for scheme in SCHEMES if scheme.name == "classical Runge-Kutta")
    off = np.array([[1e-12]])
    state = np.full((1, 1), np.pi), np.zeros((1, 1))
    ends = stepped(scheme, upright, amplitudes(upright, "absolute"), state, 1 / 32, 64, off, left=0 * off)
    expected = 1e-12 * (np.cosh(3.0 * 2.0) - 1) / 9.0
    assert ends.rounding[0, 0, 0] == pytest.approx(expected, rel=SAMPLED, abs=0)


def test_runs_without_an_end_are_refused():
    off = np.full((1, 1), 1e306)  # magnified beyond the largest double
    state = np.zeros((1, 1)), np.zeros((1, 1))
    with pytest.raises(ArithmeticError, match="end"):
        stepped(EULER, FREE, amplitudes(FREE, "absolute"), state, H, 2, off, left=0 * off)
