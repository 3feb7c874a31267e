"""The records of ``furiko bench`` and ``furiko advise``: their JSON documents; of a benchmark page and tables are made.

Times are in seconds, the minimum and the median of several; errors are absolute in rad and rad/s for trajectories,
relative to the largest acceleration of a state for accelerations. None: not measured, or not reached.
"""

from __future__ import annotations

from typing import Literal

import msgspec

from .findings import Difference

FORMAT = 1


class Point(msgspec.Struct, frozen=True, kw_only=True):
    """One run of one method: its setting, its time, and its error at the end."""

    engine: str
    scheme: str
    setting: float
    by: str  # the kind of setting: "step [s]" or "tolerance"
    error: float | None  # None: the run did not finish
    minimum: float
    median: float
    rounds: int  # number of timings, in turn with all others; 1: a coarser run of the same method is better
    front: bool  # on the Pareto front: no other run was both faster and more accurate


class Reach(msgspec.Struct, frozen=True, kw_only=True):
    """The time of a method to an error of ``error``, interpolated between two of its runs; never extrapolated."""

    error: float
    engine: str
    scheme: str
    seconds: float | None  # None: not reached
    at_most: bool = False  # its coarsest run already has a smaller error
    ratio: float | None = None  # to furiko's time
    reason: str = ""  # why it was not reached


class Motion(msgspec.Struct, frozen=True, kw_only=True):
    """Time against error at the end of one scene's motion."""

    scene: str
    system: str
    n: int
    duration: float
    truth: float  # error of the reference solution
    points: list[Point]
    reaches: list[Reach]
    left_out: list[str]  # engines without a method, and why
    causes: list[Difference] = []  # why an engine's accelerations or steps are not those of the scene
    proved: bool = False  # ``truth`` is a bound, by a kept proof, not an estimate


class Speed(msgspec.Struct, frozen=True, kw_only=True):
    """Accelerations by one call: time per state, and the largest error in a few states."""

    system: str
    n: int
    states: int  # in one call
    engine: str
    call: str
    threads: int
    minimum: float
    median: float
    error: float | None
    ratio: float | None  # its time per state over furiko's, the median over rounds; None for furiko itself, and trees
    scene: str = ""  # of a tree


class Skip(msgspec.Struct, frozen=True, kw_only=True):
    """Something that a check skips: the time it saves, and whether the verdicts are the same with and without."""

    name: str
    says: str
    same: bool
    verdicts: int  # number compared
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


class Bench(msgspec.Struct, frozen=True, kw_only=True):
    """One run of ``furiko bench``."""

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
    sharpness: list[Sharpness] = []


class Advised(msgspec.Struct, frozen=True, kw_only=True):
    """A method that reaches the error asked for, at the largest step (or tolerance) that does.

    ``error``: the largest of θ [rad] and ω [rad/s] at the times looked at; ``seconds``: the median of several runs;
    ``coarser_setting``, ``coarser_error``: the run before, which misses the error asked for (None: it failed, or there
    is none so coarse).
    """

    engine: str
    scheme: str
    by: str  # the kind of setting: "step [s]" or "tolerance"
    setting: float
    error: float
    seconds: float
    coarser_setting: float | None
    coarser_error: float | None


class NotAdvised(msgspec.Struct, frozen=True, kw_only=True):
    """A method that does not reach the error: its smallest one (None: no run ended), and why there is none smaller."""

    engine: str
    scheme: str
    error: float | None
    reason: str


class TrustLimit(msgspec.Struct, frozen=True, kw_only=True):
    """How far one mechanism can be taken along one axis until an engine's accelerations are not to be trusted."""

    axis: str
    says: str
    closed: bool  # nothing is left to be asked between the two values
    holds_at: str | None = msgspec.field(name="holds at")  # the last value with its unit; None: not even the first
    fails_at: str | None = msgspec.field(name="fails at")  # the first that fails; None: none that was tried
    rung: int | None  # of that, from 0, the mechanism as it is
    failure: str | None
    reason: str


class Trust(msgspec.Struct, frozen=True, kw_only=True):
    """Whether an engine's accelerations of one open mechanism are to be trusted, measured against proven ones."""

    engine: str
    verdict: Literal["right", "loses digits", "open", "wrong", "failed", "refused"]
    reason: str
    digits: float | None  # correct decimal digits of a typical state
    error: float | None  # relative to the largest acceleration
    error_over_bound: float | None = msgspec.field(name="error over bound")  # above 1 no rounding explains it
    limits: list[TrustLimit]


class LongMotion(msgspec.Struct, frozen=True, kw_only=True):
    """What an advised integrator keeps with its step in the long run, of the scene or of a motion known for ever."""

    engine: str
    scheme: str
    step: float  # [s]
    motion: str  # the scene's name, or that of a known motion of joints that the scene has, too
    says: str
    time: float  # [s], the longest that was run
    phase_error: float | None = msgspec.field(name="phase error")  # None: of the scene itself, or not finite
    energy_drift: float | None = msgspec.field(name="energy drift")  # None: dampers take it, or it is not finite
    length_drift: float | None = msgspec.field(name="length drift")  # of quaternions
    failure: str | None  # what makes it another motion at that time; None: nothing


class Advice(msgspec.Struct, frozen=True, kw_only=True):
    """Which engine, integrator and step to use for one scene; ``furiko advise --json`` prints it.

    Every error is measured in this scene, over ``duration`` [s], against a motion whose own estimated error is
    ``truth``. ``advised``: engines first, the fastest first; furiko itself last. An open mechanism without a motion has
    the trust alone.
    """

    furiko: str
    command: str
    machine: dict[str, str]
    versions: dict[str, str]
    scene: str
    system: str
    n: int
    duration: float
    asked: float
    truth: float
    seconds: float
    advised: list[Advised]
    not_advised: list[NotAdvised]
    left_out: list[str]  # engines without a method, and why
    long_runs: list[LongMotion] = msgspec.field(name="long runs", default=[])  # of open mechanisms
    trust: list[Trust] = []  # of open mechanisms: whether engines' accelerations are right, and how far they stay so
