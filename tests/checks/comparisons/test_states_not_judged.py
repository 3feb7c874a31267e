"""Maximal coordinates: a fault in the states for which elimination takes too long to look at is not passed over.

The accelerations and forces here are the true ones, off by a little. In two states of large elimination the little is
a hundredth of what elimination explains; in another state it is twice what anything explains. The two are further
beyond the bound without elimination, so that they are the ones that are looked at: a second is enough for two states.
"""

from dataclasses import replace

import numpy as np
import pytest

from furiko.checks.comparisons import accelerations, joint_forces
from furiko.reference import mass_matrix
from furiko.reference.rounding.bounds import EPSILON, allowed
from furiko.reference.rounding.maximal_elimination import elimination, states_within_a_second

SCENE, LINKS = "rods-50", 50


class Given:
    """Answers with these arrays."""

    def __init__(self, alpha, forces):
        self.alpha, self.forces = alpha, forces

    def accelerations(self, theta, omega):
        return self.alpha

    def joint_forces(self, theta, omega, alpha):
        return self.forces


@pytest.fixture
def explained_and_faulty(make_cell):
    """(cell, in two states off by what elimination explains), and the same with a fault in another state besides."""
    cell = make_cell("exudyn-redundant", SCENE, 3)
    system, states, truth = cell.scene.system, cell.states, cell.facts
    bound = EPSILON * allowed(LINKS, cell.info.accuracy)
    more_rows, more_forces = elimination(system, states.theta, states.omega)
    mass = mass_matrix(system, states.theta)
    rows = cell.amplitude.rows(truth.high, states.omega, mass)
    sizes = cell.amplitude.forces(truth.high, states.omega)
    by_row = np.argsort((more_rows / rows).min(axis=-1))
    by_force = np.argsort((more_forces / sizes).max(axis=-1))
    residuals, forces = np.zeros_like(rows), np.zeros_like(sizes)
    for chosen, more, of in ((by_row[-2:], more_rows, residuals), (by_force[-2:], more_forces, forces)):
        of[chosen] = 0.5 * bound * more[chosen]

    def engine():
        off = np.linalg.solve(mass, residuals[..., None])[..., 0]
        across = np.stack([forces, np.zeros_like(forces)], axis=-1)
        return replace(cell, engine=Given(truth.high + off, truth.forces + across))

    explained = engine()
    for where, scale, more, of in ((by_row[0], rows, more_rows, residuals), (by_force[0], sizes, more_forces, forces)):
        of[where] = 2 * bound * (scale + more)[where]
    return explained, engine()


@pytest.mark.slow
@pytest.mark.parametrize("check", [accelerations, joint_forces])
def test_a_fault_in_the_states_not_judged_alone_does_not_pass(check, explained_and_faulty):
    assert states_within_a_second(LINKS) == 2
    explained, faulty = explained_and_faulty
    (sound,) = check.compare(explained)
    assert sound.outcome == "agrees", sound.reason
    looked_at, others = check.compare(faulty)
    assert looked_at.outcome == "agrees"
    assert looked_at.details["states not judged"] == 1
    assert others.outcome == "skipped"
    assert others.check == f"{check.NAME}, other states"
    assert "nothing is said of 1 of the states" in others.reason
