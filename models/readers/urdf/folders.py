"""Where the meshes that a URDF document names are looked for: never outside the folders that belong to it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from ..folders import in_own_package
from ..named_folders import NamedFolders
from ..packages import in_package
from ..xml_file import Element


class MeshFolders:
    """The folder of the document at ``path``, and ``others``, which the user named.

    ``package://NAME/REST`` is REST in the folder NAME: the document's own folder or one of the three above it if it is
    that package (:mod:`..packages`). Other names are taken from the document's folder. What is in neither is looked for
    in ``others`` and below (:class:`NamedFolders`).
    """

    def __init__(self, path: Path, others: Sequence[Path] = ()) -> None:
        self._path = path
        self._own = path.resolve().parent
        self._others = NamedFolders(path, others)

    def find(self, element: Element, attribute: str = "filename") -> Path:
        """The file that ``element`` names. Raises :class:`InvalidInput` where it is not in any of these folders."""
        name = element.get(attribute)
        try:
            found = in_own_package(self._path, name) or self._beside(name) or self._others.find(name)
        except (OSError, ValueError, RuntimeError) as error:
            raise element.wrong(f"{attribute}={name[:80]!r}: {error}") from None
        if found is None:
            package, _ = in_package(name) or ("", ())
            advice = f"; name, with --meshes, a folder {package[:60]}, or one whose package.xml says so"
            raise element.wrong(
                f"{attribute}={name[:80]!r}: no such mesh in the document's own folder or those that were named for "
                f"meshes{advice if package else ''}"
            )
        return found

    def _beside(self, name: str) -> Path | None:
        if in_package(name):
            return None
        path = (self._own / name.removeprefix("file://")).resolve()
        return path if path.is_relative_to(self._own) and os.path.isfile(path) else None
