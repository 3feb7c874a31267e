"""Releases of one engine, each in an environment of its own, held against the theory and against each other."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from . import __version__
from .engines import all_of, engine_info, why_missing
from .engines.places.index import NoIndex, releases
from .engines.releases import release
from .engines.workers.isolated import Call, NotReturned, call_isolated
from .models import EngineMissing, InvalidInput
from .records import provenance
from .records.check import Outcome, Result
from .records.versions import VersionChange, VersionLook, VersionRow, VersionsDocument
from .run import check
from .studies.versions.changes import Looks, all_changes, next_to_look_at
from .studies.versions.looks import SCENES, Look, look

LIMIT = 300.0  # [s] for all looks at one release
AT_ONCE = 2  # releases that are looked at side by side
GRAVEST: tuple[Outcome, ...] = ("error", "differs", "agrees", "skipped")
Watch = Callable[[str], object]


def versions(
    engine: str,
    first: str | None = None,
    last: str | None = None,
    *,
    every: bool = False,
    scenes: Sequence[str] = SCENES,
    watch: Watch = lambda _: None,
) -> VersionsDocument:
    """Look at the releases of an engine from ``first`` to ``last``, and find the ones that changed something.

    ``engine``: an engine's name, or a package's for all its formulations; ``every``: look at every release, else at the
    first, the last, and those between that bisection leads to; ``scenes``: names from the catalogue; ``watch`` is
    called with what is being done. Raises :class:`InvalidInput` for a name or a range that is none,
    :class:`EngineMissing` where the index says nothing.
    """
    begun = time.monotonic()
    names = all_of([engine])
    infos = [engine_info(name) for name in names]
    package = infos[0].package
    if not package or any("@" in name or ":" in name or "/" in name for name in names):
        raise InvalidInput(f"engine: {engine}: an engine with a package is needed, as furiko engines lists them")
    known = _in_range(package, first, last)
    study = _Study(names, known, scenes, watch)
    study.look_at(list(known) if every else [next(iter(known)), list(known)[-1]])
    while not every and (wanted := study.wanted()):
        study.look_at(wanted)
    return VersionsDocument(
        furiko=__version__,
        started=provenance.now(),
        command=provenance.command(),
        machine=provenance.machine(),
        engines=names,
        package=package,
        every=every,
        releases=study.rows(),
        changes=study.changes(),
        seconds=time.monotonic() - begun,
    )


def _in_range(package: str, first: str | None, last: str | None) -> dict[str, str]:
    """Releases and what installs them. A bound need not be a release; one that is a prefix has all that begin so."""
    try:
        known = releases(package)
    except NoIndex as error:
        raise EngineMissing(str(error)) from None
    for bound in (first, last):
        if bound is not None and not release(bound):
            raise InvalidInput(f"{bound!r} is no version: write it in numbers, as 3.3.7")
    low, high = release(first or "0"), release(last) if last else ()
    found = {
        one: by for one, by in known.items() if low <= release(one) and (not high or release(one)[: len(high)] <= high)
    }
    if len(found) < 2:
        there = f"; there are {', '.join(known)}" if known else ""
        raise InvalidInput(
            f"{package}: two releases are needed from {first or 'the first'} to {last or 'the last'}{there}"
        )
    return found


@dataclass
class _Study:
    """What is known so far. ``known``: by engine and release the looks; ``missing``: by release why there are none."""

    names: Sequence[str]
    releases: dict[str, str]
    scenes: Sequence[str]
    watch: Watch
    known: dict[str, dict[str, Looks]] = field(default_factory=dict)
    missing: dict[str, str] = field(default_factory=dict)

    def wanted(self) -> list[str]:
        """The releases that bisection leads to next; those that cannot be had are passed over."""
        there = [one for one in self.releases if one not in self.missing]
        found: set[str] = set()
        for name in self.names:
            found |= set(next_to_look_at(there, self.known.get(name, {})))
        return [one for one in there if one in found]

    def look_at(self, wanted: Sequence[str]) -> None:
        """Look at these releases, in all engines."""
        there = []
        for version in wanted:
            self.watch(f"environment of {version}")
            why = why_missing(f"{self.names[0]}@{version}")
            if why:
                self.missing[version] = why
            else:
                there.append(version)
        places = [(name, version) for version in there for name in self.names]
        for at in range(0, len(places), AT_ONCE):
            some = places[at : at + AT_ONCE]
            self.watch(f"{', '.join(dict.fromkeys(version for _, version in some))}: answers and files")
            answers = call_isolated([Call(look, (f"{name}@{version}", self.scenes)) for name, version in some], LIMIT)
            for (name, version), answer in zip(some, answers, strict=True):
                self._take(name, version, answer)
        if places:
            self.watch(f"{', '.join(there)}: the theory")
            self._theory(places)

    def _take(self, name: str, version: str, answer: list[Look] | NotReturned) -> None:
        if isinstance(answer, NotReturned):
            answer = [Look("all", "accelerations", "error", answer.reason, "", np.zeros(0))]
        self.known.setdefault(name, {})[version] = {(one.probe, one.kind): one for one in answer}

    def _theory(self, places: Sequence[tuple[str, str]]) -> None:
        engines = [f"{name}@{version}" for name, version in places]
        report = check(self.scenes, engines, profile="quick")
        for name, version in places:
            mine = [result for result in report.results if result.engine == f"{name}@{version}"]
            judged: Looks = {(scene, "theory"): _verdict(scene, mine) for scene in self.scenes}
            self.known[name][version] = {**self.known[name][version], **judged}

    def rows(self) -> list[VersionRow]:
        """All releases, those that were not looked at as well."""
        return [self._row(version, package) for version, package in self.releases.items()]

    def _row(self, version: str, package: str) -> VersionRow:
        looks = list(self._looks(version))
        why = self.missing.get(version, "")
        return VersionRow(version=version, package=package, looked_at=bool(looks), missing=why, looks=looks)

    def _looks(self, version: str) -> Iterator[VersionLook]:
        for name in self.names:
            for one in self.known.get(name, {}).get(version, {}).values():
                yield VersionLook(
                    engine=name, probe=one.probe, of=one.kind, outcome=one.outcome, says=one.says, digest=one.digest
                )

    def changes(self) -> list[VersionChange]:
        """Every change, in the order of the releases, the gravest of a release first."""
        order = list(self.releases)
        found = []
        for name in self.names:
            for change in all_changes(order, self.known.get(name, {})):
                between = order.index(change.release) - order.index(change.before) - 1
                found.append(
                    VersionChange(
                        engine=name,
                        probe=change.probe,
                        of=change.of,
                        before=change.before,
                        release=change.release,
                        between=between,
                        kind=change.kind,
                        says=change.says,
                    )
                )
        graver = ["verdict", "values", "rounding"]
        return sorted(found, key=lambda change: (order.index(change.release), graver.index(change.kind)))


def _verdict(scene: str, results: Sequence[Result]) -> Look:
    """The checks' verdict on one scene: the gravest outcome, with the causes or reasons of what is so."""
    mine = [result for result in results if result.scene == scene]
    outcomes: list[Outcome] = [result.outcome for result in mine] or ["skipped"]
    outcome = min(outcomes, key=GRAVEST.index)
    if outcome == "agrees":
        return Look(scene, "theory", "agrees", "", "", np.zeros(0))
    if outcome == "skipped":
        return Look(scene, "theory", outcome, "", "", np.zeros(0))  # why is told where the answers are
    same = [result for result in mine if result.outcome == outcome]
    told = [r.check + (f" ({r.cause})" if r.cause else f": {r.reason}" if outcome != "differs" else "") for r in same]
    return Look(scene, "theory", outcome, "; ".join(dict.fromkeys(told))[:400], "", np.zeros(0))


def write(folder: Path, found: VersionsDocument) -> Path:
    """Write ``versions.json`` and ``versions.html``; returns the page's path. Raises :class:`InvalidInput`."""
    import msgspec

    from .models.writers.whole_file import make_folder, write_whole
    from .reports.pages.versions_page import to_versions_page

    page = to_versions_page(found)
    make_folder(folder)
    write_whole(folder / "versions.json", msgspec.json.format(msgspec.json.encode(found), indent=1).decode() + "\n")
    return write_whole(folder / "versions.html", page)
