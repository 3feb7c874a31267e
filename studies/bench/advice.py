"""Which engine, integrator and step to use for an error that is asked for: the coarsest setting of each that keeps it.

Every step is tried in the scene itself, from coarse to fine, each half of the one before. A step counts only if the
next finer one keeps the error too: at a coarse step the error may be small by chance. Nothing is extrapolated, but for
the decision to stop: where the errors so far say that the step needed takes longer than the time given, it is not run.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np

from ...models import InvalidInput, Scene, TreeScene
from ...records.bench import Advised, NotAdvised
from ...reference.integration.taylor import simulate
from .methods import FURIKO, STEP, End, Method, methods, start
from .tree_methods import TreeReference, tree_methods, tree_reference

LOOKED_AT = (0.5, 0.75, 1.0)  # parts of the motion: at its end alone an error may pass through zero
FEWEST_STEPS, HALVINGS = 16, 26  # a multiple of four: each part looked at is a whole number of steps
SURE = 0.1  # the reference may be off by this part of the error asked for
TIMED = 3  # runs
FALLS = 0.9  # of the error before: less is no sign of convergence
CONVERGING = 0.1  # errors above it [rad, rad/s] say nothing of how fast a method converges


@dataclass(frozen=True)
class Trial:
    """One setting of a method: its largest error, infinite where a run failed, and the seconds of the whole motion."""

    setting: float
    error: float
    seconds: float


@dataclass(frozen=True)
class Reference:
    """The motion at LOOKED_AT, θ and ω of shape (parts, n), and how far it may be off at most."""

    theta: np.ndarray
    omega: np.ndarray
    error: float

    def off(self, number: int, end: End) -> float:
        """The largest error of an end at one of the times looked at."""
        return float(np.abs(np.array(end) - (self.theta[number], self.omega[number])).max())


AnyScene = Scene | TreeScene
AnyReference = Reference | TreeReference


def reference(scene: Scene, asked: float) -> Reference:
    """The scene's motion by furiko's own Taylor series.

    Raises :class:`InvalidInput` where it is not known ten times better than ``asked``.
    """
    theta, omega = start(scene)
    times = [0.0, *(part * scene.duration for part in LOOKED_AT)]
    found = simulate(scene.system, theta, omega, times)
    off = np.maximum.accumulate(found.error * max(1.0, float(np.abs(found.omega).max())))
    if off[-1] > SURE * asked:
        kept = [time for time, error in zip(times, off, strict=True) if error <= SURE * asked]
        raise InvalidInput(
            f"{scene.name}: an error of {asked:g} cannot be told after {scene.duration:g} s: the motion itself is "
            f"known to {off[-1]:.0e} only, because it multiplies rounding errors; it is known well enough at "
            f"{kept[-1]:g} s. "
            "Ask for a shorter time (--until) or a larger error (--error)"
        )
    return Reference(found.theta[1:], found.omega[1:], float(off[-1]))


def advise(
    scene: AnyScene, engines: Sequence[str], asked: float, budget: float, watch: Callable[[str], None] = lambda _: None
) -> tuple[list[Advised], list[NotAdvised], list[str], float]:
    """Methods that keep an error of ``asked`` [rad, rad/s], those that do not, engines left out, the reference's error.

    ``budget`` [s]: about how long to try in all. ``watch`` is called with what is tried next.
    """
    true: AnyReference
    if isinstance(scene, TreeScene):
        true = tree_reference(scene, asked, LOOKED_AT, SURE)
        chosen, left_out = tree_methods(scene, engines)
    else:
        true = reference(scene, asked)
        chosen, left_out = methods(scene, engines)
    advised: list[Advised] = []
    missed: list[NotAdvised] = []
    left = budget
    for i, method in enumerate(chosen):
        watch(f"{scene.name} {method.engine} {method.scheme}")
        share = max(left / (len(chosen) - i), 0.1)
        begun = time.monotonic()
        found, reason = coarsest(method, scene, true, asked, share)
        if reason:
            errors = [trial.error for trial in found if trial.error < math.inf]
            missed.append(
                NotAdvised(
                    engine=method.engine, scheme=method.scheme, error=min(errors) if errors else None, reason=reason
                )
            )
        else:
            advised.append(_advised(method, found, asked))
        left -= time.monotonic() - begun
    advised.sort(key=lambda each: (each.engine == FURIKO, each.seconds))
    return advised, missed, left_out, true.error


def coarsest(
    method: Method, scene: AnyScene, true: AnyReference, asked: float, share: float
) -> tuple[list[Trial], str]:
    """Settings from coarse to fine, to the first two in a row that keep the error asked for; else why there is none."""
    tried: list[Trial] = []
    spent = 0.0
    for setting in settings(method, scene):
        needed = _needed(tried, asked)
        if needed > share - spent and tried:
            if tried[-1].error <= asked:
                return tried, f"a finer run, which must keep it too, would take {needed:.2g} s more (--budget)"
            return tried, f"it would take {needed:.2g} s more (--budget)"
        begun = time.monotonic()
        tried.append(attempt(method, scene, true, setting))
        spent += time.monotonic() - begun
        if len(tried) > 1 and max(tried[-1].error, tried[-2].error) <= asked:
            return tried, ""
        if _settled(tried, asked):
            return tried, "rounding: finer runs have no smaller error"
    return tried, "there is no finer setting"


def settings(method: Method, scene: AnyScene) -> Iterator[float]:
    """Steps [s] or tolerances, from coarse to fine."""
    if method.by == STEP:
        return (scene.duration / (FEWEST_STEPS << k) for k in range(HALVINGS))
    return iter(method.settings)


def attempt(method: Method, scene: AnyScene, true: AnyReference, setting: float) -> Trial:
    """Run a method to each of the times looked at."""
    worst = seconds = 0.0
    for number, part in enumerate(LOOKED_AT):
        begun = time.perf_counter()
        try:
            found = method.run(setting, part)
        except Exception:  # whatever an engine makes of too large a step: no other method's concern
            return Trial(setting, math.inf, time.perf_counter() - begun)
        seconds = time.perf_counter() - begun
        off = true.off(number, found)
        worst = max(worst, off) if math.isfinite(off) else math.inf
    return Trial(setting, worst, seconds)


def _needed(tried: Sequence[Trial], asked: float) -> float:
    """Seconds that the runs still needed take, if the error goes on falling as it did last; two more runs at least."""
    if len(tried) < 2:
        return 0.0
    before, last = tried[-2:]
    growth = max(1.2, min(2.0, last.seconds / max(before.seconds, 1e-9)))
    fell = before.error / last.error if 0 < last.error < math.inf else math.nan
    if last.error <= asked or last.error > CONVERGING or not fell > 1 / FALLS:
        return growth * last.seconds * len(LOOKED_AT)
    halvings = math.ceil(math.log(last.error / asked) / math.log(fell))
    return float(last.seconds * len(LOOKED_AT) * growth ** min(halvings, 60))


def _settled(tried: Sequence[Trial], asked: float) -> bool:
    """Whether three runs in a row have not come nearer, near enough for that to be rounding."""
    errors = [trial.error for trial in tried[-3:]]
    return len(errors) == 3 and asked < min(errors) < 1e-3 and errors[2] > FALLS * max(errors[0], errors[1])


def _advised(method: Method, tried: Sequence[Trial], asked: float) -> Advised:
    """The coarser of the last two, and what the setting before it does."""
    trial = tried[-2]
    before = tried[-3] if len(tried) > 2 else None
    times = []
    for _ in range(TIMED):
        begun = time.perf_counter()
        method.run(trial.setting)
        times.append(time.perf_counter() - begun)
    return Advised(
        engine=method.engine,
        scheme=method.scheme,
        by=method.by,
        setting=trial.setting,
        error=trial.error,
        seconds=median(times),
        coarser_setting=before.setting if before else None,
        coarser_error=before.error if before and math.isfinite(before.error) else None,
    )
