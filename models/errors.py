"""The errors that a user can correct: invalid input, and an engine or a library that is not installed."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from importlib import import_module
from typing import Any

# By package, the extra of furiko that brings it: ``pip install 'furiko[fast]'``.
EXTRAS = {
    "mujoco": "mujoco",
    "pin": "pin",
    "exudyn": "exudyn",
    "drake": "drake",
    "dartpy": "dart",
    "mujoco-mjx": "mjx",
    "mujoco-warp": "mujoco-warp",
    "pybullet": "pybullet",
    "sympy": "sympy",
    "numba": "fast",
    "heyoka": "truth",
    "scipy": "scipy",
    "pyarrow": "sweep",
    "distributed": "sweep",
}


class InvalidInput(ValueError):
    """A user's input is invalid; the message says what, where, and what would be right."""


class LibraryMissing(RuntimeError):
    """A library that only some of furiko needs cannot be imported; the message says how to install it."""


class EngineMissing(LibraryMissing):
    """An engine that was asked for cannot be imported; the message says how to install it."""


def nearest(word: str, known: Iterable[str]) -> str:
    """A hint naming the known word closest to ``word``: `` (did you mean 'x'?)``, or an empty string."""
    close = difflib.get_close_matches(word, list(known), n=1)
    return f" (did you mean {close[0]!r}?)" if close else ""


def installing(package: str) -> str:
    """The command that installs a package: by furiko's extra where one brings it."""
    return f"pip install 'furiko[{EXTRAS[package]}]'" if package in EXTRAS else f"pip install {package}"


def installing_all() -> str:
    """The command that installs all engines."""
    return "pip install 'furiko[engines]'"


def missing(package: str, error: ImportError | None = None) -> LibraryMissing:
    """The error for a package that could not be imported; one that is there, and broken, is told in brackets."""
    broken = error is not None and not (isinstance(error, ModuleNotFoundError) and error.name == package)
    return LibraryMissing(f"this needs {package}: {installing(package)}{f' [{error}]' if broken else ''}")


def library(module: str) -> Any:
    """Import a module of a library that only some of furiko needs. Raises :class:`LibraryMissing`."""
    package = module.partition(".")[0]
    try:
        import_module(package)
        return import_module(module)
    except ImportError as error:
        raise missing(package, error) from error
