"""Each mistake in reading MJCF, simulated by furiko's reader, against the engine that makes it.

Pinocchio reads the very bytes; of Drake 1.51.1, which no test needs installed, its numbers were written down.
"""

import numpy as np
import pinocchio
import pytest

from furiko.models.readers.rules import AS_DOCUMENTED, MjcfRules, flags_of, with_mjcf
from furiko.models.spatial import Pose, from_axis_angle, from_quaternion

from .compiled import read

INERTIAL = '<inertial pos="0.1 0 -1" mass="1" diaginertia="0.1 0.2 0.3"/>'
# What Pinocchio 4.1 always does, less what has a place only in some files.
PINOCCHIO = (
    *("first_root_only", "geoms_without_contact_weigh_nothing", "pose_of_first_fixed_body_dropped"),
    *("mesh_weighs_one_kilogram", "default_joint_pos_dropped", "default_geom_mass_dropped"),
    *("default_geom_pose_dropped", "childclass_behind_class", "total_mass_ignored", "inertia_group_ignored"),
    *(
        "balance_inertia_ignored",
        "bound_inertia_on_given_axes",
        "upper_euler_as_lower",
        "axis_not_normalised",
        "include_not_followed",
    ),
    *("late_sections_ignored", "later_sections_ignored", "bare_bodies_lost", "unnamed_sibling_twice"),
    *("first_ref_ignored", "gravity_not_read", "frame_ignored", "damping_dropped_on_free_and_ball", "springs_not_held"),
)


def mjcf(world, head="", tail=""):
    return f'<mujoco model="m">{head}<worldbody>{world}</worldbody>{tail}</mujoco>'


def arm(inside="", joint='<joint name="j" axis="0 1 0"/>', name="a", **attributes):
    given = "".join(f' {key}="{value}"' for key, value in attributes.items())
    return f'<body name="{name}"{given}>{joint}{INERTIAL}{inside}</body>'


def mass_matrix_and_gravity(mechanism, q):
    """M (nv, nv) and gravity's torque (nv,), of hinges and slides at q, by each body's Jacobian: the textbook's way."""
    joints = [joint for body in mechanism.bodies for joint in body.joints]
    matrix, torque = np.diag([joint.armature for joint in joints]), np.zeros(len(joints))
    poses, turning, moving, at = [], [], [], 0
    for body in mechanism.bodies:
        here = Pose(from_quaternion(body.quaternion), body.position)
        w, v = np.zeros((3, len(joints))), np.zeros((3, len(joints)))
        if body.parent >= 0:
            here, w, v = poses[body.parent] @ here, turning[body.parent].copy(), moving[body.parent].copy()
        for joint in body.joints:
            unit, moved = joint.axis / np.linalg.norm(joint.axis), q[at] - joint.ref
            axis, point = here.rotation @ unit, here.point(joint.anchor)
            if joint.kind == "slide":
                v[:, at] = axis
                here = Pose(here.rotation, here.translation + moved * axis)
            else:
                w[:, at], v[:, at] = axis, np.cross(point, axis)
                turn = here.rotation @ from_axis_angle(unit, moved)
                here = Pose(turn, point - turn @ joint.anchor)
            at += 1
        poses.append(here)
        turning.append(w)
        moving.append(v)
        inertial = body.inertial.transformed(here)
        centre = v + np.cross(w.T, inertial.centre).T
        matrix = matrix + inertial.mass * centre.T @ centre + w.T @ inertial.tensor @ w
        torque += inertial.mass * centre.T @ mechanism.gravity
    return matrix, torque


def pinocchios(text, tmp_path, q):
    path = tmp_path / "model.xml"
    path.write_text(text)
    model = pinocchio.buildModelFromMJCF(str(path))
    model = model[0] if isinstance(model, tuple) else model
    data, still, units = model.createData(), np.zeros(model.nv), np.eye(model.nv)
    gravity = pinocchio.computeGeneralizedGravity(model, data, q).copy()
    # Column by column, from inverse dynamics: Pinocchio's own algorithm for M relies on an order of the joints that two
    # bodies of one name do not have.
    columns = [pinocchio.rnea(model, data, q, still, unit) - gravity for unit in units]
    return np.stack(columns, axis=1), -gravity


