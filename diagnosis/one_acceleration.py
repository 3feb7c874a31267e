"""Some accelerations that are right beside others that are wrong: the place of a fault whose kind has no name."""

from __future__ import annotations

import numpy as np

from ..models.tree import SUPPORT
from ..reference import planar_tree as planar
from .explanation import Explanation, together
from .finding import Finding
from .measurement import Array, acceleration_error
from .question import Question

CLEARLY_WRONG = 1e3  # times what rounding explains


def one_acceleration(q: Question) -> Explanation:
    """Which accelerations are wrong in states where others are right, and whether the fault shows at rest."""
    if q.m.parents.count(SUPPORT) != 1:  # mechanisms side by side have accelerations of their own
        return Explanation()
    forward = q.measured.only(q.measured.forward)
    off = _off(q, forward.theta, forward.omega, forward.alpha)
    right, wrong = off.max(axis=0) <= 1, off.max(axis=0) > CLEARLY_WRONG
    if not right.any() or not wrong.any() or not (right | wrong).all():
        return Explanation()
    rest = np.zeros_like(forward.omega)
    with np.errstate(all="ignore"):
        still = np.asarray(q.engine.accelerations(forward.theta, rest), dtype=np.float64)
    if still.shape != rest.shape or not np.isfinite(still).all():
        return Explanation()
    at_rest = _off(q, forward.theta, rest, still).max(axis=0) > 1
    findings = []
    for k in np.flatnonzero(wrong):
        term = "a gravity term: it is wrong at rest, too" if at_rest[k] else "a velocity term: it is right at rest"
        ok = ", ".join(f"θ̈{i + 1}" for i in np.flatnonzero(right))
        says = f"{q.who}: θ̈{k + 1} is wrong and {ok} right: {term}"
        findings.append(Finding("one-acceleration-wrong", f"θ̈{k + 1}", float(off[:, k].max()), 1.0, says))
    return together(findings)


def _off(q: Question, theta: Array, omega: Array, alpha: Array) -> Array:
    """Errors of accelerations over what rounding explains, (S, n)."""
    true = planar.forward_dynamics(q.m.parents, q.p, theta, omega)
    return np.asarray(np.abs(alpha - true) / acceleration_error(q.m.parents, q.p, theta, omega, true))
