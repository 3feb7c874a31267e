"""Whether anything moves in what is given as an equation of motion."""

from __future__ import annotations

from collections.abc import Sequence

from ....models.errors import InvalidInput
from ...algebra.trig import Formula, Space


def require_motion(space: Space, rows: Sequence[tuple[str, Formula]]) -> None:
    """Raises InvalidInput for m = 0.2, which is no equation of motion, wrong or right."""
    for label, row in rows:
        if row and not space.by_time(row) and not any(space.accelerations(key[0]) for key in row.terms):
            raise InvalidInput(
                f"equations.{label:.40}: nothing that moves is in it: no coordinate, rate or acceleration. Say what a "
                "letter is in [define], and give the equations of motion; give those that stand in comments alone"
            )
