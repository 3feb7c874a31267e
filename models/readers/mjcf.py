"""MJCF as its documentation has it: bodies, hinges, inertials, geoms that weigh, defaults, frames and includes.

What the reader does not know it refuses by name, and what cannot matter to a pendulum (cameras, sensors, actuators
without control) it leaves out of the text that engines are given.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InvalidInput
from ..mechanism import MOST_BODIES, Body, SpatialHinge
from ..spatial import (
    HERE,
    NOTHING,
    Inertial,
    Pose,
    about,
    from_euler,
    from_quaternion,
    from_x_and_y,
    from_z_axis,
    symmetric,
)
from .attributes import Array, axis, not_negative, number, numbers, refuse, word, yes
from .geoms import geom_inertial
from .xml_file import DEEPEST, MOST_ELEMENTS, Element, read_xml

MOST_INCLUDES = 50
LIFTED = 1e-14  # kg m²; a bound up to here is there for MuJoCo's compiler, which takes no body without inertia
LEFT_OUT = ("actuator", "sensor", "keyframe", "visual", "statistic", "asset", "custom", "size")
CARRIED = ("compiler", "option", "default", "worldbody", "contact")
UNWEIGHED = ("site", "camera", "light", "geom", "inertial", "joint", "freejoint", "body", "frame")
TURNED_BY = ("quat", "axisangle", "xyaxes", "zaxis", "euler")


@dataclass
class Compiler:
    """What ``<compiler>`` says that changes how the rest is read."""

    degrees: bool = True
    sequence: str = "xyz"
    autolimits: bool = True
    from_geoms: str = "auto"
    groups: tuple[int, int] = (0, 5)
    least_mass: float = 0.0
    least_inertia: float = 0.0
    balance: bool = False
    total_mass: float = -1.0

    def angle(self, value: float) -> float:
        """An angle of the file [rad]."""
        return math.radians(value) if self.degrees else value


@dataclass
class Mjcf:
    """An MJCF file as furiko understands it; ``root`` is what engines are given."""

    root: Element
    bodies: list[Body]
    gravity: Array
    compiler: Compiler
    integrator: str = "Euler"
    timestep: float = 0.002
    notes: list[str] = field(default_factory=list)
    from_geoms: list[str] = field(default_factory=list)  # names of bodies whose inertial is that of their geoms
    geoms: dict[str, Inertial] = field(default_factory=dict)  # what the geoms of each body would make it
    tensors: dict[str, tuple[Inertial, Array]] = field(
        default_factory=dict
    )  # inertial before it is turned, and the turn


def read_mjcf(root: Element, path: Path) -> Mjcf:
    """Understand an MJCF document. Raises :class:`InvalidInput`."""
    return _Reader(root, path).read()


class _Reader:
    def __init__(self, root: Element, path: Path) -> None:
        self._path = path
        self._root = _included(root, path)
        self._compiler = Compiler()
        self._defaults: dict[str, dict[str, dict[str, str]]] = {"main": {}}
        self._names: dict[str, set[str]] = {}
        self._off: set[str] = set()  # what <flag> disables
        self._file = Mjcf(
            Element("mujoco", dict(root.attributes), str(path), root.line), [], np.zeros(3), self._compiler
        )

    def read(self) -> Mjcf:
        file = self._file
        self._sections()
        for element in self._root.all("compiler"):
            self._read_compiler(element)
        for element in self._root.all("default"):
            self._read_defaults(element, {}, "main")
        file.gravity = self._options()
        worlds = list(self._root.all("worldbody"))
        for world in worlds:
            self._walk(world)
        self._scale_to_total_mass()
        return file

    def _sections(self) -> None:
        """Keep what the motion depends on, leave out what it does not, refuse the rest."""
        kept = self._file.root.children
        for element in self._root.children:
            if element.tag == "equality":
                for constraint in element.children:
                    if constraint.get("active") != "false":
                        raise refuse(constraint, "a constraint besides the hinges")
            elif element.tag == "tendon":
                for tendon in element.children:
                    if any(
                        name in tendon.attributes
                        for name in ("stiffness", "damping", "frictionloss", "range", "limited")
                    ):
                        raise refuse(tendon, "a tendon that pulls")
            elif element.tag in CARRIED:
                kept.append(element)
            elif element.tag not in LEFT_OUT:
                raise element.wrong(f"<{element.tag}> is not supported; remove it")
            if element.tag == "actuator" and element.children:
                self._file.notes.append("actuators are left out: nothing is driven")

    def _read_compiler(self, element: Element) -> None:
        compiler = self._compiler
        compiler.degrees = (
            word(element, "angle", ("degree", "radian"), "degree" if compiler.degrees else "radian") == "degree"
        )
        compiler.sequence = element.get("eulerseq", compiler.sequence)
        if len(compiler.sequence) != 3 or set(compiler.sequence) - set("xyzXYZ"):
            raise element.wrong(f"eulerseq={compiler.sequence[:20]!r}: three letters out of xyzXYZ needed")
        if element.get("coordinate", "local") != "local":
            raise element.wrong("coordinate: only 'local' is supported, as in MuJoCo itself since 2.3")
        compiler.autolimits = yes(element, "autolimits", compiler.autolimits)
        compiler.from_geoms = word(element, "inertiafromgeom", ("true", "false", "auto"), compiler.from_geoms)
        low, high = numbers(element, "inertiagrouprange", 2, compiler.groups)
        compiler.groups = int(low), int(high)
        compiler.least_mass = not_negative(element, "boundmass", compiler.least_mass)
        compiler.least_inertia = not_negative(element, "boundinertia", compiler.least_inertia)
        compiler.balance = yes(element, "balanceinertia", compiler.balance)
        compiler.total_mass = number(element, "settotalmass", compiler.total_mass)
        for name in ("meshdir", "texturedir", "assetdir", "strippath"):
            element.attributes.pop(name, None)  # nothing is loaded from there
        element.children.clear()

    def _read_defaults(self, element: Element, inherited: dict[str, dict[str, str]], otherwise: str) -> None:
        pending = [(element, inherited, otherwise)]
        while pending:
            at, above, name = pending.pop()
            called = at.get("class", name)
            if not called:
                raise at.wrong("class: a nested <default> needs a name")
            own = dict(self._defaults.get(called, above))
            for child in at.children:
                if child.tag != "default":
                    _strip(child)
                    own[child.tag] = {**own.get(child.tag, {}), **child.attributes}
            self._defaults[called] = own
            at.children = [child for child in at.children if child.tag in ("default", "joint", "geom")]
            pending.extend((child, own, "") for child in at.all("default"))

    def _options(self) -> Array:
        gravity, off = np.array([0.0, 0.0, -9.81]), False
        for element in self._root.all("option"):
            gravity = numbers(element, "gravity", 3, tuple(gravity))
            self._file.timestep = number(element, "timestep", self._file.timestep)
            self._file.integrator = element.get("integrator", self._file.integrator)
            for name in ("density", "viscosity"):
                if not_negative(element, name) > 0:
                    raise element.wrong(
                        f"{name}={element.get(name)!r}: forces of a fluid are not modelled; set it to 0"
                    )
            for flag in element.all("flag"):
                off = word(flag, "gravity", ("enable", "disable"), "disable" if off else "enable") == "disable"
                self._off |= {name for name, value in flag.attributes.items() if value == "disable"}
                self._off -= {name for name, value in flag.attributes.items() if value == "enable"}
        return np.zeros(3) if off else gravity

    def _merged(self, element: Element, childclass: str) -> Element:
        """The element with its class's defaults behind its own attributes."""
        called = element.get("class", childclass)
        if called not in self._defaults:
            raise element.wrong(f"class={called[:60]!r}: no <default> of that class")
        kind = "joint" if element.tag == "joint" else element.tag
        behind = self._defaults[called].get(kind, {})
        return replace(element, attributes={**behind, **element.attributes})

    def _walk(self, world: Element) -> None:
        """Bodies, parents first, in the file's order."""
        pending: list[tuple[Element, int, Pose, str]] = [(world, -1, HERE, "main")]
        while pending:
            element, carrier, outer, childclass = pending.pop()
            frame = outer if element is world else outer @ self._pose(element)
            childclass = element.get("childclass", childclass)
            if childclass not in self._defaults:
                raise element.wrong(f"childclass={childclass[:60]!r}: no <default> of that class")
            inner = HERE
            if element.tag == "body":
                carrier = self._body(element, carrier, frame, childclass)
            elif element.tag == "frame":
                inner = frame
            elif any(element.all("joint", "freejoint", "inertial")):
                raise refuse(next(element.all("joint", "freejoint", "inertial")), "in the world, which does not move")
            for child in element.children:
                if child.tag not in UNWEIGHED:
                    raise child.wrong(
                        f"<{child.tag}> in a body is not supported; write out the bodies that it stands for"
                    )
            element.children = [c for c in element.children if c.tag not in ("site", "camera", "light")]
            below = [
                (child, carrier, inner, childclass) for child in element.children if child.tag in ("body", "frame")
            ]
            pending.extend(reversed(below))
            if element.tag == "worldbody":
                self._world_geoms(element, childclass)

    def _world_geoms(self, world: Element, childclass: str) -> None:
        for geom in list(self._geoms_in(world)):
            merged = self._merged(geom, childclass)
            _strip(geom)
            if merged.get("type", "sphere") in ("mesh", "hfield", "sdf"):
                _remove(world, geom)

    def _geoms_in(self, element: Element) -> Iterator[Element]:
        yield from element.all("geom")
        for frame in element.all("frame"):
            yield from self._geoms_in(frame)

    def _body(self, element: Element, carrier: int, frame: Pose, childclass: str) -> int:
        name = self._named(element, "body")
        if len(self._file.bodies) >= MOST_BODIES:
            raise element.wrong(f"more than {MOST_BODIES} bodies, which no pendulum needs")
        for attribute in ("mocap",):
            if element.get(attribute) == "true":
                raise refuse(element, f"{attribute}: a body that is moved from outside")
        if number(element, "gravcomp") != 0:
            raise element.wrong("gravcomp: a body that gravity does not pull alike is not modelled; remove it")
        hinges = tuple(
            self._hinge(self._merged(joint, childclass), joint) for joint in element.all("joint", "freejoint")
        )
        inertial = self._inertial(element, name, childclass)
        self._file.bodies.append(Body(name, carrier, frame, hinges, inertial, str(element)))
        return len(self._file.bodies) - 1

    def _named(self, element: Element, kind: str) -> str:
        """The element's name, given one where it has none, so that engines can be asked for it."""
        taken = self._names.setdefault(kind, set())
        name = element.get("name") or f"furiko_{kind}_{len(taken) + 1}"
        if name in taken:
            raise element.wrong(f"a second {kind} called {name[:60]!r}; names must be unique")
        taken.add(name)
        element.attributes["name"] = name
        return name

    def _pose(self, element: Element) -> Pose:
        return Pose(self._turn(element), numbers(element, "pos", 3, (0.0, 0.0, 0.0)))

    def _turn(self, element: Element) -> Array:
        given = [name for name in TURNED_BY if name in element.attributes]
        if len(given) > 1:
            raise element.wrong(f"{' and '.join(given)}: only one orientation can be given")
        if not given:
            return np.eye(3)
        name = given[0]
        values = numbers(element, name, {"quat": 4, "axisangle": 4, "xyaxes": 6, "zaxis": 3, "euler": 3}[name])
        compiler = self._compiler
        if name == "euler":
            return from_euler([compiler.angle(float(v)) for v in values], compiler.sequence)
        direction = values[:3] if name != "quat" else values
        if math.hypot(*direction) < 1e-10 or (
            name == "xyaxes" and np.linalg.norm(np.cross(values[:3], values[3:])) < 1e-10
        ):
            raise element.wrong(f"{name}={element.get(name)!r}: gives no direction")
        if name == "quat":
            return from_quaternion(values)
        if name == "axisangle":
            return about(values[:3], compiler.angle(float(values[3])))
        return from_x_and_y(values) if name == "xyaxes" else from_z_axis(values)

    def _hinge(self, merged: Element, given: Element) -> SpatialHinge:
        kind = "free" if given.tag == "freejoint" else merged.get("type", "hinge")
        if kind != "hinge":
            raise refuse(given, f"a joint of type {kind[:20]!r}")
        name = self._named(given, "joint")
        if "springdamper" in merged.attributes:
            raise given.wrong("springdamper: not supported; give stiffness and damping")
        compiler = self._compiler
        zero = compiler.angle(number(merged, "ref"))
        springref = compiler.angle(number(merged, "springref"))
        return SpatialHinge(
            name=name,
            axis=axis(merged, "axis", (0.0, 0.0, 1.0)),
            anchor=numbers(merged, "pos", 3, (0.0, 0.0, 0.0)),
            armature=not_negative(merged, "armature"),
            damping=self._on(_linear(merged, "damping"), "damper", "passive"),
            friction=self._on(not_negative(merged, "frictionloss"), "frictionloss", "constraint"),
            stiffness=self._on(_linear(merged, "stiffness"), "spring", "passive"),
            rest=springref - zero,
            stops=None if self._off & {"limit", "constraint"} else self._stops(merged, zero),
            zero=zero,
            where=str(given),
        )

    def _on(self, value: float, *flags: str) -> float:
        return 0.0 if self._off & set(flags) else value

    def _stops(self, merged: Element, zero: float) -> tuple[float, float] | None:
        limited = word(merged, "limited", ("true", "false", "auto"), "auto")
        ends = numbers(merged, "range", 2, (0.0, 0.0))
        if limited == "false" or (limited == "auto" and ("range" not in merged.attributes or not ends.any())):
            return None
        if limited == "auto" and not self._compiler.autolimits:
            raise merged.wrong("range without limited='true', and autolimits is off; MuJoCo refuses that: say limited")
        low, high = (self._compiler.angle(float(end)) - zero for end in ends)
        if low >= high:
            raise merged.wrong(f"range={merged.get('range')!r}: the lower limit must be the smaller")
        return low, high

    def _inertial(self, element: Element, name: str, childclass: str) -> Inertial:
        compiler = self._compiler
        given = element.first("inertial")
        from_geoms = compiler.from_geoms == "true" or (compiler.from_geoms == "auto" and given is None)
        drawn = self._drawn(element, childclass, from_geoms)
        if drawn is not None:
            self._file.geoms[name] = drawn
        if from_geoms:
            self._file.from_geoms.append(name)
            found = drawn or NOTHING
        else:
            found = self._given_inertial(given, name) if given is not None else NOTHING
        if not found.tensor.any() and 0 < compiler.least_inertia <= LIFTED:
            self._note(
                f"boundinertia={compiler.least_inertia:g} is taken as what lets MuJoCo's compiler take a point mass"
            )
            return Inertial(max(found.mass, compiler.least_mass), found.centre, found.tensor)
        return _bounded(found, compiler)

    def _given_inertial(self, given: Element, name: str) -> Inertial:
        if "pos" not in given.attributes or "mass" not in given.attributes:
            raise given.wrong("pos and mass are needed")
        pose = self._pose(given)
        mass = not_negative(given, "mass")
        if "fullinertia" in given.attributes:
            tensor = symmetric(*numbers(given, "fullinertia", 6))
            if any(turned in given.attributes for turned in TURNED_BY):
                raise given.wrong("fullinertia and an orientation: only one of them can be given")
            if np.linalg.eigvalsh(tensor)[0] < -1e-12 * abs(np.trace(tensor)):
                raise given.wrong("fullinertia: no body has an inertia with a negative principal moment")
        else:
            moments = numbers(given, "diaginertia", 3, (0.0, 0.0, 0.0))
            if (moments < 0).any():
                raise given.wrong(f"diaginertia={given.get('diaginertia')!r}: must not be negative")
            tensor = np.diag(moments)
        unturned = Inertial(mass, np.zeros(3), tensor)
        self._file.tensors[name] = (Inertial(mass, pose.shift, tensor), pose.turn)
        return unturned.seen_from(pose)

    def _drawn(self, element: Element, childclass: str, weigh: bool) -> Inertial | None:
        """All that the body's geoms weigh together; None where they weigh nothing, or cannot be told and need not."""
        total: Inertial | None = None
        low, high = self._compiler.groups
        pending: list[tuple[Element, Pose, str]] = [(element, HERE, childclass)]
        while pending:
            at, frame, inherited = pending.pop()
            pending.extend(
                (nested, frame @ self._pose(nested), nested.get("childclass", inherited)) for nested in at.all("frame")
            )
            for geom in list(at.all("geom")):
                merged = self._merged(geom, inherited)
                _strip(geom)
                if low <= number(merged, "group") <= high:
                    try:
                        pose = Pose(self._turn(merged), numbers(merged, "pos", 3, (0.0, 0.0, 0.0)))
                        part = geom_inertial(merged, pose)
                    except InvalidInput:
                        if weigh:
                            raise
                        part = None
                    if part is not None:
                        part = part.seen_from(frame)
                        total = part if total is None else total + part
                if merged.get("type", "sphere") in ("mesh", "sdf", "hfield"):
                    _remove(at, geom)  # weighs nothing here: only to be seen, or to be bumped into
                    self._note("geoms that are meshes are left out: they are not loaded, and do not collide")
        return total

    def _note(self, says: str) -> None:
        if says not in self._file.notes:
            self._file.notes.append(says)

    def _scale_to_total_mass(self) -> None:
        wanted, bodies = self._compiler.total_mass, self._file.bodies
        total = sum(body.inertial.mass for body in bodies)
        if wanted <= 0 or total <= 0:
            return
        scale = wanted / total
        self._file.bodies[:] = [
            replace(b, inertial=Inertial(b.inertial.mass * scale, b.inertial.centre, b.inertial.tensor * scale))
            for b in bodies
        ]


