"""Ladders of open mechanisms: what a rung measures, what a fault and a refusal look like, and the whole family."""

import pytest
from fake_tree_engines import Right

from furiko.engines import engine_info
from furiko.stress import stress
from furiko.studies.stress.searches import make_searches
from furiko.studies.stress.trees import TREE_LADDERS, TreeCase, chain


@pytest.mark.parametrize("name", TREE_LADDERS)
def test_the_first_rung_is_harmless_and_every_rung_is_a_mechanism(name):
    ladder = TREE_LADDERS[name]
    for rung, value in enumerate(ladder.values):
        assert ladder.system(value).n >= 2
        assert ladder.label(rung).startswith(f"{value:g}")
    # A few dozen roundings at most for a handful of links of like size.
    assert TreeCase(name, "mujoco", 0, 1).run().measured < 1e-13


def test_a_chain_has_the_mass_and_length_that_it_says():
    links = chain(8).links
    assert sum(link.mass for link in links) == pytest.approx(2.0)
    assert sum(-2 * link.centre[2] for link in links) == pytest.approx(2.0)
    assert chain(6, last_mass=1e-3).links[-1].mass == pytest.approx(1e-3 / 3)


def test_a_right_engine_holds_and_a_wrong_one_fails(monkeypatch):
    assert TreeCase("tree tip mass", "fake_tree_engines:Right", 0, 1).run().outcome == "agrees"
    true = Right.accelerations
    monkeypatch.setattr(Right, "accelerations", lambda self, q, v: (1 + 1e-7) * true(self, q, v))
    wrong = TreeCase("tree tip mass", "fake_tree_engines:Right", 0, 1).run()
    assert wrong.details["failure"] == "half its digits lost"
    assert wrong.measured == pytest.approx(1e-7, rel=1e-6)


def test_what_an_engine_cannot_hold_is_refused():
    result = TreeCase("tree limb mass", "exudyn-tree", 0, 1).run()
    assert (result.outcome, result.details["failure"]) == ("skipped", "refused")
    assert "hinges and slides alone" in result.reason


def test_engines_without_an_adapter_for_trees_are_not_asked():
    infos = [engine_info("exudyn-redundant"), engine_info("mujoco")]
    searches = make_searches((), infos, (), seed=1, families=("trees",))
    assert {search.subject for search in searches} == {"mujoco"}
    assert len(searches) == len(TREE_LADDERS)


def test_the_family_runs_by_its_name(tmp_path):
    found = stress(["trees"], ["mujoco"], budget=60, out=tmp_path)
    assert {frontier.axis for frontier in found.frontiers} == set(TREE_LADDERS)
    assert not found.open
    page = (tmp_path / "stress.html").read_text(encoding="utf-8")
    assert "tree freedoms" in page
