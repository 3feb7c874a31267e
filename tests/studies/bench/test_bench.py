"""The benchmark: its arithmetic on made-up points, its structure on short runs; nothing asks how long things take."""

import itertools
import json
import math
import os
from contextlib import contextmanager
from pathlib import Path

import jinja2
import jsonschema
import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.bench import bench, write
from furiko.cli.main import run
from furiko.engines import engine_names, engine_version, load_engine
from furiko.models import EngineMissing, InvalidInput, RodChain, Scene
from furiko.records.bench import Bench, Point
from furiko.records.schema import FOLDER
from furiko.reference.truth import closed_forms as exact
from furiko.reports.pages.bench_page import to_html
from furiko.reports.terminal.bench import print_bench
from furiko.studies.bench.acceleration_speed import speeds
from furiko.studies.bench.methods import Method, dop853, end_error, methods, taylor
from furiko.studies.bench.scenes import BENCHMARKS
from furiko.studies.bench.skips import skips
from furiko.studies.bench.timing import Subject, Times, interleaved
from furiko.studies.bench.work_precision import front, reach, reaches, refine

PENDULUM = Scene("pendulum", RodChain((1.5,)), (2.0,), (0.0,), 1.0)
RODS = Scene("rods", RodChain((1.0, 0.5)), (1.0, 2.0), (0.0, 0.0), 0.5)

needs_mujoco = pytest.mark.skipif(not engine_version("mujoco"), reason="MuJoCo is not installed")
needs_pinocchio = pytest.mark.skipif(not engine_version("pinocchio-aba"), reason="Pinocchio is not installed")
needs_exudyn = pytest.mark.skipif(not engine_version("exudyn-tree"), reason="Exudyn is not installed")


# --- the Pareto front


def test_front_of_made_up_points():
    points = [(1.0, 1e-2), (2.0, 1e-3), (3.0, 1e-3), (4.0, 1e-6), (5.0, 1e-4), (0.5, math.inf)]
    assert front(points) == [True, True, False, True, False, False]


def test_of_equals_one_is_kept():
    assert front([(1.0, 0.1), (1.0, 0.1)]) == [True, False]
    assert front([(1.0, 0.2), (1.0, 0.1)]) == [False, True]
    assert front([]) == []


@settings(deadline=None, max_examples=200)
@given(st.lists(st.tuples(st.floats(0.1, 10), st.floats(1e-12, 1)), max_size=30))
def test_front_is_what_nothing_beats(points):
    kept = [point for point, on in zip(points, front(points), strict=True) if on]
    for p, q in itertools.permutations(kept, 2):
        assert not (p[0] <= q[0] and p[1] <= q[1])
    for p in points:
        assert any(q[0] <= p[0] and q[1] <= p[1] for q in kept)


# --- the time to come within an error


def test_between_two_runs_the_line_is_straight_in_logarithms():
    # time = error^(-1/4), as a scheme of order 4 has it: exactly a straight line
    points = [(error**-0.25, error) for error in (1e-2, 1e-6, 1e-10)]
    seconds, at_most = reach(points, 1e-8)
    assert seconds == pytest.approx(100.0, rel=1e-12)
    assert not at_most
    assert reach(points, 1e-6) == (pytest.approx(10**1.5), False)


def test_nothing_is_extrapolated():
    points = [(1.0, 1e-3), (2.0, 1e-5)]
    assert reach(points, 1e-6) is None
    assert reach([], 1e-6) is None
    assert reach([(1.0, math.inf)], 1e-6) is None
    # nearer already than asked: at most what the coarsest run took
    assert reach(points, 1e-2) == (1.0, True)
    assert reach(points, 1e-3) == (1.0, False)


def test_a_slow_and_a_lucky_run_count_by_the_front():
    # the second run is slower and worse than the first: it is not on the way from the first to the third
    with_it = reach([(1.0, 1e-2), (5.0, 1e-1), (4.0, 1e-6)], 1e-4)
    assert with_it == reach([(1.0, 1e-2), (4.0, 1e-6)], 1e-4)
    assert with_it == (pytest.approx(2.0), False)
    assert reach([(1.0, 1e-2), (4.0, 0.0)], 1e-4)[0] < 4.0


