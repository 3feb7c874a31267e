"""Proved trajectories against the elliptic pendulum, another series, energy, each other, and faults put in."""

import math

import mpmath
import numpy as np
import pytest
from flint import arb, ctx
from leaning_tree import general
from planted_source import plant
from scipy.integrate import solve_ivp

import furiko
from furiko.models import InvalidInput, NLegPendulum, RodChain
from furiko.models.mechanism import Hinge, Mechanism
from furiko.models.tree import PlanarTree
from furiko.reference import energies, planar_tree
from furiko.reference.arithmetic import balls
from furiko.reference.proved import clouds, follow, series, steps, tube
from furiko.reference.proved import enclose as module
from furiko.reference.truth.closed_forms import _motion, rod_pendulum
from furiko.reference.truth.enclosures import precision

DOUBLE = NLegPendulum((1.0, 1.0), (1.0, 1.0))
START, REST = (2.0, 2.5), (0.0, 0.0)
ROD = RodChain((0.7,), 2.0)


def elliptic(theta, omega, times):
    """The one rod's exact motion, as balls of some 60 digits: (times, 2)."""
    with precision(300):
        return [[arb(x) for x in row] for row in _motion(rod_pendulum(ROD)._squared_rate(), theta, omega, times)]


def holds_the_elliptic_motion(theta, omega, times, digits=12):
    found = furiko.enclose(ROD, [theta], [omega], times, digits)
    exact = elliptic(theta, omega, [t - times[0] for t in times])
    with precision(300):
        return found.complete and all(
            ball.contains(value)
            for row, values in zip(zip(found.theta[1:, 0], found.omega[1:, 0], strict=True), exact[1:], strict=True)
            for ball, value in zip(row, values, strict=True)
        )


@pytest.mark.parametrize("state", [(0.5, 0.0), (3.0, 1.0), (1.0, 20.0), (-40.0, -3.0), (0.0, 0.0)])
@pytest.mark.parametrize("end", [0.8, -0.5])
def test_one_link_is_the_elliptic_pendulum(state, end):
    assert holds_the_elliptic_motion(*state, [0.0, end / 3, end])


def test_without_the_remainder_the_motion_is_lost(monkeypatch):
    found = tube.radius

    def nothing(*arguments):
        return None if found(*arguments) is None else (arb(0), arb(0))

    monkeypatch.setattr(steps.tube, "radius", nothing)
    assert not holds_the_elliptic_motion(3.0, 1.0, [0.0, 0.8])


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("product(sin[i], vs[i]) * -(k + 1)", "product(sin[i], vs[i]) * (k + 1)"),
        ("e_x[i] - alpha[i] * first_sin[i]", "e_x[i] + alpha[i] * first_sin[i]"),
        ("us[i]) - product(sin[i][1:], ws[i])", "us[i]) + product(sin[i][1:], ws[i])"),
        ("[-a for a in solve(rows)]", "[a for a in solve(rows)]"),
    ],
)
def test_a_wrong_sign_in_the_recurrence_is_noticed(monkeypatch, old, new):
    plant(monkeypatch, series, "motion_series", old, new)
    monkeypatch.setattr(clouds, "motion_series", series.motion_series)
    try:
        held = holds_the_elliptic_motion(1.0, 2.0, [0.0, 0.4])
    except (InvalidInput, ArithmeticError):
        held = False
    assert not held


def textbook(theta1, theta2, omega1, omega2):
    """A double pendulum's accelerations as textbooks print them, masses and lengths 1, in mpmath's numbers."""
    g, d = mpmath.mpf(9.81), theta1 - theta2
    den = 3 - mpmath.cos(2 * d)
    a = -3 * g * mpmath.sin(theta1) - g * mpmath.sin(theta1 - 2 * theta2)
    a -= 2 * mpmath.sin(d) * (omega2**2 + omega1**2 * mpmath.cos(d))
    b = 2 * mpmath.sin(d) * (2 * omega1**2 + 2 * g * mpmath.cos(theta1) + omega2**2 * mpmath.cos(d))
    return a / den, b / den


