"""Engines that run only where they are named: their adapters conform, and they agree with the proven accelerations.

DART, Drake and PyBullet are skipped where they are not installed; sympy is there with the tests.
"""

import numpy as np
import pytest

from furiko.checks.comparisons import accelerations, energy, terms
from furiko.checks.conformance.kit import steps
from furiko.engines import engine_info, engine_names, load_engine, names_on_request
from furiko.models import NLegPendulum, RodChain, Scene

# Of three links with nothing alike, by the document's own formula, and of a fork: orders and parents all matter.
SCENES = (
    Scene("unlike rods", RodChain((0.8, 0.31, 1.7), density=1.4, gravity=9.7), (0.4, -1.2, 2.9), (1.1, -0.6, 2.3)),
    Scene(
        "unlike legs", NLegPendulum((0.7, 0.4, 0.9), (0.3, 1.6, 0.2), gravity=9.8), (-0.7, 1.9, 0.2), (0.8, 1.5, -2.1)
    ),
)


def installed(name):
    pytest.importorskip(engine_info(name).module, exc_type=ImportError)
    return name


@pytest.mark.slow  # sympy derives the equations of three mechanisms
@pytest.mark.parametrize("name", names_on_request())
def test_its_adapter_conforms(name):
    assert [step for step in steps(installed(name)) if step.outcome == "wrong"] == []


@pytest.mark.slow
@pytest.mark.parametrize("name", names_on_request())
@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_it_agrees_with_what_is_proven(make_cell, name, scene):
    cell = make_cell(installed(name), scene)
    compared = [*accelerations.compare(cell), *terms.compare(cell)]
    if "energy" not in cell.info.missing:
        compared += energy.compare(cell)
    assert {result.outcome for result in compared} <= {"agrees", "skipped"}, compared
    assert sum(result.outcome == "agrees" for result in compared) >= 5


def test_they_run_only_where_they_are_named():
    assert not set(names_on_request()) & set(engine_names())


@pytest.mark.slow
def test_both_of_sympy_derive_for_themselves():
    """Kane's method uses no energies: a fault in one derivation is not in the other's."""
    scene = SCENES[0]
    found = [
        load_engine(installed(f"sympy-{method}"), scene.system).accelerations(scene.theta, scene.omega)
        for method in ("kane", "lagrange")
    ]
    # two derivations of one mechanism, rounded otherwise: some hundred roundings
    assert np.allclose(*found, rtol=1e-12, atol=0)
    assert not np.array_equal(*found)
