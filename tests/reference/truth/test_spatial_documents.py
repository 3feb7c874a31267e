"""The documents' equations, as printed, are those of the same mechanisms in space: in balls, which overlap.

Every number is a multiple of one power of two, so that relative angles and moments of inertia are exact.
"""

import numpy as np
import pytest
from flint import arb

from furiko.models import NLegPendulum, RodChain
from furiko.models.coordinates import absolute_from_relative, to_relative
from furiko.reference import centrifugal_matrix, energies, gravity_vector, mass_matrix
from furiko.reference.arithmetic import balls
from furiko.reference.truth import newton_euler
from furiko.reference.truth.enclosures import accelerations_in_balls, precision
from furiko.reference.truth.spatial import energy, spatial_truth

rng = np.random.default_rng(20181112)


def dyadic(low, high, n):
    return np.round(rng.uniform(low, high, n) * 2**10) / 2**10


SYSTEMS = [
    NLegPendulum((1.0, 0.5), (1.0, 2.0), 9.8125),
    NLegPendulum((1.5, 0.5, 0.75, 2.0), (1.0, 0.25, 4.0, 0.5), 9.8125),
    NLegPendulum(tuple(dyadic(0.2, 2, 12)), tuple(dyadic(0.2, 2, 12))),
    RodChain((0.75,), 3.0, 9.8125),
    RodChain((1.5, 0.25, 0.75), 6.0),
    RodChain(tuple(dyadic(0.2, 2, 12)), 12.0),
]
IDS = [f"{system.kind}-{system.n}" for system in SYSTEMS]


def drawn(system):
    theta, omega = dyadic(-3, 3, system.n), dyadic(-5, 5, system.n)
    parents = system.tree().parents
    return theta, omega, to_relative(parents, theta), to_relative(parents, omega)


def overlap(ours, theirs):
    flat = np.asarray(theirs, dtype=object).ravel()
    scale = max(float(abs(ball).upper()) for ball in flat)
    assert all(one.overlaps(other) for one, other in zip(ours.balls.ravel(), flat, strict=True))
    assert max(float(ball.rad()) for ball in (*ours.balls.ravel(), *flat)) <= 1e-20 * scale


@pytest.mark.parametrize("system", SYSTEMS, ids=IDS)
def test_each_moment_of_inertia_is_exact(system):
    with precision(256):
        for link, length in zip(system.tree().links, system.lengths, strict=True):
            assert link.inertia == 0 or arb(link.inertia) == arb(system.density) * arb(length) ** 3 / 12


@pytest.mark.parametrize("system", SYSTEMS, ids=IDS)
def test_equations_of_motion(system):
    theta, omega, q, v = drawn(system)
    truth = spatial_truth(system.mechanism(), q, v)
    S = absolute_from_relative(system.tree().parents).astype(int).astype(object)
    with precision(192):
        angles, rates = balls().array(theta), balls().array(omega)
        overlap(truth.mass_matrix, S.T @ mass_matrix(system, angles) @ S)
        overlap(truth.gravity, S.T @ gravity_vector(system, angles))
        overlap(truth.velocity, S.T @ (centrifugal_matrix(system, angles) @ rates**2))


@pytest.mark.parametrize("system", SYSTEMS, ids=IDS)
def test_accelerations(system):
    theta, omega, q, v = drawn(system)
    parents = system.tree().parents
    truth = spatial_truth(system.mechanism(), q, v)
    with precision(192):
        literal = accelerations_in_balls(system, balls().array(theta)[None], balls().array(omega)[None])[0]
        overlap(truth.accelerations, to_relative(parents, literal))
        proved = newton_euler.enclosed_accelerations(system, theta, omega)
        each = zip(proved.high.tolist(), proved.low.tolist(), proved.radius.tolist(), strict=True)
        eliminated = np.array([arb(high) + arb(low) + arb(0, radius) for high, low, radius in each], dtype=object)
        overlap(truth.accelerations, to_relative(parents, eliminated))


@pytest.mark.parametrize("system", SYSTEMS, ids=IDS)
def test_energies(system):
    theta, omega, q, v = drawn(system)
    with precision(192):
        literal = energies(system, balls().array(theta), balls().array(omega))
        overlap(energy(system.mechanism(), q, v), [part.item() for part in literal])
