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
@json_option
def diagnose(model: Path, against: str | None, as_json: bool) -> int:
    """Check how engines read an MJCF or URDF file; say why they differ."""
    from ..diagnosis.model_files.diagnose import diagnose as diagnose_file

    found = diagnose_file(model, against, isolated=True)
    if as_json:
        print_json(found.to_json())
    else:
        print_text(found.text())
    return found.exit_status
