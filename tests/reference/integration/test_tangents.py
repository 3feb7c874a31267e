"""Growth of small differences: closed forms, exact matrix exponentials, Liouville's theorem, and heyoka's own."""

import math

import numpy as np
import pytest
from literal_growth import growth_along

import furiko
from furiko.models import InvalidInput, NLegPendulum, RodChain
from furiko.models.states import natural_rate
from furiko.reference import mass_matrix
from furiko.reference.integration.tangents import general_directions

ROD = RodChain((0.7,), density=3.0)
RODS = RodChain((1.0, 0.4, 1.3), density=0.5)
LEGS = NLegPendulum((1.0, 0.8, 0.5, 0.3), (1.0, 0.5, 2.0, 0.1))
DOUBLE = NLegPendulum((1.0, 1.0), (1.0, 1.0))


def own_rate(system):
    """√(3g/2l) of one rod, by hand."""
    return math.sqrt(1.5 * system.gravity / system.lengths[0])


@pytest.mark.slow
def test_one_rod_along_its_separatrix():
    """θ = 2 gd(τ), τ = √(3g/2l) t: the variation u'' + (2 sech²τ - 1) u = 0 has the solutions sech τ and
    (sinh τ + τ sech τ)/2, with values and derivatives (1, 0) and (0, 1) at τ = 0."""
    rate = own_rate(ROD)
    tau = np.array([0.0, 0.5, 2.0, 6.0, 10.0])
    found = furiko.stretching(ROD, [0.0], [2 * rate], tau / rate, rate=rate)
    sech, tanh = 1 / np.cosh(tau), np.tanh(tau)
    flow = np.array(
        [
            [sech, (np.sinh(tau) + tau * sech) / 2],
            [-sech * tanh, (np.cosh(tau) + sech - tau * sech * tanh) / 2],
        ]
    )
    _, expected, right = np.linalg.svd(np.moveaxis(flow, -1, 0))
    # 10 folds multiply what the start's rounding misses the separatrix by, ε, by 2e4; and the bound of the estimate.
    np.testing.assert_allclose(found.logarithm, np.log(expected[:, 0]), atol=1e-10)
    assert (np.abs(found.logarithm - np.log(expected[:, 0])) <= 10 * found.error).all()
    np.testing.assert_allclose(found.exponent[1:], found.logarithm[1:] * rate / tau[1:], rtol=1e-14)
    assert np.isnan(found.exponent[0])
    along = np.abs(np.einsum("mi,mi->m", found.direction[1:], right[1:, 0]))
    np.testing.assert_allclose(along, 1, atol=1e-10)
    backwards = furiko.stretching(
        ROD, [0.0], [2 * rate], -tau / rate, rate=rate
    )  # θ is odd, so that |flow| is the same
    np.testing.assert_allclose(backwards.logarithm, np.log(expected[:, 0]), atol=1e-10)


@pytest.mark.slow
def test_an_upright_rod_parts_at_its_own_rate():
    rate = own_rate(ROD)
    found = furiko.stretching(ROD, [math.pi], [0.0], [0.0, 10 / rate], rate=rate)
    # δθ'' = rate² δθ: in these units the flow is a rotation of cosh and sinh, whose largest singular value is e^τ.
    # The start is 1e-16 rad off the upright and 1e-12 rad at the end: a square of that is neglected here.
    assert found.logarithm[1] == pytest.approx(10, abs=1e-12)
    spectrum = furiko.lyapunov(ROD, [math.pi], [0.0], [0.0, 10 / rate], count=2, rate=rate)
    flow = np.array([[math.cosh(10), math.sinh(10)], [math.sinh(10), math.cosh(10)]])
    expected = math.log(np.linalg.norm(flow @ general_directions(2)[0]))
    assert spectrum.logarithm[1, 0] == pytest.approx(expected, abs=1e-12)
    assert spectrum.exponents[1].sum() == pytest.approx(0, abs=1e-12 * rate)


