"""Enclosed accelerations in O(n) against those of the literal equations, and by their own bound."""

import numpy as np
import pytest

from furiko.models import NLegPendulum, RodChain
from furiko.reference.truth import enclosures, newton_euler
from furiko.reference.truth.enclosures import precision
from furiko.reference.truth.newton_euler import close_accelerations, enclosed_accelerations

random = np.random.default_rng(20181112)


def state(n):
    return random.uniform(-3, 3, n), random.uniform(-5, 5, n)


@pytest.mark.parametrize(
    "system",
    [
        RodChain((0.7,)),
        RodChain((1.0, 0.3), density=3.0),
        RodChain(tuple(random.uniform(0.1, 2, 25)), gravity=0.0),
        RodChain((1.0, 1e-6, 1e6, 1.0)),
        NLegPendulum((1.0, 0.5), (1.0, 2.0)),
        NLegPendulum(tuple(random.uniform(0.1, 2, 25)), tuple(random.uniform(1e-6, 1e6, 25))),
    ],
    ids=["one-rod", "two-rods", "25-rods-no-gravity", "length-ratio", "two-masses", "24-legs"],
)
def test_both_enclosures_hold_the_same_value(system):
    theta, omega = (np.array(rows) for rows in zip(*(state(system.n) for _ in range(3)), strict=True))
    ours, literal = (
        enclosed_accelerations(system, theta, omega),
        enclosures.enclosed_accelerations(system, theta, omega),
    )
    apart = np.abs((ours.high - literal.high) + (ours.low - literal.low))
    # Both balls hold the true value: they overlap. Double roundings of the difference itself are 2⁻⁵² of the low parts.
    assert (apart <= ours.radius + literal.radius + 2.0**-52 * np.abs(literal.low)).all()
    assert ours.relative_radius <= 2.0**-80


@pytest.mark.parametrize(
    "system",
    [
        RodChain(tuple(random.uniform(0.1, 2, 25))),
        NLegPendulum(tuple(random.uniform(0.1, 2, 25)), tuple(random.uniform(1e-3, 1e3, 25))),
    ],
    ids=["25-rods", "24-legs"],
)
def test_joint_forces_of_both_are_the_same(system):
    theta, omega = (np.array(rows) for rows in zip(*(state(system.n) for _ in range(3)), strict=True))
    ours, literal = (proofs.enclosed_joint_forces(system, theta, omega) for proofs in (newton_euler, enclosures))
    apart = np.abs((ours.high - literal.high) + (ours.low - literal.low))
    assert (apart <= ours.radius + literal.radius + 2.0**-52 * np.abs(literal.low)).all()  # as above
    assert (ours.radius.max((-2, -1)) <= 2.0**-80 * np.abs(ours.high).max((-2, -1))).all()


def test_the_proof_notices_a_wrong_acceleration():
    from flint import arb

    system = RodChain((1.0, 0.5, 0.8))
    theta, omega = (values.tolist() for values in state(3))
    with precision(200):
        right = newton_euler._rods(system, theta, omega)
        wrong = [right[0] + arb(1e-20), *right[1:]]
        balls = newton_euler._with_radii(system, theta, omega, wrong)
        assert all(ball.contains(a) for ball, a in zip(balls, right, strict=True))
        assert min(float(ball.rad()) for ball in balls) > 1e-21  # with the right ones it is 1e-58


def test_a_thousand_rods_in_one_line_are_proved():
    truth = enclosed_accelerations(
        RodChain((1.0,) * 1000), np.full(1000, 0.7) + 1e-12 * np.arange(1000), np.zeros(1000)
    )
    assert truth.relative_radius <= 2.0**-80


def test_one_state_and_many_give_the_same():
    system = RodChain((1.0, 0.5))
    theta, omega = state(2)
    single, many = (
        enclosed_accelerations(system, theta, omega),
        enclosed_accelerations(system, [theta] * 2, [omega] * 2),
    )
    assert single.high.shape == (2,)
    assert (many.high == single.high).all()
    assert [float(a) for a in close_accelerations(system, theta, omega)] == single.high.tolist()
