"""Many states in the lanes of vectors: from rows, as numpy has them, to lanes and back. Compiled code only.

A kernel works on so many states at a time, ``lanes``, one a lane; a quantity of a link is then as many consecutive
numbers of one flat scratch array. A state is a row in memory, so that the same column of several states lies in as many
places: eight rows at a time are read as vectors and turned in registers, in a third of the time of single numbers.

``lanes`` is a multiple of eight known at compile time, and everything here is compiled into the place of its call.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types

from ..limits import LARGEST_ANGLE, LARGEST_RATE
from .compiling import LINE, inlined, intrinsic, prefetch_near, prefetch_next, prefetch_own
from .instructions import declared

INT, DOUBLE = ir.IntType(32), ir.DoubleType()
EVEN, ODD = [0, 2, 4, 6, 8, 10, 12, 14], [1, 3, 5, 7, 9, 11, 13, 15]  # of two vectors one after the other
LOWER, UPPER = [0, 8, 1, 9, 2, 10, 3, 11], [4, 12, 5, 13, 6, 14, 7, 15]  # halves of two vectors number by number


@inlined
def filled_up(states: Any, first: int, lanes: int) -> Any:
    """A block of the states from the first on, fewer than lanes, and the last of them over and over.

    So a state's result does not depend on how many others there are.
    """
    filled = np.empty((lanes, states.shape[1]))
    for i in range(lanes):
        row = min(first + i, states.shape[0] - 1)
        for j in range(states.shape[1]):  # an assignment to a slice takes seconds to compile
            filled[i, j] = states[row, j]
    return filled


@inlined
def read_columns(states: Any, row: int, first: int, count: int, scratch: Any, to: int, stride: int, lanes: int) -> None:
    """``count`` ≤ 8 columns of the states from ``row`` on, each into as many places of the scratch from ``to`` on.

    ``first``: of the columns; ``stride``: from one column's places to the next one's. The places of the
    next columns, of eight in all, may be overwritten.
    """
    at, width = row * states.shape[1] + first, states.shape[1]
    for i in range(0, lanes, LINE):
        if count <= 2:
            read_two(states, at + i * width, count, scratch, to + i, stride)
        elif count <= 4:
            read_four(states, at + i * width, count, scratch, to + i, stride)
        else:
            read_eight(states, at + i * width, count, scratch, to + i, stride)


@inlined
def write_columns(
    scratch: Any, to: int, stride: int, states: Any, row: int, first: int, count: int, lanes: int
) -> None:
    """The way back from :func:`read_columns`."""
    at, width = row * states.shape[1] + first, states.shape[1]
    for i in range(0, lanes, LINE):
        if count <= 2:
            write_two(scratch, to + i, stride, states, at + i * width, count)
        elif count <= 4:
            write_four(scratch, to + i, stride, states, at + i * width, count)
        else:
            write_eight(scratch, to + i, stride, states, at + i * width, count)


@inlined
def fetch_block(theta: Any, omega: Any, out: Any, row: int, part: int, lanes: int) -> None:
    """Bring one part of the next block, as many numbers of each array as there are lanes, near the processor.

    The columns of a block lie far apart in memory; without this every line of it would be waited for.
    """
    start = row * theta.shape[1] + part * lanes
    for i in range(0, lanes, LINE):
        prefetch_near(theta, start + i)
        prefetch_near(omega, start + i)
        prefetch_near(out, start + i)


@inlined
def fetch_to_read(states: Any, row: int, first: int, lanes: int) -> None:
    """Bring the columns from ``first`` on near, as many as a line of the cache holds."""
    for i in range(lanes):
        prefetch_next(states, (row + i) * states.shape[1] + first)


@inlined
def fetch_to_write(states: Any, row: int, first: int, lanes: int) -> None:
    """:func:`fetch_to_read` for what will be written."""
    for i in range(lanes):
        prefetch_own(states, (row + i) * states.shape[1] + first)


@inlined
def fetch_scratch(scratch: Any, start: int, count: int) -> None:
    """Bring part of the scratch near, to be written: of long chains it lies in the third-level cache and far apart."""
    for i in range(0, count, LINE):
        prefetch_own(scratch, start + i)


RATE_WEIGHT = (LARGEST_ANGLE / LARGEST_RATE) ** 2
SUSPICIOUS = 0.99 * LARGEST_ANGLE**2  # rounding takes no hundredth


@inlined
def size(angle: float, rate_squared: float) -> float:
    """A link's term in the sum that :func:`any_suspicious` tests: cheaper than to compare every angle and rate."""
    return angle * angle + RATE_WEIGHT * rate_squared


@inlined
def any_suspicious(sizes: Any) -> int:
    """1 if any lane may hold a number that is beyond what the kernels hold for, or not finite; it may be many large."""
    found = 0
    for i in range(sizes.size):
        found |= 0 if sizes[i] <= SUSPICIOUS else 1
    return found


