"""Motions of open mechanisms: against closed forms, and those that are kept."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from furiko.models import TreeScene, find_scene, find_scenes
from furiko.models.trees.system import TreeJoint, TreeLink, TreeSystem
from furiko.reference.spatial_kinematics import centre_of_mass, energy, momentum, motion, rotations
from furiko.reference.truth import tree_end_points
from furiko.reference.truth.tree_motion import tree_motion


def test_a_damped_spring_falls_silent_as_its_closed_form():
    """m ẍ + d ẋ + k x = 0 from x = 1 at rest: x = e^(−βt) (cos ωt + β/ω sin ωt), β = d/2m, ω² = k/m − β²."""
    slide = TreeJoint("slide", "slide", axis=(1.0, 0.0, 0.0), damping=0.8, stiffness=8.0)
    mechanism = TreeSystem((TreeLink("body", -1, mass=2.0, joints=(slide,)),)).mechanism()
    motion = tree_motion(mechanism, np.array([1.0]), np.array([0.0]), [0.5, 1.0])
    beta, t = 0.2, np.array([0.5, 1.0])
    omega = np.sqrt(4.0 - beta**2)
    x = np.exp(-beta * t) * (np.cos(omega * t) + beta / omega * np.sin(omega * t))
    v = -np.exp(-beta * t) * 4.0 / omega * np.sin(omega * t)
    assert (np.abs(motion.q[:, 0] - x) <= motion.error).all()
    assert (np.abs(motion.v[:, 0] - v) <= motion.error).all()
    assert motion.error.max() < 1e-8


def test_a_top_without_gravity_moves_as_its_closed_form():
    """It turns about its angular momentum L, and about its own axis: R = exp(L t/A) R₀ exp(-(C - A)/A ω_z t z)."""
    across, along = 0.4, 0.7
    link = TreeLink("top", -1, mass=1.5, inertia=(across, across, along, 0, 0, 0), joints=(TreeJoint("f", "free"),))
    mechanism = TreeSystem((link,), (0.0, 0.0, 0.0)).mechanism()
    q, v = np.array([0.1, 0.2, 0.3, 0.8, -0.4, 0.4, 0.2]), np.array([0.5, -0.2, 0.1, 1.5, 0.5, 2.0])
    motion = tree_motion(mechanism, q, v, [0.75, 1.5])
    for at, t, error in zip(motion.q, [0.75, 1.5], motion.error, strict=True):
        first = rotations(q[None, 3:])[0]
        own = np.array([0.0, 0.0, (along - across) / across * v[5]])
        momentum = first @ (np.array([across, across, along]) * v[3:])
        expected = expm(cross(momentum / across) * t) @ first @ expm(-cross(own) * t)
        assert np.abs(rotations(at[None, 3:])[0] - expected).max() <= error
        assert np.abs(at[:3] - q[:3] - t * v[:3]).max() <= error
        assert np.linalg.norm(at[3:]) == pytest.approx(1, abs=1e-15)
    assert motion.error.max() < 1e-8


def cross(x):
    return np.array([[0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]])


def test_kept_end_points_are_those_of_the_catalogue():
    kept = json.loads(tree_end_points.PATH.read_text(encoding="utf-8"))
    moving = [scene for scene in find_scenes(None) if isinstance(scene, TreeScene) and tree_end_points.moves(scene)]
    assert {scene.name for scene in moving} == {
        "cart-pole",
        "cart-two-poles",
        "acrobot",
        "hopper",
        "arm-7",
        "quadruped",
        "humanoid",
    }
    again = "the scene has changed: python -m furiko.reference.truth.tree_end_points"
    assert {tree_end_points.key(scene): scene.name for scene in moving} == {
        key: entry["scene"] for key, entry in kept.items()
    }, again


@pytest.mark.parametrize("name", ["cart-pole", "acrobot", "hopper", "arm-7", "quadruped", "humanoid"])
def test_dampers_take_energy_away_and_nothing_brings_any(name):
    scene = find_scene(name)
    motion, mechanism = tree_end_points.end_points(scene), scene.system.mechanism()
    q = np.array([scene.q, *motion.q])
    v = np.array([scene.v, *motion.v])
    assert (np.diff(energy(mechanism, q, v).sum(axis=-1)) < 0).all()


def test_without_dampers_energy_is_kept():
    scene = find_scene("cart-two-poles")
    motion, mechanism = tree_end_points.end_points(scene), scene.system.mechanism()
    q, v = np.array([scene.q, *motion.q]), np.array([scene.v, *motion.v])
    total = energy(mechanism, q, v).sum(axis=-1)
    # A step of the finer run is off by 1e-13 of some J; there are a thousand.
    assert np.abs(total[1:] - total[0]).max() < 1e-10


@pytest.mark.parametrize("name", ["quadruped", "humanoid"])
def test_the_centre_of_mass_of_what_is_free_falls_as_a_stone(name):
    """c(t) = c(0) + t p/m + g t²/2, whatever the limbs do."""
    scene = find_scene(name)
    found, mechanism = tree_end_points.end_points(scene), scene.system.mechanism()
    t = np.array([0.0, *tree_end_points.times(scene)])[:, None]
    moved = motion(mechanism, np.array([scene.q, *found.q]), np.array([scene.v, *found.v]))
    centre, mass = centre_of_mass(mechanism, moved, 0)
    linear, _ = momentum(mechanism, moved, 0)
    falls = t * mechanism.gravity
    # Errors of the coordinates in metres and radians, times a reach of a metre; and of the rates.
    assert np.abs(centre - (centre[0] + t * linear[0] / mass + t * falls / 2)).max() <= 4 * found.error.max()
    assert np.abs(linear - (linear[0] + mass * falls)).max() <= 4 * mass * found.error.max()


def test_scenes_without_a_duration_are_not_followed():
    assert not tree_end_points.moves(replace(find_scene("arm-7"), duration=0.0))
