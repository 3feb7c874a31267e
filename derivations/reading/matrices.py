"""Matrices of quotients, multiplied out: what a derivation in matrix form stands for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NoReturn

from ...models.errors import InvalidInput
from ..algebra.quotient import Budget, Quotient, number

LARGEST = 4  # rows of a matrix whose inverse or determinant is taken, by cofactors


@dataclass(frozen=True)
class Grid:
    """A matrix, by rows."""

    rows: tuple[tuple[Quotient, ...], ...]

    @property
    def height(self) -> int:
        """Number of rows."""
        return len(self.rows)

    @property
    def width(self) -> int:
        """Number of columns."""
        return len(self.rows[0])


def _refuse(budget: Budget, why: str) -> NoReturn:
    raise InvalidInput(f"column {budget.at + 1}: {why}")


def added(one: Quotient | Grid, two: Quotient | Grid, sign: int, budget: Budget) -> Quotient | Grid:
    """The sum or difference; of a matrix and nothing (a zero) too."""
    if isinstance(one, Quotient) and isinstance(two, Quotient):
        return one.plus(two, sign, budget)
    if isinstance(one, Quotient) and not one.numerator:
        return two if sign > 0 else scaled(two, number(-1), budget)
    if isinstance(two, Quotient) and not two.numerator:
        return one
    if isinstance(one, Quotient) or isinstance(two, Quotient):
        _refuse(budget, "a number and a matrix are added")
    if (one.height, one.width) != (two.height, two.width):
        sizes = f"{one.height}×{one.width} and {two.height}×{two.width}"
        _refuse(budget, f"matrices of {sizes} are added")
    pairs = zip(one.rows, two.rows, strict=True)
    return Grid(tuple(tuple(x.plus(y, sign, budget) for x, y in zip(*rows, strict=True)) for rows in pairs))


def scaled(value: Quotient | Grid, factor: Quotient, budget: Budget) -> Quotient | Grid:
    """Every entry times a number."""
    if isinstance(value, Quotient):
        return value.times(factor, budget)
    return Grid(tuple(tuple(x.times(factor, budget) for x in row) for row in value.rows))


def multiplied(one: Quotient | Grid, two: Quotient | Grid, budget: Budget) -> Quotient | Grid:
    """The product in this order."""
    if isinstance(two, Quotient):
        return scaled(one, two, budget)
    if isinstance(one, Quotient):
        return scaled(two, one, budget)
    if one.width != two.height:
        if two.height == 1 and one.width == two.width:  # a vector that was written as a row
            two = Grid(tuple((x,) for x in two.rows[0]))
        else:
            _refuse(budget, f"a matrix of {one.width} columns is multiplied by one of {two.height} rows")
    columns = list(zip(*two.rows, strict=True))
    product = Grid(tuple(tuple(_dot(row, column, budget) for column in columns) for row in one.rows))
    return product.rows[0][0] if product.height == product.width == 1 and one.width > 1 else product


def _dot(row: tuple[Quotient, ...], column: tuple[Quotient, ...], budget: Budget) -> Quotient:
    total = number(0)
    for x, y in zip(row, column, strict=True):
        if x.numerator and y.numerator:
            total = total.plus(x.times(y, budget), 1, budget)
    return total


def inverse(a: Grid, budget: Budget) -> Grid:
    """By cofactors over the determinant."""
    size = a.height
    if size != a.width or size > LARGEST:
        _refuse(budget, f"the inverse of a {a.height}×{a.width} matrix; square ones up to {LARGEST} are read")
    whole = _determinant(a.rows, budget)
    if not whole.numerator:
        _refuse(budget, "the inverse of a singular matrix")
    over = whole.inverse()
    return Grid(tuple(
        tuple(_cofactor(a, j, i, budget).times(over, budget) for j in range(size)) for i in range(size)
    ))  # fmt: skip


def determinant(a: Grid, budget: Budget) -> Quotient:
    """By cofactors."""
    if a.height != a.width or a.height > LARGEST:
        _refuse(budget, f"the determinant of a {a.height}×{a.width} matrix; of square ones up to {LARGEST} it is read")
    return _determinant(a.rows, budget)


def _cofactor(a: Grid, i: int, j: int, budget: Budget) -> Quotient:
    rest = tuple(tuple(x for c, x in enumerate(row) if c != j) for r, row in enumerate(a.rows) if r != i)
    minor = _determinant(rest, budget)
    return minor if (i + j) % 2 == 0 else minor.times(number(-1), budget)


def _determinant(rows: tuple[tuple[Quotient, ...], ...], budget: Budget) -> Quotient:
    if not rows:
        return number(1)
    total = number(0)
    for c, x in enumerate(rows[0]):
        if x.numerator:
            minor = _determinant(tuple(tuple(y for k, y in enumerate(row) if k != c) for row in rows[1:]), budget)
            total = total.plus(x.times(minor, budget), 1 if c % 2 == 0 else -1, budget)
    return total
