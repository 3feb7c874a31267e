"""MJCF's ``<attach>``: a part of another document, with that one's own compiler, default classes and assets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..folders import Folders
from ..rules import MjcfRules
from ..xml_file import MOST_ELEMENTS, Element, read_xml
from .assets import Assets
from .defaults import Defaults
from .includes import with_includes, without_includes
from .options import Compiler
from .replicate import write_out_copies

DEEPEST_MODELS = 10  # documents that attach parts of one another
NO_NAME = "MuJoCo Model"  # MuJoCo calls a document so that has no name


@dataclass(frozen=True)
class Source:
    """What a document says of how its elements are read."""

    compiler: Compiler
    defaults: Defaults
    assets: Assets


@dataclass(kw_only=True)
class Attached(Element):
    """Elements of another document in the place of an ``<attach>``; ``source``: how they are read; ``childclass``: the
    class of those that name none."""

    source: Source
    childclass: str


@dataclass(frozen=True)
class Beside:
    """The sections of a document that is attached, whose elements are called ``prefix`` and their names."""

    root: Element
    source: Source
    prefix: str


@dataclass
class Document:
    """An MJCF document whose ``<attach>`` elements are written out, and so is ``<replicate>``.

    ``beside``: the sections of all documents that are attached, once for each time.
    """

    root: Element
    source: Source
    beside: list[Beside] = field(default_factory=list)


def read_document(
    root: Element, path: Path, rules: MjcfRules, others: Sequence[Path] = (), above: Sequence[Path] = ()
) -> Document:
    """The document ``root`` of the file ``path``; ``above``: the documents that attach it. Raises `InvalidInput`."""
    folders = Folders(path, others)
    root = without_includes(root) if rules.include_not_followed else with_includes(root, path, folders)
    compiler, defaults = Compiler(rules), Defaults(rules)
    for element in sections(root, "compiler", rules):
        compiler.read(element)
    for element in sections(root, "default", rules):
        defaults.read(element)
    assets = Assets(compiler, defaults, folders)
    assets.read(root.all("asset"))
    found = Document(root, Source(compiler, defaults, assets))
    models = _Models(found, folders, others, (*above, path.resolve()))
    for world in root.all("worldbody"):
        models.write_out(world)
        write_out_copies(world, compiler)
    return found


def sections(root: Element, tag: str, rules: MjcfRules) -> list[Element]:
    """The document's sections called ``tag``; fewer where a mistaken reader misses some."""
    found, after = [], False
    for element in root.children:
        after = after or element.tag == "worldbody"
        if element.tag == tag and not (after and rules.late_sections_ignored):
            found.append(element)
    return found[:1] if rules.later_sections_ignored else found


