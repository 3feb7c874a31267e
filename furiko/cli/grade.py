"""``furiko grade``."""

from __future__ import annotations

from pathlib import Path

import click

from .options import json_option
from .output import print_json, print_text


@click.command()
@click.argument("file", type=click.Path(path_type=Path), required=False)
@click.option("--callable", "function", metavar="MODULE:FUNCTION", help="Grade a function that you trust.")
@click.option("--system", help="The mechanism of a --callable; a FILE is held to it, and nothing is assumed then.")
@click.option("--links", type=click.IntRange(1, 20), help="The number of angles, likewise.")
@click.option("--japanese", is_flag=True, help="Print the result in Japanese.")
@json_option
def grade(
    file: Path | None, function: str | None, system: str | None, links: int | None, japanese: bool, as_json: bool
) -> int:
    """Grade a derivation: correct, or which term is wrong and why.

    With --callable the function is called as f(theta, omega, parameters), where parameters has lengths, masses,
    gravity and, for rods, density; it returns the accelerations. It runs in a process of its own, with limits of time
    and memory. That is no sandbox: grade only code that you would run yourself.

    With --system or --links a file that states another problem is refused, and a derivation that is right only on some
    condition is wrong.
    """
    if (file is None) == (function is None):
        raise click.UsageError("give a FILE or --callable MODULE:FUNCTION")
    if function is None:
        from ..derivations.grading.grade import grade as grade_file
        from ..derivations.reading.pinned import Pinned

        assert file is not None
        found = grade_file(file, pinned=Pinned(system, links) if system or links else None)
    else:
        from ..derivations.grading.grade_callable import grade_callable

        if system is None or links is None:
            raise click.UsageError("--callable needs --system and --links")
        found = grade_callable(function, system, links)
    if as_json:
        print_json(found.to_dict())
    else:
        print_text(found.text("ja" if japanese else "en"))
    return found.exit_status
