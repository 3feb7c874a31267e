"""``furiko diagnose``."""

from __future__ import annotations

from pathlib import Path

import click

from .options import json_option
from .output import print_json, print_text


@click.command()
@click.argument("model", type=click.Path(path_type=Path))
@click.option(
    "--against", metavar="SCENE|FILE", help="What MODEL should be: a scene, a scene's TOML file, or another model file."
)
@click.option(
    "-e", "--engine", "engines", multiple=True, metavar="NAME", help="Ask this engine, and no other; may be repeated."
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
@json_option
def diagnose(
    model: Path,
    against: str | None,
    engines: tuple[str, ...],
    meshes: tuple[Path, ...],
    limits: bool,
    fix: Path | None,
    as_json: bool,
) -> int:
    """Check how engines read an MJCF or URDF file; say why they differ."""
    from ..diagnosis.model_files.diagnose import diagnose as diagnose_file

    found = diagnose_file(model, against, engines or None, meshes=meshes, limits=limits, isolated=True)
    if fix is not None:
        from ..diagnosis.model_files.fix import write_fixed

        write_fixed(model, fix, meshes)
    if as_json:
        print_json(found.to_json())
    else:
        print_text(found.text() + (f"\n  written: {fix}" if fix is not None else ""))
    return found.exit_status
