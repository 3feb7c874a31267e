"""What an adapter's runs are: their length, their coordinates, their order."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np

from ...engines import Integrator
from ...models.systems import DocumentSystem
from ...records.listings import ConformanceStep
from ...reference import literal_accelerations
from ...reference.integration.schemes import classical_step
from .subject import MECHANISMS, Array, Subject, Wrong, array, right, states

STEP = 2.0**-9  # [s]
STEPS = 64
FINE = 6  # steps of the textbook run for each of the engine's: its error is a thousandth of the same scheme's
BEGINNING = 0.05  # of a run: how far off its end may be; schemes of first order are off by less
ORDERS = 0.35  # by how much the measured order may miss the declared one
FLOOR = 1e-11  # below this error rounding, or the scheme's tolerance, hides the order
LONG_WAY = 40.0  # [rad/s], so that an angle passes π in a run


def trajectories(subject: Subject) -> ConformanceStep:
    """Each integrator makes as many steps as asked, from the state given, in absolute angles."""
    said: list[str] = []
    for name, engine in subject.engines.items():
        for integrator in subject.info.integrators:
            _run(engine, MECHANISMS[name], integrator, name)
            _turns(engine, MECHANISMS[name], integrator, name)
    name, engine = next(iter(subject.engines.items()))
    notes = [
        note for integrator in subject.info.integrators if (note := _order(engine, MECHANISMS[name], integrator, said))
    ]
    if notes:
        raise Wrong("; ".join(notes), "Integrator(name, order): the order in which the error falls with the step.")
    return right("trajectories", f"steps, coordinates and starts are right; orders: {', '.join(said)}")


def _run(engine: Any, system: DocumentSystem, integrator: Integrator, name: str) -> None:
    theta, omega = (values[0] for values in states(system.n))
    got = _end(engine, theta, omega, integrator, STEP, STEPS)
    wanted = _textbook(system, theta, omega, STEP * STEPS)
    passed = float(np.abs(wanted - np.stack([theta, omega])).max())
    who = f"{integrator.name} on {name}"
    if float(np.abs(got - wanted).max()) > BEGINNING * passed:
        raise _another_run(system, got, theta, omega, who)
    if not np.array_equal(got, _end(engine, theta, omega, integrator, STEP, STEPS)):
        raise Wrong(
            f"{who}: the same run, made again, ends elsewhere",
            "Every call starts anew: reset time, warm starts and stored accelerations.",
        )


def _another_run(system: DocumentSystem, got: Array, theta: Array, omega: Array, who: str) -> Wrong:
    """What kind of run it is that ends here."""
    start = np.stack([theta, omega])
    lengths = {
        "it ends where it began: no step is made": 0.0,
        "it makes one step alone": STEP,
        "step is taken for the whole duration": STEP,
        "it makes half the steps": STEP * STEPS / 2,
        "it makes twice the steps": STEP * STEPS * 2,
    }
    ends = {says: _textbook(system, theta, omega, length) if length else start for says, length in lengths.items()}
    ends["angles and rates are exchanged"] = _textbook(system, theta, omega, STEP * STEPS)[::-1]
    ends["it runs backwards"] = _textbook(system, theta, -omega, STEP * STEPS) * [[1.0], [-1.0]]
    parents = system.tree().parents
    wanted = _textbook(system, theta, omega, STEP * STEPS)
    own = [i for i, parent in enumerate(parents) if parent >= 0]
    relative = wanted.copy()
    relative[:, own] -= wanted[:, [parents[i] for i in own]]
    ends["the end is in relative angles"] = relative
    off = {says: float(np.abs(got - end).max()) for says, end in ends.items()}
    best = min(off, key=lambda says: off[says])
    moved = float(np.abs(wanted - start).max())
    if off[best] < BEGINNING * moved / 2:
        return Wrong(f"{who}: {best}", "It is asked for as many steps as the last argument says.")
    return Wrong(
        f"{who}: after {STEPS} steps of {STEP:.4g} s it is off by {float(np.abs(got - wanted).max()) / moved:.3g} of "
        "the way, and no usual mistake of an adapter explains it",
        "Are rates set, gravity on, and steps not made inside other steps?",
    )


def _turns(engine: Any, system: DocumentSystem, integrator: Integrator, name: str) -> None:
    """Angles go on counting beyond a turn."""
    theta, omega = np.zeros(system.n), np.full(system.n, LONG_WAY)
    got = _end(engine, theta, omega, integrator, STEP, STEPS)[0]
    wanted = _textbook(system, theta, omega, STEP * STEPS)[0]
    turns = (wanted - got) / (2 * math.pi)
    if np.abs(turns).max() > 0.5 and np.abs(turns - np.round(turns)).max() < BEGINNING:
        raise Wrong(f"{integrator.name} on {name}: angles are wrapped into one turn", "Do not wrap them.")


def _order(engine: Any, system: DocumentSystem, integrator: Integrator, said: list[str]) -> str:
    theta, omega = (values[0] for values in states(system.n))
    duration = STEP * STEPS
    wanted = _textbook(system, theta, omega, duration)
    errors = []
    for steps in (STEPS // 4, STEPS // 2, STEPS):
        got = _end(engine, theta, omega, integrator, duration / steps, steps)
        errors.append(float(np.abs(got - wanted).max()))
    if errors[-1] < FLOOR:
        said.append(f"{integrator.name} too exact to tell")
        return ""
    orders = [math.log2(errors[k] / errors[k + 1]) for k in range(2)]
    said.append(f"{integrator.name} {orders[-1]:.2f}")
    declared = integrator.order
    if min(abs(order - declared) for order in orders) <= ORDERS or (orders[0] < declared < orders[1]):
        return ""
    return f"{integrator.name} is declared of order {declared}, and its error falls with order {orders[-1]:.2f}"


def paths(subject: Subject) -> ConformanceStep:
    """A path begins at the start, ends where the run ends, and has a point for each step."""
    for name, engine in subject.engines.items():
        n = MECHANISMS[name].n
        theta, omega = (values[0] for values in states(n))
        for integrator in subject.info.integrators:
            who = f"path of {integrator.name} on {name}"
            found = engine.path(theta.copy(), omega.copy(), integrator.name, STEP, 8)
            both = np.stack([array(who, values, (9, n)) for values in found])
            if not np.allclose(both[:, 0], [theta, omega], rtol=1e-12, atol=1e-12):
                raise Wrong(f"{who}: its first point is not the start", "The first row is the state given.")
            if not np.allclose(both[:, -1], _end(engine, theta, omega, integrator, STEP, 8), rtol=1e-9, atol=1e-9):
                raise Wrong(f"{who}: its last point is not where trajectory ends", "Both are the same run.")
    return right("paths", "they begin at the start and end where the run ends")


def _end(engine: Any, theta: Array, omega: Array, integrator: Integrator, step: float, steps: int) -> Array:
    found = engine.trajectory(theta.copy(), omega.copy(), integrator.name, step, steps)
    if not isinstance(found, tuple) or len(found) != 2:
        raise Wrong(f"{integrator.name}: trajectory returns {type(found).__name__}, a pair (theta, omega) is due")
    return np.stack([array(integrator.name, values, theta.shape) for values in found])


def _textbook(system: DocumentSystem, theta: Array, omega: Array, duration: float) -> Array:
    """The classical Runge-Kutta scheme in steps so fine that its error is no one's concern here."""
    return _computed(system, tuple(theta.tolist()), tuple(omega.tolist()), duration).copy()


@cache
def _computed(system: DocumentSystem, theta: tuple[float, ...], omega: tuple[float, ...], duration: float) -> Array:
    def slope(_: float, y: Array) -> Array:
        return np.stack([y[1], literal_accelerations(system, y[None, 0], y[None, 1])[0]])

    count = max(1, round(duration / STEP * FINE))
    h, y = duration / count, np.array([theta, omega])
    for _ in range(count):
        y = classical_step(slope, y, h)
    return y
