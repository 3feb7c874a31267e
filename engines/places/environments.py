"""Environments that furiko makes for versions of engines: once, kept in its cache, listed and removed.

Each is a folder with a virtual environment in it and, written last, a file that says what it holds: a folder without
that file was cut off and is made again. Only one process makes it at a time; others wait.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import shutil
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from ...models.errors import EngineMissing, InvalidInput
from ...models.writers.whole_file import replace_file
from ..releases import needed_beside, release
from .index import near
from .installing import Installer, NotInstalled, installer
from .surveys import survey

if sys.platform != "win32":
    import fcntl

MARKER = "furiko-environment.json"
FORMAT = 1


@dataclass(frozen=True)
class Kept:
    """An environment that is whole.

    ``requirements``: what was asked for; ``packages``: what is installed, with versions; ``made``: seconds since the
    epoch; ``by``: what installed it.
    """

    name: str
    folder: Path
    python: str
    requirements: tuple[str, ...]
    packages: dict[str, str]
    made: float
    by: str

    @property
    def executable(self) -> Path:
        """Its Python."""
        return self.folder / "bin" / "python"


def environments_folder() -> Path:
    """Where environments are kept: in the folder where this system keeps such things, or in ``FURIKO_CACHE``."""
    import platformdirs

    return Path(os.environ.get("FURIKO_CACHE") or platformdirs.user_cache_dir("furiko")) / "environments"


def kept_name(package: str, version: str) -> str:
    """The name of a version's environment."""
    numbers = ".".join(map(str, release(version))) + re.sub(r"^[0-9.]*[0-9]", "", version)
    return f"{package}-{numbers}-py{sys.version_info.major}.{sys.version_info.minor}"


def kept(name: str) -> Kept | None:
    """The environment of this name; None where there is none, or it was cut off."""
    folder = environments_folder() / name
    try:
        content = json.loads((folder / MARKER).read_text(encoding="utf-8"))
        if content["format"] != FORMAT or not (folder / "bin" / "python").exists():
            return None
        return Kept(
            name=name,
            folder=folder,
            python=str(content["python"]),
            requirements=tuple(map(str, content["requirements"])),
            packages={str(key): str(value) for key, value in content["packages"].items()},
            made=float(content["made"]),
            by=str(content["by"]),
        )
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None


def all_kept() -> list[Kept]:
    """All whole environments, by name."""
    folder = environments_folder()
    names = sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []
    return [found for name in names if (found := kept(name)) is not None]


def ensure(package: str, version: str, module: str) -> Kept:
    """The environment with this version of a package, which is made where there is none.

    Raises :class:`EngineMissing` where it cannot be, with the versions that are near.
    """
    requirements = (f"{package}=={version}", *needed_beside(package, version))
    name = kept_name(package, version)
    found = kept(name)
    if found is not None and found.requirements == requirements:
        return found
    with _alone(name):
        found = kept(name)  # another process may have made it meanwhile
        if found is not None and found.requirements == requirements:
            return found
        return _made(name, requirements, package, version, module)


def remove(name: str) -> None:
    """Remove an environment, whole or cut off. Raises :class:`InvalidInput` where there is none of this name."""
    folder = environments_folder() / name
    if os.sep in name or name in {"", ".", ".."} or not folder.is_dir():
        raise InvalidInput(f"environment: there is none called {name!r}; furiko environments lists them")
    with _alone(name):
        _remove(folder)


def size_of(environment: Kept) -> int:
    """Bytes of all its files."""
    total = 0
    for folder, _, files in os.walk(environment.folder):
        for file in files:
            with contextlib.suppress(OSError):
                total += os.lstat(os.path.join(folder, file)).st_size
    return total


def _made(name: str, requirements: tuple[str, ...], package: str, version: str, module: str) -> Kept:
    folder = environments_folder() / name
    _remove(folder)
    tool = installer()
    _say(f"making an environment with {package} {version}, once ({tool.name}; kept in {folder})")
    try:
        tool.create(folder)
        tool.install(folder / "bin" / "python", requirements)
        packages = survey(folder / "bin" / "python").packages
        tool.imports(folder / "bin" / "python", module)
    except NotInstalled as error:
        _remove(folder)
        raise EngineMissing(_why(tool, package, version, str(error))) from None
    except BaseException:
        _remove(folder)
        raise
    python = f"{sys.version_info.major}.{sys.version_info.minor}.{sys.version_info.micro}"
    made = Kept(name, folder, python, requirements, dict(packages), time.time(), tool.name)
    content = asdict(made) | {"format": FORMAT}
    del content["folder"], content["name"]
    replace_file(folder / MARKER, json.dumps(content, indent=1).encode())
    return made


def _why(tool: Installer, package: str, version: str, words: str) -> str:
    """One line: what, why, and which versions there are near."""
    where = near(package, version)
    there = f"; releases near it: {', '.join(where)}" if where else ""
    return f"{package} {version} cannot be installed: {words} ({tool.name}){there}"


def _remove(folder: Path) -> None:
    with contextlib.suppress(FileNotFoundError):
        (folder / MARKER).unlink()  # first: what is left of it then is known to be cut off
    shutil.rmtree(folder, ignore_errors=True)


@contextlib.contextmanager
def _alone(name: str) -> Iterator[None]:
    """Hold the lock of this environment; the system releases it where a process dies."""
    folder = environments_folder()
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        descriptor = os.open(folder / f".{name}.lock", os.O_RDWR | os.O_CREAT, 0o600)
    except OSError as error:
        raise EngineMissing(f"{folder}: environments cannot be kept there: {error.strerror}") from None
    try:
        if sys.platform != "win32":  # there, two that make one at a time are not kept apart
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def _say(words: str) -> None:
    if sys.stderr is not None and sys.stderr.isatty():
        print(f"furiko: {words}", file=sys.stderr, flush=True)
