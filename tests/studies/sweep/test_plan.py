"""Every cell once, each a function of its number alone; and parameters that do to a mechanism what physics says."""

import itertools
import pickle

import numpy as np
import pytest

import furiko
from furiko.models import TreeScene, find_scene
from furiko.reference.truth.spatial import spatial_truth
from furiko.studies.sweep.declaration import sweep_from_toml
from furiko.studies.sweep.generators import random_system
from furiko.studies.sweep.parameters import varied

GRID = """
engines = ["mujoco", "pinocchio-aba"]
seeds = [3, 8]
states = 4
chunk = 5
[[scenes]]
scenes = ["rods-2", "n-leg-2"]
[scenes.parameters]
gravity = [1.0, 2.0, 4.0]
lengths = [0.5, 1.0]
[[random]]
kind = "n-leg"
links = [2, 3]
"""


def test_the_grid_is_the_product_of_its_axes_and_every_cell_has_one_number():
    sweep = sweep_from_toml(GRID)
    places = [sweep.place(number) for number in range(sweep.scenes)]
    found = [(p.source.label, tuple(p.values.values()), p.seed) for p in places]
    expected = list(itertools.product(["rods-2", "n-leg-2"], itertools.product([1.0, 2.0, 4.0], [0.5, 1.0]), [3, 8]))
    expected += list(itertools.product([f"random n-leg of {n}" for n in (2, 3)], [()], [3, 8]))
    assert found == expected
    assert len({place.name for place in places}) == len(places)
    chunks = [number for chunk in range(sweep.chunks) for number in sweep.numbers(chunk)]
    assert chunks == list(range(sweep.scenes))
    cells = [sweep.cell(number, engine) for number in chunks for engine in sweep.engines]
    assert cells == list(range(sweep.cells))


def test_a_scene_is_the_same_wherever_it_is_made():
    sweep = sweep_from_toml(GRID)
    other = pickle.loads(pickle.dumps(sweep))
    for number in reversed(range(sweep.scenes)):
        assert sweep.scene(sweep.place(number)) == other.scene(other.place(number))
    assert sweep.digest("code") == other.digest("code") != sweep.digest("other code")


@pytest.mark.parametrize("change", [("2.0, 4.0", "2.0, 4.5"), ("seeds = [3", "seeds = [4"), ("chunk = 5", "chunk = 6")])
def test_another_plan_has_another_digest(change):
    assert sweep_from_toml(GRID).digest("") != sweep_from_toml(GRID.replace(*change)).digest("")


def test_random_mechanisms_depend_on_their_seed_and_on_nothing_else():
    for kind in ("rod-chain", "n-leg", "tree"):
        assert random_system(kind, 5, 1) == random_system(kind, 5, 1)
        assert random_system(kind, 5, 1) != random_system(kind, 5, 2)
        assert random_system(kind, 5, 1).n == 5


def accelerations(scene, q, v):
    """By the reference: of a tree the proven ones."""
    if isinstance(scene, TreeScene):
        return spatial_truth(scene.system.mechanism(), q, v).accelerations.enclosure.high
    return furiko.accelerations(scene.system, q, v)


def tree_of_hinges():
    """A random tree without slides, so that all its coordinates are angles."""
    systems = (random_system("tree", 4, seed) for seed in itertools.count())
    system = next(s for s in systems if {joint.kind for joint in s.joints} == {"hinge"})
    return TreeScene("tree", system)


SCENES = [find_scene("rods-3"), find_scene("n-leg-3"), tree_of_hinges()]


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_masses_scale_out_of_free_motion_and_lengths_go_with_gravity(scene):
    # Without dampers and springs the equations of motion are linear in the masses, so that a factor on all of them
    # changes nothing; angles' accelerations go as g/l, so that one factor on both changes nothing either.
    rng = np.random.default_rng(5)
    q, v = rng.normal(size=(2, scene.system.n))
    expected = accelerations(scene, q, v)
    strength = scene.system.gravity if not isinstance(scene, TreeScene) else 9.81
    for values in ({"masses": 3.7}, {"lengths": 2.6, "gravity": 2.6 * strength}):
        found = accelerations(varied(scene, values), q, v)
        # 1e-9: some thousand roundings; a factor that goes astray is an error of the order of one
        assert found == pytest.approx(expected, rel=1e-9)
    assert accelerations(varied(scene, {"gravity": 2 * strength}), q, v) != pytest.approx(expected, rel=1e-3)
    assert accelerations(varied(scene, {"lengths": 2.0}), q, 0 * v) == pytest.approx(
        accelerations(scene, q, 0 * v) / 2, rel=1e-9
    )


def test_single_lengths_and_masses_are_put_where_they_are_said_to_be():
    assert varied(find_scene("rods-3"), {"l2": 7.0}).system.lengths[1] == 7.0
    assert varied(find_scene("rods-3"), {"density": 7.0}).system.density == 7.0
    legs = varied(find_scene("n-leg-3"), {"m1": 7.0, "masses": 2.0}).system
    assert legs.masses == (14.0, *(2 * mass for mass in find_scene("n-leg-3").system.masses[1:]))


def test_a_slides_numbers_are_lengths():
    cart = find_scene("cart-pole")
    longer = varied(cart, {"lengths": 3.0})
    (before,), (after,) = (
        [joint for joint in scene.system.joints if joint.kind == "slide"] for scene in (cart, longer)
    )
    assert (after.ref, after.springref) == (3 * before.ref, 3 * before.springref)
    assert longer.system.reach == pytest.approx(3 * cart.system.reach)
    assert varied(cart, {}) is cart
