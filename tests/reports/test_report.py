"""What all renderings share: the worst of a cell, the counts, the flaws, the exit status."""

import itertools

import msgspec
import pytest

from furiko.records.check import Diagnosis, Footer
from furiko.reports.report import Report, against_line, footer_of, share


@pytest.mark.parametrize(
    ("outcomes", "worst", "status"),
    [
        (["agrees"], "agrees", 0),
        (["agrees", "skipped"], "agrees", 0),
        (["skipped"], "skipped", 3),
        (["agrees", "error"], "error", 3),
        (["agrees", "differs"], "differs", 1),
        (["agrees", "error", "differs", "skipped"], "differs", 1),
    ],
)
def test_worst_outcome_and_exit_status(make, outcomes, worst, status):
    for order in itertools.permutations(outcomes):
        report = make.report(*(make.result(outcome, check=outcome) for outcome in order))
        assert report.table["rods-2", "mujoco"].outcome == worst
        assert report.exit_status == status


def test_a_run_that_was_cut_off_is_no_success(make):
    assert make.report(make.result(), footer=False).exit_status == 3
    assert make.report(make.result("differs"), footer=False).exit_status == 1


def test_a_pair_that_left_no_result_is_a_flaw(make):
    report = make.report(make.result(), engines=[make.engine("mujoco"), make.engine("exudyn-tree")])
    assert report.exit_status == 3
    assert "1 pair" in report.flaws[0]
    assert "rods-2 × exudyn-tree" in report.flaws[0]


def test_a_footer_that_contradicts_the_results_is_a_flaw(make):
    report = Report(make.header(), (make.result(),), Footer(agrees=2, differs=0, skipped=0, error=0))
    assert not report.complete
    assert "agrees 2 (found 1)" in report.flaws[0]
    assert report.exit_status == 3


def test_worst_error_of_a_cell(make):
    report = make.report(
        make.result(check="a", measured=6.0, allowed=100.0),
        make.result(check="b", measured=3.0, allowed=4.0),
        make.result(check="c", measured=0.5, allowed=1.0, unit="m"),
        make.result("skipped", check="d"),
    )
    cell = report.table["rods-2", "mujoco"]
    assert cell.rounding == 6.0
    assert cell.worst.check == "b"
    assert cell.share == 0.75
    assert cell.error == "6 ε"


def test_a_cell_that_differs_is_judged_by_what_differs(make):
    report = make.report(
        make.result("agrees", check="a", measured=0.9, allowed=1.0),
        make.result("differs", check="b", measured=7, allowed=2),
    )
    assert report.table["rods-2", "mujoco"].share == 3.5
    assert report.table["rods-2", "mujoco"].error == "3.5 ×"


@pytest.mark.parametrize(
    ("measured", "allowed", "expected"),
    [(1, 4, 0.25), (-1, 4, 0.25), (0, 0, 0), (1, 0, float("inf")), (None, 4, None), (1, None, None)],
)
def test_share_of_the_allowed(make, measured, allowed, expected):
    assert share(make.result(measured=measured, allowed=allowed)) == expected


def test_scenes_and_engines_that_only_results_name_are_shown(make):
    report = make.report(make.result(), make.result("differs", scene="other", engine="foreign"))
    assert report.scenes == ("rods-2", "other")
    assert report.engines == ("mujoco", "foreign")
    assert report.table["other", "foreign"].outcome == "differs"