def linear(system):
    """Mass matrix and stiffness of small angles about hanging, by hand."""
    l, g, n = np.array(system.lengths), system.gravity, system.n
    if system.kind == "rod-chain":
        m = system.density * l
        beyond = np.array([m[j + 1 :].sum() for j in range(n)])
        levers = (m / 2 + beyond) * l
        mass = np.array([[(m[max(i, j)] / 2 + beyond[max(i, j)]) * l[i] * l[j] for j in range(n)] for i in range(n)])
        mass[np.diag_indices(n)] = (m / 3 + beyond) * l**2
    else:
        m = np.array(system.masses)
        levers = m * l
        levers[0] = m.sum() * l[0]
        mass = np.diag(m * l**2)
        mass[0, 0] = m.sum() * l[0] ** 2
        mass[0, 1:] = mass[1:, 0] = m[1:] * l[1:] * l[0]
    return mass, np.diag(levers * g)


@pytest.mark.slow
@pytest.mark.parametrize("system", [ROD, RODS, LEGS, RodChain((0.3,) * 9)], ids=lambda s: f"{s.kind}-{s.n}")
def test_about_hanging_it_is_the_exponential_of_a_matrix(system):
    linalg = pytest.importorskip("scipy.linalg")
    n = system.n
    mass, stiffness = linear(system)
    J = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(mass, stiffness), np.zeros((n, n))]])
    unit = np.repeat([1.0, natural_rate(system)], n)
    times = np.array([0.0, 0.3, 1.0, 7.0])
    expected = [math.log(np.linalg.norm(linalg.expm(J * t) * unit / unit[:, None], 2)) for t in times]
    found = furiko.stretching(system, np.zeros(n), np.zeros(n), times)
    np.testing.assert_allclose(found.logarithm, expected, atol=1e-11)  # some thousand roundings; expm's as many
    long = furiko.lyapunov(system, np.zeros(n), np.zeros(n), [0.0, 1e3], count=2 * n)
    # Nothing grows: what is left is the ratio of the axes of the ellipses that differences move on, over the time.
    assert np.abs(long.exponents[1]).max() < 10 / 1e3


@pytest.mark.slow
@pytest.mark.parametrize("system", [RODS, LEGS], ids=lambda s: s.kind)
def test_all_exponents_together_keep_the_volume_of_phase_space(system):
    """Liouville: (θ, M ω) keeps its volume, so that (θ, ω) changes it by det M at the start over that at the end."""
    theta, times = np.linspace(2.0, 1.0, system.n), np.linspace(0, 20, 5)
    found = furiko.lyapunov(system, theta, np.zeros(system.n), times, count=2 * system.n)
    moved = furiko.simulate(system, theta, np.zeros(system.n), times)
    sign, determinants = np.linalg.slogdet(mass_matrix(system, moved.theta))
    assert (sign == 1).all()
    # The two runs differ by steps: by their errors, times how fast ln det M changes, a few for each radian.
    allowed = 1e-11 + 10 * moved.error + 10 * furiko.simulate(system, theta, np.zeros(system.n), times, 1e-13).error
    assert (np.abs(found.logarithm.sum(-1) - (determinants[0] - determinants)) <= allowed).all()


@pytest.mark.slow
def test_the_double_pendulum_against_heyokas_variational_equations():
    heyoka = pytest.importorskip("heyoka")
    t1, t2, w1, w2 = names = heyoka.make_vars("t1", "t2", "w1", "w2")
    # Two equal point masses on massless rods of 1 m, solved for the accelerations by hand (Cramer's rule).
    s, c, g = heyoka.sin(t1 - t2), heyoka.cos(t1 - t2), 9.81
    down, over = -s * w2 * w2 - 2 * g * heyoka.sin(t1), s * w1 * w1 - g * heyoka.sin(t2)
    equations = [(t1, w1), (t2, w2), (w1, (down - c * over) / (2 - c * c)), (w2, (2 * over - c * down) / (2 - c * c))]
    ode = heyoka.var_ode_sys(equations, heyoka.var_args.vars, order=1)
    start = [2.0, 2.5, 0.0, 0.0]
    theirs = heyoka.taylor_adaptive(ode, start, compact_mode=True)
    assert len(names) == 4
    for time in (0.5, 2.0, 4.0):
        theirs.propagate_until(time)
        flow = theirs.state[4:].reshape(4, 4)
        unit = np.array([1, 1, 2.0, 2.0])
        found = furiko.stretching(DOUBLE, start[:2], start[2:], [0.0, time], rate=2.0)
        # both miss the motion by their rounding times its growth, 1e4 in four seconds
        expected = math.log(np.linalg.norm(flow * unit / unit[:, None], 2))
        assert found.logarithm[1] == pytest.approx(expected, abs=1e-10)
        assert abs(found.logarithm[1] - expected) <= 20 * found.error[1]


