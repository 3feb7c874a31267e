"""Measures the figures that furiko should reach: asked, got, met. Run ``python benchmarks/targets.py``.

All are ratios or errors, measured in turn in this process, or seconds of fresh processes. MuJoCo is timed as its users
see it, with the clock that its Python package reads in every step; the figure without that clock is given beside it.
"""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Iterator
from functools import partial

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # numpy reads them once, when it is imported
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("MKL_NUM_THREADS", "1")

import numpy as np
from cold_start import profile_targets, smoke_target
from numpy.typing import NDArray
from target import Target

from furiko.engines import AnyShape, cannot, engine_info, engine_version, load_engine
from furiko.models import NLegPendulum, RodChain, Scene
from furiko.models.states import random_states
from furiko.models.systems import DocumentSystem
from furiko.reference.documents.equations_of_motion import energies
from furiko.reference.integration.taylor import simulate
from furiko.reference.kernels.forward_dynamics import accelerations, kernel_of
from furiko.reference.truth.newton_euler import enclosed_accelerations
from furiko.studies.bench.methods import DOP853, TAYLOR, dop853, end_error, start, taylor
from furiko.studies.bench.scenes import BENCHMARKS
from furiko.studies.bench.timing import Subject, Times, interleaved
from furiko.studies.bench.work_precision import reach

Array = NDArray[np.float64]
BATCH = 4096
LONG_CHAIN = 1000
MUJOCO, PINOCCHIO = "mujoco", "pinocchio-aba"
TIMER_OFF = "timer off"
OVER_MUJOCO = {2: 100.0, 10: 70.0, 100: 150.0}
OVER_PINOCCHIO = {2: 100.0, 10: 100.0, 100: 80.0}
LEGS = (1, 2, 3, 8, 32, 100, 999)  # MuJoCo's largest mechanism here has a thousand links
SINGLE = (2, 3, 5, 10, 20, 50, 100)
LONG_RUN = 1e5  # s
GROWTH = (10, 100, 1000, 10_000)


def main() -> int:
    """Print every target as it is measured; returns 1 where one is not met."""
    found = []
    for target in targets():
        print(target.text(), flush=True)
        found.append(target)
    print(f"{sum(target.met is True for target in found)} of {len(found)} met")
    return int(any(target.met is False for target in found))


def targets() -> Iterator[Target]:
    """Measure every target in turn; one whose engine is missing says so."""
    yield from (rods_against_mujoco(n) for n in OVER_MUJOCO)
    yield from (rods_against_pinocchio(n) for n in OVER_PINOCCHIO)
    for measure in (
        long_chain_against_mujoco,
        legs_against_mujoco,
        one_state_against_pinocchio,
        acceleration_error,
        growth_with_n,
        double_pendulum,
        five_rods,
        hundred_rods,
        energy_drift,
        smoke_target,
    ):
        yield measure()
    yield from profile_targets()


def rods(n: int) -> RodChain:
    """Equal rods, 2 m in all."""
    return RodChain((2.0 / n,) * n)


def _faster(name: str, ratio: float, asked: float, says: str) -> Target:
    return Target(
        name=name,
        asked=f"≥ {asked:g} × faster",
        got=f"{ratio:.3g} ×",
        met=ratio >= asked,
        share=ratio / asked,
        says=says,
    )


def _own_batch(system: DocumentSystem, states: int) -> Subject:
    theta, omega = random_states("speed", system, states)
    return Subject(partial(accelerations, system, theta, omega, threads=1))


def _engine(name: str, system: DocumentSystem) -> AnyShape | str:
    """The engine, or why there is none."""
    info = engine_info(name)
    if not engine_version(name):
        return f"not measured: {info.package} is not installed"
    reason = cannot(info, system)
    return f"not measured: {reason}" if reason else load_engine(name, system)


def _missing(name: str, reason: str, asked: str = "") -> Target:
    return Target(name=name, asked=asked, got="", met=None, says=reason)


def rods_against_mujoco(n: int) -> Target:
    """A batch of rod chains on one thread, against MuJoCo's batch on one thread."""
    name = f"accelerations, {n} rods, B = {BATCH}, against MuJoCo batch.Batch.forward"
    found = _against_batch(rods(n), BATCH)
    return _missing(name, found) if isinstance(found, str) else _faster(name, found[0], OVER_MUJOCO[n], found[1])


