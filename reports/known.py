"""Known differences: a TOML file that says which differences of a run are no news, and what a run says of that file.

An entry accounts for a result that differs where its patterns fit and, if it names a cause, all that was found of why
it differs is named by it or by another entry that fits. It never accounts for an error.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cached_property
from pathlib import Path

import msgspec

from ..models.errors import InvalidInput
from ..models.readers.bounded_file import read_text, shown
from ..models.readers.toml_fields import fitted
from ..models.readers.toml_text import parse_toml
from ..records.check import Diagnosis, KnownDifference, KnownState, Result
from ..records.exit_status import AGREES, DIFFERS, INCOMPLETE
from .report import Report
from .words import count, one_line

LARGEST_FILE = 1_000_000  # bytes; some thousands of entries
MOST_ENTRIES = 500  # each is held against every result
LONGEST_PATTERN = 200  # characters
MOST_STARS = 4  # of one pattern: matching takes time that grows with the length to this power


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One entry as it stands in the file; patterns as in a shell."""

    scene: str
    engine: str
    reason: str
    check: str = "*"
    cause: str = ""
    link: str = ""

    def fits(self, result: Result) -> bool:
        """Whether scene, engine and check of the result are meant."""
        pairs = ((result.scene, self.scene), (result.engine, self.engine), (result.check, self.check))
        return all(fnmatchcase(name, pattern) for name, pattern in pairs)


class _File(msgspec.Struct, forbid_unknown_fields=True):
    known: list[Entry]


def read_known(path: Path) -> tuple[Entry, ...]:
    """The entries of a file. Raises :class:`InvalidInput` naming the file, the field, and what would be right."""
    text = read_text(path, LARGEST_FILE)
    try:
        tables = parse_toml(text)
        if "known" not in tables:
            raise InvalidInput("known: missing; [[known]] with scene, engine and reason is needed for each difference")
        entries = tuple(fitted(tables, _File).known)
        if len(entries) > MOST_ENTRIES:
            raise InvalidInput(f"known: at most {MOST_ENTRIES} entries, got {len(entries)}")
        for number, entry in enumerate(entries):
            _require_sound(number, entry)
    except InvalidInput as error:
        raise InvalidInput(f"{shown(path)}: {error}") from None
    return entries


def _require_sound(number: int, entry: Entry) -> None:
    for field in ("scene", "engine", "check"):
        pattern = getattr(entry, field)
        if not pattern or len(pattern) > LONGEST_PATTERN or pattern.count("*") > MOST_STARS:
            raise InvalidInput(
                f"known[{number}].{field}: a pattern of at most {LONGEST_PATTERN} characters and {MOST_STARS} '*'"
                f" is needed, got {pattern!r:.80}"
            )
    if not entry.reason.strip():
        raise InvalidInput(f"known[{number}].reason: empty; say why the difference is accepted")
    if entry.link and not entry.link.startswith(("https://", "http://")):
        raise InvalidInput(
            f"known[{number}].link: an address that begins with https:// is needed, got {entry.link!r:.80}"
        )


@dataclass(frozen=True)
class Known:
    """A run against the entries of a file."""

    report: Report
    entries: tuple[Entry, ...]

    @cached_property
    def differences(self) -> tuple[KnownDifference, ...]:
        """Every entry, with its state in this run."""
        return tuple(self._state_of(entry) for entry in self.entries)

    @cached_property
    def by_result(self) -> dict[tuple[str, str, str], Entry]:
        """The entry that accounts for each known difference, by scene, engine and check."""
        found = ((_key(result), self._entry_of(result)) for result in self.report.having("differs"))
        return {key: entry for key, entry in found if entry is not None}

    @property
    def new(self) -> int:
        """Number of differences that no entry accounts for."""
        return sum(_key(result) not in self.by_result for result in self.report.having("differs"))

    def exit_status_of(self, sharp: bool, strict: bool) -> int:
        """That of the run without its known differences; ``strict``: an entry that agrees counts as a difference."""
        agreeing = any(entry.state == "agrees" for entry in self.differences)
        if self.new or (sharp and self.report.words["loose"]) or (strict and agreeing):
            return DIFFERS
        return INCOMPLETE if self.report.counts["error"] or self.report.flaws else AGREES

    def text(self) -> str:
        """Known differences, apart from the others, and what is to be done with the file."""
        shared = len(self.report.having("differs")) - self.new
        lines = [f"Known differences: {shared:,} of {count(shared + self.new, 'difference')}; {self.new:,} not known"]
        for entry in self.differences:
            what = one_line(f"{entry.scene} × {entry.engine}, {entry.check}" + f" ({entry.cause})" * bool(entry.cause))
            link = f" {one_line(entry.link)}" if entry.link else ""
            lines.append(f"  {what}: {_says(entry)}: {one_line(entry.reason)}{link}")
        return "\n".join(lines)

    def _entry_of(self, result: Result) -> Entry | None:
        fitting = [entry for entry in self.entries if entry.fits(result)]
        causes = self._causes(result)
        named = {entry.cause for entry in fitting}
        for entry in fitting:
            if not entry.cause or (entry.cause in causes and causes <= named):
                return entry
        return None

    def _causes(self, result: Result) -> set[str]:
        """Every cause that was found of a difference."""
        found = {result.cause} if result.cause else set()
        for diagnosis in self._diagnoses.get((result.scene, result.engine), ()):
            if result.check in diagnosis.explains:
                found |= {finding.cause for finding in diagnosis.findings}
        return found

    @cached_property
    def _diagnoses(self) -> dict[tuple[str, str], list[Diagnosis]]:
        found: dict[tuple[str, str], list[Diagnosis]] = {}
        for diagnosis in self.report.diagnoses:
            found.setdefault((diagnosis.scene, diagnosis.engine), []).append(diagnosis)
        return found

    def _state_of(self, entry: Entry) -> KnownDifference:
        met = [result for result in self.report.results if result.outcome != "skipped" and entry.fits(result)]
        outcomes = {result.outcome for result in met}
        held = [
            _key(result)
            for result in met
            if result.outcome == "differs"
            and _key(result) in self.by_result
            and (not entry.cause or entry.cause in self._causes(result))
        ]
        state: KnownState = "stale"
        if held:
            state = "differs"
        elif "differs" in outcomes:
            state = "another-cause"
        elif "agrees" in outcomes:
            state = "agrees"
        elif outcomes:
            state = "failed"
        return KnownDifference(**msgspec.structs.asdict(entry), state=state, results=held)


def known_in(report: Report, entries: Sequence[Entry]) -> Known:
    """What a run says of the entries of a file, and the file of the run."""
    return Known(report, tuple(entries))


def _key(result: Result) -> tuple[str, str, str]:
    return result.scene, result.engine, result.check


def _says(entry: KnownDifference) -> str:
    if entry.state == "differs":
        return f"{count(len(entry.results), 'difference')}"
    return {
        "agrees": "agrees now; take the entry out",
        "another-cause": "differs for another cause, which is not known",
        "failed": "failed, so nothing is known of it",
        "stale": "stale: it means nothing that was run",
    }[entry.state]
