"""``furiko export``."""

from __future__ import annotations

from pathlib import Path

import click

from ..records.exit_status import AGREES
from .output import print_text


@click.command()
@click.argument("scene")
@click.option("--mjcf", "language", flag_value="mjcf", help="Write MJCF, MuJoCo's format.")
@click.option("--urdf", "language", flag_value="urdf", help="Write URDF.")
@click.option("--out", "-o", type=click.Path(path_type=Path), help="File to write; standard output if not given.")
def export(scene: str, language: str | None, out: Path | None) -> int:
    """Write a scene's mechanism as an MJCF or URDF file."""
    from ..models import TreeScene, find_scene, to_mjcf, to_urdf
    from ..models.writers.tree_files import tree_to_mjcf, tree_to_urdf
    from ..models.writers.whole_file import write_whole

    if language is None:
        raise click.UsageError("one of --mjcf and --urdf is needed")
    found = find_scene(scene)
    if isinstance(found, TreeScene):
        text = tree_to_mjcf(found) if language == "mjcf" else tree_to_urdf(found)
    else:
        text = to_mjcf(found.system) if language == "mjcf" else to_urdf(found.system)
    if out is None:
        print_text(text, end=False)
    else:
        write_whole(out, text)
    return AGREES