@pytest.mark.parametrize(
    ("outcomes", "verdict"),
    [
        ([], "Nothing was compared."),
        (["agrees"], "The one comparison agrees."),
        (["agrees"] * 1200, "All 1,200 comparisons agree."),
        (["agrees", "differs"], "1 of 2 comparisons differs; 1 agrees."),
        (["differs", "differs", "skipped"], "2 of 2 comparisons differ; 1 skipped, each with its reason."),
        (["agrees", "agrees", "error"], "1 comparison failed; 2 agree."),
        (["error"], "1 comparison failed; nothing was compared."),
        (["skipped"], "Nothing was compared; 1 skipped, each with its reason."),
        (["agrees"] * 30 + ["error"] * 9, "9 comparisons failed; 30 agree."),
        (["differs", "error", "loose", "agrees"], "1 of 3 comparisons differs; 1 failed; 1 is loose; 1 agrees."),
        (["loose", "loose", "agrees"], "2 of 3 comparisons are loose; 1 agrees."),
        (["loose"], "1 of 1 comparison is loose."),
    ],
)
def test_verdict(make, outcomes, verdict):
    results = [make.result(outcome, check=str(i)) for i, outcome in enumerate(outcomes)]
    assert make.report(*results).verdict == verdict
    assert make.report(*results, footer=False).verdict.startswith("Until the cut: ")


def test_the_command_that_runs_a_row_again_is_one_shell_command(make):
    report = make.report(make.result(scene="it's"), scenes=[make.scene("it's", source="my scenes/it's.toml")])
    assert report.again("it's") == ("""furiko check 'my scenes/it'"'"'s.toml' --profile full --no-cache""")
    assert report.engine_option("it's") == """-e 'it'"'"'s'"""
    assert report.again("not in the header") == "furiko check 'not in the header' --profile full --no-cache"


@pytest.mark.parametrize(
    ("outcomes", "says"),
    [
        (("differs", "agrees", "agrees"), "Only one differs in rods-2: the equations and the other engines agree."),
        (("differs", "differs", "differs"), "All engines differ from the equations in rods-2."),
        (("differs", "differs", "agrees"), None),  # two against one and the equations: nobody is blamed
        (("differs", "agrees", "skipped"), None),  # one engine is no second witness
        (("agrees", "agrees", "agrees"), None),
    ],
)
def test_outliers_are_found_by_a_vote(make, outcomes, says):
    named = zip(("one", "two", "three"), outcomes, strict=True)
    report = make.report(*(make.result(outcome, engine=engine) for engine, outcome in named))
    assert report.outliers == ((says,) if says else ())


def test_an_engine_is_not_the_only_one_where_another_differs_in_another_check(make):
    """Of three engines one differs in accelerations, one in energy: of neither may it be said that the others agree."""
    wrong = {("one", "accelerations"), ("two", "energy")}
    results = [
        make.result("differs" if (engine, check) in wrong else "agrees", engine=engine, check=check)
        for check in ("accelerations", "energy")
        for engine in ("one", "two", "three", "four")
    ]
    assert make.report(*results).outliers == ()
    alone = [result for result in results if result.engine != "two"]
    assert make.report(*alone).outliers == ("Only one differs in rods-2: the equations and the other engines agree.",)


@pytest.mark.parametrize("bad", ["differs", "error", "loose"])
def test_all_agree_is_never_said_beside_anything_else(make, bad):
    results = [make.result(check=str(i)) for i in range(30)]
    for report in (
        make.report(*results, make.result(bad)),
        make.report(*results, footer=False),
        make.report(*results, engines=[make.engine("mujoco"), make.engine("exudyn-tree")]),
        make.report(*results, results[0]),
        make.report(*results, make.result("skipped", engine="late"), engines=[make.engine("late", asked=True)]),
    ):
        assert "all" not in report.verdict.lower()
        assert report.exit_status_of(sharp=True) != 0
    assert make.report(*results).verdict == "All 30 comparisons agree."


@pytest.mark.parametrize(
    ("outcomes", "plain", "sharp"),
    [
        (["agrees"], 0, 0),
        (["agrees", "loose"], 0, 1),
        (["agrees", "loose", "error"], 3, 1),
        (["agrees", "error"], 3, 3),
        (["differs", "error"], 1, 1),
        ([], 3, 3),
        (["skipped"], 3, 3),
    ],
)
def test_exit_status_with_the_sharp_line(make, outcomes, plain, sharp):
    report = make.report(*(make.result(outcome, check=str(i)) for i, outcome in enumerate(outcomes)))
    assert report.exit_status == report.exit_status_of(sharp=False) == plain
    assert report.exit_status_of(sharp=True) == sharp


