"""Reads an XML file from an untrusted source: bounded in size, depth and number, without entities or a DTD.

Expat expands entities and ElementTree builds without end; here a document type declaration is refused where it begins
and every element is counted as it is read, so that no file costs more than its own size.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from html import escape  # that of xml.sax imports an HTTP client
from pathlib import Path
from xml.parsers import expat

from ..errors import InvalidInput
from .bounded_file import read_bytes, shown

LARGEST_FILE = 8_000_000  # bytes
MOST_ELEMENTS = 50_000
DEEPEST = 2_000
MOST_ATTRIBUTES = 500  # of one element; MJCF's longest list of them has some fifty
LONGEST_ATTRIBUTE = 10_000  # characters; a list of a few hundred numbers
# Lists as long as their file: shapes, positions of whole models, and what users add. None is read number by number
# unless a reader asks for it.
LONG_LISTS = {
    *("vertex", "normal", "texcoord", "elemtexcoord", "face", "vertid", "vertweight", "element", "node", "point"),
    *("body", "elevation", "grid", "qpos", "qvel", "act", "ctrl", "mpos", "mquat", "data", "user", "value", "id"),
}


@dataclass
class Element:
    """One element: tag, attributes, children, its file and line; ``unnamed``: whether a reader gave it its name."""

    tag: str
    attributes: dict[str, str]
    file: str = ""
    line: int = 0
    children: list[Element] = field(default_factory=list)
    unnamed: bool = False

    def all(self, *tags: str) -> Iterator[Element]:
        """The children with one of these tags."""
        return (child for child in self.children if child.tag in tags)

    def first(self, tag: str) -> Element | None:
        """The first child with this tag."""
        return next(self.all(tag), None)

    def get(self, name: str, otherwise: str = "") -> str:
        """An attribute's text."""
        return self.attributes.get(name, otherwise)

    def __str__(self) -> str:
        name = self.attributes.get("name")
        called = f" name={name[:60]!r}" if name and not self.unnamed else ""
        return f"{self.file}, line {self.line}, <{self.tag}{called}>"

    def wrong(self, says: str) -> InvalidInput:
        """An error to be raised: where this element is, then what is wrong and what would be right."""
        return InvalidInput(f"{self}: {says}")


def read_xml(path: Path) -> Element:
    """The file's root element. Raises :class:`InvalidInput`."""
    return parse_xml(read_bytes(path, LARGEST_FILE), shown(path))


def parse_xml(content: bytes, file: str) -> Element:
    """The root element of an XML text; ``file`` is what messages call it. Raises :class:`InvalidInput`.

    Comments may have ``--`` in them, which XML does not allow: MuJoCo, Pinocchio and Drake read such files.
    """
    try:
        return _Builder(file).build(content)
    except _NotWellFormed as error:
        bare = _without_comments(content)
        if bare == content:
            raise error from None
    return _Builder(file).build(bare)


class _NotWellFormed(InvalidInput):
    """A text that the parser stops at."""


def _without_comments(content: bytes) -> bytes:
    """The text with a space for each character of its comments, whose lines stay."""
    parts, at = [], 0
    while (start := content.find(b"<!--", at)) >= 0 and (end := content.find(b"-->", start + 4)) >= 0:
        inside = content[start : end + 3].split(b"\n")
        parts += [content[at:start], b"\n".join(b" " * len(line) for line in inside)]
        at = end + 3
    return b"".join([*parts, content[at:]])


def write_xml(root: Element) -> str:
    """The elements as a text again: attributes to the letter, comments and text left out. Takes any depth."""
    parts: list[str] = []
    pending: list[Element | str] = [root]
    while pending:
        item = pending.pop()
        if isinstance(item, str):
            parts.append(item)
            continue
        attributes = "".join(f' {name}="{_quoted(value)}"' for name, value in item.attributes.items())
        if not item.children:
            parts.append(f"<{item.tag}{attributes}/>\n")
            continue
        parts.append(f"<{item.tag}{attributes}>\n")
        pending.append(f"</{item.tag}>\n")
        pending.extend(reversed(item.children))
    return "".join(parts)


class _Builder:
    def __init__(self, file: str) -> None:
        self._file = file
        self._open: list[Element] = []
        self._root: Element | None = None
        self._count = 0
        self._parser = parser = expat.ParserCreate()
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.StartDoctypeDeclHandler = self._doctype
        parser.EntityDeclHandler = self._refuse_doctype

    def build(self, content: bytes) -> Element:
        try:
            self._parser.Parse(content, True)
        except expat.ExpatError as error:
            raise _NotWellFormed(
                f"{self._file}, line {error.lineno}: not well-formed XML: {expat.ErrorString(error.code)}"
            ) from None
        except (LookupError, ValueError) as error:
            if isinstance(error, InvalidInput):
                raise
            raise InvalidInput(f"{self._file}: not XML that can be decoded: {error}") from None
        if self._root is None:
            raise InvalidInput(f"{self._file}: no XML element in it")
        return self._root

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, self._file, self._parser.CurrentLineNumber)
        self._count += 1
        if self._count > MOST_ELEMENTS:
            raise element.wrong(f"more than {MOST_ELEMENTS} elements, the most that are read")
        if len(self._open) >= DEEPEST:
            raise element.wrong(f"nested more than {DEEPEST} levels deep")
        if len(attributes) > MOST_ATTRIBUTES:
            raise element.wrong(f"{len(attributes)} attributes; at most {MOST_ATTRIBUTES} are read")
        for name, value in attributes.items():
            if len(value) > LONGEST_ATTRIBUTE and name not in LONG_LISTS:
                raise element.wrong(f"{name[:60]}: {len(value)} characters; at most {LONGEST_ATTRIBUTE} are read")
        if self._open:
            self._open[-1].children.append(element)
        else:
            self._root = element
        self._open.append(element)

    def _end(self, tag: str) -> None:
        self._open.pop()

    def _doctype(self, name: str, system: str | None, public: str | None, has_own_part: int) -> None:
        """``<!DOCTYPE mujoco>`` alone declares nothing; other files and a part of its own may declare entities."""
        if has_own_part or system or public:
            self._refuse_doctype()

    def _refuse_doctype(self, *_: object) -> None:
        raise InvalidInput(
            f"{self._file}, line {self._parser.CurrentLineNumber}: a document type declaration: models need none, and "
            "its entities can grow without end; remove it"
        )


def _quoted(value: str) -> str:
    """An attribute's text between double quotes; a reader would make spaces of its ends of lines and tabs."""
    return escape(value).replace("\n", "&#10;").replace("\r", "&#13;").replace("\t", "&#9;")
