"""An MJCF document as a whole: which sections are read, which act and are left out, and what engines are given."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ...spatial import Inertial
from ...spatial_mechanism import RigidBody
from ..attributes import Array
from ..rules import MjcfRules
from ..xml_file import Element
from .acting import left_out
from .actuators import Actuators
from .attach import read_document
from .bodies import Bodies
from .defaults import Defaults
from .inertials import Inertials, scaled_to_total_mass
from .notes import Notes
from .options import read_options
from .spring_dampers import with_spring_dampers

KEPT = ("compiler", "option", "default", "worldbody", "contact")  # what engines are given
READ = ("actuator", "asset", "equality", "tendon", "deformable", "extension")
OF_NO_EFFECT = ("sensor", "keyframe", "visual", "statistic", "custom", "size")


@dataclass(frozen=True)
class Mjcf:
    """An MJCF document as furiko understands it.

    ``root``: the elements that engines are given, without what acts besides bodies and joints; ``bodies``: parents
    first; ``gravity`` (3,) [m/s²] in the world; ``timestep`` [s]; ``attaches``: whether it has parts of others. The
    rest as :class:`furiko.models.readers.model_file.ModelFile` has it.
    """

    root: Element
    bodies: tuple[RigidBody, ...]
    gravity: Array
    integrator: str
    timestep: float
    notes: list[str]
    without: list[str]
    servos: list[tuple[str, str]]
    from_geoms: list[str]
    geoms: Mapping[str, Inertial]
    tensors: Mapping[str, tuple[Inertial, Array]]
    attaches: bool = False


def read_mjcf(root: Element, path: Path, rules: MjcfRules | None = None, others: Sequence[Path] = ()) -> Mjcf:
    """Understand the MJCF document of the file ``path``, whose includes are read; ``root`` is changed.

    ``rules``: mistakes that are made on purpose; ``others``: folders besides the file's own that files may be read
    from. Raises :class:`InvalidInput`.
    """
    rules = MjcfRules() if rules is None else rules
    notes = Notes()
    document = read_document(root, path, rules, others)
    root, source = document.root, document.source
    kept = Element("mujoco", dict(root.attributes), str(path), root.line)
    kept.children = [element for element in root.children if element.tag in KEPT]
    for element in root.children:
        if element.tag not in (*KEPT, *READ, *OF_NO_EFFECT):
            notes.strange(element)
    options = read_options(root.all("option"), rules)
    inertials = Inertials(notes)
    bodies = Bodies(source, options, inertials, notes)
    worlds = list(root.all("worldbody"))
    for world in worlds:
        bodies.read(worlds[0] if rules.first_worldbody_again else world)
    bodies.finish()
    actuators = Actuators({joint.name for body in bodies.bodies for joint in body.joints})
    actuators.read(root.all("actuator"), source.defaults)
    for beside in document.beside:
        actuators.read(beside.root.all("actuator"), beside.source.defaults, beside.prefix)
    read = scaled_to_total_mass(_with_actuators(bodies.bodies, actuators, rules, notes), source.compiler)
    roots = [(root, source.defaults), *((beside.root, beside.source.defaults) for beside in document.beside)]
    read = _with_springs(read, bodies, roots, rules)
    _write_joints(read, bodies, actuators)
    _clean_contacts(kept, {body.name for body in read})
    acting = left_out(roots, read, options, actuators, bodies.colliding)
    return Mjcf(
        root=kept,
        bodies=read,
        gravity=options.acting_gravity,
        integrator=options.integrator,
        timestep=options.timestep,
        notes=list(notes),
        without=acting + sorted(bodies.acting),
        servos=[] if "actuation" in options.disabled else actuators.servos,
        from_geoms=inertials.from_geoms,
        geoms=inertials.geoms,
        tensors=inertials.tensors,
        attaches=bool(document.beside),
    )


def _with_actuators(
    bodies: Sequence[RigidBody], actuators: Actuators, rules: MjcfRules, notes: Notes
) -> tuple[RigidBody, ...]:
    """The bodies, whose joints have the armature and damping that actuators add."""
    found = []
    for body in bodies:
        joints = []
        for joint in body.joints:
            armature = joint.armature + actuators.armature.get(joint.name, 0.0)
            damping = joint.damping + actuators.damping.get(joint.name, 0.0)
            if (armature, damping) != (joint.armature, joint.damping):
                notes.add(f"joint {joint.name!r} has armature or damping of its actuators besides its own")
            if rules.armature_needs_actuator and joint.name not in actuators.driven:
                armature = 0.0
            joints.append(replace(joint, armature=armature, damping=damping))
        found.append(replace(body, joints=tuple(joints)))
    return tuple(found)


def _with_springs(
    read: tuple[RigidBody, ...], bodies: Bodies, roots: Sequence[tuple[Element, Defaults]], rules: MjcfRules
) -> tuple[RigidBody, ...]:
    """The bodies with the springs that ``springdamper`` gives them."""
    if not bodies.springs or rules.springs_not_held or rules.springdamper_ignored:
        return read
    tendon = _with_armature(roots)
    if tendon is not None:
        raise tendon.wrong("armature: joints with springdamper would feel it, and it is not modelled")
    return with_spring_dampers(read, bodies.springs)


def _with_armature(roots: Sequence[tuple[Element, Defaults]]) -> Element | None:
    tendons = (tendon for root, _ in roots for section in root.all("tendon") for tendon in section.children)
    return next((tendon for tendon in tendons if "armature" in tendon.attributes), None)


def _write_joints(read: Sequence[RigidBody], bodies: Bodies, actuators: Actuators) -> None:
    """Write into the elements what a joint has from elsewhere: from its actuators, and from ``springdamper``."""
    for joint in (joint for body in read for joint in body.joints):
        element = bodies.elements.get(joint.name)
        if element is None or element.tag == "freejoint":
            continue
        if joint.name in bodies.springs:
            element.attributes["springdamper"] = "0 0"
            element.attributes["stiffness"] = repr(joint.stiffness)
        if actuators.armature.get(joint.name):
            element.attributes["armature"] = repr(joint.armature)
        if actuators.damping.get(joint.name) or joint.name in bodies.springs:
            element.attributes["damping"] = repr(joint.damping)


def _clean_contacts(kept: Element, bodies: set[str]) -> None:
    """Leave out what says of bodies and geoms that are not there under that name that they (do not) touch."""
    geoms: set[str] = set()
    pending = list(kept.all("worldbody"))
    while pending:
        element = pending.pop()
        geoms.update(child.get("name") for child in element.all("geom"))
        pending.extend(element.all("body", "frame"))
    for section in kept.all("contact"):
        section.children = [
            child
            for child in section.children
            if (child.tag == "exclude" and {child.get("body1"), child.get("body2")} <= bodies)
            or (child.tag == "pair" and {child.get("geom1"), child.get("geom2")} <= geoms - {""})
        ]
