"""The sharp line of open mechanisms: sound engines are within it, and not far within; a small fault is loose."""

import numpy as np
import pytest
from score_trees import cells, quotients

from furiko.checks.trees import accelerations, sharp, terms
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import engine_info, load_tree_engine
from furiko.models import find_scene
from furiko.models.trees.states import tree_states

CATALOGUE = ("acrobot", "cart-pole", "hopper", "arm-7", "quadruped", "humanoid")
LAST = {"accelerations": (..., -1), "bias": (..., -1), "mass_matrix": (..., -1, -1)}
FACTORS = {"M": sharp.TERMS, "bias": sharp.TERMS, "G": sharp.TERMS}


def cell_of(scene, name, states, engine=None):
    scene = find_scene(scene)
    looked_at = tree_states(scene, states)
    facts = tree_facts(scene, looked_at, motion=False, slopes=False)
    return TreeCell(scene, engine_info(name), engine or load_tree_engine(name, scene.system), looked_at, facts)


def factor(cell, name):
    if name in FACTORS:
        return FACTORS[name]
    return sharp.ARTICULATED if cell.info.algorithm == "aba" else sharp.ACCELERATIONS


@pytest.mark.parametrize("scene", CATALOGUE[:4])
@pytest.mark.parametrize("name", ["mujoco", "pinocchio-aba", "pinocchio-aba-mjcf", "pinocchio-crba"])
def test_sound_engines_are_within_the_line_and_a_tenth_of_it_would_do_for_few(scene, name):
    """What is seen in a few dozen states is a part of the line, and not a hundredth: else it would say little."""
    cell = cell_of(scene, name, 30)
    for quantity, each in quotients(cell).items():
        part = float(each.max()) / factor(cell, quantity)
        assert part <= 1, quantity
        assert part >= 0.004, quantity


@pytest.mark.slow
@pytest.mark.parametrize("number", range(2000, 2012))
def test_sound_engines_are_within_the_line_on_random_mechanisms(number):
    for cell in cells(number):
        for quantity, each in quotients(cell).items():
            assert float(each.max()) <= factor(cell, quantity), (cell.info.name, quantity)


class Off:
    """An engine whose answer to one question is off in its last entry."""

    def __init__(self, engine, question, by):
        self._engine, self._question, self._by = engine, question, by

    def __getattr__(self, name):
        asked = getattr(self._engine, name)
        if name != self._question:
            return asked

        def wrong(*state):
            found = np.array(asked(*state))
            found[LAST[name]] += self._by
            return found

        return wrong


@pytest.mark.parametrize("scene", ["arm-7", "quadruped"])
@pytest.mark.parametrize("name", ["mujoco", "pinocchio-aba"])
@pytest.mark.parametrize(
    ("question", "check", "check_name"),
    [
        ("accelerations", accelerations.compare, "accelerations"),
        ("mass_matrix", terms.compare, "terms M"),
        ("bias", terms.compare, "terms bias"),
    ],
)
def test_an_entry_that_is_off_by_less_than_the_bound_is_loose(scene, name, question, check, check_name):
    """By three times the line in the state where that is narrowest; in the others it is within the bound as well."""
    sound = cell_of(scene, name, 5)
    spreads = {"accelerations": "accelerations", "mass_matrix": "M", "bias": "bias"}
    line = factor(sound, spreads[question]) * smallest_spread(sound, question)
    cell = cell_of(scene, name, 5, Off(sound.engine, question, 3 * line))
    (found,) = [result for result in check(cell) if result.check == check_name]
    assert found.outcome == "agrees"
    assert found.loose
    assert "times what rounding does there" in found.reason
    (right,) = [result for result in check(sound) if result.check == check_name]
    assert (right.outcome, right.loose) == ("agrees", False)


def smallest_spread(cell, question):
    """Of the last entry, over the states."""
    every = np.arange(len(cell.states))
    zeros = np.zeros_like(cell.facts.high)
    usual = {
        "accelerations": sharp.of_accelerations(cell, zeros),
        "mass_matrix": sharp.of_mass_matrix(cell, cell.facts.mass_matrix),
        "bias": sharp.of_bias(cell, cell.states.v, zeros),
    }[question]
    return float(usual.spread(cell.info, every)[LAST[question]].min())
