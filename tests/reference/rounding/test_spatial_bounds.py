"""Bounds of rounding in space hold for MuJoCo and Pinocchio, which are right, and not for what is a little wrong."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import spatial_engines
import spatial_trees

from furiko.models.scene import find_scene
from furiko.models.spatial import Inertial
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from furiko.models.trees.states import tree_states
from furiko.reference.rounding import spatial as rounding
from furiko.reference.truth.spatial import spatial_truth


def light_and_heavy(rng, body):
    factor = 10.0 ** rng.uniform(-6, 3)
    return replace(body, inertial=Inertial(body.inertial.mass * factor, *scaled(body, 1.0, factor)))


def short_and_long(rng, body):
    factor = 10.0 ** rng.uniform(-4, 0)
    joints = tuple(replace(j, anchor=j.anchor * factor, armature=0.0) for j in body.joints)
    inertial = Inertial(body.inertial.mass, *scaled(body, factor, factor**2))
    return replace(body, position=body.position * factor, joints=joints, inertial=inertial)


def nearly_points(rng, body):
    joints = tuple(replace(j, armature=0.0) for j in body.joints)
    return replace(body, joints=joints, inertial=Inertial(body.inertial.mass, *scaled(body, 1.0, 1e-6)))


def as_it_is(rng, body):
    return body


def scaled(body, length, inertia):
    return body.inertial.centre * length, body.inertial.tensor * inertia


KINDS = (as_it_is, light_and_heavy, short_and_long, nearly_points)


def drawn(seed, kind=as_it_is):
    rng = np.random.default_rng(seed)
    mechanism = spatial_trees.tree(rng, int(rng.integers(2, 15)), free=seed % 2 == 0)
    bodies = tuple(kind(rng, body) for body in mechanism.bodies)
    mechanism = spatial_engines.without_free_armature(replace(mechanism, bodies=bodies))
    q, v, torque = spatial_trees.state(rng, mechanism)
    return mechanism, spatial_engines.unit_quaternions(mechanism, q), v, torque


def shares(truth, found, **options):
    """What an engine's M, bias, passive forces and accelerations are off by, over what is allowed."""
    mechanism, q, v = truth.mechanism, truth.q, truth.v
    mass, bias, passive, accelerations = found
    allowed = {
        "M": (truth.mass_matrix.enclosure.error(mass), rounding.allowed_mass_matrix(mechanism, q, **options)),
        "bias": (truth.bias.enclosure.error(bias), rounding.allowed_bias(mechanism, q, v, **options)),
    }
    if passive is not None:
        allowed["passive"] = (truth.passive.enclosure.error(passive), rounding.allowed_passive(mechanism, q, v))
    if accelerations is not None:
        residual = np.abs(truth.residual(accelerations).float)
        bound = rounding.allowed_residual(
            mechanism,
            q,
            v,
            accelerations,
            truth.mass_matrix.float,
            truth.torque,
            factorised=passive is not None,
            inverted=passive is None,
            **options,
        )
        allowed["accelerations"] = (residual, bound)
    return {name: float(np.max(error / np.maximum(bound, 1e-300))) for name, (error, bound) in allowed.items()}


def both(mechanism, q, v, torque):
    truth = spatial_truth(mechanism, q, v, torque)
    yield truth, spatial_engines.MuJoCo(mechanism).terms(q, v, torque)
    yield truth, spatial_engines.Pinocchio(mechanism).terms(q, v, torque, truth.passive.float)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("seed", range(6))
def test_engines_that_are_right_are_within(kind, seed):
    for truth, found in both(*drawn(seed, kind)):
        assert max(shares(truth, found).values()) < 1


@pytest.mark.parametrize("seed", range(6))
def test_pinocchio_is_within_the_ways_along_the_joints(seed):
    _, (truth, found) = both(*drawn(seed))
    assert max(shares(truth, found, world=False).values()) < 1


@pytest.mark.parametrize("seed", range(6))
def test_no_term_is_above_its_unit(seed):
    """Of whatever is added up the sum is at most the sum of magnitudes."""
    mechanism, q, v, torque = drawn(seed)
    truth = spatial_truth(mechanism, q, v, torque)
    for world in (True, False):
        units = rounding.Magnitudes(mechanism, q, v, world=world)
        assert (np.abs(truth.mass_matrix.float) <= units.mass_matrix * (1 + 1e-12)).all()
        assert (np.abs(truth.bias.float) <= units.bias * (1 + 1e-12)).all()
        assert (np.abs(truth.gravity.float) <= units.gravity * (1 + 1e-12)).all()
        assert (np.abs(truth.passive.float) <= units.passive * (1 + 1e-12)).all()


def arm(rng, n=7):
    """A serial arm of the size of real ones, each axis across the one before."""
    bodies = []
    for i in range(n):
        inertial = Inertial(3.0 - 0.3 * i, rng.normal(size=3) * 0.05, np.diag([0.02, 0.015, 0.012]) * 0.7**i)
        axis = np.eye(3)[i % 2 + 1]
        bodies.append(
            RigidBody(
                f"link {i}",
                i - 1,
                np.array([0.02, 0.0, 0.25]),
                joints=(Joint(f"joint {i}", axis=axis),),
                inertial=inertial,
            )
        )
    return SpatialMechanism(tuple(bodies), np.array([0.0, 0.0, -9.81]))


