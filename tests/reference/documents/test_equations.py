"""Every numbered equation against first principles, at random rational points, to 40 digits.

Two expressions that differ agree at a random point to 40 digits with no probability worth naming.
"""

import inspect
from fractions import Fraction
from functools import cache

import mpmath
import numpy as np
import pytest
import sympy
from first_principles import DIGITS, chain, star
from flint import arb, fmpq

from furiko import reference
from furiko.reference import EQUATIONS, MISPRINTS, SHIKI, SLIPS, TAKENO
from furiko.reference.arithmetic import balls
from furiko.reference.documents import shiki, takeno
from furiko.reference.truth.enclosures import precision

LENGTHS = [Fraction(11, 10), Fraction(7, 10), Fraction(9, 10), Fraction(13, 10)]
MASSES = [Fraction(6, 5), Fraction(1, 2), Fraction(9, 4), Fraction(4, 5)]
GRAVITY, DENSITY = Fraction(981, 100), Fraction(13, 10)
BITS = 256
CLOSE = 1e-40  # numbers here are of size 1 to 1000 and known to 60 digits


def ball(x):
    if isinstance(x, Fraction):
        return arb(fmpq(x.numerator, x.denominator))
    with mpmath.workdps(DIGITS):
        return arb(mpmath.nstr(x, DIGITS) if isinstance(x, mpmath.mpf) else x)


def array(values):
    values = np.array(values, dtype=object)
    result = np.empty(values.size, dtype=object)
    result[:] = [ball(x) for x in values.ravel()]
    return result.reshape(values.shape)


def assert_close(found, expected):
    found, expected = np.broadcast_arrays(np.asarray(found, dtype=object), np.asarray(expected, dtype=object))
    for a, b in zip(found.ravel(), expected.ravel(), strict=True):
        assert abs(arb(a) - arb(b)) < CLOSE, f"{a} where {b} is right"


@cache
def shiki_values(n, seed):
    """Every symbol of chapters 1 to 3 at a point, and what the equations should come to, by first principles."""
    with precision(BITS):
        l, m = LENGTHS[:n], MASSES[:n]
        f, found = star(l, m, GRAVITY, seed)
        alpha = found.pop("alpha")
        numbers = {name: array(f.numbers(value, alpha)) for name, value in found.items()}
        e = array([1] * n)
        states = {
            "xp": balls(), "l": array(l), "m": array(m), "g": ball(GRAVITY), "e": e,
            "theta": array([f.state[t] for t in f.theta]), "omega": array([f.state[w] for w in f.omega]),
            "alpha": array(alpha),
        }  # fmt: skip
        A = numbers["mass_matrix"] / states["l"][:, None]
        B = numbers["squared_rates"] * states["omega"] ** 2 / states["l"][:, None]
        B[range(n), range(n)] = numbers["gravity"] / states["l"]
        return {**states, **numbers, "A": A, "B": B}


@cache
def takeno_values(n, seed, equal=False):
    with precision(BITS):
        l = [LENGTHS[0]] * n if equal else LENGTHS[:n]
        f, found = chain(l, DENSITY, GRAVITY, seed)
        alpha = found.pop("alpha")
        numbers = {name: array(f.numbers(value, alpha)) for name, value in found.items()}
        theta, omega = array([f.state[t] for t in f.theta]), array([f.state[w] for w in f.omega])
        length, rho, g = array(l), ball(DENSITY), ball(GRAVITY)
        # coefficients of p(θ_k) in a position: its derivative by θ_k, along q(θ_k)
        by_angle = array([[_quotient(f, point[0].diff(t), sympy.cos(t)) for t in f.theta] for point in found["centre"]])
        mass = numbers["mass"]
        b = np.array(
            [
                mass[j] * by_angle[j] + 2 * sum((mass[i] * by_angle[i] for i in range(j + 1, n)), array([0] * n))
                for j in range(n)
            ]
        )
        scale = rho * length
        A, B = numbers["mass_matrix"] / scale[:, None], numbers["squared_rates"] / scale[:, None]
        xp = balls()
        cos = xp.cos(theta[:, None] - theta)
        return {
            **numbers,
            "xp": xp, "l": length, "rho": rho, "m": mass, "g": g, "I": numbers["inertia"],
            "theta": theta, "omega": omega, "alpha": array(alpha),
            "T": numbers["forces"], "r_hat": numbers["position"], "r": numbers["centre"],
            "a": by_angle, "b": b, "A": A, "B": B, "alpha_jk": A / cos / length,
            "L": numbers["gravity"] / (scale * g * xp.sin(theta)),
        }  # fmt: skip


