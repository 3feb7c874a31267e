"""What a mechanism is to the kernels: numbers, and a program of pieces with the places that they read and write.

Every joint has a frame of its own: at its anchor, the third axis along its axis, in a ball's or a free body's the
body's axes. The constant frames, one in another, are computed in numpy's longest float and rounded once, where that is
longer than a double. Bodies that are fixed to others are one with them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ....models.errors import InvalidInput
from ....models.spatial_mechanism import WORLD, Joint, PlacedJoint, RigidBody, SpatialMechanism
from . import formulas
from .formulas import INERTIA, NUMBERS, ROW, SIGNS
from .vectors import rotation_of

Array = NDArray[np.float64]
Long = NDArray[np.longdouble]
MOST_IN_LINE = 0.866  # cosine of the angle of two axes: 30 degrees
WIDTH = 10  # numbers of an instruction: which piece, and its places
PIECES: tuple[Callable[..., None], ...] = (
    formulas.place_hinge,
    formulas.hinge_first,
    formulas.hinge_next,
    formulas.turn,
    formulas.begin,
    formulas.turn_last,
    formulas.world_at_rest,
    formulas.world_falls,
    formulas.place_slide,
    formulas.place_ball,
    formulas.place_free,
    formulas.slide,
    formulas.slide_last,
    formulas.turn_within,
    formulas.slide_within,
    formulas.hand_first,
    formulas.hand_next,
    formulas.free_last,
    formulas.outer_within,
)
NUMBER = {piece.__name__: number for number, piece in enumerate(PIECES)}


@dataclass(eq=False)
class Node:
    """A joint and the bodies that it moves first: their inertial about the joint's point, in the joint's axes.

    ``rotation``, ``place``: its frame in its parent's, where that leaves it. ``row``: its first freedom's, depth first.
    """

    placed: PlacedJoint
    parent: Node | None
    rotation: Long
    place: Long
    mass: Any = field(default_factory=lambda: np.longdouble(0))
    moment: Long = field(default_factory=lambda: np.zeros(3, np.longdouble))
    tensor: Long = field(default_factory=lambda: np.zeros((3, 3), np.longdouble))
    children: list[Node] = field(default_factory=list)
    row: int = -1

    @property
    def weightless(self) -> bool:
        """Whether nothing of its own moves with it, but for what hangs on it."""
        return not (self.mass or self.moment.any() or self.tensor.any())

    @property
    def last(self) -> int:
        """The row of its last freedom, which has the body."""
        return self.row + self.placed.joint.freedoms - 1


@dataclass(frozen=True, eq=False)
class Table:
    """``numbers`` that all states share, the ``program`` (int64, :data:`WIDTH` a piece), and the size of the memory.

    Places of the memory: coordinates from ``at_q`` on, rates from ``at_v``, torques and then accelerations from
    ``at_torque``, ``signs``. ``nq``, ``nv``: how many.
    """

    numbers: Array
    program: NDArray[np.int64]
    size: int
    at_q: int
    at_v: int
    at_torque: int
    signs: int
    nq: int
    nv: int


_kept: WeakKeyDictionary[SpatialMechanism, Table] = WeakKeyDictionary()


def kept_table(mechanism: SpatialMechanism) -> Table:
    """As :func:`table`, made once for each mechanism."""
    found = _kept.get(mechanism)
    if found is None:
        found = _kept[mechanism] = table(mechanism)
    return found


def table(mechanism: SpatialMechanism) -> Table:
    """The table of a mechanism. Raises InvalidInput for a quaternion or axis of length zero."""
    roots = nodes(mechanism)
    ordered = list(depth_first(roots))
    freedoms = mechanism.nv
    world = freedoms * ROW
    at_q = world + ROW
    at_v = at_q + mechanism.nq
    at_torque = at_v + mechanism.nv
    signs = at_torque + mechanism.nv
    inertias = signs + SIGNS
    numbers = np.concatenate([*(constants(node) for node in ordered), mechanism.gravity])
    program = Program(world, at_q, at_v, at_torque, signs, inertias)
    for node in ordered:
        program.place(node)
    for node in reversed(ordered):
        program.eliminate(node)
    program.emit("world_falls", world, freedoms * NUMBERS)
    for node in ordered:
        program.accelerate(node)
    size = inertias + program.most * INERTIA
    instructions = np.array(program.instructions, dtype=np.int64).reshape(-1, WIDTH)
    return Table(numbers, instructions, size, at_q, at_v, at_torque, signs, mechanism.nq, mechanism.nv)


class Program:
    """The instructions, while they are written."""

    def __init__(self, world: int, at_q: int, at_v: int, at_torque: int, signs: int, inertias: int) -> None:
        self.world, self.at_q, self.at_v, self.at_torque = world, at_q, at_v, at_torque
        self.signs, self.inertias = signs, inertias
        self.instructions: list[list[int]] = []
        self.most = 0  # inertias at a time
        self._free: list[int] = []
        self._of: dict[int, int] = {}  # the place of a node's inertia, by its row
        self.emit("world_at_rest", world)

    def emit(self, piece: str, *places: int) -> None:
        """One more piece."""
        self.instructions.append([NUMBER[piece], *places, *[0] * (WIDTH - 1 - len(places))])

    def place(self, node: Node) -> None:
        """On through a joint."""
        placed = node.placed
        parent = self.world if node.parent is None else node.parent.last * ROW
        state = self.at_q + placed.at_q, self.at_v + placed.at_v, self.at_torque + placed.at_v
        self.emit(f"place_{placed.joint.kind}", node.row * ROW, parent, node.row * NUMBERS, *state, self.signs)

    def eliminate(self, node: Node) -> None:
        """All freedoms of a joint, the last first; its children are eliminated."""
        kinds = freedoms(node.placed.joint)
        if node.row not in self._of:
            self._of[node.row] = self._taken()
            self.emit("begin", self._of[node.row], node.last * ROW, node.last * NUMBERS)
        inertia = self._of.pop(node.row)
        if node.placed.joint.kind == "free":
            self.emit("free_last", inertia, node.row * ROW, node.row * NUMBERS, self.signs)
            self._free.append(inertia)
            return
        at = [(inertia, (node.row + k) * ROW, (node.row + k) * NUMBERS, self.signs) for k in range(len(kinds))]
        for k in reversed(range(1, len(kinds))):
            self.emit(f"{kinds[k]}_within", *at[k])
        parent, outer = node.parent, outermost_of_three(node)
        hinge = node.placed.joint.kind == "hinge" and not outer
        if outer:
            self.emit("outer_within", *at[0])
        elif parent is None:
            self.emit(f"{kinds[0]}_last", *at[0])
        elif not hinge:
            self.emit(f"{kinds[0]}_within", *at[0])
        if parent is None:
            self._free.append(inertia)
            return
        first = parent.row not in self._of
        target = self._of.setdefault(parent.row, inertia)
        own = at[0] if hinge else at[0][:2]
        to = (target, parent.last * ROW, parent.last * NUMBERS) if first else (target,)
        self.emit(f"{'hinge' if hinge else 'hand'}_{'first' if first else 'next'}", *own, *to)
        if not first:
            self._free.append(inertia)

    def accelerate(self, node: Node) -> None:
        """The accelerations of a joint's freedoms."""
        parent = self.world if node.parent is None else node.parent.last * ROW
        for k, kind in enumerate(freedoms(node.placed.joint)):
            own = (node.row + k) * ROW
            self.emit(kind, own, parent, self.at_torque + node.placed.at_v + k, self.signs)
            parent = own

    def _taken(self) -> int:
        if not self._free:
            self._free.append(self.inertias + self.most * INERTIA)
            self.most += 1
        return self._free.pop()


