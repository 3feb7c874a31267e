"""The records of ``furiko advise``: its JSON document."""

from __future__ import annotations

import msgspec


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


class Advice(msgspec.Struct, frozen=True, kw_only=True):
    """Which engine, integrator and step to use for one scene; ``furiko advise --json`` prints it.

    Every error is measured in this scene, over ``duration`` [s], against a motion whose own estimated error is
    ``truth``. ``advised``: engines first, the fastest first; furiko itself last.
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
