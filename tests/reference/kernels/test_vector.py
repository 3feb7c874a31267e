"""Vectors of eight in compiled code, against numpy's own arithmetic on the same numbers."""

import math

import numpy as np
import pytest
from numba import njit

from furiko.reference.kernels import elimination
from furiko.reference.kernels.compiling import OPTIONS, inlined
from furiko.reference.kernels.sincos import sincos
from furiko.reference.kernels.vector import EIGHT, fma, load, magnitude, maximum, store

ROWS = np.random.default_rng(0).normal(size=(4, EIGHT))


@njit
def each_operation(rows, number, out):
    a, b = load(rows, 0), load(rows, 1)
    store(out, 0, a + b)
    store(out, 1, a - number)
    store(out, 2, number * b)
    store(out, 3, number / a)
    a += b
    store(out, 4, -a)
    store(out, 5, magnitude(b))
    store(out, 6, maximum(load(rows, 0), b))
    store(out, 7, number)
    store(out, 8, a * 2 + 1)


def test_arithmetic_of_vectors_is_that_of_their_numbers():
    out = np.empty((9, EIGHT))
    each_operation(ROWS, 0.3, out)
    a, b = ROWS[:2]
    wanted = [a + b, a - 0.3, 0.3 * b, 0.3 / a, -(a + b), np.abs(b), np.maximum(a, b), np.full(8, 0.3), (a + b) * 2 + 1]
    np.testing.assert_array_equal(out, wanted)


@njit
def multiplied_and_added(rows, out):
    store(out, 0, fma(load(rows, 0), load(rows, 1), load(rows, 2)))
    store(out, 1, fma(load(rows, 0), 3.0, -1.0))


def test_a_multiplication_and_an_addition_are_rounded_once():
    rows = np.full((3, EIGHT), [[1 + 2.0**-30], [1 - 2.0**-30], [-1.0]])
    out = np.empty((2, EIGHT))
    multiplied_and_added(rows, out)
    np.testing.assert_array_equal(out[0], -(2.0**-60))  # exactly; rounded twice it is 0
    np.testing.assert_array_equal(out[1], 3 * rows[0] - 1)


@njit
def sines(rows, out):
    s, c = sincos(load(rows, 0), load(rows, 1))
    store(out, 0, s)
    store(out, 1, c)


@pytest.mark.parametrize("first", [-3.0, 0.0, 1e5])
def test_sine_and_cosine_in_every_quadrant(first):
    rows = np.zeros((2, EIGHT))
    rows[0] = first + np.arange(EIGHT)
    out = np.empty((2, EIGHT))
    sines(rows, out)
    wanted = [[f(x) for x in rows[0]] for f in (math.sin, math.cos)]
    np.testing.assert_allclose(out, wanted, rtol=0, atol=2.5e-16)  # what sincos promises


absorb_rod = inlined(elimination.absorb_rod)


@njit(**OPTIONS)
def absorbed(rows, out):
    found = absorb_rod(1.5, load(rows, 0), load(rows, 1), 0.5, 2.0, load(rows, 2), 0.0, load(rows, 3))
    store(out, 0, found[0])
    store(out, 1, found[3])
    store(out, 2, found[5])


def test_a_function_for_numbers_compiles_for_vectors():
    out = np.empty((3, EIGHT))
    absorbed(ROWS, out)
    found = elimination.absorb_rod(1.5, ROWS[0], ROWS[1], 0.5, 2.0, ROWS[2], 0.0, ROWS[3])
    # fused or not, each is a few roundings of terms of size 10 at most
    np.testing.assert_allclose(out, [found[0], found[3], found[5]], rtol=0, atol=1e-14)


@njit
def of_numbers(row, out):
    store(out, 1, load(row, 2) + 1.0)


def test_of_a_row_of_numbers_one_is_read_and_written():
    out = np.zeros(3)
    of_numbers(np.arange(4.0), out)
    np.testing.assert_array_equal(out, [0, 3, 0])
