"""Accelerations in O(n): ``furiko.accelerations``, as plain numpy and as compiled code.

The formulas and their derivation are in :mod:`.elimination`: for rods an articulated-body algorithm (ABA). Plain numpy
runs them in any float type and needs no start-up; compiled code (:mod:`.forward_dynamics_compiled`) is 20 to 200 times
faster once there is machine code: made in 0.1 s (one state) or 0.6 s (many) of instructions that are written ahead
(:mod:`.ahead`), or compiled by numba where these do not fit, in some seconds once in the life of an installation.
Without llvmlite and numba (``furiko[fast]``) it is plain numpy always. Both are deterministic and a state's result does
not depend on the other states of the call; between plain, single and batch form it may differ by rounding, 1e-15 of
the largest acceleration.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Callable, Iterator
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.errors import InvalidInput
from ...models.spatial_mechanism import SpatialMechanism
from ...models.systems import System
from ..limits import checked_state, refuse_outside, shaped_state
from .ahead import load
from .elimination import (
    UNEQUAL,
    absorb_residual,
    absorb_rod,
    difference,
    force_above,
    leg_terms,
    moment_residual,
    rod_acceleration,
    turn,
    turn_down,
    turn_up,
)
from .threads import processors, thread_pool

Array = NDArray[np.float64]
FloatArray = NDArray[np.floating[Any]]

# The compiled kernels are loaded at the first call with so many angles, or after so many calls: a program that has
# asked eight times will ask again, one that asks a few times (a quick check) loads nothing.
MANY_ANGLES, MANY_CALLS = 4096, 8
ANGLES_A_THREAD = 50_000  # about 0.2 ms of work; handing a part to a thread takes 0.05 ms
SCRATCH_COLUMNS = 9

_ARRAY, _FLOAT64, _empty = np.ndarray, np.dtype(np.float64), np.empty
_kernels: dict[int, Kernel] = {}
_calls = 0


def accelerations(
    system: System | SpatialMechanism,
    theta: Any,
    omega: Any,
    torque: Any = None,
    *,
    out: Array | None = None,
    threads: int | None = None,
) -> Array:
    """Angular accelerations θ'' [rad/s²] of ``system`` in one state or many.

    ``theta`` [rad], ``omega`` [rad/s]: absolute angles and rates, shape (..., n), to 1e15 and 1e100; returns
    float64 of the same shape. ``out``: a contiguous float64 array of that shape to write into and return (fresh memory
    for large batches costs a quarter of the time). ``threads``: how many to use at most; None: as many as the work
    fills. Error relative to the largest acceleration, for n ≤ 1000, length ratios to 1e3, mass ratios to 1e6: 2e-16
    typically, 1e-14 at worst, unless rounding the state itself changes the accelerations by more. Terms below the
    smallest normal number, 2e-308 (all of them only where all rates are below 1e-153, and g is less than 1e-308 of the
    longest link a second squared), are exact to 5e-324 only, whatever the units of mass and length.
    Raises :class:`InvalidInput` for shapes that do not fit and numbers that are not finite or too large.

    An open mechanism in space (:class:`~furiko.models.spatial_mechanism.SpatialMechanism`, such as
    ``furiko.models.readers.model_file.read_model("robot.xml").spatial``) is a ``system`` too. ``theta`` is then q
    (..., nq), ``omega`` v (..., nv), ``torque`` generalised forces [N m or N], (..., nv) or (nv,), none if None, in
    MuJoCo's coordinates; returns (..., nv): see :func:`.trees.dynamics.tree_accelerations`.
    """
    kernel = _kernels.get(id(system))
    if (  # one state as a plain array: written out, because a call from Python costs as much as five rods
        kernel is not None
        and theta.__class__ is _ARRAY
        and omega.__class__ is _ARRAY
        and theta.ndim == 1
        and omega.ndim == 1
        and theta.dtype is _FLOAT64
        and omega.dtype is _FLOAT64
        and out is None
        and torque is None
    ):
        out = _empty(kernel.n)
        if kernel.single(theta, omega, out, kernel.table):
            checked_state(kernel, theta, omega)
        return out
    if isinstance(system, SpatialMechanism):
        from .trees.dynamics import tree_accelerations  # what most callers never need

        return tree_accelerations(system, theta, omega, torque, out=out, threads=threads)
    if torque is not None:
        raise InvalidInput("torque: the documents' mechanisms are not driven; None is needed")
    angles, rates = shaped_state(system, theta, omega)
    if out is not None and not (out.shape == angles.shape and out.dtype == _FLOAT64 and out.flags.carray):
        raise InvalidInput(f"out: a contiguous float64 array of shape {angles.shape} is needed")
    out = np.empty(angles.shape) if out is None else out
    if kernel is None and not _is_compiled(system, angles):
        refuse_outside(angles, rates)
        out[...] = plain_accelerations(system, angles, rates)
        return out
    kernel = kernel_of(system)
    if angles.ndim > 1:
        return kernel.batch(angles, rates, threads, out)
    if kernel.single(angles, rates, out, kernel.table):
        checked_state(system, angles, rates)
    return out


def plain_accelerations(system: System, theta: Any, omega: Any) -> Any:
    """:func:`accelerations` in plain numpy, in the float type of the arrays; shape (..., n), nothing checked."""
    masses, lengths, gravity = in_fitting_units(system)
    masses, lengths, gravity = masses.astype(theta.dtype), lengths.astype(theta.dtype), theta.dtype.type(gravity)
    form = _plain_rods if system.kind == "rod-chain" else _plain_legs
    return form(np.moveaxis(theta, -1, 0), np.moveaxis(omega, -1, 0), masses, lengths, gravity)


def link_masses(system: System) -> Array:
    """Masses of the links [kg], for rods at ρ = 1 kg/m: ρ is a factor of every term, and m_j = l_j is exact."""
    return np.array(system.lengths if system.kind == "rod-chain" else system.masses)


def in_fitting_units(system: System) -> tuple[Array, Array, float]:
    """Masses, lengths and gravity in units of mass and length in which the largest are from a half to one.

    θ'' is the same in all units. These are powers of two, which round nothing; they keep products of masses, lengths
    and accelerations in the normal range as long as θ'' itself is.
    """
    masses, lengths = link_masses(system), np.array(system.lengths)
    unit = math.ldexp(1.0, math.frexp(lengths.max())[1])
    return masses / math.ldexp(1.0, math.frexp(masses.max())[1]), lengths / unit, system.gravity / unit


class Kernel:
    """The compiled accelerations of one system, everything prepared: the way with the least overhead.

    Call it with θ and ω of one state, float64 arrays of shape (n,), or use :meth:`batch`.
    """

    def __init__(self, system: System) -> None:
        self.n = system.n
        self.masses, self.lengths, self.gravity = in_fitting_units(system)
        self.refined = unequal(self.lengths)
        self.table = table(self.masses, self.lengths, self.gravity, self.refined)
        self._kind = system.kind

    @cached_property
    def single(self) -> Callable[[Array, Array, Array, Array], int]:
        """The kernel of one state: θ, ω, θ'' of any stride, and :attr:`table`."""
        return _entry(_name(self._kind, self.refined, many=False))

    @cached_property
    def _batch(self) -> Callable[..., int]:
        return load.kernel(_name(self._kind, self.refined, many=True))

    def __call__(self, theta: Array, omega: Array) -> Array:
        """θ'' of one state; the types of the arrays are not checked."""
        out = _empty(self.n)
        if self.single(theta, omega, out, self.table):
            refuse_outside(theta, omega)
            raise InvalidInput(f"theta, omega: {self.n} values each are needed, got {len(theta)} and {len(omega)}")
        return out

    def batch(self, theta: Array, omega: Array, threads: int | None = None, out: Array | None = None) -> Array:
        """θ'' of one state or many, contiguous float64 arrays of shape (..., n), into ``out`` if given."""
        out = _empty(theta.shape) if out is None else out
        angles, rates, found = (theta, omega, out) if theta.ndim == 2 else self._rows(theta, omega, out)
        count = _parts(theta.size, threads)
        if count == 1:
            status = self._run(angles, rates, found)
        else:
            size = -(-len(angles) // count)
            parts = [slice(first, first + size) for first in range(0, len(angles), size)]
            run = thread_pool().map(lambda part: self._run(angles[part], rates[part], found[part]), parts)
            status = max(run)  # waits for all: they write into out
        if status:
            refuse_outside(theta, omega)
        return out

    def _rows(self, *arrays: Array) -> Iterator[Array]:
        return (array.reshape(-1, self.n) for array in arrays)

    def _run(self, theta: Array, omega: Array, out: Array) -> int:
        return self._batch(theta, omega, out, self.masses, self.lengths, self.gravity)


def kernel_of(system: System) -> Kernel:
    """The system's :class:`Kernel`, made once for as long as the system lives."""
    key = id(system)
    found = _kernels.get(key)
    if found is None:
        found = _kernels[key] = Kernel(system)
        weakref.finalize(system, _kernels.pop, key, None).atexit = False
    return found


