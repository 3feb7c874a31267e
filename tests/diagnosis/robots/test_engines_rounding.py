"""What an engine's compiler rounds, and a robot that cannot be simulated, are no misreadings of a file."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from handwritten_robots import LINK

from furiko import diagnose
from furiko.diagnosis.finding import Finding
from furiko.diagnosis.model_files import engine_result
from furiko.diagnosis.model_files.engine_answers import EngineAnswer
from furiko.diagnosis.model_files.engine_result import EngineResult
from furiko.diagnosis.model_files.result import mechanism_to_json
from furiko.diagnosis.robots.answer import RobotAnswer
from furiko.diagnosis.robots.same_frame import frames_kept
from furiko.engines.model_files.robot import ROBOT_READERS
from furiko.models.readers.model_file import read_model
from furiko.models.spatial import Inertial
from furiko.models.spatial_mechanism import RigidBody, SpatialMechanism

INERTIAL = '<inertial pos="0.1 0 -0.4" mass="1.5" diaginertia="0.1 0.2 0.25"/>'
BODY = '<mujoco>{}<worldbody><body name="a"><joint name="j" axis="1 2 3"/>{}</body></worldbody></mujoco>'


def engine(tmp_path, text, name="mujoco", ending="xml"):
    file = tmp_path / f"robot.{ending}"
    file.write_text(text)
    found = diagnose(file, engines=[name])
    return found, found.engines[name]


@pytest.mark.parametrize("seed", range(6))
def test_a_mesh_turned_to_principal_axes_is_not_accused(tmp_path, seed):
    """The products of inertia that are left are below 1e-7 of the largest moment: more than 1e-11."""
    vertices = np.random.default_rng(seed).normal(size=(4, 3)).astype(np.float32)
    mesh = f'<mesh name="m" vertex="{" ".join(repr(float(x)) for x in vertices.ravel())}"/>'
    file = tmp_path / "robot.xml"
    file.write_text(BODY.format(f"<asset>{mesh}</asset>", '<geom type="mesh" mesh="m"/>'))
    assert diagnose(file, engines=["mujoco"]).engines["mujoco"]["status"] == "agrees"
    assert read_model(file).spatial.bodies[0].meshes > 0


def test_a_centre_of_mass_that_is_nearly_at_the_origin(tmp_path):
    """MuJoCo takes 8e-7 m for nothing; 2e-6 m it does not."""
    arm = '<body name="b"><joint name="k"/>' + INERTIAL + "</body>"
    near = BODY.format("", '<inertial pos="8e-7 0 0" mass="1" diaginertia="1 2 2.5"/>' + arm)
    found, answer = engine(tmp_path, near)
    assert answer["status"] == "agrees"
    assert any("within 1e-06 of the body's frame" in note for note in found.notes)
    found, answer = engine(tmp_path, near.replace("8e-7", "2e-6"))
    assert (answer["status"], any("within" in note for note in found.notes)) == ("agrees", False)


def test_a_moment_of_inertia_is_not_rounded_with_the_frame():
    """Axes that are turned by 2e-6 change moments by 4e-12 of their difference: 1e-6 of one is another inertia."""
    centre, moments = np.zeros(3), np.array([1.0, 2.0, 2.5])
    said = np.diag(moments)
    said[0, 1] = said[1, 0] = 1e-6  # an angle of 1e-6 between axes whose moments differ by 1
    for held, back in ((moments, True), (moments * [1, 1 + 1e-6, 1], False)):
        found, file = (
            SpatialMechanism((RigidBody("b", -1, inertial=Inertial(1.0, centre, tensor)),), np.zeros(3))
            for tensor in (np.diag(held), said)
        )
        assert (frames_kept(found, file, 1e-6) == ["b"]) == back


def test_an_inertial_that_is_in_its_frame_is_not_told(tmp_path):
    """A box about its own centre: rounding of its moments is no turn."""
    text = BODY.format("", '<geom type="box" size=".1 .2 .3"/>').replace(
        '<joint name="j" axis="1 2 3"/>', "<freejoint/>"
    )
    found, answer = engine(tmp_path, text)
    assert (answer["status"], [note for note in found.notes if "within" in note]) == ("agrees", [])


def test_a_spring_by_time_constant_that_pinocchio_does_not_know(tmp_path):
    text = BODY.format("", INERTIAL).replace('axis="1 2 3"', 'axis="0 1 0" springdamper="0.1 1" damping="0.25"')
    arm = '<body name="b"><joint name="k"/>' + INERTIAL + "</body></body>"
    found, _ = engine(tmp_path, text.replace("</body>", arm), "pinocchio-aba")
    assert [finding.cause for finding in found.findings] == ["springdamper-ignored"]
    assert "0.25 N m s/rad" in found.findings[0].says


def test_accelerations_that_are_not_finite_have_the_cause_of_it(tmp_path):
    """Pinocchio gives these geoms no mass, and its accelerations are not finite."""
    found, answer = engine(tmp_path, BODY.format("", '<geom size="0.1" contype="0" conaffinity="0"/>'), "pinocchio-aba")
    assert answer["status"] == "differs"
    assert found.findings[0].cause == "geoms-without-contact-weigh-nothing"


def test_a_joint_that_moves_no_mass_has_no_accelerations(tmp_path):
    link = '<link name="{}"/>'
    text = f"""<robot name="r"><link name="w"/>{link.format("a")}<joint name="j" type="continuous"><parent link="w"/>
        <child link="a"/><axis xyz="0 0 1"/></joint></robot>"""
    found, answer = engine(tmp_path, text, "pinocchio-aba", "urdf")
    assert answer["status"] == "agrees"
    assert any("moves no mass" in note for note in found.notes)


def test_an_inertial_that_is_not_understood_is_no_impossible_inertia(tmp_path):
    """MuJoCo's message names the attribute, which here begins with "mass"."""
    text = BODY.format("", '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><geom size="1" massive="1"/>')
    found, answer = engine(tmp_path, text)
    assert "massive" in answer["says"]
    assert [finding.cause for finding in found.findings] == ["file-refused"]


