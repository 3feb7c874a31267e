"""Results and truths kept from earlier runs, each under the digest of everything that it depends on.

An entry's name is the SHA-256 of its inputs: the scene, the engine and its version, the check, the states, and the
source of every module that takes part. Nothing is ever changed in place, so two runs at once do not disturb each other:
an entry is written under another name and renamed. A disk that is full or not writable, or an entry that is damaged,
costs the time to compute it again and nothing else.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import platform
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import msgspec

from ..models import Scene
from ..records.check import Result
from .plan import Task

SOURCES = ("models", "records", "reference", "engines", "diagnosis", "checks")
_results = msgspec.json.Decoder(list[Result])


@dataclass(frozen=True)
class Cache:
    """A folder of entries; ``None`` for a run that keeps nothing and finds nothing."""

    folder: Path | None

    def results(self, task: Task, version: str) -> list[Result] | None:
        """The results of an earlier run of this very task, marked as kept; None where it has to run."""
        content = self._load(_results_key(task, version))
        if content is None:
            return None
        try:
            found = _results.decode(content)
        except msgspec.DecodeError:
            return None
        return [msgspec.structs.replace(result, kept=True, seconds=0.0) for result in found]

    def keep_results(self, task: Task, version: str, results: list[Result]) -> None:
        """Keep all of a task's results, unless one is a failure: that may have passed by next time."""
        if all(result.outcome != "error" for result in results):
            self._save(_results_key(task, version), msgspec.json.encode(results))

    def facts(self, scene: Scene, random_states: int) -> bytes | None:
        """A scene's truth as its worker sent it; None where it has to be computed."""
        sealed = self._load(_facts_key(scene, random_states))
        if sealed is None or hashlib.sha256(sealed[32:]).digest() != sealed[:32]:
            return None
        return sealed[32:]

    def keep_facts(self, scene: Scene, random_states: int, content: bytes) -> None:
        """Keep a scene's truth."""
        self._save(_facts_key(scene, random_states), hashlib.sha256(content).digest() + content)

    def _path(self, key: str) -> Path | None:
        return self.folder / key[:2] / key[2:] if self.folder else None

    def _load(self, key: str) -> bytes | None:
        path = self._path(key)
        try:
            return path.read_bytes() if path else None
        except OSError:
            return None

    def _save(self, key: str, content: bytes) -> None:
        path = self._path(key)
        if path is None:
            return
        draft = path.with_name(f"{path.name}.{os.getpid()}")
        with contextlib.suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            try:
                draft.write_bytes(content)
                draft.replace(path)
            finally:
                draft.unlink(missing_ok=True)

    def entries(self) -> list[Path]:
        """Files of all entries."""
        return [path for path in self.folder.glob("??/*") if path.is_file()] if self.folder else []

    def clear(self) -> int:
        """Delete every entry; returns how many there were."""
        found = self.entries()
        for path in found:
            path.unlink(missing_ok=True)
        return len(found)


def user_cache() -> Cache:
    """The cache in the folder where this system keeps such things, or in ``FURIKO_CACHE``."""
    import platformdirs

    return Cache(Path(os.environ.get("FURIKO_CACHE") or platformdirs.user_cache_dir("furiko")))


def _results_key(task: Task, version: str) -> str:
    return _digest("results", _scene(task.scene), task.engine, version, repr(task.checks), str(task.random_states))


def _facts_key(scene: Scene, random_states: int) -> str:
    return _digest("facts", _scene(scene), str(random_states))


def _scene(scene: Scene) -> str:
    """Everything of a scene that a result depends on, and nothing that it does not."""
    system = scene.system
    parts = (scene.name, system, scene.theta, scene.omega, scene.duration, scene.random, scene.named)
    return repr(parts)


def _digest(*parts: str) -> str:
    seal = hashlib.sha256(sources_digest())
    for part in parts:
        content = part.encode()
        seal.update(len(content).to_bytes(8, "big") + content)
    return seal.hexdigest()


@cache
def sources_digest() -> bytes:
    """Digest of furiko's own source that results depend on, and of the Python and numpy that run it."""
    from importlib.metadata import version

    root = Path(__file__).parent.parent
    seal = hashlib.sha256(f"{platform.python_version()} {version('numpy')} {version('python-flint')}".encode())
    for name in SOURCES:
        # In a checkout the folders stand at the root, in a wheel inside the package: beside each other in both.
        for path in sorted((root / name).rglob("*.py")):
            seal.update(path.relative_to(root).as_posix().encode() + path.read_bytes())
    return seal.digest()
