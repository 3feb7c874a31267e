"""Wrong terms of any mechanism's derivation, in its author's coordinates, symbols and scaling; without a catalogue.

A row is held against the right row with which most of its terms agree, at the factor that most of them bear out: so one
term that is wrong is accused before many that are right.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from flint import fmpq

from ..algebra.multiples import divided
from ..algebra.notation import pretty, text
from ..algebra.signs import switches
from ..algebra.symbols import symbols_of
from ..algebra.trig import CONSTANT_ONE, COS, NOTHING, ONE, Formula, Key, Space, digit, unit
from ..reading.submission import Submission
from ..steps.mechanism import Mechanism
from ..steps.solved_form import is_solved, solved_rows
from .grade_record import WrongTerm
from .hypotheses import Said
from .term_difference import difference

Term = tuple[int, int, int]  # packed motion (and coordinates outside waves), wave, its phase
Terms = dict[Term, Formula]


def terms(space: Space, f: Formula, apart: bool = False, beside: Sequence[int] = ()) -> Terms:
    """The coefficient of each product of motion and wave: in parameters, and in coordinates outside of waves, since
    rows are divided by those too; ``apart``: the latter are told apart as well; ``beside``: and the symbols there.
    """
    parts: dict[Term, dict[Key, fmpq]] = {}
    for (e, h, s), c in f.terms.items():
        q = space.motion(e) + switches(space, e) + (space.outside(e) if apart else 0)
        q += sum(digit(e, place) * unit(place) for place in beside)
        parts.setdefault((q, h, s), {})[e - q, 0, COS] = c
    return {key: Formula(part) for key, part in parts.items()}


@dataclass(frozen=True)
class Scaled:
    """A row (or Lagrangian) beside what it should be, at one factor; ``wrong``: the terms that differ."""

    given: Terms
    right: Terms
    factor: Formula

    @cached_property
    def expected(self) -> Terms:
        """The right coefficients in the author's scaling."""
        return {key: f * self.factor for key, f in self.right.items()}

    @cached_property
    def wrong(self) -> list[Term]:
        """The terms that differ, accelerations first and gravity last."""
        keys = sorted(self.given.keys() | self.right.keys(), key=lambda key: (key[0] == 0, key))
        return [k for k in keys if self.given.get(k, NOTHING) != self.expected.get(k, NOTHING)]

    @cached_property
    def agreeing(self) -> int:
        """How many single products agree."""
        shared = self.given.keys() & self.expected.keys()
        return sum(len(self.given[key].terms.items() & self.expected[key].terms.items()) for key in shared)


def scalings(given: Terms, right: Terms) -> list[Scaled]:
    """Both at each factor that a term bears out, the one with most agreeing products first; at 1 too."""
    votes: Counter[Formula] = Counter()
    for key in given.keys() & right.keys():
        factor = divided(given[key], right[key])
        if factor is not None:
            votes[factor] += 1
    votes.setdefault(CONSTANT_ONE, 0)
    found = [Scaled(given, right, factor) for factor in votes]
    return sorted(found, key=lambda x: (-x.agreeing, len(x.wrong), x.factor != CONSTANT_ONE))


def row_differences(s: Submission, mechanism: Mechanism) -> tuple[WrongTerm, ...]:
    """The wrong terms of all rows, each row at the factor that accuses fewest."""
    return differences_from(s, mechanism.rows)


def differences_from(s: Submission, rows: Sequence[Formula]) -> tuple[WrongTerm, ...]:
    """The same where these rows are right."""
    return tuple(
        term_finding(s, scaled, key, label, f"Row {label}", f"第{label}行")
        for label, scaled in aligned(s, rows)
        for key in scaled.wrong
    )


def aligned(s: Submission, rows: Sequence[Formula]) -> list[tuple[str, Scaled]]:
    """Each given row with the right row that it is meant to be: label, and both at the best factor."""
    space = s.space
    rights = [terms(space, f) for f in right_rows(s, rows)]
    pairs = []
    for r, (label, f) in enumerate(s.rows):
        given = terms(space, f)
        for i, right in enumerate(rights):
            best = scalings(given, right)[0]
            score = 2 * best.agreeing - sum(map(len, given.values())) - sum(map(len, right.values()))
            pairs.append((-score, label != str(i + 1), abs(r - i), r, i, label, best))
    out: dict[int, tuple[str, Scaled]] = {}
    taken: set[int] = set()
    for _, _, _, r, i, label, best in sorted(pairs, key=lambda pair: pair[:5]):
        if r not in out and i not in taken:
            out[r] = (label, best)
            taken.add(i)
    return [out[r] for r in sorted(out)]


