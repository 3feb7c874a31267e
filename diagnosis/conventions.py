"""Engines that are asked wrongly: angles relative for absolute, in degrees, exchanged, counted from elsewhere.

Each is a linear change of what the engine is given and of what it answers; undone, nothing may be left over.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..models.coordinates import absolute_from_relative, forces_to_relative
from ..models.mechanism import Mechanism
from ..models.tree import SUPPORT
from ..reference import planar_tree as planar
from ..reference.planar_tree import Parameters
from .finding import DEGREE, Finding
from .measurement import Array, Measurement, has_inverse_dynamics

FAR = 1e5  # angles asked wrongly are wrong by far more than this, in units of what rounding explains


@dataclass(frozen=True)
class _Reading:
    """A way to ask wrongly: the engine is given ``angles``·θ and ``rates``·ω, and answers ``answers``⁻¹·θ̈."""

    cause: str
    says: str
    angles: Array
    rates: Array
    answers: Array
    measured: str = ""


def asked_wrongly(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """The ways to ask wrongly that leave nothing over once undone."""
    forward = measured.only(measured.forward)
    if forward.worst(p) < FAR:
        return []
    found = [reading for reading in _readings(engine, m) if _fits(reading, forward, p)]
    if not found:
        return _counted_from_elsewhere(engine, m, p, forward, who)
    return [
        Finding(r.cause, who, r.measured, "absolute angles in radians, in the links' order", f"{who}: {r.says}")
        for r in found[:2]
    ]


def _fits(reading: _Reading, forward: Measurement, p: Parameters) -> bool:
    with np.errstate(all="ignore"):
        taken = replace(
            forward,
            theta=forward.theta @ reading.angles.T,
            omega=forward.omega @ reading.rates.T,
            alpha=forward.alpha @ reading.answers.T,
        )
        # Angles of many turns have lost digits; what that changes is rounding too.
        return taken.worst(p) <= max(1.0, float(np.abs(taken.theta).max()))


def _readings(engine: Any, m: Mechanism) -> Iterator[_Reading]:
    n = m.n
    same: Array = np.eye(n)
    to_absolute = absolute_from_relative(m.parents)
    to_relative: Array = np.asarray(np.linalg.inv(to_absolute))
    words = {0: "", 1: "angles", 2: "rates", 4: "accelerations"}
    if n > 1 and any(parent != SUPPORT for parent in m.parents):
        for mask in (7, 1, 2, 4, 3, 5, 6):
            which = " and ".join(words[bit] for bit in (1, 2, 4) if mask & bit)
            for turned, says in (
                (to_absolute, "are given absolute where its own are relative"),
                (to_relative, "are given relative where its own are absolute"),
            ):
                words_for = f"{which} {says}"
                a, b, c = (turned if mask & bit else same for bit in (1, 2, 4))
                yield _Reading("angle-convention", words_for, a, b, c, words_for)
    for mask in (7, 1, 2, 4, 3, 5, 6):
        which = " and ".join(words[bit] for bit in (1, 2, 4) if mask & bit)
        for factor in (DEGREE, 1 / DEGREE):
            a, b, c = (same * (factor if mask & bit else 1.0) for bit in (1, 2, 4))
            taken = "in radians where degrees are meant" if factor < 1 else "in degrees where radians are meant"
            yield _Reading("degree-vs-radian", f"{which} are taken {taken}", a, b, c, f"{which} × {factor:.7g}")
        if mask != 7:
            a, b, c = (same * (-1.0 if mask & bit else 1.0) for bit in (1, 2, 4))
            yield _Reading("angle-convention", f"{which} have the opposite sign", a, b, c, f"−({which})")
    for order in _orders(engine, m, to_absolute):
        shuffled = same[order]
        for matrix, kind in ((to_absolute @ shuffled @ to_relative, "relative "), (shuffled, "")):
            numbers = [i + 1 for i in order]
            yield _Reading(
                "joint-order",
                f"its {kind}joint coordinates come in the order {numbers}",
                matrix,
                matrix,
                matrix,
                measured=str(numbers),
            )


def _orders(engine: Any, m: Mechanism, to_absolute: Array) -> Iterator[list[int]]:
    """Orders in which the coordinates may come instead: the one that the mass matrix shows, and those readers make."""
    n = m.n
    if n < 2:
        return
    seen = {tuple(range(n))}
    shown = _order_shown(engine, m, to_absolute)
    for order in [*([shown] if shown else []), *_usual_orders(m)]:
        # As a permutation and as its inverse: which of the two an adapter means is not ours to know.
        for way in (order, list(np.argsort(order))):
            if tuple(way) not in seen:
                seen.add(tuple(way))
                yield [int(i) for i in way]


def _order_shown(engine: Any, m: Mechanism, to_absolute: Array) -> list[int] | None:
    """With all relative angles zero, exchanged coordinates only exchange the mass matrix's rows and columns."""
    if not has_inverse_dynamics(engine):
        return None
    n = m.n
    p = planar.parameters(m)
    rest = np.zeros((n, n))
    try:
        with_gravity = np.asarray(engine.inverse_dynamics(rest[:1], rest[:1], rest[:1]))
        columns = np.asarray(engine.inverse_dynamics(rest, rest, to_absolute.T.copy())) - with_gravity
    except Exception:
        return None
    shown = np.diag(forces_to_relative(m.parents, columns))
    wanted = np.diag(to_absolute.T @ planar.mass_matrix(m.parents, p, np.zeros((1, n)))[0] @ to_absolute)
    if not np.allclose(np.sort(shown), np.sort(wanted), rtol=1e-9):
        return None
    order = np.empty(n, dtype=int)
    order[np.argsort(shown)] = np.argsort(wanted)
    return [int(i) for i in order]


def _usual_orders(m: Mechanism) -> Iterator[list[int]]:
    n = m.n
    yield list(range(n))[::-1]
    yield sorted(range(n), key=lambda i: str(i + 1))  # 1, 10, 2, …
    depth = [0] * n
    for i, parent in enumerate(m.parents):
        depth[i] = 0 if parent == SUPPORT else depth[parent] + 1
    yield sorted(range(n), key=lambda i: depth[i])  # breadth first
    yield _depth_first(m)
    yield [*range(1, n), 0]
    for a in range(n):
        for b in range(a + 1, n):
            swapped = list(range(n))
            swapped[a], swapped[b] = b, a
            yield swapped


def _depth_first(m: Mechanism) -> list[int]:
    order, pending = [], [i for i in range(m.n - 1, -1, -1) if m.parents[i] == SUPPORT]
    while pending:
        i = pending.pop()
        order.append(i)
        pending += [c for c in range(m.n - 1, i, -1) if m.parents[c] == i]
    return order


def _counted_from_elsewhere(engine: Any, m: Mechanism, p: Parameters, forward: Measurement, who: str) -> list[Finding]:
    """Angles counted from up, or from level, in either sense."""
    turned = replace(forward, theta=-forward.theta, omega=-forward.omega, alpha=-forward.alpha)
    for view, sense in ((forward, ""), (turned, " and clockwise")):
        for offset, words in ((math.pi, "upwards"), (math.pi / 2, "level, to +x"), (-math.pi / 2, "level, to −x")):
            if replace(view, theta=view.theta + offset).worst(p) <= 1:
                says = f"{who}: its angles are counted from {words}{sense}"
                return [Finding("angle-convention", who, offset, 0.0, says)]
    return []
