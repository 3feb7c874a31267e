"""Fake engines of open mechanisms: one that is right, and some that are wrong in one way each.

Name one on a command line as ``fake_tree_engines:Class``.
"""

import time

import numpy as np

from furiko.engines import EngineInfo, Integrator, TreeInfo
from furiko.engines.trees.mujoco import MujocoTree
from furiko.reference.truth.spatial import energy, spatial_truth

# A rod that turns about a tilted axis on a slide with spring and damper: everything a comparison looks at.
SMALL = """
[system]
kind = "tree"
gravity = [0.5, 0.0, -9.81]
[[system.links]]
name = "block"
mass = 1.2
[[system.links.joints]]
name = "rail"
kind = "slide"
axis = [1.0, 0.2, 0.0]
damping = 0.3
stiffness = 4.0
springref = 0.1
[[system.links]]
name = "rod"
parent = "block"
mass = 0.7
centre = [0.1, 0.0, -0.4]
inertia = [0.04, 0.05, 0.02]
[[system.links.joints]]
name = "pin"
axis = [0.1, 1.0, 0.2]
armature = 0.01
damping = 0.02
[state]
q = { rail = 0.2, pin = 1.1 }
v = { pin = -0.4 }
duration = 0.5
"""

# A block on a rail along x, alone: a = (−d v − k (q − r)) / m, so that each scheme's step can be written down.
BLOCK = """
[system]
kind = "tree"
gravity = [0.0, 0.0, 0.0]
[[system.links]]
name = "block"
mass = 1.25
[[system.links.joints]]
name = "rail"
kind = "slide"
axis = [1.0, 0.0, 0.0]
damping = 0.75
stiffness = 5.0
springref = 0.25
[state]
q = { rail = 0.5 }
v = { rail = -1.0 }
duration = 0.5
"""

# A body that floats, with an arm on a ball joint and a flap on a hinge.
FLOATING = """
[system]
kind = "tree"
gravity = [0.5, 0.0, -9.81]
[[system.links]]
name = "trunk"
mass = 2.5
centre = [0.05, -0.02, 0.1]
inertia = [0.3, 0.2, 0.4, 0.02, 0.01, -0.03]
[[system.links.joints]]
name = "float"
kind = "free"
[[system.links]]
name = "arm"
parent = "trunk"
position = [0.3, 0.1, 0.2]
mass = 0.8
centre = [0.0, 0.1, -0.25]
inertia = [0.03, 0.02, 0.01]
[[system.links.joints]]
name = "shoulder"
kind = "ball"
anchor = [0.01, 0.02, 0.0]
armature = 0.02
damping = 0.05
[[system.links]]
name = "flap"
parent = "trunk"
position = [-0.3, 0.0, 0.1]
mass = 0.4
centre = [-0.2, 0.0, 0.05]
inertia = [0.01, 0.02, 0.02]
[[system.links.joints]]
name = "pin"
axis = [0.1, 1.0, 0.2]
armature = 0.01
damping = 0.02
stiffness = 1.0
[state]
q = { float = [0.3, -0.2, 1.0, 0.8, 0.2, -0.5, 0.3], shoulder = [0.9, 0.1, 0.3, -0.2], pin = 0.4 }
v = { float = [1.0, 0.5, -0.5, 1.5, -2.0, 1.0], shoulder = [0.5, 1.0, -1.0], pin = -0.4 }
duration = 0.5
"""


def about(name, **tree):
    return EngineInfo(
        name=name,
        formulation="fake",
        adapter=f"fake_tree_engines:{name}",
        module="",
        package="",
        homepage="",
        coordinates="relative",
        integrators=(Integrator("RK4", 4),),
        tree=TreeInfo(f"fake_tree_engines:{name}", **{"offers": ("joint_forces",)} | tree),
    )


