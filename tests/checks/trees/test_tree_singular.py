"""Accelerations where the mass matrix is singular to rounding: nobody is accused there, and everybody elsewhere."""

import numpy as np
import pytest

from furiko.checks.trees import accelerations
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import engine_info, load_tree_engine
from furiko.models import TreeScene
from furiko.models.trees.states import TreeStates
from furiko.studies.stress.trees.mechanisms import gimbal

SCENE = TreeScene("gimbal", gimbal())
NEAR = 1e-11  # rad from gimbal lock: inertias are singular by the square of it, far below rounding


def states(*angles):
    q = np.array([[0.3, np.pi / 2 - angle, -0.8, 0.5] for angle in angles])
    return TreeStates(tuple(f"{angle:g} rad" for angle in angles), q, np.tile([1.0, -2.0, 0.5, 0.3], (len(q), 1)))


def cell(at, off=lambda row: 1.0, engine="mujoco"):
    """A cell of an engine whose accelerations are multiplied by off(row)."""
    asked = load_tree_engine(engine, SCENE.system)
    factors = np.array([[off(row)] for row in range(len(at))])
    asked._engine.accelerations, true = lambda q, v: factors * true(q, v), asked._engine.accelerations
    return TreeCell(SCENE, engine_info(engine), asked, at, tree_facts(SCENE, at, motion=False, slopes=False))


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba", "exudyn-tree"])
def test_a_right_engine_is_not_accused_beside_gimbal_lock(engine):
    (found,) = accelerations.compare(cell(states(1.0, NEAR), engine=engine))
    assert found.outcome in ("agrees", "loose")


def test_states_left_out_are_counted_and_the_others_still_accuse():
    (found,) = accelerations.compare(cell(states(1.0, NEAR), lambda row: 2.0 if row else 1.0))
    assert (found.outcome, found.details["states left out"]) == ("agrees", 1)
    (found,) = accelerations.compare(cell(states(1.0, NEAR), lambda row: 1.0 if row else 1 + 1e-9))
    assert found.outcome == "differs"
    assert found.details["worst state"] == "1 rad"


def test_where_every_state_is_singular_nothing_is_said():
    (found,) = accelerations.compare(cell(states(NEAR, 2 * NEAR), lambda _: 2.0))
    assert found.outcome == "skipped"
    assert "too near to a singular one" in found.reason


def test_what_is_nearly_singular_and_yet_regular_is_judged():
    """At a thousandth of a radian half the digits are there, and an error of a part in 1e4 is one."""
    (found,) = accelerations.compare(cell(states(1e-3), lambda _: 1 + 1e-4))
    assert found.outcome == "differs"
