"""Fake engines, each with one fault that shows in how it moves or in a symmetry it lacks; made on the zoo's own one."""

import numpy as np

from furiko.engines import EngineInfo, Integrator
from furiko.models import NLegPendulum
from furiko.reference import literal_accelerations, mass_matrix
from furiko.reference.integration.schemes import SCHEMES

THREE_EIGHTHS = next(scheme for scheme in SCHEMES if scheme.name == "Runge-Kutta 3/8 rule")
CLASSICAL = next(scheme for scheme in SCHEMES if scheme.name == "classical Runge-Kutta")


class Fake:
    """Right in everything: the documents' accelerations, the classical Runge-Kutta scheme."""

    integrators = (Integrator("RK4", 4),)
    scheme = CLASSICAL

    def __init__(self, system):
        self.system = system

    @classmethod
    def about(cls):
        return EngineInfo(
            name=cls.__name__,
            formulation="fake",
            adapter="",
            module="",
            package="",
            homepage="",
            coordinates="absolute",
            integrators=cls.integrators,
            missing={"energy": "it has none"},
        )

    def accelerations(self, theta, omega):
        return literal_accelerations(self.system, theta, omega)

    def trajectory(self, theta, omega, integrator, step, steps):
        angles, rates = self.path(theta, omega, integrator, step, steps)
        return angles[-1], rates[-1]

    def path(self, theta, omega, integrator, step, steps):
        states = [(theta, omega)]
        for _ in range(steps):
            states.append(self.scheme.step(self.accelerations, *states[-1], step))
        return np.array([state[0] for state in states]), np.array([state[1] for state in states])


def push(system, theta, torque):
    """What a torque on the first angle adds to the accelerations."""
    torques = np.zeros_like(theta)
    torques[..., 0] = torque
    return np.linalg.solve(mass_matrix(system, theta), torques[..., None])[..., 0]


class Pushed(Fake):
    """A constant torque at the support."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta, omega) + push(self.system, theta, 1e-7)


class Damped(Fake):
    """Friction at the support."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta, omega) - push(self.system, theta, 1e-7 * omega[..., 0])


class Wound(Fake):
    """A spring at the support: an angle once round is another place."""

    def accelerations(self, theta, omega):
        return super().accelerations(theta, omega) - push(self.system, theta, 1e-7 * theta[..., 0])


class Geared(Fake):
    """A rotor's inertia at the support: it neither scales with masses nor with lengths."""

    def accelerations(self, theta, omega):
        rotor = np.zeros((self.system.n, self.system.n))
        rotor[0, 0] = 1e-7
        torque = (mass_matrix(self.system, theta) @ super().accelerations(theta, omega)[..., None])[..., 0]
        return np.linalg.solve(mass_matrix(self.system, theta) + rotor, torque[..., None])[..., 0]


class FirstLegHeavier(Fake):
    """One leg's mass is not what was asked for, and which one it is depends on the order."""

    def __init__(self, system):
        masses = [m * (1 + 1e-7 * (i == 1)) for i, m in enumerate(system.masses)]
        super().__init__(NLegPendulum(system.lengths, masses, system.gravity))


class GravityLeft(Fake):
    """Gravity cannot be turned off altogether."""

    def __init__(self, system):
        super().__init__(NLegPendulum(system.lengths, system.masses, system.gravity + 1e-7))


class OtherRungeKutta(Fake):
    """Another scheme of order four than the usual one."""

    scheme = THREE_EIGHTHS


class LongStep(Fake):
    """Its steps are longer than they are said to be, by a part in 1e9."""

    def path(self, theta, omega, integrator, step, steps):
        return super().path(theta, omega, integrator, step * (1 + 1e-9), steps)


class Astray(Fake):
    """Whole runs start a little beside the state that they are given; single steps do not."""

    def path(self, theta, omega, integrator, step, steps):
        return super().path(theta + (1e-7 if steps > 1 else 0.0), omega, integrator, step, steps)
