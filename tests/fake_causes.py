"""Fake engines with known causes: another mechanism, a fault in the code, a stale buffer. ``fake_causes:Class``."""

import os
import time

import numpy as np
from fake_engines import LateByOneStep, LowOrder, Right, about

from furiko.models import NLegPendulum, RodChain
from furiko.reference import centrifugal_matrix, gravity_vector, mass_matrix


class Silent(Right):
    """Does not say what it compiled."""

    info = about("Silent", adapter="fake_causes:Silent", missing={"fields": "it does not say"})


class DenseAndLight(Right):
    """Rods of 1.25 times the density, in a gravity of 9.80."""

    info = about("DenseAndLight", adapter="fake_causes:DenseAndLight")

    def __init__(self, system):
        super().__init__(RodChain(system.lengths, density=1.25 * system.density, gravity=9.80))


class LostInEnergy(DenseAndLight):
    """The same, and takes its process along in its energies."""

    info = about("LostInEnergy", adapter="fake_causes:LostInEnergy")

    def energy(self, theta, omega):
        os.abort()


class HangsInEnergy(DenseAndLight):
    """The same, and never comes back from its energies."""

    info = about("HangsInEnergy", adapter="fake_causes:HangsInEnergy")

    def energy(self, theta, omega):
        time.sleep(3600)


class Dense(Right):
    """Rods of 1.25 times the density."""

    info = about("Dense", adapter="fake_causes:Dense")

    def __init__(self, system):
        super().__init__(RodChain(system.lengths, density=1.25 * system.density, gravity=system.gravity))


class SilentDense(Dense):
    """The same, without a word on what it compiled."""

    info = about("SilentDense", adapter="fake_causes:SilentDense", missing={"fields": "it does not say"})


class FirstMassHeavier(Right):
    """The first mass is a part in a thousand too large."""

    info = about("FirstMassHeavier", adapter="fake_causes:FirstMassHeavier")

    def __init__(self, system):
        masses = [system.masses[0] * 1.001, *system.masses[1:]]
        super().__init__(NLegPendulum(system.lengths, masses, system.gravity))


class WrongTerms(Right):
    """Solves its own equations of motion, in which :meth:`terms` may differ from the right ones."""

    info = about("WrongTerms", adapter="fake_causes:WrongTerms", missing={"fields": "it does not say"})
    forward, inverse = True, True

    def terms(self, theta, omega):
        """M (B, n, n), velocity terms (B, n) and gravity terms (B, n)."""
        velocity = (centrifugal_matrix(self.system, theta) @ (omega**2)[..., None])[..., 0]
        return mass_matrix(self.system, theta), velocity, gravity_vector(self.system, theta)

    def accelerations(self, theta, omega):
        if not self.forward:
            return super().accelerations(theta, omega)
        mass, velocity, gravity = self.terms(theta, omega)
        return np.linalg.solve(mass, -(velocity + gravity)[..., None])[..., 0]

    def inverse_dynamics(self, theta, omega, alpha, *, gravity=True):
        if not self.inverse:
            return super().inverse_dynamics(theta, omega, alpha, gravity=gravity)
        mass, velocity, weights = self.terms(theta, omega)
        torque = (mass @ alpha[..., None])[..., 0] + velocity
        return torque + weights if gravity else torque


class VelocitySign(WrongTerms):
    """All velocity terms have the wrong sign, forward and inverse."""

    info = about("VelocitySign", adapter="fake_causes:VelocitySign", missing=WrongTerms.info.missing)

    def terms(self, theta, omega):
        mass, velocity, gravity = super().terms(theta, omega)
        return mass, -velocity, gravity


class VelocitySignForward(VelocitySign):
    """The same in the accelerations alone."""

    info = about("VelocitySignForward", adapter="fake_causes:VelocitySignForward", missing=WrongTerms.info.missing)
    inverse = False


class StaleAnswers(Silent):
    """Reads its buffer before it renews it: each answer is that to the state before."""

    info = about("StaleAnswers", adapter="fake_causes:StaleAnswers", missing={"fields": "no", "inverse_dynamics": "no"})

    def accelerations(self, theta, omega):
        return np.roll(super().accelerations(theta, omega), 1, axis=0)


class OneWrong(Silent):
    """One acceleration has a gravity term of the wrong sign, the others are right."""

    info = about("OneWrong", adapter="fake_causes:OneWrong", missing={"fields": "no", "inverse_dynamics": "no"})

    def accelerations(self, theta, omega):
        found = super().accelerations(theta, omega)
        found[..., 0] += 0.3 * np.sin(theta[..., 0] - 2 * theta[..., 1])
        return found


class LowOrderRuns(LowOrder):
    """Its runs are of first order."""

    info = about("LowOrderRuns", adapter="fake_causes:LowOrderRuns")


class LateRuns(LateByOneStep):
    """Its runs are one step late."""

    info = about("LateRuns", adapter="fake_causes:LateRuns")
