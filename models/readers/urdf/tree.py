"""The links and joints of a URDF document, and the tree that they make up."""

from __future__ import annotations

from dataclasses import dataclass

from ...errors import InvalidInput
from ...projection import MOST_BODIES
from ..xml_file import Element

WORLD = "world"


@dataclass(frozen=True)
class Place:
    """A ``link`` in the tree: the ``joint`` above it, None for the root, and the index of its ``parent``, -1 there."""

    link: Element
    joint: Element | None
    parent: int


def read_tree(root: Element) -> list[Place]:
    """The links, parents before children, depth first, siblings in the order of their joints in the document.

    Raises :class:`InvalidInput` where links and joints do not form one tree.
    """
    links: dict[str, Element] = {}
    joints: dict[str, Element] = {}
    for element in root.children:
        if element.tag.startswith("xacro:"):
            raise element.wrong("xacro is not read; expand the file with the program xacro first")
        if element.tag in ("link", "joint"):
            _take(links if element.tag == "link" else joints, element)
    if len(links) > MOST_BODIES:
        raise root.wrong(f"{len(links)} links; at most {MOST_BODIES} are read")
    if not links:
        raise root.wrong("no links; at least one must hang from the support")
    below = _children(links, joints)
    return _walk(root, links, joints, below)


def end(joint: Element, role: str) -> str:
    """The link that a joint names as its ``parent`` or ``child``."""
    element = joint.first(role)
    return "" if element is None else element.get("link")


def _take(known: dict[str, Element], element: Element) -> None:
    name = element.get("name")
    if not name:
        raise element.wrong("name: every link and joint needs one")
    if name in known:
        raise element.wrong(f"a second {element.tag} called {name[:60]!r}; names must be unique")
    known[name] = element


def _children(links: dict[str, Element], joints: dict[str, Element]) -> dict[str, list[str]]:
    """The joints on each link by its name; under "" the root link."""
    below: dict[str, list[str]] = {name: [] for name in links}
    joint_above: dict[str, str] = {}
    for name, joint in joints.items():
        if end(joint, "parent") == WORLD and WORLD not in links:  # Drake's way
            links[WORLD] = Element("link", {"name": WORLD}, joint.file, joint.line)
            below[WORLD] = []
        for role in ("parent", "child"):
            if end(joint, role) not in links:
                raise joint.wrong(f"{role} link={end(joint, role)[:60]!r}: no such link")
        child = end(joint, "child")
        if child in joint_above:
            raise joint.wrong(f"link {child[:60]!r} is the child of {joint_above[child][:60]!r} too: not a tree")
        joint_above[child] = name
        below[end(joint, "parent")].append(name)
    roots = [name for name in links if name not in joint_above]
    if len(roots) != 1:
        first = next(iter(joints.values()), None) or next(iter(links.values()))
        what = "the joints form a loop" if not roots else f"{len(roots)} links have no parent: {', '.join(roots)[:120]}"
        raise InvalidInput(f"{first.file}: {what}; one link, the support, must carry all the others")
    below[""] = roots
    return below


def _walk(
    root: Element, links: dict[str, Element], joints: dict[str, Element], below: dict[str, list[str]]
) -> list[Place]:
    support = below[""][0]
    places = [Place(links[support], None, -1)]
    pending = [(name, 0) for name in reversed(below[support])]
    while pending:
        name, parent = pending.pop()
        child = end(joints[name], "child")
        places.append(Place(links[child], joints[name], parent))
        pending.extend((lower, len(places) - 1) for lower in reversed(below[child]))
    if len(places) != len(links):
        raise InvalidInput(f"{root.file}: the joints form a loop; they must form a tree")
    return places
