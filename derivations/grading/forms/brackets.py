"""Finds the bracket that was closed too early or too late: in a row, or in the Lagrangian, in whatever form."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations

from ...algebra.fingerprint import PRIME
from ...algebra.notation import text
from ...algebra.trig import Formula
from ...mistakes.anywhere.brackets import Bracket, brackets
from ...mistakes.anywhere.parts import AnyMistake, Words, shown
from ...steps.derivation import add, lagrange_rows
from .trial import Mark, Trial

MOST_TERMS = 8  # in one bracket, of which any may be outside; of more, all but one, or one
MOST_TERMS_OF_A_SUM = 60
MOST_CHOICES = 6000  # of one sum: some tenths of a second
MOST_TERMS_OF_ENERGIES = 12  # where it is rows that are written
MOST_SHOWN = 100  # characters


def bracket_slips(trial: Trial, words: Words, *, rows: bool) -> list[AnyMistake]:
    """The slips in one bracket that explain what is written, those with fewest terms outside first.

    ``rows``: of the rows too, and not of the Lagrangian alone.
    """
    found = [*_of_rows(trial, words)] if rows and not trial.scaled else []
    if not found and (trial.scaled or len(trial.m.lagrangian) <= MOST_TERMS_OF_ENERGIES):
        found = [*_of_lagrangian(trial, words)]
    return sorted(found, key=lambda x: x.size)


def _of_rows(trial: Trial, words: Words) -> Iterator[AnyMistake]:
    (wanted,) = trial.wanted
    wide = len(wanted) // trial.space.n  # numbers of a row
    left = sorted({k // wide for k, x in enumerate(wanted) if x})
    if len(left) != 1:
        return
    (i,) = left
    for bracket, outside in _choices(trial, trial.right[i], lambda f: trial.mark_of({i: f}), [wanted]):
        en, ja = _said(trial, words, bracket, outside)
        change = add(bracket.changes[k] for k in outside)
        yield AnyMistake("bracket-slip", "equation", f"In row {i + 1}, {en}", f"第{i + 1}式：{ja}", rows={i: change})


def _of_lagrangian(trial: Trial, words: Words) -> Iterator[AnyMistake]:
    def mark(f: Formula) -> Mark:
        changes = lagrange_rows(trial.space, f)
        return trial.mark_of({i: change for i, change in enumerate(changes) if change})

    for bracket, outside in _choices(trial, trial.m.lagrangian, mark, trial.wanted):
        en, ja = _said(trial, words, bracket, outside)
        change = add(bracket.changes[k] for k in outside)
        yield AnyMistake("bracket-slip", "lagrangian", f"In the Lagrangian, {en}", f"ラグランジアン：{ja}", change)


def _choices(
    trial: Trial, f: Formula, mark: Callable[[Formula], Mark], wanted: Sequence[Mark]
) -> Iterator[tuple[Bracket, tuple[int, ...]]]:
    """Each bracket of a sum with those of its terms that, outside of it, add up to what is wanted."""
    if len(f) > MOST_TERMS_OF_A_SUM:
        return
    kept: dict[Formula, Mark] = {}
    tried = 0
    for bracket in brackets(trial.space, f):
        marks = []
        for change in bracket.changes:
            if change not in kept:
                kept[change] = mark(change)
            marks.append(kept[change])
        for outside in _subsets(len(marks), bracket):
            tried += 1
            if tried > MOST_CHOICES:
                return
            total = tuple(sum(x) % PRIME for x in zip(*(marks[k] for k in outside), strict=True))
            if total in wanted:
                yield bracket, outside


def _subsets(count: int, bracket: Bracket) -> Iterator[tuple[int, ...]]:
    """The terms that may be on the wrong side: at least one with the factor is inside of the bracket."""
    if count <= MOST_TERMS and not bracket.whole:
        for size in range(1, count + bracket.late):
            yield from combinations(range(count), size)
        return
    if not bracket.whole:
        yield from ((k,) for k in range(count))
    yield from (tuple(j for j in range(count) if j != k) for k in range(count))


def _said(trial: Trial, words: Words, bracket: Bracket, outside: Sequence[int]) -> tuple[str, str]:
    space = trial.space
    factor = shown(words, text(space, bracket.factor))
    lost = shown(words, text(space, add(bracket.terms[k] for k in outside)))
    lost = lost if len(lost) <= MOST_SHOWN else lost[:MOST_SHOWN] + " …"
    if bracket.whole:
        return (f"a minus stands before a part of its bracket alone: it belongs to {lost} as well.",
                f"括弧の前の負号が一部にしか掛かっていません：{lost} にも掛かります。")  # fmt: skip
    if bracket.late:
        return (f"a bracket is closed too late: the factor {factor} does not belong to {lost}.",
                f"括弧が遅く閉じられています：{factor} は {lost} には掛かりません。")  # fmt: skip
    return (f"a bracket is closed too early: the factor {factor} belongs to {lost} as well.",
            f"括弧が早く閉じられています：{factor} は {lost} にも掛かります。")  # fmt: skip
