"""A made-up stress summary, as the JSON document that ``furiko stress`` prints and as records."""

import msgspec

from furiko.records.check import Header
from furiko.records.stress import StressSummary

HEADER = Header(
    furiko="1", started="2026-01-01T00:00:00+00:00", command="furiko stress <script>", profile="stress", seed="1",
    machine={}, versions={"numpy": "2"}, scenes=[], engines=[],
)  # fmt: skip

POINT = {
    "at": "1e+04 m", "worst error": 1e-3, "digits": 15.5, "one ulp does": 1e-16, "condition": 10.0,
    "error over ε·cond": 0.25, "failure": None, "error over bound": None,
}  # fmt: skip


def frontier(**changes):
    return {
        "axis": "long-rods", "says": "longer & longer", "engine": "mujoco", "pair": False, "closed": True,
        "status": "fails", "holds": 7, "fails": 8, "holds at": "3160 m", "fails at": "1e+04 m", "top": 12,
        "failure": "half its digits lost", "reason": "a <b>bold</b> reason", "mechanism": None,
        "curve": [{"value": 1.0, "error": 1e-15, **POINT}, {"value": 1e4, "error": 1e-7, **POINT}],
    } | changes  # fmt: skip


def steps(**changes):
    return {
        "engine": "mujoco", "integrator": "RK4", "stress": "links", "value": 2.0, "unit": "rods", "closed": True,
        "rung": 17, "step": 0.18, "fails at": 0.25, "failure": "energy runs away", "reason": "energy",
        "cells": [{"rung": 0, "step": 0.0005, "failure": None}, {"rung": 18, "step": 0.25, "failure": "NaN"}],
    } | changes  # fmt: skip


def summary(**changes):
    """A summary from its JSON document, with these keys changed."""
    return msgspec.convert(document() | changes, StressSummary)


def document():
    return {
        "seed": 1, "cases": 12, "open": 2,
        "frontiers": [frontier(), frontier(engine="kernels", status="holds", failure=None)],
        "kernels": {"cases": 5, "promised": 1e-13, "worst": 9e-15, "broken": [], "exceptions": []},
        "condition": [
            {"posture": "legs", "coordinates": "relative", "n": [4, 8], "condition": [10.0, 20.0], "power": 1.0}
        ],
        "steps": [steps(), steps(value=4.0, closed=False)],
        "long runs": [{
            "engine": "mujoco", "integrator": "Euler", "steps": 1000, "of": 10_000, "closed": False,
            "kind": "random walk", "failure": None, "drift": [0.0, 0.1, 0.05], "largest": 0.1, "exponent": 0.5,
            "rate": 1e-9, "spread": 0.1,
        }],
        "failures": [{"engine": "mujoco", "failure": "NaN", "times": 3, "where": "here", "reason": "why"}],
        "chain": {
            "swings": [{"links": "rods", "n": [100, 200], "power": 2,
                        "rows": [{"k": 1, "errors": [3e-6, 7.5e-7], "order": 2.0, "coefficient": 0.03}]}],
            "usable step": [{"n": 5, "step": 0.07}, {"n": 10, "step": 0.03}],
            "memory": [{"n": 1000, "bytes": 1e6}], "motions": [motion(10), motion(20)], "in step": [],
            "convergence": [{"amplitude": 1.0, "n": 10, "times": [0.25], "apart": [1e-3], "order": [2.0],
                             "series": [0.0, 1e-3]}],
            "verdict": ["It is physics."],
        },
        "tree runs": [{
            "engine": "mujoco", "integrator": "RK4", "motion": "top", "says": "a top without torque", "step": 0.01,
            "closed": True, "holds at": 1.0, "fails at": 10.0, "failure": "phase", "reason": "the phase is off",
            "runs": [{"time": 1.0, "phase error": 1e-9, "energy drift": 1e-12, "length drift": None, "failure": None}],
        }],
    }  # fmt: skip


def motion(n):
    return {
        "n": n, "amplitude": 1.0, "tolerance": 1e-13, "closed": True, "time": 0.5, "tip": [[0, -1]] * 3,
        "speed": [0.0, 1.0, 2.0], "fastest tip": 2.0, "fastest tip at": 0.5, "fastest turning": 40.0,
        "energy drift": 1e-15, "steps": 100, "mean step": 5e-3, "seconds": 0.1,
        "curves": {"0.25": [[0.1, -0.5], [0.2, -0.9]]},
    }  # fmt: skip
