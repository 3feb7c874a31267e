"""Engines that are programs: the example in C, and programs that die, hang, flood or answer with nonsense."""

import subprocess
from pathlib import Path

import numpy as np
import pytest
from places import compiler, program

import furiko
from furiko.engines import engine_info, engine_version, why_missing
from furiko.engines.places.connection import EngineFailed
from furiko.engines.workers.limits import LIMITS
from furiko.models import EngineMissing, InvalidInput

EXAMPLE = Path(__file__).parents[3] / "docs" / "examples" / "planar_tree.c"
CHAIN = furiko.RodChain((0.8, 0.5), 1.3)
STATES = np.array([[0.3, -1.2]]), np.array([[0.5, 1.0]])


@pytest.fixture
def short(monkeypatch):
    """A time limit that a test can wait for; a start of Python takes a tenth of it."""
    monkeypatch.setattr(LIMITS, "seconds", 3.0)


@pytest.fixture(scope="module")
def in_c(tmp_path_factory):
    found = compiler()
    if found is None:
        pytest.skip("there is no C compiler")
    path = tmp_path_factory.mktemp("c") / "planar_tree"
    warnings = ["-O2", "-Wall", "-Wextra", "-Werror"]
    subprocess.run([found, *warnings, "-o", str(path), str(EXAMPLE), "-lm"], check=True)
    return str(path)


def test_the_example_falls_as_by_hand(in_c):
    # Two equal point masses, both rods level and at rest: accelerations (-g, 0), as in test_environment.
    engine = furiko.load_engine(in_c, furiko.NLegPendulum((1.0, 1.0), (1.0, 1.0)))
    assert engine.accelerations([np.pi / 2] * 2, [0.0, 0.0]) == pytest.approx([-9.81, 0.0], abs=1e-13)
    # A rod that hangs level: 3 g / 2 l, whatever its density.
    rod = engine.of(furiko.RodChain((0.7,), 2.0))
    assert rod.accelerations([-np.pi / 2], [5.0]) == pytest.approx([1.5 * 9.81 / 0.7], rel=1e-14)


def test_the_example_agrees_with_the_theory(in_c, tmp_path):
    report = furiko.check(["rods-3", "n-leg-3", "rods-100"], [in_c], profile="quick", use_cache=False)
    assert {result.outcome for result in report.results} == {"agrees", "skipped"}
    judged = {result.scene for result in report.results if result.outcome == "agrees"}
    assert judged == {"rods-3", "n-leg-3"}
    why = {result.reason for result in report.results if result.scene == "rods-100"}
    assert any("at most 64 links" in reason for reason in why)
    (entry,) = report.header.engines
    assert (entry.name, entry.version, entry.place) == (in_c, "1.0", "a program of its own")


def test_the_example_conforms(in_c):
    from furiko.checks.conformance.kit import engine_test

    assert engine_test(in_c, timeout=60).conforms


def test_what_a_program_says_of_itself(in_c):
    info = engine_info(in_c)
    assert info.coordinates == "absolute"
    assert info.largest_n == 64
    assert info.missing["energy"] == "the program does not offer it"
    assert engine_version(in_c) == "1.0"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ask", "words"),
    [
        ("os.kill(os.getpid(), 11)", "died of SIGSEGV"),
        ("print('out of ideas', file=sys.stderr, flush=True); os._exit(3)", "ended with status 3 .*out of ideas"),
        ("time.sleep(60)", "no answer within 3 s: it hangs"),
        ("send(b'hello, world, this is no frame')", "cannot be understood"),
        ("send(frame(b'x' * 100)[:50]); time.sleep(60)", "it hangs"),
        ("send(frame(b'x' * 100)[:50]); os._exit(0)", "ended with status 0"),
        ("send(struct.pack('>8sQI', b'furiko\\x01\\n', 1 << 60, 0))", "are the limit"),
        ("send(frame(b'12345678')[:-1] + b'9')", "damaged"),
        ("send(message(dict(arrays=[['accelerations', [1, 2]]]), [1.0]))", "longer than what came"),
        ("send(message(dict(say='answer')))", "no array 'accelerations'"),
        ("send(message(dict(say='error', what='no')))", "^no$"),
        ("send(message(dict(say='error', what=[1] * 10000)))", "1, 1"),
    ],
)
def test_bad_answers_are_errors_of_the_engine(tmp_path, short, ask, words):
    name = str(program(tmp_path / "bad", f"def ask(head, rest):\n    {ask}\nserve(ask)\n"))
    engine = furiko.load_engine(name, CHAIN)
    with pytest.raises(EngineFailed, match=words):
        engine.accelerations(*STATES)


