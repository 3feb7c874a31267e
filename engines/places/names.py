"""Names of engines in a place of their own: ``mujoco@3.3.7``, ``./venv:mujoco``, ``./program``.

Nothing is started or made here, and no engine is imported.
"""

from __future__ import annotations

import os
import re
import sys
from dataclasses import dataclass
from typing import Literal

from ...models.errors import InvalidInput

_VERSIONED = re.compile(r"(?P<engine>[A-Za-z][\w-]*)@(?P<version>.+)$")
_VERSION = re.compile(r"[0-9]+(\.[0-9]+)*((a|b|rc)[0-9]+)?(\.post[0-9]+)?(\.dev[0-9]+)?$")


@dataclass(frozen=True)
class Place:
    """``name``: as it is given; ``engine``: one of furiko's names, empty for a program.

    ``kind``: a ``version`` that is installed in an environment of its own, an ``environment`` that is there, or a
    ``program``; ``version``: which; ``path``: the environment's folder, or the program, as it was given.
    """

    name: str
    kind: Literal["version", "environment", "program"]
    engine: str = ""
    version: str = ""
    path: str = ""

    @property
    def located(self) -> str:
        """The absolute path: from the current folder, or from one of Python's; a worker has another current one.

        Raises :class:`InvalidInput` where there is none such.
        """
        for folder in ("", *sys.path):
            found = os.path.join(folder, self.path)
            if os.path.exists(found):
                return os.path.abspath(found)
        raise InvalidInput(f"engine: {self.name}: there is no {self.kind} {self.path!r}")


def place_of(name: str) -> Place | None:
    """The place that a name says, None where it says none. Raises :class:`InvalidInput` for a version that is none."""
    if os.sep not in name.partition("@")[0] and (found := _VERSIONED.match(name)):
        version = found["version"].removeprefix("v")
        if not _VERSION.match(version):
            raise InvalidInput(
                f"engine: {name[:100]}: {version[:50]!r} is no version: write it in numbers, {found['engine']}@3.3.7"
            )
        return Place(name, "version", found["engine"], version)
    path, colon, engine = name.rpartition(":")
    if colon and not path.endswith(".py") and os.sep not in engine and _may_be_folder(path):
        return Place(name, "environment", engine, path=path)
    if not colon and os.sep in name and not name.endswith(".py"):
        return Place(name, "program", path=name)
    return None


def _may_be_folder(path: str) -> bool:
    return os.sep in path or path in {".", ".."} or os.path.isdir(path)
