"""The command line as a user meets it: statuses, one clear line for bad input, JSON and nothing else where asked."""

import ast
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import click
import pytest

import furiko
from furiko.cli.check import usual_jobs
from furiko.cli.main import COMMANDS, cli
from furiko.cli.main import run as cli_run
from furiko.records.check import Header
from furiko.reports import StreamWriter

TESTS = Path(__file__).parent.parent
# The fake engines by name; and where furiko itself is, if that is told by PYTHONPATH.
ENVIRONMENT = os.environ | {"PYTHONPATH": os.pathsep.join([str(TESTS), *filter(None, [os.environ.get("PYTHONPATH")])])}


def run(*arguments, cwd, timeout=120, **options):
    return subprocess.run(
        [sys.executable, "-m", "furiko", *arguments],
        capture_output=True,
        text=True,
        cwd=cwd,
        timeout=timeout,
        env=ENVIRONMENT,
        check=False,
        **options,
    )


def one_clear_line(done, status):
    assert done.returncode == status, done
    if "--json" in done.args:
        assert set(json.loads(done.stdout)) == {"error"}
    else:
        assert done.stdout == ""
    (line,) = done.stderr.splitlines()
    assert line.startswith("furiko: ")
    return line


def test_smoke_agrees_and_writes_its_reports(tmp_path):
    done = run("check", "--profile", "smoke", cwd=tmp_path)
    assert done.returncode == 0, done
    assert done.stderr == ""
    assert "double-pendulum" in done.stdout
    assert "furiko-report" in done.stdout
    names = {path.name for path in (tmp_path / "furiko-report").iterdir()}
    assert names == {"report.jsonl", "report.html", "report.md", "junit.xml"}
    report = furiko.read_stream(tmp_path / "furiko-report")
    assert report.complete
    assert {result.outcome for result in report.results} == {"agrees"}


def test_a_difference_is_status_1(tmp_path):
    done = run("check", "rods-2", "-e", "fake_engines:SignFlipped", "--profile", "smoke", cwd=tmp_path)
    assert done.returncode == 1
    assert "differs" in done.stdout


def test_a_named_scene_of_which_nothing_is_compared_is_status_3(tmp_path):
    (tmp_path / "long.toml").write_text(f'[system]\nkind = "rod-chain"\nlengths = [{"1.0," * 3000}]\n')
    named = ("check", "rods-1", "long.toml", "--profile", "smoke", "-e", "pinocchio-aba")
    done = run(*named, cwd=tmp_path)
    assert done.returncode == 3, done
    assert "long was asked for, and nothing of it was compared" in done.stdout
    assert "Incomplete: 1 agrees" in done.stdout


def test_a_path_with_escapes_is_written_out(tmp_path):
    done = run("check", "\x1b[2J\u202e.toml", cwd=tmp_path)
    assert "\\x1b[2J\\u202e.toml" in one_clear_line(done, 2)
    assert "\x1b" not in done.stderr


def test_a_failing_engine_is_status_3(tmp_path):
    done = run("check", "rods-2", "-e", "fake_engines:Nan", "--profile", "smoke", cwd=tmp_path)
    assert done.returncode == 3
    assert "NaN" in done.stdout


def test_json_is_one_document_and_nothing_else(tmp_path):
    done = run("check", "rods-1", "--profile", "smoke", "--json", cwd=tmp_path)
    document = json.loads(done.stdout)
    assert set(document) == {"header", "results", "footer", "diagnoses", "known", "alone", "advisable"}
    assert document["footer"]["agrees"] == len(document["results"])
    for command in ("scenes", "engines", "cache"):
        assert json.loads(run(command, "--json", cwd=tmp_path).stdout)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["check", "double-pendulm"], "did you mean 'double-pendulum'"),
        (["check", "-e", "mujoko"], "did you mean 'mujoco'"),
        (["check", "-e", "nowhere:Engine"], "nowhere"),
        (["check", "--profile", "quik"], "did you mean 'quick'"),
        (["check", "missing.toml"], "missing.toml: cannot be read"),
        (["check", "--frobnicate"], "--frobnicate"),
        (["check", "--jobs", "0"], "--jobs"),
        (["check", "--jobs", "many"], "--jobs"),
        (["check", "--timeout", "-1"], "--timeout"),
        (["check", "--baseline", "missing.jsonl"], "missing.jsonl: cannot be read"),
        (["chekc"], "chekc"),
        (["export", "rods-2"], "--mjcf"),
        (["export", "rods-2", "--mjcf", "-o", "no/such/folder/x.xml"], "cannot be written"),
        (["export", "rods-2", "--urdf", "-o", "."], ".: cannot be written: Is a directory"),
        (["diff", "a", "b"], "a: cannot be read"),
        (["check", "bad.toml"], "bad.toml: system.lengths[0]: must be positive"),
        (["check", "huge.toml", "-e", "pinocchio-aba"], ""),
    ],
)
def test_bad_input_is_one_clear_line_and_status_2(tmp_path, arguments, says):
    (tmp_path / "bad.toml").write_text('[system]\nkind = "rod-chain"\nlengths = [-1.0]\n')
    (tmp_path / "huge.toml").write_text(f'[system]\nkind = "rod-chain"\nlengths = [{"1.0," * 10_001}]\n')
    done = run(*arguments, cwd=tmp_path)
    assert says in one_clear_line(done, 2)
    assert not (tmp_path / "furiko-report").exists()


