"""Energies against the documents' Lagrangians in ball arithmetic."""

import numpy as np
import pytest

from furiko.models import InvalidInput, NLegPendulum, RodChain
from furiko.reference.kernels.energy import energies, energy
from furiko.reference.truth import enclosures as truth


@pytest.mark.parametrize("system", [RodChain((1.0, 0.3, 2.0), 0.7), NLegPendulum((1.0, 0.3, 2.0), (0.1, 4.0, 2.0))])
def test_energy_is_the_lagrangians(system):
    rng = np.random.default_rng(0)
    theta, omega = rng.uniform(-4, 4, (2, 20, 3))
    kinetic, potential = energies(system, theta, omega)
    np.testing.assert_array_equal(energy(system, theta, omega), kinetic + potential)
    off = truth.enclosed_energies(system, theta, omega).error(np.stack([kinetic, potential], axis=-1))
    largest = kinetic + sum(system.masses) * 9.81 * sum(system.lengths)
    assert (off <= 10 * np.finfo(float).eps * largest[:, np.newaxis]).all()  # a dozen roundings, each of ε/2
    assert (kinetic > 0).all()
    assert potential.shape == (20,)


def test_energy_by_hand():
    """One rod, horizontal: I ω²/2 with I = m l²/3, no height. Two points below one another at rest: two heights."""
    assert energy(RodChain((2.0,), 0.5), [np.pi / 2], [3.0]) == pytest.approx(0.5 * (1.0 * 4.0 / 3) * 9.0, rel=1e-15)
    hanging = NLegPendulum((1.0, 0.5), (2.0, 4.0), 10.0)
    assert energy(hanging, [0.0, 0.0], [0.0, 0.0]) == pytest.approx(-10.0 * (2.0 * 1.0 + 4.0 * 1.5), rel=1e-15)


def test_shapes_and_refusals():
    system = RodChain((1.0, 1.0))
    assert energy(system, np.zeros((4, 0, 2)), np.zeros((4, 0, 2))).shape == (4, 0)
    assert energy(system, [0.0, 0.0], [0.0, 0.0]).shape == ()
    with pytest.raises(InvalidInput, match="theta"):
        energy(system, [0.0], [0.0])
