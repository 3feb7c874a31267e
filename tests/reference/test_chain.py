"""The chain: small swings against the document's matrices and Bernoulli's limit, motions from first principles."""

import numpy as np
import pytest

from furiko.models import RodChain
from furiko.reference import gravity_vector, mass_matrix
from furiko.reference.chain import bow, chain, largest_step, matrices, move, order, small_swings, swing_errors
from furiko.reference.documents.equations_of_motion import energies


@pytest.mark.parametrize("n", [1, 2, 3, 12, 60])
def test_small_swings_of_rods_are_those_of_takenos_matrices(n):
    from scipy.linalg import eigh

    # (22) linearised about θ = 0: A(0) θ'' + g L θ = 0, here times ρ l_j.
    rates = np.sqrt(eigh(np.diag(gravity_vector(chain(n), np.full(n, np.pi / 2))), mass_matrix(chain(n), np.zeros(n)),
                         eigvals_only=True))  # fmt: skip
    count = min(n, 10)
    # The dense matrix's condition is n² (5e4 at 60): its eigenvalues are known to 1e-11.
    np.testing.assert_allclose(small_swings(n, "rods", count), rates[:count], rtol=1e-11)


@pytest.mark.parametrize("n", [1, 2, 7, 30])
def test_small_swings_of_point_masses_are_the_zeros_of_laguerres_polynomial(n):
    # T'' with tensions m g (n - j + 1) is Laguerre's recurrence: ω² = (g/l) x with L_n(x) = 0.
    zeros = np.polynomial.laguerre.laggauss(n)[0]
    count = min(n, 10)
    np.testing.assert_allclose(
        small_swings(n, "point masses", count, 2.0, 9.0), np.sqrt(9.0 * n / 2.0 * zeros[:count]), rtol=1e-12
    )


def test_one_rod_is_the_physical_pendulum():
    assert small_swings(1, "rods", 1, 0.5, 9.81)[0] == pytest.approx(np.sqrt(1.5 * 9.81 / 0.5), rel=1e-15)


def test_dense_and_sparse_solvers_agree():
    from scipy.linalg import eigh

    mass, stiffness = matrices(100, "rods")
    full = [np.diag(b[0]) + np.diag(b[1, 1:], 1) + np.diag(b[1, 1:], -1) for b in (stiffness, mass)]
    np.testing.assert_allclose(small_swings(100, "rods", 10), np.sqrt(eigh(*full, eigvals_only=True)[:10]), rtol=1e-11)


def test_rods_come_to_bernoullis_limit_with_n_squared_and_point_masses_with_n():
    numbers = [100, 200, 400, 800]
    for links, power, coefficient in (("rods", 2, 0.0307), ("point masses", 1, -0.25)):
        errors = [swing_errors(n, links, 3) for n in numbers]
        assert order(numbers, [e[0] for e in errors]) == pytest.approx(power, abs=0.01)
        assert errors[-1][0] * numbers[-1] ** power == pytest.approx(coefficient, rel=3e-3)
        assert order(numbers, [e[2] for e in errors]) == pytest.approx(power, abs=0.05)


def test_a_small_bow_in_the_first_swing_keeps_bernoullis_time():
    # y = J0(j √(1 - s/L)) is the first swing's shape, its slope θ = -dy/ds; after one period it is back. The error
    # left is that of the period, 0.0307/n² of 2π in phase, and the non-linear one, amplitude squared.
    from scipy.special import j1, jn_zeros

    n, amplitude = 60, 1e-4
    s = (np.arange(n) + 0.5) / n
    zero = jn_zeros(0, 1)[0]
    theta = amplitude * j1(zero * np.sqrt(1 - s)) / np.sqrt(1 - s)
    period = 2 * np.pi / (zero / 2 * np.sqrt(9.81))
    found = move(chain(n), theta, np.zeros(n), [0.0, period / 2, period])
    start = found.tip[0, 0]
    assert found.tip[2, 0] == pytest.approx(start, rel=2 / n**2)  # the shape of n rods is off by as much as the rate
    assert found.tip[1, 0] == pytest.approx(-start, rel=5e-3)


def test_motion_tells_tip_speed_and_energy_by_first_principles():
    system = RodChain((0.4, 0.6))
    theta, omega = np.array([0.3, -0.2]), np.array([1.0, 2.0])
    found = move(system, theta, omega, [0.0, 0.1])
    assert found.tip[0] == pytest.approx(
        [0.4 * np.sin(0.3) + 0.6 * np.sin(-0.2), -0.4 * np.cos(0.3) - 0.6 * np.cos(-0.2)], abs=1e-15
    )
    velocity = 0.4 * 1.0 * np.array([np.cos(0.3), np.sin(0.3)]) + 0.6 * 2.0 * np.array([np.cos(-0.2), np.sin(-0.2)])
    assert found.speed[0] == pytest.approx(np.hypot(*velocity), rel=1e-15)
    rest = -9.81 * (0.4 * 0.2 + 0.6 * 0.7)
    assert found.energy[0] == pytest.approx(float(sum(energies(system, theta, omega))) - rest, rel=1e-14)
    assert found.energy[1] == pytest.approx(found.energy[0], rel=1e-13)
    assert found.curves[0, -1] == pytest.approx(found.tip[0])


def test_the_bow_is_one_curve_for_every_n():
    # Slope 1 - s/2 at the middle of each rod.
    assert bow(4).tolist() == pytest.approx([1 - 0.5 * (j + 0.5) / 4 for j in range(4)])
    assert bow(3, 0.1) == pytest.approx(0.1 * bow(3))


def test_the_usable_step_is_that_of_the_fastest_swing():
    # Classical Runge-Kutta is stable to 2√2/ω; n rods' fastest swing goes with n. Large motions ask for less.
    n = 20
    mass, stiffness = matrices(n, "rods")
    full = [np.diag(b[0]) + np.diag(b[1, 1:], 1) + np.diag(b[1, 1:], -1) for b in (stiffness, mass)]
    from scipy.linalg import eigh

    limit = 2 * np.sqrt(2) / np.sqrt(eigh(*full, eigvals_only=True)[-1])
    assert 0.3 * limit < largest_step(n) < 2 * limit
