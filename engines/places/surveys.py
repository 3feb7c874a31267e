"""What an environment has: the version of its Python, its search path, its packages. It is asked once a run."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from ...models.errors import EngineMissing
from .connection import OF_THIS_PYTHON

SURVEY = Path(__file__).with_name("survey.py")
OLDEST = (3, 10)  # of Python, that runs the adapters
LIMIT = 60.0  # [s]


@dataclass(frozen=True)
class Survey:
    """``python``: its version; ``path``: its search path; ``packages``: names in lower case, with versions."""

    python: str
    path: tuple[str, ...]
    packages: dict[str, str]


@cache
def survey(executable: Path) -> Survey:
    """Ask a Python. Raises :class:`EngineMissing` where it does not answer, or is too old for the adapters."""
    try:
        done = subprocess.run(
            [str(executable), "-I", str(SURVEY)],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=LIMIT,
            env=own_environment(),
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise EngineMissing(f"{executable}: this Python cannot be started: {error}") from None
    try:
        content = json.loads(done.stdout[: 16 << 20] or b"{}")
        found = Survey(str(content["version"]), tuple(map(str, content["path"])), dict(content["packages"]))
    except (ValueError, KeyError, TypeError):
        words = " ".join(done.stderr.decode("utf-8", "replace").split())[-300:]
        raise EngineMissing(f"{executable}: this is no Python that answers: {words or 'it said nothing'}") from None
    if tuple(map(int, found.python.split(".")[:2])) < OLDEST:
        needed = ".".join(map(str, OLDEST))
        raise EngineMissing(f"{executable}: its Python is {found.python}; the adapters need {needed} or newer")
    return found


def own_environment() -> dict[str, str]:
    """The variables for another Python, or for what installs packages: without those that are of this one."""
    import os

    return {name: value for name, value in os.environ.items() if name not in OF_THIS_PYTHON}


def same_python() -> str:
    """The version of Python that furiko runs on, as far as it tells which packages fit: ``3.11``."""
    return f"{sys.version_info.major}.{sys.version_info.minor}"
