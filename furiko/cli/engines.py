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
@json_option
def engines(names: tuple[str, ...], as_json: bool) -> int:
    """List the engines, their versions, and what they cannot compute.

    NAME: only this one; also of another version or place, as furiko check -e takes it (./venv:mujoco).
    """
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
