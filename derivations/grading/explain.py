"""Finds the mistakes that explain a set of wrong equations: one, or two, or several, of the catalogue.

Everything here is arithmetic at one random point (:mod:`furiko.derivations.algebra.fingerprint`). A row is compared up
to an unknown factor, since it may have been scaled by anything:

- one mistake: the rows of a catalogue derivation are, as a set and up to factors, the rows given;
- or the catalogue derivation, solved for the accelerations, gives what the rows given, solved, give;
- two mistakes: with the factor of a row guessed from any of its terms, (row given - right row) is the sum of the
  changes that two catalogue mistakes make; sums are found by looking up differences. Two mistakes that do not simply
  add (both in the speed of one mass, say) are tried as a derivation with both.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

from ..algebra.fingerprint import PRIME, Vector, combine, inverse, solved
from ..mistakes.known_mistakes import KnownMistake, KnownMistakes
from ..steps.derivation import NEWTON_STAGES, Mistake, derive

MOST_FACTORS = 14  # guesses at a row's factor that are followed
MOST_EXPLANATIONS = 8
COMPOSED_FIRST = 80  # mistakes that are tried as the first of two that do not add: those that leave least unexplained
COMPOSED_TRIES = 600  # derivations with two mistakes that are worked out; about a quarter of a second
LAGRANGE_STAGES = ("velocity", "speed", "energy", "lagrangian", "momentum", "derivative")  # not on the way by forces


@dataclass(frozen=True)
class Alignment:
    """Which right row each given row is meant to be (or None), and how many of its terms agree with it."""

    row_of: tuple[int | None, ...]
    agreeing: tuple[int, ...]


def factors(row: Vector, base: Vector) -> list[tuple[int, int]]:
    """Guesses at ``row`` = factor · ``base``: each with the number of terms that bear it out, best first."""
    votes = Counter([row[q] * inverse(base[q]) % PRIME for q in row.keys() & base.keys()])
    return votes.most_common(MOST_FACTORS)


def align(known: KnownMistakes, rows: Sequence[Vector], labels: Sequence[str]) -> Alignment:
    """Give each row to the right row with which most of its terms agree; a row's label decides between equals."""
    scores: list[tuple[int, int, int, int, int]] = []
    for r, row in enumerate(rows):
        for i, base in enumerate(known.right):
            best = factors(row, base)
            votes = best[0][1] if best else 0
            score = 2 * votes - len(row.keys() | base.keys())
            scores.append((-score, labels[r] != str(i + 1), abs(r - i), r, i))
    row_of: list[int | None] = [None] * len(rows)
    agreeing = [0] * len(rows)
    taken: set[int] = set()
    for _, _, _, r, i in sorted(scores):
        if row_of[r] is None and i not in taken:
            row_of[r] = i
            taken.add(i)
            best = factors(rows[r], known.right[i])
            agreeing[r] = best[0][1] if best else 0
    return Alignment(tuple(row_of), tuple(agreeing))


def singles(known: KnownMistakes, rows: Sequence[Vector]) -> list[tuple[Mistake, ...]]:
    """Single mistakes whose rows are the given ones, up to order and factors; some rows may be missing."""
    given = Counter(known.point.projective(row) for row in rows)
    strange = given.keys() - set(known.right_projective)  # which the mistake itself must have made
    found: list[tuple[Mistake, ...]] = []
    for entry in known.wrong:
        if not strange.issubset(entry.projective.values()):
            continue
        made = Counter(entry.projective.get(i, right) for i, right in enumerate(known.right_projective))
        if given <= made and any(number in given for number in entry.projective.values()):
            found.append((entry.mistake,))
    return found


def singles_solved(known: KnownMistakes, rows: Sequence[Vector]) -> list[tuple[Mistake, ...]]:
    """Single mistakes whose equations, solved, are the given ones, solved: however the rows were combined."""
    target = solved(list(rows), known.accelerations)
    if target is None:
        return []
    found: list[tuple[Mistake, ...]] = []
    for entry in known.wrong:
        made = [entry.rows.get(i, right) for i, right in enumerate(known.right)]
        if solved(made, known.accelerations) == target:
            found.append((entry.mistake,))
    return found