def _quotient(f, above, below):
    with mpmath.workdps(DIGITS):
        return f.number(above) / f.number(below)


def stacked(*parts):
    return np.stack(parts)


SHIKI_EXPECTED = {
    "1": lambda v: v["position"],
    "2": lambda v: v["speed_squared"][0],
    "3": lambda v: v["speed_squared"][1],
    "4": lambda v: v["lagrangian"],
    "6": lambda v: stacked(v["momentum"], v["momentum_rate"]),
    "7": lambda v: v["dL_dtheta"],
}
CHAPTER_2 = {
    **{key: SHIKI_EXPECTED[key] for key in "123"},
    "4": lambda v: v["speed_squared"][2],
    "5": lambda v: v["lagrangian"],
    "7": SHIKI_EXPECTED["6"],
    "8": SHIKI_EXPECTED["7"],
}
EXPECTED = {
    **{f"1.{key}": value for key, value in SHIKI_EXPECTED.items()},
    **{f"2.{key}": value for key, value in CHAPTER_2.items()},
    **{f"3.{key}": value for key, value in SHIKI_EXPECTED.items() if key != "3"},
    "3.3": lambda v: v["speed_squared"][1:],
    "1.11": lambda v: v["alpha"],
    "2.12": lambda v: v["alpha"],
    "3.11": lambda v: stacked(v["alpha"], v["e"]),
    "3.12": lambda v: stacked(v["A"], v["B"]),
    "1": lambda v: v["r_hat"],
    "2": lambda v: v["r"],
    "5": lambda v: v["I"],
    "8": lambda v: v["T"][:-1],
    "10": lambda v: v["r"],
    "11": lambda v: v["a"],
    "12": lambda v: v["L"],
    "15": lambda v: v["b"],
    "20": lambda v: v["alpha_jk"],
    "21": lambda v: stacked(v["A"], v["B"]),
}
COUNTS = {"1": [2], "2": [3], "3": [2, 4]}


def cases():
    for equation in EQUATIONS:
        counts = COUNTS[equation.number[0]] if equation.document == "shiki" else [1, 3]
        for n in [2] if equation.label == "Takeno (19)" else counts:
            yield pytest.param(equation, n, id=f"{equation.label} n={n}")


def values_for(equation, n, seed=1):
    if equation.document == "shiki":
        return shiki_values(n, seed)
    return takeno_values(n, seed, equal=equation.number == "19")


@pytest.mark.slow
@pytest.mark.parametrize(("equation", "n"), list(cases()))
def test_equation_holds(equation, n):
    values = values_for(equation, n)
    with precision(BITS):
        members = equation.members(values)
        for member in members[1:]:
            assert_close(member, members[0])
        if equation.number in EXPECTED:
            for member in members:
                assert_close(member, EXPECTED[equation.number](values))
        else:
            assert len(members) > 1, "nothing to hold this equation against"


@pytest.mark.slow
@pytest.mark.parametrize("equation", MISPRINTS, ids=lambda equation: equation.label)
def test_misprint_differs_from_its_correction(equation):
    n = {"2.1": 3, "3.4": 4, "12": 3}[equation.number]
    values = {**values_for(equation, n), "index": 0}
    with precision(BITS):
        printed = equation.printed_members(values)
        worst = max(
            float(abs(arb(a) - arb(b)))
            for a, b in zip(
                np.asarray(printed[-1], dtype=object).ravel(),
                np.asarray(equation.members(values)[-1], dtype=object).ravel(),
                strict=True,
            )
        )
    assert worst > 0.01


