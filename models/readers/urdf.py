"""URDF: links, revolute, continuous and fixed joints, inertials with their rotation, damping and friction."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ..errors import InvalidInput
from ..projection import MOST_BODIES, Body, SpatialHinge
from ..spatial import IDENTITY, ZERO_INERTIAL, Inertial, Pose, from_roll_pitch_yaw, symmetric
from .attributes import Array, axis, not_negative, number, numbers, refuse, word
from .xml_file import Element

JOINTS = ("revolute", "continuous", "fixed", "prismatic", "floating", "planar", "spherical")
WORLD = "world"
LEFT_OUT = ("material", "transmission", "gazebo", "mujoco", "ros2_control", "drake:diagram")
SIX = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")


@dataclass
class Urdf:
    """A URDF file as furiko understands it.

    ``root``: the elements that engines are given; ``bodies``: parents first; ``gravity`` (3,) [m/s²], assumed, since
    URDF has none; ``tensors``: by link, its inertial before its rotation, and that rotation (3, 3); ``continuous``:
    joints of that type.
    """

    root: Element
    bodies: list[Body]
    gravity: Array
    notes: list[str] = field(default_factory=list)
    tensors: dict[str, tuple[Inertial, Array]] = field(default_factory=dict)
    continuous: list[str] = field(default_factory=list)


def read_urdf(root: Element) -> Urdf:
    """Understand a URDF document. Raises :class:`InvalidInput` naming the element that is wrong."""
    kept = Element("robot", {"name": root.get("name") or "robot"}, root.file, root.line)
    file = Urdf(kept, [], np.array([0.0, 0.0, -9.81]))
    file.notes.append("URDF says nothing of gravity: 9.81 m/s² along −z is taken")
    links: dict[str, Element] = {}
    joints: dict[str, Element] = {}
    for element in root.children:
        if element.tag.startswith("xacro:"):
            raise element.wrong("xacro is not read; expand the file with the program xacro first")
        if element.tag in ("link", "joint"):
            _take(links if element.tag == "link" else joints, element)
        elif element.tag not in LEFT_OUT and ":" not in element.tag:
            raise element.wrong(f"<{element.tag}> is not known in URDF; remove it")
    for name, value in _extension(root).items():
        kept.children.append(Element("mujoco", {}, root.file, root.line, [Element("compiler", {name: value})]))
    if len(links) > MOST_BODIES:
        raise root.wrong(f"{len(links)} links; at most {MOST_BODIES} are read")
    if not links:
        raise root.wrong("no links; at least one must hang from the support")
    below = _children(links, joints)
    _read(file, links, joints, below)
    kept.children += links.values()
    kept.children += joints.values()
    return file


def _extension(root: Element) -> dict[str, str]:
    """The attributes of MuJoCo's own extension that let it accept a point mass."""
    found: dict[str, str] = {}
    for extension in root.all("mujoco"):
        for compiler in extension.all("compiler"):
            for name in ("boundinertia", "boundmass"):
                if name in compiler.attributes:
                    not_negative(compiler, name)
                    found[name] = compiler.attributes[name]
    return found


def _take(known: dict[str, Element], element: Element) -> None:
    name = element.get("name")
    if not name:
        raise element.wrong("name: every link and joint needs one")
    if name in known:
        raise element.wrong(f"a second {element.tag} called {name[:60]!r}; names must be unique")
    known[name] = element


def _children(links: dict[str, Element], joints: dict[str, Element]) -> dict[str, list[str]]:
    """The joints on each link by its name; under "" the root link. Refuses joints that do not form one tree."""
    below: dict[str, list[str]] = {name: [] for name in links}
    joint_above: dict[str, str] = {}
    for name, joint in joints.items():
        ends = {}
        for role in ("parent", "child"):
            end = joint.first(role)
            link = "" if end is None else end.get("link")
            if role == "parent" and link == WORLD and WORLD not in links:
                links[WORLD] = Element("link", {"name": WORLD}, joint.file, joint.line)
                below[WORLD] = []
            if link not in links:
                raise joint.wrong(f"{role} link={link[:60]!r}: no such link")
            ends[role] = link
        if ends["child"] in joint_above:
            raise refuse(
                joint,
                f"link {ends['child'][:60]!r} is the child of {joint_above[ends['child']][:60]!r} too",
            )
        joint_above[ends["child"]] = name
        below[ends["parent"]].append(name)
    roots = [name for name in links if name not in joint_above]
    if len(roots) != 1:
        first = next(iter(joints.values()), None) or next(iter(links.values()), None)
        what = "the joints form a loop" if not roots else f"{len(roots)} links have no parent: {', '.join(roots)[:120]}"
        where = first.file if first is not None else "the file"
        raise InvalidInput(f"{where}: {what}; one link, the support, must carry all the others")
    below[""] = roots
    return below