def right_rows(s: Submission, rows: Sequence[Formula]) -> Sequence[Formula]:
    """The right rows, solved for the accelerations where the author solved them."""
    space, m = s.space, symbols_of("rod-chain", s.space.n)
    right = [space.split(f) for f in rows]
    if m.n > 1 and is_solved(m, [space.split(f) for _, f in s.rows]) and not is_solved(m, right):
        solved = solved_rows(m, right)
        if all(unit(k) in row for k, row in enumerate(solved)):  # rows that an author takes as right may be singular
            return [space.join(row) for row in solved]
    return rows


def lagrangian_differences(s: Submission, mechanism: Mechanism) -> tuple[tuple[WrongTerm, ...], list[Said]]:
    """The wrong terms of a Lagrangian in the scale that leaves most of it right; other scales are said in a note."""
    assert s.lagrangian is not None
    space = s.space
    best, *others = lagrangian_scalings(space, s.lagrangian, mechanism.lagrangian)
    findings = tuple(term_finding(s, best, key, "", "The Lagrangian", "ラグランジアン") for key in best.wrong)
    notes: list[Said] = []
    if best.factor != CONSTANT_ONE:
        size = pretty(text(space, best.factor))
        notes.append((
            f"The Lagrangian is taken as {size} times T − U: so most of what is written is right.",
            f"ラグランジアンを T − U の {size} 倍と読みました（書かれた項の多くが正しくなるため）。",
        ))  # fmt: skip
    as_written = next((x for x in others if x.factor == CONSTANT_ONE and x.agreeing), None)
    if as_written is not None:
        listed = ", ".join(pretty(_shown(s, key, CONSTANT_ONE)) for key in as_written.wrong[:6])
        notes.append((
            f"Or it is T − U itself, and these terms are wrong: {listed}.",
            f"または T − U そのもので、次の項が違います：{listed}。",
        ))  # fmt: skip
    return findings, notes


def lagrangian_scalings(space: Space, lagrangian: Formula, right: Formula) -> list[Scaled]:
    """A Lagrangian beside the right one at each scale; what is constant counts in neither."""
    return scalings(*(without_constants(terms(space, f, apart=True)) for f in (lagrangian, right)))


def without_constants(parts: Terms) -> Terms:
    """Without what neither moves nor turns."""
    return {key: f for key, f in parts.items() if key[0] or key[1]}


def term_finding(s: Submission, scaled: Scaled, key: Term, label: str, where: str, wo: str) -> WrongTerm:
    """One term that differs, as a record. ``where``, ``wo``: of what, in English and Japanese."""
    found, expected = scaled.given.get(key, NOTHING), scaled.expected.get(key, NOTHING)
    code, english, japanese = difference(found, expected, s.space)
    name = authors(s, _shown(s, key, CONSTANT_ONE)) if any(key[:2]) else "the constant"
    return WrongTerm(
        "", name, authors(s, _shown(s, key, found)), authors(s, _shown(s, key, expected)), code,
        f"{where}, the term with {pretty(name)}: {authors(s, english)}.",
        f"{wo}の {pretty(name)} の項：{authors(s, japanese)}。", label,
    )  # fmt: skip


def _shown(s: Submission, key: Term, coefficient: Formula) -> str:
    q, h, phase = key
    return text(s.space, coefficient * Formula({(q, h, phase): ONE}))


def authors(s: Submission, ascii_text: str) -> str:
    """Our letters replaced by the author's, where he has others."""
    if s.mechanism is not None:
        names, primes = s.mechanism.coordinates, {"t": "", "q": "", "w": "'", "a": "''"}
        return re.sub(r"\b([tqwa])([0-9])\b", lambda x: names[int(x[2]) - 1] + primes[x[1]], ascii_text)
    said: Mapping[str, str] = {meant: written for written, meant in s.words.said if len(meant) == 1}
    for ours, his in said.items():
        ascii_text = re.sub(rf"(?<![A-Za-z]){ours}(?=[0-9₀-₉]|\b)(?![A-Za-z])", his, ascii_text)
    return ascii_text
