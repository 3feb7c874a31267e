"""Pendulums with one angle, with losses, a torque and a spring; and a mass on a spring that swings."""

from __future__ import annotations

from collections.abc import Iterator

from ....dialects.names import plain_name
from .letters import Letters
from .poles import poles
from .roles import FORCE, INERTIA, LENGTH, LOSS, MASS, REST, SPRING, TORQUE, Bodies, named

FEW = 3


def pendulums(letters: Letters, angle: str) -> Iterator[Bodies]:
    """A pendulum with this angle; none for theta_2 where theta stands beside it."""
    plain = plain_name(angle) or ""
    if plain.rstrip("0123456789") in letters.names.keys() - {plain}:
        return
    for mass in (*named(letters, MASS, but=[angle])[:FEW], "1"):
        for length in (*named(letters, LENGTH, but=[angle, mass])[:FEW], "1"):
            for pole in _poles(letters, length, mass):
                for more in _more(letters, (angle, mass, length, *pole.values())):
                    yield [{"name": "pendulum", "coordinate": angle, "mass": mass, **pole, **more}]


def _poles(letters: Letters, length: str, mass: str) -> Iterator[dict[str, str]]:
    for inertia in named(letters, INERTIA)[:2]:
        yield from poles(length, mass, None, inertia)
    yield from poles(length, mass, None, None)


def _more(letters: Letters, taken: tuple[str, ...]) -> Iterator[dict[str, str]]:
    """A drive, a loss, which may be one of m l² θ̇ as well, and a spring; each where it has a letter."""
    _, mass, length, *_ = taken
    for drive in (None, *named(letters, TORQUE, but=taken)[:FEW]):
        for loss in (None, *named(letters, LOSS, but=[*taken, drive or ""])[:FEW]):
            for spring in (None, *named(letters, SPRING, but=[*taken, drive or "", loss or ""])[:1]):
                ways = [loss] if loss is None else [loss, f"{loss}*{length}^2", f"{loss}*{mass}*{length}^2"]
                for damping in ways:
                    parts = (("damping", damping), ("drive", drive), ("spring", spring))
                    yield {name: value for name, value in parts if value is not None}


def elastic(letters: Letters, angle: str, slide: str) -> Iterator[Bodies]:
    """A mass on a spring that swings: its length is the coordinate, or by how much that is more than at rest."""
    for mass in (*named(letters, MASS, but=[angle, slide])[:2], "1"):
        for spring in named(letters, SPRING, but=[angle, slide, mass])[:2]:
            for rest in (*named(letters, REST, but=[angle, slide, mass, spring])[:FEW], None):
                bob = {
                    "name": "bob",
                    "coordinate": slide,
                    "joint": "slide",
                    "along": "link",
                    "mass": mass,
                    "spring": spring,
                }
                rod = {"name": "spring", "coordinate": angle, "mass": "0"}
                yield [rod, {**bob, **({"rest": rest} if rest else {})}]
                if rest:
                    yield [{**rod, "length": rest}, bob]
        for drive in named(letters, FORCE, but=[angle, slide, mass])[:1]:
            other = next(iter(named(letters, TORQUE, but=[angle, slide, mass, drive])), None)
            for inertia in (*named(letters, INERTIA)[:1], None):
                arm = {"name": "arm", "coordinate": angle, "mass": "0", **({"inertia": inertia} if inertia else {})}
                arm |= {"drive": other} if other else {}
                yield [
                    arm,
                    {
                        "name": "bob",
                        "coordinate": slide,
                        "joint": "slide",
                        "along": "link",
                        "mass": mass,
                        "drive": drive,
                    },
                ]
