"""Schemes against the theory of order, closed solutions, and the mechanism in other coordinates."""

from dataclasses import replace
from itertools import combinations_with_replacement

import numpy as np
import pytest

from furiko.models import NLegPendulum, RodChain
from furiko.reference import literal_accelerations
from furiko.reference.integration import schemes
from furiko.reference.integration.schemes import BUTCHER_6, CLASSICAL, DORMAND_PRINCE, SCHEMES, THREE_EIGHTHS, Tableau
from furiko.reference.maximal_coordinates import MaximalCoordinates, generalized_alpha_index_3, trapezoidal_index_2

TABLEAUX = {CLASSICAL: 4, THREE_EIGHTHS: 4, DORMAND_PRINCE: 5, BUTCHER_6: 6}
WIDE = np.longdouble


def rooted_trees(order):
    """All rooted trees with so many nodes, each as the sorted tuple of its root's subtrees."""
    if order == 1:
        return [()]
    found = set()
    for sizes in partitions(order - 1):
        for choice in choices(sizes):
            found.add(tuple(sorted(choice)))
    return sorted(found)


def partitions(total, largest=None):
    largest = largest or total
    if total == 0:
        return [()]
    return [(k, *rest) for k in range(min(total, largest), 0, -1) for rest in partitions(total - k, k)]


def choices(sizes):
    if not sizes:
        return [()]
    count = sizes.count(sizes[0])
    heads = combinations_with_replacement(rooted_trees(sizes[0]), count)
    return [(*head, *rest) for head in heads for rest in choices(sizes[count:])]


def nodes(tree):
    return 1 + sum(map(nodes, tree))


def density(tree):
    return nodes(tree) * np.prod([density(sub) for sub in tree], dtype=float)


def stage_weights(matrix, tree):
    product = np.ones(len(matrix), WIDE)
    for sub in tree:
        product = product * (matrix @ stage_weights(matrix, sub))
    return product


def order_defect(tableau, order):
    """The largest failure of Butcher's conditions Σ b_i Φ_i(t) = 1/γ(t) over all trees with up to ``order`` nodes."""
    matrix = np.array([[*row, *[0] * (len(tableau.rows) - len(row))] for row in tableau.rows], WIDE)
    weights = np.array(tableau.weights, WIDE)
    trees = [tree for k in range(1, order + 1) for tree in rooted_trees(k)]
    return max(abs(float(weights @ stage_weights(matrix, tree) - 1 / WIDE(density(tree)))) for tree in trees)


def test_there_are_as_many_trees_as_there_should_be():
    assert [len(rooted_trees(k)) for k in range(1, 8)] == [1, 1, 2, 4, 9, 20, 48]  # OEIS A000081


@pytest.mark.parametrize(("tableau", "order"), TABLEAUX.items(), ids=["classical", "3/8", "Dormand-Prince", "Butcher"])
def test_runge_kutta_schemes_fulfil_the_conditions_of_their_order_and_of_no_higher(tableau, order):
    assert order_defect(tableau, order) < 1e-17  # sums of a few terms of size 5 with 64 bits
    assert order_defect(tableau, order + 1) > 1e-5


@pytest.mark.parametrize("tableau", TABLEAUX)
def test_a_misprinted_coefficient_breaks_the_conditions(tableau):
    for i, row in enumerate(tableau.rows):
        for j in range(i):
            wrong = (*row[:j], row[j] + WIDE(1e-6), *row[j + 1 :])
            rows = (*tableau.rows[:i], wrong, *tableau.rows[i + 1 :])
            # A coefficient that no condition sees has no business there; weights of 1/12 and more let 1e-9 through.
            assert order_defect(replace(tableau, rows=rows), TABLEAUX[tableau]) > 1e-9, (i, j)