@cache
def arm_in_motion():
    rng = np.random.default_rng(7)
    mechanism = arm(rng)
    return spatial_truth(mechanism, *spatial_trees.state(rng, mechanism))


def altered(mechanism, index, parameter, relative):
    body = mechanism.bodies[index]
    inertial = body.inertial
    factor = 1 + relative
    made = {
        "mass": replace(body, inertial=replace(inertial, mass=inertial.mass * factor)),
        "centre": replace(body, inertial=replace(inertial, centre=inertial.centre * factor)),
        "tensor": replace(body, inertial=replace(inertial, tensor=inertial.tensor * factor)),
        "position": replace(body, position=body.position * factor),
    }[parameter]
    bodies = list(mechanism.bodies)
    bodies[index] = made
    return replace(mechanism, bodies=tuple(bodies))


@pytest.mark.parametrize("parameter", ["mass", "centre", "tensor", "position"])
@pytest.mark.parametrize("index", range(7))
def test_a_parameter_of_an_arm_that_is_a_little_off_is_found(parameter, index):
    """By 1e-9 in M or the bias, by 1e-6 in accelerations: through MuJoCo's own rounding.

    The first link's weight is a thousandth of what its joint moves, so that a row shows 1e-8 of it. Its place matters
    to nothing, gravity being the same everywhere.
    """
    truth = arm_in_motion()
    mechanism, q, v, torque = truth.mechanism, truth.q, truth.v, truth.torque
    terms = spatial_engines.MuJoCo(altered(mechanism, index, parameter, 1e-9 if index else 1e-8)).terms(q, v, torque)
    moved = spatial_engines.MuJoCo(altered(mechanism, index, parameter, 1e-6)).terms(q, v, torque)
    found, more = shares(truth, terms), shares(truth, moved)
    matters = (parameter, index) != ("position", 0)
    assert (max(found["M"], found["bias"]) > 1) == matters
    assert (more["accelerations"] > 1) == matters


@pytest.mark.parametrize("factorised", [True, False], ids=["factorised", "joint by joint"])
def test_a_part_in_ten_billions_of_a_free_bases_acceleration_is_found(factorised):
    """On the quadruped, in half of its states; where the rates' terms were multiplied by |E⁻¹|, seven times as much."""
    scene = find_scene("quadruped")
    mechanism, states = scene.system.mechanism(), tree_states(scene, 24)
    smallest = []
    for q, v in zip(states.q, states.v, strict=True):
        truth = spatial_truth(mechanism, q, v)
        mass, exact = truth.mass_matrix.float, truth.accelerations.float
        how = {"factorised": factorised, "inverted": not factorised}
        allowed = rounding.allowed_residual(mechanism, q, v, exact, mass, **how)
        smallest += [1 / np.max(np.abs(mass[:, part] @ exact[part]) / allowed) for part in (slice(3), slice(3, 6))]
    assert np.median(smallest) < 1e-10


def test_a_base_far_away_costs_digits_in_the_world_alone():
    mechanism, q, v, torque = drawn(4)
    q[:3] = 1e5, -2e5, 3e4
    (truth, mujoco), (_, pinocchio) = both(mechanism, q, v, torque)
    assert max(shares(truth, mujoco).values()) < 1
    assert shares(truth, mujoco, world=False)["M"] > 1
    assert max(shares(truth, pinocchio, world=False).values()) < 1


def test_a_ball_whose_block_is_inverted_loses_digits(monkeypatch):
    """Pinocchio inverts a ball's 3 × 3 block; with a slide after it on a light body that has a large condition."""
    mechanism, q, v, torque = drawn(23, nearly_points)
    _, (truth, found) = both(mechanism, q, v, torque)
    assert shares(truth, found)["accelerations"] < 1
    monkeypatch.setattr(rounding.Magnitudes, "_inverted", lambda *arguments: 0.0)
    assert shares(truth, found)["accelerations"] > 1


def several_hinges(angle, light=1.0):
    """A link on three hinges at right angles, and its state; the middle one is so far from a right angle."""
    joints = tuple(Joint(name, axis=axis) for name, axis in zip("xyz", np.eye(3)[::-1], strict=True))
    inertial = Inertial(2.0 * light, np.array([0.02, 0.01, -0.15]), np.diag([0.02, 0.018, 0.004]) * light)
    mechanism = SpatialMechanism((RigidBody("arm", -1, joints=joints, inertial=inertial),), np.array([0, 0, -9.81]))
    return mechanism, np.array([0.3, np.pi / 2 - angle, -0.8]), np.array([1.0, -2.0, 0.5])


def inverted_at_once(truth, perturbation):
    """Accelerations by an inverse of M as a whole that leaves a residual of ``perturbation`` of its norm: the best that
    inverting a block can do. M⁻¹ is perturbed on the right, as Gauss' elimination of the columns does."""
    mass, right = truth.mass_matrix.float, (truth.passive.float - truth.bias.float)
    inverse = np.linalg.inv(mass)
    rng = np.random.default_rng(1)
    return (inverse + perturbation * rng.uniform(-1, 1, (3, 3)) * np.abs(inverse).max()) @ right


