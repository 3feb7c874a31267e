"""Packages around a model file, in which meshes may lie that are not where it says."""

from __future__ import annotations

import re
from pathlib import Path

from ...models.readers.folders import package_folders

PACKAGE = re.compile(rb"(?:package|model)://([\w.+-]+)/")


def own_packages(path: Path) -> list[Path]:
    """The folders above the document at ``path`` that are the packages it names, as ``package://NAME/…``."""
    names = dict.fromkeys(name.decode() for name in PACKAGE.findall(path.read_bytes()))
    return [folder for name in names for folder in package_folders(path, name)]
