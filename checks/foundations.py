"""The files that an answer rests on, outside the scene: furiko's own files, and those of the packages that computed it.

A version says too little: a package may be edited in place, rebuilt, half removed, or hidden by another of its name on
the search path. So every file of code counts, by its path, its size and when it last changed.
"""

from __future__ import annotations

import hashlib
import os
import platform
import re
from functools import cache
from importlib.machinery import ModuleSpec, PathFinder
from importlib.metadata import Distribution, distributions
from importlib.util import find_spec
from pathlib import Path

ROOMS = ("models", "records", "reference", "engines", "diagnosis", "checks")
SHARED = {"numpy": "numpy", "python-flint": "flint", "heyoka": "heyoka", "scipy": "scipy", "numba": "numba"}
CODE = re.compile(r"\.(py|so|pyd|dll|dylib)(\.[0-9.]+)?$")
REQUIREMENT = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]*")


@cache
def own_foundation() -> bytes:
    """Digest of all that every result rests on: furiko's code and data, Python, and the libraries of the truth."""
    seal = hashlib.sha256(f"{platform.python_version()} {platform.machine()} {platform.node()}".encode())
    seal.update(own_code())
    for package, module in SHARED.items():
        seal.update(package_foundation(package, module))
    return seal.digest()


@cache
def own_code() -> bytes:
    """Digest of furiko's own code and data, the same on every machine."""
    seal = hashlib.sha256()
    root = Path(__file__).parent.parent
    for name in ROOMS:
        # In a checkout the folders stand at the root, in a wheel inside the package: beside each other in both.
        for path in sorted((root / name).rglob("*")):
            # __pycache__ holds what Python and Numba compiled from the code: it appears as furiko runs.
            if "__pycache__" not in path.parts[len(root.parts) :] and path.is_file():
                seal.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes())
    return seal.digest()


@cache
def place_foundation(python: str, path: tuple[str, ...], package: str, module: str) -> bytes:
    """The same for an engine in an environment of its own, whose Python has this search path; with that Python."""
    packages: dict[str, Distribution] = {}
    for name in (package, "numpy"):
        _closure(name, packages, path)
    found = PathFinder.find_spec(module, list(path))
    if found is None or len(packages) < 2 or any(map(_editable, packages.values())):
        return b""
    seal = hashlib.sha256(python.encode() + _stamp(os.path.realpath(python)))
    _add_place(seal, found)
    for name in sorted(packages):
        _add_files(seal, name, packages[name])
    return seal.digest()


@cache
def package_foundation(package: str, module: str) -> bytes:
    """Digest of an installed package's code, of all that it requires, and of the place that ``module`` comes from.

    Nothing is imported. Empty where the package or the module is not found, and for an editable install, whose code may
    be anywhere: then it is not known what an answer rests on.
    """
    try:
        found = find_spec(module)
    except (ImportError, ValueError):
        found = None
    packages = _closure(package, {})
    if found is None or not packages or any(map(_editable, packages.values())):
        return b""
    seal = hashlib.sha256()
    _add_place(seal, found)
    for name in sorted(packages):
        _add_files(seal, name, packages[name])
    return seal.digest()


def _add_place(seal: hashlib._Hash, found: ModuleSpec) -> None:
    """Where a module comes from."""
    places = [found.origin or "", *(found.submodule_search_locations or ())]
    seal.update("\0".join(places).encode())
    if found.origin:
        seal.update(_stamp(found.origin))


def _closure(
    package: str, found: dict[str, Distribution], path: tuple[str, ...] | None = None
) -> dict[str, Distribution]:
    """The package's distribution and those that it requires, by name; on ``path``, None for this Python's own."""
    name = re.sub(r"[-_.]+", "-", package).lower()
    if name in found:
        return found
    try:
        here = distributions(name=package) if path is None else distributions(name=package, path=list(path))
        found[name] = next(iter(here))
    except (StopIteration, ValueError):
        return found
    for line in found[name].requires or ():
        match = REQUIREMENT.match(line)
        if match and "extra ==" not in line:
            _closure(match.group(), found, path)
    return found


def _editable(package: Distribution) -> bool:
    return '"editable": true' in (package.read_text("direct_url.json") or "")


def _add_files(seal: hashlib._Hash, name: str, package: Distribution) -> None:
    seal.update(f"{name} {package.version}".encode())
    base = str(package.locate_file(""))
    for line in (package.read_text("RECORD") or "").splitlines():
        path = line.partition(",")[0].strip('"')
        if CODE.search(path):
            seal.update(path.encode() + _stamp(os.path.join(base, path)))


def _stamp(path: str) -> bytes:
    """Size and last change of a file: the time of change of its entry, which no copy and no `touch` can set back."""
    try:
        status = os.stat(path)
    except OSError:
        return b"missing"
    return f"{status.st_size} {status.st_mtime_ns} {status.st_ctime_ns}".encode()
