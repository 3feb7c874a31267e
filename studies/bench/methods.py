"""The methods that compute a motion's end: engines' own integrators, Pinocchio with scipy's DOP853, furiko's Taylor."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from ...engines import AnyShape, EngineInfo, Integrator, Native, cannot, engine_info, load_engine, why_missing
from ...models import InvalidInput, Scene, TreeScene
from ...models.errors import library
from ...reference.proved.kept import proof, sure
from ...reference.truth.end_points import lookup
from ...reference.truth.quadruple import QuadrupleTrajectory

Array = NDArray[np.float64]
End = tuple[Array, Array]

FURIKO = "furiko"
# Engines whose motions are timed unless others are named. The other variants of Pinocchio read models or solve matrices
# in another way, which changes nothing for an integrator.
ENGINES = ("mujoco", "pinocchio-aba", "exudyn-tree", "exudyn-redundant")
STEP, TOLERANCE = "step [s]", "tolerance"
FIRST_STEPS = 50  # per link, in the coarsest run of a fixed-step scheme; each further run halves the step
HALVINGS = 16
ADAPTIVE = tuple(10.0**-k for k in range(3, 14))
DOP853 = (1e-4, 1e-6, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 3e-14)  # scipy takes no tolerance below 100 ε
TAYLOR = tuple(10.0**-k for k in range(2, 15, 2))


@dataclass(frozen=True, eq=False)
class Method:
    """``run(setting)`` gives θ [rad], ω [rad/s] at the end, (n,) each; ``run(setting, part)`` after a part of the time.

    ``settings``: from coarse to fine; ``by``: steps or tolerances. ``contexts``: those in which it is timed, by name;
    they change its time and nothing else.
    """

    engine: str
    scheme: str
    by: str
    settings: Sequence[float]
    run: Callable[..., End]
    contexts: Mapping[str, Callable[[], AbstractContextManager[object]]] = field(
        default_factory=lambda: {"": nullcontext}
    )

    def named(self, context: str) -> str:
        """The scheme's name, in this context."""
        return f"{self.scheme}, {context}" if context else self.scheme


def methods(scene: Scene, engines: Sequence[str]) -> tuple[list[Method], list[str]]:
    """All methods of these engines for the scene, furiko's own first; and the engines left out, with the reason."""
    found, left_out = list(_own(scene)), []
    for name in engines:
        info = engine_info(name)
        reason = why_not(name, scene)
        if reason:
            left_out.append(f"{name}: {reason}")
            continue
        ways = list(_of_engine(scene, name, info))
        found += ways
        if not ways:
            left_out.append(f"{name}: {info.missing.get('trajectory', 'it computes no trajectories')}")
    return found, left_out


def why_not(name: str, scene: Scene | TreeScene) -> str:
    """The reason why an engine is left out; empty where it is not."""
    return why_missing(name) or cannot(engine_info(name), scene.system) or ""


def start(scene: Scene) -> tuple[Array, Array]:
    """The scene's state, θ and ω, (n,) each."""
    return np.array(scene.theta), np.array(scene.omega)


@cache
def truth(scene: Scene) -> QuadrupleTrajectory:
    """The scene's motion in quadruple precision; its last row is the end. Raises :class:`InvalidInput` without one."""
    if scene.theta is None or scene.omega is None or not scene.duration:
        raise InvalidInput(f"{scene.name}: a [state] with a duration is needed, or there is no motion to time")
    return lookup(scene.system, scene.theta, scene.omega, scene.duration)


def reference_error(scene: Scene) -> tuple[float, bool]:
    """How far :func:`truth` is from the motion at its end [rad, rad/s], and whether that is proved, not estimated."""
    true = truth(scene)
    assert scene.theta is not None
    assert scene.omega is not None
    off, proved = sure(true, proof(scene.system, scene.theta, scene.omega, scene.duration))
    return float(off[-1]), proved[-1]


def end_error(scene: Scene, end: End) -> float:
    """The largest error of θ [rad] and ω [rad/s] at the end; infinite where the run failed."""
    true = truth(scene)
    off = np.abs((np.array(end) - (true.theta[-1], true.omega[-1])) - (true.theta_low[-1], true.omega_low[-1])).max()
    return float(off) if np.isfinite(off) else math.inf


def _of_engine(scene: Scene, name: str, info: EngineInfo) -> Iterator[Method]:
    engine = load_engine(name, scene.system)
    contexts = {"": nullcontext, **engine.lighter()}
    if "trajectory" not in info.missing:
        for scheme in info.integrators:
            settings = [scene.duration / (FIRST_STEPS * scene.system.n << k) for k in range(HALVINGS)]
            yield Method(name, scheme.name, STEP, settings, partial(_fixed, engine, scene, scheme), contexts)
        for adaptive in info.adaptive:
            yield Method(name, adaptive, TOLERANCE, ADAPTIVE, partial(_adaptive, engine, scene, adaptive))
        return
    native = engine.native()
    if native is not None:
        yield Method(name, "scipy DOP853", TOLERANCE, DOP853, partial(dop853, native, scene))


def _fixed(engine: AnyShape, scene: Scene, scheme: Integrator, step: float, part: float = 1.0) -> End:
    theta, omega = start(scene)
    return engine.trajectory(theta, omega, scheme.name, step, round(part * scene.duration / step))


def _adaptive(engine: AnyShape, scene: Scene, scheme: str, tolerance: float, part: float = 1.0) -> End:
    theta, omega = start(scene)
    return engine.adaptive(theta, omega, scheme, part * scene.duration, tolerance)


def dop853(native: Native, scene: Scene, tolerance: float, part: float = 1.0) -> End:
    """The end by scipy's DOP853 in the engine's own coordinates, without conversions in between."""
    theta, omega = (native.from_absolute(x[None])[0] for x in start(scene))
    n = len(theta)
    accelerate = native.accelerate

    def motion(_time: float, state: Array) -> Array:
        return np.concatenate((state[n:], accelerate(state[:n], state[n:])))

    solved = library("scipy.integrate").solve_ivp(
        motion, (0.0, part * scene.duration), np.concatenate((theta, omega)), "DOP853", rtol=tolerance, atol=tolerance
    )
    end = solved.y[:, -1] if solved.success else np.full(2 * n, np.nan)
    return native.to_absolute(end[None, :n])[0], native.to_absolute(end[None, n:])[0]


def _own(scene: Scene) -> Iterator[Method]:
    yield Method(FURIKO, "Taylor", TOLERANCE, TAYLOR, partial(taylor, scene))


def taylor(scene: Scene, tolerance: float, part: float = 1.0) -> End:
    """The end by furiko's own Taylor series."""
    from ...reference.integration.taylor import simulate

    theta, omega = start(scene)
    found = simulate(scene.system, theta, omega, [0.0, part * scene.duration], tolerance=tolerance)
    return found.theta[-1], found.omega[-1]
