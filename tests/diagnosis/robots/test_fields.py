"""Two readings of one mechanism: no difference in other frames, and each changed number named where it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from furiko.diagnosis.robots.fields import field_differences
from furiko.models.readers.model_file import read_model
from furiko.models.spatial import Inertial, Pose, from_quaternion, to_quaternion
from furiko.models.spatial_mechanism import WORLD, Joint, RigidBody, SpatialMechanism

GRAVITY = np.array([0.0, 0.0, -9.81])


def random_inertial(rng):
    points = rng.normal(size=(6, 3)) * 0.2
    masses = rng.uniform(0.1, 1.0, 6)
    centre = masses @ points / masses.sum()
    r = points - centre
    tensor = sum(m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(masses, r, strict=True))
    return Inertial(float(masses.sum()), centre, tensor)


def random_mechanism(seed, n=7):
    rng = np.random.default_rng(seed)
    kinds = ["hinge", "slide", "ball", "hinge", "hinge"]
    bodies = []
    for i in range(n):
        joints = tuple(
            Joint(
                f"j{i}{k}",
                str(rng.choice(kinds)),
                rng.normal(size=3),
                rng.normal(size=3) * 0.1,
                ref=float(rng.uniform(-1, 1)),
                armature=float(rng.uniform(0, 0.1)),
                damping=float(rng.uniform(0, 1)),
            )
            for k in range(int(rng.integers(1, 3)) if i % 3 != 2 else 0)
        )
        parent = int(rng.integers(-1, i)) if i else WORLD
        bodies.append(
            RigidBody(f"b{i}", parent, rng.normal(size=3) * 0.3, rng.normal(size=4), joints, random_inertial(rng))
        )
    return SpatialMechanism(tuple(bodies), GRAVITY)


def inverse(pose):
    return Pose(pose.rotation.T, -pose.rotation.T @ pose.translation)


def in_other_frames(mechanism, seed):
    """Each body's frame turned and moved at random: numbers change, the mechanism does not."""
    rng = np.random.default_rng(seed)
    frames = [Pose(from_quaternion(rng.normal(size=4)), rng.normal(size=3)) for _ in mechanism.bodies]
    bodies = []
    for body, frame in zip(mechanism.bodies, frames, strict=True):
        back = inverse(frame)
        pose = body.pose @ frame
        if body.parent != WORLD:
            pose = inverse(frames[body.parent]) @ pose
        joints = tuple(
            # A point anywhere on a hinge's axis is the same hinge.
            replace(
                joint,
                axis=back.rotation @ joint.axis * 3.0,
                anchor=back.point(joint.anchor + (0.7 * joint.axis if joint.kind == "hinge" else 0.0)),
            )
            for joint in body.joints
        )
        bodies.append(
            replace(
                body,
                position=pose.translation,
                quaternion=to_quaternion(pose.rotation),
                joints=joints,
                inertial=body.inertial.transformed(back),
            )
        )
    return SpatialMechanism(tuple(bodies), mechanism.gravity)


def changed(mechanism, b, **fields):
    bodies = list(mechanism.bodies)
    bodies[b] = replace(bodies[b], **fields)
    return replace(mechanism, bodies=tuple(bodies))


@pytest.mark.parametrize("seed", range(20))
def test_other_frames_are_no_difference(seed):
    mechanism = random_mechanism(seed)
    assert field_differences(in_other_frames(mechanism, seed), mechanism) == []


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize(
    "cause", ["mass", "com-displaced", "inertia", "joint-axis", "joint-placement", "armature", "damping"]
)
def test_each_number_is_named_once_where_it_is(seed, cause):
    mechanism = random_mechanism(seed)
    b = next(i for i, body in enumerate(mechanism.bodies) if body.joints and body.joints[-1].kind == "hinge")
    body = mechanism.bodies[b]
    last, inertial = body.joints[-1], body.inertial
    if cause == "mass":
        found = changed(mechanism, b, inertial=replace(inertial, mass=inertial.mass * (1 + 1e-6)))
    elif cause == "com-displaced":
        found = changed(mechanism, b, inertial=replace(inertial, centre=inertial.centre + np.array([0, 1e-6, 0])))
    elif cause == "inertia":
        found = changed(mechanism, b, inertial=replace(inertial, tensor=inertial.tensor + np.diag([1e-6, 0, 0])))
    else:
        across = np.cross(last.axis, [0.3, 0.1, 0.9])
        joint = {
            "joint-axis": replace(last, axis=last.axis + 1e-6 * across),
            "joint-placement": replace(last, anchor=last.anchor + 1e-6 * across),
            "armature": replace(last, armature=last.armature + 1e-6),
            "damping": replace(last, damping=last.damping * (1 + 1e-6)),
        }[cause]
        found = changed(mechanism, b, joints=(*body.joints[:-1], joint))
    differences = field_differences(found, mechanism)
    causes = {d.cause for d in differences}
    place = f"link {body.name!r}" if cause in ("mass", "com-displaced", "inertia") else f"joint {last.name!r}"
    assert cause in causes
    assert differences[0].where == place
    # Bodies that are fixed to the changed one are one link with it: their common centre and tensor change too.
    beside = {"mass": {"com-displaced", "inertia"}, "com-displaced": {"inertia"}}.get(cause, set())
    if cause in ("joint-axis", "joint-placement"):
        # What hangs on a hinge that lies elsewhere is elsewhere seen from it, and the first name is the hinge's.
        assert differences[0].cause == cause
    else:
        assert causes - {cause} <= beside


