"""Accelerations: time per state against error, for 1 to 100,000 states per call and 2 to 1000 links.

Every engine is timed by its most direct call, with the input in place; furiko by the calls of its users, on numpy
arrays. The errors are against enclosures in ball arithmetic, in a few random states.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ...engines import AnyShape, BareCall, cannot, engine_info, load_engine, why_missing
from ...models import NLegPendulum, RodChain
from ...models.states import random_states
from ...models.systems import DocumentSystem
from ...records.bench import Speed
from ...reference import literal_accelerations
from ...reference.kernels.forward_dynamics import accelerations, kernel_of, plain_accelerations
from ...reference.truth.newton_euler import enclosed_accelerations
from .methods import FURIKO
from .timing import Subject, Times, interleaved, once

Array = NDArray[np.float64]

SIZES = {"rod-chain": (2, 10, 100, 1000), "n-leg": (2, 9, 101, 1000)}  # links in all: 1, 8, 100, 999 legs
BATCHES = (1, 64, 4096, 100_000)
MOST_NUMBERS = 5_000_000  # of one array, 40 MB; a larger batch is left out
LONGEST_CALL = 0.1  # [s]: batches are made smaller to fit; an engine that needs three times this for one is left out
CHECKED_STATES = 4
MANY_STATES = 4096  # from here on several threads are timed too
SHORT_CALL = 1e-4  # [s]: in a longer call the time of the bindings does not show
LARGEST_LITERAL = 101  # links: beyond, the dense matrix takes as long as everything else together


@dataclass(frozen=True)
class Entrant:
    """One way to compute accelerations: a call of ``states`` states; ``answers(theta, omega)`` for states (B, n)."""

    engine: str
    call: str
    states: int
    subject: Subject
    answers: Callable[[Array, Array], Array]
    threads: int = 1


def mechanism(kind: str, n: int) -> DocumentSystem:
    """Equal rods of 2 m in all, or legs and masses of unequal size; ``n`` links."""
    if kind == "rod-chain":
        return RodChain((2.0 / n,) * n)
    spread = np.linspace(0.5, 1.0, n)
    return NLegPendulum(tuple(spread.tolist()), tuple(spread[::-1].tolist()))


def speeds(
    kind: str, n: int, engines: Sequence[str], budget: float, *, threads: int = 1, batches: Sequence[int] = BATCHES
) -> list[Speed]:
    """All entrants for one mechanism, timed in about ``budget`` [s]. Ratios are to furiko: one state to one state,
    batches to its largest batch up to 4096."""
    system = mechanism(kind, n)
    entrants = [*own(system, batches, threads), *of_engines(system, engines, max(b for b in batches if b <= 4096))]
    times = interleaved({str(i): e.subject for i, e in enumerate(entrants)}, budget=budget)
    errors = _errors(system, entrants)
    own_times = [(e, times[str(i)]) for i, e in enumerate(entrants) if e.engine == FURIKO and e.threads == 1]
    single, batch = own_times[0], max((e for e in own_times if e[0].states <= 4096), key=lambda e: e[0].states)
    found = []
    for i, entrant in enumerate(entrants):
        took = Times(times[str(i)].seconds / entrant.states)
        fair, against = single if entrant.states == 1 else batch
        found.append(
            Speed(
                system=kind,
                n=n,
                states=entrant.states,
                engine=entrant.engine,
                call=entrant.call,
                threads=entrant.threads,
                minimum=took.minimum,
                median=took.median,
                error=errors[entrant.engine, entrant.call],
                ratio=None if entrant.engine == FURIKO else took.over(Times(against.seconds / fair.states)),
            )
        )
    return found


def own(system: DocumentSystem, batches: Sequence[int] = BATCHES, threads: int = 1) -> Iterator[Entrant]:
    """furiko's kernels in every batch, the same formulas in numpy, and the documents' formula as printed."""
    kernel = kernel_of(system)
    theta, omega = random_states("speed", system, 1)
    state = theta[0].copy(), omega[0].copy()
    yield Entrant(FURIKO, "prepared kernel", 1, Subject(partial(kernel, *state)), partial(_each, kernel))
    function = partial(accelerations, system)
    yield Entrant(FURIKO, "accelerations", 1, Subject(partial(function, *state)), partial(_each, function))
    for states in batches:
        if states == 1 or states * system.n > MOST_NUMBERS:
            continue
        theta, omega = random_states("speed", system, states)
        for several in dict.fromkeys((1, threads if states >= MANY_STATES else 1)):
            call = Subject(partial(accelerations, system, theta, omega, threads=several))
            yield Entrant(FURIKO, "accelerations", states, call, function, several)
    theta, omega = random_states("speed", system, 256)
    plain = partial(plain_accelerations, system)
    yield Entrant("numpy", "same formulas, plain", 256, Subject(partial(plain, theta, omega)), plain)
    if system.n <= LARGEST_LITERAL:
        literal = partial(literal_accelerations, system)
        yield Entrant("numpy", "literal", 1, Subject(partial(literal, theta[:1], omega[:1])), literal)


def of_engines(system: DocumentSystem, engines: Sequence[str], batch: int) -> Iterator[Entrant]:
    """The most direct calls of the installed engines that take the system, each in all its lighter contexts."""
    for name in engines:
        info = engine_info(name)
        if why_missing(name) or cannot(info, system):
            continue
        engine = load_engine(name, system)
        for says, bare in _direct_calls(engine, system, batch):
            once(Subject(bare.call))
            seconds = once(Subject(bare.call)) / bare.states
            if seconds * bare.states > 3 * LONGEST_CALL:
                continue
            yield Entrant(name, says, bare.states, Subject(bare.call), engine.accelerations)
            for suffix, around in engine.lighter().items() if seconds < SHORT_CALL else ():
                lighter = Subject(bare.call, around)
                yield Entrant(name, f"{says}, {suffix}", bare.states, lighter, engine.accelerations)


def _direct_calls(engine: AnyShape, system: DocumentSystem, batch: int) -> Iterator[tuple[str, BareCall]]:
    """Names and calls; batches are as large as :data:`LONGEST_CALL` allows."""
    theta, omega = random_states("speed", system, 2)
    calls, native = engine.bare_calls(theta, omega), engine.native()
    for says, bare in calls.items():
        if bare.states == 1:
            yield says, bare
            continue
        once(Subject(bare.call))
        seconds = once(Subject(bare.call)) / bare.states
        states = int(max(2, min(batch, LONGEST_CALL / seconds, MOST_NUMBERS / system.n)))
        yield says, engine.bare_calls(*random_states("speed", system, states))[says]
    if not calls and native is not None:
        q, v = native.from_absolute(theta)[0], native.from_absolute(omega)[0]
        yield "its calls in a row", BareCall(1, partial(native.accelerate, q, v))
    elif not calls:
        yield "through furiko's adapter", BareCall(1, partial(engine.accelerations, theta[:1], omega[:1]))


def _each(kernel: Callable[[Array, Array], Array], theta: Array, omega: Array) -> Array:
    return np.array([kernel(t, w) for t, w in zip(theta.copy(), omega.copy(), strict=True)])


def _errors(system: DocumentSystem, entrants: Sequence[Entrant]) -> dict[tuple[str, str], float]:
    """Norm-wise errors: a state's largest error over its largest acceleration, the worst of a few states."""
    theta, omega = random_states("speed", system, CHECKED_STATES)
    truth = enclosed_accelerations(system, theta, omega)
    size = np.abs(truth.high).max(-1)
    found: dict[tuple[str, str], float] = {}
    for entrant in entrants:
        key = entrant.engine, entrant.call
        if key not in found:
            found[key] = float((truth.error(entrant.answers(theta, omega)).max(-1) / size).max())
    return found
