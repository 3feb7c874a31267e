"""Options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import click
from click.shell_completion import CompletionItem

REPORT_FOLDER = Path("furiko-report")


Names = TypeVar("Names", str, tuple[str, ...])


def found_here(_context: click.Context, _parameter: click.Parameter, names: Names) -> Names:
    """The names; an adapter from elsewhere is looked for in the current folder too."""
    each = (names,) if isinstance(names, str) else names
    if each:  # most commands name no engine, and need not know of any
        from ..engines.elsewhere import look_in_current_folder

        look_in_current_folder(each)
    return names


def scene_names(_context: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """What a shell offers for a scene: names of the catalogue, and files. Nothing is imported that takes time."""
    names = sorted(path.stem for path in (Path(__file__).parent.parent / "models" / "catalogue").rglob("*.toml"))
    offered = [CompletionItem(name) for name in names if name.startswith(incomplete)]
    return offered or [CompletionItem(incomplete, type="file")]


def engine_names(_context: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """What a shell offers for an engine."""
    from ..engines import engine_names as known
    from ..engines import names_on_request, plugin_names

    return [
        CompletionItem(name) for name in [*known(), *names_on_request(), *plugin_names()] if name.startswith(incomplete)
    ]


def words(*known: str) -> Callable[..., list[CompletionItem]]:
    """What a shell offers where one of a few words is needed."""
    return lambda _context, _parameter, incomplete: [CompletionItem(w) for w in known if w.startswith(incomplete)]


json_option = click.option("--json", "as_json", is_flag=True, help="Print one JSON document and nothing else.")
engine_option = click.option(
    "--engine",
    "-e",
    "engines",
    multiple=True,
    metavar="NAME[@VERSION]|FILE.py|ENVIRONMENT:NAME|PROGRAM|module:Class",
    callback=found_here,
    shell_complete=engine_names,
    help="Run only this engine: a name, another version of it (mujoco@3.3.7, installed once in an environment of its "
    "own), the one of an environment (./venv:mujoco), a program (./program), or an adapter of your own: a file, or a "
    "class in a module, looked for in the current folder too (`furiko engine-test --help` shows one); may be repeated.",
)
report_folder_option = click.option(
    "--out",
    type=click.Path(path_type=Path),
    default=REPORT_FOLDER,
    show_default=True,
    help="Folder for the report.",
)
jobs_option = click.option(
    "--jobs", "-j", type=click.IntRange(1, 256), help="Number of worker processes; the number of cores if not given."
)
