"""What is known of an engine's operations, held against what the engine computes."""

import numpy as np
import pytest

from furiko.checks.comparisons import accelerations
from furiko.engines import load_engine
from furiko.models import NLegPendulum, RodChain, Scene, find_scene
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


SCENES = {
    "rods-20": find_scene("rods-20"),
    "n-leg-8": find_scene("n-leg-8"),
    # D (1/D) is not one at the tip, whose inertia is seven orders above that of the link that carries it.
    "unlike lengths": Scene("unlike lengths", RodChain((1.0, 0.01, 9.7))),
}


@pytest.mark.parametrize("scene", SCENES)
def test_articulated_bodies_are_modelled_operation_by_operation(make_cell, scene):
    """A link a thousand times shorter than the next shows each operation that is missing: 31 times the spread, once.

    A model that has them all is off by the few times that a random number is its root mean square, in 900 entries.
    """
    cell = make_cell("pinocchio-aba", SCENES[scene], 300)
    facts, states = cell.facts, cell.states
    size = spread.accelerations(cell.info, cell.scene.system, cell.amplitude, states.theta, states.omega, facts.high)
    quotient = np.abs(facts.error(cell.accelerations())) / size
    assert quotient.max() < 6
    assert np.median(quotient) > 0.1


def test_what_a_tip_leaves_when_its_joint_yields_is_not_sure_from_its_exact_inertia(make_cell):
    """Pinocchio's m l² is the next double: D (1/D) is not one there, which was 306 spreads without gravity."""
    pair = NLegPendulum(
        (5.657104818772004e-07, 2.150132739015506e-05), (16999.582765080584, 6001.260834677203), gravity=0.0
    )
    cell = make_cell("pinocchio-aba", Scene("the next double", pair), 100)
    (result,) = accelerations.compare(cell)
    assert (result.outcome, result.loose) == ("agrees", False), result
