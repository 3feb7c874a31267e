"""The symbols of a mechanism, and the links on the path from the support to each of its masses."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

from flint import fmpq

from .trig import NOTHING, Formula, Space

KINDS = ("n-leg", "rod-chain")


@dataclass(frozen=True)
class Symbols:
    """An n-leg pendulum (Shiki) or a chain of uniform rods (Takeno) with symbols for numbers; ``n`` angles."""

    kind: str
    n: int

    @cached_property
    def space(self) -> Space:
        """The places of the symbols in a formula."""
        return Space(self.n)

    def mass(self, b: int) -> Formula:
        """m_b; of a rod ρ l_b, so that both ways of writing it are one."""
        return self.space.rho * self.space.l(b) if self.kind == "rod-chain" else self.space.m(b)

    def inertia(self, b: int) -> Formula:
        """About the centre of mass: ρ l_b³/12 of a rod, nothing of a point mass."""
        if self.kind == "n-leg":
            return NOTHING
        return (self.space.rho * self.space.l(b).power(3)).times(fmpq(1, 12))

    def parent(self, b: int) -> int:
        """The link that carries link b, or -1."""
        return min(b - 1, 0) if self.kind == "n-leg" else b - 1

    def path(self, b: int) -> tuple[tuple[int, fmpq], ...]:
        """The links on the path to mass b, each with the fraction of it that belongs to the path."""
        if self.kind == "n-leg":
            return ((0, fmpq(1)), (b, fmpq(1))) if b else ((0, fmpq(1)),)
        return (*((k, fmpq(1)) for k in range(b)), (b, fmpq(1, 2)))

    def divisor(self, i: int) -> Formula:
        """The divisor of Lagrange's row i in the documents: l_i (Shiki (1.9)), ρ l_i (Takeno (17))."""
        return self.space.l(i) if self.kind == "n-leg" else self.space.rho * self.space.l(i)


@lru_cache(maxsize=64)
def symbols_of(kind: str, n: int) -> Symbols:
    """The symbols for n angles; ``kind`` is one of ``KINDS``. The same object each time, so that caches work."""
    return Symbols(kind, n)
