"""Two runs side by side: each kind of change gets its mark, and equal runs none."""

import pytest

from furiko.reports.compare import compare
from furiko.reports.report import Report


def marks(comparison):
    return "".join(change.mark for change in comparison.changes)


def test_a_run_is_as_itself(make):
    run = make.large(links=(1, 20))
    comparison = compare(run, run)
    assert set(marks(comparison)) == {" "}
    assert comparison.exit_status == 0
    assert comparison.text() == f"{len(run.results)} comparisons unchanged."


@pytest.mark.parametrize(
    ("before", "after", "mark", "status"),
    [
        ("agrees", "differs", "!", 1),
        ("agrees", "error", "!", 1),
        ("skipped", "differs", "!", 1),
        ("error", "differs", "!", 1),
        ("differs", "agrees", "*", 0),
        ("error", "agrees", "*", 0),
        ("skipped", "agrees", "~", 0),
        ("agrees", "skipped", "~", 3),
        ("differs", "skipped", "~", 3),
        (None, "agrees", ">", 0),
        (None, "differs", "!", 1),
        ("agrees", None, "<", 3),
        ("skipped", "skipped", " ", 3),
    ],
)
def test_outcomes(make, before, after, mark, status):
    runs = [make.report(*([make.result(o)] if o else []), scenes=[]) for o in (before, after)]
    comparison = compare(*runs)
    assert marks(comparison) == mark
    assert comparison.exit_status == status
    if mark != " ":
        assert f"  {mark} rods-2 × mujoco, accelerations: " in comparison.text()


def test_what_became_loose_or_is_no_longer_is_marked(make):
    tight, loose = (make.report(make.result(outcome, measured=50.0)) for outcome in ("agrees", "loose"))
    assert marks(compare(tight, loose)) == marks(compare(loose, tight)) == "~"
    assert "agrees 50 ε → loose 50 ε" in compare(tight, loose).text()
    assert marks(compare(loose, loose)) == " "


@pytest.mark.parametrize(
    ("before", "after", "unit", "mark"),
    [
        (3.0, 5.9, "ε", " "),
        (3.0, 6.1, "ε", "+"),
        (6.1, 3.0, "ε", "-"),
        (1e-3, 0.9, "ε", " "),  # both under one rounding
        (0.0, 0.9, "ε", " "),
        (0.0, 2.1, "ε", "+"),
        (1e-3, 0.9, "m", "+"),
        (0.0, 1e-30, "m", "+"),
        (0.0, 0.0, "m", " "),
        (-4.0, 4.0, "m", " "),
        (3.0, None, "ε", "x"),
        (None, None, "ε", " "),
    ],
)
def test_errors(make, before, after, unit, mark):
    runs = [make.report(make.result(measured=m, unit=unit)) for m in (before, after)]
    assert marks(compare(*runs)) == mark


def test_other_bounds_and_units_cannot_be_compared(make):
    first = make.report(make.result())
    assert marks(compare(first, make.report(make.result(allowed=65.0)))) == "x"
    assert marks(compare(first, make.report(make.result(unit="m")))) == "x"


def test_comparisons_of_one_name_are_paired_in_their_order(make):
    first = make.report(make.result(measured=1.0), make.result(measured=50.0))
    second = make.report(make.result(measured=1.0), make.result(measured=5.0), make.result())
    assert marks(compare(first, second)) == " ->"


def test_a_run_that_was_cut_off_says_so_and_is_no_success(make):
    whole = make.report(make.result())
    comparison = compare(whole, Report(whole.header, whole.results))
    assert comparison.exit_status == 3
    assert comparison.text().startswith("second run: This run was cut off")


def test_the_text_is_one_line_a_change(make):
    nasty = "a\x1b[2J\nb"
    text = compare(make.report(), make.report(make.result("differs", scene=nasty, reason=nasty))).text()
    assert "\x1b" not in text
    assert text.splitlines()[1:2] == ["broke (1)"] or "broke (1)" in text
    assert "a\\x1b[2J b × mujoco, accelerations: none → differs 3.1 ε: a\\x1b[2J b" in text


