"""What a text says besides its equations: it is passed over and said, and no verdict may contradict it."""

from __future__ import annotations

import re
from dataclasses import replace

from ....models.errors import InvalidInput
from ...reading.submission import Submission
from ...steps.conventions import Convention
from ..grade_record import Grade

MOST_SAID, LONGEST = 4, 60
# A height that is lowest at the angle's zero, y_p = -l cos θ, of a body that the reader does not know by that name
HANGING = re.compile(
    r"^\s*[yY]\s*(?:_\s*(?:\{\s*\w{1,6}\s*\}|\w)|[0-9])?\s*=(?:\s*[-−][^=+−-]*\bcos(?![a-z])[^=+−-]*)+$"
)


def with_passed(made: Grade, s: Submission) -> Grade:
    """The grade with what was said besides, and is no part of it."""
    if not s.passed:
        return made
    said = "; ".join(re.sub(r"\s+", " ", one)[:LONGEST] for one in s.passed[:MOST_SAID])
    more = len(s.passed) - MOST_SAID
    rest, rest_ja = (f"; and {more} more", f" ほか{more}件") if more > 0 else ("", "")
    return replace(
        made, notes=(*made.notes, f"Passed over, as no equation of motion needs it: {said}{rest}"),
        notes_ja=(*made.notes_ja, f"運動方程式に使われないため読み飛ばしたもの：{said}{rest_ja}"),
    )  # fmt: skip


def require_height(s: Submission, convention: Convention) -> None:
    """Raises InvalidInput where a height that was said besides is none in the convention that a verdict rests on."""
    if convention.origin != "down" and any(HANGING.match(one[:400]) for one in s.passed):
        raise InvalidInput(
            f"the equations are right if {convention.words}, and a height that is said besides is lowest where the "
            'angle is zero: which is meant? Say from = "up" or "down", or leave the height out'
        )
