"""An engine with some of its features switched off, and the part of the file that it is then compared with."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from ...engines.model_files.adapter import FileEngine, Reader
from ...models.mechanism import Mechanism
from ..measurement import Array


@dataclass(frozen=True)
class EngineView:
    """An engine that holds a model file, asked ``without`` some of its features; angles absolute, shape (B, n)."""

    engine: FileEngine
    without: frozenset[str]

    def accelerations(self, theta: Array, omega: Array) -> Array:
        """θ̈ [rad/s²], (B, n)."""
        return self.engine.accelerations(theta, omega, self.without)

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array) -> Array:
        """Generalised forces [N m] of the absolute angles, (B, n)."""
        return self.engine.inverse_dynamics(theta, omega, alpha, without=self.without)

    def trajectory(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        """θ [rad] and ω [rad/s], (n,) each, after ``steps`` steps of ``step`` [s]."""
        return self.engine.trajectory(theta, omega, integrator, step, steps, self.without)

    def compiled(self) -> Mechanism:
        """The mechanism that the engine holds."""
        return self.engine.compiled()

    def switched_off(self, feature: str) -> EngineView:
        """The same with one more feature switched off."""
        return EngineView(self.engine, self.without | {feature})


def view_for_comparison(engine: FileEngine, reader: Reader) -> EngineView:
    """The engine without dry friction where that can be switched off.

    MuJoCo's dry friction is a soft constraint, not a constant torque: the rest is compared without it.
    """
    return EngineView(engine, frozenset({"frictionloss"}) if "frictionloss" in reader.features else frozenset())


def theory_for(mechanism: Mechanism, reader: Reader, view: EngineView) -> Mechanism:
    """The file's mechanism without what the engine was never given and what is switched off."""
    given = with_hinges_cleared(mechanism, reader.without)
    return with_hinges_cleared(given, ("friction",)) if "frictionloss" in view.without else given


def with_hinges_cleared(mechanism: Mechanism, names: Iterable[str]) -> Mechanism:
    """The mechanism with these numbers (``damping``, ``friction`` …) zero on every hinge."""
    zeros = dict.fromkeys(names, 0.0)
    if not zeros:
        return mechanism
    return replace(mechanism, hinges=tuple(replace(hinge, **zeros) for hinge in mechanism.hinges))  # type: ignore[arg-type]
