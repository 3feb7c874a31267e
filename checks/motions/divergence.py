"""Predicted and measured errors of an engine's run along a true motion, and what their crossings say.

From the true state at each of its times t_k an engine takes one step; what it misses the true state at t_{k+1} by is
its local error d_k. Errors that are small travel with the motion's own tangent flow Φ_k, so that those of the engine's
whole run are predicted by

    e_{k+1} = Φ_k e_k + d_k.

The local errors are the engine's own, and so a different model shows in them as well as a scheme: but in proportion to
the step, while a scheme of order p neglects step^(p+1). With several steps the one is told from the other.

A scheme that remembers more than angles and rates (accelerations of its own, hinges that have come apart) is let run
for some steps first, from a true state, until it has forgotten that start: see :func:`memory`. In so many steps from
the start of the whole run nothing is predicted, since both are one run.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator
from ...records.check import Outcome, Result
from ...reference.integration.schemes import BUTCHER_6
from ...reference.integration.variation import Growth
from ...reference.proved.kept import Proof, distance
from ...reference.rounding.bounds import EPSILON
from ..cell import EngineFault
from ..true_path import STEPS

Array = NDArray[np.float64]
Acceleration = Callable[[Any, Any], Any]

NAME = "horizon"

APART = 1e-3  # [rad]; two trajectories that differ by more have parted
NEAR = 1e-2  # [rad]; up to here an error is small: what it neglects of itself is a hundredth part
GONE = 1.0  # [rad]; beyond, a carried error means nothing
MEMORIES = (4, 8, 16, 32, 64, 128)  # steps that a scheme may take to forget
FORGOTTEN = 1e-3  # twice as many steps change the local errors by less than this part of them
FRAMES = 150  # of a motion that is shown: the coarsest step's, which parts first
MOST_SHOWN = 10  # links of one
MOST_OFF = 0.1 * EPSILON  # [rad, rad/s]; a true state that is off by more shows in a scheme's local errors
WINDOW = 16  # steps whose local errors one such run gives
MOST_TOGETHER = 64  # the same of schemes that remember nothing, at most
NEGLECTED = 1e-4  # a part of a local error; as is the square of what is between a run and the true motion

# The prediction neglects what an error does to its own growth: at NEAR a hundredth part for each time that the rates
# of the motion change by as much as themselves, and a few of these add up. So an error is predicted to within a
# twentieth, and where it lingers beside a threshold the time of its crossing is known only as well as that.
KNOWN = 1.05
EXPLAINED = 0.03  # of the time: what is promised of a predicted divergence time


class Runs(Protocol):
    """A cell whose engine makes runs: of a document's mechanism, or of a tree."""

    def trajectory(self, theta: Array, omega: Array, integrator: Integrator, step: float, steps: int, /) -> Array:
        """Coordinates and rates at the end, (2, n)."""
        ...

    def path(self, theta: Array, omega: Array, integrator: Integrator, step: float, steps: int, /) -> Array | None:
        """The same side by side at the start and after each step, (steps + 1, 2n); None where there are no paths."""
        ...

    def result(self, check: str, outcome: Outcome, **fields: Any) -> Result:
        """A result of this cell."""
        ...


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


def held(truth: TrueMotion, kept: Proof | None, most: Array | float = MOST_OFF) -> Proved:
    """The true motion against a kept proof, at all of its times that are ends of steps.

    Raises ArithmeticError where it is off by more than ``most``, at each end of a step: then it is not the true motion.
    """
    found = []
    allowed = np.broadcast_to(most, len(truth.high))
    for i, time in enumerate(kept.times if kept is not None else ()):
        k = round(time / truth.step)
        if k < len(truth.high) and divides(truth.step, time):
            assert kept is not None
            off = distance(kept, i, truth.high[k], truth.low[k])
            if off > allowed[k]:
                raise ArithmeticError(f"the motion in quadruple precision is {off:.2g} beside the proved one")
            found.append((time, off))
    if not found:
        return Proved()
    return Proved(tuple(time for time, _ in found), max(off for _, off in found))


