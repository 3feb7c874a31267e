"""How far a motion may be from the polynomial that it begins with, given how far that is from solving the equations.

The stretch is cut into a few pieces; a piece's box holds the polynomial's values over it, widened by ρ. Over each box
the inverse of the mass matrix and the derivatives of the accelerations are enclosed. Let e = (e_x, e_v) be a motion
less the polynomial. As long as it is within ρ, by the mean value theorem in the box

    e_x' = e_v,    |e_v'| ≤ a |e_x| + b |e_v| + δ,    a ≥ |∂α/∂x|,  b ≥ |∂α/∂v|,  δ ≥ |M⁻¹| |E|

with |·| the largest entry of a vector and the largest sum of a row's absolute values of a matrix. So |e_x|, |e_v| stay
below the solution d of the linear equations d_x' = d_v, d_v' = a d_x + b d_v + δ that starts at zero: the right sides
only grow with d (Müller's comparison), and d grows with time. It is the exponential of a matrix of 3 × 3 a piece.

If d is below ρ at the end, no motion can have left the tube, for it would have had to be at ρ when it did; and as the
accelerations are smooth in the boxes (the mass matrix is regular in them) it exists to the stretch's end. Where time
runs backwards all this holds with |h|.
"""

from __future__ import annotations

from typing import Any

from ...models.tree import SUPPORT
from .form import Form
from .series import Numbers, Series, forces, mass_matrix
from .tangents import Tangent, derivatives, unit


def radius(
    form: Form, series: Series, rows: Numbers, length: Any, width: Any, unit: Any, pieces: int
) -> tuple[Any, Any] | None:
    """d_x and d_v at the stretch's end: exact upper bounds at any time of it. None where it is not shown.

    ``series``: balls over all the motions' polynomials; ``rows``: bounds of |E|; ``width``: ρ; ``unit``: about as small
    as what is hoped for, so that rounding is relative to it; ``pieces``: into how many the stretch is cut.
    """
    from flint import arb_mat

    h = abs(length).upper() / pieces
    reached = arb_mat(3, 1, [0, 0, unit])
    try:
        for box in boxes(series, length, width, pieces):
            a, b, off = _piece(form, box, rows)
            if not (a.is_finite() and b.is_finite() and off.is_finite()):
                return None
            reached = arb_mat([[0, h, 0], [a * h, b * h, off * h / unit], [0, 0, 0]]).exp() * reached
    except ZeroDivisionError:
        return None
    x_off, v_off = reached[0, 0].upper(), reached[1, 0].upper()
    return (x_off, v_off) if x_off < width and v_off < width else None


def boxes(series: Series, length: Any, width: Any, pieces: int) -> list[tuple[Numbers, Numbers]]:
    """Boxes of coordinates and rates that hold the polynomials over each piece, ``width`` wider."""
    from flint import arb, arb_poly

    x = [arb_poly([c * 1 for c in one]) for one in series.x]
    v = [arb_poly([c * 1 for c in one]) for one in series.v]
    half = length / (2 * pieces)
    found = []
    for j in range(pieces):
        middle = arb_poly([half * (2 * j + 1), 1])
        found.append(tuple([_around(p(middle), half) + arb(0, width) for p in polynomials] for polynomials in (x, v)))
    return found  # type: ignore[return-value]


def _around(polynomial: Any, half: Any) -> Any:
    """A ball around the values of a polynomial between -``half`` and ``half``."""
    from flint import arb, arb_poly

    middle, *rest = polynomial.coeffs() or [arb(0)]
    spread = arb_poly([arb(0), *(c.abs_upper() for c in rest)])(abs(half).upper())
    return middle + arb(0, spread.upper())


