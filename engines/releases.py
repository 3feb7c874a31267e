"""What holds for some releases of an engine only, as data with a range of versions.

A range is written as pip writes it, ``>=3.4,<4``; a release that nobody has tried falls where its number says.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from ..models.writers.mjcf import DEEPEST
from .info import Integrator

_PART = re.compile(r"(<=|>=|<|>|==)\s*([0-9][0-9.]*)$")
_RELEASE = re.compile(r"[0-9]+(\.[0-9]+)*")
_PRE = re.compile(r"(a|b|c|rc|alpha|beta|pre|preview|\.?dev)[0-9]*$", re.IGNORECASE)


@dataclass(frozen=True)
class Need:
    """``package``, in these releases, needs ``with_it`` beside it; ``why``: what happens else."""

    package: str
    releases: str
    with_it: tuple[str, ...]
    why: str


@dataclass(frozen=True)
class Fact:
    """Of the engine called so, or of all engines of ``package``, in these releases: these fields of its info."""

    name: str
    releases: str
    fields: Mapping[str, Any] = field(default_factory=dict)
    why: str = ""


_EULER, _FAST, _MEANS = Integrator("Euler", 1), Integrator("implicitfast", 1), Integrator("RK4", 4, turning=2)
_MIDPOINT = "these releases of MuJoCo solve for the middle of a free body's step by iterations"
# Each was found by making the environment and importing the engine in it (docs/reference/engine-versions.md).
NEEDS = (
    Need("mujoco", ">=0", ("numpy",), "the adapters need it"),
    Need("exudyn", ">=0", ("numpy",), "the adapters need it"),
    Need(
        "pin",
        ">=3.4,<4",
        ("cmeel-urdfdom<5", "cmeel-tinyxml2<11"),
        "liburdfdom_sensor.so.4.0, then libtinyxml2.so.10 cannot be opened: it asks for any later release of both",
    ),
)
FACTS = (
    Fact(
        "mujoco",
        "<3.2.5",
        {
            "tree": None,
            "largest_n": DEEPEST,
            "largest_n_reason": "its reader of XML takes no deeper nesting, and before 3.2.5 MjSpec builds no models",
        },
        "without MjSpec a mechanism can be given to it as a file alone",
    ),
    Fact(
        "mujoco",
        "<4",
        {"integrators": (_EULER, _FAST, _MEANS)},
        "RK4 turns bodies by the mean of its stages' rates; from 4.0 on after Munthe-Kaas, with its full order",
    ),
    Fact(
        "mujoco",
        ">=3.7,<3.11",
        {"integrators": (_EULER, replace(_FAST, lone_body=_MIDPOINT), _MEANS)},
        "implicitfast had a rule of its own for free bodies on which nothing moves",
    ),
    Fact(
        "pinocchio-aba-mjcf",
        "<4",
        {"placed": "parent"},
        "joint placements are read as they are written; from 4.0 on they are differences of places in the world",
    ),
)
# Releases that the adapters do not take: what is there instead of a wrong answer.
TOO_OLD = (
    Need(
        "exudyn",
        "<1.13",
        (),
        "settings and arguments have other names before (solution, linearSolver, mass), and 1.10 ends in a crash",
    ),
)
# What an adapter asks of its engine in different ways: since which release the way that is usual now is there.
INTERFACE = {
    "mujoco: autoreset can be switched off": ">=3.2.1",
    "mujoco: body_sameframe tells a centre of mass from its axes": ">=3.2.3",
    "mujoco: MjSpec builds and compiles": ">=3.2.5",
    "mujoco: energies are computed though their flag is off": ">=3.3",
    "mujoco: springs and dampers are switched off one by one": ">=3.3.6",
    "mujoco: a joint's damping is a polynomial": ">=3.7",
    "mujoco: mj_fullM takes MjData": ">=3.10",
}
# A package that has releases which the engine's own package lacks.
ALSO_AS = {"mujoco": ("mujoco-core",)}


def release(version: str) -> tuple[int, ...]:
    """The numbers of a version, without zeros at the end: ``3.9.0`` and ``3.9`` are one. Empty for none."""
    found = _RELEASE.match(version)
    numbers = [int(part) for part in found.group().split(".")] if found else []
    while numbers and not numbers[-1]:
        numbers.pop()
    return tuple(numbers)


def has(what: str, version: str) -> bool:
    """Whether an engine of this version has an entry of :data:`INTERFACE`."""
    return within(version, INTERFACE[what])


def is_final(version: str) -> bool:
    """Whether it is a release, not a candidate or a snapshot before one."""
    return bool(_RELEASE.match(version)) and not _PRE.search(version)


def within(version: str, releases: str) -> bool:
    """Whether a version is in a range such as ``>=3.4,<4``. Raises ValueError for what is no range."""
    numbers = release(version)
    for part in releases.split(","):
        found = _PART.match(part.strip())
        if found is None:
            raise ValueError(f"{releases!r} is no range of releases")
        sign, limit = found.group(1), release(found.group(2))
        order = (numbers > limit) - (numbers < limit)
        if order not in {"<": (-1,), "<=": (-1, 0), ">": (1,), ">=": (0, 1), "==": (0,)}[sign]:
            return False
    return True


def needed_beside(package: str, version: str) -> tuple[str, ...]:
    """What has to be installed along with this release, as requirements of pip."""
    return tuple(
        requirement
        for need in NEEDS
        if need.package == package and within(version, need.releases)
        for requirement in need.with_it
    )


def too_old(package: str, version: str) -> str:
    """Why the adapters do not take this release, in a sentence; empty where they do."""
    for one in TOO_OLD:
        if one.package == package and version and within(version, one.releases):
            return f"{package} {version} is too old for furiko's adapters ({one.releases}): {one.why}"
    return ""


def facts_of(name: str, version: str) -> dict[str, Any]:
    """The fields of an engine's info that are others in this version."""
    found: dict[str, Any] = {}
    for fact in FACTS:
        if fact.name == name and version and within(version, fact.releases):
            found |= fact.fields
    return found
