"""A derivation prepared for comparison: exact rows in absolute angles, and their values at a random point."""

from __future__ import annotations

from dataclasses import dataclass

from ..algebra.fingerprint import Vector
from ..algebra.trig import HALF, Formula
from ..mistakes.known_mistakes import KnownMistakes, known_mistakes
from ..reading.submission import Submission
from ..steps.derivation import Row, lagrange_rows
from ..steps.views import View, columns_to_absolute, merged


@dataclass(frozen=True)
class PreparedRow:
    """One row: its label, its coefficients in absolute angles, and their values at the point."""

    label: str
    row: Row
    vector: Vector


@dataclass(frozen=True)
class Prepared:
    """A whole derivation. ``lagrangian``: it was given, and ``rows`` are Lagrange's equations of it."""

    known: KnownMistakes
    rows: tuple[PreparedRow, ...]
    lagrangian: Formula | None

    @property
    def vectors(self) -> list[Vector]:
        """The rows' values at the point."""
        return [row.vector for row in self.rows]


def documents_formula(submission: Submission, f: Formula) -> Formula:
    """A formula in the documents' symbols alone: m = ρ l and I = m l²/12 of rods, l_c = l/2."""
    m, space, n = submission.symbols, submission.space, submission.space.n
    if m.kind != "rod-chain":
        return f
    values = {3 * n + k: m.mass(k) for k in range(n)}
    values |= {space.names.index(f"I{k + 1}"): m.inertia(k) for k in range(n)}
    values |= {space.names.index(f"lc{k + 1}"): space.l(k).times(HALF) for k in range(n)}
    return space.replace(f, values)


def prepare(submission: Submission) -> Prepared:
    """Prepare a derivation that was read, for the catalogue of mistakes of the documents' mechanisms."""
    m = submission.symbols
    is_lagrangian = submission.lagrangian is not None
    merge_lengths = submission.equal_lengths or (submission.equal_masses and m.kind == "rod-chain")
    view = View(m, submission.relative and not is_lagrangian, merge_lengths, submission.equal_masses)
    known = known_mistakes(view)

    def absolute(f: Formula) -> Formula:
        f = documents_formula(submission, f)
        return m.space.substitute_angles(f, columns_to_absolute(m)) if submission.relative else f

    lagrangian = merged(view, absolute(submission.lagrangian)) if submission.lagrangian is not None else None
    written = (
        submission.rows
        if lagrangian is None
        else tuple((str(i + 1), f) for i, f in enumerate(lagrange_rows(m.space, lagrangian)))
    )
    rows = []
    for label, f in written:
        row = m.space.split(merged(view, f if lagrangian is not None else absolute(f)))
        rows.append(PreparedRow(label, row, known.point.vector(row)))
    return Prepared(known, tuple(rows), lagrangian)
