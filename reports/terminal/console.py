"""The console on which all tables and lines are printed."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, TextIO

from ..words import printable

if TYPE_CHECKING:
    from rich.text import Text

PIPED_WIDTH = 120  # a log is wide, and a wrapped table hard to read
ASCII = {"✓": "+", "✗": "x", "≈": "~", "–": "-", "×": "x", "ε": "eps", "…": "...", "⁻⁵²": "^-52"}


class PlainConsole:
    """A console that prints text as it is: no markup, no control codes, and ASCII where the stream knows only that.

    ``width`` [columns]: None for that of the terminal, or 120 in a pipe.
    """

    def __init__(self, file: TextIO, width: int | None) -> None:
        from rich.console import Console
        from rich.text import Text

        self._text = Text
        self.rich = Console(file=file, width=width, highlight=False, markup=False, emoji=False)
        if width is None and not self.rich.is_terminal:
            self.rich.width = PIPED_WIDTH
        try:
            "".join(ASCII).encode(self.rich.encoding)
            self._plain = False
        except (UnicodeEncodeError, LookupError):
            self._plain = True

    def line(self, words: str = "", style: str = "") -> None:
        """Print one line. On a terminal a long one goes on below, further in; a pipe gets one line to search for."""
        for part in self._wrapped(words) if self.rich.is_terminal else [words]:
            self.rich.print(self.text(part, style), soft_wrap=True)

    def _wrapped(self, words: str) -> list[str]:
        """The line in as many as the terminal needs, broken between words; a word that is too long stays whole."""
        found = []
        for line in words.split("\n"):
            further = " " * (len(line) - len(line.lstrip()) + 2)
            found += textwrap.wrap(
                line, self.rich.width, subsequent_indent=further, break_long_words=False, break_on_hyphens=False
            ) or [""]
        return found

    def text(self, words: str, style: str = "") -> Text:
        """Text for a cell of a table."""
        words = printable(words)
        if self._plain:
            for glyph, letters in ASCII.items():
                words = words.replace(glyph, letters)
            words = words.encode(self.rich.encoding, "backslashreplace").decode(self.rich.encoding)
        return self._text(words, style=style)

    def table(self, heading: Sequence[str], rows: Iterable[Sequence[str]], header_style: str = "dim") -> None:
        """Print a table without lines."""
        from rich.table import Table

        table = Table(box=None, pad_edge=False, header_style=header_style)
        for title in heading:
            table.add_column(self.text(title))
        for row in rows:
            table.add_row(*(self.text(cell) for cell in row))
        self.rich.print(table)
