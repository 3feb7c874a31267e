"""How far a Taylor polynomial is from solving the equations of motion, over a stretch of time: a proved bound.

Let θ̃, ω̃ = θ̃', α̃ = ω̃' be the polynomials of degree N + 1, N and N - 1 that a motion's series begins with, c̃ and s̃
(degree N + 1) and U, V (degree N - 1) those of its other series. Put into the equations of motion they leave a residual
E(τ) without any power below N: all that is needed are the *tails* of a few products of polynomials, whose size on
[0, h] is at most the sum of the coefficients' absolute values times h^k.

The products are of c̃ and s̃, not of the cosine and sine of θ̃. The two differ by ε: (c̃ + i s̃) e^(-iθ̃) changes at the
rate |c̃' + s̃ ω̃ + i (s̃' - c̃ ω̃)|, as |e^(-iθ̃)| = 1, and is 1 at the start:

    ε ≤ h (tail of s̃ ω̃ + tail of c̃ ω̃), powers N + 1 and above

The second derivatives of cos θ̃ and sin θ̃ differ from the series' X, Y by

    ξ ≤ tail of (s̃ α̃ + c̃ ω̃²) + tail of (c̃ α̃ - s̃ ω̃²) + 2 ε (|α̃| + |ω̃|²), powers N and above

These move the forces on the links by no more than g, the forces' own recursion in absolute values. So row i has

    |E| ≤ tail of (c̃ U - s̃ V) + ε (|U| + |V|) + 2 g + what the last powers do in dampers and springs

Every coefficient is a ball over all the states from which the motion may start, and so the bound is for all of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ...models.tree import SUPPORT
from .form import Form
from .series import Numbers, Series


@dataclass(frozen=True)
class _Link:
    """Polynomials in τ with coefficients ≥ 0 that bound a turning link's tails and sizes on [0, τ]."""

    trig: Any  # tails of s̃ ω̃ and c̃ ω̃ together
    second: Any  # tails of the second derivatives together
    row: Any  # tail of c̃ U - s̃ V
    rate: Any
    acceleration: Any
    force: Any  # |U| + |V|


class Defect:
    """Bounds of the residual for any length of a stretch, from one series: the tails are multiplied out once."""

    def __init__(self, form: Form, series: Series) -> None:
        from flint import arb_poly

        self.form = form
        order = len(series.v[0]) - 1
        self.links: list[_Link | None] = []
        for i in range(form.n):
            if form.slide[i] is not None:
                self.links.append(None)
                continue
            cos, sin = arb_poly(_short(series.cos[i])), arb_poly(_short(series.sin[i]))
            rate = arb_poly(_short(series.v[i]))
            alpha = rate.derivative()
            squared = rate * rate
            u, w = arb_poly(_short(series.u[i])), arb_poly(_short(series.w[i]))
            self.links.append(
                _Link(
                    trig=_tail(sin * rate, order + 1) + _tail(cos * rate, order + 1),
                    second=_tail(sin * alpha + cos * squared, order) + _tail(cos * alpha - sin * squared, order),
                    row=_tail(cos * u - sin * w, order),
                    rate=_tail(rate, 0),
                    acceleration=_tail(alpha, 0),
                    force=_tail(u, 0) + _tail(w, 0),
                )
            )
        self.own = [(i, _own_tail(form, series, i, order)) for i in form.own]

    def rows(self, length: Any) -> Numbers:
        """Upper bounds of |E| of each row on [0, ``length``] or, if it is negative, on [``length``, 0]."""
        form, h = self.form, abs(length).upper()
        second: Numbers = [0] * form.n
        rows: Numbers = [0] * form.n
        for i, link in enumerate(self.links):
            if link is None:
                continue
            off = h * link.trig(h)
            second[i] = link.second(h) + 2 * off * (link.acceleration(h) + link.rate(h) ** 2)
            rows[i] = link.row(h) + off * link.force(h)
        torques, pushes = _forces_in_absolute_values(form, second)
        for i, link in enumerate(self.links):
            if link is None:
                slide = form.slide[i]
                assert slide is not None
                rows[i] = (abs(slide[0]) + abs(slide[1])) * pushes[i]
            else:
                rows[i] = rows[i] + 2 * torques[i]
        for i, tail in self.own:
            torque, parent = tail(h), form.turning_parent[i]
            rows[i] = rows[i] + torque
            if parent != SUPPORT:
                rows[parent] = rows[parent] + torque
        return [row.upper() for row in rows]


def _short(coefficients: Numbers) -> Numbers:
    """The same balls at the precision that is set, a little wider."""
    return [c * 1 for c in coefficients]


def _tail(polynomial: Any, first: int) -> Any:
    """The absolute values of the coefficients from power ``first`` on."""
    from flint import arb, arb_poly

    return arb_poly([arb(0)] * first + [c.abs_upper() for c in polynomial.coeffs()[first:]])


def _own_tail(form: Form, series: Series, i: int, order: int) -> Any:
    """What the powers that no equation has seen add to the torque of joint i."""
    from flint import arb_poly

    parent = form.turning_parent[i]
    turn, rate = arb_poly(_short(series.x[i])), arb_poly(_short(series.v[i]))
    if parent != SUPPORT:
        turn = turn - arb_poly(_short(series.x[parent]))
        rate = rate - arb_poly(_short(series.v[parent]))
    return _tail(form.damping[i] * rate + form.stiffness[i] * turn, order)


def _forces_in_absolute_values(form: Form, second: Numbers) -> tuple[Numbers, Numbers]:
    """By how much U and V of each link, and the force at its joint, move if each second derivative moves so much."""
    n, parents = form.n, form.parents
    at: Numbers = []
    force: Numbers = []
    torques: Numbers = []
    for i in range(n):
        parent = parents[i]
        moved = 0 if parent == SUPPORT else at[parent]
        if parent != SUPPORT and form.slide[parent] is None:
            moved = moved + _reach(form.hinge[i]) * second[parent]
        at.append(moved)
        if form.slide[i] is None:
            arm = _reach(form.com[i])
            force.append(form.mass[i] * (moved + arm * second[i]))
            torques.append(arm * force[i])
        else:
            force.append(form.mass[i] * moved)
            torques.append(0)
    for i in range(n - 1, -1, -1):
        parent = parents[i]
        if parent != SUPPORT:
            torques[parent] = torques[parent] + _reach(form.hinge[i]) * force[i]
            force[parent] = force[parent] + force[i]
    return torques, force


def _reach(arm: tuple[Any, Any]) -> Any:
    along, across = arm
    return abs(along) if across is None else abs(along) + abs(across)
