"""The page of one model file: what ``furiko diagnose`` found, with the mechanism drawn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .mechanism_drawing import Line, draw_lines
from .rendering import render

GLYPHS = {"agrees": "✓", "differs": "✗", "refused": "!", "failed": "!", "missing": "–"}
CLASSES = {"agrees": "agrees", "differs": "differs", "refused": "error", "failed": "error", "missing": "skipped"}
MOST_BODIES = 500  # in the table of what was read


def to_diagnosis_page(
    found: Mapping[str, Any], described: str, causes: Mapping[str, str], lines: Sequence[Line] = ()
) -> str:
    """One HTML page of a diagnosis.

    ``found``: the document of ``furiko diagnose --json``; ``described``: the mechanism in a few words; ``causes``: what
    each cause's code means; ``lines``: the mechanism's links as (x, z, x, z) [m], z upwards, empty where none was read.
    """
    return render(
        "diagnose.html.j2",
        found=found,
        described=described,
        groups=_by_cause(found["findings"]),
        causes=causes,
        bodies=found["spatial"].get("bodies", [])[:MOST_BODIES],
        all_bodies=len(found["spatial"].get("bodies", [])),
        drawing=draw_lines(lines) if lines else None,
        glyphs=GLYPHS,
        classes=CLASSES,
    )


def _by_cause(findings: Sequence[Mapping[str, Any]]) -> list[tuple[str, list[Mapping[str, Any]]]]:
    """The findings of each cause, the first one's cause first."""
    groups: dict[str, list[Mapping[str, Any]]] = {}
    for finding in findings:
        groups.setdefault(finding["cause"], []).append(finding)
    return list(groups.items())
