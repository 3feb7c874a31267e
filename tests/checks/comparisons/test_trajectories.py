"""Four runs: the order they show, where they converge to, and how sure that is, on series that are known."""

import math
from dataclasses import replace

import numpy as np
import pytest
from fake_integrators import Damped, Fake, LongStep

from furiko.checks.comparisons import trajectories
from furiko.checks.motions import ladder as ladder_module
from furiko.checks.motions.ladder import ORDER_SETTLED, Ladder, Rounding, growth, run
from furiko.models import NLegPendulum, RodChain, Scene
from furiko.reference.integration.schemes import SCHEMES
from furiko.reference.rounding.bounds import EPSILON


def ladder(error, steps=8):
    """The runs of a scheme whose error at step h is error(h), in one angle whose true value is 2."""
    ends = [np.array([[2.0 + error(0.1 / 2**k)], [0.0]]) for k in range(4)]
    return Ladder(0.1, steps, tuple(ends))


@pytest.mark.parametrize("order", [1, 2, 4, 6])
def test_the_order_of_a_known_series(order):
    coarser, finer = ladder(lambda h: 0.3 * h**order + 0.5 * h ** (order + 1)).orders()
    # The next term's share of a difference is 5/3 h (2 - 2^-order): a tenth at h = 0.1, which adds 0.2 to the order.
    assert order < finer < coarser < order + 0.25
    assert finer - order == pytest.approx((coarser - order) / 2, rel=0.1)


@pytest.mark.parametrize("order", [1, 2, 4])
def test_the_limit_is_as_sure_as_it_says(order):
    limit, uncertainty = ladder(lambda h: 0.3 * h**order + 0.5 * h ** (order + 1)).limit(order)
    assert abs(limit[0] - 2) <= uncertainty / 3
    assert uncertainty < 0.5 * 0.1 ** (order + 1)


def test_runs_that_converge_elsewhere_are_not_sure_enough_to_hide_it():
    limit, uncertainty = ladder(lambda h: 1e-6 + 0.3 * h**4).limit(4)
    assert abs(limit[0] - 2) > 100 * uncertainty


def test_runs_that_blow_up_have_no_order():
    ends = [np.full((2, 1), np.inf), *[np.array([[2.0 + 0.1 / 4**k], [0.0]]) for k in range(3)]]
    coarser, finer = Ladder(0.1, 8, tuple(ends)).orders()
    assert math.isnan(coarser)
    assert finer == pytest.approx(2)


def test_a_finer_run_that_blows_up_has_no_order_either():
    ends = [*[np.array([[2.0 + 0.1 / 4**k], [0.0]]) for k in range(3)], np.full((2, 1), np.inf)]
    coarser, finer = Ladder(0.1, 8, tuple(ends)).orders()
    assert coarser == pytest.approx(2)
    assert math.isnan(finer)


@pytest.mark.parametrize("order", [1, 2, 4, 6])
@pytest.mark.parametrize("signs", [(1, -1, 1, -1), (-1, 1, -1, 1), (1, -1, -1, 1)])
def test_an_order_that_can_be_told_is_not_below_its_own_by_more_than_a_quarter(order, signs):
    """A pure h^order, every end off by a noise in the direction that hurts: just enough of a gap, and just not."""
    noise = 1e-9
    for gap, told in ((18.1, True), (13.9, False)):  # 16, and the two noises that may hide or feign a part of it
        size = gap * 2**order * noise / (1 - 0.5**order) * 2**order / 0.1**order
        pure = ladder(lambda h, size=size: size * h**order)
        ends = tuple(end + noise * sign for end, sign in zip(pure.ends, signs, strict=True))
        found = Ladder(0.1, 8, ends)
        assert found.judges(order, noise) == told
        assert not told or found.orders()[1] > order - 0.25


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["exudyn-tree", "exudyn-redundant"])
@pytest.mark.parametrize("system", ["slow and small", "at rest afloat", "stretched out", "unequal"])
def test_sound_motions_that_only_their_numbers_make_unusual(make_cell, engine, system):
    """Found by chance among random mechanisms: each was once called different, by rounding that was not counted."""
    kind, theta, omega, duration = {
        # Millimetres in a hundredth of a moon's gravity, a tenth of a milliradian.
        "slow and small": (RodChain((0.003, 0.012), 10.0, 0.03), (7e-5, 1.7e-4), (0.0, 0.0), 0.2),
        "at rest afloat": (RodChain((0.23, 0.1), 46.0, 0.0), (-0.0016, 0.0038), (0.0, 0.0), 2.0),
        "stretched out": (RodChain((7e-5,) * 12, 0.002, 0.0), (1e-11,) * 12, (-0.08, 0.43, 0.1) * 4, 2.0),
        "unequal": (
            NLegPendulum((20.0, 0.3, 3.0), (0.001, 4.0, 0.05), 0.4),
            (0.6, -0.2, 0.9),
            (-1.1, -1.6, -1.3),
            1.3,
        ),
    }[system]
    scene = Scene(name=system, system=kind, theta=theta, omega=omega, duration=duration)
    for result in trajectories.compare(make_cell(engine, scene, random_states=1)):
        assert result.outcome == "agrees", result
        assert result.allowed < 1e-4  # and not because anything would do: the motions are of up to a radian


