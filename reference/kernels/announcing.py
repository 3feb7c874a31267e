"""Says on a terminal that numba compiles a kernel, where that takes a while: the first call would stall without a word.

Nothing is written into a pipe or a file. Imported with numba alone.
"""

from __future__ import annotations

import sys
import threading
from typing import Any

from numba.core import event

LONG = 1.0  # [s] of compiling before a word is said
# What each kernel is for, and how long it takes to compile: seconds of one core of an EPYC, numba 0.68.
KERNELS = {
    "rods_single": ("accelerations of rods", 2),
    "rods_batch": ("accelerations of rods in many states", 6),
    "refined_rods_batch": ("accelerations of unequal rods in many states", 8),
    "legs_single": ("accelerations of an N-leg pendulum", 1),
    "legs_batch": ("accelerations of an N-leg pendulum in many states", 4),
    "start": ("the start of a simulation", 1),
    "run_rods": ("simulations of rods", 6),
    "run_legs": ("simulations of an N-leg pendulum", 5),
    "run_rod_lanes": ("simulations of ensembles of rods", 9),
    "run_leg_lanes": ("simulations of ensembles of N-leg pendulums", 8),
    "run_rod_tangents": ("the growth of small differences of rods", 16),
    "run_leg_tangents": ("the growth of small differences of N-leg pendulums", 15),
    "run_rod_flips": ("flip times of rods", 10),
    "run_leg_flips": ("flip times of N-leg pendulums", 10),
}


class Announcer(event.Listener):  # type: ignore[misc]  # numba has no types
    """Listens to numba: of furiko's kernels, one inside another, only the outermost counts."""

    def __init__(self) -> None:
        self._waiting: dict[int, list[threading.Timer | None]] = {}  # by thread, outermost first

    def on_start(self, event: Any) -> None:
        """Numba begins to compile; what comes from its cache is no such event."""
        inside = self._waiting.setdefault(threading.get_ident(), [])
        dispatcher = event.data["dispatcher"]
        name = dispatcher.py_func.__name__
        ours = dispatcher.py_func.__module__.startswith(f"{__name__.rsplit('.', 2)[0]}.")
        timer = None
        if not inside and ours and name in KERNELS:
            kept = type(dispatcher._cache).__name__ != "NullCache"
            timer = threading.Timer(LONG, say, (name, kept))
            timer.daemon = True
            timer.start()
        inside.append(timer)

    def on_end(self, event: Any) -> None:
        """It is done, or has failed."""
        timer = self._waiting[threading.get_ident()].pop()
        if timer is not None:
            timer.cancel()


def say(name: str, kept: bool) -> None:
    """One line on standard error, if it is a terminal."""
    if sys.stderr is None or not sys.stderr.isatty():
        return
    what, seconds = KERNELS[name]
    again = "once: the result is kept" if kept else "in each process: there is no folder to keep the result in"
    sys.stderr.write(f"furiko: numba compiles {what}, about {seconds} s, {again}\n")
    sys.stderr.flush()


def announce() -> None:
    """Listen from now on."""
    event.register("numba:compile", Announcer())
