"""Torques that act in some states only: joint limits and contacts."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np

from ..models.coordinates import to_absolute, to_relative
from ..models.mechanism import Mechanism
from ..reference import planar_tree as planar
from ..reference.planar_tree import Parameters
from .conventions import LARGE_RESIDUAL
from .explanation import Explanation, together
from .finding import Finding, joint_label
from .measurement import Array, Measurement, probe_states
from .question import Question


def limits_and_contacts(q: Question) -> Explanation:
    """A residual torque in some states and none in the others: a joint limit, or a contact."""
    forward = q.measured.only(q.measured.forward)
    residuals = np.abs(forward.residuals(q.p, forward.tolerances(q.p)))
    bad = residuals > 1
    states = bad.any(axis=1)
    if not states.any() or float(np.median(residuals.max(axis=1)[states])) < LARGE_RESIDUAL:
        return Explanation()
    if states.all() or (~states).sum() < 2:
        # Too few states without a residual to be no accident: try smaller angles, where limits do not act.
        return together(_beyond_small_angles(q.engine, q.m, q.p, q.who))
    return together(_limits_or_contacts(q.engine, q.m, forward, bad, q.who))


def _beyond_small_angles(engine: Any, m: Mechanism, p: Parameters, who: str) -> list[Finding]:
    theta, omega = probe_states(m, 64, seed=5)
    phi = to_relative(m.parents, theta)
    shrunk = phi * np.linspace(0.02, 1.0, len(phi))[:, None]
    theta = to_absolute(m.parents, shrunk)
    alpha = np.asarray(engine.accelerations(theta, omega))
    if not np.isfinite(alpha).all():
        return []
    near = Measurement(m.parents, theta, omega, alpha, np.zeros_like(alpha), np.ones(len(theta), dtype=bool))
    residuals = np.abs(near.residuals(p, near.tolerances(p)))
    bad = residuals > 1
    states = bad.any(axis=1)
    few = states.all() or not states.any() or (~states).sum() < 3
    if few or float(np.median(residuals.max(axis=1)[states])) < LARGE_RESIDUAL:
        return []
    return _limits_or_contacts(engine, m, near, bad, who)


def _limits_or_contacts(engine: Any, m: Mechanism, measured: Measurement, bad: Any, who: str) -> list[Finding]:
    phi = to_relative(m.parents, measured.theta)
    findings, explained = [], np.zeros(len(phi), dtype=bool)
    for i in range(m.n):
        rows = bad[:, i]
        if not rows.any():
            continue
        low, high = _free_range(phi[:, i], rows)
        outside = (phi[:, i] < low) | (phi[:, i] > high)
        # A hinge that moves back fast may be free beyond its limit: most states there are held, none inside.
        if (~outside).sum() < 3 or rows[outside].mean() < 0.6:
            continue
        explained |= rows
        limits = _limit_angles(engine, m, i, low, high, phi[rows, i])
        words = " and ".join(f"{side:.4g}" for side in limits if side is not None)
        name = joint_label(m, i)
        seen = f"{int(rows.sum())} of {len(phi)} states"
        says = f"{who}: {name}: found a limit at {words} rad, expected none: beyond it {seen} differ, inside all agree"
        findings.append(Finding("joint-limit", name, words, "no limits", says))
    if explained.all() or (bad.any(axis=1) == explained).all():
        return findings
    states = int(bad.any(axis=1).sum())
    says = f"{who}: an additional torque in {states} of {len(phi)} states, none in the others: geoms are in contact"
    return [*findings, Finding("colliding-geoms", who, states, 0, says)]


def _free_range(phi: Array, held: Any) -> tuple[float, float]:
    """The range of free angles between two held ones (or the ends of the circle), where most free ones lie."""
    ends = np.concatenate([[-np.inf], np.sort(phi[held]), [np.inf]])
    free = phi[~held]
    counts = [int(((free > a) & (free < b)).sum()) for a, b in itertools.pairwise(ends)]
    k = int(np.argmax(counts))
    inside = free[(free > ends[k]) & (free < ends[k + 1])]
    return (float(inside.min()), float(inside.max())) if inside.size else (np.inf, -np.inf)


def _limit_angles(engine: Any, m: Mechanism, i: int, low: float, high: float, beyond: Array) -> list[float | None]:
    """Angles [rad] of the lower and upper limit, by bisection between the last free angle and the first held one."""
    p = planar.parameters(m)
    found: list[float | None] = []
    middle_of_free = (low + high) / 2
    for inside, outside in ((low, beyond[beyond < low]), (high, beyond[beyond > high])):
        if not outside.size:
            found.append(None)
            continue
        a, b = middle_of_free, float(outside[np.argmin(np.abs(outside - inside))])
        for _ in range(40):
            middle = (a + b) / 2
            alone = np.zeros((1, m.n))
            alone[0, i] = middle
            theta, rest = to_absolute(m.parents, alone), np.zeros((1, m.n))
            alpha = np.asarray(engine.accelerations(theta, rest))
            one = Measurement(m.parents, theta, rest, alpha, np.zeros_like(alpha), np.ones(1, dtype=bool))
            if not np.isfinite(alpha).all() or one.worst(p) > 1:
                b = middle
            else:
                a = middle
        found.append((a + b) / 2)
    return found
