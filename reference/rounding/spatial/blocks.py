"""What inverting the block of a joint of several degrees of freedom loses, as engines do that go joint by joint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....models.spatial_mechanism import Array, SpatialMechanism


@dataclass(frozen=True, eq=False)
class Blocks:
    """``moves`` (nv, bodies): 1 where a degree of freedom moves a body; ``first_moved`` (nv,): the body of its joint.

    ``together``: whether the joints of one body may be one joint of the engine's.
    """

    mechanism: SpatialMechanism
    moves: Array
    first_moved: NDArray[np.intp]
    together: bool

    def inverted(self, mass: Array, rows: Array, shares: Array, swings: Array, pull: Array) -> Array:
        """What inverting the block D of a ball's or a free joint's degrees of freedom adds to the units ``rows`` (nv,).

        D is M's block with all that hangs on the joint eliminated. Scaled to a diagonal of ones, S D S = E, a stable
        inverse X leaves |E X − 1| ≤ c ε |E⁻¹|, so that of D a = u the row S⁻¹ |E⁻¹| |S u| is lost. u is made of all
        that the rows add up, and of what the acceleration before the joint does there. Nothing moves before the first
        joint: but for gravity, whose ``pull`` (nv,) engines put there, u is D a itself, and S u at most |E| |S⁻¹ a|,
        with ``swings`` |a|. So the rates, whose terms cancel but for D a, are not multiplied by |E⁻¹| in the rows of a
        free base.

        What is taken off the inertia that the joint hands on, U X Uᵀ, is at most that inertia, but its terms are up to
        |E⁻¹| times as large: the ``shares`` (nv, bodies) of what hangs on the joint, in the rows of all joints before.
        """
        found = np.zeros_like(rows)
        for block in self._blocks():
            own = slice(0, block.stop - block.start)
            below = self.moves[block.start] > 0
            hanging = np.flatnonzero(below[self.first_moved] & (np.arange(len(rows)) >= block.start))
            root = np.sqrt(np.diag(mass)[hanging])
            if not (root > 0).all():
                continue
            try:  # of M scaled to a diagonal of ones: its inverse is in the range of doubles, whatever the units are
                inverse = np.linalg.inv(mass[np.ix_(hanging, hanging)] / root[:, None] / root)[own, own]
                scale = np.sqrt(np.abs(np.diag(np.linalg.inv(inverse))))
            except np.linalg.LinAlgError:
                continue  # a singular matrix has no accelerations that could be judged
            scaled = scale[:, None] * inverse * scale
            grown = float(np.linalg.norm(scaled, 2))
            scale = scale * root[own]
            if self._first(block):
                widest = np.repeat(scale.reshape(-1, 3).max(axis=1), 3)  # whichever axes the engine has
                carried = np.linalg.norm(np.linalg.inv(scaled), 2) * np.linalg.norm(widest * swings[block])
                meets = carried + np.linalg.norm(pull[block] / scale)
            else:
                meets = np.linalg.norm(rows[block] / scale)
            found[block] += scale * grown * meets
            before = slice(0, block.start)
            found[before] += (
                grown * (self.moves[:, self.first_moved[block.start]] * shares[:, below].sum(axis=1))[before]
            )
        return found

    def _first(self, block: slice) -> bool:
        """Whether the block is a single joint, and none moves what it hangs on."""
        one = next(one for one in self.mechanism.joints if one.at_v == block.start)
        return one.columns_v == block and not self.moves[: block.start, one.body].any()

    def _blocks(self) -> list[slice]:
        """The rows of each block of M that is inverted as a whole."""
        found: dict[tuple[int, int], slice] = {}
        for number, one in enumerate(self.mechanism.joints):
            key = (one.body, 0 if self.together else number)
            start = found[key].start if key in found else one.at_v
            found[key] = slice(start, one.columns_v.stop)
        return [block for block in found.values() if block.stop - block.start > 1]
