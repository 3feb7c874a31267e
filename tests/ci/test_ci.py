"""The action, the GitLab job, the hook and the container file, from a project that is not furiko; steps as written."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml
from packaging.requirements import Requirement

ROOT = Path(__file__).parent.parent.parent
ROBOT = (ROOT / "models" / "files" / "rods-2.xml").read_text(encoding="utf-8")
CART = (ROOT / "models" / "files" / "cart-pole.xml").read_text(encoding="utf-8")
UNKNOWN_PARENT = '<robot name="arm">\n<link name="base"/>\n<joint name="j" type="fixed"/></robot>\n'


@pytest.fixture
def project(tmp_path):
    """A project with a robot, an engine of its own, and what is neither."""
    folder = tmp_path / "project"
    (folder / "robots").mkdir(parents=True)
    (folder / "robots" / "good.xml").write_text(ROBOT)
    (folder / "robots" / "broken.urdf").write_text(UNKNOWN_PARENT)
    (folder / "robots" / "launch.xml").write_text("<launch/>\n")
    shutil.copy(ROOT / "tests" / "fake_engines.py", folder / "my_adapter.py")
    return folder


@pytest.fixture
def python(tmp_path):
    """An interpreter that has everything: what pip is asked to install is written down, and not installed."""
    wrapper = tmp_path / "bin" / "python3"
    wrapper.parent.mkdir()
    asked = tmp_path / "asked"
    wrapper.write_text(
        f'#!/bin/sh\nif [ "$1 $2" = "-m pip" ]; then printf "%s\\n" "$@" >"{asked}"; exit 0; fi\n'
        f'exec "{sys.executable}" "$@"\n'
    )
    wrapper.chmod(0o755)
    return wrapper


def run(script, project, **environment):
    path = os.pathsep.join([str(ROOT / "furiko" / "ci"), os.environ["PATH"]])
    return subprocess.run(
        ["sh", "-e", "-c", script], cwd=project, capture_output=True, text=True, check=False, timeout=300,
        env=os.environ | {"PATH": path, "PYTHONPATH": str(ROOT)} | environment,
    )  # fmt: skip


def step(inputs):
    """The script of the action's first step, and its variables as GitHub would fill them in."""
    action = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
    first = action["runs"]["steps"][0]
    known = {name: said["default"] for name, said in action["inputs"].items()} | inputs
    env = {
        name: re.sub(r"\$\{\{ inputs\.(\w+) \}\}", lambda found: known[found[1]], value)
        for name, value in first["env"].items()
    }
    assert first["shell"] == "sh"
    assert "${{" not in first["run"], "an input in the script would be run as a part of it"
    return first["run"], env | {"GITHUB_ACTION_PATH": str(ROOT), "GITHUB_ACTIONS": "true"}


def act(project, python, tmp_path, **inputs):
    script, env = step(inputs | {"python": str(python)})
    files = {name: str(tmp_path / name) for name in ("GITHUB_STEP_SUMMARY", "GITHUB_OUTPUT")}
    return run(script, project, **env, **files)


def annotations(done):
    """What GitHub's runner would take as commands: lines between stop-commands and its end are not."""
    found, stopped = [], ""
    for line in (line.strip() for line in done.stdout.splitlines()):
        if stopped:
            stopped = "" if line == f"::{stopped}::" else stopped
        elif line.startswith("::stop-commands::"):
            stopped = line.removeprefix("::stop-commands::")
        elif line.startswith("::"):
            found.append(line)
    return found


def test_the_action_checks_an_engine_of_the_project(project, python, tmp_path):
    done = act(
        project, python, tmp_path, arguments="rods-2 -e my_adapter:SignFlipped --profile smoke", extras=""
    )  # fmt: skip
    assert done.returncode == 1, done
    asked = (tmp_path / "asked").read_text().split("\n")
    wanted = Requirement(asked[-2])  # as pip reads it: this action's own furiko
    assert (wanted.name, wanted.url) == ("furiko", f"file://{ROOT}")
    (only,) = annotations(done)
    assert only.startswith("::error title=an engine differs::my_adapter:SignFlipped: its angles are counted from")
    summary = (tmp_path / "GITHUB_STEP_SUMMARY").read_text()
    assert summary.startswith("## furiko ✗ 1 of 1 comparison differs.\n\n### Causes\n\n- my&#95;adapter")
    assert (tmp_path / "GITHUB_OUTPUT").read_text() == "status=1\n"
    assert {path.name for path in (project / "furiko-report").iterdir()} >= {
        "report.html", "report.md", "report.jsonl", "junit.xml",
    }  # fmt: skip