def _linear(element: Element, attribute: str) -> float:
    """A coefficient that may be followed by those of higher powers, which must be zero."""
    values = numbers(element, attribute, (1, 3), (0.0,))
    if values[0] < 0 or values[1:].any():
        raise element.wrong(f"{attribute}={element.get(attribute)!r}: one number, not negative, is needed")
    return float(values[0])


def _bounded(inertial: Inertial, compiler: Compiler) -> Inertial:
    """What the compiler's bounds make of an inertial; they act on the principal moments."""
    mass = max(inertial.mass, compiler.least_mass)
    tensor = inertial.tensor
    if compiler.least_inertia > 0 or compiler.balance:
        moments, turn = np.linalg.eigh(tensor)
        raised = np.maximum(moments, compiler.least_inertia)
        if compiler.balance and raised[0] + raised[1] < raised[2]:
            raised = np.full(3, raised.mean())
        if (raised != moments).any():
            isotropic = (raised == raised[0]).all()
            tensor = np.diag(raised) if isotropic else (turn * raised) @ turn.T
    return inertial if mass == inertial.mass and tensor is inertial.tensor else Inertial(mass, inertial.centre, tensor)


def _strip(element: Element) -> None:
    """Take away what refers to other files or to what has been left out."""
    for name in ("material", "mesh", "hfield", "fluidshape"):
        if name != "mesh" or element.get("type") in ("mesh", "sdf"):
            element.attributes.pop(name, None)
    element.children.clear()


