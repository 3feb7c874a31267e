"""Scene files: the format, and one clear line for everything that is wrong with one."""

import contextlib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.models import (
    InvalidInput,
    NLegPendulum,
    RodChain,
    catalogue,
    document_scenes,
    find_scene,
    find_scenes,
    tagged_scenes,
)
from furiko.models.scene import LARGEST_FILE, scene_from_toml

RODS = '[system]\nkind = "rod-chain"\nlengths = [1.0, 0.8]\n'
LEGS = '[system]\nkind = "n-leg"\nlengths = [1.0, 0.8]\nmasses = [1.0, 0.5]\n'


def test_the_format_of_the_design():
    scene = scene_from_toml(LEGS + "gravity = 9.81\n[state]\ntheta = [2.0, 2.5]\nomega = [0, 0]\nduration = 10\n", "x")
    assert scene.system == NLegPendulum((1.0, 0.8), (1.0, 0.5), 9.81)
    assert (scene.theta, scene.omega, scene.duration) == ((2.0, 2.5), (0.0, 0.0), 10.0)


def test_everything_but_the_system_is_optional():
    scene = scene_from_toml(RODS, "x")
    assert scene.system == RodChain((1.0, 0.8), 1.0, 9.81)
    assert scene.theta is None
    assert scene.random == 200


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("[system\n", "not TOML.*line 1"),
        ("x = " + "[" * 5000, "nested too deeply|not TOML"),
        ("", "system"),
        ('[system]\nkind = "rods"\nlengths = [1]', "system.kind: .*'rods'"),
        ('[system]\nkind = "rod-chain"', "system: .*lengths"),
        ('[system]\nkind = "rod-chain"\nlengths = "1"', "system.lengths: .*array.*str"),
        ('[system]\nkind = "rod-chain"\nlengths = [1, "a"]', r"system.lengths\[1\]: a number.*'a'"),
        ('[system]\nkind = "rod-chain"\nlengths = [1, true]', r"system.lengths\[1\]: a number.*True"),
        ('[system]\nkind = "rod-chain"\nlengths = []', "system.lengths: at least one"),
        ('[system]\nkind = "rod-chain"\nlengths = [1, 0]', r"system.lengths\[1\]: must be positive.*0.0"),
        ('[system]\nkind = "rod-chain"\nlengths = [1e400]', r"system.lengths\[0\]: must be .*finite.*inf"),
        ('[system]\nkind = "rod-chain"\nlengths = [nan]', r"system.lengths\[0\]: must be .*finite.*nan"),
        (f'[system]\nkind = "rod-chain"\nlengths = [1{"0" * 400}]', "lengths"),
        (RODS + "masses = [1, 1]", "system.masses: .*density"),
        (RODS + "dencity = 1.0", "system.dencity: unknown field.*did you mean 'density'"),
        (RODS + "gravity = -9.81", "system.gravity: .*9.81, not -9.81"),
        (LEGS + "density = 1.0", "system.density: .*masses"),
        ('[system]\nkind = "n-leg"\nlengths = [1, 1]', "system.masses: missing"),
        ('[system]\nkind = "n-leg"\nlengths = [1, 1]\nmasses = [1]', "system.masses: 1 given for 2 lengths"),
        ('[system]\nkind = "n-leg"\nlengths = [1]\nmasses = [1]', "system.lengths: .*at least 2"),
        (RODS + "[state]\ntheta = [1]", "state.theta: 1 values given, the system has 2"),
        (RODS + "[state]\ntheta = [1, nan]", r"state.theta\[1\]: must be finite"),
        (RODS + "[state]\nomega = [1, 1]", "state: .*theta"),
        (RODS + "[state]\ntheta = [1, 1]\nduration = -1", "state.duration: .*-1"),
        (RODS + "[state]\ntheta = [1, 1]\nduration = inf", "state.duration: .*inf"),
        (RODS + "[samples]\nrandom = -1", "samples.random"),
        (RODS + '[samples]\nnamed = ["hangin"]', "samples.named: .*did you mean 'hanging'"),
        (RODS + "[samples]\nrandom = 0\nnamed = []", "no state is left"),
        (RODS + "[sytem]\n", "sytem: unknown field.*did you mean 'system'"),
        (f'[system]\nkind = "rod-chain"\nlengths = [{"1," * 10_001}]', "at most 10000"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(text, says):
    with pytest.raises(InvalidInput, match=says) as caught:
        scene_from_toml(text, "x")
    assert "\n" not in str(caught.value)


@settings(deadline=None)
@given(st.text(max_size=200) | st.binary(max_size=200).map(lambda b: b.decode("latin1")))
def test_no_text_ends_in_anything_but_a_scene_or_invalid_input(text):
    for content in (text, RODS + text):
        with contextlib.suppress(InvalidInput):
            scene_from_toml(content, "x")


def test_an_unknown_scene_gets_the_nearest_name():
    with pytest.raises(InvalidInput, match="did you mean 'double-pendulum'"):
        find_scene("double-pendulm")


def test_a_missing_unreadable_or_huge_file_is_named(tmp_path):
    with pytest.raises(InvalidInput, match=r"nowhere.toml: cannot be read"):
        find_scene(str(tmp_path / "nowhere.toml"))
    (tmp_path / "folder.toml").mkdir()
    with pytest.raises(InvalidInput, match="cannot be read"):
        find_scene(str(tmp_path / "folder.toml"))
    huge = tmp_path / "huge.toml"
    huge.write_bytes(b"#" * (LARGEST_FILE + 1))
    with pytest.raises(InvalidInput, match="larger than"):
        find_scene(str(huge))
    binary = tmp_path / "binary.toml"
    binary.write_bytes(b"\xff\xfe")
    with pytest.raises(InvalidInput, match="not UTF-8"):
        find_scene(str(binary))


def test_two_scenes_of_one_name_are_refused(tmp_path):
    (tmp_path / "rods-2.toml").write_text(RODS)
    with pytest.raises(InvalidInput, match="two scenes are called 'rods-2'"):
        find_scenes(["rods-2", str(tmp_path / "rods-2.toml")])


def test_the_catalogue_covers_every_system_of_the_documents():
    scenes = document_scenes()
    legs = {s.system.n - 1 for s in scenes if isinstance(s.system, NLegPendulum)}
    rods = {s.system.n for s in scenes if isinstance(s.system, RodChain)}
    assert legs >= {1, 2, 3, 8, 32}
    assert rods >= {1, 2, 3, 5, 10, 20, 50, 100}
    named = {equation for scene in scenes for equation in scene.equations}
    assert {"shiki 1.10", "shiki 2.11", "shiki 3.12", "takeno 18", "takeno 19", "takeno 22", "takeno 8"} <= named
    assert any(scene.system.gravity == 0 for scene in scenes)
    assert all(scene.description and scene.equations for scene in scenes)


def test_every_system_has_two_hundred_states():
    assert all(find_scene(name).random >= 200 for name in catalogue())


def test_scenes_with_a_tag_are_those_of_the_whole_catalogue_that_have_it():
    whole = find_scenes(None)
    for tag in ("smoke", "chaotic", "shiki", "no such tag"):
        assert tagged_scenes(tag) == tuple(scene for scene in whole if tag in scene.tags)
    assert len(tagged_scenes("smoke")) == 4