def test_the_ratio_stands_beside_what_grew(make):
    text = compare(make.report(make.result(measured=3.0)), make.report(make.result(measured=30.0))).text()
    assert "  + rods-2 × mujoco, accelerations: agrees 3 ε → agrees 30 ε (10 ×)" in text
    assert text.endswith("1 error grew; 0 comparisons unchanged.")


def test_an_error_that_grew_beyond_the_factor_fails(make):
    runs = [make.report(make.result(measured=m)) for m in (3.0, 9.0)]
    assert compare(*runs).exit_status == 1
    assert compare(*runs, factor=4.0).exit_status == 0
    assert compare(*reversed(runs)).exit_status == 0


def test_other_versions_and_machines_are_told(make):
    engines = [[make.engine(version=version)] for version in ("4.0.0", "4.1.0.dev0")]
    machines = [{"system": "Linux", "processor": name} for name in ("one", "another")]
    before, after = (make.report(make.result(), engines=e, machine=m) for e, m in zip(engines, machines, strict=True))
    text = compare(before, after).text()
    assert text.splitlines()[:2] == [
        "other mujoco (mujoco): 4.0.0 → 4.1.0.dev0",
        "other processor: one → another",
    ]
    assert "other" not in compare(before, before).text()


def test_a_narrower_run_is_one_line_and_what_disappeared_within_it_is_not(make):
    scenes = [make.scene("rods-2"), make.scene("rods-3")]
    both = [
        make.result(scene=scene, check=check, comparison=check)
        for scene in ("rods-2", "rods-3")
        for check in ("terms", "energy")
    ]
    wide = make.report(*both, scenes=scenes)
    narrow = make.report(both[0], scenes=scenes[:1], profile="smoke")
    text = compare(wide, narrow).text()
    assert text.startswith("other profile: full → smoke\n3 comparisons not looked at in the second run: rods-2, rods-3")
    assert text.endswith("\n\n1 comparison unchanged.")
    lost = make.report(both[0], both[3], scenes=scenes)
    assert "disappeared (2)" in compare(wide, lost).text()
    assert "not looked at" not in compare(wide, lost).text()


def test_how_many_times_an_error_grew_is_told(make):
    comparison = compare(make.report(make.result(measured=2.0)), make.report(make.result(measured=7.0)))
    (change,) = comparison.changes
    assert change.ratio == 3.5
    assert "3.5 ×" in comparison.text()


def test_a_library_of_which_one_run_says_nothing_is_no_other_circumstance(make):
    old = make.report(make.result(), versions={"numpy": "2.0", "mujoco": "4.0.1"})
    new = make.report(make.result(), versions={"numpy": "2.1", "scipy": "1.15", "mujoco": "4.0.2"})
    # mujoco is the engine's package: its version is told with the engine, or not at all
    assert compare(old, new).circumstances == (("numpy", "2.0", "2.1"),)


def test_the_document_has_each_change_and_counts_the_rest(make):
    scenes = [make.scene("rods-2"), make.scene("rods-3")]
    before = make.report(
        make.result(check="a"), make.result(check="b", measured=2.0), make.result(check="c"),
        make.result(scene="rods-3"), scenes=scenes, engines=[make.engine(version="4.0.0")],
    )  # fmt: skip
    after = make.report(
        make.result("differs", check="a", measured=900.0, reason="gravity"), make.result(check="b", measured=9.0),
        make.result(check="c"), scenes=scenes[:1], engines=[make.engine(version="4.1.0")],
    )  # fmt: skip
    found = compare(before, after, factor=3.0).document()
    broke, grew = found.changes
    assert (broke.change, broke.check, broke.before, broke.after) == ("broke", "a", "agrees", "differs")
    assert (broke.error_after, broke.reason) == (900.0, "gravity")
    assert (grew.change, grew.check, grew.error_before, grew.error_after, grew.ratio) == (
        "error grew", "b", 2.0, 9.0, 4.5,
    )  # fmt: skip
    assert (found.unchanged, found.not_looked_at, found.exit_status, found.factor) == (1, 1, 1, 3.0)
    assert [(one.what, one.before, one.after) for one in found.circumstances] == [("mujoco (mujoco)", "4.0.0", "4.1.0")]
    assert found.summary == "1 broke; 1 error grew; 1 comparison unchanged."