def test_weights_that_do_not_sum_to_one_are_refused():
    with pytest.raises(ValueError, match="sum to"):
        Tableau(((), (0.5,)), (0.5, 0.4))


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_every_scheme_has_the_order_it_is_said_to_have(scheme):
    # θ = tan t solves θ̈ = 2 θ θ̇, accelerations that depend on angle and rate.
    def local_error(h):
        theta, omega = scheme.step(lambda t, w: 2 * t * w, WIDE(0.3) * np.ones(1), np.ones(1) * WIDE(1.09), WIDE(h))
        end = np.tan(np.arctan(WIDE(0.3)) + h)
        return max(abs(theta[0] - end), abs(omega[0] - (1 + end**2)))

    h = 1 / 256 if scheme.order < 5 else 1 / 24
    order = np.log2(float(local_error(h) / local_error(h / 2))) - 1
    # From true accelerations the generalized-α scheme's first step, alone, loses an order: ã lags behind them.
    if scheme.name == "generalized-α, ρ∞ = 0.9":
        order += 1
    # The next power's share of the error is of the size of the step times ten or so.
    assert order == pytest.approx(scheme.order, abs=0.2 if scheme.order < 5 else 0.5)


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_relative_and_absolute_angles_give_the_same_step(scheme):
    system = RodChain([1.0, 0.6, 0.8])
    S = np.tril(np.ones((3, 3), WIDE))  # θ = S q
    theta, omega = np.array([0.4, 2.0, -1.0], WIDE), np.array([1.0, -3.0, 2.0], WIDE)

    def absolute(t, w):
        return literal_accelerations(system, t, w)

    def relative(q, v):
        return np.linalg.inv(S.astype(float)).astype(WIDE) @ absolute(S @ q, S @ v)

    q, v = (np.linalg.inv(S.astype(float)).astype(WIDE) @ x for x in (theta, omega))
    here, there = scheme.step(absolute, theta, omega, WIDE(1e-2)), scheme.step(relative, q, v, WIDE(1e-2))
    for one, other in zip(here, there, strict=True):
        np.testing.assert_allclose(one.astype(float), (S @ other).astype(float), rtol=1e-15)


def test_generalized_alpha_hands_its_algorithmic_accelerations_on():
    """On θ̈ = -θ each step is three linear equations in Chung and Hulbert's own form: a_{1-α_m} = -d_{1-α_f}."""
    radius, h = 0.9, 0.25
    alpha_m, alpha_f = (2 * radius - 1) / (radius + 1), radius / (radius + 1)
    gamma, beta = 0.5 - alpha_m + alpha_f, 0.25 * (1 - alpha_m + alpha_f) ** 2
    left = np.array([[1, 0, -h * h * beta], [0, 1, -h * gamma], [1 - alpha_f, 0, 1 - alpha_m]])
    right = np.array([[1, h, h * h * (0.5 - beta)], [0, 1, h * (1 - gamma)], [-alpha_f, 0, -alpha_m]])
    state = np.array([0.7, -0.4, -0.7])  # it starts from a = -θ
    for _ in range(5):
        state = np.linalg.solve(left, right @ state)
    (scheme,) = (scheme for scheme in SCHEMES if scheme.name == "generalized-α, ρ∞ = 0.9")
    start = np.array([WIDE("0.7")]), np.array([WIDE("-0.4")])
    theta, omega = schemes.run(scheme, lambda t, w: -t, *start, WIDE(h), 5)
    # A few roundings a step in the comparison's double precision.
    np.testing.assert_allclose([float(theta[0]), float(omega[0])], state[:2], rtol=0, atol=1e-14)
    again = start
    for _ in range(5):  # as if every step were the first: another motion
        again = scheme.step(lambda t, w: -t, *again, WIDE(h))
    assert abs(float(again[0][0] - theta[0])) > 1e-4


@pytest.mark.parametrize("name", ["classical Runge-Kutta", "trapezoidal rule (Newmark β = 1/4, γ = 1/2)"])
def test_several_steps_of_a_scheme_that_forgets_are_one_after_the_other(name):
    (scheme,) = (scheme for scheme in SCHEMES if scheme.name == name)
    state = np.array([WIDE("0.7")]), np.array([WIDE("-0.4")])
    found = schemes.run(scheme, lambda t, w: -t - w, *state, WIDE(0.125), 3)
    for _ in range(3):
        state = scheme.step(lambda t, w: -t - w, *state, WIDE(0.125))
    np.testing.assert_allclose(np.float64(found), np.float64(state), rtol=1e-15)


def test_a_step_too_long_for_an_implicit_scheme_is_refused():
    with pytest.raises(ArithmeticError, match="too long"):
        schemes.implicit_euler(lambda t, w: -1e6 * t, np.ones(1), np.zeros(1), 1.0)


SYSTEMS = [RodChain([0.7]), RodChain([1.0, 0.6, 0.8]), NLegPendulum([1.0, 0.5, 0.8], [1.0, 2.0, 0.3])]


