"""An MJCF document as a whole: which sections are read, which are left out, and which are refused.

An element that the reader does not know is refused by name. Elements that cannot matter to a pendulum (cameras,
sensors, actuators without control) are left out of the text that engines are given.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ...projection import Body
from ...spatial import Inertial, to_quaternion
from ...spatial_mechanism import Joint, RigidBody
from ..attributes import Array, refuse
from ..xml_file import Element
from .bodies import Bodies
from .defaults import Defaults
from .includes import with_includes
from .inertials import Inertials, scaled_to_total_mass
from .options import Compiler, read_options

LEFT_OUT = ("actuator", "sensor", "keyframe", "visual", "statistic", "asset", "custom", "size")
KEPT = ("compiler", "option", "default", "worldbody", "contact")
TENDON_FORCES = ("stiffness", "damping", "frictionloss", "range", "limited")


@dataclass(frozen=True)
class Mjcf:
    """An MJCF document as furiko understands it.

    ``root``: the elements that engines are given; ``bodies``: parents first; ``gravity`` (3,) [m/s²] in the world;
    ``timestep`` [s]. The rest as :class:`furiko.models.readers.model_file.ModelFile` has it.
    """

    root: Element
    bodies: tuple[RigidBody, ...]
    gravity: Array
    integrator: str
    timestep: float
    notes: list[str]
    without: list[str]
    from_geoms: list[str]
    geoms: Mapping[str, Inertial]
    tensors: Mapping[str, tuple[Inertial, Array]]


def read_mjcf(root: Element, path: Path) -> Mjcf:
    """Understand the MJCF document of the file ``path``, whose includes are read. Raises :class:`InvalidInput`."""
    root = with_includes(root, path)
    kept = Element("mujoco", dict(root.attributes), str(path), root.line)
    compiler, defaults = Compiler(), Defaults()
    inertials = Inertials(compiler, defaults)
    _choose_sections(root, kept, inertials.notes)
    for element in root.all("compiler"):
        compiler.read(element)
    for element in root.all("default"):
        defaults.read(element)
    options = read_options(root.all("option"))
    bodies = Bodies(compiler, defaults, options, inertials)
    for world in root.all("worldbody"):
        bodies.read(world)
    return Mjcf(
        root=kept,
        bodies=tuple(map(_rigid, scaled_to_total_mass(bodies.bodies, compiler))),
        gravity=options.acting_gravity,
        integrator=options.integrator,
        timestep=options.timestep,
        notes=inertials.notes,
        without=[],
        from_geoms=inertials.from_geoms,
        geoms=inertials.geoms,
        tensors=inertials.tensors,
    )


def _choose_sections(root: Element, kept: Element, notes: list[str]) -> None:
    """Keep the sections that the motion depends on, leave out those it does not depend on, refuse the rest."""
    for element in root.children:
        if element.tag == "equality":
            for constraint in element.children:
                if constraint.get("active") != "false":
                    raise refuse(constraint, "a constraint besides the hinges")
        elif element.tag == "tendon":
            for tendon in element.children:
                if any(name in tendon.attributes for name in TENDON_FORCES):
                    raise refuse(tendon, "a tendon that pulls")
        elif element.tag in KEPT:
            kept.children.append(element)
        elif element.tag not in LEFT_OUT:
            raise element.wrong(f"<{element.tag}> is not supported; remove it")
        if element.tag == "actuator" and element.children:
            notes.append("actuators are left out: nothing is driven")


def _rigid(body: Body) -> RigidBody:
    joints = tuple(
        Joint(
            name=hinge.name,
            axis=hinge.axis,
            anchor=hinge.anchor,
            ref=hinge.zero,
            armature=hinge.armature,
            damping=hinge.damping,
            friction=hinge.friction,
            stiffness=hinge.stiffness,
            springref=hinge.rest + hinge.zero,
            limits=None if hinge.limits is None else (hinge.limits[0] + hinge.zero, hinge.limits[1] + hinge.zero),
            where=hinge.where,
        )
        for hinge in body.hinges
    )
    turned = to_quaternion(body.pose.rotation)
    return RigidBody(body.name, body.parent, body.pose.translation, turned, joints, body.inertial, body.where)
