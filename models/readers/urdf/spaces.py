"""Numbers of URDF with white space behind them, which a reader that wants nothing behind a number takes for none."""

from __future__ import annotations

from ..xml_file import Element

NUMBERED = ("limit", "dynamics", "mimic", "safety_controller", "calibration")  # in a joint, numbers alone


def space_behind(element: Element, *attributes: str) -> bool:
    """Whether one of the attributes ends in white space; an end of line in it counts."""
    return any((text := element.get(name)) != text.rstrip() for name in attributes)


def refuse_spaces(root: Element) -> None:
    """Raise :class:`InvalidInput` at the first joint that such a reader takes for malformed."""
    for joint in root.all("joint"):
        for element in joint.all(*NUMBERED):
            for name in element.attributes:
                if name != "joint" and space_behind(element, name):
                    raise element.wrong(f"{name}={element.get(name)!r}: no number, for a space is behind it")
