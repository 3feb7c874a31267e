"""Units in which a mechanism's numbers are near one, for engines with absolute tolerances.

Exudyn's Newton iterations end at an absolute residual in newtons, newton metres or metres, whatever the mechanism's
forces and lengths are: the tolerance that gives thirteen digits for a metre and a kilogram gives none for a millimetre
and a gram. The equations of motion hold in any units, so the engine is given the mechanism in units that fit it. They
are powers of two: the conversion rounds nothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .tree import PlanarTree

Array = NDArray[np.float64]

SHORTEST_STEP = (
    1e-6  # units of time; below 2e-8, rounding errors of a joint's constraint cause forces as large as all others
)


@dataclass(frozen=True)
class Units:
    """Units of length [m], mass [kg] and time [s]."""

    length: float
    mass: float
    time: float = 1.0

    @property
    def acceleration(self) -> float:
        """The unit of acceleration [m/s²]."""
        return self.length / self.time / self.time

    @property
    def force(self) -> float:
        """The unit of force [N]."""
        return self.mass * self.acceleration

    @property
    def energy(self) -> float:
        """The unit of energy [J], and of torque [N m]."""
        return self.force * self.length

    @property
    def inertia(self) -> float:
        """The unit of inertia [kg m²]."""
        return self.mass * self.length * self.length

    def in_seconds(self, rates: Array, power: int = 1) -> Array:
        """Rates of angles, of any shape, in rad/s; with ``power`` 2 accelerations in rad/s².

        Infinite where they overflow.
        """
        with np.errstate(over="ignore"):
            for _ in range(power):  # one by one: the square of an extreme unit would itself be nothing or infinite
                rates = rates / self.time
        return rates

    def fitting(self, gravity: float, omega: Array, step: float = math.inf) -> Units:
        """The same with a unit of time in which the fastest of the rates ``omega`` [rad/s] and √(g/length) is near one.

        A ``step`` [s] of a motion is at least a millionth of that unit, however slow the motion is.
        """
        rate = max(float(np.abs(omega).max(initial=0.0)), math.sqrt(gravity / self.length), SHORTEST_STEP / step)
        return replace(self, time=1 / _power_of_two(rate)) if rate else self


def units_of(tree: PlanarTree) -> Units:
    """Units in which the longest and the heaviest link are near one; the second for time."""
    sizes = (math.hypot(*point) for link in tree.links for point in (link.hinge, link.com))
    return Units(_power_of_two(max(sizes)), _power_of_two(max(link.mass for link in tree.links)))


def in_units(tree: PlanarTree, units: Units) -> PlanarTree:
    """The tree with its numbers in these units instead of SI units."""
    links = tuple(
        replace(
            link,
            hinge=_over(link.hinge, units.length),
            com=_over(link.com, units.length),
            length=link.length / units.length,
            mass=link.mass / units.mass,
            inertia=link.inertia / units.inertia,
        )
        for link in tree.links
    )
    # One by one: the unit of acceleration itself may be below all numbers.
    return PlanarTree(links, tree.gravity / units.length * units.time * units.time)


def _over(point: tuple[float, float], unit: float) -> tuple[float, float]:
    return point[0] / unit, point[1] / unit


def _power_of_two(size: float) -> float:
    """The largest power of two that is not above ``size``; one where ``size`` is zero or infinite."""
    return math.ldexp(1.0, math.frexp(size)[1] - 1) if 0 < size < math.inf else 1.0
