"""Formulas that are written for numbers, written down as instructions for several states at once. Needs llvmlite.

A *piece* is a function ``piece(memory, numbers, *places)`` without a branch: it reads from ``memory`` what belongs to
a state, from ``numbers`` what all states share, and writes to ``memory``. Called once with the stand-ins for numbers
that are here, whose operators write LLVM's instructions on vectors, one state a lane, it becomes compiled code; called
with numpy's arrays (:mod:`.plain`), it computes. So there is one text of the formulas.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from llvmlite import ir

from ..instructions import FAST, declared, in_quadrants
from ..sine import HALF_PI, HALF_PI_LOW, ROUNDER, TWO_OVER_PI, polynomials

DOUBLE, INDEX, WORD = ir.DoubleType(), ir.IntType(64), ir.IntType(32)
BYTES = 8  # of a number


class Lane:
    """A number in each lane, while code is written: what is done with it becomes an instruction."""

    def __init__(self, builder: Any, value: Any) -> None:
        self.builder, self.value = builder, value

    def _of(self, other: Any) -> Any:
        return other.value if isinstance(other, Lane) else constant(self.value.type, other)

    def _new(self, instruction: str, left: Any, right: Any) -> Lane:
        return Lane(self.builder, getattr(self.builder, instruction)(left, right, flags=FAST))

    def __add__(self, other: Any) -> Lane:
        return self._new("fadd", self.value, self._of(other))

    def __sub__(self, other: Any) -> Lane:
        return self._new("fsub", self.value, self._of(other))

    def __rsub__(self, other: Any) -> Lane:
        return self._new("fsub", self._of(other), self.value)

    def __mul__(self, other: Any) -> Lane:
        return self._new("fmul", self.value, self._of(other))

    def __rtruediv__(self, other: Any) -> Lane:
        return self._new("fdiv", self._of(other), self.value)

    def __neg__(self) -> Lane:
        return Lane(self.builder, self.builder.fneg(self.value))

    __radd__, __rmul__ = __add__, __mul__


def constant(vector: Any, number: float) -> Any:
    """The same number in all lanes."""
    return ir.Constant(vector, [float(number)] * vector.count)


class Memory:
    """What belongs to states: vectors of ``lanes`` numbers, of which a place counts whole ones."""

    def __init__(self, builder: Any, data: Any, lanes: int) -> None:
        self._builder, self.vector = builder, ir.VectorType(DOUBLE, lanes)
        self._data = builder.bitcast(data, self.vector.as_pointer())
        self._align = BYTES * lanes
        self._written: dict[tuple[Any, int], Lane] = {}  # by place and what is added to it

    def read(self, place: Any, first: int, count: int) -> list[Any]:
        """``count`` numbers from ``place + first`` on, as they are before the piece or as it has written them."""
        return [self._written.get((place, first + i)) or self._load(place, first + i) for i in range(count)]

    def write(self, place: Any, first: int, values: Sequence[Any]) -> None:
        """The numbers from ``place + first`` on, when the piece is at its end.

        A number that is written earlier would have all later ones be read before it, lest they be the same, and stand
        on the stack meanwhile.
        """
        for i, value in enumerate(values):
            found = value if isinstance(value, Lane) else Lane(self._builder, constant(self.vector, value))
            self._written[place, first + i] = found

    def finish(self) -> None:
        """Store what was written."""
        for (place, offset), value in self._written.items():
            self._builder.store(value.value, self.at(place, offset), align=self._align)

    def _load(self, place: Any, offset: int) -> Lane:
        return Lane(self._builder, self._builder.load(self.at(place, offset), align=self._align))

    def at(self, place: Any, offset: int = 0) -> Any:
        """Where the numbers stand."""
        return self._builder.gep(self._data, [self._builder.add(place, INDEX(offset))])

    def sincos(self, angle: Lane) -> tuple[Lane, Lane]:
        """Sine and cosine [rad], as :func:`..sincos.sincos` has them."""
        rounded = self._fused(angle, TWO_OVER_PI, ROUNDER)
        k = rounded - ROUNDER
        left = self._fused(-k, HALF_PI_LOW, self._fused(-k, HALF_PI, angle))
        found = in_quadrants(self._builder, rounded.value, *(part.value for part in polynomials(left)))
        return Lane(self._builder, found[0]), Lane(self._builder, found[1])

    def _fused(self, *factors: Any) -> Lane:
        """a b + c, rounded once, on every processor."""
        kind = ir.FunctionType(self.vector, [self.vector] * 3)
        function = declared(self._builder, f"llvm.fma.v{self.vector.count}f64", kind)
        given = [f.value if isinstance(f, Lane) else constant(self.vector, f) for f in factors]
        return Lane(self._builder, self._builder.call(function, given))

    def larger_size(self, a: Lane, b: Lane) -> Lane:
        """The larger of |a| and b."""
        kind = ir.FunctionType(self.vector, [self.vector])
        function = declared(self._builder, f"llvm.fabs.v{self.vector.count}f64", kind)
        return self.larger(Lane(self._builder, self._builder.call(function, [a.value])), b)

    def larger(self, a: Lane, b: Lane) -> Lane:
        """The larger of two."""
        above = self._builder.fcmp_ordered(">", a.value, b.value)
        return Lane(self._builder, self._builder.select(above, a.value, b.value))


class Numbers:
    """Numbers that all states share."""

    def __init__(self, builder: Any, data: Any, lanes: int) -> None:
        self._builder, self._data, self._vector = builder, data, ir.VectorType(DOUBLE, lanes)

    def read(self, place: Any, first: int, count: int) -> list[Lane]:
        """``count`` numbers from ``place + first`` on."""
        return [self._spread(place, first + i) for i in range(count)]

    def _spread(self, place: Any, offset: int) -> Lane:
        builder, lanes = self._builder, self._vector.count
        number = builder.load(builder.gep(self._data, [builder.add(place, INDEX(offset))]))
        alone = builder.insert_element(ir.Constant(self._vector, ir.Undefined), number, WORD(0))
        picks = ir.Constant(ir.VectorType(WORD, lanes), [0] * lanes)
        return Lane(builder, builder.shuffle_vector(alone, alone, picks))
