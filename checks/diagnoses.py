"""A cell's diagnosis in several parts: a worker that was lost has left its own, and the one that went on another."""

from __future__ import annotations

from collections.abc import Iterable

from ..records.check import Diagnosis
from ..records.findings import Difference


def joined(earlier: Diagnosis | None, later: Diagnosis | None) -> Diagnosis | None:
    """Both parts as one, each finding once; None where there is neither. A certain finding is no alternative."""
    if earlier is None or later is None:
        return later or earlier
    findings = _once([*earlier.findings, *later.findings])
    certain = {_key(finding) for finding in findings}
    alternatives = _once([*earlier.alternatives, *later.alternatives])
    return Diagnosis(
        scene=later.scene,
        engine=later.engine,
        findings=findings,
        alternatives=[finding for finding in alternatives if _key(finding) not in certain],
        explains=list(dict.fromkeys([*earlier.explains, *later.explains])),
    )


def _once(findings: Iterable[Difference]) -> list[Difference]:
    found: dict[tuple[str, str], Difference] = {}
    for finding in findings:
        found.setdefault(_key(finding), finding)
    return list(found.values())


def _key(finding: Difference) -> tuple[str, str]:
    return finding.cause, finding.where