def table(masses: Array, lengths: Array, gravity: float, refined: bool) -> Array:
    """All that the single-state kernels read and write, in one array: each array more would take 50 ns to unpack.

    Shape (n + 1, 11): mass, length and nine places of scratch a link; last row: gravity, and 1 where to refine.
    """
    rows = np.zeros((len(masses) + 1, 2 + SCRATCH_COLUMNS))
    rows[:-1, 0], rows[:-1, 1], rows[-1, :2] = masses, lengths, (gravity, refined)
    return rows


def unequal(lengths: FloatArray) -> bool:
    """Whether a chain of such rods needs refinement."""
    return bool(lengths.max() > UNEQUAL * lengths.min())


def _name(kind: str, refined: bool, *, many: bool) -> str:
    """Of the kernel."""
    if kind != "rod-chain":
        return "legs_batch" if many else "legs_single"
    if not many:
        return "rods_single"
    return "refined_rods_batch" if refined else "rods_batch"


@cache
def _entry(name: str) -> Callable[[Array, Array, Array, Array], int]:
    """The kernel of one state; of numba's, the compiled function itself.

    numba's dispatcher looks up the arguments' types anew in each call, which takes 0.3 µs; the function itself trusts
    that it is given float64 arrays with one axis and, last, the two of :func:`table`.
    """
    kernel: Any = load.kernel(name)
    strided = np.zeros(4)[::2]
    kernel(strided, strided, np.zeros(2), table(np.ones(2), np.ones(2), 0.0, refined=False))
    entry: Callable[[Array, Array, Array, Array], int] = kernel
    if not load.is_ahead(name):
        entry = kernel.overloads[kernel.signatures[0]].entry_point
    return entry


