"""Two mechanisms in the same frames, number by number: the differences, and the cause that their pattern shows."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..models import Link
from ..models.mechanism import Mechanism
from .finding import Finding, degrees_for_radians, joint_label, link_label, rounded
from .fits.hypotheses import bodies_finding
from .reader_faults import FAULT_SENTENCES, PATTERN_TOLERANCE, ReaderFaults, matching_fault

NUMBER_TOLERANCE = 1e-13  # relative: some hundred roundings
KNOWN_FACTORS = (
    (1000.0, "millimetres used as metres"),
    (0.001, "metres used as millimetres"),
    (2.0, ""),
    (0.5, ""),
)


def differences(
    found: Mechanism, expected: Mechanism, who: str, expectation: str = "expected", faults: ReaderFaults | None = None
) -> list[Finding]:
    """Differences of ``found`` from ``expected``, the most general cause first.

    ``who``: what ``found`` belongs to, an engine or the file; ``expectation``: the words before an expected value;
    ``faults``: what each link would be with known faults of readers.
    """
    findings = list(_structure(found, expected, who))
    if findings:
        return findings
    findings += _gravity(found, expected, who, expectation)
    for cause, other in _other_bodies(expected):
        if _same_bodies(found, other) and not _same_bodies(found, expected):
            findings.append(bodies_finding(cause, who))
            expected = other
    findings += _links(found, expected, who, expectation, faults or {})
    findings += _hinges(found, expected, who, expectation)
    return findings


def _structure(found: Mechanism, expected: Mechanism, who: str) -> Iterator[Finding]:
    if found.n != expected.n:
        fewer = found.n < expected.n
        names = {hinge.name for hinge in found.hinges}
        missing = [joint_label(expected, i) for i, hinge in enumerate(expected.hinges) if hinge.name not in names]
        missing_words = f"; missing: {', '.join(missing[:5])}" if fewer and len(missing) < expected.n else ""
        yield Finding(
            "joint-dropped-by-parser" if fewer else "joint-added",
            missing[0] if fewer and missing else who,
            found.n,
            expected.n,
            f"{who}: found {found.n} hinges, expected {expected.n}{missing_words}",
        )
    elif found.parents != expected.parents:
        yield Finding(
            "joint-order",
            who,
            str([p + 1 for p in found.parents]),
            str([p + 1 for p in expected.parents]),
            f"{who}: parents of the links: found {[p + 1 for p in found.parents]}, "
            f"expected {[p + 1 for p in expected.parents]} (0: the world)",
        )


def _gravity(found: Mechanism, expected: Mechanism, who: str, expectation: str) -> Iterator[Finding]:
    got, wanted = np.array(found.gravity), np.array(expected.gravity)
    size, right = float(np.hypot(*got)), float(np.hypot(*wanted))
    if np.hypot(*(got - wanted)) <= NUMBER_TOLERANCE * max(size, right):
        return
    whole = math.hypot(*found.gravity_vector)
    if abs(size - right) <= PATTERN_TOLERANCE * right and size > 0:
        turned = math.degrees(math.atan2(got[1], got[0]) - math.atan2(wanted[1], wanted[0]))
        yield Finding(
            "gravity-turned",
            "gravity",
            turned,
            0.0,
            f"{who}: gravity is rotated by {rounded(turned)}° in the plane of motion",
        )
    elif abs(whole - right) <= PATTERN_TOLERANCE * right and size < whole * (1 - PATTERN_TOLERANCE):
        yield Finding(
            "gravity-turned",
            "gravity",
            size,
            right,
            f"{who}: gravity is not in the plane of motion: found {rounded(size)} of {rounded(whole)} m/s² in "
            f"it, {expectation} {rounded(right)} m/s²",
        )
    else:
        yield Finding(
            "gravity",
            "gravity",
            size,
            right,
            f"{who}: gravity: found {rounded(size)}, {expectation} {rounded(right)} m/s²{_ratio(size, right)}",
        )


def _links(
    found: Mechanism, expected: Mechanism, who: str, expectation: str, faults: ReaderFaults
) -> Iterator[Finding]:
    density = None if faults else _density(found, expected)  # what readers of files do has names of its own
    if density is not None:
        yield _other_density(density, expected, who)
        denser = [replace(k, mass=k.mass * density, inertia=k.inertia * density) for k in expected.links]
        expected = replace(expected, links=tuple(denser))
    other_lengths = dict(_lengths(found, expected, who, expectation))
    for i, (got, wanted) in enumerate(zip(found.links, expected.links, strict=True)):
        if i in other_lengths:
            yield other_lengths[i]
        reach = max(math.hypot(*wanted.com), math.hypot(*got.com), 1e-300)
        displaced = math.dist(got.com, wanted.com) > NUMBER_TOLERANCE * max(reach, *map(abs, wanted.hinge)) and (
            got.mass or wanted.mass
        )
        other_mass = abs(got.mass - wanted.mass) > NUMBER_TOLERANCE * max(got.mass, wanted.mass)
        about_hinge = wanted.inertia + wanted.mass * reach**2
        other_inertia = (
            abs(got.inertia - wanted.inertia) > 1e-12 * max(wanted.inertia, got.inertia) + 1e-13 * about_hinge
        )
        if not (displaced or other_mass or other_inertia):
            continue
        name = link_label(expected, i)
        cause = matching_fault(i, got, faults)
        if cause is not None:
            yield Finding(cause, name, _inertial(got), _inertial(wanted), f"{who}: {name}: {FAULT_SENTENCES[cause]}")
        if wanted.mass and not got.mass:
            says = f"{who}: {name} has no mass, {expectation} {rounded(wanted.mass)} kg"
            yield Finding("massless-link", name, 0.0, wanted.mass, says)
            continue
        ratio = got.mass / wanted.mass if wanted.mass else math.inf
        if other_mass:
            extra = _ratio(got.mass, wanted.mass)
            yield Finding(
                "mass",
                name,
                got.mass,
                wanted.mass,
                f"{who}: mass of {name}: found {rounded(got.mass)}, {expectation} {rounded(wanted.mass)} kg{extra}",
            )
        scaled_along = (
            other_mass and wanted.inertia and abs(got.inertia / wanted.inertia / ratio - 1) < PATTERN_TOLERANCE
        )
        if displaced and not (i in other_lengths and _moved_along(got, wanted, other_lengths[i])):
            yield _displaced(
                name,
                got.com,
                wanted.com,
                who,
                expectation,
                wanted.inertia == 0 and not any(p == i for p in expected.parents),
            )
        if other_inertia and not scaled_along and i not in other_lengths:
            yield _inertia(name, got.inertia, wanted.inertia, who, expectation)


def _other_bodies(expected: Mechanism) -> Iterator[tuple[str, Mechanism]]:
    """The same links as point masses at their ends, where they have inertias; or as rods, where they are points."""
    links = expected.links
    if all(link.inertia for link in links):
        points = tuple(replace(link, com=(link.length, 0.0), inertia=0.0) for link in links)
        yield "rods-as-point-masses", replace(expected, links=points)
    elif not any(link.inertia for link in links):
        rods = tuple(
            replace(link, com=(link.length / 2, 0.0), inertia=link.mass * link.length**2 / 12) for link in links
        )
        yield "point-masses-as-rods", replace(expected, links=rods)


def _same_bodies(found: Mechanism, other: Mechanism) -> bool:
    """Whether all centres of mass, and all squared radii of gyration, are the same."""
    for got, wanted in zip(found.links, other.links, strict=True):
        reach = max(math.hypot(*wanted.com), math.hypot(*got.com), 1e-300)
        if not got.mass or not wanted.mass or math.dist(got.com, wanted.com) > PATTERN_TOLERANCE * reach:
            return False
        if abs(got.inertia / got.mass - wanted.inertia / wanted.mass) > PATTERN_TOLERANCE * reach**2:
            return False
    return True


def _density(found: Mechanism, expected: Mechanism) -> float | None:
    """The one factor of all masses and inertias, in two links or more, of which one may differ in something besides."""
    if expected.n < 2 or not all(link.mass for link in expected.links):
        return None
    pairs = list(zip(found.links, expected.links, strict=True))
    for got, wanted in pairs[:2]:
        factor = got.mass / wanted.mass
        if factor and abs(factor - 1) > NUMBER_TOLERANCE:
            heavier = sum(_heavier_by(factor, *pair) for pair in pairs)
            if heavier >= max(expected.n - 1, 2 if expected.n > 2 else 1) and _masses_by(factor, pairs):
                return factor
    return None


def _masses_by(factor: float, pairs: list[tuple[Link, Link]]) -> bool:
    alike = sum(abs(got.mass / factor - wanted.mass) <= PATTERN_TOLERANCE * wanted.mass for got, wanted in pairs)
    return alike >= max(len(pairs) - 1, 2)


def _heavier_by(factor: float, got: Link, wanted: Link) -> bool:
    """Whether mass and inertia are both a factor of the expected ones."""
    about_hinge = wanted.inertia + wanted.mass * math.hypot(*wanted.com) ** 2
    room = PATTERN_TOLERANCE * wanted.inertia + 1e-13 * about_hinge
    mass_alike = abs(got.mass / factor - wanted.mass) <= PATTERN_TOLERANCE * wanted.mass
    return mass_alike and abs(got.inertia / factor - wanted.inertia) <= room


def _other_density(factor: float, expected: Mechanism, who: str) -> Finding:
    if all(link.inertia for link in expected.links):
        says = f"{who}: density: every mass and inertia: found {rounded(factor)} times the expected value"
        return Finding("density", "every link", factor, 1.0, says)
    says = f"{who}: every mass: found {rounded(factor)} times the expected value"
    return Finding("mass", "every link", factor, 1.0, says)


def _lengths(found: Mechanism, expected: Mechanism, who: str, expectation: str) -> Iterator[tuple[int, Finding]]:
    """Links whose children's hinges are at another place."""
    for i in range(expected.n):
        children = [c for c in range(expected.n) if expected.links[c].parent == i]
        for c in children:
            got, wanted = found.links[c].hinge, expected.links[c].hinge
            size, right = math.hypot(*got), math.hypot(*wanted)
            if math.dist(got, wanted) > NUMBER_TOLERANCE * max(size, right, math.hypot(*expected.links[i].com)):
                turned = abs(size - right) <= PATTERN_TOLERANCE * right
                name, other = link_label(expected, i), joint_label(expected, c)
                says = f"{who}: length of {name} to {other}: found {rounded(size)}, {expectation} {rounded(right)} m"
                says += _ratio(size, right)
                if turned:
                    off = math.degrees(math.atan2(got[1], got[0]) - math.atan2(wanted[1], wanted[0]))
                    says = f"{who}: {other} is at the expected distance on {name}, but rotated by {rounded(off)}°"
                yield i, Finding("length", name, size, right, says)
                break


