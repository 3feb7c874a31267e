"""What functions of numpy, torch, jax, casadi, sympy and MATLAB make of values that are followed."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from .arrays import entrywise, product
from .values import (
    LARGEST,
    ONE,
    ZERO,
    Array,
    Broken,
    Formula,
    NotFollowed,
    Outside,
    Reach,
    Several,
    Value,
    Words,
    formula,
    negative,
    power,
)

MODULES = frozenset((
    "np", "numpy", "math", "cmath", "jnp", "jax", "torch", "sp", "sympy", "sm", "sy", "ca", "casadi", "cs", "cas",
    "linalg", "scipy", "la", "LA", "npl", "spl", "numba", "nb", "anp", "autograd", "pnp", "cp", "cupy", "tf", "onp",
    "lax",
))  # fmt: skip
WAVES = ("sin", "cos", "tan", "sign", "sgn", "abs", "sqrt")
SAME = frozenset((
    "float", "double", "asarray", "squeeze", "ravel", "flatten", "float64", "float32", "copy", "clone", "detach",
    "numpy", "tolist", "item", "list", "tuple", "simplify", "asanyarray", "ascontiguousarray", "full", "vec", "evalf",
    "expand", "trigsimp", "as_tensor", "to", "contiguous", "requires_grad_", "Float", "DM", "evalc", "astype", "cpu",
    "requires_grad", "real", "SX", "MX", "nsimplify", "deepcopy", "toarray", "atleast_1d", "single", "collapse",
    "Parameter", "unstack", "unbind",
))  # fmt: skip
MADE = frozenset((
    "array", "tensor", "Tensor", "Matrix", "matrix", "mat", "ImmutableMatrix", "MutableDenseMatrix", "asmatrix",
    "Array", "as_vector",
))  # fmt: skip
EMPTY = frozenset((
    "zeros", "empty", "ones", "zeros_like", "empty_like", "ones_like", "eye", "identity", "new_zeros", "new_empty",
    "nan", "full_like",
))  # fmt: skip
JOINED = frozenset((
    "concatenate", "hstack", "vstack", "stack", "cat", "vertcat", "horzcat", "append", "r_", "column_stack", "block",
    "veccat", "blkdiag", "c_",
))  # fmt: skip
PRODUCTS = frozenset((
    "dot", "matmul", "mtimes", "mm", "mv", "inner", "vdot", "multi_dot", "matvec",
))  # fmt: skip
INVERSES = frozenset((
    "inv", "pinv", "pinv2", "pinvh", "inverse", "inverse_ADJ",
))  # fmt: skip
SOLVES = frozenset((
    "solve", "LUsolve", "mldivide", "linsolve", "lstsq", "gauss_jordan_solve", "cho_solve",
))  # fmt: skip


TIME_FIRST = re.compile(r"^«t»\*(?P<rate>«[^«»]+»|[0-9.]+)$")  # sin(t*w), which the readers of time have as w*t
IMPORTED = re.compile(
    r"(?m)^\s*(?:import\s+(?:sympy|numpy|casadi|torch|jax|math)[\w.]*\s+as|from\s+torch\s+import(?=\s+nn\b))\s+(?P<name>\w+)"
)


def modules_of(text: str) -> frozenset[str]:
    """Names of modules in a text of Python, its own names for them among these."""
    return MODULES | {m["name"] for m in IMPORTED.finditer(text)}


def from_items(items: Sequence[Value], kind: str = "array") -> Value:
    """A list of values as an array, where they are numbers or rows of one length."""
    if items and all(isinstance(x, Array) for x in items):
        rows = [x for x in items if isinstance(x, Array)]
        if len({x.shape for x in rows}) == 1 and len(rows[0].shape) == 1:
            entries = [e for row in rows for e in row.entries]
            return Array(entries, (len(rows), rows[0].shape[0]), kind)
        if len({x.shape for x in rows}) == 1 and all(len(x.entries) == 1 for x in rows):
            return Array([x.entries[0] for x in rows], (len(rows), 1), kind)
    if items and all(isinstance(x, Formula | Outside) or (isinstance(x, Array) and len(x.entries) == 1) for x in items):
        return Array([formula(x) for x in items], (len(items),), kind)
    return Several(list(items))


def filling(value: Value, count: int, *, is_part: bool) -> list[Formula]:
    """What as many entries of an array are given; one number stands for all of them."""
    if isinstance(value, Several):
        value = from_items(value.items)
    if isinstance(value, Outside) and is_part and count > 1:
        value = Array([Formula(Outside((*value.path, k)).mark) for k in range(count)], (count,))
    entries = value.entries if isinstance(value, Array) else [formula(value)]
    if len(entries) == 1:
        entries = entries * count
    if len(entries) != count:
        raise NotFollowed(f"{count} entries are given {len(entries)} values")
    return entries


def as_array(value: Value, kind: str = "array") -> Value:
    """What np.array, np.matrix and the like make of a list; a number stays one."""
    if isinstance(value, Several):
        value = from_items([as_array(x, kind) for x in value.items], kind)
    if isinstance(value, Array):
        shape = value.shape
        if kind == "matrix" and len(shape) == 1:
            shape = (1, *shape)
        return Array(list(value.entries), shape, kind)
    return value


def by_sizes(given: Sequence[Value], kind: str) -> Array:
    """sympy's Matrix(2, 1, [a, b])."""
    height, width = (v.whole if isinstance(v, Formula) else None for v in given[:2])
    entries = as_array(given[2])
    if not height or not width or not isinstance(entries, Array) or len(entries.entries) != height * width:
        raise NotFollowed("a matrix of this size; write out its rows")
    return Array(list(entries.entries), (height, width), kind)


