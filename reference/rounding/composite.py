"""The mass matrix of relative angles by composite rigid bodies (CRBA), in link frames or about the centre of mass.

Numbers of the kind of :class:`.monte_carlo.Noisy` only: columns of the matrix are worked on together.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...models import PlanarTree
from ...models.tree import SUPPORT
from .link_frames import Inertia, Spatial, Turn
from .monte_carlo import Noisy


def in_link_frames(tree: PlanarTree, turns: list[Turn], inertias: list[Inertia]) -> dict[int, tuple[list[int], Noisy]]:
    """Row i: the columns of link i and all it carries, and their entries, (samples, B, columns). Featherstone 6.2."""
    composite = list(inertias)
    forces: dict[int, tuple[list[int], Spatial]] = {}
    rows: dict[int, tuple[list[int], Noisy]] = {}
    for i in range(tree.n - 1, -1, -1):
        own = Spatial(composite[i].ww, composite[i].wx, composite[i].wy)
        columns, force = _together([([i], Spatial(*map(_wide, own))), *([forces.pop(i)] if i in forces else [])])
        rows[i] = columns, force.w
        parent = tree.links[i].parent
        if parent != SUPPORT:
            turn = turns[i]
            composite[parent] = composite[parent] + turn.inertia(composite[i])
            wide = Turn(*(_wide(number) for number in turn))
            arrived = columns, wide.force(force)
            forces[parent] = _together([forces[parent], arrived]) if parent in forces else arrived
    return rows


def about_centre_of_mass(
    tree: PlanarTree, axes: list[Spatial], inertias: list[Inertia]
) -> dict[int, tuple[list[int], Noisy]]:
    """Column j: the rows of link j and all that carry it, and their entries."""
    composite = list(inertias)
    for i in range(tree.n - 1, -1, -1):
        if tree.links[i].parent != SUPPORT:
            composite[tree.links[i].parent] = composite[tree.links[i].parent] + composite[i]
    found: dict[int, tuple[list[int], Noisy]] = {}
    for j in range(tree.n):
        rows, at = [], j
        while at != SUPPORT:
            rows.append(at)
            at = tree.links[at].parent
        force = composite[j].times(axes[j])
        x, y = (_stacked([axes[i][k] for i in rows]) for k in (1, 2))
        found[j] = rows, _wide(force.w) + x * _wide(force.x) + y * _wide(force.y)
    return found


def _together(parts: list[tuple[list[int], Spatial]]) -> tuple[list[int], Spatial]:
    columns = [column for part, _ in parts for column in part]
    if len(parts) == 1:
        return columns, parts[0][1]
    return columns, Spatial(*(_joined([force[k] for _, force in parts]) for k in range(3)))


def _wide(number: Any) -> Any:
    return Noisy(number.value[..., None], number.noise) if isinstance(number, Noisy) else number


def _stacked(numbers: list[Noisy]) -> Noisy:
    return Noisy(np.stack([number.value for number in numbers], axis=-1), numbers[0].noise)


def _joined(numbers: list[Noisy]) -> Noisy:
    return Noisy(np.concatenate([number.value for number in numbers], axis=-1), numbers[0].noise)
