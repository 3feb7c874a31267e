"""``furiko diagnose --fix``: the file's mechanism, written so that all engines read it alike."""

from __future__ import annotations

from pathlib import Path

from ...models import InvalidInput
from ...models.readers.model_file import ModelFile
from ...models.writers.spatial_mjcf import spatial_mjcf
from ...models.writers.spatial_urdf import spatial_urdf
from ...models.writers.whole_file import write_whole

WRITERS = {".xml": spatial_mjcf, ".mjcf": spatial_mjcf, ".urdf": spatial_urdf}


def write_fixed(model: ModelFile, out: Path) -> None:
    """Write the mechanism of a file that was read to ``out``; its ending says in which format.

    Every number stands where it acts: inertials in place of geoms, no default classes, no includes, names on all.
    Raises :class:`InvalidInput` for another ending, for the file itself, and where the format cannot hold the
    mechanism.
    """
    if out.suffix not in WRITERS:
        raise InvalidInput(f"{out}: the name must end in .xml (MJCF) or .urdf (URDF)")
    if out.exists() and _same(out, model.path):
        raise InvalidInput(f"{out}: this is the file itself, which is not overwritten; give another name")
    write_whole(out, WRITERS[out.suffix](model.spatial))


def _same(out: Path, path: str) -> bool:
    return Path(path).exists() and out.samefile(path)
