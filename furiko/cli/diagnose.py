"""``furiko diagnose``."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..records.exit_status import gravest
from .failures import Failure, failure_of
from .options import engine_names, json_option, scene_names
from .output import print_failure, print_json, print_text
from .process import stopped

if TYPE_CHECKING:
    from ..diagnosis.model_files.result import Diagnosis
    from ..models.readers.model_file import ModelFile


@click.command()
@click.argument("models", metavar="MODEL...", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "--against",
    metavar="SCENE|FILE",
    shell_complete=scene_names,
    help="What MODEL should be: a scene, a scene's TOML file, or another model file.",
)
@click.option(
    "-e",
    "--engine",
    "engines",
    multiple=True,
    metavar="NAME",
    shell_complete=engine_names,
    help="Ask this engine, and no other; may be repeated.",
)
@click.option(
    "--meshes",
    multiple=True,
    type=click.Path(path_type=Path, exists=True, file_okay=False),
    help="A folder below which meshes are looked for besides the model's own; may be repeated.",
)
@click.option("--limits", is_flag=True, help="Count ranges of joints as differences.")
@click.option(
    "--fix",
    metavar="OUT",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write the mechanism as a file that all engines read alike (.xml: MJCF, .urdf: URDF).",
)
@click.option(
    "--out",
    metavar="PAGE",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write the answer as one HTML page, with the mechanism drawn.",
)
@json_option
def diagnose(models: tuple[Path, ...], fix: Path | None, out: Path | None, as_json: bool, **how: Any) -> int:
    """Check how engines read an MJCF or URDF file; say why they differ.

    With several files, each gets a short answer. The exit status is 1 if one of them differs, else the highest of all.
    """
    asked = _Asked(**how)
    if len(models) == 1:
        return _one(models[0], asked, fix, out, as_json)
    if fix is not None or out is not None:
        raise click.UsageError(f"{'--fix' if fix is not None else '--out'} is for one MODEL, {len(models)} are given")
    return _several(models, asked, as_json)


@dataclass(frozen=True)
class _Asked:
    """The options that say how files are looked at."""

    against: str | None
    engines: tuple[str, ...]
    meshes: tuple[Path, ...]
    limits: bool

    def answer(self, file: ModelFile) -> Diagnosis:
        from ..diagnosis.model_files.diagnose import diagnose as diagnose_file

        engines = self.engines or None
        return diagnose_file(file, self.against, engines, meshes=self.meshes, limits=self.limits, isolated=True)


def _read(model: Path, asked: _Asked) -> ModelFile:
    from ..models.readers.model_file import read_model

    return read_model(model, meshes=asked.meshes)


def _one(model: Path, asked: _Asked, fix: Path | None, out: Path | None, as_json: bool) -> int:
    _require_targets(model, fix, out)
    file = _read(model, asked)
    found = asked.answer(file)
    if fix is not None:
        from ..diagnosis.model_files.fix import judged, write_fixed

        not_alike = [f"{fix}: {says}" for says in write_fixed(file, fix)]
        written = judged(fix, replace(asked, against=None).answer(_read(fix, asked)))
        found = replace(found, notes=(*found.notes, *not_alike), written=written)
    if out is not None:
        _write_page(found, file, out)
    if as_json:
        print_json(found.to_json())
    else:
        print_text(found.text() + (f"\n  written: {out}" if out is not None else ""))
    return found.exit_status


def _require_targets(model: Path, fix: Path | None, out: Path | None) -> None:
    """Raise :class:`InvalidInput` for what cannot be written, before engines are asked."""
    if fix is None and out is None:
        return
    from ..diagnosis.model_files.fix import require_other_file, require_target

    if fix is not None:
        require_target(fix, model)
    if out is not None:
        require_other_file(out, model)
        if fix is not None and fix.resolve() == out.resolve():
            raise click.UsageError(f"--fix and --out are both {out}; give two names")


def _several(models: tuple[Path, ...], asked: _Asked, as_json: bool) -> int:
    """Each file in short, as soon as it is answered; one that cannot be is told, and the others are answered."""
    statuses, entries = [], []
    for model in models:
        found = _answered(model, asked)
        statuses.append(found.status if isinstance(found, Failure) else found.exit_status)
        if as_json:
            entries.append(_entry(model, found))
        elif isinstance(found, Failure):
            print_failure(found.message)
        else:
            print_text(found.brief())
    if as_json:
        print_json({"models": entries})
    return gravest(statuses)


def _answered(model: Path, asked: _Asked) -> Diagnosis | Failure:
    try:
        found: Diagnosis | Failure = asked.answer(_read(model, asked))
    except Exception as error:
        found = failure_of(error)
    if signalled := stopped():  # an engine's own code has made another exception of it
        raise signalled
    return found


def _entry(model: Path, found: Diagnosis | Failure) -> dict[str, Any]:
    entry: dict[str, Any] = {"model": str(model), "diagnosis": None, "error": None}
    if isinstance(found, Failure):
        return entry | {"status": found.status, "error": found.record()}
    return entry | {"status": found.exit_status, "diagnosis": found.to_json()}


def _write_page(found: Diagnosis, file: ModelFile, out: Path) -> None:
    from ..diagnosis.finding import CAUSES
    from ..models.trees.system import tree_of
    from ..models.writers.whole_file import replace_file
    from ..reference.outline import outline
    from ..reports.pages.diagnose_page import to_diagnosis_page

    lines = outline(file.spatial, tree_of(file.spatial).reference, across_least=True)
    replace_file(out, to_diagnosis_page(found.to_json(), found.described(), CAUSES, lines).encode())
