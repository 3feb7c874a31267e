"""An engine that declares single precision is held to it in every quantity, and to no more."""

from dataclasses import replace

import fake_engines
import fake_tree_engines
import numpy as np
import pytest

from furiko.records.check import Result

DECLARED = {"accuracy": 2.0**-23, "accuracy_reason": "single precision", "algorithm": "other", "offers": ()}
NO_RUNS = {"trajectory": "not asked"}


def rounded(answer):
    return np.asarray(answer, dtype=np.float32).astype(np.float64)


class Single(fake_engines.Right):
    """Its answers are the nearest numbers of single precision to those of the theory."""

    info = fake_engines.about("Single", missing=NO_RUNS, **DECLARED)

    def accelerations(self, theta, omega):
        return rounded(super().accelerations(theta, omega))

    def inverse_dynamics(self, theta, omega, alpha, *, gravity=True):
        return rounded(super().inverse_dynamics(theta, omega, alpha, gravity=gravity))

    def energy(self, theta, omega):
        return rounded(super().energy(theta, omega))


class SingleTree(fake_tree_engines.Right):
    """The same for open mechanisms."""

    info = replace(fake_tree_engines.about("SingleTree", missing=NO_RUNS), **DECLARED)

    def accelerations(self, q, v):
        return rounded(super().accelerations(q, v))

    def mass_matrix(self, q):
        return rounded(super().mass_matrix(q))

    def bias(self, q, v):
        return rounded(super().bias(q, v))

    def passive(self, q, v):
        return rounded(super().passive(q, v))

    def energy(self, q, v):
        return rounded(super().energy(q, v))


@pytest.fixture
def single(monkeypatch):
    monkeypatch.setattr(fake_engines, "Single", Single, raising=False)
    monkeypatch.setattr(fake_tree_engines, "SingleTree", SingleTree, raising=False)


@pytest.mark.parametrize("scene", ["double-pendulum", "rods-3"])
def test_what_is_right_but_for_single_precision_agrees(run_cell, single, scene):
    results = run_cell("fake_engines:Single", scene)
    looked_at = {check for check, result in results.items() if result.outcome == "agrees"}
    assert {"accelerations", "terms M", "terms G", "terms C", "terms velocity", "energy"} <= looked_at
    assert [result for result in results.values() if result.outcome not in {"agrees", "skipped"}] == []


def test_so_do_trees(run_cell, single):
    results = run_cell("fake_tree_engines:SingleTree", "cart-pole", random_states=3)
    looked_at = {check for check, result in results.items() if result.outcome == "agrees"}
    assert {"accelerations", "terms M", "terms bias", "terms G", "terms passive", "energy"} <= looked_at
    assert [result for result in results.values() if result.outcome not in {"agrees", "skipped"}] == []


def test_what_is_off_by_more_differs(run_cell, single, monkeypatch):
    """By 1e-4 of each number: some thousand roundings, of which two links have some fifty in a row."""
    right = Single.energy
    monkeypatch.setattr(Single, "energy", lambda self, theta, omega: right(self, theta, omega) * (1 + 1e-4))
    found = run_cell("fake_engines:Single", "double-pendulum")["energy"]
    assert isinstance(found, Result)
    assert found.outcome == "differs"