def test_misprints_show_where_they_should_and_nowhere_else():
    assert [equation.label for equation in MISPRINTS] == ["Shiki (2.1)", "Shiki (3.4)", "Takeno (12)"]
    values = shiki_values(3, 1)
    with precision(BITS):
        (wrong,) = shiki.eq_2_1_printed(values["xp"], values["l"], values["theta"])
        assert_close(wrong[:2], values["position"][:2])
        # as printed, mass 3 hangs on a rod of length l₂
        leg = wrong[2] - wrong[0]
        assert_close((leg**2).sum(), values["l"][1] ** 2)
        speeds = {name: values[name] for name in ("xp", "l", "m", "g", "theta", "omega", "speed_squared")}
        first, second = shiki.eq_3_4_printed(**speeds)
        assert_close(first, values["lagrangian"])
        m1, l1, w1 = values["m"][0], values["l"][0], values["omega"][0]
        assert_close(second - first, m1 * w1**2 * (1 - l1**2) / 2)


def test_takeno_12_as_printed_is_right_for_equal_lengths_alone():
    equal = takeno_values(2, 1, equal=True)
    with precision(BITS):
        assert_close(takeno.eq_12_printed(equal["l"], index=1)[0], equal["L"])
        unequal = takeno_values(3, 1)
        for index in range(3):
            (printed,) = takeno.eq_12_printed(unequal["l"], index=index)
            assert any(not abs(a - b) < 1e-3 for a, b in zip(printed, unequal["L"], strict=True))


def test_shiki_3_11_leaves_e_open_and_only_1_will_do():
    values = dict(shiki_values(4, 1))
    with precision(BITS):
        left, right = shiki.eq_3_10(*(values[name] for name in ("xp", "A", "B", "e", "alpha")))
        assert_close(left, right)
        values["e"] = array([1, 1, 2, 1])
        left, right = shiki.eq_3_10(*(values[name] for name in ("xp", "A", "B", "e", "alpha")))
        assert not all(abs(a - b) < 1e-3 for a, b in zip(left.ravel(), right.ravel(), strict=True))


def test_a_wrong_equation_would_be_seen():
    values = dict(takeno_values(3, 1))
    with precision(BITS):
        values["L"] = values["L"] * (1 + arb(2) ** -100)
        left, zero = TAKENO[17].members(values)
        with pytest.raises(AssertionError):
            assert_close(left, zero)


def test_index_holds_all_57_in_order_each_its_own_function():
    numbers = [equation.number for equation in SHIKI]
    assert numbers == [f"{c}.{k}" for c, last in ((1, 11), (2, 12), (3, 12)) for k in range(1, last + 1)]
    assert [equation.number for equation in TAKENO] == [str(k) for k in range(1, 23)]
    assert len(EQUATIONS) == 57
    for equation in EQUATIONS:
        name = "eq_" + equation.number.replace(".", "_")
        assert equation.function.__name__ == name
        assert inspect.getdoc(equation.function).startswith(f"({equation.number})")
        assert equation.symbols == tuple(inspect.signature(equation.function).parameters)
        assert (equation.printed is None) == (equation.printed_formula == "") == (equation.correction == "")
        if equation.printed:
            assert equation.printed.__name__ == name + "_printed"
    # the unnumbered coefficients b_jk between Takeno (14) and (15)
    values = takeno_values(3, 1)
    with precision(BITS):
        assert_close(takeno.b_of_a(values["m"], values["a"]), values["b"])
        assert_close(
            takeno.p_second_derivative(*(values[name] for name in ("xp", "theta", "omega", "alpha"))), values["p_ddot"]
        )


def test_slips_name_both_documents():
    assert {slip.document for slip in SLIPS} == {"shiki", "takeno"}
    assert all(slip.printed != slip.right for slip in reference.SLIPS)