@pytest.mark.slow
def test_the_action_blames_a_model_file_at_its_line(project, python, tmp_path):
    patterns = "--against rods-3 -e mujoco -- robots/*.xml robots/*.urdf"
    done = act(project, python, tmp_path, command="diagnose", arguments=patterns)
    assert done.returncode == 1, done  # a difference outweighs the file that cannot be read
    lines = annotations(done)
    assert any(line.startswith("::error file=robots/good.xml,title=furiko%3A ") for line in lines)
    assert lines[-1].startswith("::error file=robots/broken.urdf,line=3,title=furiko::robots/broken.urdf, line 3, ")
    summary = (tmp_path / "GITHUB_STEP_SUMMARY").read_text()
    assert summary.startswith("## furiko ✗ 2 of 2 model files&#58; robots/good.xml; robots/broken.urdf\n")
    suites = ElementTree.parse(project / "furiko-report" / "junit.xml").getroot()
    assert [suite.get("name") for suite in suites] == ["robots/good.xml", "robots/broken.urdf"]
    assert (suites.get("failures"), suites.get("errors")) == ("1", "1")
    (failure,) = suites.iter("failure")
    assert "joint-dropped-by-parser" in failure.get("message")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "status", "line"), [("[system]\nkind = \n", 2, "line=2,"), ('[system]\nkind = "none"\n', 2, "")]
)
def test_a_file_that_cannot_be_read_is_named_everywhere(project, python, tmp_path, text, status, line):
    (project / "scene.toml").write_text(text)
    done = act(project, python, tmp_path, arguments="scene.toml -e my_adapter:Right")
    assert done.returncode == status
    (only,) = annotations(done)
    assert only.startswith(f"::error file=scene.toml,{line}title=furiko::")
    assert (tmp_path / "GITHUB_STEP_SUMMARY").read_text().startswith("## furiko ! scene.toml&#58; ")
    assert ElementTree.parse(project / "furiko-report" / "junit.xml").getroot().get("errors") == "1"


@pytest.mark.slow
def test_a_finding_is_annotated_at_the_line_that_it_names(project, python, tmp_path):
    (project / "other.xml").write_text(CART.replace('damping="0.12"', 'damping="0.13"'))
    (project / "cart.xml").write_text(CART)
    done = act(project, python, tmp_path, command="diagnose", arguments="--against cart.xml -e mujoco -- other.xml")
    line = 1 + CART[: CART.index('damping="0.12"')].count("\n")
    (only,) = annotations(done)
    assert only.startswith(f"::error file=other.xml,line={line},title=furiko%3A damping at ")


def test_nothing_that_a_file_says_is_a_command(project, python, tmp_path):
    name = "robots/::add-mask::x.urdf"
    (project / name).write_text(
        '<robot name="a">\n<link name="%0A::error::&#10;::warning::"/>\n<link name="b"/></robot>'
    )
    done = act(project, python, tmp_path, command="diagnose", arguments=name)
    (only,) = annotations(done)
    assert only.startswith("::error file=robots/%3A%3Aadd-mask%3A%3Ax.urdf,")
    assert "::error::" not in only.removeprefix("::error") or "%250A::error::" in only


def test_what_earlier_runs_left_is_not_this_runs(project, python, tmp_path):
    act(project, python, tmp_path, command="diagnose", arguments="robots/broken.urdf")
    done = act(project, python, tmp_path, command="diagnose", arguments="robots/launch.xml")
    assert done.returncode == 0
    assert not list((project / "furiko-report" / "models").iterdir())
    assert "no model file was looked at" in (project / "furiko-report" / "report.md").read_text()


def gitlab():
    job = yaml.safe_load((ROOT / "furiko" / "ci" / "gitlab.yml").read_text(encoding="utf-8"))[".furiko"]
    return job["script"], job["variables"], job["artifacts"]


@pytest.mark.slow  # builds the source archive, from it the wheel, and installs that
def test_the_gitlab_job_from_the_wheel(project, tmp_path):
    subprocess.run(
        [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(tmp_path), str(ROOT)],
        check=True, capture_output=True,
    )  # fmt: skip
    (wheel,) = tmp_path.glob("furiko-*.whl")
    subprocess.run([sys.executable, "-m", "venv", str(tmp_path / "image")], check=True)
    (site,) = (tmp_path / "image").glob("lib/python*/site-packages")
    packages = Path(yaml.__file__).parent.parent  # what the wheel needs, without the network
    (site / "packages.pth").write_text(f"{packages}\n")
    script, variables, artifacts = gitlab()
    chosen = {"FURIKO_REQUIREMENT": str(wheel), "FURIKO_ARGUMENTS": "rods-2 -e mujoco --profile smoke"}
    path = os.pathsep.join([str(tmp_path / "image" / "bin"), os.environ["PATH"]])
    done = subprocess.run(
        ["sh", "-e", "-c", "\n".join(script)], cwd=project, capture_output=True, text=True, check=False,
        env=os.environ | variables | chosen | {"PATH": path, "PYTHONPATH": "", "PIP_NO_DEPS": "1"},
    )  # fmt: skip
    assert done.returncode == 0, done
    for kept in (*artifacts["paths"], *artifacts["reports"].values()):
        assert (project / kept).exists()


