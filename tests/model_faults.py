"""Planted faults, and sound models that look as if they had one: random frames, topologies and sizes.

Everything is made from a mechanism drawn at random. What carries a fault is a model file, or a real engine built on
the faulty mechanism and asked through an adapter that knows only the sound one: never the equations under test.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from furiko.models import Link, PlanarTree
from furiko.models.mechanism import Hinge, Mechanism
from furiko.models.spatial import Inertial, Pose, from_axis_angle, to_quaternion
from furiko.models.tree import SUPPORT

GRAVITY = 9.81


@dataclass(frozen=True)
class Shape:
    """A tree as engines' adapters want their system."""

    given: PlanarTree
    kind: str = "planar-tree"

    @property
    def n(self):
        return self.given.n

    @property
    def gravity(self):
        return self.given.gravity

    @property
    def masses(self):
        return tuple(link.mass for link in self.given.links)

    @property
    def lengths(self):
        return tuple(link.length for link in self.given.links)

    def tree(self):
        return self.given


def random_tree(rng, n=None, kind=None, straight=None, bobs=None):
    """A chain, a star or any tree; centres and hinges on the links' axes or off them; some links point masses."""
    n = int(rng.integers(1, 11)) if n is None else n
    kind = rng.choice(["chain", "star", "tree"]) if kind is None else kind
    straight = rng.random() < 0.5 if straight is None else straight
    bobs = rng.random() < 0.25 if bobs is None else bobs

    def off():
        return 0.0 if straight else float(rng.uniform(-0.3, 0.3))

    links = []
    for i in range(n):
        parent = SUPPORT if i == 0 else {"chain": i - 1, "star": 0, "tree": int(rng.integers(-1, i))}[kind]
        length = float(rng.uniform(0.4, 1.3))
        mass = float(rng.uniform(0.3, 3.0))
        hinge = (0.0, 0.0) if i == 0 else (links[parent].length if parent >= 0 else 0.0, off())
        com = (length if bobs else float(rng.uniform(0.3, 0.7)) * length, off())
        inertia = 0.0 if bobs else mass * length**2 * float(rng.uniform(0.05, 0.12))
        links.append(Link(parent, hinge, length, com, mass, inertia))
    return PlanarTree(tuple(links), GRAVITY if rng.random() < 0.5 else float(rng.uniform(1, 20)))


def free(tree):
    """The tree as a mechanism on ideal hinges."""
    n = tree.n
    hinges = tuple(Hinge(name=f"hinge{i + 1:02}") for i in range(n))
    names = tuple(f"link{i + 1:02}" for i in range(n))
    return Mechanism(tree.links, hinges, (tree.gravity, 0.0), names, (0.0, 0.0, -tree.gravity))


def with_hinge(mechanism, i, **changes):
    hinges = list(mechanism.hinges)
    hinges[i] = replace(hinges[i], **changes)
    return replace(mechanism, hinges=tuple(hinges))


def with_link(mechanism, i, **changes):
    links = list(mechanism.links)
    links[i] = replace(links[i], **changes)
    return replace(mechanism, links=tuple(links))


# --- Writing a mechanism with all the freedom that files give ---------------------------------------------------------


@dataclass
class Style:
    """How a file is written: nothing here changes the motion."""

    language: str = "mjcf"
    turn_world: bool = False  # the plane, and gravity with it, turned in space
    turn_frames: bool = False  # bodies' frames turned and shifted against the links
    turn_inertials: bool = False  # inertial frames turned, tensors with them
    turn_zero: bool = False  # q = 0 is another pose
    flip_axes: bool = False
    reorder: bool = False
    split: bool = False  # links of two bodies fixed together
    full: bool = False  # tensors written by their six numbers
    aslant: tuple[float, float, float] | None = None  # gravity (down, across, out of plane) instead of straight
    geoms: dict[int, str] = field(default_factory=dict)
    compiler: str = ""
    option: str = ""
    raw_rest: bool = False  # angles written in radians though read as degrees


def random_style(rng, language=None):
    language = str(rng.choice(["mjcf", "urdf"])) if language is None else language
    coin = lambda: bool(rng.random() < 0.5)  # noqa: E731
    return Style(language, coin(), coin(), coin(), bool(rng.random() < 0.3), coin(), coin(), coin(), coin())


def numbers(values):
    return " ".join(repr(float(v)) for v in np.ravel(values))


