"""The JSON Schemas of everything that furiko prints or writes as JSON, made from the records.

``python -m furiko.records.schema`` writes them into ``records/schemas/``.
"""

from __future__ import annotations

import json
from inspect import cleandoc
from pathlib import Path
from typing import Any

import msgspec

from . import (
    bench,
    check,
    classroom,
    errors,
    findings,
    listings,
    motions,
    stress,
    sweep,
    versions,
)

FOLDER = Path(__file__).parent / "schemas"

# Name of the schema's file: its title and its type.
SCHEMAS: dict[str, tuple[str, Any]] = {
    "check": (f"furiko result stream, format {check.FORMAT}: one line of report.jsonl", check.Record),
    "check-report": ("furiko check --json", check.CheckReport),
    "diff": ("furiko diff --json", check.DiffDocument),
    "scenes": ("furiko scenes --json", list[listings.SceneRow]),
    "engines": ("furiko engines --json", list[listings.EngineRow]),
    "engine-test": ("furiko engine-test --json", listings.EngineTest),
    "cache": ("furiko cache --json", listings.CacheContents),
    "advise": ("furiko advise --json", bench.Advice),
    "bench": (f"furiko bench --json, and bench.json, format {bench.FORMAT}", bench.Bench),
    "stress": ("furiko stress --json", stress.StressSummary),
    "sweep": (f"furiko sweep --json, and sweep.json, format {sweep.FORMAT}", sweep.SweepSummary),
    "sweep-manifest": (f"manifest.json of a sweep, format {sweep.FORMAT}", sweep.SweepManifest),
    "sweep-row": ("a row of a sweep's Parquet files; each of its parameters is a column p_NAME there", sweep.SweepRow),
    "enclose": ("furiko enclose --json", motions.EnclosureDocument),
    "map": ("furiko map --json", motions.MapRecord),
    "grade": ("furiko grade --json", findings.GradeDocument),
    "class": ("furiko grade --problem --json, and class.json", classroom.ClassDocument),
    "audit": ("furiko audit --json", findings.AuditDocument),
    "audit-file": ("furiko audit FILE --json", findings.FileAuditDocument),
    "diagnose": ("furiko diagnose --json", findings.DiagnoseDocument),
    "diagnose-several": ("furiko diagnose --json with several files", findings.DiagnosedModels),
    "environments": ("furiko environments --json", list[listings.EnvironmentRow]),
    "versions": (
        f"furiko versions --json, and versions.json, format {versions.FORMAT}",
        versions.VersionsDocument,
    ),
    "error": ("every furiko command with --json that fails", errors.ErrorDocument),
}


def schema(name: str) -> str:
    """The schema of this name as text. Raises :class:`KeyError` for a name that is not in :data:`SCHEMAS`."""
    title, kind = SCHEMAS[name]
    described = _clean_descriptions(
        {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": title, **msgspec.json.schema(kind)}
    )
    return json.dumps(described, indent=2, ensure_ascii=False) + "\n"


def _clean_descriptions(value: Any) -> Any:
    """Docstrings without the indentation of the source, as Python 3.13 has them, in every Python."""
    if isinstance(value, dict):
        return {
            key: cleandoc(v) if key == "description" and isinstance(v, str) else _clean_descriptions(v)
            for key, v in value.items()
        }
    return [_clean_descriptions(v) for v in value] if isinstance(value, list) else value


def main(folder: Path = FOLDER) -> None:
    """Write all schemas, and delete those of names that are no more."""
    folder.mkdir(exist_ok=True)
    for path in folder.glob("*.json"):
        if path.stem not in SCHEMAS:
            path.unlink()
    for name in SCHEMAS:
        (folder / f"{name}.json").write_text(schema(name), encoding="utf-8")


if __name__ == "__main__":
    main()
