"""One step of an engine's integrators in trees: a right one is named, faults of a few roundings are found."""

import fake_tree_engines
import numpy as np
import pytest
from score_trees import cells

from furiko.checks.trees import step_map
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import engine_info, load_tree_engine
from furiko.engines.trees.mujoco import MujocoTree
from furiko.models.scene import scene_from_toml
from furiko.models.trees.states import tree_states

SMALL, BLOCK = fake_tree_engines.SMALL, fake_tree_engines.BLOCK


class Runs(fake_tree_engines.Right):
    """MuJoCo's Runge-Kutta scheme, and what is done to the state after each of its steps."""

    info = fake_tree_engines.about("Runs")
    after = staticmethod(lambda q, v, before, step: (q, v))
    longer = 1.0

    def trajectory(self, q, v, integrator, step, steps):
        engine = MujocoTree(self.mechanism)
        for _ in range(steps):
            before = q, v
            q, v = (np.array(x) for x in engine.trajectory(q, v, "RK4", step * self.longer, 1))
            q, v = self.after(q, v, before, step)
        return q, v


def wrong(what, **fields):
    return type("Wrong", (Runs,), {"after": staticmethod(what), **fields})


def cell(text, engine=None, name="mujoco"):
    scene = scene_from_toml(text, "small")
    states = tree_states(scene, 4)
    facts = tree_facts(scene, states, motion=False, slopes=False)
    if engine is None:
        return TreeCell(scene, engine_info(name), load_tree_engine(name, scene.system), states, facts)
    return TreeCell(scene, engine.info, engine(scene.system.mechanism()), states, facts)


def compared(*given):
    return {result.check: result for result in step_map.compare(cell(*given))}


def test_each_integrator_of_an_engine_is_named():
    schemes = {check: result.details["scheme"] for check, result in compared(SMALL).items()}
    late = "semi-implicit Euler, dampers at the end of the step"
    assert schemes == {
        "step map Euler": late,
        "step map implicitfast": late,
        "step map RK4": "classical Runge-Kutta",
    }
    assert {result.outcome for result in compared(SMALL).values()} == {"agrees"}


def test_without_dampers_euler_is_semi_implicit():
    bare = SMALL.replace("damping = 0.3\n", "").replace("damping = 0.02\n", "")
    assert compared(bare)["step map Euler"].details["scheme"] == "semi-implicit Euler"


@pytest.mark.parametrize(
    "engine",
    [
        wrong(lambda q, v, before, step: (q, v * (1 - 1e-12 * step))),  # a damper of its own
        wrong(lambda q, v, before, step: (q + 1e-13, v)),  # drifts
        wrong(lambda q, v, before, step: (q, before[1])),  # rates of the step before
        wrong(lambda q, v, before, step: (q, v.astype(np.float32).astype(float))),
        wrong(lambda q, v, before, step: (q, v), longer=1 + 1e-11),  # another second
        fake_tree_engines.WrongScheme,
        fake_tree_engines.OneOrderLess,
    ],
    ids=["damped", "drifts", "late", "single", "longer", "order", "third"],
)
def test_a_step_that_is_no_schemes_differs(engine):
    (result,) = compared(SMALL, engine).values()
    assert result.outcome == "differs"
    assert "is no textbook scheme's; the nearest, " in result.reason or "is said to be of order 4" in result.reason


def test_the_same_engine_without_a_fault_agrees():
    (result,) = compared(SMALL, Runs).values()
    assert result.outcome == "agrees"


def test_steps_of_a_block_on_a_spring_are_those_written_down():
    """By hand, with m = 5/4, d = 3/4, k = 5, r = 1/4: v⁺ = (v − h k (q − r)/m) / (1 + h d/m) with the damper late."""
    here = cell(BLOCK)
    steps = step_map.chosen_steps(here)
    h, q, v = (np.asarray(x).astype(np.longdouble) for x in (steps.h, steps.q, steps.v))
    textbook = step_map.Textbook(steps)
    by_name = {scheme.name: textbook.end(scheme) for scheme in textbook.schemes}
    a = (-0.75 * v - 5 * (q - 0.25)) / 1.25
    explicit = np.stack([q + h * v, v + h * a])
    late = (v - h * 5 * (q - 0.25) / 1.25) / (1 + h * 0.75 / 1.25)
    for name, expected in {
        "explicit Euler": explicit,
        "semi-implicit Euler": np.stack([q + h * explicit[1], explicit[1]]),
        "semi-implicit Euler, dampers at the end of the step": np.stack([q + h * late, late]),
    }.items():
        assert np.abs(by_name[name] - expected).max() < 1e-17  # some roundings of extended precision
    # The fastest rate is √(k/m) + d/m = 2.6 1/s: an eighth of its time, as a power of two.
    assert h == 2.0**-5


@pytest.mark.slow
@pytest.mark.parametrize("number", range(2000, 2030, 2))  # hinges and slides alone; every third far apart in size
def test_engines_that_are_right_are_called_right_on_any_tree(number):
    """``score_trees.mechanism`` draws them; the smallest allowed over measured in 1,137 others was 3.4."""
    results = [
        result
        for one in cells(number, 4)
        if "trajectory" not in one.info.tree.missing
        for result in step_map.compare(one)
    ]
    assert results
    assert {result.outcome for result in results} == {"agrees"}, results
