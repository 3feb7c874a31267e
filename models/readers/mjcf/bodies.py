"""The tree of MJCF bodies and their joints, walked from the world down, parents first, in the document's order."""

from __future__ import annotations

from collections.abc import Iterator

from ...projection import MOST_BODIES, Body, SpatialHinge
from ...spatial import IDENTITY, Pose
from ..attributes import axis, not_negative, number, numbers, refuse, word
from ..xml_file import Element
from .defaults import Defaults, strip
from .frames import pose_of
from .inertials import Inertials, remove
from .options import Compiler, Options

KNOWN = ("site", "camera", "light", "geom", "inertial", "joint", "freejoint", "body", "frame")  # inside a body


class Bodies:
    """Reads every ``<worldbody>`` of a document into :attr:`bodies`, and strips the elements of what has no effect."""

    def __init__(self, compiler: Compiler, defaults: Defaults, options: Options, inertials: Inertials) -> None:
        self.bodies: list[Body] = []
        self._compiler = compiler
        self._defaults = defaults
        self._options = options
        self._inertials = inertials
        self._names: dict[str, set[str]] = {}

    def read(self, world: Element) -> None:
        """Add the bodies of a ``<worldbody>``. Raises :class:`InvalidInput` for what no planar tree of hinges has."""
        pending: list[tuple[Element, int, Pose, str]] = [(world, -1, IDENTITY, "main")]
        while pending:
            element, parent, outer, childclass = pending.pop()
            frame = outer if element is world else outer @ pose_of(element, self._compiler)
            childclass = element.get("childclass", childclass)
            self._defaults.require(element, childclass, "childclass")
            inner = IDENTITY
            if element.tag == "body":
                parent = self._body(element, parent, frame, childclass)
            elif element.tag == "frame":
                inner = frame
            elif any(element.all("joint", "freejoint", "inertial")):
                raise refuse(next(element.all("joint", "freejoint", "inertial")), "in the world, which does not move")
            for child in element.children:
                if child.tag not in KNOWN:
                    raise child.wrong(
                        f"<{child.tag}> in a body is not supported; write out the bodies that it stands for"
                    )
            element.children = [c for c in element.children if c.tag not in ("site", "camera", "light")]
            below = [(child, parent, inner, childclass) for child in element.children if child.tag in ("body", "frame")]
            pending.extend(reversed(below))
            if element.tag == "worldbody":
                self._world_geoms(element, childclass)

    def _world_geoms(self, world: Element, childclass: str) -> None:
        for geom in list(_geoms_in(world)):
            full = self._defaults.applied(geom, childclass)
            strip(geom)
            if full.get("type", "sphere") in ("mesh", "hfield", "sdf"):
                remove(world, geom)

    def _body(self, element: Element, parent: int, frame: Pose, childclass: str) -> int:
        name = self._named(element, "body")
        if len(self.bodies) >= MOST_BODIES:
            raise element.wrong(f"more than {MOST_BODIES} bodies")
        if element.get("mocap") == "true":
            raise refuse(element, "mocap: a body that is moved from outside")
        if number(element, "gravcomp") != 0:
            raise element.wrong("gravcomp: gravity compensation is not modelled; remove it")
        joints = element.all("joint", "freejoint")
        hinges = tuple(self._hinge(self._defaults.applied(joint, childclass), joint) for joint in joints)
        inertial = self._inertials.of_body(element, name, childclass)
        self.bodies.append(Body(name, parent, frame, hinges, inertial, str(element)))
        return len(self.bodies) - 1

    def _named(self, element: Element, kind: str) -> str:
        """The element's name, given one where it has none, so that engines can be asked for it."""
        taken = self._names.setdefault(kind, set())
        name = element.get("name") or f"furiko_{kind}_{len(taken) + 1}"
        if name in taken:
            raise element.wrong(f"a second {kind} called {name[:60]!r}; names must be unique")
        taken.add(name)
        element.attributes["name"] = name
        return name

    def _hinge(self, full: Element, given: Element) -> SpatialHinge:
        """``given`` as a hinge; ``full`` is the same element with its defaults."""
        kind = "free" if given.tag == "freejoint" else full.get("type", "hinge")
        if kind != "hinge":
            raise refuse(given, f"a joint of type {kind[:20]!r}")
        name = self._named(given, "joint")
        if "springdamper" in full.attributes:
            raise given.wrong("springdamper: not supported; give stiffness and damping")
        compiler, options = self._compiler, self._options
        zero = compiler.angle(number(full, "ref"))
        springref = compiler.angle(number(full, "springref"))
        return SpatialHinge(
            name=name,
            axis=axis(full, "axis", (0.0, 0.0, 1.0)),
            anchor=numbers(full, "pos", 3, (0.0, 0.0, 0.0)),
            armature=not_negative(full, "armature"),
            damping=options.enabled(_coefficient(full, "damping"), "damper", "passive"),
            friction=options.enabled(not_negative(full, "frictionloss"), "frictionloss", "constraint"),
            stiffness=options.enabled(_coefficient(full, "stiffness"), "spring", "passive"),
            rest=springref - zero,
            limits=None if options.disabled & {"limit", "constraint"} else self._limits(full, zero),
            zero=zero,
            where=str(given),
        )

    def _limits(self, joint: Element, zero: float) -> tuple[float, float] | None:
        limited = word(joint, "limited", ("true", "false", "auto"), "auto")
        ends = numbers(joint, "range", 2, (0.0, 0.0))
        if limited == "false" or (limited == "auto" and ("range" not in joint.attributes or not ends.any())):
            return None
        if limited == "auto" and not self._compiler.autolimits:
            raise joint.wrong("range without limited='true', and autolimits is off; MuJoCo refuses that: say limited")
        low, high = (self._compiler.angle(float(end)) - zero for end in ends)
        if low >= high:
            raise joint.wrong(f"range={joint.get('range')!r}: the lower limit must be the smaller")
        return low, high


def _geoms_in(element: Element) -> Iterator[Element]:
    yield from element.all("geom")
    for frame in element.all("frame"):
        yield from _geoms_in(frame)


def _coefficient(element: Element, attribute: str) -> float:
    """The linear coefficient of a spring or damper; coefficients of higher powers after it must be zero."""
    values = numbers(element, attribute, (1, 3), (0.0,))
    if values[0] < 0 or values[1:].any():
        raise element.wrong(f"{attribute}={element.get(attribute)!r}: one number, not negative, is needed")
    return float(values[0])
