"""``pytest --furiko`` in somebody else's project, found by its entry point as an installation has it."""

import json
import os
import tomllib

import pytest
from package_rooms import ROOT

pytest_plugins = ["pytester"]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


@pytest.fixture
def project(pytester, monkeypatch):
    """An empty project beside an installation of furiko that has the entry point of pyproject.toml."""
    installed = pytester.mkdir("installed")
    metadata = installed / "furiko_plugin-1.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: furiko-plugin\nVersion: 1\n")
    ((name, module),) = PROJECT["entry-points"]["pytest11"].items()
    (metadata / "entry_points.txt").write_text(f"[pytest11]\n{name} = {module}\n")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(installed), str(ROOT), str(ROOT / "tests")]))
    pytester.makeini("[pytest]\naddopts = --strict-markers -p no:cacheprovider\n")
    return pytester


SMOKE = ("--furiko", "--furiko-profile", "smoke")


@pytest.mark.slow
def test_scenes_and_engines_are_tests(project):
    done = project.runpytest_subprocess(
        *SMOKE, "--furiko-scene", "rods-[12]", "--furiko-engine", "mujoco", "--furiko-engine", "pinocchio-aba", "-v"
    )
    done.assert_outcomes(passed=4)
    done.stdout.fnmatch_lines(["furiko::rods-1-mujoco PASSED*", "furiko::rods-2-pinocchio-aba PASSED*"])


@pytest.mark.slow
def test_a_difference_fails_with_its_cause_and_nothing_else(project):
    done = project.runpytest_subprocess(
        *SMOKE, "--furiko-scene", "rods-2", "--furiko-engine", "fake_engines:SignFlipped", "--furiko-engine", "mujoco"
    )
    done.assert_outcomes(failed=1, passed=1)
    done.stdout.fnmatch_lines(["rods-2 × fake_engines:SignFlipped: 1 of 1 comparison differs."])
    done.stdout.fnmatch_lines(["*cause: *upward vertical*angle-convention*", "*accelerations: differs: *allowed*"])
    assert "Traceback" not in done.stdout.str()


def test_what_an_engine_cannot_do_is_skipped_with_its_reason(project):
    done = project.runpytest_subprocess(
        *SMOKE, "--furiko-scene", "cart-pole", "--furiko-engine", "exudyn-redundant", "-rs"
    )
    done.assert_outcomes(skipped=1)
    done.stdout.fnmatch_lines(["*takes the documents' mechanisms alone*"])


KNOWN = '[[known]]\nscene = "rods-*"\nengine = "fake_engines:*"\nreason = "issue 12"\n'


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "strict", "outcome"),
    [
        ("SignFlipped", False, {"xfailed": 1}),
        ("SignFlipped", True, {"xfailed": 1}),
        ("Right", False, {"xpassed": 1}),
        ("Right", True, {"failed": 1}),
        ("Nan", False, {"failed": 1}),  # no difference: the engine gives no number
    ],
)
def test_known_differences_are_expected_to_fail(project, engine, strict, outcome):
    project.makefile(".toml", known=KNOWN)
    more = ("-o", "xfail_strict=true") if strict else ()
    done = project.runpytest_subprocess(
        *SMOKE, "--furiko-scene", "rods-2", "--furiko-engine", f"fake_engines:{engine}",
        "--furiko-known", "known.toml", "-rxX", *more,
    )  # fmt: skip
    done.assert_outcomes(**outcome)
    if "failed" not in outcome:
        done.stdout.fnmatch_lines(["*issue 12*"])


MINE = """
import furiko
import pytest

def test_rod(furiko_engine):
    # A uniform rod of length 2 held level: -(3/2) g / 2.
    found = furiko_engine(furiko.RodChain([2.0], gravity=9.81)).accelerations([1.5707963267948966], [0.0])
    assert found == pytest.approx([-7.3575], rel=1e-12), furiko_engine.name

def test_plain():
    pass
"""


@pytest.mark.slow
def test_the_fixture_gives_each_engine(project):
    project.makepyfile(MINE)
    engines = ("--furiko-engine", "mujoco", "--furiko-engine", "exudyn-tree", "--furiko-scene", "rods-1")
    project.runpytest_subprocess(*SMOKE, *engines).assert_outcomes(passed=5)
    project.runpytest_subprocess(*SMOKE, *engines, "-m", "furiko").assert_outcomes(passed=4, deselected=1)
    project.runpytest_subprocess(*SMOKE, *engines, "-k", "test_rod and mujoco").assert_outcomes(passed=1, deselected=4)


def test_without_the_option_the_fixture_skips_and_nothing_heavy_is_imported(project):
    project.makepyfile(
        MINE.replace("import furiko\n", "")
        + "def test_light():\n    import json, sys\n    print(json.dumps(sorted(sys.modules)))\n"
    )
    done = project.runpytest_subprocess("-s", "-rs")
    done.assert_outcomes(passed=2, skipped=1)
    done.stdout.fnmatch_lines(["*needs --furiko*"])
    (line,) = [line for line in done.outlines if '"furiko.pytest_plugin"' in line]
    modules = set(json.loads(line[line.index("[") : line.rindex("]") + 1]))
    assert "furiko.pytest_plugin" in modules
    assert {name for name in modules if name.split(".")[0] == "furiko"} == {"furiko", "furiko.pytest_plugin"}
    assert not modules & {"numpy", "flint", "mujoco", "scipy", "msgspec"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "says"),
    [
        (("--furiko-scene", "nothing-*"), "no scene fits 'nothing-*'"),
        (("--furiko-engine", "mujuco"), "did you mean"),
        (("--furiko-profile", "quik"), "profile 'quik'"),
        (("--furiko-known", "none.toml"), "none.toml"),
    ],
)
def test_a_mistake_is_told_before_anything_runs(project, options, says):
    done = project.runpytest_subprocess("--furiko", *options)
    assert done.ret == pytest.ExitCode.USAGE_ERROR
    (line,) = [line for line in done.errlines if line.startswith("ERROR")]
    assert says in line


@pytest.mark.slow
def test_a_scene_of_ones_own(project):
    project.makefile(".toml", mine='[system]\nkind = "rod-chain"\nlengths = [1.0]\n')
    done = project.runpytest_subprocess(*SMOKE, "--furiko-scene", "mine.toml", "--furiko-engine", "mujoco", "-v")
    done.assert_outcomes(passed=1)
    done.stdout.fnmatch_lines(["furiko::mine-mujoco PASSED*"])
