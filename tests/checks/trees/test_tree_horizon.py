"""When motions of a tree part: predicted, measured, and told from another model; the truth against its proof."""

from fractions import Fraction

import fake_tree_engines
import flint
import numpy as np
import pytest
from scipy.linalg import expm

from furiko.checks.motions import divergence
from furiko.checks.trees import horizon
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import engine_info, load_tree_engine
from furiko.engines.trees.mujoco import MujocoTree
from furiko.models import find_scene
from furiko.models.scene import scene_from_toml
from furiko.models.trees.states import tree_states
from furiko.reference.integration.tree_variation import slopes, tree_flow
from furiko.reference.proved.kept_trees import proof
from furiko.reference.truth.quadruple_tree import quadruple_tree_motion
from furiko.reference.truth.spatial_derivatives import spatial_derivatives

pytest.importorskip("heyoka")

SCENE = find_scene("cart-two-poles")


class Runs(fake_tree_engines.Right):
    """MuJoCo's Runge-Kutta scheme."""

    info = fake_tree_engines.about("Runs")
    damped = 0.0

    def __init__(self, mechanism):
        super().__init__(mechanism)
        self.engine = MujocoTree(mechanism)

    def trajectory(self, q, v, integrator, step, steps):
        for _ in range(steps):
            q, v = (np.array(x) for x in self.engine.trajectory(q, v, "RK4", step, 1))
            v = v * (1 - self.damped * step)
        return q, v


class Damped(Runs):
    """All rates lose a thousandth of themselves in a second: another model."""

    info = fake_tree_engines.about("Damped")
    damped = 1e-3


def cell(engine):
    states = tree_states(SCENE, 2)
    facts = tree_facts(SCENE, states, motion=False, slopes=False)
    if isinstance(engine, str):
        return TreeCell(SCENE, engine_info(engine), load_tree_engine(engine, SCENE.system), states, facts)
    return TreeCell(SCENE, engine.info, engine(SCENE.system.mechanism()), states, facts)


@pytest.mark.slow
def test_two_engines_part_from_the_truth_when_it_is_predicted():
    """MuJoCo's and Exudyn's classical schemes neglect the same in a step: both part at one time, to three digits."""
    times = {}
    for name, scheme in (("mujoco", "RK4"), ("exudyn-tree", "RK44")):
        results = {result.check: result for result in horizon.compare(cell(name))}
        assert {result.outcome for result in results.values()} <= {"agrees", "skipped"}, results
        found = results[f"horizon {scheme} 0.005 s"].details
        times[name] = found["parts, measured"]
        assert found["parts, predicted"] == pytest.approx(found["parts, measured"], abs=0.01)
        assert found["order of local errors"] == pytest.approx(4, abs=0.3)
    assert times["mujoco"] == pytest.approx(times["exudyn-tree"], abs=0.011)
    assert 2 < times["mujoco"] < 10


@pytest.mark.slow
def test_another_model_is_told_from_a_scheme(monkeypatch):
    monkeypatch.setattr(horizon, "STEPS", (5e-3, 2.5e-3))
    monkeypatch.setattr(horizon, "LONGEST", 1.0)
    for one in (horizon.followed, horizon.true_motion, horizon._integrated):
        one.cache_clear()
    _, sound = horizon.compare(cell(Runs))
    assert sound.outcome == "agrees"
    _, damped = horizon.compare(cell(Damped))
    assert damped.outcome == "differs"
    assert "another model" in damped.reason
    for one in (horizon.followed, horizon.true_motion, horizon._integrated):
        one.cache_clear()


@pytest.mark.slow
def test_the_true_motion_is_held_against_the_kept_proof():
    truth, kept, here = horizon.true_motion(SCENE, 1e-2, 2.0), proof(SCENE), cell("mujoco")
    assert kept.times == (1.25,)  # beyond, the motion is chaotic, and bounds grow
    most = horizon.most_off(here, truth)
    found = divergence.held(truth, kept, most)
    assert found.times == (1.25,)
    assert found.off < 1e-14  # 2e-15: the roundings of the mechanism's numbers, grown
    assert most[125] < 1e-9
    truth.high[125, 1] += 1e-8
    with pytest.raises(ArithmeticError, match="beside the proved one"):
        divergence.held(truth, kept, most)


def test_slopes_are_the_proved_ones():
    mechanism = SCENE.system.mechanism()
    random = np.random.default_rng(3)
    q, v = random.uniform(-3, 3, (2, 4, mechanism.nv))
    by_q, by_v = slopes(mechanism, q, v)
    for k in range(4):
        proved = spatial_derivatives(mechanism, q[k], v[k])
        for got, true in ((by_q[k], proved.of_positions.high), (by_v[k], proved.of_rates.high)):
            assert np.abs(got - true).max() <= 1e-8 * np.abs(true).max()


def test_the_flow_of_a_block_on_a_spring():
    """By hand: a block alone, a = −4 q − 0.6 v, has Φ = exp(h J); a step of order four misses (h J)⁵/120 of it."""
    mechanism = scene_from_toml(fake_tree_engines.BLOCK, "block").system.mechanism()
    J, h = np.array([[0.0, 1.0], [-4.0, -0.6]]), 0.01
    path = np.linspace(0.3, 0.5, 5)[:, None]
    for flow in tree_flow(mechanism, path, -path, h):
        assert np.abs(flow - expm(h * J)).max() < 2 * np.linalg.norm(h * J, np.inf) ** 5 / 120 + 1e-10


def test_quadruple_precision_is_the_closed_form_of_a_spring():
    """By hand: an undamped block, q = q₀ cos ω t + v₀ sin ω t / ω with ω = 2, about a spring at rest in 0.

    Of a mass of 1 kg: of another, 1/m is rounded to double precision.
    """
    text = fake_tree_engines.BLOCK.replace("damping = 0.75\n", "").replace("springref = 0.25\n", "")
    text = text.replace("mass = 1.25", "mass = 1.0").replace("stiffness = 5.0", "stiffness = 4.0")
    mechanism = scene_from_toml(text, "block").system.mechanism()
    high, low = quadruple_tree_motion(mechanism, [0.5], [-1.0], [0.0, 0.75])
    with flint.ctx.workprec(200):
        true = flint.arb(0.5) * flint.arb(1.5).cos() - flint.arb(1.5).sin() / 2
        exact = Fraction(float(high[1, 0])) + Fraction(float(low[1, 0]))
        off = abs(true - flint.arb(exact.numerator) / exact.denominator)
        assert off < 1e-30
