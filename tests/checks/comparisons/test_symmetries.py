"""Each symmetry passes engines that are right and fails one that lacks it."""

import numpy as np
import pytest
from fake_integrators import Damped, Fake, FirstLegHeavier, Geared, GravityLeft, Pushed, Wound

from furiko.checks.comparisons import symmetries
from furiko.models import NLegPendulum, RodChain, Scene, find_scene
from furiko.models.states import random_states


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba", "pinocchio-crba", "exudyn-tree", "exudyn-redundant"])
@pytest.mark.parametrize("scene", ["n-leg-3", "rods-3"])
def test_engines_have_every_symmetry(make_cell, engine, scene):
    results = list(symmetries.compare(make_cell(engine, scene)))
    legs = {"symmetry permutation", "symmetry split leg"} if scene == "n-leg-3" else set()
    others = {"mirror", "reversal", "2π", "mass scale", "length scale", "gravity scale", "turned support"}
    assert {result.check for result in results} == legs | {f"symmetry {name}" for name in others}
    for result in results:
        assert result.outcome == "agrees", result
        assert result.details["documents' formula"] <= 1


@pytest.mark.parametrize(
    ("fake", "lacks"),
    [
        (Pushed, {"mirror", "mass scale", "length scale", "gravity scale"}),
        (Damped, {"reversal", "mass scale", "length scale", "gravity scale"}),
        (Wound, {"2π", "mass scale", "length scale", "gravity scale", "turned support"}),
        (Geared, {"mass scale", "length scale"}),
        (FirstLegHeavier, {"permutation"}),
        (GravityLeft, {"gravity scale", "turned support"}),
        (Fake, set()),
    ],
)
def test_a_fault_of_1e_7_breaks_the_symmetries_that_it_should(make_cell, fake, lacks):
    results = list(symmetries.compare(make_cell(fake, "n-leg-3")))
    assert {result.check.removeprefix("symmetry ") for result in results if result.outcome == "differs"} == lacks


def test_an_unequal_split_breaks_the_split_leg(make_cell):
    class Uneven(Fake):
        """A leg that shares its length with the one before is heavier than asked for."""

        def __init__(self, system):
            l, m = system.lengths, list(system.masses)
            m[-1] *= 1 + 1e-7 * (l[-1] == l[-2])
            super().__init__(NLegPendulum(l, m, system.gravity))

    found = {result.check: result.outcome for result in symmetries.compare(make_cell(Uneven, "n-leg-3"))}
    assert found["symmetry split leg"] == "differs"


def test_an_image_that_the_engine_cannot_take_is_skipped(make_cell):
    scene = Scene("least", NLegPendulum((1.0, 1.0, 0.5), (1.0, 1.0, 2.0**-52)))  # which half a leg has not
    found = {result.check: result for result in symmetries.compare(make_cell("pinocchio-aba", scene))}
    assert found["symmetry split leg"].outcome == "skipped"
    assert "not 1.1e-16 (link 3)" in found["symmetry split leg"].reason
    assert {result.outcome for result in found.values()} == {"skipped", "agrees"}


def test_a_theory_without_a_symmetry_is_told(make_cell, monkeypatch):
    monkeypatch.setattr(symmetries, "literal_accelerations", lambda system, t, w: Pushed(system).accelerations(t, w))
    symmetries._theory.cache_clear()
    found = {result.check: result for result in symmetries.compare(make_cell("pinocchio-aba", "n-leg-3"))}
    symmetries._theory.cache_clear()
    assert found["symmetry mirror"].outcome == "differs"
    assert "documents' own formula" in found["symmetry mirror"].reason


@pytest.mark.parametrize("system", [find_scene("n-leg-3").system, find_scene("rods-3").system])
def test_images_are_exact(system):
    # Scaled by powers of two and put back, not a bit is lost.
    theta, omega = random_states("images", system, 5)
    for image in (symmetries.masses_scaled, symmetries.lengths_scaled, symmetries.support_turned):
        made = image(system, theta, omega)
        assert made.after.n == system.n
    scaled = symmetries.lengths_scaled(system, theta, omega).after
    np.testing.assert_array_equal(np.array(scaled.lengths) / 4, system.lengths)
    ratio = np.array(scaled.masses) / np.array(system.masses)
    np.testing.assert_array_equal(ratio, 4.0 if isinstance(system, RodChain) else 1.0)
