"""The table that a person sees at the end of a run, and below it what differs, what failed and what was skipped."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ...records.check import Outcome, Result
from ...records.exit_status import AGREES, DIFFERS
from ..report import Cell, Report, against
from ..words import GLYPHS, LEGEND, count, few, last_line, one_line

if TYPE_CHECKING:
    from rich.table import Table
    from rich.text import Text

# Blue and orange: told apart by the kinds of colour vision that red and green are not.
STYLES: dict[Outcome, str] = {
    "agrees": "blue",
    "differs": "bold dark_orange",
    "skipped": "dim",
    "error": "bold magenta",
}
MOST_LISTED = 20
LONGEST_SCENE = 32  # characters of a scene's name that the table shows
GAP = 2  # columns of the terminal between two of the table
PIPED_WIDTH = 120  # a log is wide, and a wrapped table hard to read
ASCII = {"✓": "+", "✗": "x", "–": "-", "×": "x", "ε": "eps", "…": "...", "⁻⁵²": "^-52"}


def print_report(
    report: Report, path: str | Path | None = None, file: TextIO | None = None, width: int | None = None
) -> None:
    """Print the table, what differs or failed, why things were skipped, and where the report is (``path``).

    ``file`` is standard output unless given; ``width`` [columns] that of the terminal, or 120 in a pipe.
    """
    page = Page(file or sys.stdout, width)
    _print_table(report, page)
    _print_differing(report, page)
    for sentence in report.alone:
        page.line(sentence)
    _print_reasons(report, "error", "Failed", page)
    _print_reasons(report, "skipped", "Skipped", page)
    page.line()
    for flaw in report.flaws:
        page.line(flaw, "bold reverse")
    style = {AGREES: STYLES["agrees"], DIFFERS: STYLES["differs"]}.get(report.exit_status, STYLES["error"])
    page.line(report.verdict, f"bold {style}")
    if report.kept:
        page.line(f"{count(report.kept, 'result')} kept from an earlier run of the same inputs; --no-cache runs all.")
    if path is not None:
        page.line(f"Report: {path}")


class Page:
    """A console that shows text as it is: no markup, no control codes, and ASCII where the stream knows no more."""

    def __init__(self, file: TextIO, width: int | None) -> None:
        from rich.console import Console
        from rich.text import Text

        self._text = Text
        self.console = Console(file=file, width=width, highlight=False, markup=False, emoji=False)
        if width is None and not self.console.is_terminal:
            self.console.width = PIPED_WIDTH
        try:
            "".join(ASCII).encode(self.console.encoding)
            self._plain = False
        except (UnicodeEncodeError, LookupError):
            self._plain = True

    def line(self, words: str = "", style: str = "") -> None:
        """One line, however long: a terminal wraps it, and in a pipe it stays one line to search for."""
        self.console.print(self.text(words, style), soft_wrap=True)

    def text(self, words: str, style: str = "") -> Text:
        if self._plain:
            for glyph, letters in ASCII.items():
                words = words.replace(glyph, letters)
            words = words.encode(self.console.encoding, "backslashreplace").decode(self.console.encoding)
        return self._text(words, style=style)


def _print_table(report: Report, page: Page) -> None:
    """Scene × engine. In a window too narrow for words, glyphs stand for them; if need be, the engines are split."""
    say: Callable[[Cell], str]
    for say in (_in_words, _in_glyphs):
        blocks = _blocks(report, say, page.console.width)
        if len(blocks) == 1:
            break
    for engines in blocks:
        page.console.print(_table(report, engines, say, page))
    if not report.results:
        return
    if say is _in_glyphs:
        page.line("   ".join(f"{glyph} {outcome}" for outcome, glyph in GLYPHS.items()), "dim")
    page.line(LEGEND, "dim")


def _blocks(report: Report, say: Callable[[Cell], str], width: int) -> list[list[str]]:
    """The engines, in as many groups as it takes for each to fit beside the scenes' names."""
    room = width - max((len(_row_name(scene)) for scene in report.scenes), default=0)
    blocks: list[list[str]] = [[]]
    left = room
    for engine in report.engines:
        needed = GAP + max(len(piece) for piece in _heading(engine).split("\n"))
        needed = max(needed, *(GAP + len(say(report.table[scene, engine])) for scene in report.scenes), 0)
        if needed > left and blocks[-1]:
            blocks.append([])
            left = room
        blocks[-1].append(engine)
        left -= needed
    return blocks


def _table(report: Report, engines: Sequence[str], say: Callable[[Cell], str], page: Page) -> Table:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    # One space of padding and the box's own, empty divider make the gap.
    table = Table(box=SIMPLE_HEAD, show_edge=False, pad_edge=False, padding=(0, GAP - 1, 0, 0))
    table.add_column(page.text("scene"), no_wrap=True)
    for engine in engines:
        table.add_column(page.text(_heading(engine)), no_wrap=True, vertical="bottom")
    for scene in report.scenes:
        cells = [report.table[scene, engine] for engine in engines]
        said = [page.text(say(cell), STYLES[cell.outcome] if cell.outcome else "dim") for cell in cells]
        table.add_row(page.text(_row_name(scene)), *said)
    return table


def _print_differing(report: Report, page: Page) -> None:
    found = report.having("differs")
    if found:
        page.line("\nDiffers", STYLES["differs"])
    for result in found[:MOST_LISTED]:
        page.line(f"  {finding(result)}")
    if len(found) > MOST_LISTED:
        page.line(f"  … and {len(found) - MOST_LISTED} more, which the report lists")


def _print_reasons(report: Report, outcome: Outcome, title: str, page: Page) -> None:
    """Each reason once, with where it holds: one missing engine is one line, not one for each of its comparisons."""
    found = report.reasons(outcome)
    if found:
        page.line(f"\n{title}", STYLES[outcome])
    for reason, results in found[:MOST_LISTED]:
        scenes = few((result.scene for result in results), "scene")
        engines = few((result.engine for result in results), "engine")
        checks = few((result.check for result in results), "check")
        page.line(f"  {GLYPHS[outcome]} {len(results)}: {scenes} × {engines}, {checks}: {one_line(reason)}")
    if len(found) > MOST_LISTED:
        page.line(f"  … and {len(found) - MOST_LISTED} more reasons, which the report lists")


def finding(result: Result) -> str:
    """One line: where, what was measured against what is allowed, and why."""
    said = f"{GLYPHS[result.outcome]} {result.scene} × {result.engine}, {result.check}"
    if result.measured is not None:
        said += f": {against(result)}"
    if result.cause:
        said += f" [{result.cause}]"
    if result.reason:
        said += f": {last_line(result.reason)}"
    return one_line(said)


def _in_words(cell: Cell) -> str:
    if cell.outcome is None:
        return "no result"
    return f"{GLYPHS[cell.outcome]} {cell.outcome} {cell.error}".rstrip()


def _in_glyphs(cell: Cell) -> str:
    return f"{GLYPHS[cell.outcome]} {cell.error}".rstrip() if cell.outcome else "?"


def _heading(engine: str) -> str:
    """An engine's name, broken after its hyphens: its columns need not be wider than what stands in them."""
    return one_line(engine, 40).replace("-", "-\n")


def _row_name(scene: str) -> str:
    return one_line(scene, LONGEST_SCENE)
