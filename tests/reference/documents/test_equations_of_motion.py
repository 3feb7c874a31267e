"""Terms, energies and joint forces of whole mechanisms, against physics done another way.

The other way: the planar tree that model files are written from (hinges, centres, masses, inertias), each link's motion
built up from its parent's, Newton's law for each link alone.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.models import NLegPendulum, RodChain
from furiko.models.tree import SUPPORT
from furiko.reference import (
    centre_accelerations,
    centrifugal_matrix,
    energies,
    gravity_vector,
    joint_forces,
    literal_accelerations,
    mass_matrix,
)

lengths = st.lists(st.floats(0.3, 3.0), min_size=2, max_size=5)


@st.composite
def systems(draw):
    l = tuple(draw(lengths))
    if draw(st.booleans()):
        return RodChain(l, draw(st.floats(0.3, 3.0)))
    return NLegPendulum(l, tuple(draw(st.lists(st.floats(0.3, 3.0), min_size=len(l), max_size=len(l)))))


def frames(theta):
    """Directions along and across each link, (B, n, 2)."""
    return np.stack([np.sin(theta), -np.cos(theta)], -1), np.stack([np.cos(theta), np.sin(theta)], -1)


def tree_motion(system, theta, omega, alpha):
    """Velocity and acceleration of each link's hinge and centre, from parent to child."""
    along, across = frames(theta)
    hinge_velocity, hinge_acceleration, velocity, acceleration, height = [], [], [], [], []
    hinge_height = []
    for i, link in enumerate(system.tree().links):
        if link.parent == SUPPORT:
            v = a = np.zeros((len(theta), 2))
            h = np.zeros(len(theta))
        else:
            k = link.parent
            reach = link.hinge[0]
            v = hinge_velocity[k] + reach * omega[:, k, None] * across[:, k]
            a = hinge_acceleration[k] + reach * (
                alpha[:, k, None] * across[:, k] - omega[:, k, None] ** 2 * along[:, k]
            )
            h = hinge_height[k] + reach * along[:, k, 1]
        hinge_velocity.append(v)
        hinge_acceleration.append(a)
        hinge_height.append(h)
        c = link.com[0]
        velocity.append(v + c * omega[:, i, None] * across[:, i])
        acceleration.append(a + c * (alpha[:, i, None] * across[:, i] - omega[:, i, None] ** 2 * along[:, i]))
        height.append(h + c * along[:, i, 1])
    return np.stack(velocity, 1), np.stack(acceleration, 1), np.stack(height, 1)


def some_motion(system, seed, count=3):
    generator = np.random.default_rng(seed)
    theta = generator.uniform(-np.pi, np.pi, (count, system.n))
    omega = 3 * generator.normal(size=(count, system.n))
    return theta, omega, literal_accelerations(system, theta, omega)


@given(system=systems(), seed=st.integers(0, 1000))
@settings(max_examples=40, deadline=None)
def test_each_link_obeys_newton_and_euler(system, seed):
    theta, omega, alpha = some_motion(system, seed)
    forces = joint_forces(system, theta, omega, alpha)
    _, acceleration, _ = tree_motion(system, theta, omega, alpha)
    along, _ = frames(theta)
    links, children = system.tree().links, system.tree().children()
    # errors: ε times forces times a condition number of some tens
    close = 1e-11 * max(1.0, np.abs(forces).max())
    np.testing.assert_allclose(centre_accelerations(system, theta, omega, alpha), acceleration, rtol=0, atol=close)
    for i, link in enumerate(links):
        weight = np.array([0.0, -link.mass * system.gravity])
        total = weight - forces[:, i] + sum((forces[:, k] for k in children[i]), np.zeros_like(forces[:, i]))
        np.testing.assert_allclose(link.mass * acceleration[:, i], total, rtol=0, atol=close)
        moment = cross(-link.com[0] * along[:, i], -forces[:, i])
        for k in children[i]:
            moment += cross((links[k].hinge[0] - link.com[0]) * along[:, i], forces[:, k])
        np.testing.assert_allclose(link.inertia * alpha[:, i], moment, rtol=0, atol=close * max(system.lengths))


def cross(u, v):
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]


