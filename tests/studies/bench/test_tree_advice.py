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
from furiko.studies.stress.tree_trust import trust


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
