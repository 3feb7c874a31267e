"""Folders that are ROS packages: ``package://NAME/REST`` is REST in the folder of the package NAME."""

from __future__ import annotations

import os
import posixpath
import re
from pathlib import Path

from ..errors import InvalidInput
from .bounded_file import read_bytes

LEVELS = 3  # a package's own folder is looked for in this many folders above the document's
SCHEMES = ("package://", "model://", "package:/", "model:/")
LARGEST_MANIFEST = 1_000_000  # bytes of a package.xml
COMMENT = re.compile(rb"<!--.*?-->", re.DOTALL)
NAME = re.compile(rb"<name>\s*([^<\s]+)\s*</name>")


def in_package(name: str) -> tuple[str, tuple[str, ...]] | None:
    """The package and the parts of the path in it that ``package://NAME/REST`` or ``model://NAME/REST`` says.

    None for every other name. ``..`` goes up, out of the package too: ``package://a/../b/c`` is ``package://b/c``.
    No package, but a path from the document's folder, is what CAD exporters write as ``package:///a.stl`` and
    ``package://a.stl``; MuJoCo makes ``package:/a.stl`` of it.
    """
    scheme = next((scheme for scheme in SCHEMES if name.startswith(scheme)), "")
    if not scheme:
        return None
    inside = name.removeprefix(scheme)
    package, *rest = posixpath.normpath("/" + inside).lstrip("/").split("/")
    if inside.startswith("/") or not rest:
        return "", tuple(part for part in (package, *rest) if part)
    return package, tuple(rest)


def own_folders(path: Path) -> list[Path]:
    """The folder of the document at ``path`` and the :data:`LEVELS` above it, the nearest first."""
    here = path.resolve().parent
    return [here, *list(here.parents)[:LEVELS]]


def is_package(folder: Path, package: str) -> bool:
    """Whether a folder is this package: it is called so, or its ``package.xml`` says so."""
    return bool(package) and (folder.name == package or declared(folder) == package)


def declared(folder: Path) -> str:
    """The name that the ``package.xml`` in a folder gives it, empty where it has none."""
    manifest = folder / "package.xml"
    if not os.path.isfile(manifest):
        return ""
    try:
        found = NAME.search(COMMENT.sub(b"", read_bytes(manifest, LARGEST_MANIFEST)))
    except InvalidInput:
        return ""
    return found[1].decode(errors="replace") if found else ""
