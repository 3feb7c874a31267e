"""One rung of a ladder of open mechanisms on one subject: accelerations against the proven ones, and the bound.

As :mod:`..accelerations` has it for the documents' mechanisms: the typical error of a rung (the median over its states)
decides whether half the digits are lost. Beside it stands the residual that the accelerations leave over what rounding
may do to it, in the worst state: above 1 no rounding explains the error, and the engine has the mechanism or a number
of it wrong, however small the error is; below, half the digits are lost because the mechanism multiplies rounding.
Subjects are the engines and ``kernels``, furiko's own accelerations of open mechanisms.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ....checks.cell import quotient
from ....checks.trees.cell import magnitudes_in
from ....engines import EngineInfo, cannot, engine_info, load_tree_engine
from ....models import InvalidInput, TreeScene
from ....models.spatial_mechanism import SpatialMechanism
from ....models.trees.system import TreeSystem
from ....records.check import Result
from ....reference.kernels.trees.dynamics import tree_accelerations
from ....reference.rounding.bounds import EPSILON
from ....reference.rounding.spatial import Magnitudes
from ....reference.truth.enclosures import Enclosure
from ....reference.truth.spatial import spatial_truth
from ..accelerations import digits, finite, relative_error
from ..case import RungCase
from ..failures import NO_DIGITS, Failure
from ..over_bound import KERNELS
from .axes import ladder_of
from .posed import Posed

Array = NDArray[np.float64]

HEAVY = 100  # degrees of freedom: a state's truth takes a tenth of a second


@dataclass(frozen=True)
class TreeCase(RungCase):
    """A case: it says under which names its result stands, and makes it.

    ``base``: a scene of the user's own that the ladder stands on; None: the ladder's own.
    """

    base: TreeScene | None = None

    @property
    def heavy(self) -> bool:
        """Whether it takes seconds rather than milliseconds."""
        ladder = ladder_of(self.ladder, self.base)
        return ladder.axis.name == "freedoms" and ladder.value(self.rung) > HEAVY

    def run(self) -> Result:
        """Measure. An engine's exceptions are the caller's to catch."""
        ladder = ladder_of(self.ladder, self.base)
        where = {"rung": self.rung, "value": ladder.value(self.rung), "at": ladder.label(self.rung)}
        try:
            problem = tree_problem(self.ladder, self.base, self.rung, self.seed)
        except ArithmeticError as error:
            return self.result("skipped", reason=str(error), details=where | {"failure": "no truth"})
        system = problem.posed.system
        where["n"] = system.n
        subject = Subject.of(self.engine)
        try:
            answer = subject.accelerations(system, problem.posed.q, problem.posed.v)
        except InvalidInput as refusal:
            return self.result("skipped", reason=str(refusal), details=where | {"failure": "refused"})
        errors = relative_error(problem.truth, answer)
        typical, over = float(np.median(errors)), subject.over_bound(problem, answer)
        failure = of_tree_answer(answer, typical, over, subject.half)
        return self.result(
            "differs" if failure else "agrees",
            measured=finite(typical),
            allowed=subject.half,
            unit="of the largest acceleration",
            reason=told(failure, typical, over),
            details=where
            | {
                "failure": failure,
                "states": len(errors),
                "error": finite(typical),
                "worst error": finite(float(np.max(errors))),
                "digits": digits(typical),
                "error over bound": finite(over),
            },
        )


@dataclass(frozen=True)
class Subject:
    """Whose accelerations are looked at: its name, and what is known of it; None for furiko's own kernels."""

    name: str
    info: EngineInfo | None

    @classmethod
    def of(cls, name: str) -> Subject:
        """The subject of a name."""
        return cls(name, None if name == KERNELS else engine_info(name))

    @property
    def accuracy(self) -> float:
        """Of one of its operations."""
        return EPSILON if self.info is None else self.info.accuracy

    @property
    def half(self) -> float:
        """The relative error at which half of its digits are lost."""
        return math.sqrt(self.accuracy)

    def accelerations(self, system: TreeSystem, q: Array, v: Array) -> Array:
        """Its accelerations (B, nv). Raises InvalidInput where it does not take the mechanism, or the state."""
        if self.info is None:
            return tree_accelerations(system.mechanism(), q, v)
        if why_not := cannot(self.info, system):
            raise InvalidInput(why_not)
        with np.errstate(all="ignore"):
            return load_tree_engine(self.name, system).accelerations(q, v)

    def over_bound(self, problem: TreeProblem, answer: Array) -> float:
        """The largest residual of all rows and states over what rounding may do to it, in this subject.

        Without states in which the mass matrix is singular to its rounding and that are beyond: nothing is known there.
        """
        error = (answer - problem.truth.high) - problem.truth.low
        worst = 0.0
        with np.errstate(all="ignore"):
            for k in np.flatnonzero(np.isfinite(answer).all(axis=-1)).tolist():
                units, mass = self._units(problem, k), problem.mass[k]
                unit = units.residual(answer[k], mass, factorised=self._factorises, inverted=self._inverts)
                over = float(quotient(mass @ error[k], unit).max() / (units.roundings * self.accuracy))
                if over <= 1 or units.regular(mass, self.accuracy):
                    worst = max(worst, over)
        return worst

    @property
    def _factorises(self) -> bool:
        return self.info is not None and self.info.factorises

    @property
    def _inverts(self) -> bool:
        return self.info is None or self.info.inverts

    def _units(self, problem: TreeProblem, state: int) -> Magnitudes:
        q, v = problem.posed.q[state], problem.posed.v[state]
        if self.info is None:
            return Magnitudes(problem.mechanism, q, v, world=False)
        return magnitudes_in(self.info, problem.mechanism, q, v)


def of_tree_answer(answer: Array, error: float, over: float, half: float) -> Failure | None:
    """The failure of accelerations whose typical relative error is ``error``; None where they will do."""
    if not np.isfinite(answer).all():
        return "NaN"
    if over > 1:
        return "wrong numbers that look right" if error >= NO_DIGITS else "more than rounding"
    return "half its digits lost" if error > half else None


def told(failure: Failure | None, error: float, over: float) -> str:
    """The failure in a sentence."""
    if failure is None:
        return ""
    if failure == "NaN":
        return "NaN or infinity among the accelerations"
    share = f"{over:.2g} of what rounding may do to its equation"
    cause = f"more than rounding: {share}" if over > 1 else f"the mechanism multiplies rounding, {share}"
    return f"{failure}: a typical error of {error:.2g} of the largest acceleration; {cause}"


@dataclass(frozen=True, eq=False)
class TreeProblem:
    """What stands on a rung, the proven accelerations (B, nv) and the mass matrix (B, nv, nv) there."""

    posed: Posed
    mechanism: SpatialMechanism
    truth: Enclosure
    mass: Array


@lru_cache(maxsize=64)
def tree_problem(ladder: str, base: TreeScene | None, rung: int, seed: int) -> TreeProblem:
    """The problem of a rung; kept, since every subject of this process is asked the same."""
    posed = ladder_of(ladder, base).posed(rung, seed)
    mechanism = posed.system.mechanism()
    truths = [spatial_truth(mechanism, q, v) for q, v in zip(posed.q, posed.v, strict=True)]
    found = [truth.accelerations.enclosure for truth in truths]
    return TreeProblem(
        posed,
        mechanism,
        Enclosure(*(np.array([getattr(one, part) for one in found]) for part in ("high", "low", "radius"))),
        np.array([truth.mass_matrix.float for truth in truths]),
    )
