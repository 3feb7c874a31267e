import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.engines.coordinates import RelativeCoordinates

some = settings(deadline=None, max_examples=60)


@st.composite
def trees(draw):
    n = draw(st.integers(1, 12))
    parents = [-1] + [draw(st.integers(-1, i - 1)) for i in range(1, n)]
    return parents, draw(st.permutations(range(n)))


def states(draw, n, rows=3):
    """Multiples of 2^-40 below 2^10: sums of a dozen of them need no rounding."""
    numbers = st.integers(-(2**50), 2**50).map(lambda k: k * 2.0**-40)
    return np.array(draw(st.lists(st.lists(numbers, min_size=n, max_size=n), min_size=rows, max_size=rows)))


@some
@given(st.data())
def test_each_hinge_turns_by_the_difference_of_the_angles_beside_it(data):
    parents, columns = data.draw(trees())
    theta = states(data.draw, len(parents))
    relative = RelativeCoordinates(parents, columns).relative(theta)
    for link, parent in enumerate(parents):
        before = theta[:, parent] if parent >= 0 else 0.0
        np.testing.assert_array_equal(relative[:, columns[link]], theta[:, link] - before)


@some
@given(st.data())
def test_there_and_back_is_exact_for_quantised_angles(data):
    parents, columns = data.draw(trees())
    theta = states(data.draw, len(parents))
    coordinates = RelativeCoordinates(parents, columns)
    np.testing.assert_array_equal(coordinates.absolute(coordinates.relative(theta)), theta)


@some
@given(st.data())
def test_forces_do_the_same_work_in_both_coordinates(data):
    parents, columns = data.draw(trees())
    n = len(parents)
    integers = st.lists(st.integers(-1000, 1000), min_size=n, max_size=n).map(lambda row: np.array([row], dtype=float))
    omega, torques = data.draw(integers), data.draw(integers)
    coordinates = RelativeCoordinates(parents, columns)
    # Whole numbers: the products and sums are exact.
    assert (coordinates.absolute_forces(torques) * omega).sum() == (torques * coordinates.relative(omega)).sum()


def test_no_rows_stay_no_rows():
    coordinates = RelativeCoordinates([-1, 0, 0])
    assert coordinates.absolute(coordinates.relative(np.empty((0, 3)))).shape == (0, 3)
    assert coordinates.absolute_forces(np.empty((0, 3))).shape == (0, 3)


def test_what_is_given_is_left_as_it_was():
    theta = np.array([[1.0, 3.0]])
    coordinates = RelativeCoordinates([-1, 0])
    for change in (coordinates.relative, coordinates.absolute, coordinates.absolute_forces):
        change(theta)
        np.testing.assert_array_equal(theta, [[1.0, 3.0]])
