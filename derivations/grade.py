"""Grades a derivation: right, or which term of which equation is wrong, and the mistake that produces it."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from flint import fmpq

from .compare import told
from .derivation import Mistake, Row, derive, lagrange_rows, right
from .diagnosis import Diagnosis, Finding, Named
from .explain import Alignment, align, explanations, factors, partial
from .fingerprint import PRIME, Point, Vector, solved
from .images import Images, View, images
from .mechanism import Mechanism
from .notation import equation_number, solved_term_name, term_name, text
from .rows import (
    by_waves,
    columns_to_absolute,
    columns_to_relative,
    common_factor,
    exact_factor,
    for_view,
    is_multiple,
    merged,
)
from .solved_form import is_solved, solved_rows
from .submission import Submission, parse_submission, read_submission
from .trig import COS, CONSTANT_ONE, NOTHING, Formula, digits

ENERGY_ROUTE = ("position", "velocity", "speed", "energy", "lagrangian")


def grade(source: str | os.PathLike[str]) -> Diagnosis:
    """Grade the derivation in a TOML file. Raises InvalidInput, with the place, where it is not one."""
    return grade_submission(read_submission(source))


def grade_text(toml: str) -> Diagnosis:
    """Grade the text of such a file."""
    return grade_submission(parse_submission(toml))


def grade_submission(submission: Submission) -> Diagnosis:
    """Grade what was read."""
    case = _Case(submission)
    diagnosis = case.correct() or case.incomplete()
    if diagnosis is not None:
        return diagnosis
    return case.wrong()


@dataclass(frozen=True)
class _Given:
    """One row handed in: its label, its coefficients in absolute angles, and how they look at the point."""

    label: str
    row: Row
    vector: Vector


class _Case:
    def __init__(self, submission: Submission) -> None:
        self.submission = submission
        self.m: Mechanism = submission.mechanism
        self.space = self.m.space
        self.view = View(self.m, submission.relative and submission.lagrangian is None,
                         submission.equal_lengths, submission.equal_masses)  # fmt: skip
        self.images: Images = images(self.view)
        self.lagrangian = self._absolute(submission.lagrangian) if submission.lagrangian is not None else None
        if self.lagrangian is not None:
            rows = [(str(i + 1), f) for i, f in enumerate(lagrange_rows(self.space, self.lagrangian))]
        else:
            rows = [(label, self._absolute(f)) for label, f in submission.rows]
        point = self.images.point
        self.given: list[_Given] = []
        for label, f in rows:
            row = self.space.split(merged(self.view, f))
            self.given.append(_Given(label, row, point.vector(row)))
        self.right_rows = for_view(self.view, right(self.m).rows)

    def _absolute(self, f: Formula) -> Formula:
        """In absolute angles, whatever was handed in."""
        return self.space.substitute_angles(f, columns_to_absolute(self.m)) if self.submission.relative else f

    def _answer(self, verdict: str, **parts: object) -> Diagnosis:
        return Diagnosis(verdict=verdict, system=self.m.kind, links=self.m.n, **parts)  # type: ignore[arg-type]

    @property
    def vectors(self) -> list[Vector]:
        return [given.vector for given in self.given]

    # Right ------------------------------------------------------------------------------------------------------------

    def correct(self) -> Diagnosis | None:
        """The answer when the equations are right, every one, or taken together."""
        numbers = [self.images.point.projective(vector) for vector in self.vectors]
        matches = [
            self.images.right_projective.index(number) if number in self.images.right_projective else None
            for number in numbers
        ]
        if len(self.given) == self.m.n and sorted(i for i in matches if i is not None) == list(range(self.m.n)):
            exact = all(
                is_multiple(given.row, self.right_rows[i])
                for given, i in zip(self.given, matches, strict=True)
                if i is not None
            )
            if exact and self._one_scale(matches):
                return self._answer("correct")
        if self._equivalent():
            note = "The rows are combinations of the documents' rows, and determine the same accelerations."
            return self._answer(
                "correct", notes=(note,), notes_ja=("各行は文献の式の一次結合で、同じ加速度を与えます。",)
            )
        return None

    def _one_scale(self, matches: Sequence[int | None]) -> bool:
        """Whether the rows that come from one Lagrangian have one factor in common."""
        if self.lagrangian is None:
            return True
        point, scales = self.images.point, set()
        for given, i in zip(self.given, matches, strict=True):
            if i is not None:
                ((factor, _), *_) = factors(given.vector, self.images.right[i])
                scales.add(factor * pow(point.value(self.m.divisor(i)), -1, PRIME) % PRIME)
        return len(scales) == 1

    def _equivalent(self) -> bool:
        """Whether the rows, solved for the accelerations, give the right ones, at two random points."""
        if self.lagrangian is not None or len(self.given) != self.m.n or not self._linear():
            return False
        target = solved(self.vectors, self.images.accelerations)
        if target is None or target != solved(self.images.right, self.images.accelerations):
            return False
        second = Point(self.space, self.view.equal_lengths, self.view.equal_masses, seed=1)
        given = [second.vector(given.row) for given in self.given]
        base = [second.vector(row) for row in self.right_rows]
        return solved(given, self.images.accelerations) == solved(base, self.images.accelerations)

    def _linear(self) -> bool:
        """Whether no product with an acceleration stands in the rows but the acceleration alone."""
        n = self.m.n
        return all(
            q in self.images.accelerations or not any(digits(q, 2 * n)[:n]) for given in self.given for q in given.row
        )

    # Not all there ----------------------------------------------------------------------------------------------------

    def incomplete(self) -> Diagnosis | None:
        """The answer when every row that is there is right, but not all are there."""
        number = equation_number(self.m)
        seen: dict[int, str] = {}
        findings: list[Finding] = []
        for given in self.given:
            if not given.vector:
                findings.append(Finding(
                    number, "the whole row", "0 = 0", "an equation of motion", "row-empty",
                    f"Row {given.label}: both sides are the same, so that it says nothing.",
                    f"第{given.label}行：両辺が同じで、何も言っていません。", given.label,
                ))  # fmt: skip
                continue
            projective = self.images.point.projective(given.vector)
            if projective not in self.images.right_projective:
                return None
            i = self.images.right_projective.index(projective)
            if i in seen:
                findings.append(Finding(
                    number, "the whole row", f"row {seen[i]} again", "another equation of motion", "row-repeated",
                    f"Row {given.label} is row {seen[i]} again, scaled.",
                    f"第{given.label}行は第{seen[i]}行と同じ式です。", given.label,
                ))  # fmt: skip
            seen.setdefault(i, given.label)
        missing = [i for i in range(self.m.n) if i not in seen]
        if findings:
            return self._answer("wrong", findings=tuple(findings))
        if len(missing) == 0:
            return None
        rows = ", ".join(f"of θ{i + 1}" for i in missing)
        note = f"What is there is right; the equation {rows} is not there."
        note_ja = "書かれている式は正しいですが、足りない式があります：" + "、".join(f"θ{i + 1}" for i in missing)
        return self._answer("undecided", notes=(note,), notes_ja=(note_ja,))

    # Wrong ------------------------------------------------------------------------------------------------------------

    def wrong(self) -> Diagnosis:
        """Name the mistakes, and list the terms."""
        labels = [given.label for given in self.given]
        alignment = align(self.images, self.vectors, labels)
        found = explanations(self.images, self.vectors, alignment)
        if self.lagrangian is not None:
            energetic = [ms for ms in found if all(m.stage in ENERGY_ROUTE for m in ms)]
            found = energetic or found
        if not found:
            return self._unexplained(alignment)
        made = _same_equations(self.images, found)
        mistakes = made[0][0]
        named = tuple(
            Named(m.code, m.name, m.stage, m.english, m.japanese, tuple(x.name for x in twins))
            for m, twins in zip(mistakes, made[0][1], strict=True)
        )
        alternatives = tuple(tuple(m.name for m in ms) for ms, _ in made[1:])
        findings = self._findings(mistakes, alignment)
        return self._answer("wrong", findings=findings, mistakes=named, alternatives=alternatives)

    def _findings(self, mistakes: tuple[Mistake, ...], alignment: Alignment) -> tuple[Finding, ...]:
        if self.lagrangian is not None:
            return self._lagrangian_findings(mistakes)
        wrong_rows = self._wrong_rows(mistakes)
        findings: list[Finding] = []
        matched = self._match(wrong_rows)
        for i in range(self.m.n):
            if wrong_rows[i] != self.right_rows[i] and not is_multiple(wrong_rows[i], self.right_rows[i]):
                findings += self._row_findings(i, wrong_rows[i], matched.get(i), mistakes)
        return tuple(findings) or self._unexplained(alignment).findings

    def _wrong_rows(self, mistakes: tuple[Mistake, ...]) -> list[Row]:
        """The rows that the mistakes lead to: made in one derivation, or their changes added."""
        together = for_view(self.view, derive(self.m, mistakes).rows)
        if len(mistakes) == 1:
            return together
        numbers = {self.images.point.projective(vector) for vector in self.vectors}
        point = self.images.point
        if numbers <= {point.projective(point.vector(row)) for row in together}:
            return together
        added = [dict(row) for row in self.right_rows]
        for mistake in mistakes:
            for i, row in enumerate(for_view(self.view, derive(self.m, [mistake]).rows)):
                for q in row.keys() | self.right_rows[i].keys():
                    change = row.get(q, NOTHING) - self.right_rows[i].get(q, NOTHING)
                    added[i][q] = added[i].get(q, NOTHING) + change
        return [{q: f for q, f in row.items() if f} for row in added]

    def _match(self, wrong_rows: list[Row]) -> dict[int, _Given]:
        """Which row handed in is which row of the explanation."""
        point = self.images.point
        numbers = {point.projective(point.vector(row)): i for i, row in enumerate(wrong_rows)}
        pairs = ((numbers.get(point.projective(given.vector)), given) for given in self.given)
        return {i: given for i, given in pairs if i is not None}

    def _row_findings(self, i: int, wrong: Row, given: _Given | None, mistakes: tuple[Mistake, ...]) -> list[Finding]:
        """The wrong terms of one row, in the scaling that it was handed in with where that can be told."""
        factor = exact_factor(given.row, wrong) if given is not None else None
        found, expected = wrong, self.right_rows[i]
        if factor is not None:
            found = {q: f * factor for q, f in found.items()}
            expected = {q: f * factor for q, f in expected.items()}
        found, expected = self._shown(found), self._shown(expected)
        label = given.label if given is not None else str(i + 1)
        findings = []
        for q in sorted(found.keys() | expected.keys(), key=lambda q: (q == 0, q)):
            one, other = found.get(q, NOTHING), expected.get(q, NOTHING)
            if one != other:
                for mistake in self._responsible(i, q, mistakes):
                    findings.append(
                        self._finding(i, q, one, other, mistake.code, (mistake.english, mistake.japanese), label)
                    )
        return findings

    def _responsible(self, i: int, q: int, mistakes: tuple[Mistake, ...]) -> list[Mistake]:
        """Which of the mistakes change a term; all of them where that cannot be told."""
        if len(mistakes) == 1 or self.view.relative:
            return list(mistakes)
        names = {mistake.name for mistake in mistakes}
        touching = {
            image.mistake.name for image in self.images.wrong if image.mistake.name in names and (i, q) in image.terms
        }
        return [mistake for mistake in mistakes if mistake.name in touching] or list(mistakes)

    def _shown(self, row: Row) -> Row:
        """A row in the angles that were handed in."""
        if not self.view.relative:
            return row
        return self.space.split(self.space.substitute_angles(self.space.join(row), columns_to_relative(self.m)))

    def _finding(
        self, i: int, q: int, found: Formula, expected: Formula, cause: str, says: tuple[str, str], label: str
    ) -> Finding:
        name = term_name(self.m, i, q)
        whole = not name.startswith("A[") and not (self.m.kind == "rod-chain" and name.startswith("B["))
        motion = Formula({(q, 0, COS): _ONE}) if whole else CONSTANT_ONE
        one, other = text(self.space, found * motion), text(self.space, expected * motion)
        return Finding(equation_number(self.m), name, one, other, cause, says[0], says[1], label)

    def _unexplained(self, alignment: Alignment) -> Diagnosis:
        """The terms that differ when each row is scaled so that most of its terms agree."""
        if self.lagrangian is not None:
            note = "No mistake of the catalogue leads to this Lagrangian."
            note_ja = "このラグランジアンになる誤りは目録にありません。"
            return self._answer("wrong", findings=self._lagrangian_findings(()), notes=(note,), notes_ja=(note_ja,))
        rows = [given.row for given in self.given]
        if is_solved(self.m, rows) and not self.view.relative:
            return self._answer("wrong", findings=self._solved_findings())
        findings: list[Finding] = []
        known = partial(self.images, self.vectors, alignment)
        for given, i in zip(self.given, alignment.row_of, strict=True):
            if i is None or not given.vector:
                says = "Row {0} is no equation of motion of this system.", "第{0}行はこの系の運動方程式ではありません。"
                findings.append(Finding(
                    equation_number(self.m), "the whole row", "", "", "row-unknown",
                    says[0].format(given.label), says[1].format(given.label), given.label,
                ))  # fmt: skip
            elif not is_multiple(given.row, self.right_rows[i]):
                findings += self._differences(given, i, self.right_rows[i], known)
        return self._answer("wrong", findings=tuple(findings))

    def _solved_findings(self) -> tuple[Finding, ...]:
        """The differences of rows that are solved for the accelerations from the right ones, solved too."""
        findings: list[Finding] = []
        base = solved_rows(self.m, self.right_rows)
        for given in self.given:
            i = next(k for k in range(self.m.n) if self.images.accelerations[k] in given.row)
            if not is_multiple(given.row, base[i]):
                findings += self._differences(given, i, base[i], {}, solved_term_name)
        number = {2: "1.11", 3: "2.12"}.get(self.m.n, "3.10") if self.m.kind == "n-leg" else "22"
        return tuple(replace(f, equation=number) for f in findings)

    def _differences(
        self,
        given: _Given,
        i: int,
        base: Row,
        known: Mapping[tuple[int, int], Mistake],
        name: Callable[[Mechanism, int, int], str] = term_name,
    ) -> list[Finding]:
        """The terms of one row that differ from a right one when it is scaled so that most of its terms agree."""
        vector = self.images.point.vector(base)
        best = factors(given.vector, vector)
        agreed = [q for q in base if best and given.vector.get(q) == best[0][0] * vector[q] % PRIME]
        factor = exact_factor(given.row, base, agreed)
        expected = base if factor is None else {q: f * factor for q, f in base.items()}
        found, expected = self._shown(given.row), self._shown(expected)
        findings = []
        for q in sorted(found.keys() | expected.keys(), key=lambda q: (q == 0, q)):
            one, other = found.get(q, NOTHING), expected.get(q, NOTHING)
            if one == other or (factor is None and q in agreed):
                continue
            mistake = known.get((i, q))
            cause, *says = (
                (mistake.code, mistake.english, mistake.japanese)
                if mistake
                else told(self.m, i, q, one, other, name(self.m, i, q))
            )
            finding = self._finding(i, q, one, other, cause, (says[0], says[1]), given.label)
            findings.append(replace(finding, term=name(self.m, i, q)))
        return findings

    # A Lagrangian -----------------------------------------------------------------------------------------------------

    def _lagrangian_findings(self, mistakes: tuple[Mistake, ...]) -> tuple[Finding, ...]:
        """The terms of the Lagrangian that differ, in the scale in which most agree."""
        assert self.lagrangian is not None
        given = by_waves(self.space, merged(self.view, self.lagrangian))
        base = by_waves(self.space, merged(self.view, right(self.m).lagrangian()))
        factor = common_factor(given, base)
        number = {2: "1.4", 3: "2.5"}.get(self.m.n, "3.4") if self.m.kind == "n-leg" else "18"
        changes = [
            (mistake, by_waves(self.space, merged(self.view, derive(self.m, [mistake]).lagrangian())))
            for mistake in mistakes
        ]
        findings = []
        for key in sorted(given.keys() | base.keys()):
            one, other = given.get(key, NOTHING), base.get(key, NOTHING) * factor
            if one == other:
                continue
            term = f"L: {text(self.space, Formula({key: _ONE}))}"
            made = [mistake for mistake, changed in changes if changed.get(key) != base.get(key)] or mistakes
            for code, english, japanese in [(x.code, x.english, x.japanese) for x in made] or [_plain_term(term)]:
                findings.append(Finding(
                    number, term, text(self.space, one), text(self.space, other), code, english, japanese,
                ))  # fmt: skip
        return tuple(findings)


_ONE = fmpq(1)


def _plain_term(term: str) -> tuple[str, str, str]:
    return "term-wrong", f"The term {term} of the Lagrangian is not right.", f"ラグランジアンの項 {term} が違います。"


def _same_equations(
    images: Images, found: list[tuple[Mistake, ...]]
) -> list[tuple[tuple[Mistake, ...], list[list[Mistake]]]]:
    """Explanations whose mistakes are the same one by one, up to names for the same equations, told as one.

    Each with, for each of its mistakes, the others that lead to the very same equations.
    """
    numbers = {image.mistake.name: tuple(sorted(image.projective.items())) for image in images.wrong}
    groups: dict[tuple[object, ...], tuple[tuple[Mistake, ...], list[list[Mistake]]]] = {}
    for mistakes in found:
        ordered = sorted(mistakes, key=lambda m: repr(numbers.get(m.name)))
        key = tuple(numbers.get(m.name) for m in ordered)
        if key not in groups:
            twins = [
                [
                    image.mistake
                    for image in images.wrong
                    if numbers[image.mistake.name] == numbers.get(m.name) and image.mistake.name != m.name
                ]
                for m in mistakes
            ]
            groups[key] = (mistakes, twins)
    return list(groups.values())
