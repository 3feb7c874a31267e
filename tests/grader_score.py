"""How well derivations are graded: mistakes named, right equations accepted, malformed inputs refused, and how fast.

    python tests/grader_score.py [--quick] [--json]

Every single mistake of the catalogue (2, 3 and 4 angles, both mechanisms), random pairs of mistakes, random rewritings
of right equations, and malformed or hostile inputs. Each is written as text and graded like any user's file.
"""

from __future__ import annotations

import argparse
import json
import random
import resource
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

from hostile_derivations import hostile
from rewritten_derivations import plain, rewritten

from furiko.derivations.algebra.symbols import KINDS, Symbols, symbols_of
from furiko.derivations.grading.explain import LAGRANGE_STAGES
from furiko.derivations.grading.grade import grade_text
from furiko.derivations.grading.grade_record import Grade
from furiko.derivations.mistakes.known_mistakes import KnownMistakes, known_mistakes
from furiko.derivations.steps.derivation import NEWTON_STAGES, Mistake, correct_derivation, derive
from furiko.derivations.steps.views import View
from furiko.models.errors import InvalidInput

SIZES = (2, 3, 4)


@dataclass
class Tally:
    """Counts, the slowest verdict [s], and the first few that went wrong."""

    title: str
    counts: dict[str, int] = field(default_factory=dict)
    slowest: float = 0.0
    failures: list[str] = field(default_factory=list)

    def add(self, what: str, detail: str = "") -> None:
        """Count one; ``detail`` is kept where it is a failure to look at."""
        self.counts[what] = self.counts.get(what, 0) + 1
        if detail and len(self.failures) < 20:
            self.failures.append(f"{what}: {detail}")

    def timed(self, work: Callable[..., Grade], *arguments: Any) -> Grade:
        """Run one grading and keep the slowest."""
        start = time.perf_counter()
        try:
            return work(*arguments)
        finally:
            self.slowest = max(self.slowest, time.perf_counter() - start)


def same_equations(known: KnownMistakes) -> dict[str, tuple[int, ...]]:
    """For each wrong mistake, its equations as numbers: mistakes with the same ones cannot be told apart by anyone."""
    return {
        entry.mistake.name: tuple(entry.projective.get(i, number) for i, number in enumerate(known.right_projective))
        for entry in known.wrong
    }


def singles(sizes: Sequence[int] = SIZES, seed: int = 1, part: float = 1.0) -> Tally:
    """Every mistake of the catalogue, alone; ``part``: of them, drawn at random."""
    tally, draw = Tally("single mistakes"), random.Random(seed)
    for m in _mechanisms(sizes):
        known = known_mistakes(View(m))
        classes = same_equations(known)
        for mistake in known.equivalent:
            if part < 1 and draw.random() > part:
                continue
            verdict = tally.timed(_grade, m, [mistake], draw).verdict
            tally.add(
                "equivalent to right, called correct" if verdict == "correct" else "FALSELY ACCUSED",
                "" if verdict == "correct" else mistake.name,
            )
        for entry in known.wrong:
            if part < 1 and draw.random() > part:
                continue
            answer = tally.timed(_grade, m, [entry.mistake], draw)
            tally.add(*_single(answer, entry.mistake, classes, m))
    return tally


def _single(answer: Grade, mistake: Mistake, classes: dict[str, tuple[int, ...]], m: Symbols) -> tuple[str, str]:
    where = f"{m.kind} {m.n} {mistake.name}"
    if answer.assumes and answer.verdict == "correct":
        return "right on a condition that is said", ""
    if answer.verdict != "wrong":
        return "NOT DETECTED", where
    if not answer.findings:
        return "no term named", where
    names = [named.name for named in answer.mistakes]
    if names == [mistake.name]:
        return "named first", ""
    if len(names) == 1 and classes[names[0]] == classes[mistake.name]:
        return "named under another name for the same equations", ""
    return "named wrongly", f"{where} -> {names}"


def pairs(count: int = 1000, sizes: Sequence[int] = SIZES, seed: int = 2) -> Tally:
    """Random pairs of mistakes, made in one derivation."""
    tally, draw = Tally("pairs of mistakes"), random.Random(seed)
    mechanisms = _mechanisms(sizes)
    done = 0
    while done < count:
        m = draw.choice(mechanisms)
        known = known_mistakes(View(m))
        classes = same_equations(known)
        one, two = (entry.mistake for entry in draw.sample(known.wrong, 2))
        if not _compatible(one, two):
            continue
        rows = known.rows(derive(m, [one, two]))
        number = tuple(known.point.projective(row) for row in rows)
        if number in classes.values() or number == tuple(known.right_projective) or not all(rows):
            tally.add("left out: together they make the equations of one mistake, or none")
            continue
        done += 1
        answer = tally.timed(_grade, m, [one, two], draw)
        tally.add(*_pair(answer, (one, two), classes, m))
    return tally


