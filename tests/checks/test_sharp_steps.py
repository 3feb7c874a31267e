"""The sharp line of steps, runs and symmetries, held against real engines and against small planted errors."""

from dataclasses import replace

import numpy as np
import pytest

from furiko.checks import sharp
from furiko.checks.comparisons import energy, step_map, symmetries, trajectories
from furiko.checks.motions.step_rounding import disturbed
from furiko.engines import ENGINES
from furiko.models import NLegPendulum, RodChain, Scene
from furiko.reference import literal_accelerations
from furiko.reference.rounding.bounds import amplitudes
from furiko.reference.rounding.iterations import left_in_accelerations

STEPPING = [name for name, info in ENGINES.items() if info.integrators]
SCENES = ("double-pendulum", "n-leg-3-mass-ratio", "n-leg-8", "rods-3-length-ratio", "rods-5", "rods-10")


def results(cell):
    moves = () if cell.scene.theta is None else tuple(trajectories.compare(cell))
    return [*step_map.compare(cell), *moves]


class Off:
    """A real engine whose runs end a little beside where they should, or whose answers for some mechanisms do."""

    def __init__(self, engine, angle=0.0, rate=0.0, other=0.0):
        self._engine, self._off, self._other = engine, (angle, rate), other

    def __getattr__(self, name):
        return getattr(self._engine, name)

    def trajectory(self, *run):
        theta, omega = self._engine.trajectory(*run)
        return theta + self._off[0] * np.eye(theta.size)[-1], omega + self._off[1] * np.eye(theta.size)[-1]

    def of(self, system):
        return (
            Off(self._engine.of(system), other=self._other)
            if not self._other
            else Other(self._engine.of(system), self._other)
        )


class Other(Off):
    """The last acceleration is off by a part of itself."""

    def __init__(self, engine, share):
        super().__init__(engine)
        self._share = share

    def accelerations(self, theta, omega):
        found = self._engine.accelerations(theta, omega).copy()
        found[:, -1] *= 1 + self._share
        return found


@pytest.fixture(scope="module")
def quotients():
    return {}


def measured(quotients, make_cell, engine):
    if engine not in quotients:
        quotients[engine] = [
            (scene, result)
            for scene in SCENES
            # Exudyn's iterations do not end in some states of links of very unlike lengths.
            if (scene, engine) != ("rods-3-length-ratio", "exudyn-tree")
            for result in results(make_cell(engine, scene, 30))
        ]
    return quotients[engine]


@pytest.mark.slow
@pytest.mark.parametrize("engine", STEPPING)
def test_engines_that_are_right_are_not_loose(quotients, make_cell, engine):
    for scene, result in measured(quotients, make_cell, engine):
        assert result.outcome == "agrees", (scene, result)
        assert not result.loose, (scene, result)
        assert "sharp line" in result.details, (scene, result)


@pytest.mark.slow
@pytest.mark.parametrize(("iterated", "factor"), [(False, sharp.ACCELERATIONS), (True, sharp.ITERATED)])
def test_no_factor_is_ten_times_too_wide_or_too_narrow(quotients, make_cell, iterated, factor):
    found = [
        result.details["sharp line"]["quotient"]
        for engine in STEPPING
        for _, result in measured(quotients, make_cell, engine)
        if bool(tolerance_of(engine, result)) == iterated
    ]
    assert factor / 10 < max(found) <= factor


def tolerance_of(engine, result):
    (found,) = (one.tolerance for one in ENGINES[engine].integrators if one.name == result.details["integrator"])
    return found


@pytest.mark.parametrize("planted", [{"angle": 1e-12}, {"rate": 1e-11}])
@pytest.mark.parametrize("engine", ["mujoco", "exudyn-tree"])
def test_a_small_error_of_a_step_is_loose(make_cell, engine, planted):
    """Within the proven line, which has room for the worst: 1e-6 rad/s for the implicit scheme."""
    cell = make_cell(engine, "n-leg-3-mass-ratio", 30)
    found = {result.check: result for result in step_map.compare(replace(cell, engine=Off(cell.engine, **planted)))}
    assert len(found) == len(cell.info.integrators)
    for result in found.values():
        assert result.loose or result.outcome == "differs", result
    if engine == "exudyn-tree":
        assert found["step map GeneralizedAlpha"].loose


