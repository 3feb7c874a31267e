"""A mechanism's joints in Monte-Carlo arithmetic: where they are, and the inertias that they move, in the world's axes.

A turned frame is known to the last digits of 1 in each entry: an engine has it from angles or a quaternion, and what is
0 in it need not be 0 there. A place that is a difference of places in the world has their last digits.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.spatial_mechanism import SpatialMechanism
from ..kernels.trees.table import Node, depth_first, nodes
from ..kernels.trees.vectors import add, cross, dot, product, rotation_of, scaled, times, transposed
from ..rounding.monte_carlo import Noise, Noisy
from ..rounding.spread import Formulation

Array = NDArray[np.float64]

SAMPLES = 16  # the spread is then known to a fifth of itself
SEED = 20261128
UNTURNED = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
# What MuJoCo's iteration for principal axes leaves of a tensor's norm: 14 ε in the median of random ones, 44 at most.
OF_PRINCIPAL_AXES = 20.0
OF_A_FRAME = 2.0  # an entry is a sum of two products of a quaternion's numbers, each rounded, of numbers up to 1


Freedoms = list[tuple[int, list[Any]]]  # columns, and axes in the world


@dataclass
class Joint:
    """A joint and the bodies that it moves, in Monte-Carlo arithmetic, in the world's axes.

    ``reach``: the length of its way from the world at rest [m]; ``turned``: how many frames on it are turned;
    ``turns``, ``slides``: axes of its freedoms, with their columns; ``arm``: from the parent's point to its own;
    ``point``: in the world; ``moment`` and ``tensor`` (9) about its point.
    """

    parent: int
    reach: float
    turned: int
    arm: list[Any]
    point: list[Any]
    rotation: list[Any]
    slides: Freedoms
    turns: Freedoms
    mass: Any
    moment: list[Any]
    tensor: list[Any]

    @property
    def weighs(self) -> bool:
        """Whether its bodies have a mass."""
        return isinstance(self.mass, Noisy)


class Run:
    """A mechanism's joints in states ``q`` (B, nq): numbers of (samples, states), each rounded at random."""

    def __init__(self, mechanism: SpatialMechanism, how: Formulation, q: Array) -> None:
        self.shape = (SAMPLES, len(q))
        self.noise = Noise(SEED, how.accuracy)
        self.armature = mechanism.per_freedom("armature")
        self.world = how.placed == "world"
        self.diagonalised = how.moments == "tree"
        ordered = list(depth_first(nodes(mechanism)))
        index = {id(node): number for number, node in enumerate(ordered)}
        self.joints: list[Joint] = []
        for node in ordered:
            parent = -1 if node.parent is None else index[id(node.parent)]
            self.joints.append(self._joint(node, parent, q))

    def array(self, number: Noisy | float) -> Noisy:
        """A number of one run as one of many."""
        return number if isinstance(number, Noisy) else Noisy(np.full(self.shape, float(number)), self.noise)

    def values(self, numbers: list[Any]) -> Array:
        """(samples, B, n)."""
        return np.stack([self.array(number).value for number in numbers], axis=-1)

    def state(self, column: Array) -> Noisy | float:
        """A coordinate of each state, the number 0 where it is that in all."""
        return Noisy(np.broadcast_to(column, self.shape), self.noise) if column.any() else 0.0

    def known(self, number: float, size: float | Array = 0.0) -> Noisy | float:
        """A constant, with the last digit of its own; and of ``size`` besides."""
        if number == 0.0 and not np.any(size):
            return 0.0
        own = self.noise(np.full(self.shape, float(number)))
        return self.off(own.value, size) if np.any(size) else own

    def off(self, number: Array, size: Array | float) -> Noisy:
        """A number, (B,) or (samples, B), with the last digit of another ``size`` besides."""
        ones = self.noise(np.ones(self.shape)).value - 1.0
        return Noisy(number + ones * size, self.noise)

    def frame(self, rotation: list[float], turned: int) -> list[Any]:
        """A constant rotation by rows (9): exact where no axis is turned; the ``turned``-th on its way if it is."""
        if rotation == UNTURNED:
            return [*rotation]
        return [self.known(x, OF_A_FRAME * (2 * turned if self.world else 1)) for x in rotation]

    def _joint(self, node: Node, above: int, q: Array) -> Joint:
        placed, kind = node.placed, node.placed.joint.kind
        parent = self.joints[above] if above >= 0 else None
        rotation: list[Any] = parent.rotation if parent else UNTURNED
        reach = (parent.reach if parent else 0.0) + float(np.linalg.norm(node.place))
        arm = times(rotation, [self.known(float(x), reach if x and self.world else 0.0) for x in node.place])
        own_frame = [float(x) for x in node.rotation.ravel()]
        turned = (parent.turned if parent else 0) + (own_frame != UNTURNED)
        rotation = product(rotation, self.frame(own_frame, turned))
        slides: Freedoms = []
        turns: Freedoms = []
        here = [self.state(q[:, k]) for k in range(q.shape[1])[placed.columns_q]]
        first = placed.at_v
        if kind == "hinge":
            angle = here[0]
            c, s = (angle.cos(), angle.sin()) if isinstance(angle, Noisy) else (1.0, 0.0)
            x, y, axis = rotation[0::3], rotation[1::3], rotation[2::3]
            one = [c * a + s * b for a, b in zip(x, y, strict=True)]
            two = [c * b - s * a for a, b in zip(x, y, strict=True)]
            rotation = [number for row in zip(one, two, axis, strict=True) for number in row]
            turns.append((first, axis))
        elif kind == "slide":
            axis = rotation[2::3]
            slides.append((first, axis))
            arm = add(arm, scaled(here[0] - float(placed.joint.ref), axis))
        elif kind == "ball":
            rotation = product(rotation, rotation_of(here))
            turns += [(first + k, rotation[k::3]) for k in range(3)]
        else:
            arm, rotation = here[:3], rotation_of(here[3:])
            slides += [(first + k, [1.0 if i == k else 0.0 for i in range(3)]) for k in range(3)]
            turns += [(first + 3 + k, rotation[k::3]) for k in range(3)]
        point = add(parent.point, arm) if parent else arm
        size = OF_PRINCIPAL_AXES * _about_centre(node) if self.diagonalised else 0.0
        own = [self.known(float(x), size) for x in np.asarray(node.tensor, dtype=np.float64).ravel()]
        tensor = product(product(rotation, own), transposed(rotation))
        moment = times(rotation, [self.known(float(x)) for x in node.moment])
        mass = self.known(float(node.mass))
        return Joint(above, reach, turned, arm, point, rotation, slides, turns, mass, moment, tensor)