def _against_batch(
    system: DocumentSystem, states: int, own_states: int = BATCH, rounds: int = 9
) -> tuple[float, str] | str:
    """How many times longer a state takes in MuJoCo's batch, and that in words, without its clock too."""
    engine = _engine(MUJOCO, system)
    if isinstance(engine, str):
        return engine
    batch = engine.bare_calls(*random_states("speed", system, states))["batch.Batch.forward"]
    times = interleaved(
        {
            "own": _own_batch(system, own_states),
            "batch": Subject(batch.call),
            "lighter": Subject(batch.call, engine.lighter()[TIMER_OFF]),
        },
        rounds=rounds,
    )
    own = Times(times["own"].seconds / own_states)
    with_clock, without = (Times(times[key].seconds / states) for key in ("batch", "lighter"))
    says = (
        f"{_ns(own)} against {_ns(with_clock)} a state; {TIMER_OFF}: {_ns(without)}, {without.over(own):.3g} ×; "
        f"by the fastest of each {_fastest(with_clock, own)}"
    )
    return with_clock.over(own), says


def rods_against_pinocchio(n: int) -> Target:
    """A batch of rod chains on one thread, against pin.aba called a state at a time."""
    name = f"accelerations, {n} rods, B = {BATCH}, against pin.aba a state at a time"
    system = rods(n)
    engine = _engine(PINOCCHIO, system)
    if isinstance(engine, str):
        return _missing(name, engine)
    aba = engine.bare_calls(*random_states("speed", system, 1))["aba"]
    times = interleaved({"own": _own_batch(system, BATCH), "aba": Subject(aba.call)})
    own = Times(times["own"].seconds / BATCH)
    says = f"{_ns(own)} against {_ns(times['aba'])} a state; by the fastest of each {_fastest(times['aba'], own)}"
    return _faster(name, times["aba"].over(own), OVER_PINOCCHIO[n], says)


def long_chain_against_mujoco() -> Target:
    """A thousand rods: MuJoCo factorises a dense matrix."""
    name = f"accelerations, {LONG_CHAIN} rods, against MuJoCo"
    system = rods(LONG_CHAIN)
    engine = _engine(MUJOCO, system)
    if isinstance(engine, str):
        return _missing(name, engine)
    forward = engine.bare_calls(*random_states("speed", system, 1))["mj_forward"]
    times = interleaved({"own": _own_batch(system, BATCH), "mujoco": Subject(forward.call)}, rounds=5)
    own = Times(times["own"].seconds / BATCH)
    says = f"{_ns(own)} against {_ns(times['mujoco'])} a state; by the fastest of each {_fastest(times['mujoco'], own)}"
    return _faster(name, times["mujoco"].over(own), 5000.0, says)


def legs_against_mujoco() -> Target:
    """N-leg pendulums from one leg to a thousand: the smallest ratio counts."""
    name = f"accelerations, N-leg pendulum of {LEGS[0]} to {LEGS[-1]} legs, against MuJoCo batch"
    ratios: dict[int, float] = {}
    for legs in LEGS:
        system = NLegPendulum((1.0,) * (legs + 1), (1.0,) * (legs + 1))
        few = BATCH if legs <= 100 else BATCH // 16
        found = _against_batch(system, few, rounds=5)
        if isinstance(found, str):
            return _missing(name, found)
        ratios[legs] = found[0]
    each = ", ".join(f"{legs}: {ratio:.3g}" for legs, ratio in ratios.items())
    return _faster(name, min(ratios.values()), 50.0, f"legs: times faster: {each}")


def one_state_against_pinocchio() -> Target:
    """One state, one call from Python: a prepared kernel against pin.aba with its model and data prepared."""
    name = f"accelerations, one state a call, {SINGLE[0]} to {SINGLE[-1]} rods, against pin.aba"
    ratios: dict[int, float] = {}
    general: dict[int, float] = {}
    for n in SINGLE:
        system = rods(n)
        engine = _engine(PINOCCHIO, system)
        if isinstance(engine, str):
            return _missing(name, engine)
        theta, omega = (row[0].copy() for row in random_states("speed", system, 1))
        aba = engine.bare_calls(theta[None], omega[None])["aba"]
        kernel = kernel_of(system)
        times = interleaved(
            {
                "kernel": Subject(partial(kernel, theta, omega)),
                "function": Subject(partial(accelerations, system, theta, omega)),
                "aba": Subject(aba.call),
            }
        )
        ratios[n] = times["aba"].over(times["kernel"])
        general[n] = times["aba"].over(times["function"])
    each = ", ".join(f"{n}: {ratio:.3g} ({general[n]:.3g})" for n, ratio in ratios.items())
    says = f"rods: times faster, prepared kernel (furiko.accelerations): {each}"
    worst = min(ratios.values())
    return Target(
        name=name, asked="faster at every n", got=f"{worst:.3g} × at worst", met=worst > 1, share=worst, says=says
    )


