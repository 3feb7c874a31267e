"""What a URDF document says that is passed over: tags and attributes that URDF does not have where they stand.

Nothing inside a link, joint or inertial is dropped in silence: a damping in the wrong place is read by no engine.
"""

from __future__ import annotations

from ..xml_file import Element

MOST_NOTES = 40
TOP = (
    "link",
    "joint",
    "material",
    "transmission",
    "gazebo",
    "mujoco",
    "ros2_control",
    "sensor",
    "frame",
    "group_state",
)
# By tag: the attributes and the children that the format has there; None for what is not looked into.
KNOWN: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "joint": (
        ("name", "type"),
        ("parent", "child", "origin", "axis", "limit", "dynamics", "mimic", "calibration", "safety_controller"),
    ),
    "parent": (("link",), ()),
    "child": (("link",), ()),
    "origin": (("xyz", "rpy"), ()),
    "axis": (("xyz",), ()),
    "limit": (("lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"), ()),
    "dynamics": (("damping", "friction"), ()),
    "mimic": (("joint", "multiplier", "offset"), ()),
    "link": (("name", "type"), ("inertial", "visual", "collision")),
    "inertial": ((), ("origin", "mass", "inertia")),
    "mass": (("value",), ()),
    "inertia": (("ixx", "iyy", "izz", "ixy", "ixz", "iyz"), ()),
}
WITHOUT_EFFECT = ("visual", "collision", "calibration", "safety_controller")
SEVERAL = ("visual", "collision")
MEANT_AS_DAMPING = ("damping", "friction", "joint_properties", "dynamics")


class Notes:
    """Sentences, each once; of those that several elements are told, the first place and how many there are."""

    def __init__(self) -> None:
        self._places: dict[str, list[str]] = {}

    def add(self, says: str, where: Element | None = None) -> None:
        """Add a sentence about the element ``where``."""
        self._places.setdefault(says, []).append("" if where is None else str(where))

    def sentences(self) -> list[str]:
        """All of them, in the order in which they first came up."""
        return [_sentence(says, places) for says, places in list(self._places.items())[:MOST_NOTES]]

    def sections(self, root: Element) -> None:
        """Tell what stands beside the links and joints and is not read."""
        passed: list[str] = []
        for element in root.children:
            if element.tag not in TOP and ":" not in element.tag:
                self.add(f"<{element.tag[:40]}> is not known in URDF: it is passed over", element)
            elif element.tag not in ("link", "joint", "mujoco") and element.tag not in passed:
                passed.append(element.tag)
        if passed:
            self.add(f"passed over, since it does not bear on the dynamics: {', '.join(sorted(passed))[:200]}")

    def inside(self, element: Element) -> None:
        """Tell what URDF does not have inside a link or joint."""
        pending = [element]
        while pending:
            at = pending.pop()
            attributes, children = KNOWN[at.tag]
            for name in at.attributes:
                if name not in attributes:
                    self.add(f"attribute {name[:40]!r} of <{at.tag}> {_hint(name)}", at)
            tags: set[str] = set()
            for child in at.children:
                if child.tag in tags and child.tag not in SEVERAL:
                    self.add(f"a second <{child.tag[:40]}> in <{at.tag}>: the first is read", child)
                tags.add(child.tag)
                if child.tag not in children:
                    self.add(f"<{child.tag[:40]}> in <{at.tag}> {_hint(child.tag)}", child)
                elif child.tag not in WITHOUT_EFFECT:
                    pending.append(child)


def _hint(name: str) -> str:
    if name in MEANT_AS_DAMPING:
        return 'is read by no engine; damping belongs in the joint, as <dynamics damping="…" friction="…"/>'
    if ":" in name:
        return "is a vendor's own: it is passed over"
    return "is not known there in URDF: it is passed over"


def _sentence(says: str, places: list[str]) -> str:
    where = places[0]
    more = f" (and in {len(places) - 1} more places)" if len(places) > 1 and where else ""
    return f"{where}: {says}{more}" if where else says
