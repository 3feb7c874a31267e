"""The right answers of the grader against the documents, against sympy, and against the theory's own functions."""

from dataclasses import replace

import numpy as np
import pytest
import sympy
from handwritten import (
    SHIKI_1_4,
    SHIKI_1_8,
    SHIKI_1_9,
    SHIKI_2_5,
    SHIKI_2_10,
    TAKENO_18,
    lagrangian,
    toml,
)

from furiko.derivations.algebra.fingerprint import point_of
from furiko.derivations.algebra.multiples import is_multiple
from furiko.derivations.algebra.symbols import KINDS, symbols_of
from furiko.derivations.algebra.trig import NOTHING, Space, constant
from furiko.derivations.grading.judge import Judge
from furiko.derivations.reading.submission import parse_submission
from furiko.derivations.steps.conventions import Convention
from furiko.derivations.steps.derivation import _newton_side, _row, correct_derivation, lagrange_rows
from furiko.derivations.steps.families import family
from furiko.derivations.steps.motion import ParameterValues, RowMotion
from furiko.models import NLegPendulum, RodChain
from furiko.reference import literal_accelerations


@pytest.mark.parametrize(
    ("system", "rows"),
    [("n-leg", SHIKI_1_9), ("n-leg", SHIKI_1_8), ("n-leg", SHIKI_2_10), ("rod-chain", TAKENO_18)],
)
def test_rows_are_the_documents_rows(system, rows):
    derived = correct_derivation(symbols_of(system, len(rows)))
    for (_, written), row in zip(parse_submission(toml(system, rows)).rows, derived.rows, strict=True):
        assert is_multiple(derived.space.split(written), row)


@pytest.mark.parametrize(("links", "formula"), [(2, SHIKI_1_4), (3, SHIKI_2_5)])
def test_the_lagrangian_is_the_documents(links, formula):
    written = parse_submission(lagrangian("n-leg", links, formula)).lagrangian
    assert written == correct_derivation(symbols_of("n-leg", links)).lagrangian()


@pytest.mark.parametrize("n", [2, 3, 5])
@pytest.mark.parametrize("kind", KINDS)
def test_newtons_road_leads_to_lagranges_rows(kind, n):
    d = correct_derivation(symbols_of(kind, n))
    for i in range(n):
        assert _row(d, i, _newton_side(d, i)) == d.rows[i]
    for i, row in enumerate(lagrange_rows(d.space, d.lagrangian())):
        assert is_multiple(d.space.split(row), d.rows[i])


@pytest.mark.parametrize("kind", KINDS)
def test_rows_are_sympys_lagrange_rows(kind):
    """Three angles, positions differentiated by sympy; compared at a rational point to 30 digits."""
    n = 3
    t, w, a, l, m = (sympy.symbols(f"{x}1:{n + 1}", real=True) for x in "twalm")
    g, rho = sympy.symbols("g rho")
    masses = [rho * x for x in l] if kind == "rod-chain" else m
    ends, energy = [(0, 0)], sympy.Integer(0)
    for k in range(n):
        x0, y0 = ends[k] if kind == "rod-chain" else ends[min(k, 1)]
        share = sympy.Rational(1, 2) if kind == "rod-chain" else 1
        x, y = x0 + share * l[k] * sympy.sin(t[k]), y0 - share * l[k] * sympy.cos(t[k])
        ends.append((x0 + l[k] * sympy.sin(t[k]), y0 - l[k] * sympy.cos(t[k])))
        vx, vy = (sum(p.diff(q) * r for q, r in zip(t, w, strict=True)) for p in (x, y))
        energy += masses[k] * (vx**2 + vy**2) / 2 - masses[k] * g * y
        if kind == "rod-chain":
            energy += masses[k] * l[k] ** 2 / 12 * w[k] ** 2 / 2
    numbers = {s: sympy.Rational(k + 2, 5) for k, s in enumerate([*t, *w, *a, *l, *m, g, rho])}
    mech = symbols_of(kind, n)
    names = [*a, *w, *l, *m, g, rho]
    for i, row in enumerate(correct_derivation(mech).rows):
        p = energy.diff(w[i])
        expected = sum(p.diff(q) * r + p.diff(r) * s for q, r, s in zip(t, w, a, strict=True)) - energy.diff(t[i])
        expected /= l[i] * rho if kind == "rod-chain" else l[i]
        found = sympy.Integer(0)
        for powers, halves, phase, c in mech.space.monomials(mech.space.join(row)):
            angle = sum(sympy.Rational(h, 2) * q for h, q in zip(halves, t, strict=True))
            term = sympy.Rational(int(c.p), int(c.q)) * (sympy.sin(angle) if phase else sympy.cos(angle))
            for symbol, power in zip(names, powers, strict=True):
                term *= symbol**power
            found += term
        assert abs((found - expected).subs(numbers).evalf(50)) < 1e-30


