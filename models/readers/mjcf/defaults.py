"""MJCF's default classes: the attributes that an element has where it does not give them itself."""

from __future__ import annotations

from dataclasses import replace

from ..xml_file import Element


class Defaults:
    """The document's default classes. ``main`` is the class of an element that names none."""

    def __init__(self) -> None:
        self._classes: dict[str, dict[str, dict[str, str]]] = {"main": {}}  # class → tag → attributes

    def read(self, element: Element) -> None:
        """Add a ``<default>`` and the classes nested in it, which inherit from it."""
        pending: list[tuple[Element, dict[str, dict[str, str]], str]] = [(element, {}, "main")]
        while pending:
            at, inherited, name = pending.pop()
            called = at.get("class", name)
            if not called:
                raise at.wrong("class: a nested <default> needs a name")
            own = dict(self._classes.get(called, inherited))
            for child in at.children:
                if child.tag != "default":
                    strip(child)
                    own[child.tag] = {**own.get(child.tag, {}), **child.attributes}
            self._classes[called] = own
            at.children = [child for child in at.children if child.tag in ("default", "joint", "geom")]
            pending.extend((child, own, "") for child in at.all("default"))

    def require(self, element: Element, name: str, attribute: str) -> None:
        """Raise :class:`InvalidInput` where no class is called ``name``, which ``element`` gives as ``attribute``."""
        if name not in self._classes:
            raise element.wrong(f"{attribute}={name[:60]!r}: no <default> of that class")

    def applied(self, element: Element, childclass: str) -> Element:
        """The element with the defaults of its class, ``childclass`` where it names none, behind its own attributes."""
        called = element.get("class", childclass)
        self.require(element, called, "class")
        return replace(element, attributes={**self._classes[called].get(element.tag, {}), **element.attributes})


def strip(element: Element) -> None:
    """Remove attributes that refer to other files or to elements that have been left out, and all children."""
    for name in ("material", "mesh", "hfield", "fluidshape"):
        if name != "mesh" or element.get("type") in ("mesh", "sdf"):
            element.attributes.pop(name, None)
    element.children.clear()