def test_four_steps_are_reported(make_cell):
    cell = make_cell(Fake, "double-pendulum")
    (result,) = trajectories.compare(cell)
    assert result.outcome == "agrees"
    assert result.details["time"] > cell.scene.duration / 8  # the first of the truth's times is not enough
    assert len(result.details["steps"]) == len(result.details["errors"]) == 4
    ratios = np.array(result.details["steps"][:-1]) / result.details["steps"][1:]
    np.testing.assert_allclose(ratios, 2)


@pytest.mark.slow
@pytest.mark.parametrize("fake", [Damped, LongStep])
def test_a_fault_of_1e_7_or_less_is_found_at_step_zero(make_cell, fake, monkeypatch):
    monkeypatch.setattr(ladder_module, "ORDER_SETTLED", -0.02)  # refine until the next term is small
    (result,) = trajectories.compare(make_cell(fake, "double-pendulum"))
    assert result.outcome == "differs", result


@pytest.mark.parametrize("worst", [0, 1, 2])
def test_rounding_is_that_of_the_worst_state_on_the_way(make_cell, worst):
    """In absolute angles, of an explicit scheme of order four: the largest angle, rate and acceleration of all states.

    A step adds up to five numbers (four stages and the state), each sure to ε; every acceleration is off by 1e-9.
    """
    cell = make_cell(Fake, "double-pendulum")
    theta, omega, alpha = (np.full((3, 2), 0.25) for _ in range(3))
    theta[worst, 1], omega[(worst + 1) % 3, 0], alpha[(worst + 2) % 3, 1] = -3.0, -7.0, 11.0
    found = trajectories.rounding(cell, Fake.integrators[0], theta, omega, alpha, 1e-9)
    assert found.angle == 3 * EPSILON
    assert found.rate == 7 * EPSILON
    assert found.turning == 5 * 7 * EPSILON
    reach = (found.speeding - 5 * 11 * EPSILON) / 1e-9  # the stages' weights: they add up to one, each in magnitude
    assert 1.0 <= reach < 2.0


def test_rounding_of_a_run_grows_with_its_steps_and_its_time():
    """Ten steps and two seconds: angles and rates of every step, and what turns and speeds in every second."""
    found = Rounding(angle=1.0, rate=10.0, turning=100.0, speeding=1000.0)
    assert found.after(10, 2.0, (3.0, 5.0)) == (10 * 1.0 + 2 * 100.0) * 3.0 + (10 * 10.0 + 2 * 1000.0) * 5.0


@pytest.mark.parametrize(("name", "order"), [("Kutta's third order", 3), ("explicit midpoint", 2)])
def test_a_scheme_of_a_lower_order_than_said_differs_by_its_order_alone(make_cell, name, order):
    """It converges to the true motion; and with some hundred steps it is known that no finer ones raise its order."""

    class Lower(Fake):
        scheme = next(scheme for scheme in SCHEMES if scheme.name == name)

    (result,) = trajectories.compare(make_cell(Lower, "double-pendulum"))
    assert result.outcome == "differs"
    assert result.measured <= result.allowed
    assert "RK4 is of order 4 and shows order" in result.reason
    assert result.details["measured order"] == pytest.approx(order, abs=ORDER_SETTLED / 4)
    assert result.details["time"] / result.details["steps"][-1] < 1000


class Beside(Fake):
    """Every run ends a ten-thousandth of a radian beside where it should."""

    def trajectory(self, theta, omega, integrator, step, steps):
        angles, rates = super().trajectory(theta, omega, integrator, step, steps)
        return angles + 1e-4, rates


@pytest.mark.parametrize(("sure", "outcome"), [(0.0, "differs"), (2e-4, "agrees")])
def test_no_motion_is_judged_beyond_what_its_truth_is_sure_to(make_cell, monkeypatch, sure, outcome):
    monkeypatch.setattr(trajectories, "sure", lambda *_: (np.full(4, sure), [False] * 4))
    cell = replace(make_cell(Beside, "double-pendulum"), few_steps=1)  # the first of the times is enough
    (result,) = trajectories.compare(cell)
    assert result.outcome == outcome


def test_rounding_grows_as_near_states_part():
    """A rod upright: δ̈ = ν² δ with ν² = 3 g / 2 l. An angle of 1 becomes cosh νt, a rate of 1 the angle sinh(νt)/ν."""
    scene = Scene("upright", RodChain((1.0,), 1.0, 6.0), (math.pi,), (0.0,), 1.0)

    class Cell:
        start = np.array(scene.theta), np.array(scene.omega)

        def trajectory(self, theta, omega, _integrator, step, steps):
            return np.array(Fake(scene.system).trajectory(theta, omega, "RK4", step, steps))

    cell = Cell()
    cell.scene = scene
    ends = tuple(run(cell, None, 1.0, 8 << k) for k in range(4))
    found = growth(cell, None, Ladder(1 / 8, 8, ends))
    # The classical scheme at νh = 3/16: its own error is (νh)⁴ / 120 of what grows, 1e-5.
    assert found == pytest.approx((math.cosh(3.0), math.sinh(3.0) / 3.0), rel=1e-4)
