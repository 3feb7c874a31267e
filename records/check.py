"""The result stream's records: one header, a result for each comparison, one footer.

They stand here so that the checks, which make them, and the reports, which read them, need not know each other.
"""

from __future__ import annotations

from typing import Any, Literal

import msgspec

FORMAT = 2  # 2: a result carries `comparison`
Outcome = Literal["agrees", "differs", "skipped", "error"]
OUTCOMES: tuple[Outcome, ...] = ("agrees", "differs", "skipped", "error")


class SceneEntry(msgspec.Struct, frozen=True, kw_only=True):
    """What the header says of a scene, so that a report needs nothing but the stream."""

    name: str
    system: str  # n-leg or rod-chain
    n: int
    lengths: list[float]
    masses: list[float]
    gravity: float
    duration: float = 0.0
    states: int = 0
    description: str = ""
    equations: list[str] = []
    tags: list[str] = []
    source: str = ""  # what to pass to `furiko check` to run it again: a name or a file's path


class EngineEntry(msgspec.Struct, frozen=True, kw_only=True):
    """What the header says of an engine."""

    name: str
    formulation: str
    package: str
    version: str = ""  # empty: not installed


class Header(msgspec.Struct, frozen=True, kw_only=True, tag_field="kind", tag="header"):
    """First line of a stream: what ran, where, with what."""

    format: int = FORMAT
    furiko: str
    started: str  # ISO 8601, UTC
    command: str
    profile: str
    seed: str  # how random states are seeded
    machine: dict[str, str]
    versions: dict[str, str]
    scenes: list[SceneEntry]
    engines: list[EngineEntry]


class Result(msgspec.Struct, frozen=True, kw_only=True, tag_field="kind", tag="result"):
    """One comparison of one quantity, for one scene and one engine.

    ``measured`` and ``allowed`` are in ``unit`` (``ε``: multiples of 2⁻⁵² of the sum of the terms' magnitudes); None
    where nothing was measured. ``cause``: a stable code, where one is known. ``reason``: a sentence: why it differs,
    was skipped or failed, or where the bound comes from. ``loose``: it agrees, being within the proven bound, but is
    further off than rounding explains in this state. ``details``: further figures, check by check.
    """

    scene: str
    engine: str
    check: str  # the comparison, and which part of it: "terms M", "trajectory RK4"
    outcome: Outcome
    comparison: str = ""  # the name of the check that made it; empty in runs of the stress test
    measured: float | None = None
    allowed: float | None = None
    unit: str = ""
    cause: str | None = None
    reason: str = ""
    seconds: float = 0.0
    loose: bool = False
    kept: bool = False  # from an earlier run with the very same inputs
    details: dict[str, Any] = {}


class Footer(msgspec.Struct, frozen=True, kw_only=True, tag_field="kind", tag="footer"):
    """Last line of a stream. A stream without it was cut off."""

    agrees: int
    differs: int
    skipped: int
    error: int
    loose: int = 0  # of those that agree
    seconds: float = 0.0


Record = Header | Result | Footer
