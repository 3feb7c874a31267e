"""Engines asked in another convention: relative angles, degrees, another order, another zero angle.

Each convention is a linear change of what the engine is given and of what it answers; once undone, no residual may be
left.
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
from .question import Question

MOST_ALIKE = 2  # conventions that are named where several explain the same
LARGE_RESIDUAL = 1e5  # in units of what rounding explains; another convention leaves far more


@dataclass(frozen=True)
class Convention:
    """The engine is given ``angles``·θ and ``rates``·ω, and answers ``answers``⁻¹·θ̈; matrices (n, n). Angles are
    ``offset`` [rad] more besides."""

    cause: str
    says: str
    angles: Array
    rates: Array
    answers: Array
    measured: str | float = ""
    expected: str | float = "absolute angles in radians, in the links' order"
    offset: float = 0.0

    def view(self, measured: Measurement) -> Measurement:
        """The measurement, in the coordinates that the engine means.

        Inverse dynamics is left out: its rows may be in either convention, or in both at once.
        """
        forward = measured.only(measured.forward)
        with np.errstate(all="ignore"):
            theta = forward.theta @ self.angles.T + self.offset
            # An angle of many turns has lost digits: its sine and cosine are known to ε times the angle, no better.
            digits = max(1.0, float(np.max(np.abs(theta), initial=0.0)))
            return replace(
                forward,
                theta=theta,
                omega=forward.omega @ self.rates.T,
                alpha=forward.alpha @ self.answers.T,
                accuracy=measured.accuracy * digits,
            )

    def view_of_all(self, measured: Measurement) -> Measurement:
        """The same, with inverse dynamics in the same convention."""
        seen, inverse = self.view(measured), measured.only(~measured.forward)
        with np.errstate(all="ignore"):
            return replace(
                measured,
                accuracy=seen.accuracy,
                theta=np.concatenate([seen.theta, inverse.theta @ self.angles.T + self.offset]),
                omega=np.concatenate([seen.omega, inverse.omega @ self.rates.T]),
                alpha=np.concatenate([seen.alpha, inverse.alpha @ self.answers.T]),
                torque=np.concatenate([seen.torque, inverse.torque @ np.linalg.inv(self.answers)]),
                forward=np.concatenate([seen.forward, inverse.forward]),
            )

    def finding(self, who: str) -> Finding:
        """The convention as the cause of what this engine does."""
        return Finding(self.cause, who, self.measured, self.expected, f"{who}: {self.says}")


def fitting_conventions(q: Question) -> list[Convention]:
    """The conventions, at most two, that explain the engine's accelerations."""
    forward = q.measured.only(q.measured.forward)
    if forward.worst(q.p) < LARGE_RESIDUAL:
        return []
    found = []
    for convention in conventions(q.engine, q.m):
        if _fits(convention, q.measured, q.p) and _fits(convention, q.again, q.p):
            found.append(convention)
        if len(found) == MOST_ALIKE:
            break
    return found


def _fits(convention: Convention, measured: Measurement, p: Parameters) -> bool:
    with np.errstate(all="ignore"):
        return convention.view(measured).worst(p) <= 1


def conventions(engine: Any, m: Mechanism) -> Iterator[Convention]:
    """Every convention that is known, likelier ones first."""
    yield from _conventions(engine, m)
    yield from _other_zero_angles(m.n)


def _conventions(engine: Any, m: Mechanism) -> Iterator[Convention]:
    n = m.n
    same: Array = np.eye(n)
    to_absolute = absolute_from_relative(m.parents)
    to_relative: Array = np.asarray(np.linalg.inv(to_absolute), dtype=np.float64)
    words = {0: "", 1: "angles", 2: "rates", 4: "accelerations"}
    if n > 1 and any(parent != SUPPORT for parent in m.parents):
        for mask in (7, 1, 2, 4, 3, 5, 6):
            which = " and ".join(words[bit] for bit in (1, 2, 4) if mask & bit)
            says = ("absolute values are used as relative ones", "relative values are used as absolute ones")
            # Answers go the other way: what comes back relative has been used as if it were absolute.
            for turned, said in zip((to_absolute, to_relative), says if mask != 4 else says[::-1], strict=True):
                sentence = f"{which}: {said}"
                a, b, c = (turned if mask & bit else same for bit in (1, 2, 4))
                yield Convention("angle-convention", sentence, a, b, c, sentence)
    for mask in (7, 1, 2, 4, 3, 5, 6):
        which = " and ".join(words[bit] for bit in (1, 2, 4) if mask & bit)
        for factor in (DEGREE, 1 / DEGREE):
            a, b, c = (same * (factor if mask & bit else 1.0) for bit in (1, 2, 4))
            units = "found radians, expected degrees" if factor < 1 else "found degrees, expected radians"
            yield Convention("degree-vs-radian", f"{which}: {units}", a, b, c, f"{which} × {factor:.7g}")
        if mask != 7:
            a, b, c = (same * (-1.0 if mask & bit else 1.0) for bit in (1, 2, 4))
            yield Convention("angle-convention", f"{which} have the opposite sign", a, b, c, f"−({which})")
    for order in _orders(engine, m, to_absolute):
        shuffled = same[order]
        for matrix, kind in ((to_absolute @ shuffled @ to_relative, "relative "), (shuffled, "")):
            numbers, expected = [i + 1 for i in order], list(range(1, n + 1))
            yield Convention(
                "joint-order",
                f"order of its {kind}joint coordinates: found {numbers}, expected {expected}",
                matrix,
                matrix,
                matrix,
                measured=str(numbers),
            )


def _orders(engine: Any, m: Mechanism, to_absolute: Array) -> Iterator[list[int]]:
    """Orders of the coordinates to try: the one that the mass matrix shows, and those that readers make."""
    n = m.n
    if n < 2:
        return
    seen = {tuple(range(n))}
    shown = _order_in_mass_matrix(engine, m, to_absolute)
    for order in [*([shown] if shown else []), *_usual_orders(m)]:
        # As a permutation and as its inverse: an adapter may mean either.
        for way in (order, list(np.argsort(order))):
            if tuple(way) not in seen:
                seen.add(tuple(way))
                yield [int(i) for i in way]


def _order_in_mass_matrix(engine: Any, m: Mechanism, to_absolute: Array) -> list[int] | None:
    """The order shown by the mass matrix at relative angles zero, of which it exchanges rows and columns only."""
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


def _other_zero_angles(n: int) -> Iterator[Convention]:
    """Angles counted from the upward vertical or from the horizontal, in either sense."""
    same: Array = np.eye(n)
    for sign, sense in ((1.0, ""), (-1.0, " and clockwise")):
        for offset, words in ((math.pi, "the upward vertical"), (math.pi / 2, "+x"), (-math.pi / 2, "−x")):
            says = f"its angles are counted from {words}{sense}, expected from the downward vertical"
            turned = sign * same
            yield Convention("angle-convention", says, turned, turned, turned, offset, 0.0, offset)
