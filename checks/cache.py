"""Results and truths kept from earlier runs, each under the digest of everything that it rests on.

An entry's name is the SHA-256 of its inputs: the scene, the engine and its code, the checks, the states, and furiko's
own code and data (:mod:`.foundations`). What cannot be known is not kept: an adapter from elsewhere may rest on
anything. An entry holds its own digest and the number of its results. Nothing is ever changed in place, so two runs at
once do not disturb each other: an entry is written under another name and renamed. A disk that is full or not writable,
or an entry that is damaged, costs the time to compute it again and nothing else.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import random
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

from ..engines import ENGINES, environment_of
from ..models import AnyScene, InvalidInput, TreeScene
from ..models.readers.bounded_file import read_bytes
from ..models.writers.whole_file import replace_file
from ..records.check import Diagnosis, Result
from .foundations import own_foundation, package_foundation, place_foundation
from .plan import Task

LARGEST = 512 << 20  # bytes of the whole folder; the entries that were used least recently go first
LARGEST_ENTRY = 64 << 20  # bytes; the truth of a hundred links in a thousand states is a tenth of that
DIGEST = 32


class _Entry(msgspec.Struct, frozen=True):
    count: int
    results: list[Result]
    diagnoses: list[Diagnosis]


_entries = msgspec.json.Decoder(_Entry)


@dataclass(frozen=True)
class Kept:
    """The records of an earlier run of a task."""

    results: list[Result]
    diagnoses: list[Diagnosis]


@dataclass(frozen=True)
class Holding:
    """The entries of one kind in the folder."""

    entries: int
    size: int  # bytes
    oldest: float | None  # seconds since the epoch: the last use of the entry that has not been used for longest
    newest: float | None  # and of the one that was used last


@dataclass(frozen=True)
class Cache:
    """A folder of entries; ``None`` for a run that keeps nothing and finds nothing."""

    folder: Path | None
    largest: int = LARGEST

    def results(self, task: Task) -> Kept | None:
        """The results and diagnoses of an earlier run of this very task, marked as kept; None where it has to run."""
        content = self._load("results", _results_key(task) if self.folder else None)
        if content is None:
            return None
        try:
            entry = _entries.decode(content)
        except msgspec.DecodeError:
            return None
        compared = {result.comparison for result in entry.results}
        if entry.count != len(entry.results) or compared != set(task.checks):
            return None
        results = [msgspec.structs.replace(result, kept=True, seconds=0.0, in_engine=0.0) for result in entry.results]
        return Kept(results, entry.diagnoses)

    def keep_results(self, task: Task, results: list[Result], diagnoses: Sequence[Diagnosis] = ()) -> None:
        """Keep all of a task's results and diagnoses, unless one is a failure: that may have passed by next time."""
        if self.folder and all(result.outcome != "error" for result in results):
            entry = _Entry(len(results), results, list(diagnoses))
            self._save("results", _results_key(task), msgspec.json.encode(entry))

    def facts(self, scene: AnyScene, random_states: int, *asked: bool) -> bytes | None:
        """A scene's truth as its worker sent it; None where it has to be computed."""
        return self._load("truths", _facts_key(scene, random_states, asked) if self.folder else None)

    def keep_facts(self, scene: AnyScene, random_states: int, content: bytes, *asked: bool) -> None:
        """Keep a scene's truth."""
        if self.folder:
            self._save("truths", _facts_key(scene, random_states, asked), content)

    def _path(self, kind: str, key: str | None) -> Path | None:
        return self.folder / kind / key[:2] / key[2:] if self.folder and key else None

    def _load(self, kind: str, key: str | None) -> bytes | None:
        path = self._path(kind, key)
        if path is None:
            return None
        try:
            sealed = read_bytes(path, LARGEST_ENTRY)
        except (InvalidInput, OSError):  # also where it is no file: a pipe would never end
            return None
        if hashlib.sha256(sealed[DIGEST:]).digest() != sealed[:DIGEST]:
            return None
        with contextlib.suppress(OSError):
            os.utime(path)
        return sealed[DIGEST:]

    def _save(self, kind: str, key: str | None, content: bytes) -> None:
        path = self._path(kind, key)
        if path is None or len(content) > LARGEST_ENTRY - DIGEST:
            return
        with contextlib.suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            replace_file(path, hashlib.sha256(content).digest() + content)
            if random.random() < 1 / 64:  # looking at every entry takes longer than writing one
                self.trim()

    def entries(self, kind: str = "*") -> list[Path]:
        """Files of all entries, of one kind or of all."""
        return [path for path in self.folder.glob(f"{kind}/??/*") if path.is_file()] if self.folder else []

    def holds(self) -> dict[str, Holding]:
        """The entries, kind by kind."""
        found = {}
        for kind in ("results", "truths"):
            states = []
            for path in self.entries(kind):
                with contextlib.suppress(OSError):  # another run may have deleted it
                    states.append(path.stat())
            times = [state.st_mtime for state in states]
            size = sum(state.st_size for state in states)
            found[kind] = Holding(len(states), size, min(times, default=None), max(times, default=None))
        return found

    def trim(self) -> None:
        """Delete the entries that were used least recently until the folder is within its limit."""
        states = [(path.stat().st_mtime, path.stat().st_size, path) for path in self.entries()]
        size = sum(size for _, size, _ in states)
        for _, bytes_, path in sorted(states):
            if size <= self.largest:
                return
            path.unlink(missing_ok=True)
            size -= bytes_

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


def _results_key(task: Task) -> str | None:
    """None where it is not known what the engine's answers rest on: a model file may include others, and meshes."""
    if isinstance(task.scene, TreeScene) and task.scene.model:
        return None
    info = ENGINES.get(task.engine)
    foundation = package_foundation(info.package, info.module) if info else _foundation_elsewhere(task.engine)
    if not foundation:
        return None
    scene, checks = _scene(task.scene), repr(task.checks)
    thorough = repr((task.random_states, task.few_steps))
    return _digest("results", scene, task.engine, foundation.hex(), checks, thorough)


def _foundation_elsewhere(engine: str) -> bytes:
    """Of an engine in an environment of its own; empty for a program, and for an adapter from elsewhere."""
    found = environment_of(engine)
    return b"" if found is None else place_foundation(*found)


def _facts_key(scene: AnyScene, random_states: int, asked: tuple[bool, ...]) -> str:
    return _digest("facts", _scene(scene), str(random_states), str(asked))


def _scene(scene: AnyScene) -> str:
    """Everything of a scene that a result depends on, and nothing that it does not."""
    parts = (
        scene.name,
        scene.system,
        *((scene.q, scene.v) if isinstance(scene, TreeScene) else (scene.theta, scene.omega)),
        scene.duration,
        scene.random,
        scene.named,
        sorted(scene.tags),
    )
    return repr(parts)


def _digest(*parts: str) -> str:
    seal = hashlib.sha256(own_foundation())
    for part in parts:
        content = part.encode()
        seal.update(len(content).to_bytes(8, "big") + content)
    return seal.hexdigest()
