"""Trajectories against closed forms, against the literal equations in quadruple precision, and conservation laws."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from furiko.models import InvalidInput, NLegPendulum, RodChain
from furiko.reference.integration.taylor import simulate
from furiko.reference.kernels.energy import energy
from furiko.reference.truth import closed_forms as exact
from furiko.reference.truth.quadruple import quadruple_trajectory

ROD = RodChain((0.7,), density=3.0)
RODS = RodChain((1.0, 0.4, 1.3), density=0.5)
LEGS = NLegPendulum((1.0, 0.8, 0.5, 0.3), (1.0, 0.5, 2.0, 0.1))
EPS = np.finfo(float).eps


@pytest.mark.slow
@pytest.mark.parametrize(
    ("theta", "omega", "growth"),
    [(0.3, 0, 1), (3.1, 0, 50), (-1, 4, 1), (0.5, 25, 1), (0.5, -25, 1), (1e-6, 0, 1), (100, 0.2, 1)],
)
def test_one_rod_is_the_elliptic_pendulum(theta, omega, growth):
    """Swinging, nearly upright, turning over, tiny: the closed form in ball arithmetic."""
    times = np.linspace(0, 20, 31)
    found = simulate(ROD, [theta], [omega], times)
    true_theta, true_omega = exact.rod_pendulum(ROD).motion(theta, omega, times)
    # Some hundred steps, each rounding what it adds to ε/2; near the top errors grow by exp(√(1.5 g/l) t) meanwhile.
    allowed = growth * 2e-13
    assert np.abs(found.theta[:, 0] - true_theta).max() <= allowed * np.ptp(true_theta) + EPS * abs(theta)
    assert np.abs(found.omega[:, 0] - true_omega).max() <= allowed * np.abs(true_omega).max()


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [1e-14, 1e-10, 1e-6, 1e-3])
@pytest.mark.parametrize("system", [RODS, LEGS], ids=lambda s: s.kind)
def test_matches_the_literal_equations_in_quadruple_precision(system, tolerance):
    theta, omega = np.linspace(0.4, 1.6, system.n), np.linspace(-1, 1, system.n)
    times = np.linspace(0, 3, 7)
    true = quadruple_trajectory(system, theta, omega, times)
    assert true.error.max() < 1e-25
    found = simulate(system, theta, omega, times, tolerance)
    apart = np.abs(found.theta - true.theta).max(axis=-1)
    assert apart.max() <= max(tolerance, 2e-12)  # 2e-12: rounding times this motion's growth, about 1e3, and a margin
    assert (apart <= 10 * found.error + EPS).all()  # the estimate holds within its order of magnitude
    assert (found.warning == "") == (found.error.max() <= tolerance)


def test_double_pendulum_keeps_eight_digits_for_ten_seconds():
    """Its errors grow by 1e6 to 1e7 in that time: with rounding of 1e-16, 1e-9 is what doubles can give."""
    system = RodChain((1.0, 1.0))
    true = quadruple_trajectory(system, [2.0, 2.5], [0.0, 0.0], [0.0, 10.0])
    found = simulate(system, [2.0, 2.5], [0.0, 0.0], [0.0, 10.0])
    assert np.abs(found.theta[-1] - true.theta[-1]).max() <= 1e-8
    assert 1e-10 < found.error[-1] < 1e-7
    assert "not reached" in found.warning


@pytest.mark.slow
def test_five_rods_keep_eleven_digits_for_five_seconds():
    system, theta = RodChain((1.0,) * 5), np.linspace(1, 2, 5)
    true = quadruple_trajectory(system, theta, np.zeros(5), [0.0, 5.0])
    found = simulate(system, theta, np.zeros(5), [0.0, 5.0])
    assert np.abs(found.theta[-1] - true.theta[-1]).max() <= 1e-11


@pytest.mark.slow
@pytest.mark.parametrize("system", [RodChain((0.1,) * 40), NLegPendulum((1.0,) + (0.5,) * 39, (1.0,) * 40)])
def test_many_links_conserve_energy(system):
    """More links than a vector holds, and a number that is no multiple of one."""
    times = np.linspace(0, 4, 9)
    found = simulate(system, np.linspace(0.5, 2, 40), np.zeros(40), times)
    energies = energy(system, found.theta, found.omega)
    scale = system.gravity * sum(system.masses) * sum(system.lengths)
    assert np.abs(energies - energies[0]).max() <= 1e-14 * scale


@pytest.mark.slow
def test_energy_stays_for_a_thousand_seconds():
    system = RodChain((1.0, 1.0))
    found = simulate(system, [2.0, 2.5], [0.0, 0.0], np.linspace(0, 1e3, 5))
    energies = energy(system, found.theta, found.omega)
    assert np.abs(energies / energies[0] - 1).max() <= 1e-12  # rounding's random walk: EPS · √steps = 5e-14, and more


@pytest.mark.parametrize("system", [ROD, RODS, LEGS], ids=lambda s: f"{s.kind}-{s.n}")
def test_backward_returns_to_the_start(system):
    theta, omega = np.linspace(-1, 1, system.n), np.linspace(1, -2, system.n)
    there = simulate(system, theta, omega, [1.0, 3.0])
    back = simulate(system, there.theta[-1], there.omega[-1], [3.0, 2.0, 1.0])
    np.testing.assert_allclose(back.theta[-1], theta, atol=1e-12)
    np.testing.assert_allclose(back.omega[-1], omega, atol=1e-11)
    middle = simulate(system, theta, omega, [1.0, 2.0])
    np.testing.assert_allclose(back.theta[1], middle.theta[-1], atol=1e-12)


@pytest.mark.parametrize("system", [RODS, LEGS], ids=lambda s: s.kind)
def test_dense_output_does_not_change_the_motion(system):
    theta, omega = np.full(system.n, 1.5), np.zeros(system.n)
    few, many = (simulate(system, theta, omega, np.linspace(0, 2, m)) for m in (3, 2001))
    np.testing.assert_array_equal(few.theta, many.theta[::1000])
    np.testing.assert_array_equal(few.omega, many.omega[::1000])
    assert few.steps == many.steps
    # and in between it is the motion: ω is the derivative of θ (central difference, error h²/6 · |ω''| below 1e-3)
    rate = (many.theta[2:] - many.theta[:-2]) / (many.times[2:] - many.times[:-2])[:, np.newaxis]
    assert np.abs(rate - many.omega[1:-1]).max() < 1e-2


def test_no_duration_one_time_and_repeats_give_the_state_itself():
    theta, omega = np.array([3.5, -200.1, 1e15]), np.array([0.1, 0.2, 0.3])
    for times in ([0.0], [2.0, 2.0, 2.0]):
        found = simulate(RODS, theta, omega, times)
        np.testing.assert_array_equal(found.theta, np.tile(theta, (len(times), 1)))
        np.testing.assert_array_equal(found.omega, np.tile(omega, (len(times), 1)))
        assert found.warning == ""
    found = simulate(RODS, [*theta[:2].tolist(), 1.0], omega, [0, 0, 1, 1, 2])
    np.testing.assert_array_equal(found.theta[2], found.theta[3])
    np.testing.assert_array_equal(found.theta[0], found.theta[1])


def test_without_gravity_or_motion():
    still = RodChain((1.0, 2.0), gravity=0.0)
    found = simulate(still, [1.0, 2.0], [0.0, 0.0], [0.0, 1e6])
    np.testing.assert_array_equal(found.theta[1], [1.0, 2.0])
    lone = simulate(RodChain((1.0,), gravity=0.0), [1.0], [2.0], [0.0, 0.5, 1e6])
    np.testing.assert_allclose(lone.theta[:, 0], [1.0, 2.0, 1.0 + 2e6], rtol=2e-16)
    spun = simulate(still, [1.0, 1.0], [5.0, 5.0], [0.0, 10.0])  # turning as one straight rod
    np.testing.assert_allclose(spun.theta[1], [51.0, 51.0], rtol=1e-13)


def test_hanging_still_stays_still():
    for system in (RODS, LEGS):
        found = simulate(system, np.zeros(system.n), np.zeros(system.n), [0.0, 1.0, 100.0])
        np.testing.assert_array_equal(found.theta, 0)
        assert found.warning == ""


def test_angles_are_continuous_and_count_turns():
    found = simulate(ROD, [0.0], [40.0], np.linspace(0, 5, 1001))
    assert found.theta[-1, 0] > 100
    assert np.diff(found.theta[:, 0]).max() < 0.3
    shifted = simulate(ROD, [2 * math.pi * 1000], [40.0], np.linspace(0, 5, 1001))
    apart = shifted.theta - 2 * math.pi * 1000 - found.theta
    assert np.abs(apart).max() < 1e-10  # 2000 π is rounded to 5e-13, and the turning pendulum shears it


@pytest.mark.slow
@pytest.mark.parametrize("shape", [(3,), (2, 2), (0,), (1, 0, 2)])
def test_an_ensemble_is_its_members(shape):
    rng = np.random.default_rng(0)
    theta, omega = rng.uniform(-2, 2, (2, *shape, 3))
    times = [0.0, 0.7, 1.5]
    found = simulate(RODS, theta, omega, times)
    assert found.theta.shape == found.omega.shape == (*shape, 3, 3)
    assert found.steps.shape == shape
    assert found.error.shape == (*shape, 3)
    alone = simulate(RODS, theta, omega, times, threads=1)
    np.testing.assert_array_equal(found.theta, alone.theta)
    for place in np.ndindex(shape):
        one = simulate(RODS, theta[place], omega[place], times)
        # alone it is rounded otherwise: each is as far from the motion as its own estimate says, in rad and per |ω|
        fastest = np.abs(one.omega).max()
        assert (np.abs(found.theta[place] - one.theta).max(-1) <= found.error[place] + one.error).all()
        assert (np.abs(found.omega[place] - one.omega).max(-1) <= fastest * (found.error[place] + one.error)).all()


@pytest.mark.slow
@pytest.mark.parametrize("system", [RODS, LEGS], ids=["rods", "legs"])
def test_a_member_of_an_ensemble_depends_on_no_other(system):
    """Twenty in eight lanes: some start in a lane where another has ended, some run beside a much faster one."""
    rng = np.random.default_rng(1)
    theta, omega = rng.uniform(-2, 2, (2, 20, system.n))
    omega *= np.logspace(-1, 1.5, 20)[:, np.newaxis]
    times = [0.0, 0.1, 0.1, 1.0]
    found = simulate(system, theta, omega, times, threads=1)
    other = simulate(system, theta[::-1], omega[::-1], times, threads=1)
    np.testing.assert_array_equal(found.theta, other.theta[::-1])
    np.testing.assert_array_equal(found.omega, other.omega[::-1])
    np.testing.assert_array_equal(found.steps, other.steps[::-1])
    few = simulate(system, theta[3:5], omega[3:5], times, threads=1)
    np.testing.assert_array_equal(found.theta[3:5], few.theta)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["rods", "legs"])
def test_every_start_may_have_its_own_system(kind):
    rng = np.random.default_rng(2)
    lengths, masses = rng.uniform(0.3, 1.5, (2, 11, 3))
    gravities = rng.uniform(1, 20, 11)
    systems = [
        RodChain(l, density=2.0, gravity=g) if kind == "rods" else NLegPendulum(l, m, gravity=g)
        for l, m, g in zip(lengths, masses, gravities, strict=True)
    ]
    theta, omega = rng.uniform(-2, 2, (2, 11, 3))
    times = [0.0, 0.5, 1.0]
    found = simulate(systems, theta, omega, times)
    for system, *start, each, error in zip(systems, theta, omega, found.theta, found.error, strict=True):
        one = simulate(system, *start, times)
        assert (np.abs(each - one.theta).max(-1) <= error + one.error).all()
    from_one = simulate(systems, theta[0], omega[0], times)
    assert from_one.theta.shape == (11, 3, 3)
    np.testing.assert_array_equal(from_one.theta[0], found.theta[0])


@pytest.mark.parametrize(
    ("systems", "theta", "says"),
    [
        ([], np.zeros((0, 2)), "one or more of one kind"),
        ([ROD, RODS], np.zeros((2, 1)), "one or more of one kind"),
        ([RODS, RODS], np.zeros((3, 3)), r"with 2 systems, shape \(2, 3\) is needed, got \(3, 3\)"),
    ],
)
def test_systems_that_do_not_fit_the_starts_are_refused(systems, theta, says):
    with pytest.raises(InvalidInput, match=says):
        simulate(systems, theta, theta, [0.0, 1.0])


def test_a_motion_of_an_ensemble_that_cannot_be_followed_is_told():
    omega = np.zeros((9, 3))
    omega[7, 1] = 1e90
    with pytest.raises(InvalidInput, match="too fast to be followed from t = 0 s"):
        simulate(RODS, np.zeros((9, 3)), omega, [0.0, 1.0])


def test_a_coarser_tolerance_takes_less_work_and_is_kept():
    theta, times = np.linspace(1, 2, 3), [0.0, 2.0]
    fine, coarse = simulate(RODS, theta, np.zeros(3), times), simulate(RODS, theta, np.zeros(3), times, 1e-5)
    assert 0 < np.abs(fine.theta - coarse.theta).max() <= 1e-5
    assert coarse.warning == ""
    assert coarse.error.max() > fine.error.max()


def test_a_tolerance_that_is_just_kept_is_no_warning():
    found = simulate(RODS, np.linspace(1, 2, 3), np.zeros(3), [0.0, 2.0])
    error = float(found.error.max())
    assert error > 0
    assert replace(found, tolerance=error).warning == ""
    short = replace(found, tolerance=np.nextafter(error, 0)).warning
    assert "not reached" in short
    assert f"estimated error {error:.1e}" in short
    # A few roundings are what doubles hold; more than a hundred are the motion's growth.
    assert ("double precision" in short) == (error < 100 * 2.0**-52)
    assert ("multiplies rounding errors by about" in short) == (error >= 100 * 2.0**-52)


def test_a_scaled_mechanism_moves_the_same():
    """Lengths by 1e-3 and time by √1e-3: no length or time is built in."""
    times = np.linspace(0, 2, 5)
    small = NLegPendulum(tuple(l / 1024 for l in LEGS.lengths), LEGS.masses, LEGS.gravity)
    theta = np.linspace(0.5, 1.5, 4)
    a, b = simulate(LEGS, theta, np.zeros(4), times), simulate(small, theta, np.zeros(4), times / 32)
    np.testing.assert_allclose(a.theta, b.theta, atol=1e-12)
    assert a.steps == b.steps


@pytest.mark.parametrize(
    ("times", "says"),
    [
        ([0.0, 1.0, 0.5], r"times\[1\] = 1 is followed by times\[2\] = 0.5"),
        ([1.0, 0.0, 0.5], r"times\[1\] = 0 is followed by times\[2\] = 0.5"),
        ([0.0, 1.0, 0.0], "must rise or fall"),
        ([], "at least one time"),
        (1.0, "one axis"),
        ([[0.0, 1.0]], "one axis"),
        ([0.0, math.nan], "finite"),
        ([0.0, math.inf], "finite"),
        (["now"], "array of numbers"),
    ],
)
def test_refuses_times_that_make_no_sense(times, says):
    with pytest.raises(InvalidInput, match=says):
        simulate(RODS, [0.0] * 3, [0.0] * 3, times)


@pytest.mark.parametrize("tolerance", [0, -1e-9, 1, math.nan, math.inf, "fine", None])
def test_refuses_tolerances_that_make_no_sense(tolerance):
    with pytest.raises(InvalidInput, match="tolerance"):
        simulate(RODS, [0.0] * 3, [0.0] * 3, [0.0, 1.0], tolerance)


def test_refuses_states_that_are_none():
    with pytest.raises(InvalidInput, match=r"theta\[0\]"):
        simulate(RODS, [math.nan, 0, 0], [0.0] * 3, [0.0, 1.0])
    with pytest.raises(InvalidInput, match="too fast"):
        simulate(RODS, [0.0, 1.0, 2.0], [0.0, 0.0, 1e90], [0.0, 1.0])


@settings(deadline=None, max_examples=25)
@given(
    st.integers(1, 5).flatmap(
        lambda n: st.tuples(
            *(st.lists(st.floats(*ends), min_size=n, max_size=n) for ends in ((0.2, 2), (-4, 4), (-5, 5)))
        )
    )
)
def test_energy_is_conserved(lists):
    lengths, theta, omega = lists
    systems = [RodChain(lengths)] + ([NLegPendulum(lengths, lengths[::-1])] if len(lengths) > 1 else [])
    for system in systems:
        found = simulate(system, theta, omega, [0.0, 0.5, 1.0])
        energies = energy(system, found.theta, found.omega)
        reach = sum(system.lengths)
        scale = sum(system.masses) * reach * (system.gravity + reach * max(w * w for w in omega))
        assert np.abs(energies - energies[0]).max() <= 1e-13 * scale  # some hundred roundings of the largest term
