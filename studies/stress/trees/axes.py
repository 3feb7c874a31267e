"""The axes along which open mechanisms are put under stress, and the ladders: an axis on a mechanism.

An axis is data: what is done to a mechanism and its states, from harmless to absurd, rung by rung. It applies to any
open mechanism that has what is changed, so that a user's own scene is asked the same questions as the catalogue's. What
stands on a rung is a function of ladder, rung and seed alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np

from ....models import TreeScene, find_scene
from ....models.trees.states import random_states
from ....models.trees.system import TreeSystem
from . import posed as made
from .mechanisms import chain, floating, gimbal
from .posed import Change, Posed

STATES = 3  # random ones of a scene; its given one beside them
BASES = ("cart-pole", "acrobot", "arm-7", "quadruped", "humanoid")  # of the catalogue
QUARTER = 0.25
NO_UNIT = ""


@dataclass(frozen=True)
class TreeAxis:
    """A ladder of numbers: rung k has the value ``start`` · ``ratio``ᵏ, at which ``change`` makes a mechanism worse.

    ``least``: the value of the last rung, or just before it; ``applies``: whether a mechanism has what is changed.
    """

    name: str
    says: str
    unit: str
    change: Change
    start: float
    end: float
    ratio: float
    applies: Callable[[TreeSystem], bool] = lambda system: True

    @cached_property
    def top(self) -> int:
        """The last rung."""
        return math.floor(abs(math.log2(self.end / self.start) / math.log2(self.ratio)) + 1e-9)

    def value(self, rung: int) -> float:
        """The number on this rung."""
        return self.start * self.ratio**rung


@dataclass(frozen=True)
class TreeLadder:
    """An axis on a mechanism, the ``base``."""

    axis: TreeAxis
    base: TreeScene

    @property
    def name(self) -> str:
        """The mechanism and the axis."""
        return f"{self.base.name}: {self.axis.name}"

    @property
    def says(self) -> str:
        """A sentence that says what it is."""
        return f"{self.base.name}, {self.axis.says}"

    @property
    def top(self) -> int:
        """The last rung."""
        return self.axis.top

    def value(self, rung: int) -> float:
        """In the axis' unit."""
        return self.axis.value(rung)

    def label(self, rung: int) -> str:
        """The value with its unit."""
        return f"{self.value(rung):.2g} {self.axis.unit}".rstrip()

    def posed(self, rung: int, seed: int) -> Posed:
        """What stands on a rung."""
        return self.axis.change(drawn(self.base, seed), self.value(rung))


def drawn(scene: TreeScene, seed: int) -> Posed:
    """A scene in its given state, if it has one, and in random ones."""
    rows = random_states(f"{seed} {scene.name}", scene.system, STATES)
    if scene.q is not None and scene.v is not None:
        rows.insert(0, (np.array(scene.q), np.array(scene.v)))
    return Posed(scene.system, np.array([q for q, _ in rows]), np.array([v for _, v in rows]))


def _has_single(system: TreeSystem) -> bool:
    return any(joint.kind in ("hinge", "slide") for joint in system.joints)


def _has_hinges(system: TreeSystem) -> bool:
    return any(joint.kind == "hinge" for joint in system.joints)


def _turns_freely(system: TreeSystem) -> bool:
    return bool(made.quaternions(system))


def _has_several(system: TreeSystem) -> bool:
    return sum(bool(link.joints) for link in system.links) > 1


def _growing(name: str, says: str, change: Change, bits: int, *more: Callable[[TreeSystem], bool]) -> TreeAxis:
    """From 1 to 2^bits, fourfold from rung to rung."""
    return TreeAxis(name, says, NO_UNIT, change, 1.0, 2.0**bits, 4.0, *more)


def _shrinking(name: str, says: str, change: Change, bits: int, *more: Callable[[TreeSystem], bool]) -> TreeAxis:
    return TreeAxis(name, says, NO_UNIT, change, 1.0, 2.0**-bits, QUARTER, *more)


def _to_denormals(name: str, says: str, change: Change, bits: int, *more: Callable[[TreeSystem], bool]) -> TreeAxis:
    """Down to 2^-bits, where numbers or their products are subnormal; ten bits, a thousandth, from rung to rung."""
    return TreeAxis(name, says, NO_UNIT, change, 1.0, 2.0**-bits, 2.0**-10, *more)


