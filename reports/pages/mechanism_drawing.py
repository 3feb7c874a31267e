"""A drawing of a mechanism's links to scale; coordinates only, no markup."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ...records.check import SceneEntry

MOST_LINKS = 200  # drawn of a longer mechanism; more cannot be told apart in a picture of this size
MARGIN = 12.0

Point = tuple[float, float]
Line = tuple[float, float, float, float]


@dataclass(frozen=True)
class MechanismDrawing:
    """Lines (x1, y1, x2, y2) and bobs (x, y, r) in a box of ``width`` × ``height``; the support is at ``support``."""

    width: float
    height: float
    support: Point
    lines: tuple[tuple[float, float, float, float], ...]
    bobs: tuple[tuple[float, float, float], ...]
    left_out: int


def draw_mechanism(scene: SceneEntry, size: float = 150.0) -> MechanismDrawing:
    """The links to scale. At rest they would hang on top of one another: they are drawn swung out, but for a tree."""
    lengths = scene.lengths[:MOST_LINKS]
    links = _seen(scene) if scene.outline else _links(scene.system, lengths)
    across = [0.0, *(x for _, (x, _) in links)]
    down = [0.0, *(y for _, (_, y) in links)]
    scale = (size - 2 * MARGIN) / (max(max(across) - min(across), max(down) - min(down)) or 1.0)
    left, top = MARGIN - scale * min(across), MARGIN - scale * min(down)

    def placed(point: Point) -> Point:
        return left + scale * point[0], top + scale * point[1]

    heaviest = max(scene.masses, default=1.0)
    ends = zip(links, scene.masses, strict=False)
    bobs = [(*placed(end), 2 + 4 * (mass / heaviest) ** (1 / 3)) for (_, end), mass in ends]
    return MechanismDrawing(
        width=2 * MARGIN + scale * (max(across) - min(across)),
        height=2 * MARGIN + scale * (max(down) - min(down)),
        support=placed((0.0, 0.0)),
        lines=tuple((*placed(start), *placed(end)) for start, end in links),
        bobs=tuple(bobs) if scene.system == "n-leg" else (),
        left_out=len(scene.lengths) - len(lengths),
    )


def draw_lines(lines: Sequence[Line], size: float = 300.0) -> MechanismDrawing:
    """Lines (x, z, x, z) [m], z upwards, to scale in a box at most ``size`` wide and high."""
    shown = lines[:MOST_LINKS]
    across = [0.0, *(x for line in shown for x in line[::2])]
    down = [0.0, *(-z for line in shown for z in line[1::2])]
    scale = (size - 2 * MARGIN) / (max(max(across) - min(across), max(down) - min(down)) or 1.0)
    left, top = MARGIN - scale * min(across), MARGIN - scale * min(down)
    return MechanismDrawing(
        width=2 * MARGIN + scale * (max(across) - min(across)),
        height=2 * MARGIN + scale * (max(down) - min(down)),
        support=(left, top),
        lines=tuple((left + scale * x, top - scale * z, left + scale * u, top - scale * w) for x, z, u, w in shown),
        bobs=(),
        left_out=len(lines) - len(shown),
    )


def _seen(scene: SceneEntry) -> list[tuple[Point, Point]]:
    """Both ends of each line of a tree [m], y downwards."""
    return [((x, -z), (other_x, -other_z)) for x, z, other_x, other_z in scene.outline[:MOST_LINKS]]


def _links(system: str, lengths: list[float]) -> list[tuple[Point, Point]]:
    """Both ends of each link [m], y downwards: legs hang from the end of the first rod, a rod from the one before."""
    links: list[tuple[Point, Point]] = []
    for length, angle in zip(lengths, _angles(system, len(lengths)), strict=True):
        x, y = (0.0, 0.0) if not links else links[0][1] if system == "n-leg" else links[-1][1]
        links.append(((x, y), (x + length * math.sin(angle), y + length * math.cos(angle))))
    return links


def _angles(system: str, n: int) -> list[float]:
    """Angles that show every link: legs fanned out, a chain in a bow."""
    if system == "n-leg":
        legs = n - 1
        return [0.35, *(1.1 if legs == 1 else -1.1 + 2.2 * k / (legs - 1) for k in range(legs))][:n]
    return [0.9 - 1.5 * j / max(n - 1, 1) for j in range(n)]
