"""What a derivation may mean, the likeliest first: mechanism, masses, moments of inertia, angles, special values.

Each hypothesis is a mechanism derived from first principles, what it assumes beyond what the file says, and what the
author's symbols then stand for. None is a guess at a verdict: a derivation is held against it exactly.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from math import gcd, lcm

from flint import fmpq

from ..algebra.trig import Formula, Space, constant
from ..reading.submission import Submission
from ..steps.conventions import Convention, conventions
from ..steps.families import Choices, family
from ..steps.mechanism import Mechanism

Said = tuple[str, str]  # English, Japanese
MOST_LINKS_FREE = 6  # links up to which every convention is tried; beyond, the zero of the angles alone


@dataclass(frozen=True)
class Variant:
    """What the letters m and I mean. ``given``: what symbols of the derivation stand for, by place."""

    choices: Choices = field(default_factory=Choices)
    given: dict[int, Formula] = field(default_factory=dict)
    assumes: tuple[Said, ...] = ()


@dataclass(frozen=True)
class Hypothesis:
    """A mechanism in a convention, and what it assumes."""

    mechanism: Mechanism
    convention: Convention
    variant: Variant
    assumes: tuple[Said, ...] = ()

    @property
    def is_plain(self) -> bool:
        """Whether nothing is assumed."""
        return not self.assumes


def variants(s: Submission) -> list[Variant]:
    """What masses and moments of inertia may mean, the author's own symbols first."""
    letters = {letter for letter, _ in s.used}
    if s.kind in ("n-leg", "point-masses", "mechanism"):
        return [Variant()]
    space, centre = s.space, "c" in letters or s.kind == "links"
    densities = {3 * s.space.n + k: space.rho * space.l(k) for k in range(space.n)}
    masses: list[Variant] = [Variant(Choices(centre=centre))]
    if s.kind == "rod-chain" and "r" in letters:
        masses = [Variant(Choices(density=True, centre=centre), densities)]
    elif s.kind == "rod-chain" and "m" in letters and s.space.n > 1:
        english = f"m = ρ l, so that {_ratios(space.n)}; for rods of independent masses it is wrong"
        japanese = "m = ρ l（線密度が等しい）。質量が独立な棒では誤り"
        masses.append(Variant(Choices(density=True, centre=centre), densities, ((english, japanese),)))
    elif s.kind == "rod-chain":
        masses = [Variant(Choices(density=True, centre=centre), densities)]
    if "I" not in letters and s.kind != "links":
        return masses
    return [made for about in ("centre", "pivot", "value") for v in masses for made in _inertias(s, v, about)]


def _ratios(n: int) -> str:
    return " = ".join(f"m{k}/l{k}" for k in range(1, n + 1))


def _inertias(s: Submission, v: Variant, about: str) -> Iterator[Variant]:
    choices, space, n = v.choices, s.space, s.space.n
    named = " and ".join(f"I{k}" for k in range(1, n + 1)) if n < 4 else "I"
    if about == "centre":
        yield Variant(Choices(choices.density, "centre", choices.centre), v.given, v.assumes)
    elif about == "pivot":
        what = "is the moment of inertia about the pivot" if n == 1 else "are moments of inertia about the joints"
        says = f"{named} {what}"
        said = (says, f"{named} は軸（関節）まわりの慣性モーメント")
        yield Variant(Choices(choices.density, "pivot", choices.centre), v.given, (*v.assumes, said))
    elif s.kind != "links":
        for part, where, wo in ((12, "centre of mass", "重心"), (3, "joint", "関節")):
            values = {}
            for k in range(n):
                mass = space.rho * space.l(k) if choices.density else space.m(k)
                values[space.names.index(f"I{k + 1}")] = (mass * space.l(k) * space.l(k)).times(fmpq(1, part))
            said = (f"I = m l²/{part}, about the {where}", f"I = m l²/{part}（{wo}まわり）")
            yield Variant(choices, {**v.given, **values}, (*v.assumes, said))


def hypotheses(s: Submission, *, pinned: bool = False) -> Iterator[Hypothesis]:
    """Everything that the derivation may mean without special values. ``pinned``: nothing is assumed."""
    choices = variants(s)
    if pinned:
        choices = [v for v in choices if not v.assumes] or choices[:1]
    for convention in _conventions(s, pinned):
        for variant in choices:
            assumes = variant.assumes
            if convention != s.convention:
                assumes = ((convention.words, convention.words_ja), *assumes)
            if s.mechanism is not None:
                mechanism = s.mechanism.mechanism(convention)
            else:
                mechanism = family(s.kind, s.space, convention, variant.choices).with_values(merged(s, variant))
            if s.weight is not None:
                mechanism = replace(mechanism, weight=s.weight)
            yield Hypothesis(mechanism, convention, variant, assumes)


