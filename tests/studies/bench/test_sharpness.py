"""The smallest error that a check notices: as planted faults confirm it."""

import pytest

from furiko.engines import load_engine
from furiko.models import find_scene
from furiko.studies.bench import sharpness


def rows(engine="mujoco", scene="double-pendulum"):
    return {row.quantity: row for row in sharpness.sharpness([scene], [engine], random_states=20)}


def test_twice_what_is_read_off_the_line_is_noticed():
    found = rows()
    assert list(found) == ["accelerations", "terms M", "joint forces"]
    for row in found.values():
        assert row.found == row.planted >= 2
        assert 0 < row.noticed == pytest.approx(row.ratio * row.own, rel=1e-12, abs=0)
        assert row.ratio <= 30


@pytest.mark.parametrize(("times", "raised"), [(1.9, 1), (2.1, 2), (7.0, 4), (1e9, sharpness.RAISED)])
def test_what_planted_faults_do_not_confirm_is_raised(monkeypatch, times, raised):
    """A check that notices nothing below so many times the line, of which twice is planted first."""
    line = 1e-13
    monkeypatch.setattr(sharpness, "_notices", lambda cell, quantity, place, share: share >= times * line)
    assert sharpness._raised(None, "accelerations", (0,), 2 * line) == raised


def test_a_fault_that_nothing_notices_is_not_found(monkeypatch):
    monkeypatch.setattr(sharpness, "_notices", lambda *_: False)
    for row in rows().values():
        assert (row.found, row.planted >= 2) == (0, True)


def test_a_planted_fault_is_in_its_entry_alone():
    scene = find_scene("double-pendulum")
    engine = load_engine("mujoco", scene.system)
    cell = type("cell", (), {"scene": scene})()
    planted = sharpness._Planted(engine, cell, "accelerations", (1,), 1e-3)
    state = [[0.3, 1.1]], [[0.5, -0.2]]
    right, wrong = engine.accelerations(*state), planted.accelerations(*state)
    assert wrong[0, 0] == right[0, 0]
    assert wrong[0, 1] == pytest.approx(1.001 * right[0, 1], rel=1e-14)
