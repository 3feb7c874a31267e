"""Symmetries of trees: the true motion has each of them, a right engine too, and one that lacks one is found by it."""

from dataclasses import replace

import numpy as np
import pytest
from fake_tree_engines import Right
from score_trees import random_tree

from furiko.checks.trees import symmetries
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import TreeShape, engine_info, engine_version, load_tree_engine
from furiko.models.scene import scene_from_toml
from furiko.models.trees.scene import TreeScene
from furiko.models.trees.states import random_states, tree_states
from furiko.reference.truth.spatial import spatial_truth

# A block on a rail, with a rod before it and one behind, each of the two on a hinge: one with a spring, one without.
FORKED = """
[system]
kind = "tree"
gravity = [0.5, 0.0, -9.75]
[[system.links]]
name = "block"
mass = 1.25
[[system.links.joints]]
name = "rail"
kind = "slide"
axis = [1.0, 0.25, 0.0]
damping = 0.25
[[system.links]]
name = "front"
parent = "block"
mass = 0.75
centre = [0.125, 0.0, -0.375]
inertia = [0.0625, 0.05, 0.03]
[[system.links.joints]]
name = "pin"
axis = [0.0, 1.0, 0.25]
[[system.links]]
name = "back"
parent = "block"
mass = 0.5
centre = [0.0, 0.125, -0.5]
inertia = [0.05, 0.05, 0.02]
[[system.links.joints]]
name = "other"
axis = [0.0, 1.0, 0.0]
stiffness = 1.5
"""

# For each symmetry an engine's mistake that shows in its image and in no other: where the mechanism and rates are so.
SPOILED = {
    "mirror": lambda m, q, v: m.joints[0].joint.axis[0] < 0,
    "axes": lambda m, q, v: m.gravity[0] < -9,
    "turn": lambda m, q, v: m.gravity[0] < 0 and m.joints[0].joint.axis[0] > 0 and m.gravity[2] < 0,
    "reversal": lambda m, q, v: not m.joints[0].joint.damping and (v == -rates()).all(),
    "2π": lambda m, q, v: np.abs(q).max() > 4,
    "permutation": lambda m, q, v: m.bodies[1].name == "back",
    "split link": lambda m, q, v: len(m.bodies) > 3,
    "mass scale": lambda m, q, v: m.bodies[0].inertial.mass == 10.0,
    "length scale": lambda m, q, v: m.bodies[1].inertial.centre[2] == -1.5,
    "gravity scale": lambda m, q, v: m.gravity[2] == -39.0,
}


def scene():
    return scene_from_toml(FORKED, "forked")


def rates():
    return tree_states(scene(), 3).v[-3:]


def cell(engine=Right, made=None):
    found = made or scene()
    states = tree_states(found, 3)
    shape = TreeShape(engine(found.system.mechanism()), engine.info, found.system.mechanism())
    return TreeCell(found, engine.info, shape, states, tree_facts(found, states, motion=False, slopes=False))


def outcomes(of):
    return {result.check.removeprefix("symmetry "): result.outcome for result in symmetries.compare(of)}


def test_a_right_engine_has_every_symmetry():
    assert outcomes(cell()) == dict.fromkeys(SPOILED, "agrees")


@pytest.mark.parametrize("name", SPOILED)
def test_a_mistake_that_shows_in_one_image_is_found_by_its_symmetry_and_no_other(name):
    class Spoiled(Right):
        def accelerations(self, q, v):
            wrong = SPOILED[name](self.mechanism, q, v)
            return super().accelerations(q, v) * (1 + 1e-9 * bool(wrong))

    found = {result.check: result for result in symmetries.compare(cell(Spoiled))}
    assert [check for check, one in found.items() if one.outcome == "differs"] == [f"symmetry {name}"]
    assert "in state 'random" in found[f"symmetry {name}"].reason


@pytest.mark.parametrize("seed", range(6))
def test_the_true_motion_has_every_symmetry(seed):
    """In ball arithmetic, whose nearest doubles are the same where the image is exact: a third of them without springs.

    A turn by 2π is not: 2e-15 rad, what rounding the angle may be, times slopes of up to 1e3 of accelerations of 1.
    """
    rng = np.random.default_rng(seed)
    system = random_tree(rng, hinges_and_slides=seed % 2 == 0)
    if seed % 3 == 0:
        system = without_springs(system)
    q, v = (np.array([state[k] for state in random_states("x", system, 2)]) for k in (0, 1))
    seen = 0
    for symmetry in symmetries.SYMMETRIES:
        image = symmetry.image(system, q, v)
        if image is None:
            continue
        seen += 1
        before, after = (
            np.array([spatial_truth(one.mechanism(), *state).accelerations.float for state in zip(*at, strict=True)])
            for one, at in ((image.before, (q, v)), (image.after, (image.q, image.v)))
        )
        off = np.abs(image.accelerations.back(after) - before)
        assert (off <= (2e-12 * np.abs(before).max() if symmetry.name == "2π" else 0)).all(), symmetry.name
        assert (off <= symmetries.by_angles(image, q, v) + 2.0**-52 * np.abs(before)).all()
    assert seen >= 7


def without_springs(system):
    links = (replace(link, joints=tuple(replace(j, stiffness=0.0) for j in link.joints)) for link in system.links)
    return replace(system, links=tuple(links))


def test_images_are_other_mechanisms_and_states():
    """Else a symmetry would compare an answer with itself."""
    system = scene().system
    q, v = tree_states(scene(), 3).q[-3:], rates()
    for symmetry in symmetries.SYMMETRIES:
        image = symmetry.image(system, q, v)
        same = image.before == image.after and (image.q == q).all() and (image.v == v).all()
        assert not same, symmetry.name


def test_mechanisms_that_lack_a_symmetry_are_not_asked_for_it():
    """One branch, a spring in every hinge, and a damper on what moves freely, which has one number for two units."""
    system = scene().system
    chain = replace(system, links=(system.links[0], system.links[2]))
    found = outcomes(cell(made=TreeScene("chain", chain, random=3)))
    assert set(SPOILED) - set(found) == {"2π", "permutation"}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["mujoco", "pinocchio-aba", "pinocchio-crba", "exudyn-tree"])
def test_engines_have_them_in_random_trees(name):
    if not engine_version(name):
        pytest.skip(f"{name} is not installed")
    for seed in range(0, 40, 2):
        system = random_tree(np.random.default_rng(7000 + seed), hinges_and_slides=True)
        made = TreeScene(f"random {seed}", system if seed % 4 else without_springs(system), random=3)
        states = tree_states(made, 3)
        facts = tree_facts(made, states, motion=False, slopes=False)
        of = TreeCell(made, engine_info(name), load_tree_engine(name, made.system), states, facts)
        found = list(symmetries.compare(of))
        assert {result.outcome for result in found} == {"agrees"}, found
        assert not any(result.loose for result in found)