def test_a_double_pendulum_is_that_of_mpmaths_series():
    found = furiko.enclose(DOUBLE, START, REST, [0.0, 0.125], digits=18)
    with mpmath.workdps(22):
        motion = mpmath.odefun(lambda _t, y: [y[2], y[3], *textbook(*y)], 0, [*map(mpmath.mpf, START + REST)])
        values = [mpmath.nstr(x, 21) for x in motion(mpmath.mpf("0.125"))]
    with precision(200):
        # mpmath's own error is a few units of its 22 digits; the enclosure's radius is proved, 1e-18 and less
        for ball, value in zip([*found.theta[1], *found.omega[1]], values, strict=True):
            assert (ball + arb(0, "1e-19")).contains(arb(value))
            assert ball.rad() < arb(10) ** -18


@pytest.mark.parametrize("system", [DOUBLE, RodChain((1.0, 0.7), 1.3), NLegPendulum((1.0, 0.8, 0.6), (1.0, 0.5, 2.0))])
def test_more_digits_are_inside_fewer_and_energy_stays(system):
    theta, omega = (2.0, 2.5, 1.0)[: system.n], (0.1, -1.0, 2.0)[: system.n]
    coarse, fine = (furiko.enclose(system, theta, omega, [0.0, 0.2, 0.4], digits) for digits in (8, 25))
    with precision(300):
        for part in ("theta", "omega"):
            wide, narrow = getattr(coarse, part), getattr(fine, part)
            assert all(a.contains(b) for a, b in zip(wide.flat, narrow.flat, strict=True))
        assert fine.radius.max() <= 1e-25 < coarse.radius.max() <= 1e-8
        kinetic, potential = energies(system, fine.theta, fine.omega)
        total = kinetic + potential
        assert all(later.overlaps(total[0]) for later in total[1:])
        # narrow enough to say something: the radius times forces and momenta, tens
        assert all(float(later.rad()) < 1e-22 for later in total[1:])


def test_a_start_as_wide_as_asked_holds_the_motions_of_all_its_states():
    radius = 1e-5
    found = furiko.enclose(DOUBLE, START, (0.5, -0.25), [0.0, 0.25, 0.5], radius=radius)
    assert found.complete
    random = np.random.default_rng(17)
    for corner in random.choice([-1.0, 1.0, 0.5], (6, 4)) * radius * (1 - 1e-9):
        theta, omega = np.array(START) + corner[:2], np.array((0.5, -0.25)) + corner[2:]
        one = furiko.enclose(DOUBLE, theta, omega, [0.0, 0.25, 0.5])
        assert (found.theta_low <= one.theta_low).all()
        assert (one.theta_high <= found.theta_high).all()
        assert (found.omega_low <= one.omega_low).all()
        assert (one.omega_high <= found.omega_high).all()
    # the cloud grows as the motion's differences do: a corner's distance, several times, not thousands
    assert found.radius[-1] < 100 * radius


@pytest.mark.slow
def test_directions_and_balls_alone_prove_the_same(monkeypatch):
    alone = furiko.enclose(DOUBLE, START, REST, [0.0, 1.0])
    assert alone.bits > 100
    monkeypatch.setattr(module, "LOST", 0)
    along = furiko.enclose(DOUBLE, START, REST, [0.0, 1.0])
    with precision(200):
        assert all(a.overlaps(b) for a, b in zip(alone.theta.flat, along.theta.flat, strict=True))
    assert along.bits == math.ceil(15 * math.log2(10)) + 64


