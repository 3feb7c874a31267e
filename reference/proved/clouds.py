"""Sets of states that are carried through time, and what a step makes of them.

A cloud is ŷ + A r + a box: a point, directions (the columns of A), how far it goes along each (|r_j| ≤ reach_j), and
the balls' own radii. The polynomials p of a motion's series are functions of the state at the start, and by the mean
value theorem those of every state of the cloud are in

    p(ŷ) + Σ_j (∂p/∂r_j over the cloud) r_j

with the derivatives carried through the recurrences (:mod:`.tangents`). At the step's end the same formula is the next
cloud, whose directions are made orthogonal (Lohner 1987): boxes around turned boxes would grow without bound.
Derivatives cost twice as many series as there are coordinates. Without directions a cloud is a box, and only more
precision helps.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .form import Form
from .series import Numbers, Series, motion_series
from .sizes import log2_largest, log2_of
from .tangents import Tangent, convolve, derivatives, solver


@dataclass(frozen=True)
class Cloud:
    """States: balls ``x``, ``v`` of coordinates and rates; ``frame`` [coordinate, then rate][direction], ``reach``."""

    x: Numbers
    v: Numbers
    frame: list[Numbers]
    reach: Numbers

    def values(self) -> tuple[Numbers, Numbers]:
        """A ball of each coordinate and rate that holds all the cloud's."""
        balls = _spread([*self.x, *self.v], self.frame, self.reach)
        return balls[: len(self.x)], balls[len(self.x) :]

    def wide(self) -> float:
        """log₂ of the largest radius, to within one."""
        return log2_largest(a.rad() for part in self.values() for a in part)

    def upright(self, pace: int = 0) -> Cloud:
        """The same or more states around a point, with orthogonal directions; itself if it has none.

        ŷ + F r + box is in ŷ + Q (Q⁻¹F r + Q⁻¹ box) for any regular Q, here of doubles: the orthogonal factor of F, its
        columns sorted by how far the cloud goes along them. Orthogonal are they where rates are in units of 2^``pace``
        1/s: an oscillation is then a turn, and what turns does not grow.
        """
        if not self.frame:
            return self
        from flint import arb, arb_mat

        size = len(self.frame)
        units = np.where(np.arange(size) < len(self.x), 1.0, 2.0**pace)[:, None]
        lengths = np.array([2.0 ** max(-900.0, min(900.0, log2_of(r) - _base(self.reach))) for r in self.reach])
        columns = np.array([[float(entry) for entry in line] for line in self.frame]) / units
        order = np.argsort(-np.linalg.norm(columns * lengths, axis=0), kind="stable")
        q = np.linalg.qr(columns[:, order])[0] * units
        turned = arb_mat(size, size, q.ravel().tolist())
        back = turned.inv()
        forward = back * arb_mat(size, len(self.reach), [entry for line in self.frame for entry in line])
        radii = [a.rad() for a in (*self.x, *self.v)]
        reach = []
        for i in range(size):
            along = sum((forward[i, j].abs_upper() * r for j, r in enumerate(self.reach)), arb(0))
            reach.append((along + sum((back[i, j].abs_upper() * r for j, r in enumerate(radii)), arb(0))).upper())
        frame = [[arb(float(entry)) for entry in line] for line in q]
        return Cloud([a.mid() for a in self.x], [a.mid() for a in self.v], frame, reach)


def box(x: Sequence[Any], v: Sequence[Any], directions: bool) -> Cloud:
    """The cloud of these balls, with a direction for each coordinate and rate or with none."""
    from flint import arb

    if not directions:
        return Cloud([*x], [*v], [], [])
    size = len(x) + len(v)
    frame = [[arb(int(i == j)) for j in range(size)] for i in range(size)]
    return Cloud([a.mid() for a in x], [a.mid() for a in v], frame, [a.rad() for a in (*x, *v)])


@dataclass(frozen=True)
class Stretch:
    """What is proved of a stretch of time: polynomials in balls, and how far a motion may be from them.

    ``x``, ``v``: coefficients of each coordinate and rate; ``slopes``: [coordinate, then rate][direction][power], their
    derivatives along the cloud's frame; ``reach``: how far the cloud goes along each; ``x_off``, ``v_off``: exact upper
    bounds of what is not in the polynomials, for any time between 0 and ``length`` [s], which may be negative.
    """

    x: list[Numbers]
    v: list[Numbers]
    slopes: list[list[Numbers]]
    reach: Numbers
    x_off: Any
    v_off: Any
    length: Any

    def at(self, time: Any) -> Cloud:
        """The states at this time after the stretch's start, inside it."""
        from flint import arb, arb_poly

        x = [arb_poly(c)(time) + arb(0, self.x_off) for c in self.x]
        v = [arb_poly(c)(time) + arb(0, self.v_off) for c in self.v]
        return Cloud(x, v, [[arb_poly(c)(time) for c in one] for one in self.slopes], self.reach)


@dataclass(frozen=True)
class Spread:
    """Series of a cloud: ``point``, at its centre; ``whole``, over all of it; ``slopes`` and ``reach`` of a Stretch."""

    point: Series
    whole: Series
    slopes: list[list[Numbers]]
    reach: Numbers

    def stretch(self, x_off: Any, v_off: Any, length: Any) -> Stretch:
        """The stretch of this length whose motions are no further off than this."""
        return Stretch(self.point.x, self.point.v, self.slopes, self.reach, x_off, v_off, length)


def spread_series(form: Form, cloud: Cloud, order: int) -> Spread:
    """The series of every motion from the cloud. Raises ZeroDivisionError as :func:`motion_series` does."""
    point = motion_series(form, cloud.x, cloud.v, order)
    if not cloud.frame:
        return Spread(point, point, [], [])
    x, v = cloud.values()
    size = len(cloud.reach)
    moving = motion_series(
        form,
        [Tangent(a, parts) for a, parts in zip(x, cloud.frame[: form.n], strict=True)],
        [Tangent(a, parts) for a, parts in zip(v, cloud.frame[form.n :], strict=True)],
        order,
        lambda rows: solver(rows, size),
        convolve(size),
    )
    slopes = [[[derivatives(c, size)[j] for c in one] for j in range(size)] for one in (*moving.x, *moving.v)]

    def whole(centre: list[Numbers], around: list[Numbers]) -> list[Numbers]:
        return [_spread(a, [derivatives(c, size) for c in b], cloud.reach) for a, b in zip(centre, around, strict=True)]

    parts = ((getattr(point, name), getattr(moving, name)) for name in ("x", "v", "cos", "sin", "u", "w"))
    return Spread(point, Series(*(whole(*pair) for pair in parts)), slopes, cloud.reach)


def _spread(balls: Numbers, rows: list[Numbers], reach: Numbers) -> Numbers:
    """Each ball made wider by Σ_j |row_j| reach_j."""
    if not reach:
        return [*balls]
    from flint import arb

    found = []
    for ball, line in zip(balls, rows, strict=True):
        wider = sum((abs(a) * r for a, r in zip(line, reach, strict=True)), arb(0))
        found.append(ball + arb(0, wider.upper()))
    return found


def _base(reach: Numbers) -> float:
    return max(-1e6, log2_largest(reach))
