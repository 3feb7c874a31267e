"""What rounding may do to derivatives of accelerations and to M⁻¹: units for each entry, as in :mod:`.bounds`.

In the coordinates in which an engine computes, with F_ij the magnitudes that meet in entry ij of M and of its factors:

* M⁻¹, however it is got column by column (factors, or articulated bodies under unit forces), is judged by the residual
  M X − 1, as accelerations are. Its unit is F |X| (Higham, section 14.1, of right inverses).
* D = ∂a/∂q leaves M D + L, with L what the derivatives of the equations' terms are at held accelerations. A term of row
  i is a product of at most three vectors that depend on q_k (a body's turn, its velocity, its lever) and of forces;
  differentiating a vector does not make it longer. So each entry of row i of L has magnitudes of at most 3 r_i, with
  r_i the magnitudes of row i of the equations themselves, and rounds by as much. The accelerations that enter L are the
  engine's own, off by |X| r ε, in a matrix of at most 2 F; and whoever multiplies L by a computed inverse, or carries
  derivatives along through the elimination of M, rounds by F |X| |L|. Together 3 r + 2 F |X| 3 r.
* D = ∂a/∂v likewise, with the velocity terms' magnitudes, which are a form Q_i of second degree in the rates, in the
  place of 3 r: 2 Q_i(|v|, e_k), without the share of a's error, as M does not depend on rates.

Inertias may be placed in the world then, with moments about its origin (Pinocchio's are): a short link's moment about
its hinge is a small difference of large ones, and is known no better than these.

An adapter that computes in relative coordinates and hands on matrices of absolute ones adds rows and columns up along
the chain: what it rounds there comes back, in its own coordinates, as up to |S⁻¹||S| times the other rows and columns.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .bounds import Amplitudes

Array = NDArray[np.float64]


@dataclass(frozen=True)
class DerivativeUnits:
    """The units of the residuals M D + L and M X − 1, (B, n, n) each, in the engine's coordinates."""

    of_positions: Array
    of_rates: Array
    inverse_mass: Array


def units(amplitude: Amplitudes, mass: Array, alpha: Array, omega: Array) -> DerivativeUnits:
    """Those of a document's mechanism in states with rates ``omega`` and accelerations ``alpha`` (B, n).

    ``mass``: the absolute mass matrix (B, n, n); ``amplitude``: of the engine's coordinates.
    """
    rows = amplitude.rows(alpha, omega, mass)
    inverse = np.abs(amplitude.from_absolute @ amplitude.solution(mass))
    handed_on = np.abs(amplitude.from_absolute) @ np.abs(amplitude.to_absolute)

    def velocity_terms(own: Array) -> Array:
        return amplitude.velocity_terms(own @ amplitude.to_absolute.T)

    rates = np.array([polarised(velocity_terms, each) for each in np.abs(amplitude.own(omega))])
    return combined(amplitude.factors(mass), inverse, rows, rates.reshape(mass.shape), handed_on)


def combined(factors: Array, inverse: Array, rows: Array, rates: Array, handed_on: Array) -> DerivativeUnits:
    """The units from F and |M⁻¹| (B, n, n), r (B, n), 2 Q (B, n, n) and |S⁻¹||S| (n, n)."""
    of_positions = np.broadcast_to(3 * rows[..., None], inverse.shape)
    of_rates = rates @ handed_on
    met = factors @ inverse
    return DerivativeUnits(
        of_positions + 2 * (met @ of_positions),
        of_rates + met @ of_rates,
        factors @ (handed_on @ inverse @ handed_on.T),
    )


def polarised(form: Callable[[Array], Array], rates: Array) -> Array:
    """2 Q_i(v, e_k), (n, n), from Q_i(v, v) of rates (m, n), for magnitudes ``rates`` v (n,).

    The units e_k are taken as long as the largest of v, so that little cancels; what does is far below a unit's digits.
    """
    n, size = len(rates), float(rates.max(initial=0.0)) or 1.0
    steps = size * np.eye(n)
    found = form(rates + steps) - form(rates[None]) - form(steps)
    return np.maximum(found, 0.0).T / size
