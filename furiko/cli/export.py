"""``furiko export``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..records.exit_status import AGREES
from .options import scene_names
from .output import print_text

if TYPE_CHECKING:
    from ..models import AnyScene


@click.command()
@click.argument("scene", shell_complete=scene_names)
@click.option("--mjcf", is_flag=True, help="Write MJCF, MuJoCo's format.")
@click.option("--urdf", is_flag=True, help="Write URDF.")
@click.option(
    "--out",
    "-o",
    type=click.Path(path_type=Path),
    help="File to write; standard output if not given. With --mjcf and --urdf: a folder, the current one if not given.",
)
def export(scene: str, mjcf: bool, urdf: bool, out: Path | None) -> int:
    """Write a scene's mechanism as an MJCF or URDF file.

    With both, SCENE.xml and SCENE.urdf are written.
    """
    from ..models import find_scene
    from ..models.writers.whole_file import make_folder, write_whole

    if not (mjcf or urdf):
        raise click.UsageError("one of --mjcf and --urdf is needed, or both")
    found = find_scene(scene)
    languages = [name for name, wanted in (("mjcf", mjcf), ("urdf", urdf)) if wanted]
    texts = {name: _written(found, name) for name in languages}  # both, before a file is there
    if len(texts) == 2:
        folder = out or Path()
        make_folder(folder)
        for name, suffix in (("mjcf", "xml"), ("urdf", "urdf")):
            print_text(str(write_whole(folder / f"{found.name}.{suffix}", texts[name])))
        return AGREES
    (text,) = texts.values()
    if out is None:
        print_text(text, end=False)
    else:
        write_whole(out, text)
    return AGREES


def _written(scene: AnyScene, language: str) -> str:
    from ..models import TreeScene, to_mjcf, to_urdf
    from ..models.writers.tree_files import tree_to_mjcf, tree_to_urdf

    if isinstance(scene, TreeScene):
        return tree_to_mjcf(scene) if language == "mjcf" else tree_to_urdf(scene)
    return to_mjcf(scene.system) if language == "mjcf" else to_urdf(scene.system)
