"""The axes along which accelerations are put under stress: from an everyday mechanism, rung by rung, to the absurd.

An axis is a ladder of mechanisms and states whose rungs are equally far apart in the logarithm of one number (how many
links, how heavy a leg, how fast); rung 0 is harmless. Two axes of one kind of mechanism make a pair, on which both
numbers move together. What stands on a rung is a function of the axis, the rung and a seed alone.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import combinations
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ...models import InvalidInput, NLegPendulum, RodChain
from ...models.errors import nearest
from ...models.states import quantised

Array = NDArray[np.float64]
Mechanism = NLegPendulum | RodChain

# Random states on a rung: up to so many links, so many states. Long chains average by themselves.
STATES = ((50, 25), (200, 9), (100_000, 3))
PAIR_RUNGS = 24
PAIR_LINKS = 200  # a pair's most links: what is looked for is how two difficulties work together


@dataclass(frozen=True)
class Recipe:
    """A mechanism and how its states are drawn.

    ``kind``; ``n`` angles; ``first_mass``, ``leg_mass`` and ``light_leg_mass`` [kg]: of links 1, 2 and 3 of an N-leg
    pendulum, all others being 1; ``other_length`` [m]: of every second link, all others being 1; ``gravity`` [m/s²];
    ``rate`` [rad/s]: the largest; ``turns``: angles have up to so many radians added; ``spread`` [rad]: angles are
    within it of one direction; ``folded``: every second link points back. ``of_mass``, ``of_length``, ``of_time``:
    masses, lengths and rates are so many times smaller, in other units: powers of two, so that the motion is the same,
    to the last digit as long as no number is subnormal.
    """

    kind: Literal["rod-chain", "n-leg"]
    n: int
    first_mass: float = 1.0
    leg_mass: float = 1.0
    light_leg_mass: float = 1.0
    other_length: float = 1.0
    gravity: float = 9.81
    rate: float = 6.0
    turns: float = 0.0
    spread: float = math.pi
    folded: bool = False
    of_mass: float = 1.0
    of_length: float = 1.0
    of_time: float = 1.0

    def system(self) -> Mechanism:
        """The mechanism."""
        lengths = tuple(self.of_length * (self.other_length if j % 2 else 1.0) for j in range(self.n))
        gravity = self.gravity * self.of_length * self.of_time**2
        if self.kind == "rod-chain":
            return RodChain(lengths, density=self.of_mass / self.of_length, gravity=gravity)
        masses = [1.0] * self.n
        masses[:3] = [self.first_mass, self.leg_mass, self.light_leg_mass][: self.n]
        return NLegPendulum(lengths, tuple(self.of_mass * mass for mass in masses), gravity=gravity)

    @property
    def states(self) -> int:
        """How many states are drawn."""
        return next(states for most, states in STATES if self.n <= most)

    def draw(self, seed: str) -> tuple[Array, Array]:
        """θ [rad] and ω [rad/s], shape (states, n): the same for the same seed.

        Angles have few enough digits that differences of them are exact: an engine in relative coordinates is given
        the very same state.
        """
        digest = hashlib.sha256(seed.encode()).digest()
        random = np.random.Generator(np.random.PCG64(int.from_bytes(digest[:16], "big")))
        shape = (self.states, self.n)
        direction = random.uniform(-math.pi, math.pi, (self.states, 1))
        theta = self.spread * random.uniform(-1, 1, shape)
        turns = self.turns * random.uniform(-1, 1, shape)
        omega = self.rate * random.uniform(-1, 1, shape)
        if self.spread < math.pi:
            direction = np.round(direction * 1024) / 1024
        quantum = self.spread * 2.0**-36 if self.spread < 1e-3 else 2.0**-40
        quantum = 2.0 ** math.floor(math.log2(max(quantum, self.turns * 2.0**-50)))
        theta = np.round((theta + turns) / quantum) * quantum + (direction if self.spread < math.pi else 0.0)
        if self.folded:
            theta[:, 1::2] += math.pi
        return theta, self.of_time * (quantised(omega) if 1e-3 < self.rate < 1e4 else omega)


@dataclass(frozen=True)
class Axis:
    """A ladder: rung k has the value ``start`` · ``ratio``ᵏ, which ``change`` puts into the recipe ``base``."""

    name: str
    says: str
    unit: str
    base: Recipe
    start: float
    end: float
    ratio: float
    change: Callable[[Recipe, float], Recipe]
    fields: frozenset[str]
    links: bool = False  # its value is the number of angles
    further: float = 0.0  # where furiko's own kernels go on to

    @cached_property
    def top(self) -> int:
        """The last rung."""
        return self._rung(self.end)

    def top_for(self, most_links: int, *, kernels: bool) -> int:
        """The last rung for an engine that takes so many links."""
        if not self.links:
            return self.top
        others = self.recipe(0).n - 1  # that the axis does not count
        return self._rung(min(self.further if kernels and self.further else self.end, float(most_links - others)))

    def value(self, rung: int) -> float:
        """The number on this rung."""
        value = self.start * self.ratio**rung
        return float(min(round(value), round(max(self.end, self.further)))) if self.links else value

    def recipe(self, rung: int) -> Recipe:
        """The value of this rung."""
        return self.change(self.base, self.value(rung))

    def label(self, rung: int) -> str:
        """The value and its unit."""
        return f"{self.value(rung):.3g} {self.unit}".rstrip()

    def _rung(self, value: float) -> int:
        return math.floor(abs(math.log(value / self.start) / math.log(self.ratio)) + 1e-6)


@dataclass(frozen=True)
class Pair:
    """Two axes climbed together: rung k stands at the same part of both ladders."""

    first: Axis
    second: Axis

    @property
    def name(self) -> str:
        """Both names."""
        return f"{self.first.name} x {self.second.name}"

    @property
    def says(self) -> str:
        """A sentence that says what it is."""
        return f"{self.first.says}; at the same time {self.second.says}"

    @property
    def top(self) -> int:
        """The last rung."""
        return PAIR_RUNGS

    def top_for(self, most_links: int, *, kernels: bool) -> int:
        """The last rung: the same for every engine."""
        return PAIR_RUNGS

    def value(self, rung: int) -> float:
        """The part of the ladders, in percent."""
        return 100.0 * rung / PAIR_RUNGS

    def recipe(self, rung: int) -> Recipe:
        """The value of this rung."""
        first, second = (self._value(axis, rung) for axis in (self.first, self.second))
        return self.second.change(self.first.change(self._base(), first), second)

    def label(self, rung: int) -> str:
        """Both values."""
        return ", ".join(f"{self._value(axis, rung):.3g} {axis.unit}".rstrip() for axis in (self.first, self.second))

    def _base(self) -> Recipe:
        """The larger of the two mechanisms."""
        return max(self.first.base, self.second.base, key=lambda recipe: recipe.n)

    def _value(self, axis: Axis, rung: int) -> float:
        end = min(axis.end, PAIR_LINKS) if axis.links else axis.end
        value = axis.start * (end / axis.start) ** (rung / PAIR_RUNGS)
        return float(round(value)) if axis.links else value


Ladder = Axis | Pair

CHAIN = Recipe("rod-chain", 5)
STAR = Recipe("n-leg", 4)
UNITS = "units"
TINY = 2.0**-160  # 7e-49, of masses and lengths, of which furiko takes those from 1e-50 on
HALF_DECADE, TWELFTH_DECADE = 10 ** (1 / 2), 10 ** (1 / 12)


def _axis(
    name: str,
    says: str,
    base: Recipe,
    field: str,
    start: float,
    end: float,
    unit: str = "",
) -> Axis:
    def change(recipe: Recipe, value: float) -> Recipe:
        return replace(recipe, **{field: value})  # type: ignore[arg-type]  # its fields of type float alone

    ratio = HALF_DECADE if end > start else 1 / HALF_DECADE
    return Axis(name, says, unit, base, start, end, ratio, change, frozenset({field}))


def _links(name: str, says: str, base: Recipe, more: int, further: float) -> Axis:
    def change(recipe: Recipe, value: float) -> Recipe:
        return replace(recipe, n=int(value) + more)

    unit = "legs" if more else "rods"
    fields = frozenset({"n"})
    return Axis(name, says, unit, base, 1.0, 1000.0, TWELFTH_DECADE, change, fields, links=True, further=further)


def _to_denormals(name: str, says: str, base: Recipe, change: Callable[[Recipe, float], Recipe], bits: int) -> Axis:
    """Down to 2^-bits: units in which numbers or their products are subnormal; ten bits, a thousandth, a rung."""
    return Axis(name, says, "", base, 1.0, 2.0**-bits, 2.0**-10, change, frozenset({UNITS}))


def _small_masses(recipe: Recipe, value: float) -> Recipe:
    return replace(recipe, of_mass=value)


def _small_lengths(recipe: Recipe, value: float) -> Recipe:
    return replace(recipe, of_length=value)


def _slow(recipe: Recipe, value: float) -> Recipe:
    return replace(recipe, of_time=value)


def _tiny(recipe: Recipe) -> Recipe:
    return replace(recipe, of_mass=TINY, of_length=TINY)


def _folded(recipe: Recipe, value: float) -> Recipe:
    return replace(recipe, spread=value, folded=True)


_TWENTY = replace(CHAIN, n=20)

AXES: tuple[Axis, ...] = (
    _links("links", "rods of 1 m end to end", CHAIN, 0, 10_000.0),
    _axis("long-rods", "every second rod longer than 1 m", CHAIN, "other_length", 1.0, 1e6, "m"),
    _axis("short-rods", "every second rod shorter than 1 m", CHAIN, "other_length", 1.0, 1e-6, "m"),
    _axis("fast-rods", "rods that turn faster", CHAIN, "rate", 1.0, 1e6, "rad/s"),
    _axis("far-rods", "rods whose angles count many turns", CHAIN, "turns", 1.0, 1e9, "rad"),
    _axis("straight-rods", "twenty rods in one line but for so much", _TWENTY, "spread", 1.0, 1e-12, "rad"),
    Axis(
        "folded-rods",
        "twenty rods folded back on each other but for so much",
        "rad",
        _TWENTY,
        1.0,
        1e-12,
        1 / HALF_DECADE,
        _folded,
        frozenset({"spread"}),
    ),
    _axis("strong-gravity", "rods in strong gravity", CHAIN, "gravity", 9.81, 9.81e12, "m/s²"),
    _axis("weak-gravity", "rods in weak gravity", CHAIN, "gravity", 9.81, 9.81e-12, "m/s²"),
    _links("legs", "legs of 1 m and 1 kg", STAR, 1, 10_000.0),
    _axis("heavy-first", "link 1 heavier than its legs", STAR, "first_mass", 1.0, 1e12, "kg"),
    _axis("light-first", "link 1 lighter than its legs", STAR, "first_mass", 1.0, 1e-12, "kg"),
    _axis("heavy-leg", "one leg heavier than the rest", STAR, "leg_mass", 1.0, 1e12, "kg"),
    _axis("light-leg", "one leg lighter than the rest", STAR, "light_leg_mass", 1.0, 1e-12, "kg"),
    _axis("long-legs", "every second link longer than 1 m", STAR, "other_length", 1.0, 1e6, "m"),
    _axis("short-legs", "every second link shorter than 1 m", STAR, "other_length", 1.0, 1e-6, "m"),
    _axis("fast-legs", "legs that turn faster", STAR, "rate", 1.0, 1e6, "rad/s"),
    _axis("far-legs", "legs whose angles count many turns", STAR, "turns", 1.0, 1e9, "rad"),
    _axis("aligned-legs", "all links in one line but for so much", STAR, "spread", 1.0, 1e-12, "rad"),
    *(
        _to_denormals(f"{name}-{of}", says.format(of), base, change, bits)
        for of, base, tiny in (("rods", CHAIN, _tiny(CHAIN)), ("legs", STAR, _tiny(STAR)))
        for name, says, base, change, bits in (
            ("small-mass", "{} with masses in a unit that makes them smaller", base, _small_masses, 160),
            ("small-length", "{} with lengths in a unit that makes them smaller", base, _small_lengths, 160),
            ("slow", "{} with rates in a unit that makes them smaller", base, _slow, 530),
            ("subnormal", "tiny {} with rates in a unit that makes them smaller", tiny, _slow, 530),
        )
    ),
    _axis("no-gravity", "rods without gravity, ever slower", replace(CHAIN, gravity=0.0), "rate", 1.0, 1e-6, "rad/s"),
)


def pairs() -> Iterator[Pair]:
    """All pairs of axes of one kind of mechanism that change different things."""
    for first, second in combinations(AXES, 2):
        if first.base.kind == second.base.kind and not first.fields & second.fields and _fits(first, second):
            yield Pair(first, second)


def _fits(first: Axis, second: Axis) -> bool:
    """A mechanism without gravity stays without, and units are no difficulty beside another: they stand alone."""
    if UNITS in first.fields | second.fields:
        return False
    return not any("gravity" in a.fields and b.base.gravity == 0 for a, b in ((first, second), (second, first)))


@cache
def _known() -> dict[str, Ladder]:
    return {axis.name: axis for axis in AXES} | {pair.name: pair for pair in pairs()}


def find_axes(names: tuple[str, ...] | None) -> tuple[Ladder, ...]:
    """The ladders with these names; ``all`` for every axis and every pair; the single axes for None."""
    if names is None:
        return AXES
    known = _known()
    found: list[Ladder] = []
    for name in names:
        if name in ("all", "pairs"):
            found += [*(AXES if name == "all" else ()), *pairs()]
        elif name in known:
            found.append(known[name])
        else:
            single = ", ".join(axis.name for axis in AXES)
            hint = nearest(name, known) or f"; there are {single}, 'A x B' for two of them, pairs, trees, and all"
            raise InvalidInput(f"axis: none is called {name!r}{hint}")
    return tuple(dict.fromkeys(found))
