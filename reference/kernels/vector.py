"""Eight numbers as one value in compiled code: arithmetic on eight trajectories at once.

A compiled function that is written for numbers compiles for vectors of eight unchanged: ``+``, ``-``, ``*``, ``/``
and a sign work on them, and between them and a number. :func:`load` and :func:`store` read and write one number of an
array, or, where the array has one axis more, the eight numbers there. Left to itself, the compiler does not find such
vectors: in loops over eight lanes it must first prove that no array overlaps another.
"""

from __future__ import annotations

import operator
from typing import Any, ClassVar

from llvmlite import ir
from numba import types
from numba.core.typing import templates
from numba.core.typing.templates import ConcreteTemplate, signature
from numba.extending import lower_builtin, models, register_model

from .compiling import intrinsic
from .instructions import FAST, declared, in_quadrants
from .sizes import EIGHT

infer_global: Any = templates.infer_global  # of which numba does not say what it is

DOUBLE, INTEGER = ir.DoubleType(), ir.IntType(64)
VECTOR = ir.VectorType(DOUBLE, EIGHT)


class VectorType(types.Type):  # type: ignore[misc]  # numba has no types of its own
    """numba's type of a vector of eight."""

    def __init__(self) -> None:
        super().__init__("vector of eight")


vector = VectorType()


@register_model(VectorType)
class _VectorModel(models.PrimitiveModel):  # type: ignore[misc]
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, VECTOR)


SIDES = (vector, vector), (vector, types.float64), (types.float64, vector)


def _arithmetic(name: str, function: Any) -> None:
    """Teach numba one operation between two vectors, and between a vector and a number."""

    @infer_global(function)
    class _Operation(ConcreteTemplate):  # type: ignore[misc]
        cases: ClassVar = [signature(vector, *sides) for sides in SIDES]

    def generate(_context: Any, builder: Any, signature: Any, args: Any) -> Any:
        both = [
            side if kind == vector else spread(builder, side) for side, kind in zip(args, signature.args, strict=True)
        ]
        return getattr(builder, name)(*both, flags=FAST)

    for sides in SIDES:
        lower_builtin(function, *sides)(generate)


for _name, _function in (
    ("fadd", operator.add),
    ("fadd", operator.iadd),
    ("fsub", operator.sub),
    ("fmul", operator.mul),
    ("fdiv", operator.truediv),
):
    _arithmetic(_name, _function)


@infer_global(operator.neg)
class _Negation(ConcreteTemplate):  # type: ignore[misc]
    cases: ClassVar = [signature(vector, vector)]


def _negative(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    return builder.fneg(args[0])


lower_builtin(operator.neg, vector)(_negative)


def spread(builder: Any, number: Any) -> Any:
    """A vector of eight equal numbers."""
    alone = builder.insert_element(ir.Constant(VECTOR, ir.Undefined), number, ir.IntType(32)(0))
    picks = ir.Constant(ir.VectorType(ir.IntType(32), EIGHT), [0] * EIGHT)
    return builder.shuffle_vector(alone, alone, picks)


def _elementwise(name: str, count: int) -> Any:
    """One of LLVM's functions of ``count`` numbers or vectors, elementwise; a number among vectors is spread."""

    def typed(*kinds: Any) -> Any:
        kind = vector if vector in kinds else types.float64

        def generate(_context: Any, builder: Any, signature: Any, args: Any) -> Any:
            of_vectors = signature.return_type == vector
            sides = [
                spread(builder, side) if of_vectors and side_kind != vector else side
                for side, side_kind in zip(args, signature.args, strict=True)
            ]
            numbers, suffix = (VECTOR, f"v{EIGHT}f64") if of_vectors else (DOUBLE, "f64")
            function = declared(builder, f"llvm.{name}.{suffix}", ir.FunctionType(numbers, [numbers] * count))
            return builder.call(function, sides)

        return kind(*(vector if each == vector else types.float64 for each in kinds)), generate

    return typed


@intrinsic
def fma(_context: Any, a: Any, b: Any, c: Any) -> Any:
    """a·b + c, rounded once, on every processor."""
    return _elementwise("fma", 3)(a, b, c)


@intrinsic
def magnitude(_context: Any, a: Any) -> Any:
    """|a|."""
    return _elementwise("fabs", 1)(a)


@intrinsic
def maximum(_context: Any, a: Any, b: Any) -> Any:
    """The larger of two; the other where one is not a number."""
    return _elementwise("maxnum", 2)(a, b)


@intrinsic
def square_root(_context: Any, a: Any) -> Any:
    """√a."""
    return _elementwise("sqrt", 1)(a)


@intrinsic
def in_quadrant(_context: Any, rounded: Any, _sine: Any, _cosine: Any) -> Any:
    """Sine and cosine of an angle from those of what is left of it within its quadrant.

    The quadrant stands in the lowest two bits of ``rounded``. For numbers and for vectors of eight.
    """
    kind = vector if rounded == vector else types.float64

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return context.make_tuple(builder, signature.return_type, in_quadrants(builder, *args))

    return types.UniTuple(kind, 2)(kind, kind, kind), generate


def _row(context: Any, builder: Any, kind: Any, row: Any, index: Any) -> Any:
    """Where a row's number stands, or its eight numbers."""
    data = context.make_array(kind)(context, builder, row).data
    if kind.ndim == 1:
        return builder.gep(data, [index])
    return builder.bitcast(builder.gep(data, [builder.mul(index, INTEGER(EIGHT))]), VECTOR.as_pointer())


@intrinsic
def load(_context: Any, row: Any, _index: Any) -> Any:
    """``row[index]`` of a contiguous row: a number, or of a row of shape (…, 8) a vector. No bounds are checked."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.load(_row(context, builder, signature.args[0], *args), align=8)

    return (types.float64 if row.ndim == 1 else vector)(row, types.int64), generate


@intrinsic
def store(_context: Any, row: Any, _index: Any, _value: Any) -> Any:
    """``row[index] = value`` of such a row; a number goes to all eight places."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        kind, value = signature.args[0], args[2]
        if kind.ndim == 2 and signature.args[2] != vector:
            value = spread(builder, value)
        builder.store(value, _row(context, builder, kind, *args[:2]), align=8)
        return context.get_dummy_value()

    return types.void(row, types.int64, vector if _value == vector else types.float64), generate
