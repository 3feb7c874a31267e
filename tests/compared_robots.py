"""Two engines' readings of one file held together: their numbers, and how they move in one mapping."""

import math
from dataclasses import replace
from itertools import count

import numpy as np

from furiko.models.spatial_mechanism import SpatialMechanism


def as_read(compiled):
    """With furiko's names for what the file leaves unnamed."""
    joints, bodies = count(1), count(1)
    return SpatialMechanism(
        tuple(
            replace(
                body,
                name=body.name or f"furiko_body_{next(bodies)}",
                joints=tuple(
                    replace(joint, name=f"furiko_joint_{next(joints)}") if " " in joint.name else joint
                    for joint in body.joints
                ),
            )
            for body in compiled.bodies
        ),
        compiled.gravity,
    )


def states(mechanism, rows=20):
    rng = np.random.default_rng(5)
    shapes = (rows, mechanism.nq), (rows, mechanism.nv), (rows, mechanism.nv)
    return tuple(rng.normal(size=shape) for shape in shapes)


def close(found, expected, unit):
    """Two right engines differ by some ten roundings in the magnitudes that they add: 200 ε of ``unit``."""
    error = np.abs(found - expected)
    np.testing.assert_array_less(error, np.broadcast_to(200 * np.finfo(float).eps * unit, error.shape))


def assert_same_dynamics(mechanism, one, other):
    """M, bias, and accelerations under torque, without each one's own springs and dampers, in random states."""
    q, v, torque = states(mechanism)
    matrix = one.mass_matrix(q)
    diagonal = np.sqrt(np.einsum("bii->bi", matrix))
    close(other.mass_matrix(q), matrix, diagonal[:, :, None] * diagonal[:, None, :])
    # A bias is a sum over the bodies of a robot of some kilograms, metres and radians a second.
    speed = 1 + np.linalg.norm(v, axis=1, keepdims=True) ** 2
    close(other.bias(q, v), one.bias(q, v), 10 * diagonal * np.sqrt(len(mechanism.bodies)) * speed)
    accelerations = tuple(robot.accelerations(q, v, torque - robot.passive(q, v)) for robot in (one, other))
    condition = np.linalg.cond(matrix)[:, None]
    close(*accelerations, condition * np.abs(accelerations[0]).max(axis=1, keepdims=True))
    # Accelerations, M and bias are one equation: the mapping of torques and accelerations is that of M.
    for engine, found in zip((one, other), accelerations, strict=True):
        left = np.einsum("bij,bj->bi", engine.mass_matrix(q), found) + engine.bias(q, v) - torque
        close(left, 0, 10 * condition * diagonal * np.abs(found).max(axis=1, keepdims=True) + speed)


def assert_same_numbers(like, found, free=True):
    """Bodies that move, with those fixed to them, and their joints, by name.

    ``free``: where free bodies start too, which no dynamics shows.
    """
    ours, theirs = merged(like), merged(found)
    assert set(ours) == set(theirs)
    for name, (one, inertial) in ours.items():
        other, others_inertial = theirs[name]
        if free or one.joints[0].kind != "free":
            np.testing.assert_allclose(other.position, one.position, rtol=0, atol=1e-15)
            sign = math.copysign(1, other.quaternion @ one.quaternion)
            np.testing.assert_allclose(sign * other.quaternion, one.quaternion, rtol=0, atol=1e-15)
        # Moving a tensor of about 0.3 kg m² to another point and back leaves some roundings.
        np.testing.assert_allclose(others_inertial.mass, inertial.mass, rtol=1e-15)
        np.testing.assert_allclose(others_inertial.centre, inertial.centre, rtol=0, atol=1e-15)
        np.testing.assert_allclose(others_inertial.tensor, inertial.tensor, rtol=0, atol=1e-15)
        for a, b in zip(one.joints, other.joints, strict=True):
            assert (a.name, a.kind, a.ref, a.armature, a.damping) == (b.name, b.kind, b.ref, b.armature, b.damping)
            if a.kind in {"hinge", "slide"}:
                np.testing.assert_allclose(b.axis, a.axis / np.linalg.norm(a.axis), rtol=0, atol=1e-15)
            if a.kind in {"hinge", "ball"}:
                off = np.cross(b.anchor - a.anchor, a.axis) if a.kind == "hinge" else b.anchor - a.anchor
                np.testing.assert_allclose(off, 0, rtol=0, atol=1e-15)


def merged(mechanism):
    """Bodies with joints, and their inertials with those of the bodies fixed to them, by name."""
    found = {body.name: [body, body.inertial] for body in mechanism.bodies if body.joints}
    for body in mechanism.bodies:
        if not body.joints and body.parent >= 0:
            pose = body.pose
            found[mechanism.bodies[body.parent].name][1] += body.inertial.transformed(pose)
    return found
