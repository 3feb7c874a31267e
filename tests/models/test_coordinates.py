"""Absolute and relative values of a tree: against the matrix of the definition, and there and back."""

import numpy as np
import pytest

from furiko.models.coordinates import (
    absolute_from_relative,
    forces_to_absolute,
    forces_to_relative,
    to_absolute,
    to_relative,
)

TREES = [(-1,), (-1, 0, 1, 2), (-1, 0, 0, 0), (-1, 0, 1, 0, -1, 4, 1)]


def whole_numbers(parents, *shape):
    return np.random.default_rng(len(parents)).integers(-9, 9, (*shape, len(parents))).astype(float)


@pytest.mark.parametrize("parents", TREES)
def test_an_absolute_angle_is_the_sum_of_the_relative_ones_on_its_path(parents):
    matrix = absolute_from_relative(parents)
    for link, row in enumerate(matrix):
        path = [link]
        while parents[path[-1]] >= 0:
            path.append(parents[path[-1]])
        np.testing.assert_array_equal(np.flatnonzero(row), sorted(path))
    q = whole_numbers(parents, 2, 3)
    np.testing.assert_array_equal(to_absolute(parents, q), q @ matrix.T)
    np.testing.assert_array_equal(to_relative(parents, to_absolute(parents, q)), q)


@pytest.mark.parametrize("parents", TREES)
def test_forces_follow_the_transposed_rule(parents):
    matrix, forces = absolute_from_relative(parents), whole_numbers(parents, 3)
    np.testing.assert_array_equal(forces_to_relative(parents, forces), forces @ matrix)
    np.testing.assert_array_equal(forces_to_absolute(parents, forces_to_relative(parents, forces)), forces)


@pytest.mark.parametrize("change", [to_relative, to_absolute, forces_to_relative, forces_to_absolute])
def test_values_given_are_left_as_they_are(change):
    values = np.array([[1.0, 3.0]])
    assert change((-1, 0), values) is not values
    np.testing.assert_array_equal(values, [[1.0, 3.0]])
