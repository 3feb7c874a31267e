"""One run of a sweep: the file, the folder, chunks here or on a cluster, and the summary, tied together."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Generator
from contextlib import ExitStack, closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import msgspec

from . import __version__
from .checks.foundations import own_code
from .engines import engine_info, engine_version, why_missing
from .models import EngineMissing
from .models.errors import library
from .models.writers.whole_file import write_whole
from .records import provenance
from .records.exit_status import AGREES, DIFFERS, INCOMPLETE
from .records.sweep import SweepEngine, SweepManifest, SweepSummary
from .studies.sweep.chunk import Part
from .studies.sweep.cluster import ClusterLost, cluster, run_on_cluster
from .studies.sweep.declaration import read_sweep
from .studies.sweep.folder import SweepFolder, begin, folder_names, open_folder
from .studies.sweep.local import run_here
from .studies.sweep.plan import Sweep
from .studies.sweep.summary import summarise

SUMMARY, PAGE, MARKDOWN = "sweep.json", "sweep.html", "sweep.md"


@dataclass(frozen=True)
class Doing:
    """Progress: cells that are there, of how many; those of this run; and results of this run that are not agreed."""

    cells: int
    of: int
    here: int
    differs: int
    errors: int


class SweepCutOff(RuntimeError):
    """A run ended before all was done; ``summary`` is what is there, and the same command goes on."""

    def __init__(self, message: str, summary: SweepSummary) -> None:
        super().__init__(message)
        self.summary = summary


def sweep(
    path: str | Path,
    *,
    out: str | Path,
    jobs: int | None = None,
    dask: str | None = None,
    fresh: bool = False,
    watch: Callable[[Doing], None] = lambda _: None,
) -> SweepSummary:
    """Run the sweep that a TOML file declares, or what is left of it, and sum it up.

    ``out``: the folder of its results; one that holds this very sweep goes on where it stood, unless ``fresh``.
    ``jobs``: chunks at once on this machine, as many as there are cores for None; ``dask``: the address of a scheduler
    of ``distributed``, or its scheduler file, None for this machine; ``watch`` is called with each chunk that is done.

    Raises :class:`furiko.InvalidInput` for a bad file and a folder that holds another sweep,
    :class:`furiko.EngineMissing` and :class:`furiko.LibraryMissing`, all before anything runs, and :class:`SweepCutOff`
    where a cluster was lost on the way.
    """
    found, text = read_sweep(Path(path))
    library("pyarrow")
    if dask is not None:
        library("distributed")
    for name in found.engines:
        if why := why_missing(name):
            raise EngineMissing(f"{name}: {why}")
    manifest = make_manifest(found, Path(path), text)
    lost = ""
    with ExitStack() as open_until_done:
        client = None if dask is None else open_until_done.enter_context(cluster(dask))
        folder = begin(Path(out), manifest, fresh=fresh)
        try:
            _run(found, folder, jobs, client, watch)
        except ClusterLost as error:
            lost = str(error)
    summary = report(folder.path)
    if lost:
        raise SweepCutOff(f"{lost}; what was done is kept, and the same command goes on", summary)
    return summary


def _run(found: Sweep, folder: SweepFolder, jobs: int | None, client: Any, watch: Callable[[Doing], None]) -> None:
    digest = folder.manifest.digest
    left = list(folder.left())
    there = found.cells - sum(len(work.engines) * len(found.numbers(work.chunk)) for work in left)
    doing = Doing(there, found.cells, 0, 0, 0)
    if not left:
        return
    watch(doing)
    parts: Generator[tuple[Part, ...], None, None]
    if client is None:
        parts = run_here(found, digest, left, min(jobs or os.cpu_count() or 1, len(left)))
    else:
        parts = run_on_cluster(found, digest, left, client)
    with closing(parts):
        for several in parts:
            for part in several:
                folder.keep(part)
                doing = _after(doing, part)
            watch(doing)


def _after(doing: Doing, part: Part) -> Doing:
    return replace(
        doing,
        cells=doing.cells + part.mark.cells,
        here=doing.here + part.mark.cells,
        differs=doing.differs + part.outcomes.get("differs", 0),
        errors=doing.errors + part.outcomes.get("error", 0),
    )


def report(folder: str | Path) -> SweepSummary:
    """Sum up the sweep in a folder as far as it is there; writes ``sweep.json``, ``sweep.md`` and ``sweep.html``.

    Raises :class:`furiko.InvalidInput` where the folder holds no sweep, or cannot be written.
    """
    path = Path(folder)
    found = summarise(open_folder(path))
    from .reports.ci.sweep_markdown import to_markdown
    from .reports.pages.sweep_page import to_html

    write_whole(path / SUMMARY, msgspec.json.format(msgspec.json.encode(found), indent=1).decode() + "\n")
    write_whole(path / MARKDOWN, to_markdown(found))
    write_whole(path / PAGE, to_html(found))
    return found


def exit_status(found: SweepSummary) -> int:
    """1 where something differs; 3 where a cell is missing, an engine failed, or nothing was compared; else 0."""
    if any(tally.differs for tally in found.tallies):
        return DIFFERS
    compared = any(tally.agrees for tally in found.tallies)
    whole = found.complete and compared and not any(tally.errors for tally in found.tallies)
    return AGREES if whole else INCOMPLETE


def make_manifest(found: Sweep, path: Path, text: str) -> SweepManifest:
    """What is planned, by whom, with what."""
    code = _code()
    infos = [engine_info(name) for name in found.engines]
    engines = [
        SweepEngine(
            name=name, formulation=info.formulation, package=info.package, version=engine_version(name), folder=folder
        )
        for name, info, folder in zip(found.engines, infos, folder_names(found.engines), strict=True)
    ]
    return SweepManifest(
        furiko=__version__,
        code=code,
        digest=found.digest(repr((code, [(one.name, one.version, _file(one.name)) for one in engines]))),
        started=provenance.now(),
        command=provenance.command(),
        machine=provenance.machine(),
        versions=provenance.versions(),
        file=path.name,
        text=text,
        engines=engines,
        checks=list(found.checks),
        parameters=list(found.parameters),
        cells=found.cells,
        scenes=found.scenes,
        chunk=found.chunk,
        chunks=found.chunks,
    )


def _code() -> str:
    """Digest of all of furiko's code that decides what is in a cell."""
    seal = hashlib.sha256(own_code())
    for path in sorted((Path(__file__).parent / "studies" / "sweep").glob("*.py")):
        seal.update(path.name.encode() + b"\0" + path.read_bytes())
    return seal.hexdigest()


def _file(engine: str) -> str:
    """Digest of an adapter's file, where an engine's name is one; it may change between two runs."""
    path = Path(engine if os.path.isfile(engine) else engine.rpartition(":")[0])
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
