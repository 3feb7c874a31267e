"""The planar tree's equations: both documents' are special cases, and what is general in them has its own witnesses."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.models import Link, NLegPendulum, PlanarTree, RodChain
from furiko.models.coordinates import forces_to_relative
from furiko.models.mechanism import Hinge, Mechanism, mechanism_of
from furiko.reference import planar_tree as planar
from furiko.reference.arithmetic import balls
from furiko.reference.truth.enclosures import accelerations_in_balls, precision

DOCUMENTS = [
    NLegPendulum((1.0, 0.8, 0.6, 0.5), (1.0, 0.5, 0.3, 2.0)),
    NLegPendulum((1.0, 1.0), (1.0, 1.0), gravity=0.0),
    RodChain((1.0,)),
    RodChain((1.0, 0.7, 0.3, 0.4, 1.1), density=0.7),
    RodChain((0.5,) * 9),
]


@pytest.mark.parametrize("system", DOCUMENTS, ids=lambda system: f"{system.kind} {system.n}")
def test_the_documents_are_special_cases_in_ball_arithmetic(system):
    """Both enclose the true accelerations, so their balls must overlap: 200 bits leave no room for a mistake."""
    rng = np.random.default_rng(system.n)
    theta, omega = rng.uniform(-3, 3, (2, 4, system.n))
    mechanism = exact_mechanism(system)
    with precision(200):
        xp = balls()
        p = exact_parameters(system, mechanism, xp)
        ours = planar.forward_dynamics(mechanism.parents, p, xp.array(theta), xp.array(omega))
        theirs = accelerations_in_balls(system, xp.array(theta), xp.array(omega))
        assert all(a.overlaps(b) for a, b in zip(ours.flat, theirs.flat, strict=True))
        assert max(float(a.rad()) for a in ours.flat) < 1e-40


def exact_mechanism(system):
    return mechanism_of(system.tree())


def exact_parameters(system, mechanism, xp):
    """The mechanism's numbers; a rod's mass is ρ l and its inertia m l²/12 unrounded, as the document has them."""
    p = planar.parameters(mechanism, xp)
    if not isinstance(system, RodChain):
        return p
    from dataclasses import replace

    l, rho = xp.array(system.lengths), xp.array(system.density)
    mass = rho * l
    return replace(p, mass=mass, inertia=mass * l * l / 12, com_along=l / 2)


def random_mechanism(seed, n):
    rng = np.random.default_rng(seed)
    links, hinges = [], []
    for i in range(n):
        parent = int(rng.integers(-1, i)) if i else -1
        links.append(
            Link(parent, tuple(rng.normal(size=2)), 1.0, tuple(rng.normal(size=2)), *rng.uniform(0.1, 2, 2).tolist())
        )
        hinges.append(Hinge("", *rng.uniform(0, 1, 4).tolist(), rest=rng.normal()))
    return Mechanism(tuple(links), tuple(hinges), tuple(rng.normal(size=2) * 5), tuple("x" * n))


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10**6), st.integers(1, 12))
def test_forward_dynamics_is_the_inverse_of_inverse_dynamics(seed, n):
    """Two recursions that share no step: tips to support with elimination, support to tips without."""
    m = random_mechanism(seed, n)
    p = planar.parameters(m)
    theta, omega = np.random.default_rng(seed).normal(size=(2, 6, n)) * 3
    alpha = planar.forward_dynamics(m.parents, p, theta, omega)
    left = forces_to_relative(m.parents, planar.inverse_dynamics(m.parents, p, theta, omega, alpha))
    size = planar.magnitudes(m.parents, p, theta, omega, alpha)
    # 26 roundings a link, as furiko.reference.rounding.bounds counts them.
    assert np.all(np.abs(left) <= 26 * n * 2.0**-52 * size)


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10**6), st.integers(1, 8))
def test_power_is_the_rate_of_energy(seed, n):
    """With every hinge's own torque away, τ·ω is the rate of the energy, by a difference in time."""
    from dataclasses import replace

    m = random_mechanism(seed, n)
    m = replace(m, hinges=tuple(Hinge() for _ in range(n)))
    p = planar.parameters(m)
    theta, omega, alpha = np.random.default_rng(seed).normal(size=(3, 1, n))

    def energy(t):
        angles, rates = theta + omega * t + alpha * t * t / 2, omega + alpha * t
        return kinetic_and_potential(m, angles[0], rates[0])

    h = 1e-4
    rate = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h)  # error h⁴
    power = float((planar.inverse_dynamics(m.parents, p, theta, omega, alpha) * omega).sum())
    scale = float(np.abs(planar.magnitudes(m.parents, p, theta, omega, alpha)).max() * (1 + np.abs(omega).max()))
    assert rate == pytest.approx(power, abs=1e-9 * scale * n)