def _reader(most: int) -> Any:
    """Eight rows, ``count`` ≤ ``most`` columns of each, to vectors of eight: log2(most) times even from odd."""

    @intrinsic
    def read(_context: Any, states: Any, _at: Any, _count: Any, scratch: Any, _to: Any, _stride: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            source, target = (context.make_array(signature.args[k])(context, builder, args[k]) for k in (0, 3))
            row, mask = builder.extract_value(source.shape, 1), _first(builder, args[2], most)
            places = _places(builder, source.data, args[1], row, LINE)
            vectors = [_masked_load(builder, place, mask) for place in places]
            while len(vectors) > most:
                vectors = [_shuffled(builder, a, b, range(2 * a.type.count)) for a, b in _neighbours(vectors)]
            for _ in range(most.bit_length() - 1):
                pairs = _neighbours(vectors)
                vectors = [_shuffled(builder, a, b, picked) for picked in (EVEN, ODD) for a, b in pairs]
            for vector, place in zip(vectors, _places(builder, target.data, args[4], args[5], most), strict=True):
                builder.store(vector, _as_vector(builder, place, LINE), align=8)
            return context.get_dummy_value()

        return types.void(states, types.int64, types.int64, scratch, types.int64, types.int64), generate

    return read


def _writer(most: int) -> Any:
    """The way back: log2(most) times number by number."""

    @intrinsic
    def write(_context: Any, scratch: Any, _to: Any, _stride: Any, states: Any, _at: Any, _count: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            source, target = (context.make_array(signature.args[k])(context, builder, args[k]) for k in (0, 3))
            places = _places(builder, source.data, args[1], args[2], most)
            vectors = [builder.load(_as_vector(builder, place, LINE), align=8) for place in places]
            for _ in range(most.bit_length() - 1):
                pairs = zip(vectors[: most // 2], vectors[most // 2 :], strict=True)
                vectors = [_shuffled(builder, a, b, picked) for a, b in pairs for picked in (LOWER, UPPER)]
            while len(vectors) < LINE:
                half = vectors[0].type.count // 2
                parts = range(half), range(half, 2 * half)
                vectors = [_shuffled(builder, vector, vector, part) for vector in vectors for part in parts]
            row, mask = builder.extract_value(target.shape, 1), _first(builder, args[5], most)
            for vector, place in zip(vectors, _places(builder, target.data, args[4], row, LINE), strict=True):
                _masked_store(builder, vector, place, mask)
            return context.get_dummy_value()

        return types.void(scratch, types.int64, types.int64, states, types.int64, types.int64), generate

    return write


def _neighbours(vectors: list[Any]) -> list[Any]:
    return [*zip(vectors[::2], vectors[1::2], strict=True)]


def _places(builder: Any, data: Any, at: Any, apart: Any, count: int) -> Iterator[Any]:
    for _ in range(count):
        yield builder.gep(data, [at])
        at = builder.add(at, apart)


def _as_vector(builder: Any, place: Any, count: int) -> Any:
    return builder.bitcast(place, ir.VectorType(DOUBLE, count).as_pointer())


def _shuffled(builder: Any, a: Any, b: Any, picked: Iterable[int]) -> Any:
    picks = [*picked]
    return builder.shuffle_vector(a, b, ir.Constant(ir.VectorType(INT, len(picks)), picks))


def _first(builder: Any, count: Any, most: int) -> Any:
    """A mask of the first ``count`` of ``most``."""
    words = ir.VectorType(ir.IntType(64), most)
    alone = builder.insert_element(ir.Constant(words, ir.Undefined), count, INT(0))
    counts = _shuffled(builder, alone, alone, [0] * most)
    return builder.icmp_signed("<", ir.Constant(words, [*range(most)]), counts)


def _masked_load(builder: Any, place: Any, mask: Any) -> Any:
    numbers = ir.VectorType(DOUBLE, mask.type.count)
    kind = ir.FunctionType(numbers, [numbers.as_pointer(), INT, mask.type, numbers])
    function = declared(builder, f"llvm.masked.load.v{numbers.count}f64.p0", kind)
    zeros = ir.Constant(numbers, [0.0] * numbers.count)
    return builder.call(function, [_as_vector(builder, place, numbers.count), INT(8), mask, zeros])


def _masked_store(builder: Any, vector: Any, place: Any, mask: Any) -> None:
    numbers = vector.type
    kind = ir.FunctionType(ir.VoidType(), [numbers, numbers.as_pointer(), INT, mask.type])
    function = declared(builder, f"llvm.masked.store.v{numbers.count}f64.p0", kind)
    builder.call(function, [vector, _as_vector(builder, place, numbers.count), INT(8), mask])


read_two, read_four, read_eight = map(_reader, (2, 4, 8))
write_two, write_four, write_eight = map(_writer, (2, 4, 8))
