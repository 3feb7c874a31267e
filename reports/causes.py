"""Results that differ, grouped by engine and cause: each cause once, with the scenes and results that it explains."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from ..records.check import Diagnosis, Result
from ..records.findings import Difference
from .words import count, last_line, listed, one_line

UNEXPLAINED = "unexplained"
SAME_RATIO = 1e-6  # relative: measured / expected of one cause in several places
MOST_SENTENCES = 12  # of one cause; the page lists all

Found = tuple[str, Difference]  # a scene, and what was found in it
Key = tuple[str, frozenset[str], frozenset[str]]  # engine, codes that hold together, codes that are alternatives


@dataclass(frozen=True)
class Cause:
    """One cause in one engine: all places and scenes where it was found."""

    engine: str
    code: str
    found: tuple[Found, ...]

    @cached_property
    def every(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """Each sentence that was found, with its scenes; one sentence for one place and one pair of values."""
        said: dict[tuple[object, ...], tuple[str, list[str]]] = {}
        for scene, finding in self.found:
            key = (
                finding.where,
                *map(_rounded, (finding.measured, finding.expected)),
                "" if finding.where else finding,
            )
            said.setdefault(key, (_sentence(finding, self.engine), []))[1].append(scene)
        return tuple((sentence, tuple(dict.fromkeys(scenes))) for sentence, scenes in said.values())

    @cached_property
    def sentences(self) -> tuple[str, ...]:
        """The same in few sentences: one for each place, one for all places where the ratio of the values is one."""
        if len(self.every) == 1:
            return (self.every[0][0],)
        places = list(dict.fromkeys(finding.where for _, finding in self.found))
        ratio = _common_ratio([finding for _, finding in self.found])
        if ratio is not None:
            where = "" if places in ([self.engine], [""]) else f", at {count(len(places), 'place')}: {listed(places)}"
            return (f"{ratio:.9g} times the expected value{where}",)
        said = [self._of_place(place) for place in places]
        left = len(said) - MOST_SENTENCES
        return tuple(said) if left <= 0 else (*said[:MOST_SENTENCES], f"and {left} more places; the report lists all")

    def _of_place(self, place: str) -> str:
        found = [(scene, finding) for scene, finding in self.found if finding.where == place]
        values = {(_rounded(finding.measured), _rounded(finding.expected), finding.says) for _, finding in found}
        scene, first = found[0]
        said = _sentence(first, self.engine)
        others = len({name for name, _ in found} - {scene})
        if len({value[:2] for value in values}) == 1 and (place or len(values) == 1):
            return said
        also = f"; with other values in {count(others, 'other scene')}" if others else "; with other values besides"
        return f"{said} (in {one_line(scene, 80)}{also})"


@dataclass(frozen=True)
class Explanation:
    """Causes that explain differences of one engine together, in all scenes where these same causes were found.

    ``together``: all of them hold; ``alternatives``: one of them holds besides; ``explained``: the results that they
    explain, largest error first; ``differing``: number of results of this engine that differ.
    """

    engine: str
    together: tuple[Cause, ...]
    alternatives: tuple[Cause, ...]
    explained: tuple[Result, ...]
    differing: int

    @cached_property
    def scenes(self) -> tuple[str, ...]:
        """The scenes in which these causes were found."""
        return tuple(dict.fromkeys(scene for c in (*self.together, *self.alternatives) for scene, _ in c.found))

    @property
    def coverage(self) -> str:
        """How many differences it explains, in words."""
        inside = count(len(self.scenes), "scene")
        if not self.explained:
            return f"explains none of {count(self.differing, 'difference')}; found in {inside}"
        return f"explains {len(self.explained):,} of {count(self.differing, 'difference')} in {inside}"

    @property
    def headline(self) -> str:
        """Engine, causes, and how much they explain, in one line."""
        engine = one_line(self.engine, 80)
        codes = " and ".join(one_line(cause.code, 80) for cause in self.together)
        if len(self.together) == 1 and not self.alternatives and len(self.together[0].sentences) == 1:
            said = f"{one_line(self.together[0].sentences[0])} [{codes}]"
        elif len(self.together) == 1 and not self.alternatives:
            said = f"{codes}, at several places"
        elif self.alternatives and self.together:
            said = f"{codes}, and one of {len(self.alternatives)} further causes"
        elif self.alternatives:
            said = f"one of {count(len(self.alternatives), 'cause')}; the measurements cannot tell which"
        else:
            said = f"{codes}, {'both' if len(self.together) == 2 else 'all'} together"
        return f"{engine}: {said}: {self.coverage}"

    @property
    def detailed(self) -> bool:
        """Whether there is more to list than the headline and the lines say."""
        return any(len(cause.every) > 1 for cause in (*self.together, *self.alternatives))

    @property
    def lines(self) -> list[str]:
        """Each cause with its sentences, alternatives last; none where the headline says it all."""
        if len(self.together) == 1 and not self.alternatives and len(self.together[0].sentences) == 1:
            return []
        said = [_coded(cause.code, sentence) for cause in self.together for sentence in cause.sentences]
        for i, cause in enumerate(self.alternatives):
            said += [f"{'or' if i else 'either'} {_coded(cause.code, sentence)}" for sentence in cause.sentences]
        return [one_line(line) for line in said]

    @property
    def in_words(self) -> str:
        """The causes in one line, for a reader that has room for no more."""
        lines = self.lines or [_coded(cause.code, cause.sentences[0]) for cause in self.together]
        return one_line("; ".join(lines))


@dataclass(frozen=True)
class CheckGroup:
    """Results of one engine and one check, largest error first."""

    engine: str
    check: str
    results: tuple[Result, ...]


@dataclass(frozen=True)
class Causes:
    """``explanations``: most explained first, engine by engine; ``unexplained``: what they leave; ``remarks``: what the
    diagnoses say of it: engine, sentence, scenes."""

    explanations: tuple[Explanation, ...]
    unexplained: tuple[CheckGroup, ...]
    remarks: tuple[tuple[str, str, tuple[str, ...]], ...]

    def explanation_of(self, result: Result) -> Explanation | None:
        """The explanation of a result that differs; None where there is none."""
        return self._by_result.get(id(result))

    @cached_property
    def _by_result(self) -> dict[int, Explanation]:
        return {id(result): explanation for explanation in self.explanations for result in explanation.explained}


def group_causes(differing: Sequence[Result], diagnoses: Sequence[Diagnosis]) -> Causes:
    """Group results that differ (largest error first) by engine and cause.

    A result belongs to the diagnosis of its scene and engine that explains its check; failing that, to its own
    ``cause``; failing that, it is unexplained.
    """
    found: dict[Key, list[Diagnosis]] = {}
    owner: dict[tuple[str, str, str], Key] = {}
    for diagnosis in map(_known, diagnoses):
        if diagnosis.findings or diagnosis.alternatives:
            key = _key(diagnosis)
            found.setdefault(key, []).append(diagnosis)
            for check in diagnosis.explains:
                owner.setdefault((diagnosis.scene, diagnosis.engine, check), key)
    explained: dict[Key, list[Result]] = {}
    left: list[Result] = []
    for result in differing:
        owned = owner.get((result.scene, result.engine, result.check))
        if owned is None and result.cause and result.cause != UNEXPLAINED:
            alone = _of_result(result, result.cause)
            owned = _key(alone)
            found.setdefault(owned, []).append(alone)
        if owned is None:
            left.append(result)
        else:
            explained.setdefault(owned, []).append(result)
    number = {engine: sum(r.engine == engine for r in differing) for engine, _, _ in found}
    explanations = [_explanation(key, of_key, explained.get(key, []), number[key[0]]) for key, of_key in found.items()]
    engines = list(dict.fromkeys(e.engine for e in explanations))
    explanations.sort(key=lambda e: (engines.index(e.engine), -len(e.explained)))
    return Causes(tuple(explanations), group_by_check(left), _remarks(diagnoses))


def group_by_check(results: Iterable[Result]) -> tuple[CheckGroup, ...]:
    """Results (largest error first) by engine and check."""
    found: dict[tuple[str, str], list[Result]] = {}
    for result in results:
        found.setdefault((result.engine, result.check), []).append(result)
    return tuple(CheckGroup(engine, check, tuple(of_check)) for (engine, check), of_check in found.items())


def _known(diagnosis: Diagnosis) -> Diagnosis:
    """The diagnosis without what it could not explain."""
    return Diagnosis(
        scene=diagnosis.scene,
        engine=diagnosis.engine,
        findings=[f for f in diagnosis.findings if f.cause != UNEXPLAINED],
        alternatives=[f for f in diagnosis.alternatives if f.cause != UNEXPLAINED],
        explains=diagnosis.explains,
    )


def _key(diagnosis: Diagnosis) -> Key:
    together, either = ({f.cause for f in fs} for fs in (diagnosis.findings, diagnosis.alternatives))
    return diagnosis.engine, frozenset(together), frozenset(either)


def _of_result(result: Result, cause: str) -> Diagnosis:
    """A diagnosis for a result that carries only the code of its cause; its reason may end with the sentence."""
    reason = last_line(result.reason)
    _, _, sentence = reason.partition(f"; {cause}: ")
    says = sentence or reason
    finding = Difference(cause=cause, where="", measured=None, expected=None, says=says)
    return Diagnosis(scene=result.scene, engine=result.engine, findings=[finding], explains=[result.check])


def _explanation(key: Key, diagnoses: Sequence[Diagnosis], explained: Sequence[Result], number: int) -> Explanation:
    engine = key[0]
    together = _causes(engine, ((d.scene, f) for d in diagnoses for f in d.findings))
    alternatives = _causes(engine, ((d.scene, f) for d in diagnoses for f in d.alternatives))
    return Explanation(engine, together, alternatives, tuple(explained), number)


def _causes(engine: str, found: Iterable[Found]) -> tuple[Cause, ...]:
    by_code: dict[str, list[Found]] = {}
    for scene, finding in found:
        by_code.setdefault(finding.cause, []).append((scene, finding))
    return tuple(Cause(engine, code, tuple(of_code)) for code, of_code in by_code.items())


def _remarks(diagnoses: Sequence[Diagnosis]) -> tuple[tuple[str, str, tuple[str, ...]], ...]:
    said: dict[tuple[str, str], list[str]] = {}
    for diagnosis in diagnoses:
        for finding in (*diagnosis.findings, *diagnosis.alternatives):
            if finding.cause == UNEXPLAINED:
                sentence = _sentence(finding, diagnosis.engine)
                said.setdefault((diagnosis.engine, sentence), []).append(diagnosis.scene)
    return tuple((engine, sentence, tuple(scenes)) for (engine, sentence), scenes in said.items())


def _sentence(finding: Difference, engine: str) -> str:
    """The finding, without the engine's name, which the entry begins with."""
    if finding.says:
        return finding.says.removeprefix(f"{engine}: ").removeprefix(f"{engine} ")
    values = f"{_rounded(finding.measured)}, expected {_rounded(finding.expected)}"
    return f"{finding.where} is {values}" if finding.where not in ("", engine) else values


def _coded(code: str, sentence: str) -> str:
    """The sentence behind its code, unless it begins with that word: "gravity: found …", "length of link 1 …"."""
    return sentence if re.match(rf"{re.escape(code)}\b(?!-)", sentence) else f"{code}: {sentence}"


def _common_ratio(findings: Sequence[Difference]) -> float | None:
    """measured / expected where it is the same in all findings; None where it is not, or one of them has no ratio."""
    ratios = []
    for finding in findings:
        measured, expected = finding.measured, finding.expected
        if not isinstance(measured, int | float) or not isinstance(expected, int | float) or not measured * expected:
            return None
        ratios.append(measured / expected)
    first = ratios[0]
    return first if all(math.isclose(ratio, first, rel_tol=SAME_RATIO) for ratio in ratios) else None


def _rounded(value: float | str | None) -> str:
    return f"{value:.9g}" if isinstance(value, int | float) else str(value)
