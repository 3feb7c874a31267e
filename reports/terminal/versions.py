"""``furiko versions`` in a terminal: what changed, release by release, then the releases in a table."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TextIO

from ...records.versions import VersionRow, VersionsDocument
from ..versions import changed_in, headline, tally_of
from .console import PlainConsole


def print_versions(found: VersionsDocument, page: Path | None = None, file: TextIO | None = None) -> None:
    """Print it; ``page``: where the page is."""
    console = PlainConsole(file or sys.stdout, None)
    console.line(headline(found), style="bold")
    console.line()
    for row in found.releases:
        several = changed_in(found, row.version)
        if several:
            console.line(f"{row.version}, after {several.before}", style="bold")
            for line in several.lines:
                console.line(f"  {line}")
    console.line()
    several_engines = len(found.engines) > 1
    heading = ("release", "package", *(found.engines if several_engines else ("theory",)), "files read")
    console.table(heading, [_cells(row, found) for row in found.releases if row.looked_at or row.missing])
    left = sum(not row.looked_at and not row.missing for row in found.releases)
    if left:
        console.line(
            f"{left} releases were not looked at: those on both sides answer alike. --every looks at all of them."
        )
    if page is not None:
        console.line(f"Page: {page}")


def _cells(row: VersionRow, found: VersionsDocument) -> tuple[str, ...]:
    if row.missing:
        return (row.version, row.package, *("!" for _ in found.engines), row.missing)
    theory = [tally_of(row, name, "theory") for name in found.engines]
    files = dict.fromkeys(filter(None, (tally_of(row, name, "reading") for name in found.engines)))
    return (row.version, row.package, *theory, "; ".join(files))
