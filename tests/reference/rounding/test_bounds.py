"""Bounds of rounding hold for engines that are right, in scenes that bring out every sum that cancels."""

from dataclasses import replace

import numpy as np
import pytest

from furiko.checks.comparisons import accelerations, energy, joint_forces, symmetries, terms
from furiko.checks.registry import CHECKS as REGISTERED
from furiko.models import Link, NLegPendulum, PlanarTree, RodChain, Scene
from furiko.models.coordinates import absolute_from_relative
from furiko.reference import centrifugal_matrix
from furiko.reference.rounding import bounds as rounding
from furiko.reference.rounding import lever_arms as levers

TREES = ("mujoco", "pinocchio-aba", "pinocchio-crba", "exudyn-tree")
CHECKS = (accelerations, symmetries, terms, joint_forces, energy)
SYSTEMS = (
    NLegPendulum((1.0, 0.4, 0.7, 0.2), (1.0, 2.0, 0.5, 3.0)),
    RodChain((0.3, 1.0, 0.2, 0.6)),
)


def found(cell):
    """Every result, but of what the engine cannot give."""
    asked = (check for check in CHECKS if REGISTERED[check.NAME].needs not in cell.info.missing)
    return {result.check: result for check in asked for result in check.compare(cell)}


def differing(cell):
    return {check: result.reason for check, result in found(cell).items() if result.outcome == "differs"}


def placed(system, theta):
    """Hinges and centres of mass as complex numbers, down and to +x, one state."""
    hinges, centres = [], []
    for link, angle in zip(system.tree().links, theta, strict=True):
        if link.parent < 0:
            hinges.append(complex(*link.hinge))
        else:
            hinges.append(hinges[link.parent] + complex(*link.hinge) * np.exp(1j * theta[link.parent]))
        centres.append(hinges[-1] + complex(*link.com) * np.exp(1j * angle))
    return np.array(hinges), np.array(centres)


@pytest.mark.parametrize("system", SYSTEMS)
def test_no_configuration_reaches_beyond_an_arm(system):
    tree = system.tree()
    arm = levers.relative_levers(tree).arm
    carried = absolute_from_relative(tree.parents).T
    rng = np.random.default_rng(1)
    apart = []
    for theta in [np.zeros(system.n), *rng.uniform(-np.pi, np.pi, (50, system.n))]:
        hinges, centres = placed(system, theta)
        apart.append(np.abs(centres - hinges[:, None]) * carried)
    assert (np.max(apart, axis=0) <= arm * (1 + 1e-14)).all()
    np.testing.assert_allclose(apart[0], arm, rtol=1e-14)  # stretched out it is the arm


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
@pytest.mark.parametrize("system", SYSTEMS)
def test_amplitudes_are_not_below_what_they_are_amplitudes_of(system, coordinates):
    amplitude = rounding.amplitudes(system, coordinates)
    rng = np.random.default_rng(2)
    for _ in range(50):
        theta, omega = rng.uniform(-np.pi, np.pi, system.n), rng.normal(size=system.n)
        true = amplitude.residual(centrifugal_matrix(system, theta) @ omega**2)
        assert (np.abs(true) <= amplitude.velocity_terms(omega)).all()


def test_a_turning_rod_has_its_moment_of_inertia_in_its_row():
    """m = 2 kg, c = 1 m, I = 2/3 kg m² and 3 rad/s: of the terms in docs/theory/bounds.md m F U A is 18 N m and I F² is
    6 N m; V is zero, since the hinge is at rest. The second is never above a third of the first in the documents' rods.
    """
    amplitude = rounding.amplitudes(RodChain((2.0,)), "relative")
    np.testing.assert_allclose(amplitude.velocity_terms(np.array([[3.0]])), [[24.0]], rtol=1e-14)


def test_what_is_lost_below_the_smallest_number_grows_with_the_factors():
    """Two bobs of 5 kg and 1 kg on legs of 1 m: stretched out M is (9, 2; 2, 1) in hinge angles. A pivot is at least
    1 kg m², so that no entry of L, M = LᵀDL, is above √(9/1); stretched out it is 2.
    """
    amplitude = rounding.amplitudes(NLegPendulum((1.0, 1.0), (5.0, 1.0), 0.0), "relative")
    rates = np.array([[1e-160, 2e-160]])
    lost, grown = amplitude.underflow(rates), amplitude.solution_underflow(rates)
    np.testing.assert_allclose(grown / lost, 3.0, rtol=1e-14)


