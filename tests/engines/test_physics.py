"""Each engine against first principles: closed forms, virtual work in ball arithmetic, and one another."""

import numpy as np
import pytest

from furiko.engines import ENGINES, load_engine
from furiko.models import NLegPendulum, RodChain

EPS = 2.0**-52


def states(seed, n, rows=20):
    """Angles and rates in multiples of 2^-40, which differences do not round."""
    rng = np.random.default_rng(seed)
    theta, omega, alpha = (
        rng.uniform(-np.pi, np.pi, (rows, n)),
        rng.normal(0, 3, (rows, n)),
        rng.normal(0, 9, (rows, n)),
    )
    return tuple(np.round(x * 2.0**40) * 2.0**-40 for x in (theta, omega, alpha))


def able(engine, quantity):
    if quantity in ENGINES[engine].missing:
        pytest.skip(ENGINES[engine].missing[quantity])


def test_a_swinging_rod(engine):
    length, gravity = 0.7, 9.81
    theta, omega, _ = states(1, 1, rows=100)
    found = load_engine(engine, RodChain((length,), 1.3, gravity)).accelerations(theta, omega)
    # θ̈ = -3g/(2l) sin θ: a dozen operations of the engine, and its sine of an angle up to π, to half a unit each.
    np.testing.assert_allclose(found, -3 * gravity / (2 * length) * np.sin(theta), rtol=0, atol=20 * EPS * 21.1)


def test_the_double_pendulum(engine):
    (l1, l2), (m1, m2), g = (1.0, 0.6), (0.8, 1.7), 9.81
    theta, omega, _ = states(2, 2, rows=100)
    found = load_engine(engine, NLegPendulum((l1, l2), (m1, m2), g)).accelerations(theta, omega)
    (t1, t2), (w1, w2) = np.longdouble(theta).T, np.longdouble(omega).T
    # The textbook's two equations, solved by Cramer's rule in extended precision.
    a11, a12, a22 = (m1 + m2) * l1, m2 * l2 * np.cos(t1 - t2), l2
    a21 = l1 * np.cos(t1 - t2)
    b1 = -m2 * l2 * w2**2 * np.sin(t1 - t2) - (m1 + m2) * g * np.sin(t1)
    b2 = l1 * w1**2 * np.sin(t1 - t2) - g * np.sin(t2)
    expected = np.stack([b1 * a22 - a12 * b2, a11 * b2 - a21 * b1], axis=1) / (a11 * a22 - a12 * a21)[:, None]
    worst = np.abs(found - expected).max() / np.abs(expected).max()
    assert worst < 100 * EPS  # condition number about 10, ten roundings


@pytest.mark.parametrize("system", [f"tree-{seed}" for seed in range(4)] + ["n-leg", "rods"])
def test_accelerations_of_any_tree(engine, system, any_tree, virtual_work):
    mechanism = _mechanism(system, any_tree)
    n = mechanism.n
    theta, omega, _ = states(3, n, rows=10)
    found = load_engine(engine, mechanism).accelerations(theta, omega)
    expected = [virtual_work(mechanism.tree(), t, w) for t, w in zip(theta, omega, strict=True)]
    for row, truth in zip(found, expected, strict=True):
        # A stable solution of n equations: n roundings times the matrix's condition, here at most in the relative
        # coordinates that most engines solve in; ten for the roundings of the right-hand side, sums of as many terms.
        relative = _path_matrix(mechanism.tree()).T @ truth.mass_matrix @ _path_matrix(mechanism.tree())
        allowed = 10 * n * EPS * np.linalg.cond(relative)
        assert np.abs(row - truth.accelerations).max() <= allowed * np.abs(truth.accelerations).max()


@pytest.mark.parametrize("system", ["tree-0", "tree-1", "n-leg", "rods"])
@pytest.mark.parametrize("gravity", [True, False])
def test_forces_for_given_accelerations(engine, system, gravity, any_tree, virtual_work):
    able(engine, "inverse_dynamics")
    mechanism = _mechanism(system, any_tree)
    theta, omega, alpha = states(4, mechanism.n, rows=10)
    found = load_engine(engine, mechanism).inverse_dynamics(theta, omega, alpha, gravity=gravity)
    for row, t, w, a in zip(found, theta, omega, alpha, strict=True):
        truth = virtual_work(mechanism.tree(), t, w)
        expected = truth.mass_matrix @ a + truth.velocity_terms + gravity * truth.weight_terms
        size = np.abs(truth.mass_matrix) @ np.abs(a) + np.abs(truth.velocity_terms) + np.abs(truth.weight_terms)
        # Sums over n links of terms up to `size`, formed in relative coordinates, that is from sums of n angles' parts.
        assert np.abs(row - expected).max() <= 10 * mechanism.n * EPS * size.max()