class Writer:
    """Writes one mechanism in one style."""

    def __init__(self, mechanism, style, rng):
        self.m, self.style, self.rng = mechanism, style, rng
        n = mechanism.n
        self.zero = rng.uniform(-2, 2, n) if style.turn_zero else np.zeros(n)
        world = self._rotation() if style.turn_world else np.eye(3)
        if style.turn_world and style.language == "urdf":
            world = from_axis_angle([0, 0, 1], rng.uniform(-3, 3))
        # Columns: down, across and the hinge axis of the plane, in the world.
        self.plane = world @ np.array([[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]])
        self.sense = np.where(rng.random(n) < 0.5, -1.0, 1.0) if style.flip_axes else np.ones(n)
        self.frames = [self._frame(i) for i in range(n)]
        self.children = {i: [c for c in range(n) if mechanism.links[c].parent == i] for i in range(-1, n)}
        if style.reorder:
            for c in self.children.values():
                rng.shuffle(c)

    def _rotation(self):
        return from_axis_angle(self.rng.normal(size=3), self.rng.uniform(0, 3))

    def _frame(self, i):
        """The body's frame in the link's own (down, across, axis) frame, whose origin is the hinge."""
        style, rng = self.style, self.rng
        turn = self._rotation() if style.turn_frames else np.linalg.inv(np.array([[0.0, 1, 0], [0, 0, -1], [-1, 0, 0]]))
        shift = rng.normal(size=3) * 0.3 if style.turn_frames else np.zeros(3)
        if style.language == "urdf":  # a joint is at its child's origin, anywhere along the axis
            shift = np.array([0.0, 0.0, shift[2]])
        return Pose(turn, shift)

    def link_pose(self, i):
        """The link's frame in that of its parent's link (or the plane), at q = 0."""
        link = self.m.links[i]
        base = self.zero[link.parent] if link.parent >= 0 else 0.0
        return Pose(from_axis_angle([0, 0, 1], self.zero[i] - base), np.array([*link.hinge, 0.0]))

    def body_pose(self, i):
        """The body's frame in its parent body's (or the world)."""
        parent = self.m.links[i].parent
        inner = self.link_pose(i) @ self.frames[i]
        if parent < 0:
            return Pose(self.plane, np.zeros(3)) @ inner
        return inverse(self.frames[parent]) @ inner

    def tensor(self, i):
        """A tensor about the centre of mass, in the link's frame, whose moment about the axis is the link's."""
        wanted = self.m.links[i].inertia
        if wanted == 0:
            return np.zeros((3, 3))
        if not self.style.turn_inertials:
            return np.diag([wanted * 0.9, wanted * 0.6, wanted])
        turn = self._rotation()
        a, b = self.rng.uniform(0.5, 1.5, 2)
        c = self.rng.uniform(abs(a - b) + 0.05, a + b - 0.05)
        tensor = turn @ np.diag([a, b, c]) @ turn.T
        return tensor * (wanted / tensor[2, 2])

    def inertials(self, i):
        """One inertial, or two that are fixed together: (pose in the body's frame, Inertial in its own frame)."""
        link, frame = self.m.links[i], self.frames[i]
        whole = Inertial(link.mass, np.array([*link.com, self.rng.normal() * 0.05]), self.tensor(i))
        parts = [whole]
        if self.style.split and link.inertia:
            small = Inertial(
                0.2 * link.mass,
                whole.centre + self.rng.uniform(-0.08, 0.08, 3) * math.sqrt(link.inertia / link.mass),
                whole.tensor * 0.3,
            )
            rest = 0.8 * link.mass
            centre = (link.mass * whole.centre - small.mass * small.centre) / rest
            tensor = whole.tensor - small.tensor_about(whole.centre)
            r = centre - whole.centre
            tensor = tensor - rest * (r @ r * np.eye(3) - np.outer(r, r))
            parts = [Inertial(rest, centre, tensor), small]
        return [part.transformed(inverse(frame)) for part in parts]

    # MJCF

    def mjcf(self):
        style = self.style
        down, across, out = style.aslant or (self.m.gravity[0], 0.0, 0.0)
        gravity = self.plane @ np.array([down, across, out])
        compiler = style.compiler or "angle='radian' autolimits='true'"
        if any(k.inertia == 0 for k in self.m.links):
            compiler += " boundinertia='1e-15'"
        parts = [f"<mujoco><compiler {compiler}/><option gravity='{numbers(gravity)}' {style.option}/><worldbody>"]
        parts += [self._body(i) for i in self.children[-1]]
        return "".join([*parts, "</worldbody></mujoco>"])

    def _body(self, i):
        pose, frame, hinge = self.body_pose(i), self.frames[i], self.m.hinges[i]
        into = inverse(frame)
        axis, anchor = into.rotation @ np.array([0, 0, self.sense[i]]), into.translation
        rest = 0.0
        if hinge.stiffness:
            base = self.zero[self.m.links[i].parent] if self.m.links[i].parent >= 0 else 0.0
            rest = self.sense[i] * (hinge.rest - (self.zero[i] - base))
        attributes = {"armature": hinge.armature, "damping": hinge.damping, "frictionloss": hinge.friction,
                      "stiffness": hinge.stiffness, "springref": rest}  # fmt: skip
        text = " ".join(f"{k}='{float(v)!r}'" for k, v in attributes.items() if v)
        if hinge.limits:
            base = self.zero[self.m.links[i].parent] if self.m.links[i].parent >= 0 else 0.0
            ends = sorted(self.sense[i] * (stop - (self.zero[i] - base)) for stop in hinge.limits)
            text += f" range='{numbers(ends)}'"
        quat = numbers(to_quaternion(pose.rotation))
        parts = [f"<body name='{self.m.link_names[i]}' pos='{numbers(pose.translation)}' quat='{quat}'>"]
        parts.append(f"<joint name='{hinge.name}' axis='{numbers(axis)}' pos='{numbers(anchor)}' {text}/>")
        parts.append(self.style.geoms.get(i, ""))
        first, *others = self.inertials(i)
        parts.append(self._inertial(first))
        for k, other in enumerate(others):
            fixed = Pose(self._rotation(), self.rng.normal(size=3) * 0.1)
            inside = other.transformed(inverse(fixed))
            parts.append(
                f"<body name='{self.m.link_names[i]}_fixed{k}' pos='{numbers(fixed.translation)}' "
                f"quat='{numbers(to_quaternion(fixed.rotation))}'>{self._inertial(inside)}</body>"
            )
        parts += [self._body(c) for c in self.children[i]]
        return "".join([*parts, "</body>"])

    def _inertial(self, inertial):
        t = inertial.tensor
        if self.style.full:
            six = numbers([t[0, 0], t[1, 1], t[2, 2], t[0, 1], t[0, 2], t[1, 2]])
            written = f"fullinertia='{six}'" if t.any() else "diaginertia='0 0 0'"
        else:
            moments, turn = np.linalg.eigh(t)
            if np.linalg.det(turn) < 0:
                turn = turn * np.array([1, 1, -1])
            written = f"diaginertia='{numbers(moments)}' quat='{numbers(to_quaternion(turn))}'"
            if not t.any():
                written = "diaginertia='0 0 0'"
        return f"<inertial pos='{numbers(inertial.centre)}' mass='{inertial.mass!r}' {written}/>"

    # URDF

    def urdf(self):
        parts = ["<robot name='planted'><link name='world'/>"]
        order = list(range(self.m.n))
        if self.style.reorder:
            self.rng.shuffle(order)
        for i in order:
            parts += [self._link(i), self._joint(i)]
        return "".join([*parts, "</robot>"])

    def _link(self, i):
        first, *others = self.inertials(i)
        name = self.m.link_names[i]
        parts = [f"<link name='{name}'>{self._urdf_inertial(first)}</link>"]
        for k, other in enumerate(others):
            fixed = Pose(self._rotation(), self.rng.normal(size=3) * 0.1)
            inside = other.transformed(inverse(fixed))
            parts.append(f"<link name='{name}_fixed{k}'>{self._urdf_inertial(inside)}</link>")
            parts.append(
                f"<joint name='{name}_weld{k}' type='fixed'><parent link='{name}'/><child link='{name}_fixed{k}'/>"
                f"{origin(fixed)}</joint>"
            )
        return "".join(parts)

    def _joint(self, i):
        link, hinge = self.m.links[i], self.m.hinges[i]
        parent = "world" if link.parent < 0 else self.m.link_names[link.parent]
        axis = inverse(self.frames[i]).rotation @ np.array([0, 0, self.sense[i]])
        limit, kind = "", "continuous"
        if hinge.limits:
            base = self.zero[link.parent] if link.parent >= 0 else 0.0
            low, high = sorted(self.sense[i] * (stop - (self.zero[i] - base)) for stop in hinge.limits)
            limit, kind = (
                f"<limit lower='{float(low)!r}' upper='{float(high)!r}' effort='100' velocity='100'/>",
                "revolute",
            )
        dynamics = f"<dynamics damping='{hinge.damping!r}' friction='{hinge.friction!r}'/>"
        return (
            f"<joint name='{hinge.name}' type='{kind}'><parent link='{parent}'/><child link='{self.m.link_names[i]}'/>"
            f"{origin(self.body_pose(i))}<axis xyz='{numbers(axis)}'/>{dynamics}{limit}</joint>"
        )

    def _urdf_inertial(self, inertial):
        turn = self._rotation() if self.style.turn_inertials else np.eye(3)
        t = turn.T @ inertial.tensor @ turn
        six = zip(("ixx", "iyy", "izz", "ixy", "ixz", "iyz"),
                  (t[0, 0], t[1, 1], t[2, 2], t[0, 1], t[0, 2], t[1, 2]), strict=True)  # fmt: skip
        written = " ".join(f"{k}='{float(v)!r}'" for k, v in six)
        pose = origin(Pose(turn, inertial.centre))
        return f"<inertial>{pose}<mass value='{inertial.mass!r}'/><inertia {written}/></inertial>"

    def text(self):
        return self.mjcf() if self.style.language == "mjcf" else self.urdf()