def a_state(system):
    generator = np.random.default_rng(3)
    return generator.uniform(-2, 2, (2, system.n)).astype(WIDE)


@pytest.mark.parametrize("system", SYSTEMS)
def test_maximal_coordinates_describe_the_same_motion(system):
    bodies, (theta, omega) = MaximalCoordinates(system.tree()), a_state(system)
    q, v = bodies.state(theta, omega)
    np.testing.assert_allclose(bodies.constraint(q).astype(float), 0, atol=1e-18)
    np.testing.assert_allclose((bodies.jacobian(q) @ v).astype(float), 0, atol=1e-17)
    expected = literal_accelerations(system, theta, omega)
    # Newton's iterations end at ten digits and gain ten more with the last one.
    np.testing.assert_allclose(bodies.accelerations(q, v)[2::3].astype(float), expected.astype(float), rtol=1e-15)


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_jacobian_is_the_constraints_derivative(system):
    bodies, (theta, omega) = MaximalCoordinates(system.tree()), a_state(system)
    q, v = bodies.state(theta, omega)
    step = WIDE(2.0**-20)
    for k, column in enumerate(bodies.jacobian(q).T):
        d = step * np.eye(len(q))[k]
        quotient = (bodies.constraint(q + d) - bodies.constraint(q - d)) / (2 * step)
        np.testing.assert_allclose(column.astype(float), quotient.astype(float), atol=1e-11)  # step² = 1e-12
    d = step * v
    turning = (bodies.jacobian(q + d) @ v - bodies.jacobian(q - d) @ v) / (2 * step)
    np.testing.assert_allclose(bodies.constraint_bias(q, v).astype(float), turning.astype(float), atol=1e-10)


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("step", [lambda *a: generalized_alpha_index_3(*a, WIDE("0.9")), trapezoidal_index_2])
def test_schemes_in_maximal_coordinates_have_a_local_error_of_third_order_in_the_angles(system, step):
    bodies, (theta, omega) = MaximalCoordinates(system.tree()), a_state(system)

    def error(h):
        true = theta, omega
        for _ in range(8):
            true = BUTCHER_6.step(lambda t, w: literal_accelerations(system, t, w), *true, WIDE(h) / 8)
        return float(np.abs(step(bodies, theta, omega, WIDE(h))[0] - true[0]).max())

    assert np.log2(error(2**-9) / error(2**-10)) == pytest.approx(3, abs=0.2)


@pytest.mark.parametrize(
    ("steps", "order"),
    [(lambda *a: generalized_alpha_index_3(*a[:-1], WIDE("0.9"), a[-1]), 2), (trapezoidal_index_2, 2)],
)
def test_runs_in_maximal_coordinates_converge_with_second_order(steps, order):
    """As they do only if accelerations are handed on: generalized-α from true ones at every step is of first order."""
    system = NLegPendulum([1.0, 0.5, 0.8], [1.0, 2.0, 0.3])
    bodies, (theta, omega) = MaximalCoordinates(system.tree()), a_state(system)

    def error(count):
        true = theta, omega
        for _ in range(64):
            true = BUTCHER_6.step(lambda t, w: literal_accelerations(system, t, w), *true, WIDE(1) / 512)
        return float(np.abs(steps(bodies, theta, omega, WIDE(1) / (8 * count), count)[0] - true[0]).max())

    assert np.log2(error(16) / error(32)) == pytest.approx(order, abs=0.2)


def test_the_classical_step_is_the_classical_tableaus():
    system = NLegPendulum((1.0, 0.5), (1.0, 2.0))
    theta, omega = np.random.default_rng(4).uniform(-2, 2, (2, 2))

    def slope(_, state):
        return np.stack([state[1], literal_accelerations(system, *state)])

    found = schemes.classical_step(slope, np.stack([theta, omega]), 0.01)
    expected = CLASSICAL.step(lambda t, w: literal_accelerations(system, t, w), theta, omega, 0.01)
    np.testing.assert_allclose(found, expected, rtol=0, atol=8 * np.finfo(float).eps * np.abs(found).max())


def test_the_classical_step_tells_the_slope_its_place_in_the_step():
    """ẏ = 4 t³ from t = 1 to 3: Simpson's rule is exact."""
    found = schemes.classical_step(lambda part, y: 4 * (1 + 2 * part) ** 3 + 0 * y, np.array([1.0]), 2.0)
    assert found == pytest.approx([81.0], rel=1e-15)
