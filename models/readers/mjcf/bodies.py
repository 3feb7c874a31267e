"""The tree of MJCF bodies and their joints, walked from the world down, parents first, in the document's order."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import count

import numpy as np

from ...projection import MOST_BODIES
from ...spatial import ZERO_INERTIAL, Inertial
from ...spatial_mechanism import WORLD, Joint, RigidBody
from ..aligned import with_aligned
from ..attributes import number, word
from ..placement import HERE, Placement
from ..xml_file import Element
from .attach import Attached, Source
from .defaults import strip
from .frames import placement_of
from .geoms import collides
from .inertials import Inertials, PlacedGeom
from .joints import read_joint, spring_damper
from .notes import Notes
from .options import Options

SEEN_THROUGH = ("frame", "attached")
KEPT = ("geom", "inertial", "joint", "freejoint", "body", *SEEN_THROUGH)  # inside a body
MESHES_LEFT_OUT = "geoms that are meshes do not collide in the text that furiko makes of a planar file for engines"
LEFT_OUT = ("site", "camera", "light")
REFUSED = {
    "composite": "it stands for bodies and joints that only MuJoCo makes; write them out",
    "flexcomp": "a body that bends is not a tree of rigid bodies",
}


@dataclass(frozen=True)
class Place:
    """An element of a body: ``element`` itself, the body or frame that holds it, where its frames are in the body, the
    class of what is inside that names none, and how its document is read."""

    element: Element
    holder: Element
    frame: Placement
    childclass: str
    source: Source


@dataclass(frozen=True)
class Pending:
    """A body that is still to be read. ``called``: what a reader calls it that names bodies by their parent's name."""

    element: Element
    parent: int
    frame: Placement
    childclass: str
    source: Source
    above: str