def test_joints_that_iterations_leave_apart_are_not_loose(make_cell):
    """In one of these states Newton's iterations end just below their tolerance: joints are 7e-14 of a length apart,
    where rounding leaves 1e-16, and turn a short rod by 2e-12 rad. A long one cannot be off by 1e-13 rad for that,
    though joints as far apart as the tolerance of 1e-12 allows would turn it by as much.
    """
    lengths = (
        4.792858753168332e31,
        4.6302047870911585e30,
        3.422381788002323e31,
        1.923359083954608e32,
        5.281967323071129e32,
    )
    scene = Scene("absurd-53-15", RodChain(lengths, 4.4945849198938e-09))  # random states follow from the name
    cell = make_cell("exudyn-redundant", scene, random_states=200)
    (alpha,) = (one for one in cell.info.integrators if one.name == "GeneralizedAlpha")
    only = replace(cell, info=replace(cell.info, integrators=(alpha,)))
    (right,) = step_map.compare(only)
    assert (right.outcome, right.loose) == ("agrees", False), right
    (off,) = step_map.compare(replace(only, engine=Off(cell.engine, angle=1e-13)))
    assert off.loose, off


@pytest.mark.parametrize("engine", ["mujoco", "exudyn-tree"])
def test_a_run_that_ends_a_little_beside_the_schemes_is_loose(make_cell, engine):
    """1e-11 rad where 0.01 rad are within the proven line; 1e-9 of a scheme whose iterations end at 1e-12."""
    cell = make_cell(engine, "n-leg-3-mass-ratio", 30)
    for integrator in cell.info.integrators:
        only = replace(cell, info=replace(cell.info, integrators=(integrator,)))
        planted = Off(cell.engine, angle=1e-9 if integrator.tolerance else 1e-11)
        (right,), (off,) = trajectories.compare(only), trajectories.compare(replace(only, engine=planted))
        assert (right.outcome, right.loose) == ("agrees", False)
        assert off.outcome == "differs" or off.loose, off
        assert not off.loose or "steps of" in off.reason


@pytest.mark.parametrize("engine", ["mujoco", "pinocchio-aba", "exudyn-redundant"])
def test_a_small_difference_between_a_mechanism_and_its_image_is_loose(make_cell, engine):
    cell = make_cell(engine, "rods-10", 30)
    agreeing = {result.check: result for result in symmetries.compare(cell)}
    assert {result.outcome for result in agreeing.values()} == {"agrees"}
    assert not any(result.loose for result in agreeing.values())
    found = {result.check: result for result in symmetries.compare(replace(cell, engine=Off(cell.engine, other=1e-9)))}
    for name in ("mass scale", "length scale", "gravity scale"):  # those that ask for another mechanism
        result = found[f"symmetry {name}"]
        assert result.loose or result.outcome == "differs", result


def test_iterations_leave_what_a_residual_of_the_allowed_norm_may_make_of_an_acceleration():
    """Newton's tolerance is of the norm of all rows: a light link's row may be left with all of it.

    By hand for two masses 1e6 apart, in absolute angles: M from T = ½ m₁ v₁² + ½ m₂ v₂², and residuals of the norm
    1e-12 ‖|M| |α|‖ in random directions.
    """
    system = NLegPendulum((1.0, 1.0), (1e6, 1.0))
    theta, omega = np.array([[0.5, 1.0]]), np.array([[1.0, -2.0]])
    alpha = literal_accelerations(system, theta, omega)
    coupling = np.cos(theta[0, 0] - theta[0, 1])
    mass = np.array([[1e6 + 1.0, coupling], [coupling, 1.0]])
    norm = 1e-12 * np.linalg.norm(np.abs(mass) @ np.abs(alpha[0]))
    left = left_in_accelerations(system, amplitudes(system, "absolute"), theta, omega, alpha, 1e-12)[0]
    inverse = np.linalg.inv(mass)
    directions = np.random.default_rng(1).normal(size=(2, 1000))
    reached = np.abs(inverse @ (norm * directions / np.linalg.norm(directions, axis=0)))
    assert (reached.max(axis=1) <= left).all()
    # n of the largest link's torques may be the larger norm: ten times as much leaves room for that, and no more.
    assert (left <= 10 * norm * np.linalg.norm(inverse, axis=1)).all()


