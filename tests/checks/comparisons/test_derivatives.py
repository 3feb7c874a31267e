"""The check of derivatives: what is right agrees, what is wrong in one way differs, with that cause."""

import importlib.util

import numpy as np
import pytest

from furiko.checks.plan import make_plan
from furiko.diagnosis.slopes import Mistake, cause_of
from furiko.engines import engine_info, load_tree_engine
from furiko.models import find_scene

PARTS = ("derivatives ∂a/∂q", "derivatives ∂a/∂v", "derivatives M⁻¹")
SCENES = ["double-pendulum", "n-leg-3-mass-ratio", "rods-3-length-ratio", "rods-5-no-gravity", "rods-10"]


@pytest.mark.slow
@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("engine", ["fake_engines:Right", "pinocchio-aba", "pinocchio-aba-mjcf"])
def test_right_derivatives_agree(run_cell, engine, scene):
    if engine == "pinocchio-aba-mjcf" and "leg" in scene:
        engine = "pinocchio-aba"
    results = run_cell(engine, scene)
    assert {part: results[part].outcome for part in PARTS} == dict.fromkeys(PARTS, "agrees"), results


@pytest.mark.slow
@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-crba"])
def test_an_engine_that_offers_an_inverse_alone_is_asked_for_that(run_cell, engine, scene):
    results = run_cell(engine, scene)
    assert [results[part].outcome for part in PARTS] == ["skipped", "skipped", "agrees"]
    assert results[PARTS[0]].reason == engine_info(engine).lacks["derivatives"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "causes"),
    [
        ("TransposedDerivatives", ("derivative-transposed", "derivative-transposed", None)),
        ("NegatedDerivatives", ("derivative-sign", "derivative-sign", None)),
        ("ExchangedDerivatives", ("derivatives-exchanged", "derivatives-exchanged", None)),
        ("HalfDerivativeByRates", (None, "factor-half", None)),
        ("RelativeDerivatives", ("angle-convention",) * 3),
        ("ForcesForDerivatives", ("derivative-of-forces", "derivative-of-forces", "mass-matrix-for-inverse")),
        ("DerivativesWithoutGravity", ("derivative-lacks-term", None, None)),
        ("DerivativesOfOtherRates", ("derivatives-of-others", "derivatives-of-others", None)),
    ],
)
@pytest.mark.parametrize("scene", ["rods-3", pytest.param("n-leg-3", marks=pytest.mark.slow)])
def test_each_mistake_differs_with_its_cause_and_nothing_else_does(run_cell, engine, causes, scene):
    results = run_cell(f"fake_engines:{engine}", scene)
    expected = {part: ("differs" if cause else "agrees", cause) for part, cause in zip(PARTS, causes, strict=True)}
    assert {part: (results[part].outcome, results[part].cause) for part in PARTS} == expected
    assert {check for check, result in results.items() if result.outcome == "differs"} == {
        part for part, cause in zip(PARTS, causes, strict=True) if cause
    }


@pytest.mark.slow
def test_one_entry_that_is_slightly_off_differs(run_cell, monkeypatch):
    import fake_engines

    def slightly(self, theta, omega, right=fake_engines.Right.derivatives):
        of_positions, of_rates = right(self, theta, omega)
        of_positions[:, 0, 1] *= 1 + 1e-11  # of a chain of two rounding explains some 1e-13
        return of_positions, of_rates

    monkeypatch.setattr(fake_engines.Right, "derivatives", slightly)
    results = run_cell("fake_engines:Right", "rods-2")
    assert [results[part].outcome for part in PARTS] == ["differs", "agrees", "agrees"]


# A rod 200 times longer than the one at its end: about the support the short one's moment is 1e5 times what it is about
# its own hinge, to which its inverse is the answer.
SHORT_AT_THE_END = """
[system]
kind = "rod-chain"
lengths = [2.362553756567956e-06, 1.1435760494585665e-08]
gravity = 5.7482462842804274e-05
density = 3.084270942190986e-05
[state]
theta = [-4.802483524511062e-07, -8.058837901523096e-07]
omega = [5.363644143247399e-09, 2.2581161307480948e-07]
"""
SLID_FAR = """
[system]
kind = "tree"
[[system.links]]
name = "block"
mass = 1.2
[[system.links.joints]]
name = "rail"
kind = "slide"
axis = [1.0, 0.0, 0.0]
[[system.links]]
name = "rod"
parent = "block"
mass = 0.7
centre = [0.1, 0.0, -0.4]
inertia = [0.04, 0.05, 0.02]
[[system.links.joints]]
name = "pin"
axis = [0.0, 1.0, 0.0]
[state]
q = { rail = 2e6, pin = 1.1 }
v = { pin = -0.4 }
"""


