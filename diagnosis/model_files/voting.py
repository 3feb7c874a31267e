"""Which one differs from all others: one engine, or furiko's own reading of the file."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..finding import Finding
from ..measurement import Array
from .engine_answers import EngineAnswer

ALIKE = 1e-7  # engines agree with one another within this, relative to each state's largest acceleration


def vote(path: str, answers: Sequence[EngineAnswer]) -> list[Finding]:
    """The engines' findings; ``theory-is-wrong`` first where all that read the file themselves differ alike."""
    voters = [answer for answer in answers if answer.accelerations is not None and answer.native]
    if len(voters) >= 2 and all(answer.residual > 1 for answer in voters) and _agree(voters):
        names = ", ".join(answer.name for answer in voters)
        says = f"{names} agree with one another; only furiko's own reading of the file differs"
        return [Finding("theory-is-wrong", path, None, None, says), *voters[0].findings]
    return [finding for answer in answers for finding in answer.findings]


def _agree(voters: Sequence[EngineAnswer]) -> bool:
    accelerations: list[Array] = [a.accelerations for a in voters if a.accelerations is not None]
    first = accelerations[0]
    size = np.abs(first).max(axis=1, keepdims=True)
    return all(bool((np.abs(other - first) <= ALIKE * size).all()) for other in accelerations)