def test_a_run_in_which_nothing_was_compared_says_so(make):
    report = make.report(make.result("skipped"))
    assert report.complete
    assert report.flaws == ("No comparison was made, so this run proves nothing.",)
    assert make.report(make.result("error")).flaws == ()


@pytest.mark.parametrize("asked", [True, False])
def test_what_was_asked_for_must_be_compared(make, asked):
    skipped = make.report(
        make.result(),
        make.result("skipped", engine="exudyn-tree"),
        engines=[make.engine("mujoco"), make.engine("exudyn-tree", asked=asked)],
    )
    scene = make.report(
        make.result(),
        make.result("skipped", scene="rods-100"),
        scenes=[make.scene(), make.scene("rods-100", asked=asked)],
    )
    assert [report.exit_status for report in (skipped, scene)] == ([3, 3] if asked else [0, 0])
    if asked:
        assert skipped.flaws == ("exudyn-tree was asked for, and nothing of it was compared: each check was skipped.",)
        assert scene.flaws[0].startswith("rods-100 was asked for")
        assert skipped.verdict == "Incomplete: 1 agrees; 1 skipped, each with its reason."


def test_a_result_that_is_in_the_stream_twice_is_a_flaw(make):
    twice = make.result(seconds=0.25)
    header = make.header()
    assert Report(header, (twice,), footer_of([twice])).complete
    report = Report(header, (twice, twice), footer_of([twice, twice]))
    # As often as a result was doubled, another one is gone: the footer's counts alone do not show it.
    copied = Report(header, (twice, msgspec.structs.replace(twice)), footer_of([twice, twice]))
    for found in (copied, report):
        assert not found.complete
        assert found.exit_status == 3
        assert "1 result in it twice, the first rods-2 × mujoco, accelerations" in found.flaws[0]


def test_the_footer_counts_loose_results_and_diagnoses(make):
    results = (make.result("loose"), make.result("differs", check="energy"))
    diagnosis = Diagnosis(scene="rods-2", engine="mujoco", explains=["energy"])
    footer = footer_of(results, [diagnosis], 1.0)
    assert (footer.agrees, footer.differs, footer.loose, footer.diagnoses) == (1, 1, 1, 1)
    assert Report(make.header(), results, footer, (diagnosis,)).complete
    assert "diagnoses 1 (found 0)" in Report(make.header(), results, footer).flaws[0]
    tight = (msgspec.structs.replace(results[0], loose=False), results[1])
    assert "loose 1 (found 0)" in Report(make.header(), tight, footer, (diagnosis,)).flaws[0]


def test_a_cell_that_is_loose_shows_its_loosest_result(make):
    report = make.report(
        make.result(check="a", measured=60.0), make.result("loose", check="b"), make.result("skipped", check="c")
    )
    cell = report.table["rods-2", "mujoco"]
    assert (cell.outcome, cell.word, cell.worst.check, cell.error) == ("agrees", "loose", "b", "50 ε")
    assert report.words == {"differs": 0, "error": 0, "loose": 1, "agrees": 1, "skipped": 1}
    graver = make.report(make.result("loose"), make.result("differs", check="b"))
    assert graver.table["rods-2", "mujoco"].word == "differs"


def test_loose_results_are_ordered_by_the_sharp_line(make):
    report = make.report(
        make.result("loose", check="a", measured=60.0, line=30.0), make.result("loose", check="b", measured=8, line=1)
    )
    assert [result.check for result in report.loose] == ["b", "a"]
    assert against_line(report.loose[0]) == "8 ε, rounding gives at most 1 ε"
    assert against_line(make.result("loose", line=None)) == "50 ε against 64 ε allowed"
