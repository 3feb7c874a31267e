"""Textbook schemes that carry an open mechanism over one step of time, with quaternions among its coordinates.

A step leads from a place q to q ⊕ x (:mod:`.tree_places`), and a scheme of :mod:`.schemes` finds the move x, which is
nothing where the step begins. Of hinges and slides x and v are what θ and ω are there. Where something turns in all
directions, dx/dt is not v, and three ways are usual:

* x is moved as if it were: a rotation is by the mean of the rates that the stages have, in the moved body's axes, so
  that a scheme's order is at most two;
* dx/dt is what it is (:func:`.tree_places.rates_of_moves`), as Munthe-Kaas has it: the order is the scheme's;
* the four components of a quaternion are moved like other coordinates, and at the end it is made of length one.

Sources: Munthe-Kaas 1998, "Runge-Kutta methods on Lie groups"; Hairer, Lubich, Wanner, *Geometric Numerical
Integration* (IV.8).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.spatial_mechanism import WORLD, PlacedJoint, SpatialMechanism
from .schemes import SCHEMES, Scheme, Tableau
from .tree_places import moved, normalised, quaternions, rates_of_coordinates, rates_of_moves
from .tree_variation import accelerations, rate_slopes

Floats = NDArray[np.float64]
Wide = NDArray[Any]
Step = Callable[[Wide, Wide, Any], tuple[Wide, Wide]]

BY_MEANS = ", rotations by means of rates"
ON_THE_GROUP = ", rotations after Munthe-Kaas"
BY_COMPONENTS = ", quaternions by components"
LATE = "semi-implicit Euler, dampers at the end of the step"
LATE_FREE = LATE + ", and what turns free bodies"
LATE_BARE = LATE_FREE + " that carry nothing"


@dataclass(frozen=True)
class TreeScheme:
    """A scheme, whose ``step`` takes q (B, nq), v (B, nv) and a time [s] to both after it; the rest as a Scheme's."""

    name: str
    order: int
    step: Step
    reach: float = 1.0
    stages: int = 1


def tree_schemes(mechanism: SpatialMechanism, mass: Floats) -> list[TreeScheme]:
    """All of a mechanism; ``mass``: M (B, nv, nv) of the states that steps are taken from."""
    turns = bool(quaternions(mechanism))
    found = []
    for scheme in SCHEMES:
        several = turns and scheme.tableau is not None and scheme.stages > 1
        name, order = (scheme.name + BY_MEANS, min(scheme.order, 2)) if several else (scheme.name, scheme.order)
        found.append(_like(scheme, name, order, partial(_moved_by, mechanism, scheme.step)))
        if several and scheme.tableau is not None:
            along = partial(rates_of_moves, mechanism)
            on_the_group = partial(_moved_by, mechanism, partial(scheme.tableau.step_along, along))
            found.append(_like(scheme, scheme.name + ON_THE_GROUP, scheme.order, on_the_group))
        if turns:
            found += _by_components(mechanism, scheme)
    return [*found, *_late(mechanism, mass)]


def _like(scheme: Scheme, name: str, order: int, step: Step) -> TreeScheme:
    return TreeScheme(name, order, step, scheme.reach, scheme.stages)


def _moved_by(mechanism: SpatialMechanism, step: Any, q: Wide, v: Wide, h: Any) -> tuple[Wide, Wide]:
    """The step of a scheme of moves and rates."""
    by, rates = step(lambda x, w: accelerations(mechanism, moved(mechanism, q, x), w), np.zeros_like(v), v, h)
    return moved(mechanism, q, by), rates


def _by_components(mechanism: SpatialMechanism, scheme: Scheme) -> Iterator[TreeScheme]:
    along, a = partial(rates_of_coordinates, mechanism), partial(accelerations, mechanism)

    def runge_kutta(tableau: Tableau, q: Wide, v: Wide, h: Any) -> tuple[Wide, Wide]:
        places, rates = tableau.step_along(along, a, normalised(mechanism, q), v, h)
        return normalised(mechanism, places), rates

    def semi_implicit(q: Wide, v: Wide, h: Any) -> tuple[Wide, Wide]:
        rates, begin = v + h * a(q, v), normalised(mechanism, q)
        return normalised(mechanism, begin + h * along(begin, rates)), rates

    name = scheme.name + BY_COMPONENTS
    if scheme.tableau is not None:
        yield _like(scheme, name, scheme.order, partial(runge_kutta, scheme.tableau))
    elif scheme.name == "explicit Euler":
        yield _like(scheme, name, 1, partial(runge_kutta, Tableau(((),), (1,))))
    elif scheme.name == "semi-implicit Euler":
        yield _like(scheme, name, 1, semi_implicit)


def _late(mechanism: SpatialMechanism, mass: Floats) -> Iterator[TreeScheme]:
    """Semi-implicit Euler with some forces at the end of the step, where there are any.

    Of dampers D, (M + h D)⁻¹ M a is a − (M + h D)⁻¹ h D a, in which the second part, which double precision gives, is
    small. Of a free body on which nothing moves, with J = ∂a/∂v, all that depends on its rates: (1 − h J)⁻¹ a, which is
    a + (1 − h J)⁻¹ h J a.
    """
    damping = np.diag(mechanism.per_freedom("damping"))
    alone, bare = lone_free_bodies(mechanism), lone_free_bodies(mechanism, bare=True)

    def more(a: Floats, h: float) -> Floats:
        late = h * damping
        return np.asarray(-np.linalg.solve(mass + late, late @ a[..., None])[..., 0], dtype=np.float64)

    def more_of_free(joints: list[PlacedJoint], q: Wide, v: Wide, a: Floats, h: float) -> Floats:
        found, slopes = more(a, h), rate_slopes(mechanism, q.astype(np.float64), v.astype(np.float64))
        for joint in joints:
            own = joint.columns_v
            late = h * slopes[:, own, own].astype(np.float64)
            found[:, own] = np.linalg.solve(np.eye(len(late[0])) - late, late @ a[:, own, None])[..., 0]
        return found

    def step(joints: list[PlacedJoint], q: Wide, v: Wide, h: Any) -> tuple[Wide, Wide]:
        a = accelerations(mechanism, q, v)
        double = a.astype(np.float64)
        rates = v + h * (a + (more_of_free(joints, q, v, double, float(h)) if joints else more(double, float(h))))
        return moved(mechanism, q, h * rates), rates

    if damping.any():
        yield TreeScheme(LATE, 1, partial(step, []), stages=2)
    if alone:
        yield TreeScheme(LATE_FREE, 1, partial(step, alone), stages=2)
    if bare and len(bare) < len(alone):
        yield TreeScheme(LATE_BARE, 1, partial(step, bare), stages=2)


def lone_free_bodies(mechanism: SpatialMechanism, *, bare: bool = False) -> list[PlacedJoint]:
    """The joints of free bodies on which nothing hangs that moves, or, ``bare``, nothing that has mass."""
    carriers: list[int] = []
    for index, body in enumerate(mechanism.bodies):
        carriers.append(index if body.parent == WORLD else carriers[body.parent])
    loaded = {
        carrier
        for carrier, body in zip(carriers, mechanism.bodies, strict=True)
        if body.parent != WORLD and (body.joints or (bare and body.inertial.mass))
    }
    return [one for one in mechanism.joints if one.joint.kind == "free" and one.body not in loaded]
