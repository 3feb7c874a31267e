"""The four arithmetics in which the one text of each equation runs.

Equations are written with numpy arrays whose last axis (for matrices: the last two) counts components. The elements
decide the arithmetic: floats (batched over leading axes), balls of python-flint (every result encloses the true value),
sympy expressions, or heyoka expressions (compiled, integrated in quadruple precision). Functions that numpy's operators
lack are in a small namespace, the argument ``xp``. flint, sympy and heyoka are imported only for such a number.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..models.errors import library

Array = NDArray[Any]


class Arithmetic(ABC):
    """The functions that equations need besides operators, on arrays with elements of ``dtype``."""

    name: str
    dtype: np.dtype[Any]

    @abstractmethod
    def array(self, values: ArrayLike | Iterable[Any]) -> Array:
        """``values`` in this arithmetic. A float or an integer is taken as exact."""

    @abstractmethod
    def cos(self, x: Any) -> Any:
        """Cosine of each element [rad]."""

    @abstractmethod
    def sin(self, x: Any) -> Any:
        """Sine of each element [rad]."""

    @abstractmethod
    def solve(self, matrix: Array, right: Array) -> Array:
        """x with matrix · x = right; shapes (…, n, n) and (…, n).

        The matrix is a symmetric positive definite one with its rows and columns scaled by positive numbers, as those
        of both documents are: elimination then needs no pivoting, and symbolic arithmetics can do it.
        """

    def cos_sin(self, x: Any) -> tuple[Any, Any]:
        """Cosine and sine of each element [rad] at once, where an arithmetic can share work."""
        return self.cos(x), self.sin(x)

    def cos_sin_differences(self, angles: Array) -> tuple[Array, Array]:
        """cos(θ_j - θ_k) and sin(θ_j - θ_k), shape (…, n, n) each."""
        return self.cos_sin(_differences(angles))

    def cos_differences(self, angles: Array) -> Array:
        """The first of them alone."""
        return self.cos_sin_differences(angles)[0]

    def sin_differences(self, angles: Array) -> Array:
        """The second of them alone."""
        return self.cos_sin_differences(angles)[1]

    def zeros(self, shape: Sequence[int]) -> Array:
        """An array of zeros to be filled."""
        return np.zeros(tuple(shape), dtype=self.dtype)

    def stack(self, parts: Sequence[Any], axis: int = -1) -> Array:
        """Components, broadcast to a common batch shape, along a new axis."""
        return np.stack(np.broadcast_arrays(*(self._component(part) for part in parts)), axis=axis)

    def matrix(self, rows: Sequence[Sequence[Any]]) -> Array:
        """The matrix with these entries, shape (…, rows, columns)."""
        return self.stack([self.stack(row) for row in rows], axis=-2)

    def _component(self, part: Any) -> Array:
        return self.array(part) if isinstance(part, int | float) else np.asarray(part, dtype=self.dtype)


def _differences(angles: Array) -> Array:
    return np.asarray(angles[..., :, None] - angles[..., None, :])


class Floats(Arithmetic):
    """numpy floating point: float64, or longdouble."""

    def __init__(self, dtype: Any = np.float64) -> None:
        self.dtype = np.dtype(dtype)
        self.name = self.dtype.name

    def array(self, values: ArrayLike | Iterable[Any]) -> Array:
        return np.asarray(values, dtype=self.dtype)

    def cos(self, x: Any) -> Any:
        return np.cos(x)

    def sin(self, x: Any) -> Any:
        return np.sin(x)

    def cos_differences(self, angles: Array) -> Array:
        return np.asarray(np.cos(_differences(angles)))

    def sin_differences(self, angles: Array) -> Array:
        return np.asarray(np.sin(_differences(angles)))

    def solve(self, matrix: Array, right: Array) -> Array:
        if self.dtype == np.float64:
            return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0])
        return _eliminate(matrix, right)  # LAPACK has no longdouble


class Objects(Arithmetic):
    """Arrays of Python objects that bring their own operators."""

    dtype = np.dtype(object)

    def __init__(self, name: str, number: Callable[[Any], Any], cos: Callable[[Any], Any], sin: Callable[[Any], Any]):
        self.name = name
        self._number = np.frompyfunc(number, 1, 1)
        self._cos = np.frompyfunc(cos, 1, 1)
        self._sin = np.frompyfunc(sin, 1, 1)

    def array(self, values: ArrayLike | Iterable[Any]) -> Array:
        return np.asarray(self._number(np.asarray(values, dtype=object)), dtype=object)

    def cos(self, x: Any) -> Any:
        return self._cos(x)

    def sin(self, x: Any) -> Any:
        return self._sin(x)

    def cos_sin_differences(self, angles: Array) -> tuple[Array, Array]:
        """As :meth:`Arithmetic.cos_sin_differences`; cosine being even and sine odd, half of them is enough."""
        n = angles.shape[-1]
        j, k = np.triu_indices(n, 1)
        cos, sin = self.zeros((2, *angles.shape, n))
        cos[..., range(n), range(n)], sin[..., range(n), range(n)] = self.array(1), self.array(0)
        upper_cos, upper_sin = self.cos_sin(angles[..., j] - angles[..., k])
        cos[..., j, k] = cos[..., k, j] = upper_cos
        sin[..., j, k], sin[..., k, j] = upper_sin, -upper_sin
        return cos, sin

    def solve(self, matrix: Array, right: Array) -> Array:
        return _eliminate_symbols(matrix, right)


class Balls(Objects):
    """python-flint's arb at the precision of ``flint.ctx``: midpoint and radius, every operation rounded outwards."""

    def __init__(self) -> None:
        from flint import arb

        super().__init__("balls", arb, arb.cos, arb.sin)
        self._sin_cos = np.frompyfunc(arb.sin_cos, 1, 2)

    def cos_sin(self, x: Any) -> tuple[Any, Any]:
        sin, cos = self._sin_cos(x)
        return cos, sin

    def solve(self, matrix: Array, right: Array) -> Array:
        """As :meth:`Arithmetic.solve`, for any matrix that the balls show to be regular; else ZeroDivisionError."""
        n = right.shape[-1]
        batch = np.broadcast_shapes(matrix.shape[:-2], right.shape[:-1])
        matrices = np.broadcast_to(matrix, (*batch, n, n)).reshape(-1, n, n)
        rights = np.broadcast_to(right, (*batch, n)).reshape(-1, n)
        solved = self.zeros(rights.shape)
        for i, (a, b) in enumerate(zip(matrices, rights, strict=True)):
            solved[i] = ball_matrix(a).solve(ball_matrix(b[:, None])).entries()
        return solved.reshape(*batch, n)


