"""Axes of open mechanisms: what a rung is, what it measures, and that each kind of wrong engine is found on it."""

import numpy as np
import pytest
from fake_tree_engines import Right

from furiko.engines import engine_info
from furiko.models import InvalidInput, find_scene
from furiko.reference.truth.spatial import spatial_truth
from furiko.stress import chosen_axes, stress
from furiko.studies.stress.searches import make_searches
from furiko.studies.stress.trees import posed as made
from furiko.studies.stress.trees.axes import BASES, TREE_AXES, drawn, find_ladders, ladders_of, tree_ladders
from furiko.studies.stress.trees.case import TreeCase
from furiko.studies.stress.trees.mechanisms import chain, floating

ENGINE = "fake_tree_engines:Right"
NAMES = tuple(tree_ladders())


@pytest.mark.parametrize("name", NAMES)
def test_the_first_rung_is_harmless_and_the_last_is_a_mechanism(name):
    ladder = tree_ladders()[name]
    last = ladder.posed(ladder.top, 1)
    assert np.isfinite(last.q).all()
    assert np.isfinite(last.v).all()
    found = TreeCase(name, "kernels", 0, 1).run()
    assert found.details["failure"] is None
    assert found.measured < 1e-13  # a few dozen roundings, and what the pose multiplies them by
    assert found.details["error over bound"] < 0.1


@pytest.mark.parametrize("base", BASES)
def test_a_factor_of_one_changes_nothing(base):
    posed = drawn(find_scene(base), 1)
    for axis in TREE_AXES:
        if axis.start == 1 and not axis.unit and axis.applies(posed.system):
            changed = axis.change(posed, 1.0)
            assert changed.system == posed.system
            assert (changed.q == posed.q).all(), axis.name
            assert (changed.v == posed.v).all()


@pytest.mark.parametrize("base", BASES)
def test_other_units_are_the_same_motion(base):
    """By dimensions: accelerations are the same with all masses, and angular ones with all lengths, in another unit."""
    posed = drawn(find_scene(base), 1)
    turning = [i for i, name in enumerate(posed.system.freedoms) if name not in sliding(posed.system)]
    for change, power in ((made.smaller_masses, 0), (made.smaller_lengths, 0), (made.slower, 2)):
        other = change(posed, 2.0**-30)
        for q, v, new_q, new_v in zip(posed.q, posed.v, other.q, other.v, strict=True):
            before, after = (
                spatial_truth(system.mechanism(), *state).accelerations.float[turning]
                for system, state in ((posed.system, (q, v)), (other.system, (new_q, new_v)))
            )
            assert after == pytest.approx(before * 2.0 ** (-30 * power), rel=1e-12, abs=1e-12 * np.abs(after).max())


def sliding(system):
    """Freedoms that are lengths."""
    return {f"{j.name}[{k}]" for j in system.joints for k in (1, 2, 3) if j.kind == "free"} | {
        j.name for j in system.joints if j.kind == "slide"
    }


def test_what_each_change_does_by_hand():
    posed = made.Posed(chain(4), np.full((1, 4), 0.5), np.full((1, 4), 2.0))
    heavy = made.heavy_links(posed, 8.0).system.links
    assert [link.mass for link in heavy] == [0.5, 4.0, 0.5, 4.0]
    assert heavy[1].inertia == tuple(8 * part for part in posed.system.links[1].inertia)
    light = made.light_tips(posed, 0.25).system.links
    assert [link.mass for link in light] == [0.5, 0.5, 0.5, 0.125]
    long = made.long_links(posed, 4.0).system.links
    # The second and the fourth: what hangs on the second hangs four times as far from its joint.
    assert [link.centre[2] for link in long] == [-0.25, -1.0, -0.25, -1.0]
    assert [link.position[2] for link in long] == [0.0, -0.5, -2.0, -0.5]
    assert (made.fast(posed, 4.0).v == 8.0).all()
    assert (made.straight(posed, 0.25).q == 0.125).all()
    free = made.Posed(floating(), np.ones((1, 15)), np.ones((1, 12)))
    far, quick = made.far_base(free, 8.0), made.fast_base(free, 8.0)
    assert far.q[0, :3].tolist() == [9.0, -3.0, 3.0]
    assert (far.q[0, 3:] == 1).all()
    assert quick.v[0, :3].tolist() == [5.0, 9.0, -1.0]
    assert (quick.v[0, 3:] == 1).all()
    assert made.quaternion_lengths(free, 4.0).q[0].tolist() == [1] * 3 + [4] * 12
    assert made.half_turns(free, 0.25).q[0, [3, 7, 11]].tolist() == [0.25] * 3


