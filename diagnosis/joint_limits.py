"""What acts in some states and not in others: a hinge's stop, or geoms that touch."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np

from ..models.coordinates import to_absolute, to_relative
from ..models.mechanism import Mechanism
from ..reference import planar_tree as planar
from ..reference.planar_tree import Parameters
from .conventions import FAR
from .finding import Finding, joint
from .measurement import Array, Measurement, probe_states


def in_some_states(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """A torque that is there in some states and not in others: a stop, or a contact."""
    forward = measured.only(measured.forward)
    left = np.abs(forward.left_over(p, forward.scale(p)))
    bad = left > 1
    states = bad.any(axis=1)
    if not states.any() or float(np.median(left.max(axis=1)[states])) < FAR:
        return []
    if states.all() or (~states).sum() < 2:
        # Fewer quiet states than can be told from chance: look at small angles, where stops do not act.
        return _only_further_out(engine, m, p, who)
    return _stops_or_contacts(engine, m, forward, bad, who)


def _only_further_out(engine: Any, m: Mechanism, p: Parameters, who: str) -> list[Finding]:
    theta, omega = probe_states(m, 64, seed=5)
    phi = to_relative(m.parents, theta)
    shrunk = phi * np.linspace(0.02, 1.0, len(phi))[:, None]
    theta = to_absolute(m.parents, shrunk)
    alpha = np.asarray(engine.accelerations(theta, omega))
    if not np.isfinite(alpha).all():
        return []
    near = Measurement(m.parents, theta, omega, alpha, np.zeros_like(alpha), np.ones(len(theta), dtype=bool))
    left = np.abs(near.left_over(p, near.scale(p)))
    bad = left > 1
    states = bad.any(axis=1)
    few = states.all() or not states.any() or (~states).sum() < 3
    if few or float(np.median(left.max(axis=1)[states])) < FAR:
        return []
    return _stops_or_contacts(engine, m, near, bad, who)


def _stops_or_contacts(engine: Any, m: Mechanism, measured: Measurement, bad: Any, who: str) -> list[Finding]:
    phi = to_relative(m.parents, measured.theta)
    findings, told = [], np.zeros(len(phi), dtype=bool)
    for i in range(m.n):
        rows = bad[:, i]
        if not rows.any():
            continue
        low, high = _free_range(phi[:, i], rows)
        outside = (phi[:, i] < low) | (phi[:, i] > high)
        # Moving back fast, a hinge may be let go beyond its stop: most states there are held, none inside.
        if (~outside).sum() < 3 or rows[outside].mean() < 0.6:
            continue
        told |= rows
        stops = _stop_angles(engine, m, i, low, high, phi[rows, i])
        words = " and ".join(f"{side:.4g}" for side in stops if side is not None)
        name = joint(m, i)
        seen = f"in {int(rows.sum())} of {len(phi)} states"
        says = f"{who}: {name} is held back beyond {words} rad, {seen}; inside, all agrees"
        findings.append(Finding("joint-limit", name, words, "turns freely", says))
    if told.all() or (bad.any(axis=1) == told).all():
        return findings
    states = int(bad.any(axis=1).sum())
    says = f"{who}: in {states} of {len(phi)} states something pushes, in the others all agrees: geoms that touch"
    return [*findings, Finding("colliding-geoms", who, states, 0, says)]


def _free_range(phi: Array, held: Any) -> tuple[float, float]:
    """Between which two held angles (or the ends of the circle) most free ones lie, as the free ones' own range."""
    ends = np.concatenate([[-np.inf], np.sort(phi[held]), [np.inf]])
    free = phi[~held]
    counts = [int(((free > a) & (free < b)).sum()) for a, b in itertools.pairwise(ends)]
    k = int(np.argmax(counts))
    inside = free[(free > ends[k]) & (free < ends[k + 1])]
    return (float(inside.min()), float(inside.max())) if inside.size else (np.inf, -np.inf)


def _stop_angles(engine: Any, m: Mechanism, i: int, low: float, high: float, beyond: Array) -> list[float | None]:
    """Where the stop begins, by halving between the last free angle and the first held one."""
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