def _compatible(one: Mistake, two: Mistake) -> bool:
    stages = {one.stage, two.stage}
    return stages.isdisjoint(NEWTON_STAGES) or stages.isdisjoint(LAGRANGE_STAGES)


def _pair(  # noqa: PLR0911 -- one for each outcome
    answer: Grade, planted: tuple[Mistake, Mistake], classes: dict[str, tuple[int, ...]], m: Symbols
) -> tuple[str, str]:
    where = f"{m.kind} {m.n} {[p.name for p in planted]} -> {[n.name for n in answer.mistakes]}"
    if answer.assumes and answer.verdict == "correct":
        return "right on a condition that is said", ""
    if answer.verdict != "wrong":
        return "NOT DETECTED", where
    wanted = sorted(classes[p.name] for p in planted)

    def names_both(names: Sequence[str]) -> bool:
        return sorted(classes.get(name, ()) for name in names) == wanted

    if {named.name for named in answer.mistakes} == {p.name for p in planted}:
        return "both named, first", ""
    if names_both([named.name for named in answer.mistakes]):
        return "both named, first, under another name for the same equations", ""
    if any(names_both(names) for names in answer.alternatives):
        return "both named, as an alternative", ""
    if {named.name for named in answer.mistakes} & {p.name for p in planted}:
        return "one of two named", where
    return "neither named", where


def rewritings(count: int = 1000, sizes: Sequence[int] = SIZES, seed: int = 3) -> Tally:
    """Right equations, written in random ways."""
    tally, draw = Tally("right equations, rewritten"), random.Random(seed)
    mechanisms = _mechanisms(sizes)
    for _ in range(count):
        m = draw.choice(mechanisms)
        text = rewritten(m, correct_derivation(m).rows, draw)
        answer = tally.timed(grade_text, text)
        tally.add("correct" if answer.verdict == "correct" else "REJECTED", "" if answer.verdict == "correct" else text)
    return tally


def hostile_inputs(count: int = 10_000, seed: int = 4) -> Tally:
    """Malformed and hostile inputs, none twice: each must end in a verdict or in one line that says where."""
    tally, draw = Tally("hostile inputs"), random.Random(seed)
    tried: set[str] = set()
    while len(tried) < count:
        text = hostile(draw)
        if text in tried:  # of large ones there are a few dozen, each of which takes as long as a hundred others
            continue
        tried.add(text)
        try:
            answer = tally.timed(grade_text, text)
            tally.add(f"read after all: {answer.verdict}")
        except InvalidInput as error:
            message = str(error)
            tally.add("refused in one line" if "\n" not in message and len(message) < 600 else "NOT ONE LINE", "")
        except Exception as error:  # the measurement is of just this
            tally.add("TRACEBACK", f"{type(error).__name__}: {text[:200]!r}")
    tally.add(f"memory at most {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024} MB")
    return tally


def cold(sizes: Sequence[int] = (4,)) -> Tally:
    """The first verdict on a wrong derivation, nothing kept from before: with the catalogue derived from the start."""
    tally = Tally("first verdict, from nothing")
    for m in _mechanisms(sizes):
        known_mistakes.cache_clear()
        correct_derivation.cache_clear()
        answer = tally.timed(_grade_last, m)
        tally.add(f"{m.kind}, {m.n} angles: {answer.verdict}")
    return tally


def _grade_last(m: Symbols) -> Grade:
    return _grade(m, [known_mistakes(View(m)).wrong[-1].mistake], random.Random(0))


def _grade(m: Symbols, mistakes: Sequence[Mistake], draw: random.Random) -> Grade:
    return grade_text(plain(m, derive(m, mistakes).rows, draw))


def _mechanisms(sizes: Sequence[int]) -> list[Symbols]:
    return [symbols_of(kind, n) for kind in KINDS for n in sizes]


def table(tallies: Sequence[Tally]) -> str:
    """The figures, for a terminal."""
    lines = []
    for tally in tallies:
        total = sum(tally.counts.values())
        lines.append(f"{tally.title} (slowest verdict {tally.slowest:.2f} s)")
        lines += [f"  {count:6d}  {100 * count / total:5.1f} %  {what}" for what, count in sorted(tally.counts.items())]
        lines += [f"      {failure[:200]}" for failure in tally.failures[:10]]
    return "\n".join(lines)


def main() -> None:
    """Run all measurements and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="a tenth of everything, and only 2 and 3 angles")
    parser.add_argument("--json", action="store_true", help="print one JSON document")
    options = parser.parse_args()
    sizes, share = ((2, 3), 10) if options.quick else (SIZES, 1)
    tallies = [
        cold(), singles(sizes), pairs(1000 // share, sizes), rewritings(1000 // share, sizes),
        hostile_inputs(10_000 // share),
    ]  # fmt: skip
    report: Any = [asdict(tally) for tally in tallies]
    print(json.dumps(report, ensure_ascii=False) if options.json else table(tallies))


if __name__ == "__main__":
    main()
