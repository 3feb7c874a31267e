"""The two mechanisms of the documents, validated when they are created.

Both are planar, hang from the origin, and are described by absolute angles from the downward vertical,
counter-clockwise positive: a positive angle moves the bob to +x. SI units throughout.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING, Protocol

from .errors import InvalidInput
from .tree import SUPPORT, Link, PlanarTree

if TYPE_CHECKING:
    from .spatial_mechanism import SpatialMechanism

# Lengths, masses and densities outside this range are refused: inside it a product such as m l² ω², and the
# square of it, stays clear of double precision's overflow and underflow.
SMALLEST, LARGEST = 1e-50, 1e50


class System(Protocol):
    """A mechanism, as every part of furiko uses it."""

    @property
    def n(self) -> int:
        """Number of angles."""
        ...

    @property
    def lengths(self) -> tuple[float, ...]:
        """Length of each link [m]."""
        ...

    @property
    def masses(self) -> tuple[float, ...]:
        """Mass of each link [kg]."""
        ...

    @property
    def gravity(self) -> float:
        """Gravity along -z [m/s²]."""
        ...

    @property
    def kind(self) -> str:
        """Its name in scene files: ``n-leg`` or ``rod-chain``."""
        ...

    def tree(self) -> PlanarTree:
        """The same mechanism as a planar tree of links."""
        ...

    def mechanism(self) -> SpatialMechanism:
        """The same mechanism in space, as every mechanism of furiko has it."""
        ...


@dataclass(frozen=True)
class NLegPendulum:
    """Shiki 2020: one point mass on a rod, with N further point masses hanging from it, each on a rod of its own.

    ``lengths[0]`` [m] and ``masses[0]`` [kg] are the document's l₁ and m₁; the N ≥ 1 legs follow. Rods have
    no mass. ``gravity`` [m/s²] points along -z. Raises :class:`InvalidInput` where a value makes no mechanism.
    """

    lengths: tuple[float, ...]
    masses: tuple[float, ...]
    gravity: float = 9.81

    def __post_init__(self) -> None:
        object.__setattr__(self, "lengths", _positive_numbers("lengths", self.lengths, "m"))
        object.__setattr__(self, "masses", _positive_numbers("masses", self.masses, "kg"))
        object.__setattr__(self, "gravity", _gravity(self.gravity))
        if len(self.lengths) < 2:
            raise InvalidInput("lengths: an N-leg pendulum has at least 2 (the first rod and one leg), got 1")
        if len(self.masses) != len(self.lengths):
            raise InvalidInput(
                f"masses: {len(self.masses)} given for {len(self.lengths)} lengths; one mass for each length is needed"
            )

    @property
    def n(self) -> int:
        """Number of angles: 1 + legs."""
        return len(self.lengths)

    @property
    def kind(self) -> str:
        return "n-leg"

    def tree(self) -> PlanarTree:
        """Link 1 on the support, every leg on link 1's end; point masses at the ends."""
        links = tuple(
            Link(parent=0 if i else SUPPORT, hinge=(self.lengths[0] if i else 0.0, 0.0), length=l, com=(l, 0.0), mass=m)
            for i, (l, m) in enumerate(zip(self.lengths, self.masses, strict=True))
        )
        return PlanarTree(links, self.gravity)

    def mechanism(self) -> SpatialMechanism:
        """The same in space: its joints' coordinates are each link's angle less its parent's [rad]."""
        from .planar_in_space import spatial_mechanism_of  # with numpy, which a system of plain numbers does not need

        return spatial_mechanism_of(self.tree())


@dataclass(frozen=True)
class RodChain:
    """Takeno 2018: n uniform rigid rods of one line density, joined end to end.

    ``lengths`` [m], l₁ … l_n from the support; ``density`` ρ [kg/m], so that m_j = ρ l_j; ``gravity`` [m/s²] along
    -z. Raises :class:`InvalidInput` where a value makes no mechanism.
    """

    lengths: tuple[float, ...]
    density: float = 1.0
    gravity: float = 9.81

    def __post_init__(self) -> None:
        object.__setattr__(self, "lengths", _positive_numbers("lengths", self.lengths, "m"))
        object.__setattr__(self, "density", _positive("density", self.density, "kg/m"))
        object.__setattr__(self, "gravity", _gravity(self.gravity))

    @property
    def n(self) -> int:
        """Number of angles: one a rod."""
        return len(self.lengths)

    @property
    def kind(self) -> str:
        return "rod-chain"

    @property
    def masses(self) -> tuple[float, ...]:
        """m_j = ρ l_j [kg]."""
        return tuple(self.density * l for l in self.lengths)

    def tree(self) -> PlanarTree:
        """Rod j on the end of rod j-1; centre of mass at half length, I_j = m_j l_j²/12 (Takeno (5))."""
        links = tuple(
            Link(
                parent=j - 1 if j else SUPPORT,
                hinge=(self.lengths[j - 1] if j else 0.0, 0.0),
                length=l,
                com=(l / 2, 0.0),
                mass=m,
                inertia=m * l * l / 12,
            )
            for j, (l, m) in enumerate(zip(self.lengths, self.masses, strict=True))
        )
        return PlanarTree(links, self.gravity)

    def mechanism(self) -> SpatialMechanism:
        """The same in space: its joints' coordinates are each link's angle less its parent's [rad]."""
        from .planar_in_space import spatial_mechanism_of  # with numpy, which a system of plain numbers does not need

        return spatial_mechanism_of(self.tree())


DocumentSystem = NLegPendulum | RodChain  # the mechanisms of the two documents


def number(field: str, value: object) -> float:
    """``value`` as a float. Raises :class:`InvalidInput` naming ``field`` where it is not a number."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InvalidInput(f"{field}: a number is needed, got {value!r:.60}")
    try:
        return float(value)
    except OverflowError:
        raise InvalidInput(f"{field}: {value!r:.60} is beyond double precision") from None


def _positive(field: str, value: object, unit: str) -> float:
    given = number(field, value)
    if not SMALLEST <= given <= LARGEST:
        raise InvalidInput(
            f"{field}: must be positive and finite, from {SMALLEST:g} to {LARGEST:g} {unit}, got {given!r}"
        )
    return given


def _positive_numbers(field: str, values: object, unit: str) -> tuple[float, ...]:
    if isinstance(values, str | bytes) or not isinstance(values, Iterable):
        raise InvalidInput(f"{field}: a list of numbers is needed, got {values!r:.60}")
    numbers = tuple(_positive(f"{field}[{i}]", value, unit) for i, value in enumerate(values))
    if not numbers:
        raise InvalidInput(f"{field}: at least one link is needed, got none")
    return numbers


def _gravity(value: object) -> float:
    given = number("gravity", value)
    if not (math.isfinite(given) and 0 <= given <= LARGEST):
        raise InvalidInput(
            f"gravity: must be zero or positive and finite (it points along -z: write 9.81, not -9.81), got {given!r}"
        )
    return given
