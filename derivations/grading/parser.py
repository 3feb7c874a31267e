"""Reads the tokens of a line into a tree: sums, products, powers, calls of cos, sin and tan. Nothing is evaluated.

equation  = sum "=" sum
sum       = ["+"|"-"] product { ("+"|"-") product }
product   = factor { ["*"|"/"] factor }              side by side is a product; / takes one factor, as in Python
factor    = ("+"|"-") factor | primary [ "^" whole number ]
primary   = number | symbol | "(" sum ")" | call | "\\frac" group group
call      = ("cos"|"sin"|"tan") [ "^" whole number ] ( "(" sum ")" | [number] symbol )
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import fmpq

from .tokens import CLOSING, OPENING, Token, fail, tokenize

DEEPEST = 60  # brackets within brackets
LARGEST_POWER = 12


@dataclass(frozen=True)
class Number:
    """A rational number."""

    value: fmpq
    at: int


@dataclass(frozen=True)
class Symbol:
    """A symbol: its letter and its index, from 1, or 0 where it has none."""

    letter: str
    index: int
    at: int


@dataclass(frozen=True)
class Sum:
    """A sum of signed parts."""

    parts: tuple[tuple[int, Node], ...]
    at: int


@dataclass(frozen=True)
class Product:
    """A product; a part with False is divided by."""

    parts: tuple[tuple[bool, Node], ...]
    at: int


@dataclass(frozen=True)
class Power:
    """A whole power, of either sign."""

    base: Node
    exponent: int
    at: int


@dataclass(frozen=True)
class Call:
    """cos, sin or tan of an angle, to a power."""

    function: str
    argument: Node
    at: int


@dataclass(frozen=True)
class Name:
    """A name that the file itself defines."""

    text: str
    at: int


Node = Number | Symbol | Sum | Product | Power | Call | Name


def parse_expression(line: str, names: frozenset[str] = frozenset()) -> Node:
    """The tree of an expression without an equals sign. ``names`` are the file's own definitions."""
    parser = _Parser(line, names)
    node = parser.sum(0)
    parser.expect_end("an equals sign is not expected here" if parser.next.text == "=" else "")
    return node


def parse_equation(line: str, names: frozenset[str] = frozenset()) -> tuple[Node, Node]:
    """The trees of both sides of an equation."""
    parser = _Parser(line, names)
    left = parser.sum(0)
    if parser.next.text != "=":
        if parser.next.kind == "end":
            fail(parser.next.at, "an equation needs an equals sign; put '= 0' behind it")
        parser.expect_end("")
    parser.advance()
    right = parser.sum(0)
    parser.expect_end("a second equals sign; one equation a row" if parser.next.text == "=" else "")
    return left, right