def _moved_along(got: Link, wanted: Link, length: Finding) -> bool:
    """Whether the centre of mass is where the link's other length, or its turned end, has taken it."""
    found, expected = length.measured, length.expected
    if not isinstance(found, float) or not isinstance(expected, float) or not expected:
        return True
    if abs(found / expected - 1) <= PATTERN_TOLERANCE:
        return True
    along = tuple(found / expected * x for x in wanted.com)
    return math.dist(got.com, along) <= PATTERN_TOLERANCE * max(math.hypot(*got.com), math.hypot(*along))


def _displaced(
    name: str, got: tuple[float, float], wanted: tuple[float, float], who: str, expectation: str, bob: bool
) -> Finding:
    size, right = math.hypot(*got), math.hypot(*wanted)
    same_distance = right > 0 and abs(size / right - 1) < PATTERN_TOLERANCE
    in_line = (
        abs(got[0] * wanted[1] - got[1] * wanted[0]) <= PATTERN_TOLERANCE * size * right and size > 0 and right > 0
    )
    if same_distance:
        off = math.degrees(math.atan2(got[1], got[0]) - math.atan2(wanted[1], wanted[0]))
        says = f"{who}: centre of mass of {name} is rotated by {rounded(off)}° about the hinge"
        return Finding("inertial-com-rotated", name, str(got), str(wanted), says)
    if bob and in_line:  # the length of a point mass's rod is its distance
        says = f"{who}: length of {name} (hinge to point mass): found {rounded(size)}, {expectation} {rounded(right)} m"
        says += _ratio(size, right)
        return Finding("length", name, size, right, says)
    says = f"{who}: centre of mass of {name} (along, across): found {_point(got)}, {expectation} {_point(wanted)} m"
    return Finding("com-displaced", name, str(got), str(wanted), says)


