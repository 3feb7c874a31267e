"""Writes out MJCF's ``<replicate>``: each copy in a ``<frame>``, its names with the copy's number behind."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..attributes import number, numbers
from ..placement import by_euler
from ..xml_file import MOST_ELEMENTS, Element
from .options import Compiler

MOST_COPIES = 10_000


def write_out_copies(world: Element, compiler: Compiler) -> None:
    """Put copies in the place of every ``<replicate>`` in ``world``, the innermost first. Raises `InvalidInput`."""
    order = [world]
    for element in order:  # grows as it goes: parents before children
        order.extend(element.children)
    total = len(order)
    for element in reversed(order):
        if not any(child.tag == "replicate" for child in element.children):
            continue
        children: list[Element] = []
        for child in element.children:
            children.extend(_copies(child, compiler, MOST_ELEMENTS - total) if child.tag == "replicate" else [child])
        element.children = children
        total += sum(map(_size, children))
        if total > MOST_ELEMENTS:
            raise element.wrong(f"more than {MOST_ELEMENTS} elements with the copies of <replicate>")


def _copies(element: Element, compiler: Compiler, room: int) -> list[Element]:
    count = int(number(element, "count", 0.0))
    if not 0 < count <= MOST_COPIES or count * _size(element) > room:
        raise element.wrong(f"count={element.get('count')!r:.40}: from 1 to {MOST_COPIES} copies, and {room} elements")
    if any(child.tag in ("joint", "freejoint", "inertial") for child in element.children):
        raise element.wrong("a joint or inertial directly in <replicate>; put it into a <body>")
    offset = numbers(element, "offset", 3, (0.0, 0.0, 0.0))
    angles = np.array([compiler.angle(float(v)) for v in numbers(element, "euler", 3, (0.0, 0.0, 0.0))])
    if count > 2 and np.count_nonzero(angles) > 1:
        raise element.wrong("euler: turning about several axes adds up in a way that MJCF leaves open; use <frame>s")
    digits = len(str(count))
    copies, position = [], np.zeros(3)
    for index in range(count):
        quaternion = by_euler(index * angles, compiler.sequence)
        attributes = {"pos": _written(position), "quat": _written(quaternion)}
        if "childclass" in element.attributes:
            attributes["childclass"] = element.get("childclass")
        inside = [_copy(child, f"{element.get('sep')}{index:0{digits}}") for child in element.children]
        copies.append(Element("frame", attributes, element.file, element.line, inside))
        position = position + _turned(quaternion, offset)
    return copies


def _turned(quaternion: np.ndarray, offset: np.ndarray) -> np.ndarray:
    w, xyz = quaternion[0], quaternion[1:]
    across = 2 * np.cross(xyz, offset)
    return np.asarray(offset + w * across + np.cross(xyz, across))


def _copy(element: Element, suffix: str) -> Element:
    """The element and all inside, which may be deep, with ``suffix`` behind every name."""
    top = replace(element, attributes=dict(element.attributes))
    pending = [top]
    while pending:
        new = pending.pop()
        if new.get("name"):
            new.attributes["name"] += suffix
        new.children = [replace(child, attributes=dict(child.attributes)) for child in new.children]
        pending.extend(new.children)
    return top


def _size(element: Element) -> int:
    count, pending = 0, [element]
    while pending:
        count += 1
        pending.extend(pending.pop().children)
    return count


def _written(values: np.ndarray) -> str:
    return " ".join(repr(float(value)) for value in values)
