"""The states of a scene: seeded by its name, the same everywhere, exact as differences."""

import itertools
from fractions import Fraction

import numpy as np
import pytest

from furiko.models import NLegPendulum, RodChain, find_scene
from furiko.models.scene import NAMED_STATES, scene_from_toml
from furiko.models.states import named_state, natural_rate, random_states, states

SYSTEM = RodChain([1.0, 0.5, 0.25])


def test_states_depend_on_the_name_alone():
    a, b = random_states("a", SYSTEM, 20), random_states("a", SYSTEM, 20)
    assert np.array_equal(a[0], b[0])
    assert np.array_equal(a[1], b[1])
    assert not np.array_equal(a[0], random_states("b", SYSTEM, 20)[0])


def test_the_first_states_of_many_are_those_of_few():
    few, many = random_states("a", SYSTEM, 5), random_states("a", SYSTEM, 200)
    assert np.array_equal(few[0], many[0][:5])
    assert np.array_equal(few[1], many[1][:5])


def test_differences_of_neighbouring_random_angles_are_exact():
    theta, omega = random_states("a", SYSTEM, 50)
    for values in (theta, omega):
        for row in values:
            for a, b in itertools.pairwise(row):
                assert Fraction(float(b - a)) == Fraction(float(b)) - Fraction(float(a))


@pytest.mark.parametrize("system", [SYSTEM, NLegPendulum([1, 1], [1, 1], gravity=0)])
@pytest.mark.parametrize("word", NAMED_STATES)
def test_every_named_state_exists(word, system):
    theta, omega = named_state(word, system)
    assert theta.shape == omega.shape == (system.n,)
    assert np.isfinite(theta).all()
    assert np.isfinite(omega).all()


def test_a_state_without_a_name_is_refused():
    with pytest.raises(ValueError, match="sideways"):
        named_state("sideways", SYSTEM)


def test_given_named_and_random_states_stand_in_this_order():
    found = states(find_scene("double-pendulum"))
    assert found.labels[0] == "given"
    assert found.theta[0].tolist() == [2.0, 2.5]
    assert found.labels[1:7] == NAMED_STATES
    assert found.labels[-1] == "random 199"
    assert found.theta.shape == found.omega.shape == (207, 2)


def test_a_scene_may_ask_for_its_own_state_alone():
    text = '[system]\nkind="rod-chain"\nlengths=[1]\n[state]\ntheta=[1]\n[samples]\nrandom=0\nnamed=[]\n'
    assert states(scene_from_toml(text, "x")).labels == ("given",)


def test_natural_rate_is_that_of_the_longest_way_down():
    assert natural_rate(RodChain([1.0, 3.0], gravity=16.0)) == 2.0
    assert natural_rate(NLegPendulum([1.0, 3.0, 2.0], [1, 1, 1], gravity=16.0)) == 2.0
    assert natural_rate(RodChain([1.0], gravity=0.0)) == 1.0
