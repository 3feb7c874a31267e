"""Lists the wrong terms: each with its place in the documents, what was found and what is expected."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from flint import fmpq

from ..algebra.fingerprint import PRIME
from ..algebra.multiples import by_waves, common_factor, exact_factor, is_multiple
from ..algebra.notation import equation_number, solved_term_name, term_name, text
from ..algebra.symbols import Symbols
from ..algebra.trig import CONSTANT_ONE, COS, NOTHING, Formula
from ..mistakes.known_mistakes import KnownMistakes
from ..steps.derivation import Mistake, Row, correct_derivation, derive
from ..steps.solved_form import is_solved, solved_rows
from ..steps.views import columns_to_relative, for_view, merged
from .explain import Alignment, factors, partial
from .grade_record import WrongTerm
from .prepared import Prepared, PreparedRow
from .term_difference import describe

ONE = fmpq(1)


@dataclass(frozen=True)
class WrongTermFinder:
    """Finds the wrong terms of derivations of one mechanism, in one view."""

    known: KnownMistakes

    @property
    def m(self) -> Symbols:
        """The mechanism."""
        return self.known.symbols

    @cached_property
    def right_rows(self) -> list[Row]:
        """The right rows, exactly, as the view has them."""
        return for_view(self.known.view, correct_derivation(self.m).rows)

    # Where mistakes of the catalogue explain everything ---------------------------------------------------------------

    def explained(self, mistakes: Sequence[Mistake], rows: Sequence[PreparedRow]) -> tuple[WrongTerm, ...]:
        """The terms that these mistakes make wrong, each scaled like its row in the derivation."""
        wrong_rows = self._wrong_rows(mistakes, rows)
        point = self.known.point
        places = {point.projective(point.vector(row)): i for i, row in enumerate(wrong_rows)}
        matched = {places.get(point.projective(row.vector)): row for row in rows}
        findings: list[WrongTerm] = []
        for i, wrong in enumerate(wrong_rows):
            if not is_multiple(wrong, self.right_rows[i]):
                findings += self._row(i, wrong, matched.get(i), mistakes)
        return tuple(findings)

    def _wrong_rows(self, mistakes: Sequence[Mistake], rows: Sequence[PreparedRow]) -> list[Row]:
        """The rows that the mistakes lead to: made in one derivation, or their changes added."""
        together = for_view(self.known.view, derive(self.m, mistakes).rows)
        point = self.known.point
        numbers = {point.projective(row.vector) for row in rows}
        if len(mistakes) == 1 or numbers <= {point.projective(point.vector(row)) for row in together}:
            return together
        added = [dict(row) for row in self.right_rows]
        for mistake in mistakes:
            for i, row in enumerate(for_view(self.known.view, derive(self.m, [mistake]).rows)):
                for q in row.keys() | self.right_rows[i].keys():
                    change = row.get(q, NOTHING) - self.right_rows[i].get(q, NOTHING)
                    added[i][q] = added[i].get(q, NOTHING) + change
        return [{q: f for q, f in row.items() if f} for row in added]

    def _row(self, i: int, wrong: Row, given: PreparedRow | None, mistakes: Sequence[Mistake]) -> list[WrongTerm]:
        factor = exact_factor(given.row, wrong) if given is not None else None
        found, expected = (_scaled(row, factor or CONSTANT_ONE) for row in (wrong, self.right_rows[i]))
        label = given.label if given is not None else str(i + 1)
        return [
            self._finding(i, q, (one, other), (mistake.code, mistake.english, mistake.japanese), label)
            for q, one, other in self._pairs(found, expected)
            for mistake in self._responsible(i, q, mistakes)
        ]

    def _responsible(self, i: int, q: int, mistakes: Sequence[Mistake]) -> Sequence[Mistake]:
        """Which of the mistakes change a term; all of them where that cannot be decided."""
        if len(mistakes) == 1 or self.known.view.relative:
            return mistakes
        names = {mistake.name for mistake in mistakes}
        touching = {
            entry.mistake.name
            for entry in self.known.wrong
            if entry.mistake.name in names and (i, q) in entry.terms
        }  # fmt: skip
        return [mistake for mistake in mistakes if mistake.name in touching] or mistakes

    # Where none does --------------------------------------------------------------------------------------------------

    def unexplained(self, given: Prepared, alignment: Alignment) -> tuple[WrongTerm, ...]:
        """The terms that differ when each row is scaled so that most of its terms agree."""
        if is_solved(self.m, [row.row for row in given.rows]) and not self.known.view.relative:
            return self._solved(given.rows)
        by_term = partial(self.known, given.vectors, alignment)
        findings: list[WrongTerm] = []
        for row, i in zip(given.rows, alignment.row_of, strict=True):
            if i is None:
                findings.append(WrongTerm(
                    equation_number(self.m), "the whole row", "", "", "row-unknown",
                    f"Row {row.label} is not an equation of motion of this system.",
                    f"第{row.label}行はこの系の運動方程式ではありません。", row.label,
                ))  # fmt: skip
            elif not is_multiple(row.row, self.right_rows[i]):
                findings += self._differences(row, i, self.right_rows[i], by_term)
        return tuple(findings)

    def _solved(self, rows: Sequence[PreparedRow]) -> tuple[WrongTerm, ...]:
        """The differences of rows that are solved for the accelerations from the right ones, solved too."""
        findings: list[WrongTerm] = []
        base = solved_rows(self.m, self.right_rows)
        for row in rows:
            i = next(k for k in range(self.m.n) if self.known.accelerations[k] in row.row)
            if not is_multiple(row.row, base[i]):
                findings += self._differences(row, i, base[i], {}, solved_term_name)
        number = {2: "1.11", 3: "2.12"}.get(self.m.n, "3.10") if self.m.kind == "n-leg" else "22"
        return tuple(replace(finding, equation=number) for finding in findings)

    def _differences(
        self,
        given: PreparedRow,
        i: int,
        base: Row,
        by_term: Mapping[tuple[int, int], Mistake],
        name: Callable[[Symbols, int, int], str] = term_name,
    ) -> list[WrongTerm]:
        vector = self.known.point.vector(base)
        best = factors(given.vector, vector)
        agreed = [q for q in base if best and given.vector.get(q) == best[0][0] * vector[q] % PRIME]
        factor = exact_factor(given.row, base, agreed)
        findings = []
        for q, one, other in self._pairs(given.row, _scaled(base, factor or CONSTANT_ONE)):
            if factor is None and q in agreed:
                continue
            mistake = by_term.get((i, q))
            said = (
                (mistake.code, mistake.english, mistake.japanese)
                if mistake
                else describe(self.m, i, q, one, other, name(self.m, i, q))
            )
            finding = self._finding(i, q, (one, other), said, given.label)
            findings.append(replace(finding, term=name(self.m, i, q)))
        return findings

    # A Lagrangian -----------------------------------------------------------------------------------------------------

    def lagrangian(self, lagrangian: Formula, mistakes: Sequence[Mistake]) -> tuple[WrongTerm, ...]:
        """The terms of a Lagrangian that differ, in the scale in which most agree."""
        space, view = self.m.space, self.known.view
        given = by_waves(space, lagrangian)
        base = by_waves(space, merged(view, correct_derivation(self.m).lagrangian()))
        factor = common_factor(given, base)
        changed = [by_waves(space, merged(view, derive(self.m, [mistake]).lagrangian())) for mistake in mistakes]
        number = {2: "1.4", 3: "2.5"}.get(self.m.n, "3.4") if self.m.kind == "n-leg" else "18"
        findings = []
        for key in sorted(given.keys() | base.keys()):
            one, other = given.get(key, NOTHING), base.get(key, NOTHING) * factor
            if one == other:
                continue
            term = f"L: {text(space, Formula({key: ONE}))}"
            made = [x for x, parts in zip(mistakes, changed, strict=True) if parts.get(key) != base.get(key)]
            for code, english, japanese in _said(made or mistakes) or [_plain(term)]:
                shown = text(space, one), text(space, other)
                findings.append(WrongTerm(number, term, *shown, code, english, japanese))
        return tuple(findings)

    # Writing ----------------------------------------------------------------------------------------------------------

    def _pairs(self, found: Row, expected: Row) -> Iterable[tuple[int, Formula, Formula]]:
        """The coefficients that differ, in the angles of the derivation; gravity last."""
        found, expected = self._shown(found), self._shown(expected)
        for q in sorted(found.keys() | expected.keys(), key=lambda q: (q == 0, q)):
            one, other = found.get(q, NOTHING), expected.get(q, NOTHING)
            if one != other:
                yield q, one, other

    def _shown(self, row: Row) -> Row:
        space = self.m.space
        if not self.known.view.relative:
            return row
        return space.split(space.substitute_angles(space.join(row), columns_to_relative(self.m)))

    def _finding(
        self, i: int, q: int, pair: tuple[Formula, Formula], said: tuple[str, str, str], label: str
    ) -> WrongTerm:
        """A matrix entry is written without the motion that it multiplies, as in the documents; other terms whole."""
        name = term_name(self.m, i, q)
        entry = name.startswith("A[") or (self.m.kind == "rod-chain" and name.startswith("B["))
        motion = CONSTANT_ONE if entry else Formula({(q, 0, COS): ONE})
        one, other = (text(self.m.space, f * motion) for f in pair)
        return WrongTerm(equation_number(self.m), name, one, other, *said, label)


def _scaled(row: Row, factor: Formula) -> Row:
    return {q: f * factor for q, f in row.items()}


def _said(mistakes: Sequence[Mistake]) -> list[tuple[str, str, str]]:
    return [(mistake.code, mistake.english, mistake.japanese) for mistake in mistakes]


def _plain(term: str) -> tuple[str, str, str]:
    return "term-wrong", f"The term {term} of the Lagrangian is wrong.", f"ラグランジアンの項 {term} が違います。"
