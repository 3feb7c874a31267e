"""The causes of a cell's differences: all of them, once, and each row with the one that explains it."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

import furiko
from furiko.checks.cache import Cache
from furiko.checks.causes import Causes
from furiko.checks.diagnoses import joined
from furiko.checks.jobs import CellJob, Facts, TruthJob, messages_of
from furiko.checks.plan import make_plan
from furiko.checks.registry import CHECKS
from furiko.diagnosis.explanation import together
from furiko.diagnosis.finding import Finding
from furiko.records.check import Diagnosis, Result
from furiko.records.findings import Difference


@pytest.fixture
def diagnosed():
    """Results by check, and diagnoses, of one fake engine on one scene."""

    def run(engine, scene):
        (task,) = make_plan([scene], [f"fake_causes:{engine}"], "quick").tasks
        (truth,) = (m for m in messages_of(TruthJob(task.scene, 20)) if isinstance(m, Facts))
        messages = messages_of(CellJob(replace(task, random_states=20), truth.content))
        results = {m.check: m for m in messages if isinstance(m, Result)}
        return results, [m for m in messages if isinstance(m, Diagnosis)][-1:]  # each has all of those before it

    return run


def test_two_causes_at_once_are_both_named_once(diagnosed):
    results, (found,) = diagnosed("DenseAndLight", "rods-3")
    assert [(f.cause, f.where) for f in found.findings] == [("gravity", "gravity"), ("density", "every link")]
    assert found.findings[0].measured == pytest.approx(9.80)
    assert found.findings[1].measured == pytest.approx(1.25)
    assert found.alternatives == []
    assert {"model fields", "accelerations", "terms M", "terms G"} <= set(found.explains)
    assert (results["terms M"].cause, results["terms G"].cause) == ("density", "gravity")
    assert all("expected 9.81" not in result.reason for result in results.values())


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["Dense", "SilentDense"])
def test_a_density_is_one_cause_and_not_as_many_masses(diagnosed, engine):
    _, (found,) = diagnosed(engine, "rods-3")
    assert [f.cause for f in found.findings] == ["density"]
    assert found.findings[0].measured == pytest.approx(1.25)


def test_one_mass_is_named_once_in_a_scene(diagnosed):
    results, (found,) = diagnosed("FirstMassHeavier", "n-leg-3")
    assert [(f.cause, f.where) for f in found.findings] == [("mass", "link 1")]
    assert sum(result.outcome == "differs" for result in results.values()) >= 5
    assert {result.cause for result in results.values() if result.outcome == "differs"} <= {"mass", None}
    assert all("1.001)" not in result.reason for check, result in results.items() if check != "model fields")


@pytest.mark.parametrize(
    ("engine", "words"), [("VelocitySign", ""), ("VelocitySignForward", "in its accelerations alone")]
)
def test_velocity_terms_of_the_wrong_sign_have_a_name(diagnosed, engine, words):
    _, (found,) = diagnosed(engine, "rods-3")
    (finding,) = found.findings
    assert finding.cause == "velocity-terms-sign"
    assert words in finding.says
    assert ("alone" in finding.says) == bool(words)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "cause"), [("LowOrderRuns", "first-order-integrator"), ("LateRuns", "stale-derived-state")]
)
def test_the_causes_of_a_motion_are_reported(diagnosed, engine, cause):
    results, (found,) = diagnosed(engine, "rods-2")
    assert [f.cause for f in found.findings] == [cause]
    assert results["accelerations"].outcome == "agrees"
    assert results["trajectory RK4"].cause == cause
    assert "trajectory RK4" in found.explains


@pytest.mark.slow
def test_nothing_is_said_of_an_engine_that_agrees():
    assert furiko.check(["rods-2"], ["fake_engines:Right"], use_cache=False).diagnoses == ()


def test_a_run_keeps_and_writes_its_diagnoses(tmp_path):
    from furiko.reports.stream import read_stream

    report = furiko.check(["rods-3"], ["fake_causes:DenseAndLight"], out=tmp_path, use_cache=False)
    (found,) = report.diagnoses
    assert found.engine == "fake_causes:DenseAndLight"
    assert read_stream(tmp_path).diagnoses == report.diagnoses


def test_kept_results_come_with_their_diagnosis(tmp_path):
    (task,) = make_plan(["rods-2"], ["mujoco"], "smoke").tasks
    result = Result(
        scene="rods-2", engine="mujoco", check="accelerations", comparison="accelerations", outcome="differs"
    )
    found = Diagnosis(scene="rods-2", engine="mujoco", explains=["accelerations"])
    cache = Cache(tmp_path)
    cache.keep_results(task, [result], [found])
    assert cache.results(task).diagnoses == [found]


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["LostInEnergy", "HangsInEnergy"])
def test_a_worker_that_is_lost_leaves_the_causes_that_it_had_found(engine):
    """The worker is gone in the energies: after the accelerations, before the trajectories."""
    report = furiko.check(["rods-2"], [f"fake_causes:{engine}"], use_cache=False, timeout=3.0)
    (found,) = report.diagnoses
    assert [finding.cause for finding in found.findings] == ["gravity", "density"]
    assert {"accelerations", "terms M"} <= set(found.explains)
    assert {r.check for r in report.results if r.outcome == "error"} == {"energy"}
    moving = [result for result in report.results if result.comparison == "trajectory"]
    assert {result.outcome for result in moving} == {"skipped"}  # as where no worker was lost
    assert report.complete


@pytest.mark.slow
def test_an_engine_that_is_given_up_keeps_the_causes_of_every_cell():
    scenes = ["rods-1", "rods-2", "rods-3"]
    report = furiko.check(scenes, ["fake_causes:HangsInEnergy"], use_cache=False, timeout=2.0, jobs=1)
    hung = {result.scene for result in report.results if "it hangs" in result.reason}
    assert len(hung) == 2
    assert {found.scene for found in report.diagnoses} == hung
    assert all(found.findings for found in report.diagnoses)


def finding(cause, where):
    return Difference(cause=cause, where=where, measured=None, expected=None, says=f"{cause} at {where}")


def test_two_parts_of_a_diagnosis_are_one():
    mass, gravity, late = (
        finding("mass", "link 1"),
        finding("gravity", "gravity"),
        finding("stale-derived-state", "RK4"),
    )
    first = Diagnosis(scene="s", engine="e", findings=[mass], alternatives=[gravity], explains=["accelerations"])
    second = Diagnosis(scene="s", engine="e", findings=[mass, gravity, late], explains=["accelerations", "trajectory"])
    both = joined(first, second)
    assert both.findings == [mass, gravity, late]
    assert both.alternatives == []  # gravity is certain by now
    assert both.explains == ["accelerations", "trajectory"]
    assert joined(None, first) == joined(first, None) == first
    assert joined(None, None) is None


@pytest.mark.parametrize("cause", ["mass", "density", "length", "inertia", "gravity", "com-displaced"])
def test_a_wrong_number_of_the_mechanism_is_the_cause_of_wrong_forces_too(cause):
    """Newton's sum over all that hangs below a joint has every one of these numbers in it."""
    found = together([Finding(cause, "link 1", 2.0, 1.0, "another number")])
    causes = Causes(SimpleNamespace(explanation=found, scene=SimpleNamespace(name="s"), info=SimpleNamespace(name="e")))
    for check in ("accelerations", "joint forces", "energy"):
        result = Result(scene="s", engine="e", check=check, comparison=check, outcome="differs")
        assert causes.named(result, CHECKS[check]).cause == cause
    assert causes.diagnosis().explains == ["accelerations", "joint forces", "energy"]


def test_what_each_part_alone_has_stays():
    """One cause at two places, and checks that only the first worker came to."""
    first = Diagnosis(scene="s", engine="e", findings=[finding("mass", "link 1")], explains=["terms M"])
    second = Diagnosis(scene="s", engine="e", findings=[finding("mass", "link 2")], explains=["trajectory"])
    both = joined(first, second)
    assert [found.where for found in both.findings] == ["link 1", "link 2"]
    assert both.explains == ["terms M", "trajectory"]
