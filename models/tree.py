"""A planar tree of links on hinges: the form from which model files are written and engines' models are built.

Frame of a link: origin at its hinge, first axis *along* the link (down when its angle is zero), second axis *across*
(to +x when its angle is zero). Points in it are pairs ``(along, across)`` [m]. Angles are absolute.
"""

from __future__ import annotations

from dataclasses import dataclass

SUPPORT = -1  # the parent of a link that hangs from the fixed support


@dataclass(frozen=True)
class Link:
    """One rigid link.

    ``parent``: index of the link that it hangs on, smaller than its own, or :data:`SUPPORT`; ``hinge``: their joint in
    the parent's frame, (along, across) [m]; ``com``: centre of mass in its own frame [m]; ``mass`` [kg]; ``inertia``:
    about the centre of mass and an axis parallel to the hinge's [kg m²], zero for a point mass; ``length``: of the
    drawing [m].
    """

    parent: int
    hinge: tuple[float, float]
    length: float
    com: tuple[float, float]
    mass: float
    inertia: float = 0.0


@dataclass(frozen=True)
class PlanarTree:
    """Links, every parent before its children, and gravity along -z [m/s²]. Raises ValueError for another order."""

    links: tuple[Link, ...]
    gravity: float

    def __post_init__(self) -> None:
        for i, link in enumerate(self.links):
            if not SUPPORT <= link.parent < i:
                raise ValueError(f"link {i}: its parent is {link.parent}, which does not come before it")

    @property
    def n(self) -> int:
        """Number of links, and of angles."""
        return len(self.links)

    @property
    def parents(self) -> tuple[int, ...]:
        """Index of each link's parent, :data:`SUPPORT` for links on the support."""
        return tuple(link.parent for link in self.links)

    @property
    def depth(self) -> int:
        """Number of links of the longest chain from the support to a tip."""
        depths: list[int] = []
        for link in self.links:
            depths.append(1 if link.parent == SUPPORT else depths[link.parent] + 1)
        return max(depths, default=0)

    def names(self, prefix: str) -> tuple[str, ...]:
        """``prefix`` with each link's number from 1, zero-padded so that sorting by name keeps the order."""
        width = len(str(self.n))
        return tuple(f"{prefix}{i:0{width}}" for i in range(1, self.n + 1))

    def children(self) -> tuple[tuple[int, ...], ...]:
        """Indices of each link's children."""
        found: list[list[int]] = [[] for _ in self.links]
        for i, link in enumerate(self.links):
            if link.parent != SUPPORT:
                found[link.parent].append(i)
        return tuple(map(tuple, found))

    def roots(self) -> tuple[int, ...]:
        """Indices of the links on the support."""
        return tuple(i for i, link in enumerate(self.links) if link.parent == SUPPORT)
