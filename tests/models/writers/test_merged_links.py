"""Links that weigh nothing, merged into what they carry: the same motion, by ball arithmetic and by engines."""

import numpy as np
import pytest
from compared_robots import states
from handwritten_robots import LINK, urdf, urdf_joint

from furiko import diagnose
from furiko.models.readers.model_file import model_from_text
from furiko.models.writers.merged_links import without_weightless_links
from furiko.models.writers.spatial_mjcf import spatial_mjcf
from furiko.reference.truth.spatial import spatial_truth

EMPTY = '<link name="{}"/>'


def shoulder(between=3):
    """Between two links that weigh: joints about three axes and a slide, a frame fixed to one of what is between."""
    names = [f"e{k}" for k in range(between)]
    kinds = ("revolute", "prismatic", "continuous", "revolute", "continuous", "revolute", "continuous")
    axes = ("0 0.6 0.8", "1 0 0", "0 0 1", "0 1 0", "1 0 0", "0 1 0", "0 0 1")
    chain = ["a", *names, "b"]
    joints = [
        urdf_joint(kind, f"j{k}", above, below, axis)
        for k, (kind, axis, above, below) in enumerate(zip(kinds, axes, chain, chain[1:], strict=False))
    ]
    frame = [EMPTY.format("frame"), urdf_joint("fixed", "mount", "e1", "frame")] if between > 1 else []
    links = [LINK.format("a", 2), LINK.format("b", 1), LINK.format("c", 1), *(EMPTY.format(name) for name in names)]
    ends = [urdf_joint("continuous", "root", "world", "a", "0 1 0"), urdf_joint("revolute", "tip", "b", "c", "1 0 0")]
    return urdf([*links, *frame, *joints, *ends])


def test_the_motion_is_the_same():
    """Mass matrix and bias of Kane's equations, in ball arithmetic, joint for joint."""
    whole = model_from_text(shoulder(), "robot.urdf").spatial
    merged, left = without_weightless_links(whole)
    assert sorted(left) == ["e0", "e1", "e2", "frame"]
    assert merged.joint_names == whole.joint_names
    q, v, _ = states(whole, 4)
    for row in range(len(q)):
        one, other = (spatial_truth(mechanism, q[row], v[row]) for mechanism in (whole, merged))
        for name in ("mass_matrix", "bias"):
            expected = getattr(one, name).float
            np.testing.assert_allclose(getattr(other, name).float, expected, atol=1e-13 * np.abs(expected).max())


@pytest.mark.parametrize("between", [1, 3, 5])
def test_all_engines_read_what_is_written(tmp_path, between):
    path = tmp_path / "robot.xml"
    path.write_text(spatial_mjcf(without_weightless_links(model_from_text(shoulder(between)).spatial)[0]))
    found = diagnose(path)
    assert {engine["status"] for engine in found.engines.values()} == {"agrees"}, found.text()


def left_out(*parts):
    return without_weightless_links(model_from_text(urdf(parts)).spatial)[1]


def test_of_more_than_six_freedoms_only_six_are_one_bodys():
    """Seven joints between the two: the first link that weighs nothing keeps its own."""
    assert "e0" not in without_weightless_links(model_from_text(shoulder(6)).spatial)[1]


def test_what_one_body_cannot_have_stays():
    """A link that carries two, and one at the end."""
    heavy = [LINK.format(name, 1) for name in "bc"]
    first = [EMPTY.format("a"), urdf_joint("continuous", "j", "world", "a")]
    two = [urdf_joint("continuous", name, "a", name, "0 1 0") for name in "bc"]
    assert left_out(*first, *heavy, *two) == ()
    assert left_out(*first) == ()
    assert left_out(*first, heavy[0], two[0]) == ("a",)


def test_a_ball_stays_on_a_link_of_its_own():
    """Engines take it beside no other joint."""
    text = """<mujoco><worldbody><body name="a"><joint name="j"/><body name="b"><joint name="k" type="ball"/>
        <inertial pos="0 0 1" mass="1" diaginertia="1 1 1"/></body></body></worldbody></mujoco>"""
    assert without_weightless_links(model_from_text(text).spatial)[1] == ()
