"""What all renderings share: the worst of a cell, the counts, the flaws, the exit status."""

import itertools

import pytest

from furiko.records.check import Footer
from furiko.reports.report import Report, share


@pytest.mark.parametrize(
    ("outcomes", "worst", "status"),
    [
        (["agrees"], "agrees", 0),
        (["agrees", "skipped"], "agrees", 0),
        (["skipped"], "skipped", 0),
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
        (["agrees", "differs"], "1 of 2 comparisons differs."),
        (["differs", "differs", "skipped"], "2 of 2 comparisons differ; 1 skipped, each with its reason."),
        (["agrees", "agrees", "error"], "All 2 comparisons agree; 1 failed."),
        (["error"], "No comparison finished; 1 failed."),
        (["skipped"], "Nothing was compared; 1 skipped, each with its reason."),
    ],
)
def test_verdict(make, outcomes, verdict):
    results = [make.result(outcome, check=str(i)) for i, outcome in enumerate(outcomes)]
    assert make.report(*results).verdict == verdict
    assert make.report(*results, footer=False).verdict.startswith("Until the cut: ")


def test_the_command_that_runs_a_row_again_is_one_shell_command(make):
    report = make.report(make.result(scene="it's"), scenes=[make.scene("it's", source="my scenes/it's.toml")])
    assert report.again("it's") == ("""furiko check 'my scenes/it'"'"'s.toml' --profile full""")
    assert report.again("not in the header") == "furiko check 'not in the header' --profile full"


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