def alike(one, other):
    # Both sums have some tens of terms of order one: a hundred roundings.
    return all(
        a.shape == b.shape and np.allclose(a, b, rtol=0, atol=1e-13 * max(1, np.abs(b).max()))
        for a, b in zip(one, other, strict=True)
    )


MESH = '<asset><mesh name="t" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>'
FILES = {
    "first_root_only": mjcf(arm() + arm(name="b", joint='<joint name="k" axis="0 1 0"/>')),
    "geoms_without_contact_weigh_nothing": mjcf(
        '<body name="a"><joint axis="0 1 0"/><geom size=".1" pos="0 0 -1"/>'
        '<geom size=".2" pos="1 0 0" contype="0" conaffinity="0"/></body>'
    ),
    "pose_of_first_fixed_body_dropped": mjcf(arm(arm(name="b"), joint="", euler="0 40 0")),
    "mesh_weighs_one_kilogram": mjcf(
        '<body name="a"><joint axis="0 1 0"/><geom type="mesh" mesh="t" pos="1 0 0" mass="7"/></body>', MESH
    ),
    "default_joint_pos_dropped": mjcf(arm(joint="<joint/>"), '<default><joint axis="0 1 0" pos="0 0 0.5"/></default>'),
    "default_geom_mass_dropped": mjcf(
        '<body name="a"><joint axis="0 1 0"/><geom size=".1" pos="0 0 -1"/></body>',
        '<default><geom mass="2"/></default>',
    ),
    "default_geom_pose_dropped": mjcf(
        '<body name="a"><joint axis="0 1 0"/><geom size=".1"/></body>', '<default><geom pos="1 0 0"/></default>'
    ),
    "childclass_behind_class": mjcf(
        arm(joint='<joint class="b"/>', childclass="a"),
        '<default><default class="a"><joint axis="1 0 0"/></default>'
        '<default class="b"><joint armature="2"/></default></default>',
    ),
    "total_mass_ignored": mjcf(arm(), '<compiler settotalmass="10"/>'),
    "inertia_group_ignored": mjcf(
        '<body name="a"><joint axis="0 1 0"/><geom size=".1" pos="0 0 1"/>'
        '<geom size=".2" pos="0 0 1" group="3"/></body>',
        '<compiler inertiagrouprange="0 2"/>',
    ),
    "balance_inertia_ignored": mjcf(
        '<body name="a"><joint axis="0 1 0"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 3"/></body>',
        '<compiler balanceinertia="true"/>',
    ),
    "bound_inertia_on_given_axes": mjcf(
        '<body name="a"><joint axis="1 1 0"/><inertial pos="0 0 0" mass=".1" fullinertia="1 1 1 .5 0 0"/>'
        '<body name="b"><joint axis="0 1 0"/><geom size=".1"/></body></body>',
        '<compiler boundmass="1" boundinertia=".8"/>',
    ),
    "upper_euler_as_lower": mjcf(
        arm(arm(name="b", joint='<joint name="k" axis="0 1 0"/>', euler="10 20 30")), '<compiler eulerseq="XYZ"/>'
    ),
    "axis_not_normalised": mjcf(
        '<body name="a"><joint axis="1 1 0"/><geom type="box" size=".1 .2 .3" pos="0 .2 0" axisangle="1 2 0 40"/>'
        '<body name="b"><joint axis="0 1 0"/><inertial pos="0 0 .2" mass="1" diaginertia=".1 .2 .25" '
        'axisangle=".6 0 .6 70"/></body></body>'
    ),
    "late_sections_ignored": mjcf(arm(joint="<joint/>"), "", '<default><joint axis="0 1 0"/></default>'),
    "later_sections_ignored": mjcf(
        arm(joint="<joint/>"), '<default><joint axis="0 1 0"/></default><default><joint armature="2"/></default>'
    ),
    "bare_bodies_lost": mjcf(
        arm(
            '<body><joint axis="1 0 0"/>'
            + INERTIAL
            + arm(name="c", joint='<joint axis="0 0 1" name="l"/>', pos="0 0 3")
            + "</body>"
        )
    ),
    "unnamed_sibling_twice": mjcf(
        arm(
            f'<body pos="1 0 0"><joint axis="1 0 0"/>{INERTIAL}</body>'
            '<body pos="0 2 0"><joint axis="0 1 0"/><geom size=".2"/>'
            + arm(name="y", joint='<joint name="l"/>', pos="0 0 7")
            + "</body>"
        )
    ),
    "first_ref_ignored": mjcf(arm(joint='<joint axis="0 1 0" ref="30"/><joint axis="1 0 0" ref="20"/>')),
    "gravity_not_read": mjcf(arm(), '<option gravity="1 0 -2"/>'),
    "frame_ignored": mjcf(
        arm('<frame pos="0 0 1"><geom size=".1"/>' + arm(name="b", joint='<joint name="k"/>') + "</frame>")
    ),
}