# Near rest the first steps of all schemes of an order are the same to rounding, and later ones are not. In the first
# an angle is zero that the engine has as a difference; the second turns so slowly that all its rates are nearly zero.
NEAR_REST = {
    "slow": (
        NLegPendulum(
            (
                35501.20885899796,
                41181.99565602456,
                14696.722358223951,
                33330.586981310196,
                3500.584929410877,
                59678.2424201904,
                6377.3606582165485,
                37847.40083750548,
            ),
            (
                0.0011401364260930054,
                0.0005271547210438288,
                0.002226265724795448,
                0.002060332458797265,
                0.003621539388508421,
                0.0005682312610250354,
                0.0026932881309600603,
                0.0008740280166206581,
            ),
            gravity=0.0,
        ),
        (
            0.11667498713615622,
            0.38542830026885705,
            0.0,
            -0.12500283876562984,
            0.0,
            -0.2444486996228659,
            0.0,
            0.19940533377056793,
        ),
        (
            6.733271219699611e-06,
            -8.346893143942823e-06,
            0.0,
            4.8056839033279645e-06,
            6.013163644703515e-06,
            0.0,
            5.889048362535161e-07,
            0.0,
        ),
        5.640723223729603,
    ),
    "straight": (
        RodChain((1.0, 1.1, 0.9, 1.2, 0.8), gravity=0.0),
        (0.0, -3e-292, 6e-292, 1e-293, -1e-292),
        (0.0, -2e-4, -1e-4, 9e-5, -5e-5),
        3.0,
    ),
}


@pytest.mark.parametrize("name", NEAR_REST)
@pytest.mark.parametrize("engine", STEPPING)
def test_near_rest_a_run_may_be_that_of_any_scheme_whose_first_step_is_the_same(make_cell, engine, name):
    system, theta, omega, duration = NEAR_REST[name]
    cell = make_cell(engine, Scene(name, system, theta, omega, duration))
    for result in (*trajectories.compare(cell), *energy.compare(cell)):
        assert (result.outcome, result.loose) == ("agrees", False), result


def test_a_step_may_be_that_of_any_scheme_within_the_proven_bound(make_cell):
    """Of a leg a hundred times shorter than the first: 3/8 rule and classical Runge-Kutta are 4e-15 rad/s apart in its
    rate, of which the proven bound explains 4e-14, and ten roundings as they are 1e-15. Exudyn's is the latter.
    """
    system = NLegPendulum(
        (5.67544700133484e-22, 3.838322299228545e-24, 5.0080959149773334e-23),
        (1.2480731588927749e30, 1.1154102428495624e30, 1.200739138436013e30),
        9.931839693377556e-24,
    )
    # The name is what random states follow from.
    runge_kutta, *_ = step_map.compare(make_cell("exudyn-tree", Scene("absurd-102-0", system), random_states=200))
    assert (runge_kutta.outcome, runge_kutta.loose) == ("agrees", False), runge_kutta


@pytest.mark.parametrize("engine", ["mujoco", "exudyn-tree"])
def test_a_run_is_that_of_one_scheme_where_steps_are_not_the_same_to_rounding(make_cell, engine):
    """Of a lively motion: the 3/8 rule, whose first step is another by 1e-9, would explain a wrong run too."""
    cell = make_cell(engine, "double-pendulum", 5)
    runge_kutta = next(one for one in cell.info.integrators if one.order == 4)
    theta, omega = (values[None] for values in cell.start)
    alpha = literal_accelerations(cell.scene.system, theta, omega)
    by = disturbed(cell, runge_kutta, theta, omega, alpha, 0.02)
    found = trajectories.schemes_of(cell, runge_kutta, theta, omega, 0.02, by)
    assert [candidate.scheme.name for candidate in found] == ["classical Runge-Kutta"]
