"""Adapters that are wrong, each in one way, in how they ask an engine and hand on its answers; the engine is right.

They are here to show that ``furiko engine-test`` tells what is wrong with an adapter. Each has the step that finds it
and a word of what is said.
"""

import os
import time
from types import MappingProxyType

import numpy as np
from fake_engines import Right, about

from furiko.models.coordinates import absolute_from_relative

BROKEN = {}


def broken(step, word):
    def keep(adapter):
        adapter.info = about(adapter.__name__, **getattr(adapter, "changes", {}))
        adapter.info = type(adapter.info)(**{**vars(adapter.info), "adapter": f"broken_adapters:{adapter.__name__}"})
        BROKEN[adapter.__name__] = (step, word)
        return adapter

    return keep


@broken("class", "'energies'")
class MisspellsWhatIsMissing(Right):
    """Says that something is missing that nobody asks for."""

    changes = MappingProxyType({"missing": {"energies": "it has none"}})


@broken("building", "KeyError")
class OnlyTwoLinks(Right):
    """Looks its links up in a table of two."""

    def __init__(self, system):
        super().__init__(system)
        self.names = [{0: "a", 1: "b"}[i] for i in range(system.n)]


@broken("shapes", "one state's answer")
class OneState(Right):
    """Answers the first state alone."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta[:1], omega[:1])[0] if len(theta) else np.empty(theta.shape)


@broken("shapes", "axes are exchanged")
class Columns(Right):
    """Gives states as columns."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta, omega).T


@broken("shapes", "ValueError")
class NoStates(Right):
    """Stacks its rows, and cannot stack none."""

    def accelerations(self, theta, omega):
        return np.stack([super(NoStates, self).accelerations(theta[[b]], omega[[b]])[0] for b in range(len(theta))])


@broken("arguments", "writes into theta")
class InPlace(Right):
    """Makes relative angles in the caller's own array."""

    def accelerations(self, theta, omega):
        found = super().accelerations(theta, omega)
        theta[:, 1:] -= theta[:, :-1].copy()
        return found


@broken("buffers", "one buffer")
class OneBuffer(Right):
    """Hands out its own buffer."""

    def __init__(self, system):
        super().__init__(system)
        self.buffers = {}

    def accelerations(self, theta, omega):
        buffer = self.buffers.setdefault(theta.shape, np.empty(theta.shape))
        buffer[:] = super().accelerations(theta, omega)
        return buffer


@broken("buffers", "last state")
class ListOfOneBuffer(Right):
    """Appends the same array for every row."""

    def accelerations(self, theta, omega):
        buffer, rows = np.empty(theta.shape[1]), []
        for b in range(len(theta)):
            buffer[:] = super().accelerations(theta[[b]], omega[[b]])[0]
            rows.append(buffer)
        return np.array(rows).reshape(theta.shape)


@broken("memory", "asked again")
class WarmStart(Right):
    """Starts its solver at the last answer, and stops early."""

    last = 0.0

    def accelerations(self, theta, omega):
        found = super().accelerations(theta, omega)
        found = found + 1e-7 * self.last
        self.last = float(found.sum()) if found.size else 0.0
        return found


@broken("memory", "another one has been made")
class OneModelForAll(Right):
    """Keeps the model in the class."""

    kept = None

    def __init__(self, system):
        super().__init__(system)
        type(self).kept = system

    def accelerations(self, theta, omega):
        self.system = type(self).kept if type(self).kept.n == theta.shape[1] else self.system
        return super().accelerations(theta, omega) * (1 + 0.01 * type(self).kept.n)


@broken("batches", "row before")
class Late(Right):
    """Reads each row's answer before it is computed, and begins with the last one's."""

    def accelerations(self, theta, omega):
        found = super().accelerations(theta, omega)
        return np.roll(found, 1, axis=0)


@broken("batches", "reverse order")
class Backwards(Right):
    """Gives the rows in the reverse order."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta, omega)[::-1].copy()


def relative(system):
    return absolute_from_relative(system.tree().parents)


@broken("accelerations", "relative")
class RelativeAngles(Right):
    """Takes absolute angles for relative ones, both ways."""

    def accelerations(self, theta, omega):
        turned = relative(self.system)
        return super().accelerations(theta @ turned.T, omega @ turned.T) @ np.linalg.inv(turned).T


@broken("accelerations", "accelerations: relative values are used as absolute ones")
class RelativeAnswers(Right):
    """Converts what it is given, and not what it answers."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta, omega) @ np.linalg.inv(relative(self.system)).T


@broken("accelerations", "order")
class OtherOrder(Right):
    """Has the links in the reverse order."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta[:, ::-1], omega[:, ::-1])[:, ::-1].copy()


@broken("accelerations", "degrees")
class Degrees(Right):
    """Gives degrees."""

    def accelerations(self, theta, omega):
        return np.degrees(super().accelerations(theta, omega))


@broken("accelerations", "opposite sign")
class Clockwise(Right):
    """Forgets to turn the sign of the answer alone."""

    def accelerations(self, theta, omega):
        return -super().accelerations(theta, omega)


@broken("accelerations", "upward vertical")
class FromUp(Right):
    """Counts angles from the upward vertical."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta + np.pi, omega)