def test_rows_that_share_a_place_or_a_state_are_answered_as_each_alone(engine):
    """An adapter may ask its engine once for what such rows share; here neighbours share one, both or nothing."""
    able(engine, "inverse_dynamics")
    adapter = load_engine(engine, RodChain((1.0, 0.5)))
    angles, rates = [[0.3, 1.0], [0.8, -2.0]], [[0.0, 0.0], [1.0, 2.0]]
    shared = ((0, 0, 1), (0, 0, 0), (0, 1, 1), (1, 1, 1), (0, 1, 1))
    rows = np.array([[angles[i], rates[j], rates[k]] for i, j, k in shared])
    theta, omega, alpha = rows.swapaxes(0, 1)
    for gravity in (True, False):
        alone = [adapter.inverse_dynamics(*row, gravity=gravity) for row in rows]
        assert (adapter.inverse_dynamics(theta, omega, alpha, gravity=gravity) == alone).all()


@pytest.mark.parametrize("lengths", [(5e-7,), (5e-7, 1e-7, 1e-3), (1e-3, 2e-6, 1e-7)])
def test_mujoco_keeps_centres_of_mass_that_are_near_the_hinge(lengths, virtual_work):
    chain = RodChain(lengths, density=1e15)
    theta, omega, _ = states(11, chain.n, rows=10)
    adapter = load_engine("mujoco", chain)
    found = adapter.inverse_dynamics(theta, omega, 0 * theta)
    swinging = adapter.accelerations(theta, omega)
    for row, alpha, t, w in zip(found, swinging, theta, omega, strict=True):
        truth = virtual_work(chain.tree(), t, w)
        size = np.abs(truth.velocity_terms) + np.abs(truth.weight_terms)
        # Far from the tree's centre of mass roundings are of all the weight and length there is.
        assert np.abs(row - truth.velocity_terms - truth.weight_terms).max() <= 100 * EPS * size.max()
        allowed = 100 * EPS * np.linalg.cond(truth.mass_matrix)
        assert np.abs(alpha - truth.accelerations).max() <= allowed * np.abs(truth.accelerations).max()


def test_forces_and_accelerations_are_inverse_to_each_other(engine, any_tree):
    able(engine, "inverse_dynamics")
    mechanism = any_tree(7, 5)
    adapter = load_engine(engine, mechanism)
    theta, omega, _ = states(5, 5)
    left = adapter.inverse_dynamics(theta, omega, adapter.accelerations(theta, omega))
    weights = adapter.inverse_dynamics(theta, omega, 0 * theta)
    assert np.abs(left).max() < 1000 * EPS * np.abs(weights).max()  # condition number of five links: below a hundred


def test_a_hanging_chain_carries_the_weight_below(engine):
    able(engine, "joint_forces")
    chain = RodChain((0.5, 0.7, 0.2, 1.1), density=1.3, gravity=9.81)
    rest = np.zeros(4)
    found = load_engine(engine, chain).joint_forces(rest, rest, rest)
    below = -np.cumsum(chain.masses[::-1])[::-1] * chain.gravity
    np.testing.assert_allclose(found, np.stack([rest, below], axis=1), rtol=0, atol=4 * EPS * abs(below[0]))


@pytest.mark.parametrize("system", ["tree-0", "tree-1", "tree-2", "n-leg", "rods"])
def test_joint_forces_in_motion(engine, system, any_tree, virtual_work):
    able(engine, "joint_forces")
    mechanism = _mechanism(system, any_tree)
    theta, omega, alpha = states(6, mechanism.n, rows=10)
    adapter = load_engine(engine, mechanism)
    if engine == "exudyn-redundant":  # it gives those of its own accelerations
        alpha = adapter.accelerations(theta, omega)
    found = adapter.joint_forces(theta, omega, alpha)
    for row, t, w, a in zip(found, theta, omega, alpha, strict=True):
        expected = virtual_work(mechanism.tree(), t, w).joint_forces(a)
        # Newton's law summed over n links; where they come with the accelerations, these are rounded like a solution.
        assert np.abs(row - expected).max() <= 50 * mechanism.n * EPS * np.abs(expected).max()


