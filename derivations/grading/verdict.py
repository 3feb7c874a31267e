"""Decides whether a derivation is right: every row, exactly; or all rows taken together."""

from __future__ import annotations

from collections.abc import Sequence

from ..algebra.fingerprint import PRIME, Point, solved
from ..algebra.notation import equation_number
from ..algebra.trig import digits
from ..mistakes.views import for_view, is_multiple
from ..steps.derivation import Row, right
from .explain import factors
from .given import Given
from .result import Finding


def is_correct_row_by_row(given: Given) -> bool:
    """Whether each row is, exactly, a multiple of a right row of its own, and none is missing."""
    seen = given.seen
    right_rows = for_view(seen.view, right(seen.mechanism).rows)
    matches = matching(given)
    return (
        sorted(i for i in matches if i is not None) == list(range(seen.mechanism.n))
        and len(matches) == seen.mechanism.n
        and all(
            is_multiple(row.row, right_rows[i]) for row, i in zip(given.rows, matches, strict=True) if i is not None
        )
        and _one_scale(given, matches)
    )


def matching(given: Given) -> list[int | None]:
    """Which right row each row is a multiple of, or None."""
    numbers = [given.seen.point.projective(vector) for vector in given.vectors]
    known = given.seen.right_projective
    return [known.index(number) if number in known else None for number in numbers]


def _one_scale(given: Given, matches: Sequence[int | None]) -> bool:
    """Whether rows that come from one Lagrangian have one factor in common; other rows may have any."""
    if given.lagrangian is None:
        return True
    seen, scales = given.seen, set()
    for row, i in zip(given.rows, matches, strict=True):
        if i is not None:
            ((factor, _), *_) = factors(row.vector, seen.right[i])
            scales.add(factor * pow(seen.point.value(seen.mechanism.divisor(i)), -1, PRIME) % PRIME)
    return len(scales) == 1


def is_correct_together(given: Given) -> bool:
    """Whether the rows, solved for the accelerations, give the right ones, at two random points.

    Rows that are combined by hand (a solved form, rows added) have degree below 10⁴: the probability that wrong ones
    pass is below (10⁴/2⁶¹)² < 10⁻²⁸.
    """
    seen, m = given.seen, given.seen.mechanism
    if given.lagrangian is not None or len(given.rows) != m.n or not _is_linear(given):
        return False
    target = solved(given.vectors, seen.accelerations)
    if target is None or target != solved(seen.right, seen.accelerations):
        return False
    second = Point(m.space, seen.view.equal_lengths, seen.view.equal_masses, seed=1)
    base: list[Row] = for_view(seen.view, right(m).rows)
    return solved([second.vector(row.row) for row in given.rows], seen.accelerations) == solved(
        [second.vector(row) for row in base], seen.accelerations
    )


def _is_linear(given: Given) -> bool:
    """Whether no product with an acceleration stands in the rows but the acceleration alone."""
    n, accelerations = given.seen.mechanism.n, set(given.seen.accelerations)
    return all(q in accelerations or not any(digits(q, 2 * n)[:n]) for row in given.rows for q in row.row)


def empty_and_repeated(given: Given) -> tuple[Finding, ...]:
    """Rows that say nothing, or nothing new."""
    number = equation_number(given.seen.mechanism)
    first: dict[int, str] = {}
    findings = []
    for row in given.rows:
        if not row.row:
            findings.append(Finding(
                number, "the whole row", "0 = 0", "an equation of motion", "row-empty",
                f"Row {row.label}: both sides are the same, so that it says nothing.",
                f"第{row.label}行：両辺が同じで、何も言っていません。", row.label,
            ))  # fmt: skip
            continue
        earlier = first.setdefault(given.seen.point.projective(row.vector), row.label)
        if earlier != row.label:
            findings.append(Finding(
                number, "the whole row", f"row {earlier} again", "another equation of motion", "row-repeated",
                f"Row {row.label} is row {earlier} again, scaled.",
                f"第{row.label}行は第{earlier}行と同じ式です。", row.label,
            ))  # fmt: skip
    return tuple(findings)