def test_joints_that_are_inverted_together_have_room_for_it_and_others_have_not():
    mechanism, q, v = several_hinges(1e-4)
    truth = spatial_truth(mechanism, q, v)
    found = inverted_at_once(truth, 2.0**-52)
    residual = np.abs(truth.residual(found).float)
    ratio = []
    for together in (False, True):
        units = rounding.Magnitudes(mechanism, q, v, world=False, together=together)
        allowed = units.roundings * 2.0**-52 * units.residual(found, truth.mass_matrix.float, factorised=False)
        ratio.append((residual / allowed).max())
    assert ratio[0] > 1 > ratio[1]


def test_what_is_singular_to_rounding_is_not_regular_and_a_light_tip_is():
    for angle, regular in ((1.0, True), (1e-4, True), (1e-9, False)):
        mechanism, q, v = several_hinges(angle)
        mass = spatial_truth(mechanism, q, v).mass_matrix.float
        assert rounding.Magnitudes(mechanism, q, v).regular(mass) == regular
    bodies = (
        *mechanism.bodies,
        RigidBody("tip", 0, joints=(Joint("tip"),), inertial=Inertial(1e-12, np.ones(3), 1e-12 * np.eye(3))),
    )
    mechanism, q, v = replace(mechanism, bodies=bodies), np.array([0.3, 0.5, -0.8, 0.1]), np.zeros(4)
    assert rounding.Magnitudes(mechanism, q, v).regular(spatial_truth(mechanism, q, v).mass_matrix.float)


def test_underflow_is_in_the_bound_where_numbers_are_subnormal_and_nowhere_else():
    mechanism, q, v = several_hinges(1.0)
    for power in (0, 530):
        slow = replace(mechanism, gravity=np.ldexp(mechanism.gravity, -2 * power))
        rates = np.ldexp(v, -power)
        truth = spatial_truth(slow, q, rates)
        units = rounding.Magnitudes(slow, q, rates, world=False)
        answer = truth.accelerations.float
        unit = units.residual(answer, truth.mass_matrix.float)
        # One smallest number more or less in each acceleration is what a double must be allowed.
        error = truth.mass_matrix.float @ np.full(3, 5e-324)
        assert (np.abs(error) <= units.roundings * (2.0**-52 * unit)).all()
        plain = np.abs(truth.mass_matrix.float) @ np.abs(answer) + np.abs(truth.bias.float)
        assert (unit.max() < 1e3 * plain.max()) == (power == 0)


def sprung_ball(w):
    """A link on a ball with a spring, nearly half a turn from its rest: w is the first component of its quaternion."""
    joint = Joint("ball", kind="ball", stiffness=3.0)
    inertial = Inertial(2.0, np.array([0.02, 0.01, -0.15]), np.diag([0.02, 0.018, 0.014]))
    mechanism = SpatialMechanism((RigidBody("arm", -1, joints=(joint,), inertial=inertial),), np.array([0, 0, -9.81]))
    return mechanism, np.array([w, 0.6, 0.0, 0.8]), np.zeros(3)


@pytest.mark.parametrize(("w", "told"), [(1e-200, False), (-1e-200, False), (-1e-14, True), (0.3, True)])
def test_a_spring_that_rounding_turns_the_other_way_is_no_fault_and_any_other_is(w, told):
    """At half a turn both ways are as short; an angle of π − 2|w| is rounded to π where |w| is below rounding."""
    mechanism, q, v = sprung_ball(w)
    truth = spatial_truth(mechanism, q, v)
    pull = truth.passive.float
    other = pull * (1 - 2 * np.pi / np.linalg.norm(pull / 3.0))  # round the other way
    off = np.abs(other - pull)
    assert off.max() > 1
    assert (off > rounding.allowed_passive(mechanism, q, v)).any() == told
    answer = np.linalg.solve(truth.mass_matrix.float, other - truth.bias.float)
    residual = np.abs(truth.residual(answer).float)
    allowed = rounding.allowed_residual(mechanism, q, v, answer, truth.mass_matrix.float)
    assert (residual > allowed).any() == told


def test_numbers_beyond_the_range_of_doubles_accuse_nobody():
    mechanism, q, v = several_hinges(1.0)
    units = rounding.Magnitudes(mechanism, q, v)
    mass = spatial_truth(mechanism, q, v).mass_matrix.float
    assert not np.isnan(units.residual(np.full(3, 1e300), mass)).any()
    free = SpatialMechanism(
        (RigidBody("body", -1, joints=(Joint("free", kind="free"),), inertial=Inertial(1.0, np.zeros(3), np.eye(3))),),
        np.zeros(3),
    )
    units = rounding.Magnitudes(free, np.array([0, 0, 0, 1.0, 0, 0, 0]), np.full(6, 1e200))
    assert not np.isnan(units.residual(np.full(6, 1e200), np.eye(6))).any()
