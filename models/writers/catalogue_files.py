"""Writes the catalogue's model files into ``models/files/`` or the folder given.

python -m furiko.models.writers.catalogue_files [FOLDER]
"""

from __future__ import annotations

import sys
from contextlib import suppress
from pathlib import Path

from ..errors import InvalidInput
from ..scene import find_scenes
from ..trees.scene import TreeScene
from .mjcf import to_mjcf
from .tree_files import tree_to_mjcf, tree_to_urdf
from .urdf import to_urdf
from .whole_file import write_whole

FOLDER = Path(__file__).parent.parent / "files"


def model_files() -> dict[str, str]:
    """File name and content of every model file of the catalogue."""
    files = {}
    for scene in find_scenes(None):
        if isinstance(scene, TreeScene):
            files[f"{scene.name}.xml"] = tree_to_mjcf(scene)
            with suppress(InvalidInput):  # what URDF cannot say
                files[f"{scene.name}.urdf"] = tree_to_urdf(scene)
            continue
        files[f"{scene.name}.xml"] = to_mjcf(scene.system)
        files[f"{scene.name}.urdf"] = to_urdf(scene.system)
    return files


def main(folder: Path = FOLDER) -> None:
    """Write all model files into ``folder``, and delete those of scenes that no longer exist."""
    folder.mkdir(exist_ok=True)
    files = model_files()
    for stale in {path.name for path in folder.iterdir()} - set(files):
        (folder / stale).unlink()
    for name, content in files.items():
        write_whole(folder / name, content)


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
