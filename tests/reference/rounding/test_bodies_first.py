"""The rounding bound of bodies solved for one by one and multipliers from a dense matrix, against that in singles.

The algorithm is written out here from Newton's equations: each body's coordinates are its hinge's place and its angle,
its forces gravity's and the centrifugal ones, and every joint says that two places accelerate alike.
"""

from dataclasses import replace

import numpy as np
import pytest

from furiko.checks.comparisons import accelerations
from furiko.models import RodChain, Scene
from furiko.reference import literal_accelerations, mass_matrix
from furiko.reference.rounding.bodies_first import bodies_first, bodies_first_spread

UNLIKE = RodChain((1.0, 0.01, 10.0))
SINGLE = 2.0**-23
UP = np.array([0.0, 1.0])


def across(vectors):
    """Turned by a quarter, counter-clockwise."""
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


def solved(system, theta, omega, number, *, world=False):
    """Accelerations (n,) and multipliers (n, 2), computed in numbers of this type.

    ``world``: levers are the differences of the hinges' places, as they are rounded.
    """
    tree, n = system.tree(), system.n
    theta, omega = theta.astype(number), omega.astype(number)
    along = np.stack([np.sin(theta), -np.cos(theta)], axis=-1)
    lengths, centres = (np.array(v, number) for v in (system.lengths, [link.com[0] for link in tree.links]))
    mass, inertia = (np.array(v, number) for v in ([ln.mass for ln in tree.links], [ln.inertia for ln in tree.links]))
    lever, arm = lengths[:, None] * along, centres[:, None] * along
    if world:
        places = np.vstack([np.zeros((1, 2), number), np.cumsum(lever, axis=0, dtype=number)])
        lever = places[1:] - places[:-1]
    matrices = np.zeros((n, 3, 3), number)
    forces = np.zeros((n, 3), number)
    jacobian = np.zeros((2 * n, n, 3), number)
    gamma = np.zeros((n, 2), number)
    weight = number(system.gravity) * UP.astype(number)
    for i in range(n):
        turned = mass[i] * across(arm[i])
        matrices[i, :2, :2] = mass[i] * np.eye(2, dtype=number)
        matrices[i, :2, 2] = matrices[i, 2, :2] = turned
        matrices[i, 2, 2] = inertia[i] + mass[i] * (arm[i] @ arm[i])
        forces[i, :2] = mass[i] * (omega[i] ** 2 * arm[i] - weight)
        forces[i, 2] = -turned @ weight
        jacobian[2 * i : 2 * i + 2, i, :2] = np.eye(2)
        if i:
            jacobian[2 * i : 2 * i + 2, i - 1, :2] = -np.eye(2)
            jacobian[2 * i : 2 * i + 2, i - 1, 2] = -across(lever[i - 1])
            gamma[i] = omega[i - 1] ** 2 * lever[i - 1]
    inverse = np.linalg.inv(matrices)
    moved = np.einsum("ijk,mik->mij", inverse, jacobian)
    dense = np.einsum("mij,kij->mk", jacobian, moved)
    fall = np.einsum("mij,ij->m", moved, forces) + gamma.ravel()
    q, r = np.linalg.qr(dense)
    multipliers = np.linalg.solve(r, q.T @ fall)
    found = np.einsum("ijk,ik->ij", inverse, forces - np.einsum("mij,m->ij", jacobian, multipliers))
    assert found.dtype == number
    return found[:, 2].astype(float), multipliers.reshape(n, 2).astype(float)


def states(system, count):
    """Of singles, so that single precision starts from the very same."""
    random = np.random.default_rng(5)
    return random.uniform(-3, 3, (2, count, system.n)).astype(np.float32).astype(float)


SYSTEMS = [UNLIKE, RodChain((0.3, 1.0, 2.0, 0.5)), RodChain((1.0, 0.003, 0.5, 0.002, 2.0), gravity=0.0)]


def test_the_algorithm_gives_the_documents_accelerations():
    for system in SYSTEMS:
        theta, omega = states(system, 5)
        right = literal_accelerations(system, theta, omega)
        for i in range(len(theta)):
            alpha, _ = solved(system, theta[i], omega[i], np.float64)
            assert np.abs(alpha - right[i]).max() < 1e-9 * np.abs(right[i]).max()


@pytest.mark.parametrize("world", [False, True], ids=["on the parent", "in the world"])
@pytest.mark.parametrize("system", SYSTEMS, ids=["unlike", "alike", "very unlike"])
def test_it_errs_by_no_more_than_what_meets_in_it(system, world):
    theta, omega = states(system, 40)
    placed, n = "world" if world else "parent", system.n
    rows, forces = bodies_first(system, theta, omega, placed)
    spread, forced = bodies_first_spread(system, theta, omega, placed)
    found = [
        [solved(system, t, w, number, world=world) for number in (np.float64, np.float32)]
        for t, w in zip(theta, omega, strict=True)
    ]
    error = np.array([single[0] - double[0] for double, single in found])
    apart = np.array([np.linalg.norm(single[1] - double[1], axis=-1) for double, single in found])
    residual = np.abs(np.einsum("bij,bj->bi", mass_matrix(system, theta), error))
    assert (residual <= 5 * n * SINGLE * rows).all()
    assert (apart <= 5 * n * SINGLE * forces).all()
    # What it usually is: neither a small part of the spread nor far beyond it.
    scale = SINGLE / 2.0**-52
    for off, usual in ((error, spread), (apart, forced)):
        quotient = np.sqrt(np.mean((off / (scale * usual)) ** 2))
        assert 0.05 < quotient < 3
        assert np.abs(off / (scale * usual)).max() < 8


class OneByOne:
    """Answers with the algorithm above."""

    def __init__(self, system):
        self.system = system

    def accelerations(self, theta, omega):
        return np.array([solved(self.system, t, w, np.float64)[0] for t, w in zip(theta, omega, strict=True)])


@pytest.mark.parametrize(("ordering", "outcome"), [("pivoted", "differs"), ("bodies", "agrees"), ("unknown", "agrees")])
def test_an_engine_is_held_to_the_bound_of_its_own_algorithm(make_cell, ordering, outcome):
    """A rod of a hundredth carries one of ten times the first: 3,000 ε where rows are interchanged at most 78 ε."""
    scene = Scene("unlike", UNLIKE)
    cell = make_cell("exudyn-redundant", scene, random_states=60)
    info = replace(cell.info, ordering=ordering, accuracy=2.0**-52, accuracy_reason="")
    found = list(accelerations.compare(replace(cell, info=info, engine=OneByOne(UNLIKE))))
    assert found[0].outcome == outcome, found[0].reason
    assert not found[0].loose
    if ordering == "bodies":
        assert "states not judged" not in found[0].details


def test_a_body_without_inertia_is_not_solved_for_by_itself(make_cell):
    cell = make_cell("exudyn-redundant", "n-leg-3", random_states=2)
    for ordering in ("unknown", "bodies", "pivoted"):
        ways = replace(cell, info=replace(cell.info, ordering=ordering)).ways
        assert [way.info.ordering for way in ways] == ["pivoted"]
