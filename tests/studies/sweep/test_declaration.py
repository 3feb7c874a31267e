"""What a sweep's file says, by hand; and for a file that says nothing sensible, one line that says where."""

import pytest

from furiko.cli.main import run
from furiko.models import InvalidInput
from furiko.studies.sweep.declaration import sweep_from_toml

SMALL = """
engines = ["mujoco"]
[[scenes]]
scenes = ["rods-2"]
"""


def axes_of(text):
    (source,) = sweep_from_toml(SMALL + f"[scenes.parameters]\n{text}").sources
    return {axis.name: axis.values for axis in source.axes}


def test_a_file_with_everything_in_it():
    found = sweep_from_toml(
        """
        engines = ["mujoco", "pin"]
        checks = ["terms", "accelerations"]
        seeds = [7, 5]
        states = 3
        named = ["whirling"]
        chunk = 4
        [limits]
        seconds = 2.5
        memory = 1.5
        [[scenes]]
        scenes = ["rods-2", "rods-3"]
        [scenes.parameters]
        gravity = [1.0, 2.0, 3.0]
        l2 = 0.5
        [[random]]
        kind = "tree"
        links = [2, 5]
        """
    )
    formulations = ("pinocchio-aba", "pinocchio-aba-mjcf", "pinocchio-crba")
    assert found.engines == ("mujoco", *formulations)  # a package means all of its
    assert found.checks == ("accelerations", "terms")  # as a cell runs them
    assert list(found.seeds) == [7, 5]
    assert (found.states, found.named, found.chunk, found.seconds, found.memory) == (3, ("whirling",), 4, 2.5, 3 << 29)
    # rods-2 and rods-3 in three gravities each, and two sizes of trees; two seeds; four engines; chunks of four
    assert found.scenes == (3 + 3 + 1 + 1) * 2
    assert found.cells == 16 * 4
    assert found.chunks == 4
    assert found.parameters == ("gravity", "l2")


def test_ranges_are_evenly_spaced_and_end_where_they_should():
    assert axes_of("gravity = { from = 0, to = 9, count = 4 }") == {"gravity": (0.0, 3.0, 6.0, 9.0)}
    (values,) = axes_of('masses = { from = 0.01, to = 100, count = 5, spacing = "log" }').values()
    assert values == pytest.approx((0.01, 0.1, 1.0, 10.0, 100.0), rel=1e-15)  # some roundings of a power
    assert (values[0], values[-1]) == (0.01, 100.0)
    assert axes_of("gravity = { from = 2, to = 9, count = 1 }") == {"gravity": (2.0,)}


