"""Results on standard output: one JSON document, or a table."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import click


def print_json(content: object) -> None:
    """Print one JSON document."""
    import msgspec

    click.echo(msgspec.json.format(msgspec.json.encode(content), indent=2).decode())


def print_table(heading: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> None:
    """Print a table as wide as the terminal; 160 characters wide where standard output is no terminal."""
    from rich.console import Console
    from rich.table import Table

    table = Table(*heading, box=None, header_style="bold", pad_edge=False)
    for row in rows:
        table.add_row(*row)
    console = Console(width=None if sys.stdout.isatty() else 160, highlight=False, markup=False)
    console.print(table)
