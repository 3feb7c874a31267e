"""Reads a Hamiltonian, or equations of first order with momenta: what they say about the motion, momenta eliminated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import gcd, lcm
from typing import Any

from flint import fmpq

from ....models.errors import InvalidInput
from ...algebra.quotient import Budget, Quotient, TooLarge
from ...algebra.trig import CONSTANT_ONE, Formula, Space
from ...steps.first_order import (
    MOST_COORDINATES,
    WORK,
    FirstOrder,
    Labelled,
    Momenta,
    NoMomenta,
    Places,
    hamiltons_rows,
    legendre,
    solved_momenta,
    without_momenta,
)
from ..submission import Reader, Submission

ADVICE = (
    "write H in coordinates and momenta p1, p2, …, or give as many equations for the rates, as in \\dot\\theta_1 = …, "
    "and for the momenta's derivatives, as in \\dot p_1 = …"
)


def read_hamilton(data: dict[str, Any], reader: Reader) -> Submission:
    """Read ``hamiltonian``, or ``equations`` of first order with or without ``momenta``."""
    space = reader.evaluation.space
    if space.n > MOST_COORDINATES:
        raise InvalidInput(f"momenta of {space.n} coordinates; they are eliminated for up to {MOST_COORDINATES}")
    if ("hamiltonian" in data) == ("equations" in data):
        raise InvalidInput(f'give either hamiltonian = "…" or [equations] with the momenta: {ADVICE}')
    try:
        if "hamiltonian" in data:
            return _hamiltonian(data, reader)
        return _equations(data, reader)
    except TooLarge:
        raise InvalidInput(
            "with the momenta eliminated, this has too many terms; give the equations of motion"
        ) from None


def places(space: Space) -> Places:
    """Of the momenta, and of their derivatives."""
    first = space.symbol_count - 2 * space.n
    return Places(tuple(range(first, first + space.n)), tuple(range(first + space.n, first + 2 * space.n)))


def _hamiltonian(data: dict[str, Any], reader: Reader) -> Submission:
    space, budget = reader.evaluation.space, Budget(WORK)
    at = places(space)
    if "momenta" in data:
        raise InvalidInput("momenta: with a Hamiltonian they are what q̇ = ∂H/∂p makes them; leave them out")
    written = reader.quotient("hamiltonian", "H", data["hamiltonian"])
    above, below = written.numerator, _product(written, budget)
    used = space.places(above)
    if used & set(range(2 * space.n)):
        raise InvalidInput("hamiltonian: it has rates; a Hamiltonian is written in coordinates and momenta p1, p2, …")
    if used & set(at.slopes) or space.places(below) & {*at.momenta, *at.slopes}:
        raise InvalidInput(f"hamiltonian: momenta stand above, and not as derivatives; {ADVICE}")
    relations, slopes = hamiltons_rows(space, at, above, below, budget)
    momenta = _momenta(space, at, relations, budget, "hamiltonian")
    labels = [str(k) for k in range(1, space.n + 1)]
    stated = FirstOrder(at, _labelled(labels, relations), _labelled(labels, slopes), momenta, (above, below))
    lagrangian = legendre(space, at, above, below, momenta, budget)
    if lagrangian is not None:
        return replace(reader.submission((), lagrangian), first_order=stated)
    rows = without_momenta(space, at, slopes, momenta, budget)
    return replace(reader.submission(_labelled(labels, rows), None), first_order=stated)


def _equations(data: dict[str, Any], reader: Reader) -> Submission:
    momenta = tuple(reader.momenta(data["momenta"])) if "momenta" in data else ()
    made = split_equations(reader, reader.rows(data["equations"]), momenta)
    if made is None:
        raise InvalidInput(f"equations: there are no momenta in them; {ADVICE}")
    letter = reader.words.said[-1][0]
    stated = FirstOrder(made.at, momenta or made.relations, made.slopes, made.momenta, canonical=letter in "pP")
    return replace(reader.submission(made.rows, None), first_order=stated)


@dataclass(frozen=True)
class Split:
    """Equations with momenta. ``relations``: those without derivatives of momenta; ``rows``: the others, eliminated."""

    at: Places
    momenta: Momenta
    relations: Labelled
    slopes: Labelled
    rows: Labelled


def split_equations(
    reader: Reader, rows: Labelled, momenta: Labelled, hamiltonian: FirstOrder | None = None
) -> Split | None:
    """Tell relations from slopes; None where there are no momenta at all. ``momenta``: what they are said to be."""
    space, budget = reader.evaluation.space, Budget(WORK)
    at, n = places(space), space.n
    relations: list[tuple[str, Formula]] = []
    slopes: list[tuple[str, Formula]] = []
    for label, row in rows:
        f = _whole_numbers(row)
        used = space.places(f)
        if used & set(range(n)) and used & {*at.momenta, *at.slopes}:
            raise InvalidInput(f"equations.{label}: accelerations in an equation with momenta; {ADVICE}")
        (slopes if used & set(at.slopes) else relations).append((label, f))
    if not slopes and not any(space.places(f) & set(at.momenta) for _, f in relations):
        return None
    letter = reader.words.said[-1][0]
    there = momenta or tuple(relations) or (hamiltonian.relations if hamiltonian else ())
    if len(there) != n or len(slopes) != n or (momenta and len(relations) not in (0, n)):
        raise InvalidInput(
            f"equations: {len(there)} for the rates or momenta and {len(slopes)} for the derivatives of {letter}, "
            f"where {n} and {n} are needed; {ADVICE}"
        )
    solved = _momenta(space, at, [f for _, f in there], budget, "momenta" if momenta else "equations")
    made = without_momenta(space, at, [f for _, f in slopes], solved, budget)
    labels = [label for label, _ in slopes]
    return Split(at, solved, tuple(relations), tuple(slopes), _labelled(labels, made))


def _momenta(space: Space, at: Places, relations: Sequence[Formula], budget: Budget, where: str) -> Momenta:
    try:
        return solved_momenta(space, at, relations, budget)
    except NoMomenta as error:
        raise InvalidInput(f"{where}: {error}; {ADVICE}") from None


def _labelled(labels: Sequence[str], rows: Sequence[Formula]) -> Labelled:
    return tuple(zip(labels, rows, strict=True))


def _whole_numbers(f: Formula) -> Formula:
    """The same equation with whole coefficients that have no factor in common."""
    if not f:
        return f
    below, above = lcm(*(int(c.q) for c in f.terms.values())), gcd(*(int(c.p) for c in f.terms.values()))
    return f.times(fmpq(below, above))


def _product(written: Quotient, budget: Budget) -> Formula:
    below = CONSTANT_ONE
    for factor, power in written.denominator.items():
        below = budget.product(below, budget.power(factor, power))
    return below