@pytest.mark.parametrize("flag", FILES)
def test_a_mistake_reproduces_what_pinocchio_has(tmp_path, flag):
    text = FILES[flag]
    wrong = read(text, with_mjcf(flag).mjcf)
    joints = sum(len(body.joints) for body in wrong.bodies)
    q = np.linspace(0.3, 1.2, joints)
    theirs = pinocchios(text, tmp_path, q)
    # Gravity is never read there: compared with the number that the mistake alone has.
    assert alike(mass_matrix_and_gravity(wrong, q), theirs)
    right = read(text)
    same_joints = sum(len(body.joints) for body in right.bodies) == joints
    assert not (same_joints and alike(mass_matrix_and_gravity(right, q), theirs))


def test_all_mistakes_together_are_pinocchio_s(tmp_path):
    for text in FILES.values():
        wrong = read(text, with_mjcf(*PINOCCHIO).mjcf)
        q = np.linspace(0.3, 1.2, sum(len(body.joints) for body in wrong.bodies))
        assert alike(mass_matrix_and_gravity(wrong, q), pinocchios(text, tmp_path, q)), text


def test_an_include_is_not_followed(tmp_path):
    part = arm(name="b", joint='<joint name="k"/>')
    (tmp_path / "part.xml").write_text(f"<mujoco>{part}</mujoco>")
    text = mjcf(arm('<include file="part.xml"/>'))
    q = np.array([0.3])
    wrong = read(text, with_mjcf("include_not_followed").mjcf, tmp_path / "model.xml")
    assert alike(mass_matrix_and_gravity(wrong, q), pinocchios(text, tmp_path, q))
    assert len(read(text, None, tmp_path / "model.xml").bodies) == 2


def test_damping_and_springs_are_dropped_as_pinocchio_drops_them(tmp_path):
    ball = '<joint type="ball" damping="2" frictionloss="3" stiffness="4"/>'
    hinge = '<joint name="k" damping="2" stiffness="4"/>'
    text = mjcf(arm(arm(name="b", joint=hinge), joint=ball))
    path = tmp_path / "model.xml"
    path.write_text(text)
    model = pinocchio.buildModelFromMJCF(str(path))
    found = read(text, with_mjcf("damping_dropped_on_free_and_ball", "springs_not_held").mjcf)
    joints = [joint for body in found.bodies for joint in body.joints]
    assert [joint.damping for joint in joints for _ in range(joint.freedoms)] == list(model.damping)
    assert not any(joint.stiffness for joint in joints)


# As Drake 1.51.1 prints them: CalcMassMatrixViaInverseDynamics in its default configuration, q = ref.
DRAKES = {
    "pos_of_last_joint_for_all": (
        '<mujoco model="m"><worldbody><body name="b" pos="0 0 1" euler="90 0 0"><joint axis="0 1 0" pos="0 0 .5"/>'
        f'<joint axis="1 0 0"/><joint axis="0 0 1"/>{INERTIAL}</body></worldbody></mujoco>',
        [[0.56, -0.1, -0.31], [-0.1, 2.1, 0.1], [-0.31, 0.1, 0.31]],
    ),
    "armature_needs_actuator": (mjcf(arm(joint='<joint axis="0 1 0" armature="3"/>')), [[1.21]]),
    "nested_class_inherits_nothing": (
        mjcf(
            arm(joint='<joint class="size3"/>', childclass="robot"),
            '<default><default class="robot"><joint axis="0 1 0"/><default class="size3"/></default></default>',
        ),
        [[0.31]],
    ),
    "frame_ignored": (FILES["frame_ignored"], [[1.21]]),
    "bound_ignored": (
        mjcf(
            '<body name="a"><joint/><inertial pos="0 0 0" mass=".1" diaginertia=".1 .1 .1"/></body>',
            '<compiler boundmass="1" boundinertia="2"/>',
        ),
        [[0.1]],
    ),
}


