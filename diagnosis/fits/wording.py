"""Findings of fitted hypotheses: the link or hinge, the value that explains the measurement, its uncertainty."""

from __future__ import annotations

import math

import numpy as np

from ...models.mechanism import Mechanism
from ...reference.planar_tree import Parameters
from ..finding import UNITS, Finding, degrees_for_radians, joint_label, link_label, rounded
from ..measurement import Array
from .fitting import FittedHypothesis
from .hypotheses import Hypothesis


def findings_of_fit(found: FittedHypothesis, m: Mechanism, p: Parameters, who: str) -> list[Finding]:
    """One finding, or one for each hinge or link where all values of a kind were free; ``p``: what was expected."""
    hypothesis = found.hypothesis
    if hypothesis.tell is not None:
        return hypothesis.tell(float(found.values[0]), float(found.uncertainty[0]), p, who)
    if hypothesis.relative:
        return [_factor(found, m, p, who)]
    if hypothesis.cause == "gravity-turned":
        return [_gravity(found, p, who)]
    findings = []
    columns_by_link = _columns_by_link(hypothesis)
    for columns in columns_by_link:
        values, spread = found.values[columns], found.uncertainty[columns]
        if len(columns_by_link) > 1 and not (np.abs(values) > 30 * np.maximum(spread, 1e-300)).any():
            continue
        findings += _value(hypothesis, columns, values, spread, m, p, who)
    first = columns_by_link[0]
    return findings or _value(hypothesis, first, found.values[first], found.uncertainty[first], m, p, who)


def _columns_by_link(hypothesis: Hypothesis) -> list[list[int]]:
    """Columns of the values of each link."""
    places: dict[int, list[int]] = {}
    for column, i in enumerate(hypothesis.links):
        places.setdefault(i, []).append(column)
    return list(places.values())


def _value(
    hypothesis: Hypothesis, columns: list[int], values: Array, spread: Array, m: Mechanism, p: Parameters, who: str
) -> list[Finding]:
    name, i = hypothesis.names[columns[0]], hypothesis.links[columns[0]]
    before = float(p.items()[name][i])
    value, error = before + float(values[0]), float(spread[0])
    if name in ("armature", "damping", "friction", "stiffness"):
        return _hinge_value(hypothesis, name, i, before, value, error, values, m, p, who)
    place = link_label(m, i)
    if name in ("mass", "inertia"):
        says = f"{who}: {name} of {place}: found {rounded(value, error)}, expected {rounded(before)} {UNITS[name]}"
        cause = "point-mass-patched" if name == "inertia" and before == 0 else name
        return [Finding(cause, place, value, before, says)]
    second = hypothesis.names[columns[1]]
    wanted = (before, float(p.items()[second][i]))
    got = (value, wanted[1] + float(values[1]))
    if name == "hinge_along":
        parent = m.parents[i]
        place = link_label(m, parent)
        size, right = math.hypot(*got), math.hypot(*wanted)
        says = (
            f"{who}: position of {joint_label(m, i)} on {place} (along, across): found {_point(got, spread)}, "
            f"expected {_point(wanted)} m"
        )
        return [Finding("length", place, size, right, says)]
    size, right = math.hypot(*got), math.hypot(*wanted)
    turned = right > 0 and abs(size / right - 1) <= max(1e-9, 10 * error / right)
    cause = "inertial-com-rotated" if turned else "com-displaced"
    says = f"{who}: centre of mass of {place} (along, across): found {_point(got, spread)}, expected {_point(wanted)} m"
    return [Finding(cause, place, str(got), str(wanted), says)]


def _point(point: tuple[float, float], spread: Array | None = None) -> str:
    errors = (0.0, 0.0) if spread is None else (float(spread[0]), float(spread[1]))
    return f"({rounded(point[0], errors[0])}, {rounded(point[1], errors[1])})"


