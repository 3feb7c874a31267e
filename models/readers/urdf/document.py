"""A URDF document as a whole: its tree of links, what engines are given of it, and what is told about the rest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ...errors import InvalidInput
from ...spatial import Inertial
from ...spatial_mechanism import WORLD, Joint, RigidBody
from ..aligned import with_aligned
from ..attributes import Array
from ..placement import HERE, Placement
from ..rules import UrdfRules
from ..xml_file import Element
from .extension import Extension, gravity_of, read_extension, tell
from .folders import MeshFolders
from .inertials import Inertials, weighed_by_meshes
from .joints import placement, read_joints, rotor_inertias
from .notes import Notes
from .spaces import refuse_spaces
from .tree import Place, read_tree

GRAVITY = "URDF says nothing of gravity: 9.81 m/s² along −z is taken"
KEPT = ("parent", "child", "origin", "axis", "dynamics", "limit")  # of a joint, for engines


@dataclass
class Urdf:
    """A URDF file as furiko understands it.

    ``root``: the elements that engines are given; ``bodies``: parents first, depth first; ``gravity`` (3,) [m/s²],
    assumed, since URDF has none. The rest as :class:`furiko.models.readers.model_file.ModelFile` has it.
    """

    root: Element
    bodies: tuple[RigidBody, ...]
    gravity: Array
    notes: list[str]
    without: list[str]
    tensors: dict[str, tuple[Inertial, Array]] = field(default_factory=dict)
    continuous: list[str] = field(default_factory=list)
    timestep: float = 0.0
    integrator: str = ""


def read_urdf(root: Element, path: Path, rules: UrdfRules | None = None, meshes: Sequence[Path] = ()) -> Urdf:
    """Understand a URDF document of the file ``path``; ``root`` is changed. Raises :class:`InvalidInput`.

    ``rules``: mistakes that are made on purpose; ``meshes``: folders that meshes may be read from besides its own.
    """
    rules = UrdfRules() if rules is None else rules
    notes = Notes()
    notes.add(GRAVITY)
    if rules.space_behind_number_rejected:
        refuse_spaces(root)
    places = read_tree(root)
    notes.sections(root)
    tell(root, notes)
    extension = read_extension(root)
    acting = extension if rules.extension_honoured else Extension()
    inertials = Inertials(rules, acting, MeshFolders(path, meshes), notes)
    of_links = inertials.of_links(places)
    rotors = rotor_inertias(root) if rules.drake_rotor_counted else {}
    bodies: list[RigidBody] = []
    in_world: list[Placement | None] = []  # of the links that do not move
    for place, inertial in zip(places, of_links, strict=True):
        for element in (place.link, place.joint):
            if element is not None:
                notes.inside(element)
        body = _body(place, inertial, rules, notes, rotors)
        above = HERE if place.parent == WORLD else in_world[place.parent]
        moves = bool(body.joints) or above is None
        in_world.append(None if moves or above is None else above @ Placement(body.position, body.quaternion))
        bodies.append(_freed(body, above))
    if acting.align_free:
        bodies = with_aligned(bodies, _free(bodies))
    return Urdf(
        root=_for_engines(root, places, extension),
        bodies=tuple(bodies),
        gravity=gravity_of(acting),
        notes=notes.sentences(),
        without=_without(places, bodies),
        tensors=inertials.tensors,
        continuous=[
            place.joint.get("name")
            for place in places
            if place.joint is not None and place.joint.get("type") == "continuous"
        ],
        timestep=acting.timestep,
        integrator=acting.integrator,
    )


def _body(place: Place, inertial: Inertial, rules: UrdfRules, notes: Notes, rotors: dict[str, float]) -> RigidBody:
    joint, name, where = place.joint, place.link.get("name"), str(place.link)
    meshes = float(np.linalg.norm(inertial.tensor, 2)) if weighed_by_meshes(place.link, rules) else 0.0
    if joint is None:
        return RigidBody(name, WORLD, inertial=inertial, where=where, meshes=meshes)
    at = placement(joint)
    joints = read_joints(joint, rules, notes, rotors.get(joint.get("name"), 0.0))
    return RigidBody(name, place.parent, at.position, at.quaternion, joints, inertial, where, meshes)


def _freed(body: RigidBody, above: Placement | None) -> RigidBody:
    """The body, put on the world where it is free of what it hangs on, which does not move."""
    free: Joint | None = next((joint for joint in body.joints if joint.kind == "free"), None)
    if free is None:
        return body
    if above is None:
        raise InvalidInput(
            f"{free.where}: a floating joint on a link that moves: engines do not agree on what its coordinates are"
        )
    at = above @ Placement(body.position, body.quaternion)
    return replace(body, parent=WORLD, position=at.position, quaternion=at.quaternion)


def _free(bodies: Sequence[RigidBody]) -> list[int]:
    return [k for k, body in enumerate(bodies) if any(joint.kind == "free" for joint in body.joints)]


def _without(places: Sequence[Place], bodies: Sequence[RigidBody]) -> list[str]:
    joints = [joint for body in bodies for joint in body.joints]
    elements = [place.joint for place in places if place.joint is not None]
    acts = {
        "contacts": sum(place.link.first("collision") is not None for place in places) > 1,
        "joint limits": any(joint.limits is not None for joint in joints),
        "dry friction": any(joint.friction > 0 for joint in joints),
        "mimic (joints that follow another one)": any(joint.first("mimic") is not None for joint in elements),
    }
    return [what for what, does in acts.items() if does]


def _for_engines(root: Element, places: Sequence[Place], extension: Extension) -> Element:
    """The links' inertials and the joints alone, and of MuJoCo's extension what lets it accept a point mass."""
    kept = Element("robot", {"name": root.get("name") or "robot"}, root.file, root.line)
    bounds = {"boundinertia": extension.least_inertia, "boundmass": extension.least_mass}
    given = {name: repr(value) for name, value in bounds.items() if value > 0}
    if given:
        kept.children.append(Element("mujoco", {}, root.file, root.line, [Element("compiler", given)]))
    for place in places:
        children = [child for child in place.link.children if child.tag == "inertial"]
        kept.children.append(replace(place.link, children=children))
    for place in places:
        if place.joint is not None:
            children = [child for child in place.joint.children if child.tag in KEPT]
            kept.children.append(replace(place.joint, children=children))
    return kept