def inverse(pose):
    return Pose(pose.rotation.T, -pose.rotation.T @ pose.translation)


def origin(pose):
    r = pose.rotation
    pitch = math.atan2(-r[2, 0], math.hypot(r[0, 0], r[1, 0]))
    roll, yaw = math.atan2(r[2, 1], r[2, 2]), math.atan2(r[1, 0], r[0, 0])
    return f"<origin xyz='{numbers(pose.translation)}' rpy='{numbers([roll, pitch, yaw])}'/>"


def written(mechanism, style, rng):
    """The mechanism as a file's text."""
    return Writer(mechanism, style, rng).text()


def saved(text, folder, language):
    path = Path(folder, f"model.{'xml' if language == 'mjcf' else 'urdf'}")
    path.write_text(text)
    return path


# --- Sound models ---------------------------------------------------------------------------------------------------


def mass_moved(mechanism, rng):
    """Some mass of a link that carries others, at their hinge, given to the one that hangs there: the same motion."""
    carried = [c for c, link in enumerate(mechanism.links) if link.parent >= 0]
    if not carried:
        return mechanism
    c = int(rng.choice(carried))
    p = mechanism.links[c].parent
    child, parent = mechanism.links[c], mechanism.links[p]
    moved = 0.1 * min(child.mass, parent.mass) * float(rng.uniform(-1, 1))
    more = add_point(child, moved, (0.0, 0.0))
    less = add_point(parent, -moved, child.hinge)
    if min(more.inertia, less.inertia) <= 0:
        return mechanism
    return with_link(with_link(mechanism, c, **changed(more)), p, **changed(less))


