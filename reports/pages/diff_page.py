"""The page of ``furiko diff``: what changed from one run to another, the gravest first."""

from __future__ import annotations

from ..compare import SAYS, Comparison, Mark
from ..report import Report
from .rendering import render

MOST = 200  # changes of one kind in the page; --json has all
CLASSES: dict[Mark, str] = {"!": "differs", "+": "loose", "x": "skipped", "~": "skipped", "*": "agrees", "-": "agrees"}


def to_diff_page(comparison: Comparison) -> str:
    """One HTML page; everything from the runs is escaped.

    The causes are those of the second run's engines in which something broke or grew.
    """
    kinds = [(mark, says, found) for mark, says in SAYS.items() if (found := comparison.of_kind(mark))]
    worse = {change.result.engine for change in comparison.marked("!", "+")}
    causes = [e for e in comparison.after.causes.explanations if e.engine in worse]
    return render(
        "diff.html.j2",
        ("style.css", "check.css"),
        comparison=comparison,
        runs=[("first", comparison.before), ("second", comparison.after)],
        engines=_engines,
        kinds=kinds,
        causes=causes,
        classes=CLASSES,
        most=MOST,
    )


def _engines(report: Report) -> str:
    return ", ".join(f"{engine.name} {engine.version}".strip() for engine in report.header.engines)
