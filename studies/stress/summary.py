"""What a stress test's results say, as plain data: what ``furiko stress --json`` prints, and what its pages show.

Everything here follows from the searches and the results alone, in whatever order those came.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from ...records.check import Result
from ...reference.chain import order
from .accelerations import KERNELS, PROMISED
from .chain import COARSE, FINE, FRAMES, ChainRun, MemoryCase, StepCase, SwingsCase, listed_cases
from .condition import condition_cases
from .searches import AccelerationSearch, LongRun, Results, Search, StabilitySearch, key
from .stability import STRESSES, TOP, classify, problem, step

Data = dict[str, Any]


def summary(searches: Sequence[Search], results: Results, *, seed: int) -> Data:
    """All of it."""
    waiting = sum(search.next(results)[0] is not None for search in searches)
    return {
        "seed": seed,
        "cases": len(results),
        "open": waiting,
        "frontiers": [_frontier(s, results) for s in searches if isinstance(s, AccelerationSearch)],
        "kernels": kernels(results),
        "condition": condition(results, seed),
        "steps": [_steps(s, results) for s in searches if isinstance(s, StabilitySearch)],
        "long runs": [_long(s, results) for s in searches if isinstance(s, LongRun)],
        "failures": failures(results),
        "chain": chain(searches, results),
    }


def _frontier(search: AccelerationSearch, results: Results) -> Data:
    ladder, found = search.ladder, search.frontier(results)
    rungs = [
        (rung, results[key(search.case(rung))]) for rung in range(search.top + 1) if key(search.case(rung)) in results
    ]
    failing = results.get(key(search.case(found.fails))) if found.fails is not None else None
    return {
        "axis": ladder.name,
        "says": ladder.says,
        "engine": search.subject,
        "pair": search.family == "pairs",
        "closed": found.closed,
        "status": "open" if not found.closed else "holds" if found.fails is None else "fails",
        "holds": found.holds,
        "fails": found.fails,
        "holds at": ladder.label(found.holds) if found.holds >= 0 else None,
        "fails at": ladder.label(found.fails) if found.fails is not None else None,
        "top": search.top,
        "failure": failing.details.get("failure") if failing else None,
        "reason": failing.reason if failing else "",
        "curve": [_point(ladder.value(rung), result) for rung, result in rungs],
    }


def _point(value: float, result: Result) -> Data:
    names = ("at", "error", "worst error", "digits", "one ulp does", "condition", "error over ε·cond", "failure")
    return {"value": value, **{name: result.details.get(name) for name in names}}


def kernels(results: Results) -> Data:
    """How furiko's own accelerations did: where one is off by more than was promised, and why."""
    own = [result for result in results.values() if result.engine == KERNELS and "rung" in result.details]
    beyond = [result for result in own if result.details.get("exception") or result.outcome != "agrees"]
    return {
        "cases": len(own),
        "promised": PROMISED,
        "worst": max((r.measured for r in own if r.measured is not None), default=None),
        "broken": [_told(result) for result in own if result.outcome != "agrees"],
        "exceptions": [_told(result) for result in beyond if result.outcome == "agrees"],
    }


def _told(result: Result) -> Data:
    return {
        "axis": result.scene,
        "at": result.details.get("at"),
        "measured": result.measured,
        "allowed": result.allowed,
        "reason": result.reason,
    }


def condition(results: Results, seed: int) -> list[Data]:
    """Condition of the mass matrix against n, and the power of n with which it grows."""
    found: dict[str, list[Data]] = {}
    for case in condition_cases(seed):
        result = results.get(key(case))
        if result is not None and result.outcome != "error":
            found.setdefault(case.posture, []).append(result.details)
    rows = []
    for posture, points in found.items():
        numbers = [point["n"] for point in points]
        for coordinates in ("absolute", "relative"):
            values = [point[coordinates] for point in points]
            late = slice(min(2, max(len(numbers) - 2, 0)), None)
            power = -order(numbers[late], values[late]) if len(numbers) > 1 else None
            rows.append(
                {"posture": posture, "coordinates": coordinates, "n": numbers, "condition": values, "power": power}
            )
    return rows


