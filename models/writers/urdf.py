"""Writes a planar tree as URDF."""

from __future__ import annotations

from xml.etree import ElementTree

from ..systems import System
from ..tree import SUPPORT, PlanarTree
from .mjcf import LEAST_INERTIA, point

# A free hinge would be "continuous", which has two coordinates in Pinocchio (cos, sin); "revolute" has one, and needs
# limits: these are beyond any angle, rate or torque that is ever reached.
NO_LIMIT = repr(1e30)


def to_urdf(system: System) -> str:
    """The mechanism as a URDF document.

    Conventions as in :func:`furiko.models.writers.mjcf.to_mjcf`. URDF has no gravity: it must be set in the engine.
    Names are zero-padded, since some readers order children by name.
    """
    return write_urdf(system.tree(), system.kind)


def write_urdf(tree: PlanarTree, name: str) -> str:
    """A planar tree as a URDF document whose robot is called ``name``."""
    robot = ElementTree.Element("robot", name=name)
    if any(link.inertia == 0 for link in tree.links):
        # For MuJoCo's own URDF reader alone, which refuses a point mass; every other reader ignores this element.
        extension = ElementTree.SubElement(robot, "mujoco")
        ElementTree.SubElement(extension, "compiler", boundinertia=repr(LEAST_INERTIA), balanceinertia="false")
    ElementTree.SubElement(robot, "link", name="world")
    link_names = tree.names("link")
    for link, link_name, hinge_name in zip(tree.links, link_names, tree.names("hinge"), strict=True):
        _link(robot, link_name, link.length, point(link.com), link.mass, link.inertia)
        parent = "world" if link.parent == SUPPORT else link_names[link.parent]
        joint = ElementTree.SubElement(robot, "joint", name=hinge_name, type="revolute")
        ElementTree.SubElement(joint, "parent", link=parent)
        ElementTree.SubElement(joint, "child", link=link_name)
        ElementTree.SubElement(joint, "origin", xyz=point(link.hinge), rpy="0 0 0")
        ElementTree.SubElement(joint, "axis", xyz="0 -1 0")
        ElementTree.SubElement(joint, "limit", lower="-" + NO_LIMIT, upper=NO_LIMIT, effort=NO_LIMIT, velocity=NO_LIMIT)
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode") + "\n"


def _link(robot: ElementTree.Element, name: str, length: float, com: str, mass: float, inertia: float) -> None:
    element = ElementTree.SubElement(robot, "link", name=name)
    inertial = ElementTree.SubElement(element, "inertial")
    ElementTree.SubElement(inertial, "origin", xyz=com, rpy="0 0 0")
    ElementTree.SubElement(inertial, "mass", value=repr(mass))
    # Only iyy, about the hinge axis, takes part in planar motion.
    moments = {"ixx": repr(inertia), "iyy": repr(inertia), "izz": repr(inertia)}
    ElementTree.SubElement(inertial, "inertia", moments, ixy="0", ixz="0", iyz="0")
    visual = ElementTree.SubElement(element, "visual")
    ElementTree.SubElement(visual, "origin", xyz=f"0 0 {-length / 2!r}", rpy="0 0 0")
    geometry = ElementTree.SubElement(visual, "geometry")
    ElementTree.SubElement(geometry, "cylinder", radius=repr(length / 40), length=repr(length))
