"""Enclosures: against plain ball elimination, first principles, and against its own promise."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.models import NLegPendulum, RodChain
from furiko.reference import energies, joint_forces, literal_accelerations, mass_matrix
from furiko.reference.arithmetic import balls
from furiko.reference.documents import equations_of_motion as motion
from furiko.reference.truth import linear_solve as verified
from furiko.reference.truth.enclosures import (
    RELATIVE_RADIUS,
    enclosed_accelerations,
    enclosed_energies,
    enclosed_joint_forces,
    enclosed_terms,
    precision,
)

STAR = NLegPendulum((1.0, 0.8, 0.6), (1.0, 0.5, 2.0))
CHAIN = RodChain((1.0, 0.8, 0.6, 0.9), 1.3)


def random_state(system, count, seed=1, rate=5.0):
    generator = np.random.default_rng(seed)
    return generator.uniform(-np.pi, np.pi, (count, system.n)), rate * generator.normal(size=(count, system.n))


def random_chain(n, seed=2):
    return RodChain(tuple(np.random.default_rng(seed).uniform(0.5, 1.0, n)))


def eliminated(system, theta, omega, bits):
    """θ̈ in balls by flint's own elimination, one state."""
    with precision(bits):
        xp = balls()
        equations = motion.literal_system(xp, system, xp.array(theta), xp.array(omega))
        return xp.solve(equations.matrix, equations.right)


def assert_overlap(truth, enclosures):
    """The truth's ball and flint's hold the same number, so they must meet."""
    with precision(600):
        for high, low, radius, ball in zip(
            truth.high.ravel(), truth.low.ravel(), truth.radius.ravel(), enclosures.ravel(), strict=True
        ):
            assert (type(ball)(high, radius) + low).overlaps(ball)


@pytest.mark.parametrize("n", [1, 2, 5, 12, 13, 20, 40])
def test_truth_meets_flints_own_elimination(n):
    system = random_chain(n)
    theta, omega = random_state(system, 3)
    truth = enclosed_accelerations(system, theta, omega)
    for i in range(3):
        # 600 bits: elimination loses a few bits a rod, so its balls stay far narrower than the truth's radius
        ball = eliminated(system, theta[i], omega[i], 600)
        assert max(float(b.rad()) for b in ball) < 1e-50
        row = type(truth)(truth.high[i], truth.low[i], truth.radius[i])
        assert_overlap(row, ball)
    assert truth.relative_radius <= RELATIVE_RADIUS


def test_a_hundred_rods():
    system = random_chain(100)
    theta, omega = random_state(system, 2)
    truth = enclosed_accelerations(system, theta, omega)
    assert truth.relative_radius <= RELATIVE_RADIUS
    row = type(truth)(truth.high[0], truth.low[0], truth.radius[0])
    assert_overlap(row, eliminated(system, theta[0], omega[0], 1500))
    # the dense solve in doubles is off by about ε·cond, 2e-16 · 3e4; ten times that is a fault
    literal = literal_accelerations(system, theta, omega)
    assert np.max(truth.error(literal)) < 1e-10 * np.abs(truth.high).max()


def test_the_verified_path_is_taken_and_the_poor_inverse_is_not_trusted(monkeypatch):
    system = random_chain(20)
    theta, omega = random_state(system, 2)
    asked = []
    monkeypatch.setattr(verified.Balls, "solve", lambda self, a, b: asked.append(1))
    enclosed_accelerations(system, theta, omega)
    assert not asked
    monkeypatch.undo()

    good = verified._approximate_inverse
    monkeypatch.setattr(verified, "_approximate_inverse", lambda m: good(m) * 1.7)  # |I - R M| = 0.7
    truth = enclosed_accelerations(system, theta, omega)
    monkeypatch.undo()
    assert truth.relative_radius <= RELATIVE_RADIUS
    for i in range(2):
        row = type(truth)(truth.high[i], truth.low[i], truth.radius[i])
        assert_overlap(row, eliminated(system, theta[i], omega[i], 600))


def test_a_mediocre_inverse_costs_radius_but_never_truth(monkeypatch):
    system = random_chain(15)
    theta, omega = random_state(system, 2)
    good = verified._approximate_inverse
    monkeypatch.setattr(verified, "_approximate_inverse", lambda m: good(m) * (1 + 1e-5))
    with precision(128):
        xp = balls()
        found = motion.literal_system(xp, system, xp.array(theta), xp.array(omega))
        enclosed = verified.solve(found.matrix, found.right)
    for i in range(2):
        assert all(
            a.contains(b.mid()) for a, b in zip(enclosed[i], eliminated(system, theta[i], omega[i], 600), strict=True)
        )


