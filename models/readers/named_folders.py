"""Finds files in folders that the user named and in everything below them, by package or by the end of the path."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path, PurePosixPath

from ..errors import InvalidInput
from .bounded_file import read_bytes, shown
from .packages import declared, in_package, is_package, own_folders

MOST_ENTRIES = 50_000  # files and folders below one that was named
LEAST_OF_ABSOLUTE = 2  # parts of an absolute path that a file has to share with it
LARGEST_COMPARED = 100_000_000  # bytes of a file that is held against another one of the same name


class NamedFolders:
    """The folders that the user named, in their order, for the document at ``path``.

    What is below them is listed once, when it is first needed. Nothing outside a folder is found: links to folders are
    not followed, and a file that is a link must lead to another one below the same folder.
    """

    def __init__(self, path: Path, folders: Sequence[Path] = ()) -> None:
        self._document = path
        self._folders = [_Below(folder, path.resolve().parent) for folder in folders]

    def find(self, name: str) -> Path | None:
        """The file that ``name`` means, a path or ``package://NAME/…``; None where no folder has one called so.

        Never a file that only has the same last name, for that may be another robot's. Of a relative path all parts
        have to be there, those behind every ``..``; an absolute one, of another machine, has to share its last two;
        the longest end wins. Without its folders a name is taken only from a named folder itself. Of two folders that
        have one the first, and in a folder first what is there in so many words. Raises :class:`InvalidInput` where
        that leaves several with different contents, and for a folder with too much below it.
        """
        package, rest = in_package(name) or ("", ())
        if package:
            return self._in_package(package, rest, name)
        end = rest or _parts(name)
        if not end:
            return None
        for folder in self._folders:
            path = folder.path.joinpath(*end)
            if folder.has(path):
                return path
        absolute = name.startswith(("file://", "/"))
        least = min(len(end), LEAST_OF_ABSOLUTE) if absolute else len(end)
        for length in range(len(end), least - 1, -1):
            for folder in self._folders:
                if found := folder.ending(end[-length:]):
                    exact = folder.path.joinpath(*end[-length:])
                    return exact if exact in found else folder.one_of(found, name)
        flat = (folder.path / end[-1] for folder in self._folders if folder.has(folder.path / end[-1]))
        return next(flat, None)

    def _in_package(self, package: str, rest: tuple[str, ...], name: str) -> Path | None:
        """The file in a folder that is the package, else in one of the document's own folders that is no other one."""
        for folder in self._folders:
            if found := [path for path in folder.ending(rest) if folder.is_in(path, rest, package)]:
                return folder.one_of(found, name)
        for own in own_folders(self._document):
            path = own.joinpath(*rest)
            if any(folder.has(path) for folder in self._folders) and not declared(own):
                return path
        return None


def _parts(name: str) -> tuple[str, ...]:
    """The parts of a path behind its scheme and behind every ``..``."""
    parts = PurePosixPath(name.partition("://")[2] or name).parts
    parts = tuple(part for part in parts if part not in ("/", "//", "."))
    above = max((place for place, part in enumerate(parts) if part == ".."), default=-1)
    return parts[above + 1 :]


class _Below:
    """One folder, and the files below it; ``near``: the folder of the document."""

    def __init__(self, folder: Path, near: Path) -> None:
        self.path = folder.resolve()
        self._called = folder.name  # which may be a link
        self._near = near

    def has(self, path: Path) -> bool:
        return path.is_file() and path.resolve().is_relative_to(self.path)

    def ending(self, end: tuple[str, ...]) -> list[Path]:
        """The files whose path ends so."""
        return [path for path in self._by_name.get(end[-1], ()) if path.parts[-len(end) :] == end and self.has(path)]

    def is_in(self, path: Path, rest: tuple[str, ...], package: str) -> bool:
        """Whether the folder in which the file ``path`` has the path ``rest`` is the package."""
        folder = path.parents[len(rest) - 1]
        return is_package(folder, package) or (folder == self.path and self._called == package)

    @cached_property
    def _by_name(self) -> dict[str, list[Path]]:
        found: dict[str, list[Path]] = {}
        count = 0
        for folder, below, names in os.walk(self.path):
            count += len(below) + len(names)
            if count > MOST_ENTRIES:
                raise InvalidInput(
                    f"{shown(self.path)}: more than {MOST_ENTRIES} files and folders below it, the most that are "
                    "looked through; name a folder nearer to the meshes"
                )
            for name in names:
                found.setdefault(name, []).append(Path(folder, name))
        return found

    def one_of(self, found: list[Path], name: str) -> Path:
        """Any of the files that are nearest, if they are all alike. Raises :class:`InvalidInput`."""
        shared = {path: len(os.path.commonpath([path, self._near])) for path in found}
        first, *others = sorted(path for path in found if shared[path] == max(shared.values()))
        content = read_bytes(first, LARGEST_COMPARED) if others else b""
        for other in others:
            if read_bytes(other, LARGEST_COMPARED) != content:
                one, two = (shown(path.relative_to(self.path)) for path in (first, other))
                raise InvalidInput(
                    f"mesh {name[-80:]!r}: name the folder of the one that is meant: {one} and {two} differ, both in "
                    f"{shown(self.path)}"
                )
        return first
