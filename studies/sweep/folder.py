"""The folder of a sweep: its manifest, a Parquet file for each chunk and engine, and what of the plan is there.

Each file is written under another name and renamed: it is whole or not there. A file says of which sweep it is and how
much is in it; one that does not, or says something else, counts as not there and is made again.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

from ...models import InvalidInput
from ...models.readers.bounded_file import read_bytes, shown
from ...models.writers.whole_file import make_folder, replace_file
from ...records.sweep import SweepManifest
from .chunk import Part, Work
from .table import cells_of, mark_of

MANIFEST, RESULTS = "manifest.json", "results"
LARGEST_MANIFEST = 16 << 20  # bytes
_manifests = msgspec.json.Decoder(SweepManifest)


def folder_names(engines: Sequence[str]) -> list[str]:
    """A folder for each engine, by its name; a number is added where two would have the same."""
    found: list[str] = []
    for name in engines:
        plain = re.sub(r"[^A-Za-z0-9@._-]+", "-", name).strip("-.")[-80:] or "engine"
        taken = sum(other == plain or other.startswith(f"{plain}~") for other in found)
        found.append(f"{plain}~{taken + 1}" if taken else plain)
    return found


@dataclass(frozen=True)
class SweepFolder:
    """A folder and its manifest."""

    path: Path
    manifest: SweepManifest

    def file(self, engine: str, chunk: int) -> Path:
        """The file of a chunk on an engine."""
        folder = next(one.folder for one in self.manifest.engines if one.name == engine)
        return self.path / RESULTS / folder / f"{chunk:07d}.parquet"

    def keep(self, part: Part) -> None:
        """Write a part. Raises :class:`InvalidInput` where that fails."""
        path = self.file(part.mark.engine, part.mark.chunk)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            replace_file(path, part.content)
        except OSError as error:
            raise InvalidInput(f"{shown(path)}: cannot be written: {error.strerror or error}") from None

    def has(self, engine: str, chunk: int) -> bool:
        """Whether the file of a chunk on an engine is there, and is what it should be, by what it says of itself."""
        path = self.file(engine, chunk)
        mark = mark_of(path) if path.is_file() else None
        return mark is not None and (mark.digest, mark.chunk, mark.engine, mark.cells) == (
            self.manifest.digest,
            chunk,
            engine,
            self.scenes_in(chunk),
        )

    def scenes_in(self, chunk: int) -> int:
        """Number of scenes in a chunk, and so of cells of one engine."""
        return min(self.manifest.chunk, self.manifest.scenes - chunk * self.manifest.chunk)

    def left(self) -> Iterator[Work]:
        """What is still to be done, chunk by chunk."""
        names = [engine.name for engine in self.manifest.engines]
        for chunk in range(self.manifest.chunks):
            missing = tuple(name for name in names if not self.has(name, chunk))
            if missing:
                yield Work(chunk, missing)

    def reconciled(self) -> Reconciled:
        """Hold what is there against the plan, cell by cell."""
        cells, missing, flaws = 0, [], []
        several = len(self.manifest.engines)
        for place, engine in enumerate(self.manifest.engines):
            for chunk in range(self.manifest.chunks):
                path = self.file(engine.name, chunk)
                found = cells_of(path) if self.has(engine.name, chunk) else None
                if found is None:
                    missing.append(path.relative_to(self.path).as_posix())
                    continue
                first = chunk * self.manifest.chunk
                planned = {(first + k) * several + place for k in range(self.scenes_in(chunk))}
                cells += len(planned & set(found))
                if set(found) != planned:
                    flaws.append(f"{shown(path)}: its cells are not those that were planned")
        flaws += self._strangers()
        return Reconciled(cells, tuple(missing), tuple(flaws))

    def _strangers(self) -> Iterator[str]:
        """Files that the plan has not."""
        known = {engine.folder for engine in self.manifest.engines}
        names: Counter[str] = Counter()
        for path in (self.path / RESULTS).glob("*/*.parquet"):
            chunk = path.stem
            if path.parent.name not in known or not chunk.isdigit() or int(chunk) >= self.manifest.chunks:
                names["files"] += 1
        if names:
            yield f"{shown(self.path / RESULTS)}: {names['files']} files of another sweep are in it"


@dataclass(frozen=True)
class Reconciled:
    """How many cells are there; the files that are not; and what is wrong with others."""

    cells: int
    missing: tuple[str, ...]
    flaws: tuple[str, ...]


def open_folder(path: Path) -> SweepFolder:
    """The folder of a sweep that was begun. Raises :class:`InvalidInput` where it is none."""
    if not (path / MANIFEST).is_file():
        raise InvalidInput(f"{shown(path)}: no sweep: it has no {MANIFEST}; 'furiko sweep FILE.toml --out' makes one")
    try:
        manifest = _manifests.decode(read_bytes(path / MANIFEST, LARGEST_MANIFEST))
    except msgspec.MsgspecError as error:
        raise InvalidInput(f"{shown(path / MANIFEST)}: not the manifest of a sweep: {error}") from None
    names = [engine.folder for engine in manifest.engines]
    if any("/" in name or name in ("", ".", "..") for name in names) or len(set(names)) < len(names):
        raise InvalidInput(f"{shown(path / MANIFEST)}: not the manifest of a sweep: its folders have no plain names")
    if min(manifest.chunk, manifest.scenes, manifest.chunks, len(names)) < 1:
        raise InvalidInput(f"{shown(path / MANIFEST)}: not the manifest of a sweep: nothing was planned")
    return SweepFolder(path, manifest)


def begin(path: Path, manifest: SweepManifest, *, fresh: bool = False) -> SweepFolder:
    """The folder for a sweep: a new one, or that of the same sweep, which goes on.

    ``fresh``: what an earlier sweep left in it is removed. Raises :class:`InvalidInput` where another sweep is in it.
    """
    make_folder(path)
    if (path / MANIFEST).exists() and not fresh:
        kept = open_folder(path)
        if kept.manifest.digest != manifest.digest:
            held = _another(kept.manifest, manifest)
            raise InvalidInput(f"{shown(path)}: holds {held}; --fresh starts anew, --out names another folder")
        return kept
    try:
        for file in (path / RESULTS).glob("*/*.parquet"):
            file.unlink()
        replace_file(path / MANIFEST, msgspec.json.format(msgspec.json.encode(manifest), indent=1) + b"\n")
    except OSError as error:
        raise InvalidInput(f"{shown(path)}: cannot be written: {error.strerror or error}") from None
    return SweepFolder(path, manifest)


def _another(kept: SweepManifest, wanted: SweepManifest) -> str:
    for one in wanted.engines:
        for other in kept.engines:
            if (one.name, kept.text) == (other.name, wanted.text) and one.version != other.version:
                return f"this sweep, begun with {one.name} {other.version or 'of no version'}, not {one.version}"
    if (kept.text, kept.code) != (wanted.text, wanted.code) and kept.text == wanted.text:
        return f"this sweep, begun with another furiko ({kept.furiko}, of other code)"
    return "another sweep, or another version of this one"
