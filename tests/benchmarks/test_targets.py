"""The script of the targets: unreached and unmeasured targets are told apart; nothing asks how long things take."""

from importlib import import_module
from pathlib import Path

import pytest

from furiko.engines import engine_version
from furiko.models import RodChain, Scene

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"
RODS = Scene("rods", RodChain((1.0, 0.5)), (1.0, 2.0), (0.0, 0.0), 0.5)


@pytest.fixture
def script(monkeypatch):
    """The module, as Python finds it when the script is run; what it sets for numpy is taken back."""
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        monkeypatch.setenv(name, "1")
    return import_module("targets")


@pytest.mark.slow
def test_a_target_out_of_reach_is_not_met(script, monkeypatch):
    assert script.own_tolerance(RODS, 1e-30).startswith("no nearer than")
    monkeypatch.setattr(script, "own_tolerance", lambda scene, error: "no nearer than 1e-3")
    if engine_version("pinocchio-aba"):
        target = script.five_rods()
        assert target.met is False
        assert target.got == "no nearer than 1e-3"


def test_a_target_without_its_engine_is_not_measured(script, monkeypatch):
    monkeypatch.setattr(script, "engine_version", lambda name: "")
    target = script.five_rods()
    assert target.met is None
    assert "not installed" in target.says


@pytest.mark.parametrize(("met", "status", "mark"), [(True, 0, "✓"), (None, 0, "–"), (False, 1, "✗")])
def test_the_status_is_1_where_a_target_is_not_met(script, monkeypatch, capsys, met, status, mark):
    target = script.Target("speed", "≥ 2 ×", "1 ×", met, 0.5, "measured so")
    monkeypatch.setattr(script, "targets", lambda: iter([target]))
    assert script.main() == status
    assert capsys.readouterr().out == (
        f"{mark} speed: asked ≥ 2 ×, got 1 × [0.50 of what is asked]\n    measured so\n{int(met is True)} of 1 met\n"
    )


@pytest.mark.slow
def test_a_smoke_run_imports_nothing_heavy(script):
    cold_start = import_module("cold_start")
    imported = cold_start.imported_by_smoke()
    assert {"furiko", "numpy"} <= set(imported)
    # scipy is there for one thing: SuperLU's own factors, which the sharp line of maximal coordinates rests on.
    assert set(cold_start.HEAVY) & set(imported) <= {"scipy"}
