"""Energy: the engine's kinetic and potential energy against the mechanism's."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...models.spatial_mechanism import WORLD, SpatialMechanism
from ...records.check import Result
from ...reference.rounding.spatial import Magnitudes
from .cell import TreeCell
from .verdict import judged

Array = NDArray[np.float64]

NAME = "energy"
PARTS = ("kinetic", "potential")


def compare(cell: TreeCell) -> Iterator[Result]:
    """Both parts, over the sum of the magnitudes of their terms; the potential up to what it is in the first state.

    So it has the errors of two states, and their units are added.
    """
    states, facts = cell.states, cell.facts
    got = cell.answer(NAME, cell.engine.energy(states.q, states.v), (len(states), 2))
    error = got - facts.energy
    unit = np.array([energy_unit(cell.mechanism, units) for units in cell.magnitudes])
    error[:, 1] -= error[0, 1]
    unit[:, 1] += unit[0, 1]

    def says(state: int, index: tuple[int, ...]) -> str:
        (part,) = index
        off = f"is off by {error[state, part]:.3g} J from {facts.energy[state, part]:.9g} J"
        return f"the {PARTS[part]} energy {off}"

    yield judged(cell, NAME, error, unit, says, {})


def energy_unit(mechanism: SpatialMechanism, units: Magnitudes) -> Array:
    """½ Σ |v_i| × unit of M_ij × |v_j|, and Σ m |g| × the way to the centre, with the springs'; (2,) [J]."""
    rates = units.once(units.v)
    kinetic = float(rates @ units.mass_matrix @ rates) / 2
    masses = np.array([body.inertial.mass for body in mechanism.bodies])
    potential = float(np.linalg.norm(mechanism.gravity) * (masses @ _ways(mechanism, units.q)))
    for placed in mechanism.joints:
        joint, here = placed.joint, units.q[placed.columns_q]
        if joint.kind in ("hinge", "slide"):
            potential += joint.stiffness * (abs(here[0]) + abs(joint.springref)) ** 2 / 2
            continue
        potential += joint.stiffness * np.pi**2 / 2
        if joint.kind == "free":
            rest = float(np.linalg.norm(mechanism.bodies[placed.body].position))
            potential += joint.stiffness * (float(np.linalg.norm(here[:3])) + rest) ** 2 / 2
    return np.array([kinetic, potential])


def _ways(mechanism: SpatialMechanism, q: Array) -> Array:
    """The length of the way from the world's origin along the joints to each body's centre of mass [m], (bodies,)."""
    frames: list[float] = []
    at = {placed.joint.name: placed.at_q for placed in mechanism.joints}
    for body in mechanism.bodies:
        way = (0.0 if body.parent == WORLD else frames[body.parent]) + float(np.linalg.norm(body.position))
        for joint in body.joints:
            here = q[at[joint.name] :]
            if joint.kind == "free":
                way = float(np.linalg.norm(here[:3]))
            elif joint.kind == "slide":
                way += abs(float(here[0])) + abs(joint.ref)
            else:
                way += 2 * float(np.linalg.norm(joint.anchor))
        frames.append(way)
    centres = [float(np.linalg.norm(body.inertial.centre)) for body in mechanism.bodies]
    return np.asarray(np.array(frames) + np.array(centres))
