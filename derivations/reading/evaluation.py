"""Turns the tree of an expression into exact formulas. Only arithmetic: nothing of the text is ever run."""

from __future__ import annotations

from collections.abc import Mapping

from flint import fmpq

from ..algebra.quotient import Budget, Quotient, number
from ..algebra.signs import sign_of
from ..algebra.trig import CONSTANT_ONE, COS, SIN, Formula, unit
from .matrices import Grid, added, determinant, inverse, multiplied, scaled
from .meaning import WORDS, Meaning
from .nodes import Call, Determinant, Inverse, Matrix, Name, Node, Number, Power, Product, Rate, Root, Sum, Symbol
from .tokens import fail

LARGEST_ANGLE_FACTOR = 16  # cos(16 θ) at most: harmonics stay small, and nobody writes more
QUARTER = fmpq(1, 2)  # a quarter turn is π/2
Value = Quotient | Grid
# What is divided by what: the tangent, and the reciprocals
RATIOS: dict[str, tuple[int | None, int]] = {
    "tan": (SIN, COS),
    "cot": (COS, SIN),
    "sec": (None, COS),
    "csc": (None, SIN),
}
NAMES_OF_RATIOS = {"tan": "tangent", "cot": "cotangent", "sec": "secant", "csc": "cosecant"}


