"""Rows that say nothing: both sides equal, or another row again."""

from __future__ import annotations

from ..algebra.notation import equation_number
from .grade_record import WrongTerm
from .prepared import Prepared


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