class _Models:
    """The documents that the ``<model>`` assets of one name, each read when it is first attached."""

    def __init__(self, document: Document, folders: Folders, others: Sequence[Path], above: Sequence[Path]) -> None:
        self._document = document
        self._rules = document.source.compiler.rules
        self._folders, self._others, self._above = folders, others, above
        self._assets = [asset for section in document.root.all("asset") for asset in section.all("model")]
        self._roots: dict[int, Element] = {}
        self._read: dict[int, Document] = {}

    def write_out(self, world: Element) -> None:
        """Put what is attached in the place of every ``<attach>``, or nothing where a reader ignores them."""
        count, pending = 0, [world]
        while pending:
            element = pending.pop()
            children = [self._attached(child) if child.tag == "attach" else child for child in element.children]
            element.children = [child for child in children if child is not None]
            written = [child for child in element.children if isinstance(child, Attached)]
            count += sum(1 for child in written for _ in _all(child))
            if count > MOST_ELEMENTS:
                raise element.wrong(f"more than {MOST_ELEMENTS} elements with what is attached")
            pending.extend(child for child in element.children if not isinstance(child, Attached))

    def _attached(self, element: Element) -> Attached | None:
        if self._rules.attach_ignored:
            return None
        if "prefix" not in element.attributes:
            raise element.wrong("prefix: needed, and goes before the names of all that is attached")
        if not element.get("model"):
            raise element.wrong("a part of the document itself is not attached; write its bodies out a second time")
        if self._document.source.compiler.merges:
            raise element.wrong('<compiler conflict="merge">: options are not merged; write those that are meant here')
        model, prefix = self._model(element), element.get("prefix")
        part, childclass, source = _part(element, model)
        self._document.beside.append(Beside(model.root, model.source, prefix))
        self._document.beside += [replace(one, prefix=prefix + one.prefix) for one in model.beside]
        where = (element.file, element.line)
        top = Attached("attached", {}, *where, children=part, source=source, childclass=childclass)
        return _prefixed(top, prefix)

    def _model(self, element: Element) -> Document:
        name = element.get("model")
        for number, asset in enumerate(self._assets):
            if (asset.get("name") or self._root(number).get("model") or NO_NAME) != name:
                continue
            if number not in self._read:
                if len(self._above) > DEEPEST_MODELS:
                    raise asset.wrong(f"documents attached more than {DEEPEST_MODELS} deep")
                path = self._path(number)
                if path in self._above:
                    raise asset.wrong("the document is attached to itself")
                root = self._root(number)
                self._read[number] = read_document(root, path, self._rules, self._others, self._above)
            return self._read[number]
        raise element.wrong(f"model={name[:60]!r}: no <model> of that name in an <asset>")

    def _path(self, number: int) -> Path:
        asset = self._assets[number]
        if not asset.get("file"):
            raise asset.wrong("file: the name of an MJCF file is needed")
        return self._folders.find(asset, asset.get("file")).resolve()

    def _root(self, number: int) -> Element:
        if number not in self._roots:
            root = read_xml(self._path(number))
            if root.tag != "mujoco":
                raise self._assets[number].wrong(f"<{root.tag[:40]}>: only MJCF is attached; convert it to MJCF first")
            self._roots[number] = root
        return self._roots[number]


def _part(element: Element, model: Document) -> tuple[list[Element], str, Source]:
    """What is attached, a body, a frame, or all that the world holds; the class of what names none there, and how it
    is read."""
    worlds = list(model.root.all("worldbody"))
    given = [tag for tag in ("body", "frame") if tag in element.attributes]
    if len(given) > 1:
        raise element.wrong("body and frame: only one of them can be given")
    if not given:
        classes = {world.get("childclass", "main") for world in worlds}
        if len(classes) > 1:
            raise element.wrong("the worlds of the model have several childclasses; write a body or a frame")
        return [child for world in worlds for child in world.children], next(iter(classes), "main"), model.source
    tag, name = given[0], element.get(given[0])
    pending = [(world, "main", model.source) for world in worlds]
    while pending:
        at, childclass, source = pending.pop()
        if at.tag == tag and name and at.get("name") == name:
            return [at], childclass, source
        inside = at.get("childclass", childclass)
        if isinstance(at, Attached):
            inside, source = at.childclass, at.source
        pending.extend((child, inside, source) for child in at.children)
    raise element.wrong(f"{tag}={name[:60]!r}: no <{tag}> of that name in the model")


def _all(top: Element) -> Iterator[Element]:
    pending = [top]
    while pending:
        element = pending.pop()
        yield element
        pending.extend(element.children)


def _prefixed(top: Attached, prefix: str) -> Attached:
    """The element and all inside, which may be deep, with ``prefix`` before every name."""
    copy = replace(top, attributes=dict(top.attributes))
    pending: list[Element] = [copy]
    while pending:
        element = pending.pop()
        element.children = [replace(child, attributes=dict(child.attributes)) for child in element.children]
        if element.get("name"):
            element.attributes["name"] = prefix + element.get("name")
        pending.extend(element.children)
    return copy
