"""Says on a terminal that numba compiles a kernel, where that takes a while. Imported with numba alone."""

from __future__ import annotations

import threading
from typing import Any

from numba.core import event

from .ahead.announcing import saying_later
from .ahead.kernels import KERNELS

# How long each takes to compile: seconds of one core of an EPYC, numba 0.68.
SECONDS = {
    "rods_single": 2,
    "rods_batch": 6,
    "refined_rods_batch": 8,
    "legs_single": 1,
    "legs_batch": 4,
    "start": 1,
    "run_rods": 6,
    "run_legs": 5,
    "run_rod_lanes": 9,
    "run_leg_lanes": 8,
    "run_rod_tangents": 16,
    "run_leg_tangents": 15,
    "run_rod_flips": 10,
    "run_leg_flips": 10,
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
            timer = saying_later(line(name, kept))
        inside.append(timer)

    def on_end(self, event: Any) -> None:
        """It is done, or has failed."""
        timer = self._waiting[threading.get_ident()].pop()
        if timer is not None:
            timer.cancel()


def line(name: str, kept: bool) -> str:
    """What is said of a kernel."""
    again = "once: the result is kept" if kept else "in each process: there is no folder to keep the result in"
    return f"numba compiles {KERNELS[name].what}, about {SECONDS[name]} s, {again}"


def announce() -> None:
    """Listen from now on."""
    event.register("numba:compile", Announcer())