class Evaluation:
    """Evaluates the lines of one file, with one meaning of its symbols, within one budget."""

    def __init__(self, meaning: Meaning) -> None:
        self.meaning = meaning
        self.space = meaning.space
        self.budget = Budget()
        self.definitions: dict[str, Node] = {}
        self._values: dict[str, Value] = {}
        self._angles: dict[str, _Angle] = {}

    def scalar(self, node: Node) -> Quotient:
        """The formula of a tree. Raises InvalidInput, with the column, where it has no meaning or is a matrix."""
        value = self.value(node)
        if not isinstance(value, Quotient):
            fail(
                node.at, f"a matrix of {value.height} rows and {value.width} columns stands where a number is expected"
            )
        return value

    def weight(self, node: Node) -> Formula:
        """What g is said to be: 0, 9.81 or ω_0². Raises InvalidInput where that needs g, or is a quotient of sums."""
        value, space = self.scalar(node), self.meaning.space
        if value.denominator or 4 * space.n in space.places(value.numerator):
            fail(node.at, 'a number, or a product of quantities as in "w0^2", is needed; say what other letters are by '
                          'g, as in [define] k = "g/l"')  # fmt: skip
        return value.numerator

    def value(self, node: Node) -> Value:  # noqa: PLR0911, PLR0912 -- one for each kind of node
        """The formula or the matrix of a tree. Raises InvalidInput, with the column, where it has no meaning."""
        match node:
            case Number(value=value):
                return number(value)
            case Symbol():
                return self._symbol(node)
            case Name(text=text):
                return self._name(text, node.at)
            case Sum(parts=parts):
                total: Value | None = None
                for sign, part in parts:
                    value = self.value(part)
                    self.budget.at = part.at
                    total = self._signed(value, sign) if total is None else added(total, value, sign, self.budget)
                return number(0) if total is None else total
            case Product(parts=parts):
                product: Value | None = None
                for above, part in parts:
                    vector = self.column(part) if above and isinstance(product, Grid) else None
                    factor = self._factor(part, above) if vector is None else vector
                    self.budget.at = part.at
                    product = factor if product is None else multiplied(product, factor, self.budget)
                return number(1) if product is None else product
            case Power(base=base, exponent=exponent, at=at):
                return self._power(base, exponent, at)
            case Call():
                return self._call(node)
            case Matrix(rows=rows):
                return Grid(tuple(tuple(self.scalar(entry) for entry in row) for row in rows))
            case Inverse(base=base, at=at, left=left):
                if left and not isinstance(self.value(base), Grid):
                    fail(at, "a backslash behind what is no matrix: does the line go on? Then leave it out; what is "
                             "divided is a column, as in M\\b")  # fmt: skip
                return self._power(base, -1, at)
            case Determinant(base=base, at=at):
                return self._determinant(base, at)
            case Rate():
                return self._rate(node)
            case Root(at=at):
                return fail(at, "a square root; it is read where it is squared, as in w0^2 with w0 = sqrt(g/l)")

    def column(self, node: Node) -> Grid | None:
        """All rates, or all accelerations, of a symbol without an index; None where it is none."""
        n = self.space.n
        if not isinstance(node, Symbol) or node.index or node.letter not in "wa" or n < 2:
            return None
        return Grid(tuple((self.meaning.symbol(node.letter, k, node.at),) for k in range(1, n + 1)))

    def _signed(self, value: Value, sign: int) -> Value:
        return value if sign > 0 else scaled(value, number(-1), self.budget)

    def _name(self, text: str, at: int) -> Value:
        if text in self.definitions:
            if text not in self._values:
                self._values[text] = self.value(self.definitions[text])
            return self._values[text]
        return self.meaning.own(text, at)

    def _determinant(self, base: Node, at: int) -> Quotient:
        value = self.value(base)
        self.budget.at = at
        if isinstance(value, Quotient):
            fail(at, "the determinant of a number; of a matrix it is read, as in det(M)")
        return determinant(value, self.budget)

    def _rate(self, node: Rate) -> Value:
        """The time derivative; of a matrix, entry by entry."""
        if isinstance(node.base, Name) and node.base.text not in self.definitions:
            fail(node.at, f"a dot or a prime on {node.base.text}, which is no coordinate; say what it is in [define]")
        value = self.value(node.base)
        self.budget.at = node.at
        if isinstance(value, Grid):
            return Grid(tuple(tuple(self._by_time(x, node.at) for x in row) for row in value.rows))
        found = self._by_time(value, node.at)
        if isinstance(node.base, Name) and not found.numerator:
            fail(node.at, f"{node.base.text} does not change with time; give what the prime means a name of its own")
        return found

    def _by_time(self, value: Quotient, at: int) -> Quotient:
        """By the quotient rule, a factor of the denominator at a time."""
        space, budget, degree = self.space, self.budget, value.degree
        for part in (value.numerator, *value.denominator):
            places = space.places(part)
            if any(k < space.n for k in places):
                fail(at, "a third time derivative; an equation of motion has none")
            if any(space.names[k] in self.meaning.momenta for k in places):
                fail(at, "d/dt of an expression with momenta; write it in coordinates and rates")
            budget.left -= 2 * space.n * len(part)
        over = Quotient(CONSTANT_ONE, value.denominator, degree)
        found = Quotient(space.by_time(value.numerator), {}, degree + 2).times(over, budget)
        for factor, power in value.denominator.items():
            inner = Quotient(budget.product(value.numerator, space.by_time(factor).times(power)), {}, 2 * degree + 2)
            below = Quotient(CONSTANT_ONE, {factor: 1}, degree)
            found = found.plus(inner.times(over, budget).times(below, budget), -1, budget)
        return found

    def _power(self, base: Node, exponent: int, at: int) -> Value:
        root = self.definitions.get(base.text) if isinstance(base, Name) else base
        if isinstance(root, Root) and exponent % 2 == 0:
            return self._power(root.base, exponent // 2, at)
        value = self.value(base)
        self.budget.at = at
        if isinstance(value, Grid):
            if exponent != -1:
                fail(at, "of a matrix only the inverse, to the power -1, is read")
            return inverse(value, self.budget)
        if exponent < 0 and not value.numerator:
            fail(at, "zero to a negative power")
        return value.power(exponent, self.budget)

    def _factor(self, node: Node, above: bool) -> Value:
        if above:
            return self.value(node)
        value = self.scalar(node)
        if not value.numerator:
            fail(node.at, "a division by zero: this is 0 whatever the angles and numbers are")
        return value.inverse()

    def _symbol(self, node: Symbol) -> Quotient:
        found = self.meaning.symbol(node.letter, node.index, node.at)
        if node.less:
            if node.letter not in "wa":
                fail(node.at, f"two indices on one {WORDS.get(node.letter, 'symbol')}")
            found = found.plus(self.meaning.symbol(node.letter, node.less, node.at), -1, self.budget)
        return found

    def _call(self, node: Call) -> Quotient:
        if node.function in ("sgn", "abs"):
            return self._sign(node)
        angle = self.angle(node.argument)
        size = 1 + sum(abs(h) for h in angle.halves.values()) // 2
        if node.function in RATIOS:
            above, below = RATIOS[node.function]
            bottom = self._wave(angle, below)
            if not bottom:
                fail(node.at, f"the {NAMES_OF_RATIOS[node.function]} of an angle that has none")
            ratio = Quotient(bottom, {}, size).inverse()
            return ratio if above is None else Quotient(self._wave(angle, above), {}, size).times(ratio, self.budget)
        return Quotient(self._wave(angle, SIN if node.function == "sin" else COS), {}, size)

    def _sign(self, node: Call) -> Quotient:
        """sgn or |…| of a rate, or of the sum or difference of two, times a number."""
        value, space = self.scalar(node.argument), self.space
        if self.meaning.kind != "mechanism" or not space.first_sign:
            fail(node.at, "the sign of a rate, as dry friction has it, is read where the mechanism is declared body by "
                          'body, with friction = "F"')  # fmt: skip
        places = {unit(space.n + k): k for k in range(space.n)}
        form = {places[e]: c for (e, h, _), c in value.numerator.terms.items() if e in places and not h}
        size = abs(next(iter(form.values()), fmpq(1)))
        whole = {k: int((c / size).p) for k, c in form.items() if abs(c) == size}
        sign = sign_of(space, whole) if len(whole) == len(value.numerator.terms) and not value.denominator else None
        if sign is None:
            fail(node.at, "only the sign of a rate, or of the sum or difference of two, is read, as in sgn(x') or "
                          "sgn(theta2' - theta1')")  # fmt: skip
        found = Quotient(sign, {}, 1)
        return found if node.function == "sgn" else found.times(value, self.budget)

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
            case Symbol(letter="t", index=index, at=at, less=less):
                form = {self.meaning.angle(index, at): fmpq(1)}
                if less:
                    form[self.meaning.angle(less, at)] = fmpq(-1)
                return form
            case Sum(parts=parts):
                total: dict[int, fmpq] = {}
                for sign, part in parts:
                    for k, c in self._linear(part).items():
                        total[k] = total.get(k, fmpq(0)) + sign * c
                return total
            case Product(parts=parts):
                return self._scaled(node, parts)
            case Name(text=text):
                if text not in self.definitions:
                    fail(node.at, f"{text} is no angle; inside cos and sin, a sum or difference of angles is expected")
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
                other = self._linear(part) if above else {}
                if form is not None and PI in {**form, **other}:
                    fail(node.at, "an angle times π: degrees? Angles are in radians here, as in sin(t1)")
                if form is not None or not above:
                    fail(node.at, "inside cos and sin an angle can only be multiplied by a number")
                form = other
            elif above:
                factor *= value
            elif value:
                factor /= value
            else:
                fail(part.at, "a division by zero: this is 0 whatever the angles and numbers are")
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
