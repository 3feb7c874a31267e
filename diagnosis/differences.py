"""Two mechanisms in the same frames, number by number: what differs, and the cause that the pattern shows."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..models import Link
from ..models.mechanism import Mechanism
from .finding import Finding, amount, degrees_for_radians, joint, link
from .reader_faults import ALIKE, Suspects, suspect
from .reader_faults import SAYS as SUSPECTED

SAME = 1e-13  # relative: some hundred roundings


def differences(
    found: Mechanism, expected: Mechanism, who: str, asked: str = "asked for", suspects: Suspects | None = None
) -> list[Finding]:
    """What ``found`` has otherwise than ``expected``, the most telling cause first.

    ``who`` is what has it (an engine, the file); ``asked``: the words before an expected value.
    """
    findings = list(_structure(found, expected, who))
    if findings:
        return findings
    findings += _gravity(found, expected, who, asked)
    findings += _links(found, expected, who, asked, suspects or Suspects())
    findings += _hinges(found, expected, who, asked)
    return findings


def _structure(found: Mechanism, expected: Mechanism, who: str) -> Iterator[Finding]:
    if found.n != expected.n:
        fewer = found.n < expected.n
        names = {hinge.name for hinge in found.hinges}
        lost = [joint(expected, i) for i, hinge in enumerate(expected.hinges) if hinge.name not in names]
        lost_words = f"; {', '.join(lost[:5])} missing" if fewer and len(lost) < expected.n else ""
        yield Finding(
            "joint-dropped-by-parser" if fewer else "joint-added",
            lost[0] if fewer and lost else who,
            found.n,
            expected.n,
            f"{who} has {found.n} hinges, {expected.n} asked for{lost_words}",
        )
    elif found.parents != expected.parents:
        yield Finding(
            "joint-order",
            who,
            str([p + 1 for p in found.parents]),
            str([p + 1 for p in expected.parents]),
            f"{who}: links hang on {[p + 1 for p in found.parents]}, asked for {[p + 1 for p in expected.parents]} "
            "(0: the support)",
        )


def _gravity(found: Mechanism, expected: Mechanism, who: str, asked: str) -> Iterator[Finding]:
    got, wanted = np.array(found.gravity), np.array(expected.gravity)
    size, right = float(np.hypot(*got)), float(np.hypot(*wanted))
    if np.hypot(*(got - wanted)) <= SAME * max(size, right):
        return
    whole = math.hypot(*found.gravity_vector)
    if abs(size - right) <= ALIKE * right and size > 0:
        turned = math.degrees(math.atan2(got[1], got[0]) - math.atan2(wanted[1], wanted[0]))
        yield Finding(
            "gravity-turned",
            "gravity",
            turned,
            0.0,
            f"{who}: gravity is turned by {amount(turned)}° in the plane of motion",
        )
    elif abs(whole - right) <= ALIKE * right and size < whole * (1 - ALIKE):
        yield Finding(
            "gravity-turned",
            "gravity",
            size,
            right,
            f"{who}: gravity leans out of the plane of motion, in which {amount(size)} of {amount(whole)} m/s² remain; "
            f"{asked} {amount(right)}",
        )
    else:
        yield Finding(
            "gravity",
            "gravity",
            size,
            right,
            f"{who}: gravity is {amount(size)} m/s², {asked} {amount(right)}{_ratio(size, right)}",
        )


def _links(found: Mechanism, expected: Mechanism, who: str, asked: str, suspects: Suspects) -> Iterator[Finding]:
    stretched = dict(_lengths(found, expected, who, asked))
    for i, (got, wanted) in enumerate(zip(found.links, expected.links, strict=True)):
        if i in stretched:
            yield stretched[i]
        reach = max(math.hypot(*wanted.com), math.hypot(*got.com), 1e-300)
        moved = math.dist(got.com, wanted.com) > SAME * max(reach, *map(abs, wanted.hinge)) and (
            got.mass or wanted.mass
        )
        heavier = abs(got.mass - wanted.mass) > SAME * max(got.mass, wanted.mass)
        about_hinge = wanted.inertia + wanted.mass * reach**2
        stiffer = abs(got.inertia - wanted.inertia) > 1e-12 * max(wanted.inertia, got.inertia) + 1e-13 * about_hinge
        if not (moved or heavier or stiffer):
            continue
        name = link(expected, i)
        cause = suspect(i, got, suspects)
        if cause is not None:
            yield Finding(cause, name, _inertial(got), _inertial(wanted), f"{who}: {name}: {SUSPECTED[cause]}")
        ratio = got.mass / wanted.mass if wanted.mass else math.inf
        if heavier:
            extra = _ratio(got.mass, wanted.mass)
            yield Finding(
                "mass",
                name,
                got.mass,
                wanted.mass,
                f"{who}: mass of {name} is {amount(got.mass)}, {asked} {amount(wanted.mass)} kg{extra}",
            )
        scaled_along = heavier and wanted.inertia and abs(got.inertia / wanted.inertia / ratio - 1) < ALIKE
        if moved and i not in stretched:
            yield _moved(
                name, got.com, wanted.com, who, asked, wanted.inertia == 0 and not any(p == i for p in expected.parents)
            )
        if stiffer and not scaled_along and i not in stretched:
            yield _stiffer(name, got.inertia, wanted.inertia, who, asked)


def _lengths(found: Mechanism, expected: Mechanism, who: str, asked: str) -> Iterator[tuple[int, Finding]]:
    """Links on which the hinges of those that they carry are elsewhere."""
    for i in range(expected.n):
        carried = [c for c in range(expected.n) if expected.links[c].parent == i]
        for c in carried:
            got, wanted = found.links[c].hinge, expected.links[c].hinge
            size, right = math.hypot(*got), math.hypot(*wanted)
            if math.dist(got, wanted) > SAME * max(size, right, math.hypot(*expected.links[i].com)):
                turned = abs(size - right) <= ALIKE * right
                name, other = link(expected, i), joint(expected, c)
                says = f"{who}: length of {name} to {other} is {amount(size)}, {asked} {amount(right)} m"
                if turned:
                    off = math.degrees(math.atan2(got[1], got[0]) - math.atan2(wanted[1], wanted[0]))
                    says = f"{who}: {other} is at the right distance on {name}, turned by {amount(off)}°"
                yield i, Finding("length", name, size, right, says + _ratio(size, right))
                break


def _moved(
    name: str, got: tuple[float, float], wanted: tuple[float, float], who: str, asked: str, bob: bool
) -> Finding:
    size, right = math.hypot(*got), math.hypot(*wanted)
    same_distance = right > 0 and abs(size / right - 1) < ALIKE
    in_line = abs(got[0] * wanted[1] - got[1] * wanted[0]) <= ALIKE * size * right and size > 0 and right > 0
    if same_distance:
        off = math.degrees(math.atan2(got[1], got[0]) - math.atan2(wanted[1], wanted[0]))
        says = f"{who}: centre of mass of {name} is turned by {amount(off)}° about the hinge"
        return Finding("inertial-com-rotated", name, str(got), str(wanted), says)
    if bob and in_line:  # the length of a point mass's rod is its distance
        says = f"{who}: length of {name} (hinge to point mass) is {amount(size)}, {asked} {amount(right)} m"
        says += _ratio(size, right)
        return Finding("length", name, size, right, says)
    says = f"{who}: centre of mass of {name} is at {_point(got)} m, {asked} {_point(wanted)} m (along, across)"
    return Finding("com-displaced", name, str(got), str(wanted), says)


def _stiffer(name: str, got: float, wanted: float, who: str, asked: str) -> Finding:
    if wanted == 0:
        says = (
            f"{who}: {name} has an inertia of {amount(got)} kg m² about its centre of mass, a point mass was asked for"
        )
        return Finding("point-mass-patched", name, got, wanted, says)
    says = f"{who}: inertia of {name} about the hinge axis is {amount(got)}, {asked} {amount(wanted)} kg m²"
    says += _ratio(got, wanted)
    return Finding("inertia", name, got, wanted, says)


def _hinges(found: Mechanism, expected: Mechanism, who: str, asked: str) -> Iterator[Finding]:
    for i, (got, wanted) in enumerate(zip(found.hinges, expected.hinges, strict=True)):
        name = joint(expected, i)
        rows = (
            ("armature", "armature", got.armature, wanted.armature, "kg m²"),
            ("damping", "damping", got.damping, wanted.damping, "N m s"),
            ("dry-friction", "dry friction", got.friction, wanted.friction, "N m"),
            ("stiffness", "stiffness", got.stiffness, wanted.stiffness, "N m/rad"),
        )
        for cause, word, value, right, unit in rows:
            if abs(value - right) > SAME * max(value, right):
                if degrees_for_radians(value / right if right else 0.0):
                    yield _degrees(name, word, value, right, who)
                ignored = {
                    "damping": "damping-ignored",
                    "dry-friction": "friction-ignored",
                    "stiffness": "stiffness-ignored",
                }
                code = ignored.get(cause, cause) if value == 0 else cause
                theirs = f"{asked} {amount(right)}" if right else f"{asked} none"
                yield Finding(code, name, value, right, f"{who}: {name}: {word} {amount(value)} {unit}, {theirs}")
        if got.stiffness and wanted.stiffness and abs(got.rest - wanted.rest) > SAME * max(1.0, abs(wanted.rest)):
            if wanted.rest and degrees_for_radians(got.rest / wanted.rest):
                yield _degrees(name, "spring reference", got.rest, wanted.rest, who)
            says = f"{who}: {name}: its spring rests at {amount(got.rest)} rad, {asked} {amount(wanted.rest)}"
            yield Finding("spring-reference", name, got.rest, wanted.rest, says)
        if got.limits != wanted.limits and not _alike(got.limits, wanted.limits):
            yield from _stops(name, got.limits, wanted.limits, who, asked)


def _stops(
    name: str, got: tuple[float, float] | None, wanted: tuple[float, float] | None, who: str, asked: str
) -> Iterator[Finding]:
    if got and wanted:
        ratios = [a / b for a, b in zip(got, wanted, strict=True) if b]
        if ratios and all(map(degrees_for_radians, ratios)):
            yield _degrees(name, "limit", got[1], wanted[1], who)
    says = f"{who}: {name} stops at {_stop(got)}; {asked} {_stop(wanted)}"
    yield Finding("joint-limit", name, _stop(got), _stop(wanted), says)


def _alike(a: tuple[float, float] | None, b: tuple[float, float] | None) -> bool:
    return (
        a is not None and b is not None and all(abs(x - y) <= 1e-12 * max(1, abs(y)) for x, y in zip(a, b, strict=True))
    )


def _stop(stops: tuple[float, float] | None) -> str:
    return f"{stops[0]:.6g} and {stops[1]:.6g} rad" if stops else "nothing"


def _degrees(name: str, word: str, got: float, wanted: float, who: str) -> Finding:
    says = (
        f"{who}: {name}: {word} is {amount(got)} where {amount(wanted)} is due: a factor of 180/π, degrees for radians"
    )
    return Finding("degree-vs-radian", name, got, wanted, says)


def _inertial(found: Link) -> str:
    return f"{found.mass:.9g} kg at {_point(found.com)} m, {found.inertia:.9g} kg m²"


def _point(p: tuple[float, float]) -> str:
    return f"({amount(p[0])}, {amount(p[1])})"


def _ratio(got: float, wanted: float) -> str:
    if not wanted or not got:
        return ""
    ratio = got / wanted
    if degrees_for_radians(ratio):
        return "; the factor is 180/π: degrees for radians"
    for factor, words in ((1000.0, "metres for millimetres"), (0.001, "millimetres for metres"), (2.0, ""), (0.5, "")):
        if abs(ratio / factor - 1) < 1e-9:
            return f" (a factor of {factor:g}{', ' + words if words else ''})"
    return f" (a factor of {ratio:.12g})"
