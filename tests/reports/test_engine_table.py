"""The public table of engines, from records alone."""

from furiko.records.check import EngineEntry, Header, Result, SceneEntry
from furiko.reports.engine_table import Defect, engine_table
from furiko.reports.report import Report


def run(results):
    scenes = [
        SceneEntry(name=name, system=kind, n=2, lengths=[], masses=[], gravity=9.81)
        for name, kind in (("rods-2", "rod-chain"), ("rods-5", "rod-chain"), ("two-legs", "n-leg"))
    ]
    engines = [
        EngineEntry(name="right", formulation="formulation one", package="one", version="1.2"),
        EngineEntry(name="absent", formulation="formulation two", package="two"),
    ]
    header = Header(
        furiko="0.1.0",
        started="2026-11-27T12:00:00Z",
        command="furiko check",
        profile="quick",
        seed="",
        machine={"cores": "2"},
        versions={},
        scenes=scenes,
        engines=engines,
    )
    return Report(header=header, results=results)


def result(scene, measured, outcome="agrees", **fields):
    given = {"comparison": "accelerations", "check": "accelerations", "unit": "ε", "allowed": 50.0} | fields
    return Result(scene=scene, engine="right", outcome=outcome, measured=measured, **given)


RESULTS = [
    result("rods-2", 2.0, details={"forward error": 3e-15}),
    result("rods-5", 8.0, details={"forward error": 5e-14}, loose=True),
    result("two-legs", 70.0, "differs", reason="off by 70.", cause="gravity", details={"forward error": 1e-3}),
    result("two-legs", None, "skipped", reason="it has none", check="energy", comparison="energy"),
]
DEFECT = Defect("One", "1.2", "adds wrongly", "Sums are wrong.", "print(1 + 1)", "`2`, by hand.", "`3`.")


def test_the_table_says_what_the_run_says():
    text = engine_table(
        [run(RESULTS)], {"right": {"rods-5": 12.345}}, {"right": ["no energy: it has none"]}, [DEFECT], "make it"
    )
    assert "1 formulations of 1 engines, on 3 scenes" in text  # what is not installed takes no part
    assert "    make it" in text
    assert "| `right` | 1.2 | formulation one | 3 | 2 | 1 | 1 | 0 | 1 | 12 |" in text
    chains = text[text.index("### Chains") : text.index("## What differs")]
    assert "| `right` | 5e-14 | 8 (×4) |" in chains  # the worst scene, and four times that of its best
    stars = text[text.index("### Stars") : text.index("### Chains")]
    assert "| `right` | 1e-03 | 70 |" in stars
    assert "* `right`, two-legs, accelerations: off by 70. Cause: `gravity`." in text
    assert "* `right`: no energy: it has none." in text
    for part in ("### One 1.2: adds wrongly", "print(1 + 1)", "*Expected*: `2`, by hand.", "*Got*: `3`."):
        assert part in text


def test_nothing_differs():
    text = engine_table([run(RESULTS[:2])], {}, {}, [], "make it")
    assert "## What differs\n\nNothing.\n" in text


def test_what_has_no_epsilon_is_a_share_of_what_is_allowed():
    moved = result("rods-2", 3.0, comparison="trajectory", check="trajectory RK4", unit="rad", allowed=12.0)
    text = engine_table([run([*RESULTS[:1], moved])], {}, {}, [], "make it")
    assert "| 25 % |" in text


def test_a_page_needs_runs_and_a_place():
    from click.testing import CliRunner

    from furiko.cli.main import cli

    answer = CliRunner().invoke(cli, ["engines", "--out", "engines.md"], standalone_mode=False)
    assert "go together" in str(answer.exception or answer.output)
