"""The rounding bound of elimination in maximal coordinates, against elimination itself in single precision."""

import numpy as np
import pytest

from furiko.checks.comparisons import accelerations, joint_forces
from furiko.models import NLegPendulum, RodChain, Scene
from furiko.reference import mass_matrix
from furiko.reference.maximal_coordinates import MaximalCoordinates
from furiko.reference.rounding.maximal_elimination import elimination

UNLIKE = RodChain((1.0, 0.004, 0.009), 1.0, 0.0)
SINGLE = 2.0**-23


def solved(system, theta, omega, order):
    """Accelerations of the angles and the multipliers, in double precision and in single with unknowns in this order.

    Single precision starts from the same matrix, which is therefore one of singles, as if it were exact.
    """
    bodies, n = MaximalCoordinates(system.tree()), system.n
    q, v = bodies.state(theta, omega)
    matrix = bodies.kkt_matrix(bodies.jacobian(q)).astype(np.float32)
    right = np.concatenate([bodies.force, -bodies.constraint_bias(q, v)]).astype(np.float32)
    double, single = np.linalg.solve(matrix.astype(float), right.astype(float)), np.empty(5 * n)
    single[order] = np.linalg.solve(matrix[:, order], right)
    return double[2 : 3 * n : 3], single[2 : 3 * n : 3], double[3 * n :], single[3 * n :]


@pytest.mark.parametrize("system", [UNLIKE, NLegPendulum((1.0, 0.03, 0.5), (1.0, 1e-3, 0.1))], ids=["rods", "legs"])
def test_elimination_errs_by_no_more_than_what_meets_in_it(system):
    random, n = np.random.default_rng(5), system.n
    theta, omega = random.uniform(-3, 3, (40, n)), random.uniform(-3, 3, (40, n))
    rows, forces = elimination(system, theta, omega)
    mass = mass_matrix(system, theta)
    for i in range(len(theta)):
        for _ in range(10):
            double, single, forced, roughly = solved(system, theta[i], omega[i], random.permutation(5 * n))
            residual = np.abs(mass[i] @ (single - double))
            assert (residual <= 5 * n * SINGLE * rows[i]).all()
            apart = np.linalg.norm((roughly - forced).reshape(n, 2), axis=-1)
            assert (apart <= 5 * n * SINGLE * forces[i]).all()


def test_unlike_links_in_exudyn_are_within_it(make_cell):
    scene = Scene("unlike", RodChain((0.05860499559350387, 0.0002418080768757145, 0.0005323618917476031), 13.8, 0.0))
    cell = make_cell("exudyn-redundant", scene, random_states=200)
    for check in (accelerations, joint_forces):
        (result,) = check.compare(cell)
        assert result.outcome == "agrees", result
