"""The causes of a cell's differences: one explanation of the equations of motion, and one of each integrator."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from ..diagnosis.explanation import UNEXPLAINED, Explanation
from ..diagnosis.finding import Finding
from ..engines import Integrator
from ..records.check import Diagnosis, Result
from ..records.findings import Difference
from .cell import Cell
from .check import Check

if TYPE_CHECKING:
    from .trees.cell import TreeCell

# What a cause can show in, for those that do not show in every term: M, V (velocity terms) and G (gravity terms).
TERMS_OF_CAUSE = {
    "gravity": "G",
    "gravity-turned": "G",
    "velocity-terms-sign": "V",
    "velocity-terms-forgotten": "V",
    "damping": "V",
    "damping-ignored": "V",
    "dry-friction": "V",
    "friction-ignored": "V",
    "stiffness": "G",
    "stiffness-ignored": "G",
    "spring-reference": "G",
    "armature": "M",
}
TERMS_OF_RESULT = {"terms M": "M", "terms C": "V", "terms velocity": "V", "terms G": "G"}
# Numbers of the mechanism, which show wherever the mechanism is asked for.
OF_THE_MECHANISM = {
    "mass",
    "density",
    "massless-link",
    "length",
    "inertia",
    "gravity",
    "gravity-turned",
    "com-displaced",
    "point-mass-patched",
    "rods-as-point-masses",
    "joint-order",
    "joint-dropped-by-parser",
    "joint-added",
}
ALSO_OF_THE_MECHANISM = ("symmetry", "joint forces", "energy")


class Causes:
    """Gives each result that differs its cause as it comes, and all of them so far in one :class:`Diagnosis`."""

    def __init__(self, cell: Cell | TreeCell) -> None:
        self._cell = cell
        self._explains: list[str] = []
        self._model_differs = False
        self._motion: dict[tuple[str, str], Finding] = {}  # by cause and place

    def named(self, result: Result, check: Check) -> Result:
        """The result with the first cause that explains it; as it is where it does not differ or none is found."""
        if result.outcome != "differs":
            return result
        cause = self._of_motion(result) if check.moves else self._of_model(result, check)
        if result.cause is not None or cause is None:
            return result
        return msgspec.structs.replace(result, cause=cause)

    def diagnosis(self) -> Diagnosis | None:
        """Everything that was found; None where nothing was looked for or found."""
        found = self._cell.explanation if self._model_differs else Explanation()
        motion = list(self._motion.values())
        if not found and not motion:
            return None
        return Diagnosis(
            scene=self._cell.scene.name,
            engine=self._cell.info.name,
            findings=[_entry(finding) for finding in (*found.findings, *motion)],
            alternatives=[_entry(finding) for finding in found.alternatives],
            explains=list(self._explains),
        )

    def _of_model(self, result: Result, check: Check) -> str | None:
        if not check.explained and check.name not in ALSO_OF_THE_MECHANISM:
            return None
        self._model_differs = self._model_differs or check.explained
        if not self._model_differs:  # nothing says that the mechanism differs: the quantity itself is at fault
            return None
        found = self._cell.explanation
        if not check.explained and not {finding.cause for finding in found.all} & OF_THE_MECHANISM:
            return None
        if found.explained:
            self._explains.append(result.check)
        return next((finding.cause for finding in found.all if _shows_in(finding, result)), None)

    def _of_motion(self, result: Result) -> str | None:
        integrator = _integrator(result, self._cell.info.integrators)
        if integrator is None:
            return None
        found = self._cell.motion_causes(integrator)
        self._motion |= {(finding.cause, finding.where): finding for finding in found}
        if found and all(finding.cause != UNEXPLAINED for finding in found):
            self._explains.append(result.check)
        return found[0].cause if found else None


def _shows_in(finding: Finding, result: Result) -> bool:
    shown = TERMS_OF_RESULT.get(result.check, "MVG")
    return any(term in shown for term in TERMS_OF_CAUSE.get(finding.cause, "MVG"))


def _integrator(result: Result, integrators: tuple[Integrator, ...]) -> Integrator | None:
    """The integrator that a result is about: its details name it, or its title does."""
    named = result.details.get("integrator")
    about = [i for i in integrators if i.name == named or f" {i.name} " in f" {result.check} "]
    return max(about, key=lambda integrator: len(integrator.name), default=None)


def _entry(finding: Finding) -> Difference:
    return Difference(**finding.to_json())
