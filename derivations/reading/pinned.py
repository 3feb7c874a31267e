"""What a teacher fixes: a submission is held to it and cannot change it."""

from __future__ import annotations

from dataclasses import dataclass

from ...models.errors import InvalidInput
from .submission import Submission


@dataclass(frozen=True)
class Pinned:
    """The problem. A part that is None is left to the submission."""

    system: str | None = None
    links: int | None = None
    angles: str | None = None

    def check(self, s: Submission) -> None:
        """Raises InvalidInput where the submission states another problem."""
        angles = "relative" if s.relative else "absolute"
        for name, fixed, found in (
            ("system", self.system, s.kind), ("links", self.links, s.space.n), ("angles", self.angles, angles),
        ):  # fmt: skip
            if fixed is not None and fixed != found:
                raise InvalidInput(f"{name}: the problem is {fixed!r}, this file says {found!r}; it cannot change that")
