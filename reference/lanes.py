"""Many states in the lanes of vectors: from rows, as numpy has them, to lanes and back. Compiled code only.

A kernel works on LANES states at a time, one a lane; a quantity of a link is then LANES consecutive numbers of one
flat scratch array. A state is a row in memory, so that the same column of LANES states lies in as many places: eight
rows at a time are read as vectors and turned in registers, which takes a third of the time of single numbers.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from .compiling import LINE, inlined, prefetch
from .limits import LARGEST_ANGLE, LARGEST_RATE

LANES = 32  # four vectors of 512 bits hide each other's latency; more would leave the cache with fewer rods

INT = ir.IntType(32)
NUMBERS, WORDS, MASK = (ir.VectorType(kind, LINE) for kind in (ir.DoubleType(), ir.IntType(64), ir.IntType(1)))
ADDRESS = NUMBERS.as_pointer()
ALIGNED, ZEROS = INT(8), ir.Constant(NUMBERS, [0.0] * LINE)
EVEN, ODD, LOWER, UPPER = (  # of two vectors one after the other; the halves of what they are number by number
    ir.Constant(ir.VectorType(INT, LINE), picked)
    for picked in (
        [0, 2, 4, 6, 8, 10, 12, 14],
        [1, 3, 5, 7, 9, 11, 13, 15],
        [0, 8, 1, 9, 2, 10, 3, 11],
        [4, 12, 5, 13, 6, 14, 7, 15],
    )
)


@inlined
def filled_up(states: Any, first: int) -> Any:
    """A block of the states from the first on, fewer than LANES, and the last of them over and over.

    So a state's result does not depend on how many others there are.
    """
    filled = np.empty((LANES, states.shape[1]))
    for i in range(LANES):
        filled[i] = states[min(first + i, states.shape[0] - 1)]
    return filled


@inlined
def read_columns(states: Any, row: int, first: int, count: int, scratch: Any, to: int, stride: int) -> None:
    """``count`` ≤ 8 columns of the LANES states from ``row`` on, each into LANES places of the scratch from ``to`` on.

    ``first``: of the columns; ``stride``: from one column's places to the next one's. There must be room for eight.
    """
    width = states.shape[1]
    for i in range(0, LANES, LINE):
        read_tile(states, (row + i) * width + first, count, scratch, to + i, stride)


@inlined
def write_columns(scratch: Any, to: int, stride: int, states: Any, row: int, first: int, count: int) -> None:
    """The way back from :func:`read_columns`."""
    width = states.shape[1]
    for i in range(0, LANES, LINE):
        write_tile(scratch, to + i, stride, states, (row + i) * width + first, count)


@inlined
def fetch_ahead(theta: Any, omega: Any, out: Any, row: int, part: int) -> None:
    """Bring one part of the next block, LANES numbers of each array, near the processor.

    The columns of a block lie far apart in memory; without this every line of it would be waited for.
    """
    start = row * theta.shape[1] + part * LANES
    for i in range(0, LANES, LINE):
        prefetch(theta, start + i)
        prefetch(omega, start + i)
        prefetch(out, start + i)


RATE_WEIGHT = (LARGEST_ANGLE / LARGEST_RATE) ** 2
SUSPICIOUS = 0.99 * LARGEST_ANGLE**2  # rounding takes no hundredth


@inlined
def size(angle: float, rate_squared: float) -> float:
    """What :func:`any_suspicious` wants summed over the links: cheaper than to compare every angle and rate."""
    return angle * angle + RATE_WEIGHT * rate_squared


@inlined
def any_suspicious(sizes: Any) -> int:
    """1 if any lane may hold a number that is beyond what the kernels hold for, or not finite; it may be many large."""
    found = 0
    for i in range(LANES):
        found |= 0 if sizes[i] <= SUSPICIOUS else 1
    return found


@intrinsic  # type: ignore[untyped-decorator]
def read_tile(_context: Any, states: Any, _at: Any, _count: Any, scratch: Any, _to: Any, _stride: Any) -> Any:
    """Eight rows, ``count`` columns of each, the others 0, to eight vectors: three times even from odd."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        source, target = (context.make_array(signature.args[k])(context, builder, args[k]) for k in (0, 3))
        row = builder.extract_value(source.shape, 1)
        mask, places = _first(builder, args[2]), _places(builder, source.data, args[1], row)
        vectors = [builder.call(_masked_load(builder), [place, ALIGNED, mask, ZEROS]) for place in places]
        for _ in range(3):
            pairs = [*zip(vectors[::2], vectors[1::2], strict=True)]
            vectors = [builder.shuffle_vector(a, b, picked) for picked in (EVEN, ODD) for a, b in pairs]
        for vector, place in zip(vectors, _places(builder, target.data, args[4], args[5]), strict=True):
            builder.store(vector, place, align=8)
        return context.get_dummy_value()

    return types.void(states, types.int64, types.int64, scratch, types.int64, types.int64), generate


@intrinsic  # type: ignore[untyped-decorator]
def write_tile(_context: Any, scratch: Any, _to: Any, _stride: Any, states: Any, _at: Any, _count: Any) -> Any:
    """The way back: three times number by number."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        source, target = (context.make_array(signature.args[k])(context, builder, args[k]) for k in (0, 3))
        vectors = [builder.load(place, align=8) for place in _places(builder, source.data, args[1], args[2])]
        for _ in range(3):
            pairs = [*zip(vectors[:4], vectors[4:], strict=True)]
            vectors = [builder.shuffle_vector(a, b, picked) for a, b in pairs for picked in (LOWER, UPPER)]
        row, mask = builder.extract_value(target.shape, 1), _first(builder, args[5])
        for vector, place in zip(vectors, _places(builder, target.data, args[4], row), strict=True):
            builder.call(_masked_store(builder), [vector, place, ALIGNED, mask])
        return context.get_dummy_value()

    return types.void(scratch, types.int64, types.int64, states, types.int64, types.int64), generate


def _first(builder: Any, count: Any) -> Any:
    """A mask of the first ``count`` of eight."""
    filled = builder.insert_element(ir.Constant(WORDS, ir.Undefined), count, INT(0))
    counts = builder.shuffle_vector(filled, filled, ir.Constant(ir.VectorType(INT, LINE), [0] * LINE))
    return builder.icmp_signed("<", ir.Constant(WORDS, [*range(LINE)]), counts)


def _places(builder: Any, data: Any, at: Any, apart: Any) -> Iterator[Any]:
    """Eight addresses of vectors."""
    for _ in range(LINE):
        yield builder.bitcast(builder.gep(data, [at]), ADDRESS)
        at = builder.add(at, apart)


def _masked_load(builder: Any) -> Any:
    kind = ir.FunctionType(NUMBERS, [ADDRESS, INT, MASK, NUMBERS])
    return _declared(builder, "llvm.masked.load.v8f64.p0", kind)


def _masked_store(builder: Any) -> Any:
    kind = ir.FunctionType(ir.VoidType(), [NUMBERS, ADDRESS, INT, MASK])
    return _declared(builder, "llvm.masked.store.v8f64.p0", kind)


def _declared(builder: Any, name: str, kind: Any) -> Any:
    return builder.module.globals.get(name) or ir.Function(builder.module, kind, name)
