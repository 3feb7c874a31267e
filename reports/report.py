"""A run that was read back, with the tables, counts and sentences that all renderings show."""

from __future__ import annotations

import math
import shlex
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from ..records.check import OUTCOMES, Diagnosis, EngineEntry, Footer, Header, Outcome, Result, SceneEntry
from ..records.exit_status import AGREES, DIFFERS, INCOMPLETE
from .words import count, few, figure, last_line

# The outcome of a cell with several checks is the first of these that occurs: a difference outweighs a failure, and one
# skipped check says little where others ran.
GRAVEST: tuple[Outcome, ...] = ("differs", "error", "agrees", "skipped")


@dataclass(frozen=True)
class TableCell:
    """All comparisons of one scene with one engine."""

    scene: str
    engine: str
    results: tuple[Result, ...]

    @cached_property
    def outcome(self) -> Outcome | None:
        """The gravest outcome; None where there is no result at all."""
        found = {result.outcome for result in self.results}
        return next((outcome for outcome in GRAVEST if outcome in found), None)

    @cached_property
    def worst(self) -> Result | None:
        """The result that decides: with the cell's outcome, and the largest error as a multiple of what is allowed."""
        deciding = [result for result in self.results if result.outcome == self.outcome]
        return max(deciding, key=_share_or_nothing, default=None)

    @property
    def share(self) -> float | None:
        """Worst error as a multiple of what is allowed; None where nothing was measured."""
        return share(self.worst) if self.worst else None

    @cached_property
    def rounding(self) -> float | None:
        """Worst error as a multiple of rounding [ε], over the checks that measure in it."""
        errors = [r.measured for r in self.results if r.unit == "ε" and r.measured is not None]
        return max(errors, default=None)

    @property
    def error(self) -> str:
        """The cell's one figure: in roundings where it agrees and some check measures in them, else in the allowed."""
        if self.outcome == "agrees" and self.rounding is not None:
            return f"{figure(self.rounding)} ε"
        if self.outcome in ("agrees", "differs") and self.share is not None:
            return f"{figure(self.share)} ×"
        return ""


