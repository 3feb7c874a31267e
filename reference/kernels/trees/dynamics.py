"""Accelerations of open mechanisms in space: ``furiko.accelerations`` of a robot.

The algorithm is in :mod:`.formulas`. Compiled (:mod:`.machine`), it takes some 30 ns a joint and state; plain numpy
runs the same formulas over all states at once, in some µs, and needs no start-up. Plain numpy answers until what it has
cost would have paid for compiling, and always without llvmlite (``furiko[fast]``). Both are deterministic and a
state's result does not depend on the other states of the call; one may differ from the other by rounding.
"""

from __future__ import annotations

import sys
from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....models.errors import InvalidInput
from ....models.spatial_mechanism import SpatialMechanism
from ...limits import FLOAT64, LARGEST_ANGLE, numbers
from ..threads import processors, thread_pool
from . import plain
from .springs import sprung
from .table import Table, kept_table

Array = NDArray[np.float64]

STATES_ALIKE = 300  # so many states cost plain numpy twice what one does
WORTH = 3000  # pieces of plain numpy, some 0.5 s of a processor: what compiling takes
FREEDOMS_A_THREAD = 8_000  # about 0.25 ms of work
SIZES = 1e-100, 1e100  # of quaternions: beyond, squares leave the range of doubles
LEAST_PIVOT = 2.0**-1022  # kg m² or kg: a smaller double is subnormal, and has fewer digits

_COMPILED = f"{__package__}.machine"
_spent = 0.0


def tree_accelerations(
    mechanism: SpatialMechanism,
    q: Any,
    v: Any,
    torque: Any = None,
    *,
    out: Array | None = None,
    threads: int | None = None,
) -> Array:
    """v' [rad/s² or m/s²] of ``mechanism`` in one state or many, float64 (..., nv).

    ``q`` (..., nq), ``v`` (..., nv): MuJoCo's coordinates and rates, as
    :mod:`furiko.models.spatial_mechanism` has them; a quaternion of any length but zero stands for the rotation of its
    direction, angles go to 1e15 rad. ``torque``: generalised forces [N m or N] of v's shape or (nv,), zero if None.
    Armature, damping and springs act; dry friction, limits and contacts do not. ``out``: a contiguous float64 array of
    v's shape to write into and return. ``threads``: how many to use at most; None: as many as the work fills.

    The residual that accelerations leave is a few ε of the terms of its equation, summed in magnitude over the bodies.
    Raises :class:`InvalidInput` for shapes that do not fit, numbers that are not finite or too large, a quaternion or
    axis of length zero, and where a pivot of the mass matrix is not positive: something moves that weighs nothing, or
    so little that its number is subnormal.
    """
    known = kept_table(mechanism)
    q, v, torque, out = _shaped(known, q, v, torque, out)
    if not out.size:
        return out
    rows = q.reshape(-1, known.nq), v.reshape(-1, known.nv), out.reshape(-1, known.nv)
    forces = None if torque is None else torque.reshape(rows[1].shape)
    positions = _sized(mechanism, rows[0])
    forces = sprung(mechanism, positions, forces)
    signs = _run(known, positions, rows[1], forces, rows[2], threads)
    _judge(mechanism, signs, q, v, torque)
    return out


def _shaped(known: Table, q: Any, v: Any, torque: Any, out: Array | None) -> tuple[Array, Array, Array | None, Array]:
    """All as contiguous arrays of shapes that fit."""
    q, v = numbers("q", q), numbers("v", v)
    for name, values, size in (("q", q, known.nq), ("v", v, known.nv)):
        if values.ndim == 0 or values.shape[-1] != size:
            raise InvalidInput(f"{name}: the last axis must hold {size} numbers, (..., {size}), got {values.shape}")
    if q.shape[:-1] != v.shape[:-1]:
        raise InvalidInput(f"v: one row for each of q is needed, {(*q.shape[:-1], known.nv)}, got {v.shape}")
    if torque is not None:
        torque = numbers("torque", torque)
        if torque.shape not in (v.shape, (known.nv,)):
            raise InvalidInput(f"torque: v's shape {v.shape} or ({known.nv},) is needed, got {torque.shape}")
        torque = np.ascontiguousarray(np.broadcast_to(torque, v.shape))
    if out is not None and not (out.shape == v.shape and out.dtype == FLOAT64 and out.flags.carray):
        raise InvalidInput(f"out: a contiguous float64 array of shape {v.shape} is needed")
    return q, v, torque, np.empty(v.shape) if out is None else out


