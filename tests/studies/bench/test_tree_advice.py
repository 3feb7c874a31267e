"""``furiko advise`` of open mechanisms: trust in engines that are wrong in a known way, steps against a formula."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from fake_tree_engines import BLOCK, SMALL

from furiko.advise import advise
from furiko.cli.main import run
from furiko.engines import engine_info
from furiko.models import InvalidInput, find_scene
from furiko.studies.bench.tree_methods import tree_methods, tree_reference
from furiko.studies.stress.tree_long_runs import Advisable, long_runs
from furiko.studies.stress.tree_trust import trust
from furiko.studies.stress.trees.runs import TIMES, TreeRunCase


def file(tmp_path, text):
    path = tmp_path / "own.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def trusted(scene, *names, budget=60):
    infos = [replace(engine_info(name), name=name) for name in names]
    return {one.engine.partition(":")[2] or one.engine: one for one in trust(scene, infos, budget)}


def test_each_engine_is_told_what_it_is(tmp_path):
    scene = find_scene(file(tmp_path, SMALL))
    found = trusted(scene, "fake_tree_engines:NotANumber", "fake_tree_engines:Raises", "exudyn-tree", "mujoco")
    assert {name: one.verdict for name, one in found.items()} == {
        "NotANumber": "wrong",
        "Raises": "failed",
        "exudyn-tree": "refused",
        "mujoco": "right",
    }
    assert next(iter(found)) == "mujoco"  # the most trustworthy first
    assert "no armature" in found["exudyn-tree"].reason
    assert found["exudyn-tree"].limits == []
    assert found["mujoco"].digits > 14
    assert found["mujoco"].error_over_bound < 1
    assert all(limit.closed for limit in found["mujoco"].limits)


def test_where_it_stops_is_told_for_the_very_scene(tmp_path):
    scene = find_scene(file(tmp_path, SMALL))
    found = trusted(scene, "fake_tree_engines:FailsWhenFast")["FailsWhenFast"]
    assert found.verdict == "right"
    fast = next(limit for limit in found.limits if limit.axis == "fast")
    # Rates are at most some 30 rad/s there; it fails beyond 1000 rad/s, between 4³ and 4⁴ times.
    assert (fast.holds_at, fast.fails_at, fast.failure) == ("64", "2.6e+02", "more than rounding")
    others = [limit for limit in found.limits if limit.axis in ("heavy-links", "straight", "many-turns")]
    assert [limit.fails_at for limit in others] == [None] * 3


def test_a_budget_that_is_too_small_leaves_questions_open(tmp_path):
    scene = find_scene(file(tmp_path, SMALL))
    found = trusted(scene, "fake_tree_engines:Slow", budget=1)["Slow"]
    assert found.limits
    assert not any(limit.closed for limit in found.limits)


def test_what_is_open_is_said(tmp_path, capsys):
    still = file(tmp_path, SMALL.partition("[state]")[0])
    run(["advise", still, "-e", "fake_tree_engines:Slow", "--budget", "1"])
    assert "questions open: a larger --budget answers them" in " ".join(capsys.readouterr().out.split())


def test_the_motion_is_the_closed_form_and_errors_are_against_it(tmp_path):
    """A block with spring and damper: q = r + e^(−ct)(A cos ωt + B sin ωt), by hand."""
    scene = find_scene(file(tmp_path, BLOCK))
    true = tree_reference(scene, 1e-6, (0.5, 1.0), 0.1)
    m, d, k, rest, q, v = 1.25, 0.75, 5.0, 0.25, 0.5, -1.0
    c, w = d / (2 * m), math.sqrt(k / m - (d / (2 * m)) ** 2)
    a, b = q - rest, (v + c * (q - rest)) / w
    t = 0.5
    end = rest + math.exp(-c * t) * (a * math.cos(w * t) + b * math.sin(w * t))
    assert true.motion.q[-1] == pytest.approx([end], abs=1e-12)
    assert true.off(1, (np.array([end + 1e-3]), true.motion.v[1])) == pytest.approx(1e-3, rel=1e-6)
    methods, left_out = tree_methods(scene, ["mujoco", "pinocchio-aba"])
    rk4 = next(method for method in methods if method.scheme == "RK4")
    errors = [true.off(1, rk4.run(0.5 / steps)) for steps in (16, 32)]
    assert errors[0] / errors[1] == pytest.approx(16, rel=0.1)  # of fourth order
    assert "pinocchio-aba: Pinocchio computes dynamics" in left_out[0]


def test_a_motion_that_is_not_known_well_enough_is_refused(tmp_path):
    scene = find_scene(file(tmp_path, BLOCK))
    with pytest.raises(InvalidInput, match="the motion itself is known to"):
        tree_reference(scene, 1e-6, (0.5, 1.0), 1e-12)


def test_both_are_told_of_a_scene_with_a_motion(tmp_path, capsys):
    assert run(["advise", file(tmp_path, BLOCK), "-e", "mujoco", "--budget", "8", "--error", "1e-4", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["trust"][0]["verdict"] == "right"
    assert found["advised"][0]["error"] <= 1e-4
    assert run(["advise", file(tmp_path, BLOCK), "-e", "mujoco", "--budget", "8", "--error", "1e-4"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "Accelerations of own (1 degree of freedom), against proven ones:" in text
    assert "Use mujoco with" in text


def test_without_a_motion_accelerations_are_told_alone_and_the_exit_status_says_whether_any_is_right(tmp_path, capsys):
    still = file(tmp_path, SMALL.partition("[state]")[0])
    assert run(["advise", still, "-e", "mujoco", "--budget", "5"]) == 0
    assert "Use " not in capsys.readouterr().out
    assert run(["advise", still, "-e", "fake_tree_engines:NotANumber", "--budget", "5"]) == 3
    assert "wrong" in capsys.readouterr().out


def test_engines_that_take_no_open_mechanism_are_refused_or_left_out(tmp_path):
    still = file(tmp_path, SMALL.partition("[state]")[0])
    with pytest.raises(InvalidInput, match="none of these engines takes open mechanisms"):
        advise(still, engines=["exudyn-redundant"], budget=5)
    found = advise(still, engines=["exudyn-redundant", "mujoco"], budget=5)
    assert "exudyn-redundant takes the documents' mechanisms alone" in found.left_out[0]


SWINGING = """
[system]
kind = "tree"

