"""Adapters from elsewhere: of a plug-in, of a module on Python's path, or of a file.

A plug-in is a package that declares in its ``pyproject.toml`` ::

    [project.entry-points."furiko.engines"]
    my-engine = "my_package.adapter:MyEngine"

and is an engine of that name wherever furiko takes one.
"""

from __future__ import annotations

import importlib
import os
import sys
import zlib
from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any, get_args

from ..models import InvalidInput
from ..models.errors import nearest
from .info import EngineInfo, Quantity

GROUP = "furiko.engines"
EXAMPLE = "; `furiko engine-test --help` shows one"
NEEDED = ("accelerations",)  # what every adapter has


def plugin_names() -> list[str]:
    """The names of the engines that installed packages declare, in alphabetical order."""
    return sorted(_plugins())


def is_elsewhere(name: str) -> bool:
    """Whether a name is that of a class in a module, or of a file."""
    return ":" in name or _is_file(name)


def look_in_current_folder(names: Iterable[str]) -> None:
    """For adapters from elsewhere: put the current folder on Python's path, after all else."""
    if any(map(is_elsewhere, names)) and os.getcwd() not in sys.path:
        sys.path.append(os.getcwd())


def adapter(name: str) -> Any:
    """The adapter that ``module:Class``, ``path/to/file.py:Class``, ``path/to/file.py`` or a plug-in's name names.

    Importing it runs its code. Raises :class:`InvalidInput` where there is none such, or the import fails.
    """
    if not is_elsewhere(name):
        return adapter(_plugins()[name])
    if _is_file(name):
        return _of_file(name)
    module, _, attribute = name.partition(":")
    try:
        return getattr(importlib.import_module(module), attribute)
    except ImportError as error:
        own = isinstance(error, ModuleNotFoundError) and error.name in (module, module.partition(".")[0])
        where = "; it is looked for in the current folder by the command line, and on PYTHONPATH" if own else ""
        raise InvalidInput(f"engine: {name}: cannot import {module!r}: {error}{where}") from None
    except (AttributeError, ValueError, TypeError):
        raise InvalidInput(f"engine: {name}: the module {module!r} has no class {attribute!r}") from None


def info_of(name: str) -> EngineInfo:
    """The :class:`EngineInfo` of an adapter. Raises :class:`InvalidInput` where it has none.

    What the class has no method for is missing, whether its author says so or not.
    """
    found = adapter(name)
    info = getattr(found, "info", None)
    if not isinstance(info, EngineInfo):
        raise InvalidInput(f"engine: {name} has no attribute 'info' that is a furiko.engines.EngineInfo{EXAMPLE}")
    absent = {
        quantity: f"the adapter has no method {quantity}"
        for quantity in get_args(Quantity)
        if quantity not in NEEDED and not callable(getattr(found, quantity, None))
    }
    return replace(info, missing=absent | dict(info.missing)) if absent else info


@cache
def _plugins() -> dict[str, str]:
    from importlib.metadata import entry_points  # takes 20 ms, and most runs never ask

    return {point.name: point.value for point in entry_points(group=GROUP)}


def _is_file(name: str) -> bool:
    path, _ = _file_and_class(name)
    return path.endswith(".py") or os.sep in path


def _file_and_class(name: str) -> tuple[str, str]:
    path, colon, attribute = name.rpartition(":")
    return (path, attribute) if colon and os.sep not in attribute and not attribute.endswith(".py") else (name, "")


def _of_file(name: str) -> Any:
    path, attribute = _file_and_class(name)
    module = _module_of(_located(path, name))
    if attribute:
        if not hasattr(module, attribute):
            hint = nearest(attribute, [known for known, _ in _adapters_in(module)])
            raise InvalidInput(f"engine: {name}: the file has no class {attribute!r}{hint}")
        return getattr(module, attribute)
    found = _adapters_in(module)
    if len(found) != 1:
        several = ", ".join(f"{path}:{known}" for known, _ in found)
        what = (
            f"the file has several adapters: name one, {several}"
            if found
            else f"the file has no class with an attribute 'info' that is a furiko.engines.EngineInfo{EXAMPLE}"
        )
        raise InvalidInput(f"engine: {name}: {what}")
    return found[0][1]


def _adapters_in(module: ModuleType) -> list[tuple[str, type]]:
    """The adapters among the classes that the module defines itself."""
    return [
        (name, value)
        for name, value in vars(module).items()
        if isinstance(value, type)
        and value.__module__ == module.__name__
        and isinstance(getattr(value, "info", None), EngineInfo)
    ]


def _located(path: str, name: str) -> str:
    """The file's absolute path: from the current folder, or from one of Python's; a worker has another current one."""
    for folder in ("", *sys.path):
        if os.path.isfile(os.path.join(folder, path)):
            return os.path.abspath(os.path.join(folder, path))
    raise InvalidInput(f"engine: {name}: there is no file {path!r}")


@cache
def _module_of(path: str) -> ModuleType:
    """The module of a file, under a name of its own; it can import what stands beside it."""
    known = f"furiko_engine_{Path(path).stem}_{zlib.crc32(path.encode()):x}"
    spec = spec_from_file_location(known, path)
    if spec is None or spec.loader is None:
        raise InvalidInput(f"engine: {path}: a file of Python code ends in .py")
    module = module_from_spec(spec)
    sys.modules[known] = module  # dataclasses and pickle look a class's module up
    folder = str(Path(path).parent)
    if folder not in sys.path:
        sys.path.append(folder)
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[known]
        raise InvalidInput(f"engine: {path}: it cannot be imported: {type(error).__name__}: {error}") from None
    return module
