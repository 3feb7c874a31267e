"""What a teacher fixes: a submission is held to it and cannot change it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ...models.errors import InvalidInput
from .declaration import WORDS
from .submission import Submission


@dataclass(frozen=True)
class Pinned:
    """The problem. A part that is None is left to the submission."""

    system: str | None = None
    links: int | None = None
    angles: str | None = None

    def fields(self) -> dict[str, Any]:
        """What it says, as the fields of a derivation."""
        return {name: value for name, value in vars(self).items() if value is not None}

    def check(self, s: Submission) -> None:
        """Raises InvalidInput where the submission states another problem."""
        angles = "relative" if s.relative else "absolute"
        system, usual = WORDS.get(self.system or "", (self.system, None))
        for name, fixed, found in (
            ("system", system, s.kind), ("links", self.links or usual, s.space.n), ("angles", self.angles, angles),
        ):  # fmt: skip
            if fixed is not None and fixed != found:
                raise InvalidInput(f"{name}: the problem is {fixed!r}, this file says {found!r}; it cannot change that")