BAD = [
    ("", "engines"),
    ("engines = []\n" + SMALL.partition("]\n")[2], "engines: at least one is needed"),
    ('engines = ["mujco"]\n[[scenes]]\nscenes=["rods-2"]', "did you mean 'mujoco'"),
    ('engines = ["mujoco"]', "scenes: missing"),
    (SMALL + "[scenes.parameters]\ngravty = 1", "gravty: no parameter of this mechanism (did you mean 'gravity'?)"),
    (SMALL + "[scenes.parameters]\ngravity = -1", "scenes[0].parameters: gravity: must be zero or positive"),
    (SMALL + "[scenes.parameters]\ngravity = [1, 1]", "scenes[0].parameters.gravity: a value is there twice"),
    (SMALL + '[scenes.parameters]\ngravity = ["g"]', "scenes[0].parameters.gravity[0]: a number is needed"),
    (SMALL + "[scenes.parameters]\ngravity = nan", "scenes[0].parameters.gravity: must be finite"),
    (SMALL + "[scenes.parameters]\ngravity = []", "from 1 to 100000 values, got 0"),
    (SMALL + "[scenes.parameters]\nl3 = 1", "l3: no parameter"),
    (SMALL + "[scenes.parameters]\nm1 = 1", "m1: no parameter"),
    (SMALL + "[scenes.parameters]\ngravity = { from = 0, to = 1, count = 3, spacing = 'log' }", "above zero where the"),
    (SMALL + "[scenes.parameters]\ngravity = { from = 0, to = 1, count = 10000000 }", "count: from 1 to 100000"),
    (SMALL + "[scenes.parameters]\ngravity = { from = 0, to = 1, cunt = 3 }", "cunt"),
    ("seed = 1\n" + SMALL, "seed: unknown field (did you mean 'seeds'?)"),
    ("seeds = 0\n" + SMALL, "seeds: from 1 to 100000, got 0"),
    ("seeds = true\n" + SMALL, "seeds: how many, or a list"),
    ("seeds = [1, 1]\n" + SMALL, "seeds: a value is there twice"),
    ("seeds = [-1]\n" + SMALL, "seeds: how many, or a list"),
    ("states = -1\n" + SMALL, "states: from 0"),
    ("states = 0\nnamed = []\n" + SMALL.replace("rods-2", "n-leg-8-equal"), "none is left"),
    ("chunk = 0\n" + SMALL, "chunk: from 1"),
    ('checks = ["energies"]\n' + SMALL, "checks: 'energies' is none of"),
    ('named = ["upside"]\n' + SMALL, "named: rods-2 has no state 'upside'"),
    (SMALL.replace("rods-2", "rods-two"), "not in the catalogue"),
    (SMALL.replace("rods-2", "missing.toml"), "missing.toml"),
    (SMALL.replace('"rods-2"', '"rods-2", "rods-2"'), "rods-2: there twice"),
    ('engines = ["mujoco"]\n[[random]]\nkind = "n-leg"\nlinks = 1', "random[0].links: from 2 to 10000, got 1"),
    ('engines = ["mujoco"]\n[[random]]\nkind = "n-leg"\nlinks = 2.5', "random[0].links: whole numbers are needed"),
    ('engines = ["mujoco"]\n[[random]]\nkind = "ring"\nlinks = 2', "random[0].kind"),
    ("[limits]\nseconds = 0\n" + SMALL, "engines"),
    (SMALL + "[limits]\nseconds = inf", "limits.seconds: a finite number"),
    (SMALL + "[limits]\nmemory = 0.001", "limits.memory: a finite number from 0.05"),
    (
        "seeds = 100000\n" + SMALL + "[scenes.parameters]\ngravity = {from=0,to=1,count=100000}",
        "100,000,000 are",
    ),
    ("engines = [\n", "not TOML"),
    ("a" * 2000 + " = 1", "not TOML of a size"),
]


@pytest.mark.parametrize(("text", "says"), BAD)
def test_a_bad_file_is_one_clear_line(text, says, tmp_path, capsys):
    (tmp_path / "bad.toml").write_text(text)
    assert run(["sweep", str(tmp_path / "bad.toml"), "--out", str(tmp_path / "out")]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    (line,) = err.splitlines()
    assert "bad.toml" in line
    assert says in line, line
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["sweep"], "Missing argument"),
        (["sweep", "a.toml", "b.toml"], "one file is needed"),
        (["sweep", "report"], "one folder is needed"),
        (["sweep", "report", "nowhere"], "nowhere: no sweep: it has no manifest.json"),
        (["sweep", "nowhere.toml"], "nowhere.toml"),
        (["sweep", "a.toml", "--resume", "--fresh"], "one of the two"),
    ],
)
def test_bad_usage_is_one_clear_line(words, says, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert run(words) == 2
    out, err = capsys.readouterr()
    assert (out, len(err.splitlines())) == ("", 1)
    assert says in err


def test_a_scene_file_is_looked_for_beside_the_sweeps(tmp_path, monkeypatch):
    (tmp_path / "mine.toml").write_text('[system]\nkind = "rod-chain"\nlengths = [1.0, 2.0]\n')
    found = sweep_from_toml(SMALL.replace("rods-2", "mine.toml"), tmp_path)
    assert found.sources[0].base.system.lengths == (1.0, 2.0)
    with pytest.raises(InvalidInput, match=r"mine\.toml"):
        sweep_from_toml(SMALL.replace("rods-2", "mine.toml"), tmp_path / "elsewhere")