@pytest.mark.parametrize(
    "system",
    [NLegPendulum((1.0, 0.7, 1.3, 0.4), (0.5, 2.0, 1.0, 0.3)), RodChain((1.0, 0.6, 1.4, 0.8, 0.5), density=1.7)],
)
def test_numbers_are_the_theorys(system):
    """The exact rows with numbers put in, against the documents' final formulas in floats."""
    draw = np.random.default_rng(1)
    theta, omega = draw.uniform(-3, 3, (50, system.n)), draw.normal(0, 3, (50, system.n))
    m = symbols_of(system.kind, system.n)
    density = getattr(system, "density", 1.0)
    parameters = ParameterValues(system.lengths, system.masses if system.kind == "n-leg" else (), density)
    found = RowMotion(m, correct_derivation(m).rows, parameters).accelerations(theta, omega)
    # both solve a well-conditioned system of five unknowns in double precision
    np.testing.assert_allclose(found, literal_accelerations(system, theta, omega), rtol=1e-11, atol=1e-11)


def test_a_motion_keeps_the_small_swings_period():
    """One rod: the trajectory against the harmonic motion that a swing of 1e-4 rad is, to its cubic correction."""
    m = symbols_of("rod-chain", 1)
    rate = np.sqrt(1.5 * 9.81 / 1.2)
    times = np.linspace(0, 2, 401)
    angles = RowMotion(m, correct_derivation(m).rows, ParameterValues((1.2,))).trajectory(
        np.array([1e-4]), np.zeros(1), 2.0, 400
    )
    np.testing.assert_allclose(angles[:, 0], 1e-4 * np.cos(rate * times), atol=1e-10)


@pytest.mark.parametrize("weightless", [False, True])
@pytest.mark.parametrize("kind", ["rods", "point-masses"])
def test_values_put_into_the_rows_are_values_put_into_the_energies(kind, weightless):
    space = Space.general(2)
    values = {space.names.index("m2"): space.m(0).times(3), space.names.index("l1"): space.l(1) * space.g}
    values[space.names.index("l2")] = constant(2)  # in the one before as well
    plain = family(kind, space, Convention(relative=True))
    from_rows = plain.with_values(values)
    from_energies = replace(plain, values=values)  # which knows no rows without values
    if weightless:
        from_rows, from_energies = (replace(m, weight=NOTHING) for m in (from_rows, from_energies))
    assert from_rows.rows == from_energies.rows
    judge = Judge(parse_submission(toml("n-leg", SHIKI_1_9)))
    judge.space, judge.point = space, point_of(space)
    assert judge.right_numbers(from_rows) == from_energies.system.numbers
    moving = {space.names.index("m2"): space.m(0) * space.cos({0: 1})}  # of no meaning: yet the energies decide
    assert plain.with_values(moving).rows == replace(plain, values=moving).rows
    assert plain.with_values(moving).rows != tuple(space.replace(row, moving) for row in plain.rows)
