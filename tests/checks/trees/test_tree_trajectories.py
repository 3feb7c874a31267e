"""Trajectories of bodies that turn in all directions: right runs converge to the motion, wrong ones beside it."""

from dataclasses import replace

import numpy as np
import pytest
from fake_tree_engines import FLOATING, Means, Right

from furiko.checks.trees import trajectories
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import TreeShape
from furiko.models.scene import scene_from_toml
from furiko.models.trees.states import tree_states
from furiko.reference.kernels.trees.dynamics import tree_accelerations

SCENE = scene_from_toml(FLOATING.replace("duration = 0.5", "duration = 0.25"), "floating")


@pytest.fixture(scope="module")
def given():
    states = tree_states(SCENE, 1)
    return states, tree_facts(SCENE, states, slopes=False)


def compared(engine, given, **integrator):
    mechanism, (usual,) = SCENE.system.mechanism(), engine.info.integrators
    info = replace(engine.info, integrators=(replace(usual, **integrator),))
    cell = TreeCell(SCENE, info, TreeShape(engine(mechanism), info, mechanism), *given)
    (result,) = trajectories.compare(cell)
    return result


class Turned(Right):
    """The body is turned about its own z axis by 1e-7 rad a second more than its rates say."""

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        half = 5e-8 * step * steps
        w, x, y, z = at[3:7]
        at[3:7] = [w - half * z, x + half * y, y - half * x, z + half * w]
        return at, rates


class Aside(Right):
    """The body is 1e-8 m beside its place."""

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        return at + 1e-8 * np.eye(len(at))[1], rates


class OtherSign(Right):
    """Its quaternions have the other sign."""

    def trajectory(self, q, v, integrator, step, steps):
        at, rates = super().trajectory(q, v, integrator, step, steps)
        at[3:11] *= -1
        return at, rates


@pytest.mark.slow
@pytest.mark.parametrize("engine", [Right, OtherSign])
def test_a_right_engine_converges_to_the_motion_in_its_order(given, engine):
    found = compared(engine, given)
    assert found.outcome == "agrees"
    assert found.details["measured order"] == pytest.approx(4, abs=0.2)
    assert found.allowed < 1e-8


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "missed"), [(Turned, 2.5e-8), (Aside, 1e-8)])
def test_a_run_that_ends_beside_the_motion_differs(given, engine, missed):
    found = compared(engine, given)
    assert found.outcome == "differs"
    assert found.measured == pytest.approx(missed, rel=0.1)
    assert "converges" in found.reason


class FastMeans(Means):
    """The same with the kernels' accelerations: there are thousands."""

    def a(self, q, v):
        return tree_accelerations(self.mechanism, q, v)


@pytest.mark.slow
def test_means_of_rates_show_their_order(given):
    found = compared(FastMeans, given)
    assert found.outcome == "differs"
    assert found.reason == "RK4 is of order 4 and shows order 2.00"
    found = compared(FastMeans, given, turning=2)
    assert found.outcome == "agrees"
    assert found.details["measured order"] == pytest.approx(2, abs=0.1)
