"""The page of a history, ``history.html``: an engine a section, its versions and outcomes, the latest first."""

from __future__ import annotations

from pathlib import Path

from ...models.writers.whole_file import make_folder, write_whole
from ..pages.rendering import render
from ..words import GLYPHS, WORDS
from .badges import badges
from .runs import History

PAGE = "history.html"


def to_history_page(history: History) -> str:
    """The whole page as text; everything from the runs is escaped."""
    return render("history.html.j2", ("style.css", "check.css"), history=history, glyphs=GLYPHS, words=WORDS)


def write_history(history: History, folder: Path) -> list[Path]:
    """Write the page, and the badges of the latest run, into a folder. Returns their paths, the page's first."""
    make_folder(folder)
    page = to_history_page(history)
    files = {PAGE: page} | (badges(history.runs[0]) if history.runs else {})
    return [write_whole(folder / name, text) for name, text in files.items()]
