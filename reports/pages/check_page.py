"""The page of a check, ``report.html``: one file that opens from disk and fetches nothing.

What a reader needs first is in the markup: the verdict, the causes, what is known, each engine in a line; it is the
page without JavaScript, and on paper. All else is data, from which the page's own script makes what is looked at.
"""

from __future__ import annotations

from collections import Counter
from functools import cache

from ..causes import group_by_check
from ..known import Known
from ..report import Report, group_line, worst_rounding
from ..words import GLYPHS, LEGEND, WORDS, Word, figure, outcome_of, package_of, word
from .check_data import page_data
from .rendering import TEMPLATES, digest, environment, render

PAGE = "report.html.j2"
PARTS = ("facts", "causes", "by_engine", "reasons", "browse", "loose")  # it includes these
MOST_LISTED = 40  # lines of a list in the markup; the table has all results
SCRIPTS = ("formula.js", "check.js")
# Where there is something to plot: uPlot, with its licence, and what draws with it.
PLOTTING = ("uplot/uPlot.js", "motion.js")
HEAT = "heat.js"  # where there are matrices


def to_html(report: Report, known: Known | None = None) -> str:
    """The whole page as text; nothing from the stream is markup. ``known``: its known differences."""
    from markupsafe import Markup

    data, plotted, mapped = page_data(report, known)
    script = _script(plotted, mapped)
    return render(
        PAGE,
        ("style.css", *(("uplot/uPlot.css",) if plotted else ()), "check.css"),
        report=report,
        known=known,
        mark=outcome_of(report.exit_status if known is None else known.exit_status_of(sharp=False, strict=False)),
        by_engine=_by_engine(report),
        glyphs=GLYPHS,
        legend=LEGEND,
        group_line=group_line,
        words=WORDS,
        loose=group_by_check(report.loose),
        most=MOST_LISTED,
        data=Markup(data),
        script=Markup(script),
        script_digest=digest(script),
    )


def load_templates() -> None:
    """Compile the page's templates ahead of their use; they are kept."""
    for name in (PAGE, *(f"{part}.html.j2" for part in PARTS)):
        environment().get_template(name)


@cache
def _script(plotted: bool, mapped: bool) -> str:
    names = (*(PLOTTING if plotted else ()), *((HEAT,) if mapped else ()), *SCRIPTS)
    parts = [(TEMPLATES / name).read_text(encoding="utf-8") for name in names]
    if plotted:
        licence = (TEMPLATES / "uplot" / "LICENSE.txt").read_text(encoding="utf-8")
        parts.insert(0, f"/* uPlot, which draws the plots of this page:\n\n{licence}*/")
    return "\n".join(parts)


def _by_engine(report: Report) -> list[tuple[str, str, Counter[Word], str]]:
    """Each engine: its name, its package, the number of results of each word, its worst error where it agrees."""
    found = []
    for name in report.engines:
        results = [result for scene in report.scenes for result in report.table[scene, name].results]
        worst = worst_rounding(results)
        shown = "" if worst is None else f"{figure(worst)} ε"
        found.append((name, package_of(report.engine(name)), Counter(map(word, results)), shown))
    return found
