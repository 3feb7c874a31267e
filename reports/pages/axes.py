"""Axes of plots, linear and logarithmic: scale, ticks and paths; coordinates only, no markup."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

NEAR = 1e-9  # of a decade, or of a tick's step: so near to a whole one counts as there


@dataclass(frozen=True)
class Tick:
    """``place`` in the units of the drawing; the label is ``base`` with ``exponent`` above it, which may be empty."""

    place: float
    base: str
    exponent: str = ""


@dataclass(frozen=True)
class Axis:
    """Values from ``low`` to ``high`` are drawn from ``start`` to ``stop``; values beyond are drawn at the end.

    On a logarithmic axis ``low`` and ``high`` are exponents of ten, and zero lies beyond the lower end.
    """

    low: float
    high: float
    start: float
    stop: float
    log: bool = False

    def at(self, value: float) -> float:
        """Where a value is drawn, in the units of the drawing."""
        scaled = self._scaled(value)
        share = (min(max(scaled, self.low), self.high) - self.low) / (self.high - self.low)
        return self.start + (self.stop - self.start) * share

    def ticks(self, most: int) -> tuple[Tick, ...]:
        """About ``most`` ticks at most, at multiples of a round step: whole decades where the axis is logarithmic."""
        return self._decades(most) if self.log else self._steps(most)

    def _decades(self, most: int) -> tuple[Tick, ...]:
        step = max(1, math.ceil((self.high - self.low) / most))
        exponents = [e for e in range(math.ceil(self.low), math.floor(self.high) + 1) if e % step == 0]
        return tuple(Tick(self.at(10.0**e), *power_of_ten(e)) for e in exponents)

    def _steps(self, most: int) -> tuple[Tick, ...]:
        span = self.high - self.low
        step = 10.0 ** math.floor(math.log10(span / most))
        step *= next(m for m in (1, 2, 5, 10) if span / (step * m) <= most)
        whole = range(math.ceil(self.low / step - NEAR), math.floor(self.high / step + NEAR) + 1)
        return tuple(Tick(self.at(k * step), f"{k * step:.6g}".replace("-", "−")) for k in whole)

    def _scaled(self, value: float) -> float:
        if not self.log:
            return value
        return math.log10(value) if value > 0 else -math.inf


def power_of_ten(exponent: int) -> tuple[str, str]:
    """Base and exponent of a label: 10⁻³; 1 for 10⁰."""
    return ("10", str(exponent).replace("-", "−")) if exponent else ("1", "")


def fits(value: float | None, log: bool) -> bool:
    """Whether an axis can show the value: a finite one, and above zero where the axis is logarithmic."""
    return value is not None and math.isfinite(value) and (not log or value > 0)


def log_axis(values: Sequence[float], start: float, stop: float) -> Axis:
    """The whole decades that hold all the values, at least one; each value is above zero."""
    logs = [math.log10(value) for value in values]
    low, high = math.floor(min(logs) + NEAR), math.ceil(max(logs) - NEAR)
    return Axis(low, max(high, low + 1), start, stop, log=True)


def linear_axis(values: Sequence[float], start: float, stop: float) -> Axis:
    """From the smallest value to the largest; from zero where the smallest is less than half of the largest."""
    low, high = min(values), max(values)
    if 0 < low < 0.5 * high:
        low = 0.0
    if high <= low:
        low, high = low - 1, low + 1
    return Axis(low, high, start, stop)


def path(points: Sequence[tuple[float, float]]) -> str:
    """The ``d`` of an SVG path through the points, in the units of the drawing; empty for fewer than two."""
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points) if len(points) > 1 else ""
