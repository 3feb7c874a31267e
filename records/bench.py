"""What ``furiko bench`` measured: the records of its JSON document, which the page is drawn from.

Times are in seconds, the minimum and the median of several; errors are absolute in rad and rad/s for trajectories,
relative to the largest acceleration of a state for accelerations. None stands for what could not be had.
"""

from __future__ import annotations

import msgspec

FORMAT = 1


class Point(msgspec.Struct, frozen=True, kw_only=True):
    """One run of one method: what it was set to, what it took, and how far off it ended."""

    engine: str
    scheme: str
    setting: float
    by: str  # what the setting is: "step [s]" or "tolerance"
    error: float | None  # None: it did not come to its end
    minimum: float
    median: float
    rounds: int  # how often it was timed, in turn with all the others; 1: a coarser run of its own beats it
    front: bool  # on the Pareto front: no other run was both faster and nearer


class Reach(msgspec.Struct, frozen=True, kw_only=True):
    """What a method takes to come within ``error``, between two of its measured runs; never beyond them."""

    error: float
    engine: str
    scheme: str
    seconds: float | None  # None: not reached
    at_most: bool = False  # its coarsest run is already nearer than asked
    ratio: float | None = None  # to furiko's own
    reason: str = ""  # why it was not reached


class Motion(msgspec.Struct, frozen=True, kw_only=True):
    """Time against error at the end of one scene's motion."""

    scene: str
    system: str
    n: int
    duration: float
    truth: float  # estimated error of the truth that all are held against
    points: list[Point]
    reaches: list[Reach]
    left_out: list[str]  # sentences: which engine, and why


class Speed(msgspec.Struct, frozen=True, kw_only=True):
    """Accelerations by one call: time a state, and the largest error in a few states."""

    system: str
    n: int
    states: int  # in one call
    engine: str
    call: str
    threads: int
    minimum: float
    median: float
    error: float | None
    ratio: float | None  # median of its time over furiko's, a state, round by round; None for furiko itself


class Skip(msgspec.Struct, frozen=True, kw_only=True):
    """Something that a run leaves out: what it saves, and whether the verdicts are the same with it and without."""

    name: str
    says: str
    same: bool
    verdicts: int  # how many were compared
    seconds_with: float
    seconds_without: float


class Sharpness(msgspec.Struct, frozen=True, kw_only=True):
    """Smallest relative error in an entry that a run notices, for one scene, engine and quantity, at its worst entry.

    ``noticed``: an error of so much of the entry, in every state, is loose or differs; ``own``: the 99th percentile,
    over states, of the engine's own relative error there (one ε at least); ``ratio`` of the two. ``entry``: the worst,
    counted from one. ``planted``: faults of twice what is noticed, planted in the first, a middle and the last entry;
    ``found``: how many of them a run noticed.
    """

    scene: str
    engine: str
    quantity: str
    states: int
    noticed: float
    own: float
    ratio: float
    entry: list[int]
    planted: int
    found: int


class Target(msgspec.Struct, frozen=True, kw_only=True):
    """A figure that furiko is to reach, and what this run got."""

    name: str
    asked: str
    got: str
    met: bool | None  # None: could not be measured, ``says`` tells why
    share: float | None = None  # got over asked, so that 1 or more is met
    says: str = ""


class Bench(msgspec.Struct, frozen=True, kw_only=True):
    """All of one run."""

    format: int = FORMAT
    furiko: str
    started: str  # ISO 8601, UTC
    command: str
    machine: dict[str, str]
    threads: dict[str, str]
    versions: dict[str, str]
    budget: float
    seconds: float
    notes: list[str]
    motions: list[Motion] = []
    speeds: list[Speed] = []
    skips: list[Skip] = []
    targets: list[Target] = []