[[system.links]]
name = "bob"
mass = 1.0
centre = [0.0, 0.0, -0.5]
inertia = [0.01, 0.01, 0.01]
joints = [{ name = "hinge", axis = [0.0, 1.0, 0.0] }]

[state]
q = { hinge = 1.0 }
v = { hinge = 0.0 }
duration = 1.0
"""


@pytest.mark.slow
def test_an_advice_says_what_its_steps_keep_in_the_long_run(tmp_path, capsys):
    path = file(tmp_path, SWINGING)
    assert run(["advise", path, "-e", "mujoco", "--budget", "20", "--error", "1e-3", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    steps = {each["scheme"]: each["setting"] for each in found["advised"]}
    said = {(each["scheme"], each["motion"]): each for each in found["long runs"]}
    assert {motion for _, motion in said} == {"own", "pendulum"}  # a hinge: no quaternion, no slide
    for (scheme, _), each in said.items():
        assert each["step"] == steps[scheme]
        assert each["time"] >= 10 or each["failure"]
    assert said["RK4", "own"]["phase error"] is None  # of a user's own scene nothing is known so long
    assert 0 < said["RK4", "own"]["energy drift"] < 1
    assert said["RK4", "pendulum"]["phase error"] > 0
    # What it says of the known motion is what furiko stress says of it.
    again = TreeRunCase("mujoco", "RK4", "pendulum", steps["RK4"], TIMES.index(said["RK4", "pendulum"]["time"])).run()
    assert said["RK4", "pendulum"]["phase error"] == again.details["phase error"]
    assert run(["advise", path, "-e", "mujoco", "--budget", "8", "--error", "1e-3"]) == 0
    assert "In the long run, with these steps" in " ".join(capsys.readouterr().out.split())


def test_energy_that_drifts_is_measured_against_what_moves(tmp_path):
    """RK4 of a small swing takes (ωh)⁶/72 of its energy a step: |R(iωh)|² = 1 - (ωh)⁶/72 + …, by hand."""
    scene = find_scene(file(tmp_path, SWINGING.replace("hinge = 1.0", "hinge = 0.01")))
    rate = math.sqrt(9.81 * 0.5 / (0.25 + 0.01))
    step = 0.05
    taken = 1 - math.exp(-((rate * step) ** 6) / 72 * 1000 / step)
    own = next(each for each in long_runs(scene, [Advisable("mujoco", "RK4", step)], 60.0) if each.motion == "own")
    assert own.time == 1000
    # The next term is (ωh)²/8 of that, 0.6 %; the largest kinetic energy is looked at an eighth of a second apart.
    assert 0.99 * taken < own.energy_drift < taken / math.cos(rate / 16) ** 2


def test_what_a_damper_takes_is_no_drift_and_an_engine_that_raises_is_told(tmp_path, monkeypatch):
    from fake_tree_engines import Right

    scene = find_scene(file(tmp_path, BLOCK))
    (own,) = [each for each in long_runs(scene, [Advisable("mujoco", "RK4", 0.01)], 5.0) if each.motion == scene.name]
    assert (own.energy_drift, own.failure) == (None, None)
    monkeypatch.setattr(Right, "trajectory", lambda *_: 1 / 0)
    found = long_runs(scene, [Advisable("fake_tree_engines:Right", "RK4", 0.01)], 5.0)
    assert {each.failure for each in found} == {"ZeroDivisionError: division by zero"}


def test_an_integrator_whose_energy_runs_away_is_told_at_the_time_it_does(tmp_path, monkeypatch):
    from fake_tree_engines import Right

    true = Right.trajectory

    def faster(self, q, v, name, step, steps):
        end, rates = true(self, q, v, name, step, steps)
        return end, rates + 0.1 * step * steps

    monkeypatch.setattr(Right, "trajectory", faster)
    scene = find_scene(file(tmp_path, SWINGING))
    own = next(each for each in long_runs(scene, [Advisable("fake_tree_engines:Right", "RK4", 0.05)], 30.0))
    assert own.failure == "energy runs away"
    assert own.time >= 3