# A short link on a fast long one: the velocity of its hinge times its momentum, which cancel with themselves, are far
# above everything that is left in its row. A link's length in 1e4 shows it, and MuJoCo still takes the inertia.
SHORT_ON_LONG = Scene("short on long", NLegPendulum((1.0, 1e-4), (1.0, 1.0)), random=40)
SHORT_RODS = Scene("short rod on long", RodChain((1.0, 1.0, 1e-4)), random=40)


@pytest.mark.parametrize("scene", [SHORT_ON_LONG, SHORT_RODS])
@pytest.mark.parametrize("engine", TREES)
def test_a_short_link_on_a_fast_long_one(make_cell, engine, scene):
    assert differing(make_cell(engine, scene, random_states=40)) == {}


@pytest.mark.parametrize("system", SYSTEMS)
def test_no_configuration_reaches_beyond_an_arm_by_way_of_the_trees_centre(system):
    tree = system.tree()
    about, _ = levers.tree_levers(tree)
    carried = absolute_from_relative(tree.parents).T
    rng = np.random.default_rng(1)
    apart = []
    for theta in [np.zeros(system.n), *rng.uniform(-np.pi, np.pi, (50, system.n))]:
        hinges, centres = placed(system, theta)
        middle = np.average(centres, weights=system.masses)
        apart.append((np.abs(hinges - middle)[:, None] + np.abs(centres - middle)) * carried)
    assert (np.max(apart, axis=0) <= about.arm * (1 + 1e-14)).all()


# A bob of 1 kg at 2 m, and one of 3 kg at 3 m from it; the support's hinge is 1 m from the origin.
TWO_BOBS = PlanarTree(
    (Link(-1, (1.0, 0.0), 2.0, (2.0, 0.0), 1.0, 0.0), Link(0, (2.0, 0.0), 3.0, (3.0, 0.0), 3.0, 0.0)), 9.81
)


def test_lever_arms_of_two_bobs_by_hand():
    to_hinge, to_centre = levers.from_support(TWO_BOBS)
    np.testing.assert_array_equal(to_hinge, [1.0, 3.0])
    np.testing.assert_array_equal(to_centre, [3.0, 6.0])
    own = levers.relative_levers(TWO_BOBS)
    np.testing.assert_array_equal(own.arm, [[2.0, 5.0], [0.0, 3.0]])
    np.testing.assert_array_equal(own.to_point, [[0.0, 2.0], [0.0, 0.0]])
    # Weighed by 1/4 and 3/4: from hinge 1 to the bobs 2 and 5, from hinge 2 0 and 3, from bob 1 0 and 3, from bob 2 3
    # and 0. The mean of the paths is 17/4, 9/4, 9/4 and 3/4.
    about, placed = levers.tree_levers(TWO_BOBS)
    np.testing.assert_array_equal(about.arm, [[9 / 4 + 17 / 4, 3 / 4 + 17 / 4], [0.0, 3 / 4 + 9 / 4]])
    np.testing.assert_array_equal(about.to_point, [[17 / 4, 17 / 4], [0.0, 9 / 4]])
    # Points in the world are known to their path from the origin: each arm has a centre and a hinge in it.
    np.testing.assert_array_equal(placed.arm, [[3.0 + 1.0, 6.0 + 1.0], [0.0, 6.0 + 3.0]])
    np.testing.assert_array_equal(placed.to_point, [[1.0, 1.0], [0.0, 3.0]])
    world = levers.world_errors(TWO_BOBS)  # only the place of hinge 2 on link 1 is a difference
    np.testing.assert_array_equal(world.arm, [[0.0, 3.0], [0.0, 0.0]])


def test_lever_arms_about_the_origin_by_hand():
    """From hinge 1, at 1 m, to the origin and on to the bobs at 3 m and 6 m; from hinge 2, at 3 m, to the second."""
    about = levers.world_levers(TWO_BOBS)
    np.testing.assert_array_equal(about.arm, [[1 + 3.0, 1 + 6.0], [0.0, 3 + 6.0]])
    np.testing.assert_array_equal(about.to_point, [[1.0, 1.0], [0.0, 3.0]])


def test_lever_arms_beside_the_axis_by_hand():
    """Hinge 2 is at (3, 4) on link 1, its centre at (0, 4): 5 m and 4 m from hinge 1, and 3 m apart."""
    links = Link(-1, (0.0, 0.0), 5.0, (0.0, 4.0), 1.0, 0.0), Link(0, (3.0, 4.0), 1.0, (1.0, 0.0), 1.0, 0.0)
    path = levers.path_lengths(PlanarTree(links, 9.81))
    np.testing.assert_array_equal(path, [[0, 5, 4, 6], [5, 0, 3, 1], [4, 3, 0, 4], [6, 1, 4, 0]])


