"""The summary of a stress test: ``furiko stress --json`` prints it, the pages and the terminal show it.

It follows from the searches and the results alone, in whatever order the results came.
"""

from __future__ import annotations

from collections.abc import Sequence

from ...records.check import Result
from ...records.stress import (
    AxisFrontier,
    ConditionGrowth,
    CurvePoint,
    EnergyDrift,
    FailureCount,
    KernelCase,
    KernelErrors,
    StableStep,
    StepRun,
    StressSummary,
    TreeRun,
    TreeRunPoint,
)
from ...reference.chain import order
from .accelerations import PROMISED
from .chain_summary import chain_summary
from .condition import condition_cases
from .frontier import frontier
from .over_bound import KERNELS
from .searches import AccelerationSearch, LongRun, Results, Search, StabilitySearch, TreeRunSearch, TreeSearch, key
from .stability import STRESSES, TOP, classify, problem, step
from .trees.axes import TreeLadder
from .trees.motions import known_motions
from .trees.runs import TIMES, TreeRunCase

COORDINATES = ("absolute", "relative")
DRIFT_SAMPLES = 200  # about so many of a long run's energies are kept for its plot
FEWEST_TO_CLASSIFY = 50  # samples of the energy
BEYOND = ("NaN", "more than rounding", "wrong numbers that look right")  # of open mechanisms: no rounding explains it


def summary(searches: Sequence[Search], results: Results, *, seed: int) -> StressSummary:
    """The whole summary; ``seed`` of the random states, as the searches were made with it."""
    waiting = sum(search.next(results)[0] is not None for search in searches)
    return StressSummary(
        seed=seed,
        cases=len(results),
        open=waiting,
        frontiers=[_frontier(s, results) for s in searches if isinstance(s, AccelerationSearch | TreeSearch)],
        kernels=kernel_errors(results),
        condition=condition_growth(results, seed),
        steps=[_stable_step(s, results) for s in searches if isinstance(s, StabilitySearch)],
        long_runs=[_energy_drift(s, results) for s in searches if isinstance(s, LongRun)],
        failures=failure_counts(results),
        chain=chain_summary(searches, results),
        tree_runs=[_tree_run(s, results) for s in searches if isinstance(s, TreeRunSearch)],
    )


def _frontier(search: AccelerationSearch | TreeSearch, results: Results) -> AxisFrontier:
    ladder, found = search.ladder, search.frontier(results)
    rungs = [
        (rung, results[key(search.case(rung))]) for rung in range(search.top + 1) if key(search.case(rung)) in results
    ]
    failing = results.get(key(search.case(found.fails))) if found.fails is not None else None
    return AxisFrontier(
        axis=ladder.name,
        says=ladder.says,
        engine=search.subject,
        mechanism=ladder.base.name if isinstance(ladder, TreeLadder) else None,
        pair=search.family == "pairs",
        closed=found.closed,
        status="open" if not found.closed else "holds" if found.fails is None else "fails",
        holds=found.holds,
        fails=found.fails,
        holds_at=ladder.label(found.holds) if found.holds >= 0 else None,
        fails_at=ladder.label(found.fails) if found.fails is not None else None,
        top=search.top,
        failure=failing.details.get("failure") if failing else None,
        reason=failing.reason if failing else "",
        curve=[_point(ladder.value(rung), result) for rung, result in rungs],
    )


def _point(value: float, result: Result) -> CurvePoint:
    details = result.details
    return CurvePoint(
        value=value,
        at=details.get("at"),
        error=details.get("error"),
        worst_error=details.get("worst error"),
        digits=details.get("digits"),
        one_ulp=details.get("one ulp does"),
        condition=details.get("condition"),
        error_over_condition=details.get("error over ε·cond"),
        error_over_bound=details.get("error over bound"),
        failure=details.get("failure"),
    )


def kernel_errors(results: Results) -> KernelErrors:
    """Errors of furiko's own accelerations: where one is above the promised bound, and why."""
    rungs = [result for result in results.values() if result.engine == KERNELS and "rung" in result.details]
    own = [result for result in rungs if "one ulp does" in result.details]
    beyond = [
        result for result in rungs if result.details["failure"] in BEYOND and "one ulp does" not in result.details
    ]
    return KernelErrors(
        cases=len(own),
        promised=PROMISED,
        worst=max((r.measured for r in own if r.measured is not None), default=None),
        broken=[*(_kernel_case(r) for r in own if r.outcome != "agrees"), *map(_kernel_case, beyond)],
        exceptions=[_kernel_case(r) for r in own if r.outcome == "agrees" and r.details.get("exception")],
    )


def _kernel_case(result: Result) -> KernelCase:
    return KernelCase(
        axis=result.scene,
        at=result.details.get("at"),
        measured=result.measured,
        allowed=result.allowed,
        reason=result.reason,
    )