@dataclass(frozen=True)
class Report:
    """A result stream: its header, its results in the order they came, and its footer if the run got that far."""

    header: Header
    results: tuple[Result, ...]
    footer: Footer | None = None
    diagnoses: tuple[Diagnosis, ...] = ()

    @property
    def complete(self) -> bool:
        """Whether the stream is whole: it has its footer, and the footer's counts are those of the results."""
        return self.footer is not None and self._counted == self.counts

    @cached_property
    def counts(self) -> Mapping[Outcome, int]:
        """Number of results of each outcome."""
        found = Counter(result.outcome for result in self.results)
        return {outcome: found[outcome] for outcome in OUTCOMES}

    @cached_property
    def kept(self) -> int:
        """Number of results that were taken from an earlier run with the very same inputs."""
        return sum(result.kept for result in self.results)

    @cached_property
    def scenes(self) -> tuple[str, ...]:
        """Names of the scenes: the header's in its order, then any that only results name."""
        return _in_order([scene.name for scene in self.header.scenes], (result.scene for result in self.results))

    @cached_property
    def engines(self) -> tuple[str, ...]:
        """Names of the engines: the header's in its order, then any that only results name."""
        return _in_order([engine.name for engine in self.header.engines], (result.engine for result in self.results))

    @cached_property
    def checks(self) -> tuple[str, ...]:
        """Names of the checks in the order in which they first came; last those that were never measured."""
        measured = [result.check for result in self.results if result.measured is not None]
        return _in_order(measured, (result.check for result in self.results))

    @cached_property
    def table(self) -> Mapping[tuple[str, str], TableCell]:
        """One cell for each scene and engine."""
        found: dict[tuple[str, str], list[Result]] = {}
        for result in self.results:
            found.setdefault((result.scene, result.engine), []).append(result)
        return {
            (scene, engine): TableCell(scene, engine, tuple(found.get((scene, engine), ())))
            for scene in self.scenes
            for engine in self.engines
        }

    @cached_property
    def unrun(self) -> tuple[TableCell, ...]:
        """Cells of the header's scenes and engines for which the stream has no result, not even a reason for none."""
        return tuple(
            cell
            for scene in self.header.scenes
            for engine in self.header.engines
            if not (cell := self.table[scene.name, engine.name]).results
        )

    @cached_property
    def flaws(self) -> tuple[str, ...]:
        """Why this is not a whole run, a sentence each; every rendering shows them. Empty for a whole run."""
        found = []
        if self.footer is None:
            found.append(
                "This run was cut off: its stream has no footer, so only the results before the cut are shown."
            )
        elif not self.complete:
            wrong = ", ".join(
                f"{outcome} {self._counted[outcome]} (found {self.counts[outcome]})"
                for outcome in OUTCOMES
                if self._counted[outcome] != self.counts[outcome]
            )
            found.append(f"This stream was altered or damaged: its footer does not count the results in it: {wrong}.")
        if self.footer is not None and self.unrun:
            first = self.unrun[0]
            found.append(
                f"{count(len(self.unrun), 'pair')} of scene and engine that should have run left no result, "
                f"the first {first.scene} × {first.engine}."
            )
        return tuple(found)

    @property
    def exit_status(self) -> int:
        """0: all planned comparisons ran and agree; 1: something differs; 3: something failed or is missing."""
        if self.counts["differs"]:
            return DIFFERS
        if self.counts["error"] or self.flaws:
            return INCOMPLETE
        return AGREES

    @cached_property
    def verdict(self) -> str:
        """One sentence for people: how many comparisons differ, failed, agree and were left out."""
        ran = self.counts["agrees"] + self.counts["differs"]
        if not ran and not self.counts["error"]:
            said = ["Nothing was compared"]
        elif self.counts["differs"]:
            said = [f"{self.counts['differs']:,} of {count(ran, 'comparison')} {_verb(self.counts['differs'])}"]
        else:
            said = [f"All {count(ran, 'comparison')} agree" if ran != 1 else "The one comparison agrees"]
            if not ran:
                said = ["No comparison finished"]
        if self.counts["error"]:
            said.append(f"{self.counts['error']:,} failed")
        if self.counts["skipped"]:
            said.append(f"{self.counts['skipped']:,} skipped, each with its reason")
        return ("Until the cut: " if self.footer is None else "") + "; ".join(said) + "."

    def having(self, *outcomes: Outcome) -> list[Result]:
        """The results with these outcomes, largest share of the allowed first."""
        chosen = [result for result in self.results if result.outcome in outcomes]
        return sorted(chosen, key=_share_or_nothing, reverse=True)

    def reasons(self, outcome: Outcome) -> list[tuple[str, list[Result]]]:
        """Each reason for this outcome, with the results that give it; the most frequent first."""
        found: dict[str, list[Result]] = {}
        for result in self.results:
            if result.outcome == outcome:
                found.setdefault(last_line(result.reason) or "no reason was given", []).append(result)
        return sorted(found.items(), key=lambda item: -len(item[1]))

    @cached_property
    def outliers(self) -> tuple[str, ...]:
        """Sentences: where only one engine differs from all others, or all engines differ from the equations.

        The equations and at least two engines vote on each scene and check. Any other split blames nobody.
        """
        votes: dict[tuple[str, str], dict[Outcome, list[str]]] = {}
        for result in self.results:
            votes.setdefault((result.scene, result.check), {}).setdefault(result.outcome, []).append(result.engine)
        lone: dict[str, list[str]] = {}
        for (scene, _), vote in votes.items():
            differing, agreeing = vote.get("differs", []), vote.get("agrees", [])
            if len(differing) == 1 and len(agreeing) >= 2:
                lone.setdefault(differing[0], []).append(scene)
            elif len(differing) >= 2 and not agreeing:
                lone.setdefault("", []).append(scene)
        return tuple(
            f"Only {engine} differs in {few(scenes, 'scene')}: the equations and the other engines agree."
            if engine
            else f"All engines differ from the equations in {few(scenes, 'scene')}."
            for engine, scenes in lone.items()
        )

    def scene(self, name: str) -> SceneEntry | None:
        """The header's entry of this scene; None where there is none."""
        return next((scene for scene in self.header.scenes if scene.name == name), None)

    def engine(self, name: str) -> EngineEntry | None:
        """The header's entry of this engine; None where there is none."""
        return next((engine for engine in self.header.engines if engine.name == name), None)

    def again(self, scene: str) -> str:
        """The command line that runs this scene again."""
        entry = self.scene(scene)
        words = ["furiko", "check", (entry.source if entry else "") or scene]
        return shlex.join([*words, "--profile", self.header.profile])

    @property
    def _counted(self) -> Mapping[Outcome, int]:
        if self.footer is None:
            return {}
        return {
            "agrees": self.footer.agrees,
            "differs": self.footer.differs,
            "skipped": self.footer.skipped,
            "error": self.footer.error,
        }


def share(result: Result) -> float | None:
    """Measured as a multiple of allowed: at most 1 agrees. Infinite for an error where none is allowed."""
    if result.measured is None or result.allowed is None:
        return None
    if result.allowed == 0:
        return math.inf if result.measured else 0.0
    return abs(result.measured / result.allowed)


def against(result: Result) -> str:
    """``2.3e9 ε against 160 ε allowed``; as much of it as was measured."""
    if result.measured is None:
        return ""
    said = f"{figure(result.measured)} {result.unit}".rstrip()
    if result.allowed is None:
        return said
    return f"{said} against {figure(result.allowed)} {result.unit}".rstrip() + " allowed"


def _share_or_nothing(result: Result) -> float:
    value = share(result)
    return -1.0 if value is None else value


def _in_order(first: Iterable[str], then: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys([*first, *then]))


def _verb(number: int) -> str:
    return "differs" if number == 1 else "differ"
