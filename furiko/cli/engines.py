"""``furiko engines``."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import click

from ..records.exit_status import AGREES
from .options import engine_names as known_engines
from .options import found_here, json_option
from .output import print_json, print_table, print_text

if TYPE_CHECKING:
    from ..engines import EngineInfo
    from ..records.listings import EngineRow


@click.command()
@click.argument("names", nargs=-1, metavar="[NAME]...", callback=found_here, shell_complete=known_engines)
@click.option(
    "--table",
    "runs",
    multiple=True,
    metavar="DIR",
    type=click.Path(exists=True),
    help="In place of the list: a page that compares all engines of this run of furiko check. Again for more runs.",
)
@click.option("--out", metavar="FILE", type=click.Path(dir_okay=False), help="Where the page of --table goes.")
@click.option(
    "--probe",
    "pythons",
    multiple=True,
    metavar="PYTHON",
    type=click.Path(exists=True, dir_okay=False),
    help="With --table: another Python, whose engines are looked at for known defects, too.",
)
@json_option
def engines(
    names: tuple[str, ...], as_json: bool, runs: tuple[str, ...], out: str | None, pythons: tuple[str, ...]
) -> int:
    """List the engines, their versions, and what they cannot compute.

    NAME: only this one; also of another version or place, as furiko check -e takes it (./venv:mujoco).
    """
    if runs or out or pythons:
        return _table(runs, out, pythons)
    from ..engines import all_of, engine_info, engine_names, engine_version, names_on_request, plugin_names, untested
    from ..models.errors import installing

    always = engine_names()
    known = all_of(names) or [*always, *names_on_request(), *plugin_names()]
    infos = [replace(engine_info(name), name=name) for name in known]
    if as_json:
        print_json([_row(info, engine_version(info.name), info.name not in always) for info in infos])
    else:
        rows = [
            (
                info.name + ("" if names or info.name in always else " *"),
                engine_version(info.name) + (" (not tested)" if untested(info) else "")
                or f"not installed: {installing(info.package)}",
                info.formulation,
                ", ".join(i.name for i in info.integrators) or "-",
                ", ".join(info.missing) or "-",
            )
            for info in infos
        ]
        print_table(("engine", "version", "formulation", "integrators", "does not give"), rows)
        if not names:
            print_text("* runs only where it is named: -e NAME, as are NAME@VERSION, ENVIRONMENT:NAME and ./program")
    return AGREES


def _table(runs: tuple[str, ...], out: str | None, pythons: tuple[str, ...]) -> int:
    from pathlib import Path

    from ..engine_table import table_of_runs
    from ..models.errors import InvalidInput
    from ..models.writers.whole_file import replace_file

    if not runs or out is None:
        raise InvalidInput("engines: --table DIR and --out FILE go together, and --probe with them")
    parts = [*(f"--table {Path(run).name}" for run in runs), *("--probe PYTHON" for _ in pythons), f"--out {out}"]
    command = " ".join(["furiko engines", *parts])
    replace_file(Path(out), table_of_runs(runs, command, pythons).encode())
    print_text(f"Page: {out}")
    return AGREES


def _row(info: EngineInfo, version: str, named: bool) -> EngineRow:
    from ..records.listings import EngineRow, IntegratorRow

    return EngineRow(
        name=info.name,
        formulation=info.formulation,
        package=info.package,
        version=version or None,
        coordinates=info.coordinates,
        integrators=[IntegratorRow(name=i.name, order=i.order) for i in info.integrators],
        missing=dict(info.missing),
        largest_n=info.largest_n,
        homepage=info.homepage,
        named=named,
    )
