"""A zoo of small fake engines: one that is right, and many that are wrong in one way each.

They are here to show that every check can fail. Name one on a command line as ``fake_engines:Class``.
"""

import os
import time

import numpy as np

from furiko.engines import EngineInfo, Integrator, ModelFields
from furiko.models.coordinates import absolute_from_relative
from furiko.reference import (
    centrifugal_matrix,
    energies,
    gravity_vector,
    joint_forces,
    literal_accelerations,
    mass_matrix,
)


def about(name, **changes):
    fields = {
        "formulation": "fake",
        "adapter": f"fake_engines:{name}",
        "module": "",
        "package": "",
        "homepage": "",
        "coordinates": "absolute",
        "moments": "hinge",
        "placed": "parent",
        "interchanges": False,
        "algorithm": "crba",
        "integrators": (Integrator("RK4", 4),),
        "offers": ("derivatives", "inverse_mass"),
    }
    return EngineInfo(name=name, **(fields | changes))


class Right:
    """Answers with the documents' own equations and a textbook Runge-Kutta scheme."""

    info = about("Right")

    def __init__(self, system):
        self.system = system

    def fields(self):
        links = self.system.tree().links
        return ModelFields(
            dofs=self.system.n,
            parents=self.system.tree().parents,
            hinges=np.array([link.hinge for link in links]),
            centres=np.array([link.com for link in links]),
            masses=np.array([link.mass for link in links]),
            inertias=np.array([link.inertia for link in links]),
            gravity=np.array([0.0, 0.0, -self.system.gravity]),
            armature=np.zeros(self.system.n),
            damping=np.zeros(self.system.n),
        )

    def accelerations(self, theta, omega):
        return literal_accelerations(self.system, theta, omega)

    def inverse_dynamics(self, theta, omega, alpha, *, gravity=True):
        mass, centrifugal = mass_matrix(self.system, theta), centrifugal_matrix(self.system, theta)
        torque = (mass @ alpha[..., None] + centrifugal @ (omega**2)[..., None])[..., 0]
        return torque + gravity_vector(self.system, theta) if gravity else torque

    def derivatives(self, theta, omega):
        """By complex steps: the imaginary part of an answer over a step so small that nothing of it is seen beside."""
        n, step = self.system.n, 1e-40
        found = np.empty((2, *theta.shape, n))
        for k in range(n):
            for which in range(2):
                state = [theta.astype(complex), omega.astype(complex)]
                state[which][:, k] += 1j * step
                found[which, :, :, k] = literal_accelerations(self.system, *state).imag / step
        return found[0], found[1]

    def inverse_mass(self, theta):
        return np.linalg.inv(mass_matrix(self.system, theta))

    def joint_forces(self, theta, omega, alpha):
        return joint_forces(self.system, theta, omega, alpha)

    def energy(self, theta, omega):
        return np.stack(energies(self.system, theta, omega), axis=-1)

    def trajectory(self, theta, omega, integrator, step, steps):
        def slope(y):
            return np.stack([y[1], self.accelerations(y[0][None], y[1][None])[0]])

        y = np.stack([theta, omega])
        for _ in range(steps):
            a = slope(y)
            b = slope(y + step / 2 * a)
            c = slope(y + step / 2 * b)
            d = slope(y + step * c)
            y = y + step / 6 * (a + 2 * b + 2 * c + d)
        return y[0], y[1]


class AlwaysWrong(Right):
    """Gives ones, whatever it is asked."""

    info = about("AlwaysWrong")

    def accelerations(self, theta, omega):
        return np.ones_like(theta)


class SlightlyWrong(Right):
    """Its accelerations are off in the eleventh digit."""

    info = about("SlightlyWrong")

    def accelerations(self, theta, omega):
        return super().accelerations(theta, omega) * (1 + 1e-11)


class SignFlipped(Right):
    """Takes gravity for upwards."""

    info = about("SignFlipped")

    def accelerations(self, theta, omega):
        return super().accelerations(np.asarray(theta) + np.pi, omega)

    def inverse_dynamics(self, theta, omega, alpha, *, gravity=True):
        torque = super().inverse_dynamics(theta, omega, alpha, gravity=False)
        return torque - gravity_vector(self.system, theta) if gravity else torque


class ProductOfRates(Right):
    """Has a term in ω₁ω₂ that is not there: invisible while one link alone moves."""

    info = about("ProductOfRates")

    def inverse_dynamics(self, theta, omega, alpha, *, gravity=True):
        torque = super().inverse_dynamics(theta, omega, alpha, gravity=gravity)
        torque[..., 0] += 1e-9 * omega[..., 0] * omega[..., 1]
        return torque


class HeavyEntry(Right):
    """One entry of its mass matrix is off by 1e-10."""

    info = about("HeavyEntry")

    def inverse_dynamics(self, theta, omega, alpha, *, gravity=True):
        torque = super().inverse_dynamics(theta, omega, alpha, gravity=gravity)
        torque[..., 1] += 1e-10 * alpha[..., 0]
        return torque


class WrongFields(Right):
    """Compiled the last link a part in 1e12 too heavy."""

    info = about("WrongFields")

    def fields(self):
        fields = super().fields()
        fields.masses[-1] *= 1 + 1e-12
        return fields


class HiddenArmature(Right):
    """Carries a rotor's inertia that nobody asked for."""

    info = about("HiddenArmature")

    def fields(self):
        fields = super().fields()
        fields.armature[0] = 1e-12
        return fields


class DroppedJoint(Right):
    """Welded one hinge."""

    info = about("DroppedJoint")

    def fields(self):
        from dataclasses import replace

        return replace(super().fields(), dofs=self.system.n - 1)


