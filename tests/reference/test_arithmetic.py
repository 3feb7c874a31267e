"""The one text in four arithmetics, and what the namespace adds to operators."""

import subprocess
import sys

import numpy as np
import pytest
from flint import arb
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.models import NLegPendulum, RodChain
from furiko.reference import literal_accelerations
from furiko.reference.arithmetic import (
    arithmetic_of,
    balls,
    components,
    floats,
    heyoka_arithmetic,
    sum_after,
    sympy_arithmetic,
)
from furiko.reference.documents import equations_of_motion as motion
from furiko.reference.truth.enclosures import enclosed_accelerations, precision

STAR = NLegPendulum((1.0, 0.8, 0.6), (1.0, 0.5, 2.0))
CHAIN = RodChain((1.0, 0.8, 0.6), 1.3)
SYSTEMS = pytest.mark.parametrize("system", [STAR, CHAIN], ids=["star", "chain"])
THETA, OMEGA = np.array([2.0, -0.7, 1.1]), np.array([0.5, -3.0, 2.0])


@SYSTEMS
def test_sympy_evaluates_to_the_truth(system):
    import sympy

    xp = sympy_arithmetic()
    found = literal_accelerations(system, xp.array(THETA), xp.array(OMEGA))
    truth = enclosed_accelerations(system, THETA, OMEGA)
    for value, high, low in zip(found, truth.high, truth.low, strict=True):
        exact = sympy.Rational(high) + sympy.Rational(low)
        assert abs(sympy.N(value - exact, 40)) < 1e-28  # a double-double holds 32 digits


@SYSTEMS
def test_heyoka_compiles_to_the_truth(system):
    import heyoka

    xp = heyoka_arithmetic()
    theta = np.array(heyoka.make_vars("t1", "t2", "t3"), dtype=object)
    omega = np.array(heyoka.make_vars("w1", "w2", "w3"), dtype=object)
    found = literal_accelerations(system, theta, omega)
    assert xp.name == "heyoka"
    function = heyoka.cfunc([*found], vars=[*theta, *omega], fp_type=heyoka.real128)
    values = function(np.array([heyoka.real128(x) for x in (*THETA, *OMEGA)]))
    truth = enclosed_accelerations(system, THETA, OMEGA)
    difference = np.array(
        [
            float(v - heyoka.real128(h) - heyoka.real128(l))
            for v, h, l in zip(values, truth.high, truth.low, strict=True)
        ]
    )
    # some hundred operations with 113 bits; constants rounded to double would show as 1e-16
    assert np.max(np.abs(difference)) < 1e-30


@SYSTEMS
@given(seed=st.integers(0, 10_000))
@settings(max_examples=30, deadline=None)
def test_doubles_and_longdoubles_stay_near_the_truth(system, seed):
    generator = np.random.default_rng(seed)
    theta, omega = generator.uniform(-3, 3, (4, 3)), generator.normal(size=(4, 3))
    truth = enclosed_accelerations(system, theta, omega)
    condition = np.linalg.cond(motion.mass_matrix(system, theta))
    size = np.abs(truth.high).max(-1)
    for dtype in (np.float64, np.longdouble):
        found = literal_accelerations(system, theta.astype(dtype), omega.astype(dtype))
        assert found.dtype == dtype
        error = np.abs((found - truth.high) - truth.low).max(-1)
        # forward error of a solve: a few n ε cond; the right side's own terms may be ten times their sum
        assert np.all(error <= 100 * float(np.finfo(dtype).eps) * condition * np.maximum(size, 10))


@SYSTEMS
def test_balls_enclose_what_more_bits_give(system):
    theta, omega = np.array([THETA, -2 * THETA]), np.array([OMEGA, OMEGA / 3])
    with precision(53):
        xp = balls()
        wide = literal_accelerations(system, xp.array(theta), xp.array(omega))
    with precision(400):
        narrow = literal_accelerations(system, xp.array(theta), xp.array(omega))
        assert all(a.contains(b) for a, b in zip(wide.ravel(), narrow.ravel(), strict=True))