def _hinge_value(
    hypothesis: Hypothesis,
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
    place, unit = joint_label(m, i), UNITS[name]
    word = "dry friction" if name == "friction" else name
    ignored = {"damping": "damping-ignored", "friction": "friction-ignored", "stiffness": "stiffness-ignored"}
    gone = before > 0 and abs(value) <= 1e-9 * before and name in ignored
    theirs = f"expected {rounded(before)} {unit}" if before else "expected none"
    says = f"{who}: {place}: {word}: found {rounded(0.0 if gone else value, error)} {unit}, {theirs}"
    findings = []
    if before and degrees_for_radians(value / before):
        findings.append(
            Finding(
                "degree-vs-radian",
                place,
                value,
                before,
                f"{says} (a factor of 180/π: degrees and radians are mixed up)",
            )
        )
    if name == "stiffness" and len(values) > 1 and value:
        rest = (float(p.preload[i]) + float(values[1])) / value
        right = float(p.preload[i]) / before if before else 0.0
        if before and abs(values[0]) <= 1e-9 * before:
            says = f"{who}: {place}: rest angle of the spring: found {rounded(rest)}, expected {rounded(right)} rad"
            cause = "degree-vs-radian" if right and degrees_for_radians(rest / right) else "spring-reference"
            return [*findings, Finding(cause, place, rest, right, says)]
        says += f"; its rest angle is {rounded(rest)} rad"
    findings.append(Finding(ignored[name] if gone else hypothesis.cause, place, value, before, says))
    return findings


def _factor(found: FittedHypothesis, m: Mechanism, p: Parameters, who: str) -> Finding:
    hypothesis = found.hypothesis
    factor, error = 1 + float(found.values[0]), float(found.uncertainty[0])
    i = hypothesis.links[0]
    if hypothesis.cause == "gravity":
        return _strength(factor, error, p, who)
    place = "every link" if i < 0 else link_label(m, i)
    if hypothesis.cause == "mass" and i >= 0 and abs(factor) <= max(1e-9, 30 * error):
        return Finding("massless-link", place, 0.0, float(p.mass[i]), f"{who}: {place} has no mass")
    if hypothesis.cause == "density":
        cause = "density" if np.all(p.inertia > 0) else "mass"
        says = f"{who}: every mass and inertia (the density): found {rounded(factor, error)} times the expected value"
        return Finding(cause, place, factor, 1.0, says)
    if hypothesis.cause == "mass" and i >= 0:
        wanted = float(p.mass[i])
        says = (
            f"{who}: mass of {place}: found {rounded(wanted * factor, wanted * error)}, expected {rounded(wanted)} kg"
        )
        return Finding("mass", place, wanted * factor, wanted, says)
    if hypothesis.cause == "continuous-joint-not-normalised":
        place = "every joint" if i < 0 else joint_label(m, i)
        says = f"{who}: {place}: length of the pair (cos, sin): found {rounded(factor, error)}, expected 1"
        return Finding(hypothesis.cause, place, factor, 1.0, says)
    cause = hypothesis.cause
    if degrees_for_radians(factor):
        cause = "degree-vs-radian"
    word = hypothesis.names[0] if i < 0 else f"{hypothesis.cause.removesuffix('-displaced')} of {place}"
    says = f"{who}: {word}: found {rounded(factor, error)} times the expected value"
    return Finding(cause, place, factor, 1.0, says)


def _strength(factor: float, error: float, p: Parameters, who: str) -> Finding:
    """Gravity times a factor."""
    size = float(np.hypot(p.gravity_along[0], p.gravity_across[0]))
    if abs(factor + 1) <= max(1e-9, 30 * error):
        says = f"{who}: gravity has the opposite sign, or angles are counted from the upward vertical"
        return Finding("angle-convention", who, math.pi, 0.0, says)
    says = f"{who}: gravity: found {rounded(size * factor, size * error)}, expected {rounded(size)} m/s²"
    return Finding("gravity", "gravity", size * factor, size, says)


def _gravity(found: FittedHypothesis, p: Parameters, who: str) -> Finding:
    wanted = np.array([float(p.gravity_along[0]), float(p.gravity_across[0])])
    got = wanted + found.values
    size, right = float(np.hypot(*got)), float(np.hypot(*wanted))
    angle = math.degrees(math.atan2(got[1], got[0]) - math.atan2(wanted[1], wanted[0]))
    turned = abs(angle) > 1e-7
    says = f"{who}: gravity: found {rounded(size)}, expected {rounded(right)} m/s²"
    if turned:
        says += f"; rotated by {rounded(angle)}° in the plane of motion"
        return Finding("gravity-turned", "gravity", angle, 0.0, says)
    return Finding("gravity", "gravity", size, right, says)