def test_an_answer_of_another_shape_is_refused(tmp_path):
    ask = (
        "def ask(head, rest):\n    send(message(dict(arrays=[['accelerations', [3]]]), [1.0, 2.0, 3.0]))\nserve(ask)\n"
    )
    engine = furiko.load_engine(str(program(tmp_path / "bad", ask)), CHAIN)
    with pytest.raises(RuntimeError, match="shape"):
        engine.accelerations(*STATES)


def test_a_flood_on_standard_error_stops_nothing(tmp_path, short):
    ask = (
        "def ask(head, rest):\n    sys.stderr.write('x' * 5_000_000)\n"
        "    send(message(dict(say='answer', arrays=[['accelerations', [1, 2]]]), [1.0, 2.0]))\nserve(ask)\n"
    )
    engine = furiko.load_engine(str(program(tmp_path / "loud", ask)), CHAIN)
    assert engine.accelerations(*STATES).tolist() == [[1.0, 2.0]]


@pytest.mark.parametrize(
    ("hello", "words"),
    [
        ("dict(HELLO, protocol=2)", "speaks protocol 2, where 1 is needed"),
        ("dict(say='error', what='no licence')", "no licence"),
    ],
)
def test_a_program_that_cannot_start_is_missing(tmp_path, hello, words):
    name = str(program(tmp_path / "odd", f"serve(None, {hello})\n"))
    assert words in why_missing(name)
    with pytest.raises(EngineMissing, match=words):
        engine_info(name)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("questions=3", "'questions'"),
        ("questions=['energy']", "'questions'"),
        ("coordinates='polar'", "'coordinates'"),
        ("largest_n=0", "'largest_n'"),
        ("largest_n=True", "'largest_n'"),
        ("integrators=[dict(name='Euler', order=1)]", "does not offer 'trajectory'"),
        ("integrators=[dict(name='Euler')]", "order"),
        ("integrators=3", "hello"),
    ],
)
def test_nonsense_in_a_hello_is_refused(tmp_path, change, words):
    name = str(program(tmp_path / "odd", f"serve(None, dict(HELLO, {change}))\n"))
    with pytest.raises(InvalidInput, match=words):
        engine_info(name)


def test_a_file_that_cannot_be_run_is_told(tmp_path):
    (tmp_path / "text").write_text("no program")
    assert "a program that can be run" in why_missing(f"{tmp_path}/text")
    assert "there is no program" in why_missing(f"{tmp_path}/nothing")


def test_it_may_not_take_more_memory_than_it_is_given(tmp_path, monkeypatch):
    ask = (
        "def ask(head, rest):\n    held = bytearray(400 << 20)\n"
        "    send(message(dict(say='answer', arrays=[['accelerations', [1, 2]]]), [1.0, 2.0]))\nserve(ask)\n"
    )
    name = str(program(tmp_path / "hog", ask))
    assert furiko.load_engine(name, CHAIN).accelerations(*STATES).tolist() == [[1.0, 2.0]]
    monkeypatch.setattr(LIMITS, "memory", 200 << 20)
    engine = furiko.load_engine(str(program(tmp_path / "hog2", ask)), CHAIN)
    with pytest.raises(EngineFailed, match="MemoryError"):
        engine.accelerations(*STATES)


@pytest.mark.slow
def test_one_that_hangs_and_one_that_dies_cost_their_own_cells_alone(tmp_path):
    hangs = str(program(tmp_path / "hangs", "serve(lambda head, rest: time.sleep(600))\n"))
    dies = str(program(tmp_path / "dies", "serve(lambda head, rest: os.kill(os.getpid(), 6))\n"))
    report = furiko.check(["rods-1"], [hangs, "mujoco", dies], profile="smoke", timeout=3.0, use_cache=False, jobs=2)
    outcomes = {name: {r.outcome for r in report.results if r.engine == name} for name in (hangs, "mujoco", dies)}
    assert outcomes == {hangs: {"error"}, "mujoco": {"agrees"}, dies: {"error"}}
    reasons = {result.engine: result.reason for result in report.results}
    assert "it hangs" in reasons[hangs]
    assert "SIGABRT" in reasons[dies]
    assert report.exit_status == 3