@dataclass
class Bodies:
    """Reads every ``<worldbody>`` of a document into ``bodies``, and strips the elements of what has no effect.

    ``springs``: by joint, what ``springdamper`` gives; ``elements``: by joint, its element. ``acting``: sentences on
    what acts on bodies and is left out; ``colliding``: how many geoms may touch others.
    """

    source: Source
    options: Options
    inertials: Inertials
    notes: Notes
    bodies: list[RigidBody] = field(default_factory=list)
    springs: dict[str, tuple[float, float]] = field(default_factory=dict)
    elements: dict[str, Element] = field(default_factory=dict)
    acting: set[str] = field(default_factory=set)
    colliding: int = 0
    _names: dict[str, set[str]] = field(default_factory=dict)
    _first: dict[str, int] = field(default_factory=dict)  # by what a reader calls it that names by the parent's name
    _once: dict[int, Inertial] = field(default_factory=dict)  # the inertial of a body, however often it is read
    _aligned: dict[int, Element] = field(default_factory=dict)  # by body, its free joint that asks for it
    _fuses: bool = False  # whether a body asks to be made one with the one that carries it
    _roots: int = 0
    _worlds: int = 0  # read so far, and this one

    def read(self, world: Element) -> None:
        """Add the bodies of a ``<worldbody>``. Raises :class:`InvalidInput`."""
        self._worlds += 1
        childclass = world.get("childclass", "main")
        pending: list[Pending] = []
        for place in reversed(list(self._contents(world, childclass, self.source))):
            if place.element.tag in ("joint", "freejoint", "inertial"):
                raise place.element.wrong("in the world, which does not move")
            if place.element.tag == "geom":
                self._world_geom(place)
            elif place.element.tag == "body":
                pending.append(Pending(place.element, WORLD, place.frame, place.childclass, place.source, ""))
        rules = self.source.compiler.rules
        if rules.first_root_only:
            pending = pending[-1:] if not self._roots or rules.first_worldbody_again else []
        self._roots += len(pending)
        while pending:
            pending.extend(reversed(self._body(pending.pop())))

    def finish(self) -> None:
        """Do what depends on whether a body carries others."""
        if not self.source.compiler.rules.align_ignored:
            self._refuse_fused()
            self.bodies = with_aligned(self.bodies, list(self._aligned), self.inertials.axes, self.notes.add)

    def _refuse_fused(self) -> None:
        """A free body that is aligned only if all that it carries is fused with it, which much else decides."""
        joints = [bool(body.joints) for body in self.bodies]
        for index, joint in self._aligned.items():
            carried = [k for k, body in enumerate(self.bodies) if k > index and self._carries(index, body)]
            if carried and not any(joints[k] for k in carried) and (self._fuses or self.source.compiler.fuses):
                raise joint.wrong(
                    "align beside fusestatic: whether the body is aligned depends on whether what is fixed to it is "
                    "made one with it; write these as one body, or align='false'"
                )

    def _carries(self, index: int, body: RigidBody) -> bool:
        while body.parent > index:
            body = self.bodies[body.parent]
        return body.parent == index

    def _contents(self, element: Element, childclass: str, source: Source) -> Iterator[Place]:
        """What is in a body, in the document's order; frames and what is attached are seen through. Strips what has no
        effect."""
        pending = [Place(element, element, HERE, childclass, source)]
        while pending:
            at = pending.pop()
            if at.element is not element:
                if at.element.tag not in SEEN_THROUGH:
                    yield at
                    continue
                if at.element.tag == "frame":
                    self.notes.unknown(at.element)
            holder = at.element
            for child in holder.children:
                if child.tag in REFUSED:
                    raise child.wrong(f"<{child.tag}>: {REFUSED[child.tag]}")
                if child.tag == "plugin":
                    self.acting.add("plugins")
                elif child.tag not in (*KEPT, *LEFT_OUT):
                    self.notes.strange(child)
            holder.children = [child for child in holder.children if child.tag in KEPT]
            inside = [place for child in holder.children if (place := self._inside(child, at)) is not None]
            pending.extend(reversed(inside))

    def _inside(self, child: Element, at: Place) -> Place | None:
        """A child of what is seen through; None where a reader does not see it."""
        if isinstance(child, Attached):
            return Place(child, at.element, at.frame, child.childclass, child.source)
        if child.tag != "frame":
            return Place(child, at.element, at.frame, at.childclass, at.source)
        compiler, defaults = at.source.compiler, at.source.defaults
        if compiler.rules.frame_ignored:
            return None
        childclass = child.get("childclass", at.childclass)
        defaults.require(child, childclass, "childclass")
        return Place(child, at.element, at.frame @ placement_of(child, compiler), childclass, at.source)

    def _world_geom(self, place: Place) -> None:
        full = place.source.defaults.applied(place.element, place.childclass)
        self.colliding += collides(full)
        strip(place.element)
        if full.get("type", "sphere") in ("mesh", "hfield", "sdf") or full.get("mesh"):
            place.holder.children = [child for child in place.holder.children if child is not place.element]

    def _body(self, at: Pending) -> list[Pending]:
        """Read one body; the bodies that it carries come back."""
        element, rules = at.element, at.source.compiler.rules
        self.notes.unknown(element)
        childclass = element.get("childclass", at.childclass)
        at.source.defaults.require(element, childclass, "childclass")
        inside = list(self._contents(element, childclass, at.source))
        children = [place for place in inside if place.element.tag == "body"]
        if rules.bare_bodies_lost and not element.attributes:
            return [
                Pending(place.element, WORLD, place.frame, place.childclass, place.source, "") for place in children
            ]
        called = element.get("name") or f"{at.above}Bis"
        index = first = self._add(at, inside, childclass)
        known = self._first.setdefault(called, index)
        if rules.unnamed_sibling_twice or (rules.first_worldbody_again and self._worlds > 1):
            first = known
        if first == index:
            self._once[index] = self.bodies[index].inertial
        else:
            self._read_again(first, index)
        return [
            Pending(place.element, first, place.frame, place.childclass, place.source, called) for place in children
        ]

    def _add(self, at: Pending, inside: list[Place], childclass: str) -> int:
        element, compiler = at.element, at.source.compiler
        rules = compiler.rules
        name = self._named(element, "body")
        if len(self.bodies) >= MOST_BODIES:
            raise element.wrong(f"more than {MOST_BODIES} bodies")
        placement = placement_of(element, compiler)
        self._fuses |= element.get("fuse", "false") != "false"
        joints = [self._joint(place, at.parent) for place in inside if place.element.tag in ("joint", "freejoint")]
        self._acts_on(element, at.parent, bool(joints))
        inertials = (place for place in inside if place.element.tag == "inertial")
        given = next(((place.element, place.frame, place.source) for place in inertials), None)
        if given is not None:
            self.notes.unknown(given[0])
        geoms = self._geoms(inside)
        inertial = self.inertials.of_body(name, placement.position, compiler, given, geoms)
        self._strip(geoms)
        placement = at.frame @ placement
        if rules.pose_of_first_fixed_body_dropped and not self.bodies and not joints:
            placement = HERE
        if rules.first_ref_ignored and len(joints) > 1:
            joints[0] = replace(joints[0], ref=0.0)
        if rules.pos_of_last_joint_for_all:
            joints = [*(_before_the_pose(joint, placement) for joint in joints[:-1]), *joints[-1:]]
        at_parent = (at.parent, placement.position, placement.quaternion)
        meshes = self.inertials.meshes.get(name, 0.0)
        self.bodies.append(RigidBody(name, *at_parent, tuple(joints), inertial, str(element), meshes))
        return len(self.bodies) - 1

    def _read_again(self, first: int, index: int) -> None:
        """Have the body ``index`` be the ``first`` again, whose inertial grows by as much, as one reader has it.

        That reader looks a joint up by its name to give it armature, and finds the first of that name each time.
        """
        master, again = self.bodies[first], self.bodies[index]
        own = again.joints + tuple(replace(j, name=f"{j.name} of {again.name}") for j in master.joints)
        joints = tuple(replace(j, name=other.name, armature=0.0) for j, other in zip(master.joints, own, strict=False))
        self.bodies[index] = replace(master, name=again.name, joints=joints, inertial=ZERO_INERTIAL)
        if joints:  # what is fixed weighs once, however often it is read
            self.bodies[first] = replace(master, inertial=master.inertial + self._once[first])

    def _acts_on(self, element: Element, parent: int, moves: bool) -> None:
        if word(element, "mocap", ("true", "false"), "false") == "true":
            if parent != WORLD or moves:
                raise element.wrong("mocap: only a body of the world without joints can be moved from outside")
            self.acting.add("mocap bodies, which stay where the file has them")
        if number(element, "gravcomp") != 0:
            self.acting.add("gravity compensation (gravcomp)")
        for name in ("mocap", "gravcomp"):
            element.attributes.pop(name, None)

    def _geoms(self, inside: list[Place]) -> list[PlacedGeom]:
        found = []
        for place in inside:
            if place.element.tag == "geom":
                full = place.source.defaults.applied(place.element, place.childclass)
                self.colliding += collides(full)
                found.append(PlacedGeom(place.element, full, place.frame, place.holder, place.source))
        return found

    def _strip(self, geoms: list[PlacedGeom]) -> None:
        for geom in geoms:
            strip(geom.given)
            if geom.from_file:
                geom.holder.children = [child for child in geom.holder.children if child is not geom.given]
                self.notes.add(MESHES_LEFT_OUT)

    def _named(self, element: Element, kind: str) -> str:
        """The element's name, given one where it has none, so that engines can be asked for it."""
        taken = self._names.setdefault(kind, set())
        name = element.get("name") or f"furiko_{kind}_{len(taken) + 1}"
        if name in taken and self.source.compiler.rules.first_worldbody_again:
            name = next(again for k in count(2) if (again := f"{name} ({k})") not in taken)  # as engines show it
            taken.add(name)
            return name
        if name in taken:
            raise element.wrong(f"a second {kind} called {name[:60]!r}; names must be unique")
        taken.add(name)
        element.unnamed |= not element.get("name")
        element.attributes["name"] = name
        return name

    def _joint(self, place: Place, parent: int) -> Joint:
        given = place.element
        self.notes.unknown(given)
        compiler, defaults = place.source.compiler, place.source.defaults
        full = given if given.tag == "freejoint" else defaults.applied(given, place.childclass)
        name = self._named(given, "joint")
        joint = replace(read_joint(full, given, place.frame, compiler, self.options), name=name)
        if joint.kind == "free" and parent != WORLD:
            raise given.wrong("a free joint on a body that another one carries")
        self.elements[name] = given
        found = spring_damper(full)
        if found is not None:
            self.springs[name] = found
        if joint.kind == "free":
            aligned = word(given, "align", ("true", "false", "auto"), "auto")
            if aligned == "true" or (aligned == "auto" and compiler.align_free):
                self._aligned[len(self.bodies)] = given
        return joint


def _before_the_pose(joint: Joint, placement: Placement) -> Joint:
    """The joint in its body's frame, where its numbers are meant in the frame that the body's ``placement`` is in."""
    pose = placement.pose
    axis = np.asarray(pose.rotation.T @ joint.axis)
    return replace(joint, axis=axis, anchor=np.asarray(pose.rotation.T @ (joint.anchor - pose.translation)))