def ball_matrix(a: Array) -> Any:
    """An array of balls, shape (rows, columns), as flint's own matrix."""
    from flint import arb_mat

    rows, columns = a.shape
    return arb_mat(rows, columns, a.ravel().tolist())


def floats(dtype: Any = np.float64) -> Arithmetic:
    """numpy's arithmetic in ``dtype``."""
    return Floats(dtype)


def balls() -> Arithmetic:
    """Ball arithmetic; ``with flint.ctx.workprec(bits):`` sets the precision."""
    return Balls()


def sympy_arithmetic() -> Arithmetic:
    """sympy expressions; floats become the rational numbers that they are."""
    sympy = library("sympy")

    def number(x: Any) -> Any:
        return sympy.Rational(x) if isinstance(x, float) else sympy.sympify(x)

    return Objects("sympy", number, sympy.cos, sympy.sin)


def heyoka_arithmetic() -> Arithmetic:
    """heyoka expressions; numbers become quadruple precision constants."""
    heyoka = library("heyoka")

    def number(x: Any) -> Any:
        return x if isinstance(x, heyoka.expression) else heyoka.expression(heyoka.real128(x))

    return Objects("heyoka", number, heyoka.cos, heyoka.sin)


_OF_MODULE: dict[str, Callable[[], Arithmetic]] = {
    "flint": balls,
    "sympy": sympy_arithmetic,
    "heyoka": heyoka_arithmetic,
}


def arithmetic_of(*values: Array) -> Arithmetic:
    """The arithmetic of these arrays' elements. Raises TypeError for elements of none of the four."""
    for value in values:
        if value.dtype == object:
            for element in value.flat:
                make = _OF_MODULE.get(type(element).__module__.partition(".")[0])
                if make:
                    return make()
            raise TypeError(f"elements of type {type(value.flat[0]).__name__} belong to none of the four arithmetics")
    dtype = np.result_type(np.float64, *values)
    return Floats(dtype)


def components(vector: Array) -> tuple[Any, ...]:
    """The components along the last axis, each of batch shape."""
    return tuple(np.moveaxis(vector, -1, 0))


def times(matrix: Array, vector: Array) -> Array:
    """matrix · vector; shapes (…, m, n) and (…, n)."""
    return np.asarray((matrix * vector[..., None, :]).sum(-1))


def sum_after(x: Array, axis: int = -1) -> Array:
    """Σ x_i over i = j+1 … n, for each j along ``axis``."""
    from_j = np.flip(np.cumsum(np.flip(x, axis), axis), axis)
    after = np.zeros_like(x)
    np.moveaxis(after, axis, 0)[:-1] = np.moveaxis(from_j, axis, 0)[1:]
    return after


def _eliminate(matrix: Array, right: Array) -> Array:
    """Gaussian elimination, last unknown first, batched."""
    n = right.shape[-1]
    batch = np.broadcast_shapes(matrix.shape[:-2], right.shape[:-1])
    a = np.broadcast_to(matrix, (*batch, n, n)).copy()
    b = np.broadcast_to(right, (*batch, n)).copy()
    for k in range(n - 1, 0, -1):
        factor = a[..., :k, k] / a[..., k, k, None]
        a[..., :k, :k] -= factor[..., None] * a[..., k, None, :k]
        b[..., :k] -= factor * b[..., k, None]
    x = np.zeros_like(b)
    for k in range(n):
        x[..., k] = (b[..., k] - (a[..., k, :k] * x[..., :k]).sum(-1)) / a[..., k, k]
    return x


def _eliminate_symbols(matrix: Array, right: Array) -> Array:
    """The same for one matrix of expressions. Structural zeros stay zeros, so an arrow matrix costs O(n)."""
    n = right.shape[-1]
    a, b = matrix.copy(), right.copy()
    for k in range(n - 1, 0, -1):
        for i in range(k):
            if _is_zero(a[i, k]):
                continue
            factor = a[i, k] / a[k, k]
            for j in range(k):
                if not _is_zero(a[k, j]):
                    a[i, j] = a[i, j] - factor * a[k, j]
            b[i] = b[i] - factor * b[k]
    x = np.empty_like(b)
    for k in range(n):
        rest = b[k]
        for j in range(k):
            if not _is_zero(a[k, j]):
                rest = rest - a[k, j] * x[j]
        x[k] = rest / a[k, k]
    return x


def _is_zero(x: Any) -> bool:
    return isinstance(x, int) and x == 0