class _Parser:
    def __init__(self, line: str, names: frozenset[str]) -> None:
        self.tokens = tokenize(line, names)
        self.place = 0

    @property
    def next(self) -> Token:
        return self.tokens[self.place]

    def advance(self) -> Token:
        token = self.tokens[self.place]
        self.place += 1
        return token

    def sees_times(self) -> bool:
        """Whether a sign of multiplication comes next."""
        return self.next.kind == "operator" and self.next.text == "*"

    def expect_end(self, why: str) -> None:
        token = self.next
        if token.kind != "end":
            if not why:
                why = (
                    "this closing bracket was never opened"
                    if token.kind == "close"
                    else f"{token.text!r} is not expected here"
                )
            fail(token.at, why)

    def sum(self, depth: int) -> Node:
        at = self.next.at
        if depth > DEEPEST:
            fail(at, f"more than {DEEPEST} brackets within one another")
        parts: list[tuple[int, Node]] = []
        sign = 1
        while True:
            parts.append((sign, self.product(depth)))
            if self.next.kind != "operator" or self.next.text not in ("+", "-"):
                break
            sign = 1 if self.advance().text == "+" else -1
        return parts[0][1] if len(parts) == 1 else Sum(tuple(parts), at)

    def product(self, depth: int) -> Node:
        at = self.next.at
        parts: list[tuple[bool, Node]] = [(True, self.factor(depth))]
        while True:
            token = self.next
            if token.kind == "operator" and token.text in ("*", "/"):
                self.advance()
                parts.append((token.text == "*", self.factor(depth)))
            elif token.kind in ("symbol", "function", "open", "fraction", "number", "name"):
                if token.kind == "number" and isinstance(parts[-1][1], Number):
                    fail(token.at, "two numbers side by side; write * between them")
                parts.append((True, self.factor(depth)))
            else:
                break
        return parts[0][1] if len(parts) == 1 else Product(tuple(parts), at)

    def factor(self, depth: int) -> Node:
        at, sign = self.next.at, 1
        while self.next.kind == "operator" and self.next.text in ("+", "-"):
            sign = sign if self.advance().text == "+" else -sign
        node = self.powered(self.primary(depth))
        return node if sign > 0 else Sum(((-1, node),), at)

    def powered(self, base: Node) -> Node:
        token = self.next
        if token.kind != "operator" or not token.text.startswith("^"):
            return base
        self.advance()
        node = Power(base, self.exponent(token), token.at)
        if self.next.kind == "operator" and self.next.text.startswith("^"):
            fail(self.next.at, "a power of a power; put brackets around the first")
        return node

    def exponent(self, token: Token) -> int:
        """The whole number behind a ``^`` (or the superscript that it was)."""
        if len(token.text) > 1:
            return _bounded(int(token.text[1:]) if len(token.text) < 6 else LARGEST_POWER + 1, token.at)
        opened = self.advance() if self.next.kind == "open" else None
        sign = 1
        if self.next.kind == "operator" and self.next.text in ("+", "-"):
            sign = -1 if self.advance().text == "-" else 1
        figure = self.next
        if figure.kind != "number":
            fail(figure.at, "a power must be a whole number")
        self.advance()
        if opened is not None:
            self.close(opened)
        if figure.value.q != 1:
            fail(figure.at, f"the power {figure.text} is not a whole number")
        return _bounded(sign * int(min(figure.value.p, LARGEST_POWER + 1)), figure.at)

    def close(self, opened: Token) -> None:
        token = self.next
        if token.kind != "close" or token.text != OPENING[opened.text]:
            found = "the line ends" if token.kind == "end" else f"found {token.text!r}"
            fail(
                token.at,
                f"{OPENING[opened.text]!r} is missing for the {opened.text!r} of column {opened.at + 1}; {found}",
            )
        self.advance()

    def group(self, depth: int) -> Node:
        opened = self.advance()
        if self.next.kind == "close" and self.next.text in CLOSING:
            fail(self.next.at, "nothing between the brackets")
        node = self.sum(depth + 1)
        self.close(opened)
        return node

    def primary(self, depth: int) -> Node:  # noqa: PLR0911 -- one for each kind of token
        token = self.next
        match token.kind:
            case "number":
                self.advance()
                return Number(token.value, token.at)
            case "symbol":
                self.advance()
                return Symbol(token.text, token.index, token.at)
            case "name":
                self.advance()
                return Name(token.text, token.at)
            case "open":
                return self.group(depth)
            case "function":
                return self.call(depth)
            case "fraction":
                return self.fraction(depth)
            case "close":
                return fail(token.at, "this closing bracket was never opened, or something is missing before it")
            case "end":
                return fail(token.at, "the line ends where a term is expected")
            case _:
                return fail(token.at, f"a term is expected before {token.text!r}")

    def call(self, depth: int) -> Node:
        function = self.advance()
        exponent = 1
        if self.next.kind == "operator" and self.next.text.startswith("^"):
            exponent = self.exponent(self.advance())
            if exponent < 0:
                fail(function.at, f"{function.text} to a negative power is ambiguous; write 1/{function.text}(…)")
        node: Node = Call(function.text, self.argument(function, depth), function.at)
        return node if exponent == 1 else Power(node, exponent, function.at)

    def argument(self, function: Token, depth: int) -> Node:
        if self.next.kind == "open":
            return self.group(depth)
        if depth >= DEEPEST:
            fail(self.next.at, f"more than {DEEPEST} brackets within one another")
        parts: list[tuple[bool, Node]] = []
        if self.next.kind == "number":
            token = self.advance()
            parts.append((True, Number(token.value, token.at)))
            if self.sees_times():
                self.advance()
        if self.next.kind == "fraction" and not parts:
            return self.fraction(depth)
        if self.next.kind not in ("symbol", "name"):
            fail(self.next.at, f"{function.text} needs an angle, as in {function.text}(t1)")
        parts.append((True, self.primary(depth)))
        return parts[0][1] if len(parts) == 1 else Product(tuple(parts), function.at)

    def fraction(self, depth: int) -> Node:
        token = self.advance()
        top, bottom = self.fraction_part(token, depth), self.fraction_part(token, depth)
        return Product(((True, top), (False, bottom)), token.at)

    def fraction_part(self, fraction: Token, depth: int) -> Node:
        if self.next.kind == "open" and self.next.text == "{":
            return self.group(depth)
        if self.next.kind == "number" and len(self.next.text) == 2 and self.next.text.isdigit():
            # \frac12: each digit is a part of its own
            token = self.next
            self.tokens[self.place] = Token("number", token.text[1], token.at + 1, value=fmpq(int(token.text[1])))
            return Number(fmpq(int(token.text[0])), token.at)
        if self.next.kind in ("number", "symbol"):
            return self.primary(depth)
        return fail(self.next.at, f"{fraction.text} needs two parts in braces: {fraction.text}{{…}}{{…}}")


def _bounded(exponent: int, at: int) -> int:
    if abs(exponent) > LARGEST_POWER:
        fail(at, f"a power beyond ±{LARGEST_POWER}; no equation of motion has one")
    return exponent
