"""Joint forces of mechanisms in space: cases by hand, the documents' own, and momenta that change along motions."""

import numpy as np
import pytest
from spatial_trees import tree

from furiko.models import RodChain
from furiko.models.spatial import Inertial
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from furiko.reference import spatial_kinematics
from furiko.reference.truth import newton_euler
from furiko.reference.truth.spatial import spatial_truth

GRAVITY = np.array([0.0, 0.0, -9.81])
TENSOR = np.diag([0.1, 0.2, 0.3])


def rod(joint, centre, position=(0.0, 0.0, 0.0)):
    body = RigidBody("rod", -1, position=np.array(position), joints=(joint,), inertial=Inertial(2.0, centre, TENSOR))
    return SpatialMechanism((body,), GRAVITY)


def forces(mechanism, q, v, a):
    return spatial_truth(mechanism, np.array(q), np.array(v)).joint_forces(np.array(a)).float


def test_a_pendulum_at_rest_pulls_its_support_down_with_its_weight():
    hinge = Joint("hinge", axis=np.array([0.0, -1.0, 0.0]))
    found = forces(rod(hinge, np.array([0.0, 0.0, -0.5])), [0.0], [0.0], [0.0])
    assert found == pytest.approx(np.array([[0, 0, -2 * 9.81, 0, 0, 0]]))


def test_a_rod_that_is_held_out_turns_its_support_with_its_lever_about_the_links_origin_wherever_that_is():
    """r × F with r = (0.5, 0, 0), F = (0, 0, −2 g): about +y. Neither the anchor nor the world's origin."""
    hinge = Joint("hinge", axis=np.array([0.0, 0.0, 1.0]), anchor=np.array([0.2, 0.0, 0.0]))
    found = forces(rod(hinge, np.array([0.5, 0.0, 0.0]), position=(3.0, 4.0, 5.0)), [0.0], [0.0], [0.0])
    assert found == pytest.approx(np.array([[0, 0, -2 * 9.81, 0, 0.5 * 2 * 9.81, 0]]))


def test_what_whirls_pulls_outwards_and_what_speeds_up_pushes_back():
    """Turning about z at 3 rad/s with 4 rad/s²: m ω² r = 9 outwards, m α r = 4 against the motion along y, (I + m r²) α
    about z, against it too; the rest is weight."""
    hinge = Joint("hinge", axis=np.array([0.0, 0.0, 1.0]), armature=7.0)
    found = forces(rod(hinge, np.array([0.5, 0.0, 0.0])), [0.0], [3.0], [4.0])
    weight = 2 * 9.81
    assert found == pytest.approx(np.array([[9.0, -4.0, -weight, 0.0, 0.5 * weight, -(0.3 + 0.5) * 4.0]]))


def test_what_falls_freely_holds_nothing():
    found = forces(rod(Joint("free", "free"), np.zeros(3)), [0, 0, 0, 1, 0, 0, 0], [0.0] * 6, [0, 0, -9.81, 0, 0, 0])
    assert found == pytest.approx(np.zeros((1, 6)))


def test_the_documents_rods_pull_at_their_joints_as_takenos_equation_8_has_it():
    system = RodChain((0.8, 0.5, 0.7), 1.3, 9.81)
    theta, omega = np.array([[0.4, -1.1, 2.0]]), np.array([[1.5, -0.7, 2.2]])
    alpha = newton_euler.enclosed_accelerations(system, theta, omega).high
    expected = newton_euler.enclosed_joint_forces(system, theta, omega).high[0]
    mechanism = system.mechanism()
    q, v, a = (np.diff(row[0], prepend=0.0) for row in (theta, omega, alpha))
    found = forces(mechanism, q, v, a)
    assert found[:, [0, 2]] == pytest.approx(expected, rel=1e-13)
    assert found[:, 1] == pytest.approx(0, abs=1e-14)


@pytest.mark.parametrize("seed", range(20))
def test_forces_are_what_changes_momenta_of_all_that_hangs_there(seed):
    """F = weight − dP/dt, and moments about the world's origin alike, by differences of momenta along a motion.

    Of hinges and slides, whose coordinates along it are q + v t + a t²/2; momenta are computed another way. Differences
    over 2e-5 s of numbers of the size of 100 leave some 1e-9 by rounding and t².
    """
    rng = np.random.default_rng(seed)
    mechanism = hinges_and_slides(tree(rng, 5))
    nv = mechanism.nv
    q, v, a = rng.normal(size=nv), rng.normal(size=nv), 3 * rng.normal(size=nv)
    found = forces(mechanism, q, v, a)
    h = 1e-5
    times = np.array([-h, h])[:, None]
    moved = spatial_kinematics.motion(mechanism, q + times * v + times**2 / 2 * a, v + times * a)
    here = spatial_kinematics.motion(mechanism, q[None], v[None])
    moving = [index for index, body in enumerate(mechanism.bodies) if body.joints]
    assert len(found) == len(moving)
    for wrench, root in zip(found, moving, strict=True):
        linear, angular = spatial_kinematics.momentum(mechanism, moved, root)
        mass, first = weighed(mechanism, here, root)
        force = mass * mechanism.gravity - (linear[1] - linear[0]) / (2 * h)
        moment = np.cross(first, mechanism.gravity) - (angular[1] - angular[0]) / (2 * h)
        moment = moment - np.cross(here.position[0, root], force)
        size = 1 + np.abs(force).max() + np.abs(moment).max()
        assert np.abs(wrench - [*force, *moment]).max() < 1e-6 * size


def hinges_and_slides(mechanism):
    bodies = [
        RigidBody(
            body.name,
            body.parent,
            body.position,
            body.quaternion,
            tuple(Joint(j.name, "hinge" if j.kind == "ball" else j.kind, j.axis, j.anchor, j.ref) for j in body.joints),
            body.inertial,
        )
        for body in mechanism.bodies
    ]
    return SpatialMechanism(tuple(bodies), mechanism.gravity)


def weighed(mechanism, here, root):
    """Mass and Σ m c of all that hangs on a link."""
    hangs, mass, first = set(), 0.0, np.zeros(3)
    for index, body in enumerate(mechanism.bodies):
        if index == root or body.parent in hangs:
            hangs.add(index)
            mass += body.inertial.mass
            first += body.inertial.mass * (here.position[0, index] + here.rotation[0, index] @ body.inertial.centre)
    return mass, first