def _piece(form: Form, box: tuple[Numbers, Numbers], rows: Numbers) -> tuple[Any, Any, Any]:
    """Upper bounds in a box: the largest row sums of |∂α/∂x| and |∂α/∂v|, and the largest entry of |M⁻¹| |E|."""
    from flint import arb, arb_mat

    x, v = box
    n = form.n
    sin_cos = [x[i].sin_cos() if form.slide[i] is None else (None, None) for i in range(n)]
    sin, cos = [s for s, _ in sin_cos], [c for _, c in sin_cos]
    matrix = mass_matrix(form, cos, sin)
    inverse = arb_mat(n, n, [entry for line in matrix for entry in line]).inv()
    bias = _rows(form, x, v, [arb(0)] * n, sin, cos)
    alpha = (inverse * arb_mat(n, 1, [-one.value for one in bias])).entries()
    slopes = _rows(form, x, v, alpha, sin, cos)
    zero = arb(0)
    slope = inverse * arb_mat(n, 2 * n, [part for one in slopes for part in derivatives(one, 2 * n)])
    entries = [entry.abs_upper() for entry in slope.entries()]
    weights = [entry.abs_upper() for entry in inverse.entries()]
    by_x = by_v = off = zero
    for i in range(n):
        line = entries[2 * n * i : 2 * n * (i + 1)]
        by_x, by_v = _larger(by_x, sum(line[:n])), _larger(by_v, sum(line[n:]))
        off = _larger(off, sum(w * e for w, e in zip(weights[n * i : n * (i + 1)], rows, strict=True)))
    return by_x, by_v, off


def _rows(form: Form, x: Numbers, v: Numbers, alpha: Numbers, sin: Numbers, cos: Numbers) -> list[Tangent]:
    """M α + bias of each row with its derivatives by x (directions 0 … n-1) and v (n … 2n-1), α held fixed.

    With α such that the rows are zero, M ∂α = -∂rows. I α and the armatures, which are constant factors of α, have no
    such derivatives and are left out of the values: they are wanted without α only.
    """
    from flint import arb

    n, m = form.n, 2 * form.n
    e_x: Numbers = [0] * n
    e_y: Numbers = [0] * n
    for i in range(n):
        slide = form.slide[i]
        if slide is not None:
            e_x[i], e_y[i] = Tangent(slide[0] * alpha[i], None), Tangent(slide[1] * alpha[i], None)
            continue
        squared = v[i] * v[i]
        e_x[i] = -sin[i] * alpha[i] - cos[i] * squared
        e_y[i] = cos[i] * alpha[i] - sin[i] * squared
        e_x[i], e_y[i] = (
            Tangent(e_x[i], _two(unit(i, -e_y[i], m), n + i, cos[i] * v[i] * -2)),
            Tangent(e_y[i], _two(unit(i, e_x[i], m), n + i, sin[i] * v[i] * -2)),
        )
    u, w, force = forces(form, e_x, e_y, form.gravity)
    rows: list[Tangent] = []
    for i in range(n):
        slide = form.slide[i]
        if slide is None:
            rows.append(Tangent(cos[i], unit(i, -sin[i], m)) * u[i] - Tangent(sin[i], unit(i, cos[i], m)) * w[i])
        else:
            rows.append(slide[0] * force[i][0] + slide[1] * force[i][1])
    for i in form.own:
        parent = form.turning_parent[i]
        turn, rate = Tangent(x[i], unit(i, arb(1), m)), Tangent(v[i], unit(n + i, arb(1), m))
        if parent != SUPPORT:
            turn = turn - Tangent(x[parent], unit(parent, arb(1), m))
            rate = rate - Tangent(v[parent], unit(n + parent, arb(1), m))
        torque = form.damping[i] * rate + form.stiffness[i] * turn - form.preload[i]
        rows[i] = rows[i] + torque
        if parent != SUPPORT:
            rows[parent] = rows[parent] - torque
    return rows


def _two(parts: Numbers, key: int, value: Any) -> Numbers:
    parts[key] = value
    return parts


def _larger(a: Any, b: Any) -> Any:
    """The larger of two balls' upper ends."""
    a, b = a.upper(), b.upper()
    return a if a > b else b
