"""Whether runs in ever shorter steps keep a number: what they leave of it, extrapolated to step zero, is nothing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator
from ...records.check import Outcome, Result
from ...reference.integration.richardson import amplified, at_step_zero, settles

Array = NDArray[np.float64]

NAME = "invariant"

STEPS = 16  # of the coarsest run
SHORT = 1 / 4  # step × fastest rate, in the coarsest run
RUNS = 4
LARGEST_N = 32  # degrees of freedom; beyond, engines need seconds for it


class OfEngine(Protocol):
    """A cell of any kind, which makes results."""

    def result(self, check: str, outcome: Outcome, **fields: Any) -> Result:
        """A result of this cell."""
        ...


@dataclass(frozen=True)
class Kept:
    """What runs keep: its name, its unit, and a sentence on why they do."""

    name: str
    unit: str
    says: str


ENERGY = Kept("energy", "J", "nothing takes energy away or brings any")
WAY_BACK = "with rates reversed the way leads back"


def too_large(cell: OfEngine, n: int) -> Result:
    """The result where a mechanism has so many degrees of freedom that no runs are made."""
    return cell.result(NAME, "skipped", reason=f"runs are made up to {LARGEST_N} links, not with {n}")


def result(
    cell: OfEngine,
    integrator: Integrator,
    kept: Kept,
    step: float,
    runs: Sequence[Array],
    noise: float,
    details: dict[str, Any],
) -> Result:
    """``runs``: what runs in steps of ``step`` [s], half of it, … leave; ``noise``: what of it rounding explains."""
    name, unit = f"{NAME} {kept.name} {integrator.name}", kept.unit
    if not np.isfinite(runs).all():
        reason = f"{integrator.name} diverges at a step of {step:.3g} s or a part of it"
        return cell.result(name, "skipped", reason=reason)
    if not np.isfinite(noise):
        return cell.result(name, "skipped", reason=f"in {STEPS * step:.3g} s rounding may grow beyond any number")
    at_zero, uncertainty = at_step_zero(runs, integrator.order)
    limit = float(np.abs(at_zero).max())
    noise = amplified(integrator.order) * noise
    bound = uncertainty + noise
    agrees = limit <= bound
    if not agrees and not settles(runs, integrator.order, noise):
        reason = f"{integrator.name}: from a step of {step:.3g} s to an eighth of it, errors do not fall as they do "
        return cell.result(name, "skipped", reason=reason + "where an extrapolation to step zero means something")
    return cell.result(
        name,
        "agrees" if agrees else "differs",
        measured=limit,
        allowed=bound,
        unit=unit,
        reason=kept.says if agrees else f"at step zero {limit:.3g} {unit} are left, and {kept.says}",
        details=details
        | {
            "integrator": integrator.name,
            "steps": [step / 2**k for k in range(RUNS)],
            "left": [float(np.abs(run).max()) for run in runs],
        },
    )