def test_axes_apply_where_there_is_something_to_change():
    names = {base: {ladder.axis.name for ladder in ladders_of(find_scene(base))} for base in BASES}
    assert "far-base" in names["cart-pole"]  # it slides
    assert "far-base" not in names["acrobot"]
    assert "half-turns" not in names["arm-7"]
    assert {"half-turns", "far-base", "long-quaternions"} <= names["quadruped"]


def heaviest(self):
    return max(body.inertial.mass for body in self.mechanism.bodies)


@pytest.mark.parametrize(
    ("off", "failure"),
    [
        (1 + 1e-9, "more than rounding"),  # half the digits are there, and yet no rounding explains it
        (1.1, "wrong numbers that look right"),
        (np.nan, "NaN"),
    ],
)
def test_an_engine_that_is_wrong_about_heavy_links_is_found_where_it_is(monkeypatch, off, failure):
    true = Right.accelerations
    monkeypatch.setattr(
        Right, "accelerations", lambda self, q, v: true(self, q, v) * (off if heaviest(self) > 1000 else 1)
    )
    results = [TreeCase("chain: heavy-links", ENGINE, rung, 1).run() for rung in range(8)]
    # A link weighs a third of a kilogram; fourfold from rung to rung: 4^5/3 = 341 kg, 4^6/3 = 1365 kg.
    assert [result.details["failure"] for result in results] == [None] * 6 + [failure] * 2
    assert all(result.details["error over bound"] < 0.1 for result in results[:6])


def test_an_engine_that_normalises_no_quaternion_is_found(monkeypatch):
    true = Right.accelerations

    def without(self, q, v):
        size = np.linalg.norm(q[:, 3:7], axis=-1, keepdims=True)
        return true(self, q, v) * np.where(np.abs(size - 1) < 0.5, 1.0, 1 + 1e-6 * size)

    monkeypatch.setattr(Right, "accelerations", without)
    names = ("floating: long-quaternions", "floating: short-quaternions", "floating: half-turns")
    failures = [TreeCase(name, ENGINE, 1, 1).run().details["failure"] for name in names]
    assert failures == ["wrong numbers that look right", None, None]


def test_an_engine_that_flushes_subnormals_is_found_on_units_alone(monkeypatch):
    """An engine whose inertias below the normal range are zero: none but the smallest units shows it."""
    true = Right.accelerations

    def flushing(self, q, v):
        lost = heaviest(self) < 2.0**-1010
        return true(self, q, v) * (1.01 if lost else 1.0)

    monkeypatch.setattr(Right, "accelerations", flushing)
    assert TreeCase("chain: small-masses", ENGINE, 100, 1).run().outcome == "agrees"
    assert TreeCase("chain: small-masses", ENGINE, 101, 1).run().details["failure"] == "wrong numbers that look right"


def test_what_an_engine_cannot_hold_is_refused():
    result = TreeCase("floating: fast", "exudyn-tree", 0, 1).run()
    assert (result.outcome, result.details["failure"]) == ("skipped", "refused")
    assert "hinges and slides alone" in result.reason


