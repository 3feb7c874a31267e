"""Sentences on what was passed over or assumed, each once, and no more of them than a person reads."""

from __future__ import annotations

from ..xml_file import Element

MOST_NOTES = 60
MOST_UNKNOWN = 20  # elements and attributes that are told one by one

# What MuJoCo 4.0's own schema has, for the elements whose every word matters to the dynamics.
FRAME = {"pos", "quat", "axisangle", "xyaxes", "zaxis", "euler", "childclass", "name"}
KNOWN = {
    "body": FRAME | {"mocap", "gravcomp", "sleep", "simple", "fuse", "user"},
    "frame": FRAME,
    "inertial": FRAME - {"childclass", "name"} | {"mass", "diaginertia", "fullinertia"},
    "freejoint": {"name", "group", "align"},
    "joint": {
        *("name", "class", "type", "group", "pos", "axis", "springdamper", "limited", "actuatorfrclimited"),
        *("solreflimit", "solimplimit", "solreffriction", "solimpfriction", "stiffness", "range", "actuatorfrcrange"),
        *("actuatorgravcomp", "margin", "ref", "springref", "springyield", "armature", "damping", "frictionloss"),
        *("user",),
    },
}


class Notes(list[str]):
    """Notes in the order in which they came up."""

    def __init__(self) -> None:
        super().__init__()
        self._unknown = 0

    def add(self, says: str) -> None:
        """Add a sentence that is not there yet."""
        if says not in self and len(self) < MOST_NOTES:
            self.append(says)

    def unknown(self, element: Element) -> None:
        """Tell the attributes of ``element`` that MJCF does not have, and the elements inside where none may be."""
        known = KNOWN.get(element.tag)
        if known is None:
            return
        for name in element.attributes:
            if name not in known:
                self._tell(f"{element}: attribute {name[:40]!r} is not known in MJCF, and is passed over")
        if element.tag not in ("body", "frame"):
            for child in element.children:
                self.strange(child)

    def strange(self, element: Element) -> None:
        """Tell an element that MJCF does not have in this place."""
        self._tell(f"{element}: this element is not known there in MJCF, and is passed over")

    def _tell(self, says: str) -> None:
        self._unknown += 1
        if self._unknown <= MOST_UNKNOWN:
            self.add(says)