def columns(value: Value) -> Value:
    """sympy's Matrix of a list is a column."""
    if isinstance(value, Array) and value.shape[0] == 1 and len(value.shape) == 2 and len(value.entries) > 1:
        return value
    return value


def sizes(arguments: Sequence[Value]) -> tuple[int, ...] | None:
    """The shape that is asked for; None where it is not known."""
    first = arguments[0] if arguments else None
    given = first.entries if isinstance(first, Array) else [a for a in arguments if isinstance(a, Formula)]
    if isinstance(first, Several):
        return None
    found = [f.whole for f in given]
    if not found or None in found or len(found) > 3:
        return None
    shape = tuple(k for k in found if k is not None)
    if any(k < 1 for k in shape) or math.prod(shape) > LARGEST:
        return None
    return shape


def empty(name: str, shape: tuple[int, ...]) -> Array:
    """Zeros, ones, or the unit matrix."""
    if name in ("eye", "identity"):
        n = shape[0]
        return Array([ONE if i == j else ZERO for i in range(n) for j in range(n)], (n, n))
    return Array([ONE if "ones" in name else ZERO] * math.prod(shape), shape)


def joined(name: str, values: Sequence[Value], axis: int | None) -> Value:
    """Vectors one behind another, rows one under another."""
    if not values:
        raise NotFollowed(f"{name} of nothing")
    arrays = []
    for value in values:
        v = as_array(value) if isinstance(value, Several) else value
        if isinstance(v, Broken):
            raise NotFollowed(v.why)
        v = v if isinstance(v, Array) else Array([formula(v)], (1,))
        if name in ("vertcat", "horzcat") and v.kind == "loose":  # a vector of casadi is a column
            v = Array(v.entries, (len(v.entries), 1))
        arrays.append(v)
    flat = all(len(a.shape) == 1 for a in arrays)
    if name in ("vstack", "stack", "column_stack") and flat and all(len(a.entries) > 1 for a in arrays):
        width = len(arrays[0].entries)
        if any(len(a.entries) != width for a in arrays):
            raise NotFollowed(f"{name} of vectors of different length")
        across = (name == "stack" and axis not in (None, 0)) or name == "column_stack"
        if across:
            return Array([a.entries[k] for k in range(width) for a in arrays], (width, len(arrays)))
        return Array([e for a in arrays for e in a.entries], (len(arrays), width))
    if all(a.is_vector for a in arrays) and (flat or all(a.shape[-1] == 1 for a in arrays if len(a.entries) > 1)):
        entries = [e for a in arrays for e in a.entries]
        return Array(entries, (len(entries),) if flat and name != "vertcat" else (len(entries), 1))
    return stacked(arrays, across=name in ("hstack", "horzcat") or axis in (1, -1))


def stacked(arrays: Sequence[Array], *, across: bool) -> Array:
    """Matrices beside or under one another."""
    kind = "matrix" if any(a.kind == "matrix" for a in arrays) else "array"
    if across:
        heights = {len(a.rows) if len(a.shape) == 2 else len(a.entries) for a in arrays}
        if len(heights) != 1:
            raise NotFollowed("matrices of different height stand beside one another")
        rows = [a.rows if len(a.shape) == 2 else [[e] for e in a.entries] for a in arrays]
        made = [[e for part in rows for e in part[i]] for i in range(heights.pop())]
    else:
        if len({a.shape[-1] for a in arrays}) != 1:
            raise NotFollowed("matrices of different width stand under one another")
        made = [row for a in arrays for row in a.rows]
    return Array([e for row in made for e in row], (len(made), len(made[0])), kind)


def wave(name: str, value: Value) -> Value:
    """sin and its kin, entry by entry."""
    short = {"sgn": "sign", "fabs": "abs", "absolute": "abs", "Abs": "abs"}.get(name, name)

    def one(x: Formula) -> Formula:
        if short == "sin" and x.text == "0":
            return ZERO
        if short == "cos" and x.text == "0":
            return ONE
        of = TIME_FIRST.sub(r"\g<rate>*«t»", x.text)
        return Formula(f"{short}({of})")

    if isinstance(value, Array):
        return Array([one(x) for x in value.entries], value.shape, value.kind)
    return one(formula(value))


def diagonal(value: Value) -> Array:
    """A matrix with these entries on its diagonal."""
    if not isinstance(value, Array) or not value.is_vector:
        raise NotFollowed("a diagonal matrix is made of a list")
    n = len(value.entries)
    return Array([value.entries[i] if i == j else ZERO for i in range(n) for j in range(n)], (n, n))


def squared(value: Value) -> Value:
    """Entry by entry."""
    return entrywise(value, Formula("2"), power)


def total(value: Value) -> Formula:
    """The sum of all entries; of an empty list, 0."""
    if isinstance(value, Several) and not value.items:
        return ZERO
    if not isinstance(value, Array):
        return formula(value)
    found = product(
        Array([ONE] * len(value.entries), (len(value.entries),)), Array(value.entries, (len(value.entries),))
    )
    return formula(found)


def reach(value: Value) -> list[int]:
    """The numbers that a loop counts."""
    if isinstance(value, Reach) and value.first is not None and value.last is not None:
        return list(range(value.first, value.last, value.step))
    if isinstance(value, Array):
        found = [f.whole for f in value.entries]
        if None not in found:
            return [k for k in found if k is not None]
    raise NotFollowed("a loop over something else than whole numbers; write it out")


def is_words(value: Value) -> bool:
    """Whether a value is a text."""
    return isinstance(value, Words)


__all__ = ["negative"]
