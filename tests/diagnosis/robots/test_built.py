"""Exudyn, which reads no robot files, beside the engines that do: it moves the mechanism that furiko reads."""

from dataclasses import replace

import numpy as np
import pytest
from compared_robots import states

from furiko import diagnose
from furiko.diagnosis.robots import built
from furiko.engines.trees.robot_exudyn import ExudynRobot
from furiko.models.readers.model_file import read_model
from furiko.reference.truth.spatial import spatial_truth

INERTIAL = '<inertial pos="0.1 0 -0.4" mass="1.5" diaginertia="0.1 0.2 0.25"/>'
ARM = f"""<mujoco><worldbody><body name="a" pos="0 0 1" euler="10 20 30"><joint name="j1" axis="1 2 0" ref="20"
    damping="0.3" stiffness="2" springref="10"/>{INERTIAL}<body name="b" pos="0.3 0 0">
    <joint name="j2" axis="0 0 1" pos="0 0.1 0"{{}}/><joint name="j3" type="slide" axis="0 1 1"/>{INERTIAL}</body>
    </body></worldbody></mujoco>"""


@pytest.fixture
def saved(tmp_path):
    def made(text):
        path = tmp_path / "robot.xml"
        path.write_text(text)
        return path

    return made


def test_hinges_and_slides_are_moved_by_exudyn_too(saved):
    found = diagnose(saved(ARM.format("")))
    assert found.engines["exudyn-tree"]["status"] == "agrees"
    assert found.engines["exudyn-tree"]["reads the file itself"] is False
    assert {one["quantity"] for one in found.engines["exudyn-tree"]["measured"]} >= {"mass matrix", "bias"}
    assert found.verdict == "agrees"


def test_its_accelerations_are_those_of_first_principles(saved):
    """Ball arithmetic's, with the springs, the damper and forces on the joints."""
    mechanism = read_model(saved(ARM.format(""))).spatial
    q, v, torque = states(mechanism, 4)
    found = ExudynRobot(mechanism).accelerations(q, v, torque)
    for row in range(len(q)):
        truth = spatial_truth(mechanism, q[row], v[row])
        passive, matrix, bias = (getattr(truth, name).float for name in ("passive", "mass_matrix", "bias"))
        np.testing.assert_allclose(ExudynRobot(mechanism).passive(q, v)[row], passive, atol=1e-12)
        np.testing.assert_allclose(matrix @ found[row] + bias, passive + torque[row], atol=1e-10)


def test_armature_is_left_out_and_said(saved):
    found = diagnose(saved(ARM.format(' armature="0.2"')))
    assert found.engines["exudyn-tree"]["status"] == "agrees"
    assert "armature in exudyn-tree, whose kinematic tree has none" in found.without


def test_what_it_cannot_hold_is_said(saved, monkeypatch):
    path = saved(f'<mujoco><worldbody><body name="a"><freejoint name="f"/>{INERTIAL}</body></worldbody></mujoco>')
    why = "its kinematic tree has hinges and slides alone, and joint 'f' is free"
    found = diagnose(path)
    assert "exudyn-tree" not in found.engines
    assert found.verdict == "agrees"
    assert f"exudyn-tree is not asked: {why}" in found.notes
    named = diagnose(path, engines=["exudyn-tree"])
    assert (named.verdict, named.exit_status, named.engines["exudyn-tree"]["says"]) == ("incomplete", 3, why)
    monkeypatch.setattr(built, "MOST_FREEDOMS", 2)
    assert "3 freedoms; at most 2" in built.why_not_built(read_model(saved(ARM.format(""))).spatial)


