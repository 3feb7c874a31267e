"""The page of a check, ``report.html``: one file that opens from disk, fetches nothing and runs nothing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from ...records.check import Result, SceneEntry
from ..report import Report, TableCell, against, group_line
from ..words import GLYPHS, LEGEND, Word, count, last_line, word
from .error_plots import ErrorPlot, HorizonPlot, draw_errors, draw_horizons
from .mechanism_drawing import MechanismDrawing, draw_mechanism
from .rendering import environment, render

DRAWN = ("traceback", "errors over time")  # details that the page shows elsewhere

PAGE = "report.html.j2"
PARTS = ("marks", "facts", "causes", "overview", "reasons", "scene", "plot")  # it includes these


@dataclass(frozen=True)
class SceneView:
    """One scene, as the page shows it; ``anchor`` is a number of the page's own, because a name may hold anything."""

    report: Report
    name: str
    anchor: str

    @cached_property
    def entry(self) -> SceneEntry | None:
        """The header's entry; None where only results name the scene."""
        return self.report.scene(self.name)

    @cached_property
    def cells(self) -> list[TableCell]:
        """One for each engine."""
        return [self.report.table[self.name, engine] for engine in self.report.engines]

    @cached_property
    def results(self) -> list[Result]:
        """All results, engine by engine."""
        return [result for cell in self.cells for result in cell.results]

    @cached_property
    def words(self) -> list[Word]:
        """The outcomes that occur, and ``loose``."""
        found = {word(result) for result in self.results}
        return [name for name in GLYPHS if name in found]

    @cached_property
    def horizons(self) -> tuple[HorizonPlot, ...]:
        """Errors over time, predicted and measured, where a run followed them."""
        return draw_horizons(self.results)

    @property
    def lyapunov_time(self) -> float | None:
        """Seconds in which a small difference grows e-fold, where some check found it."""
        times = [result.details.get("Lyapunov time") for result in self.results]
        return next((time for time in times if isinstance(time, float)), None)

    @cached_property
    def checks(self) -> list[str]:
        """The checks of this scene, in the same order for all scenes."""
        found = {result.check for result in self.results}
        return [check for check in self.report.checks if check in found]

    @property
    def further(self) -> list[tuple[str, list[str], list[Result]]]:
        """Each check, the names of its further figures (a traceback is none), and its results."""
        return [(check, _keys(found), found) for check in self.checks if (found := self.of(check))]

    def of(self, check: str) -> list[Result]:
        """The results of one check, engine by engine."""
        return [result for result in self.results if result.check == check]

    @cached_property
    def rows(self) -> list[tuple[str, list[list[Result]]]]:
        """Each check, with its results for each engine."""
        return [
            (check, [[r for r in cell.results if r.check == check] for cell in self.cells]) for check in self.checks
        ]

    @cached_property
    def mechanism(self) -> MechanismDrawing | None:
        """The drawing of the mechanism."""
        return draw_mechanism(self.entry) if self.entry and (self.entry.lengths or self.entry.outline) else None

    @cached_property
    def errors(self) -> ErrorPlot | None:
        """Its errors relative to their bounds."""
        return draw_errors(self.results, self.report.engines)

    @property
    def again(self) -> str:
        """The command line that runs this scene again."""
        return self.report.again(self.name)

    @property
    def equations(self) -> list[tuple[str, str]]:
        """Name and, where the stream gives it, text of each equation: ``name: text``."""
        named = [equation.partition(": ") for equation in (self.entry.equations if self.entry else ())]
        return [(name, text) for name, _, text in named]


def to_html(report: Report) -> str:
    """The whole page as text; everything from the stream is escaped."""
    return render(
        PAGE,
        report=report,
        scenes=[SceneView(report, name, f"s{i}") for i, name in enumerate(report.scenes, start=1)],
        glyphs=GLYPHS,
        legend=LEGEND,
        in_words=_in_words,
        group_line=group_line,
    )


def load_templates() -> None:
    """Compile the page's templates ahead of their use; they are kept."""
    for name in (PAGE, *(f"{part}.html.j2" for part in PARTS)):
        environment().get_template(name)


def _in_words(cell: TableCell) -> str:
    """The tooltip of a table cell: its deciding check, and how many others were skipped."""
    worst = cell.worst
    if worst is None:
        return f"{cell.scene} × {cell.engine}: no result"
    said = f"{cell.scene} × {cell.engine}: {worst.check} {word(worst)}"
    if worst.measured is not None:
        said += f", {against(worst)}"
    elif worst.reason:
        said += f", {last_line(worst.reason)[:200]}"
    skipped = sum(result.outcome == "skipped" for result in cell.results)
    return said + (f"; {count(skipped, 'check')} skipped" if skipped and cell.outcome != "skipped" else "")


def _keys(results: Sequence[Result]) -> list[str]:
    return [key for key in dict.fromkeys(key for result in results for key in result.details) if key not in DRAWN]