def test_a_mesh_without_volume_is_no_impossible_inertia(tmp_path):
    """MuJoCo's message advises "inertia to shell"; no inertial is wrong."""
    flat = '<asset><mesh name="m" vertex="0 0 0 1e-5 0 0 0 1e-5 0 0 0 1e-5"/></asset>'
    found, answer = engine(tmp_path, BODY.format(flat, INERTIAL + '<geom type="mesh" mesh="m"/>'))
    assert "mesh volume" in answer["says"]
    assert [finding.cause for finding in found.findings] == ["file-refused"]


def test_json_of_masses_that_are_numbers_of_numpy(tmp_path):
    """As a volume is where numpy has made it: it must not reach the document as one."""
    planar = planar_arm_file(tmp_path)
    links = tuple(replace(k, mass=np.float64(k.mass), inertia=np.float64(k.inertia)) for k in planar.links)
    for link in mechanism_to_json(replace(planar, links=links))["links"]:
        assert {type(link["mass"]), type(link["inertia"])} == {float}


def planar_arm_file(tmp_path):
    file = tmp_path / "arm.xml"
    file.write_text(PLANE.format(joint="", z="-0.4", moments="0.1 0.2 0.25", b=INERTIAL))
    return read_model(file).planar


PLANE = """<mujoco><worldbody><body name="a"><joint name="j" axis="0 1 0" {joint}/><inertial pos="0 0 {z}" mass="1.5"
    diaginertia="{moments}"/><body name="b" pos="0 0 -1"><joint name="k" axis="0 1 0"/>{b}</body></body></worldbody>
    </mujoco>"""


def planar_arm(tmp_path, joint="", z="-0.4", moments="0.1 0.2 0.25"):
    file = tmp_path / "arm.xml"
    file.write_text(PLANE.format(joint=joint, z=z, moments=moments, b=INERTIAL))
    return diagnose(file)


@pytest.mark.parametrize("z", ["8e-7", "-3e-8"])
def test_in_the_plane_too_a_centre_of_mass_nearly_at_the_origin_is_a_note(tmp_path, z):
    found = planar_arm(tmp_path, z=z)
    assert (found.verdict, found.findings, found.mechanism is not None) == ("agrees", (), True), found.text()
    assert any("within 1e-06 of the body's frame" in note for note in found.notes)
    assert found.mechanism["links"][0]["centre of mass"][0] == -float(z)  # what the file says is what is shown


def test_in_the_plane_too_geoms_that_touch_are_what_a_simulation_adds(tmp_path):
    """Two balls of 0.6 m, 1 m from one another: their bodies are not adjacent, so that MuJoCo lets them collide."""
    ball = '<geom type="sphere" size="0.6" mass="0"/>'
    link = f'<joint name="{{}}" axis="0 1 0"/>{INERTIAL}'
    c = f'<body name="c" pos="0 0 -0.5">{link.format("m")}{ball}</body>'
    b = f'<body name="b" pos="0 0 -0.5">{link.format("k")}{c}</body>'
    file = tmp_path / "arm.xml"
    file.write_text(f'<mujoco><worldbody><body name="a">{link.format("j")}{ball}{b}</body></worldbody></mujoco>')
    found = diagnose(file)
    assert (found.verdict, found.findings, found.mechanism is not None) == ("agrees", (), True), found.text()
    assert [said.cause for said in found.simulation if said.cause != "coarse-time-step"] == ["colliding-geoms"]
    assert "contacts" in found.without


