"""Flip times: elliptic functions, energy that forbids, proofs, and polynomials whose roots are known."""

import math

import numpy as np
import pytest

import furiko
from furiko.models import InvalidInput, NLegPendulum, RodChain
from furiko.reference.integration.taylor_flips import NEVER, passing
from furiko.reference.kernels.compiling import njit

ROD = RodChain((0.7,), density=3.0)
OWN = math.sqrt(1.5 * 9.81 / 0.7)  # √(3g/2l)
DOUBLE = NLegPendulum((1.0, 1.0), (1.0, 1.0))


@pytest.mark.slow
@pytest.mark.parametrize("factor", [1 + 1e-6, 1.001, 1.5, 10.0, -1.2])
def test_a_rod_goes_over_the_top_when_elliptic_functions_say(factor):
    """ω² = ω0² - 4 (3g/2l) sin²(θ/2): from hanging to the top it takes (2/ω0) K(m), √m = 2 √(3g/2l) / ω0."""
    special = pytest.importorskip("scipy.special")
    omega = 2 * OWN * factor
    m = (2 * OWN / omega) ** 2
    expected = 2 / abs(omega) * special.ellipk(m)
    found = furiko.flip_times(ROD, [0.0], [omega], 10.0)
    # Near the separatrix a rounding of ω0, or of OWN, is one of 1 - m divided by 1 - m.
    rounded = expected * (1e-15 + 4e-16 / (1 - m))
    assert abs(found.times - expected) <= 5 * found.error + rounded
    assert abs(found.times - expected) <= 10 * rounded
    assert found.link == 0
    assert furiko.flip_times(ROD, [0.0], [omega], 0.99 * expected).times == math.inf
    assert furiko.flip_times(ROD, [6 * math.pi], [omega], 10.0).times == pytest.approx(expected, rel=1e-9 / (1 - m))


@pytest.mark.slow
@pytest.mark.parametrize("factor", [0.5, 1 - 1e-6, 1 - 1e-12])
def test_a_rod_that_swings_never_flips(factor):
    found = furiko.flip_times(ROD, [0.0], [2 * OWN * factor], 30.0)
    assert (found.times, found.link, found.error) == (math.inf, -1, 0.0)


def test_without_gravity_it_turns_evenly():
    still = RodChain((1.0,), gravity=0.0)
    for theta, omega, expected in (
        (0.0, 2.0, math.pi / 2),
        (1.0, -0.25, 4 * (1 + math.pi)),
        (4.0, 1.0, 3 * math.pi - 4),
    ):
        found = furiko.flip_times(still, [theta], [omega], 100.0)
        assert found.times == pytest.approx(expected, rel=1e-15)


def test_a_start_beside_the_upright_counts_only_what_passes_it():
    below, above = math.pi, math.nextafter(math.pi, 4)  # π itself lies between the two
    for theta, omega in ((below, 1.0), (above, -1.0), (-below, -1.0), (-above, 1.0), (9 * math.pi + 1e-14, -1.0)):
        assert furiko.flip_times(ROD, [theta], [omega], 1.0).times < 1e-13
    for theta, omega in ((below, -20.0), (above, 20.0)):  # away from it, and once around
        assert 0.1 < furiko.flip_times(ROD, [theta], [omega], 1.0).times < 0.6


@pytest.mark.slow
def test_energy_forbids_flips():
    """At rest the energy is -mgl (2 cos θ1 + cos θ2), and -mgl at least where the second link is upright."""
    theta = np.random.default_rng(0).uniform(-3.1, 3.1, (600, 2))
    found = furiko.flip_times(DOUBLE, theta, np.zeros_like(theta), 10.0, 1e-10)
    allowed = 2 * np.cos(theta[:, 0]) + np.cos(theta[:, 1]) < 1
    assert np.isinf(found.times[~allowed]).all()
    assert np.isfinite(found.times[allowed]).mean() > 0.5
    assert found.times.shape == found.link.shape == found.error.shape == (600,)
    assert set(found.link[np.isfinite(found.times)].tolist()) == {0, 1}