def _conventions(s: Submission, pinned: bool) -> Iterator[Convention]:
    if pinned:
        yield s.convention
        return
    free_origin = "from" not in s.declared
    slides = s.mechanism is not None and any(body.slide is not None for body in s.mechanism.bodies)
    found = conventions(
        s.convention,
        s.space.n,
        free_frame="angles" not in s.declared,
        free_origin=free_origin,
        has_sides=slides or "sense" in s.declared,
    )
    for convention in found:
        if "sense" in s.declared and convention.senses != s.convention.senses:
            continue
        if s.space.n > MOST_LINKS_FREE and (
            convention.relative != s.convention.relative or convention.senses or convention.origin == "right"
        ):
            continue
        yield convention


def merged(s: Submission, variant: Variant) -> dict[int, Formula]:
    """All lengths, all masses as the first, where the derivation has one symbol for them."""
    n, space = s.space.n, s.space
    values: dict[int, Formula] = {}
    if s.equal_lengths or (s.equal_masses and variant.choices.density):
        values |= {2 * n + k: space.l(0) for k in range(1, n)}
    if s.equal_masses:
        values |= {3 * n + k: space.m(0) for k in range(1, n)}
    return values


def absent(s: Submission, mechanism: Mechanism) -> list[int]:
    """The places of the mechanism's parameters that the derivation never mentions."""
    used = {_place(s.space, letter, max(index, 1) - 1) for letter, index in s.used if letter in "lmgrIc"}
    return sorted(mechanism.parameters - used)


def _place(space: Space, letter: str, k: int) -> int:
    names = {"l": f"l{k + 1}", "m": f"m{k + 1}", "g": "g", "r": "rho", "I": f"I{k + 1}", "c": f"lc{k + 1}"}
    return space.names.index(names[letter])


def simple_values(s: Submission, places: list[int]) -> list[dict[int, Formula]]:
    """Values that people leave out: equal masses; everything one; what is missing as large as what is there."""
    n, space = s.space.n, s.space
    one = constant(1)
    masses = [p for p in places if 3 * n <= p < 4 * n]
    out: list[dict[int, Formula]] = []
    if masses and len(masses) < len(places):
        out.append(dict.fromkeys(masses, one))
    out.append(dict.fromkeys(places, one))
    twins: dict[int, Formula] = {}
    for start in (2 * n, 3 * n):
        there = [p for p in range(start, start + n) if (space.names[p][0], p - start + 1) in s.used]
        if there:
            twins |= {p: space.symbol(there[0]) for p in places if start <= p < start + n}
    if twins:
        out.append({**dict.fromkeys(places, one), **twins})
    return out


def value_words(space: Space, values: dict[int, Formula], per_gravity: bool = False) -> Said:
    """ "l1 = l2 = 1 and m1 : m2 = 2 : 1 (a special case)"; ``per_gravity``: lengths are known over g alone."""
    n = space.n
    masses = {p: f for p, f in values.items() if 3 * n <= p < 4 * n}
    ratio = len(masses) == n and all(f.is_number() for f in masses.values())
    groups: dict[tuple[str, str], list[str]] = {}
    free = {space.names.index("rho")} | (set(masses) if ratio else set())  # their size does not matter
    free |= {4 * n} if per_gravity else set()
    for place in sorted(values):
        if place not in free:
            name = space.names[place] + ("/g" if per_gravity and space.names[place][0] == "l" else "")
            groups.setdefault((space.names[place][0], _value(space, values[place])), []).append(name)
    parts = [" = ".join([*names, value]) for (_, value), names in sorted(groups.items())]
    if ratio and n > 1:
        names = [space.names[p] for p in sorted(masses)]
        equal = len({f.number() for f in masses.values()}) == 1
        parts.append(" = ".join(names) if equal else f"{' : '.join(names)} = {_ratio(masses)}")
    parts = parts or ["all parameters are one"]
    return " and ".join(parts) + " (a special case)", "、".join(parts) + "（特別な場合）"


def _ratio(masses: dict[int, Formula]) -> str:
    numbers = [masses[p].number() for p in sorted(masses)]
    common = lcm(*(int(x.q) for x in numbers))
    whole = [int((x * common).p) for x in numbers]
    return " : ".join(str(x // gcd(*whole)) for x in whole)


def _value(space: Space, f: Formula) -> str:
    """A number, as a decimal where it is one, or a symbol's name."""
    if not f.is_number():
        return space.names[min(space.places(f))]
    x = f.number()
    decimal = str(int(x.p) / int(x.q))
    return decimal if x.q != 1 and len(decimal) <= 8 else str(x)
