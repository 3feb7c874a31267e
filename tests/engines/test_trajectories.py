"""The engines' own integrators, against the pendulum's closed form."""

import numpy as np
import pytest

from furiko.engines import ENGINES, load_engine
from furiko.models import RodChain

SCHEMES = [(engine, scheme) for engine, info in ENGINES.items() for scheme in info.integrators]
names = pytest.mark.parametrize(("engine", "scheme"), SCHEMES, ids=[f"{e}-{s.name}" for e, s in SCHEMES])
LENGTH, GRAVITY, START, END = 0.7, 9.81, 2.0, 2.0
# So many steps that the next order's part of the error is a fifth at most, and so few that rounding's is less.
COARSEST = {"Euler": 400, "implicitfast": 400, "RK4": 200, "RK44": 200, "RK67": 50}


def pendulum(time):
    """Angle and rate of a rod let go at START: sin(θ/2) = k sn(ω₀ t + K), k = sin(START/2), ω₀² = 3g/2l."""
    from scipy.special import ellipj, ellipk

    k, frequency = np.sin(START / 2), np.sqrt(1.5 * GRAVITY / LENGTH)
    sn, cn, _, _ = ellipj(frequency * time + ellipk(k * k), k * k)
    return np.array([2 * np.arcsin(k * sn), 2 * k * frequency * cn])


@names
def test_the_order_is_what_its_makers_say(engine, scheme):
    adapter = load_engine(engine, RodChain((LENGTH,), gravity=GRAVITY))
    coarsest = COARSEST.get(scheme.name, 200)
    errors = []
    for steps in (coarsest, 2 * coarsest, 4 * coarsest):
        (angle,), (rate,) = adapter.trajectory([START], [0.0], scheme.name, END / steps, steps)
        errors.append(np.abs(np.array([angle, rate]) - pendulum(END)).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (np.abs(orders - scheme.order) < 0.5).all(), (errors, orders)


@names
def test_coming_to_grief_is_nan(engine, scheme, capfd, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    adapter = load_engine(engine, RodChain((1.0, 0.8, 0.6)))
    angles, rates = adapter.trajectory([2.0, 2.5, 1.0], [1e3, 0.0, -1e3], scheme.name, 10.0, 200)
    assert np.isnan(angles).all()
    assert np.isnan(rates).all()
    assert capfd.readouterr() == ("", "")
    assert list(tmp_path.iterdir()) == []


@names
def test_one_step_then_another_is_two_steps(engine, scheme):
    if scheme.name in ("GeneralizedAlpha", "TrapezoidalIndex2"):
        pytest.skip("it carries accelerations of its own from step to step, and starts anew with the true ones")
    adapter = load_engine(engine, RodChain((LENGTH, 0.5)))
    start = np.array([1.0, -0.5]), np.array([0.3, 0.0])
    once = adapter.trajectory(*start, scheme.name, 1e-3, 1)
    at_once, in_turn = adapter.trajectory(*start, scheme.name, 1e-3, 2), adapter.trajectory(*once, scheme.name, 1e-3, 1)
    # Absolute angles and back between the steps: a rounding of numbers below 1, times the step in the rates.
    np.testing.assert_allclose(in_turn, at_once, rtol=0, atol=1e-14)


@names
def test_a_path_ends_where_the_run_ends(engine, scheme):
    adapter = load_engine(engine, RodChain((LENGTH, 0.5)))
    start = np.array([1.0, -0.5]), np.array([0.25, 0.0])
    angles, rates = adapter.path(*start, scheme.name, 1e-2, 7)
    assert angles.shape == rates.shape == (8, 2)
    np.testing.assert_array_equal([angles[0], rates[0]], start)  # multiples of 1/4: exact in any coordinates
    for steps in (3, 7):
        # The same operations but for the time of each step, which Exudyn reckons from the run's end: not used here.
        np.testing.assert_allclose(
            [angles[steps], rates[steps]], adapter.trajectory(*start, scheme.name, 1e-2, steps), rtol=0, atol=1e-13
        )


IMPLICIT = [(engine, scheme) for engine, scheme in SCHEMES if scheme.tolerance]


@pytest.mark.parametrize(("engine", "scheme"), IMPLICIT, ids=[f"{e}-{s.name}" for e, s in IMPLICIT])
def test_iterations_end_where_the_registry_says(engine, scheme, monkeypatch):
    """The bound of a step counts a residual of ``tolerance`` times a norm that is at least one for each link.

    An iteration ends at the sum of both of Exudyn's tolerances, so that neither may be more than that.
    """
    from furiko.engines import exudyn_settings

    links, told = 3, []
    adapter = load_engine(engine, RodChain((1.0, 0.8, 0.6)))
    solve = exudyn_settings.exudyn.SolveDynamic

    def listening(mbs, settings, **named):
        newton = settings.timeIntegration.newton
        told.append((newton.relativeTolerance, newton.absoluteTolerance))
        return solve(mbs, settings, **named)

    monkeypatch.setattr(exudyn_settings.exudyn, "SolveDynamic", listening)
    theta, omega = adapter.trajectory([0.3, 0.4, 0.5], [0.1, 0.2, 0.3], scheme.name, 0.01, 2)
    assert np.isfinite(theta).all()
    assert np.isfinite(omega).all()
    ((relative, absolute),) = told
    assert relative == scheme.tolerance
    assert 0 < absolute < links * scheme.tolerance