@settings(deadline=None, max_examples=100)
@given(st.lists(st.tuples(st.floats(0.1, 10), st.floats(1e-12, 1)), min_size=1, max_size=12), st.floats(1e-12, 1))
def test_reach_lies_between_measured_times(points, error):
    found = reach(points, error)
    assert (found is None) == all(off > error for _, off in points)
    if found:
        assert min(p[0] for p in points) <= found[0] * (1 + 1e-12)
        assert found[0] <= min(p[0] for p in points if p[1] <= error) * (1 + 1e-12)


def point(engine, seconds, error):
    return Point(
        engine=engine,
        scheme="S",
        setting=1.0,
        by="tolerance",
        error=error,
        minimum=seconds,
        median=seconds,
        rounds=3,
        front=False,
    )


def test_ratios_are_to_furikos_own_and_not_reached_has_a_reason():
    points = [point("furiko", 1.0, 1e-5), point("furiko", 2.0, 1e-10), point("other", 10.0, 1e-5)]
    points += [point("other", 1000.0, 1e-7), point("lost", 1.0, None)]
    stopped = {("furiko", "S"): "done", ("other", "S"): "rounding", ("lost", "S"): "time"}
    found = {(r.engine, r.error): r for r in reaches(points, stopped)}
    assert len(found) == 9
    assert found["furiko", 1e-6].seconds == pytest.approx(2**0.2)
    assert found["furiko", 1e-6].ratio is None
    assert found["other", 1e-6].ratio == pytest.approx(100 / 2**0.2)
    assert found["other", 1e-9].seconds is None
    assert found["other", 1e-9].ratio is None
    assert found["other", 1e-9].reason == "smallest error 1.0e-07; rounding"
    assert found["lost", 1e-6].reason == "no run finished; time"
    assert found["furiko", 1e-12].seconds is None


# --- refinement


def made_up(errors):
    """A method whose run number k ends with errors[k]."""
    return Method("made-up", "S", "tolerance", range(len(errors)), lambda k, part=1.0: (errors[k], part))


def own_error(end):
    return end[0]


def test_refinement_stops_at_rounding():
    method = made_up([1e-2, 1e-4, 1e-6, 1e-8, 2e-8, 3e-8, 1e-20])
    runs, why = refine(method, own_error, math.inf)
    assert [run.error for run in runs] == [1e-2, 1e-4, 1e-6, 1e-8, 2e-8, 3e-8]
    assert "rounding" in why


def test_errors_that_still_fall_by_a_third_are_no_rounding_and_those_that_fall_by_a_fifth_are():
    falling = [1e-2, 1e-4, 0.66e-4, 0.44e-4, 0.29e-4, 0.19e-4]
    assert [run.error for run in refine(made_up(falling), own_error, math.inf)[0]] == falling
    stuck = [1e-2, 1e-4, 0.8e-4, 0.64e-4, 1e-9]
    runs, why = refine(made_up(stuck), own_error, math.inf)
    assert [run.error for run in runs] == stuck[:4]
    assert "rounding" in why


def test_errors_that_do_not_fall_yet_are_no_rounding():
    errors = [10.0, 20.0, 15.0, 12.0, 1e-1, 1e-3]
    runs, why = refine(made_up(errors), own_error, math.inf)
    assert [run.error for run in runs] == errors
    assert "no finer" in why


def test_refinement_stops_when_its_time_is_spent():
    runs, why = refine(made_up([1.0, 0.1, 0.01]), own_error, 0.0)
    assert runs == []
    assert "coarsest run would take" in why


# --- timing


def test_every_subject_is_timed_once_a_round_to_and_fro():
    seen = []
    subjects = {name: Subject(lambda name=name: seen.append(name)) for name in "abc"}
    times = interleaved(subjects, rounds=4, shortest=0.0)
    assert "".join(seen) == "abccbaabccba"
    assert {name: len(found.seconds) for name, found in times.items()} == {"a": 4, "b": 4, "c": 4}


def test_no_round_begins_once_the_budget_is_spent():
    times = interleaved({"a": Subject(lambda: None)}, rounds=50, fewest=2, budget=0.0, shortest=0.0)
    assert len(times["a"].seconds) == 2