def add_point(link, mass, at):
    total = link.mass + mass
    com = tuple((link.mass * a + mass * b) / total for a, b in zip(link.com, at, strict=True))
    inertia = link.inertia + link.mass * math.dist(link.com, com) ** 2 + mass * math.dist(at, com) ** 2
    return replace(link, mass=total, com=com, inertia=inertia)


def changed(link):
    return {"mass": link.mass, "com": link.com, "inertia": link.inertia}


def sound_model(rng):
    """(text, style, what is wanted): a file that looks suspicious and is not."""
    tree = random_tree(rng)
    wanted = free(tree)
    model = wanted
    if rng.random() < 0.3 and all(link.inertia for link in tree.links):
        model = mass_moved(model, rng)
    style = random_style(rng)
    return written(model, style, rng), style, wanted


# --- Planted faults in files ----------------------------------------------------------------------------------------


@dataclass
class Planted:
    """``cause`` is what must be named; ``text`` the file, ``wanted`` what it is held against."""

    cause: str
    text: str
    language: str
    wanted: Mechanism
    n: int


def off(rng, least=0.02, most=0.5):
    """A factor near one and not one, or further off."""
    return float(1 + rng.choice([-1, 1]) * rng.uniform(least, most))


def plant_armature(rng, style):
    wanted = free(random_tree(rng))
    i, all_of_them = int(rng.integers(wanted.n)), rng.random() < 0.3
    value = float(10 ** rng.uniform(-3, 0))
    model = wanted
    for k in range(wanted.n) if all_of_them else [i]:
        model = with_hinge(model, k, armature=value)
    return model, wanted