def test_arithmetic_is_told_by_the_elements():
    import heyoka
    import sympy

    assert arithmetic_of(THETA, OMEGA).name == "float64"
    assert arithmetic_of(THETA, OMEGA.astype(np.longdouble)).name == np.dtype(np.longdouble).name
    assert arithmetic_of(THETA.astype(int)).name == "float64"
    assert arithmetic_of(np.array([0, arb(1)], dtype=object)).name == "balls"
    assert arithmetic_of(np.array([sympy.Symbol("x")], dtype=object)).name == "sympy"
    assert arithmetic_of(np.array([heyoka.expression("x")], dtype=object)).name == "heyoka"
    with pytest.raises(TypeError, match="str"):
        arithmetic_of(np.array(["x"], dtype=object))


def test_importing_the_theory_costs_no_heavy_library():
    heavy = "flint", "sympy", "heyoka", "scipy", "numba", "mpmath", "mujoco", "pinocchio", "exudyn"
    found = subprocess.run(
        [sys.executable, "-c", "import furiko.reference, furiko.reference.truth, sys; print(*sys.modules)"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert not set(found.stdout.split()) & set(heavy)


def test_numbers_are_taken_for_exactly_what_they_are():
    assert balls().array([0.1])[0].is_exact()
    assert balls().array([0.1])[0] == arb(0.1)
    tenth = sympy_arithmetic().array([0.1])[0]
    assert (tenth.p, tenth.q) == (0.1).as_integer_ratio()
    assert str(heyoka_arithmetic().array([0.1])[0]).startswith("0.10000000000000000555")


@pytest.mark.parametrize("xp", [floats(), floats(np.longdouble), balls()], ids=["float64", "longdouble", "balls"])
def test_differences_of_angles(xp):
    theta = np.random.default_rng(3).uniform(-3, 3, (2, 5))
    cos, sin = (np.asarray(part, dtype=float) for part in xp.cos_sin_differences(xp.array(theta)))
    difference = theta[:, :, None] - theta[:, None, :]
    np.testing.assert_allclose(cos, np.cos(difference), rtol=0, atol=4e-16)
    np.testing.assert_allclose(sin, np.sin(difference), rtol=0, atol=4e-16)


def test_sums_after_and_components():
    x = np.arange(1.0, 9.0).reshape(4, 2)
    np.testing.assert_array_equal(sum_after(x, axis=-2), [[15, 18], [12, 14], [7, 8], [0, 0]])
    np.testing.assert_array_equal(sum_after(np.array([1.0, 2.0, 3.0])), [5, 3, 0])
    first, second = components(x)
    np.testing.assert_array_equal(first, [1, 3, 5, 7])
    np.testing.assert_array_equal(second, [2, 4, 6, 8])


def test_solving_without_pivots_and_with_structural_zeros():
    import sympy

    generator = np.random.default_rng(5)
    root = generator.normal(size=(3, 6, 6))
    matrix = (root @ root.swapaxes(-1, -2) + np.eye(6)) * generator.uniform(0.1, 10, (6, 1))
    x = generator.normal(size=(3, 6))
    right = (matrix @ x[..., None])[..., 0]
    for dtype, close in ((np.float64, 1e-11), (np.longdouble, 1e-11)):  # right is rounded to double in both
        xp = floats(dtype)
        np.testing.assert_allclose(xp.solve(xp.array(matrix), xp.array(right)).astype(float), x, rtol=0, atol=close)
    xp = sympy_arithmetic()
    arrow = xp.zeros((3, 3))
    arrow[0] = xp.array([4, 1, 2])
    arrow[1, :2] = xp.array([1, 3])
    arrow[2, 0], arrow[2, 2] = xp.array([2, 5])
    solved = xp.solve(arrow, xp.array([1, 2, 3]))
    dense = sympy.Matrix([[4, 1, 2], [1, 3, 0], [2, 0, 5]])
    assert list(solved) == list(dense.LUsolve(sympy.Matrix([1, 2, 3])))