def _steps(search: StabilitySearch, results: Results) -> Data:
    from .frontier import frontier

    answers = search.answers(results)
    found = frontier(answers, TOP)
    duration = problem(search.stress, search.value, search.seed).duration
    failing = results.get(key(search.case(found.fails))) if found.fails is not None else None
    looked_at = [(rung, results[key(search.case(rung))]) for rung in sorted(answers)]
    return {
        "engine": search.engine,
        "integrator": search.integrator,
        "stress": search.stress,
        "value": search.value,
        "unit": STRESSES[search.stress][0],
        "closed": found.closed,
        "rung": found.holds,
        "step": step(found.holds, duration) if found.holds >= 0 else None,
        "fails at": step(found.fails, duration) if found.fails is not None else None,
        "failure": failing.details.get("failure") if failing else None,
        "reason": failing.reason if failing else "",
        "cells": [
            {"rung": rung, "step": step(rung, duration), "failure": r.details.get("failure")} for rung, r in looked_at
        ],
    }


def _long(search: LongRun, results: Results) -> Data:
    parts = search.parts(results)
    drift = [0.0, *(value for part in parts for value in part.details.get("drift", ()))]
    taken = sum(part.details.get("steps", 0) for part in parts)
    broken = bool(parts) and parts[-1].details.get("failure") is not None
    found: Data = {
        "engine": search.engine,
        "integrator": search.integrator,
        "steps": taken,
        "of": search.steps,
        "closed": search.next(results)[0] is None,
        "kind": None,
        "failure": parts[-1].details.get("failure") if broken else None,
        "drift": drift[:: max(1, len(drift) // 200)],
        "largest": max(map(abs, drift)),
    }
    if len(drift) >= 50 and not broken:
        fit = classify(drift, taken / (len(drift) - 1))
        found |= {"kind": fit.kind, "exponent": fit.exponent, "rate": fit.rate, "spread": fit.spread}
    return found


def failures(results: Results) -> list[Data]:
    """Each way in which each engine failed: how often, and the first instance by name."""
    named = [(r.engine, r.details.get("failure") or "exception", r) for r in results.values() if _failed(r)]
    counts = Counter((engine, failure) for engine, failure, _ in named)
    examples = {
        (engine, failure): min(
            (r for e, f, r in named if (e, f) == (engine, failure)), key=lambda r: (r.scene, r.check)
        )
        for engine, failure in counts
    }
    return [
        {
            "engine": engine,
            "failure": failure,
            "times": times,
            "where": f"{examples[engine, failure].scene}: {examples[engine, failure].check}",
            "reason": examples[engine, failure].reason,
        }
        for (engine, failure), times in sorted(counts.items())
    ]


def _failed(result: Result) -> bool:
    return result.details.get("failure") is not None or result.outcome == "error"


def chain(searches: Sequence[Search], results: Results) -> Data:
    """The chain's page."""
    runs = [search for search in searches if isinstance(search, ChainRun)]
    moved = [data for run in runs if (data := _motion(run, results))]
    listed = [(case, results[key(case)]) for case in listed_cases() if key(case) in results]
    return {
        "swings": [data for links in ("rods", "point masses") if (data := _swings(links, listed))],
        "usable step": [
            {"n": case.n, "step": result.measured} for case, result in listed if isinstance(case, StepCase)
        ],
        "memory": [{"n": case.n, "bytes": result.measured} for case, result in listed if isinstance(case, MemoryCase)],
        "motions": moved,
        "convergence": convergence(moved),
        "in step": in_step(moved),
        "verdict": verdict(moved),
    }


def _swings(links: str, listed: Sequence[tuple[Any, Result]]) -> Data | None:
    found = [result.details for case, result in listed if isinstance(case, SwingsCase) and case.links == links]
    if len(found) < 2:
        return None
    numbers = [point["n"] for point in found]
    count = min(len(point["errors"]) for point in found)
    power = 2 if links == "rods" else 1
    late = [i for i, n in enumerate(numbers) if n >= 100] or list(range(len(numbers)))
    rows = []
    for k in range(count):
        errors = [point["errors"][k] for point in found]
        some = len(late) > 1
        rows.append(
            {
                "k": k + 1,
                "errors": errors,
                "order": order([numbers[i] for i in late], [errors[i] for i in late]) if some else None,
                "coefficient": errors[-1] * numbers[-1] ** power,
            }
        )
    return {"links": links, "n": numbers, "power": power, "rows": rows}


def _motion(run: ChainRun, results: Results) -> Data | None:
    pieces = run.pieces(results)
    if not pieces:
        return None
    tip = np.concatenate([np.array(piece.details["tip"])[bool(i) :] for i, piece in enumerate(pieces)])
    speed = np.concatenate([np.array(piece.details["speed"])[bool(i) :] for i, piece in enumerate(pieces)])
    first = pieces[0].details["energy"][0]
    drift = max(max(abs(e - first) for e in piece.details["energy"][1:]) for piece in pieces) / first
    time = (len(tip) - 1) / FRAMES
    peak, peak_at = max(tuple(piece.details["peak"]) for piece in pieces)
    steps = sum(piece.details["steps"] for piece in pieces)
    curves = {t: c for piece in pieces for t, c in piece.details["curves"].items()}
    return {
        "n": run.n,
        "amplitude": run.amplitude,
        "tolerance": run.tolerance,
        "closed": run.next(results)[0] is None,
        "time": time,
        "tip": tip.tolist(),
        "speed": speed.tolist(),
        "fastest tip": peak,
        "fastest tip at": peak_at,
        "fastest turning": max(piece.details["fastest"] for piece in pieces),
        "energy drift": float(drift),
        "steps": steps,
        "mean step": time / steps,
        "seconds": sum(piece.details["computing"] for piece in pieces),
        "curves": curves,
    }


CRACK = 0.4  # [s] until when the motion is smooth; the whip cracks a little later


def verdict(moved: Sequence[Data]) -> list[str]:
    """Whether the far end's violence is physics or numerics: a sentence for each piece of evidence there is."""
    fine = [m for m in moved if m["tolerance"] == FINE and m["amplitude"] == 1.0 and m["time"] >= 1.0]
    said = []
    before = _falling(moved, CRACK)
    if before:
        n, apart, power = before
        said.append(
            f"Until {CRACK:g} s the tip converges: {n} and {2 * n} rods are {apart:.1e} m apart, and that falls as "
            f"n^-{power:.2f}, as for a smooth solution of the chain's partial differential equation."
        )
    steps = [(r["n"], r["apart"][r["times"].index(1.0)]) for r in in_step(moved) if 1.0 in r["times"]]
    if steps:
        n, apart = max(steps, key=lambda one: one[1])
        said.append(
            f"It is not the integrator's doing: with tolerance {COARSE:g} and series of another order in place of "
            f"{FINE:g}, no tip is elsewhere by more than {apart:.1e} m until 1 s ({n} rods)."
        )
    if len(fine) >= 3:
        numbers = [m["n"] for m in fine]
        turning = -order(numbers, [m["fastest turning"] for m in fine])
        last = fine[-1]
        said.append(
            f"At {last['fastest tip at']:.3f} s the whip cracks: the last rod's rate grows as n^{turning:.2f} "
            f"({fine[0]['fastest turning']:.0f} rad/s with {numbers[0]} rods, {last['fastest turning']:.0f} rad/s "
            f"with {numbers[-1]}), while the tip's speed is {fine[0]['fastest tip']:.1f} and "
            f"{last['fastest tip']:.1f} m/s and energy is kept to {max(m['energy drift'] for m in fine):.0e}. There "
            "the curve has a kink."
        )
    said += _doublings(moved)
    after = _falling(moved, 1.0)
    if after:
        n, apart, power = after
        said.append(
            f"Past the kink the tip still converges, if not as that of a smooth solution: until 1 s {n} and {2 * n} "
            f"rods differ by {apart:.1e} m, and that falls as n^-{power:.2f}."
        )
    if len(said) >= 3:
        said.append(
            "So the violent tip is physics: the chain's own solution loses its smoothness at the free end, where the "
            "tension vanishes. What asks for ever smaller steps is that every finer chain resolves more of the kink."
        )
    return said


def _doublings(moved: Sequence[Data]) -> list[str]:
    """What each doubling of n adds to the speed of the tip, in either amplitude."""
    told = []
    for amplitude in sorted({m["amplitude"] for m in moved}, reverse=True):
        fine = {m["n"]: m["fastest tip"] for m in moved if m["amplitude"] == amplitude and m["tolerance"] == FINE}
        added = [fine[2 * n] - fine[n] for n in sorted(fine) if 2 * n in fine]
        if len(added) >= 3:
            told.append(f"{', '.join(f'{value:.2g}' for value in added)} m/s (amplitude {amplitude:g})")
    return [f"What each doubling of n adds to the tip's greatest speed: {'; '.join(told)}."] if told else []


def _falling(moved: Sequence[Data], until: float) -> tuple[int, float, float] | None:
    """The largest n whose tip was compared with that of 2n, how far they are apart, and the power of 1/n over all n."""
    rows = [r for r in convergence(moved) if r["amplitude"] == 1.0 and r["n"] >= 20 and until in r["times"]]
    found = [(r["n"], r["apart"][r["times"].index(until)]) for r in rows]
    if len(found) < 3:
        return None
    return *found[-1], order(*zip(*found, strict=True))


TIMES = (0.25, 0.4, 0.45, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0)


def convergence(moved: Sequence[Data]) -> list[Data]:
    """How far the tips of n and of twice as many rods are apart, up to some times; and the order in n that this is."""
    fine = {(m["amplitude"], m["n"]): np.array(m["tip"]) for m in moved if m["tolerance"] == FINE}
    rows = []
    for (amplitude, n), tip in fine.items():
        twice = fine.get((amplitude, 2 * n))
        if twice is None:
            continue
        length = min(len(tip), len(twice))
        apart = np.linalg.norm(tip[:length] - twice[:length], axis=1)
        until = [t for t in TIMES if round(t * FRAMES) < length]
        rows.append(
            {
                "amplitude": amplitude,
                "n": n,
                "times": until,
                "apart": [float(apart[: round(t * FRAMES) + 1].max()) for t in until],
                "series": apart.tolist(),
            }
        )
    for row in rows:
        finer = next((r for r in rows if r["amplitude"] == row["amplitude"] and r["n"] == 2 * row["n"]), None)
        pairs = zip(row["apart"], finer["apart"], strict=False) if finer else ()
        row["order"] = [float(np.log2(a / b)) if b else None for a, b in pairs]
    return rows


def in_step(moved: Sequence[Data]) -> list[Data]:
    """How far a coarse run's tip is from a fine one's, for each n: what of the motion is the integrator's doing."""
    found = {(m["n"], m["tolerance"]): np.array(m["tip"]) for m in moved if m["amplitude"] == 1.0}
    rows = []
    for n in sorted({n for n, _ in found}):
        fine, coarse = found.get((n, FINE)), found.get((n, COARSE))
        if fine is None or coarse is None:
            continue
        length = min(len(fine), len(coarse))
        apart = np.linalg.norm(fine[:length] - coarse[:length], axis=1)
        until = [t for t in TIMES if round(t * FRAMES) < length]
        rows.append({"n": n, "times": until, "apart": [float(apart[: round(t * FRAMES) + 1].max()) for t in until]})
    return rows
