"""The page of ``furiko versions``: what changed first, then a table of releases, then every look."""

from __future__ import annotations

from ...records.versions import VersionsDocument
from ..versions import MARKS, OF, changed_in, headline, tally_of
from .rendering import render


def to_versions_page(found: VersionsDocument) -> str:
    """One HTML page; everything from engines is escaped."""
    changed = [(row.version, one) for row in found.releases if (one := changed_in(found, row.version))]
    rows = [
        (
            row,
            [tally_of(row, name, "theory") for name in found.engines],
            [tally_of(row, name, "reading") for name in found.engines],
        )
        for row in found.releases
    ]
    return render(
        "versions.html.j2", found=found, headline=headline(found), changed=changed, rows=rows, marks=MARKS, of=OF
    )