def kinetic_and_potential(m, theta, omega):
    """Straight from the positions of the centres, in complex numbers."""
    hinge, speed, total = {}, {}, 0.0
    for i, link in enumerate(m.links):
        at, v = (0j, 0j) if link.parent < 0 else (hinge[link.parent], speed[link.parent])
        if link.parent >= 0:
            arm = complex(*link.hinge) * np.exp(1j * theta[link.parent])
            at, v = at + arm, v + 1j * omega[link.parent] * arm
        else:
            at = complex(*link.hinge)
        hinge[i], speed[i] = at, v
        arm = complex(*link.com) * np.exp(1j * theta[i])
        centre, velocity = at + arm, v + 1j * omega[i] * arm
        total += link.mass * abs(velocity) ** 2 / 2 + link.inertia * omega[i] ** 2 / 2
        total -= link.mass * (complex(*m.gravity).conjugate() * centre).real
    return total


def test_inverse_dynamics_is_the_mass_matrix_times_the_accelerations_and_the_bias():
    m = random_mechanism(3, 6)
    p = planar.parameters(m)
    theta, omega, alpha = np.random.default_rng(5).normal(size=(3, 4, 6))
    mass = planar.mass_matrix(m.parents, p, theta)
    np.testing.assert_allclose(mass, mass.swapaxes(1, 2), atol=1e-13)
    bias = planar.inverse_dynamics(m.parents, p, theta, omega, alpha * 0)
    together = (mass @ alpha[..., None])[..., 0] + bias
    np.testing.assert_allclose(planar.inverse_dynamics(m.parents, p, theta, omega, alpha), together, atol=1e-12)


def test_a_hinges_torque_acts_on_its_link_and_against_the_parent():
    m = random_mechanism(3, 6)
    p = planar.parameters(m)
    theta, omega, alpha = np.random.default_rng(5).normal(size=(3, 4, 6))
    ideal = planar.parameters(m.ideal())
    own = np.zeros_like(theta)
    for i, parent in enumerate(m.parents):
        torque = planar.hinge_torque(p, i, parent, theta, omega, alpha)
        own[:, i] += torque
        if parent >= 0:
            own[:, parent] -= torque
    found, free = (planar.inverse_dynamics(m.parents, q, theta, omega, alpha) for q in (p, ideal))
    np.testing.assert_allclose(found, free + own, atol=1e-12)


def test_stretched_inertias_are_the_mass_matrix_of_the_straight_mechanism():
    tree = PlanarTree((Link(-1, (0, 0), 1, (0.5, 0), 1.0, 0.1), Link(0, (1, 0), 1, (0.7, 0), 2.0, 0.2)), 9.81)
    p = planar.parameters(mechanism_of(tree))
    s = np.array([[1.0, 0.0], [1.0, 1.0]])
    relative = s.T @ planar.mass_matrix(tree.parents, p, np.zeros((1, 2)))[0] @ s
    np.testing.assert_allclose(planar.stretched_inertias(tree.parents, p), np.diag(relative), rtol=1e-14)