def condition_growth(results: Results, seed: int) -> list[ConditionGrowth]:
    """Condition of the mass matrix against n, and the power of n with which it grows."""
    found: dict[str, list[dict[str, float]]] = {}
    for case in condition_cases(seed):
        result = results.get(key(case))
        if result is not None and result.outcome != "error":
            found.setdefault(case.posture, []).append(result.details)
    return [_growth(posture, coordinates, points) for posture, points in found.items() for coordinates in COORDINATES]


def _growth(posture: str, coordinates: str, points: Sequence[dict[str, float]]) -> ConditionGrowth:
    numbers = [int(point["n"]) for point in points]
    values = [point[coordinates] for point in points]
    late = slice(min(2, max(len(numbers) - 2, 0)), None)
    power = -order(numbers[late], values[late]) if len(numbers) > 1 else None
    return ConditionGrowth(posture=posture, coordinates=coordinates, n=numbers, condition=values, power=power)


def _stable_step(search: StabilitySearch, results: Results) -> StableStep:
    answers = search.answers(results)
    found = frontier(answers, TOP)
    duration = problem(search.stress, search.value, search.seed).duration
    failing = results.get(key(search.case(found.fails))) if found.fails is not None else None
    runs = [(rung, results[key(search.case(rung))]) for rung in sorted(answers)]
    return StableStep(
        engine=search.engine,
        integrator=search.integrator,
        stress=search.stress,
        value=search.value,
        unit=STRESSES[search.stress][0],
        closed=found.closed,
        rung=found.holds,
        step=step(found.holds, duration) if found.holds >= 0 else None,
        fails_at=step(found.fails, duration) if found.fails is not None else None,
        failure=failing.details.get("failure") if failing else None,
        reason=failing.reason if failing else "",
        runs=[StepRun(rung=rung, step=step(rung, duration), failure=r.details.get("failure")) for rung, r in runs],
    )


def _tree_run(search: TreeRunSearch, results: Results) -> TreeRun:
    answers = search.answers(results)
    found = search.frontier(results)
    failing = results.get(key(search.case(found.fails))) if found.fails is not None else None
    return TreeRun(
        engine=search.engine,
        integrator=search.integrator,
        motion=search.motion,
        says=known_motions()[search.motion].says,
        step=search.step,
        closed=found.closed,
        holds_at=TIMES[found.holds] if found.holds >= 0 else None,
        fails_at=None if found.fails is None else TIMES[found.fails],
        failure=failing.details.get("failure") or "exception" if failing else None,
        reason=failing.reason if failing else "",
        runs=[_tree_run_point(search.case(rung), results) for rung in sorted(answers)],
    )


def _tree_run_point(case: TreeRunCase, results: Results) -> TreeRunPoint:
    details = results[key(case)].details
    return TreeRunPoint(
        time=case.time,
        phase_error=details.get("phase error"),
        energy_drift=details.get("energy drift"),
        length_drift=details.get("length drift"),
        failure=details.get("failure"),
    )


def _energy_drift(search: LongRun, results: Results) -> EnergyDrift:
    parts = search.parts(results)
    drift = [0.0, *(value for part in parts for value in part.details.get("drift", ()))]
    taken = sum(part.details.get("steps", 0) for part in parts)
    broken = bool(parts) and parts[-1].details.get("failure") is not None
    enough = len(drift) >= FEWEST_TO_CLASSIFY and not broken
    fit = classify(drift, taken / (len(drift) - 1)) if enough else None
    return EnergyDrift(
        engine=search.engine,
        integrator=search.integrator,
        steps=taken,
        of=search.steps,
        closed=search.next(results)[0] is None,
        kind=fit.kind if fit else None,
        failure=parts[-1].details.get("failure") if broken else None,
        drift=drift[:: max(1, len(drift) // DRIFT_SAMPLES)],
        largest=max(map(abs, drift)),
        exponent=fit.exponent if fit else None,
        rate=fit.rate if fit else None,
        spread=fit.spread if fit else None,
    )


def failure_counts(results: Results) -> list[FailureCount]:
    """Each way in which each engine failed: how often, and the first case by name."""
    found: dict[tuple[str, str], list[Result]] = {}
    for result in results.values():
        failure = result.details.get("failure")
        if failure is not None or result.outcome == "error":
            found.setdefault((result.engine, failure or "exception"), []).append(result)
    return [_failure_count(*names, failed) for names, failed in sorted(found.items(), key=lambda item: item[0])]


def _failure_count(engine: str, failure: str, failed: Sequence[Result]) -> FailureCount:
    first = min(failed, key=lambda result: (result.scene, result.check))
    return FailureCount(
        engine=engine,
        failure=failure,
        times=len(failed),
        where=f"{first.scene}: {first.check}",
        reason=first.reason,
    )
