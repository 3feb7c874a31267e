"""Open mechanisms whose motion is known for ever, against which runs of engines' integrators are held.

* ``thrown``: a body thrown under gravity: its centre of mass is on a parabola, and its angular momentum about that
  stays what it was (Newton, Euler).
* ``top``: a symmetric body without torque (moments I, I, J): its axis goes around the angular momentum L at the rate
  |L|/I, while it turns about itself at ω₃ (1 - J/I): R(t) = exp(t L/I) R(0) exp(t ω₃ (1 - J/I) e₃).
* ``slider``: a mass on a spring: x(t) = x(0) cos(√(k/m) t).
* ``pendulum``: a pendulum about an axis that leans in space: Jacobi's elliptic function of what gravity does across it.

Errors are in radians, or in parts of what moves: of the amplitude, of the way so far, of the angular momentum. Of what
swings, place and rate count both, so that no turning point hides a phase that is lost.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from ....models.spatial import from_quaternion
from ....models.trees.system import TreeJoint, TreeLink, TreeSystem
from ....reference.truth.closed_forms import Pendulum

Array = NDArray[np.float64]

GRAVITY = 9.81  # m/s²


@dataclass(frozen=True)
class Known:
    """A mechanism's motion from ``q``, ``v``.

    ``error``: how far a state is off it at a time [s]; ``scale`` [J]: of its energies at the start; ``falling`` [J]:
    what a fall has turned from one into the other at a time.
    """

    name: str
    says: str
    system: TreeSystem
    q: tuple[float, ...]
    v: tuple[float, ...]
    error: Callable[[float, Array, Array], float]
    scale: float
    quaternion: slice | None = None  # its columns of q
    falling: Callable[[float], float] = lambda time: 0.0  # [J]

    def energy_at(self, time: float) -> float:
        """How large its energies are at a time [s], in [J]."""
        return self.scale + self.falling(time)

    def length_off(self, q: Array) -> float:
        """By how much its quaternion's length is not one."""
        return 0.0 if self.quaternion is None else abs(float(np.linalg.norm(q[self.quaternion])) - 1.0)


@cache
def known_motions() -> dict[str, Known]:
    """By name."""
    return {motion.name: motion for motion in (_thrown(), _top(), _slider(), _pendulum())}


def _thrown() -> Known:
    mass, centre, moments = 2.0, np.array([0.1, 0.0, -0.05]), np.array([0.03, 0.05, 0.04])
    link = TreeLink(
        "body",
        -1,
        mass=mass,
        centre=(*centre,),
        inertia=(*moments, 0.0, 0.0, 0.0),
        joints=(TreeJoint("float", "free"),),
    )
    q = np.array([0.0, 0.0, 1.0, 0.5, 0.5, -0.5, 0.5])
    v = np.array([1.0, -0.5, 3.0, 0.5, -1.0, 0.25])

    def about(state: Array, rates: Array) -> tuple[Array, Array, Array]:
        """Place and velocity of the centre of mass, angular momentum about it; in the world's axes."""
        turn = from_quaternion(state[3:])
        arm, spin = turn @ centre, turn @ rates[3:]
        return state[:3] + arm, rates[:3] + np.cross(spin, arm), turn @ (moments * rates[3:])

    place, speed, momentum = about(q, v)
    size = float(np.linalg.norm(momentum))

    def error(time: float, state: Array, rates: Array) -> float:
        now = place + time * speed - np.array([0.0, 0.0, GRAVITY * time**2 / 2])
        found, _, kept = about(state, rates)
        way = max(1.0, float(np.linalg.norm(now - place)))
        return max(float(np.linalg.norm(found - now)) / way, float(np.linalg.norm(kept - momentum)) / size)

    def fall(time: float) -> float:
        return mass * GRAVITY * abs(float(speed[2]) * time - GRAVITY * time**2 / 2)

    spun = float(v[3:] @ (moments * v[3:])) / 2
    says = "a body thrown under gravity: parabola of its centre of mass, angular momentum about it"
    scale = mass * float(speed @ speed) / 2 + spun
    system = TreeSystem((link,), gravity=(0.0, 0.0, -GRAVITY))
    return Known("thrown", says, system, (*q,), (*v,), error, scale, slice(3, 7), fall)


