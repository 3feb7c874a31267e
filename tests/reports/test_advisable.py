"""``furiko check`` points to ``furiko advise`` where it helps, in one line, and nowhere else."""

from furiko.reports.ci.markdown import to_markdown
from furiko.reports.pages.check_page import to_html
from tests.reports.terminal.test_check import printed


def moving(make, *results, **fields):
    """A run in a scene that moves for a second."""
    return make.report(*results, scenes=[make.scene(duration=1.0, **fields)])


def motion(make, outcome="agrees", comparison="trajectory", **fields):
    given = {"check": f"{comparison} RK4", "unit": "rad", "measured": 1e-9, "allowed": 1e-6} | fields
    return make.result(outcome, comparison=comparison, **given)


def test_a_run_in_which_everything_agrees_sharply_says_nothing(make):
    report = moving(make, make.result(), motion(make), motion(make, comparison="horizon"))
    assert report.advisable == ()
    for text in (printed(report), to_html(report), to_markdown(report)):
        assert "furiko advise" not in text


def test_a_loose_result_points_to_advise_in_one_line_before_the_path(make):
    report = moving(make, make.result("loose"), make.result(check="energy"))
    lines = [line for line in printed(report, path="report.html").splitlines() if "furiko advise" in line]
    assert lines == [
        "furiko advise rods-2 says which engine, integrator and step keep an error that you ask for "
        "(rods-2 × mujoco, accelerations is loose)."
    ]
    assert printed(report, path="report.html").splitlines()[-2] == lines[0]
    assert lines[0] in to_html(report)
    assert "furiko advise rods" in to_markdown(report).replace("&#45;", "-")


def test_a_trajectory_that_differs_comes_before_a_loose_result(make):
    report = moving(make, make.result("loose", engine="a"), motion(make, "differs", measured=1.0))
    (found,) = report.advisable
    assert (found.engine, found.check, found.why) == ("mujoco", "trajectory RK4", "differs")


def test_a_motion_that_parts_by_its_step_alone_is_limited_by_it(make):
    parts = motion(make, comparison="horizon", details={"parts, measured": 0.8})
    stays = motion(make, comparison="horizon", details={"parts, measured": None})
    vague = motion(make, allowed=2e-3)
    assert [one.why for one in moving(make, parts).advisable] == ["limited by its step"]
    assert [one.why for one in moving(make, vague).advisable] == ["limited by its step"]
    assert moving(make, stays).advisable == ()


def test_accelerations_that_differ_are_another_model_and_no_matter_of_steps(make):
    assert moving(make, make.result("differs")).advisable == ()


def test_a_scene_that_advise_does_not_take_is_not_named(make):
    still = make.report(make.result("loose"), scenes=[make.scene(duration=0.0)])
    tree = make.report(make.result("loose"), scenes=[make.scene(system="tree", duration=0.0)])
    assert still.advisable == ()
    assert [one.scene for one in tree.advisable] == ["rods-2"]


def test_a_file_and_engines_that_were_named_stand_in_the_command_line(make):
    report = make.report(
        motion(make, "differs", engine="mine:Engine"),
        make.result(engine="pinocchio-aba"),
        scenes=[make.scene(duration=1.0, source="my arm.toml")],
        engines=[make.engine("mine:Engine", asked=True), make.engine("pinocchio-aba", asked=True)],
    )
    (found,) = report.advisable
    assert found.command == "furiko advise 'my arm.toml' -e mine:Engine"


def test_many_scenes_are_one_line(make):
    scenes = [make.scene(f"rods-{n}", duration=1.0) for n in range(2, 30)]
    report = make.report(*(make.result("loose", scene=scene.name) for scene in scenes), scenes=scenes)
    assert len(report.advisable) == 28
    assert sum("furiko advise" in line for line in printed(report).splitlines()) == 1
    assert "so with rods-3, rods-4, rods-5 and 24 more" in report.advice