@given(system=systems(), seed=st.integers(0, 1000))
@settings(max_examples=40, deadline=None)
def test_energy_is_that_of_the_links_and_does_not_change(system, seed):
    theta, omega, alpha = some_motion(system, seed)
    kinetic, potential = energies(system, theta, omega)
    velocity, _, height = tree_motion(system, theta, omega, alpha)
    mass = np.array([link.mass for link in system.tree().links])
    inertia = np.array([link.inertia for link in system.tree().links])
    expected = (mass * (velocity**2).sum(-1)).sum(-1) / 2 + (inertia * omega**2).sum(-1) / 2
    np.testing.assert_allclose(kinetic, expected, rtol=1e-13)  # sums of positive terms
    np.testing.assert_allclose(potential, (mass * system.gravity * height).sum(-1), rtol=0, atol=1e-13 * 9.81 * 45)
    # along the motion, by central differences: off by (ωh)² and θ̈h/ω squared, 1e-6 of E's own turnover at the most
    h = 1e-6
    ahead, behind = (sum(energies(system, theta + t * omega + t**2 * alpha / 2, omega + t * alpha)) for t in (h, -h))
    turnover = (kinetic + np.abs(potential)) * (np.abs(omega).max(-1) + np.abs(alpha).max(-1))
    assert np.all(np.abs(ahead - behind) / (2 * h) < 1e-6 * (1 + turnover))


@given(system=systems(), seed=st.integers(0, 1000))
@settings(max_examples=25, deadline=None)
def test_terms_are_derivatives_of_the_energies(system, seed):
    theta, omega, _ = some_motion(system, seed, count=1)
    n = system.n
    M, C, G = (term(system, theta)[0] for term in (mass_matrix, centrifugal_matrix, gravity_vector))
    np.testing.assert_allclose(M, M.T, rtol=0, atol=1e-14 * np.abs(M).max())
    unit = np.eye(n)
    # T is quadratic: its second differences are exact but for rounding
    quadratic = np.array(
        [
            [
                kinetic_of(system, theta, unit[j] + unit[k])
                - kinetic_of(system, theta, unit[j])
                - kinetic_of(system, theta, unit[k])
                for k in range(n)
            ]
            for j in range(n)
        ]
    )
    np.testing.assert_allclose(M, quadratic, rtol=0, atol=1e-12 * np.abs(M).max())
    # central differences, step 1e-5: truncation 1e-10, rounding 1e-11
    h = 1e-5
    slope = np.array(
        [
            (energies(system, theta + h * u, omega)[1] - energies(system, theta - h * u, omega)[1])[0] / (2 * h)
            for u in unit
        ]
    )
    np.testing.assert_allclose(G, slope, rtol=0, atol=1e-7)
    # C_jk ω_k² from Lagrange: Σ_k ∂M_jk/∂θ_k ω_k² - ½ ∂/∂θ_j ΣM ω ω leaves ∂M_jk/∂θ_k for k ≠ j
    for k in range(n):
        by_k = (mass_matrix(system, theta + h * unit[k]) - mass_matrix(system, theta - h * unit[k]))[0] / (2 * h)
        np.testing.assert_allclose(np.delete(C[:, k], k), np.delete(by_k[:, k], k), rtol=0, atol=1e-7)
    assert not np.diag(C).any()


def kinetic_of(system, theta, rates):
    return energies(system, theta, rates[None, :])[0][0]


def test_the_documents_rows_are_lagranges_divided():
    star, chain = NLegPendulum((1.0, 0.8, 0.6), (1.0, 0.5, 2.0)), RodChain((1.0, 0.8), 1.3)
    theta = np.array([0.3, -1.0, 2.0])
    # Shiki (3.12): A₁₁ = (Σm) l₁, A₂₁ = m₂ l₁ cos(θ₁ - θ₂); times l_i
    M = mass_matrix(star, theta)
    assert M[0, 0] == pytest.approx(3.5 * 1.0 * 1.0, rel=1e-15)
    assert M[1, 0] == pytest.approx(0.8 * 0.5 * 1.0 * np.cos(1.3), rel=1e-15)
    assert M[1, 2] == 0
    # Takeno (18): ρ l₁ (L₁ - l₁/6) l₁, with L₁ = 1/2 + 0.8
    assert mass_matrix(chain, theta[:2])[0, 0] == pytest.approx(1.3 * (1.3 - 1 / 6), rel=1e-15)


def test_one_rod_turning_pulls_with_its_centripetal_force():
    rod = RodChain((2.0,), 3.0, gravity=0.0)
    force = joint_forces(rod, np.array([0.0]), np.array([5.0]), np.array([0.0]))
    np.testing.assert_allclose(force, [[0.0, -6.0 * 1.0 * 25.0]])  # m (l/2) ω², downwards on the support


def test_hanging_star_weighs_on_its_hinges():
    star = NLegPendulum((1.0, 0.8, 0.6), (1.0, 0.5, 2.0), gravity=10.0)
    still = np.zeros(3)
    np.testing.assert_allclose(joint_forces(star, still, still, still), [[0, -35], [0, -5], [0, -20]])
