"""Random mechanisms, each a function of its kind, its size and its seed alone.

Lengths, masses and densities are uniform in their logarithm, directions on the sphere. Numbers are short, so that a
mechanism can be written down.
"""

from __future__ import annotations

import hashlib
import math
from typing import TYPE_CHECKING, Literal

from ...models import NLegPendulum, RodChain, TreeSystem
from ...models.trees.system import Kind, TreeJoint, TreeLink, Vector

if TYPE_CHECKING:
    import numpy as np

GeneratorKind = Literal["rod-chain", "n-leg", "tree"]
LENGTHS, MASSES, DENSITIES = (0.3, 1.5), (0.3, 3.0), (0.3, 3.0)  # [m], [kg], [kg/m]
BRANCHING = 0.3  # part of a tree's links that hang on another than the last
SLIDES = 0.2  # part of a tree's joints that are slides; the others are hinges


def random_system(kind: GeneratorKind, links: int, seed: int) -> NLegPendulum | RodChain | TreeSystem:
    """A mechanism of so many links (angles, of the documents' two), the same for the same three."""
    import numpy as np

    digest = hashlib.sha256(f"{kind} {links} {seed}".encode()).digest()
    draw = np.random.Generator(np.random.PCG64(int.from_bytes(digest[:16], "big")))
    if kind == "tree":
        return _tree(draw, links)
    lengths = tuple(_size(draw, LENGTHS) for _ in range(links))
    if kind == "rod-chain":
        return RodChain(lengths, _size(draw, DENSITIES))
    return NLegPendulum(lengths, tuple(_size(draw, MASSES) for _ in range(links)))


def _size(draw: np.random.Generator, between: tuple[float, float]) -> float:
    low, high = map(math.log, between)
    return round(math.exp(draw.uniform(low, high)), 4)


def _tree(draw: np.random.Generator, links: int) -> TreeSystem:
    """An open mechanism of boxes, whose moments of inertia matter can have."""
    found: list[TreeLink] = []
    for i in range(links):
        parent = i - 1 if i < 2 or draw.random() > BRANCHING else int(draw.integers(i - 1))
        kind: Kind = "slide" if draw.random() < SLIDES else "hinge"
        mass = _size(draw, MASSES)
        sides = [_size(draw, (0.05, 0.5)) for _ in range(3)]
        squares = [side * side for side in sides]
        moments = tuple(mass / 12 * (sum(squares) - one) for one in squares)
        found.append(
            TreeLink(
                name=f"link {i + 1}",
                parent=parent,
                position=_vector(draw, 0.5),
                quaternion=_unit(draw, 4),
                mass=mass,
                centre=_vector(draw, 0.3),
                inertia=(*moments, 0.0, 0.0, 0.0),
                joints=(TreeJoint(f"joint {i + 1}", kind, axis=_unit(draw, 3)),),
            )
        )
    return TreeSystem(tuple(found))


def _vector(draw: np.random.Generator, largest: float) -> Vector:
    return tuple(round(float(value), 4) for value in draw.uniform(-largest, largest, 3))


def _unit(draw: np.random.Generator, length: int) -> Vector:
    values = draw.normal(size=length)
    size = math.sqrt(float(values @ values))
    return tuple(float(value) / size for value in values)
