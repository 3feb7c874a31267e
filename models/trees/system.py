"""An open mechanism of a scene as plain numbers: it is known, hashed and sent to workers without numpy.

:meth:`TreeSystem.mechanism` makes the :class:`~furiko.models.spatial_mechanism.SpatialMechanism` of it, in whose
coordinates its states are.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from ..spatial_mechanism import Joint, RigidBody, SpatialMechanism

Vector = tuple[float, ...]
Kind = Literal["hinge", "slide", "ball", "free"]

KINDS: tuple[Kind, ...] = ("hinge", "slide", "ball", "free")
COORDINATES: dict[Kind, int] = {"hinge": 1, "slide": 1, "ball": 4, "free": 7}
RATES: dict[Kind, int] = {"hinge": 1, "slide": 1, "ball": 3, "free": 6}
ORIGIN = (0.0, 0.0, 0.0)
UPRIGHT = (1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class TreeJoint:
    """A joint, with the fields of :class:`~furiko.models.spatial_mechanism.Joint`."""

    name: str
    kind: Kind = "hinge"
    axis: Vector = (0.0, 0.0, 1.0)
    anchor: Vector = ORIGIN
    ref: float = 0.0
    armature: float = 0.0
    damping: float = 0.0
    stiffness: float = 0.0
    springref: float = 0.0
    limits: tuple[float, float] | None = None


@dataclass(frozen=True)
class TreeLink:
    """A link: index of its ``parent`` (-1: the world), its pose there in the reference configuration, its inertial.

    ``position`` [m] and ``quaternion`` (w, x, y, z); ``mass`` [kg]; ``centre`` of mass [m] and ``inertia`` about it,
    xx, yy, zz, xy, xz, yz [kg m²], in its own axes. ``joints``: in the order in which they move it; none: it is fixed.
    """

    name: str
    parent: int
    position: Vector = ORIGIN
    quaternion: Vector = UPRIGHT
    mass: float = 0.0
    centre: Vector = ORIGIN
    inertia: Vector = (0.0,) * 6
    joints: tuple[TreeJoint, ...] = ()


@dataclass(frozen=True)
class TreeSystem:
    """``links``, parents before children, and ``gravity`` (3,) in the world [m/s²]."""

    links: tuple[TreeLink, ...]
    gravity: Vector = (0.0, 0.0, -9.81)

    @property
    def kind(self) -> Literal["tree"]:
        """Its name in scene files."""
        return "tree"

    @cached_property
    def joints(self) -> tuple[TreeJoint, ...]:
        """All joints, in the order of their coordinates."""
        return tuple(joint for link in self.links for joint in link.joints)

    @property
    def nq(self) -> int:
        """Number of coordinates."""
        return sum(COORDINATES[joint.kind] for joint in self.joints)

    @property
    def n(self) -> int:
        """Number of degrees of freedom."""
        return sum(RATES[joint.kind] for joint in self.joints)

    @cached_property
    def freedoms(self) -> tuple[str, ...]:
        """What each degree of freedom is called: its joint's name, with a number where the joint has several."""
        return tuple(
            joint.name if RATES[joint.kind] == 1 else f"{joint.name}[{k + 1}]"
            for joint in self.joints
            for k in range(RATES[joint.kind])
        )

    @cached_property
    def reference(self) -> Vector:
        """The coordinates (nq,) of the reference configuration, in which every link has the pose that is given."""
        q: list[float] = []
        for link in self.links:
            for joint in link.joints:
                if joint.kind == "free":
                    q += [*link.position, *link.quaternion]
                else:
                    q += UPRIGHT if joint.kind == "ball" else (joint.ref,)
        return tuple(q)

    @cached_property
    def features(self) -> frozenset[str]:
        """What an engine must be able to hold: kinds of joints, ``armature``, ``spring`` and so on."""
        found: set[str] = {joint.kind for joint in self.joints}
        for joint in self.joints:
            single = joint.kind in ("hinge", "slide")
            found |= {name for name in ("armature", "damping") if getattr(joint, name)}
            if joint.kind == "free" and joint.armature:
                found.add("armature of a free joint")
            if joint.stiffness:
                found.add("spring" if single else "spring of a ball")
        if any(len(link.joints) > 1 for link in self.links):
            found.add("several joints")
        if any(len(link.joints) > 1 and link.joints[0].ref for link in self.links):
            found.add("several joints, the first with ref")
        if any("ball" in [joint.kind for joint in link.joints[:k]] for link in self.links for k in _rotations(link)):
            found.add("ball before a rotation")
        if "free" in found and sum(link.parent == -1 for link in self.links) > 1:
            found.add("free beside others")
        if self._massless():
            found.add("massless link")
        return frozenset(found)

    def _massless(self) -> bool:
        """Whether a link that moves has no mass, and none is fixed to it."""
        masses = [link.mass for link in self.links]
        for i, link in reversed(list(enumerate(self.links))):
            if not link.joints and link.parent >= 0:
                masses[link.parent] += masses[i]
        return any(link.joints and not mass for link, mass in zip(self.links, masses, strict=True))

    @cached_property
    def reach(self) -> float:
        """The longest way from the world to a link's centre of mass in the reference configuration [m], at least."""
        ways: list[float] = []
        far = 0.0
        for link in self.links:
            ways.append((ways[link.parent] if link.parent >= 0 else 0.0) + _length(link.position))
            far = max(far, ways[-1] + _length(link.centre))
        return far

    def mechanism(self) -> SpatialMechanism:
        """The same with arrays."""
        import numpy as np

        from ..spatial import Inertial, symmetric
        from ..spatial_mechanism import RigidBody, SpatialMechanism

        def body(link: TreeLink) -> RigidBody:
            inertial = Inertial(link.mass, np.array(link.centre), symmetric(*link.inertia))
            pose = np.array(link.position), np.array(link.quaternion)
            return RigidBody(link.name, link.parent, *pose, tuple(map(_joint, link.joints)), inertial)

        return SpatialMechanism(tuple(map(body, self.links)), np.array(self.gravity))


