"""What holds for some releases only: ranges as pip reads them, and where each release falls."""

import pytest

from furiko.engines.releases import facts_of, is_final, needed_beside, release, too_old, within


@pytest.mark.parametrize(
    ("version", "releases", "is_in"),
    [
        ("3.9.0", "<4", True),
        ("4.0.0", "<4", False),
        ("3.10", ">=3.9", True),  # as numbers, not as text
        ("3.10", "<3.9", False),
        ("3.4", ">=3.4,<4", True),
        ("3.3.1", ">=3.4,<4", False),
        ("3.9", "==3.9.0", True),
        ("4.0.0", "<=4", True),
        ("4.0.1", "<=4", False),
        ("4.0.0", ">4", False),
    ],
)
def test_ranges(version, releases, is_in):
    assert within(version, releases) is is_in


def test_a_range_that_is_none_is_refused():
    with pytest.raises(ValueError):
        within("3.9", "~3")


def test_versions():
    assert release("3.9.0") == release("3.9") == (3, 9)
    assert release("2.3.1.post1") == (2, 3, 1)
    assert is_final("2.3.1.post1")
    assert not any(map(is_final, ("4.0rc1", "4.0.0b2", "1.0.dev3", "word")))


def test_what_pinocchio_3_needs_beside_it():
    # measured: without them 3.4 to 3.9 end in "liburdfdom_sensor.so.4.0: cannot open shared object file"
    assert needed_beside("pin", "3.9") == ("cmeel-urdfdom<5", "cmeel-tinyxml2<11")
    assert needed_beside("pin", "3.3.1") == needed_beside("pin", "4.0.0") == ()


def test_what_integrators_of_mujoco_do_with_free_bodies_is_a_fact_of_its_release():
    # read in MuJoCo's sources 3.6 to 3.12, and measured with 3.3.7, 3.9.0, 3.17.0 and 4.0.0 on two scenes
    for version, turning, own_rule in (("3.3.7", 2, False), ("3.9.0", 2, True), ("3.17.0", 2, False)):
        found = {one.name: one for one in facts_of("mujoco", version)["integrators"]}
        assert (found["RK4"].turning, bool(found["implicitfast"].lone_body)) == (turning, own_rule)
    assert facts_of("mujoco", "4.0.0") == {}


def test_placement_in_pinocchio_s_mjcf_is_a_fact_of_its_release():
    assert facts_of("pinocchio-aba-mjcf", "3.9.0") == {"placed": "parent"}
    assert facts_of("pinocchio-aba-mjcf", "4.0.0") == {}
    assert facts_of("pinocchio-aba-mjcf", "") == {}


def test_an_old_exudyn_is_told_apart():
    assert "1.11.0" in too_old("exudyn", "1.11.0")
    assert too_old("exudyn", "1.13.6") == too_old("exudyn", "") == ""
