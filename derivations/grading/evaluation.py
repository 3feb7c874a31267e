"""Turns the tree of an expression into an exact formula. Only arithmetic: nothing of the text is ever run."""

from __future__ import annotations

from collections.abc import Mapping

from flint import fmpq

from ..algebra.quotient import Budget, Quotient, number
from ..algebra.symbols import Symbols
from ..algebra.trig import COS, SIN, Formula
from .parser import Call, Name, Node, Number, Power, Product, Sum, Symbol
from .tokens import fail

LARGEST_ANGLE_FACTOR = 16  # cos(16 θ) at most: harmonics stay small, and nobody writes more
QUARTER = fmpq(1, 2)  # a quarter turn is π/2

WORDS = {"t": "angle", "w": "rate", "a": "acceleration", "l": "length", "m": "mass", "I": "inertia"}


class Evaluation:
    """Evaluates the lines of one file, for one mechanism, within one budget."""

    def __init__(self, symbols: Symbols) -> None:
        self.symbols = symbols
        self.space = symbols.space
        self.budget = Budget()
        self.definitions: dict[str, Node] = {}
        self._values: dict[str, Quotient] = {}
        self._angles: dict[str, _Angle] = {}
        self.equal_lengths = self.equal_masses = False

    def value(self, node: Node) -> Quotient:  # noqa: PLR0911 -- one for each kind of node
        """The formula of a tree. Raises InvalidInput, with the column, where it has no meaning."""
        match node:
            case Number(value=value):
                return number(value)
            case Symbol():
                return self._symbol(node)
            case Name(text=text):
                if text not in self._values:
                    self._values[text] = self.value(self.definitions[text])
                return self._values[text]
            case Sum(parts=parts):
                total = number(0)
                for sign, part in parts:
                    value = self.value(part)
                    self.budget.at = part.at
                    total = total.plus(value, sign, self.budget)
                return total
            case Product(parts=parts):
                product = number(1)
                for above, part in parts:
                    factor = self._factor(part, above)
                    self.budget.at = part.at
                    product = product.times(factor, self.budget)
                return product
            case Power(base=base, exponent=exponent, at=at):
                value = self.value(base)
                if exponent < 0 and not value.numerator:
                    fail(at, "zero to a negative power")
                self.budget.at = at
                return value.power(exponent, self.budget)
            case Call():
                return self._call(node)

    def _factor(self, node: Node, above: bool) -> Quotient:
        value = self.value(node)
        if above:
            return value
        if not value.numerator:
            fail(node.at, "a division by zero")
        return value.inverse()

    def _symbol(self, node: Symbol) -> Quotient:
        letter, index, space = node.letter, node.index, self.space
        if letter == "t":
            fail(node.at, "an angle outside cos and sin; the exact equations have angles only inside")
        if letter == "p":
            fail(node.at, "π outside cos and sin; an equation of motion has none")
        if letter == "g":
            return Quotient(space.g, {}, 1)
        if letter == "r":
            if self.symbols.kind != "rod-chain":
                fail(node.at, "rho is the line density of a rod chain; an n-leg pendulum has masses m1, m2, …")
            return Quotient(space.rho, {}, 1)
        if index > space.n:
            fail(node.at, f"{WORDS[letter]} number {index}, but links = {space.n}; write * for a product with a number")
        if index == 0:
            return self._without_index(node)
        place = index - 1
        if letter == "I":
            if self.symbols.kind != "rod-chain":
                fail(node.at, "I is the inertia of a rod; the point masses of an n-leg pendulum have none")
            return Quotient(self.symbols.inertia(place), {}, 4)
        symbol = {"w": space.w, "a": space.a, "l": space.l, "m": self.symbols.mass}[letter]
        return Quotient(symbol(place), {}, 2)

    def _without_index(self, node: Symbol) -> Quotient:
        if node.letter == "l":
            self.equal_lengths = True
            return Quotient(self.space.l(0), {}, 1)
        if node.letter == "m":
            self.equal_masses = True
            self.equal_lengths = self.equal_lengths or self.symbols.kind == "rod-chain"
            return Quotient(self.symbols.mass(0), {}, 2)
        if self.space.n == 1:
            return self._symbol(Symbol(node.letter, 1, node.at))
        return fail(node.at, f"this {WORDS[node.letter]} has no index; which of the {self.space.n} links is it?")

    def _call(self, node: Call) -> Quotient:
        angle = self.angle(node.argument)
        size = 1 + sum(abs(h) for h in angle.halves.values()) // 2
        if node.function == "tan":
            cosine = self._wave(angle, COS)
            if not cosine:
                fail(node.at, "the tangent of a right angle")
            tangent = Quotient(self._wave(angle, SIN), {}, size)
            return tangent.times(Quotient(cosine, {}, size).inverse(), self.budget)
        return Quotient(self._wave(angle, SIN if node.function == "sin" else COS), {}, size)

    def _wave(self, angle: _Angle, phase: int) -> Formula:
        """cos or sin of an angle and some quarter turns: cos(x + π/2) = -sin x, sin(x + π/2) = cos x."""
        sign = 1
        for _ in range(angle.quarters % 4):
            if phase == COS:
                phase, sign = SIN, -sign
            else:
                phase = COS
        wave = self.space.wave(angle.halves, phase)
        return wave if sign > 0 else -wave

    def angle(self, node: Node) -> _Angle:
        """The argument of cos or sin: whole or half multiples of angles, and quarter turns."""
        linear = self._linear(node)
        halves: dict[int, int] = {}
        for k, factor in linear.items():
            if k == PI:
                continue
            half = factor * 2
            if half.q != 1 or abs(half) > 2 * LARGEST_ANGLE_FACTOR:
                fail(
                    node.at, f"θ{k + 1} times {factor}: angles are taken in halves, up to {LARGEST_ANGLE_FACTOR} times"
                )
            halves[k] = int(half.p)
        quarters = linear.get(PI, fmpq(0)) / QUARTER
        if quarters.q != 1:
            fail(node.at, "only multiples of π/2 can be added to an angle")
        return _Angle(halves, int(quarters.p) % 4)

    def _linear(self, node: Node) -> dict[int, fmpq]:  # noqa: PLR0911 -- one for each kind of node
        """A linear form in the angles, and in π."""
        match node:
            case Symbol(letter="p"):
                return {PI: fmpq(1)}
            case Symbol(letter="t", index=index, at=at):
                if index == 0 and self.space.n > 1:
                    fail(at, f"this angle has no index; which of the {self.space.n} links is it?")
                if index > self.space.n:
                    fail(at, f"angle number {index}, but links = {self.space.n}")
                return {max(index, 1) - 1: fmpq(1)}
            case Sum(parts=parts):
                total: dict[int, fmpq] = {}
                for sign, part in parts:
                    for k, c in self._linear(part).items():
                        total[k] = total.get(k, fmpq(0)) + sign * c
                return total
            case Product(parts=parts):
                return self._scaled(node, parts)
            case Name(text=text):
                if text not in self._angles:
                    self._angles[text] = self.angle(self.definitions[text])
                named = self._angles[text]
                return {PI: named.quarters * QUARTER} | {k: fmpq(h, 2) for k, h in named.halves.items()}
            case Number(value=value) if not value:
                return {}
        return fail(node.at, "inside cos and sin, a sum or difference of angles is expected, as in cos(t1 - t2)")

    def _scaled(self, node: Product, parts: tuple[tuple[bool, Node], ...]) -> dict[int, fmpq]:
        factor, form = fmpq(1), None
        for above, part in parts:
            value = _rational(part)
            if value is None:
                if form is not None or not above:
                    fail(node.at, "inside cos and sin an angle can only be multiplied by a number")
                form = self._linear(part)
            elif above:
                factor *= value
            elif value:
                factor /= value
            else:
                fail(part.at, "a division by zero")
        if form is None:
            fail(node.at, "inside cos and sin an angle is needed, as in cos(t1 - t2)")
        return {k: c * factor for k, c in form.items()}


PI = -1  # where a linear form keeps its multiple of π


class _Angle:
    """Σ halves[k]·θ_k/2 + quarters·π/2."""

    def __init__(self, halves: Mapping[int, int], quarters: int) -> None:
        self.halves = halves
        self.quarters = quarters


def _rational(node: Node) -> fmpq | None:
    match node:
        case Number(value=value):
            return value
        case Sum(parts=((-1, Number(value=value)),)):
            return -value
        case Product(parts=((True, Number(value=top)), (False, Number(value=bottom)))) if bottom:
            return top / bottom
    return None
