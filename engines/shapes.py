"""Checks what an adapter is given and what it answers, and turns states of any shape into rows for it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..models import InvalidInput, System
from ..models.errors import nearest
from .info import EngineInfo, Offer, Quantity
from .protocol import Array, BareCall, Engine, ModelFields, Native


class AnyShape:
    """An engine that takes states of any leading shape (..., n), and answers in the same.

    Input that is no state, and questions that the engine's ``info`` calls missing, raise :class:`InvalidInput`. An
    answer of the wrong shape raises RuntimeError: it is the engine's fault. NaN in an answer is passed on.
    """

    def __init__(self, engine: Engine, info: EngineInfo, n: int) -> None:
        self.info = info
        self._engine = engine
        self._n = n

    def of(self, system: System) -> AnyShape:
        """The same engine with another mechanism. Raises :class:`InvalidInput` where it cannot take it."""
        return AnyShape(type(self._engine)(system), self.info, system.n)

    def fields(self) -> ModelFields:
        """The model as the engine compiled it."""
        self._refuse_missing("fields")
        return self._engine.fields()

    def accelerations(self, theta: ArrayLike, omega: ArrayLike) -> Array:
        """θ̈ [rad/s²], shape (..., n)."""
        self._refuse_missing("accelerations")
        return self._batched(self._engine.accelerations, (self._n,), theta=theta, omega=omega)

    def inverse_dynamics(self, theta: ArrayLike, omega: ArrayLike, alpha: ArrayLike, *, gravity: bool = True) -> Array:
        """Generalised forces [N m] that the absolute angles need for ``alpha``, shape (..., n)."""
        self._refuse_missing("inverse_dynamics")

        def forces(*rows: Array) -> Array:
            return self._engine.inverse_dynamics(*rows, gravity=gravity)

        return self._batched(forces, (self._n,), theta=theta, omega=omega, alpha=alpha)

    def joint_forces(self, theta: ArrayLike, omega: ArrayLike, alpha: ArrayLike) -> Array:
        """Force (x, z) [N] of each link on its parent or the support, shape (..., n, 2)."""
        self._refuse_missing("joint_forces")
        return self._batched(self._engine.joint_forces, (self._n, 2), theta=theta, omega=omega, alpha=alpha)

    def derivatives(self, theta: ArrayLike, omega: ArrayLike) -> tuple[Array, Array]:
        """∂θ̈/∂θ [1/s²] and ∂θ̈/∂θ̇ [1/s], shape (..., n, n) each."""
        self._refuse_unless_offered("derivatives")

        def both(*rows: Array) -> Array:
            return np.stack(self._engine.derivatives(*rows), axis=1)

        found = self._batched(both, (2, self._n, self._n), theta=theta, omega=omega)
        return found[..., 0, :, :], found[..., 1, :, :]

    def inverse_mass(self, theta: ArrayLike) -> Array:
        """M⁻¹ [1/(kg m²)] of absolute angles, shape (..., n, n)."""
        self._refuse_unless_offered("inverse_mass")
        return self._batched(self._engine.inverse_mass, (self._n, self._n), theta=theta)

    def energy(self, theta: ArrayLike, omega: ArrayLike) -> Array:
        """Kinetic and potential energy [J], shape (..., 2)."""
        self._refuse_missing("energy")
        return self._batched(self._engine.energy, (2,), theta=theta, omega=omega)

    def trajectory(
        self, theta: ArrayLike, omega: ArrayLike, integrator: str, step: float, steps: int
    ) -> tuple[Array, Array]:
        """θ and ω, shape (n,) each, after ``steps`` steps of ``step`` [s] from one state (n,), (n,)."""
        start = self._start(theta, omega, integrator, step, steps)
        angles, rates = self._engine.trajectory(*start, integrator, float(step), int(steps))
        return self._held(angles, (self._n,)), self._held(rates, (self._n,))

    def path(
        self, theta: ArrayLike, omega: ArrayLike, integrator: str, step: float, steps: int
    ) -> tuple[Array, Array] | None:
        """All states of the same run, the first included, (steps + 1, n) each; None where the adapter has no paths."""
        start = self._start(theta, omega, integrator, step, steps)
        if not hasattr(self._engine, "path"):
            return None
        angles, rates = self._engine.path(*start, integrator, float(step), int(steps))
        return self._held(angles, (steps + 1, self._n)), self._held(rates, (steps + 1, self._n))

    def adaptive(
        self, theta: ArrayLike, omega: ArrayLike, scheme: str, duration: float, tolerance: float
    ) -> tuple[Array, Array]:
        """θ and ω, shape (n,) each, after ``duration`` [s] by a scheme that chooses its steps from ``tolerance``."""
        self._refuse_missing("trajectory")
        if scheme not in self.info.adaptive:
            has = ", ".join(self.info.adaptive) or "none"
            raise InvalidInput(f"{self.info.name}: no adaptive scheme {scheme!r}; it has {has}")
        for name, value in (("duration", duration), ("tolerance", tolerance)):
            if not (math.isfinite(value) and value > 0):
                raise InvalidInput(f"{name}: a positive number is needed, got {value!r}")
        start = self._state(theta, omega)
        angles, rates = self._engine.adaptive(*start, scheme, float(duration), float(tolerance))
        return self._held(angles, (self._n,)), self._held(rates, (self._n,))

    def bare_calls(self, theta: ArrayLike, omega: ArrayLike, threads: int = 1) -> Mapping[str, BareCall]:
        """The engine's shortest ways to the accelerations of states (B, n), to be timed; empty if it offers none."""
        if not hasattr(self._engine, "bare_calls"):
            return {}
        return self._engine.bare_calls(_numbers("theta", theta), _numbers("omega", omega), threads)

    def native(self) -> Native | None:
        """The engine's accelerations in its own coordinates; None where it does not offer them."""
        return self._engine.native() if hasattr(self._engine, "native") else None

    def lighter(self) -> Mapping[str, Callable[[], AbstractContextManager[None]]]:
        """By name, contexts in which calls lack an overhead that only the engine's Python bindings add."""
        return self._engine.lighter() if hasattr(self._engine, "lighter") else {}

    def gap(self) -> float | None:
        """Largest violation of a joint's constraint [m] at the end of the last run; None without constraints."""
        return float(self._engine.gap()) if hasattr(self._engine, "gap") else None

    def _start(
        self, theta: ArrayLike, omega: ArrayLike, integrator: str, step: float, steps: int
    ) -> tuple[Array, Array]:
        """One state, (n,) each, once all arguments of a run have been checked."""
        self._refuse_missing("trajectory")
        known = [scheme.name for scheme in self.info.integrators]
        if integrator not in known:
            hint = nearest(integrator, known) or f"; it has {', '.join(known)}"
            raise InvalidInput(f"{self.info.name}: no integrator {integrator!r}{hint}")
        if not (math.isfinite(step) and step > 0):
            raise InvalidInput(f"step: a positive number of seconds is needed, got {step!r}")
        if steps < 1:
            raise InvalidInput(f"steps: at least 1 is needed, got {steps!r}")
        return self._state(theta, omega)

    def _state(self, theta: ArrayLike, omega: ArrayLike) -> tuple[Array, Array]:
        angles, rates = np.array(_numbers("theta", theta)), np.array(_numbers("omega", omega))  # the engine's own
        for name, values in (("theta", angles), ("omega", rates)):
            if values.shape != (self._n,):
                raise InvalidInput(f"{name}: shape {values.shape}, where one state of {self._n} angles is needed")
        return angles, rates

    def _refuse_missing(self, quantity: Quantity) -> None:
        if quantity in self.info.missing:
            raise InvalidInput(f"{self.info.name}: no {quantity.replace('_', ' ')}: {self.info.missing[quantity]}")

    def _refuse_unless_offered(self, quantity: Offer) -> None:
        if quantity not in self.info.offers:
            why = self.info.lacks.get(quantity, "its adapter does not offer it")
            raise InvalidInput(f"{self.info.name}: no {quantity.replace('_', ' ')}: {why}")

    def _batched(self, ask: Callable[..., Any], tail: tuple[int, ...], **given: ArrayLike) -> Array:
        """Ask with rows (B, n) made from every given (..., n); the answer, (B, *tail), as (..., *tail)."""
        states = {name: _numbers(name, value) for name, value in given.items()}
        first = next(iter(states.values())).shape
        for name, values in states.items():
            if values.shape[-1:] != (self._n,) or values.shape != first:
                shapes = ", ".join(f"{known} {state.shape}" for known, state in states.items())
                raise InvalidInput(f"{name}: all must have one shape (..., {self._n}), got {shapes}")
        # Copies: what an engine does to its arguments reaches nobody, and what it returns is its own buffer no longer.
        rows = [np.array(values.reshape(-1, self._n), order="C") for values in states.values()]
        return self._held(ask(*rows), (len(rows[0]), *tail)).reshape(first[:-1] + tail)

    def _held(self, answer: Any, shape: tuple[int, ...]) -> Array:
        found = np.array(answer, dtype=np.float64)
        if found.shape != shape:
            raise RuntimeError(f"{self.info.name} gave an answer of shape {found.shape} where {shape} is due")
        return found


def _numbers(name: str, value: ArrayLike) -> Array:
    try:
        given = np.asarray(value)
    except ValueError:
        raise InvalidInput(f"{name}: an array of numbers is needed, got rows of different lengths") from None
    if given.dtype.kind not in "iuf":
        raise InvalidInput(f"{name}: real numbers are needed, got {given.dtype.name}")
    numbers = np.asarray(given, dtype=np.float64)
    if not np.isfinite(numbers).all():
        where = tuple(int(i) for i in np.argwhere(~np.isfinite(numbers))[0])
        raise InvalidInput(f"{name}[{', '.join(map(str, where))}]: must be finite, got {numbers[where]!r}")
    return numbers