def predicted(
    cell: Runs, integrator: Integrator, truth: TrueMotion, accelerations: Acceleration, proved: Proved
) -> Horizon:
    """Predict and measure along a true motion; ``accelerations``: its own, of states (…, n)."""
    start = memory(cell, integrator, truth, accelerations) if integrator.remembers else 0
    errors = _remembering(cell, integrator, truth, accelerations, start) if start else _plain(cell, integrator, truth)
    carried, local = carry(truth, errors)
    n, steps = truth.high.shape[-1] // 2, len(truth.flow)
    # Where the prediction has come to its end the run need not go on for long.
    last = min(steps, len(carried) + len(carried) // 10 + 10)
    run = path(cell, integrator, truth.high[0], truth.step, last)
    measured = run - truth.high[: last + 1]
    return Horizon(
        integrator=integrator,
        step=truth.step,
        times=truth.growth.times,
        predicted=largest_so_far(carried[:, :n], steps),
        measured=largest_so_far(measured[:, :n], steps),
        local=local,
        from_time=start * truth.step,
        lyapunov_time=truth.growth.lyapunov_time,
        truth=truth.high[:, :n],
        run=run[:, :n],
        proved=proved,
    )


def divides(small: float, large: float) -> bool:
    """Whether ``large`` is a whole number of ``small``."""
    return abs(large / small - round(large / small)) < 1e-9


def _plain(cell: Runs, integrator: Integrator, truth: TrueMotion) -> Iterator[Array]:
    """Local errors (2n,), one after the other, of a scheme that knows nothing but its state.

    By short runs from true states: what is between a run and the true motion travels with that, Φ y, and what comes
    besides in a step is the local error. What Φ neglects of y has to be nothing beside it: else the next run begins.
    """
    first, steps = 0, len(truth.flow)
    fewest = most_together(first)
    while first < steps:
        count = min(fewest, most_together(first), steps - first)
        run = path(cell, integrator, truth.high[first], truth.step, count)
        # The run started from the true state rounded to double precision: that part of its error is not its own.
        off = run - truth.high[first : first + count + 1] - truth.low[first : first + count + 1]
        errors = off[1:] - (truth.flow[first : first + count] @ off[:-1, :, None])[..., 0]
        large = np.abs(off[1:-1]).max(axis=-1) ** 2 > NEGLECTED * np.abs(errors[1:]).max(axis=-1)
        used = 1 + int(np.argmax(large)) if large.any() else count
        yield from errors[:used]
        first, fewest = first + used, 2 * used


def most_together(first: int) -> int:
    """Steps of one run, from so many steps after the start, that give local errors at most.

    A fourth of all that came before: a prediction made of the errors of the run that it predicts would be none.
    """
    return max(1, min(first // 4, MOST_TOGETHER))


def _remembering(
    cell: Runs, integrator: Integrator, truth: TrueMotion, accelerations: Acceleration, start: int
) -> Iterator[Array]:
    """The same of a scheme with a memory of ``start`` steps."""
    steps = len(truth.flow)
    for first in range(0, steps, WINDOW):
        yield from _window(cell, integrator, truth, accelerations, first, min(first + WINDOW, steps), start)


def _window(
    cell: Runs,
    integrator: Integrator,
    truth: TrueMotion,
    accelerations: Acceleration,
    first: int,
    last: int,
    start: int,
) -> Array:
    """Local errors of steps ``first`` to ``last``, (…, 2n), from a run begun at the true state ``start`` steps before.

    The run has left the truth by its start, which the scheme has forgotten, but not by its state: the local error is
    what a step misses the true motion *from where it began* by. That motion is one step of Butcher's sixth order.
    """
    begin = max(0, first - start)
    run = path(cell, integrator, truth.high[begin], truth.step, last - begin)[first - begin :]
    n = run.shape[-1] // 2
    true = BUTCHER_6.step(accelerations, run[:-1, :n], run[:-1, n:], truth.step)
    return np.asarray(run[1:] - np.concatenate(true, axis=-1), dtype=np.float64)


def memory(cell: Runs, integrator: Integrator, truth: TrueMotion, accelerations: Acceleration) -> int:
    """Steps after which a scheme has forgotten its start: local errors no longer depend on where a run began.

    Looked at in three places; at most a quarter of the whole run, and at most the last of :data:`MEMORIES`.
    """
    steps = len(truth.flow)
    places = [steps // 2, 5 * steps // 8, 3 * steps // 4]
    for start in MEMORIES:
        pairs = [
            [_window(cell, integrator, truth, accelerations, place, place + 1, each)[0] for each in (start, 2 * start)]
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


def path(cell: Runs, integrator: Integrator, state: Array, step: float, steps: int) -> Array:
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


def result(cell: Runs, found: Horizon, order: float | None) -> Result:
    """Of one integrator and step; ``order``: :func:`local_order`, with the step before."""
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
