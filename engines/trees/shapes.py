"""Checks what an adapter of open mechanisms answers, and turns states of any shape into rows for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...models import InvalidInput
from ...models.spatial_mechanism import SpatialMechanism
from ..info import EngineInfo, TreeOffer, TreeQuantity
from ..protocol import Array, TreeEngine


class TreeShape:
    """An engine of an open mechanism that takes states of any leading shape: q (..., nq), v (..., nv).

    Input that is no state, and questions that the engine's ``info.tree`` calls missing, raise :class:`InvalidInput`. An
    answer of the wrong shape raises RuntimeError: it is the engine's fault. NaN in an answer is passed on.
    """

    def __init__(self, engine: TreeEngine, info: EngineInfo, mechanism: SpatialMechanism) -> None:
        self.info, self.mechanism = info, mechanism
        self._engine = engine
        self._nq, self._nv = mechanism.nq, mechanism.nv
        self._links = sum(bool(body.joints) for body in mechanism.bodies)

    def of(self, mechanism: SpatialMechanism) -> TreeShape:
        """The same engine with another mechanism. What its adapter raises where it cannot hold it comes through."""
        return TreeShape(type(self._engine)(mechanism), self.info, mechanism)

    def accelerations(self, q: ArrayLike, v: ArrayLike) -> Array:
        """a [rad/s² or m/s²], (..., nv)."""
        self._refuse_missing("accelerations")
        return self._batched(self._engine.accelerations, (self._nv,), q, v)

    def mass_matrix(self, q: ArrayLike) -> Array:
        """M, (..., nv, nv)."""
        self._refuse_missing("mass_matrix")
        return self._batched(self._engine.mass_matrix, (self._nv, self._nv), q)

    def bias(self, q: ArrayLike, v: ArrayLike) -> Array:
        """Forces that hold a = 0 without dampers and springs, (..., nv)."""
        self._refuse_missing("bias")
        return self._batched(self._engine.bias, (self._nv,), q, v)

    def passive(self, q: ArrayLike, v: ArrayLike) -> Array:
        """Forces of dampers and springs, (..., nv)."""
        self._refuse_missing("passive")
        return self._batched(self._engine.passive, (self._nv,), q, v)

    def derivatives(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """∂a/∂q and ∂a/∂v, (..., nv, nv) each."""
        self._refuse_unless_offered("derivatives")

        def both(*rows: Array) -> Array:
            return np.stack(self._engine.derivatives(*rows), axis=1)

        found = self._batched(both, (2, self._nv, self._nv), q, v)
        return found[..., 0, :, :], found[..., 1, :, :]

    def inverse_mass(self, q: ArrayLike) -> Array:
        """M⁻¹, (..., nv, nv)."""
        self._refuse_unless_offered("inverse_mass")
        return self._batched(self._engine.inverse_mass, (self._nv, self._nv), q)

    def joint_forces(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
        """Force [N] and moment [N m] of each moving link on what carries it, (..., links, 6)."""
        self._refuse_unless_offered("joint_forces")
        return self._batched(self._engine.joint_forces, (self._links, 6), q, v, a)

    def energy(self, q: ArrayLike, v: ArrayLike) -> Array:
        """Kinetic and potential energy [J], (..., 2)."""
        self._refuse_missing("energy")
        return self._batched(self._engine.energy, (2,), q, v)

    def trajectory(self, q: ArrayLike, v: ArrayLike, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        """q (nq,) and v (nv,) after ``steps`` steps of ``step`` seconds from one state."""
        self._refuse_missing("trajectory")
        if integrator not in [one.name for one in self.info.integrators]:
            raise InvalidInput(f"integrator: {self.info.name} has none called {integrator!r}")
        if not (step > 0 and np.isfinite(step) and steps >= 1):
            raise InvalidInput(f"at least one step of a positive and finite time is needed, got {steps} of {step!r} s")
        given = _state("q", q, self._nq), _state("v", v, self._nv)
        if any(values.ndim != 1 for values in given):
            raise InvalidInput("a trajectory starts from one state")
        found = tuple(
            np.asarray(end, dtype=np.float64) for end in self._engine.trajectory(*given, integrator, step, steps)
        )
        if [end.shape for end in found] != [(self._nq,), (self._nv,)]:
            raise RuntimeError(f"{self.info.name} ended a run in arrays of shapes {[end.shape for end in found]}")
        return found[0], found[1]

    def _refuse_missing(self, quantity: TreeQuantity) -> None:
        assert self.info.tree is not None
        if quantity in self.info.tree.missing:
            raise InvalidInput(f"{self.info.name} has no {quantity} of a tree: {self.info.tree.missing[quantity]}")

    def _refuse_unless_offered(self, quantity: TreeOffer) -> None:
        assert self.info.tree is not None
        if quantity not in self.info.tree.offers:
            why = self.info.tree.lacks.get(quantity, "its adapter does not offer it")
            raise InvalidInput(f"{self.info.name} has no {quantity} of a tree: {why}")

    def _batched(self, ask: Callable[..., Any], tail: tuple[int, ...], q: ArrayLike, *v: ArrayLike) -> Array:
        given = [_state("q", q, self._nq), *(_state("v", rates, self._nv) for rates in v)]
        first = given[0].shape[:-1]
        if any(values.shape[:-1] != first for values in given):
            raise InvalidInput(f"q and v: as many states of each are needed, got {[values.shape for values in given]}")
        rows = [np.array(values.reshape(-1, values.shape[-1]), order="C") for values in given]
        found = np.array(ask(*rows), dtype=np.float64)
        if found.shape != (len(rows[0]), *tail):
            raise RuntimeError(f"{self.info.name} gave an answer of shape {found.shape}, not {(len(rows[0]), *tail)}")
        return found.reshape(first + tail)


def _state(name: str, value: ArrayLike, size: int) -> Array:
    try:
        given = np.asarray(value)
    except ValueError:
        raise InvalidInput(f"{name}: an array of numbers is needed, got rows of different lengths") from None
    if given.dtype.kind not in "iuf":
        raise InvalidInput(f"{name}: real numbers are needed, got {given.dtype.name}")
    if not given.ndim or given.shape[-1] != size:
        raise InvalidInput(f"{name}: {size} numbers a state are needed, got an array of shape {given.shape}")
    if not np.isfinite(given).all():
        raise InvalidInput(f"{name}: every number must be finite")
    return np.asarray(given, dtype=np.float64)
