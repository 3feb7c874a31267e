"""Why an engine's motion is not the theory's: hypotheses, each tested against what the engine itself gives.

In this order: other conventions of the same engine (relative angles, degrees, another order of coordinates), answers to
another state, what the engine says it compiled, what acts in some states only (limits, contacts), single precision that
shows in the numbers, then the mechanism's numbers and the terms of the engine's code: each alone, all of one kind, two
at once, a convention and one of them, a few at once. A cause is named only where it leaves nothing that rounding does
not explain, in the states in which it was found and in others; where several do, all are named; where none does, the
finding is ``unexplained``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..models.coordinates import forces_to_relative
from ..models.mechanism import Mechanism
from ..reference import planar_tree as planar
from ..reference.planar_tree import Parameters
from ..reference.rounding.bounds import EPSILON
from .buffers import stale_answers
from .compiled import compiled_by, compiled_differences, mechanism_from
from .differences import differences
from .explanation import Explanation, together, with_more
from .finding import Finding, joint_label
from .fits.parameter_faults import several_at_once, slight_fault, two_at_once, wrong_numbers
from .limits_and_contacts import limits_and_contacts
from .measurement import Measurement, measure
from .one_acceleration import one_acceleration
from .question import Question
from .single_precision import single_precision, visible_single_precision
from .views import another_view, wrong_convention

Attempt = Callable[[Question], Explanation]
ONE_CAUSE: tuple[Attempt, ...] = (
    wrong_convention,
    stale_answers,
    compiled_differences,
    limits_and_contacts,
    visible_single_precision,
    wrong_numbers,
    single_precision,
)
MORE_CAUSES: tuple[Attempt, ...] = (one_acceleration, two_at_once, another_view, several_at_once)


def explain(
    engine: Any, expected: Any, *, who: str = "the engine", accuracy: float = EPSILON, slight: bool = True
) -> list[Finding]:
    """Every finding of :func:`explanation`, the likeliest first; those that are alternatives say so."""
    return list(explanation(engine, expected, who=who, accuracy=accuracy, slight=slight).all)


def explanation(
    engine: Any, expected: Any, *, who: str = "the engine", accuracy: float = EPSILON, slight: bool = True
) -> Explanation:
    """Why ``engine`` does not move as ``expected``; empty where it does.

    ``engine``: anything with ``accelerations(theta, omega)`` of absolute angles [rad], (B, n), and where it has them
    ``inverse_dynamics(theta, omega, alpha)`` and ``fields()`` or ``compiled()``; ``expected``: a system, a planar tree
    or a mechanism; ``who``: the engine's name in messages; ``accuracy``: relative accuracy of its operations.
    ``slight``: look also for a single number that is off by so little that each state alone could be rounding, while
    all of them together cannot.
    """
    mechanism = mechanism_from(expected)
    compiled = compiled_by(engine, mechanism)
    if isinstance(compiled, Mechanism) and (compiled.n != mechanism.n or compiled.parents != mechanism.parents):
        return together(differences(compiled, mechanism, who))
    try:
        measured = measure(engine, mechanism, accuracy)
    except RuntimeError as error:
        return together([Finding("unexplained", who, None, None, f"{who}: {error}")])
    question = Question(engine, mechanism, measured, compiled, who)
    if measured.worst(question.p) <= 1:
        return slight_fault(question) if slight else Explanation()
    return _first(ONE_CAUSE, question) or _besides_compiled(question) or _more(question)


def _first(attempts: tuple[Attempt, ...], question: Question) -> Explanation:
    """The findings of the first attempt that has any."""
    for attempt in attempts:
        found = attempt(question)
        if found:
            return found
    return Explanation()


def _besides_compiled(question: Question) -> Explanation:
    """The mechanism that the engine compiled is another one, and there is something else besides."""
    if question.compiled is None:
        return Explanation()
    other = differences(question.compiled, question.m, question.who)
    if not other:
        return Explanation()
    rest = question.against(question.compiled)
    found = _first(ONE_CAUSE, rest) or _first(MORE_CAUSES, rest)
    return with_more(found, other) if found else Explanation()


def _more(question: Question) -> Explanation:
    found = _first(MORE_CAUSES, question)
    if found:
        return found
    return together([_unexplained(question.engine, question.measured, question.m, question.p, question.who)])


def _unexplained(engine: Any, measured: Measurement, m: Mechanism, p: Parameters, who: str) -> Finding:
    """The residual, term by term."""
    words = []
    forward = measured.only(measured.forward)
    left = np.abs(forward.residuals(p, forward.tolerances(p)))
    if left.max() > 1:
        state, row = np.unravel_index(int(left.argmax()), left.shape)
        rows = planar.inverse_dynamics(m.parents, p, forward.theta, forward.omega, forward.alpha)
        torque = float(forces_to_relative(m.parents, rows)[state, row])
        words.append(f"accelerations leave a residual torque of {torque:.3g} N m at {joint_label(m, int(row))}")
    inverse = measured.only(~measured.forward)
    if len(inverse) and inverse.worst(p) > 1:
        words += _by_term(engine, inverse, m, p)
    size = measured.worst(p)
    says = f"{who}: no known cause fits: {'; '.join(words)} ({size:.3g} times the tolerance)"
    return Finding("unexplained", who, size, 1.0, says)


def _by_term(engine: Any, inverse: Measurement, m: Mechanism, p: Parameters) -> list[str]:
    """Errors of gravity terms, mass matrix and velocity terms, by asking for each alone."""
    rest = np.zeros_like(inverse.theta)
    states = {
        "gravity terms": (inverse.theta, rest, rest),
        "mass matrix": (inverse.theta, rest, inverse.alpha),
        "velocity terms": (inverse.theta, inverse.omega, rest),
    }
    errors = {
        name: np.asarray(engine.inverse_dynamics(*state)) - planar.inverse_dynamics(m.parents, p, *state)
        for name, state in states.items()
    }
    words = []
    for name, error in errors.items():
        own = error if name == "gravity terms" else error - errors["gravity terms"]
        sizes = np.abs(forces_to_relative(m.parents, own))
        scale = Measurement(m.parents, *states[name], rest, inverse.forward, inverse.accuracy).tolerances(p)
        if (sizes > scale).any():
            row = int(np.unravel_index(int((sizes / scale).argmax()), sizes.shape)[1])
            words.append(f"{name} off by up to {float(sizes.max()):.3g} N m, most at {joint_label(m, row)}")
    return words or ["inverse dynamics is off only where all terms act together"]