@broken("accelerations", "The rates do not reach the engine")
class NoRates(Right):
    """Does not set the rates."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta, 0 * omega)


@broken("precision", "single precision")
class SingleUndeclared(Right):
    """Computes in single precision, and does not say so."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta, omega).astype(np.float32)


@broken("fields", "about the hinge")
class InertiaAboutHinge(Right):
    """Gives inertias about the hinges."""

    def fields(self):
        found = super().fields()
        return type(found)(
            **{**vars(found), "inertias": found.inertias + found.masses * (found.centres**2).sum(axis=1)}
        )


@broken("fields", "parents are")
class ParentsFromOne(Right):
    """Counts links from one."""

    def fields(self):
        found = super().fields()
        return type(found)(**{**vars(found), "parents": tuple(p + 1 for p in found.parents)})


@broken("inverse dynamics", "relative joint torques")
class RelativeTorques(Right):
    """Gives the torques of its own joints."""

    def inverse_dynamics(self, theta, omega, alpha, *, gravity=True):
        return super().inverse_dynamics(theta, omega, alpha, gravity=gravity) @ relative(self.system)


@broken("inverse dynamics", "keyword is not looked at")
class AlwaysGravity(Right):
    """Ignores ``gravity=False``."""

    def inverse_dynamics(self, theta, omega, alpha, *, gravity=True):
        return super().inverse_dynamics(theta, omega, alpha)


@broken("derivatives", "relative angles")
class RelativeDerivatives(Right):
    """Hands on derivatives as its engine has them, of relative angles."""

    def derivatives(self, theta, omega):
        turned = absolute_from_relative(self.system.tree().parents)
        return tuple(np.linalg.inv(turned) @ found @ turned for found in super().derivatives(theta, omega))


@broken("derivatives", "two matrices")
class OneArrayOfDerivatives(Right):
    """Puts both derivatives side by side, as some engines do."""

    def derivatives(self, theta, omega):
        return np.concatenate(super().derivatives(theta, omega), axis=-1)


@broken("inverse mass matrix", "columns alone")
class HalfConvertedInverse(Right):
    """Converts the columns of its inverse, and not the rows."""

    def inverse_mass(self, theta):
        turned = absolute_from_relative(self.system.tree().parents)
        return np.linalg.inv(turned) @ super().inverse_mass(theta)


@broken("joint forces", "opposite sign")
class Reactions(Right):
    """Gives the force on the link, not on its parent."""

    def joint_forces(self, theta, omega, alpha):
        return -super().joint_forces(theta, omega, alpha)


@broken("energy", "off by a constant")
class OtherZero(Right):
    """Has its zero of potential energy a metre lower."""

    def energy(self, theta, omega):
        return super().energy(theta, omega) + np.array([0.0, 1.5])


@broken("energy", "exchanged")
class PotentialFirst(Right):
    """Gives the potential energy first."""

    def energy(self, theta, omega):
        return super().energy(theta, omega)[:, ::-1].copy()


@broken("trajectories", "one step alone")
class OneStep(Right):
    """Makes one step, however many are asked for."""

    def trajectory(self, theta, omega, integrator, step, steps):
        return super().trajectory(theta, omega, integrator, step, 1)


@broken("trajectories", "wrapped")
class Wrapped(Right):
    """Wraps its angles into one turn."""

    def trajectory(self, theta, omega, integrator, step, steps):
        angles, rates = super().trajectory(theta, omega, integrator, step, steps)
        return (angles + np.pi) % (2 * np.pi) - np.pi, rates


@broken("trajectories", "of order 1")
class OrderMisdeclared(Right):
    """Says that its scheme is of first order, and it is of fourth."""


@broken("trajectories", "relative angles")
class EndsRelative(Right):
    """Does not convert the end."""

    def trajectory(self, theta, omega, integrator, step, steps):
        back = np.linalg.inv(relative(self.system)).T
        return tuple(values @ back for values in super().trajectory(theta, omega, integrator, step, steps))


@broken("memory", "crashed")
class Crashes(Right):
    """Takes its process along at the third question."""

    asked = 0

    def accelerations(self, theta, omega):
        self.asked += 1
        if self.asked > 6:
            os.abort()
        return super().accelerations(theta, omega)


@broken("buffers", "hangs")
class Hangs(Right):
    """Never answers a second question of five states."""

    def accelerations(self, theta, omega):
        if len(theta) == 5 and self.__dict__.setdefault("seen", 0) > 1:
            time.sleep(3600)
        self.seen = self.__dict__.get("seen", 0) + (len(theta) == 5)
        return super().accelerations(theta, omega)


OrderMisdeclared.info = type(OrderMisdeclared.info)(
    **{**vars(OrderMisdeclared.info), "integrators": (type(Right.info.integrators[0])("RK4", 1),)}
)
IN_A_PROCESS = ("Crashes", "Hangs")
