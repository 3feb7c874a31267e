"""A mechanism written as MJCF or URDF, with all the freedom that these formats give."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from furiko.models.spatial import Inertial, Pose, from_axis_angle, to_quaternion


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
