"""Units in which a mechanism's numbers are near one, for engines whose tolerances are plain numbers.

Exudyn's Newton iterations end at a residual of so many newtons, newton metres or metres, whatever the mechanism's
forces and lengths are: what holds a metre and a kilogram to thirteen digits holds a millimetre and a gram to none. The
equations of motion have no units of their own, so the engine is given the mechanism in units that fit it. They are
powers of two: nothing is rounded on the way there or back.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .tree import PlanarTree

Array = NDArray[np.float64]

SHORTEST_STEP = 1e-6  # units of time; below 2e-8, what rounding leaves of a joint's gap makes forces of the size of all


@dataclass(frozen=True)
class Units:
    """Units of length [m], mass [kg] and time [s]."""

    length: float
    mass: float
    time: float = 1.0

    @property
    def acceleration(self) -> float:
        """[m/s²]."""
        return self.length / self.time / self.time

    @property
    def force(self) -> float:
        """[N]."""
        return self.mass * self.acceleration

    @property
    def energy(self) -> float:
        """[J], and of a torque [N m]."""
        return self.force * self.length

    @property
    def inertia(self) -> float:
        """[kg m²]."""
        return self.mass * self.length * self.length

    def in_seconds(self, rates: Array, power: int = 1) -> Array:
        """Rates (or, with ``power`` 2, accelerations) of angles per unit of time as such per second.

        Infinite where doubles end.
        """
        with np.errstate(over="ignore"):
            for _ in range(power):  # one by one: the square of an extreme unit would itself be nothing or infinite
                rates = rates / self.time
        return rates

    def fitting(self, gravity: float, omega: Array, step: float = math.inf) -> Units:
        """With a unit of time in which the fastest of the rates [rad/s], gravity's own included, is near one.

        A ``step`` [s] of a motion is at least a millionth of it, however slow the motion is.
        """
        rate = max(float(np.abs(omega).max(initial=0.0)), math.sqrt(gravity / self.length), SHORTEST_STEP / step)
        return replace(self, time=1 / _power_of_two(rate)) if rate else self


def units_of(tree: PlanarTree) -> Units:
    """Units in which the longest link and the heaviest are near one; the second for time."""
    sizes = (math.hypot(*point) for link in tree.links for point in (link.hinge, link.com))
    return Units(_power_of_two(max(sizes)), _power_of_two(max(link.mass for link in tree.links)))


def in_units(tree: PlanarTree, units: Units) -> PlanarTree:
    """The tree as the numbers that it has in these units."""
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
    return PlanarTree(links, tree.gravity / units.acceleration)


def _over(point: tuple[float, float], unit: float) -> tuple[float, float]:
    return point[0] / unit, point[1] / unit


def _power_of_two(size: float) -> float:
    """The largest that is not above ``size``, or one where there is no size."""
    return math.ldexp(1.0, math.frexp(size)[1] - 1) if 0 < size < math.inf else 1.0
