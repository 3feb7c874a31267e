"""A Lagrangian with time in it, of a mechanism whose support moves as a cosine: its equations, in the support's motion.

With x = A cos γt for the support, cos γt is x/A, so that the Lagrangian is one of coordinates. Behind the derivatives
x'' = -γ² x holds; and where another support moves as y = B sin γt, x' = (A/B) y''/γ and y' = -(B/A) x''/γ.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ....models.errors import InvalidInput
from ...algebra.trig import Formula, Space

Row = tuple[str, Formula]


def rows_of_lagrangian(reader: Any, lagrangian: Formula, moved: Mapping[str, tuple[str, str, str]]) -> tuple[Row, ...]:
    """d/dt ∂L/∂q' - ∂L/∂q for each coordinate that is free, in the accelerations of those that are moved.

    ``reader``: of the file; ``moved``: amplitude, "cos" or "sin", and frequency of each that is moved, as texts. Raises
    InvalidInput where these are no products of quantities, or a rate of what is moved is left that has no other name.
    """
    space: Space = reader.evaluation.space
    coordinates: tuple[str, ...] = reader.mechanism.coordinates
    said = {name: (_product(reader, a), wave, _product(reader, rate)) for name, (a, wave, rate) in moved.items()}
    values: dict[int, Formula] = {}
    for name, (amplitude, wave, rate) in said.items():
        k = coordinates.index(name)
        values[4 * space.n + 2 + k] = space.a(k).times(-1) * rate.power(2).inverse_monomial()
        other = next((o for o in said if o != name and said[o][2] == rate and said[o][1] != wave), None)
        if other is not None:
            ratio = amplitude * said[other][0].inverse_monomial() * rate.inverse_monomial()
            values[space.n + k] = space.a(coordinates.index(other)) * ratio.times(1 if wave == "cos" else -1)
    rows = []
    for k, label in enumerate(coordinates):
        if label in moved:
            continue
        f = space.by_time(space.by_rate(lagrangian, k)) - space.by_angle(lagrangian, k)
        rows.append((label, space.replace(f, values)))
    if any(space.n + coordinates.index(name) in space.places(f) for name in moved for _, f in rows):
        raise InvalidInput(
            "lagrangian: the support's rate is left in the equations; give these, or a Lagrangian without what is a "
            "whole derivative by time"
        )
    return tuple(rows)


def _product(reader: Any, text: str) -> Formula:
    found = reader.quotient("define", text, text)
    if found.denominator or not found.numerator.is_monomial():
        raise InvalidInput(f"define: {text[:40]}: a given motion is a product of quantities times a cosine or sine")
    return found.numerator  # type: ignore[no-any-return]