@pytest.mark.parametrize("factor", [0.7, 0.9, 1.3])
def test_the_bound_is_one_even_where_it_is_sharp(monkeypatch, factor):
    # Diagonal matrices, and an inverse wrong by a known factor: the error left after three steps is (1 - factor)³ of
    # the solution, and for factors below 1 the theorem's bound is just that.
    good = verified._approximate_inverse
    monkeypatch.setattr(verified, "_approximate_inverse", lambda m: good(m) * factor)
    n = verified.SMALL + 1
    with precision(128):
        xp = balls()
        diagonal = np.linspace(1.0, 2.0, n)
        (enclosed,) = verified.solve(xp.array(np.diag(diagonal))[None], xp.array(np.ones((1, n))))
        for ball, d in zip(enclosed, diagonal, strict=True):
            assert ball.contains(1 / type(ball)(d))
            assert float(ball.rad()) <= 2.0 * abs(1 - factor) ** 3


@pytest.mark.parametrize("system", [STAR, CHAIN, random_chain(14)], ids=["star", "chain", "14 rods"])
def test_states_that_are_exact(system):
    n = system.n
    rest = enclosed_accelerations(system, np.zeros(n), np.zeros(n))
    assert rest.high.shape == (n,)
    assert not rest.high.any()
    assert not rest.radius.any()
    # In a straight line turning as one body, without gravity, the rod's ends only feel centripetal forces: θ̈ = 0.
    weightless = type(system)(system.lengths, *((system.masses,) if system.kind == "n-leg" else ()), gravity=0.0)
    spin = enclosed_accelerations(weightless, np.full((1, n), 0.7), np.full((1, n), 2.0))
    assert not spin.high.any()


@given(data=st.data())
@settings(max_examples=25, deadline=None)
def test_any_system_any_state(data):
    exponents = st.floats(-3, 3)
    n = data.draw(st.integers(2, 6))
    lengths = tuple(10**x for x in data.draw(st.lists(exponents, min_size=n, max_size=n)))
    star = data.draw(st.booleans())
    masses = tuple(10**x for x in data.draw(st.lists(exponents, min_size=n, max_size=n)))
    system = NLegPendulum(lengths, masses) if star else RodChain(lengths, masses[0])
    numbers = st.floats(-100, 100)
    theta = np.array(data.draw(st.lists(numbers, min_size=n, max_size=n)))
    omega = np.array(data.draw(st.lists(numbers, min_size=n, max_size=n)))
    truth = enclosed_accelerations(system, theta, omega)
    # below 1e-290 a pair of doubles has no 80 bits left
    assert truth.relative_radius <= RELATIVE_RADIUS or np.abs(truth.high).max() < 1e-290
    assert_overlap(truth, eliminated(system, theta, omega, 800))


def test_batches_keep_their_shape():
    theta, omega = random_state(STAR, 6)
    flat = enclosed_accelerations(STAR, theta, omega)
    shaped = enclosed_accelerations(STAR, theta.reshape(2, 3, 3), omega.reshape(2, 3, 3))
    np.testing.assert_array_equal(shaped.high, flat.high.reshape(2, 3, 3))
    assert enclosed_accelerations(STAR, np.empty((0, 3)), np.empty((0, 3))).high.shape == (0, 3)
    assert enclosed_joint_forces(STAR, theta, omega).high.shape == (6, 3, 2)


def test_energy_and_forces_of_the_truth_round_to_those_in_doubles():
    for system in (STAR, CHAIN):
        theta, omega = random_state(system, 5)
        kinetic, potential = energies(system, theta, omega)
        truth = enclosed_energies(system, theta, omega)
        both = np.stack([kinetic, potential], axis=-1)
        # some twenty operations on terms no larger than their sum: 1e-13 leaves room
        assert np.max(truth.error(both) / np.abs(both).max(-1, keepdims=True)) < 1e-13
        accelerations = enclosed_accelerations(system, theta, omega)
        forces = joint_forces(system, theta, omega, accelerations.high)
        enclosed_forces = enclosed_joint_forces(system, theta, omega)
        assert np.max(enclosed_forces.error(forces)) < 1e-13 * np.abs(forces).max()
        assert enclosed_forces.relative_radius < 2.0**-75


def test_terms():
    for system in (STAR, CHAIN):
        theta, _ = random_state(system, 4)
        terms = enclosed_terms(system, theta)
        # one cosine of a rounded difference of angles up to 2π: 4 ulp of π in the angle, a few roundings besides
        np.testing.assert_allclose(mass_matrix(system, theta), terms.mass, rtol=0, atol=1e-14)
        np.testing.assert_allclose(motion.centrifugal_matrix(system, theta), terms.centrifugal, rtol=0, atol=1e-14)
        np.testing.assert_allclose(motion.gravity_vector(system, theta), terms.gravity, rtol=0, atol=1e-13)
