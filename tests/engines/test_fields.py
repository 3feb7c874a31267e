"""What an engine compiled, against what was asked; and that it is read from the engine, not from the question."""

import numpy as np
import pytest

from furiko.engines import load_engine
from furiko.models import NLegPendulum, RodChain

SYSTEMS = [RodChain((0.5, 0.7, 0.3), 1.3, 3.7), NLegPendulum((1.0, 0.5, 0.3), (1.0, 2.0, 0.1), 0.0), "any tree"]


@pytest.mark.parametrize("system", SYSTEMS, ids=["rods", "n-leg", "tree"])
def test_fields_are_what_was_asked(engine, system, any_tree):
    system = any_tree(3, 6) if system == "any tree" else system
    fields = load_engine(engine, system).fields()
    links = system.tree().links
    assert fields.dofs == system.n
    assert fields.parents == system.tree().parents
    # The writers write every digit: masses, and in most engines all, are the same numbers. Exudyn's maximal coordinates
    # hold differences of points, and Pinocchio composes placements: a rounding of numbers below 1.
    np.testing.assert_array_equal(fields.masses, system.masses)
    np.testing.assert_allclose(fields.hinges, [link.hinge for link in links], rtol=0, atol=3e-16)
    np.testing.assert_allclose(fields.centres, [link.com for link in links], rtol=0, atol=3e-16)
    np.testing.assert_allclose(fields.inertias, [link.inertia for link in links], rtol=0, atol=1e-17)
    np.testing.assert_array_equal(fields.gravity, [0.0, 0.0, -system.gravity])
    np.testing.assert_array_equal(fields.armature, np.zeros(system.n))
    np.testing.assert_array_equal(fields.damping, np.zeros(system.n))


def test_point_masses_are_points(engine):
    star = NLegPendulum((1.0, 0.5, 0.3), (1.0, 2.0, 0.1))
    np.testing.assert_array_equal(load_engine(engine, star).fields().inertias, np.zeros(3))


def tampered(name):
    """An adapter whose engine's model has been changed behind its back: mass 2 doubled, gravity 1.62."""
    loaded = load_engine(name, RodChain((0.5, 0.7, 0.3)))
    adapter = loaded._engine
    if name == "mujoco":
        adapter._model.body_mass[2] *= 2
        adapter._model.opt.gravity[2] = -1.62
        adapter._model.dof_armature[1] = 0.25
        adapter._model.dof_damping[1] = 0.5
    elif name.startswith("pinocchio"):
        import pinocchio

        held = adapter._model.inertias[2]
        adapter._model.inertias[2] = pinocchio.Inertia(2 * held.mass, held.lever, held.inertia)
        adapter._model.gravity.linear = np.array([0, 0, -1.62])
        adapter._model.armature = np.array([0, 0.25, 0])
        adapter._model.damping = np.array([0, 0.5, 0])
    elif name == "exudyn-tree":
        masses, units = adapter._mbs.GetObjectParameter(adapter._tree, "linkMasses"), adapter._units
        adapter._mbs.SetObjectParameter(adapter._tree, "linkMasses", masses * [1, 2, 1])
        adapter._mbs.SetObjectParameter(adapter._tree, "gravity", [0, -1.62 / units.acceleration, 0])
        adapter._mbs.SetObjectParameter(adapter._tree, "jointDControlVector", [0, 0.5 / units.energy, 0])
        adapter._mbs.SetObjectParameter(adapter._tree, "jointPControlVector", [0, 0, 0])
        adapter._mbs.SetObjectParameter(adapter._tree, "jointPositionOffsetVector", [0, 0, 0])
        adapter._mbs.SetObjectParameter(adapter._tree, "jointVelocityOffsetVector", [0, 0, 0])
    else:
        units = adapter._units
        adapter._mbs.SetObjectParameter(adapter._bodies[1], "mass", 1.4 / units.mass)
        for load in adapter._loads:
            adapter._mbs.SetLoadParameter(load, "loadVector", [0, -1.62 / units.acceleration, 0])
    return loaded


def test_a_model_changed_behind_the_adapters_back_shows(engine):
    fields = tampered(engine).fields()
    np.testing.assert_array_equal(fields.masses, [0.5, 1.4, 0.3])
    assert fields.gravity[2] == -1.62
    if engine != "exudyn-redundant":  # whose joints can have no damping
        np.testing.assert_array_equal(fields.damping, [0.0, 0.5, 0.0])
    if not engine.startswith("exudyn"):  # which has no armature
        np.testing.assert_array_equal(fields.armature, [0.0, 0.25, 0.0])


def test_bodies_that_weigh_differently_have_no_one_gravity():
    loaded = load_engine("exudyn-redundant", RodChain((0.5, 0.7)))
    adapter = loaded._engine
    adapter._mbs.SetLoadParameter(adapter._loads[1], "loadVector", [0, -1.0, 0])
    assert np.isnan(loaded.fields().gravity).all()