def plant_damping(rng, style):
    wanted = free(random_tree(rng))
    return with_hinge(wanted, int(rng.integers(wanted.n)), damping=float(10 ** rng.uniform(-3, 0))), wanted


def plant_friction(rng, style):
    wanted = free(random_tree(rng))
    return with_hinge(wanted, int(rng.integers(wanted.n)), friction=float(10 ** rng.uniform(-3, 0))), wanted


def plant_stiffness(rng, style):
    wanted = free(random_tree(rng))
    rest = float(rng.uniform(-1, 1))
    return with_hinge(wanted, int(rng.integers(wanted.n)), stiffness=float(rng.uniform(0.1, 5)), rest=rest), wanted


def plant_limit(rng, style):
    style.turn_zero = False
    wanted = free(random_tree(rng))
    stops = (-float(rng.uniform(0.5, 3)), float(rng.uniform(0.5, 3)))
    return with_hinge(wanted, int(rng.integers(wanted.n)), limits=stops), wanted


def plant_mass(rng, style):
    wanted = free(random_tree(rng))
    i = int(rng.integers(wanted.n))
    return with_link(wanted, i, mass=wanted.links[i].mass * off(rng)), wanted


def plant_length(rng, style):
    wanted = free(random_tree(rng, n=int(rng.integers(2, 11)), kind=str(rng.choice(["chain", "star"]))))
    i = wanted.links[int(rng.integers(1, wanted.n))].parent
    factor = off(rng)
    model = wanted
    for c in range(wanted.n):
        if wanted.links[c].parent == i:
            model = with_link(model, c, hinge=tuple(factor * x for x in wanted.links[c].hinge))
    return model, wanted


def plant_inertia(rng, style):
    wanted = free(random_tree(rng, bobs=False))
    i = int(rng.integers(wanted.n))
    return with_link(wanted, i, inertia=wanted.links[i].inertia * off(rng)), wanted


def plant_gravity(rng, style):
    style.language = "mjcf"
    wanted = free(random_tree(rng))
    g = wanted.gravity[0] * off(rng)
    return replace(wanted, gravity=(g, 0.0)), wanted


def plant_gravity_turned(rng, style):
    style.language, style.turn_world, style.turn_zero = "mjcf", False, False
    wanted = free(random_tree(rng, straight=True))
    g, angle = wanted.gravity[0], float(rng.choice([-1, 1]) * rng.uniform(0.05, 1.0))
    inside = rng.random() < 0.5
    style.aslant = (
        (g * math.cos(angle), g * math.sin(angle), 0.0) if inside else (g * math.cos(angle), 0.0, g * math.sin(angle))
    )
    return wanted, wanted


def plant_com(rng, style):
    style.turn_zero = False
    wanted = free(random_tree(rng, bobs=False))
    i = int(rng.integers(wanted.n))
    a, b = wanted.links[i].com
    return with_link(wanted, i, com=(a + float(rng.uniform(0.02, 0.2)), b + float(rng.uniform(0.02, 0.2)))), wanted


def plant_com_turned(rng, style):
    style.turn_zero = False
    # Of a link that carries nothing, turning its centre about its hinge is counting its angle from elsewhere.
    wanted = free(random_tree(rng, n=int(rng.integers(2, 11)), kind=str(rng.choice(["chain", "star"])), bobs=False))
    i = int(rng.choice([link.parent for link in wanted.links if link.parent >= 0]))
    angle = float(rng.choice([-1, 1]) * rng.uniform(0.1, 3.0))
    z = complex(*wanted.links[i].com) * complex(math.cos(angle), math.sin(angle))
    return with_link(wanted, i, com=(z.real, z.imag)), wanted


def plant_point_mass(rng, style):
    wanted = free(random_tree(rng, bobs=True))
    i = int(rng.integers(wanted.n))
    return with_link(wanted, i, inertia=float(10 ** rng.uniform(-8, -3))), wanted


def plant_from_geoms(rng, style):
    style.language, style.split = "mjcf", False
    style.compiler = "angle='radian' inertiafromgeom='true'"
    wanted = free(random_tree(rng, bobs=False))
    for i, link in enumerate(wanted.links):
        half = link.length / 2
        style.geoms[i] = (
            f"<geom type='capsule' size='{link.length / 30!r} {half!r}' pos='0 0 {-half!r}' contype='0' "
            "conaffinity='0'/>"
        )
    return wanted, wanted