def _inertia(name: str, got: float, wanted: float, who: str, expectation: str) -> Finding:
    if wanted == 0:
        says = f"{who}: inertia of {name} about its centre of mass: found {rounded(got)} kg m², expected a point mass"
        return Finding("point-mass-patched", name, got, wanted, says)
    says = f"{who}: inertia of {name} about its centre of mass: found {rounded(got)}, "
    says += f"{expectation} {rounded(wanted)} kg m²{_ratio(got, wanted)}"
    return Finding("inertia", name, got, wanted, says)


def _hinges(found: Mechanism, expected: Mechanism, who: str, expectation: str) -> Iterator[Finding]:
    for i, (got, wanted) in enumerate(zip(found.hinges, expected.hinges, strict=True)):
        name = joint_label(expected, i)
        rows = (
            ("armature", "armature", got.armature, wanted.armature, "kg m²"),
            ("damping", "damping", got.damping, wanted.damping, "N m s"),
            ("dry-friction", "dry friction", got.friction, wanted.friction, "N m"),
            ("stiffness", "stiffness", got.stiffness, wanted.stiffness, "N m/rad"),
        )
        for cause, word, value, right, unit in rows:
            if abs(value - right) > NUMBER_TOLERANCE * max(value, right):
                if degrees_for_radians(value / right if right else 0.0):
                    yield _degrees(name, word, value, right, who)
                ignored = {
                    "damping": "damping-ignored",
                    "dry-friction": "friction-ignored",
                    "stiffness": "stiffness-ignored",
                }
                code = ignored.get(cause, cause) if value == 0 else cause
                theirs = f"{expectation} {rounded(right)} {unit}" if right else f"{expectation} none"
                yield Finding(
                    code, name, value, right, f"{who}: {name}: {word}: found {rounded(value)} {unit}, {theirs}"
                )
        if (
            got.stiffness
            and wanted.stiffness
            and abs(got.rest - wanted.rest) > NUMBER_TOLERANCE * max(1.0, abs(wanted.rest))
        ):
            if wanted.rest and degrees_for_radians(got.rest / wanted.rest):
                yield _degrees(name, "rest angle of the spring", got.rest, wanted.rest, who)
            says = f"{who}: {name}: rest angle of the spring: found {rounded(got.rest)}, "
            says += f"{expectation} {rounded(wanted.rest)} rad"
            yield Finding("spring-reference", name, got.rest, wanted.rest, says)
        if got.limits != wanted.limits and not _same_limits(got.limits, wanted.limits):
            yield from _limits(name, got.limits, wanted.limits, who, expectation)