@pytest.mark.slow
@pytest.mark.parametrize("system", [DOUBLE, RodChain((1.0, 0.8, 0.6))], ids=lambda s: s.kind)
def test_the_same_growth_as_the_literal_equations_give(system):
    """Butcher's scheme and the derivative of the literal equations: no step and no formula in common."""
    theta = np.linspace(2.0, 2.5, system.n)
    other = growth_along(system, theta, np.zeros(system.n), 5.0)
    found = furiko.stretching(system, theta, np.zeros(system.n), [0.0, 5.0])
    assert found.logarithm[1] == pytest.approx(other.logarithm[-1], abs=0.05)  # what that settles to


@pytest.mark.slow
def test_the_double_pendulum_is_chaotic():
    """Chaos of a swinging double pendulum has the scale of √(g/l), and each exponent its negative."""
    found = furiko.lyapunov(DOUBLE, [2.0, 2.5], [0.0, 0.0], [0.0, 300.0], count=4)
    assert 0.2 < found.exponents[1, 0] / math.sqrt(9.81) < 1.5
    np.testing.assert_allclose(found.exponents[1], -found.exponents[1, ::-1], atol=0.05)  # a few folds in 300 s
    assert np.abs(found.exponents[1, 1:3]).max() < 0.1  # energy: two of them are zero in the limit


@pytest.mark.slow
def test_the_first_directions_do_not_depend_on_how_many_are_asked_for():
    times = np.linspace(0, 3, 4)
    whole = furiko.lyapunov(RODS, [1.0, 2.0, 0.5], [0.0] * 3, times, count=6)
    for count in (1, 3):
        part = furiko.lyapunov(RODS, [1.0, 2.0, 0.5], [0.0] * 3, times, count=count)
        np.testing.assert_allclose(part.logarithm, whole.logarithm[:, :count], atol=1e-10)


@pytest.mark.slow
def test_each_of_an_ensemble_is_as_if_alone_and_has_its_own_system():
    generator = np.random.default_rng(3)
    systems = [RodChain(generator.uniform(0.5, 1.5, 2)) for _ in range(11)]
    theta, omega = generator.uniform(-2, 2, (2, 11, 2))
    times = [0.0, 1.0, 2.5]
    found = furiko.stretching(systems, theta, omega, times)
    assert found.logarithm.shape == (11, 3)
    assert found.direction.shape == (11, 3, 4)
    for system, angles, rates, row in zip(systems, theta, omega, found.logarithm, strict=True):
        alone = furiko.stretching(system, angles, rates, times)
        np.testing.assert_array_equal(alone.logarithm, row)
    one = furiko.lyapunov(systems, theta, omega, times, threads=1)
    np.testing.assert_array_equal(one.logarithm, furiko.lyapunov(systems, theta, omega, times, threads=2).logarithm)
    assert furiko.stretching(systems[0], np.zeros((0, 2)), np.zeros((0, 2)), times).logarithm.shape == (0, 3)


@pytest.mark.slow
def test_nothing_overflows_in_a_long_run():
    rate = own_rate(ROD)
    found = furiko.lyapunov(ROD, [math.pi], [0.0], [0.0, 20 / rate], rate=rate)
    assert np.isfinite(found.logarithm).all()
    long = furiko.lyapunov(DOUBLE, [2.0, 2.5], [0.0, 0.0], [0.0, 2000.0], 1e-8)
    assert long.logarithm[1, 0] > 710  # beyond the largest double
    assert np.isfinite(long.error[1:]).all()


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"count": 0}, "count"),
        ({"count": 7}, "count"),
        ({"count": 1.5}, "count"),
        ({"rate": -1.0}, "rate"),
        ({"rate": math.nan}, "rate"),
        ({"tolerance": 0.0}, "tolerance"),
        ({"times": [0.0, 1.0, 0.5]}, "times"),
        ({"theta": [1.0]}, "theta"),
    ],
)
def test_what_makes_no_sense_is_refused(change, says):
    given = {"theta": [0.0] * 3, "omega": [0.0] * 3, "times": [0.0, 1.0], **change}
    with pytest.raises(InvalidInput, match=says):
        furiko.lyapunov(RODS, **given)
