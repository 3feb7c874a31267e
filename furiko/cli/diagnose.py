"""``furiko diagnose``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from .options import engine_names, json_option, scene_names
from .output import print_json, print_text

if TYPE_CHECKING:
    from ..diagnosis.model_files.result import Diagnosis


@click.command()
@click.argument("model", type=click.Path(path_type=Path))
@click.option(
    "--against",
    metavar="SCENE|FILE",
    shell_complete=scene_names,
    help="What MODEL should be: a scene, a scene's TOML file, or another model file.",
)
@click.option(
    "-e",
    "--engine",
    "engines",
    multiple=True,
    metavar="NAME",
    shell_complete=engine_names,
    help="Ask this engine, and no other; may be repeated.",
)
@click.option(
    "--meshes",
    multiple=True,
    type=click.Path(path_type=Path, exists=True, file_okay=False),
    help="A folder in which meshes and packages are looked for besides the model's own; may be repeated.",
)
@click.option("--limits", is_flag=True, help="Count ranges of joints as differences.")
@click.option(
    "--fix",
    metavar="OUT",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write the mechanism as a file that all engines read alike (.xml: MJCF, .urdf: URDF).",
)
@click.option(
    "--out",
    metavar="PAGE",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write the answer as one HTML page, with the mechanism drawn.",
)
@json_option
def diagnose(
    model: Path,
    against: str | None,
    engines: tuple[str, ...],
    meshes: tuple[Path, ...],
    limits: bool,
    fix: Path | None,
    out: Path | None,
    as_json: bool,
) -> int:
    """Check how engines read an MJCF or URDF file; say why they differ."""
    from ..diagnosis.model_files.diagnose import diagnose as diagnose_file

    found = diagnose_file(model, against, engines or None, meshes=meshes, limits=limits, isolated=True)
    if fix is not None:
        from ..diagnosis.model_files.fix import write_fixed

        write_fixed(model, fix, meshes)
    if out is not None:
        _write_page(found, model, meshes, out)
    if as_json:
        print_json(found.to_json())
    else:
        print_text("\n".join([found.text(), *(f"  written: {path}" for path in (fix, out) if path is not None)]))
    return found.exit_status


def _write_page(found: Diagnosis, model: Path, meshes: tuple[Path, ...], out: Path) -> None:
    from ..diagnosis.finding import CAUSES
    from ..models.readers.model_file import read_model
    from ..models.trees.system import tree_of
    from ..models.writers.whole_file import replace_file
    from ..reference.outline import outline
    from ..reports.pages.diagnose_page import to_diagnosis_page

    mechanism = read_model(model, meshes=meshes).spatial
    lines = outline(mechanism, tree_of(mechanism).reference, across_least=True) if mechanism is not None else []
    replace_file(out, to_diagnosis_page(found.to_json(), found.described(), CAUSES, lines).encode())
