"""Decides whether a derivation is right: every row, exactly; or all rows taken together."""

from __future__ import annotations

from collections.abc import Sequence

from ..algebra.fingerprint import PRIME, RandomPoint, solved
from ..algebra.multiples import is_multiple
from ..algebra.notation import equation_number
from ..algebra.trig import digits
from ..steps.derivation import Row, correct_derivation
from ..steps.views import for_view
from .explain import factors
from .grade_record import WrongTerm
from .prepared import Prepared


def is_correct_row_by_row(given: Prepared) -> bool:
    """Whether each row is, exactly, a multiple of a right row of its own, and none is missing."""
    known = given.known
    right_rows = for_view(known.view, correct_derivation(known.symbols).rows)
    matches = matching(given)
    return (
        sorted(i for i in matches if i is not None) == list(range(known.symbols.n))
        and len(matches) == known.symbols.n
        and all(
            is_multiple(row.row, right_rows[i]) for row, i in zip(given.rows, matches, strict=True) if i is not None
        )
        and _one_scale(given, matches)
    )


def matching(given: Prepared) -> list[int | None]:
    """Which right row each row is a multiple of, or None."""
    numbers = [given.known.point.projective(vector) for vector in given.vectors]
    right = given.known.right_projective
    return [right.index(number) if number in right else None for number in numbers]


def _one_scale(given: Prepared, matches: Sequence[int | None]) -> bool:
    """Whether rows that come from one Lagrangian have one factor in common; other rows may have any."""
    if given.lagrangian is None:
        return True
    known, scales = given.known, set()
    for row, i in zip(given.rows, matches, strict=True):
        if i is not None:
            ((factor, _), *_) = factors(row.vector, known.right[i])
            scales.add(factor * pow(known.point.value(known.symbols.divisor(i)), -1, PRIME) % PRIME)
    return len(scales) == 1


def is_correct_together(given: Prepared) -> bool:
    """Whether the rows, solved for the accelerations, give the right ones, at two random points.

    Rows that are combined by hand (a solved form, rows added) have degree below 10⁴: the probability that wrong ones
    pass is below (10⁴/2⁶¹)² < 10⁻²⁸.
    """
    known, m = given.known, given.known.symbols
    if given.lagrangian is not None or len(given.rows) != m.n or not _is_linear(given):
        return False
    target = solved(given.vectors, known.accelerations)
    if target is None or target != solved(known.right, known.accelerations):
        return False
    second = RandomPoint(m.space, known.view.equal_lengths, known.view.equal_masses, seed=1)
    base: list[Row] = for_view(known.view, correct_derivation(m).rows)
    return solved([second.vector(row.row) for row in given.rows], known.accelerations) == solved(
        [second.vector(row) for row in base], known.accelerations
    )


def _is_linear(given: Prepared) -> bool:
    """Whether accelerations occur in the rows only to the first power, and not times a rate."""
    n, accelerations = given.known.symbols.n, set(given.known.accelerations)
    return all(q in accelerations or not any(digits(q, 2 * n)[:n]) for row in given.rows for q in row.row)


def empty_and_repeated(given: Prepared) -> tuple[WrongTerm, ...]:
    """Rows whose sides are equal, and rows that repeat another."""
    number = equation_number(given.known.symbols)
    first: dict[int, str] = {}
    findings = []
    for row in given.rows:
        if not row.row:
            findings.append(WrongTerm(
                number, "the whole row", "0 = 0", "an equation of motion", "row-empty",
                f"Row {row.label}: both sides are the same; it is no equation of motion.",
                f"第{row.label}行：両辺が同じで、運動方程式になっていません。", row.label,
            ))  # fmt: skip
            continue
        earlier = first.setdefault(given.known.point.projective(row.vector), row.label)
        if earlier != row.label:
            findings.append(WrongTerm(
                number, "the whole row", f"row {earlier} again", "another equation of motion", "row-repeated",
                f"Row {row.label} repeats row {earlier}, scaled.",
                f"第{row.label}行は第{earlier}行と同じ式です。", row.label,
            ))  # fmt: skip
    return tuple(findings)
