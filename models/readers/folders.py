"""Which files a document may have read: those of its own folder and below, and of folders that the user named."""

from __future__ import annotations

import os
import posixpath
from collections.abc import Sequence
from pathlib import Path

from .bounded_file import shown
from .named_folders import NamedFolders
from .packages import in_package, is_package, own_folders
from .xml_file import Element


def package_folders(path: Path, package: str) -> list[Path]:
    """Of the document's own folders those that are the ``package``; see :mod:`.packages`."""
    return [folder for folder in own_folders(path) if is_package(folder, package)]


def in_own_package(path: Path, name: str) -> Path | None:
    """The file ``package://NAME/REST`` in one of :func:`package_folders` of the document at ``path``.

    One without a package (``package:///REST``) is beside the document.
    """
    package, rest = in_package(name) or ("", ())
    here = [path.resolve().parent] if rest and not package else []
    for folder in here or package_folders(path, package):
        found = folder.joinpath(*rest).resolve()
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

        In the others a ``mesh`` is looked for below, too, by its path (:class:`NamedFolders`).
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
            elsewhere = self._below.find(posixpath.join(folder, name)) if mesh else self._beside(name)
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
