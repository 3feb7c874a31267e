"""Which kernels are written ahead, where their text is, and what they are given. Needs neither numba nor llvmlite."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

HERE = Path(__file__).parent
REFERENCE = HERE.parent.parent
# All text that goes into compiled code; last what writes it ahead.
SOURCES = (
    "kernels/elimination.py",
    "kernels/compiling.py",
    "kernels/instructions.py",
    "kernels/sizes.py",
    "kernels/lanes.py",
    "kernels/vector.py",
    "limits.py",
    "kernels/sincos.py",
    "kernels/sine.py",
    "integration/convolution.py",
    "integration/layout.py",
    "kernels/forward_dynamics_compiled.py",
    "integration/taylor_compiled.py",
    "integration/taylor_lanes.py",
    "integration/taylor_tangents.py",
    "integration/taylor_flips.py",
    "kernels/ahead/kernels.py",
    "kernels/ahead/runtime.ll",
    "write_kernels.py",
)


@dataclass(frozen=True)
class Parameter:
    """What a kernel is given at one place: a number, or a contiguous array of so many axes."""

    kind: str  # numpy's: "f" a double, "i" an integer of 64 bits
    axes: int
    strided: bool = False  # not contiguous, perhaps


@dataclass(frozen=True)
class Written:
    """A kernel: what it is for, the module of its Python text under ``reference``, and its parameters.

    ``packed``: the text takes them as one tuple (``*given``).
    """

    what: str
    module: str
    parameters: tuple[Parameter, ...]
    packed: bool


def _kernels(module: str, text: str, what: dict[str, str], *, packed: bool = True) -> dict[str, Written]:
    """The kernels of a module; their parameters by kind and axes, "s" where a row need not be contiguous."""
    given = tuple(Parameter(word[0], int(word[1]), word.endswith("s")) for word in text.split())
    return {name: Written(each, module, given, packed) for name, each in what.items()}


_LANES = "f2 f2 f1 f2 f2 f1 i0 f0 f3 f3 f2 i2 i1"  # masses … steps: what every run in lanes begins with
KERNELS = (
    _kernels(
        "kernels.forward_dynamics_compiled",
        "f1s f1s f1 f2",
        {"rods_single": "accelerations of rods", "legs_single": "accelerations of an N-leg pendulum"},
        packed=False,
    )
    | _kernels(
        "kernels.forward_dynamics_compiled",
        "f2 f2 f2 f1 f1 f0",
        {
            "rods_batch": "accelerations of rods in many states",
            "refined_rods_batch": "accelerations of unequal rods in many states",
            "legs_batch": "accelerations of an N-leg pendulum in many states",
        },
        packed=False,
    )
    | _kernels("integration.taylor_compiled", "f1 f1 f2", {"start": "the start of a simulation"}, packed=False)
    | _kernels(
        "integration.taylor_compiled",
        "f1 f1 f0 f1 i0 f0 f2 f1 i1 f2 f2 i0",
        {"run_rods": "simulations of rods", "run_legs": "simulations of an N-leg pendulum"},
    )
    | _kernels(
        "integration.taylor_lanes",
        f"{_LANES} f3 f3 i0",
        {
            "run_rod_lanes": "simulations of ensembles of rods",
            "run_leg_lanes": "simulations of ensembles of N-leg pendulums",
        },
    )
    | _kernels(
        "integration.taylor_tangents",
        f"{_LANES} f3 f3 f3 f1 f3 f4 f3 f2 f2 f3 f4 f2 i0",
        {
            "run_rod_tangents": "the growth of small differences of rods",
            "run_leg_tangents": "the growth of small differences of N-leg pendulums",
        },
    )
    | _kernels(
        "integration.taylor_flips",
        f"{_LANES} i1 f2 f1 i1 i0",
        {"run_rod_flips": "flip times of rods", "run_leg_flips": "flip times of N-leg pendulums"},
    )
)


def place(name: str) -> Path:
    """The file of a kernel."""
    return HERE / "files" / f"{name}.ll.xz"


@cache
def source_stamp() -> str:
    """A digest of all source text that goes into compiled code."""
    return hashlib.sha256(b"".join((REFERENCE / name).read_bytes() for name in SOURCES)).hexdigest()
