"""Which files a document may have read: those of its own folder and below, and of folders that the user named."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from .bounded_file import shown
from .named_folders import NamedFolders
from .xml_file import Element

LEVELS = 3  # a package's own folder is looked for in this many folders above the document's


def package_folders(path: Path, package: str) -> list[Path]:
    """Of the folder of the document at ``path`` and the :data:`LEVELS` above it those that are the ``package``."""
    here = path.resolve().parent
    return [folder for folder in (here, *list(here.parents)[:LEVELS]) if folder.name == package]


def in_own_package(path: Path, name: str) -> Path | None:
    """The file ``package://NAME/REST`` in one of :func:`package_folders` of the document at ``path``."""
    if not name.startswith("package://"):
        return None
    package, _, rest = name.removeprefix("package://").partition("/")
    for folder in package_folders(path, package):
        found = (folder / rest).resolve()
        if found.is_relative_to(folder) and os.path.isfile(found):
            return found
    return None


class Folders:
    """The folder of the model at ``path``, against which names are resolved, and ``others``, which may be read too."""

    def __init__(self, path: Path, others: Sequence[Path] = ()) -> None:
        self.own = path.resolve().parent
        self._others = [other.resolve() for other in others]
        self._below = NamedFolders(path, others)
        self._found: dict[str, Path] = {}  # the folders of files found so far, by what elements call these

    def find(self, element: Element, name: str, folder: str = "", *, mesh: bool = False) -> Path:
        """The file ``name`` in the model's ``folder``, beside an included file that names it, or in the others.

        In the others a ``mesh`` is looked for below, too, by the end of its path (:class:`NamedFolders`).
        MuJoCo looks in this order too: what an included file names may lie beside it, whatever ``folder`` is. Raises
        :class:`InvalidInput`, at ``element``, where it is nowhere, or only where nothing may be read.
        """
        named = f"file={name[:80]!r}"
        try:
            wanted = (self.own / folder / name).resolve()
            included = self._found.get(element.file)
            for path in (wanted, *(() if included is None else ((included / name).resolve(),))):
                if _inside(path, (self.own, *self._others)) and os.path.isfile(path):
                    return self._kept(path)
            elsewhere = self._below.find(f"{folder}/{name}") if mesh else self._beside(name)
            if elsewhere is not None:
                return self._kept(elsewhere)
        except (OSError, ValueError, RuntimeError) as error:
            raise element.wrong(f"{named}: {error}") from None
        if not _inside(wanted, (self.own, *self._others)):
            both = os.path.commonpath([self.own, wanted.parent])
            raise element.wrong(
                f"{named}: outside the model's own folder, where nothing is read; move it inside, or name its folder "
                f"with --meshes: {both[-200:]} holds both"
            )
        raise element.wrong(f"{named}: cannot be read: there is no such file in the model's folder")

    def _beside(self, name: str) -> Path | None:
        """The file in one of the other folders themselves, with the folders of its name or without."""
        for other in self._others:
            for tail in (name, Path(name).name):
                path = (other / tail).resolve()
                if _inside(path, (other,)) and os.path.isfile(path):
                    return path
        return None

    def _kept(self, path: Path) -> Path:
        self._found[shown(path)] = path.parent
        return path


def _inside(path: Path, folders: Sequence[Path]) -> bool:
    return any(path.is_relative_to(folder) for folder in folders)
