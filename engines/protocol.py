"""What an engine is to furiko: six questions that it may be asked.

Angles and rates are absolute and along the last axis, batches along the first: ``theta`` [rad] and ``omega`` [rad/s]
have shape (B, n). Forces and torques are those of the planar mechanism; x is to the right, z up.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..models import System

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ModelFields:
    """What the engine holds after it has read the model, in the order of the mechanism's links.

    ``dofs``: degrees of freedom; ``parents``: index of each link's parent, -1 for the support; ``hinges`` and
    ``centres``: hinge in the parent's frame and centre of mass in its own, (along, across) [m], shape (n, 2);
    ``masses`` [kg]; ``inertias`` about the centre of mass and the hinge axis [kg m²]; ``gravity``: the vector
    (x, y, z) [m/s²] in the world where z is up and y into the plane; ``armature`` [kg m²] and ``damping`` [N m s] of
    each hinge.
    """

    dofs: int
    parents: tuple[int, ...]
    hinges: Array
    centres: Array
    masses: Array
    inertias: Array
    gravity: Array
    armature: Array
    damping: Array


@dataclass(frozen=True)
class BareCall:
    """One call of an engine's interface, its input in place, that computes the accelerations of ``states`` states."""

    states: int
    call: Callable[[], object]


@dataclass(frozen=True)
class Native:
    """An engine's accelerations a(q, v), (n,), in its own coordinates, and the changes to and from them, (B, n)."""

    accelerate: Callable[[Array, Array], Array]
    from_absolute: Callable[[Array], Array]
    to_absolute: Callable[[Array], Array]


class Engine(Protocol):
    """An adapter: made for one system, asked in absolute angles. It need not answer what its info calls missing."""

    def __init__(self, system: System) -> None: ...

    def fields(self) -> ModelFields:
        """The model as the engine compiled it."""
        ...

    def accelerations(self, theta: Array, omega: Array) -> Array:
        """θ̈ [rad/s²], shape (B, n)."""
        ...

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        """Generalised forces [N m] that the absolute angles need for the accelerations ``alpha``, shape (B, n)."""
        ...

    def joint_forces(self, theta: Array, omega: Array, alpha: Array) -> Array:
        """Force (x, z) [N] that each link exerts on what carries it, at its hinge, in that motion; shape (B, n, 2).

        For a rod chain row j is Takeno's T_j, j = 0 … n-1: the force of A_{j+1} on A_j at their joint. An engine that
        only solves for forces along with its own accelerations may pass over ``alpha``.
        """
        ...

    def energy(self, theta: Array, omega: Array) -> Array:
        """Kinetic and potential energy [J], the latter zero at the support's height; shape (B, 2)."""
        ...

    def trajectory(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        """θ and ω, shape (n,) each, after ``steps`` steps of ``step`` seconds from one state (n,), (n,)."""
        ...

    def path(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        """The same run with all its states, the first included: shape (steps + 1, n) each.

        An adapter may leave this out: whoever wants a path then runs to each of its points anew.
        """
        ...

    def adaptive(
        self, theta: Array, omega: Array, scheme: str, duration: float, tolerance: float
    ) -> tuple[Array, Array]:
        """θ and ω, shape (n,) each, after ``duration`` seconds by one of the info's adaptive schemes, if there are any.

        ``tolerance``: relative and absolute, of one step.
        """
        ...

    def bare_calls(self, theta: Array, omega: Array, threads: int) -> Mapping[str, BareCall]:
        """Its barest ways to accelerations, by the names that its users know, prepared to be timed.

        A call works on all the states (B, n), or on the first alone. An adapter may leave this out.
        """
        ...

    def native(self) -> Native:
        """Its accelerations in its own coordinates, one state a call; an adapter may leave this out."""
        ...

    def lighter(self) -> Mapping[str, Callable[[], AbstractContextManager[None]]]:
        """Contexts in which its calls are spared what its bindings alone add, by name; it may leave this out."""
        ...

    def gap(self) -> float:
        """Largest distance [m] between the two points that a joint holds together, at the end of the last run.

        Only where joints are constraints, in maximal coordinates; others leave this out.
        """
        ...
