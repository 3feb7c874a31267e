"""The end of a check in the terminal: verdict, causes, failures, then the table of scenes and engines, and skips."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ...records.check import Outcome
from ..causes import group_by_check
from ..report import Report, TableCell, against, group_line
from ..words import GLYPHS, LEGEND, Word, count, few, listed, one_line, outcome_of
from .console import PlainConsole

if TYPE_CHECKING:
    from rich.table import Table

# Blue and orange, which people who confuse red and green can distinguish.
STYLES: dict[Word, str] = {
    "agrees": "blue",
    "loose": "bold yellow",
    "differs": "bold dark_orange",
    "skipped": "dim",
    "error": "bold magenta",
}
MOST_LISTED = 20
SCREEN = 20  # lines of table and reasons above which the verdict, at the top, is out of sight
LONGEST_SCENE = 32  # characters of a scene's name that the table shows
GAP = 2  # columns of the terminal between two of the table


def print_report(
    report: Report, path: str | Path | None = None, file: TextIO | None = None, width: int | None = None
) -> None:
    """Print verdict, causes of differences, failures, loose results, the table, skips, advice, and the report's path.

    The verdict is repeated at the end where the rest is longer than a screen. ``file`` is standard output unless given;
    ``width`` [columns] that of the terminal, or 120 in a pipe.
    """
    console = PlainConsole(file or sys.stdout, width)
    _print_verdict(report, console)
    _print_causes(report, console)
    _print_unexplained(report, console)
    for sentence in report.outliers:
        console.line(sentence)
    _print_reasons(report, "error", "Failed", console)
    _print_loose(report, console)
    console.line()
    _print_table(report, console)
    for scene in report.header.scenes:
        if scene.own:
            console.line(one_line(f"\n{scene.name}: your equations: {'; '.join(scene.own)}", 2000))
    _print_reasons(report, "skipped", "Skipped", console)
    console.line()
    for sentence in report.untested:
        console.line(one_line(sentence))
    if report.kept:
        console.line(
            f"{count(report.kept, 'result')} kept from an earlier run with the same inputs; --no-cache runs all."
        )
    if len(report.scenes) + len(report.reasons("skipped")) > SCREEN:
        _print_verdict(report, console)
    if report.advice:
        console.line(report.advice)
    if path is not None:
        console.line(one_line(f"Report: {path}"))


def _print_verdict(report: Report, console: PlainConsole) -> None:
    for flaw in report.flaws:
        console.line(flaw, "bold reverse")
    console.line(report.verdict, f"bold {STYLES[outcome_of(report.exit_status)]}")


def _print_table(report: Report, console: PlainConsole) -> None:
    """Scene × engine. In a narrow window glyphs replace words; if need be, the engines are split into groups."""
    say: Callable[[TableCell], str]
    for say in (_in_words, _in_glyphs):
        blocks = _blocks(report, say, console.rich.width)
        if len(blocks) == 1:
            break
    for engines in blocks:
        console.rich.print(_table(report, engines, say, console))
    if not report.results:
        return
    if say is _in_glyphs:
        console.line("   ".join(f"{glyph} {outcome}" for outcome, glyph in GLYPHS.items()), "dim")
    console.line(LEGEND, "dim")


def _blocks(report: Report, say: Callable[[TableCell], str], width: int) -> list[list[str]]:
    """The engines in as few groups as fit, each beside the names of the scenes."""
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


def _table(report: Report, engines: Sequence[str], say: Callable[[TableCell], str], console: PlainConsole) -> Table:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    # One space of padding and the empty divider of the box make the gap.
    table = Table(box=SIMPLE_HEAD, show_edge=False, pad_edge=False, padding=(0, GAP - 1, 0, 0))
    table.add_column(console.text("scene"), no_wrap=True)
    for engine in engines:
        table.add_column(console.text(_heading(engine)), no_wrap=True, vertical="bottom")
    for scene in report.scenes:
        cells = [report.table[scene, engine] for engine in engines]
        said = [console.text(say(cell), STYLES[cell.word] if cell.word else "dim") for cell in cells]
        table.add_row(console.text(_row_name(scene)), *said)
    return table


def _print_loose(report: Report, console: PlainConsole) -> None:
    """One line for each engine and check, with its loosest result."""
    found = group_by_check(report.loose)
    if found:
        console.line("\nLoose: they agree, but with larger errors than rounding explains", STYLES["loose"])
    for group in found[:MOST_LISTED]:
        console.line(f"  {GLYPHS['loose']} {group_line(group)}")
    _print_left(len(found), "checks", console)


def _print_causes(report: Report, console: PlainConsole) -> None:
    """Each cause once, with the scenes where it was found and its largest error."""
    found = report.causes.explanations
    if found:
        console.line("\nCauses", STYLES["differs"])
    for explanation in found:
        console.line(f"  {GLYPHS['differs']} {explanation.headline}")
        for line in explanation.lines:
            console.line(f"      {line}")
        console.line(f"      scenes: {listed(explanation.scenes)}")
        if explanation.explained:
            worst = explanation.explained[0]
            console.line(f"      largest: {one_line(f'{worst.scene}, {worst.check}: {against(worst)}'.rstrip(': '))}")


def _print_unexplained(report: Report, console: PlainConsole) -> None:
    """One line for each engine and check, with the largest error; then what the diagnoses say of it."""
    found = report.causes.unexplained
    if found:
        console.line("\nDiffers without a known cause", STYLES["differs"])
    for group in found[:MOST_LISTED]:
        console.line(f"  {GLYPHS['differs']} {group_line(group)}")
    _print_left(len(found), "checks", console)
    remarks = report.causes.remarks
    for engine, sentence, scenes in remarks[:MOST_LISTED]:
        console.line(f"      {one_line(engine, 80)}, {listed(scenes)}: {one_line(sentence)}")
    _print_left(len(remarks), "sentences", console)


def _print_left(number: int, noun: str, console: PlainConsole) -> None:
    if number > MOST_LISTED:
        console.line(f"  … and {number - MOST_LISTED} more {noun}; the report lists all")


def _print_reasons(report: Report, outcome: Outcome, title: str, console: PlainConsole) -> None:
    """Each reason once, with its results: a missing engine is one line, not one for each of its comparisons."""
    found = report.reasons(outcome)
    if found:
        console.line(f"\n{title}", STYLES[outcome])
    for reason, results in found[:MOST_LISTED]:
        scenes = few((result.scene for result in results), "scene")
        engines = few((result.engine for result in results), "engine")
        checks = few((result.check for result in results), "check")
        console.line(f"  {GLYPHS[outcome]} {len(results)}: {scenes} × {engines}, {checks}: {one_line(reason)}")
    _print_left(len(found), "reasons", console)


def _in_words(cell: TableCell) -> str:
    return f"{GLYPHS[cell.word]} {cell.word} {cell.error}".rstrip() if cell.word else "no result"


def _in_glyphs(cell: TableCell) -> str:
    return f"{GLYPHS[cell.word]} {cell.error}".rstrip() if cell.word else "?"


def _heading(engine: str) -> str:
    """An engine's name, broken after its hyphens, so that its column is no wider than its cells need."""
    return one_line(engine, 40).replace("-", "-\n")


def _row_name(scene: str) -> str:
    return one_line(scene, LONGEST_SCENE)