def _is_compiled(system: System, angles: Array) -> bool:
    """Whether compiled code answers: it is worth it and can be had."""
    name = _name(system.kind, unequal(np.array(system.lengths)), many=angles.ndim > 1)
    return _worth_compiling(angles.size, name) and load.can_load(name)


def _worth_compiling(angles: int, name: str) -> bool:
    global _calls  # noqa: PLW0603  # how often this process has asked is a fact of the process
    _calls += 1
    return load.is_loaded(name) or angles >= MANY_ANGLES or _calls > MANY_CALLS


def _parts(angles: int, threads: int | None) -> int:
    """The number of threads for so many angles: each must have work that is worth its start."""
    worth = angles // ANGLES_A_THREAD
    if worth > 1 or threads is not None:
        worth = min(worth, processors(threads))
    return max(worth, 1)


def _plain_rods(
    theta: FloatArray, omega: FloatArray, masses: FloatArray, lengths: FloatArray, gravity: Any
) -> FloatArray:
    """θ'' of a rod chain; arrays of shape (n, ...), returns (..., n)."""
    n = len(theta)
    sines, cosines = _sincos_of_differences(theta, np.concatenate([np.zeros_like(theta[:1]), theta[:-1]]))
    w = (omega * omega) * lengths.reshape(n, *[1] * (theta.ndim - 1))
    A = B = C = D = P = Q = np.zeros_like(theta[0])
    terms: list[Any] = [None] * n
    for j in reversed(range(n)):
        A, B, C, P, Q, *kept = absorb_rod(masses[j], w[j], A, B, C, D, P, Q)
        A, B, C, D, P, Q = turn(sines[j], cosines[j], A, B, C, P, Q)
        terms[j] = (sines[j], cosines[j], w[j], *kept)
    moved = np.empty_like(theta)
    above = np.empty((2, *theta.shape), theta.dtype)
    along, across = np.full_like(theta[0], -gravity), np.zeros_like(theta[0])
    for j in range(n):
        above[:, j] = turn_down(sines[j], cosines[j], along, across)
        s, c, wj, tau, kappa_B, kappa_m6 = terms[j]
        moved[j], along, across = rod_acceleration(s, c, wj, tau, kappa_B, kappa_m6, along, across)
    if unequal(lengths):
        moved += _plain_correction(masses, terms, above, moved)
    return np.ascontiguousarray(np.moveaxis(moved, 0, -1)) / lengths


