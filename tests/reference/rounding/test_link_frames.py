"""What is known of an engine's operations, held against what the engine computes."""

import numpy as np
import pytest

from furiko.engines import load_engine
from furiko.models import RodChain, find_scene
from furiko.reference.rounding import spread
from furiko.reference.rounding.lever_arms import differences_lost


@pytest.mark.parametrize("seed", range(4))
def test_places_from_mjcf_lose_what_pinocchios_have_lost(seed):
    random = np.random.default_rng(seed)
    chain = RodChain(tuple(10 ** random.uniform(-2, 1) * random.uniform(0.1, 1, 20)))
    hinges = load_engine("pinocchio-aba-mjcf", chain).fields().hinges[:, 0]
    given = np.array([link.hinge[0] for link in chain.tree().links])
    lost = np.array(differences_lost(chain.tree()))
    np.testing.assert_array_equal(hinges, given + lost)
    assert lost.any()


@pytest.mark.parametrize("scene", ["rods-3-length-ratio", "rods-20", "n-leg-8"])
def test_articulated_bodies_are_modelled_operation_by_operation(make_cell, scene):
    """A link a thousand times shorter than the next shows each operation that is missing: 31 times the spread, once.

    A model that has them all is off by the few times that a random number is its root mean square, in 900 entries.
    """
    cell = make_cell("pinocchio-aba", find_scene(scene), 300)
    facts, states = cell.facts, cell.states
    size = spread.accelerations(cell.info, cell.scene.system, cell.amplitude, states.theta, states.omega, facts.high)
    quotient = np.abs(facts.error(cell.accelerations())) / size
    assert quotient.max() < 6
    assert np.median(quotient) > 0.1
