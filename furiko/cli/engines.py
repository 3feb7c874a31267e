"""``furiko engines``."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import click

from ..records.exit_status import AGREES
from .options import json_option
from .output import print_json, print_table, print_text

if TYPE_CHECKING:
    from ..engines import EngineInfo
    from ..records.listings import EngineRow


@click.command()
@json_option
def engines(as_json: bool) -> int:
    """List the engines, their versions, and what they cannot compute."""
    from ..engines import engine_info, engine_names, engine_version, names_on_request, plugin_names, untested
    from ..models.errors import installing

    always = engine_names()
    known = [*always, *names_on_request(), *plugin_names()]
    infos = [replace(engine_info(name), name=name) for name in known]
    if as_json:
        print_json([_row(info, engine_version(info.name), info.name not in always) for info in infos])
    else:
        rows = [
            (
                info.name + ("" if info.name in always else " *"),
                engine_version(info.name) + (" (not tested)" if untested(info) else "")
                or f"not installed: {installing(info.package)}",
                info.formulation,
                ", ".join(i.name for i in info.integrators) or "-",
                ", ".join(info.missing) or "-",
            )
            for info in infos
        ]
        print_table(("engine", "version", "formulation", "integrators", "does not give"), rows)
        print_text("* runs only where it is named: -e NAME")
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
