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
from ..kernels.sizes import EIGHT
from ..kernels.vector import INTEGER, VECTOR

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


@intrinsic
def convolve_tangent(_context: Any, series: Any, tangent: Any, _order: Any, _start: Any, part: Any) -> Any:
    """The first variation of :func:`convolve_eight`: what its sums change by where the series change by ``tangent``.

    Of every product two, the change of either factor times the other. A turn is counted from where the motion itself
    begins the step, and so the zeroth order of the sine's change is that of the angle there, which is not zero.
    """
    return types.void(series, tangent, types.int64, types.int64, part), _generate_variation


def _generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    rows = _Rows(context, builder, signature.args[0], args[0], args[2])
    order = args[1]
    one = INTEGER(1)
    sums = _Sums(builder)
    with cgutils.for_range(builder, order) as loop:
        i = builder.add(loop.index, one)
        behind = builder.sub(order, i)
        s, c = rows.term(SINE, i), rows.term(COSINE, i)
        omega = rows.term(OMEGA, builder.add(behind, one))
        sums.add("sw", s, omega)
        sums.add("cw", c, omega)
        sums.add("sf", s, rows.term(FP, behind))
        sums.add("cf", c, rows.term(FQ, behind))
    last, first = builder.add(order, one), rows.term(OMEGA, INTEGER(0))
    sums.add("sw", rows.term(SINE, last), first)
    sums.add("cw", rows.term(COSINE, last), first)
    return sums.written(context, signature.args[3], args[3], rows)


def _generate_variation(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    rows, changes = (_Rows(context, builder, signature.args[k], args[k], args[3]) for k in (0, 1))
    order = args[2]
    one = INTEGER(1)
    sums = _Sums(builder)
    with cgutils.for_range(builder, order) as loop:
        i = builder.add(loop.index, one)
        behind = builder.sub(order, i)
        ahead = builder.add(behind, one)
        for turns, others in ((rows, changes), (changes, rows)):
            s, c, omega = turns.term(SINE, i), turns.term(COSINE, i), others.term(OMEGA, ahead)
            sums.add("sw", s, omega)
            sums.add("cw", c, omega)
            sums.add("sf", s, others.term(FP, behind))
            sums.add("cf", c, others.term(FQ, behind))
    last, first = builder.add(order, one), INTEGER(0)
    for turns, others in ((rows, changes), (changes, rows)):
        sums.add("sw", turns.term(SINE, last), others.term(OMEGA, first))
        sums.add("cw", turns.term(COSINE, last), others.term(OMEGA, first))
    turned = changes.term(SINE, first)
    sums.add("sw", turned, rows.term(OMEGA, last))
    sums.add("sf", turned, rows.term(FP, order))
    return sums.written(context, signature.args[4], args[4], rows)


class _Rows:
    """Eight numbers of any row of a series, from ``start`` on."""

    def __init__(self, context: Any, builder: Any, kind: Any, value: Any, start: Any) -> None:
        series = context.make_array(kind)(context, builder, value)
        _, self.orders, links, *lanes = cgutils.unpack_tuple(builder, series.shape)
        for lane in lanes:
            links = builder.mul(links, lane)
        self.builder, self.data, self.links, self.start = builder, series.data, links, start

    def vector(self, data: Any, row: Any) -> Any:
        """Where they stand in ``data``."""
        place = self.builder.gep(data, [self.builder.add(self.builder.mul(row, self.links), self.start)])
        return self.builder.bitcast(place, VECTOR.as_pointer())

    def term(self, which: int, order: Any) -> Any:
        """Those of one order of one of the series."""
        row = self.builder.add(self.builder.mul(INTEGER(which), self.orders), order)
        return self.builder.load(self.vector(self.data, row), align=8)


class _Sums:
    """Four sums in registers: sine and cosine with the rate (``w``) and with the force (``f``)."""

    def __init__(self, builder: Any) -> None:
        self.builder = builder
        zero = ir.Constant(VECTOR, [0.0] * EIGHT)
        self.totals = {name: cgutils.alloca_once_value(builder, zero) for name in ("sw", "cw", "sf", "cf")}

    def add(self, name: str, x: Any, y: Any) -> None:
        """One product more."""
        total = self.totals[name]
        product = self.builder.fmul(x, y, flags=("contract",))
        self.builder.store(self.builder.fadd(product, self.builder.load(total), flags=("contract",)), total)

    def written(self, context: Any, kind: Any, value: Any, rows: _Rows) -> Any:
        """The sums where :func:`convolve_eight` says."""
        part = context.make_array(kind)(context, self.builder, value)
        sw, cw, sf, cf = (self.builder.load(total) for total in self.totals.values())
        for which, total in ((WP, sw), (WQ, cw), (R, self.builder.fsub(cf, sf))):
            self.builder.store(total, rows.vector(part.data, INTEGER(which)), align=8)
        return context.get_dummy_value()
