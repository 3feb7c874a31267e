"""The numbers of a mechanism by the names that authors give them, for constants that a file does not give."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...models.trees.system import TreeJoint, TreeSystem
from .plane import PARALLEL, Plane

WORDS = {
    "mass": "the mass of", "length": "the length of", "centre": "the way from its joint to the centre of mass of",
    "inertia": "the moment of inertia about the centre of mass of", "damping": "the damping of",
    "stiffness": "the stiffness of",
}  # fmt: skip
UNITS = {"mass": "kg", "length": "m", "centre": "m", "inertia": "kg m²"}
OF_JOINTS = {"damping": ("N m s", "N s/m"), "stiffness": ("N m/rad", "N/m"), "armature": ("kg m²", "kg")}


@dataclass(frozen=True)
class Quantity:
    """A number of the file: its ``kind``, the joint's index, the link or joint that has it, and its ``value``, SI."""

    kind: str
    joint: int
    of: str
    value: float
    unit: str

    @property
    def words(self) -> str:
        """ "the mass of 'pole'"."""
        return f"{WORDS[self.kind]} {self.of!r}"


def joint_unit(kind: str, joint: TreeJoint) -> str:
    """The unit of a hinge's, or a slide's, damping, stiffness or armature."""
    return OF_JOINTS[kind][joint.kind == "slide"]


def quantities(system: TreeSystem, plane: Plane | None) -> list[Quantity]:
    """All that a usual name may mean, joint after joint."""
    found: list[Quantity] = []
    for k, joint in enumerate(system.joints):
        found += [
            Quantity(kind, k, joint.name, getattr(joint, kind), joint_unit(kind, joint))
            for kind in ("damping", "stiffness")
        ]
        if plane is None:
            continue
        body = plane.bodies[k]
        way = math.dist(body.centre, body.anchor) if body.mass else 0.0
        numbers = {"mass": body.mass, "inertia": body.inertia}
        if body.turns:
            length = _length(plane, k, way)
            numbers |= {"centre": way} | ({"length": length} if length else {})
        found += [Quantity(kind, k, body.link, value, UNITS[kind]) for kind, value in numbers.items()]
    return found


def _length(plane: Plane, k: int, way: float) -> float:
    """Where it carries one joint, the way there; where it carries none, that to a point mass; else it is not known."""
    own = plane.bodies[k]
    joints = plane.children(k)
    if len(joints) == 1:
        return math.dist(joints[0].anchor, own.anchor)
    point = not joints and own.inertia <= PARALLEL * own.mass * way * way
    return way if point else 0.0


LETTERS = {
    "mass": ("m", "M"), "length": ("l", "L"), "centre": ("lc", "r"), "inertia": ("I", "J"), "damping": ("b", "c"),
    "stiffness": ("k",),
}  # fmt: skip


def usual_names(system: TreeSystem, found: list[Quantity]) -> dict[str, Quantity]:
    """The names that mean one number of the file and no other.

    m1: by the joint's number; m_pole: by the link's (or joint's) name; m alone: where one link has a mass. What is zero
    in the file has no letter alone.
    """
    named: dict[str, Quantity] = {}
    for kind, letters in LETTERS.items():
        those = [q for q in found if q.kind == kind]
        there = [q for q in those if q.value]
        for letter in letters:
            for q in those:
                of = "".join(c for c in q.of if c.isalnum())
                named.setdefault(f"{letter}{q.joint + 1}", q)
                if of and of.isascii():
                    named.setdefault(f"{letter}{of}", q)
            if len(there) == 1:
                named.setdefault(letter, there[0])
    return named
