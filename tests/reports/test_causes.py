"""What differs, grouped: each cause once, whole, with what it explains; then what is left."""

import pytest

from furiko.records.check import Diagnosis
from furiko.records.findings import Difference
from furiko.reports.causes import group_causes
from furiko.reports.ci.junit import to_junit
from furiko.reports.ci.markdown import to_markdown
from furiko.reports.pages.check_page import to_html
from furiko.reports.report import Report, footer_of

CHECKS = ("accelerations", "terms M", "terms gravity", "energy")
GRAVITY = Difference(
    cause="gravity", where="mujoco", measured=9.8, expected=9.81, says="mujoco: gravity is 9.8 m/s², asked for 9.81"
)


def mass(link: int, measured: float, expected: float = 1.0) -> Difference:
    says = f"mujoco: mass of link {link} is {measured}, asked for {expected} kg"
    return Difference(cause="mass", where=f"link {link}", measured=measured, expected=expected, says=says)


def diagnosis(scene="rods-2", findings=(), alternatives=(), explains=CHECKS, engine="mujoco") -> Diagnosis:
    return Diagnosis(
        scene=scene,
        engine=engine,
        findings=list(findings),
        alternatives=list(alternatives),
        explains=list(explains),
    )


def run(make, diagnoses, scenes=("rods-2",), checks=CHECKS, **fields) -> Report:
    """Every check differs in every scene."""
    results = tuple(make.result("differs", scene=s, check=c, measured=1e5, **fields) for s in scenes for c in checks)
    header = make.header(scenes=[make.scene(scene) for scene in scenes])
    return Report(header, results, footer_of(results, diagnoses), tuple(diagnoses))


def everywhere(report: Report) -> dict[str, str]:
    """The run as each report shows it, references in Markdown and XML resolved."""
    import html
    import io

    from furiko.reports.terminal.check import print_report

    stream = io.StringIO()
    print_report(report, file=stream)
    rendered = {"markdown": to_markdown(report), "junit": to_junit(report), "page": to_html(report)}
    return {"terminal": stream.getvalue(), **{name: html.unescape(text) for name, text in rendered.items()}}


def test_one_cause_in_many_scenes_is_one_entry(make):
    scenes = [f"rods-{n}" for n in range(2, 31)]
    report = run(make, [diagnosis(scene, [GRAVITY]) for scene in scenes], scenes)
    (entry,) = report.causes.explanations
    assert entry.headline == (
        "mujoco: gravity is 9.8 m/s², asked for 9.81 [gravity]: explains 116 of 116 differences in 29 scenes"
    )
    assert entry.lines == []
    assert report.causes.unexplained == ()
    for name, text in everywhere(report).items():
        assert entry.headline in text, name
        if name != "junit":  # which has a text for each failure
            assert text.count(entry.headline) == 1, name
    terminal = everywhere(report)["terminal"]
    assert ", ".join(scenes) in terminal
    assert "more" not in terminal


def test_one_mass_that_is_off_is_one_entry_and_no_rows(make):
    scenes = [f"rods-{n}" for n in range(2, 29)]
    checks = [f"check {i}" for i in range(7)]
    diagnoses = [diagnosis(scene, [mass(1, 1.001)], explains=checks) for scene in scenes]
    text = everywhere(run(make, diagnoses, scenes, checks))["terminal"]
    verdict, causes, *_ = text.split("\n\n")
    assert verdict == "189 of 189 comparisons differ."
    assert causes.splitlines()[1].endswith("[mass]: explains 189 of 189 differences in 27 scenes")
    assert len(causes.splitlines()) < 10


def test_causes_that_hold_together_are_apart_from_alternatives(make):
    together = run(make, [diagnosis(findings=[GRAVITY, mass(1, 1.25)])])
    (entry,) = together.causes.explanations
    assert entry.headline == "mujoco: gravity and mass, both together: explains 4 of 4 differences in 1 scene"
    assert entry.lines == [
        "gravity is 9.8 m/s², asked for 9.81",
        "mass of link 1 is 1.25, asked for 1.0 kg",
    ]
    either = run(make, [diagnosis(alternatives=[GRAVITY, mass(1, 1.25)])])
    (entry,) = either.causes.explanations
    assert "one of 2 causes; the measurements cannot tell which" in entry.headline
    assert [line.split(" is ")[0] for line in entry.lines] == ["either gravity", "or mass of link 1"]
    both = run(make, [diagnosis(findings=[GRAVITY], alternatives=[mass(1, 1.25), mass(2, 1.5)])])
    assert len(both.causes.explanations[0].lines) == 3
    for report in (together, either, both):
        for line in report.causes.explanations[0].lines:
            for name, text in everywhere(report).items():
                assert line in text, (name, line)


