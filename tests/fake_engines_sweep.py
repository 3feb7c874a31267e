"""Engines that misbehave in cells of their own choosing: by the length of the first rod, which a sweep can set.

A rod of FAULTS[name] m, or up to 0.9 mm more, makes the engine do that; with any other it is right. They are for sweeps
of ``rods-2`` whose parameter ``l1`` has these values among others.
"""

import os
import sys
import time

import numpy as np
from fake_engines import Right, about

from furiko.engines.workers.frames import HEADER, MAGIC

FAULTS = {"crash": 0.501, "hang": 0.502, "flood": 0.503, "hog": 0.504, "raise": 0.505, "rubbish": 0.506, "kill": 0.507}
BLOCK = 1 << 28  # bytes that the hog takes at a time


def faulty_lengths(scenes, planted):
    """Lengths of the first rod for so many scenes, all different; evenly among them so many faults, of all kinds."""
    kinds = list(FAULTS)
    lengths = [round(0.6 + 1e-6 * k, 6) for k in range(scenes)]
    for k in range(planted):
        lengths[k * scenes // planted] = _faulty(kinds[k % len(kinds)], k // len(kinds))
    return lengths


def _faulty(kind, number):
    """The number-th length that means this fault."""
    return round(FAULTS[kind] + 1e-6 * number, 6)


def fault_of(length):
    """The fault that a length means; None for none."""
    return next((kind for kind, least in FAULTS.items() if least <= length < least + 9e-4), None)


def about_this(name):
    others = ("fields", "inverse_dynamics", "joint_forces", "energy", "trajectory")
    return about(name, adapter=f"fake_engines_sweep:{name}", missing=dict.fromkeys(others, "not asked for here"))


def misbehave(fault):
    connection = int(sys.argv[1])
    if fault == "crash":
        os.abort()
    if fault == "hang":
        time.sleep(3600)
    if fault == "flood":
        os.write(connection, HEADER.pack(MAGIC, 2**62, 0))
        while True:
            os.write(connection, b"x" * 65536)
    if fault == "hog":
        taken = []
        while True:
            taken.append(np.empty(BLOCK // 8))
    if fault == "raise":
        raise RuntimeError("the time step is too large")
    if fault == "rubbish":
        os.write(connection, b"engine: warning: time step too large\n" * 100)
        time.sleep(3600)
    if fault == "kill":
        os.kill(os.getpid(), 9)


class Faulty(Right):
    """Right, but for the faults."""

    info = about_this("Faulty")

    def accelerations(self, theta, omega):
        misbehave(fault_of(self.system.lengths[0]))
        return super().accelerations(theta, omega)


class Sound(Right):
    """Right everywhere."""

    info = about_this("Sound")


class Off(Right):
    """Wrong in the sixth digit where the first rod is longer than a metre."""

    info = about_this("Off")

    def accelerations(self, theta, omega):
        return super().accelerations(theta, omega) * (1 + 1e-6 * (self.system.lengths[0] > 1))


class Slow(Right):
    """Takes a tenth of a second for each call."""

    info = about_this("Slow")

    def accelerations(self, theta, omega):
        time.sleep(0.1)
        return super().accelerations(theta, omega)
