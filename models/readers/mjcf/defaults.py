"""MJCF's default classes: the attributes that an element has where it does not give them itself."""

from __future__ import annotations

from dataclasses import replace

from ..rules import MjcfRules
from ..xml_file import Element
from .frames import ROTATIONS

Attributes = dict[str, dict[str, str]]  # tag → attributes
KEPT = ("default", "joint", "geom")
REFERENCES = ("material", "mesh", "hfield", "fluidshape")


class Defaults:
    """The document's default classes. ``main`` is the class of an element that names none."""

    def __init__(self, rules: MjcfRules) -> None:
        self._rules = rules
        self._classes: dict[str, Attributes] = {"main": {}}
        self._chains: dict[str, list[Element]] = {"main": []}

    def read(self, element: Element) -> None:
        """Add a ``<default>`` and the classes nested in it, which inherit from it."""
        pending: list[tuple[Element, Attributes, list[Element], str]] = [(element, {}, [], "main")]
        while pending:
            at, inherited, chain, name = pending.pop()
            called = at.get("class", name)
            if not called:
                raise at.wrong("class: a nested <default> needs a name")
            if called in self._classes and at is not element:
                raise at.wrong(f"class={called[:60]!r}: a second <default> of that class; names must be unique")
            own = dict(self._classes.get(called, {} if self._rules.nested_class_inherits_nothing else inherited))
            chain = [*self._chains.get(called, chain)]
            for child in at.children:
                if child.tag != "default":
                    behind = own.get(child.tag, inherited.get(child.tag, {}))
                    own[child.tag] = _over(child.attributes, behind)
                    chain.append(replace(child, attributes=dict(child.attributes)))
                    strip(child)
            self._classes[called], self._chains[called] = own, chain
            at.children = [child for child in at.children if child.tag in KEPT]
            pending.extend((child, own, chain, "") for child in at.all("default"))

    def require(self, element: Element, name: str, attribute: str) -> None:
        """Raise :class:`InvalidInput` where no class is called ``name``, which ``element`` gives as ``attribute``."""
        if name not in self._classes:
            raise element.wrong(f"{attribute}={name[:60]!r}: no <default> of that class")

    def applied(self, element: Element, childclass: str) -> Element:
        """The element with the defaults of its class, ``childclass`` where it names none, behind its own attributes."""
        called = element.get("class", childclass)
        self.require(element, called, "class")
        behind = self._classes[called].get(element.tag, {})
        if self._rules.childclass_behind_class:
            behind = _over(behind, self._classes[childclass].get(element.tag, {}))
        return replace(element, attributes=_over(element.attributes, self._without_mistakes(element.tag, behind)))

    def chain(self, element: Element) -> list[Element]:
        """The elements of default classes that stand behind ``element``, from the outermost class inwards."""
        called = element.get("class", "main")
        self.require(element, called, "class")
        return self._chains[called]

    def _without_mistakes(self, tag: str, given: dict[str, str]) -> dict[str, str]:
        """Default attributes less those that a mistaken reader drops."""
        dropped: set[str] = set()
        if tag == "joint" and self._rules.default_joint_pos_dropped:
            dropped.add("pos")
        if tag == "geom" and self._rules.default_geom_mass_dropped:
            dropped.add("mass")
        if tag == "geom" and self._rules.default_geom_pose_dropped:
            dropped.update(("pos", *ROTATIONS))
        return {name: value for name, value in given.items() if name not in dropped} if dropped else given


def _over(given: dict[str, str], behind: dict[str, str]) -> dict[str, str]:
    """``given`` attributes over those ``behind`` them. There is one orientation, in whichever way it is written."""
    if any(name in given for name in ROTATIONS):
        behind = {name: value for name, value in behind.items() if name not in ROTATIONS}
    return {**behind, **given}


def strip(element: Element) -> None:
    """Remove attributes that refer to other files or to elements that have been left out, and all children."""
    for name in REFERENCES:
        element.attributes.pop(name, None)
    element.children.clear()