def test_the_same_factor_in_all_links_is_one_sentence(make):
    report = run(make, [diagnosis(findings=[mass(i, 1.25 * i, float(i)) for i in range(1, 21)])])
    (cause,) = report.causes.explanations[0].together
    (sentence,) = cause.sentences
    assert sentence.startswith("1.25 times the expected value, at 20 places: link 1, link 2, ")
    assert len(cause.every) == 20


def test_different_values_are_said_place_by_place(make):
    report = run(make, [diagnosis(findings=[mass(1, 1.25), mass(2, 1.5)])])
    (entry,) = report.causes.explanations
    assert "mass, at several places" in entry.headline
    assert [line.split(", ")[0] for line in entry.lines] == [
        "mass of link 1 is 1.25",
        "mass of link 2 is 1.5",
    ]


def test_values_that_vary_with_the_scene_are_said_once_and_listed_on_the_page(make):
    single = [
        Difference(cause="float32", where="mujoco", measured=1e-8 * i, expected=0.0, says=f"single precision: {i}")
        for i in (1, 2, 3)
    ]
    scenes = ["rods-2", "rods-3", "rods-5"]
    report = run(make, [diagnosis(s, [f]) for s, f in zip(scenes, single, strict=True)], scenes)
    (entry,) = report.causes.explanations
    assert "single precision: 1 (in rods-2; with other values in 2 other scenes) [float32]" in entry.headline
    assert "single precision: 3" in everywhere(report)["page"]


def test_what_no_diagnosis_explains_is_listed_apart(make):
    left = Difference(cause="unexplained", where="mujoco", measured=7.0, expected=1.0, says="no known cause fits: Δb")
    report = run(make, [diagnosis(findings=[GRAVITY, left], explains=["terms gravity"])])
    causes = report.causes
    assert causes.explanations[0].coverage == "explains 1 of 4 differences in 1 scene"
    assert [group.check for group in causes.unexplained] == ["accelerations", "terms M", "energy"]
    assert causes.remarks == (("mujoco", "no known cause fits: Δb", ("rods-2",)),)
    text = everywhere(report)["terminal"]
    assert text.index("Causes") < text.index("Differs without a known cause") < text.index("no known cause fits")


def test_a_diagnosis_that_explains_nothing_is_shown_too(make):
    report = run(make, [diagnosis(findings=[GRAVITY], explains=[])])
    assert "explains none of 4 differences" in everywhere(report)["terminal"]
    assert len(report.causes.unexplained) == 4


def test_engines_are_apart(make):
    results = tuple(make.result("differs", engine=engine) for engine in ("mujoco", "exudyn-tree"))
    diagnoses = [diagnosis(findings=[GRAVITY], engine=engine) for engine in ("mujoco", "exudyn-tree")]
    assert [e.engine for e in group_causes(results, diagnoses).explanations] == ["mujoco", "exudyn-tree"]


def test_a_stream_without_diagnoses_is_grouped_by_the_cause_of_each_result(make):
    reason = "residual of joint 1; mass: mujoco: mass of link 1 is 1.001, asked for 1 kg"
    scenes = ["rods-2", "rods-3", "rods-5"]
    report = run(make, [], scenes, cause="mass", reason=reason)
    (entry,) = report.causes.explanations
    assert entry.headline == (
        "mujoco: mass of link 1 is 1.001, asked for 1 kg [mass]: explains 12 of 12 differences in 3 scenes"
    )
    assert run(make, [], cause="unexplained").causes.explanations == ()


@pytest.mark.parametrize("length", [400, 1500])
def test_nothing_is_cut_off(make, length):
    long = "x" * length + " the end"
    finding = Difference(cause="mass", where="link 1", measured=2.0, expected=1.0, says=long)
    for name, text in everywhere(run(make, [diagnosis(findings=[finding])])).items():
        assert long in text, name
    unexplained = run(make, [], reason=long)
    for name, text in everywhere(unexplained).items():
        assert long in text, name


def test_many_unexplained_results_of_a_check_are_one_line(make):
    scenes = [f"rods-{n}" for n in range(2, 31)]
    text = everywhere(run(make, [], scenes))["terminal"]
    listed = text[text.index("Differs without a known cause") :].partition("\n\n")[0]
    assert listed.count("✗") == len(CHECKS)
    assert "the largest of 29 in 29 scenes: rods-2, rods-3" in listed