def _top() -> Known:
    across, along = 0.04, 0.06
    inertia = (across, across, along, 0.0, 0.0, 0.0)
    link = TreeLink("top", -1, mass=1.0, inertia=inertia, joints=(TreeJoint("ball", "ball"),))
    q, v = np.array([0.5, 0.5, -0.5, 0.5]), np.array([0.75, 0.0, 2.0])
    turn = from_quaternion(q)
    momentum = turn @ (np.array([across, across, along]) * v)
    rate = float(v[2]) * (1 - along / across)

    def error(time: float, state: Array, _rates: Array) -> float:
        true = _turned(momentum / across * time) @ turn @ _turned(np.array([0.0, 0.0, rate * time]))
        return angle_between(from_quaternion(state), true)

    scale = float(v @ (np.array([across, across, along]) * v)) / 2
    system = TreeSystem((link,), gravity=(0.0, 0.0, 0.0))
    says = "a symmetric top without torque: its axis around the angular momentum"
    return Known("top", says, system, (*q,), (*v,), error, scale, slice(0, 4))


def _slider() -> Known:
    stiffness, amplitude = 4.0, 0.5
    joint = TreeJoint("slide", "slide", axis=(0.6, 0.8, 0.0), stiffness=stiffness)
    link = TreeLink("mass", -1, mass=1.0, inertia=(0.01, 0.01, 0.01, 0.0, 0.0, 0.0), joints=(joint,))

    rate = math.sqrt(stiffness)  # for 1 kg

    def error(time: float, state: Array, rates: Array) -> float:
        off = float(state[0]) - amplitude * math.cos(rate * time)
        fast = float(rates[0]) / rate + amplitude * math.sin(rate * time)
        return math.hypot(off, fast) / amplitude

    system = TreeSystem((link,), gravity=(0.0, 0.0, -GRAVITY))  # across the track
    says = "a mass on a spring: the cosine"
    return Known("slider", says, system, (amplitude,), (0.0,), error, stiffness * amplitude**2 / 2)


def _pendulum() -> Known:
    mass, arm, moment, start = 1.5, 0.5, 0.02, 2.0
    axis = (0.36, 0.48, 0.8)  # gravity's part across it is 0.6 of the whole, along (0.48, 0.64, -0.6)
    link = TreeLink(
        "bob",
        -1,
        mass=mass,
        centre=(0.48 * arm, 0.64 * arm, -0.6 * arm),
        inertia=(moment, moment, moment, 0.0, 0.0, 0.0),
        joints=(TreeJoint("hinge", axis=axis),),
    )
    # (m a² + I) θ'' = -0.6 m g a sin θ
    form = Pendulum(length=mass * arm**2 + moment, gravity=GRAVITY, factor=0.6 * mass * arm)

    rate = math.sqrt(form.factor * form.gravity / form.length)

    def error(time: float, state: Array, rates: Array) -> float:
        (angle,), (speed,) = form.motion(start, 0.0, [time])
        return math.hypot(float(state[0] - angle), float(rates[0] - speed) / rate) / start

    scale = 0.6 * mass * GRAVITY * arm * (1 - math.cos(start))
    system = TreeSystem((link,), gravity=(0.0, 0.0, -GRAVITY))
    says = "a pendulum about an axis that leans: the elliptic function"
    return Known("pendulum", says, system, (start,), (0.0,), error, scale)


def _turned(vector: Array) -> Array:
    """The rotation (3, 3) by |vector| radians about it."""
    angle = float(np.linalg.norm(vector))
    axis = vector / angle if angle else vector
    return from_quaternion(np.array([math.cos(angle / 2), *(math.sin(angle / 2) * axis)]))


def angle_between(one: Array, other: Array) -> float:
    """The angle [rad] of the rotation that parts two: from the chord ‖R₁ - R₂‖ = √8 sin(angle/2), exact near zero."""
    chord = float(np.linalg.norm(one - other)) / math.sqrt(8)
    return 2 * math.asin(min(1.0, chord))