def test_a_system_too_large_for_an_engine_is_skipped_in_words_before_memory_is_gone(tmp_path):
    (tmp_path / "long.toml").write_text(f'[system]\nkind = "rod-chain"\nlengths = [{"1.0," * 3000}]\n')
    done = run("check", "long.toml", "-e", "pinocchio-aba", "--profile", "smoke", cwd=tmp_path)
    assert done.returncode == 3, done  # nothing was compared
    assert "takes at most" in done.stdout


@pytest.mark.parametrize("place", ["/proc/furiko", "/dev/null/x"])
def test_an_unwritable_folder_is_one_clear_line(tmp_path, place):
    done = run("check", "rods-1", "--profile", "smoke", "--out", place, cwd=tmp_path)
    assert place in one_clear_line(done, 2)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs Linux's /dev/full to stand for a full disk")
def test_a_full_disk_is_one_clear_line_and_no_whole_report(tmp_path):
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / "report.jsonl").symlink_to("/dev/full")
    done = run("check", "rods-1", "--profile", "smoke", "--out", str(folder), cwd=tmp_path)
    assert "report.jsonl" in one_clear_line(done, 2)
    assert not (folder / "report.html").exists()


def test_interrupted_it_leaves_a_stream_that_says_so(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-m", "furiko", "check", "rods-2", "-e", "fake_engines:Hanging", "-e", "mujoco"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=ENVIRONMENT,
        # What runs in the background may have been told to pass over interrupts, and hands that on.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),  # noqa: PLW1509 (no threads)
    )
    stream = tmp_path / "furiko-report" / "report.jsonl"
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and not (stream.exists() and stream.read_text().count("\n") > 1):
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    assert process.returncode == 130
    (line,) = filter(None, errors.splitlines())  # after an empty one: a terminal has just shown ^C
    assert "interrupted" in line
    assert not furiko.read_stream(stream).complete
    assert not (stream.parent / "report.html").exists()


def test_a_broken_pipe_is_no_traceback(tmp_path):
    command = f"{sys.executable} -m furiko scenes | head -n 1"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.stderr == ""


def test_export_writes_what_the_library_writes(tmp_path):
    system = furiko.RodChain([1.0, 1.0])
    assert run("export", "rods-2-equal", "--mjcf", cwd=tmp_path).stdout == furiko.to_mjcf(system)
    run("export", "rods-2-equal", "--urdf", "-o", "model.urdf", cwd=tmp_path)
    assert (tmp_path / "model.urdf").read_text() == furiko.to_urdf(system)
    assert run("export", "rods-2-equal", "--urdf", "-o", "/dev/stdout", cwd=tmp_path).stdout == furiko.to_urdf(system)
    done = run("export", "rods-2-equal", "--mjcf", "--urdf", "-o", "both", cwd=tmp_path)
    assert done.stdout.split() == ["both/rods-2-equal.xml", "both/rods-2-equal.urdf"]
    assert (tmp_path / "both" / "rods-2-equal.xml").read_text() == furiko.to_mjcf(system)
    assert (tmp_path / "both" / "rods-2-equal.urdf").read_text() == furiko.to_urdf(system)


@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("furiko di", ["plain,diagnose", "plain,diff"]),
        ("furiko check rods-5-", ["plain,rods-5-chaotic", "plain,rods-5-equal", "plain,rods-5-no-gravity"]),
        ("furiko export hop", ["plain,hopper"]),
        ("furiko check my/sc", ["file,my/sc"]),  # no scene: the shell completes files itself
        ("furiko diff ru", ["file,ru"]),
        ("furiko check -e exu", ["plain,exudyn-tree", "plain,exudyn-redundant"]),
        ("furiko check --profile sm", ["plain,smoke"]),
    ],
)
def test_a_shell_completes_commands_scenes_engines_and_files(tmp_path, typed, offered):
    shell = {"_FURIKO_COMPLETE": "bash_complete", "COMP_WORDS": typed, "COMP_CWORD": str(len(typed.split()) - 1)}
    done = subprocess.run(
        [sys.executable, "-c", "from furiko.cli import main; main()"],
        capture_output=True, text=True, cwd=tmp_path, env=ENVIRONMENT | shell, check=False,
    )  # fmt: skip
    assert done.stdout.splitlines() == offered, done


