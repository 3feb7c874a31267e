"""Engines that break, each in its own way, at a known place: name one as ``fake_engines_stress:Class``."""

import os
import time

import numpy as np
from fake_engines import Right, about

from furiko.engines import Integrator


class _Breaking(Right):
    """Right as long as no rod is longer than 1000 m."""

    def accelerations(self, theta, omega):
        found = super().accelerations(theta, omega)
        return self.broken(found) if max(self.system.lengths) > 1000 * (1 + 1e-9) else found


def _about(name, **changes):
    return about(
        name, adapter=f"fake_engines_stress:{name}", integrators=(), missing={"trajectory": "none here"}, **changes
    )


class LosesDigits(_Breaking):
    """Loses three quarters of its digits."""

    info = _about("LosesDigits")

    def broken(self, found):
        return found * (1 + 1e-4)


class LooksRight(_Breaking):
    """Wrong by a tenth, and says nothing."""

    info = _about("LooksRight")

    def broken(self, found):
        return found * 1.1


class GivesNaN(_Breaking):
    """NaN."""

    info = _about("GivesNaN")

    def broken(self, found):
        return found * np.nan


class Raises(_Breaking):
    """An exception."""

    info = _about("Raises")

    def broken(self, found):
        raise ArithmeticError("too long for me")


class Crashes(_Breaking):
    """Takes its process along."""

    info = _about("Crashes")

    def broken(self, found):
        os.abort()


class Hangs(_Breaking):
    """Never comes back."""

    info = _about("Hangs")

    def broken(self, found):
        time.sleep(3600)


class Refuses(Right):
    """Takes chains of up to 40 rods."""

    info = _about("Refuses", largest_n=10_000, least_mass=1e-2, least_reason="too light for me")


class _Path(Right):
    """One rod, integrated by symplectic Euler: what goes wrong is put on top."""

    def path(self, theta, omega, integrator, step, steps):
        states = [(theta, omega)]
        for _ in range(steps):
            t, w = states[-1]
            w = w + step * self.accelerations(t[None], w[None])[0]
            states.append((t + step * w, w))
        angles, rates = (np.array(rows) for rows in zip(*states, strict=True))
        return self.spoilt(angles, rates, step)

    def spoilt(self, angles, rates, step):
        return angles, rates

    def trajectory(self, theta, omega, integrator, step, steps):
        angles, rates = self.path(theta, omega, integrator, step, steps)
        return angles[-1], rates[-1]


def _mover(name):
    return about(name, adapter=f"fake_engines_stress:{name}", integrators=(Integrator("Euler", 1),))


class Resets(_Path):
    """Silently starts again in the middle where a step is longer than 10 ms."""

    info = _mover("Resets")

    def spoilt(self, angles, rates, step):
        if step > 0.01:
            middle = max(2, len(angles) // 2)
            angles[middle:] = angles[: len(angles) - middle]
            rates[middle:] = rates[: len(rates) - middle]
        return angles, rates


class ComesApart(_Path):
    """Its joints gape where a step is longer than 10 ms."""

    info = _mover("ComesApart")

    def __init__(self, system):
        super().__init__(system)
        self.wide = False

    def spoilt(self, angles, rates, step):
        self.wide = step > 0.01
        return angles, rates

    def gap(self):
        return 0.5 if self.wide else 0.0


class EndsInNaN(_Path):
    """NaN from half of the way on where a step is longer than 10 ms."""

    info = _mover("EndsInNaN")

    def spoilt(self, angles, rates, step):
        if step > 0.01:
            rates[len(rates) // 2 :] = np.nan
        return angles, rates