def outermost_of_three(node: Node) -> bool:
    """Whether a hinge is the first of three at one point that turn one body, the axes of the other two far from
    parallel, as :mod:`.formulas` eliminates them. The angle of neighbouring axes is the same in all states."""
    three = [node]
    while len(three) < 3 and len(three[-1].children) == 1:
        three += three[-1].children
    if len(three) < 3 or any(one.placed.joint.kind != "hinge" for one in three):
        return False
    if not (node.weightless and three[1].weightless):
        return False
    if any(one.place.any() or one.placed.joint.armature for one in three[1:]):
        return False
    return bool(abs(three[2].rotation[2, 2]) < MOST_IN_LINE)  # the cosine: the second's own axis is the third


def freedoms(joint: Joint) -> list[str]:
    """Whether each freedom of a joint turns or slides."""
    return {"hinge": ["turn"], "slide": ["slide"], "ball": ["turn"] * 3, "free": ["slide"] * 3 + ["turn"] * 3}[
        joint.kind
    ]


def constants(node: Node) -> Array:
    """The numbers of a joint's freedoms, one row after another."""
    joint = node.placed.joint
    rows = np.zeros((joint.freedoms, NUMBERS))
    rows[:, formulas.ARMATURE], rows[:, formulas.DAMPING] = joint.armature, joint.damping
    rows[0, formulas.FRAME : formulas.PLACE] = node.rotation.ravel()
    rows[0, formulas.PLACE : formulas.TENSOR] = node.place
    if joint.kind in ("hinge", "slide"):
        rows[0, formulas.STIFFNESS : formulas.NUMBERS] = joint.stiffness, joint.springref, joint.ref
    symmetric = (node.tensor + node.tensor.T) / 2
    rows[-1, formulas.TENSOR : formulas.MOMENT] = symmetric[np.triu_indices(3)]
    rows[-1, formulas.MOMENT : formulas.MASS] = node.moment
    rows[-1, formulas.MASS] = node.mass
    return rows.ravel()


