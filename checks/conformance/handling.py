"""How an adapter handles questions and answers, whatever the numbers mean."""

from __future__ import annotations

import inspect
from typing import Any, get_args

import numpy as np

from ...engines import Quantity
from ...records.listings import ConformanceStep
from .subject import MECHANISMS, Array, Subject, Wrong, apart, array, right, states

ARGUMENTS = {
    "fields": (),
    "accelerations": ("theta", "omega"),
    "inverse_dynamics": ("theta", "omega", "alpha", "gravity"),
    "joint_forces": ("theta", "omega", "alpha"),
    "energy": ("theta", "omega"),
    "trajectory": ("theta", "omega", "integrator", "step", "steps"),
}
SAME = 1e-12  # relative: a batch may be computed in another order, with a few roundings' difference


def declared(subject: Subject) -> ConformanceStep:
    """The class has what its ``info`` promises, and says what is missing."""
    info = subject.info
    if not hasattr(subject.adapter, "accelerations"):
        raise Wrong("the class has no method accelerations(theta, omega)", "It is the one that cannot be left out.")
    unknown = [name for name in info.missing if name not in get_args(Quantity)]
    if unknown:
        raise Wrong(
            f"info.missing names {', '.join(map(repr, unknown))}, which nobody asks for",
            f"The questions are {', '.join(get_args(Quantity))}.",
        )
    for name in get_args(Quantity):
        _offered(subject, name)
    if subject.has("trajectory") and not (info.integrators or info.adaptive):
        raise Wrong("there is a trajectory, and info.integrators is empty", 'integrators=(Integrator("Euler", 1),)')
    if not (0 < info.accuracy < 1e-2):
        raise Wrong(f"info.accuracy is {info.accuracy!r}", "2.0**-52 for double precision, 2.0**-23 for single.")
    offered = [name for name in get_args(Quantity) if subject.has(name)]
    return right("class", f"it offers {', '.join(offered)}" + "".join(f"; no {name}" for name in info.missing))


def _offered(subject: Subject, name: str) -> None:
    method = getattr(subject.adapter, name, None)
    if method is None or name in subject.info.missing:
        return
    try:
        taken = inspect.signature(method).parameters
    except (TypeError, ValueError):
        return  # compiled code may not tell
    anything = any(parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD) for parameter in taken.values())
    lacking = [argument for argument in ARGUMENTS[name] if argument not in taken]
    if len(taken) < 1 + len(ARGUMENTS[name]) and not anything:
        raise Wrong(
            f"{name} takes {', '.join(list(taken)[1:]) or 'nothing'}; {', '.join(lacking)} is missing",
            f"def {name}(self, {', '.join(ARGUMENTS[name])})"
            + (", gravity after a *" if name.startswith("inv") else ""),
        )


def builds(subject: Subject) -> ConformanceStep:
    """It can be made for small mechanisms of each kind."""
    if not subject.mechanisms:
        raise Wrong(
            "info says that it can take none of " + ", ".join(MECHANISMS), "largest_n, least_mass, least_inertia"
        )
    for name, system in subject.mechanisms.items():
        try:
            subject.adapter(system)
        except Exception as error:
            raise Wrong(
                f"it cannot be made for {name}: {type(error).__name__}: {' '.join(str(error).split())[:300]}",
                "system.tree() has the links, with parent, hinge, com, mass and inertia, parents before children; "
                "to_mjcf(system) and to_urdf(system) of furiko.models write them as a model file.",
            ) from error
    return right("building", f"made for {', '.join(subject.mechanisms)}")


def shapes(subject: Subject) -> ConformanceStep:
    """Batches of any length, and an answer of the right shape, type and finite."""
    for name, engine in subject.engines.items():
        n = MECHANISMS[name].n
        for count in (5, 1, 0):
            _ask(engine, *states(n, count))
    return right("shapes", "batches of 5, 1 and 0 states are answered with as many rows of float64")


