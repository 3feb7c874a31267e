"""Arithmetic of arrays, as numpy and MATLAB do it; what one does otherwise than the other is refused."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from .values import (
    LARGEST,
    ONE,
    ZERO,
    Array,
    Formula,
    NotFollowed,
    Outside,
    Value,
    added,
    divided,
    formula,
    negative,
    subtracted,
    times,
)

MOST_INVERTED = 4


def entrywise(a: Value, b: Value, of: Callable[[Formula, Formula], Formula]) -> Value:
    """An operation entry by entry; a number stands for as many as the other has."""
    if isinstance(a, Array) and isinstance(b, Outside):
        b = expanded(b, a)
    if isinstance(b, Array) and isinstance(a, Outside):
        a = expanded(a, b)
    if isinstance(a, Array) and isinstance(b, Array):
        if len(a.entries) == 1 and len(b.entries) > 1:
            return Array([of(a.entries[0], y) for y in b.entries], b.shape, b.kind)
        if len(b.entries) == 1 and len(a.entries) > 1:
            return Array([of(x, b.entries[0]) for x in a.entries], a.shape, a.kind)
        if "spread" in (a.kind, b.kind):
            a, b = _broadcast(a, b)
        shape = _common(a, b)
        kind = "matrix" if "matrix" in (a.kind, b.kind) else a.kind if a.kind == b.kind else "array"
        return Array([of(x, y) for x, y in zip(a.entries, b.entries, strict=True)], shape, kind)
    if isinstance(a, Array):
        return Array([of(x, formula(b)) for x in a.entries], a.shape, a.kind)
    if isinstance(b, Array):
        return Array([of(formula(a), y) for y in b.entries], b.shape, b.kind)
    return of(formula(a), formula(b))


def expanded(value: Outside, like: Array) -> Array:
    """A vector from outside, as long as another one."""
    if not like.is_vector:
        raise NotFollowed(f"{value.path[-1]} and a matrix are put together; say what {value.path[-1]} is in [define]")
    return vector(value, len(like.entries))


def vector(value: Outside, size: int) -> Array:
    """A vector from outside."""
    return Array([Formula(Outside((*value.path, k)).mark) for k in range(size)], (size,), "loose")


def spread(value: Array, axis: int) -> Array:
    """A vector with an axis more, np.expand_dims(x, 1): put together with another it is repeated along this."""
    if len(value.shape) != 1 or value.is_state or axis not in (0, 1, -1):
        raise NotFollowed("an axis more of something that is no vector; write out its entries")
    return Array(list(value.entries), (1, len(value.entries)) if axis == 0 else (len(value.entries), 1), "spread")


def _broadcast(a: Array, b: Array) -> tuple[Array, Array]:
    """Both as large as the larger, along each axis."""
    if len(a.shape) != 2 or len(b.shape) != 2 or "matrix" in (a.kind, b.kind):
        raise NotFollowed("a vector with an axis more is put together with another array; write out what it comes to")
    sizes = [max(x, y) for x, y in zip(a.shape, b.shape, strict=True)]
    if any(x not in (1, size) for one in (a, b) for x, size in zip(one.shape, sizes, strict=True)):
        raise NotFollowed("arrays of different size are put together")
    if sizes[0] * sizes[1] > LARGEST:
        raise NotFollowed(f"an array of more than {LARGEST} entries")
    made = []
    for one in (a, b):
        rows = one.rows * (sizes[0] if one.shape[0] == 1 else 1)
        entries = [e for row in rows for e in row * (sizes[1] if one.shape[1] == 1 else 1)]
        made.append(Array(entries, (sizes[0], sizes[1])))
    return made[0], made[1]


def _common(a: Array, b: Array) -> tuple[int, ...]:
    if a.shape == b.shape:
        return a.shape
    if len(a.entries) == len(b.entries) and a.is_vector and b.is_vector:
        if a.kind == "loose":
            return b.shape
        if b.kind == "loose":
            return a.shape
    sizes = " and ".join("×".join(map(str, x.shape)) for x in (a, b))
    raise NotFollowed(
        f"arrays of {sizes} are put together entry by entry; give both the same shape, and @ for products"
    )


def product(a: Value, b: Value) -> Value:  # noqa: PLR0911 -- one for each kind
    """The product of matrices and vectors; of numbers too."""
    if isinstance(a, Outside) and isinstance(b, Array):
        a = vector(a, b.shape[0]) if b.is_vector else a
    if isinstance(b, Outside) and isinstance(a, Array):
        if a.kind == "array" and len(a.entries) > 1 and a.shape[-1] == 1 and len(a.shape) == 2:  # a column B @ u
            return Array([times(x, vector(b, 1).entries[0]) for x in a.entries], (len(a.entries),), "array")
        b = vector(b, a.shape[-1]) if a.kind != "loose" or len(a.entries) > 1 else b
    if not isinstance(a, Array) or not isinstance(b, Array):
        return entrywise(a, b, times)
    if len(a.entries) == 1 or len(b.entries) == 1:
        return entrywise(a, b, times)
    left, right = _as_left(a, b), _as_right(a, b)
    if len(left[0]) != len(right):
        raise NotFollowed(f"a matrix of {len(left[0])} columns is multiplied by one of {len(right)} rows")
    width = len(right[0])
    if len(left) * width > LARGEST:
        raise NotFollowed("a matrix of more than 64 entries")
    entries = [_dot(row, [r[j] for r in right]) for row in left for j in range(width)]
    kind = "matrix" if "matrix" in (a.kind, b.kind) else "array"
    if len(entries) == 1 and (len(a.shape) == 1 or len(b.shape) == 1 or kind == "matrix"):
        return entries[0]
    if len(b.shape) == 1:
        return Array(entries, (len(left),), b.kind if b.kind != "matrix" else "array")
    if len(a.shape) == 1:
        return Array(entries, (width,), a.kind)
    return Array(entries, (len(left), width), kind)


def _as_left(a: Array, b: Array) -> list[list[Formula]]:
    if len(a.shape) == 1 and a.kind == "loose" and len(b.shape) == 2 and b.shape[0] == 1 and b.shape[1] > 1:
        return [[x] for x in a.entries]
    return a.rows


def _as_right(a: Array, b: Array) -> list[list[Formula]]:
    if len(b.shape) == 1:
        return [[x] for x in b.entries]
    return b.rows


def _dot(row: list[Formula], column: list[Formula]) -> Formula:
    total = ZERO
    for x, y in zip(row, column, strict=True):
        total = added(total, times(x, y))
    return total


def turned(a: Value) -> Value:
    """Transposed; of one axis alone it stays as it is."""
    if not isinstance(a, Array) or len(a.shape) == 1:
        return a
    return Array([row[j] for j in range(a.shape[1]) for row in a.rows], (a.shape[1], a.shape[0]), a.kind, a.is_state)


def determinant(a: Array) -> Formula:
    """By cofactors."""
    if len(a.shape) != 2 or a.shape[0] != a.shape[1] or a.shape[0] > MOST_INVERTED:
        raise NotFollowed(f"the inverse of {'×'.join(map(str, a.shape))}; square matrices up to 4×4 are followed")
    return _minor(a.rows)


def _minor(rows: list[list[Formula]]) -> Formula:
    if not rows:
        return ONE
    total = ZERO
    for c, x in enumerate(rows[0]):
        if x.text == "0":
            continue
        term = times(x, _minor([[y for k, y in enumerate(row) if k != c] for row in rows[1:]]))
        total = added(total, term) if c % 2 == 0 else subtracted(total, term)
    return total


def adjugate(a: Array) -> Array:
    """The matrix of cofactors, transposed."""
    size = a.shape[0]
    entries = []
    for i in range(size):
        for j in range(size):
            rest = [[x for c, x in enumerate(row) if c != i] for r, row in enumerate(a.rows) if r != j]
            minor = _minor(rest)
            entries.append(minor if (i + j) % 2 == 0 else negative(minor))
    return Array(entries, a.shape, a.kind)


def over(a: Value, by: Formula) -> Value:
    """Every entry divided by a number."""
    return entrywise(a, by, divided)


def grow(array: Array, places: Sequence[int], path: str) -> None:
    """MATLAB's array made as large as the place that is filled, counted from 1, asks for."""
    height, width = array.shape
    if len(places) == 1:
        k = places[0]
        new = (max(height, k), 1) if width == 1 else (height, max(width, k) if height == 1 else width)
    else:
        new = (max(height, places[0]), max(width, places[1]))
    if new == array.shape:
        return
    if new[0] * new[1] > LARGEST:
        raise NotFollowed(f"{path}: more than {LARGEST} entries")
    rows = [[*row, *[ZERO] * (new[1] - width)] for row in array.rows]
    rows += [[ZERO] * new[1] for _ in range(new[0] - height)]
    array.entries[:] = [e for row in rows for e in row]
    array.shape = new