def test_a_damped_planar_arm_that_all_read_alike_agrees(tmp_path):
    found = planar_arm(tmp_path, joint='damping="0.3" frictionloss="0.1" stiffness="2"')
    assert (found.verdict, found.findings) == ("agrees", ()), found.text()
    said = [note for note in found.notes if note.startswith("the file gives")]
    assert said == [f"the file gives {what} to 'j'" for what in ("damping", "dry friction", "a spring")]


def test_an_inertia_that_no_body_has_is_refused_once(tmp_path):
    found = planar_arm(tmp_path, moments="1 0.2 0.25")  # 0.2 + 0.25 < 1
    assert [finding.cause for finding in found.findings] == ["inertia-rejected"], found.text()


def test_a_misreading_is_kept_where_the_engines_own_numbers_are_not_understood():
    def found(cause):
        return Finding(cause, "x", None, None, cause)

    own = RobotAnswer("e", "differs", findings=[found("first-root-only"), found("unexplained")])
    planar = EngineAnswer("e", "differs", findings=[found("com-displaced"), found("float32")])
    assert causes(EngineResult("e", own, planar)) == ["first-root-only", "float32"]
    assert causes(EngineResult("e", own, EngineAnswer("e", "agrees"))) == ["first-root-only", "unexplained"]
    own.findings = own.findings[1:]
    assert causes(EngineResult("e", own, planar)) == ["com-displaced", "float32"]


def causes(result):
    return [finding.cause for finding in result.findings]


def test_no_worker_is_started_for_an_engine_that_is_not_installed(tmp_path, monkeypatch):
    started = []
    monkeypatch.setattr(engine_result, "call_isolated", lambda calls, timeout: started.extend(calls) or [])
    absent = replace(ROBOT_READERS["drake"], module="no_such_engine_x", adapter=".no_such_adapter:X")
    monkeypatch.setitem(engine_result.ROBOT_READERS, "drake", absent)
    file = tmp_path / "robot.xml"
    file.write_text(BODY.format("", INERTIAL))
    found = diagnose(file, engines=["drake"], isolated=True)
    assert (found.engines["drake"]["status"], started) == ("missing", [])


def test_a_joint_through_a_point_mass_moves_no_mass_whatever_the_angles(tmp_path):
    """Its entry of the mass matrix is zero in the reals, and a few 1e-41 in any arithmetic that turns the link."""
    zero = " ".join(f'i{axes}="0"' for axes in ("xx", "xy", "xz", "yy", "yz", "zz"))
    links = [f'<link name="{n}"><inertial><mass value="0.2"/><inertia {zero}/></inertial></link>' for n in "ab"]
    joint = """<joint name="{}" type="continuous"><origin xyz="{}" rpy="{}"/><axis xyz="0 0 1"/><parent link="{}"/>
        <child link="{}"/></joint>"""
    first = joint.format("j1", "0 0 0.1", "0 0.4 1.5", "w", "a")
    second = joint.format("j2", "0.3 0.1 0", "1.5 0.2 0.3", "a", "b")
    text = f'<robot name="r"><link name="w"/>{"".join(links)}{first}{second}</robot>'
    found, answer = engine(tmp_path, text, "pinocchio-aba", "urdf")
    assert answer["status"] == "agrees"
    assert any("moves no mass" in note for note in found.notes)


@pytest.mark.parametrize(
    ("limit", "says"),
    [
        ('<limit lower="-1" upper="1" velocity="1"/>', "limit has no effort. Instead, give <limit> both effort= and"),
        ('<limit lower="-1" upper="1" effort="1"/>', "limit has no velocity. Instead, give <limit> both effort= and"),
        ("", "[j] is of type REVOLUTE but it does not specify limits"),
    ],
)
def test_what_pinocchios_parser_of_urdf_says_is_passed_on(tmp_path, limit, says):
    """Its error names the file alone; why is written to standard error."""
    text = f"""<robot name="r"><link name="w"/>{LINK.format("a", 1)}<joint name="j" type="revolute"><parent link="w"/>
        <child link="a"/><axis xyz="0 0 1"/>{limit}</joint></robot>"""
    found, answer = engine(tmp_path, text, "pinocchio-aba", "urdf")
    assert answer["status"] == "refused"
    assert says in answer["says"]
    assert [finding.cause for finding in found.findings] == ["file-refused"]
