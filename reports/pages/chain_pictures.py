"""Pictures of chains of different numbers of rods at one instant; coordinates only, no markup."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from .axes import path
from .plot import KINDS

REACH = 1.05  # m to each side of the support that a picture shows
SIZE = 240.0


@dataclass(frozen=True)
class ChainPicture:
    """Curves (path, colour's number, name) in a picture ``size`` wide; the support is at ``support``."""

    title: str
    size: float
    curves: tuple[tuple[str, int, str], ...]
    support: tuple[float, float]


def draw_chains(title: str, curves: Mapping[str, Sequence[Sequence[float]]]) -> ChainPicture:
    """Chains that hang from one support, each with its joints (x, z) [m], z upwards."""
    scale = SIZE / (2 * REACH)
    support = SIZE / 2, SIZE / 5
    drawn = tuple(
        (path([support, *((support[0] + scale * x, support[1] - scale * z) for x, z in joints)]), i % KINDS, name)
        for i, (name, joints) in enumerate(curves.items())
    )
    return ChainPicture(title, SIZE, drawn, support)