def test_ways_along_the_links_of_a_branching_tree():
    # A leg of 3 and one of 4 at the end of one of 2, each with its centre of mass at its end.
    way = levers.path_lengths(NLegPendulum((2.0, 3.0, 4.0), (1.0, 1.0, 1.0)).tree())
    hinges, centres = way[:3, :3], way[3:, 3:]
    np.testing.assert_array_equal(hinges, [[0, 2, 2], [2, 0, 0], [2, 0, 0]])
    np.testing.assert_array_equal(centres, [[0, 3, 4], [3, 0, 7], [4, 7, 0]])
    np.testing.assert_array_equal(way[:3, 3:], [[2, 5, 6], [0, 3, 4], [0, 3, 4]])


def test_trees_that_share_nothing_but_the_support_have_their_own_centres():
    tree = SYSTEMS[0].tree()
    beside = tuple(replace(link, parent=link.parent + tree.n if link.parent >= 0 else -1) for link in tree.links)
    alone, together = levers.tree_levers(tree), levers.tree_levers(replace(tree, links=tree.links + beside))
    for one, both in zip(alone, together, strict=True):
        np.testing.assert_allclose(both.arm, np.kron(np.eye(2), one.arm), rtol=1e-14)
        np.testing.assert_allclose(both.to_point, np.kron(np.eye(2), one.to_point), rtol=1e-14)


def test_mujoco_takes_moments_about_the_whole_trees_centre_of_mass(make_cell):
    cell = make_cell("mujoco", SHORT_RODS, random_states=40)
    elsewhere = replace(cell, info=replace(cell.info, moments="hinge"))
    assert {"terms M", "terms G", "accelerations"} <= set(differing(elsewhere))


# The centre of mass of the whole is almost that of the short link, but all that is known of its place in the world is
# known to 1e-16 of the long one's length.
HEAVY_AT_THE_END = Scene("heavy at the end", NLegPendulum((1.0, 1e-4), (1e-6, 1.0)), random=40)


@pytest.mark.parametrize("engine", TREES)
def test_a_heavy_short_link_at_the_end_of_a_light_long_one(make_cell, engine):
    assert differing(make_cell(engine, HEAVY_AT_THE_END, random_states=40)) == {}


@pytest.fixture
def fresh_amplitudes():
    """None kept from before where their making is changed, and none from then on."""
    rounding.amplitudes.cache_clear()
    yield
    rounding.amplitudes.cache_clear()


def test_mujoco_places_links_in_the_world(make_cell, monkeypatch, fresh_amplitudes):
    monkeypatch.setattr(rounding, "tree_levers", lambda tree: (levers.tree_levers(tree)[0], None))
    assert "terms M" in differing(make_cell("mujoco", HEAVY_AT_THE_END, random_states=40))


@pytest.mark.parametrize("engine", TREES)
def test_a_product_of_rates_that_is_not_there_is_found_behind_all_that_cancels(make_cell, engine):
    cell = make_cell(engine, SHORT_RODS, random_states=40)
    right = cell.engine.inverse_dynamics

    def wrong(theta, omega, alpha, *, gravity=True):
        torque = right(theta, omega, alpha, gravity=gravity)
        torque[..., 2] += 1e-9 * omega[..., 1] * omega[..., 2]
        return torque

    cell.engine.inverse_dynamics = wrong
    assert set(differing(cell)) == {"terms velocity"}


LEGS = NLegPendulum((1.0, 0.3, 0.5), (1.0, 2.0, 0.7))
MANY_TURNS = Scene("many turns", LEGS, (501.1, -377.7, 90.9), (0.3, -2.1, 0.9))


@pytest.mark.parametrize("engine", TREES)
def test_differences_of_angles_of_many_turns_are_rounded(make_cell, engine):
    assert differing(make_cell(engine, MANY_TURNS, random_states=3)) == {}


def test_without_that_they_are_taken_for_a_difference(make_cell, monkeypatch):
    monkeypatch.setattr(terms, "turns", lambda theta: np.ones(len(theta)))
    assert "terms G" in differing(make_cell("pinocchio-aba", MANY_TURNS, random_states=3))


def test_angles_whose_differences_are_exact_raise_no_bound():
    exact = np.array([0.0, np.pi, 7.5, 2.0**12 - 2.0**-40])
    rounded = np.array([3.1, 31.1, 2.0**12 + 0.1])
    np.testing.assert_array_equal(rounding.turns(exact[:, None]), 1)
    np.testing.assert_array_equal(rounding.turns(rounded[:, None]), [1, *rounded[1:] / np.pi])


