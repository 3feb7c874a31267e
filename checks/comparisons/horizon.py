"""The horizon: when two trajectories of a chaotic motion had to part, and whether these did then and no earlier.

From the true state at each of its times t_k an engine takes one step; what it misses the true state at t_{k+1} by is
its local error d_k. Errors that are small travel with the motion's own tangent flow Φ_k, so that those of the engine's
whole run are predicted by

    e_{k+1} = Φ_k e_k + d_k,

with Φ from the reference's variational equations and the truth in quadruple precision. Beside it stands the error that
the engine's run really has. Where the two cross 0.001 rad at one time, the trajectories had to part then: by what the
scheme neglects in a step, and by how the motion makes differences grow.

The local errors are the engine's own, and so a different model shows in them as well as a scheme: but in proportion to
the step, while a scheme of order p neglects step^(p+1). With several steps the one is told from the other.

A scheme that remembers more than angles and rates (accelerations of its own, hinges that have come apart) is let run
for some steps first, from a true state, until it has forgotten that start: see :func:`memory`. In so many steps from
the start of the whole run nothing is predicted, since both are one run.

    python -m furiko.checks.comparisons.horizon [SCENE|FILE.toml ...] [--engine NAME] [--step SECONDS] [--duration
    SECONDS]
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator, engine_info, engine_names, load_engine
from ...models import InvalidInput, Scene, document_catalogue, find_document_scene
from ...models.states import natural_rate, states
from ...models.systems import DocumentSystem
from ...records.check import Result
from ...reference import literal_accelerations
from ...reference.integration.schemes import BUTCHER_6
from ...reference.integration.variation import Growth, growth, lyapunov_time, tangent_flow
from ...reference.proved.kept import Proof, distance, proof
from ...reference.rounding.bounds import EPSILON
from ...reference.truth.quadruple import quadruple_trajectory
from ..cell import Cell, EngineFault
from ..facts import scene_facts

Array = NDArray[np.float64]

NAME = "horizon"

STEPS = (1e-2, 5e-3, 1e-3)  # [s]; every one a multiple of the last
LONGEST = 10.0  # [s]
FOLDS = 20.0  # Lyapunov times; a local error of a few roundings has grown past every threshold here by then
APART = 1e-3  # [rad]; two trajectories that differ by more have parted
NEAR = 1e-2  # [rad]; up to here an error is small: what it neglects of itself is a hundredth part
GONE = 1.0  # [rad]; beyond, a carried error means nothing
MEMORIES = (4, 8, 16, 32, 64, 128)  # steps that a scheme may take to forget
FORGOTTEN = 1e-3  # twice as many steps change the local errors by less than this part of them
FRAMES = 150  # of a motion that is shown: the coarsest step's, which parts first
MOST_SHOWN = 10  # links of one
MOST_OFF = 0.1 * EPSILON  # [rad, rad/s]; a true state that is off by more shows in a scheme's local errors
WINDOW = 16  # steps whose local errors one such run gives

# The prediction neglects what an error does to its own growth: at NEAR a hundredth part for each time that the rates
# of the motion change by as much as themselves, and a few of these add up. So an error is predicted to within a
# twentieth, and where it lingers beside a threshold the time of its crossing is known only as well as that.
KNOWN = 1.05
EXPLAINED = 0.03  # of the time: what is promised of a predicted divergence time


@dataclass(frozen=True)
class TrueMotion:
    """The true motion at steps of ``step`` [s]: states high + low, (K+1, 2n), and Φ of each step, (K, 2n, 2n)."""

    step: float
    high: Array
    low: Array
    flow: Array
    growth: Growth


@dataclass(frozen=True)
class Proved:
    """Times [s] at which the motion was held against a kept proof, and the most it is off there [rad, rad/s]: a bound.

    Beyond the last of them, and where there is none, it rests on quadruple precision's estimate of its own error.
    """

    times: tuple[float, ...] = ()
    off: float = 0.0


@dataclass(frozen=True)
class Horizon:
    """``predicted`` and ``measured``: largest error of an angle so far [rad] at each of ``times`` [s], (K+1,).

    ``local``: size of the local error [rad, rad/s] of each step that is predicted; ``from_time``: predictions begin
    here [s]. ``truth``, ``run``: angles of the true motion and of the engine's [rad], (K+1, n), (≤ K+1, n);
    ``proved``: where the true motion was held against kept proofs.
    """

    integrator: Integrator
    step: float
    times: Array
    predicted: Array
    measured: Array
    local: Array
    from_time: float
    lyapunov_time: float
    truth: Array
    run: Array
    proved: Proved = Proved()

    def crossing(self, threshold: float) -> tuple[float, float]:
        """When the predicted and the measured error first exceed a threshold [s]; infinite where they do not."""
        return _first(self.times, self.predicted > threshold), _first(self.times, self.measured > threshold)

    def miss(self) -> float:
        """How far the measured crossings are from the predicted ones, as a part of the time: the worse of the two.

        Less the time of one step, which either may be off by.
        """
        worst, end = 0.0, float(self.times[-1])
        for threshold in (APART, NEAR):
            early, late = (min(self.crossing(threshold * known)[0], end) for known in (1 / KNOWN, KNOWN))
            measured = min(self.crossing(threshold)[1], end)
            outside = max(early - measured, measured - late) - 1.5 * self.step
            worst = max(worst, outside / measured)
        return worst


def compare(cell: Cell) -> Iterator[Result]:
    """One result for each of the engine's integrators and each step."""
    for integrator in cell.info.integrators:
        found = [horizon(cell, integrator, step, followed(cell.scene)) for step in STEPS]
        orders = [None, *(local_order(a, b) for a, b in pairwise(found))]
        for one, order in zip(found, orders, strict=True):
            yield _result(cell, one, order)