def test_a_subject_runs_in_its_context():
    inside, seen = [], []

    @contextmanager
    def around():
        inside.append(1)
        yield
        inside.pop()

    interleaved(
        {"a": Subject(lambda: seen.append(len(inside)), around), "b": Subject(lambda: seen.append(-1))}, rounds=2
    )
    assert set(seen) == {1, -1}
    assert inside == []


def test_a_ratio_is_taken_round_by_round():
    # the machine is ten times slower in the last round: it is so for both
    a, b = Times(np.array([2.0, 2.0, 20.0])), Times(np.array([1.0, 1.0, 10.0]))
    assert a.over(b) == 2.0
    assert (a.minimum, a.median) == (2.0, 2.0)


# --- methods, against a closed form and against each other


def test_error_at_the_end_is_against_the_closed_form():
    theta, omega = exact.rod_pendulum(PENDULUM.system).motion(2.0, 0.0, [1.0])
    assert end_error(PENDULUM, (theta, omega)) < 1e-15  # half an ulp each
    end = taylor(PENDULUM, 1e-14)
    assert end_error(PENDULUM, end) < 1e-13
    assert end_error(PENDULUM, (end[0] + 1e-3, end[1])) == pytest.approx(1e-3, rel=1e-9)
    assert end_error(PENDULUM, (end[0], end[1] - 2e-3)) == pytest.approx(2e-3, rel=1e-9)
    assert end_error(PENDULUM, (end[0] * np.nan, end[1])) == math.inf


def test_every_method_comes_to_the_same_end():
    found, left_out = methods(RODS, [name for name in engine_names() if engine_version(name)])
    assert left_out == []
    schemes = {(method.engine, method.scheme) for method in found}
    assert ("furiko", "Taylor") in schemes
    if engine_version("exudyn-tree"):
        assert {("exudyn-tree", s) for s in ("RK44", "RK67", "DOPRI5", "GeneralizedAlpha")} <= schemes
    for method in found:
        setting = method.settings[5]
        # first order in steps of 0.16 ms; half the rates' change in a step is 5e-3
        assert end_error(RODS, method.run(setting)) < 1e-2, (method.engine, method.scheme)


@needs_pinocchio
def test_dop853_in_an_engines_own_coordinates():
    native = load_engine("pinocchio-aba", RODS.system).native()
    # the tolerance of one step, times some tens of steps
    assert end_error(RODS, dop853(native, RODS, 1e-10)) < 1e-8
    half = dop853(native, RODS, 1e-12, 0.5)
    np.testing.assert_allclose(half[0], taylor(RODS, 1e-13, 0.5)[0], atol=1e-10)


@needs_exudyn
def test_exudyn_chooses_its_own_steps():
    engine = load_engine("exudyn-tree", RODS.system)
    coarse, fine = (end_error(RODS, engine.adaptive((1.0, 2.0), (0.0, 0.0), "DOPRI5", 0.5, t)) for t in (1e-4, 1e-10))
    assert fine < 1e-8 < coarse
    with pytest.raises(InvalidInput, match="no adaptive scheme 'RK44'; it has DOPRI5"):
        engine.adaptive((1.0, 2.0), (0.0, 0.0), "RK44", 0.5, 1e-6)
    with pytest.raises(InvalidInput, match="tolerance: a positive number"):
        engine.adaptive((1.0, 2.0), (0.0, 0.0), "DOPRI5", 0.5, 0.0)


@needs_mujoco
def test_without_its_clock_mujoco_gives_the_same_numbers():
    engine = load_engine("mujoco", RODS.system)
    state = (1.0, 2.0), (0.5, -0.5)
    before = engine.trajectory(*state, "RK4", 1e-3, 100)
    with engine.lighter()["timer off"]():
        within = engine.trajectory(*state, "RK4", 1e-3, 100)
    np.testing.assert_array_equal(before, within)
    batch = engine.bare_calls(np.array([state[0]] * 3), np.array([state[1]] * 3))["batch.Batch.forward"]
    assert batch.states == 3


