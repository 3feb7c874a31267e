"""Quadruple precision: against published digits, energy, time reversal, and the data kept of it."""

import json

import numpy as np
import pytest

from furiko.models import LibraryMissing, NLegPendulum, RodChain, Scene, document_scenes, find_scene
from furiko.reference import literal_accelerations
from furiko.reference.arithmetic import balls, floats
from furiko.reference.truth import end_points as endpoints
from furiko.reference.truth import quadruple
from furiko.reference.truth.block_tridiagonal import chain_accelerations
from furiko.reference.truth.enclosures import accelerations_in_balls, enclosed_energies, precision
from furiko.reference.truth.end_points import lookup
from furiko.reference.truth.quadruple import quadruple_trajectory

DOUBLE = NLegPendulum((1.0, 1.0), (1.0, 1.0))
START = (2.0, 2.5)
REST = (0.0, 0.0)


def test_double_pendulum_after_ten_seconds():
    found = quadruple_trajectory(DOUBLE, START, REST, [0.0, 10.0])
    # the same motion by another program (an own quadruple precision Taylor series), twenty digits
    np.testing.assert_array_equal(found.theta[1], [-0.75312887429491238939, 1.62793308205370183556])
    np.testing.assert_array_equal(found.theta[0], START)
    assert found.error[1] < 1e-20


@pytest.mark.slow
def test_five_rods_after_ten_seconds():
    rods = RodChain((1.0, 0.8, 0.6, 0.9, 0.7))
    found = quadruple_trajectory(rods, (2.0, 2.5, 1.5, 2.8, 0.7), (0.0,) * 5, [0.0, 10.0])
    # From a run with 160 bits (heyoka's MPFR numbers). The motion magnifies errors by 5e24: what quadruple precision
    # rounds away, 1e-34 a step, comes back as some 1e-11, whichever program computes.
    assert found.theta[1, 0] == pytest.approx(0.0874383719325611, abs=1e-10)
    assert abs(found.theta[1, 0] - 0.0874383719325611) < found.error[1]


@pytest.mark.parametrize("system", [DOUBLE, RodChain((1.0, 0.7), 1.3), NLegPendulum((1.0, 0.8, 0.6), (1.0, 0.5, 2.0))])
def test_energy_stays(system):
    n = system.n
    found = quadruple_trajectory(system, (2.0, 2.5, 1.0)[:n], (0.1, -1.0, 2.0)[:n], [0.0, 0.5, 1.0, 2.0])
    truth = enclosed_energies(system, found.theta, found.omega)
    total = truth.high.sum(-1)
    # states rounded to double: energy is off by ε times its own size and rates, some ten
    np.testing.assert_allclose(total, total[0], rtol=0, atol=1e-13 * np.abs(truth.high).max())


def test_there_and_back():
    there = quadruple_trajectory(DOUBLE, START, REST, [0.0, 2.0])
    back = quadruple_trajectory(DOUBLE, there.theta[1], there.omega[1], [2.0, 1.0, 0.0])
    # rounding the turning point to double, magnified by at most e^(4·2)
    np.testing.assert_allclose(back.theta[2], START, rtol=0, atol=1e-12)
    np.testing.assert_allclose(back.omega[2], REST, rtol=0, atol=1e-12)
    assert back.theta.shape == (3, 2)
    alone = quadruple_trajectory(DOUBLE, START, REST, [3.0])
    np.testing.assert_array_equal(alone.theta, [START])


def test_low_parts_carry_what_doubles_cannot():
    found = quadruple_trajectory(DOUBLE, START, REST, [0.0, 1.0])
    assert np.all(np.abs(found.theta_low[1]) <= np.spacing(np.abs(found.theta[1])))
    assert found.theta_low[1].any()
    again = quadruple.from_decimals([["0.1", "2"]], [0.0], 1)
    # 0.1 as a double is too much by 5.55e-18
    assert again.theta_low[0, 0] == pytest.approx(-5.551115123125783e-18, rel=1e-12, abs=0)
    assert again.omega[0, 0] == 2


@pytest.mark.parametrize("n", [1, 2, 5, 12])
def test_equations_with_the_joint_forces_are_the_same_motion(n):
    generator = np.random.default_rng(n)
    rods = RodChain(tuple(generator.uniform(0.5, 1.0, n)), 1.3)
    theta, omega = generator.uniform(-3, 3, n), generator.normal(size=n)
    with precision(300):
        xp = balls()
        theta_balls, omega_balls = xp.array(theta), xp.array(omega)
        found = chain_accelerations(xp, rods, theta_balls, omega_balls)
        literal = accelerations_in_balls(rods, theta_balls[None], omega_balls[None])[0]
        # two enclosures of one number: they meet, and are narrow enough for that to say something
        assert all(a.overlaps(b) and float(a.rad()) < 1e-60 for a, b in zip(found, literal, strict=True))
    np.testing.assert_allclose(
        chain_accelerations(floats(), rods, theta, omega),
        literal_accelerations(rods, theta, omega),
        rtol=1e-9,
    )


