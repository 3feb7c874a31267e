"""Accelerations of an open mechanism: time a state against error, through each engine's adapter.

furiko has no fast accelerations of its own for such mechanisms: there is no ratio to them. The errors are against
enclosures in ball arithmetic, in a few random states.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from ...engines import cannot, engine_info, load_tree_engine
from ...models import TreeScene
from ...models.trees.states import random_states
from ...records.bench import Speed
from ...reference.truth.spatial import spatial_truth
from .timing import Subject, Times, interleaved

BATCHES = (1, 64)
CHECKED_STATES = 4


def tree_speeds(scene: TreeScene, engines: Sequence[str], budget: float) -> list[Speed]:
    """Each engine that takes the scene, in calls of one state and of many, timed in about ``budget`` [s]."""
    system = scene.system
    states = random_states("speed", system, max(BATCHES))
    q, v = (np.array(values) for values in zip(*states, strict=True))
    loaded = {name: load_tree_engine(name, system) for name in engines if not cannot(engine_info(name), system)}
    subjects = {
        (name, batch): Subject(partial(engine.accelerations, q[:batch], v[:batch]))
        for name, engine in loaded.items()
        for batch in BATCHES
    }
    times = interleaved({f"{name} {batch}": subject for (name, batch), subject in subjects.items()}, budget=budget)
    mechanism = system.mechanism()
    truth = [spatial_truth(mechanism, *state).accelerations.enclosure for state in states[:CHECKED_STATES]]
    errors = {
        name: max(
            float(one.error(got).max() / np.abs(one.high).max())
            for one, got in zip(truth, engine.accelerations(q[:CHECKED_STATES], v[:CHECKED_STATES]), strict=True)
        )
        for name, engine in loaded.items()
    }
    found = []
    for name, batch in subjects:
        took = Times(times[f"{name} {batch}"].seconds / batch)
        found.append(
            Speed(
                system=system.kind,
                n=system.n,
                scene=scene.name,
                states=batch,
                engine=name,
                call="through furiko's adapter",
                threads=1,
                minimum=took.minimum,
                median=took.median,
                error=errors[name],
                ratio=None,
            )
        )
    return found