def slow(rate):
    """Two legs without gravity of which one moves so slowly that squared rates lose digits, or all of them."""
    return Scene("slow", NLegPendulum((1.0, 0.8), (1.0, 0.5), 0.0), (0.3, 1.4), (0.0, rate), random=0)


@pytest.mark.parametrize("rate", [1e-150, 1e-155, 4.36e-156, 1e-158, 1e-160, 1e-162, 1e-300])
@pytest.mark.parametrize("engine", TREES)
def test_products_below_the_smallest_normal_number(make_cell, engine, rate):
    assert differing(make_cell(engine, slow(rate), random_states=0)) == {}


def test_a_product_that_is_not_lost_is_compared(make_cell):
    cell = make_cell("pinocchio-aba", slow(1e-150), random_states=0)
    right = cell.engine.accelerations
    cell.engine.accelerations = lambda theta, omega: right(theta, omega) * (1 + 1e-6)
    assert "accelerations" in differing(cell)


@pytest.mark.parametrize("scale", [1e-30, 1e30])
@pytest.mark.parametrize("engine", ["pinocchio-aba", "pinocchio-crba", "exudyn-tree"])
def test_what_is_lost_is_multiplied_by_masses_and_lengths(make_cell, engine, scale):
    legs = NLegPendulum((scale, 0.8 * scale, 0.7 * scale), (1e30, 0.5e30, 1e28), 0.0)
    scene = Scene("heavy", legs, (0.3, 1.4, 2.0), (1e-161, 3e-161, -2e-161), random=0)
    assert differing(make_cell(engine, scene, random_states=0)) == {}


def without(cell, **fields):
    """The same cell, as if the engine's info did not say what it does."""
    return replace(cell, info=replace(cell.info, **fields))


# Legs of which some are 1e5 times shorter: eliminating a long one's row with a short one's as its pivot leaves the
# rounding of large entries in a row of small ones.
UNLIKE_LEGS = Scene("unlike", NLegPendulum((0.4, 7e-5, 1.5e-3, 2.5e-6), (15.0, 5e-7, 0.8, 0.2)), random=40)


def test_rows_that_are_interchanged_share_their_rounding(make_cell):
    cell = make_cell("exudyn-tree", UNLIKE_LEGS, random_states=40)
    assert differing(cell) == {}
    assert "accelerations" in differing(without(cell, interchanges=False))


def test_factors_with_rows_interchanged():
    # The second row is the pivot's: L = [[1, 0], [2^-4, 1]], U = [[1, 1], [0, 1 - 2^-4]] of the rows turned round.
    matrix = np.array([[2.0**-4, 1.0], [1.0, 1.0]])
    straight = np.array([[1.0, 2.0**-4], [2.0**-4, 1.0]])
    found = rounding.interchanged(np.stack([matrix, straight, np.zeros((2, 2))]))
    np.testing.assert_array_equal(found[0], [[2.0**-4, 1.0], [1.0, 1.0]])
    np.testing.assert_array_equal(found[1], [[1.0, 2.0**-4], [2.0**-4, 1.0]])
    np.testing.assert_array_equal(found[2], 0)


def test_links_placed_in_the_world(make_cell):
    tail = Scene("tail", RodChain((1.0, 1e-6, 1e-6), 1e6), random=40)
    cell = make_cell("pinocchio-aba-mjcf", tail, random_states=40)
    assert differing(cell) == {}
    assert "terms M" in differing(without(cell, placed="parent"))
    assert differing(make_cell("pinocchio-aba", tail, random_states=40)) == {}


NEARLY_SINGULAR = RodChain((1e-8, 1e-10, 0.1), 5e3)


@pytest.mark.parametrize("engine", ["pinocchio-aba", "pinocchio-crba", "exudyn-tree"])
def test_no_acceleration_is_asked_for_where_the_mass_matrix_is_singular_but_for_rounding(make_cell, engine):
    results = found(make_cell(engine, Scene("nearly singular", NEARLY_SINGULAR, random=40), random_states=40))
    for check in ("accelerations", "symmetry"):
        assert results[check].outcome == "skipped"
        assert "singular" in results[check].reason
    assert {results[f"terms {term}"].outcome for term in "MCG"} == {"agrees"}


def test_the_states_in_which_it_is_not_are_compared(make_cell, monkeypatch):
    cell = make_cell("pinocchio-crba", "n-leg-3", random_states=5)
    kept = np.arange(len(cell.states)) % 2 == 0
    monkeypatch.setattr(rounding.Amplitudes, "regular", lambda self, mass, accuracy: kept)
    (result,) = accelerations.compare(cell)
    assert (result.outcome, result.details["states"]) == ("agrees", int(kept.sum()))
    assert result.details["states left out"] == int((~kept).sum())
