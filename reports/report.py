"""A run that was read back, with the tables, counts and sentences that all renderings show."""

from __future__ import annotations

import math
import shlex
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from ..records.check import (
    OUTCOMES,
    Advisable,
    Alone,
    Diagnosis,
    EngineEntry,
    Footer,
    Header,
    Outcome,
    Result,
    SceneEntry,
)
from ..records.exit_status import AGREES, DIFFERS, INCOMPLETE
from .advisable import advice_line, advisable_in
from .alone import alone_in
from .causes import Causes, CheckGroup, group_causes
from .words import WORDS, Word, count, few, figure, last_line, listed, one_line, tally, word

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
        return gravest(result.outcome for result in self.results)

    @cached_property
    def word(self) -> Word | None:
        """The outcome; ``loose`` where all that ran agrees and something only loosely."""
        loose = self.outcome == "agrees" and any(word(result) == "loose" for result in self.results)
        return "loose" if loose else self.outcome

    @cached_property
    def worst(self) -> Result | None:
        """The result that decides: with the cell's word, and the largest error as a multiple of what is allowed."""
        deciding = [result for result in self.results if word(result) == self.word]
        return max(deciding, key=_share_or_nothing, default=None)

    @property
    def share(self) -> float | None:
        """Worst error as a multiple of what is allowed; None where nothing was measured."""
        return share(self.worst) if self.worst else None

    @cached_property
    def rounding(self) -> float | None:
        """Worst error as a multiple of rounding [ε], over the checks that measure in it; of a loose cell, over its
        loose results."""
        deciding = [r for r in self.results if word(r) == "loose"] if self.word == "loose" else self.results
        return worst_rounding(deciding)

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
    """A result stream: its header, its results in the order they came, its footer if the run got that far, and its
    diagnoses. ``altered``: the stream that was read is not the one that the run wrote."""

    header: Header
    results: tuple[Result, ...]
    footer: Footer | None = None
    diagnoses: tuple[Diagnosis, ...] = ()
    altered: bool = False

    @property
    def complete(self) -> bool:
        """Whether the stream is whole: its footer has the counts and the digest of its lines, none of them twice."""
        return self.footer is not None and not self._miscounted and not self.repeated and not self.altered

    @cached_property
    def repeated(self) -> tuple[Result, ...]:
        """Results that are in the stream twice, the same to the last digit: no run writes one twice."""
        first: dict[tuple[object, ...], Result] = {}
        again = []
        for result in self.results:
            key = (result.scene, result.engine, result.check, result.outcome, result.measured, result.seconds)
            if key not in first:
                first[key] = result
            elif repr(first[key]) == repr(result):
                again.append(result)
        return tuple(again)

    @cached_property
    def counts(self) -> Mapping[Outcome, int]:
        """Number of results of each outcome."""
        found = Counter(result.outcome for result in self.results)
        return {outcome: found[outcome] for outcome in OUTCOMES}

    @cached_property
    def words(self) -> Mapping[Word, int]:
        """Number of results of each word, the gravest first. Loose results are not among those that agree."""
        found = Counter(word(result) for result in self.results)
        return {name: found[name] for name in WORDS}

    @cached_property
    def loose(self) -> tuple[Result, ...]:
        """The results that agree only loosely, the largest multiple of the sharp line first."""
        found = [result for result in self.results if word(result) == "loose"]
        return tuple(sorted(found, key=_of_line, reverse=True))

    @cached_property
    def causes(self) -> Causes:
        """The differences, by engine and cause."""
        return group_causes(self.having("differs"), self.diagnoses)

    @cached_property
    def kept(self) -> int:
        """Number of results that were taken from an earlier run with the very same inputs."""
        return sum(result.kept for result in self.results)

    @property
    def untested(self) -> tuple[str, ...]:
        """A sentence for each installed version that furiko was not tested with."""
        return tuple(dict.fromkeys(engine.untested for engine in self.header.engines if engine.untested))

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
        elif self._miscounted:
            wrong = ", ".join(f"{name} {said} (found {found})" for name, said, found in self._miscounted)
            found.append(f"This stream was altered or damaged: its footer does not count the lines in it: {wrong}.")
        if self.repeated:
            first = self.repeated[0]
            found.append(
                f"This stream was altered or damaged: {count(len(self.repeated), 'result')} in it twice, "
                f"the first {_place(first.scene, first.engine)}, {one_line(first.check, 80)}."
            )
        if self.altered and not found:
            found.append(
                "This stream was altered or damaged: its lines are not those that the run wrote; the digest in its "
                "footer is of others."
            )
        if self.footer is not None and self.unrun:
            pair = self.unrun[0]
            found.append(
                f"{count(len(self.unrun), 'pair')} of scene and engine that should have run left no result, "
                f"the first {_place(pair.scene, pair.engine)}."
            )
        return (*found, *self._nothing_compared)

    @cached_property
    def _nothing_compared(self) -> tuple[str, ...]:
        """Why a run of which everything was skipped proves nothing: the whole of it, or what the user named."""
        if self.counts["error"] and not self._ran:
            return ()  # the failures say it
        if not self._ran:
            return ("No comparison was made, so this run proves nothing.",)
        scenes = [scene.name for scene in self.header.scenes if scene.asked]
        engines = [engine.name for engine in self.header.engines if engine.asked]
        cells = self.table.values()
        return tuple(
            f"{one_line(name, 80)} was asked for, and nothing of it was compared: each check was skipped."
            for names, field in ((scenes, "scene"), (engines, "engine"))
            for name in names
            if all(cell.outcome == "skipped" for cell in cells if getattr(cell, field) == name)
        )

    @property
    def _ran(self) -> int:
        return self.counts["agrees"] + self.counts["differs"]

    @property
    def exit_status(self) -> int:
        """0: all planned comparisons ran and agree; 1: something differs; 3: something failed or is missing."""
        return self.exit_status_of(sharp=False)

    def exit_status_of(self, sharp: bool) -> int:
        """The exit status; ``sharp``: a loose result counts as one that differs."""
        if self.counts["differs"] or (sharp and self.words["loose"]):
            return DIFFERS
        if self.counts["error"] or self.flaws:
            return INCOMPLETE
        return AGREES

    @cached_property
    def verdict(self) -> str:
        """One sentence for people: how many comparisons differ, failed, are loose, agree and were left out."""
        words, ran = self.words, self._ran
        said: list[str] = []
        if words["differs"]:
            said.append(f"{words['differs']:,} of {count(ran, 'comparison')} {_verb(words['differs'])}")
        if words["error"]:
            said.append(f"{words['error']:,} failed" if said else f"{count(words['error'], 'comparison')} failed")
        if words["loose"]:
            number, be = words["loose"], "is" if words["loose"] == 1 else "are"
            said.append(f"{number:,} {be} loose" if said else f"{number:,} of {count(ran, 'comparison')} {be} loose")
        if not ran:
            said.append("nothing was compared")
        elif words["agrees"] and not said and not self.flaws:
            said.append(f"all {words['agrees']:,} comparisons agree" if ran > 1 else "the one comparison agrees")
        elif words["agrees"]:
            said.append(tally(words["agrees"], "agrees"))
        if words["skipped"]:
            said.append(f"{words['skipped']:,} skipped, each with its reason")
        text = "; ".join(said) + "."
        if self.footer is None:
            return f"Until the cut: {text}"
        return f"Incomplete: {text}" if ran and self.flaws else text[:1].upper() + text[1:]

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
    def alone(self) -> tuple[Alone, ...]:
        """Of each scene with a user's own equations: which of them, the model and the engines is alone."""
        return alone_in(self)

    @cached_property
    def advisable(self) -> tuple[Advisable, ...]:
        """The scenes of which ``furiko advise`` has more to say."""
        return advisable_in(self)

    @property
    def advice(self) -> str:
        """Where it has, one sentence that says so and what to type; else empty."""
        return advice_line(self.advisable)

    @cached_property
    def outliers(self) -> tuple[str, ...]:
        """Sentences: where only one engine differs from all others, or all engines differ from the equations.

        The equations and at least two engines vote on each scene and check. Any other split blames nobody, and an
        engine is no scene's only one where another differs in another check. Of scenes with a user's own equations the
        sentences are those of :attr:`alone`.
        """
        own = {alone.scene for alone in self.alone}
        votes: dict[tuple[str, str], dict[Outcome, list[str]]] = {}
        blamed: dict[str, set[str]] = {}  # the engines that differ in a scene, whatever the check
        for result in self.results:
            if result.scene not in own:
                votes.setdefault((result.scene, result.check), {}).setdefault(result.outcome, []).append(result.engine)
                if result.outcome == "differs":
                    blamed.setdefault(result.scene, set()).add(result.engine)
        lone: dict[str, list[str]] = {}
        for (scene, _), vote in votes.items():
            differing, agreeing = vote.get("differs", []), vote.get("agrees", [])
            if len(differing) == 1 and len(agreeing) >= 2 and len(blamed[scene]) == 1:
                lone.setdefault(differing[0], []).append(scene)
            elif len(differing) >= 2 and not agreeing:
                lone.setdefault("", []).append(scene)
        return tuple(alone.says for alone in self.alone) + tuple(
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
        """The command line that runs this scene again, on all engines, and keeps nothing of an earlier run."""
        entry = self.scene(scene)
        words = ["furiko", "check", (entry.source if entry else "") or scene]
        return shlex.join([*words, "--profile", self.header.profile, "--no-cache"])

    @staticmethod
    def engine_option(engine: str) -> str:
        """What to write behind :meth:`again` for one engine alone."""
        return shlex.join(["-e", engine])

    @cached_property
    def _miscounted(self) -> tuple[tuple[str, int, int], ...]:
        """The footer's counts that are not those of the stream: name, the footer's number, the number found."""
        if self.footer is None:
            return ()
        found = footer_of(self.results, self.diagnoses)
        names = (*OUTCOMES, "loose", "diagnoses")
        pairs = [(name, getattr(self.footer, name), getattr(found, name)) for name in names]
        return tuple(pair for pair in pairs if pair[1] != pair[2])


def footer_of(results: Iterable[Result], diagnoses: Sequence[Diagnosis] = (), seconds: float = 0.0) -> Footer:
    """The footer of a run with these results and diagnoses that took so many seconds."""
    found = Counter(word(result) for result in results)
    return Footer(
        agrees=found["agrees"] + found["loose"],
        differs=found["differs"],
        skipped=found["skipped"],
        error=found["error"],
        loose=found["loose"],
        diagnoses=len(diagnoses),
        seconds=seconds,
    )


def gravest(outcomes: Iterable[Outcome]) -> Outcome | None:
    """The gravest of these outcomes; None where there is none."""
    found = set(outcomes)
    return next((outcome for outcome in GRAVEST if outcome in found), None)


def worst_rounding(results: Iterable[Result]) -> float | None:
    """The largest error as a multiple of rounding [ε]; None where none is measured in it."""
    return max((r.measured for r in results if r.unit == "ε" and r.measured is not None), default=None)


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


def against_line(result: Result) -> str:
    """``1,800 ε, rounding gives at most 12 ε``; as much of it as was measured, and the bound where there is no line."""
    if result.measured is None or result.line is None:
        return against(result)
    line = f"{figure(result.line)} {result.unit}".rstrip()
    return f"{figure(result.measured)} {result.unit}".rstrip() + f", rounding gives at most {line}"


def group_line(group: CheckGroup) -> str:
    """One engine and one check: where its largest error is, how large, why, and in which scenes there are others."""
    worst = group.results[0]
    scenes = list(dict.fromkeys(result.scene for result in group.results))
    said = f"{worst.scene} × {worst.engine}, {worst.check}"
    if worst.measured is not None:
        said += f": {against_line(worst) if word(worst) == 'loose' else against(worst)}"
    if worst.reason:
        said += f": {last_line(worst.reason)}"
    if len(group.results) > 1:
        said += f"; the largest of {len(group.results):,} in {count(len(scenes), 'scene')}: {listed(scenes)}"
    return one_line(said)


def _of_line(result: Result) -> float:
    """Error as a multiple of the sharp line, of what is allowed where there is no line."""
    if result.measured is None or not result.line:
        return _share_or_nothing(result)
    return abs(result.measured / result.line)


def _share_or_nothing(result: Result) -> float:
    value = share(result)
    return -1.0 if value is None else value


def _in_order(first: Iterable[str], then: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys([*first, *then]))


def _verb(number: int) -> str:
    return "differs" if number == 1 else "differ"


def _place(scene: str, engine: str) -> str:
    return f"{one_line(scene, 80)} × {one_line(engine, 80)}"
