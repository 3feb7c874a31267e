"""The exact algebra against sympy, which knows nothing of it."""

import random

import pytest
import sympy
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.derivations.algebra.fingerprint import PRIME, ROOT, RandomPoint
from furiko.derivations.algebra.trig import Formula, Space, constant, digit, digits, unit

SPACE = Space(3)
THETA = sympy.symbols("t1:4", real=True)
SYMBOLS = sympy.symbols(list(SPACE.names), positive=True)
ALL = st.integers(0, SPACE.symbol_count - 1)


def in_sympy(f):
    total = sympy.Integer(0)
    for powers, halves, phase, c in SPACE.monomials(f):
        angle = sum(sympy.Rational(h, 2) * t for h, t in zip(halves, THETA, strict=True))
        term = sympy.Rational(int(c.p), int(c.q)) * (sympy.sin(angle) if phase else sympy.cos(angle))
        for symbol, power in zip(SYMBOLS, powers, strict=True):
            term *= symbol**power
        total += term
    return total


POINT = {s: sympy.Rational(k + 3, 7) for k, s in enumerate([*SYMBOLS, *THETA])}


def same(f, expression):
    """At a rational point, to 40 digits: different sums agree there with no probability worth naming."""
    return abs((in_sympy(f) - expression).subs(POINT).evalf(60)) < sympy.Float(10) ** -40


@st.composite
def formulas(draw):
    f = Formula()
    for _ in range(draw(st.integers(1, 3))):
        term = constant(fmpq(draw(st.integers(-5, 5)), draw(st.integers(1, 4))))
        for _ in range(draw(st.integers(0, 3))):
            term = term * SPACE.symbol(draw(ALL))
        halves = {k: draw(st.integers(-3, 3)) for k in range(3)}
        f = f + term * SPACE.wave(halves, draw(st.integers(0, 1)))
    return f


@pytest.mark.slow
@settings(deadline=None, max_examples=15)
@given(formulas(), formulas())
def test_sums_products_and_differences_are_those_of_sympy(f, g):
    assert same(f + g, in_sympy(f) + in_sympy(g))
    assert same(f - g, in_sympy(f) - in_sympy(g))
    assert same(f * g, in_sympy(f) * in_sympy(g))
    assert same(f.power(3), in_sympy(f) ** 3)


@pytest.mark.slow
@settings(deadline=None, max_examples=20)
@given(formulas())
def test_derivatives_are_those_of_sympy(f):
    for k in range(3):
        assert same(SPACE.by_angle(f, k), in_sympy(f).diff(THETA[k]))
        assert same(SPACE.by_rate(f, k), in_sympy(f).diff(SYMBOLS[3 + k]))
    rate = sum(
        in_sympy(f).diff(THETA[k]) * SYMBOLS[3 + k] + in_sympy(f).diff(SYMBOLS[3 + k]) * SYMBOLS[k] for k in range(3)
    )
    assert same(SPACE.by_time(f), rate)


@settings(deadline=None, max_examples=60)
@given(formulas(), formulas())
def test_equal_formulas_have_equal_tables(f, g):
    assert (f + g) * (f - g) == f * f - g * g
    assert SPACE.join(SPACE.split(f)) == f


def test_trigonometric_identities_need_no_rule():
    s, c = SPACE.sin, SPACE.cos
    assert c({0: 1}) * c({0: 1}) + s({0: 1}) * s({0: 1}) == constant(1)
    assert s({0: 1, 1: -1}) == s({0: 1}) * c({1: 1}) - c({0: 1}) * s({1: 1})
    assert s({0: 1, 1: -1}) == -s({1: 1, 0: -1})
    assert c({0: 2}) == constant(1) - s({0: 1}).power(2).times(2)
    assert not s({})


def test_packed_digits_come_back():
    draw = random.Random(3)
    for _ in range(200):
        written = [draw.randrange(-500, 500) for _ in range(9)]
        packed = sum(x * unit(k) for k, x in enumerate(written))
        assert list(digits(packed, 9)) == written
        assert [digit(packed, k) for k in range(9)] == written


def test_the_prime_is_one_and_has_the_root():
    assert sympy.isprime(PRIME)
    assert pow(ROOT, 2, PRIME) == PRIME - 1


@settings(deadline=None, max_examples=40)
@given(formulas(), formulas())
def test_values_at_a_point_respect_sums_and_products(f, g):
    point = RandomPoint(SPACE)
    assert point.value(f * g) == point.value(f) * point.value(g) % PRIME
    assert point.value(f + g) == (point.value(f) + point.value(g)) % PRIME


@pytest.mark.parametrize("columns", [({0: 1}, {0: 1, 1: 1}, {0: 1, 1: 1, 2: 1}), ({0: 1}, {0: 1, 1: 1}, {0: 1, 2: 1})])
def test_other_angles_and_back(columns):
    f = SPACE.a(2) * SPACE.cos({1: 1, 2: -1}) + SPACE.w(1).power(2) * SPACE.sin({1: 1})
    back = ({0: 1}, {1: 1, 0: -1}, {2: 1, 1: -1}) if columns[2].get(1) else ({0: 1}, {1: 1, 0: -1}, {2: 1, 0: -1})
    assert SPACE.substitute_angles(SPACE.substitute_angles(f, columns), back) == f