def _plain_correction(masses: FloatArray, terms: list[Any], above: FloatArray, moved: FloatArray) -> FloatArray:
    """The correction of lθ'' by one step of refinement; above: a_{j-1} in each rod's frame, (2, n, ...)."""
    along = across = P = Q = np.zeros_like(moved[0])
    taus: list[Any] = [None] * len(terms)
    for j, (s, c, w, _, kappa_B, kappa_m6) in reversed([*enumerate(terms)]):
        delta = moment_residual(masses[j], above[1, j], moved[j], across)
        P, Q, taus[j] = absorb_residual(masses[j], delta, kappa_B, kappa_m6, P, Q)
        P, Q = turn_up(s, c, P, Q)
        along, across = force_above(masses[j], w, above[0, j], above[1, j], moved[j], along, across)
        along, across = turn_up(s, c, along, across)
    more = np.empty_like(moved)
    along = across = np.zeros_like(moved[0])
    for j, (s, c, _, _, kappa_B, kappa_m6) in enumerate(terms):
        more[j], along, across = rod_acceleration(s, c, 0, taus[j], kappa_B, kappa_m6, along, across)
    return more


def _plain_legs(
    theta: FloatArray, omega: FloatArray, masses: FloatArray, lengths: FloatArray, gravity: Any
) -> FloatArray:
    """θ'' of an N-leg pendulum; arrays of shape (n, ...), returns (..., n)."""
    column = (-1, *[1] * (theta.ndim - 1))
    l, m = lengths.reshape(column), masses.reshape(column)
    h = gravity * np.cos(theta[0]) + lengths[0] * omega[0] ** 2
    s, c = _sincos_of_differences(theta[:1], theta[1:])
    load, inertia = leg_terms(m[1:], l[1:] * omega[1:] ** 2, h, s, c)
    G = -load.sum(axis=0) / (masses[0] + inertia.sum(axis=0))
    out = np.concatenate([(G - gravity * np.sin(theta[0]))[np.newaxis], h * s - c * G]) / l
    return np.ascontiguousarray(np.moveaxis(out, 0, -1))


def _sincos_of_differences(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Sine and cosine of x - y, the difference taken exactly."""
    high, low = difference(x, y)
    s, c, low_s, low_c = np.sin(high), np.cos(high), np.sin(low), np.cos(low)
    return s * low_c + c * low_s, c * low_c - s * low_s
