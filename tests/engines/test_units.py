"""Equations of motion have no units of their own: a mechanism in other units moves, bit by bit, the same."""

import numpy as np
import pytest

from furiko.engines import ENGINES, load_engine
from furiko.models import NLegPendulum, RodChain
from furiko.models.units import Units, in_units, units_of

# A tenth of a micrometre and a tenth of a microgram, and a year: powers of two, so that the numbers' digits are kept.
LENGTH, MASS, TIME = 2.0**-23, 2.0**-33, 2.0**25
SYSTEMS = [RodChain((1.0, 0.7, 0.4), 1.5), NLegPendulum((1.0, 0.5, 1.6), (2.0, 0.3, 0.7)), RodChain((0.8,), 1.0, 0.0)]
EXUDYN = ["exudyn-tree", "exudyn-redundant"]
THETA, OMEGA = np.array([0.5, -1.25, 2.0]), np.array([0.75, 2.0, -1.5])


def small(system):
    """The same mechanism with its lengths, masses and times multiplied by those above."""
    lengths, gravity = tuple(LENGTH * l for l in system.lengths), system.gravity * LENGTH / TIME**2
    if system.kind == "rod-chain":
        return RodChain(lengths, system.density * MASS / LENGTH, gravity)
    return NLegPendulum(lengths, tuple(MASS * m for m in system.masses), gravity)


@pytest.mark.parametrize("name", EXUDYN)
@pytest.mark.parametrize("system", SYSTEMS, ids=["rods", "legs", "weightless"])
def test_motions_do_not_depend_on_units(name, system):
    one, other = load_engine(name, system), load_engine(name, small(system))
    theta, omega = THETA[: system.n], OMEGA[: system.n]
    for integrator in ENGINES[name].integrators:
        angles, rates = one.trajectory(theta, omega, integrator.name, 1 / 64, 50)
        slow_angles, slow_rates = other.trajectory(theta, omega / TIME, integrator.name, TIME / 64, 50)
        assert np.isfinite(angles).all()
        np.testing.assert_array_equal(slow_angles, angles)
        np.testing.assert_array_equal(slow_rates * TIME, rates)


@pytest.mark.parametrize("name", EXUDYN)
@pytest.mark.parametrize("system", SYSTEMS, ids=["rods", "legs", "weightless"])
def test_what_holds_at_an_instant_does_not_depend_on_units(name, system):
    one, other = load_engine(name, system), load_engine(name, small(system))
    theta, omega = THETA[None, : system.n], OMEGA[None, : system.n]
    force = MASS * LENGTH / TIME**2
    alpha = one.accelerations(theta, omega)
    np.testing.assert_array_equal(other.accelerations(theta, omega / TIME) * TIME**2, alpha)
    np.testing.assert_array_equal(other.energy(theta, omega / TIME) / (force * LENGTH), one.energy(theta, omega))
    if name == "exudyn-tree":
        torques = other.inverse_dynamics(theta, omega / TIME, alpha / TIME**2) / (force * LENGTH)
        np.testing.assert_array_equal(torques, one.inverse_dynamics(theta, omega, alpha))
    else:
        forces = other.joint_forces(theta, omega / TIME, alpha / TIME**2) / force
        np.testing.assert_array_equal(forces, one.joint_forces(theta, omega, alpha))


def test_fitting_units_are_powers_of_two_near_the_largest():
    tree = NLegPendulum((3.0, 0.1), (0.2, 0.7)).tree()
    assert units_of(tree) == Units(length=2.0, mass=0.5)
    assert Units(2.0, 0.5).fitting(0.0, np.array([0.1, -5.0])).time == 0.25
    assert Units(2.0, 0.5).fitting(32.0, np.array([0.1])).time == 0.25  # √(32/2) = 4 rad/s
    assert Units(2.0, 0.5).fitting(0.0, np.array([0.0])).time == 1.0  # nothing moves, nothing makes it move
    # A run of steps of a second that moves by 1e-9 rad in each: a step is a millionth of the unit, not a billionth.
    assert Units(2.0, 0.5).fitting(0.0, np.array([1e-9]), step=1.0).time == 2.0**20


def test_units_of_what_is_derived():
    units = Units(length=2.0, mass=8.0, time=4.0)
    assert (units.acceleration, units.force, units.energy, units.inertia) == (0.125, 1.0, 2.0, 32.0)


def test_a_tree_in_its_units_is_the_same_tree():
    tree = RodChain((6.0, 3.0), 2.0, 9.0).tree()  # 12 and 6 kg
    units = Units(length=2.0, mass=4.0, time=0.5)
    changed = in_units(tree, units)
    assert changed.gravity == 9.0 / 8  # a metre over a second squared is half a length over four of the units of time
    assert [link.mass for link in changed.links] == [3.0, 1.5]
    assert [link.length for link in changed.links] == [3.0, 1.5]
    assert changed.links[1].hinge == (3.0, 0.0)
    assert changed.links[0].com == (1.5, 0.0)
    assert changed.links[0].inertia == 3.0 * 3.0**2 / 12


def test_rates_too_large_for_seconds_are_infinite():
    rates = Units(1.0, 1.0, time=2.0**-1000).in_seconds(np.array([2.0**100, 2.0]))
    np.testing.assert_array_equal(rates, [np.inf, 2.0**1001])