def test_a_baseline_shows_what_got_worse(tmp_path):
    run("check", "rods-2", "-e", "fake_engines:Right", "--profile", "smoke", "--out", "before", cwd=tmp_path)
    stream = tmp_path / "before" / "report.jsonl"
    (tmp_path / "after").mkdir()
    text = stream.read_text().replace('"outcome":"agrees"', '"outcome":"differs"')
    text = text.replace('"agrees":1,"differs":0', '"agrees":0,"differs":1')
    (tmp_path / "after" / "report.jsonl").write_text(text)
    assert run("diff", "before", "before", cwd=tmp_path).returncode == 0
    worse = run("diff", "before", "after", cwd=tmp_path)
    assert worse.returncode == 1
    assert "rods-2" in worse.stdout


@pytest.mark.parametrize(
    "arguments",
    [
        ["diff", "old.jsonl", "now.jsonl"],
        ["diff", "now.jsonl", "old.jsonl"],
        ["check", "rods-1", "--baseline", "old.jsonl"],
        ["check", "rods-1", "--baseline", "old.jsonl", "--json"],
    ],
)
def test_a_stream_of_another_format_is_one_clear_line(make_stream, tmp_path, arguments):
    make_stream(tmp_path / "now.jsonl")
    # of that format nothing is known but how it says that it is another
    (tmp_path / "old.jsonl").write_text('{"kind":"header","format":99,"furiko":"9.9"}\n{"kind":"row"}\n')
    line = one_clear_line(run(*arguments, cwd=tmp_path), 2)
    assert line.startswith("furiko: old.jsonl, line 1: this stream has format 99, and this furiko reads format ")
    assert line.endswith("read it with furiko 9.9 that wrote it, or make the run again with this one")
    assert not (tmp_path / "furiko-report").exists()


@pytest.fixture
def make_stream():
    header = Header(
        furiko="1", started="", command="", profile="smoke", seed="", machine={}, versions={}, scenes=[], engines=[]
    )

    def make(path):
        with StreamWriter(path, header) as stream:
            stream.finish()

    return make


@pytest.mark.parametrize("arguments", [["--help"], ["check", "-h"]])
def test_help_is_printed(tmp_path, arguments):
    done = run(*arguments, cwd=tmp_path)
    assert done.returncode == 0
    assert "Usage" in done.stdout


def test_every_file_of_a_command_is_listed():
    files = {path.stem for path in (Path(furiko.__file__).parent / "cli").glob("*.py")}
    files -= {"__init__", "main", "options", "output", "progress", "process", "failures", "remaining"}
    assert {name.replace("_", "-") for name in files} == set(COMMANDS)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_help_and_its_line_is_the_one_in_the_list(name, capsys):
    command = cli.get_command(click.Context(cli), name)
    assert command.name == name
    assert " ".join(command.help.partition("\n\n")[0].split()) == COMMANDS[name]
    assert cli_run([name, "--help"]) == 0
    assert COMMANDS[name].split()[0] in capsys.readouterr().out
    # one line of a terminal, and words for every option
    assert len(COMMANDS[name]) <= 66
    assert all(option.help for option in command.params if isinstance(option, click.Option))


def test_a_command_imports_no_other(tmp_path):
    program = (
        "import sys; from furiko.cli.main import run; run(['--help']); run(['scenes', '--help']); "
        "print([name for name in sys.modules if name.startswith('furiko.')], file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=tmp_path, check=True)
    names = {"cli", "cli.main", "cli.scenes", "cli.options", "cli.output", "cli.process", "cli.failures"}
    names |= {"records", "records.exit_status", "records.printable"}
    assert {name.removeprefix("furiko.") for name in ast.literal_eval(done.stderr)} == names


def test_importing_furiko_imports_no_engine_and_nothing_heavy(tmp_path):
    program = (
        "import sys, furiko, furiko.cli, furiko.run; "
        "heavy = {'mujoco', 'pinocchio', 'exudyn', 'numba', 'scipy', 'sympy', 'heyoka', 'rich', 'jinja2'}; "
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=tmp_path, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.slow
def test_the_adapter_that_the_help_shows_is_one(tmp_path):
    shown = run("engine-test", "--help", cwd=tmp_path).stdout
    code = shown[shown.index("# my_engine.py") : shown.index("Options:")]
    (tmp_path / "my_engine.py").write_text("\n".join(line.removeprefix("      ") for line in code.splitlines()))
    done = run("check", "rods-2", "-e", "my_engine.py", cwd=tmp_path)
    assert done.returncode == 0, done
    assert done.stdout.startswith("All 8 comparisons agree; 7 skipped")


@pytest.mark.parametrize(
    ("profile", "engines", "cores", "processes"),
    [("smoke", 1, 8, 1), ("smoke", 3, 8, 3), ("smoke", 3, 2, 2), ("smoke", 0, 8, 8), ("quick", 1, 8, 8)],
)
def test_a_smoke_run_starts_no_more_workers_than_engines_are_named(profile, engines, cores, processes, monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: cores)
    assert usual_jobs(profile, engines) == processes
