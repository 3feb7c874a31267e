"""Simbody as a program over the protocol; skipped where Simbody or a compiler is missing."""

import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from furiko.checks.comparisons import accelerations
from furiko.checks.conformance.kit import steps
from furiko.engines import cannot, engine_info
from furiko.engines.registry import load_engine
from furiko.models import NLegPendulum, RodChain, Scene
from furiko.reference.truth.enclosures import enclosed_accelerations

SCRIPT = Path(__file__).parents[3] / "docs" / "examples" / "simbody" / "build.sh"
HEADER = Path("/usr/include/simbody/Simbody.h")
CHAIN = RodChain((0.8, 0.5, 0.65, 0.9), density=1.3)

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    if shutil.which("c++") is None or not HEADER.is_file():
        pytest.skip("a C++ compiler and Simbody (libsimbody-dev) are needed")
    built = tmp_path_factory.mktemp("simbody")
    subprocess.run([SCRIPT, built], check=True, capture_output=True)
    return built


def test_the_programs_conform(folder):
    for name in ("furiko-simbody", "furiko-simbody-maximal"):
        info = engine_info(str(folder / name))
        if info.no_point_masses:
            assert "singular" in cannot(info, NLegPendulum((1.0, 0.5), (1.0, 1.0)))
            continue
        assert [step for step in steps(str(folder / name)) if step.outcome == "wrong"] == []
        assert info.offers == ("inverse_mass",)
        assert info.lacks == {"derivatives": "Simbody differentiates no accelerations"}


@pytest.mark.parametrize(("name", "close"), [("furiko-simbody", 1e-14), ("furiko-simbody-maximal", 1e-12)])
def test_both_formulations_have_the_proved_accelerations(folder, name, close):
    """Four links lose a digit or two by conditioning; the factorised constraints some more."""
    generator = np.random.Generator(np.random.PCG64(5))
    theta, omega = generator.uniform(-2, 2, (2, 7, CHAIN.n))
    true = enclosed_accelerations(CHAIN, theta, omega).high
    got = load_engine(str(folder / name), CHAIN).accelerations(theta, omega)
    assert np.abs(got - true).max() < close * np.abs(true).max()


def test_unlike_links_are_within_the_bound_of_multipliers_from_a_dense_matrix(folder, make_cell):
    """A rod of a hundredth between two others: 3,209 ε where only an elimination that interchanges rows is allowed."""
    cell = make_cell(str(folder / "furiko-simbody-maximal"), "rods-3-length-ratio", random_states=200)
    assert cell.info.ordering == "bodies"
    (result,) = accelerations.compare(cell)
    assert (result.outcome, result.loose) == ("agrees", False), result.reason


@pytest.mark.parametrize(("middle", "outcome"), [(2e-10, "agrees"), (3e-11, "differs")])
def test_an_equation_that_simbody_drops_is_seen(folder, make_cell, middle, outcome):
    """Of G M⁻¹ Gᵀ the smallest singular value is about ``middle`` / 8 of the largest; below 6 ε^(3/4) it is dropped."""
    scene = Scene("light", RodChain((1.0, middle, 1.0)))
    cell = make_cell(str(folder / "furiko-simbody-maximal"), scene, random_states=20)
    (result,) = accelerations.compare(cell)
    assert result.outcome == outcome, result.reason


def test_point_masses_are_refused_by_the_maximal_formulation_alone():
    info = replace(engine_info("exudyn-tree"), no_point_masses="it divides by their inertia")
    pendulum = NLegPendulum((1.0, 0.5), (1.0, 1.0))
    assert cannot(info, pendulum) == "exudyn-tree takes no point masses (link 1): it divides by their inertia"
    assert cannot(info, CHAIN) is None
