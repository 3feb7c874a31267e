"""Growth of small differences along a motion: Butcher's scheme, and the derivative of the literal equations.

No step and no formula in common with :mod:`furiko.reference.integration.tangents`, which it is held against.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furiko.models import DocumentSystem
from furiko.models.states import natural_rate
from furiko.reference import literal_accelerations
from furiko.reference.integration import schemes
from furiko.reference.integration.variation import Growth, fastest_rate, growth, tangent_flow

Floats = NDArray[np.float64]

LOGARITHM_SETTLED = 0.05  # growth is known to a factor of e^0.05
MOST_STEPS = 50_000


def growth_along(system: DocumentSystem, theta: Floats, omega: Floats, duration: float) -> Growth:
    """Growth of small differences along the motion from a state (n,), over ``duration`` [s].

    The motion is integrated in double precision by Butcher's sixth order scheme, twice as finely until the growth no
    longer changes by a twentieth of a factor e. Where the motion is chaotic that is not the motion from this state,
    after some time, but one from a state beside it; the growth is as typical.
    """
    rate = natural_rate(system)
    steps = max(8, int(np.ceil(4 * duration * float(fastest_rate(system, theta, omega)))))
    before = _growth_in(system, theta, omega, duration, steps, rate)
    while True:
        steps *= 2
        found = _growth_in(system, theta, omega, duration, steps, rate)
        if abs(found.logarithm[-1] - before.logarithm[-1]) < LOGARITHM_SETTLED or steps > MOST_STEPS:
            return found
        before = found


def _growth_in(
    system: DocumentSystem, theta: Floats, omega: Floats, duration: float, steps: int, rate: float
) -> Growth:
    step = duration / steps
    states = np.empty((2 * steps + 1, 2, system.n))
    states[0] = theta, omega

    def accelerations(angles: Floats, rates: Floats) -> Floats:
        return literal_accelerations(system, angles, rates)

    with np.errstate(over="ignore", invalid="ignore"):  # steps too long for what comes on the way are halved
        for k in range(2 * steps):  # half steps, which the tangent flow needs
            angles, rates = states[k]
            states[k + 1] = schemes.BUTCHER_6.step(accelerations, angles, rates, step / 2)
        return growth(tangent_flow(system, states[:, 0], states[:, 1], step), step, rate)
