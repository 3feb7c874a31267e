"""What the terminal and the page of ``furiko versions`` both say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..records.versions import VersionChange, VersionRow, VersionsDocument

OF = {"theory": "against the theory", "accelerations": "accelerations", "fields": "fields", "reading": "reading"}
MARKS = {"agrees": "✓", "differs": "✗", "error": "!", "skipped": "–"}


@dataclass(frozen=True)
class Changed:
    """What one release changed: the release ``before`` it that was looked at, and a line for each change."""

    before: str
    lines: tuple[str, ...]
    grave: bool  # more than last digits


def headline(found: VersionsDocument) -> str:
    """The whole in one sentence."""
    looked = [row for row in found.releases if row.looked_at]
    grave = [row.version for row in found.releases if (c := changed_in(found, row.version)) and c.grave]
    span = f"{found.releases[0].version} to {found.releases[-1].version}"
    seen = f"{len(looked)} of {len(found.releases)} releases from {span} looked at"
    what = f"{', '.join(grave)} changed an answer" if grave else "none changed more than last digits"
    return f"{found.package}: {what}; {seen}."


def changed_in(found: VersionsDocument, release: str) -> Changed | None:
    """What a release changed; None where nothing."""
    mine = [change for change in found.changes if change.release == release]
    if not mine:
        return None
    lines = [_line(change, found) for change in mine if change.kind != "rounding"]
    digits = [change for change in mine if change.kind == "rounding"]
    if digits:
        lines.append(_digits(digits))
    return Changed(_before(mine), tuple(dict.fromkeys(lines)), any(change.kind != "rounding" for change in mine))


def tally_of(row: VersionRow, engine: str, of: str) -> str:
    """``✓ 8`` or ``✓ 6  ✗ 2``: how many looks of a kind have which outcome."""
    outcomes = [look.outcome for look in row.looks if look.engine == engine and look.of == of]
    return "  ".join(f"{MARKS[kind]} {outcomes.count(kind)}" for kind in MARKS if kind in outcomes)


def _before(changes: Sequence[VersionChange]) -> str:
    change = changes[0]
    return change.before + (f" ({change.between} between them not looked at)" if change.between else "")


def _line(change: VersionChange, found: VersionsDocument) -> str:
    who = f"{change.engine}, " if len(found.engines) > 1 else ""
    return f"{who}{change.probe}, {OF[change.of]}: {change.says}"


def _digits(changes: Sequence[VersionChange]) -> str:
    where = list(dict.fromkeys(f"{change.probe} ({OF[change.of]})" for change in changes))
    shown = ", ".join(where[:4]) + (f" and {len(where) - 4} more" if len(where) > 4 else "")
    return f"other last digits: {shown}"
