"""Terms and accelerations of mechanisms in space against closed forms."""

import math

import numpy as np
import pytest

from furiko.models.errors import InvalidInput
from furiko.models.spatial import Inertial
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from furiko.reference.truth.spatial import energy, spatial_truth

GRAVITY = np.array([0.0, 0.0, -9.81])


def close(found, expected):
    # The expected value is computed in doubles, from a few operations.
    np.testing.assert_allclose(found.float, expected, rtol=1e-14, atol=1e-15)
    assert (found.radius <= 1e-15 * (1 + np.abs(found.float))).all()


def test_a_compound_pendulum():
    body = RigidBody(
        "rod",
        -1,
        joints=(Joint("hinge", axis=np.array([0.0, 3.0, 0.0]), armature=0.1, damping=0.2, stiffness=5, springref=0.3),),
        inertial=Inertial(2.0, np.array([0.0, 0.0, -0.7]), np.diag([0.3, 0.4, 0.5])),
    )
    truth = spatial_truth(SpatialMechanism((body,), GRAVITY), np.array([0.6]), np.array([1.5]), np.array([0.9]))
    inertia = 0.4 + 2 * 0.7**2 + 0.1
    weight = 2 * 9.81 * 0.7 * math.sin(0.6)
    held = -0.2 * 1.5 - 5 * (0.6 - 0.3)
    close(truth.mass_matrix, [[inertia]])
    close(truth.bias, [weight])
    close(truth.passive, [held])
    close(truth.accelerations, [(held + 0.9 - weight) / inertia])


def test_a_free_top_turns_by_eulers_equations():
    """Its centre is at its frame's origin: the place falls, and I ω̇ = Iω × ω + torque in its own axes."""
    inertia = np.array([0.3, 0.4, 0.5])
    body = RigidBody("top", -1, joints=(Joint("free", "free"),), inertial=Inertial(2.0, np.zeros(3), np.diag(inertia)))
    q, v = np.array([1.0, 2, 3, 0.4, -0.2, 0.7, 1.1]), np.array([3.0, -1, 2, 0.5, -4, 2])
    torque = np.array([0.4, 0.2, 0.8, 0.1, 0.2, 0.3])
    truth = spatial_truth(SpatialMechanism((body,), GRAVITY), q, v, torque)
    turning = (np.cross(inertia * v[3:], v[3:]) + torque[3:]) / inertia
    close(truth.mass_matrix, np.diag([2, 2, 2, *inertia]))
    close(truth.accelerations, [*(GRAVITY + torque[:3] / 2), *turning])
    kinetic = (2 * v[:3] @ v[:3] + inertia @ v[3:] ** 2) / 2
    close(energy(SpatialMechanism((body,), GRAVITY), q, v), [kinetic, 2 * 9.81 * 3])


def test_a_quarter_turn_of_a_ball_spring():
    half = math.sqrt(0.5)
    body = RigidBody(
        "ball",
        -1,
        joints=(Joint("ball", "ball", stiffness=3.0),),
        inertial=Inertial(1.0, np.zeros(3), np.eye(3)),
    )
    truth = spatial_truth(SpatialMechanism((body,), GRAVITY), np.array([half, 0, 0, half]), np.zeros(3))
    close(truth.passive, [0, 0, -3 * math.pi / 2])
    back = spatial_truth(SpatialMechanism((body,), GRAVITY), np.array([-half, 0, 0, half]), np.zeros(3))
    close(back.passive, [0, 0, 3 * math.pi / 2])  # three quarters forward are one quarter back
    rest = spatial_truth(SpatialMechanism((body,), GRAVITY), np.array([2.0, 0, 0, 1e-200]), np.zeros(3))
    close(rest.passive, [0, 0, -3e-200])


def test_a_body_that_nothing_moves_has_no_accelerations():
    massless = RigidBody("nothing", -1, joints=(Joint("hinge"),))
    truth = spatial_truth(SpatialMechanism((massless,), GRAVITY), np.zeros(1), np.zeros(1))
    close(truth.mass_matrix, [[0]])
    with pytest.raises(ArithmeticError, match="singular"):
        truth.accelerations  # noqa: B018


@pytest.mark.parametrize(
    ("q", "v", "says"),
    [([0.0], [0.0, 1.0], "v: 1 numbers"), ([math.nan], [0.0], "finite"), ([0.0, 1.0], [0.0], "q: 1 numbers")],
)
def test_states_that_are_none_are_refused(q, v, says):
    mechanism = SpatialMechanism((RigidBody("b", -1, joints=(Joint("hinge"),)),), GRAVITY)
    with pytest.raises(InvalidInput, match=says):
        spatial_truth(mechanism, np.array(q), np.array(v))


def test_directions_of_length_zero_are_refused():
    no_axis = RigidBody("b", -1, joints=(Joint("hinge", axis=np.zeros(3)),))
    with pytest.raises(InvalidInput, match="'hinge': its axis"):
        spatial_truth(SpatialMechanism((no_axis,), GRAVITY), np.zeros(1), np.zeros(1))
    ball = RigidBody("b", -1, joints=(Joint("ball", "ball"),))
    with pytest.raises(InvalidInput, match="'ball': its quaternion in q"):
        spatial_truth(SpatialMechanism((ball,), GRAVITY), np.zeros(4), np.zeros(3))
    turned = RigidBody("b", -1, quaternion=np.zeros(4))
    with pytest.raises(InvalidInput, match="'b': its quaternion"):
        spatial_truth(SpatialMechanism((turned,), GRAVITY), np.zeros(0), np.zeros(0))


def test_without_freedoms_there_is_nothing():
    truth = spatial_truth(SpatialMechanism((RigidBody("b", -1),), GRAVITY), np.zeros(0), np.zeros(0))
    assert truth.mass_matrix.float.shape == (0, 0)
    assert truth.accelerations.float.shape == truth.bias.float.shape == (0,)


def test_many_trees_beside_each_other_have_the_mass_matrix_of_each():
    """Of 60 free bodies that are alike, each moves alone: m on the translations, and the block of one body alone."""
    count = 60
    inertial = Inertial(2.0, np.array([0.1, 0, 0]), np.diag([1.0, 2.0, 2.5]))
    bodies = [RigidBody(f"b{k}", -1, joints=(Joint(f"j{k}", "free"),), inertial=inertial) for k in range(count)]
    mechanism, alone = (SpatialMechanism(tuple(some), GRAVITY) for some in (bodies, bodies[:1]))
    turned = np.array([0.5, -0.2, 0.3, 0.5, 0.5, -0.5, 0.5])
    matrix = spatial_truth(mechanism, np.tile(turned, count), np.zeros(6 * count)).mass_matrix
    block = spatial_truth(alone, turned, np.zeros(6)).mass_matrix
    expected = np.kron(np.eye(count), block.float)
    assert (matrix.float == expected).all()
    assert matrix.float[0, 0] == 2  # the mass
    assert (matrix.enclosure.radius <= 2.0**-80 * np.abs(block.float).max()).all()
    assert all(0 in ball for ball in matrix.balls[0, 6:])
