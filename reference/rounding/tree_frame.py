"""RNEA of a planar tree about the whole tree's centre of mass, in the world's axes, as MuJoCo computes it.

One text for any numbers that add, multiply and divide, as :mod:`.link_frames`, whose spatial vectors it uses. First
axis down, second to +x. Links are placed by unit quaternions, a pair of numbers in the plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...models import PlanarTree
from ...models.tree import SUPPORT
from .link_frames import STILL, Inertia, Spatial, cross_force


class Placed:
    """Joints' axes and links' inertias about the centre of mass, for relative angles ``q``; depths below the support.

    ``sine_and_cosine`` of half an angle.
    """

    def __init__(self, tree: PlanarTree, half: Sequence[tuple[Any, Any]]) -> None:
        hinges: list[tuple[Any, Any]] = []
        centres: list[tuple[Any, Any]] = []
        turns: list[tuple[Any, Any]] = []
        for link, (sin, cos) in zip(tree.links, half, strict=True):
            if link.parent == SUPPORT:
                turn, (x, y) = (cos, sin), link.hinge
            else:
                w, v = turns[link.parent]
                turn = (w * cos - v * sin, v * cos + w * sin)
                x, y = _at(hinges[link.parent], w, v, link.hinge)
            turns.append(turn)
            hinges.append((x, y))
            centres.append(_at((x, y), *turn, link.com))
        total = sum(link.mass for link in tree.links)
        moments = [[link.mass * centre[k] for link, centre in zip(tree.links, centres, strict=True)] for k in (0, 1)]
        middle = [sum(parts[1:], parts[0]) / total for parts in moments]
        self.depths = [centre[0] for centre in centres]  # of the centres of mass, below the support
        self.axes: list[Spatial] = []
        self.inertias: list[Inertia] = []
        for link, hinge, centre in zip(tree.links, hinges, centres, strict=True):
            self.axes.append(Spatial(1.0, hinge[1] - middle[1], -(hinge[0] - middle[0])))
            dx, dy = centre[0] - middle[0], centre[1] - middle[1]
            x, y = link.mass * dx, link.mass * dy
            about = link.mass * (dx * dx + dy * dy) + link.inertia
            self.inertias.append(Inertia(about, -y, x, link.mass, 0.0, link.mass))


def inverse_dynamics(
    tree: PlanarTree, placed: Placed, rates: Sequence[Any], accelerations: Sequence[Any], *, gravity: Any
) -> tuple[list[Any], list[Spatial]]:
    """Joint torques [N m] and spatial forces through the joints, about the centre of mass [N m, N]."""
    v: list[Spatial] = []
    a: list[Spatial] = []
    forces: list[Spatial] = []
    for i, link in enumerate(tree.links):
        axis, rate = placed.axes[i], rates[i]
        carried_v, carried_a = (
            (STILL, Spatial(0.0, -gravity, 0.0)) if link.parent == SUPPORT else (v[link.parent], a[link.parent])
        )
        turning = Spatial(0.0, -(carried_v.w * axis.y) + carried_v.y, carried_v.w * axis.x - carried_v.x)
        v.append(carried_v + _times(axis, rate))
        a.append(carried_a + _times(turning, rate) + _times(axis, accelerations[i]))
        inertia = placed.inertias[i]
        forces.append(inertia.times(a[i]) + cross_force(v[i], inertia.times(v[i])))
    for i in range(tree.n - 1, -1, -1):
        if tree.links[i].parent != SUPPORT:
            forces[tree.links[i].parent] = forces[tree.links[i].parent] + forces[i]
    torques = [
        axis.w * force.w + axis.x * force.x + axis.y * force.y for axis, force in zip(placed.axes, forces, strict=True)
    ]
    return torques, forces


def _at(origin: tuple[Any, Any], w: Any, v: Any, point: tuple[float, float]) -> tuple[Any, Any]:
    """A point of a frame that is turned by the quaternion (w, v)."""
    cos, sin, (x, y) = w * w - v * v, 2.0 * (w * v), point
    return origin[0] + (cos * x - sin * y), origin[1] + (sin * x + cos * y)


def _times(vector: Spatial, number: Any) -> Spatial:
    return Spatial(vector.w * number, vector.x * number, vector.y * number)