@pytest.mark.parametrize(
    ("text", "random_states"), [(SHORT_AT_THE_END, 60), (SLID_FAR, 0)], ids=["short at the end", "slid far"]
)
@pytest.mark.parametrize("engine", ["pinocchio-aba", "pinocchio-aba-mjcf"])
def test_moments_about_a_far_origin_are_rounding(run_cell, tmp_path, engine, text, random_states):
    """Pinocchio differentiates, and inverts M, with inertias in the world."""
    (tmp_path / "far.toml").write_text(text, encoding="utf-8")
    results = run_cell(engine, str(tmp_path / "far.toml"), random_states=random_states)
    assert {part: results[part].outcome for part in PARTS} == dict.fromkeys(PARTS, "agrees"), results


def test_another_engine_is_not_excused_by_a_far_origin(run_cell, tmp_path, monkeypatch):
    """Its own factors give the inverse of a short link's moment to all digits, and it is held to them."""
    import fake_engines

    def slightly(self, theta, right=fake_engines.Right.inverse_mass):
        return right(self, theta) * (1 + 1e-12)

    monkeypatch.setattr(fake_engines.Right, "inverse_mass", slightly)
    (tmp_path / "far.toml").write_text(SHORT_AT_THE_END, encoding="utf-8")
    results = run_cell("fake_engines:Right", str(tmp_path / "far.toml"))
    assert [results[part].outcome for part in PARTS] == ["agrees", "agrees", "differs"]


@pytest.mark.parametrize("name", ["arm-7", "cart-pole", "hopper", "acrobot"])
def test_trees_agree(run_cell, name):
    results = run_cell("pinocchio-aba", name, random_states=10)
    assert {part: results[part].outcome for part in PARTS} == dict.fromkeys(PARTS, "agrees"), results


def test_trees_with_balls_are_skipped_and_say_so():
    plan = make_plan(["humanoid"], ["pinocchio-aba"], "quick")
    (settled,) = (result for result in plan.settled if result.check == "derivatives")
    assert settled.reason == "derivatives are compared of trees of hinges and slides alone"


def test_an_engine_that_offers_nothing_is_skipped_with_its_reason():
    plan = make_plan(["rods-2"], ["exudyn-tree"], "quick")
    (settled,) = (result for result in plan.settled if result.check == "derivatives")
    assert settled.outcome == "skipped"
    assert settled.reason.startswith("Exudyn has neither")


def test_composite_joints_of_pinocchio_are_differentiated_wrongly(run_cell):
    """A fact of the engine that ``cannot_differentiate`` rests on; once this fails, it is mended there."""
    results = run_cell("pinocchio-aba-mjcf", "hopper", random_states=10)
    assert results[PARTS[0]].outcome == "skipped"
    assert "JointModelComposite" in results[PARTS[0]].reason
    scene = find_scene("hopper")
    engine = load_tree_engine("pinocchio-aba-mjcf", scene.system)
    n = scene.system.mechanism().nv
    state = np.random.Generator(np.random.PCG64(4))
    q, v = state.uniform(-1, 1, (1, n)), state.uniform(-1, 1, (1, n))
    got = engine.derivatives(q, v)[0][0]
    # Its own accelerations, by central differences, are good to some 1e-9 of the largest; it is off by percents.
    own = np.empty_like(got)
    for k in range(n):
        step = 2.0**-17 * np.eye(n)[k]
        own[:, k] = ((engine.accelerations(q + step, v) - engine.accelerations(q - step, v)) / 2.0**-16)[0]
    assert np.abs(got - own).max() > 1e-3 * np.abs(own).max()
    right = load_tree_engine("pinocchio-aba", scene.system).derivatives(q, v)[0][0]
    assert np.abs(right - own).max() < 1e-6 * np.abs(own).max()


def test_a_mistake_that_gives_the_truth_is_no_cause():
    symmetric = np.eye(2)[None]
    assert cause_of(symmetric, iter([Mistake("derivative-transposed", "", symmetric)]), symmetric) is None


@pytest.mark.skipif(importlib.util.find_spec("pydrake") is None, reason="Drake is not installed")
@pytest.mark.parametrize("scene", SCENES)
def test_drake_s_derivatives_agree(run_cell, scene):
    results = run_cell("drake-aba", scene)
    assert [results[part].outcome for part in PARTS] == ["agrees", "agrees", "skipped"]


@pytest.mark.skipif(importlib.util.find_spec("dartpy") is None, reason="DART is not installed")
@pytest.mark.parametrize("scene", SCENES)
def test_the_inverse_of_dart_agrees(run_cell, scene):
    results = run_cell("dart", scene)
    assert [results[part].outcome for part in PARTS] == ["skipped", "skipped", "agrees"]
