"""One small fault in an engine's own model: detected, and the number named that is wrong, at its link, and no other.

``tests/score_robot_faults.py`` plants one into every number of every link of whole robots.
"""

from __future__ import annotations

import pytest
from faults.robots import CAUSES, FAULTS
from score_robot_faults import FILES, Asked, score

from furiko.diagnosis.robots.numbers import FieldDifference
from furiko.diagnosis.robots.wording import Places, field_findings

# The tool is fixed to the flange: MuJoCo keeps its body in a URDF as long as its link has a mass, Pinocchio adds it up.
LINK = """<link name="{}"><inertial><origin xyz="0.05 0.1 -0.2" rpy="0.3 -0.2 0.1"/><mass value="{}"/>
    <inertia ixx="0.11" iyy="0.2" izz="0.25" ixy="0.02" ixz="-0.01" iyz="0.03"/></inertial></link>"""
JOINT = """<joint name="{}" type="{}"><parent link="{}"/><child link="{}"/>
    <origin xyz="0.1 0.2 0.3" rpy="0.3 -0.4 0.5"/>
    <axis xyz="0 0.6 0.8"/></joint>"""
URDF = "".join(
    [
        '<robot name="arm"><link name="world"/>',
        *(LINK.format(name, mass) for name, mass in (("base", 3), ("upper", 2), ("flange", 1), ("tool", 0.5))),
        JOINT.format("mount", "fixed", "world", "base"),
        JOINT.format("shoulder", "continuous", "base", "upper"),
        JOINT.format("elbow", "continuous", "upper", "flange"),
        JOINT.format("grip", "fixed", "flange", "tool"),
        "</robot>",
    ]
)


def one_of_each(asked, link):
    """Of each kind that the robot has the last fault in the ``link``-th of the links that have it."""
    chosen = {}
    for fault in asked.faults():
        places = chosen.setdefault(fault.kind, {})
        places[fault.body] = fault
    return [[*places.values()][link % len(places)] for places in chosen.values()]


@pytest.mark.slow
@pytest.mark.parametrize("engine", FAULTS)
def test_a_fault_in_each_number_of_an_arm_is_named(engine):
    asked = Asked(FILES / "arm-7.xml", engine)
    faults = one_of_each(asked, 4)
    assert {fault.kind for fault in faults} == set(CAUSES)
    found = score(asked, faults)
    assert {kind: (one.matter, one.detected, one.named, one.misleading) for kind, one in found.items()} == {
        # Dampers are left to the caller of Pinocchio's dynamics: they move nothing, and are told all the same.
        kind: (0, 0, 0, 0) if (kind, engine) == ("damping", "pinocchio-aba") else (1, 1, 1, 0)
        for kind in CAUSES
    }


@pytest.mark.parametrize("engine", FAULTS)
def test_a_link_of_several_bodies_that_is_placed_otherwise_is_one_difference(tmp_path, engine):
    file = tmp_path / "arm.urdf"
    file.write_text(URDF)
    asked = Asked(file, engine)
    assert asked.known == []
    for fault in asked.faults():
        if fault.kind in ("axis", "position", "orientation") and fault.joint == "elbow":
            (found,) = asked.findings(fault)
            assert asked.right(fault, found), found.says


def test_a_tensor_that_differs_in_the_seventh_digit_is_told_with_so_many(tmp_path):
    file = tmp_path / "arm.urdf"
    file.write_text(URDF)
    asked = Asked(file, "mujoco")
    fault = next(fault for fault in asked.faults() if (fault.kind, fault.body) == ("mass", "upper"))
    (found,) = asked.findings(fault)
    assert "mass 2.000002 kg, the file says 2 kg" in found.says
    tensors = ([0.11, 0.2000002, 0.25, 0.0, 0.0, 0.0], [0.11, 0.2, 0.25, 0.0, 0.0, 0.0])
    (found,) = field_findings("mujoco", [FieldDifference("inertia", "", "inertia", *tensors, "", 8e-7)], Places({}))
    assert "(0.11, 0.2000002, 0.25, 0, 0, 0), the file says (0.11, 0.2, 0.25, 0, 0, 0)" in found.says