@pytest.mark.parametrize("seed", range(5))
def test_a_body_that_is_placed_or_turned_otherwise_is_one_difference(seed):
    """Its joint, its inertial and all that hangs on it move along: in its own frame one number is wrong."""
    mechanism = random_mechanism(seed)
    moving = next(i for i, body in enumerate(mechanism.bodies) if body.joints and body.parent != WORLD)
    fixed = next(i for i, body in enumerate(mechanism.bodies) if not body.joints and body.parent != WORLD)
    for b, kind, where in (
        (moving, "joint", f"joint {mechanism.bodies[moving].joints[0].name!r}"),
        (fixed, "body", f"link {mechanism.bodies[fixed].name!r}"),
    ):
        body = mechanism.bodies[b]
        elsewhere = changed(mechanism, b, position=body.position + np.array([0, 1e-6, 0]))
        turned = changed(mechanism, b, quaternion=body.quaternion + np.array([0, 1e-6, 0, 0]))
        for found, cause in ((elsewhere, f"{kind}-placement"), (turned, f"{kind}-orientation")):
            assert [(d.cause, d.where) for d in field_differences(found, mechanism)] == [(cause, where)]
            assert field_differences(in_other_frames(found, seed), mechanism)


def test_a_lost_joint_and_an_added_one_are_told_before_all_else():
    mechanism = random_mechanism(3)
    first = next(i for i, body in enumerate(mechanism.bodies) if body.joints)
    lost = changed(mechanism, first, joints=mechanism.bodies[first].joints[:-1])
    name = mechanism.bodies[first].joints[-1].name
    assert (field_differences(lost, mechanism)[0].cause, field_differences(lost, mechanism)[0].where) == (
        "joint-dropped-by-parser",
        f"joint {name!r}",
    )
    assert field_differences(mechanism, lost)[0].cause == "joint-added"


def test_gravity_turned_and_weakened():
    mechanism = random_mechanism(1)
    turned = replace(mechanism, gravity=np.array([9.81, 0.0, 0.0]))
    weak = replace(mechanism, gravity=np.array([0.0, 0.0, -1.62]))
    assert [d.cause for d in field_differences(turned, mechanism)] == ["gravity-turned"]
    assert [d.cause for d in field_differences(weak, mechanism)] == ["gravity"]


def test_a_reference_turned_about_its_hinge_is_seen_in_what_hangs_on_it():
    mechanism = random_mechanism(5)
    b = next(i for i, body in enumerate(mechanism.bodies) if body.joints and body.joints[-1].kind == "hinge")
    body = mechanism.bodies[b]
    joint = replace(body.joints[-1], ref=body.joints[-1].ref + 0.3)
    found = changed(mechanism, b, joints=(*body.joints[:-1], joint))
    assert field_differences(found, mechanism)


def test_a_slides_reference_is_seen_and_no_other_pose_of_the_same_motion(tmp_path):
    """At the coordinate 0.2 a slide with ref 0.2 is where its body is posed; without ref 0.2 m further along."""

    def read(pos, ref):
        file = tmp_path / "slide.xml"
        file.write_text(
            f"""<mujoco><worldbody><body name="a" pos="{pos} 0 0"><joint name="j" type="slide" axis="1 0 0"
            ref="{ref}"/><inertial pos="0 0 1" mass="2" diaginertia="1 1 1"/></body></worldbody></mujoco>"""
        )
        return read_model(file).spatial

    said = read(0.5, 0.2)
    assert not field_differences(read(0.3, 0.0), said)  # the same place at each coordinate
    (found,) = field_differences(read(0.5, 0.0), said)
    assert (found.cause, found.found, found.expected) == ("joint-reference", 0.0, 0.2)


@pytest.mark.parametrize(("off", "causes"), [(7e-18, []), (1e-6, ["com-displaced"])])
def test_a_centre_is_held_against_the_size_of_the_body_where_there_is_no_other_length(off, causes):
    """A mesh about its own origin has its centre there to rounding, which is no length to hold a distance against."""

    def thrown(centre):
        inertial = Inertial(2.0, np.array([0.0, centre, 0.0]), np.diag([0.1, 0.2, 0.25]))
        return SpatialMechanism((RigidBody("b", WORLD, joints=(Joint("j", "free"),), inertial=inertial),), GRAVITY)

    assert [d.cause for d in field_differences(thrown(off), thrown(3e-18))] == causes
