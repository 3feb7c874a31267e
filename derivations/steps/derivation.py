"""The equations of motion from first principles, step by step, with a place at every step where a mistake can be made.

    positions → velocities → squared speeds → energies → Lagrangian → momenta → derivatives → rows → matrix

and, the second way, by forces (Newton–Euler):

    positions → forces → joint forces → moments → rows

Every step is an attribute that a mistake may replace. Only what depends on a replaced part is worked out again, so that
a catalogue of thousands of mistakes is derived within a second.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Literal

from flint import fmpq

from ..algebra.symbols import Symbols
from ..algebra.trig import HALF, NOTHING, Formula, Space

# fmt: off
Stage = Literal[
    "position", "velocity", "speed", "energy", "lagrangian", "momentum", "derivative",
    "force", "moment",
    "equation", "matrix",
]
# fmt: on
NEWTON_STAGES: tuple[Stage, ...] = ("force", "moment")  # the way by forces
Pair = tuple[Formula, Formula]  # x and y
Row = dict[int, Formula]  # coefficient of each product of accelerations and rates: row = Σ coefficient · product = 0
ROTATION = (-1, -1)  # the part of a kinetic energy that is the rod's own turning


@dataclass(frozen=True)
class Mistake:
    """A mistake, made at one stage, at given places (links, counted from 0).

    ``code`` is stable and names the kind of mistake; ``english`` and ``japanese`` explain it to whoever made it.
    """

    code: str
    stage: Stage
    places: tuple[int, ...]
    english: str
    japanese: str
    apply: Callable[[Derivation], None] = field(compare=False, repr=False)

    @cached_property
    def name(self) -> str:
        """The code with its places, counted from 1: unique within a catalogue."""
        return self.code + "".join(f":{p + 1}" for p in self.places)


@dataclass
class Derivation:
    """All steps of one derivation.

    By mass b: ``position[b][k]`` and ``velocity[b][k]``: the segment of link k as (x, y); ``square[b][j, k]``: the
    parts of the squared speed, j ≤ k; ``kinetic[b]``: the same with ½ m, and the rotation; ``potential[b][k]``;
    ``share[b]``: how often (kinetic, -potential) enter the Lagrangian, (1, 1) when right.
    By angle i: ``momentum[i]`` = ∂L/∂ω_i; its time derivative as ``inertial[i]`` (accelerations) and
    ``convective[i][j]`` (through θ_j); ``kinetic_slope[i]``, ``potential_slope[i]``: ∂T/∂θ_i and ∂U/∂θ_i.
    By rod: ``inertia_side[j]`` = I_j α_j, ``upper[j]`` and ``lower[j]``: the moments of the forces at its two ends.
    ``rows``: the equations of motion, each divided by what the documents divide by.
    """

    symbols: Symbols
    position: list[dict[int, Pair]]
    velocity: list[dict[int, Pair]]
    square: list[dict[tuple[int, int], Formula]]
    kinetic: list[dict[tuple[int, int], Formula]]
    potential: list[dict[int, Formula]]
    share: list[tuple[int, int]]
    momentum: list[Formula]
    inertial: list[Formula]
    convective: list[dict[int, Formula]]
    kinetic_slope: list[Formula]
    potential_slope: list[Formula]
    force: list[Pair]
    inertia_side: list[Formula]
    upper: list[Formula]
    lower: list[Formula]
    rows: list[Row]

    @property
    def space(self) -> Space:
        """The symbols."""
        return self.symbols.space

    @property
    def n(self) -> int:
        """Number of angles."""
        return self.symbols.n

    def copy(self) -> Derivation:
        """A copy whose lists can be changed; the parts in them are shared and must be replaced, not changed."""
        lists = {name: list(value) for name, value in vars(self).items() if name != "symbols"}
        return Derivation(self.symbols, **lists)

    def lagrangian(self) -> Formula:
        """Σ share · (T, -U)."""
        total = NOTHING
        for b, (t, u) in enumerate(self.share):
            total = total + add(self.kinetic[b].values()).times(t) - add(self.potential[b].values()).times(u)
        return total


def add(parts: Iterable[Formula]) -> Formula:
    """The sum of formulas."""
    total = NOTHING
    for part in parts:
        total = total + part
    return total


# First principles, one step a function -------------------------------------------------------------------------------


def segment_position(m: Symbols, k: int, fraction: fmpq) -> Pair:
    """(l_k sin θ_k, -l_k cos θ_k), times the fraction of the link: angles from the downward vertical."""
    s = m.space
    return (s.l(k) * s.sin({k: 1})).times(fraction), (s.l(k) * s.cos({k: 1})).times(-fraction)


def velocities(s: Space, position: dict[int, Pair]) -> dict[int, Pair]:
    """d/dt of each segment."""
    return {k: (s.by_time(x), s.by_time(y)) for k, (x, y) in position.items()}


def squares(velocity: dict[int, Pair]) -> dict[tuple[int, int], Formula]:
    """|Σ v_k|² by pairs of segments; the two equal products j, k and k, j together."""
    keys = list(velocity)
    parts: dict[tuple[int, int], Formula] = {}
    for place, j in enumerate(keys):
        for k in keys[place:]:
            (xj, yj), (xk, yk) = velocity[j], velocity[k]
            parts[j, k] = (xj * xk + yj * yk).times(1 if j == k else 2)
    return parts


def kinetic_parts(m: Symbols, b: int, square: dict[tuple[int, int], Formula]) -> dict[tuple[int, int], Formula]:
    """½ m |v|² by parts, and ½ I ω²."""
    half_mass = m.mass(b).times(HALF)
    parts = {pair: half_mass * part for pair, part in square.items()}
    if m.kind == "rod-chain":
        parts[ROTATION] = m.inertia(b).times(HALF) * m.space.w(b).power(2)
    return parts


def potential_parts(m: Symbols, b: int, position: dict[int, Pair]) -> dict[int, Formula]:
    """m g y by segments."""
    weight = m.mass(b) * m.space.g
    return {k: weight * y for k, (_, y) in position.items()}


def inertial_part(s: Space, momentum: Formula) -> Formula:
    """The part of d(∂L/∂ω)/dt that has accelerations."""
    return add(s.by_rate(momentum, j) * s.a(j) for j in range(s.n))


def convective_parts(s: Space, momentum: Formula) -> dict[int, Formula]:
    """The part of d(∂L/∂ω)/dt that comes from the change of each angle."""
    parts = {j: s.by_angle(momentum, j) * s.w(j) for j in range(s.n)}
    return {j: part for j, part in parts.items() if part}


def lagrange_rows(s: Space, lagrangian: Formula) -> list[Formula]:
    """d/dt ∂L/∂ω_i - ∂L/∂θ_i for each i, of any Lagrangian."""
    return [s.by_time(s.by_rate(lagrangian, i)) - s.by_angle(lagrangian, i) for i in range(s.n)]


def forces(m: Symbols, position: dict[int, Pair], b: int) -> Pair:
    """m (r̈ + g e_y) of mass b: the force that its joints must supply."""
    s = m.space
    ax, ay = (add(s.by_time(s.by_time(segment[axis])) for segment in position.values()) for axis in (0, 1))
    return m.mass(b) * ax, m.mass(b) * (ay + s.g)


def across(s: Space, j: int, force: Pair) -> Formula:
    """force · q(θ_j), q = (cos θ, sin θ): its component that turns link j."""
    return force[0] * s.cos({j: 1}) + force[1] * s.sin({j: 1})


def total(pairs: Iterable[Pair]) -> Pair:
    """The sum of vectors."""
    x, y = NOTHING, NOTHING
    for px, py in pairs:
        x, y = x + px, y + py
    return x, y


def newton_sides(m: Symbols, force: Sequence[Pair], j: int) -> Pair:
    """Moments on link j of the forces at its lower and its upper end.

    Rods (Takeno (4), (8)): T_k = -Σ_{i>k} m_i(r̈_i + g e_y) acts at the lower end of rod k, and the moment about its
    centre is l/2 (T_j + T_{j-1})·q. n-leg: a massless rod carries no moment, so that l q·(force on its mass, and, of
    link 1, on the masses it carries) = 0; the weightless link has no upper side.
    """
    s = m.space
    if m.kind == "n-leg":
        carried = total(force[1:]) if j == 0 else (NOTHING, NOTHING)
        return -(s.l(j) * across(s, j, carried)), -(s.l(j) * across(s, j, force[j]))
    arm = s.l(j).times(HALF)
    return -(arm * across(s, j, total(force[j + 1 :]))), -(arm * across(s, j, total(force[j:])))


@lru_cache(maxsize=64)
def correct_derivation(m: Symbols) -> Derivation:
    """The derivation without a mistake."""
    s, n = m.space, m.n
    position = [{k: segment_position(m, k, fraction) for k, fraction in m.path(b)} for b in range(n)]
    velocity = [velocities(s, p) for p in position]
    square = [squares(v) for v in velocity]
    kinetic = [kinetic_parts(m, b, square[b]) for b in range(n)]
    potential = [potential_parts(m, b, position[b]) for b in range(n)]
    t = add(part for parts in kinetic for part in parts.values())
    u = add(part for parts in potential for part in parts.values())
    momentum = [s.by_rate(t, i) for i in range(n)]
    force = [forces(m, position[b], b) for b in range(n)]
    sides = [newton_sides(m, force, j) for j in range(n)]
    derivation = Derivation(
        symbols=m,
        position=position,
        velocity=velocity,
        square=square,
        kinetic=kinetic,
        potential=potential,
        share=[(1, 1)] * n,
        momentum=momentum,
        inertial=[inertial_part(s, p) for p in momentum],
        convective=[convective_parts(s, p) for p in momentum],
        kinetic_slope=[s.by_angle(t, i) for i in range(n)],
        potential_slope=[s.by_angle(u, i) for i in range(n)],
        force=force,
        inertia_side=[m.inertia(j) * s.a(j) for j in range(n)],
        lower=[lower for lower, _ in sides],
        upper=[upper for _, upper in sides],
        rows=[],
    )
    derivation.rows = [_row(derivation, i, _lagrange_side(derivation, i)) for i in range(n)]
    return derivation


def _lagrange_side(d: Derivation, i: int) -> Formula:
    return d.inertial[i] + add(d.convective[i].values()) - d.kinetic_slope[i] + d.potential_slope[i]


def _newton_side(d: Derivation, i: int) -> Formula:
    return d.inertia_side[i] - d.lower[i] - d.upper[i]


def _row(d: Derivation, i: int, side: Formula) -> Row:
    return d.space.split(side * d.symbols.divisor(i).inverse_monomial())


# With mistakes -------------------------------------------------------------------------------------------------------


def derive(m: Symbols, mistakes: Sequence[Mistake] = ()) -> Derivation:
    """The derivation in which these mistakes are made, each at its stage; only what they touch is worked out anew."""
    base = correct_derivation(m)
    if not mistakes:
        return base
    d = base.copy()
    _to_lagrangian(base, d, mistakes)
    if any(mistake.stage in NEWTON_STAGES for mistake in mistakes):
        _by_newton(base, d, mistakes)
    else:
        _by_lagrange(base, d, mistakes)
    _make(d, mistakes, "equation")
    _make(d, mistakes, "matrix")
    return d


def _make(d: Derivation, mistakes: Sequence[Mistake], stage: Stage) -> None:
    for mistake in mistakes:
        if mistake.stage == stage:
            mistake.apply(d)


def _to_lagrangian(base: Derivation, d: Derivation, mistakes: Sequence[Mistake]) -> None:
    m, s = d.symbols, d.space
    _make(d, mistakes, "position")
    for b in range(d.n):
        if d.position[b] is not base.position[b]:
            d.velocity[b] = velocities(s, d.position[b])
            d.potential[b] = potential_parts(m, b, d.position[b])
    _make(d, mistakes, "velocity")
    for b in range(d.n):
        if d.velocity[b] is not base.velocity[b]:
            d.square[b] = squares(d.velocity[b])
    _make(d, mistakes, "speed")
    for b in range(d.n):
        if d.square[b] is not base.square[b]:
            d.kinetic[b] = kinetic_parts(m, b, d.square[b])
    _make(d, mistakes, "energy")
    _make(d, mistakes, "lagrangian")


def _by_lagrange(base: Derivation, d: Derivation, mistakes: Sequence[Mistake]) -> None:
    s = d.space
    t = _change(base, d, lambda x, b: (x.kinetic[b], x.share[b][0]))
    u = _change(base, d, lambda x, b: (x.potential[b], x.share[b][1]))
    if t:
        d.momentum = _changed(base.momentum, lambda i: s.by_rate(t, i))
        d.kinetic_slope = _changed(base.kinetic_slope, lambda i: s.by_angle(t, i))
    if u:
        d.potential_slope = _changed(base.potential_slope, lambda i: s.by_angle(u, i))
    _make(d, mistakes, "momentum")
    for i in range(d.n):
        if d.momentum[i] is not base.momentum[i]:
            d.inertial[i] = inertial_part(s, d.momentum[i])
            d.convective[i] = convective_parts(s, d.momentum[i])
    _make(d, mistakes, "derivative")
    for i in range(d.n):
        if any(
            getattr(d, part)[i] is not getattr(base, part)[i]
            for part in ("inertial", "convective", "kinetic_slope", "potential_slope")
        ):
            d.rows[i] = _row(d, i, _lagrange_side(d, i))


def _changed(old: list[Formula], change: Callable[[int], Formula]) -> list[Formula]:
    """Each formula with its change added; the very same object where there is none."""
    changes = [change(i) for i in range(len(old))]
    return [f + c if c else f for f, c in zip(old, changes, strict=True)]


def _change(
    base: Derivation,
    d: Derivation,
    energy: Callable[[Derivation, int], tuple[dict[tuple[int, int], Formula] | dict[int, Formula], int]],
) -> Formula:
    """By how much an energy, summed over the masses, has changed."""
    change = NOTHING
    for b in range(d.n):
        (old, _), (new, share) = energy(base, b), energy(d, b)
        if new is not old or share != 1:
            change = change + add(new.values()).times(share) - add(old.values())
    return change


def _by_newton(base: Derivation, d: Derivation, mistakes: Sequence[Mistake]) -> None:
    m = d.symbols
    for b in range(d.n):
        if d.position[b] is not base.position[b]:
            d.force[b] = forces(m, d.position[b], b)
    _make(d, mistakes, "force")
    if any(now is not old for now, old in zip(d.force, base.force, strict=True)):
        for j in range(d.n):
            sides = newton_sides(m, d.force, j)
            if sides != (base.lower[j], base.upper[j]):
                d.lower[j], d.upper[j] = sides
    _make(d, mistakes, "moment")
    for i in range(d.n):
        if any(getattr(d, part)[i] is not getattr(base, part)[i] for part in ("inertia_side", "lower", "upper")):
            d.rows[i] = _row(d, i, _newton_side(d, i))