def _read(file: Urdf, links: dict[str, Element], joints: dict[str, Element], below: dict[str, list[str]]) -> None:
    """Read the bodies, parents first and siblings in the file's order."""
    root = below[""][0]
    file.bodies.append(Body(root, -1, IDENTITY, (), _inertial(file, links[root]), str(links[root])))
    pending = [(name, 0) for name in reversed(below[root])]
    reached = 1
    while pending:
        name, parent = pending.pop()
        joint = joints[name]
        child = joint.first("child")
        link = links[child.get("link") if child is not None else ""]
        pose = _origin(joint)
        hinges = _hinges(file, joint)
        file.bodies.append(Body(link.get("name"), parent, pose, hinges, _inertial(file, link), str(link)))
        index = len(file.bodies) - 1
        reached += 1
        pending.extend((lower, index) for lower in reversed(below[link.get("name")]))
    if reached != len(links):
        raise InvalidInput(f"{file.root.file}: the joints form a loop; they must form a tree")
    for link in links.values():
        link.children = [child for child in link.children if child.tag == "inertial"]
    for joint in joints.values():
        kept = ("parent", "child", "origin", "axis", "dynamics", "limit")
        joint.children = [child for child in joint.children if child.tag in kept]


def _hinges(file: Urdf, joint: Element) -> tuple[SpatialHinge, ...]:
    kind = word(joint, "type", JOINTS, "")
    if kind == "fixed":
        return ()
    if kind not in ("revolute", "continuous"):
        raise refuse(joint, f"a joint of type {kind!r}")
    if joint.first("mimic") is not None:
        raise refuse(joint, "mimic: a joint that another one moves")
    if kind == "continuous":
        file.continuous.append(joint.get("name"))
    dynamics = joint.first("dynamics") or Element("dynamics", {})
    direction = joint.first("axis")
    along = np.array([1.0, 0.0, 0.0]) if direction is None else axis(direction, "xyz", (1.0, 0.0, 0.0))
    return (
        SpatialHinge(
            name=joint.get("name"),
            axis=along,
            anchor=np.zeros(3),
            damping=not_negative(dynamics, "damping"),
            friction=not_negative(dynamics, "friction"),
            limits=_limits(joint, kind),
            where=str(joint),
        ),
    )


def _limits(joint: Element, kind: str) -> tuple[float, float] | None:
    limit = joint.first("limit")
    if kind == "continuous":
        return None
    if limit is None:
        raise joint.wrong(
            "a revolute joint needs <limit lower= upper= effort= velocity=>; without limits it is continuous"
        )
    low, high = number(limit, "lower"), number(limit, "upper")
    if low > high:
        raise limit.wrong("lower is above upper")
    return low, high


def _origin(element: Element) -> Pose:
    origin = element.first("origin")
    if origin is None:
        return IDENTITY
    angles = numbers(origin, "rpy", 3, (0.0, 0.0, 0.0))
    if (np.abs(angles) > 1e6).any():
        raise origin.wrong(f"rpy={origin.get('rpy')!r}: angles in radians are needed")
    translation = numbers(origin, "xyz", 3, (0.0, 0.0, 0.0))
    return Pose(from_roll_pitch_yaw(angles) if angles.any() else np.eye(3), translation)


def _inertial(file: Urdf, link: Element) -> Inertial:
    given = link.first("inertial")
    if given is None:
        return ZERO_INERTIAL
    mass_element, moments = given.first("mass"), given.first("inertia")
    if mass_element is None or "value" not in mass_element.attributes:
        raise given.wrong("<mass value=> is needed")
    mass = not_negative(mass_element, "value")
    missing = [name for name in SIX if moments is None or name not in moments.attributes]
    if moments is None or missing:
        raise given.wrong(f"<inertia {' '.join(f'{name}=' for name in SIX)}> is needed, {', '.join(missing)} missing")
    tensor = symmetric(*(number(moments, name) for name in SIX))
    least = float(np.linalg.eigvalsh(tensor)[0])
    if least < -1e-9 * abs(float(np.trace(tensor))) or math.isnan(least):
        raise given.wrong("inertia: no body has an inertia with a negative principal moment")
    pose = _origin(given)
    file.tensors[link.get("name")] = (Inertial(mass, pose.translation, tensor), pose.rotation)
    return Inertial(mass, np.zeros(3), tensor).transformed(pose)
