"""The summary of Takeno's chain: natural frequencies, motions, their convergence, and what these say of the tip."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...records.check import Result
from ...records.stress import (
    ChainMemory,
    ChainMotion,
    ChainSummary,
    SmallSwings,
    StepConvergence,
    SwingError,
    TipConvergence,
    UsableStep,
)
from ...reference.chain import order
from .chain import COARSE, FINE, FRAMES, ChainRun, MemoryCase, StepCase, SwingsCase, listed_cases
from .searches import Results, Search, key

Array = NDArray[np.float64]

LARGE = 1.0  # amplitude of the large motion
CRACK = 0.4  # [s] until when the motion is smooth; the whip cracks a little later
AFTER = 1.0  # [s], after the crack
TIMES = (0.25, CRACK, 0.45, 0.5, 0.75, AFTER, 1.5, 2.0, 3.0, 4.0)  # [s] until which tips are compared
ASYMPTOTIC = 100  # links from which on the order of convergence is taken
FEWEST = 20  # rods from which on tips of n and 2n rods are compared in the verdict


def chain_summary(searches: Sequence[Search], results: Results) -> ChainSummary:
    """All that the results say of the chain."""
    runs = [search for search in searches if isinstance(search, ChainRun)]
    motions = [motion for run in runs if (motion := _motion(run, results))]
    listed = [(case, results[key(case)]) for case in listed_cases() if key(case) in results]
    return ChainSummary(
        swings=[swings for links in ("rods", "point masses") if (swings := _swings(links, listed))],
        usable_steps=[UsableStep(n=case.n, step=r.measured) for case, r in listed if isinstance(case, StepCase)],
        memory=[ChainMemory(n=case.n, bytes=r.measured) for case, r in listed if isinstance(case, MemoryCase)],
        motions=motions,
        convergence=tip_convergence(motions),
        step_convergence=step_convergence(motions),
        verdict=verdict(motions),
    )


def _swings(links: str, listed: Sequence[tuple[Any, Result]]) -> SmallSwings | None:
    found = [result.details for case, result in listed if isinstance(case, SwingsCase) and case.links == links]
    if len(found) < 2:
        return None
    numbers = [point["n"] for point in found]
    power = 2 if links == "rods" else 1
    count = min(len(point["errors"]) for point in found)
    rows = [_swing(k, numbers, [point["errors"][k] for point in found], power) for k in range(count)]
    return SmallSwings(links=links, n=numbers, power=power, rows=rows)


def _swing(k: int, numbers: Sequence[int], errors: list[float], power: int) -> SwingError:
    late = [i for i, n in enumerate(numbers) if n >= ASYMPTOTIC] or list(range(len(numbers)))
    return SwingError(
        k=k + 1,
        errors=errors,
        order=order([numbers[i] for i in late], [errors[i] for i in late]) if len(late) > 1 else None,
        coefficient=errors[-1] * numbers[-1] ** power,
    )


def _motion(run: ChainRun, results: Results) -> ChainMotion | None:
    pieces = [piece.details for piece in run.pieces(results)]
    if not pieces:
        return None
    first = pieces[0]["energy"][0]
    tip, speed = _joined(piece["tip"] for piece in pieces), _joined(piece["speed"] for piece in pieces)
    time = (len(tip) - 1) / FRAMES
    peak, peak_at = max(tuple(piece["peak"]) for piece in pieces)
    steps = sum(piece["steps"] for piece in pieces)
    return ChainMotion(
        n=run.n,
        amplitude=run.amplitude,
        tolerance=run.tolerance,
        closed=run.next(results)[0] is None,
        time=time,
        tip=tip.tolist(),
        speed=speed.tolist(),
        fastest_tip=peak,
        fastest_tip_at=peak_at,
        fastest_turning=max(piece["fastest"] for piece in pieces),
        energy_drift=float(max(max(abs(e - first) for e in piece["energy"][1:]) for piece in pieces) / first),
        steps=steps,
        mean_step=time / steps,
        seconds=sum(piece["computing"] for piece in pieces),
        curves={t: curve for piece in pieces for t, curve in piece["curves"].items()},
    )


def _joined(pieces: Iterable[Any]) -> Array:
    """Each piece begins with the sample with which the one before it ended."""
    return np.concatenate([np.array(piece)[bool(i) :] for i, piece in enumerate(pieces)])


def tip_convergence(motions: Sequence[ChainMotion]) -> list[TipConvergence]:
    """Distance between the tips of n and of 2n rods, and the order in 1/n with which it falls at the next doubling."""
    fine = {(m.amplitude, m.n): np.array(m.tip) for m in motions if m.tolerance == FINE}
    distances = {
        (amplitude, n): _distance(tip, fine[amplitude, 2 * n])
        for (amplitude, n), tip in fine.items()
        if (amplitude, 2 * n) in fine
    }
    largest = {where: _largest(distance) for where, distance in distances.items()}
    return [
        TipConvergence(
            amplitude=amplitude,
            n=n,
            times=_reached(distance),
            largest=largest[amplitude, n],
            series=distance.tolist(),
            order=_orders(largest[amplitude, n], largest.get((amplitude, 2 * n), [])),
        )
        for (amplitude, n), distance in distances.items()
    ]


def _orders(coarse: Sequence[float], fine: Sequence[float]) -> list[float | None]:
    return [float(np.log2(a / b)) if b else None for a, b in zip(coarse, fine, strict=False)]


def step_convergence(motions: Sequence[ChainMotion]) -> list[StepConvergence]:
    """Distance between the tips of a coarse and a fine run, for each n: the part of the motion that is numerics."""
    found = {(m.n, m.tolerance): np.array(m.tip) for m in motions if m.amplitude == LARGE}
    rows = []
    for n in sorted({n for n, _ in found}):
        fine, coarse = found.get((n, FINE)), found.get((n, COARSE))
        if fine is not None and coarse is not None:
            distance = _distance(fine, coarse)
            rows.append(StepConvergence(n=n, times=_reached(distance), largest=_largest(distance)))
    return rows


def _distance(first: Array, second: Array) -> Array:
    """Distance [m] of two tips at the times that both runs reach."""
    length = min(len(first), len(second))
    return np.asarray(np.linalg.norm(first[:length] - second[:length], axis=1))


def _reached(distance: Array) -> list[float]:
    return [t for t in TIMES if round(t * FRAMES) < len(distance)]


def _largest(distance: Array) -> list[float]:
    """The largest distance until each of the times that are reached."""
    return [float(distance[: round(t * FRAMES) + 1].max()) for t in _reached(distance)]


def verdict(motions: Sequence[ChainMotion]) -> list[str]:
    """Sentences: is the violent motion of the tip physics or numerics? One for each piece of evidence there is."""
    said = [*_before(motions), *_integrator(motions), *_crack(motions), *_doublings(motions), *_after(motions)]
    if len(said) >= 3:
        said.append(
            "So the violent tip is physics: the chain's own solution loses its smoothness at the free end, where the "
            "tension vanishes. Steps become smaller with n because every finer chain resolves more of the kink."
        )
    return said


def _before(motions: Sequence[ChainMotion]) -> list[str]:
    falling = _falling(motions, CRACK)
    if falling is None:
        return []
    n, distance, power = falling
    return [
        f"Until {CRACK:g} s the tip converges: the tips of {n} and {2 * n} rods differ by {distance:.1e} m, which "
        f"falls as n^-{power:.2f}, as for a smooth solution of the chain's partial differential equation."
    ]


def _integrator(motions: Sequence[ChainMotion]) -> list[str]:
    reached = [(r.n, r.largest[r.times.index(AFTER)]) for r in step_convergence(motions) if AFTER in r.times]
    if not reached:
        return []
    n, distance = max(reached, key=lambda one: one[1])
    return [
        f"The integrator is not the cause: with tolerance {COARSE:g} and series of another order in place of "
        f"{FINE:g}, the tips differ by at most {distance:.1e} m until {AFTER:g} s ({n} rods)."
    ]


def _crack(motions: Sequence[ChainMotion]) -> list[str]:
    fine = [m for m in motions if m.tolerance == FINE and m.amplitude == LARGE and m.time >= AFTER]
    if len(fine) < 3:
        return []
    first, last = fine[0], fine[-1]
    power = -order([m.n for m in fine], [m.fastest_turning for m in fine])
    return [
        f"At {last.fastest_tip_at:.3f} s the whip cracks: the angular rate of the last rod grows as n^{power:.2f} "
        f"({first.fastest_turning:.0f} rad/s with {first.n} rods, {last.fastest_turning:.0f} rad/s "
        f"with {last.n}), while the speed of the tip is {first.fastest_tip:.1f} and "
        f"{last.fastest_tip:.1f} m/s and the energy drifts by at most "
        f"{max(m.energy_drift for m in fine):.0e}. There the curve has a kink."
    ]


def _doublings(motions: Sequence[ChainMotion]) -> list[str]:
    """How much each doubling of n adds to the speed of the tip, for each amplitude."""
    told = []
    for amplitude in sorted({m.amplitude for m in motions}, reverse=True):
        fine = {m.n: m.fastest_tip for m in motions if m.amplitude == amplitude and m.tolerance == FINE}
        added = [fine[2 * n] - fine[n] for n in sorted(fine) if 2 * n in fine]
        if len(added) >= 3:
            told.append(f"{', '.join(f'{value:.2g}' for value in added)} m/s (amplitude {amplitude:g})")
    return [f"Each doubling of n adds to the largest speed of the tip: {'; '.join(told)}."] if told else []


def _after(motions: Sequence[ChainMotion]) -> list[str]:
    falling = _falling(motions, AFTER)
    if falling is None:
        return []
    n, distance, power = falling
    return [
        f"After the kink the tip still converges, but more slowly than for a smooth solution: until {AFTER:g} s the "
        f"tips of {n} and {2 * n} rods differ by {distance:.1e} m, which falls as n^-{power:.2f}."
    ]


def _falling(motions: Sequence[ChainMotion], until: float) -> tuple[int, float, float] | None:
    """The largest n whose tip was compared with that of 2n, their distance [m], and the power of 1/n over all n."""
    rows = [r for r in tip_convergence(motions) if r.amplitude == LARGE and r.n >= FEWEST and until in r.times]
    found = [(r.n, r.largest[r.times.index(until)]) for r in rows]
    if len(found) < 3:
        return None
    return *found[-1], order(*zip(*found, strict=True))
