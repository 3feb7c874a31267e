"""Replaces every ``<include>`` of an MJCF document by the file it names, inside the folders that may be read only."""

from __future__ import annotations

from pathlib import Path

from ..folders import Folders
from ..xml_file import DEEPEST, MOST_ELEMENTS, Element, read_xml

MOST_INCLUDES = 50


def with_includes(root: Element, path: Path, folders: Folders) -> Element:
    """The document at ``path`` with the children of every included file in the place of its ``<include>``.

    Raises :class:`InvalidInput` for a file outside ``folders``, one that is missing, one that is included twice, and
    for more files, elements or levels than the limits.
    """
    seen = {path.resolve()}
    count = 0
    pending = [(root, 0)]
    while pending:
        element, depth = pending.pop()
        if depth > DEEPEST:
            raise element.wrong(f"nested more than {DEEPEST} levels deep")
        children = _replaced(element.children, folders, seen)
        while any(child.tag == "include" for child in children):
            children = _replaced(children, folders, seen)
        count += len(children)
        if count > MOST_ELEMENTS:
            raise element.wrong(f"more than {MOST_ELEMENTS} elements with what it includes")
        element.children = children
        pending.extend((child, depth + 1) for child in children)
    return root


def without_includes(root: Element) -> Element:
    """The document with every ``<include>`` left out: what a reader has that does not follow them."""
    pending = [root]
    while pending:
        element = pending.pop()
        element.children = [child for child in element.children if child.tag != "include"]
        pending.extend(element.children)
    return root


def _replaced(children: list[Element], folders: Folders, seen: set[Path]) -> list[Element]:
    found: list[Element] = []
    for child in children:
        found.extend(_include(child, folders, seen) if child.tag == "include" else (child,))
    return found


def _include(element: Element, folders: Folders, seen: set[Path]) -> list[Element]:
    name = element.get("file")
    if not name:
        raise element.wrong("file: the name of a file is needed")
    path = folders.find(element, name)
    if path in seen:
        raise element.wrong(f"file={name[:80]!r}: included twice, or by itself")
    if len(seen) > MOST_INCLUDES:
        raise element.wrong(f"more than {MOST_INCLUDES} files included")
    seen.add(path)
    return read_xml(path).children
