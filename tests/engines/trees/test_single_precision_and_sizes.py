"""Numbers of single precision are the doubles that they are, and quaternions of any length rotations, in engines."""

from dataclasses import replace

import numpy as np
import pytest

import furiko
from furiko.engines import cannot, engine_info, engine_names, load_engine, why_missing
from furiko.engines.elsewhere import adapter
from furiko.models import RodChain, find_scene
from furiko.models.spatial import Inertial, unit
from furiko.models.spatial_mechanism import SpatialMechanism
from furiko.models.trees.states import random_states
from furiko.reference.truth.spatial import spatial_truth

ENGINES = [name for name in engine_names() if engine_info(name).tree and not why_missing(name)]
SINGLE = np.float32


def given_in(kind, mechanism):
    """The mechanism with all its numbers rounded to single precision, as arrays and numbers of ``kind``."""

    def number(value):
        return kind(SINGLE(value))

    def array(values):
        return np.asarray(values, dtype=SINGLE).astype(kind)

    def joint(one):
        names = ("ref", "armature", "damping", "stiffness", "springref")
        numbers = {name: number(getattr(one, name)) for name in names}
        return replace(one, axis=array(one.axis), anchor=array(one.anchor), **numbers)

    def body(one):
        inertial = Inertial(number(one.inertial.mass), array(one.inertial.centre), array(one.inertial.tensor))
        place = {"position": array(one.position), "quaternion": array(one.quaternion)}
        return replace(one, **place, joints=tuple(map(joint, one.joints)), inertial=inertial)

    return SpatialMechanism(tuple(map(body, mechanism.bodies)), array(mechanism.gravity))


def states(scene, kind=np.float64):
    rows = random_states("single", scene.system, 3)
    return [np.array([row[k] for row in rows], dtype=SINGLE).astype(kind) for k in (0, 1)]


@pytest.mark.parametrize("name", ["arm-7", "humanoid", "hopper"])
@pytest.mark.parametrize("engine", ENGINES)
def test_a_mechanism_in_single_precision_is_the_same_to_the_last_bit(engine, name):
    scene = find_scene(name)
    if cannot(engine_info(engine), scene.system):
        pytest.skip("the engine cannot hold it")
    shape = adapter(engine_info(engine).tree.adapter)
    found = []
    for kind in (SINGLE, np.float64):
        mechanism = given_in(kind, scene.system.mechanism())
        found.append(shape(mechanism).accelerations(*states(scene)))
    assert np.array_equal(*found)
    assert found[0].dtype == np.float64


@pytest.mark.parametrize("name", ["arm-7", "humanoid"])
def test_the_theory_takes_single_precision_exactly(name):
    scene = find_scene(name)
    found = []
    for kind in (SINGLE, np.float64):
        mechanism, (q, v) = given_in(kind, scene.system.mechanism()), states(scene, kind)
        found.append(
            (spatial_truth(mechanism, q[0], v[0]).accelerations.float, furiko.accelerations(mechanism, q, v)[0])
        )
    assert np.array_equal(found[0], found[1])


def test_public_functions_take_single_precision_exactly():
    lengths = SINGLE([0.3, 0.7, 1.1])
    theta, omega = SINGLE([[0.1, 0.7, -1.3]]), SINGLE([[1.1, -0.3, 0.2]])
    double = theta.astype(float), omega.astype(float)
    of_singles, of_doubles = RodChain(tuple(lengths)), RodChain(tuple(lengths.astype(float)))
    for function in (furiko.accelerations, furiko.energy):
        one, other = function(of_singles, theta, omega), function(of_doubles, *double)
        assert np.array_equal(np.asarray(one), np.asarray(other))
    ends = [furiko.simulate(of_singles, theta[0], omega[0], SINGLE([0, 0.25])).theta]
    ends.append(furiko.simulate(of_doubles, *(x[0] for x in double), [0, 0.25]).theta)
    assert np.array_equal(*ends)
    assert furiko.to_mjcf(of_singles) == furiko.to_mjcf(of_doubles)


@pytest.mark.parametrize("engine", [name for name in engine_names() if not why_missing(name)])
def test_adapters_of_the_documents_systems_take_single_precision_exactly(engine):
    lengths = SINGLE([0.3, 0.7, 1.1])
    theta, omega = SINGLE([[0.1, 0.7, -1.3]]), SINGLE([[1.1, -0.3, 0.2]])
    one = load_engine(engine, RodChain(tuple(lengths))).accelerations(theta, omega)
    other = load_engine(engine, RodChain(tuple(lengths.astype(float))))
    assert np.array_equal(one, other.accelerations(theta.astype(float), omega.astype(float)))


def of_length(q, columns, length):
    q = q.copy()
    for start in columns:
        q[:, start : start + 4] *= length
    return q


@pytest.mark.parametrize("engine", ENGINES)
def test_quaternions_of_any_length_are_the_rotations_of_their_directions(engine):
    """From the least normal number to nearly the largest; squares are out of range at 1e-170 and at 1e170."""
    scene = find_scene("quadruped")
    if cannot(engine_info(engine), scene.system):
        pytest.skip("the engine cannot hold it")
    asked = adapter(engine_info(engine).tree.adapter)(scene.system.mechanism())
    q, v = states(scene)
    usual = asked.accelerations(q, v)
    for power in (-1000, -560, -60, 60, 560, 1020):
        other = of_length(q, [3], 2.0**power)
        # The same digits, and lengths that are divided away a rounding or two differently.
        assert np.abs(asked.accelerations(other, v) - usual).max() < 1e-13 * np.abs(usual).max()


@pytest.mark.parametrize("power", [-1000, -60, 60, 1000])
def test_runs_energies_and_forces_of_mujoco_start_from_the_direction_too(power):
    mechanism = find_scene("quadruped").system.mechanism()
    asked = adapter(engine_info("mujoco").tree.adapter)(mechanism)
    q, v = states(find_scene("quadruped"))
    other, a = of_length(q, [3], 2.0**power), np.zeros_like(v)
    for usual, found in (
        (asked.energy(q, v), asked.energy(other, v)),
        (asked.joint_forces(q, v, a), asked.joint_forces(other, v, a)),
        (asked.trajectory(q[0], v[0], "RK4", 1e-3, 3), asked.trajectory(other[0], v[0], "RK4", 1e-3, 3)),
    ):
        assert np.hstack(found) == pytest.approx(np.hstack(usual), rel=1e-12, abs=1e-12)


def test_unit_leaves_no_length_and_is_the_plain_quotient_in_between():
    q = np.array([0.3, -0.4, 0.1, 0.8])
    assert np.array_equal(unit(q), q / np.linalg.norm(q))
    for power in (-1070, -600, 600, 1023):
        scaled = np.ldexp(q, power)
        assert np.linalg.norm(unit(scaled)) == pytest.approx(1, abs=1e-15)
        # Subnormal numbers are themselves rounded: their direction is what it is.
        assert unit(scaled) == pytest.approx(unit(np.ldexp(scaled, -power)), abs=1e-14)
