"""Columns of states to lanes and back, against numpy's own indexing."""

import numpy as np
import pytest
from numba import njit

from furiko.models import NLegPendulum, RodChain
from furiko.models.errors import InvalidInput
from furiko.reference.kernels import forward_dynamics as kernels
from furiko.reference.kernels import lanes
from furiko.reference.kernels.compiling import aligned
from furiko.reference.limits import LARGEST_ANGLE, LARGEST_RATE

LANES = 16
STRIDE = 2 * LANES
UNTOUCHED = -7.0


@njit
def read(states, row, first, count, scratch):
    lanes.read_columns(states, row, first, count, scratch, 3, STRIDE, LANES)


@njit
def write(scratch, states, row, first, count):
    lanes.write_columns(scratch, 3, STRIDE, states, row, first, count, LANES)


@njit
def address(count):
    return aligned(count).ctypes.data


CASES = [(width, first, min(8, width - first)) for width in (*range(1, 11), 16, 21) for first in range(0, width, 8)]


@pytest.mark.parametrize(("width", "first", "count"), CASES)
def test_columns_to_lanes(width, first, count):
    states = np.arange(3.0 * LANES * width).reshape(-1, width)
    scratch = np.full(3 + 8 * STRIDE, UNTOUCHED)
    read(states, 5, first, count, scratch)
    for k in range(8):
        own, between = np.split(scratch[3 + k * STRIDE : 3 + (k + 1) * STRIDE], [LANES])
        assert (between == UNTOUCHED).all()
        if k < count:
            np.testing.assert_array_equal(own, states[5 : 5 + LANES, first + k])


@pytest.mark.parametrize(("width", "first", "count"), CASES)
def test_lanes_to_columns_and_nowhere_else(width, first, count):
    scratch = np.arange(3.0 + 8 * STRIDE)
    states = np.full((LANES + 9, width), UNTOUCHED)
    write(scratch, states, 5, first, count)
    expected = np.full_like(states, UNTOUCHED)
    for k in range(count):
        expected[5 : 5 + LANES, first + k] = scratch[3 + k * STRIDE :][:LANES]
    np.testing.assert_array_equal(states, expected)


@pytest.mark.parametrize("count", [1, 7, 100, 4096])
def test_scratch_begins_with_a_line_of_the_cache(count):
    assert [address(count) % 64 for _ in range(20)] == [0] * 20


@pytest.mark.parametrize("system", [RodChain((1.0, 2.0)), RodChain((1.0, 9.0)), NLegPendulum((1.0, 2.0), (1.0, 2.0))])
@pytest.mark.parametrize("place", [(0, 0), (31, 1), (39, 1)])  # in a whole block and in a last one
def test_the_edge_of_what_is_accepted(system, place):
    """States are looked at in sums over their links: what lies beyond is never missed, what lies within is taken."""
    kernel = kernels.kernel_of(system)
    for which, largest in enumerate((LARGEST_ANGLE, LARGEST_RATE)):
        states = np.zeros((2, 40, 2))
        states[which] = 0.9 * largest
        states[(which, *place)] = -largest
        assert np.isfinite(kernel.batch(*states)).all()
        for beyond in (np.nextafter(largest, np.inf), np.inf, np.nan):
            states[(which, *place)] = beyond
            with pytest.raises(InvalidInput, match=rf"{('theta', 'omega')[which]}\[{place[0]}, {place[1]}\]"):
                kernel.batch(*states)