def hook():
    (only,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    return only


@pytest.mark.slow  # two runs of pre-commit, each with engines' own processes
def test_the_hook_on_what_is_committed(project, python):
    """pre-commit itself, with the hook as it stands but for its environment: there everything is installed."""
    pre_commit = pytest.importorskip("pre_commit", reason="pre-commit is not installed")
    assert pre_commit
    command = [sys.executable, "-m", "pre_commit"]
    subprocess.run([*command, "validate-manifest", str(ROOT / ".pre-commit-hooks.yaml")], check=True)
    here = {key: value for key, value in hook().items() if key != "additional_dependencies"} | {"language": "system"}
    (project / ".pre-commit-config.yaml").write_text(json.dumps({"repos": [{"repo": "local", "hooks": [here]}]}))
    git = ["git", "-c", "user.name=x", "-c", "user.email=x@example.org"]
    subprocess.run([*git, "init", "-q"], cwd=project, check=True)
    subprocess.run([*git, "add", "."], cwd=project, check=True)
    shutil.copy(ROOT / "furiko" / "ci" / "furiko-ci", python.parent)  # beside its interpreter, as pip puts them
    path = os.pathsep.join([str(python.parent), os.environ["PATH"]])
    for more, status in (((), 1), (("--files", "robots/good.xml", "robots/launch.xml"), 0)):
        done = run(" ".join([*command, "run", *more]), project, PATH=path, PRE_COMMIT_HOME=str(project / ".cache"))
        assert done.returncode == status, done
    assert not (project / "furiko-report").exists()


def test_the_hook_needs_what_the_extra_has():
    extras = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    for requirement in hook()["additional_dependencies"]:
        assert f'"{requirement}"' in extras


def test_the_container_file_copies_what_there_is():
    """No container can be built in a test: what its steps name is there, and each is a line that a shell reads."""
    lines = (ROOT / "Containerfile").read_text(encoding="utf-8").splitlines()
    copied = [words[1] for words in map(str.split, lines) if words[:1] == ["COPY"] and not words[1].startswith("--")]
    assert copied == [".", "constraints.txt"]
    assert all((ROOT / name).exists() for name in copied)
    for line in lines:
        if line.startswith("RUN "):
            subprocess.run(["sh", "-n", "-c", line.removeprefix("RUN ")], check=True)


# Of Debian's packages, those that a slim image lacks, and what they bring; python:slim has the C and C++ libraries.
IN_PACKAGES = {
    "libgomp1": ("libgomp",),
    "libgl1": ("libGL", "libGLX", "libGLdispatch"),
    "libx11-6": ("libX11", "libxcb", "libXau", "libXdmcp", "libbsd", "libmd"),
}
IN_THE_IMAGE = ("linux-vdso", "ld-linux-x86-64", "libc", "libm", "libdl", "libpthread", "librt", "libutil", "libstdc++",
                "libgcc_s", "libz", "libcrypt")  # fmt: skip


@pytest.mark.skipif(shutil.which("ldd") is None, reason="there is no ldd")
def test_the_container_has_what_engines_are_linked_with():
    """Each shared library that an engine's modules need and no wheel brings is in the image, or put there."""
    site = Path(yaml.__file__).parent.parent
    inside = ("exudyn", "pinocchio", "cmeel.prefix/lib/python3*/site-packages/pinocchio", "mujoco")
    modules = [path for folder in inside for path in site.glob(f"{folder}/*.so")]
    if not modules:
        pytest.skip("no engine is installed")
    needed = set()
    for module in modules:
        told = subprocess.run(["ldd", str(module)], capture_output=True, text=True, check=False).stdout
        lines = [line for line in told.splitlines() if str(site) not in line]
        needed |= {line.split()[0].rpartition("/")[2].partition(".so")[0] for line in lines if line.strip()}
    words = (ROOT / "Containerfile").read_text(encoding="utf-8").split()
    there = {name for package, names in IN_PACKAGES.items() if package in words for name in names}
    wheels = {path.name.partition(".so")[0] for path in site.rglob("lib*.so*")}
    assert needed - there - set(IN_THE_IMAGE) - wheels == set()
