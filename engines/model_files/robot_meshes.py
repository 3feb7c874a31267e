"""Packages around a model file, in which meshes may lie that are not where it says."""

from __future__ import annotations

import re
from pathlib import Path

PACKAGE = re.compile(rb"(?:package|model)://")


def names_packages(path: Path) -> bool:
    """Whether the document at ``path`` has paths in packages, ``package://NAME/…``, which engines do not resolve."""
    return PACKAGE.search(path.read_bytes()) is not None
