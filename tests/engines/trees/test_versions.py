"""What differs between versions of MuJoCo, in the plainest objects that have it."""

from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("mujoco")
from furiko.engines.trees.mujoco import _set_linear


def test_a_damping_is_one_number_or_the_first_of_a_polynomials():
    """MuJoCo 3.3.7 has a float there, 3.17.0 and 4.0.0 an array of three."""
    number, polynomial = SimpleNamespace(damping=0.0), SimpleNamespace(damping=np.zeros(3))
    _set_linear(number, "damping", 0.12)
    _set_linear(polynomial, "damping", 0.12)
    assert number.damping == 0.12
    assert polynomial.damping.tolist() == [0.12, 0.0, 0.0]