def _limits(
    name: str, got: tuple[float, float] | None, wanted: tuple[float, float] | None, who: str, expectation: str
) -> Iterator[Finding]:
    if got and wanted:
        ratios = [a / b for a, b in zip(got, wanted, strict=True) if b]
        if ratios and all(map(degrees_for_radians, ratios)):
            yield _degrees(name, "limit", got[1], wanted[1], who)
    says = f"{who}: {name}: limits: found {_limit_words(got)}, {expectation} {_limit_words(wanted)}"
    yield Finding("joint-limit", name, _limit_words(got), _limit_words(wanted), says)


def _same_limits(a: tuple[float, float] | None, b: tuple[float, float] | None) -> bool:
    return (
        a is not None and b is not None and all(abs(x - y) <= 1e-12 * max(1, abs(y)) for x, y in zip(a, b, strict=True))
    )


def _limit_words(limits: tuple[float, float] | None) -> str:
    return f"{limits[0]:.6g} and {limits[1]:.6g} rad" if limits else "no limits"


def _degrees(name: str, word: str, got: float, wanted: float, who: str) -> Finding:
    factor = "a factor of 180/π, degrees and radians are mixed up"
    says = f"{who}: {name}: {word}: found {rounded(got)}, expected {rounded(wanted)} ({factor})"
    return Finding("degree-vs-radian", name, got, wanted, says)


def _inertial(found: Link) -> str:
    return f"{found.mass:.9g} kg at {_point(found.com)} m, {found.inertia:.9g} kg m²"


def _point(p: tuple[float, float]) -> str:
    return f"({rounded(p[0])}, {rounded(p[1])})"


def _ratio(got: float, wanted: float) -> str:
    if not wanted or not got:
        return ""
    ratio = got / wanted
    if degrees_for_radians(ratio):
        return " (a factor of 180/π: degrees and radians are mixed up)"
    for factor, words in KNOWN_FACTORS:
        if abs(ratio / factor - 1) < 1e-9:
            return f" (a factor of {factor:g}{', ' + words if words else ''})"
    return f" (a factor of {ratio:.12g})"
