"""Fits in words: which link or hinge, the value that explains what was measured, its uncertainty, what was asked."""

from __future__ import annotations

import math

import numpy as np

from ..models.mechanism import Mechanism
from ..reference.planar_tree import Parameters
from .finding import UNITS, Finding, amount, degrees_for_radians, joint, link
from .hypotheses import Family, Fit
from .measurement import Array


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
        f"{who}: centre of mass of {place} is at ({amount(got[0], error)}, {amount(got[1], float(spread[1]))}) m, "
        f"asked for ({amount(wanted[0])}, {amount(wanted[1])}) (along, across)"
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