def acceleration_error() -> Target:
    """The worst norm-wise error over sizes, length ratios, mass ratios and rates, against balls."""
    generator = np.random.default_rng(3)
    worst, where, count = 0.0, "", 0
    for n in (2, 3, 5, 10, 30, 100, 300, 1000):
        for length_ratio in (1.0, 1e3):
            for rate in (0.0, 1.0, 1e3):
                for kind in ("rods", "legs"):
                    system = _uneven(kind, n, length_ratio, generator)
                    for theta in _shapes(n, generator):
                        omega = rate * generator.uniform(-1, 1, (1, n))
                        error = _normwise(system, theta[None], omega)
                        count += 1
                        if error > worst:
                            worst = error
                            where = f"{n} {kind}, length ratio {length_ratio:g}, rates to {rate:g} rad/s"
    return Target(
        name="norm-wise error of accelerations, n ≤ 1000, length ratios to 1e3, mass ratios to 1e6, rates to 1e3",
        asked="≤ 1e-14",
        got=f"{worst:.2g}",
        met=worst <= 1e-14,
        share=1e-14 / worst,
        says=f"worst of {count} states: {where}; batch kernel, against enclosures in ball arithmetic",
    )


def _uneven(kind: str, n: int, length_ratio: float, generator: np.random.Generator) -> DocumentSystem:
    """Lengths, and a star's masses (ratio 1e6), spread evenly in their logarithms; their extremes are there."""
    lengths = length_ratio ** -_spread(n, generator)
    if kind == "rods":
        return RodChain(tuple(lengths.tolist()))
    return NLegPendulum(tuple(lengths.tolist()), tuple((1e6 ** -_spread(n, generator)).tolist()))


def _spread(n: int, generator: np.random.Generator) -> Array:
    return np.asarray(generator.permutation(np.linspace(0.0, 1.0, n)))


def _shapes(n: int, generator: np.random.Generator) -> list[Array]:
    """Angles all round, and links nearly in line."""
    return [generator.uniform(-math.pi, math.pi, n), 0.7 + 1e-4 * generator.uniform(-1, 1, n)]


def _normwise(system: DocumentSystem, theta: Array, omega: Array) -> float:
    truth = enclosed_accelerations(system, theta, omega)
    found = kernel_of(system).batch(theta, omega, 1)
    return float((truth.error(found).max(-1) / np.abs(truth.high).max(-1)).max())