@pytest.mark.slow
@pytest.mark.parametrize("system", [DOUBLE, RodChain((0.5, 0.8, 0.3))], ids=lambda s: s.kind)
def test_between_two_points_of_a_fine_motion(system):
    theta, n = np.random.default_rng(1).uniform(-3, 3, (60, system.n)), system.n
    until, grid = 5.0, np.linspace(0, 5, 5001)
    found = furiko.flip_times(system, theta, np.zeros_like(theta), until)
    each = [furiko.flip_times(system, theta, np.zeros_like(theta), until, link=j).times for j in range(n)]
    turns = np.round(furiko.simulate(system, theta, np.zeros_like(theta), grid).theta / (2 * math.pi))
    for link, times in enumerate(each):
        moved = turns[..., link] != turns[:, :1, link]
        seen = np.where(moved.any(-1), grid[np.argmax(moved, -1)], math.inf)
        assert (np.isinf(seen) == np.isinf(times)).all()
        late = seen[np.isfinite(seen)] - times[np.isfinite(times)]
        assert late.min() > 0
        assert late.max() < 0.001 + 1e-9  # one step of the grid
    np.testing.assert_allclose(found.times, np.min(each, axis=0), rtol=1e-9)  # the steps after a flip are not taken
    flipped = np.isfinite(found.times)
    np.testing.assert_array_equal(found.link[flipped], np.argmin(each, axis=0)[flipped])


@pytest.mark.slow
@pytest.mark.parametrize("theta", [(2.8, 1.0), (3.0, -2.0)])
def test_a_proof_has_the_link_below_the_upright_before_and_above_it_after(theta):
    pytest.importorskip("flint")
    found = furiko.flip_times(DOUBLE, theta, (0.0, 0.0), 3.0)
    assert np.isfinite(found.times)
    apart = max(1e-11, 2 * float(found.error))
    times = [0.0, float(found.times) - apart, float(found.times) + apart]
    proof = furiko.enclose(DOUBLE, theta, (0.0, 0.0), times, digits=13)
    assert proof.complete
    before, after = proof.theta[1:, int(found.link)]
    top = math.copysign(math.pi, float(after.mid()))  # beside it by 1e-16, which is nothing here
    sides = {(before - top) > 1e-15, (after - top) > 1e-15}
    assert sides == {True, False}
    assert abs(before - top) > 1e-15
    assert abs(after - top) > 1e-15


@njit
def first_passing(rates, above, below, h):
    return passing(rates, above, below, h)


@pytest.mark.parametrize("over", [1e-4, 1e-8, 1e-12])
def test_an_angle_that_passes_and_comes_back_within_a_step_has_flipped(over):
    # above + turned = over - (t - 1/2)²: passes at 1/2 - √over, comes back at 1/2 + √over
    rates = np.array([1.0, -2.0, 0.0, 0.0])
    found = first_passing(rates, over - 0.25, 6.0, 1.0)
    assert found == pytest.approx(0.5 - math.sqrt(over), abs=1e-15 / math.sqrt(over))
    assert first_passing(rates, -over - 0.25, 6.0, 1.0) == NEVER
    # downwards, to the other end
    found = first_passing(-rates, -6.0, 0.25 - over, 1.0)
    assert found == pytest.approx(0.5 - math.sqrt(over), abs=1e-15 / math.sqrt(over))


def test_the_first_of_several_roots_is_found():
    # (t - 0.1)(t - 0.4)(t - 0.7) = t³ - 1.2 t² + 0.39 t - 0.028
    rates = np.array([0.39, -2.4, 3.0])
    assert first_passing(rates, -0.028, 6.0, 1.0) == pytest.approx(0.1, abs=1e-15)
    assert first_passing(rates, -0.028, 6.0, 0.0999) == NEVER
    assert first_passing(rates - [0.39, -2.4, 3.0], -0.028, 6.0, 1.0) == NEVER  # at rest


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"until": 0.0}, "until"),
        ({"until": -1.0}, "until"),
        ({"until": math.inf}, "until"),
        ({"until": "long"}, "until"),
        ({"link": 2}, "link"),
        ({"link": True}, "link"),
        ({"tolerance": 1.0}, "tolerance"),
        ({"omega": [math.nan, 0.0]}, "omega"),
    ],
)
def test_what_makes_no_sense_is_refused(change, says):
    given = {"theta": [0.0, 0.0], "omega": [0.0, 0.0], "until": 1.0, **change}
    with pytest.raises(InvalidInput, match=says):
        furiko.flip_times(DOUBLE, **given)
