"""The parts of the usual rounding of accelerations, one at a time, by hand."""

import numpy as np
import pytest

from furiko.engines import engine_info
from furiko.models import NLegPendulum, RodChain
from furiko.reference.rounding import spread
from furiko.reference.rounding.bounds import amplitudes
from furiko.reference.rounding.monte_carlo import ONE_ROUNDING

LEGS = NLegPendulum((1.0, 1.0), (1.0, 1.0))


def accelerations(engine, system, theta, alpha):
    info, state = engine_info(engine), np.array([theta])
    amplitude = amplitudes(system, info.coordinates, moments=info.moments, placed=info.placed)
    return spread.accelerations(info, system, amplitude, state, 0 * state, np.array([alpha]))[0]


@pytest.mark.parametrize(("angle", "turns"), [(0.0, 1.0), (4.1 * np.pi, 4.1)])
def test_no_acceleration_is_known_better_than_the_last_digits_of_those_of_the_hinges(monkeypatch, angle, turns):
    """Accelerations of (2, -1) rad/s² are (2, -3) of the hinges, which add up to 5 for the second; and angles beyond
    half a turn are known to so many times less.
    """
    monkeypatch.setattr(spread, "aba_accelerations", lambda *_, **__: np.zeros((1, 2)))
    found = accelerations("pinocchio-aba", LEGS, (angle, 0.0), (2.0, -1.0))
    assert found == pytest.approx(turns * ONE_ROUNDING * np.array([2.0, 5.0]), rel=1e-12, abs=0)


def test_a_weight_that_is_held_is_rounded_where_nothing_accelerates():
    """Of a rod of 0.7 m: m g l/2 is the weight's moment, and m l²/3 the rod's."""
    found = accelerations("pinocchio-crba", RodChain((0.7,)), (0.0,), (0.0,))
    assert found == pytest.approx([ONE_ROUNDING * 1.5 * 9.81 / 0.7], rel=1e-12, abs=0)
