"""The options with which numba compiles furiko's kernels, and access to memory and instructions that Python lacks.

Imported only when compiled code is needed: importing numba takes a quarter of a second.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from ...models.errors import missing

try:
    import numba
    from llvmlite import ir
    from numba import types
    from numba.extending import intrinsic as numba_intrinsic
except ImportError as error:  # whatever else needs numba imports this module first
    raise missing("numba", error) from error

from .ahead.kernels import source_stamp
from .announcing import announce  # needs numba as well
from .instructions import FAST

announce()
LINE = 8  # numbers in a line of the cache
F = TypeVar("F", bound=Callable[..., Any])

# error_model: Python's check for division by zero would keep every loop with a division from being vectorised.
OPTIONS: dict[str, Any] = {"error_model": "numpy", "fastmath": set(FAST)}

njit: Any = numba.njit  # numba's own types know neither forceinline nor what the result can be called with


def intrinsic(function: Callable[..., Any]) -> Any:
    """numba's decorator for a function that is written in instructions: its first parameter is not the caller's."""
    return numba_intrinsic(function)


def inlined(function: F) -> F:
    """Compile an elementwise function into every place that calls it."""
    return _part(function, forceinline=True)


def merged(function: F) -> F:
    """Put a function's text into the place of its call before anything is compiled: of functions that are called once.

    numba compiles and optimises each function that it knows by itself, and again within each that calls it.
    """
    dispatcher = njit(inline="always", no_cpython_wrapper=True, no_cfunc_wrapper=True, **OPTIONS)(function)
    part: F = dispatcher
    return part


def called(function: F) -> F:
    """Compile a larger function once, to be called from other compiled code."""
    return _part(function, forceinline=False)


def _part(function: F, *, forceinline: bool) -> F:
    """A function that only compiled code calls: it needs no way in from Python or C."""
    dispatcher = njit(forceinline=forceinline, no_cpython_wrapper=True, no_cfunc_wrapper=True, **OPTIONS)(function)
    part: F = dispatcher
    return part


def compiled(*, releases_gil: bool) -> Callable[[F], F]:
    """Compile at the first call and keep the result on disk, beside the source or in the user's cache directory.

    Where neither can be written, the result lives as long as the process.
    """

    def decorate(function: F) -> F:
        try:
            dispatcher = njit(nogil=releases_gil, cache=True, **OPTIONS)(function)
        except RuntimeError:  # numba: no place for its cache
            dispatcher = njit(nogil=releases_gil, **OPTIONS)(function)
        else:
            # numba compares the date of the function's own file only, not of those it inlines.
            dispatcher._cache._cache_file._source_stamp = source_stamp()
        decorated: F = dispatcher
        return decorated

    return decorate


@inlined
def aligned(count: int) -> Any:
    """``count`` uninitialised numbers, aligned to a cache line: a vector across two lines takes twice as long."""
    numbers = np.empty(count + LINE)
    start = (-(numbers.ctypes.data // 8)) % LINE
    return numbers[start : start + count]


@intrinsic
def bits(_context: Any, _x: Any) -> Any:
    """The 64 bits of a float as an integer."""
    return types.int64(types.float64), lambda _c, builder, _s, args: builder.bitcast(args[0], ir.IntType(64))


@intrinsic
def wide_vectors(_context: Any) -> Any:
    """Let the function it is called in use vectors of 512 bits (LLVM alone stops at 256; measured gain 1.1 to 1.5).

    Without effect where the processor has none.
    """

    def generate(context: Any, builder: Any, _s: Any, _args: Any) -> Any:
        # llvmlite's own add() knows only attributes without a value.
        set.add(builder.function.attributes, '"prefer-vector-width"="512"')
        return context.get_dummy_value()

    return types.void(), generate


def _prefetcher(*, to_write: int, nearness: int) -> Any:
    """Ask for the memory at the array's index-th number, counted through all axes; harmless beyond its ends."""

    @intrinsic
    def prefetch(_context: Any, array: Any, _index: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            data = context.make_array(signature.args[0])(context, builder, args[0]).data
            address = builder.bitcast(builder.gep(data, [args[1]]), ir.IntType(8).as_pointer())
            word = ir.IntType(32)
            function = builder.module.declare_intrinsic(
                "llvm.prefetch", [address.type], ir.FunctionType(ir.VoidType(), [address.type, word, word, word])
            )
            builder.call(function, [address, word(to_write), word(nearness), word(1)])  # 1: data
            return context.get_dummy_value()

        return types.void(array, types.int64), generate

    return prefetch


prefetch_near = _prefetcher(to_write=0, nearness=2)  # into the second-level cache
prefetch_next = _prefetcher(to_write=0, nearness=3)  # into the first
prefetch_own = _prefetcher(to_write=1, nearness=3)  # into the first, to be written
