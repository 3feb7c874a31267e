"""What names of a program stand for while it is followed: formulas as text, arrays of these, and what is not known."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field

from ....models.errors import InvalidInput

LONGEST_FORMULA = 6000  # characters
LARGEST = 64  # entries of an array
WHOLE = re.compile(r"-?[0-9]{1,6}")
ATOM = re.compile(r"[\w.']+|«[^«»]+»")
SUM, PRODUCT, FACTOR = 2, 1, 0


class NotFollowed(InvalidInput):
    """A statement or an expression that is not followed, with what to write."""


class Doubtful(NotFollowed):
    """What may be meant in two ways: no other part of the program is looked at."""


@dataclass(frozen=True)
class Formula:
    """``level``: SUM, PRODUCT (without divisions) or FACTOR."""

    text: str
    level: int = FACTOR

    def within(self, level: int) -> str:
        """In brackets where it binds less than this."""
        return self.text if self.level <= level else f"({self.text})"

    @property
    def whole(self) -> int | None:
        """The whole number that it is."""
        return int(self.text) if WHOLE.fullmatch(self.text) else None


@dataclass(frozen=True)
class Outside:
    """A quantity that comes from outside: a parameter, a field of it, an entry of it by its number from 0."""

    path: tuple[str | int, ...]

    @property
    def mark(self) -> str:
        """What stands for it until all is followed."""
        return "«" + "|".join(map(str, self.path)) + "»"


@dataclass(eq=False)
class Array:
    """``shape``: one or two sizes; ``kind``: "matrix" multiplies as one by *, a "loose" vector is row or column."""

    entries: list[Formula]
    shape: tuple[int, ...]
    kind: str = "array"
    is_state: bool = False  # as long as the state, with an axis for many of them

    @property
    def is_vector(self) -> bool:
        """Whether it has one row or one column."""
        return len(self.shape) == 1 or 1 in self.shape

    @property
    def rows(self) -> list[list[Formula]]:
        """Its entries by rows; of a vector of one size, one row."""
        width = self.shape[-1]
        return [self.entries[k : k + width] for k in range(0, len(self.entries), width)] if width else []

    def copied(self) -> Array:
        """Another one with the same entries."""
        return Array(list(self.entries), self.shape, self.kind, self.is_state)


@dataclass(eq=False)
class Several:
    """A list or tuple of values, not all of them numbers."""

    items: list[Value]


@dataclass(eq=False)
class Local:
    """A function of the text. ``given``: the names around it."""

    parameters: tuple[str, ...]
    of: object  # nodes.Define or nodes.Nameless
    given: dict[str, Value] = field(default_factory=dict)
    around: object = None  # the Scope that a closure sees


@dataclass(eq=False)
class Record:
    """A thing with named parts; ``path``: of what comes from outside, and has all others."""

    fields: dict[str, Value]
    path: tuple[str | int, ...] = ()


@dataclass(frozen=True)
class Words:
    """A text in quotes."""

    text: str


@dataclass(frozen=True)
class Reach:
    """Places from one to another."""

    first: int | None
    last: int | None
    step: int = 1


@dataclass(frozen=True)
class Broken:
    """What could not be followed, refused only where it is needed."""

    why: str


Value = Formula | Outside | Array | Several | Local | Record | Words | Reach | Broken
ZERO, ONE = Formula("0"), Formula("1")


def number(value: int) -> Formula:
    """A whole number."""
    return Formula(str(value), FACTOR if value >= 0 else SUM)


def outside_of(value: Value) -> Value:
    """A formula that is nothing but a quantity from outside, as that; any other value as it is."""
    found = re.fullmatch("«([^«»]+)»", value.text) if isinstance(value, Formula) else None
    return Outside(tuple(int(p) if p.isdigit() else p for p in found[1].split("|"))) if found else value


def copied(value: Value) -> Value:
    """An array, or a thing with fields, that changes with no other; any other value as it is."""
    if isinstance(value, Record):
        return Record(dict(value.fields), value.path)
    return value.copied() if isinstance(value, Array) else value


def formula(value: Value) -> Formula:
    """A number or a quantity. Raises NotFollowed for anything else."""
    match value:
        case Formula():
            return value
        case Outside():
            return Formula(value.mark)
        case Array(entries=[one]):
            return one
        case Array():
            raise NotFollowed("an array stands where a number is needed; write out its entries")
        case Broken(why=why):
            raise NotFollowed(why)
    raise NotFollowed("something that is no number stands where one is needed")


def _made(text: str, level: int) -> Formula:
    if len(text) > LONGEST_FORMULA:
        raise NotFollowed("an expression that is too long; give its parts names")
    return Formula(text, level)


def added(a: Formula, b: Formula) -> Formula:
    """a + b"""
    if a.whole is not None and b.whole is not None:
        return number(a.whole + b.whole)
    if a.text == "0":
        return b
    if b.text == "0":
        return a
    return _made(f"{a.text} + {b.text}" if not b.text.startswith("-") else f"{a.text} + ({b.text})", SUM)


def subtracted(a: Formula, b: Formula) -> Formula:
    """a - b"""
    if a.whole is not None and b.whole is not None:
        return number(a.whole - b.whole)
    if b.text == "0":
        return a
    if a.text == "0":
        return negative(b)
    return _made(f"{a.text} - {b.within(PRODUCT)}", SUM)


def negative(a: Formula) -> Formula:
    """-a"""
    if a.whole is not None:
        return number(-a.whole)
    return _made(f"-{a.within(PRODUCT)}", SUM)


def times(a: Formula, b: Formula) -> Formula:
    """a b"""
    if a.whole is not None and b.whole is not None:
        return number(a.whole * b.whole)
    if "0" in (a.text, b.text):
        return ZERO
    if a.text == "1":
        return b
    if b.text == "1":
        return a
    return _made(f"{a.within(PRODUCT)}*{b.within(PRODUCT)}", PRODUCT)


def divided(a: Formula, b: Formula) -> Formula:
    """a / b"""
    if b.text == "1":
        return a
    if b.text == "0":
        raise NotFollowed("a division by zero")
    if a.text == "0":
        return a
    return _made(f"{a.within(PRODUCT)}/{b.within(FACTOR)}", SUM)


def power(a: Formula, b: Formula) -> Formula:
    """a to a whole number."""
    exponent = re.sub(r"\.0*$", "", b.text)
    if not WHOLE.fullmatch(exponent):
        raise NotFollowed(f"a power of {b.text[:20]}; only whole numbers are read, as in x^2")
    if exponent == "1":
        return a
    base = a.text if ATOM.fullmatch(a.text) else f"({a.text})"
    return _made(f"{base}^{exponent}" if int(exponent) >= 0 else f"{base}^({exponent})", FACTOR)


SCALAR: dict[str, Callable[[Formula, Formula], Formula]] = {
    "+": added, "-": subtracted, "*": times, "/": divided, "^": power,
    "\\": lambda a, b: divided(b, a),
}  # fmt: skip
