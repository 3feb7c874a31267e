"""Writes a planar tree as MJCF, MuJoCo's model format."""

from __future__ import annotations

from xml.etree import ElementTree

from ..errors import InvalidInput
from ..systems import System
from ..tree import SUPPORT, PlanarTree

# The smallest principal moment of inertia that MuJoCo's compiler accepts [kg m²]. A point mass has none: the compiler
# raises it to this (``boundinertia``), and an adapter that can sets it back to zero in the compiled model.
LEAST_INERTIA = 1e-15
# MJCF nests a body in its parent, and TinyXML-2, which MuJoCo reads it with, fails beyond 500 levels.
DEEPEST = 450


def to_mjcf(system: System) -> str:
    """The mechanism as an MJCF document.

    Up is +z, the plane x-z, every hinge turns about (0, -1, 0), so that a positive angle moves the bob to +x. Joint
    coordinates are relative: each hinge's angle is the link's absolute angle less its parent's. Inertials are explicit
    and numbers exact (``repr``). Geoms are for display: they have no mass and do not collide. Raises
    :class:`InvalidInput` for more than 450 links one after the other.
    """
    return write_mjcf(system.tree(), system.kind)


def write_mjcf(tree: PlanarTree, model: str) -> str:
    """A planar tree as an MJCF document whose model is called ``model``; see :func:`to_mjcf`."""
    if tree.depth > DEEPEST:
        raise InvalidInput(f"a chain of {tree.depth} links: MJCF nests them, and its readers take at most {DEEPEST}")
    root = ElementTree.Element("mujoco", model=model)
    point_masses = any(link.inertia == 0 for link in tree.links)
    compiler = ElementTree.SubElement(
        root, "compiler", angle="radian", inertiafromgeom="false", balanceinertia="false", autolimits="false"
    )
    if point_masses:
        compiler.set("boundinertia", repr(LEAST_INERTIA))
    option = ElementTree.SubElement(root, "option", gravity=f"0 0 {-tree.gravity!r}")
    ElementTree.SubElement(option, "flag", constraint="disable", energy="enable", autoreset="disable")
    world = ElementTree.SubElement(root, "worldbody")
    ElementTree.SubElement(world, "light", pos="0 -3 3", dir="0 1 -1")
    bodies = {SUPPORT: world}
    for i, (link, body_name, hinge_name) in enumerate(
        zip(tree.links, tree.names("link"), tree.names("hinge"), strict=True)
    ):
        body = ElementTree.SubElement(bodies[link.parent], "body", name=body_name, pos=point(link.hinge))
        ElementTree.SubElement(body, "joint", name=hinge_name, type="hinge", axis="0 -1 0")
        ElementTree.SubElement(
            body,
            "inertial",
            pos=point(link.com),
            mass=repr(link.mass),
            # Only the middle one, about the hinge axis, takes part in planar motion.
            diaginertia=" ".join([repr(link.inertia)] * 3),
        )
        _draw(body, link.length, link.com if link.inertia == 0 else None)
        bodies[i] = body
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def point(along_across: tuple[float, float]) -> str:
    """The point (along, across) [m] of a link's frame as the text ``x y z`` of its body's frame."""
    along, across = along_across
    return f"{across!r} 0 {0.0 - along!r}"


def _draw(body: ElementTree.Element, length: float, bob: tuple[float, float] | None) -> None:
    display_only = {"contype": "0", "conaffinity": "0", "mass": "0", "group": "1"}
    ElementTree.SubElement(
        body,
        "geom",
        display_only,
        type="capsule",  # not by its ends: MuJoCo refuses those nearer than 1e-7 m to each other
        pos=point((length / 2, 0.0)),
        size=f"{length / 40!r} {length / 2!r}",
        rgba="0.45 0.5 0.6 1",
    )
    if bob is not None:
        ElementTree.SubElement(
            body,
            "geom",
            display_only,
            type="sphere",
            pos=point(bob),
            size=repr(length / 12),
            rgba="0.85 0.35 0.2 1",
        )