class Remainder:
    """The wrong rows, which are to be explained, as numbers, each with guesses at the factor it was scaled by.

    ``taken``: a mistake that is already taken as made; the guesses then come from its rows too, since it may have left
    no term of the right row as it was.
    """

    def __init__(self, known: KnownMistakes, rows: Sequence[Vector], alignment: Alignment) -> None:
        self.known = known
        self.rows: dict[int, Vector] = {}
        self.settled: set[int] = set()
        self.guesses: dict[int, list[int]] = {}
        for row, i in zip(rows, alignment.row_of, strict=True):
            if i is None:
                continue
            if known.point.projective(row) == known.right_projective[i]:
                self.settled.add(i)
                continue
            self.rows[i] = row
            self.guesses[i] = [inverse(f) for f, _ in factors(row, known.right[i])]
            self.guesses[i] += [inverse(f) for f in usual_factors(known, i)]
        self.numbers = {i: known.point.linear(row) for i, row in self.rows.items()}
        self.base = [known.point.linear(row) for row in known.right]

    def after(self, entry: KnownMistake | None) -> dict[int, set[int]] | None:
        """What remains of each wrong row after the change that a mistake makes; None where it changes a right row."""
        changes = entry.change if entry is not None else {}
        if not self.settled.isdisjoint(changes):
            return None
        left: dict[int, set[int]] = {}
        for i, row in self.rows.items():
            base = self.base[i] + changes.get(i, 0)
            guesses = self.guesses[i]
            if entry is not None and i in entry.rows:
                guesses = guesses + [inverse(f) for f, _ in factors(row, entry.rows[i])[:3]]
            rest = {(self.numbers[i] * guess - base) % PRIME for guess in guesses}
            if 0 not in rest:
                left[i] = rest
        return left


def usual_factors(known: KnownMistakes, i: int) -> list[int]:
    """Factors that rows are usually scaled by: those that Lagrange's equations leave, and signs."""
    m, point = known.symbols, known.point
    s = m.space
    one = point.value(m.divisor(i))
    forms = [s.l(i), m.mass(i), m.mass(i) * s.l(i), s.l(i) * s.l(i)]
    values = [1, one, *(point.value(f) for f in forms)]
    return [sign * v % PRIME for v in values for sign in (1, -1)]


def sums(known: KnownMistakes, rows: Sequence[Vector], remainder: Remainder) -> list[tuple[Mistake, ...]]:
    """Pairs of mistakes whose changes add up to what is wrong: the second is looked up by what the first leaves."""
    table: dict[int, dict[int, list[KnownMistake]]] = defaultdict(lambda: defaultdict(list))
    for entry in known.wrong:
        for i, change in entry.change.items():
            table[i][change].append(entry)
    found: dict[frozenset[str], tuple[Mistake, ...]] = {}
    given = Counter(known.point.projective(row) for row in rows)
    for first in known.wrong:
        left = remainder.after(first)
        if not left or (len(left) == len(remainder.rows) and remainder.rows.keys().isdisjoint(first.change)):
            continue
        row, numbers = min(left.items(), key=lambda item: len(item[1]))
        for number in numbers:
            for second in table[row].get(number, ()):
                if second is not first and _explains(left, second) and _can_add(known, first, second, given):
                    pair = (first.mistake, second.mistake)
                    found.setdefault(frozenset(m.name for m in pair), pair)
    return list(found.values())


def _can_add(known: KnownMistakes, first: KnownMistake, second: KnownMistake, given: Counter[int]) -> bool:
    """Whether two mistakes really lead to the rows: where they meet in a term, that takes a derivation with both."""
    if first.terms.isdisjoint(second.terms):
        return True
    made = known.rows(derive(known.symbols, (first.mistake, second.mistake)))
    return given <= Counter(known.point.projective(row) for row in made)


def _explains(left: dict[int, set[int]], entry: KnownMistake) -> bool:
    return entry.change.keys() <= left.keys() and all(entry.change.get(i, 0) in left[i] for i in left)


def composed(known: KnownMistakes, rows: Sequence[Vector], alignment: Alignment) -> list[tuple[Mistake, ...]]:
    """Pairs of mistakes that explain the rows when both are made in one derivation, though they do not add.

    Two mistakes that do not add touch a term in common.
    """
    point = known.point
    given = Counter(point.projective(row) for row in rows)
    aligned = [(row, i) for row, i in zip(rows, alignment.row_of, strict=True) if i is not None]
    wrong_rows = {i for row, i in aligned if point.projective(row) != known.right_projective[i]}
    firsts = [(entry, _differing(known, aligned, entry)) for entry in known.wrong if entry.rows.keys() <= wrong_rows]
    firsts.sort(key=lambda item: sum(len(guesses[0]) for guesses in item[1]))
    tried: set[tuple[str, str]] = set()
    found: dict[frozenset[str], tuple[Mistake, ...]] = {}
    for first, left in firsts[:COMPOSED_FIRST]:
        for second in known.wrong:
            names = (first.mistake.name, second.mistake.name)
            if not _covers(second, left) or not _may_meet(first, second, wrong_rows) or names[::-1] in tried:
                continue
            tried.add(names)
            pair = (first.mistake, second.mistake)
            made = known.rows(derive(known.symbols, pair))
            if given <= Counter(point.projective(row) for row in made):
                found.setdefault(frozenset(names), pair)
        if found or len(tried) > COMPOSED_TRIES:
            break
    return list(found.values())


def _may_meet(first: KnownMistake, second: KnownMistake, wrong_rows: set[int]) -> bool:
    """Whether two mistakes can be made in one derivation, meet in a term, and together touch just the wrong rows."""
    if first is second or first.terms.isdisjoint(second.terms):
        return False
    stages = {first.mistake.stage, second.mistake.stage}
    if not stages.isdisjoint(NEWTON_STAGES) and not stages.isdisjoint(LAGRANGE_STAGES):
        return False
    return wrong_rows == first.rows.keys() | second.rows.keys()