def plant_degrees(rng, style):
    style.language, style.turn_zero = "mjcf", False
    wanted = free(random_tree(rng))
    i = int(rng.integers(wanted.n))
    if rng.random() < 0.5:
        wanted = with_hinge(
            wanted, i, stiffness=float(rng.uniform(0.5, 3)), rest=float(rng.choice([-1, 1]) * rng.uniform(0.3, 2))
        )
    else:
        wanted = with_hinge(wanted, i, limits=(-float(rng.uniform(0.5, 3)), float(rng.uniform(0.5, 3))))
    style.compiler = "angle='degree'"
    return wanted, wanted


def plant_spring_reference(rng, style):
    style.language, style.turn_zero = "mjcf", False
    wanted = free(random_tree(rng))
    i = int(rng.integers(wanted.n))
    wanted = with_hinge(wanted, i, stiffness=float(rng.uniform(0.5, 3)), rest=float(rng.uniform(0.3, 2)))
    return with_hinge(wanted, i, rest=float(rng.uniform(-2, 0))), wanted


def plant_dropped(rng, style):
    wanted = free(random_tree(rng, n=int(rng.integers(2, 11))))
    leaves = [i for i in range(wanted.n) if all(k.parent != i for k in wanted.links)]
    k = int(rng.choice([i for i in leaves if wanted.links[i].parent >= 0] or leaves))
    return fused(wanted, k), wanted


def plant_added(rng, style):
    model, wanted = plant_dropped(rng, style)
    return wanted, model


def fused(mechanism, k):
    """Leaf k fixed to the link that carries it."""
    lost = mechanism.links[k]
    p = lost.parent
    links = list(mechanism.links)
    if p >= 0:
        carrier = links[p]
        at = (lost.hinge[0] + lost.com[0], lost.hinge[1] + lost.com[1])
        links[p] = add_point(carrier, lost.mass, at)
        links[p] = replace(links[p], inertia=links[p].inertia + lost.inertia)
    kept = [i for i in range(mechanism.n) if i != k]
    place = {old: new for new, old in enumerate(kept)} | {SUPPORT: SUPPORT}
    return replace(
        mechanism,
        links=tuple(replace(links[i], parent=place[links[i].parent]) for i in kept),
        hinges=tuple(mechanism.hinges[i] for i in kept),
        link_names=tuple(mechanism.link_names[i] for i in kept),
    )


def plant_colliding(rng, style):
    style.language, style.split = "mjcf", False
    wanted = free(random_tree(rng, n=int(rng.integers(3, 8)), kind="chain", bobs=False))
    for i, link in enumerate(wanted.links):
        style.geoms[i] = f"<geom type='sphere' size='{0.45 * link.length!r}' mass='0'/>"
    return wanted, wanted


IN_FILES: dict[str, Callable[..., Any]] = {
    "armature": plant_armature,
    "damping": plant_damping,
    "dry-friction": plant_friction,
    "stiffness": plant_stiffness,
    "joint-limit": plant_limit,
    "mass": plant_mass,
    "length": plant_length,
    "inertia": plant_inertia,
    "gravity": plant_gravity,
    "gravity-turned": plant_gravity_turned,
    "com-displaced": plant_com,
    "inertial-com-rotated": plant_com_turned,
    "point-mass-patched": plant_point_mass,
    "inertia-from-geoms": plant_from_geoms,
    "degree-vs-radian": plant_degrees,
    "spring-reference": plant_spring_reference,
    "joint-dropped-by-parser": plant_dropped,
    "joint-added": plant_added,
    "colliding-geoms": plant_colliding,
}
ONLY_MJCF = {"armature", "stiffness"}


def planted_in_file(cause, rng):
    """A file with exactly this fault."""
    style = random_style(rng, "mjcf" if cause in ONLY_MJCF else None)
    model, wanted = IN_FILES[cause](rng, style)
    return Planted(cause, written(model, style, rng), style.language, wanted, model.n)


def diagnosed(text, language, wanted):
    """Findings of ``diagnose`` for a text, through a file."""
    from furiko.diagnosis.diagnose import diagnose

    with tempfile.TemporaryDirectory() as folder:
        return diagnose(saved(text, folder, language), wanted)