@dataclass(frozen=True)
class Placed:
    """A joint with its body's first moment and tensor about the point at which its spatial vectors are.

    ``arm``: from the parent's point; ``pushes``: what each freedom to turn moves that point by.
    """

    joint: Joint
    arm: list[Any]
    pushes: Freedoms
    moment: list[Any]
    tensor: list[Any]

    def times_inertia(self, turning: list[Any], moving: list[Any]) -> tuple[list[Any], list[Any]]:
        """Moment and force of the inertia times a motion."""
        return (
            add(times(self.tensor, turning), cross(self.moment, moving)),
            add(scaled(self.joint.mass, moving), cross(turning, self.moment)),
        )


def placed_joints(run: Run, moments: str) -> list[Placed]:
    """Each joint at its own point, or at the centre of mass of the ``tree`` that it belongs to."""
    if moments != "tree":
        return [
            Placed(joint, joint.arm, [(column, [0.0] * 3) for column, _ in joint.turns], joint.moment, joint.tensor)
            for joint in run.joints
        ]
    roots = _roots(run)
    middles = {root: _centre(run, [k for k, own in enumerate(roots) if own == root]) for root in set(roots)}
    found = []
    for joint, root in zip(run.joints, roots, strict=True):
        far = [a - b for a, b in zip(middles[root], joint.point, strict=True)]
        pushes = [(column, cross(axis, far)) for column, axis in joint.turns]
        found.append(Placed(joint, [0.0] * 3, pushes, *_moved(joint, middles[root])))
    return found


def _roots(run: Run) -> list[int]:
    """For each joint, the one in the world that it hangs on."""
    found: list[int] = []
    for number, joint in enumerate(run.joints):
        found.append(found[joint.parent] if joint.parent >= 0 else number)
    return found


def _centre(run: Run, members: list[int]) -> list[Any]:
    """The centre of mass of these joints' bodies, in the world."""
    total: Any = 0.0
    moment: list[Any] = [0.0, 0.0, 0.0]
    for number in members:
        joint = run.joints[number]
        total = total + joint.mass
        moment = add(moment, add(joint.moment, scaled(joint.mass, joint.point)))
    return [x / total for x in moment]


def _moved(joint: Joint, middle: list[Any]) -> tuple[list[Any], list[Any]]:
    """First moment c' and tensor (9) about the point ``middle`` in the world, which is d from the joint's.

    c' = c − m d,  I' = I − d·(c + c') 1 + c dᵀ + d c'ᵀ. The centre of mass is a place in the world, and has its last
    digits.
    """
    centre = [x + c / joint.mass for x, c in zip(joint.point, joint.moment, strict=True)] if joint.weighs else middle
    before = [joint.mass * (x - y) for x, y in zip(centre, joint.point, strict=True)]
    after = [joint.mass * (x - y) for x, y in zip(centre, middle, strict=True)]
    far = [x - y for x, y in zip(middle, joint.point, strict=True)]
    both = dot(far, add(before, after))
    tensor = [
        joint.tensor[3 * i + j] + far[i] * after[j] + before[i] * far[j] - (both if i == j else 0.0)
        for i in range(3)
        for j in range(3)
    ]
    return after, tensor


def _about_centre(node: Node) -> float:
    """The norm of the tensor of a joint's bodies about their centre of mass [kg m²]."""
    moment, mass = node.moment.astype(np.float64), float(node.mass)
    away = (moment @ moment * np.eye(3) - np.outer(moment, moment)) / mass if mass else 0.0
    return float(np.linalg.norm(node.tensor.astype(np.float64) - away, 2))
