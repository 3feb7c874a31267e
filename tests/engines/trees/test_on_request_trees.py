"""Engines that run only where they are named, with open mechanisms: they agree with what is proven.

Skipped where they are not installed.
"""

import pytest

from furiko.checks.trees import accelerations, derivatives, energy, terms
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import engine_info, load_tree_engine, names_on_request
from furiko.models import find_scene
from furiko.models.trees.scene import TreeScene
from furiko.models.trees.states import tree_states
from furiko.models.trees.system import TreeJoint, TreeLink, TreeSystem

ENGINES = [name for name in names_on_request() if engine_info(name).tree]
SIDE, UP = (0.3, -0.2, 0.1), (0.1, 0.2, 0.4)
# Everything that a joint of theirs may have, two joints on one link, turned frames, and links in no order of depth.
LINKS = (
    TreeLink(
        "hip",
        -1,
        position=SIDE,
        quaternion=(0.9, 0.1, -0.3, 0.2),
        mass=1.3,
        centre=UP,
        inertia=(0.2, 0.3, 0.25, 0.01, -0.02, 0.03),
        joints=(
            TreeJoint("track", "slide", axis=(1.0, 0.2, 0.0), ref=0.1, stiffness=3.0, springref=0.4, damping=0.2),
            TreeJoint("turn", "hinge", axis=(0.1, 1.0, 0.3), anchor=SIDE, ref=-0.3, armature=0.05, stiffness=1.0),
        ),
    ),
    TreeLink(
        "arm",
        0,
        position=UP,
        mass=0.7,
        centre=SIDE,
        inertia=(0.02, 0.03, 0.025, 0.0, 0.0, 0.0),
        joints=(TreeJoint("shoulder", "ball", anchor=UP, damping=0.1, armature=0.02),),
    ),
    TreeLink(
        "tool",
        1,
        position=SIDE,
        quaternion=(0.5, 0.5, 0.5, -0.5),
        mass=0.2,
        centre=UP,
        inertia=(0.01, 0.01, 0.01, 0.0, 0.0, 0.0),
    ),
    TreeLink(
        "leg",
        0,
        position=UP,
        mass=0.5,
        centre=SIDE,
        inertia=(0.01, 0.02, 0.02, 0.0, 0.0, 0.0),
        joints=(TreeJoint("knee"),),
    ),
    TreeLink(
        "bird", -1, mass=0.3, centre=UP, inertia=(0.03, 0.02, 0.04, 0.0, 0.0, 0.0), joints=(TreeJoint("air", "free"),)
    ),
)
SCENES = (
    TreeScene("everything", TreeSystem(LINKS, (0.5, -0.3, -9.0))),
    find_scene("cart-pole"),
    find_scene("quadruped"),
)


def test_who_takes_trees():
    assert {"mjx", "mjx-float32", "mujoco-warp"} <= set(ENGINES)


@pytest.mark.slow  # JAX and Warp compile for each mechanism
@pytest.mark.parametrize("name", ENGINES)
@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_it_agrees_with_what_is_proven(name, scene):
    info = engine_info(name)
    pytest.importorskip(info.module, exc_type=ImportError)
    looked_at = tree_states(scene, 3)
    facts = tree_facts(scene, looked_at, motion=False, slopes="derivatives" in info.tree.offers)
    cell = TreeCell(scene, info, load_tree_engine(name, scene.system), looked_at, facts)
    compared = [*accelerations.compare(cell), *terms.compare(cell)]
    if "energy" not in info.tree.missing:
        compared += energy.compare(cell)
    if "derivatives" in info.tree.offers:
        compared += derivatives.compare(cell)
    assert {result.outcome for result in compared} <= {"agrees", "skipped"}, compared
    assert sum(result.outcome == "agrees" for result in compared) >= 5