@pytest.mark.parametrize("flag", DRAKES)
def test_a_mistake_reproduces_what_drake_has(flag):
    text, matrix = DRAKES[flag]
    found = read(text, with_mjcf(flag).mjcf)
    q = np.array([joint.ref for body in found.bodies for joint in body.joints])
    assert alike(mass_matrix_and_gravity(found, q)[:1], [np.array(matrix)])
    documented = read(text)
    q = np.array([joint.ref for body in documented.bodies for joint in body.joints])
    assert not alike(mass_matrix_and_gravity(documented, q)[:1], [np.array(matrix)])


def test_a_pose_at_the_last_joint_leaves_the_bodies_and_joints_as_they_are():
    """Drake's massless bodies between the joints are none of the file's: they are not told as another tree."""
    text = DRAKES["pos_of_last_joint_for_all"][0].replace("<joint axis", '<joint name="first" axis', 1)
    (body,) = read(text, with_mjcf("pos_of_last_joint_for_all").mjcf).bodies
    assert (body.name, len(body.joints)) == ("b", 3)
    # Turned about x by 90° and 1 m up, the world's y axis is the body's −z, and the point 0.5 m up is 0.5 m along −y.
    np.testing.assert_allclose(body.joints[0].axis, [0, 0, -1], atol=1e-15)
    np.testing.assert_allclose(body.joints[0].anchor, [0, -0.5, 0], atol=1e-15)


def test_damping_of_free_joints_is_dropped():
    text = mjcf(
        '<body name="a"><joint type="free" damping="2" frictionloss="1"/><inertial pos="0 0 0" mass="1" '
        'diaginertia="1 1 1"/><body name="b"><joint type="ball" damping="3"/><inertial pos="0 0 0" mass="1" '
        'diaginertia="1 1 1"/></body></body>'
    )
    joints = [body.joints[0] for body in read(text, with_mjcf("damping_dropped_on_free").mjcf).bodies]
    assert [(joint.damping, joint.friction) for joint in joints] == [(0, 1), (3, 0)]


def test_armature_of_a_driven_joint_stays():
    text = mjcf(arm(joint='<joint name="j" armature="3"/>'), "", '<actuator><motor joint="j"/></actuator>')
    assert read(text, with_mjcf("armature_needs_actuator").mjcf).bodies[0].joints[0].armature == 3


def test_the_gravity_flag_is_not_read():
    text = mjcf(arm(), '<option gravity="0 0 -5"><flag gravity="disable"/></option>')
    assert list(read(text, with_mjcf("gravity_flag_ignored").mjcf).gravity) == [0, 0, -5]  # as Drake has it
    assert not read(text).gravity.any()


def test_every_mistake_has_its_sentence_and_its_test():
    tested = {*FILES, *DRAKES, "include_not_followed", "damping_dropped_on_free_and_ball", "springs_not_held"}
    tested |= {"gravity_flag_ignored", "springdamper_ignored", "damping_dropped_on_free"}
    tested |= {"first_worldbody_again", "inertial_without_inertia_is_unit"}  # on files in tests/diagnosis/robots
    tested |= {"attach_ignored", "align_ignored"}  # in test_mjcf_attach.py and test_mjcf_aligned.py
    assert tested == set(flags_of(MjcfRules))
    assert not any(getattr(AS_DOCUMENTED.mjcf, flag) for flag in flags_of(MjcfRules))
    assert all(says and not says.endswith(".") for says in flags_of(MjcfRules).values())
    with pytest.raises(TypeError):
        with_mjcf("no_such_mistake")