class Right:
    """Answers with the nearest doubles of the truth, and with MuJoCo's Runge-Kutta scheme."""

    info = about("Right")
    scheme = "RK4"

    def __init__(self, mechanism):
        self.mechanism = mechanism

    def _truths(self, q, v):
        return [spatial_truth(self.mechanism, *state) for state in zip(q, v, strict=True)]

    def accelerations(self, q, v):
        return np.array([truth.accelerations.float for truth in self._truths(q, v)])

    def mass_matrix(self, q):
        rest = np.zeros((len(q), self.mechanism.nv))
        return np.array([truth.mass_matrix.float for truth in self._truths(q, rest)])

    def bias(self, q, v):
        return np.array([truth.bias.float for truth in self._truths(q, v)])

    def passive(self, q, v):
        return np.array([truth.passive.float for truth in self._truths(q, v)])

    def joint_forces(self, q, v, a):
        truths = zip(self._truths(q, v), a, strict=True)
        return np.array([truth.joint_forces(given).float for truth, given in truths])

    def energy(self, q, v):
        return np.array([energy(self.mechanism, *state).float for state in zip(q, v, strict=True)])

    def trajectory(self, q, v, integrator, step, steps):
        return MujocoTree(self.mechanism).trajectory(q, v, self.scheme, step, steps)


class WrongAccelerations(Right):
    """One part in 1e9 too large."""

    info = about("WrongAccelerations")

    def accelerations(self, q, v):
        return (1 + 1e-9) * super().accelerations(q, v)


class WrongMass(Right):
    """The last diagonal entry is one part in 1e9 too large."""

    info = about("WrongMass")

    def mass_matrix(self, q):
        mass = super().mass_matrix(q)
        mass[:, -1, -1] *= 1 + 1e-9
        return mass


class WrongVelocityTerms(Right):
    """A part in 1e6 of the velocity terms is forgotten; gravity is right."""

    info = about("WrongVelocityTerms")

    def bias(self, q, v):
        at_rest = super().bias(q, np.zeros_like(v))
        return at_rest + (1 - 1e-6) * (super().bias(q, v) - at_rest)


class WrongGravity(Right):
    """Gravity's share of the bias is one part in 1e9 too large."""

    info = about("WrongGravity")

    def bias(self, q, v):
        return super().bias(q, v) + 1e-9 * super().bias(q, np.zeros_like(v))


class WrongPassive(Right):
    """Dampers one part in 1e9 too strong, in the terms alone."""

    info = about("WrongPassive")

    def passive(self, q, v):
        return super().passive(q, v) * (1 + 1e-9)


class WrongForces(Right):
    """One part in 1e9 of the force is missing; the moment is right."""

    info = about("WrongForces")

    def joint_forces(self, q, v, a):
        return super().joint_forces(q, v, a) * np.array([1 - 1e-9] * 3 + [1.0] * 3)


class OtherPoint(Right):
    """Moments about a point 1e-9 m beside the links' origins, along x."""

    info = about("OtherPoint")

    def joint_forces(self, q, v, a):
        found = super().joint_forces(q, v, a)
        found[..., 3:] -= np.cross([1e-9, 0.0, 0.0], found[..., :3])
        return found


class OnTheLink(Right):
    """What is exerted on each link, not what each link exerts."""

    info = about("OnTheLink")

    def joint_forces(self, q, v, a):
        return -super().joint_forces(q, v, a)


class Rubbed(Right):
    """Every run loses a part in 1e6 of its rates in a second, whatever the step."""

    info = about("Rubbed")

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        return at, rates * (1 - 1e-6 * step * steps)


class WrongEnergy(Right):
    """The kinetic energy without the armature of the last joint, or a part of it."""

    info = about("WrongEnergy")

    def energy(self, q, v):
        found = super().energy(q, v)
        found[:, 0] *= 1 - 1e-9
        return found


class WrongHeight(Right):
    """A part in 1e9 of the potential energy is missing."""

    info = about("WrongHeight")

    def energy(self, q, v):
        return super().energy(q, v) * np.array([1.0, 1 - 1e-9])


class OtherZero(Right):
    """Right: the potential energy is off by one constant."""

    info = about("OtherZero")

    def energy(self, q, v):
        return super().energy(q, v) + np.array([0.0, 3.0])


class WrongScheme(Right):
    """Euler's, of first order, under the name of another."""

    info = about("WrongScheme")
    scheme = "Euler"


class Beside(Right):
    """Every run ends a ten-thousandth beside the motion, in its last coordinate alone."""

    info = about("Beside")

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        return at + 1e-4 * np.eye(self.mechanism.nv)[-1], rates


class OneOrderLess(Right):
    """Converges to the true motion, with the third power of the step."""

    info = about("OneOrderLess")

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        return at + 0.1 * step**3, rates


