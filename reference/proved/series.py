"""Taylor coefficients of a planar mechanism's motion, order by order, in any numbers.

With [k] the coefficient of t^k, c = cos θ, s = sin θ, ω = θ':

    (k+1) c[k+1] = -(s ω)[k],   (k+1) s[k+1] = (c ω)[k],   (k+1) θ[k+1] = ω[k],   (k+1) ω[k+1] = α[k]

so that the second derivative of a link's unit vector e = (c, s) is known but for the order's own α[k]:

    e''[k] = (X, Y) + α[k] (-s[0], c[0]),   X = -(k+1) Σ s[k+1-j] ω[j],   Y = (k+1) Σ c[k+1-j] ω[j],   j = 0 … k

Newton and Euler, as :mod:`furiko.reference.planar_tree` writes them: accelerations u of the hinges outwards and forces
F inwards, both *linear* in the e''; then with P and Q the sums of the forces on a link, each times the length along and
across the link at which it acts, a row of the equations of motion is

    c (P_y - Q_x) - s (P_x + Q_y) + I α + the joint's own torque = 0

a product of two series. So an order costs four products of series a link, the two for X and Y and the two of the row;
its unknown α[k] is in the row through M(θ[0]) α[k], the same matrix in every order, whose inverse is taken once.

The numbers may be balls, or anything with the operators of numbers, ``sin_cos`` and a solver of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import mul
from typing import Any

from ...models.tree import SUPPORT
from .form import Form

Numbers = list[Any]
Solver = Callable[[list[Numbers]], Callable[[Numbers], Numbers]]  # of a matrix, as rows: right sides to solutions


@dataclass(frozen=True)
class Series:
    """Coefficients [link][power] up to t^N of the rates ``v``, up to t^(N+1) of the coordinates ``x``, their integrals.

    ``cos``, ``sin``: of a link's angle, up to t^(N+1); ``u``, ``w``: P_y - Q_x and P_x + Q_y, up to t^(N-1); all four
    empty where a link slides.
    """

    x: list[Numbers]
    v: list[Numbers]
    cos: list[Numbers]
    sin: list[Numbers]
    u: list[Numbers]
    w: list[Numbers]


def ball_solver(rows: list[Numbers]) -> Callable[[Numbers], Numbers]:
    """Solutions by the enclosed inverse. Raises ZeroDivisionError where the balls do not show it to be regular."""
    from flint import arb_mat

    n = len(rows)
    inverse = arb_mat(n, n, [entry for row in rows for entry in row]).inv()
    return lambda right: (inverse * arb_mat(n, 1, right)).entries()


def ball_product(a: Sequence[Any], b: Sequence[Any]) -> Any:
    """Σ a_i b_i, as long as the shorter."""
    return sum(map(mul, a, b))


def motion_series(
    form: Form,
    x: Sequence[Any],
    v: Sequence[Any],
    order: int,
    solver: Solver = ball_solver,
    product: Callable[[Sequence[Any], Sequence[Any]], Any] = ball_product,
) -> Series:
    """The series of the motion from coordinates ``x`` and rates ``v``, n numbers each, up to t^``order``.

    Raises ZeroDivisionError where the mass matrix is not shown to be regular.
    """
    n, turning = form.n, [i for i in range(form.n) if form.slide[i] is None]
    xs, vs = [[a] for a in x], [[b] for b in v]
    cos: list[Numbers] = [[] for _ in range(n)]
    sin: list[Numbers] = [[] for _ in range(n)]  # both: the newest coefficient first
    for i in turning:
        s, c = x[i].sin_cos()
        cos[i], sin[i] = [c * v[i], s * 0 + c], [s * v[i], c * 0 + s]
        cos[i][0], sin[i][0] = -sin[i][0], cos[i][0]  # c[1] = -s ω, s[1] = c ω
    first_cos = [cos[i][-1] if cos[i] else None for i in range(n)]
    first_sin = [sin[i][-1] if sin[i] else None for i in range(n)]
    solve = solver(mass_matrix(form, first_cos, first_sin))
    us: list[Numbers] = [[] for _ in range(n)]
    ws: list[Numbers] = [[] for _ in range(n)]
    zero = x[0] * 0
    for k in range(order):
        e_x, e_y = [zero] * n, [zero] * n
        for i in turning:
            e_x[i] = product(sin[i], vs[i]) * -(k + 1)
            e_y[i] = product(cos[i], vs[i]) * (k + 1)
        weight = form.gravity if k == 0 else None
        u, w, force = forces(form, e_x, e_y, weight)
        rows = [
            form.slide[i][0] * force[i][0] + form.slide[i][1] * force[i][1]  # type: ignore[index]
            if form.slide[i]
            else first_cos[i] * u[i] - first_sin[i] * w[i]
            for i in range(n)
        ]
        for i in turning if k else ():
            rows[i] = rows[i] + product(cos[i][1:], us[i]) - product(sin[i][1:], ws[i])
        if form.own:
            _add_own(form, rows, xs, vs, k)
        alpha = [-a for a in solve(rows)]
        for i in range(n):
            slide = form.slide[i]
            if slide is None:
                e_x[i] = e_x[i] - alpha[i] * first_sin[i]
                e_y[i] = e_y[i] + alpha[i] * first_cos[i]
                cos[i].insert(0, e_x[i] / ((k + 1) * (k + 2)))
                sin[i].insert(0, e_y[i] / ((k + 1) * (k + 2)))
            else:
                e_x[i], e_y[i] = alpha[i] * slide[0], alpha[i] * slide[1]
            xs[i].append(vs[i][k] / (k + 1))
            vs[i].append(alpha[i] / (k + 1))
        u, w, _ = forces(form, e_x, e_y, weight)
        for i in turning:
            us[i].append(u[i])
            ws[i].append(w[i])
    for i in range(n):
        xs[i].append(vs[i][order] / (order + 1))
    return Series(xs, vs, [c[::-1] for c in cos], [s[::-1] for s in sin], us, ws)


def forces(
    form: Form, e_x: Numbers, e_y: Numbers, weight: tuple[Any, Any] | None
) -> tuple[Numbers, Numbers, list[tuple[Any, Any]]]:
    """P_y - Q_x and P_x + Q_y of each link, and the force at its joint, for these e'' of each link.

    Of a link that slides, e'' stands for its acceleration relative to its parent. ``weight``: gravity, in order 0.
    """
    n, parents = form.n, form.parents
    at: list[tuple[Any, Any]] = []  # u, the acceleration of the hinge
    force: list[tuple[Any, Any]] = []
    u: Numbers = []
    w: Numbers = []
    for i in range(n):
        x, y = e_x[i], e_y[i]
        parent = parents[i]
        if parent == SUPPORT:
            ux, uy = (0, 0) if weight is None else (-weight[0], -weight[1])
        else:
            ux, uy = at[parent]
            if form.slide[parent] is None:
                ax, ay = _turned(form.hinge[i], e_x[parent], e_y[parent])
                ux, uy = ux + ax, uy + ay
        if form.slide[i] is not None:
            ux, uy = ux + x, uy + y
            at.append((ux, uy))
            force.append((form.mass[i] * ux, form.mass[i] * uy))
            u.append(None)
            w.append(None)
            continue
        at.append((ux, uy))
        ax, ay = _turned(form.com[i], x, y)
        fx, fy = form.mass[i] * (ux + ax), form.mass[i] * (uy + ay)
        force.append((fx, fy))
        along, across = form.com[i]
        u.append(along * fy if across is None else along * fy - across * fx)
        w.append(along * fx if across is None else along * fx + across * fy)
    for i in range(n - 1, -1, -1):
        parent = parents[i]
        if parent == SUPPORT:
            continue
        fx, fy = force[i]
        if form.slide[parent] is None:
            along, across = form.hinge[i]
            u[parent] = u[parent] + along * fy
            w[parent] = w[parent] + along * fx
            if across is not None:
                u[parent] = u[parent] - across * fx
                w[parent] = w[parent] + across * fy
        force[parent] = (force[parent][0] + fx, force[parent][1] + fy)
    return u, w, force


def mass_matrix(form: Form, cos: Numbers, sin: Numbers) -> list[Numbers]:
    """M as rows: column j is what the rows of the equations need for α_j = 1 alone."""
    n = form.n
    matrix: list[Numbers] = [[0] * n for _ in range(n)]
    for j in range(n):
        e_x, e_y = [0] * n, [0] * n
        slide = form.slide[j]
        e_x[j], e_y[j] = (-sin[j], cos[j]) if slide is None else slide
        u, w, force = forces(form, e_x, e_y, None)
        for i in range(n):
            slide = form.slide[i]
            matrix[i][j] = (
                cos[i] * u[i] - sin[i] * w[i] if slide is None else slide[0] * force[i][0] + slide[1] * force[i][1]
            )
        if form.slide[j] is None:
            matrix[j][j] = matrix[j][j] + form.inertia[j]
        a, parent = form.armature[j], form.turning_parent[j]
        if a is not None:
            matrix[j][j] = matrix[j][j] + a
            if parent != SUPPORT:
                matrix[parent][parent] = matrix[parent][parent] + a
                matrix[parent][j] = matrix[parent][j] - a
                matrix[j][parent] = matrix[j][parent] - a
    return matrix


def _turned(arm: tuple[Any, Any], x: Any, y: Any) -> tuple[Any, Any]:
    along, across = arm
    if across is None:
        return along * x, along * y
    return along * x - across * y, along * y + across * x


def _add_own(form: Form, rows: Numbers, xs: list[Numbers], vs: list[Numbers], k: int) -> None:
    """Dampers and springs of the joints, order k, onto the rows of the link and its parent."""
    for i in form.own:
        parent = form.turning_parent[i]
        turn, rate = xs[i][k], vs[i][k]
        if parent != SUPPORT:
            turn, rate = turn - xs[parent][k], rate - vs[parent][k]
        torque = form.damping[i] * rate + form.stiffness[i] * turn
        if k == 0:
            torque = torque - form.preload[i]
        rows[i] = rows[i] + torque
        if parent != SUPPORT:
            rows[parent] = rows[parent] - torque