def test_an_engine_that_moves_it_otherwise_differs(saved, monkeypatch):
    """One per million too heavy a link is seen in the mass matrix."""

    class Heavier(ExudynRobot):
        def __init__(self, mechanism):
            body = mechanism.bodies[-1]
            heavier = replace(body.inertial, mass=body.inertial.mass * (1 + 1e-6))
            super().__init__(replace(mechanism, bodies=(*mechanism.bodies[:-1], replace(body, inertial=heavier))))

    monkeypatch.setattr("furiko.engines.trees.robot_exudyn.ExudynRobot", Heavier)
    found = diagnose(saved(ARM.format("")), engines=["exudyn-tree"])
    assert found.engines["exudyn-tree"]["status"] == "differs"
    assert [finding.cause for finding in found.findings] == ["unexplained"]


def test_exudyn_that_is_not_installed_is_missing(saved, monkeypatch):
    monkeypatch.setattr(built, "BUILT", replace(built.BUILT, adapter="no_such_module:Nothing"))
    found = diagnose(saved(ARM.format("")), engines=["exudyn-tree"])
    assert found.engines["exudyn-tree"]["status"] == "missing"


def link(name, mass, moments):
    given = " ".join(f'i{axes}="{moment}"' for axes, moment in zip(("xx", "yy", "zz"), moments, strict=True))
    return f"""<link name="{name}"><inertial><mass value="{mass}"/><inertia {given} ixy="0" ixz="0" iyz="0"/>
        </inertial></link>"""


def chain(*links):
    """Joints about z and x in turn, each link 0.3 m from the one before."""
    joint = """<joint name="j{0}" type="continuous"><parent link="{1}"/><child link="{2}"/><origin xyz="0.3 0 0"/>
        <axis xyz="{3}"/></joint>"""
    names = ["world", "a", "b", "c"]
    rows = [joint.format(n, *names[n : n + 2], ("0 0 1", "1 0 0")[n % 2]) for n in range(len(links))]
    return f'<robot name="r"><link name="world"/>{"".join(links)}{"".join(rows)}</robot>'


def test_where_a_joint_moves_no_mass_it_is_not_asked_and_not_accused(tmp_path):
    """Its mass matrix comes from accelerations, which are not determined there; two planar links, then two in space."""
    path = tmp_path / "robot.urdf"
    path.write_text(chain(link("a", 1, (0.1, 0.1, 0.1)), '<link name="b"/>'))
    found = diagnose(path)
    assert "exudyn-tree" not in found.engines
    assert [finding.cause for finding in found.findings] == ["inertia-rejected"], found.text()  # by MuJoCo
    assert any(note.startswith("exudyn-tree is not asked") and "'j1' moves no mass" in note for note in found.notes)
    named = diagnose(path, engines=["exudyn-tree"])
    assert (named.verdict, named.findings) == ("incomplete", ())


WITHOUT_MUJOCO = {"mujoco": "refused", "pinocchio-aba": "agrees", "exudyn-tree": "agrees"}


def statuses(found):
    return {name: engine["status"] for name, engine in found.engines.items()}


def test_a_negative_mass_is_read_alike_by_those_that_take_it(tmp_path):
    """The bound of its mass matrix has the magnitude of what it adds up."""
    path = tmp_path / "robot.urdf"
    path.write_text(chain(link("a", 1, (0.1, 0.1, 0.1)), link("b", -0.2, (0.1, 0.1, 0.1))))
    found = diagnose(path)
    assert statuses(found) == WITHOUT_MUJOCO, found.text()
    assert [body["mass"] for body in found.engines["pinocchio-aba"]["holds"]["bodies"]] == [0, 1, -0.2]


def test_a_mass_matrix_that_no_mechanism_has_judges_no_accelerations(tmp_path):
    """A negative moment: bounds of accelerations rest on its square root. Mass matrix and bias are judged."""
    path = tmp_path / "robot.urdf"
    path.write_text(chain(link("a", 1, (0.1, 0.1, -0.2)), link("b", 1, (0.1, 0.1, 0.1))))
    found = diagnose(path)
    assert statuses(found) == WITHOUT_MUJOCO, found.text()
    assert any("not positive definite" in note for note in found.notes)
    quantities = {one["quantity"] for one in found.engines["pinocchio-aba"]["measured"]}
    assert quantities == {"mass matrix", "bias"}
