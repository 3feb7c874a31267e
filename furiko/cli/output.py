"""Results on standard output: one JSON document, a text, or a table; nothing in it can act on a terminal."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import click

from ..records.printable import printable, printable_json, without_surrogates

_UTF_8 = ("utf-8", "utf8", "utf_8")
_documents = 0  # printed by this process


def print_json(content: object) -> None:
    """Print one JSON document."""
    global _documents  # noqa: PLW0603 -- what standard output has had belongs to the process
    import msgspec

    try:
        encoded = msgspec.json.encode(content)
    except UnicodeEncodeError:
        encoded = msgspec.json.encode(without_surrogates(msgspec.to_builtins(content)))
    ascii_only = (sys.stdout.encoding or "utf-8").lower() not in _UTF_8
    text = printable_json(msgspec.json.format(encoded, indent=2).decode(), ascii_only=ascii_only)
    _documents += 1
    click.echo(text)


def documents_printed() -> int:
    """How many JSON documents this process has printed."""
    return _documents


def print_text(text: str, *, err: bool = False, end: bool = True) -> None:
    """Print a text, control characters written out. ``err``: on standard error; ``end``: with a line end."""
    click.echo(printable(text), err=err, nl=end)


def print_failure(text: str) -> None:
    """Print what went wrong: one line on standard error."""
    click.echo(f"furiko: {printable(' '.join(text.split()))}", err=True)


def print_table(heading: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> None:
    """Print a table as wide as the terminal; 160 characters wide where standard output is no terminal."""
    from rich.console import Console
    from rich.table import Table

    table = Table(*heading, box=None, header_style="bold", pad_edge=False)
    for row in rows:
        table.add_row(*map(printable, row))
    console = Console(width=None if sys.stdout.isatty() else 160, highlight=False, markup=False, emoji=False)
    console.print(table)