@lru_cache(maxsize=1)  # a worker looks at one scene with several integrators and engines
def followed(scene: Scene) -> float:
    """How long a scene's motion is followed [s]: a whole number of the longest steps."""
    assert scene.theta is not None
    assert scene.omega is not None
    folding = lyapunov_time(scene.system, np.array(scene.theta), np.array(scene.omega), scene.duration)
    return STEPS[0] * round(min(LONGEST, FOLDS * folding) / STEPS[0])


def horizon(cell: Cell, integrator: Integrator, step: float, duration: float) -> Horizon:
    """Predict and measure the error of one integrator at one step."""
    scene = cell.scene
    if scene.theta is None or scene.omega is None:
        raise InvalidInput(f"scene {scene.name!r} has no state for a trajectory to start from")
    truth = true_motion(scene.system, scene.theta, scene.omega, step, duration)
    start = memory(cell, integrator, truth) if integrator.remembers else 0
    errors = _remembering(cell, integrator, truth, start) if start else _step_by_step(cell, integrator, truth)
    carried, local = carry(truth, errors)
    n, steps = scene.system.n, len(truth.flow)
    # Where the prediction has come to its end the run need not go on for long.
    last = min(steps, len(carried) + len(carried) // 10 + 10)
    run = path(cell, integrator, truth.high[0], step, last)
    measured = run - truth.high[: last + 1]
    return Horizon(
        integrator=integrator,
        step=step,
        times=truth.growth.times,
        predicted=largest_so_far(carried[:, :n], steps),
        measured=largest_so_far(measured[:, :n], steps),
        local=local,
        from_time=start * step,
        lyapunov_time=truth.growth.lyapunov_time,
        truth=truth.high[:, :n],
        run=run[:, :n],
        proved=held(truth, proof(scene.system, scene.theta, scene.omega, scene.duration)),
    )


def held(truth: TrueMotion, kept: Proof | None) -> Proved:
    """The true motion against a kept proof, at all of its times that are ends of steps.

    Raises ArithmeticError where it is off by more than local errors are known to: then it is not the true motion.
    """
    found = []
    for i, time in enumerate(kept.times if kept is not None else ()):
        k = round(time / truth.step)
        if k < len(truth.high) and _divides(truth.step, time):
            assert kept is not None
            found.append((time, distance(kept, i, truth.high[k], truth.low[k])))
    if not found:
        return Proved()
    off = max(each for _, each in found)
    if off > MOST_OFF:
        raise ArithmeticError(f"the motion in quadruple precision is {off:.2g} beside the proved one: it is of no use")
    return Proved(tuple(time for time, _ in found), off)


def true_motion(
    system: DocumentSystem, theta: tuple[float, ...], omega: tuple[float, ...], step: float, duration: float
) -> TrueMotion:
    """The true motion in steps; the quadruple precision behind it is shared among all steps that divide."""
    finest = STEPS[-1] if _divides(STEPS[-1], step) else step
    stride = round(step / finest)
    steps = int(duration / step + 0.5)
    high, low = _integrated(system, theta, omega, finest / 2, 2 * steps * stride)
    half = slice(0, 2 * steps * stride + 1, stride)
    n = system.n
    flow = tangent_flow(system, high[half, :n], high[half, n:], step)
    whole = slice(0, 2 * steps * stride + 1, 2 * stride)
    return TrueMotion(step, high[whole], low[whole], flow, growth(flow, step, natural_rate(system)))


def _divides(small: float, large: float) -> bool:
    return abs(large / small - round(large / small)) < 1e-9


@lru_cache(maxsize=4)
def _integrated(
    system: DocumentSystem, theta: tuple[float, ...], omega: tuple[float, ...], spacing: float, points: int
) -> tuple[Array, Array]:
    found = quadruple_trajectory(system, theta, omega, spacing * np.arange(points + 1, dtype=np.float64))
    return np.hstack([found.theta, found.omega]), np.hstack([found.theta_low, found.omega_low])


def _step_by_step(cell: Cell, integrator: Integrator, truth: TrueMotion) -> Iterator[Array]:
    """Local errors (2n,), one after the other: a step from each true state, less the true state after it."""
    n = cell.scene.system.n
    for k, flow in enumerate(truth.flow):
        state = truth.high[k]
        end = cell.trajectory(state[:n], state[n:], integrator, truth.step, 1).ravel()
        # The engine started from the true state rounded to double precision: that part of its error is not its own.
        yield end - truth.high[k + 1] - truth.low[k + 1] + flow @ truth.low[k]


def _remembering(cell: Cell, integrator: Integrator, truth: TrueMotion, start: int) -> Iterator[Array]:
    """The same of a scheme with a memory of ``start`` steps."""
    steps = len(truth.flow)
    for first in range(0, steps, WINDOW):
        yield from _window(cell, integrator, truth, first, min(first + WINDOW, steps), start)


def _window(cell: Cell, integrator: Integrator, truth: TrueMotion, first: int, last: int, start: int) -> Array:
    """Local errors of steps ``first`` to ``last``, (…, 2n), from a run begun at the true state ``start`` steps before.

    The run has left the truth by its start, which the scheme has forgotten, but not by its state: the local error is
    what a step misses the true motion *from where it began* by. That motion is one step of Butcher's sixth order.
    """
    begin = max(0, first - start)
    run = path(cell, integrator, truth.high[begin], truth.step, last - begin)[first - begin :]
    system, n = cell.scene.system, cell.scene.system.n
    true = BUTCHER_6.step(
        lambda theta, omega: literal_accelerations(system, theta, omega), run[:-1, :n], run[:-1, n:], truth.step
    )
    return np.asarray(run[1:] - np.concatenate(true, axis=-1), dtype=np.float64)


def memory(cell: Cell, integrator: Integrator, truth: TrueMotion) -> int:
    """Steps after which a scheme has forgotten its start: local errors no longer depend on where a run began.

    Looked at in three places; at most a quarter of the whole run, and at most the last of :data:`MEMORIES`.
    """
    steps = len(truth.flow)
    places = [steps // 2, 5 * steps // 8, 3 * steps // 4]
    for start in MEMORIES:
        pairs = [
            [_window(cell, integrator, truth, place, place + 1, length)[0] for length in (start, 2 * start)]
            for place in places
        ]
        changes = [np.abs(once - twice).max() / max(np.abs(twice).max(), EPSILON) for once, twice in pairs]
        if max(changes) < FORGOTTEN or 4 * start > steps:
            return start
    return MEMORIES[-1]


def carry(truth: TrueMotion, errors: Iterator[Array]) -> tuple[Array, Array]:
    """e_{k+1} = Φ_k e_k + d_k from e_0 = 0, as far as it means anything, (≤ K+1, 2n); and the sizes of the d_k."""
    carried, sizes = [np.zeros(truth.high.shape[-1])], []
    for flow, error in zip(truth.flow, errors, strict=False):
        carried.append(flow @ carried[-1] + error)
        sizes.append(float(np.abs(error).max()))
        if not np.abs(carried[-1]).max() <= GONE:
            break
    return np.array(carried), np.array(sizes)


def path(cell: Cell, integrator: Integrator, state: Array, step: float, steps: int) -> Array:
    """All states of one run, (steps + 1, 2n): the adapter's own path, or one step after the other.

    Raises :class:`EngineFault` where the engine gives neither.
    """
    n = len(state) // 2
    found = cell.path(state[:n], state[n:], integrator, step, steps)
    if found is not None:
        return found
    if integrator.remembers:
        raise EngineFault(f"{integrator.name} remembers more than angles and rates, and the adapter gives no paths")
    states = [state]
    for _ in range(steps):
        states.append(cell.trajectory(states[-1][:n], states[-1][n:], integrator, step, 1).ravel())
    return np.array(states)


def largest_so_far(errors: Array, steps: int) -> Array:
    """The largest magnitude of any angle's error up to each time, (steps + 1,); infinite where it is none, or ends."""
    sizes = np.full(steps + 1, np.inf)
    sizes[: len(errors)] = np.abs(np.where(np.isfinite(errors), errors, np.inf)).max(axis=-1)
    return np.asarray(np.maximum.accumulate(sizes))


def local_order(coarse: Horizon, fine: Horizon) -> float | None:
    """The power of the step with which local errors fall, less one; None where rounding is much of them.

    Compared are their medians over the time that both predictions cover.
    """
    time = min(len(one.local) * one.step for one in (coarse, fine))
    large, small = (float(np.median(one.local[: max(1, round(time / one.step))])) for one in (coarse, fine))
    if not (small > 100 * EPSILON and math.isfinite(large)):
        return None
    return math.log(large / small) / math.log(coarse.step / fine.step) - 1


def _first(times: Array, crossed: NDArray[np.bool_]) -> float:
    return float(times[int(np.argmax(crossed))]) if crossed.any() else math.inf


def _result(cell: Cell, found: Horizon, order: float | None) -> Result:
    predicted, measured = found.crossing(APART)
    miss = found.miss()
    needed = min(predicted, measured, float(found.times[-1]))  # up to here the verdict rests on the true motion
    # Another model's part is of order 0; a coarse step shows a little less than the scheme's.
    foreign = order is not None and order < found.integrator.order / 2
    agrees = miss <= EXPLAINED and not foreign
    return cell.result(
        f"{NAME} {found.integrator.name} {found.step:g} s",
        "agrees" if agrees else "differs",
        measured=miss,
        allowed=EXPLAINED,
        unit="of the time",
        reason=says(found, order, foreign=foreign),
        details={
            "integrator": found.integrator.name,
            "step": found.step,
            "parts, predicted": _finite(predicted),
            "parts, measured": _finite(measured),
            "reaches 0.01 rad, predicted": _finite(found.crossing(NEAR)[0]),
            "reaches 0.01 rad, measured": _finite(found.crossing(NEAR)[1]),
            "Lyapunov time": found.lyapunov_time,
            "order of local errors": order,
            "predicted from": found.from_time,
            "truth": "proved" if found.proved.times and found.proved.times[-1] >= needed else "estimated",
            "truth proved at": list(found.proved.times),
            "truth off by at most": found.proved.off if found.proved.times else None,
            "errors over time": history(found),
            **({"motion": motion(found)} if found.step == max(STEPS) and found.truth.shape[-1] <= MOST_SHOWN else {}),
        },
    )


def history(found: Horizon) -> list[list[float | None]]:
    """Time, predicted and measured error at fifty of the times, for a drawing."""
    chosen = np.unique(np.linspace(1, len(found.times) - 1, 50).astype(int))
    columns = (found.times, found.predicted, found.measured)
    return [[_finite(float(column[k])) for column in columns] for k in chosen]


def motion(found: Horizon) -> dict[str, list[list[float]] | list[float]]:
    """``times`` [s], and the angles [rad] of ``theory`` and ``engine`` at each, to four decimals, for a drawing.

    As long as the engine's are numbers.
    """
    ended = ~np.isfinite(found.run).all(axis=-1)
    last = int(np.argmax(ended)) - 1 if ended.any() else len(found.run) - 1
    chosen = np.unique(np.linspace(0, last, FRAMES).astype(int))
    return {
        "times": [round(float(found.times[k]), 4) for k in chosen],
        "theory": np.round(found.truth[chosen], 4).tolist(),
        "engine": np.round(found.run[chosen], 4).tolist(),
    }


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def says(found: Horizon, order: float | None, *, foreign: bool) -> str:
    """In words: whether these two trajectories had to part."""
    predicted, measured = found.crossing(APART)
    end, name = found.times[-1], f"{found.integrator.name} with a step of {found.step:g} s"
    if foreign:
        return (
            f"the local errors of {name} fall with order {order:.2f}, not {found.integrator.order}: what parts these "
            f"trajectories is not the scheme but another model"
        )
    if math.isinf(predicted) and math.isinf(measured):
        return (
            f"these two trajectories need not part within {end:g} s and do not: they end {found.measured[-1]:.2g} rad "
            f"apart, predicted were {found.predicted[-1]:.2g}"
        )
    if found.miss() > EXPLAINED:
        when = "not at all" if math.isinf(predicted) else f"at {predicted:.4g} s"
        really = "stay together" if math.isinf(measured) else f"part at {measured:.4g} s"
        return f"these two trajectories had to part {when}, by the local errors of {name}; they {really}"
    if measured <= found.from_time:
        start = round(found.from_time / found.step)
        return f"these two trajectories part at {measured:.4g} s, in the {start} steps that {name} remembers its start"
    return (
        f"these two trajectories had to part: the local errors of {name}, grown e-fold each {found.lyapunov_time:.2g} "
        f"s, reach {APART:g} rad at {predicted:.4g} s, and they do at {measured:.4g} s"
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Print predicted and measured divergence times of scenes, engines, integrators and steps."""
    parser = argparse.ArgumentParser(
        prog="python -m furiko.checks.comparisons.horizon", description="When trajectories part."
    )
    parser.add_argument("scene", nargs="*", help="of the catalogue, or a TOML file; those tagged chaotic if left out")
    parser.add_argument("--engine", action="append", help="may be given several times; all that integrate if left out")
    parser.add_argument("--step", action="append", type=float, help=f"[s]; {', '.join(map(str, STEPS))} if left out")
    parser.add_argument("--duration", type=float, default=LONGEST, help=f"[s]; {LONGEST:g} if left out")
    given = parser.parse_args(arguments)
    scenes = [find_document_scene(name, "this") for name in given.scene or document_catalogue()]
    chosen = [scene for scene in scenes if given.scene or "chaotic" in scene.tags]
    print("scene                 engine            integrator            step   parts: predicted  measured   Lyapunov")
    for scene in chosen:
        for engine in given.engine or [name for name in engine_names() if engine_info(name).integrators]:
            for line in _table(scene, engine, given.step or STEPS, given.duration):
                print(line, flush=True)


def _table(scene: Scene, engine: str, steps: Sequence[float], duration: float) -> Iterator[str]:
    looked_at = states(scene, random=1)
    cell = Cell(scene, engine_info(engine), load_engine(engine, scene.system), looked_at, scene_facts(scene, looked_at))
    for integrator in cell.info.integrators:
        for step in steps:
            found = horizon(cell, integrator, step, duration)
            predicted, measured = (
                f"{time:8.3f} s" if math.isfinite(time) else "   later  " for time in found.crossing(APART)
            )
            yield (
                f"{scene.name:21} {engine:17} {integrator.name:17} {step:8g} s       {predicted}  {measured} "
                f"{found.lyapunov_time:7.3f} s"
            )


if __name__ == "__main__":
    main()