@pytest.mark.slow
def test_long_chain_runs_on_the_joint_forces(monkeypatch):
    rods = RodChain((1.0, 0.8, 0.6))
    state = (2.0, 2.5, 1.5), (0.0, 1.0, 0.0)
    dense = quadruple_trajectory(rods, *state, [0.0, 1.0])
    monkeypatch.setattr(quadruple, "LARGEST_DENSE_N", 1)
    along = quadruple_trajectory(rods, *state, [0.0, 1.0])
    # the same problem in other rounding: quadruple's error times the motion's growth
    np.testing.assert_allclose(along.theta + 0.0, dense.theta, rtol=2.0**-52)
    difference = np.abs((along.theta - dense.theta) + (along.theta_low - dense.theta_low))
    assert difference.max() < 1e-28


def test_error_estimate_covers_what_a_still_finer_run_finds(monkeypatch):
    coarse = quadruple_trajectory(DOUBLE, START, REST, [0.0, 4.0])
    monkeypatch.setattr(quadruple, "TOLERANCES", (1e-24, 1e-20))
    rough = quadruple_trajectory(DOUBLE, START, REST, [0.0, 4.0])
    off = np.abs((rough.theta - coarse.theta) + (rough.theta_low - coarse.theta_low)).max()
    assert 0 < off <= rough.error[1]


def test_without_heyoka_a_clear_line(monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "heyoka", None)
    with pytest.raises(LibraryMissing, match=r"^this needs heyoka: pip install 'furiko\[truth\]'$"):
        quadruple_trajectory(DOUBLE, START, REST, [0.0, 1.0])


def test_kept_end_points_are_those_of_the_catalogue():
    kept = json.loads(endpoints.PATH.read_text(encoding="utf-8"))
    wanted = {scene.name for scene in document_scenes() if scene.theta is not None and scene.duration > 0}
    assert {entry["scene"] for entry in kept.values()} == wanted
    for scene in document_scenes():
        if scene.name in wanted:
            key = endpoints._key(scene.system, scene.theta, scene.omega, endpoints._times(scene.duration))
            assert kept[key]["scene"] == scene.name, (
                "the scene has changed: python -m furiko.reference.truth.end_points"
            )
            assert max(kept[key]["error"]) < 1e-20


@pytest.mark.parametrize("name", ["double-pendulum", "rods-1", "two-legs"])
def test_kept_end_points_can_be_made_again(name):
    scene = find_scene(name)
    ((key, made),) = endpoints.entries([scene]).items()
    kept = json.loads(endpoints.PATH.read_text(encoding="utf-8"))[key]
    assert made["times"] == kept["times"]
    for new, old, error in zip(made["states"], kept["states"], kept["error"], strict=True):
        for a, b in zip(new, old, strict=True):
            assert a[:20] == b[:20] or abs(float(a) - float(b)) <= 10 * error
    found = lookup(scene.system, scene.theta, scene.omega, scene.duration)
    assert found.theta.shape == (4, scene.system.n)
    np.testing.assert_array_equal(found.theta[3], [float(x) for x in kept["states"][3][: scene.system.n]])


def test_lookup_uses_what_is_kept_and_else_computes(monkeypatch):
    scene = find_scene("rods-5")
    monkeypatch.setattr(quadruple, "decimal_states", lambda *_: pytest.fail("computed what is kept"))
    lookup(scene.system, scene.theta, scene.omega, scene.duration)
    monkeypatch.undo()
    new = lookup(DOUBLE, (0.5, 0.25), REST, 0.5)
    direct = quadruple_trajectory(DOUBLE, (0.5, 0.25), REST, [0.0, 0.0625, 0.125, 0.25, 0.5])
    np.testing.assert_array_equal(new.theta, direct.theta[1:])


def test_keys_tell_apart_what_differs_and_nothing_else():
    times = [1.0]
    key = endpoints._key(DOUBLE, START, REST, times)
    assert key == endpoints._key(NLegPendulum((1, 1), (1, 1)), np.array(START), (0, 0), (1,))
    others = [
        endpoints._key(NLegPendulum((1.0, 1.0), (1.0, 1.0), 9.8), START, REST, times),
        endpoints._key(RodChain((1.0, 1.0)), START, REST, times),
        endpoints._key(DOUBLE, START, (0.0, 1e-300), times),
        endpoints._key(DOUBLE, START, REST, [2.0]),
    ]
    assert len({key, *others}) == 5


def test_writing_the_data(tmp_path):
    scene = Scene("mine", DOUBLE, START, REST, duration=0.25)
    path = tmp_path / "new" / "endpoints.json"
    assert endpoints.write([scene, Scene("still", DOUBLE, START, REST)], path) == 1
    (entry,) = json.loads(path.read_text(encoding="utf-8")).values()
    assert entry["scene"] == "mine"
    assert entry["times"] == [0.03125, 0.0625, 0.125, 0.25]
    assert len(entry["states"]) == 4
    assert len(entry["states"][0]) == 4
