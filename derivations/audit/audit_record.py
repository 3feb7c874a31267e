"""The result of the audit: typed records, written as JSON by ``furiko audit --json``."""

from __future__ import annotations

from typing import Any, Literal

import msgspec
from msgspec import UNSET, Struct, UnsetType

from .cost import Cost
from .question import Question

Judgement = Literal["holds", "holds-if", "misprint"]


class BallEvidence(Struct, frozen=True, rename={"largest": "largest enclosure of a difference"}):
    """The equation in ball arithmetic: for these numbers of angles, at so many random points.

    ``largest``: the largest number in any ball that encloses a difference which must vanish; None where it failed at
    every point.
    """

    angles: tuple[int, ...]
    points: int
    largest: float | None


class Evidence(
    Struct,
    frozen=True,
    rename={
        "in_symbols": "in symbols",
        "in_balls": "in balls",
        "proof": "proof that it fails",
        "probability_of_error": "probability of error",
    },
):
    """How it is known whether an equation holds.

    ``in_symbols``: by number of angles, whether it holds exactly. ``proof`` is there where it fails at a point,
    ``probability_of_error`` where it does not; ``corrected``, the evidence for the correction, with a misprint.
    """

    holds: bool
    in_symbols: dict[str, bool]
    in_balls: BallEvidence
    proof: str | UnsetType = UNSET
    probability_of_error: str | UnsetType = UNSET
    corrected: Evidence | UnsetType = UNSET


class JudgedEquation(Struct, frozen=True):
    """One equation. ``evidence`` says how it was judged; what follows it is for conditions and misprints, or empty."""

    document: Literal["shiki", "takeno"]
    number: str
    judgement: Judgement
    says: str
    formula: str
    evidence: Evidence
    condition: str = ""
    printed: str = ""
    correction: str = ""
    costs: tuple[Cost, ...] = ()


class FoundSlip(Struct, frozen=True):
    """A slip outside the numbered formulas; ``found`` says how: by reading, not by computing."""

    found: str
    document: Literal["shiki", "takeno"]
    where: str
    printed: str
    right: str
    says: str


class Audit(Struct, frozen=True):
    """The whole audit."""

    equations: tuple[JudgedEquation, ...]
    slips: tuple[FoundSlip, ...]
    open_questions: tuple[Question, ...] = ()
    unnumbered: tuple[JudgedEquation, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        content: dict[str, Any] = msgspec.to_builtins(self)
        return content

    @property
    def counts(self) -> dict[str, int]:
        """How many equations were judged how."""
        kinds = [judged.judgement for judged in self.equations]
        return {kind: kinds.count(kind) for kind in ("holds", "holds-if", "misprint")}
