"""Replaces every ``<include>`` of an MJCF document by the file it names, inside the model's own folder only."""

from __future__ import annotations

import os
from pathlib import Path

from ..xml_file import DEEPEST, MOST_ELEMENTS, Element, read_xml

MOST_INCLUDES = 50


def with_includes(root: Element, path: Path) -> Element:
    """The document at ``path`` with the children of every included file in the place of its ``<include>``.

    Raises :class:`InvalidInput` for a file outside the model's folder, one that is missing, one that is included
    twice, and for more files, elements or levels than the limits.
    """
    folder = path.resolve().parent
    seen = {path.resolve()}
    count = 0
    pending = [(root, 0)]
    while pending:
        element, depth = pending.pop()
        if depth > DEEPEST:
            raise element.wrong(f"nested more than {DEEPEST} levels deep")
        children = _replaced(element.children, folder, seen)
        while any(child.tag == "include" for child in children):
            children = _replaced(children, folder, seen)
        count += len(children)
        if count > MOST_ELEMENTS:
            raise element.wrong(f"more than {MOST_ELEMENTS} elements with what it includes")
        element.children = children
        pending.extend((child, depth + 1) for child in children)
    return root


def _replaced(children: list[Element], folder: Path, seen: set[Path]) -> list[Element]:
    found: list[Element] = []
    for child in children:
        found.extend(_include(child, folder, seen) if child.tag == "include" else (child,))
    return found


def _include(element: Element, folder: Path, seen: set[Path]) -> list[Element]:
    name = element.get("file")
    if not name:
        raise element.wrong("file: the name of a file is needed")
    try:
        path = (folder / name).resolve()
    except (OSError, ValueError, RuntimeError) as error:
        raise element.wrong(f"file={name[:80]!r}: {error}") from None
    if not path.is_relative_to(folder):
        raise element.wrong(
            f"file={name[:80]!r}: outside the model's own folder, where nothing is read; move it inside"
        )
    if not os.path.isfile(path):  # pathlib's raises where the name is too long
        raise element.wrong(f"file={name[:80]!r}: cannot be read: there is no such file in the model's folder")
    if path in seen:
        raise element.wrong(f"file={name[:80]!r}: included twice, or by itself")
    if len(seen) > MOST_INCLUDES:
        raise element.wrong(f"more than {MOST_INCLUDES} files included")
    seen.add(path)
    return read_xml(path).children