def _sized(mechanism: SpatialMechanism, q: Array) -> Array:
    """q (B, nq) with quaternions that can be squared. Raises InvalidInput where one has length zero."""
    for placed in mechanism.joints:
        if placed.joint.kind not in ("ball", "free"):
            continue
        columns = slice(placed.columns_q.stop - 4, placed.columns_q.stop)
        sizes = np.abs(q[:, columns]).max(axis=-1)
        if not sizes.all():
            raise InvalidInput(f"joint {placed.joint.name!r}: its quaternion in q has length zero")
        odd = ((sizes < SIZES[0]) | (sizes > SIZES[1])) & (sizes < np.inf)
        if odd.any():
            q = q.copy()
            q[odd, columns] /= sizes[odd, None]
    return q


def _run(
    known: Table, q: Array, v: Array, torque: Array | None, out: Array, threads: int | None
) -> tuple[float, float, float]:
    """The accelerations into ``out``, and what the run noticed."""
    available = processors(threads)
    if not (_worth_compiling(known, len(q)) and _can_compile()):
        return plain.run(known, q, v, torque, out)
    from .machine import machine

    compiled = machine()
    count = min(available, max(out.size // FREEDOMS_A_THREAD, 1))
    if count == 1:
        return compiled.run(known, q, v, torque, out)
    size = -(-len(q) // count)
    parts = [slice(first, first + size) for first in range(0, len(q), size)]
    found = thread_pool().map(
        lambda part: compiled.run(known, q[part], v[part], torque if torque is None else torque[part], out[part]), parts
    )
    finite, largest, pivot = zip(*found, strict=True)  # waits for all: they write into out
    return sum(finite), max(largest), max(pivot)


def _worth_compiling(known: Table, states: int) -> bool:
    """Whether plain numpy has cost, with this call, what compiling takes."""
    global _spent  # noqa: PLW0603  # what this process has asked for is a fact of the process
    if _spent <= WORTH:
        _spent += len(known.program) * (1 + states / STATES_ALIKE)
    return _spent > WORTH or _COMPILED in sys.modules


@cache
def _can_compile() -> bool:
    """Whether llvmlite is installed: without it plain numpy answers all calls."""
    return find_spec("llvmlite") is not None


def _judge(
    mechanism: SpatialMechanism, signs: tuple[float, float, float], q: Array, v: Array, torque: Array | None
) -> None:
    """Raise InvalidInput where the run noticed that its numbers mean nothing."""
    finite, largest, pivot = signs
    if finite == 0 and largest <= LARGEST_ANGLE and pivot <= -LEAST_PIVOT:
        return
    for name, values in (("q", q), ("v", v), ("torque", torque)):
        if values is not None:
            _refuse(name, values, np.isfinite(values), "must be finite")
    hinges = [placed.at_q for placed in mechanism.joints if placed.joint.kind == "hinge"]
    fits = np.ones(q.shape, dtype=bool)
    fits[..., hinges] = np.abs(q[..., hinges]) <= LARGEST_ANGLE
    _refuse("q", q, fits, f"an angle must be at most {LARGEST_ANGLE:g} rad")
    if not pivot < 0:
        raise InvalidInput("the mass matrix is singular in a state: a joint moves nothing that has mass, or armature")
    if pivot > -LEAST_PIVOT:
        raise InvalidInput(
            f"a joint moves {-pivot:.2g} kg m² (or kg) in a state, which doubles hold to a few digits only: give "
            "masses or lengths in a smaller unit, so that their numbers are larger"
        )
    raise InvalidInput("the accelerations of a state are beyond the range of doubles")


def _refuse(name: str, values: Array, fits: NDArray[np.bool_], what: str) -> None:
    if not fits.all():
        place = tuple(int(i) for i in np.argwhere(~fits)[0])
        raise InvalidInput(f"{name}[{', '.join(map(str, place))}]: {what}, got {float(values[place])!r}")