def _differing(
    known: KnownMistakes, aligned: list[tuple[Vector, int]], entry: KnownMistake
) -> list[list[frozenset[tuple[int, int]]]]:
    """For each row, the terms that differ from a catalogue derivation: at its best factor, and the next best."""
    differing = []
    for row, i in aligned:
        base = entry.rows.get(i, known.right[i])
        guesses = [factor for factor, _ in factors(row, base)[:3]] or [0]
        differing.append([
            frozenset((i, q) for q in row.keys() | base.keys() if row.get(q, 0) != factor * base.get(q, 0) % PRIME)
            for factor in guesses
        ])  # fmt: skip
    return differing


def _covers(entry: KnownMistake, left: list[list[frozenset[tuple[int, int]]]]) -> bool:
    """Whether a mistake touches all that is left to be explained, for some factor of each row."""
    return all(any(terms <= entry.terms for terms in guesses) for guesses in left)


def partial(known: KnownMistakes, rows: Sequence[Vector], alignment: Alignment) -> dict[tuple[int, int], Mistake]:
    """The mistakes of single terms that explain terms of the wrong rows, by (row, product of motion).

    The factor of a row is the one that most of its terms bear out.
    """
    point = known.point
    by_row: dict[int, dict[frozenset[int], dict[int, Mistake]]] = defaultdict(lambda: defaultdict(dict))
    for entry in known.wrong:
        if entry.mistake.stage == "equation" and len(entry.rows) == 1:
            ((place, wrong),) = entry.rows.items()
            change = combine([(1, wrong), (-1, known.right[place])])
            by_row[place][frozenset(change)].setdefault(point.linear(change), entry.mistake)
    found: dict[tuple[int, int], Mistake] = {}
    for row, i in zip(rows, alignment.row_of, strict=True):
        if i is None:
            continue
        change = difference(row, known.right[i])
        for keys, mistakes in by_row[i].items():
            if change.keys() >= keys:
                mistake = mistakes.get(point.linear({q: change[q] for q in keys}))
                if mistake is not None:
                    found |= {(i, q): mistake for q in keys}
                    change = {q: value for q, value in change.items() if q not in keys}
    return found


def difference(row: Vector, base: Vector) -> Vector:
    """row / factor - base, with the factor that most terms bear out."""
    best = factors(row, base)
    if not best:
        return combine([(1, row), (-1, base)])
    return combine([(inverse(best[0][0]), row), (-1, base)])


def term_by_term(known: KnownMistakes, rows: Sequence[Vector], alignment: Alignment) -> list[tuple[Mistake, ...]]:
    """The mistakes of single terms, however many, when together they explain everything."""
    found = partial(known, rows, alignment)
    wrong = {
        (i, q)
        for row, i in zip(rows, alignment.row_of, strict=True)
        if i is not None
        for q in difference(row, known.right[i])
    }
    if not wrong or wrong != found.keys() or None in alignment.row_of:
        return []
    return [tuple({mistake.name: mistake for mistake in found.values()}.values())]


def explanations(known: KnownMistakes, rows: Sequence[Vector], alignment: Alignment) -> list[tuple[Mistake, ...]]:
    """The shortest explanations there are, most likely first; empty where the catalogue has none."""
    if not known.has_catalogue:
        return []
    found = singles(known, rows)
    if not found:
        found = sums(known, rows, Remainder(known, rows, alignment))
    if not found and len(rows) == known.symbols.n and not _uncombined(known, rows):
        found = singles_solved(known, rows)
    if not found:
        found = composed(known, rows, alignment)
    if not found:
        found = term_by_term(known, rows, alignment)
    return ranked(found)[:MOST_EXPLANATIONS]


def _uncombined(known: KnownMistakes, rows: Sequence[Vector]) -> bool:
    """Whether all rows but one are right ones, so that nobody has combined or solved them."""
    right = set(known.right_projective)
    return sum(known.point.projective(row) in right for row in rows) >= known.symbols.n - 1 > 0


# Mistakes that share their equations with a likelier one are listed after it.
UNLIKELY = {
    "inertia-counted-twice": 2, "rod-inertia-for-point-mass": 1, "rate-not-squared": 1, "x-sign": 1,
    "inner-derivative-missing": 1, "mass-counted-twice": 1, "carriers-halved": 1, "rate-product": 1,
    "moment-about-joint-with-central-inertia": 1, "zero-of-height-moved": 3, "angle-sum": 1,
}  # fmt: skip


def ranked(found: list[tuple[Mistake, ...]]) -> list[tuple[Mistake, ...]]:
    """Fewest first, then the least unlikely; the catalogue's order (earlier stages first) decides what is left."""
    return sorted(found, key=lambda mistakes: (len(mistakes), sum(UNLIKELY.get(m.code, 0) for m in mistakes)))