def _remove(parent: Element, child: Element) -> None:
    for holder in [parent, *parent.all("frame")]:
        holder.children = [c for c in holder.children if c is not child]


def _included(root: Element, path: Path) -> Element:
    """The document with every <include> replaced by what it names, all of it inside the file's own folder."""
    folder = path.resolve().parent
    seen = {path.resolve()}
    count = 0

    def expand(element: Element) -> Element:
        nonlocal count
        pending = [(element, 0)]
        while pending:
            at, depth = pending.pop()
            if depth > DEEPEST:
                raise at.wrong(f"nested more than {DEEPEST} levels deep")
            children: list[Element] = []
            for child in at.children:
                children.extend(_include(child, folder, seen) if child.tag == "include" else (child,))
            while any(child.tag == "include" for child in children):
                children = [
                    part
                    for child in children
                    for part in (_include(child, folder, seen) if child.tag == "include" else (child,))
                ]
            count += len(children)
            if count > MOST_ELEMENTS:
                raise at.wrong(f"more than {MOST_ELEMENTS} elements with what it includes")
            at.children = children
            pending.extend((child, depth + 1) for child in children)
        return element

    return expand(root)


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


def option(root: Element, name: str) -> Any:
    """An attribute of <option>, the last one given."""
    return next((e.get(name) for e in reversed(root.children) if e.tag == "option" and e.get(name)), None)
