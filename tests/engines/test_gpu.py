"""Engines on a CUDA device, thousands of states at once, each held against the proven accelerations.

Skipped where there is none, or where JAX or Warp is not installed.
"""

from dataclasses import replace

import numpy as np
import pytest

from furiko.checks.cell import Cell
from furiko.checks.comparisons.accelerations import backward_error
from furiko.checks.facts import scene_facts
from furiko.checks.trees import accelerations
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import engine_info, load_engine, load_tree_engine
from furiko.models import find_scene
from furiko.models.states import states
from furiko.models.trees.states import tree_states
from furiko.reference.rounding.bounds import allowed

pytestmark = [pytest.mark.gpu, pytest.mark.slow]  # proofs of thousands of states

ENGINES = ["mjx", "mjx-float32", "mujoco-warp"]
BATCH = 4096
TREE_BATCH = 64  # what is proven of a tree in space costs far more than of the documents' mechanisms


@pytest.fixture(params=ENGINES)
def on_gpu(request):
    """An engine that computes on a CUDA device."""
    pytest.importorskip(engine_info(request.param).module, exc_type=ImportError)
    if request.param == "mujoco-warp":
        from furiko.engines.mujoco_warp import warp

        there = warp.get_device().is_cuda
    else:
        from furiko.engines.mjx import jax

        there = jax.default_backend() == "gpu"
    if not there:
        pytest.skip("no CUDA device is found")
    return request.param


@pytest.fixture(scope="module")
def proven():
    """States of a scene, given and random, and the truth in them: once for all engines."""
    known = {}

    def of(name):
        if name not in known:
            scene = replace(find_scene(name), random=BATCH)
            looked_at = states(scene, BATCH)
            known[name] = scene, looked_at, scene_facts(scene, looked_at, slopes=False)
        return known[name]

    return of


@pytest.mark.parametrize("name", ["double-pendulum", "rods-5", "rods-20"])
def test_thousands_of_states_at_once_agree_with_what_is_proven(on_gpu, proven, name):
    scene, looked_at, facts = proven(name)
    loaded = load_engine(on_gpu, scene.system)
    cell = Cell(scene, loaded.info, loaded, looked_at, facts)
    error, judged = backward_error(cell, loaded.accelerations(looked_at.theta, looked_at.omega), cell.amplitude)
    assert len(error) >= BATCH
    assert judged.all()
    # Of the terms, which it is of whether or not single precision has a digit of the accelerations themselves.
    assert error.max() <= allowed(scene.system.n, loaded.info.accuracy)


@pytest.mark.parametrize("name", ["cart-pole", "quadruped"])
def test_trees_agree_with_what_is_proven(on_gpu, name):
    scene = find_scene(name)
    looked_at = tree_states(scene, TREE_BATCH)
    facts = tree_facts(scene, looked_at, motion=False, slopes=False)
    cell = TreeCell(scene, engine_info(on_gpu), load_tree_engine(on_gpu, scene.system), looked_at, facts)
    compared = list(accelerations.compare(cell))
    assert [result.outcome for result in compared] == ["agrees"], compared


def test_a_state_is_answered_as_if_it_were_alone(on_gpu):
    """By another kernel, of another size: the same but for rounding, which each of some hundred operations has."""
    scene = replace(find_scene("rods-5"), random=BATCH)
    looked_at = states(scene, BATCH)
    loaded = load_engine(on_gpu, scene.system)
    together = loaded.accelerations(looked_at.theta, looked_at.omega)
    for row in (0, 17, BATCH - 1):
        alone = loaded.accelerations(looked_at.theta[row], looked_at.omega[row])
        assert np.abs(alone - together[row]).max() <= 1e4 * loaded.info.accuracy * np.abs(together[row]).max()
