"""Why an engine's motion is not the theory's: hypotheses, each tested against what the engine itself gives.

First what would make it the same engine asked wrongly (angles relative, in degrees, in another order), then what the
engine says it compiled, then what acts in some states only (limits, contacts), then every single number of the
mechanism, then every kind of number, then a few at once. A cause is only named when it leaves nothing that rounding
does not explain; where several do, all are named; where none does, the finding is ``unexplained``.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..engines import ModelFields
from ..models import Link, PlanarTree
from ..models.mechanism import Hinge, Mechanism, mechanism_of
from ..models.tree import SUPPORT
from ..reference import planar
from ..reference.planar import Parameters
from .differences import differences
from .families import Family, Fit, added, fit, groups, screened, singles
from .finding import DEGREE, UNITS, Finding, amount, degrees_for_radians, joint, link
from .measurement import Array, Measurement, has_inverse_dynamics, measure, probe_states
from .rounding import EPSILON

TRIED = 14  # families fitted in full, out of all that were screened
TRIED_BESIDE = 5  # the same beside others
AT_MOST = 4  # causes at once
AS_GOOD = 20.0  # a fit this many times the best fit's left-over is not as good
NOISE = 0.02  # what every right fit leaves, in units of what rounding may
FAR = 1e5  # angles asked wrongly are wrong by far more than this, in units of what rounding explains
SINGLE = 2.0**-23 / EPSILON


def mechanism_from(expected: Any) -> Mechanism:
    """A mechanism from a system, a planar tree, or a mechanism."""
    if isinstance(expected, Mechanism):
        return expected
    return mechanism_of(expected if isinstance(expected, PlanarTree) else expected.tree())


def explain(engine: Any, expected: Any, *, who: str = "the engine", accuracy: float = EPSILON) -> list[Finding]:
    """Why ``engine`` does not move as ``expected``; empty where it does.

    ``engine``: anything with ``accelerations(theta, omega)`` of absolute angles (B, n), and where it has them
    ``inverse_dynamics(theta, omega, alpha)`` and ``fields()``; ``expected``: a system, a planar tree or a mechanism.
    The first finding is the likeliest; findings that fit equally well say so.
    """
    mechanism = mechanism_from(expected)
    p = planar.parameters(mechanism)
    compiled = compiled_by(engine, mechanism)
    if isinstance(compiled, Mechanism) and (compiled.n != mechanism.n or compiled.parents != mechanism.parents):
        return differences(compiled, mechanism, who)
    try:
        measured = measure(engine, mechanism, accuracy)
    except RuntimeError as error:
        return [Finding("unexplained", who, None, None, f"{who}: {error}")]
    if measured.worst(p) <= 1:
        return []
    for attempt in (_asked_wrongly, _compiled_wrongly, _in_some_states, _numbers, _single_precision):
        findings = attempt(engine, mechanism, p, measured, compiled, who)
        if findings:
            return findings
    if has_inverse_dynamics(engine):  # perhaps the two disagree with each other
        forward = measured.only(measured.forward)
        findings = [] if forward.worst(p) <= 1 else _numbers(engine, mechanism, p, forward, compiled, who)
        if findings:
            return findings
    return [unexplained(engine, measured, mechanism, p, who)]


def compiled_by(engine: Any, mechanism: Mechanism) -> Mechanism | None:
    """The mechanism that the engine says it holds; None where it does not say."""
    if hasattr(engine, "compiled"):
        found: Mechanism = engine.compiled()
        return found
    missing = getattr(getattr(engine, "info", None), "missing", {})
    if not hasattr(engine, "fields") or "fields" in missing:
        return None
    fields = engine.fields()
    return mechanism_of_fields(fields, mechanism)


def mechanism_of_fields(fields: ModelFields, like: Mechanism) -> Mechanism:
    """What an adapter's model fields describe, in the links' own frames; names as ``like`` has them."""
    n = len(fields.masses)
    links = tuple(
        Link(
            parent=int(fields.parents[i]),
            hinge=tuple(map(float, fields.hinges[i])),  # type: ignore[arg-type]
            length=1.0,
            com=tuple(map(float, fields.centres[i])),  # type: ignore[arg-type]
            mass=float(fields.masses[i]),
            inertia=float(fields.inertias[i]),
        )
        for i in range(n)
    )
    names = [hinge.name for hinge in like.hinges] + [""] * n
    hinges = tuple(
        Hinge(name=names[i], armature=float(fields.armature[i]), damping=float(fields.damping[i])) for i in range(n)
    )
    x, _, z = (float(v) for v in fields.gravity)
    link_names = (like.link_names + ("",) * n)[:n]
    if fields.dofs != n:  # fewer coordinates than links
        links, hinges, link_names = links[: fields.dofs], hinges[: fields.dofs], link_names[: fields.dofs]
        links = tuple(replace(k, parent=min(k.parent, i - 1)) for i, k in enumerate(links))
    return Mechanism(links, hinges, (-z, x), link_names, tuple(map(float, fields.gravity)))


@dataclass(frozen=True)
class _Reading:
    """A way to ask wrongly: the engine is given ``angles``·θ and ``rates``·ω, and answers ``answers``⁻¹·θ̈."""

    cause: str
    says: str
    angles: Array
    rates: Array
    answers: Array
    measured: str = ""


def _asked_wrongly(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
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
    same = np.eye(n)
    to_absolute = np.eye(n)
    for i, parent in enumerate(m.parents):
        if parent != SUPPORT:
            to_absolute[i] += to_absolute[parent]
    to_relative = np.linalg.inv(to_absolute)
    words = {0: "", 1: "angles", 2: "rates", 4: "accelerations"}
    if n > 1 and any(parent != SUPPORT for parent in m.parents):
        for mask in (7, 1, 2, 4, 3, 5, 6):
            which = " and ".join(words[bit] for bit in (1, 2, 4) if mask & bit)
            for turned, back, says in (
                (to_absolute, to_relative, "are given absolute where its own are relative"),
                (to_relative, to_absolute, "are given relative where its own are absolute"),
            ):
                parts = [turned if mask & 1 else same, turned if mask & 2 else same, turned if mask & 4 else same]
                yield _Reading("angle-convention", f"{which} {says}", *parts, measured=f"{which} {says}")
    for mask in (7, 1, 2, 4, 3, 5, 6):
        which = " and ".join(words[bit] for bit in (1, 2, 4) if mask & bit)
        for factor in (DEGREE, 1 / DEGREE):
            parts = [same * (factor if mask & bit else 1.0) for bit in (1, 2, 4)]
            taken = "in radians where degrees are meant" if factor < 1 else "in degrees where radians are meant"
            yield _Reading("degree-vs-radian", f"{which} are taken {taken}", *parts, measured=f"{which} × {factor:.7g}")
        if mask != 7:
            parts = [same * (-1.0 if mask & bit else 1.0) for bit in (1, 2, 4)]
            yield _Reading("angle-convention", f"{which} have the opposite sign", *parts, measured=f"−({which})")
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
    shown = np.diag(planar.relative_rows(m.parents, columns))
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


def _compiled_wrongly(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """What the engine says it holds, where that explains what it does."""
    if compiled is None or measured.worst(planar.parameters(compiled)) > 1:
        return []
    return differences(compiled, m, who)


def _in_some_states(
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
    relative = _relative(m, theta)
    shrunk = relative * np.linspace(0.02, 1.0, len(relative))[:, None]
    theta = _absolute(m, shrunk)
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
    phi = _relative(m, measured.theta)
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
        says = f"{who}: {name} is held back beyond {words} rad, in {int(rows.sum())} of {len(phi)} states; inside, all agrees"
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
            relative = np.zeros((1, m.n))
            relative[0, i] = middle
            theta, rest = _absolute(m, relative), np.zeros((1, m.n))
            alpha = np.asarray(engine.accelerations(theta, rest))
            one = Measurement(m.parents, theta, rest, alpha, np.zeros_like(alpha), np.ones(1, dtype=bool))
            if not np.isfinite(alpha).all() or one.worst(p) > 1:
                b = middle
            else:
                a = middle
        found.append((a + b) / 2)
    return found


def _numbers(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """Single numbers, kinds of numbers, several numbers."""
    one = singles(m, p)
    ranked = screened(one, p, measured)
    fits = [fit(family, p, measured) for _, family in ranked[:TRIED]]
    explaining = _as_good([f for f in fits if f.explains])
    if explaining:
        return _told(explaining, one, m, p, compiled, who)
    every = [fit(family, p, measured) for family in groups(m, p)]
    explaining = _as_good([f for f in every if f.explains])
    if explaining:
        fewest = min(_moved(f) for f in explaining)
        return _told([f for f in explaining if _moved(f) == fewest][:1], [f.family for f in every], m, p, compiled, who)
    return _several(one, m, p, measured, compiled, who)


def _as_good(fits: list[Fit]) -> list[Fit]:
    """Those that leave about as little as the best does, with as few values as any of them."""
    if not fits:
        return []
    best = min(f.left for f in fits)
    good = [f for f in fits if f.left <= max(AS_GOOD * best, NOISE)]
    fewest = min(f.family.d for f in good)
    return [f for f in good if f.family.d == fewest]


def _moved(f: Fit) -> int:
    return int((np.abs(f.values) > 30 * np.maximum(f.uncertainty, 1e-300)).sum())


def _told(
    fits: list[Fit], order: Sequence[Family], m: Mechanism, p: Parameters, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """Findings of fits that explain equally well, in the order of the families; one for each cause and place."""
    place = {id(family): i for i, family in enumerate(order)}
    possible = [f for f in fits if not _impossible(f, p)]
    fits = possible or fits
    findings: list[Finding] = []
    for found in sorted(fits, key=lambda f: place.get(id(f.family), 0)):
        for finding in named(found, m, p, who):
            if all((finding.cause, finding.where) != (other.cause, other.where) for other in findings):
                findings.append(finding)
    causes = {(f.cause, f.where) for f in findings}
    if len(fits) > 1 and len(causes) > 1:
        others = len(causes) - 1
        findings = [
            replace(f, says=f"{f.says}; {others} other cause{'s' * (others > 1)} would explain it as well")
            for f in findings
        ]
    return findings


def _impossible(found: Fit, p: Parameters) -> bool:
    """A hinge that drives itself, or a mass below zero."""
    for name, i, value, spread in zip(
        found.family.names, found.family.links, found.values, found.uncertainty, strict=True
    ):
        if found.family.relative or name not in ("armature", "damping", "friction", "stiffness", "mass", "inertia"):
            continue
        if float(p.items()[name][i]) + value < -30 * spread:
            return True
    return False


def _several(
    one: Sequence[Family], m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """A few numbers at once: the one that leaves least, then the next beside it, fitted together."""
    chosen: list[Family] = []
    at = p
    for _ in range(AT_MOST):
        ranked = screened(one, at, measured)
        tried = [
            fit(joined([*chosen, family]), p, measured) for _, family in ranked[:TRIED_BESIDE] if family not in chosen
        ]
        if not tried:
            return []
        best = min(tried, key=lambda f: f.left)
        pool = [f for f in tried if f.explains]
        if pool:
            best = _as_good(pool)[0]
        chosen = list(best.family.parts)  # type: ignore[attr-defined]
        at = best.family.apply(p, best.values)
        if best.explains:
            findings: list[Finding] = []
            start = 0
            for family in chosen:
                moved = np.abs(best.values[start : start + family.d]) > 30 * best.uncertainty[start : start + family.d]
                if not moved.any():
                    start += family.d
                    continue
                part = Fit(
                    family,
                    best.values[start : start + family.d],
                    best.uncertainty[start : start + family.d],
                    best.left,
                )
                start += family.d
                findings += named(part, m, p, who)
            return findings
    return []


@dataclass(frozen=True)
class Joined(Family):
    """Several families at once."""

    parts: tuple[Family, ...] = ()


def joined(families: Sequence[Family]) -> Joined:
    """Their values side by side."""

    def apply(base: Parameters, x: Array) -> Parameters:
        start = 0
        for family in families:
            base = family.apply(base, x[..., start : start + family.d])
            start += family.d
        return base

    return Joined(
        cause="several",
        apply=apply,
        names=tuple(name for f in families for name in f.names),
        links=tuple(i for f in families for i in f.links),
        sizes=np.concatenate([f.sizes for f in families]),
        parts=tuple(families),
    )


def _single_precision(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """Everything agrees as well as numbers of 24 bits can."""
    forward = measured.only(measured.forward)
    relative = _relative(m, forward.alpha)
    narrow = np.abs(relative - relative.astype(np.float32)) <= 8 * EPSILON * np.abs(forward.alpha).max(
        axis=1, keepdims=True
    )
    narrow_absolute = forward.alpha == forward.alpha.astype(np.float32)
    left = measured.worst(p)
    if left > SINGLE:
        return []
    shown = bool(narrow.all() or narrow_absolute.all())
    if not shown and left < 1e-4 * SINGLE:
        return []
    why = "its accelerations are numbers of 24 bits" if shown else "the rest is what numbers of 24 bits leave"
    size = left * EPSILON
    return [
        Finding(
            "float32",
            who,
            size,
            EPSILON,
            f"{who}: single precision: {why}; {left:.3g} times what double precision leaves",
        )
    ]


def unexplained(engine: Any, measured: Measurement, m: Mechanism, p: Parameters, who: str) -> Finding:
    """What is left, term by term."""
    words = []
    forward = measured.only(measured.forward)
    left = np.abs(forward.left_over(p, forward.scale(p)))
    if left.max() > 1:
        state, row = np.unravel_index(int(left.argmax()), left.shape)
        rows = planar.torques(m.parents, p, forward.theta, forward.omega, forward.alpha)
        torque = float(planar.relative_rows(m.parents, rows)[state, row])
        words.append(f"accelerations leave a torque of {torque:.3g} N m at {joint(m, int(row))}")
    inverse = measured.only(~measured.forward)
    if len(inverse) and inverse.worst(p) > 1:
        words += _by_term(engine, inverse, m, p)
    size = measured.worst(p)
    says = f"{who}: no known cause fits: {'; '.join(words)} ({size:.3g} times what rounding explains)"
    return Finding("unexplained", who, size, 1.0, says)


def _by_term(engine: Any, inverse: Measurement, m: Mechanism, p: Parameters) -> list[str]:
    """Gravity, mass matrix and velocity terms apart, by asking for each alone."""
    rest = np.zeros_like(inverse.theta)
    asked = {
        "gravity terms": (inverse.theta, rest, rest),
        "mass matrix": (inverse.theta, rest, inverse.alpha),
        "velocity terms": (inverse.theta, inverse.omega, rest),
    }
    off = {
        name: np.asarray(engine.inverse_dynamics(*state)) - planar.torques(m.parents, p, *state)
        for name, state in asked.items()
    }
    words = []
    for name, error in off.items():
        own = error if name == "gravity terms" else error - off["gravity terms"]
        sizes = np.abs(planar.relative_rows(m.parents, own))
        scale = Measurement(m.parents, *asked[name], rest, inverse.forward, inverse.accuracy).scale(p)
        if (sizes > scale).any():
            row = int(np.unravel_index(int((sizes / scale).argmax()), sizes.shape)[1])
            words.append(f"{name} off by up to {float(sizes.max()):.3g} N m, most at {joint(m, row)}")
    return words or ["inverse dynamics differs in all terms together"]


def named(found: Fit, m: Mechanism, p: Parameters, who: str) -> list[Finding]:
    """A fit in words: one finding, or one for each hinge or link where all of a kind were free."""
    family = found.family
    if family.relative:
        return [_factor(found, m, p, who)]
    if family.cause == "gravity-turned":
        return [_gravity(found, p, who)]
    findings = []
    pairs = _together(family)
    for columns in pairs:
        values, spread = found.values[columns], found.uncertainty[columns]
        if len(pairs) > 1 and not (np.abs(values) > 30 * np.maximum(spread, 1e-300)).any():
            continue
        findings += _value(family, columns, values, spread, m, p, who)
    return findings or _value(family, pairs[0], found.values[pairs[0]], found.uncertainty[pairs[0]], m, p, who)


def _together(family: Family) -> list[list[int]]:
    """Columns that belong to one link."""
    places: dict[int, list[int]] = {}
    for column, i in enumerate(family.links):
        places.setdefault(i, []).append(column)
    return list(places.values())


def _value(
    family: Family, columns: list[int], values: Array, spread: Array, m: Mechanism, p: Parameters, who: str
) -> list[Finding]:
    name, i = family.names[columns[0]], family.links[columns[0]]
    before = float(p.items()[name][i])
    value, error = before + float(values[0]), float(spread[0])
    if name in ("armature", "damping", "friction", "stiffness"):
        return _hinge_value(family, name, i, before, value, error, values, m, p, who)
    place = link(m, i)
    if name in ("mass", "inertia"):
        unit = UNITS[name]
        says = f"{who}: {name} of {place} is {amount(value, error)} {unit}, asked for {amount(before)}"
        cause = "point-mass-patched" if name == "inertia" and before == 0 else name
        return [Finding(cause, place, value, before, says)]
    second = family.names[columns[1]]
    wanted = (before, float(p.items()[second][i]))
    got = (value, wanted[1] + float(values[1]))
    if name == "hinge_along":
        parent = m.parents[i]
        place = link(m, parent)
        size, right = math.hypot(*got), math.hypot(*wanted)
        says = (
            f"{who}: {joint(m, i)} is at ({amount(got[0], error)}, {amount(got[1], float(spread[1]))}) m on {place}, "
            f"asked for ({amount(wanted[0])}, {amount(wanted[1])})"
        )
        return [Finding("length", place, size, right, says)]
    size, right = math.hypot(*got), math.hypot(*wanted)
    turned = right > 0 and abs(size / right - 1) <= max(1e-9, 10 * error / right)
    cause = "inertial-com-rotated" if turned else "com-displaced"
    says = (
        f"{who}: centre of mass of {place} is at ({amount(got[0], error)}, {amount(got[1], float(spread[1]))}) m, asked "
        f"for ({amount(wanted[0])}, {amount(wanted[1])}) (along, across)"
    )
    return [Finding(cause, place, str(got), str(wanted), says)]


def _hinge_value(
    family: Family,
    name: str,
    i: int,
    before: float,
    value: float,
    error: float,
    values: Array,
    m: Mechanism,
    p: Parameters,
    who: str,
) -> list[Finding]:
    place, unit = joint(m, i), UNITS[name]
    word = "dry friction" if name == "friction" else name
    ignored = {"damping": "damping-ignored", "friction": "friction-ignored", "stiffness": "stiffness-ignored"}
    gone = before > 0 and abs(value) <= 1e-9 * before and name in ignored
    theirs = f"asked for {amount(before)}" if before else "the theory has none"
    says = f"{who}: {place}: {word} {amount(0.0 if gone else value, error)} {unit}, {theirs}"
    findings = []
    if before and degrees_for_radians(value / before):
        findings.append(Finding("degree-vs-radian", place, value, before, f"{says}: a factor of 180/π"))
    if name == "stiffness" and len(values) > 1 and value:
        rest = (float(p.preload[i]) + float(values[1])) / value
        right = float(p.preload[i]) / before if before else 0.0
        if before and abs(values[0]) <= 1e-9 * before:
            says = f"{who}: {place}: its spring rests at {amount(rest)} rad, asked for {amount(right)}"
            cause = "degree-vs-radian" if right and degrees_for_radians(rest / right) else "spring-reference"
            return [*findings, Finding(cause, place, rest, right, says)]
        says += f", at rest at {amount(rest)} rad"
    findings.append(Finding(ignored[name] if gone else family.cause, place, value, before, says))
    return findings


def _factor(found: Fit, m: Mechanism, p: Parameters, who: str) -> Finding:
    family = found.family
    factor, error = 1 + float(found.values[0]), float(found.uncertainty[0])
    i = family.links[0]
    if family.cause == "gravity":
        size = float(np.hypot(p.gravity_along[0], p.gravity_across[0]))
        says = f"{who}: gravity is {amount(size * factor, size * error)} m/s², asked for {amount(size)}"
        return Finding("gravity", "gravity", size * factor, size, says)
    place = "every link" if i < 0 else link(m, i)
    if family.cause == "mass" and i >= 0:
        wanted = float(p.mass[i])
        says = f"{who}: mass of {place} is {amount(wanted * factor, wanted * error)}, asked for {amount(wanted)} kg"
        return Finding("mass", place, wanted * factor, wanted, says)
    if family.cause == "continuous-joint-not-normalised":
        place = joint(m, i)
        says = f"{who}: {place} turns by a pair (cos, sin) of length {amount(factor, error)}, which must be 1"
        return Finding(family.cause, place, factor, 1.0, says)
    cause = family.cause
    if degrees_for_radians(factor):
        cause = "degree-vs-radian"
    word = family.names[0] if i < 0 else f"{family.cause.removesuffix('-displaced')} of {place}"
    says = f"{who}: {word} is {amount(factor, error)} times what was asked for"
    return Finding(cause, place, factor, 1.0, says)


def _gravity(found: Fit, p: Parameters, who: str) -> Finding:
    wanted = np.array([float(p.gravity_along[0]), float(p.gravity_across[0])])
    got = wanted + found.values
    size, right = float(np.hypot(*got)), float(np.hypot(*wanted))
    angle = math.degrees(math.atan2(got[1], got[0]) - math.atan2(wanted[1], wanted[0]))
    turned = abs(angle) > 1e-7
    says = f"{who}: gravity is {amount(size)} m/s², turned by {amount(angle)}° in the plane; asked for {amount(right)}"
    if turned:
        return Finding("gravity-turned", "gravity", angle, 0.0, says)
    return Finding(
        "gravity", "gravity", size, right, f"{who}: gravity is {amount(size)} m/s², asked for {amount(right)}"
    )


def _relative(m: Mechanism, values: Array) -> Array:
    found = values.copy()
    for i, parent in enumerate(m.parents):
        if parent != SUPPORT:
            found[:, i] = values[:, i] - values[:, parent]
    return np.asarray(found)


def _absolute(m: Mechanism, relative: Array) -> Array:
    found = relative.copy()
    for i, parent in enumerate(m.parents):
        if parent != SUPPORT:
            found[:, i] += found[:, parent]
    return np.asarray(found)


__all__ = ["added", "explain", "explain_cell", "mechanism_from", "unexplained"]


def explain_cell(cell: Any) -> list[Finding]:
    """:func:`explain` for a cell whose comparisons differ: its engine against its scene's system."""
    return explain(cell.engine, cell.scene.system, who=cell.info.name, accuracy=cell.info.accuracy)
