"""End points of the catalogue's motions of open mechanisms, kept in ``reference/data/``: each takes seconds.

``python -m furiko.reference.truth.tree_end_points`` computes them again.
"""

from __future__ import annotations

import hashlib
import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ...models import TreeScene, find_scenes
from ...models.writers.whole_file import write_whole
from .tree_motion import TreeMotion, tree_motion

PATH = Path(__file__).parent.parent / "data" / "tree_endpoints.json"
PARTS = (0.125, 0.25, 0.5, 1.0)  # of the duration


def times(scene: TreeScene) -> list[float]:
    """When the motion is looked at [s]."""
    return [scene.duration * part for part in PARTS]


def moves(scene: TreeScene) -> bool:
    """Whether the scene has a motion that is followed: a state, and a duration."""
    return scene.starts and scene.duration > 0


def end_points(scene: TreeScene) -> TreeMotion:
    """The motion at :func:`times`, as it is kept, or computed. Raises ArithmeticError as :func:`tree_motion` does."""
    kept = _kept().get(key(scene))
    if kept is not None:
        return TreeMotion(*(np.array(kept[name]) for name in ("q", "v", "error")))
    assert scene.q is not None
    assert scene.v is not None
    return tree_motion(scene.system.mechanism(), np.array(scene.q), np.array(scene.v), times(scene))


@cache
def _kept() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(PATH.read_text(encoding="utf-8"))
    return found


def key(scene: TreeScene) -> str:
    """A digest of all that the motion depends on."""
    return hashlib.sha256(repr((scene.system, scene.q, scene.v, scene.duration)).encode()).hexdigest()


def main() -> None:
    """Compute and write those of the catalogue."""
    found: dict[str, Any] = {}
    for scene in find_scenes(None):
        if isinstance(scene, TreeScene) and moves(scene):
            assert scene.q is not None
            assert scene.v is not None
            motion = tree_motion(scene.system.mechanism(), np.array(scene.q), np.array(scene.v), times(scene))
            numbers = {name: getattr(motion, name).tolist() for name in ("q", "v", "error")}
            found[key(scene)] = {"scene": scene.name} | numbers
    write_whole(PATH, json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    main()
