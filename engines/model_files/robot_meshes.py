"""Where a mesh lies that is not where a model file says: in packages around it, and folders that the user names."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path, PurePosixPath

from ...models.readers.folders import package_folders

PACKAGE = re.compile(rb"package://([\w.+-]+)/")


def own_packages(path: Path) -> list[Path]:
    """The folders above the document at ``path`` that are the packages it names as ``package://NAME/…``."""
    names = dict.fromkeys(name.decode() for name in PACKAGE.findall(path.read_bytes()))
    return [folder for name in names for folder in package_folders(path, name)]


def find_in(folders: Sequence[Path], wanted: str) -> Path | None:
    """The file that ``wanted`` names, a relative path or ``package://NAME/…``, in the first folder that has it.

    The whole path below the folder is looked for, then, as in a folder that is the package itself, without its first
    part, and so on to the bare name. Never outside the folders: parts ``..`` are refused.
    """
    parts = [part for part in PurePosixPath(wanted.partition("://")[2] or wanted).parts if part not in {"/", "."}]
    if ".." in parts:
        parts = parts[-1:] if parts and parts[-1] != ".." else []
    for first in range(len(parts)):
        for folder in folders:
            candidate = folder.joinpath(*parts[first:])
            if candidate.is_file() and candidate.resolve().is_relative_to(folder.resolve()):
                return candidate
    return None
