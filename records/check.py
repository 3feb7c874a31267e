"""The result stream's records: one header, a result for each comparison, diagnoses, one footer.

The checks make them and the reports read them; neither imports the other.
"""

from __future__ import annotations

from typing import Any, Literal

import msgspec

from .findings import Difference

FORMAT = 2  # 2: a result carries `comparison`
Outcome = Literal["agrees", "differs", "skipped", "error"]
OUTCOMES: tuple[Outcome, ...] = ("agrees", "differs", "skipped", "error")


class SceneEntry(msgspec.Struct, frozen=True, kw_only=True):
    """One scene in the header, so that a report needs nothing but the stream."""

    name: str
    system: str  # n-leg, rod-chain or tree
    n: int  # degrees of freedom
    lengths: list[float]
    masses: list[float]
    gravity: float
    duration: float = 0.0
    states: int = 0
    description: str = ""
    equations: list[str] = []
    tags: list[str] = []
    source: str = ""  # what to pass to `furiko check` to run it again: a name or a file's path
    asked: bool = False  # the user named it: a run in which nothing of it was compared is incomplete
    joints: list[str] = []  # of a tree: each joint's name and kind
    own: list[str] = []  # how a user's own equations were read: joints, angles, what was taken from the model, rows
    outline: list[tuple[float, float, float, float]] = []  # of a tree, seen along y: lines x, z to x, z [m]


class EngineEntry(msgspec.Struct, frozen=True, kw_only=True):
    """One engine in the header."""

    name: str
    formulation: str
    package: str
    version: str = ""  # empty: not installed
    place: str = ""  # a phrase on its environment, where it does not run beside furiko
    untested: str = ""  # a sentence where this version is none that furiko was tested with
    asked: bool = False  # the user named it: a run in which nothing was compared with it is incomplete


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
    was skipped or failed, or where the bound comes from. ``details``: further figures, check by check. ``loose``: the
    result agrees, since ``measured`` is within ``allowed``, but it is beyond ``line``, which rounding does not exceed
    in this state.
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
    in_engine: float = 0.0  # [s] of those, in calls of the engine
    kept: bool = False  # from an earlier run with the very same inputs
    loose: bool = False  # only where it agrees
    line: float | None = None  # the sharp line, in `unit`; None: there is none
    details: dict[str, Any] = {}


class Diagnosis(msgspec.Struct, frozen=True, kw_only=True, tag_field="kind", tag="diagnosis"):
    """Why one engine differs in one scene: everything that was found.

    All of ``findings`` hold together. Where ``alternatives`` has entries, exactly one of them holds besides: the
    measurements cannot tell which. ``explains``: the ``check`` of each result that these causes explain together. A
    finding whose cause is ``unexplained`` describes what is left.
    """

    scene: str
    engine: str
    findings: list[Difference] = []
    alternatives: list[Difference] = []
    explains: list[str] = []


class Footer(msgspec.Struct, frozen=True, kw_only=True, tag_field="kind", tag="footer"):
    """Last line of a stream. A stream without it was cut off.

    ``digest``: the SHA-256 of every byte of the stream before its own value, in hexadecimal; empty in a run that was
    not written.
    """

    agrees: int
    differs: int
    skipped: int
    error: int
    loose: int = 0  # of those that agree
    diagnoses: int = 0
    seconds: float = 0.0
    digest: str = ""  # the last field: what stands before it in the line is in it


Record = Header | Result | Diagnosis | Footer


KnownState = Literal["differs", "agrees", "another-cause", "failed", "stale"]


class KnownDifference(msgspec.Struct, frozen=True, kw_only=True):
    """An entry of a file of known differences, and what this run says of it.

    ``scene``, ``engine``, ``check``: patterns (``*``, ``?``, ``[abc]``); ``cause``: the cause's code, empty for any.
    ``state``: some results differ as it says (``differs``); all that ran agree (``agrees``); some differ, but for
    another cause; none could be compared (``failed``); nothing that was run is meant by it (``stale``).
    ``results``: scene, engine and check of each difference that it accounts for.
    """

    scene: str
    engine: str
    check: str
    cause: str
    reason: str
    link: str
    state: KnownState
    results: list[tuple[str, str, str]] = []


class Alone(msgspec.Struct, frozen=True, kw_only=True):
    """Which of three is alone in a scene with a user's own equations: these, the model, or engines.

    ``nobody``: all agree; ``several``: equations and engines differ from the theory. ``names``: of the engines that
    are alone; ``says``: in sentences, with the causes.
    """

    scene: str
    who: Literal["nobody", "equations", "model", "engine", "several"]
    names: list[str]
    says: str


class Advisable(msgspec.Struct, frozen=True, kw_only=True):
    """A scene of which ``furiko advise`` has more to say than this run: which engine, integrator and step to trust.

    ``engine``, ``check``: the result that tells most; ``why``: that it is loose, that a motion differs, or that it
    agrees and is limited by its step: it parts from the true motion, or is known to no better than that.
    """

    scene: str
    engine: str
    check: str
    why: Literal["differs", "loose", "limited by its step"]
    command: str


class CheckReport(msgspec.Struct, frozen=True, kw_only=True):
    """One run of ``furiko check``: what ``--json`` prints."""

    header: Header
    results: list[Result]
    footer: Footer | None  # None: the run was cut off
    diagnoses: list[Diagnosis] = []
    known: list[KnownDifference] = []  # one an entry of the file of known differences
    alone: list[Alone] = []  # one a scene with a user's own equations
    advisable: list[Advisable] = []  # one a scene of which `furiko advise` has more to say


ChangeKind = Literal[
    "broke", "error grew", "not comparable", "outcome changed", "fixed", "error shrank", "appeared", "disappeared"
]


class Change(msgspec.Struct, frozen=True, kw_only=True):
    """One comparison of two runs that is not the same in both; None: that run does not have it, or measured nothing.

    ``ratio``: the second run's error over the first's.
    """

    change: ChangeKind
    scene: str
    engine: str
    check: str
    before: Outcome | None
    after: Outcome | None
    error_before: float | None
    error_after: float | None
    unit: str
    ratio: float | None
    reason: str  # the second run's, where it does not agree


class Circumstance(msgspec.Struct, frozen=True, kw_only=True):
    """What else is not the same in two runs: an engine's version, the machine, the profile."""

    what: str
    before: str
    after: str


class DiffDocument(msgspec.Struct, frozen=True, kw_only=True):
    """Two runs of ``furiko check``: what ``furiko diff --json`` prints.

    ``not_looked_at``: comparisons of the first run that the second was not asked for; ``flaws``: why a run is not
    whole.
    """

    summary: str
    exit_status: int
    factor: float  # an error that grew by more is worse
    flaws: list[str]
    circumstances: list[Circumstance]
    changes: list[Change]
    unchanged: int
    not_looked_at: int
