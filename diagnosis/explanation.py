"""An explanation: the causes that hold together, the alternatives among them, and what they were tested on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from .finding import Finding

UNEXPLAINED = "unexplained"
Key = tuple[str, str]


@dataclass(frozen=True)
class Explanation:
    """``sets``: sets of findings. All findings of a set hold together, and each set explains as much as any other, so
    that a single set is certain and several are alternatives. Empty: nothing differs."""

    sets: tuple[tuple[Finding, ...], ...] = ()

    def __bool__(self) -> bool:
        return bool(self.sets)

    @property
    def explained(self) -> bool:
        """Whether a cause was found."""
        return bool(self.sets) and all(finding.cause != UNEXPLAINED for finding in self.all)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The findings of every set: these hold together, and are certain."""
        if not self.sets:
            return ()
        others = [{_key(finding) for finding in other} for other in self.sets[1:]]
        return tuple(finding for finding in self.sets[0] if all(_key(finding) in other for other in others))

    @property
    def alternatives(self) -> tuple[Finding, ...]:
        """The findings in which the sets differ, an entry each: one of these holds besides :attr:`findings`."""
        if len(self.sets) < 2:
            return ()
        common = {_key(finding) for finding in self.findings}
        left = [[finding for finding in each if _key(finding) not in common] for each in self.sets]
        return tuple(_unique(_joined(each) for each in left if each))

    @property
    def all(self) -> tuple[Finding, ...]:
        """Every finding once, the likeliest set's first. Those that are not certain say so."""
        certain = {_key(finding) for finding in self.findings}
        every = list(_unique(finding for each in self.sets for finding in each))
        others = len(self.sets) - 1
        note = f"; {others} other cause{'s' * (others > 1)} would explain it equally well"
        return tuple(f if _key(f) in certain else replace(f, says=f.says + note) for f in every)


def together(findings: Sequence[Finding]) -> Explanation:
    """All of the findings hold."""
    return Explanation((tuple(findings),)) if findings else Explanation()


def one_of(findings: Sequence[Finding]) -> Explanation:
    """One of the findings holds."""
    return Explanation(tuple((finding,) for finding in findings))


def with_more(explanation: Explanation, before: Sequence[Finding]) -> Explanation:
    """The explanation, with these findings in every set, first."""
    return Explanation(tuple((*before, *each) for each in explanation.sets))


def _key(finding: Finding) -> Key:
    return finding.cause, finding.where


def _unique(findings: Iterator[Finding]) -> Iterator[Finding]:
    seen: set[Key] = set()
    for finding in findings:
        if _key(finding) not in seen:
            seen.add(_key(finding))
            yield finding


def _joined(findings: list[Finding]) -> Finding:
    """Several findings that hold together, as one alternative."""
    if len(findings) == 1:
        return findings[0]
    places = ", ".join(dict.fromkeys(finding.where for finding in findings))
    says = "; together with: ".join(finding.says for finding in findings)
    return Finding(findings[0].cause, places, None, None, says)
