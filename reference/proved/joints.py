"""Between a mechanism's own coordinates, those of its joints, and absolute angles: exact one way, in clouds the other.

A joint's coordinate is q = sense (x - x of the parent that turns) + zero. Sums of doubles are binary fractions and
are not rounded; a set of starts is carried along the joints' directions, so that a box of q stays that box.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from ...models.tree import SUPPORT
from .clouds import Cloud
from .form import Planar
from .series import Numbers


def start(p: Planar, q: Sequence[float], rates: Sequence[float], radius: tuple[float, float]) -> Cloud:
    """The cloud of all states within ``radius`` (of coordinates, of rates) of these, in absolute angles.

    ``q``, ``rates``: doubles, in the coordinates of ``p.joints``. Without a radius the cloud is an exact point.
    """
    from flint import arb

    n = p.n
    x: list[Fraction] = []
    v: list[Fraction] = []
    ways: list[list[int]] = []
    for i, (joint, parent) in enumerate(zip(p.joints, p.turning_parents, strict=True)):
        turns = parent != SUPPORT
        x.append(joint.sense * (Fraction(q[i]) - Fraction(joint.zero)) + (x[parent] if turns else 0))
        v.append(joint.sense * Fraction(rates[i]) + (v[parent] if turns else 0))
        way = [*ways[parent]] if turns else [0] * n
        way[i] = joint.sense
        ways.append(way)
    exact = [_exact(value) for value in x], [_exact(value) for value in v]
    if not any(radius):
        return Cloud(*exact, [], [])
    still = [0] * n
    frame = [[*map(arb, (*way, *still))] for way in ways] + [[*map(arb, (*still, *way))] for way in ways]
    return Cloud(*exact, frame, [arb(radius[0])] * n + [arb(radius[1])] * n)


def in_joints(p: Planar, cloud: Cloud) -> Cloud:
    """A cloud of absolute angles and their rates in the coordinates of ``p.joints``."""
    from flint import arb

    n = p.n
    zeros = [arb(joint.zero) for joint in p.joints]
    x = [q + zero for q, zero in zip(_relative(p, cloud.x), zeros, strict=True)]
    columns = [*map(list, zip(*cloud.frame, strict=True))]
    turned = [_relative(p, one[:n]) + _relative(p, one[n:]) for one in columns]
    return Cloud(x, _relative(p, cloud.v), [*map(list, zip(*turned, strict=True))], cloud.reach)


def _relative(p: Planar, values: Numbers) -> Numbers:
    """``values`` of each link less its turning parent's, in the joints' sense."""
    return [
        joint.sense * (values[i] if parent == SUPPORT else values[i] - values[parent])
        for i, (joint, parent) in enumerate(zip(p.joints, p.turning_parents, strict=True))
    ]


def _exact(value: Fraction) -> Any:
    """The ball of a binary fraction, without a radius, whatever the precision."""
    from flint import arb

    return arb((value.numerator, 1 - value.denominator.bit_length()))