def growth_with_n() -> Target:
    """Time a rod in batches of as many rods in all."""
    rods_in_all = 64 * GROWTH[-1]  # as many states as fill the kernels' lanes in the longest chain
    subjects = {str(n): _own_batch(rods(n), rods_in_all // n) for n in GROWTH}
    times = interleaved(subjects)
    per_rod = {n: times[str(n)].median / rods_in_all * 1e9 for n in GROWTH}
    spread = max(per_rod.values()) / min(per_rod.values())
    return Target(
        name=f"growth of cost, {GROWTH[0]} to {GROWTH[-1]} rods",
        asked="time a rod within 1.5 ×",
        got=f"{spread:.3g} ×",
        met=spread <= 1.5,
        share=1.5 / spread,
        says="ns a rod: " + ", ".join(f"{n}: {ns:.3g}" for n, ns in per_rod.items()),
    )


def double_pendulum() -> Target:
    """furiko to 1e-8 against MuJoCo's RK4 at a step of 1e-4 s."""
    scene = BENCHMARKS["bench-rods-2"]
    name, step = "double pendulum of rods, 10 s, against MuJoCo RK4 at 1e-4 s", 1e-4
    asked = "error ≤ 1e-8 in ≤ 1/300 of its time"
    engine = _engine(MUJOCO, scene.system)
    if isinstance(engine, str):
        return _missing(name, engine, asked)
    found = own_tolerance(scene, 1e-8)
    if isinstance(found, str):
        return Target(name=name, asked=asked, got=found, met=False)
    tolerance, error = found
    run = partial(engine.trajectory, *start(scene), "RK4", step, round(scene.duration / step))
    times = interleaved(
        {
            "own": Subject(partial(taylor, scene, tolerance)),
            "mujoco": Subject(run),
            "lighter": Subject(run, engine.lighter()[TIMER_OFF]),
        },
        rounds=5,
    )
    ratio, lighter = (times[key].over(times["own"]) for key in ("mujoco", "lighter"))
    says = (
        f"{_ms(times['own'])} at tolerance {tolerance:.0e} against {_ms(times['mujoco'])}, which ends at "
        f"{end_error(scene, run()):.1e}; {TIMER_OFF}: {lighter:.4g} ×; "
        f"by the fastest of each {_fastest(times['mujoco'], times['own'])}"
    )
    return _nearer_and_faster(name, asked, error, ratio, 300.0, says)


def five_rods() -> Target:
    """furiko to 1e-11 against Pinocchio and DOP853 to the same."""
    return _against_dop853("bench-rods-5", "5 rods, 5 s", 1e-11, 80.0)


def hundred_rods() -> Target:
    """furiko to 1e-11 against Pinocchio and DOP853 to 1e-7."""
    return _against_dop853("bench-rods-100", "100 rods, 5 s", 1e-7, 15.0)


def _against_dop853(scene_name: str, says_scene: str, their_error: float, factor: float) -> Target:
    scene = BENCHMARKS[scene_name]
    name = f"{says_scene}, against Pinocchio and DOP853 to {their_error:g}"
    asked = f"error ≤ 1e-11 in ≤ 1/{factor:g} of its time"
    engine = _engine(PINOCCHIO, scene.system)
    if isinstance(engine, str):
        return _missing(name, engine, asked)
    native = engine.native()
    found = own_tolerance(scene, 1e-11)
    if isinstance(found, str):
        return Target(name=name, asked=asked, got=found, met=False)
    assert native is not None
    tolerance, error = found
    # From coarse to fine until one is near enough; timed are that one and the last that was not.
    errors: dict[float, float] = {}
    for setting in DOP853:
        errors[setting] = end_error(scene, dop853(native, scene, setting))
        if errors[setting] <= their_error:
            break
    else:
        return _missing(name, f"not measured: DOP853 comes no nearer than {min(errors.values()):.1e}", asked)
    chosen = list(errors)[-2:]
    runs = {str(setting): Subject(partial(dop853, native, scene, setting)) for setting in chosen}
    times = interleaved({"own": Subject(partial(taylor, scene, tolerance)), **runs}, rounds=5)
    theirs = reach([(times[str(setting)].median, errors[setting]) for setting in chosen], their_error)
    assert theirs is not None
    ratio = theirs[0] / times["own"].median
    says = f"{_ms(times['own'])} at tolerance {tolerance:.0e} against {theirs[0] * 1e3:.4g} ms for {their_error:g}"
    return _nearer_and_faster(name, asked, error, ratio, factor, says)


def _nearer_and_faster(name: str, asked: str, error: float, ratio: float, factor: float, says: str) -> Target:
    return Target(
        name=name,
        asked=asked,
        got=f"{error:.1e} in 1/{ratio:.4g}",
        met=ratio >= factor,  # the error was met before, or the target was not measured
        share=ratio / factor,
        says=says,
    )


def own_tolerance(scene: Scene, error: float) -> tuple[float, float] | str:
    """The loosest tolerance with which furiko ends within ``error``, and the error there; or how near it comes."""
    nearest = math.inf
    for tolerance in TAYLOR:
        found = end_error(scene, taylor(scene, tolerance))
        if found <= error:
            return tolerance, found
        nearest = min(nearest, found)
    return f"no nearer than {nearest:.1e}"


def energy_drift() -> Target:
    """The double pendulum of rods for a day and more, looked at a hundred times on its way."""
    scene = BENCHMARKS["bench-rods-2"]
    taylor(scene, 1e-16)  # compiled before the clock runs
    times = np.linspace(0.0, LONG_RUN, 101)
    begun = time.perf_counter()
    motion = simulate(scene.system, *start(scene), times)
    seconds = time.perf_counter() - begun
    total = np.sum(energies(scene.system, motion.theta, motion.omega), axis=0)
    drift = float(np.abs(total / total[0] - 1).max())
    return Target(
        name=f"energy of the double pendulum of rods over {LONG_RUN:g} s",
        asked="drift ≤ 1e-11 relative, in ≤ 20 s",
        got=f"{drift:.1e} in {seconds:.3g} s",
        met=drift <= 1e-11 and seconds <= 20,
        share=min(1e-11 / max(drift, 1e-300), 20 / seconds),
        says=f"the largest of {len(times) - 1} looks on the way; {seconds / LONG_RUN * 1e6:.3g} µs a simulated second",
    )


def _fastest(slow: Times, fast: Times) -> str:
    """The ratio of the minima: what is left when whatever else the machine does is taken away."""
    return f"{slow.minimum / fast.minimum:.4g} ×"


def _ns(times: Times) -> str:
    return f"{times.median * 1e9:.4g} ns"


def _ms(times: Times) -> str:
    return f"{times.median * 1e3:.4g} ms"


if __name__ == "__main__":
    sys.exit(main())
