"""Why an engine's motion is not the theory's: hypotheses, each tested against what the engine itself gives.

First what would make it the same engine asked wrongly (angles relative, in degrees, in another order), then what the
engine says it compiled, then what acts in some states only (limits, contacts), then every single number of the
mechanism, then every kind of number, then a few at once. A cause is only named when it leaves nothing that rounding
does not explain; where several do, all are named; where none does, the finding is ``unexplained``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..engines import ModelFields
from ..models import Link, PlanarTree
from ..models.coordinates import forces_to_relative, to_relative
from ..models.mechanism import Hinge, Mechanism, mechanism_of
from ..reference import planar_tree as planar
from ..reference.planar_tree import Parameters
from ..reference.rounding.bounds import EPSILON
from .conventions import asked_wrongly
from .differences import differences
from .finding import Finding, joint
from .hypotheses import Family, Fit, fit, groups, screened, singles
from .joint_limits import in_some_states
from .measurement import Array, Measurement, has_inverse_dynamics, measure
from .wording import named

TRIED = 14  # families fitted in full, out of all that were screened
TRIED_BESIDE = 5  # the same beside others
AT_MOST = 4  # causes at once
AS_GOOD = 20.0  # a fit this many times the best fit's left-over is not as good
NOISE = 0.02  # what every right fit leaves, in units of what rounding may
MOST = 60  # links up to which numbers are solved for; the cost grows with their cube
NEXT_TO_NOTHING = 1e-6  # a factor beyond this and its inverse is no fault but a mechanism done away with
PATTERN = 8.0  # by how much one number must lessen what is left for it to be no accident
SINGLE = 2.0**-23 / EPSILON


def mechanism_from(expected: Any) -> Mechanism:
    """A mechanism from a system, a planar tree, or a mechanism."""
    if isinstance(expected, Mechanism):
        return expected
    return mechanism_of(expected if isinstance(expected, PlanarTree) else expected.tree())


def explain(
    engine: Any, expected: Any, *, who: str = "the engine", accuracy: float = EPSILON, slight: bool = True
) -> list[Finding]:
    """Why ``engine`` does not move as ``expected``; empty where it does.

    ``engine``: anything with ``accelerations(theta, omega)`` of absolute angles (B, n), and where it has them
    ``inverse_dynamics(theta, omega, alpha)`` and ``fields()``; ``expected``: a system, a planar tree or a mechanism.
    The first finding is the likeliest; findings that fit equally well say so. ``slight``: look also for a single number
    that is off by so little that each state alone could be rounding, while all of them together cannot.
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
    worst = measured.worst(p)
    if worst <= 1:
        return _slight(mechanism, p, measured, who) if slight and worst > NOISE else []
    for attempt in (asked_wrongly, _compiled_wrongly, in_some_states, _shown_single, _numbers, _single_precision):
        findings = attempt(engine, mechanism, p, measured, compiled, who)
        if findings:
            return findings
    if has_inverse_dynamics(engine):  # perhaps the two disagree with each other
        forward = measured.only(measured.forward)
        findings = [] if forward.worst(p) <= 1 else _numbers(engine, mechanism, p, forward, compiled, who)
        if findings:
            return findings
    return [unexplained(engine, measured, mechanism, p, who)]


def _slight(m: Mechanism, p: Parameters, measured: Measurement, who: str) -> list[Finding]:
    """One number, off by so little that only all states together show it: rounding has no pattern, this has."""
    if m.n > MOST:
        return []
    left = measured.left_over(p, measured.scale(p))
    before = float(np.sqrt(np.mean(left**2)))
    one = singles(m, p)
    telling = [family for rms, family in screened(one, p, measured)[:TRIED] if rms * PATTERN < before]
    fits = [fit(family, p, measured) for family in telling]
    clear = [f for f in fits if f.left <= NOISE and (np.abs(f.values) > np.maximum(f.uncertainty, 1e-300)).any()]
    return _told(_as_good(clear), one, m, p, None, who) if clear else []


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


def _compiled_wrongly(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """What the engine says it holds, where that explains what it does."""
    if compiled is None or measured.worst(planar.parameters(compiled)) > 1:
        return []
    return differences(compiled, m, who)


def _numbers(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """Single numbers, kinds of numbers, several numbers."""
    if m.n > MOST:
        return []
    one = singles(m, p)
    ranked = screened(one, p, measured)
    fits = [fit(family, p, measured) for _, family in ranked[:TRIED]]
    explaining = _as_good([f for f in fits if f.explains and not _impossible(f, p)])
    if explaining:
        return _told(explaining, one, m, p, compiled, who)
    every = [fit(family, p, measured) for family in groups(m, p)]
    explaining = _as_good([f for f in every if f.explains and not _impossible(f, p)])
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
    """A hinge that drives itself, a mass below zero, or a link of no size, with which nothing would be left."""
    if found.family.relative and found.family.cause != "gravity":
        return not NEXT_TO_NOTHING < 1 + float(found.values[0]) < 1 / NEXT_TO_NOTHING
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
        tried = [f for f in tried if not _impossible(f, p)] or tried
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


def _shown_single(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """Single precision that shows in the numbers themselves."""
    return _single_precision(engine, m, p, measured, compiled, who) if _narrow(m, measured) else []


def _narrow(m: Mechanism, measured: Measurement) -> bool:
    """Whether accelerations, absolute or relative, are numbers of 24 bits."""
    forward = measured.only(measured.forward)
    swing = to_relative(m.parents, forward.alpha)
    largest = np.abs(forward.alpha).max(axis=1, keepdims=True)
    kept = np.abs(swing - swing.astype(np.float32)) <= 8 * EPSILON * largest
    return bool(kept.all() or (forward.alpha == forward.alpha.astype(np.float32)).all())


def _single_precision(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """Everything agrees as well as numbers of 24 bits can."""
    left, shown = measured.worst(p), _narrow(m, measured)
    if left > SINGLE or (not shown and left < 1e-4 * SINGLE):
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
        rows = planar.inverse_dynamics(m.parents, p, forward.theta, forward.omega, forward.alpha)
        torque = float(forces_to_relative(m.parents, rows)[state, row])
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
        name: np.asarray(engine.inverse_dynamics(*state)) - planar.inverse_dynamics(m.parents, p, *state)
        for name, state in asked.items()
    }
    words = []
    for name, error in off.items():
        own = error if name == "gravity terms" else error - off["gravity terms"]
        sizes = np.abs(forces_to_relative(m.parents, own))
        scale = Measurement(m.parents, *asked[name], rest, inverse.forward, inverse.accuracy).scale(p)
        if (sizes > scale).any():
            row = int(np.unravel_index(int((sizes / scale).argmax()), sizes.shape)[1])
            words.append(f"{name} off by up to {float(sizes.max()):.3g} N m, most at {joint(m, row)}")
    return words or ["inverse dynamics differs in all terms together"]
