"""Rows that are no equations of motion: what a quantity or a coordinate is set to, which says nothing of the mechanics.

``m = 0.2`` of a program is one, and so is a ``theta = 0.1`` at its start. A verdict on such a row would be about a row
that its author never wrote as one.
"""

from __future__ import annotations

from ....models.errors import InvalidInput
from ...algebra.trig import Formula, Space
from ...reading.submission import Submission


def require_motion(s: Submission) -> None:
    """Raises InvalidInput where a row is none of motion, before a derivation is called wrong for it.

    Of rows that were cut out of one text, each needs an acceleration; of rows that were given one by one, each needs
    something that moves.
    """
    rows = s.rows if s.stages is None else s.stages.equations or s.stages.solved or ()
    written = dict(s.lines)
    for label, f in rows:
        if not f or not _is_none(s.space, f, cut=s.cut):
            continue
        said = written.get(label, f"row {label}")[:60]
        raise InvalidInput(
            f"equations: {said!r} is a value, or a step on the way, and no equation of "
            "motion, which says what an acceleration depends on: give the equations of motion alone, a row each"
        )


def _is_none(space: Space, f: Formula, *, cut: bool) -> bool:
    n, places = space.n, space.places(f)
    moving = {p for p in places if p < 2 * n or 4 * n + 2 <= p < 5 * n + 2}
    turns = any(harmonics for _, harmonics, _ in f.terms)
    if not moving and not turns:
        return True
    accelerations = {p for p in places if p < n}
    # of one acceleration, made of lengths and masses: a name that looks like it, as \alpha of an inertia
    is_value = not turns and len(moving) == 1 and 4 * n not in places
    return cut and (not accelerations or is_value)
