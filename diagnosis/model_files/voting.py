"""Which one differs from all others: one engine, or furiko's own reading of the file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...models.readers.model_file import ModelFile
from ...models.spatial_mechanism import SpatialMechanism
from ..finding import Finding
from ..robots.fields import field_differences
from .engine_result import REFUSALS, EngineResult

if TYPE_CHECKING:
    from ..measurement import Array
    from .engine_answers import EngineAnswer

ALIKE = 1e-7  # engines agree with one another within this, relative to each state's largest acceleration


def vote(file: ModelFile, results: Sequence[EngineResult]) -> list[Finding]:
    """The engines' findings; ``theory-is-wrong`` first where all that read the file themselves differ alike."""
    voters = [result for result in results if result.reads_itself and result.compared]
    if len(voters) >= 2 and (_hold_the_same(file, voters) or _move_alike(voters)):
        names = ", ".join(voter.name for voter in voters)
        says = f"{names} agree with one another; only furiko's own reading of the file differs"
        return [Finding("theory-is-wrong", file.path, None, None, says), *voters[0].findings]
    found = [finding for result in results for finding in result.findings]
    return sorted(found, key=lambda finding: finding.cause in REFUSALS)  # after what explains numbers


def _hold_the_same(file: ModelFile, voters: Sequence[EngineResult]) -> bool:
    """Whether all hold one mechanism that is not the file's, and no known mistake explains it."""
    held: list[SpatialMechanism] = [v.own.holds for v in voters if v.own is not None and v.own.holds is not None]
    if len(held) < len(voters) or any(voter.own is None or not voter.own.left for voter in voters):
        return False
    passive = ("damping", "friction", "stiffness")  # which not every engine holds
    return all(not field_differences(other, held[0], ignored=passive) for other in held[1:])


def _move_alike(voters: Sequence[EngineResult]) -> bool:
    """Whether all planar answers differ from the theory in the same accelerations."""
    answers: list[EngineAnswer] = [v.planar for v in voters if v.planar is not None]
    if len(answers) < 2 or any(answer.accelerations is None or answer.residual <= 1 for answer in answers):
        return False
    accelerations: list[Array] = [a.accelerations for a in answers if a.accelerations is not None]
    first = accelerations[0]
    size = np.abs(first).max(axis=1, keepdims=True)
    return all(bool((np.abs(other - first) <= ALIKE * size).all()) for other in accelerations)
