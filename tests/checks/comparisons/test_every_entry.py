"""An error in any one entry of an answer, and in no other, is found by the check of that answer."""

from dataclasses import fields, replace

import numpy as np
import pytest

from furiko.checks.comparisons import accelerations, energy, joint_forces, model_fields, terms, trajectories
from furiko.engines import ModelFields
from furiko.models import NLegPendulum, Scene

SCENE, LINKS = "rods-3", 3
OFF = 1e-9  # a part of the entry: far beyond the proven bounds of three links, which are some 1e-13


class Moved:
    """A sound engine, one of whose answers ``change`` moves: it is given the answer and what was asked."""

    def __init__(self, engine, question, change):
        self._engine, self._question, self._change = engine, question, change

    def __getattr__(self, name):
        found = getattr(self._engine, name)
        if name != self._question:
            return found

        def moved(*asked, **named):
            answer = found(*asked, **named)
            self._change(answer, *asked)
            return answer

        return moved


def outcomes(make_cell, check, question, change, scene=SCENE):
    cell = replace(make_cell("fake_engines:Right", scene, 3), few_steps=1)  # the first of the truth's times is enough
    found = check.compare(replace(cell, engine=Moved(cell.engine, question, change)))
    return {result.check: result.outcome for result in found}


@pytest.mark.parametrize("link", range(LINKS))
def test_of_the_accelerations(make_cell, link):
    def change(answer, *_):
        answer[:, link] *= 1 + OFF

    assert outcomes(make_cell, accelerations, "accelerations", change) == {"accelerations": "differs"}


@pytest.mark.parametrize(("part", "outcome"), [(0.5, "agrees"), (2.0, "differs")])
def test_twice_the_proven_bound_is_beyond_it_and_half_is_not(make_cell, part, outcome):
    """26 roundings a link, as the theory says; the residual is in proportion to the error."""
    cell = make_cell("fake_engines:Right", SCENE, 3)

    def off(size):
        def change(answer, *_):
            answer[:, -1] *= 1 + size

        (found,) = accelerations.compare(replace(cell, engine=Moved(cell.engine, "accelerations", change)))
        return found

    coarse = off(OFF)
    assert coarse.allowed == 26 * LINKS
    found = off(OFF * part * coarse.allowed / coarse.measured)
    assert found.measured == pytest.approx(part * found.allowed, rel=0.1)  # Right's own rounding is some ε of 78
    assert found.outcome == outcome


def test_states_in_which_no_digit_is_sure_are_left_out(make_cell):
    """Two masses on one line, the upper 1e-15 of the lower: M is (1 + 1e-15, 1; 1, 1), and rounding 52 ε of each."""
    system = NLegPendulum((1.0, 1.0), (1e-15, 1.0))
    cell = make_cell("fake_engines:Right", Scene("light", system, named=("hanging", "horizontal")), 3)
    (found,) = accelerations.compare(cell)
    assert found.details["states left out"] >= 1
    assert found.details["states"] + found.details["states left out"] == len(cell.states)


@pytest.mark.parametrize("joint", range(LINKS))
@pytest.mark.parametrize("axis", [0, 1])
def test_of_the_joint_forces(make_cell, joint, axis):
    def change(answer, *_):
        answer[:, joint, axis] *= 1 + OFF

    assert outcomes(make_cell, joint_forces, "joint_forces", change) == {"joint forces": "differs"}


@pytest.mark.parametrize("part", [0, 1])
def test_of_the_energies(make_cell, part):
    def change(answer, *_):
        answer[:, part] *= 1 + OFF

    assert outcomes(make_cell, energy, "energy", change) == {"energy": "differs"}


@pytest.mark.parametrize("row", range(LINKS))
@pytest.mark.parametrize("column", range(LINKS))
def test_of_mass_matrix_and_velocity_terms(make_cell, row, column):
    """As the torques of a unit acceleration or rate show it; all torques are of the order of one."""

    def heavier(answer, _theta, _omega, alpha):
        answer[:, row] += OFF * alpha[:, column]

    def faster(answer, _theta, omega, _alpha):
        answer[:, row] += OFF * omega[:, column] ** 2

    agrees = dict.fromkeys(("terms M", "terms G", "terms C", "terms velocity"), "agrees")
    assert outcomes(make_cell, terms, "inverse_dynamics", heavier) == agrees | {"terms M": "differs"}
    both = {"terms C": "differs", "terms velocity": "differs"}
    assert outcomes(make_cell, terms, "inverse_dynamics", faster) == agrees | both


@pytest.mark.parametrize("row", range(LINKS))
def test_of_the_velocity_terms_with_all_rates_at_once(make_cell, row):
    def product_of_rates(answer, _theta, omega, _alpha):
        answer[:, row] += OFF * omega[:, 0] * omega[:, 2]

    found = outcomes(make_cell, terms, "inverse_dynamics", product_of_rates)
    assert [check for check, outcome in found.items() if outcome == "differs"] == ["terms velocity"]


NUMBERS = [field.name for field in fields(ModelFields) if field.name not in ("dofs", "parents")]


@pytest.mark.parametrize("name", NUMBERS)
def test_of_the_fields(make_cell, name):
    """Every number of every field, in turn; and a link that hangs on another."""
    cell = make_cell("fake_engines:Right", SCENE, 3)
    right = cell.engine.fields()
    for index in np.ndindex(getattr(right, name).shape):
        wrong = getattr(right, name).copy()
        wrong[index] += 1e-6
        moved = Fields(cell.engine, replace(right, **{name: wrong}))
        (result,) = model_fields.compare(replace(cell, engine=moved))
        assert result.outcome == "differs", (name, index)
    other = Fields(cell.engine, replace(right, parents=(-1, 0, 0)))
    (result,) = model_fields.compare(replace(cell, engine=other))
    assert result.outcome == "differs"
    assert "links hang on (-1, 0, 0)" in result.reason


class Fields:
    """An engine that says that it holds these fields."""

    def __init__(self, engine, held):
        self._engine, self._held = engine, held

    def __getattr__(self, name):
        return getattr(self._engine, name)

    def fields(self):
        return self._held


def test_of_where_a_motion_ends(make_cell):
    """Every run ends a ten-thousandth of a radian beside where it should, in one angle of two."""

    def change(answer, *_):
        answer[0][1] += 1e-4

    assert outcomes(make_cell, trajectories, "trajectory", change, "double-pendulum") == {"trajectory RK4": "differs"}
