"""What the symbols of one file stand for: as formulas, in a space that keeps each of the author's symbols apart."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from flint import fmpq

from ..algebra.quotient import Quotient
from ..algebra.trig import Formula, Space, constant
from .momenta import Variable
from .tokens import fail

WORDS = {
    "t": "angle", "w": "rate", "a": "acceleration", "l": "length", "m": "mass", "I": "inertia",
    "c": "distance of a centre of mass",
}  # fmt: skip
GRAVITY = re.compile(r"\s*\+?([0-9]{1,4}(?:\.[0-9]{0,8})?)\s*;?\s*(?:m\s*/\s*s(?:\^2|²|\*\*2))?\s*")
MASSLESS = ("n-leg", "point-masses")


def own_symbols(n: int) -> tuple[str, ...]:
    """Moments of inertia and distances of centres of mass, which stay the author's."""
    return (*(f"I{k}" for k in range(1, n + 1)), *(f"lc{k}" for k in range(1, n + 1)))


def momentum_symbols(letter: Variable | None, n: int) -> tuple[str, ...]:
    """Names of momenta and of their derivatives, where a file has some."""
    if letter is None or letter.kind != "momentum":
        return ()
    return (*(f"{letter.letter}{k}" for k in range(1, n + 1)), *(f"{letter.letter}{k}'" for k in range(1, n + 1)))


@dataclass
class Meaning:
    """For one mechanism. ``used``: the symbols that occurred, as (letter, index), index 0 where none was written.

    ``named``: the author's own names, where he declares the mechanism himself.
    """

    kind: str
    space: Space
    named: Mapping[str, Formula] = field(default_factory=dict)
    used: set[tuple[str, int]] = field(default_factory=set)
    momenta: tuple[str, ...] = ()  # names of momenta and of their derivatives, where a file has some

    def own(self, name: str, at: int) -> Quotient:
        """A symbol that the file declares."""
        if name not in self.named:
            fail(at, f"{name} is not defined before it is used")
        return Quotient(self.named[name], {}, 1)

    def angle(self, index: int, at: int) -> int:
        """The place of the coordinate that an angle inside cos or sin is."""
        n = self.space.n
        if index == 0 and n > 1:
            fail(at, f"this angle has no index; which of the {n} links is it?")
        if index > n:
            fail(at, f"angle number {index}, but links = {n}")
        return max(index, 1) - 1

    def symbol(self, letter: str, index: int, at: int) -> Quotient:  # noqa: PLR0911, PLR0912 -- one for each kind of symbol
        """A symbol outside cos and sin. Raises InvalidInput, with the column, where it has no meaning here."""
        space = self.space
        if letter == "t":
            return self._coordinate(index, at)
        if letter == "p":
            fail(at, "π outside cos and sin; an equation of motion has none")
        if letter == "g":
            self.used.add(("g", 0))
            return Quotient(space.g, {}, 1)
        if letter == "r":
            if self.kind != "rod-chain":
                fail(at, "rho is the line density of a rod chain; other systems have masses m1, m2, …")
            self.used.add(("r", 0))
            return Quotient(space.rho, {}, 1)
        if letter in "PD":
            return self._momentum(letter, index, at)
        if self.kind == "mechanism" and letter not in "wa":
            name = letter.replace("c", "lc") + (str(index) if index else "")
            if name in self.named:
                return Quotient(self.named[name], {}, 1)
            fail(at, f"this {WORDS[letter]} is not among the symbols that the mechanism is declared with")
        if index > space.n:
            fail(at, f"{WORDS[letter]} number {index}, but links = {space.n}; write * for a product with a number")
        if letter in "Ic" and self.kind in MASSLESS:
            what = "I is the inertia of a rod" if letter == "I" else "l_c is the distance of a link's centre of mass"
            fail(at, f"{what}; point masses have none")
        if index == 0 and space.n > 1 and letter not in "lm":
            fail(at, f"this {WORDS[letter]} has no index; which of the {space.n} links is it?")
        self.used.add((letter, index))
        place = max(index, 1) - 1
        match letter:
            case "I":
                return Quotient(space.own(f"I{place + 1}"), {}, 1)
            case "c":
                return Quotient(space.own(f"lc{place + 1}"), {}, 1)
        return Quotient({"w": space.w, "a": space.a, "l": space.l, "m": space.m}[letter](place), {}, 1)

    def _momentum(self, letter: str, index: int, at: int) -> Quotient:
        n = self.space.n
        if index > n or (not index and n > 1):
            fail(at, f"momentum number {index}, but there are {n}" if index else
                 f"this momentum has no index; which of the {n} is it?")  # fmt: skip
        names = self.space.extra[-2 * n :]
        return Quotient(self.space.own(names[max(index, 1) - 1 + (n if letter == "D" else 0)]), {}, 1)

    def _coordinate(self, index: int, at: int) -> Quotient:
        if self.kind != "mechanism":
            fail(at, "an angle outside cos and sin; the exact equations have angles only inside")
        return Quotient(self.space.q(self.angle(index, at)), {}, 1)

    @property
    def equal_lengths(self) -> bool:
        """Whether l without an index stands for all lengths."""
        return self.space.n > 1 and ("l", 0) in self.used

    @property
    def equal_masses(self) -> bool:
        """Whether m without an index stands for all masses."""
        return self.space.n > 1 and ("m", 0) in self.used


def number_of_gravity(line: object) -> Formula | None:
    """What g is, where its definition is a number: 0 of a mechanism that lies flat; None elsewhere."""
    found = GRAVITY.fullmatch(line) if isinstance(line, str) else None
    return None if found is None else constant(fmpq(*Fraction(found[1]).as_integer_ratio()))
