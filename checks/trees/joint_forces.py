"""Joint forces: what each moving link exerts on what carries it, against Newton's and Euler's laws for all below it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...records.check import Result
from .cell import TreeCell
from .verdict import judged

Array = NDArray[np.float64]

NAME = "joint forces"
PARTS = (("force", "N"), ("moment", "N m"))


def compare(cell: TreeCell) -> Iterator[Result]:
    """The engine's forces and moments in the true accelerations, each over the magnitudes of what makes it up.

    The unit is that of the row of a translation and of a rotation of all that hangs there
    (:meth:`Magnitudes.joint_forces`): a free base's own forces cancel, and its moments about a far point.
    """
    count = len(cell.facts.forces)
    last = np.arange(len(cell.states))[-count:]
    high, expected = cell.facts.high[last], cell.facts.forces
    units = [cell.magnitudes[k] for k in last]
    cell = replace(cell, states=cell.states.at(last))
    q, v = cell.states.q, cell.states.v
    got = cell.answer(NAME, cell.engine.joint_forces(q, v, high), expected.shape)
    off = np.linalg.norm((got - expected).reshape(*expected.shape[:2], 2, 3), axis=-1)
    unit = np.array([one.joint_forces(a) for one, a in zip(units, high, strict=True)]).reshape(off.shape)
    links = [link.name for link in cell.scene.system.links if link.joints]

    def says(state: int, index: tuple[int, ...]) -> str:
        link, part = index
        name, of = PARTS[part]
        return f"the {name} of {links[link]!r} on what carries it is off by {off[state, link, part]:.3g} {of}"

    yield judged(cell, NAME, off, unit, says, {})