@pytest.mark.parametrize("system", ["tree-0", "tree-1", "n-leg", "rods"])
def test_energy(engine, system, any_tree, virtual_work):
    mechanism = _mechanism(system, any_tree)
    theta, omega, _ = states(8, mechanism.n, rows=10)
    found = load_engine(engine, mechanism).energy(theta, omega)
    highest = sum(mechanism.masses) * mechanism.gravity * sum(mechanism.lengths)
    for row, t, w in zip(found, theta, omega, strict=True):
        kinetic, potential = virtual_work(mechanism.tree(), t, w).energy
        assert abs(row[0] - kinetic) <= 10 * mechanism.n * EPS * kinetic  # a sum of squares
        assert abs(row[1] - potential) <= 10 * mechanism.n * EPS * highest  # a sum of heights of either sign


def test_the_same_state_gives_the_same_answer_whatever_was_asked_before(engine):
    chain = RodChain((0.5, 0.7, 0.2))
    theta, omega, alpha = states(9, 3)
    adapter = load_engine(engine, chain)
    first = adapter.accelerations(theta, omega)
    missing = ENGINES[engine].missing
    if "inverse_dynamics" not in missing:
        adapter.inverse_dynamics(theta, omega, alpha, gravity=False)
    if "joint_forces" not in missing:
        adapter.joint_forces(theta, omega, alpha)
    adapter.energy(theta, omega)
    for integrator in ENGINES[engine].integrators:
        adapter.trajectory(theta[0], omega[0], integrator.name, 1e-3, 10)
        adapter.trajectory(theta[0], 1e3 * omega[0], integrator.name, 1.0, 50)  # which comes to grief
    np.testing.assert_array_equal(adapter.accelerations(theta, omega), first)
    np.testing.assert_array_equal(adapter.accelerations(theta[::-1], omega[::-1])[::-1], first)


def test_many_turns_are_no_turns(engine):
    theta, omega, _ = states(10, 3)
    adapter = load_engine(engine, RodChain((0.5, 0.7, 0.2)))
    once, wound = adapter.accelerations(theta, omega), adapter.accelerations(theta + 40 * np.pi, omega)
    # 40π is rounded, and angles near 125 are 2^-46 apart: each angle is off by at most 2e-14 (times d θ̈/dθ).
    assert np.abs(once - wound).max() < 2e-14 * 30 * np.abs(once).max()


def test_mujoco_built_without_xml_is_the_same_model():
    import mujoco

    from furiko.engines.mujoco import model_from_spec

    chain = RodChain((0.5, 0.7, 0.2, 0.9), gravity=3.7)
    theta, omega, _ = states(11, 4)
    adapter = load_engine("mujoco", chain)
    model = model_from_spec(chain.tree())
    assert model.opt.disableflags == adapter._engine._model.opt.disableflags
    data = mujoco.MjData(model)
    for row, t, w in zip(adapter.accelerations(theta, omega), theta, omega, strict=True):
        data.qpos[:], data.qvel[:] = np.diff(t, prepend=0.0), np.diff(w, prepend=0.0)
        mujoco.mj_forward(model, data)
        np.testing.assert_array_equal(row, np.cumsum(data.qacc))


def test_chains_too_deep_for_xml_swing_in_mujoco():
    n = 460
    found = load_engine("mujoco", RodChain((0.5,) * n)).accelerations(np.full(n, 0.3), np.zeros(n))
    expected = load_engine("exudyn-redundant", RodChain((0.5,) * n)).accelerations(np.full(n, 0.3), np.zeros(n))
    # The mass matrix in relative coordinates has a condition number that grows with n⁴: 1e-7 is what MuJoCo keeps here.
    assert np.abs(found - expected).max() < 1e-6 * np.abs(expected).max()


def test_a_rod_whose_own_inertia_is_below_what_mujocos_compiler_takes():
    tiny = 2e-5
    rod = RodChain((tiny,))  # 7e-16 kg m² about its centre of mass, but 3e-15 about the hinge: above mjMINVAL
    adapter = load_engine("mujoco", rod)
    assert adapter.fields().inertias[0] == rod.tree().links[0].inertia
    np.testing.assert_allclose(adapter.accelerations([1.0], [0.0]), -1.5 * 9.81 / tiny * np.sin([1.0]), rtol=20 * EPS)


def _mechanism(name, any_tree):
    if name == "n-leg":
        return NLegPendulum((1.0, 0.5, 0.7, 0.3), (1.0, 2.0, 0.5, 0.7))
    if name == "rods":
        return RodChain((0.5, 0.9, 0.7, 0.3, 0.6, 0.8))
    return any_tree(int(name.removeprefix("tree-")), 7)


def _path_matrix(tree):
    """S of θ = S q: 1 where a link stands on the way from the support to another."""
    matrix = np.eye(tree.n)
    for i, link in enumerate(tree.links):
        if link.parent >= 0:
            matrix[i] += matrix[link.parent]
    return matrix