def test_a_tree_with_dampers_and_springs_is_that_of_the_articulated_body_algorithm():
    mechanism = general()
    numbers = planar_tree.parameters(mechanism)
    theta, omega = np.array([1.0, -0.5, 2.0]), np.array([0.5, 1.0, -2.0])

    def rates(_t, y):
        return np.concatenate([y[3:], planar_tree.forward_dynamics(mechanism.parents, numbers, y[:3], y[3:])])

    other = solve_ivp(rates, (0.0, 0.5), [*theta, *omega], "DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    found = furiko.enclose(mechanism, theta, omega, [0.0, 0.5])
    # DOP853's error at this tolerance, some 1e-11
    np.testing.assert_allclose([*found.theta_low[1], *found.omega_low[1]], other, rtol=0, atol=1e-9)
    assert found.radius[1] <= 1e-15


def test_there_and_back():
    there = furiko.enclose(DOUBLE, START, REST, [1.0, 1.5], digits=20)
    back = furiko.enclose(DOUBLE, there.theta_low[1], there.omega_low[1], [1.5, 1.0])
    # the turning point is rounded to doubles, 2e-16 at most, and magnified by e^(4 · 0.5) or so
    np.testing.assert_allclose(back.theta_low[1], START, rtol=0, atol=1e-14)


def test_what_is_out_of_reach_is_proved_as_far_as_it_goes(monkeypatch):
    monkeypatch.setattr(module, "MOST_BITS", 96)
    times = np.linspace(0.0, 3.0, 31)
    found = furiko.enclose(DOUBLE, START, REST, times)
    assert not found.complete
    assert "96 bits" in found.why
    assert 0 < found.proved_until < 3.0
    assert len(found.times) == len(found.theta) == len(found.theta_low) == (times <= found.proved_until).sum()
    assert (found.radius <= 1e-15).all()
    whole = furiko.simulate(DOUBLE, START, REST, times[: len(found.times)])
    np.testing.assert_allclose(found.theta_low, whole.theta, rtol=0, atol=1e-12)


def test_a_time_limit_and_an_interrupt_end_a_run():
    found = furiko.enclose(DOUBLE, START, REST, [0.0, 50.0], seconds=0.2)
    assert not found.complete
    assert found.why == "the time limit"
    assert len(found.times) == 1

    def interrupt(_time, _wide):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        furiko.enclose(DOUBLE, START, REST, [0.0, 1.0], watch=interrupt)
    assert ctx.prec == 53  # flint's precision is as it was


def test_doubles_are_rounded_outwards():
    with precision(100):
        third = np.array([arb(1) / 3, arb(-1) / 3, arb(2), arb(0)], dtype=object)
        low, high = module.outward(third)
        assert all(arb(a) < x < arb(b) for a, x, b in zip(low[:2], third[:2], high[:2], strict=True))
    assert math.nextafter(low[0], 1) == high[0]
    assert low[2:].tolist() == high[2:].tolist() == [2.0, 0.0]


@pytest.mark.parametrize(
    ("changed", "word"),
    [
        ({"digits": 0}, "digits"),
        ({"digits": True}, "digits"),
        ({"digits": 1.5}, "digits"),
        ({"radius": -1.0}, "radius"),
        ({"radius": (1.0,)}, "radius"),
        ({"radius": math.nan}, "radius"),
        ({"seconds": 0}, "seconds"),
        ({"times": [0.0, 1.0, 0.5]}, "times"),
        ({"theta": [[2.0, 2.5]], "omega": [[0.0, 0.0]]}, "theta"),
        ({"theta": [math.nan, 1.0]}, "theta"),
    ],
)
def test_bad_input_is_refused(changed, word):
    arguments = {"theta": START, "omega": REST, "times": [0.0, 0.1]} | changed
    with pytest.raises(InvalidInput, match=f"^{word}"):
        furiko.enclose(DOUBLE, **arguments)


def test_friction_is_refused():
    with pytest.raises(InvalidInput, match="friction"):
        furiko.enclose(
            Mechanism(PlanarTree(general().links[:1], 9.81).links, (Hinge(friction=0.1),), (9.81, 0.0), ("a",)),
            [1.0],
            [0.0],
            [0.0, 1.0],
        )


def test_times_repeat_and_stand_still():
    found = furiko.enclose(DOUBLE, START, REST, [1.0, 1.0])
    assert found.complete
    assert found.radius.tolist() == [0.0, 0.0]
    assert found.contains([START, START], [REST, REST]).all()
    assert follow.order_for(100) == 40
    assert balls().name == "balls"
