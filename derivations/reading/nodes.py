"""The tree of a line: what the parser makes, and what is evaluated and said back."""

from __future__ import annotations

from dataclasses import dataclass

from flint import fmpq


@dataclass(frozen=True)
class Number:
    """A rational number."""

    value: fmpq
    at: int


@dataclass(frozen=True)
class Symbol:
    """A symbol: its letter and its index, from 1, or 0 where it has none. ``less``: minus that of this index."""

    letter: str
    index: int
    at: int
    less: int = 0


@dataclass(frozen=True)
class Rate:
    """The time derivative of an expression."""

    base: Node
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
    """cos, sin or tan of an angle; or sgn or abs of a rate."""

    function: str
    argument: Node
    at: int


@dataclass(frozen=True)
class Name:
    """A name that the file itself defines."""

    text: str
    at: int


@dataclass(frozen=True)
class Matrix:
    """A matrix; a list of numbers is a column."""

    rows: tuple[tuple[Node, ...], ...]
    at: int


@dataclass(frozen=True)
class Inverse:
    """The inverse of a matrix, or 1 over a number. ``left``: of ``base``, which divides what follows, as in A \\ b."""

    base: Node
    at: int
    left: bool = False


@dataclass(frozen=True)
class Determinant:
    """The determinant of a matrix."""

    base: Node
    at: int


@dataclass(frozen=True)
class Root:
    """A square root, of which only even powers are read."""

    base: Node
    at: int


Node = Number | Symbol | Sum | Product | Power | Call | Name | Matrix | Inverse | Determinant | Root | Rate
