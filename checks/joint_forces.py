"""Joint forces: what each link exerts on its carrier, against Newton's sum over all that hangs below (Takeno (8))."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..models.result import Result
from ..models.tree import SUPPORT, PlanarTree
from .cell import Cell, quotient, worst
from .facts import FORCE_STATES
from .rounding import EPSILON, allowed

Array = NDArray[np.float64]

NAME = "joint forces"
NEEDS = "joint_forces"


def compare(cell: Cell) -> Iterator[Result]:
    """The engine's forces in the true motion, over the sum of the magnitudes of the forces that make them up."""
    states = cell.states
    chosen = slice(-FORCE_STATES, None)
    theta, omega, alpha = states.theta[chosen], states.omega[chosen], cell.facts.high[chosen]
    expected = cell.facts.forces
    got = cell.answer("joint forces", cell.engine.joint_forces(theta, omega, alpha), expected.shape)
    error = np.linalg.norm(got - expected, axis=-1)
    swing = cell.amplitude.felt(alpha) + cell.amplitude.felt(omega) ** 2
    scale = force_amplitudes(cell.scene.system.tree(), swing)
    found = worst(quotient(error, EPSILON * scale))
    bound = allowed(cell.scene.system.n, cell.info.accuracy)
    largest = np.linalg.norm(expected, axis=-1).max(axis=-1)
    relative = worst(quotient(error.max(axis=-1), largest)).value
    state, joint = found.index
    label = states.labels[chosen][state]
    agrees = found.value <= bound
    yield cell.result(
        NAME,
        "agrees" if agrees else "differs",
        measured=found.value,
        allowed=bound,
        unit="ε",
        reason=cell.info.accuracy_reason
        if agrees
        else f"the force at joint {joint + 1} is off by {float(error[state, joint]):.3g} N in state {label!r}",
        details={"relative": relative, "joint": joint + 1, "state": label, "states": len(theta)},
    )


def force_amplitudes(tree: PlanarTree, swing: Array) -> Array:
    """Σ over all that hangs at each hinge of mass × (gravity + |every acceleration on the way to it|), (B, n) [N].

    ``swing``: |θ̈| + θ̇² of each link [1/s²], (B, n).
    """
    carried = np.zeros_like(swing)  # acceleration of each link's hinge
    force = np.zeros_like(swing)
    for i, link in enumerate(tree.links):
        if link.parent != SUPPORT:
            carried[..., i] = carried[..., link.parent] + np.hypot(*link.hinge) * swing[..., link.parent]
        force[..., i] = link.mass * (tree.gravity + carried[..., i] + np.hypot(*link.com) * swing[..., i])
    for i in range(tree.n - 1, -1, -1):
        if tree.parents[i] != SUPPORT:
            force[..., tree.parents[i]] += force[..., i]
    return force