class WrongForces(Right):
    """Its joint forces are turned about."""

    info = about("WrongForces")

    def joint_forces(self, theta, omega, alpha):
        return -super().joint_forces(theta, omega, alpha)


class WrongEnergy(Right):
    """Forgets a part in 1e12 of the potential energy."""

    info = about("WrongEnergy")

    def energy(self, theta, omega):
        return super().energy(theta, omega) * [1, 1 - 1e-12]


class EmptiesItsArguments(Right):
    """Kinetic energy half as much again, and the arguments set to zero."""

    info = about("EmptiesItsArguments")

    def energy(self, theta, omega):
        energies = np.array(super().energy(theta, omega))
        energies[:, 0] *= 1.5
        theta[:] = omega[:] = 0.0
        return energies


class LateByOneStep(Right):
    """Reports the state before the last step."""

    info = about("LateByOneStep")

    def trajectory(self, theta, omega, integrator, step, steps):
        return super().trajectory(theta, omega, integrator, step, steps - 1)


class LowOrder(Right):
    """Calls Euler's method RK4."""

    info = about("LowOrder")

    def trajectory(self, theta, omega, integrator, step, steps):
        y = np.stack([theta, omega])
        for _ in range(steps):
            y = y + step * np.stack([y[1], self.accelerations(y[0][None], y[1][None])[0]])
        return y[0], y[1]


class Damped(Right):
    """Integrates another mechanism: with a little friction."""

    info = about("Damped")

    def trajectory(self, theta, omega, integrator, step, steps):
        other = Right(self.system)
        other.accelerations = lambda t, w: literal_accelerations(self.system, t, w) - 1e-6 * w
        return other.trajectory(theta, omega, integrator, step, steps)


class Nan(Right):
    """Returns NaN in one state."""

    info = about("Nan")

    def accelerations(self, theta, omega):
        accelerations = super().accelerations(theta, omega)
        accelerations[3:4, 0] = np.nan
        return accelerations


class WrongShape(Right):
    """Returns one state too few."""

    info = about("WrongShape")

    def accelerations(self, theta, omega):
        accelerations = super().accelerations(theta, omega)
        return accelerations[1:] if len(accelerations) > 1 else accelerations


class NotNumbers(Right):
    """Returns words."""

    info = about("NotNumbers")

    def accelerations(self, theta, omega):
        return "fast" if len(theta) > 1 else super().accelerations(theta, omega)


class Raising(Right):
    """Raises in its energies."""

    info = about("Raising")

    def energy(self, theta, omega):
        raise ZeroDivisionError("no energy today")


class CannotStart(Right):
    """Raises when it is made."""

    info = about("CannotStart")

    def __init__(self, system):
        raise MemoryError("too large for me")


class Crashing(Right):
    """Takes its process along in its energies."""

    info = about("Crashing")

    def energy(self, theta, omega):
        os.abort()


class Hanging(Right):
    """Never comes back from its energies."""

    info = about("Hanging")

    def energy(self, theta, omega):
        time.sleep(3600)


class Littering(Right):
    """Prints, and leaves a file in the folder it runs in."""

    info = about("Littering")

    def accelerations(self, theta, omega):
        print("hello")
        with open("LITTER.TXT", "w") as file:
            file.write("litter")
        return super().accelerations(theta, omega)


class TransposedDerivatives(Right):
    """Exchanges rows and columns of its derivatives."""

    info = about("TransposedDerivatives")

    def derivatives(self, theta, omega):
        return tuple(found.swapaxes(1, 2) for found in super().derivatives(theta, omega))


class NegatedDerivatives(Right):
    """Gives derivatives of minus the accelerations."""

    info = about("NegatedDerivatives")

    def derivatives(self, theta, omega):
        return tuple(-found for found in super().derivatives(theta, omega))


class ExchangedDerivatives(Right):
    """Returns both in the other order."""

    info = about("ExchangedDerivatives")

    def derivatives(self, theta, omega):
        return super().derivatives(theta, omega)[::-1]


class HalfDerivativeByRates(Right):
    """Forgets the factor 2 of the derivative of a square."""

    info = about("HalfDerivativeByRates")

    def derivatives(self, theta, omega):
        of_positions, of_rates = super().derivatives(theta, omega)
        return of_positions, of_rates / 2


class RelativeDerivatives(Right):
    """Gives derivatives, and an inverse, of relative angles."""

    info = about("RelativeDerivatives")

    def derivatives(self, theta, omega):
        turned = absolute_from_relative(self.system.tree().parents)
        return tuple(np.linalg.inv(turned) @ found @ turned for found in super().derivatives(theta, omega))

    def inverse_mass(self, theta):
        back = np.linalg.inv(absolute_from_relative(self.system.tree().parents))
        return back @ super().inverse_mass(theta) @ back.T


class ForcesForDerivatives(Right):
    """Gives the derivatives of the forces, and M in the place of its inverse."""

    info = about("ForcesForDerivatives")

    def derivatives(self, theta, omega):
        return tuple(-mass_matrix(self.system, theta) @ found for found in super().derivatives(theta, omega))

    def inverse_mass(self, theta):
        return mass_matrix(self.system, theta)


class DerivativesWithoutGravity(Right):
    """Leaves gravity out of its derivatives alone."""

    info = about("DerivativesWithoutGravity")

    def derivatives(self, theta, omega):
        of_positions, of_rates = super().derivatives(theta, omega)
        slope = gravity_vector(self.system, theta + np.pi / 2)[:, :, None] * np.eye(self.system.n)
        return of_positions + np.linalg.solve(mass_matrix(self.system, theta), slope), of_rates


class DerivativesOfOtherRates(Right):
    """Differentiates at rates that are a hundredth too large."""

    info = about("DerivativesOfOtherRates")

    def derivatives(self, theta, omega):
        return super().derivatives(theta, 1.01 * omega)
