"""Compares two runs: changed outcomes, errors that grew or shrank, comparisons that only one run has."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from ..records import check
from ..records.check import ChangeKind, Circumstance, DiffDocument, Result
from ..records.exit_status import AGREES, DIFFERS, INCOMPLETE
from .report import Report
from .words import count, few, figure, one_line, word

# ! agreed, or was missing, and now differs or fails     * differed or failed and now agrees
# + error grew     - error shrank     x bound or unit changed, so the errors cannot be compared
# ~ the outcome changed in another way (to or from skipped)     > only in the second run     < only in the first
Mark = Literal["!", "*", "+", "-", "x", "~", ">", "<", " "]
SAYS: dict[Mark, ChangeKind] = {
    "!": "broke",
    "+": "error grew",
    "x": "not comparable",
    "~": "outcome changed",
    "*": "fixed",
    "-": "error shrank",
    ">": "appeared",
    "<": "disappeared",
}
BAD = ("differs", "error")
FACTOR = 2.0  # two machines, or two orders of summation, may change an error by this factor with nothing wrong


@dataclass(frozen=True, eq=False)
class Change:
    """One comparison in both runs; ``before`` or ``after`` is None where that run does not have it."""

    before: Result | None
    after: Result | None
    mark: Mark

    @property
    def result(self) -> Result:
        """The later result, or the earlier one where there is no later: for names."""
        result = self.after or self.before
        assert result is not None
        return result

    @property
    def figures(self) -> tuple[str, str]:
        """Outcome and error in each run, as a report writes them."""
        return _figures(self.before), _figures(self.after)

    @property
    def ratio(self) -> float | None:
        """The later error over the earlier one; None where either is missing or the earlier one is zero."""
        if self.before is None or self.after is None or self.before.measured is None or self.after.measured is None:
            return None
        return abs(self.after.measured / self.before.measured) if self.before.measured else None


@dataclass(frozen=True)
class Comparison:
    """All comparisons of two runs: those of the second run in its order, then those that only the first has."""

    before: Report
    after: Report
    changes: tuple[Change, ...]
    factor: float

    def marked(self, *marks: Mark) -> list[Change]:
        """The changes with one of these marks."""
        return [change for change in self.changes if change.mark in marks]

    @cached_property
    def exit_status(self) -> int:
        """0: nothing got worse; 1: something differs or fails now that did not before, or its error grew; 3: a run is
        incomplete."""
        if self.marked("!", "+"):
            return DIFFERS
        return AGREES if self.before.complete and not self.after.flaws else INCOMPLETE

    @cached_property
    def circumstances(self) -> tuple[tuple[str, str, str], ...]:
        """What else changed, engine and library versions, furiko, machine: what, in the first run, in the second."""
        old, new = self.before.header, self.after.header
        versions = [
            (f"{engine.name} ({engine.package})", there.version or "not installed", engine.version or "not installed")
            for engine in new.engines
            if (there := self.before.engine(engine.name)) is not None
        ]
        packages = {engine.package for engine in (*old.engines, *new.engines)}
        names = [name for name in new.versions if name in old.versions and name not in packages]
        found = [
            ("furiko", old.furiko, new.furiko),
            ("profile", old.profile, new.profile),
            *versions,
            *((name, old.versions[name], new.versions[name]) for name in names),
            *((name, old.machine[name], new.machine[name]) for name in new.machine if name in old.machine),
        ]
        return tuple(item for item in found if item[1] != item[2])

    @cached_property
    def not_looked_at(self) -> frozenset[Change]:
        """What only the first run has because the second was asked for less: fewer scenes or engines, or a profile that
        has no such check. Within what both were asked for, a comparison that is gone has disappeared."""
        old, new = self.before.header, self.after.header
        scenes = {scene.name for scene in old.scenes} - {scene.name for scene in new.scenes}
        engines = {engine.name for engine in old.engines} - {engine.name for engine in new.engines}
        checks = {result.comparison for result in self.before.results} - {r.comparison for r in self.after.results}
        checks = checks if old.profile != new.profile else set()
        return frozenset(
            change
            for change in self.marked("<")
            if change.result.scene in scenes or change.result.engine in engines or change.result.comparison in checks
        )

    @cached_property
    def narrower(self) -> str:
        """How much of the first run the second was not asked for, in a sentence; empty where it was asked for all."""
        if not self.not_looked_at:
            return ""
        left = [change.result for change in self.changes if change in self.not_looked_at]
        scenes = few((result.scene for result in left), "scene")
        engines = few((result.engine for result in left), "engine")
        return f"{count(len(left), 'comparison')} not looked at in the second run: {scenes} × {engines}"

    @cached_property
    def flaws(self) -> tuple[str, ...]:
        """Why a run is not whole, in sentences."""
        runs = (("first", self.before), ("second", self.after))
        return tuple(f"{name} run: {flaw}" for name, run in runs for flaw in run.flaws)

    def of_kind(self, mark: Mark) -> list[Change]:
        """The changes with this mark, less those that the second run was not asked for."""
        return [change for change in self.marked(mark) if change not in self.not_looked_at]

    @cached_property
    def summary(self) -> str:
        """How many changes there are of each kind, and how many comparisons are unchanged."""
        said = [f"{len(found)} {says}" for mark, says in SAYS.items() if (found := self.of_kind(mark))]
        return "; ".join([*said, f"{count(len(self.marked(' ')), 'comparison')} unchanged"]) + "."

    def text(self) -> str:
        """One line for each change, under headings; unchanged comparisons are only counted."""
        lines = [*self.flaws]
        lines += [f"other {what}: {one_line(old)} → {one_line(new)}" for what, old, new in self.circumstances]
        for mark, says in SAYS.items():
            if found := self.of_kind(mark):
                lines += [f"{says} ({len(found)})", *(f"  {mark} {_line(change)}" for change in found), ""]
        if self.narrower:
            lines += [self.narrower, ""]
        return "\n".join([*lines, self.summary])

    def document(self) -> DiffDocument:
        """All of it as one record."""
        return DiffDocument(
            summary=self.summary,
            exit_status=self.exit_status,
            factor=self.factor,
            flaws=list(self.flaws),
            circumstances=[Circumstance(what=what, before=a, after=b) for what, a, b in self.circumstances],
            changes=[_record(says, change) for mark, says in SAYS.items() for change in self.of_kind(mark)],
            unchanged=len(self.marked(" ")),
            not_looked_at=len(self.not_looked_at),
        )


def _record(says: ChangeKind, change: Change) -> check.Change:
    result, before, after = change.result, change.before, change.after
    return check.Change(
        change=says,
        scene=result.scene,
        engine=result.engine,
        check=result.check,
        before=before.outcome if before else None,
        after=after.outcome if after else None,
        error_before=before.measured if before else None,
        error_after=after.measured if after else None,
        unit=result.unit,
        ratio=change.ratio,
        reason=after.reason if after and after.outcome != "agrees" else "",
    )


def compare(before: Report, after: Report, factor: float = FACTOR) -> Comparison:
    """Pair the comparisons of two runs by scene, engine and check.

    An error that grew or shrank by less than ``factor`` (over 1) is unchanged, as is one that is under one rounding
    in both runs.
    """
    old, new = _keyed(before), _keyed(after)
    changes = [_change(old.get(key), result, factor) for key, result in new.items()]
    changes += [_change(result, None, factor) for key, result in old.items() if key not in new]
    return Comparison(before, after, tuple(changes), factor)


def _keyed(report: Report) -> dict[tuple[str, str, str, int], Result]:
    """Results by scene, engine, check, and the number of earlier results with the same three."""
    seen: Counter[tuple[str, str, str]] = Counter()
    found = {}
    for result in report.results:
        key = (result.scene, result.engine, result.check)
        found[(*key, seen[key])] = result
        seen[key] += 1
    return found


def _change(before: Result | None, after: Result | None, factor: float) -> Change:
    return Change(before, after, _mark(before, after, factor))


def _mark(before: Result | None, after: Result | None, factor: float) -> Mark:  # noqa: PLR0911
    if after is None:
        return "<"
    if after.outcome in BAD and (before is None or before.outcome != after.outcome):
        return "!"
    if before is None:
        return ">"
    if before.outcome in BAD and after.outcome == "agrees":
        return "*"
    if word(before) != word(after):
        return "~"
    if after.measured is None and before.measured is None:
        return " "
    if (
        before.unit != after.unit
        or before.allowed != after.allowed
        or after.measured is None
        or before.measured is None
    ):
        return "x"
    return _growth(abs(before.measured), abs(after.measured), 1.0 if after.unit == "ε" else 0.0, factor)


def _growth(before: float, after: float, floor: float, factor: float) -> Mark:
    before, after = max(before, floor), max(after, floor)
    if after > factor * before:
        return "+"
    return "-" if before > factor * after else " "


def _line(change: Change) -> str:
    result = change.result
    said = f"{result.scene} × {result.engine}, {result.check}: {_figures(change.before)} → {_figures(change.after)}"
    if change.ratio is not None:
        said += f" ({figure(change.ratio)} ×)"
    if change.after is not None and change.after.outcome != "agrees" and change.after.reason:
        said += f": {change.after.reason}"
    return one_line(said)


def _figures(result: Result | None) -> str:
    if result is None:
        return "none"
    if result.measured is None:
        return word(result)
    return f"{word(result)} {figure(result.measured)} {result.unit}".rstrip()