class FewQuestions(Right):
    """Knows accelerations alone, and no springs."""

    info = about(
        "FewQuestions",
        missing=dict.fromkeys(("mass_matrix", "bias", "passive", "energy", "trajectory"), "it has accelerations alone"),
        cannot_hold={"spring": "it has no springs"},
    )


class NoForces(Right):
    """An adapter from before joint forces were asked of trees."""

    info = about("NoForces", offers=())


class BadShape(Right):
    """Answers with a column too many."""

    info = about("BadShape")

    def accelerations(self, q, v):
        return np.zeros((len(q), self.mechanism.nv + 1))


class Raises(Right):
    """Fails where it is asked."""

    info = about("Raises")

    def accelerations(self, q, v):
        raise ArithmeticError("not today")


class Slow(Right):
    """Right, half a second later."""

    info = about("Slow")

    def accelerations(self, q, v):
        time.sleep(0.5)
        return super().accelerations(q, v)


class FailsWhenFast(Right):
    """A part in 1e9 off where anything moves faster than a thousand metres or radians a second."""

    info = about("FailsWhenFast")

    def accelerations(self, q, v):
        quick = np.abs(v).max(axis=-1, keepdims=True) > 1000
        return super().accelerations(q, v) * np.where(quick, 1 + 1e-9, 1.0)


class NotANumber(Right):
    """Answers with NaN in one state."""

    info = about("NotANumber")

    def accelerations(self, q, v):
        found = super().accelerations(q, v)
        found[-1] = np.nan
        return found


def turned(q, by):
    """q of ``FLOATING`` with its two quaternions as ``by`` makes them: of what they are, and of their number."""
    q = q.copy()
    for number, at in enumerate((slice(3, 7), slice(7, 11))):
        q[at] = by(q[at], number)
    return q


def product(first, second):
    (a, *r), (b, *s) = first, second
    return np.array([a * b - np.dot(r, s), *(a * np.array(s) + b * np.array(r) + np.cross(r, s))])


class Own(Right):
    """A scheme of its own, Runge and Kutta's, in plain numbers; of ``FLOATING``."""

    info = about("Own")

    def trajectory(self, q, v, integrator, step, steps):
        for _ in range(steps):
            q, v = self.step(q, v, step)
        return q, v

    def a(self, q, v):
        return self.accelerations(q[None], v[None])[0]


def weighed(parts):
    return (parts[0] + 2 * parts[1] + 2 * parts[2] + parts[3]) / 6


def start_of(q):
    return turned(q, lambda one, number: one / np.linalg.norm(one))


class Components(Own):
    """Quaternions are four numbers that have rates, and are made of length one at the end of a step."""

    def step(self, q, v, h):
        q = start_of(q)

        def rates(at, v):
            found = np.concatenate([v[:3], np.zeros(8), v[9:]])
            found[3:7], found[7:11] = product(at[3:7], [0, *v[3:6]]) / 2, product(at[7:11], [0, *v[6:9]]) / 2
            return found

        moving, speeding = [], []
        for part in (0.0, 0.5, 0.5, 1.0):
            at = q + part * h * moving[-1] if moving else q
            speed = v + part * h * speeding[-1] if moving else v
            moving.append(rates(at, speed))
            speeding.append(self.a(at, speed))
        return start_of(q + h * weighed(moving)), v + h * weighed(speeding)


class Means(Own):
    """Rotations are by the mean of the stages' rates, as in releases of MuJoCo before 4."""

    def step(self, q, v, h):
        q, moving, speeding = start_of(q), [], []
        for part in (0.0, 0.5, 0.5, 1.0):
            at = self.moved(q, part * h * moving[-1]) if moving else q
            speed = v + part * h * speeding[-1] if moving else v
            moving.append(speed)
            speeding.append(self.a(at, speed))
        return self.moved(q, h * weighed(moving)), v + h * weighed(speeding)

    def moved(self, q, x):
        def turn(one, number):
            vector = x[3 + 3 * number : 6 + 3 * number]
            angle = np.linalg.norm(vector)
            return product(one, [np.cos(angle / 2), *(np.sin(angle / 2) * vector / angle)])

        found = turned(q, turn)
        found[:3] += x[:3]
        found[11:] += x[9:]
        return found
