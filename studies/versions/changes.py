"""Which release changed what: the looks of releases held against each other, and the releases still to be looked at."""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...records.versions import ChangeKind, LookKind
from .looks import Look

EPSILON = 2.0**-52
TINY = 1e-12  # numbers of the scenes and files are near one: what is less has come from rounding
_NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]?\d+)?")
Looks = Mapping[tuple[str, LookKind], Look]  # by probe and kind


@dataclass(frozen=True)
class Change:
    """``release`` gives another answer than ``before``, the release that was looked at before it.

    ``kind``: ``verdict``: another outcome or another cause; ``values``: numbers that rounding does not explain;
    ``rounding``: other last digits; ``says``: in a sentence.
    """

    probe: str
    of: LookKind
    before: str
    release: str
    kind: ChangeKind
    says: str


def next_to_look_at(releases: Sequence[str], known: Mapping[str, Looks]) -> list[str]:
    """The releases in the middle between neighbours that differ; none where every change has its release.

    ``releases``: oldest first; ``known``: the looks at some of them, the first and the last among them.
    """
    found = []
    at = [i for i, release in enumerate(releases) if release in known]
    for first, last in itertools.pairwise(at):
        if last - first > 1 and changes_between(releases[first], releases[last], known):
            found.append(releases[(first + last) // 2])
    return found


def all_changes(releases: Sequence[str], known: Mapping[str, Looks]) -> list[Change]:
    """Every change between neighbours among the releases that were looked at, in their order."""
    looked = [release for release in releases if release in known]
    return [change for before, after in itertools.pairwise(looked) for change in changes_between(before, after, known)]


def changes_between(before: str, after: str, known: Mapping[str, Looks]) -> list[Change]:
    """What ``after`` answers otherwise than ``before``."""
    old, new = known[before], known[after]
    found = []
    for key in dict.fromkeys([*old, *new]):
        if key not in old or key not in new:
            says = "is asked for the first time" if key in new else "is asked no more"
            found.append(Change(*key, before, after, "verdict", says))
        elif change := _between(old[key], new[key]):
            found.append(Change(*key, before, after, *change))
    return found


def _rounded(says: str) -> str:
    """A sentence with its numbers to three digits, so that last digits alone are no other verdict."""

    def short(found: re.Match[str]) -> str:
        value = float(found.group())
        return "0" if abs(value) < TINY else f"{value:.3g}"

    return _NUMBER.sub(short, says)


def _between(old: Look, new: Look) -> tuple[ChangeKind, str] | None:
    if (old.outcome, _rounded(old.says)) != (new.outcome, _rounded(new.says)):
        was = f"{old.outcome}{f' ({old.says})' if old.says else ''}"
        return "verdict", f"{was} before; now {new.outcome}{f' ({new.says})' if new.says else ''}"
    if old.digest == new.digest:
        return None
    if old.answer.shape != new.answer.shape:
        return "values", f"{old.answer.size} numbers before, {new.answer.size} now"
    size = max(float(np.abs(old.answer).max(initial=0.0)), float(np.abs(new.answer).max(initial=0.0)), 1e-300)
    apart = float(np.abs(old.answer - new.answer).max(initial=0.0)) / size
    if not np.isfinite(apart):
        return "values", "numbers that are none"
    several = f"{apart / EPSILON:.2g} ε of the largest number"
    # Both were held against the theory: what is left is by how much they are apart.
    return "rounding", f"other last digits, up to {several}"