TREE_AXES: tuple[TreeAxis, ...] = (
    _growing("heavy-links", "every second link heavier, by this factor", made.heavy_links, 40, _has_several),
    _shrinking("light-tips", "the last links and their motors lighter, by this factor", made.light_tips, 40),
    _growing("long-links", "every second link longer, by this factor", made.long_links, 20, _has_several),
    _shrinking("short-links", "every second link shorter, by this factor", made.long_links, 20, _has_several),
    _growing("fast", "all rates larger, by this factor", made.fast, 20),
    TreeAxis("many-turns", "hinges that count many turns", "rad", made.many_turns, 1.0, 2.0**40, 4.0, _has_hinges),
    _shrinking("straight", "as near the reference configuration as this", made.straight, 40, _has_single),
    TreeAxis("far-base", "far from the origin", "m", made.far_base, 1.0, 2.0**40, 4.0, made.moves_on_the_world),
    TreeAxis("fast-base", "fast through the world", "m/s", made.fast_base, 1.0, 2.0**30, 4.0, made.moves_on_the_world),
    TreeAxis(
        "long-quaternions",
        "quaternions of this length",
        NO_UNIT,
        made.quaternion_lengths,
        1.0,
        2.0**1020,
        2.0**20,
        _turns_freely,
    ),
    TreeAxis(
        "short-quaternions",
        "quaternions of this length",
        NO_UNIT,
        made.quaternion_lengths,
        1.0,
        2.0**-1020,
        2.0**-20,
        _turns_freely,
    ),
    _to_denormals("half-turns", "as near half a turn as this", made.half_turns, 1070, _turns_freely),
    _to_denormals("small-masses", "masses in a unit that makes them smaller", made.smaller_masses, 1060),
    _to_denormals("small-lengths", "lengths in a unit that makes them smaller", made.smaller_lengths, 530),
    _to_denormals("slow", "rates in a unit that makes them smaller", made.slower, 530),
)
_GIMBAL = TreeAxis(
    "gimbal-lock",
    "the middle one of three hinges on one link so near a right angle",
    "rad",
    made.near_gimbal_lock,
    1.0,
    2.0**-40,
    QUARTER,
)


def ladders_of(scene: TreeScene) -> tuple[TreeLadder, ...]:
    """Every axis that applies to a scene."""
    return tuple(TreeLadder(axis, scene) for axis in TREE_AXES if axis.applies(scene.system))


@dataclass(frozen=True)
class ChainLadder(TreeLadder):
    """A chain in space of more and more links."""

    def posed(self, rung: int, seed: int) -> Posed:
        """What stands on a rung."""
        links = int(self.value(rung))
        return drawn(TreeScene(f"chain of {links}", chain(links)), seed)


_FREEDOMS = TreeAxis("freedoms", "of more and more links", "degrees of freedom", made.unchanged, 2.0, 256.0, 2.0)


@cache
def tree_ladders() -> dict[str, TreeLadder]:
    """By name: a chain in space, three hinges on one link, then every axis on scenes of the catalogue and a chain."""
    bases = [*map(find_scene, BASES), TreeScene("chain", chain(6)), TreeScene("floating", floating())]
    found: list[TreeLadder] = [
        ChainLadder(_FREEDOMS, TreeScene("chain", chain(2))),
        TreeLadder(_GIMBAL, TreeScene("gimbal", gimbal())),
    ]
    found += [ladder for base in bases if isinstance(base, TreeScene) for ladder in ladders_of(base)]
    return {ladder.name: ladder for ladder in found}


def find_ladders(name: str) -> list[TreeLadder]:
    """The ladders of a name: one, those of an axis on every mechanism, or those of a mechanism; else none."""
    known = tree_ladders()
    if name in known:
        return [known[name]]
    return [ladder for ladder in known.values() if name in (ladder.axis.name, ladder.base.name)]


def ladder_of(name: str, base: TreeScene | None = None) -> TreeLadder:
    """The ladder of a name, on a scene of the user's own where one is given."""
    if base is None:
        return tree_ladders()[name]
    return next(ladder for ladder in ladders_of(replace(base, own=None)) if ladder.name == name)