# --- the whole


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    path = tmp_path_factory.mktemp("bench") / "rods.toml"
    path.write_text(
        '[system]\nkind = "rod-chain"\nlengths = [1.0, 0.5]\n'
        "[state]\ntheta = [1.0, 2.0]\nduration = 0.5\n[samples]\nrandom = 1\n",
        encoding="utf-8",
    )
    motion = bench([str(path)], ["mujoco"] if engine_version("mujoco") else [], budget=2.0)
    names = [name for name in ("mujoco", "pinocchio-aba") if engine_version(name)]
    rows = speeds("rod-chain", 2, names, 0.1, batches=(1, 64))
    return msgspec.structs.replace(motion, speeds=rows)


@pytest.mark.slow
def test_a_motion_has_every_method_at_every_error(found):
    (motion,) = found.motions
    assert (motion.scene, motion.n, motion.duration) == ("rods", 2, 0.5)
    assert motion.truth < 1e-25
    methods_found = {(r.engine, r.scheme) for r in motion.reaches}
    assert len(motion.reaches) == 3 * len(methods_found)
    assert any(p.front for p in motion.points)
    for p in motion.points:
        assert 0 < p.minimum <= p.median
    if engine_version("mujoco"):
        assert {s for e, s in methods_found if e == "mujoco"} >= {"RK4", "RK4, timer off", "Euler", "implicitfast"}
    (own,) = {s for e, s in methods_found if e == "furiko"}
    assert own == "Taylor"
    nearest = min(p.error for p in motion.points if p.engine == "furiko")
    assert nearest < 1e-13  # half a second of two rods: a few hundred roundings at most


def test_accelerations_are_held_against_balls(found):
    by = {(s.engine, s.call, s.states): s for s in found.speeds}
    assert ("furiko", "prepared kernel", 1) in by
    assert ("furiko", "accelerations", 64) in by
    assert ("numpy", "literal", 1) in by
    for speed in found.speeds:
        # rounding of a few dozen operations, more where a 2 × 2 mass matrix of condition 40 is factorised
        assert speed.error < 1e-13
        assert (speed.ratio is None) == (speed.engine == "furiko")
        assert 0 < speed.minimum <= speed.median