def test_masses_and_inertias_below_an_engines_least_are_refused_with_the_link():
    light = TreeCase("chain: small-masses", "pinocchio-aba", 10, 1).run()
    assert light.details["failure"] == "refused"
    assert "takes masses from 2.22045e-16 kg" in light.reason
    assert "'rod 1'" in light.reason
    thin = TreeCase("arm-7: small-lengths", "mujoco", 6, 1).run()
    assert "takes inertias about a joint from 1e-15 kg m²" in thin.reason


def test_an_exception_in_one_case_leaves_the_others(monkeypatch, tmp_path):
    found = stress(["chain: fast", "chain: straight"], ["fake_tree_engines:Raises", "mujoco"], budget=60, jobs=1)
    by = {(f.engine, f.axis): f for f in found.frontiers}
    assert not found.open
    for axis in ("chain: fast", "chain: straight"):
        assert (by["fake_tree_engines:Raises", axis].failure, by["mujoco", axis].status) == ("exception", "holds")


def test_engines_without_an_adapter_for_trees_are_not_asked():
    infos = [engine_info("exudyn-redundant"), engine_info("mujoco")]
    searches = make_searches((), infos, ("document", "kernels"), seed=1, families=("trees",))
    assert {search.subject for search in searches} == {"mujoco", "kernels"}
    assert len(searches) == 2 * len(NAMES)


def test_names_of_an_axis_a_mechanism_and_both():
    assert [ladder.name for ladder in find_ladders("arm-7: fast")] == ["arm-7: fast"]
    assert {ladder.base.name for ladder in find_ladders("half-turns")} == {"quadruped", "humanoid", "floating"}
    assert {ladder.axis.name for ladder in find_ladders("gimbal")} == {"gimbal-lock"}
    _, trees, families = chosen_axes(["acrobot", "long-rods"])
    assert {ladder.base.name for ladder in trees} == {"acrobot"}
    assert families == ("trees", "accelerations")
    assert chosen_axes(["trees", "acrobot"])[1] == ()  # all


def test_a_cut_off_run_says_what_is_open():
    found = stress(["chain"], ["fake_tree_engines:Slow"], budget=1, jobs=1)
    assert found.open > 0
    assert {f.status for f in found.frontiers} == {"open"}


def test_frontiers_are_on_the_page_and_in_words(tmp_path, capsys):
    from furiko.cli.main import run

    assert run(["stress", "-a", "gimbal-lock", "-a", "cart-pole: fast", "-e", "mujoco", "--out", str(tmp_path)]) == 0
    text = capsys.readouterr().out
    assert "open mechanisms fail from" in " ".join(text.split())
    assert "(gimbal: digits)" in " ".join(text.split())
    assert "gimbal: gimbal-lock" in (tmp_path / "stress.html").read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.sweep
def test_no_engine_that_is_right_is_beyond_the_bound_anywhere():
    """The bound of rounding is derived: on no rung of any ladder is a right engine beyond it."""
    found = stress(["trees"], ["kernels", "mujoco", "pin", "exudyn-tree"], budget=600)
    assert not found.open
    over = {(f.engine, f.axis): max(p.error_over_bound or 0.0 for p in f.curve) for f in found.frontiers}
    assert max(over.values()) <= 1, [name for name, value in over.items() if value > 1]
    assert not found.kernels.broken


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("arm-7: fats", "arm-7: fast"),
        ("heavy-link", "heavy-links"),
        ("long-rod", "long-rods"),
        ("zzz", "trees, and all"),
    ],
)
def test_a_name_that_is_none_is_answered_with_the_nearest(name, says):
    with pytest.raises(InvalidInput, match=f"none is called '{name}'.*{says}"):
        chosen_axes([name])


def test_a_mass_matrix_without_factors_is_a_finding_in_words_and_no_crash():
    result = TreeCase("gimbal: gimbal-lock", "pinocchio-crba", 13, 2018).run()
    assert (result.outcome, result.details["failure"]) == ("skipped", "refused")
    assert "not positive definite" in result.reason
    assert "Use pinocchio-aba" in result.reason
