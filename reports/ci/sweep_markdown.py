"""A sweep as GitHub-flavoured Markdown: tables; text from engines never acts as markup."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...records.sweep import SweepSummary
from ..sweeps import FAULTS, TALLIES, fault_row, flaws, group_heading, group_row, headline, tally_row
from ..words import count
from .markdown import escape

MOST_GROUPS = 200


def to_markdown(found: SweepSummary) -> str:
    """The whole as text."""
    parameters = found.manifest.parameters
    parts = [f"## furiko sweep: {escape(headline(found))}"]
    parts += [f"> [!WARNING]\n> {escape(sentence)}" for sentence in flaws(found)]
    parts.append("\n".join(_table(TALLIES, map(tally_row, found.tallies))))
    if found.faults:
        parts += ["### What went wrong", "\n".join(_table(FAULTS, map(fault_row, found.faults)))]
    if found.groups:
        rows = [group_row(group, parameters) for group in found.groups[:MOST_GROUPS]]
        parts += ["### The grid, over all seeds", "\n".join(_table(group_heading(parameters), rows))]
        left = len(found.groups) + found.groups_left_out - len(rows)
        if left:
            parts.append(f"{count(left, 'row')} more: in the Parquet files.")
    manifest = found.manifest
    parts.append(f"furiko {escape(manifest.furiko)}, {escape(manifest.started)}: {escape(manifest.command)}")
    return "\n\n".join(parts) + "\n"


def _table(heading: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    yield f"| {' | '.join(map(escape, heading))} |"
    yield f"|{'---|' * len(heading)}"
    for row in rows:
        yield f"| {' | '.join(map(escape, row))} |"