def test_json_and_page_and_table_tell_the_same(found, tmp_path, capsys):
    page = write(tmp_path / "out", found)
    content = (tmp_path / "out" / "bench.json").read_bytes()
    again = msgspec.json.decode(content, type=Bench)
    assert again == found
    schema = json.loads((FOLDER / "bench.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(schema).validate(json.loads(content))
    html = page.read_text(encoding="utf-8")
    assert html == to_html(again)
    assert html.count('<figure class="chart"') == 1 + 2
    assert "http" not in html.replace("http-equiv", "")
    assert html.count("<script") == 1  # its own
    assert "NaN" not in html
    print_bench(found, page)
    printed = capsys.readouterr().out
    for word in ("furiko", "Taylor", "1e-09", "literal", "times", found.versions["numpy"], found.machine["processor"]):
        assert word in printed
        assert word in html or word in ("1e-09", "times")
    assert "not reached" in printed
    assert "not reached" in html


def test_nothing_is_written_where_the_page_cannot_be_made(found, tmp_path):
    with pytest.raises(jinja2.UndefinedError):
        write(tmp_path, msgspec.structs.replace(found, motions=[None]))
    assert not list(tmp_path.iterdir())
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(InvalidInput, match="file: cannot be written"):
        write(tmp_path / "file", found)


def test_what_comes_from_a_scene_is_escaped(found):
    (motion,) = found.motions
    nasty = msgspec.structs.replace(motion, scene="<script>alert(1)</script>")
    html = to_html(msgspec.structs.replace(found, motions=[nasty]))
    assert html.count("<script") == 1  # its own


def test_a_scene_without_motion_is_refused(tmp_path):
    with pytest.raises(InvalidInput, match="no \\[state\\] with a duration"):
        bench(["rods-100"])
    with pytest.raises(InvalidInput, match="no engine is called"):
        bench(["rods-5"], ["mujocco"])


def test_an_engine_that_is_asked_for_must_be_there(monkeypatch):
    monkeypatch.setattr("furiko.engines.registry.engine_version", lambda name: "")
    with pytest.raises(EngineMissing, match=r"pip install 'furiko\[mujoco\]'"):
        bench(["rods-5"], ["mujoco"])


# --- skips


@pytest.fixture
def fakes_for_subprocesses(monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parents[2]), prepend=os.pathsep)


@pytest.mark.slow
@pytest.mark.usefixtures("fakes_for_subprocesses")
def test_every_skip_keeps_the_verdicts():
    found = {skip.name: skip for skip in skips(["double-pendulum"], ["fake_engines:Right", "fake_engines:SignFlipped"])}
    assert set(found) == {"cache", "truth", "trajectory", "velocity terms", "imports"}
    assert all(skip.same and skip.verdicts for skip in found.values())
    # the planted engine's accelerations differ: its trajectories were left out, and would have changed no verdict
    assert "1 of 2 cells differ" in found["trajectory"].says


@pytest.mark.slow
@pytest.mark.usefixtures("fakes_for_subprocesses")
def test_a_skip_that_changes_a_verdict_is_seen(monkeypatch):
    from furiko.studies.bench import skips as module

    plain = module._cell

    def forgetful(task, facts):
        # a run without trajectories on its own says that all is well
        for result in plain(task, facts):
            yield msgspec.structs.replace(result, outcome="agrees") if len(task.checks) > 1 else result

    monkeypatch.setattr(module, "_cell", forgetful)
    plan = module.make_plan(["double-pendulum"], ["fake_engines:SignFlipped"], "quick")
    assert not module._trajectory(plan).same


# --- reference solutions kept for the benchmark's motions


def test_benchmarks_have_kept_ends():
    from furiko.reference.truth import end_points as endpoints

    kept = json.loads(endpoints.BENCHMARKS_PATH.read_text(encoding="utf-8"))
    for scene in BENCHMARKS.values():
        key = endpoints._key(scene.system, scene.theta, scene.omega, endpoints._times(scene.duration))
        assert kept[key]["scene"] == scene.name, "the scene has changed: python -m furiko.studies.bench.scenes"
        # long doubles for a hundred rods: eleven bits more than what is held against them
        assert max(kept[key]["error"]) < (1e-14 if scene.system.n > 50 else 1e-24)


@pytest.mark.slow
def test_kept_ends_of_a_benchmark_are_computed_again():
    from furiko.reference.truth import end_points as endpoints

    scene = BENCHMARKS["bench-rods-2"]
    (entry,) = endpoints.entries([scene]).values()
    kept = json.loads(endpoints.BENCHMARKS_PATH.read_text(encoding="utf-8"))
    (same,) = [old for old in kept.values() if old["scene"] == scene.name]
    new, old = (np.array(e["states"], dtype=np.longdouble) for e in (entry, same))
    assert np.abs(new - old).max() < 1e-18  # a long double's own rounding of the decimals


# --- causes


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "causes"),
    [
        ("fake_engines:Right", []),
        ("fake_causes:LowOrderRuns", ["first-order-integrator"]),
        ("fake_causes:LateRuns", ["stale-derived-state"]),
        ("fake_causes:VelocitySign", ["velocity-terms-sign"]),
    ],
)
def test_a_timed_engine_that_is_wrong_is_said_to_be(engine, causes, monkeypatch, capsys):
    monkeypatch.setattr("furiko.bench.BENCHMARKS", {"rods": RODS})
    found = bench(["rods"], [engine], budget=1.0)
    (motion,) = found.motions
    assert [cause.cause for cause in motion.causes] == causes
    print_bench(found)
    shown, page = capsys.readouterr().out, to_html(found)
    for cause in motion.causes:
        assert cause.says in " ".join(shown.split())
        assert cause.cause in page
        assert engine in cause.says


@pytest.mark.slow
def test_a_benchmark_of_a_wrong_engine_has_the_status_of_a_difference(tmp_path, capsys):
    scene = tmp_path / "rods.toml"
    scene.write_text(
        '[system]\nkind = "rod-chain"\nlengths = [1.0, 0.5]\n[state]\ntheta = [1.0, 2.0]\nduration = 0.5\n'
    )
    for engine, status in (("fake_engines:Right", 0), ("fake_causes:LateRuns", 1)):
        arguments = ["bench", str(scene), "-e", engine, "--budget", "1", "--out", str(tmp_path / "bench")]
        assert run(arguments) == status, capsys.readouterr()
