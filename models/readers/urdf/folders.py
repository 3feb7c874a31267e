"""Where the meshes that a URDF document names are looked for: never outside the folders that belong to it."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from ..folders import package_folders
from ..xml_file import Element


class MeshFolders:
    """The folder of the document at ``path``, and ``others``, which the user named.

    ``package://NAME/REST`` is REST in the folder NAME: the document's own folder or one of the three above it if it is
    called so, or NAME in one of ``others``, or one of them if it is called so. Other names are taken from the
    document's folder, or from one of ``others`` (with their folders, or without).
    """

    def __init__(self, path: Path, others: Sequence[Path] = ()) -> None:
        self._path = path
        self._own = path.resolve().parent
        self._others = [other.resolve() for other in others]

    def find(self, element: Element, attribute: str = "filename") -> Path:
        """The file that ``element`` names. Raises :class:`InvalidInput` where it is not in any of these folders."""
        name = element.get(attribute)
        try:
            for folder, rest in self._places(name):
                path = (folder / rest).resolve()
                if path.is_relative_to(folder) and os.path.isfile(path):
                    return path
        except (OSError, ValueError, RuntimeError) as error:
            raise element.wrong(f"{attribute}={name[:80]!r}: {error}") from None
        raise element.wrong(
            f"{attribute}={name[:80]!r}: no such mesh in the document's own folder or those that were named for meshes"
        )

    def _places(self, name: str) -> Iterator[tuple[Path, str]]:
        if name.startswith("package://"):
            package, _, rest = name.removeprefix("package://").partition("/")
            named = (folder for folder in self._others if folder.name == package)
            for folder in (*package_folders(self._path, package), *named):
                yield folder, rest
            for folder in self._others:
                if package not in ("", ".", ".."):
                    yield folder / package, rest
            return
        name = name.removeprefix("file://")
        for folder in (self._own, *self._others):
            yield folder, name
        for folder in self._others:
            yield folder, Path(name).name
