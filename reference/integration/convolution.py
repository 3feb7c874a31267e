"""The products of series in a Taylor step, eight links at a time with all sums in registers.

Half of a step's time goes here. Written as Python loops, LLVM cannot keep the sums in registers (it would have to
vectorise the outer of two loops); written as instructions it takes a third of the time for 20 rods and more.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils

from ..kernels.compiling import intrinsic
from ..kernels.vector import EIGHT, INTEGER, VECTOR

SINE, COSINE, OMEGA, FP, FQ, SERIES = range(6)  # series[which, order, link]
WP, WQ, R = range(3)  # part[which, link]


@intrinsic
def convolve_eight(_context: Any, series: Any, _order: Any, _start: Any, part: Any) -> Any:
    """For order k and links start … start + 7, with i from 1:

    part[WP] = Σ s_i ω_{k+1-i}, part[WQ] = Σ c_i ω_{k+1-i} (to i = k+1), part[R] = Σ (c_i F^q_{k-i} - s_i F^p_{k-i})
    (to i = k). ``series`` (SERIES, orders, links) and ``part`` (…, links) are contiguous, links a multiple of 8; with
    one axis more, of eight lanes, links and lanes are counted through.
    """
    return types.void(series, types.int64, types.int64, part), _generate


def _generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    series = context.make_array(signature.args[0])(context, builder, args[0])
    part = context.make_array(signature.args[3])(context, builder, args[3])
    order, start = args[1], args[2]
    _, orders, links, *lanes = cgutils.unpack_tuple(builder, series.shape)
    for lane in lanes:
        links = builder.mul(links, lane)
    one = INTEGER(1)

    def vector(data: Any, row: Any) -> Any:
        place = builder.gep(data, [builder.add(builder.mul(row, links), start)])
        return builder.bitcast(place, VECTOR.as_pointer())

    def term(which: int, row: Any) -> Any:
        return builder.load(vector(series.data, builder.add(builder.mul(INTEGER(which), orders), row)), align=8)

    def add(total: Any, x: Any, y: Any) -> None:
        product = builder.fmul(x, y, flags=("contract",))
        builder.store(builder.fadd(product, builder.load(total), flags=("contract",)), total)

    zero = ir.Constant(VECTOR, [0.0] * EIGHT)
    sw, cw, sf, cf = (cgutils.alloca_once_value(builder, zero) for _ in range(4))
    with cgutils.for_range(builder, order) as loop:
        i = builder.add(loop.index, one)
        behind = builder.sub(order, i)
        s, c = term(SINE, i), term(COSINE, i)
        omega = term(OMEGA, builder.add(behind, one))
        add(sw, s, omega)
        add(cw, c, omega)
        add(sf, s, term(FP, behind))
        add(cf, c, term(FQ, behind))
    last, first = builder.add(order, one), term(OMEGA, INTEGER(0))
    add(sw, term(SINE, last), first)
    add(cw, term(COSINE, last), first)
    for which, total in (
        (WP, builder.load(sw)),
        (WQ, builder.load(cw)),
        (R, builder.fsub(builder.load(cf), builder.load(sf))),
    ):
        builder.store(total, vector(part.data, INTEGER(which)), align=8)
    return context.get_dummy_value()
