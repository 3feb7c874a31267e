"""One target: a figure that furiko should reach, and the figure that was measured."""

from __future__ import annotations

from dataclasses import dataclass

MARKS = {True: "✓", False: "✗", None: "–"}


@dataclass(frozen=True)
class Target:
    """``asked`` and ``got`` in words; ``met``: None where it could not be measured, then ``says`` tells why.

    ``share``: got over asked, so that 1 or more is met.
    """

    name: str
    asked: str
    got: str
    met: bool | None
    share: float | None = None
    says: str = ""

    def text(self) -> str:
        """For a terminal."""
        share = f" [{self.share:.2f} of what is asked]" if self.share is not None else ""
        line = f"{MARKS[self.met]} {self.name}: asked {self.asked or '–'}, got {self.got or '–'}{share}"
        return f"{line}\n    {self.says}" if self.says else line
