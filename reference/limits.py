"""The states that furiko's own kernels accept; every other state is refused here."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..models.errors import InvalidInput

Array = NDArray[np.float64]

FLOAT64 = np.dtype(np.float64)
LARGEST_ANGLE = 1e15  # rad: above, neighbouring doubles are 0.1 rad apart and an angle means nothing
LARGEST_RATE = 1e100  # rad/s: squares and products with masses and lengths stay clear of overflow


class HasAngles(Protocol):
    """A mechanism, of which only the number of its angles matters here."""

    @property
    def n(self) -> int:
        """Number of angles."""
        ...


def checked_state(system: HasAngles, theta: Any, omega: Any) -> tuple[Array, Array]:
    """``theta`` and ``omega`` as contiguous float64 of one shape (..., n) and within range. Raises InvalidInput."""
    angles, rates = shaped_state(system, theta, omega)
    refuse_outside(angles, rates)
    return angles, rates


def shaped_state(system: HasAngles, theta: Any, omega: Any) -> tuple[Array, Array]:
    """:func:`checked_state` without the check of the range."""
    angles, rates = numbers("theta", theta), numbers("omega", omega)
    for name, values in (("theta", angles), ("omega", rates)):
        if values.ndim == 0 or values.shape[-1] != system.n:
            raise InvalidInput(
                f"{name}: the last axis must hold one value an angle, (..., {system.n}), got shape {values.shape}"
            )
    if angles.shape != rates.shape:
        raise InvalidInput(f"omega: must have theta's shape {angles.shape}, got {rates.shape}")
    return angles, rates


def refuse_outside(theta: Array, omega: Array) -> None:
    """Raise InvalidInput where an angle or a rate is not finite or too large, naming the first."""
    for name, unit, values, largest in (
        ("theta", "rad", theta, LARGEST_ANGLE),
        ("omega", "rad/s", omega, LARGEST_RATE),
    ):
        fits = np.abs(values) <= largest  # false for NaN
        if not fits.all():
            place = tuple(int(i) for i in np.argwhere(~fits)[0])
            index = ", ".join(map(str, place))
            raise InvalidInput(
                f"{name}[{index}]: must be finite and at most {largest:g} {unit}, got {float(values[place])!r}"
            )


def numbers(name: str, values: Any) -> Array:
    """``values`` as a contiguous float64 array. Raises InvalidInput where they are no numbers."""
    if values.__class__ is np.ndarray and values.dtype is FLOAT64 and values.flags.c_contiguous:
        return values  # what most callers give, in a tenth of the time
    try:
        if np.iscomplexobj(values):
            raise TypeError  # numpy would drop the imaginary part
        return np.asarray(values, np.float64, order="C")
    except (TypeError, ValueError):
        raise InvalidInput(f"{name}: an array of numbers is needed, got {str(values)[:60]}") from None