def tree_of(mechanism: SpatialMechanism) -> TreeSystem:
    """The plain numbers of a mechanism; dry friction, which no scene has, is left out."""
    return TreeSystem(tuple(map(_link, mechanism.bodies)), _vector(mechanism.gravity))


def _joint(joint: TreeJoint) -> Joint:
    import numpy as np

    from ..spatial_mechanism import Joint

    return Joint(
        name=joint.name,
        kind=joint.kind,
        axis=np.array(joint.axis),
        anchor=np.array(joint.anchor),
        ref=joint.ref,
        armature=joint.armature,
        damping=joint.damping,
        stiffness=joint.stiffness,
        springref=joint.springref,
        limits=joint.limits,
    )


def _rotations(link: TreeLink) -> list[int]:
    """Numbers of its joints that turn it."""
    return [k for k, joint in enumerate(link.joints) if joint.kind != "slide"]


def _link(body: RigidBody) -> TreeLink:
    tensor = body.inertial.tensor
    upper = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    return TreeLink(
        name=body.name,
        parent=body.parent,
        position=_vector(body.position),
        quaternion=_vector(body.quaternion),
        mass=float(body.inertial.mass),
        centre=_vector(body.inertial.centre),
        inertia=tuple(float(tensor[i, j] + tensor[j, i]) / 2 for i, j in upper),
        joints=tuple(
            TreeJoint(
                name=joint.name,
                kind=next(kind for kind in KINDS if kind == joint.kind),
                axis=_vector(joint.axis),
                anchor=_vector(joint.anchor),
                ref=float(joint.ref),
                armature=float(joint.armature),
                damping=float(joint.damping),
                stiffness=float(joint.stiffness),
                springref=float(joint.springref),
                limits=joint.limits,
            )
            for joint in body.joints
        ),
    )


def _vector(values: object) -> Vector:
    import numpy as np

    return tuple(np.asarray(values, dtype=np.float64).tolist())


def _length(vector: Vector) -> float:
    return math.hypot(*vector)