def depth_first(roots: Iterable[Node]) -> Iterable[Node]:
    """Every node before those that hang on it, each with all that hangs on it; numbers their rows."""
    waiting = [*roots][::-1]
    row = 0
    while waiting:
        node = waiting.pop()
        node.row = row
        row += node.placed.joint.freedoms
        yield node
        waiting += reversed(node.children)


def nodes(mechanism: SpatialMechanism) -> list[Node]:
    """The joints that hang in the world, and on them all others."""
    roots: list[Node] = []
    carriers: list[tuple[Node | None, Long, Long]] = []  # of each body: the joint that moves it, and its pose there
    placed: dict[int, list[PlacedJoint]] = {}
    for joint in mechanism.joints:
        placed.setdefault(joint.body, []).append(joint)
    for index, body in enumerate(mechanism.bodies):
        carrier, rotation, place = (None, np.eye(3, dtype=np.longdouble), np.zeros(3, np.longdouble))
        if body.parent != WORLD:
            carrier, rotation, place = carriers[body.parent]
        place = place + rotation @ body.position
        rotation = rotation @ of_quaternion(body)
        for one in placed.get(index, ()):
            own, back, offset = joint_frame(one.joint)
            anchor: Long = np.asarray(place + rotation @ offset, dtype=np.longdouble)
            node = Node(one, carrier, rotation @ own, anchor)
            (roots if carrier is None else carrier.children).append(node)
            carrier, rotation, place = node, back, -(back @ offset)
        carriers.append((carrier, rotation, place))
        if carrier is not None:
            weigh(carrier, body, rotation, place)
    return roots


def joint_frame(joint: Joint) -> tuple[Long, Long, Long]:
    """The joint's frame in the body's (rotation), the body's in the joint's, moved by 0, and the frame's place."""
    offset = np.zeros(3, np.longdouble)
    if joint.kind in ("ball", "hinge"):
        offset = offset + joint.anchor
    if joint.kind in ("ball", "free"):
        return np.eye(3, dtype=np.longdouble), np.eye(3, dtype=np.longdouble), offset
    own = along(joint)
    if joint.kind == "slide":
        return own, own.T, offset
    angle = np.longdouble(joint.ref)
    c, s = np.cos(angle), np.sin(angle)
    zero, one = np.longdouble(0), np.longdouble(1)
    return own, np.array([[c, s, zero], [-s, c, zero], [zero, zero, one]]) @ own.T, offset


def along(joint: Joint) -> Long:
    """A rotation whose third column is the joint's axis."""
    axis = joint.axis.astype(np.longdouble)
    scale = np.abs(axis).max(initial=0.0)
    if not scale > 0:
        raise InvalidInput(f"joint {joint.name!r}: its axis has length zero")
    axis = axis / scale
    axis = axis / np.sqrt(axis @ axis)
    other = np.zeros(3, np.longdouble)
    other[np.abs(axis).argmin()] = 1
    first = np.cross(other, axis)
    first = first / np.sqrt(first @ first)
    return np.stack([first, np.cross(axis, first), axis], axis=1)


def of_quaternion(body: RigidBody) -> Long:
    """The rotation of a body's quaternion."""
    q = body.quaternion.astype(np.longdouble)
    scale = np.abs(q).max(initial=0.0)
    if not scale > 0:
        raise InvalidInput(f"body {body.name!r}: its quaternion has length zero")
    return np.array(rotation_of(q / scale), dtype=np.longdouble).reshape(3, 3)


def weigh(node: Node, body: RigidBody, rotation: Long, place: Long) -> None:
    """Add a body's inertial; its frame is there in the joint's."""
    inertial = body.inertial
    if inertial.weightless:
        return
    mass = np.longdouble(inertial.mass)
    centre = place + rotation @ inertial.centre
    tensor = (inertial.tensor.astype(np.longdouble) + inertial.tensor.T) / 2
    node.mass += mass
    node.moment = node.moment + mass * centre
    about = np.eye(3, dtype=np.longdouble) * (centre @ centre) - np.outer(centre, centre)
    node.tensor = np.asarray(node.tensor + rotation @ tensor @ rotation.T + mass * about, dtype=np.longdouble)
