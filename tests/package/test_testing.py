"""The assertions that furiko offers to other projects' tests."""

import math
import re

import numpy as np
import pytest

from furiko import InvalidInput, NLegPendulum, RodChain, to_mjcf, to_urdf
from furiko.testing import assert_accelerations, assert_model_matches

G = 9.81
ROD = RodChain([2.0], gravity=G)
DOUBLE = NLegPendulum((1.0, 0.5), (1.0, 2.0), G)


def rod(theta, omega, g=G):
    # A uniform rod on its end, length l = 2: (m l²/3) θ̈ = -m g (l/2) sin θ.
    return -1.5 * g / 2.0 * np.sin(theta)


def double(theta, omega, g=G, sign=1.0, m2=2.0):
    # Two point masses on massless rods, Lagrange's equations solved by Cramer's rule.
    l1, l2, m1 = 1.0, 0.5, 1.0
    d = theta[:, 0] - theta[:, 1]
    a, b, c = (m1 + m2) * l1**2, m2 * l1 * l2 * np.cos(d), m2 * l2**2
    f1 = -m2 * l1 * l2 * np.sin(d) * omega[:, 1] ** 2 - (m1 + m2) * g * l1 * np.sin(theta[:, 0])
    f2 = sign * m2 * l1 * l2 * np.sin(d) * omega[:, 0] ** 2 - m2 * g * l2 * np.sin(theta[:, 1])
    det = a * c - b * b
    return np.stack([(f1 * c - f2 * b) / det, (a * f2 - b * f1) / det], axis=-1)


def test_right_accelerations_pass():
    assert_accelerations(ROD, rod)
    assert_accelerations(DOUBLE, double)
    assert_accelerations(DOUBLE, double, rtol=1e-12)  # well above rounding, cond(M) is below 100
    assert_accelerations(ROD, rod, states=([0.3], [1.0]))


def test_what_is_wrong_is_told_with_its_cause():
    with pytest.raises(AssertionError) as error:
        assert_accelerations(ROD, lambda theta, omega: rod(theta, omega, 9.8))
    assert "gravity at" in str(error.value)
    assert "9.8" in str(error.value)


def test_state_link_expected_and_got_are_told():
    def wrong(theta, omega):
        return rod(theta, omega) * 1.5

    with pytest.raises(AssertionError) as error:
        assert_accelerations(ROD, wrong, states=([[0.0], [math.pi / 2]], [[0.0], [2.0]]))
    # At π/2: -(3/2) (9.81/2) = -7.3575, and half as much again -11.03625.
    told = str(error.value).splitlines()[0]
    said = re.fullmatch(
        r"wrong: acceleration of link 1 of 1 in state 'states\[1\]': expected (\S+), got (\S+) rad/s²", told
    )
    assert [float(number) for number in said.groups()] == pytest.approx([-7.3575, -11.03625], rel=1e-15)
    assert "omega = [2.0]" in str(error.value)


def test_a_flipped_sign_of_a_velocity_term_fails_and_is_invisible_at_rest():
    def flipped(theta, omega):
        return double(theta, omega, sign=-1.0)

    assert_accelerations(DOUBLE, flipped, states=([[0.3, 0.9]], [[0.0, 0.0]]))
    with pytest.raises(AssertionError, match="link 2 of 2"):
        assert_accelerations(DOUBLE, flipped, states=([[0.3, 0.9]], [[3.0, 0.0]]))


def test_the_bound_is_that_of_rounding():
    def off(theta, omega):
        return double(theta, omega) * (1 + 1e-12)

    with pytest.raises(AssertionError, match="rounding explains"):
        assert_accelerations(DOUBLE, off)
    assert_accelerations(DOUBLE, off, rtol=1e-10)
    with pytest.raises(AssertionError, match="rtol is 1e-13"):
        assert_accelerations(DOUBLE, off, rtol=1e-13)


@pytest.mark.parametrize(
    ("fn", "says"),
    [
        (lambda theta, omega: theta[:, :1], r"shape \(\d+, 1\) returned, \(\d+, 2\) expected"),
        (lambda theta, omega: theta * np.nan, "NaN or infinite, first in state 'hanging'"),
        (lambda theta, omega: None, "not an array|shape"),
    ],
)
def test_no_acceleration_is_told(fn, says):
    with pytest.raises(AssertionError, match=says):
        assert_accelerations(DOUBLE, fn)


def test_what_the_function_does_to_its_arguments_is_its_own():
    def spoils(theta, omega):
        found = double(theta, omega)
        theta[:] = omega[:] = 0.0
        return found

    assert_accelerations(DOUBLE, spoils)


@pytest.mark.parametrize(
    "arguments",
    [
        {"rtol": 0.0},
        {"rtol": math.nan},
        {"states": ([0.1], [0.1])},
        {"states": ([math.inf] * 2, [0.0] * 2)},
        {"coordinates": "maximal"},
    ],
)
def test_bad_arguments_are_refused(arguments):
    with pytest.raises(InvalidInput):
        assert_accelerations(DOUBLE, double, **arguments)


@pytest.fixture
def files(tmp_path):
    def write(name, system):
        path = tmp_path / name
        path.write_text((to_urdf if name.endswith("urdf") else to_mjcf)(system), encoding="utf-8")
        return path

    return write


def test_two_files_of_one_mechanism_match_whatever_the_order(files):
    a, b = files("a.urdf", RodChain([1.0, 0.5], gravity=9.8)), files("b.xml", RodChain([1.0, 0.5], gravity=9.8))
    assert_model_matches(a, b)
    assert_model_matches(str(b), str(a))
    assert_model_matches(a, b, engines=["pinocchio-aba"])


def test_the_number_that_differs_is_told(files):
    a, b = files("a.urdf", RodChain([1.0, 0.5])), files("b.xml", RodChain([1.0, 0.75]))
    for one, other in ((a, b), (b, a)):
        with pytest.raises(AssertionError) as error:
            assert_model_matches(one, other)
        # A rod's mass is density × length, its inertia m l²/12: they are not the same either.
        assert f"{a} does not match {b}:" in str(error.value)
        assert "0.5" in str(error.value)
        assert "0.75" in str(error.value)


def test_a_file_that_is_not_there_is_refused(files, tmp_path):
    with pytest.raises(InvalidInput):
        assert_model_matches(files("a.xml", ROD), tmp_path / "none.xml")