def arguments(subject: Subject) -> ConformanceStep:
    """What it is given is left as it is, and not handed back."""
    for name, engine in subject.engines.items():
        given = states(MECHANISMS[name].n)
        before = [values.copy() for values in given]
        answer = np.asarray(engine.accelerations(*given))
        for argument, values, copy in zip(("theta", "omega"), given, before, strict=True):
            if not np.array_equal(values, copy):
                raise Wrong(f"accelerations writes into {argument}", f"Copy it first: {argument} = {argument}.copy().")
            if np.shares_memory(answer, values):
                raise Wrong(f"accelerations returns {argument}'s own memory", "Return a new array.")
    return right("arguments", "they are left as they are")


def buffers(subject: Subject) -> ConformanceStep:
    """An answer stays what it was when the next question is asked."""
    for name, engine in subject.engines.items():
        n = MECHANISMS[name].n
        first = np.asarray(engine.accelerations(*states(n, seed=3)))
        kept = first.copy()
        second = np.asarray(engine.accelerations(*states(n, seed=4)))
        if np.shares_memory(first, second) or not np.array_equal(first, kept):
            raise Wrong(
                "an answer changes when the next question is asked: it is one buffer, returned again and again",
                "Return a new array each time: np.array(...), or .copy() of the engine's data.",
            )
        if n and len(kept) > 1 and (kept == kept[-1]).all():
            raise Wrong(
                "every row of the answer is that of the last state: one buffer stands in all rows",
                "found[row] = self.data.qacc copies; found.append(self.data.qacc) does not.",
            )
    return right("buffers", "each answer has memory of its own")


def memory(subject: Subject) -> ConformanceStep:
    """The answer depends on the question alone."""
    for name, engine in subject.engines.items():
        system = MECHANISMS[name]
        here, there = states(system.n, seed=3), states(system.n, seed=4)
        first = _ask(engine, *here)
        again = _ask(engine, *here)
        _ask(engine, *there)
        later = _ask(engine, *here)
        fresh = _ask(subject.adapter(system), *here)
        for other, when in ((again, "at once"), (later, "after another question")):
            if not _alike(first, other):
                raise Wrong(
                    f"the same question, asked again {when}, gets another answer (by {apart(other, first):.3g} of it)",
                    "Something is kept from call to call: reset the engine's data, warm starts and time before each.",
                )
        subject.adapter(next(other for other in MECHANISMS.values() if other != system))
        if not _alike(first, fresh) or not _alike(first, _ask(engine, *here)):
            raise Wrong(
                "an engine answers otherwise once another one has been made",
                "The model, or what it is computed from, is kept in the class or the module: keep it in self.",
            )
    return right("memory", "the same question gets the same answer: at once, later, and by a fresh engine")


def batches(subject: Subject) -> ConformanceStep:
    """Row b of the answer is that of row b alone, in any order."""
    for name, engine in subject.engines.items():
        theta, omega = states(MECHANISMS[name].n)
        together = _ask(engine, theta, omega)
        alone = np.concatenate([_ask(engine, theta[[b]], omega[[b]]) for b in range(len(theta))])
        if not _alike(together, alone):
            raise Wrong(_mixed_rows(together, alone), "Row b of the answer belongs to row b of theta and omega.")
        backwards = _ask(engine, theta[::-1].copy(), omega[::-1].copy())[::-1]
        if not _alike(together, backwards):
            raise Wrong("the answer to a state depends on the states before it in the batch", "Reset between rows.")
    return right("batches", "each row is answered as if it were alone")


def _mixed_rows(together: Array, alone: Array) -> str:
    if _alike(together[1:], alone[:-1]):
        return "each row of a batch has the answer to the row before: it is read before it is computed"
    if _alike(together, alone[::-1]):
        return "the rows of a batch come back in the reverse order"
    return f"a state alone and in a batch gets another answer (by {apart(alone, together):.3g} of it)"


def _ask(engine: Any, theta: Array, omega: Array) -> Array:
    return array("accelerations", engine.accelerations(theta, omega), theta.shape).copy()


def _alike(one: Array, other: Array) -> bool:
    return apart(other, one) <= SAME
