"""Slips with brackets: a factor that multiplies a part of its bracket alone, or more than its bracket.

l (a + b + c) has become l a + b + c, (M + m) ẍ has become M + m ẍ, and l (a + b) + c has become l (a + b + c). What is
lost may be any factor that terms of a sum have in common, and which of them lost it is not known: all choices are left
to whoever tries them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from flint import fmpq

from ...algebra.trig import COS, ONE, Formula, Key, Space, digits, unit

MOST_FACTORS = 120  # of one sum
MOST_DIVISORS = 24  # of what two terms have in common
MOST_NUMBERS = 3  # that a factor may have before it, beside 1
Symbols = tuple[int, tuple[int, int]]  # packed exponents, and a wave


@dataclass(frozen=True)
class Bracket:
    """A ``factor``, terms of a sum that may have lost it (or, where it is ``late``, gained it), and what that adds.

    ``whole``: all of them but one, or none.
    """

    factor: Formula
    terms: tuple[Formula, ...]
    changes: tuple[Formula, ...]
    late: bool = False
    whole: bool = False


def brackets(space: Space, f: Formula) -> Iterator[Bracket]:
    """Every factor that terms have in common: a symbol, several, cos or sin of an angle, with a number; and a sign."""
    exponents = {key: digits(key[0], space.symbol_count) for key in f.terms}
    factors = _factors(f, exponents)[:MOST_FACTORS]
    groups = [(symbols, _having(space, symbols, exponents)) for symbols in ((0, (0, COS)), *factors)]
    for symbols, having in groups:
        for number in _numbers(f, having, symbols):
            if len(having) > 1:
                yield _early(f, symbols, number, having)
    still = [key for key in f.terms if not space.accelerations(key[0])]
    if len(still) > 2:
        terms = tuple(Formula({key: f.terms[key]}) for key in still)
        yield Bracket(Formula({(0, 0, COS): -ONE}), terms, tuple(t.times(-2) for t in terms), whole=True)
    for symbols, having in groups[1:]:
        without = [key for key in f.terms if key not in having]
        factor = Formula({(symbols[0], *symbols[1]): ONE})
        terms = tuple(Formula({key: f.terms[key]}) for key in without)
        yield Bracket(factor, terms, tuple(t * factor - t for t in terms), late=True)


def _early(f: Formula, symbols: Symbols, number: fmpq, having: list[Key]) -> Bracket:
    e, wave = symbols
    terms = [Formula({key: f.terms[key]}) for key in having]
    rests: list[Key] = [(key[0] - e, 0, COS) if wave[0] else (key[0] - e, key[1], key[2]) for key in having]
    changes = [Formula({rest: f.terms[key] / number}) - t for rest, key, t in zip(rests, having, terms, strict=True)]
    return Bracket(Formula({(e, *wave): number}), tuple(terms), tuple(changes))


def _numbers(f: Formula, having: list[Key], symbols: Symbols) -> list[fmpq]:
    """What may stand before the symbols: 1, where there are some, and the sizes of the terms' coefficients."""
    sizes = dict.fromkeys(abs(f.terms[key]) for key in having)
    return [*([ONE] if symbols != (0, (0, COS)) else []), *[x for x in sizes if x != 1][:MOST_NUMBERS]]


def _having(space: Space, symbols: Symbols, exponents: dict[Key, tuple[int, ...]]) -> list[Key]:
    e, wave = symbols
    powers = [(place, power) for place, power in enumerate(digits(e, space.symbol_count)) if power]
    return [
        key for key, mine in exponents.items()
        if all(mine[place] >= power for place, power in powers) and wave in ((0, COS), key[1:])
    ]  # fmt: skip


def _factors(f: Formula, exponents: dict[Key, tuple[int, ...]]) -> list[Symbols]:
    """Single symbols first, then waves, then all that two terms have in common."""
    symbols = {unit(place): None for powers in exponents.values() for place, power in enumerate(powers) if power > 0}
    waves = {key[1:]: None for key in f.terms if key[1]}
    shared: dict[Symbols, None] = {}
    for (one, mine), (other, theirs) in combinations(exponents.items(), 2):
        common = {k: min(x, y) for k, (x, y) in enumerate(zip(mine, theirs, strict=True)) if x > 0 and y > 0}
        for e in _divisors(common):
            if e not in symbols:
                shared[e, (0, COS)] = None
            if one[1:] == other[1:] != (0, COS):
                shared[e, one[1:]] = None
    return [*((e, (0, COS)) for e in symbols), *((0, wave) for wave in waves), *shared]


def _divisors(powers: dict[int, int]) -> list[int]:
    """All products of symbols, packed, that divide one; the largest first, and no more than some."""
    found = [0]
    for place, power in powers.items():
        found = [e + k * unit(place) for e in found for k in range(power, -1, -1)]
        if len(found) > MOST_DIVISORS:
            break
    return [e for e in found[:MOST_DIVISORS] if e]
