"""Accelerations of open mechanisms in units so small that numbers are subnormal: the same, or refused in words."""

import numpy as np
import pytest

from furiko.models import InvalidInput, find_scene
from furiko.reference.kernels.trees.dynamics import tree_accelerations
from furiko.studies.stress.trees import posed as made
from furiko.studies.stress.trees.axes import BASES, drawn


@pytest.mark.parametrize("base", BASES)
def test_masses_in_any_unit_give_the_same_accelerations_or_are_refused(base):
    """By dimensions masses' unit drops out; a factor of two is exact while no number is subnormal."""
    posed = drawn(find_scene(base), 1)
    usual = tree_accelerations(posed.system.mechanism(), posed.q, posed.v)
    refused = []
    for power in range(900, 1074, 3):
        small = made.smaller_masses(posed, 2.0**-power)
        try:
            found = tree_accelerations(small.system.mechanism(), small.q, small.v)
        except InvalidInput as error:
            refused.append(str(error))
            continue
        assert not refused, "refused where it is larger, and not where it is smaller"
        assert np.abs(found - usual).max() < 1e-13 * np.abs(usual).max()
    assert len(refused) > 5
    assert all("in a smaller unit" in reason or "singular" in reason for reason in refused)


def test_what_is_refused_says_which_number_is_too_small():
    posed = drawn(find_scene("cart-pole"), 1)
    small = made.smaller_lengths(posed, 2.0**-515)
    with pytest.raises(InvalidInput, match=r"a joint moves .*e-3.* kg m² .*give masses or lengths in a smaller unit"):
        tree_accelerations(small.system.mechanism(), small.q, small.v)
