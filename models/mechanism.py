"""A planar mechanism as a model file has it: the links, and the passive torques that a real hinge has.

Link frames are those of :mod:`furiko.models.tree`, chosen so that in the file's reference configuration every absolute
angle is zero: *down* is the direction of gravity in the plane, and *across* lies so that positive angles lead to it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from .tree import Link, PlanarTree


@dataclass(frozen=True)
class Hinge:
    """A hinge joint, in the sense of the planar relative angle φ = θ − θ of the parent [rad].

    Its torque on the link [N m] is −damping·φ̇ − stiffness·(φ − rest) − friction·sign(φ̇) − armature·φ̈: ``armature``
    [kg m²], ``damping`` [N m s], ``friction`` [N m], ``stiffness`` [N m], ``rest`` [rad]. ``limits``: lowest and
    highest φ [rad], or None. The file's own coordinate is ``sense``·φ + ``zero``, ``sense`` being 1 or −1.
    """

    name: str = ""
    armature: float = 0.0
    damping: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0
    limits: tuple[float, float] | None = None
    sense: float = 1.0
    zero: float = 0.0

    @property
    def ideal(self) -> bool:
        """Whether it turns freely, as the documents' hinges do."""
        passive = (self.armature, self.damping, self.friction, self.stiffness)
        return not any(passive) and self.limits is None


@dataclass(frozen=True)
class Mechanism:
    """Links and their hinges, and ``gravity`` (along, across) in the plane [m/s²].

    ``gravity_vector`` (3,): gravity in the file's world [m/s²]; ``down`` and ``across`` (3,): the plane's unit vectors
    there. ``link_names``: as the file has them. ``tilt``: the largest relative change of a torque that deviations from
    a planar mechanism may cause: the largest angle [rad] between hinge axes, times the sum of the links' offsets along
    them over their size.
    """

    links: tuple[Link, ...]
    hinges: tuple[Hinge, ...]
    gravity: tuple[float, float]
    link_names: tuple[str, ...]
    gravity_vector: tuple[float, ...] = (0.0, 0.0, 0.0)
    down: tuple[float, ...] = (0.0, 0.0, -1.0)
    across: tuple[float, ...] = (1.0, 0.0, 0.0)
    tilt: float = 0.0

    @property
    def n(self) -> int:
        """Number of links, and of angles."""
        return len(self.links)

    @property
    def parents(self) -> tuple[int, ...]:
        """Index of each link's parent, -1 for those on the support."""
        return tuple(link.parent for link in self.links)

    def ideal(self) -> Mechanism:
        """The same links on free hinges."""
        free = tuple(Hinge(name=h.name, sense=h.sense, zero=h.zero) for h in self.hinges)
        return replace(self, hinges=free)

    def tree(self) -> PlanarTree:
        """The links alone. Raises ValueError where gravity is not along *down*."""
        along, across = self.gravity
        if across != 0 or along < 0:
            raise ValueError("gravity is not along the frame's first axis")
        return PlanarTree(self.links, along)


def mechanism_of(tree: PlanarTree) -> Mechanism:
    """A planar tree of free hinges, named as furiko's own model files name them."""
    hinges = tuple(Hinge(name=name) for name in tree.names("hinge"))
    vector = (0.0, 0.0, -tree.gravity)
    return Mechanism(tree.links, hinges, (tree.gravity, 0.0), tree.names("link"), vector)
