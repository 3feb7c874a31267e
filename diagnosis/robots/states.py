"""States in which a robot is looked at: inside its joints' ranges, turning and sliding, under random joint torques."""

from __future__ import annotations

import math

import numpy as np

from ...models.spatial_mechanism import Array, Joint, SpatialMechanism

STATES = 8
QUANTUM = 2.0**-30  # rad, m and their rates; so short numbers are turned into other coordinates with less rounding


def probe_states(mechanism: SpatialMechanism, count: int = STATES, seed: int = 1) -> tuple[Array, Array]:
    """Positions (count, nq) and velocities (count, nv) in MuJoCo's coordinates, SI units.

    Angles all round the circle and lengths within a metre, inside the joints' ranges; rates of both signs, none small.
    The first state is the reference configuration, at rest.
    """
    generator = np.random.Generator(np.random.PCG64(seed))
    q = np.empty((count, mechanism.nq))
    v = np.empty((count, mechanism.nv))
    for row in range(count):
        for placed in mechanism.joints:
            q[row, placed.columns_q] = _position(placed.joint, generator)
        v[row] = _rounded(generator.uniform(0.3, 2.0, mechanism.nv) * generator.choice([-1.0, 1.0], mechanism.nv))
    if count:
        q[0], v[0] = mechanism.reference, 0.0
    return q, v


def _position(joint: Joint, generator: np.random.Generator) -> Array:
    if joint.kind in ("ball", "free"):
        quaternion = generator.normal(size=4)
        quaternion /= np.linalg.norm(quaternion)
        place = _rounded(generator.uniform(-1.0, 1.0, 3))
        return quaternion if joint.kind == "ball" else np.concatenate([place, quaternion])
    reach = math.pi if joint.kind == "hinge" else 1.0
    low, high = joint.ref - reach, joint.ref + reach
    if joint.limits is not None and joint.limits[0] < joint.limits[1]:
        margin = 0.02 * (joint.limits[1] - joint.limits[0])
        low, high = max(low, joint.limits[0] + margin), min(high, joint.limits[1] - margin)
        if low > high:
            low = high = min(max(low, joint.limits[0]), joint.limits[1])
    return _rounded(np.array([generator.uniform(low, high)]))


def random_torques(mass_matrix: Array, bias: Array, seed: int = 2) -> Array:
    """Generalised forces (count, nv) that move each freedom about as much as its bias (count, nv) and inertia do."""
    generator = np.random.Generator(np.random.PCG64(seed))
    size = np.abs(bias) + 3.0 * np.einsum("bii->bi", mass_matrix)
    return np.asarray(size * generator.uniform(-1.0, 1.0, bias.shape))


def _rounded(values: Array) -> Array:
    return np.asarray(np.round(values / QUANTUM) * QUANTUM)
