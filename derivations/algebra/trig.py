"""Exact polynomials in accelerations, rates and parameters whose coefficients are trigonometric sums of the angles.

Every formula of a planar pendulum is one: a finite sum of

    rational · (product of powers of α, ω, l, m, g, ρ) · (cos or sin of Σ h_k θ_k / 2),

and these functions are linearly independent over the rationals once each h has its first sign fixed (its last nonzero
entry is positive) and sin 0 is left out. So two formulas are equal exactly when their tables of terms are equal: the
trigonometric identities need no rules, products become sums as they are multiplied out, and nothing is "simplified".

Exponents and harmonics are packed into one integer each, sixteen bits a symbol, signed digits: adding exponents is
adding integers. Powers may be negative (l, m, g, ρ in a denominator).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from struct import unpack

from flint import fmpq

BITS = 16
DIGIT = (1 << BITS) - 1
MIDDLE = 1 << (BITS - 1)
LARGEST_POWER = MIDDLE // 2  # |digit| up to here cannot carry when two are added

COS, SIN = 0, 1
Key = tuple[int, int, int]  # exponents, harmonics in half angles, COS or SIN

ONE, HALF, ZERO = fmpq(1), fmpq(1, 2), fmpq(0)


class Formula:
    """An immutable sum of terms; ``terms`` maps each key to its nonzero rational coefficient."""

    __slots__ = ("terms",)

    def __init__(self, terms: dict[Key, fmpq] | None = None) -> None:
        self.terms: dict[Key, fmpq] = {} if terms is None else terms

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __len__(self) -> int:
        return len(self.terms)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Formula) and self.terms == other.terms

    def __hash__(self) -> int:
        return hash(frozenset(self.terms.items()))

    def __add__(self, other: Formula) -> Formula:
        small, large = (self, other) if len(self.terms) < len(other.terms) else (other, self)
        terms = dict(large.terms)
        for key, c in small.terms.items():
            _accumulate(terms, key, c)
        return Formula(terms)

    def __sub__(self, other: Formula) -> Formula:
        terms = dict(self.terms)
        for key, c in other.terms.items():
            _accumulate(terms, key, -c)
        return Formula(terms)

    def __neg__(self) -> Formula:
        return Formula({key: -c for key, c in self.terms.items()})

    def __mul__(self, other: Formula) -> Formula:
        terms: dict[Key, fmpq] = {}
        for (e1, h1, s1), c1 in self.terms.items():
            for (e2, h2, s2), c2 in other.terms.items():
                e, c = e1 + e2, c1 * c2
                if not h2 and not s2:
                    _accumulate(terms, (e, h1, s1), c)
                elif not h1 and not s1:
                    _accumulate(terms, (e, h2, s2), c)
                else:
                    _product_to_sum(terms, e, c * HALF, (h1, s1), (h2, s2))
        return Formula(terms)

    def times(self, factor: fmpq | int) -> Formula:
        """The formula times a rational number."""
        if not factor:
            return Formula()
        return Formula({key: c * factor for key, c in self.terms.items()})

    def power(self, exponent: int) -> Formula:
        """The formula to a whole power ≥ 0."""
        result, base = CONSTANT_ONE, self
        while exponent:
            if exponent & 1:
                result = result * base
            exponent >>= 1
            if exponent:
                base = base * base
        return result

    def degree(self) -> int:
        """The largest power of a symbol, or multiple of an angle, in any term."""
        largest = 0
        for e, h, _ in self.terms:
            for packed in (e, h):
                shifted = packed + _bias(packed.bit_length() // BITS + 2)
                while shifted:
                    largest = max(largest, abs((shifted & DIGIT) - MIDDLE))
                    shifted >>= BITS
        return largest

    def is_number(self) -> bool:
        """Whether nothing but a rational number is left."""
        return not self.terms or (len(self.terms) == 1 and (0, 0, COS) in self.terms)

    def number(self) -> fmpq:
        """The rational number that the formula is; meaningful only where :meth:`is_number` holds."""
        return self.terms.get((0, 0, COS), ZERO)

    def is_monomial(self) -> bool:
        """Whether it is a single product of symbols, without an angle: what may be divided by at once."""
        return len(self.terms) == 1 and next(iter(self.terms))[1:] == (0, COS)

    def inverse_monomial(self) -> Formula:
        """1 over the formula, which is a single product of symbols."""
        ((e, _, _), c), *_ = self.terms.items()
        return Formula({(-e, 0, COS): 1 / c})


def _accumulate(terms: dict[Key, fmpq], key: Key, c: fmpq) -> None:
    old = terms.get(key)
    if old is None:
        terms[key] = c
        return
    new = old + c
    if new:
        terms[key] = new
    else:
        del terms[key]


def _harmonic(terms: dict[Key, fmpq], e: int, h: int, s: int, c: fmpq) -> None:
    """Add c · cos or sin(h) with the sign of h fixed: the last nonzero digit of a packed number carries its sign."""
    if h < 0:
        h, c = -h, (-c if s else c)
    if h or not s:
        _accumulate(terms, (e, h, s), c)


def _product_to_sum(terms: dict[Key, fmpq], e: int, c: fmpq, one: tuple[int, int], two: tuple[int, int]) -> None:
    (h1, s1), (h2, s2) = one, two
    if s1 and s2:  # sin A sin B = (cos(A-B) - cos(A+B)) / 2
        _harmonic(terms, e, h1 - h2, COS, c)
        _harmonic(terms, e, h1 + h2, COS, -c)
    elif s1:  # sin A cos B = (sin(A+B) + sin(A-B)) / 2
        _harmonic(terms, e, h1 + h2, SIN, c)
        _harmonic(terms, e, h1 - h2, SIN, c)
    elif s2:  # cos A sin B = (sin(A+B) - sin(A-B)) / 2
        _harmonic(terms, e, h1 + h2, SIN, c)
        _harmonic(terms, e, h1 - h2, SIN, -c)
    else:  # cos A cos B = (cos(A-B) + cos(A+B)) / 2
        _harmonic(terms, e, h1 - h2, COS, c)
        _harmonic(terms, e, h1 + h2, COS, c)


CONSTANT_ONE = Formula({(0, 0, COS): ONE})
NOTHING = Formula()


def constant(value: int | fmpq) -> Formula:
    """A rational number as a formula."""
    return Formula({(0, 0, COS): fmpq(value)}) if value else NOTHING


def digits(packed: int, count: int) -> tuple[int, ...]:
    """The signed digits of a packed number."""
    shifted = (packed + _bias(count)) & ((1 << (BITS * count)) - 1)
    return tuple([x - MIDDLE for x in unpack(f"<{count}H", shifted.to_bytes(BITS // 8 * count, "little"))])


def digit(packed: int, place: int) -> int:
    """One signed digit of a packed number."""
    return (((packed + _bias(place + 1)) >> (BITS * place)) & DIGIT) - MIDDLE


@cache
def _bias(count: int) -> int:
    return sum(MIDDLE << (BITS * i) for i in range(count))


def unit(place: int) -> int:
    """The packed number whose only digit is a 1 at ``place``."""
    return 1 << (BITS * place)


@dataclass(frozen=True)
class Space:
    """The symbols of a system of ``n`` coordinates and the place of each in a packed exponent.

    Order: α₁…αₙ, ω₁…ωₙ (together the *motion*), l₁…lₙ, m₁…mₙ, g, ρ; then, in a space made by :meth:`general`, the
    coordinates themselves where they stand outside cos and sin, q₁…qₙ, and the author's own symbols. So a formula of
    the plain space is one of the general space, digit for digit. Indices count from 0 here.
    """

    n: int
    extra: tuple[str, ...] = ()

    @staticmethod
    def general(n: int, own: tuple[str, ...] = ()) -> Space:
        """A space with coordinates outside cos and sin (of slides and springs), and with the symbols ``own``."""
        return Space(n, (*(f"q{k}" for k in range(1, n + 1)), *own))

    @cached_property
    def names(self) -> tuple[str, ...]:
        """ASCII name of each symbol, in order of place."""
        indexed = [f"{letter}{i}" for letter in "awlm" for i in range(1, self.n + 1)]
        return (*indexed, "g", "rho", *self.extra)

    @property
    def symbol_count(self) -> int:
        """How many symbols there are."""
        return 4 * self.n + 2 + len(self.extra)

    @cached_property
    def first_sign(self) -> int:
        """The place of the first of the signs of rates (:mod:`.signs`), which stand together; 0 where there is none."""
        return next((4 * self.n + 2 + k for k, name in enumerate(self.extra) if name.startswith("sgn(")), 0)

    def own(self, name: str) -> Formula:
        """A symbol of ``extra`` by its name."""
        return self.symbol(self.own_place(name))

    def own_place(self, name: str) -> int:
        """Where it stands: behind the coordinates there, since one of the author's may be called q1 too."""
        return 4 * self.n + 2 + self.extra.index(name, self.n)

    def q(self, k: int) -> Formula:
        """Coordinate k outside cos and sin; only in a general space."""
        return self.symbol(4 * self.n + 2 + k)

    def symbol(self, place: int) -> Formula:
        """The symbol at a place."""
        return Formula({(unit(place), 0, COS): ONE})

    def a(self, k: int) -> Formula:
        """α_k, an angular acceleration."""
        return self.symbol(k)

    def w(self, k: int) -> Formula:
        """ω_k, an angular rate."""
        return self.symbol(self.n + k)

    def l(self, k: int) -> Formula:  # noqa: E743 -- the documents' letter
        """l_k."""
        return self.symbol(2 * self.n + k)

    def m(self, k: int) -> Formula:
        """m_k."""
        return self.symbol(3 * self.n + k)

    @property
    def g(self) -> Formula:
        """The gravitational acceleration."""
        return self.symbol(4 * self.n)

    @property
    def rho(self) -> Formula:
        """The line density ρ of rods."""
        return self.symbol(4 * self.n + 1)

    def cos(self, angle: Mapping[int, int]) -> Formula:
        """cos Σ angle[k]·θ_k with whole coefficients."""
        return self.wave({k: 2 * c for k, c in angle.items()}, COS)

    def sin(self, angle: Mapping[int, int]) -> Formula:
        """sin Σ angle[k]·θ_k with whole coefficients."""
        return self.wave({k: 2 * c for k, c in angle.items()}, SIN)

    def wave(self, halves: Mapping[int, int], phase: int) -> Formula:
        """cos or sin of Σ halves[k]·θ_k/2."""
        terms: dict[Key, fmpq] = {}
        _harmonic(terms, 0, sum(h << (BITS * k) for k, h in halves.items()), phase, ONE)
        return Formula(terms)

    def by_rate(self, f: Formula, k: int) -> Formula:
        """∂f/∂ω_k."""
        return self.by_symbol(f, self.n + k)

    def by_symbol(self, f: Formula, place: int) -> Formula:
        """∂f/∂(symbol at place)."""
        terms: dict[Key, fmpq] = {}
        for (e, h, s), c in f.terms.items():
            power = digit(e, place)
            if power:
                _accumulate(terms, (e - unit(place), h, s), c * power)
        return Formula(terms)

    def by_angle(self, f: Formula, k: int) -> Formula:
        """∂f/∂θ_k, of a coordinate outside cos and sin as well."""
        terms: dict[Key, fmpq] = dict(self.by_symbol(f, 4 * self.n + 2 + k).terms) if self.extra else {}
        for (e, h, s), c in f.terms.items():
            half = digit(h, k)
            if half:
                _accumulate(terms, (e, h, 1 - s), c * fmpq(half if s else -half, 2))
        return Formula(terms)

    def by_time(self, f: Formula) -> Formula:
        """df/dt of a formula in angles and rates: Σ ∂f/∂θ_k ω_k + ∂f/∂ω_k α_k."""
        result = NOTHING
        for k in range(self.n):
            result = result + self.by_angle(f, k) * self.w(k) + self.by_rate(f, k) * self.a(k)
        return result

    @cached_property
    def motion_mask(self) -> int:
        """Selects the exponents of accelerations and rates of a packed exponent that was biased."""
        return (1 << (BITS * 2 * self.n)) - 1

    def motion(self, e: int) -> int:
        """The packed exponents of accelerations and rates alone."""
        bias = _bias(2 * self.n)
        return ((e + bias) & self.motion_mask) - bias

    def accelerations(self, e: int) -> int:
        """The packed exponents of accelerations alone."""
        bias = _bias(self.n)
        return ((e + bias) & ((1 << (BITS * self.n)) - 1)) - bias

    def outside(self, e: int) -> int:
        """The packed exponents of coordinates outside cos and sin alone."""
        places = range(4 * self.n + 2, 5 * self.n + 2) if self.extra else ()
        return sum(digit(e, place) << (BITS * place) for place in places)

    def split(self, f: Formula) -> dict[int, Formula]:
        """The coefficient of each product of accelerations and rates, keyed by that product's packed exponents."""
        parts: dict[int, dict[Key, fmpq]] = {}
        for (e, h, s), c in f.terms.items():
            q = self.motion(e)
            parts.setdefault(q, {})[(e - q, h, s)] = c
        return {q: Formula(terms) for q, terms in parts.items()}

    def join(self, parts: Mapping[int, Formula]) -> Formula:
        """The formula whose coefficients :meth:`split` gives."""
        terms: dict[Key, fmpq] = {}
        for q, f in parts.items():
            for (e, h, s), c in f.terms.items():
                _accumulate(terms, (e + q, h, s), c)
        return Formula(terms)

    def monomials(self, f: Formula) -> Iterator[tuple[tuple[int, ...], tuple[int, ...], int, fmpq]]:
        """Each term as (exponents, harmonics in half angles, COS or SIN, coefficient)."""
        for (e, h, s), c in f.terms.items():
            yield digits(e, self.symbol_count), digits(h, self.n), s, c

    def substitute_angles(self, f: Formula, columns: tuple[Mapping[int, int], ...]) -> Formula:
        """Put θ_k = Σ columns[k][j]·θ'_j, and the same for rates and accelerations."""
        result = NOTHING
        for (e, h, s), c in f.terms.items():
            q = self.motion(e)
            product = Formula({(e - q, 0, COS): c})
            powers = digits(q, 2 * self.n)
            for place, power in enumerate(powers):
                if power:
                    product = product * self._combination(columns[place % self.n], place // self.n).power(power)
            halves: dict[int, int] = {}
            for k, half in enumerate(digits(h, self.n)):
                for j, factor in columns[k].items():
                    halves[j] = halves.get(j, 0) + half * factor
            result = result + product * self.wave(halves, s)
        return result

    def _combination(self, column: Mapping[int, int], kind: int) -> Formula:
        result = NOTHING
        for j, factor in column.items():
            result = result + self.symbol(kind * self.n + j).times(factor)
        return result

    def replace(self, f: Formula, values: Mapping[int, Formula]) -> Formula:
        """The symbols at these places replaced by formulas; where one stands in a denominator, by a single product."""
        result: dict[Key, fmpq] = {}
        for (e, h, s), c in f.terms.items():
            term = Formula({(e, h, s): c})
            for place, value in values.items():
                power = digit(e, place)
                if power:
                    left = Formula({(e2 - unit(place) * power, h2, s2): c2 for (e2, h2, s2), c2 in term.terms.items()})
                    term = left * (value.power(power) if power > 0 else value.inverse_monomial().power(-power))
            for key, c2 in term.terms.items():
                _accumulate(result, key, c2)
        return Formula(result)

    def places(self, f: Formula) -> set[int]:
        """The places of the symbols that occur in a formula."""
        found: set[int] = set()
        for e in {e for e, _, _ in f.terms}:
            found.update(place for place, power in enumerate(digits(e, self.symbol_count)) if power)
        return found

    def rename(self, f: Formula, places: Mapping[int, int]) -> Formula:
        """Every symbol at a place in ``places`` replaced by the symbol at the place that it is mapped to."""
        terms: dict[Key, fmpq] = {}
        for (e, h, s), c in f.terms.items():
            new = e
            for old, target in places.items():
                power = digit(e, old)
                new += power * (unit(target) - unit(old))
            _accumulate(terms, (new, h, s), c)
        return Formula(terms)
