"""What ``furiko engine-test`` says of an adapter."""

from __future__ import annotations

from typing import Literal

import msgspec

StepOutcome = Literal["right", "wrong", "note", "skipped"]


class ConformanceStep(msgspec.Struct, frozen=True, kw_only=True):
    """One step of the test. ``help`` is empty where nothing is to be done."""

    step: str  # what was looked at
    outcome: StepOutcome
    says: str  # what was found, or why nothing was looked for
    help: str = ""  # what to change in the adapter


class EngineTest(msgspec.Struct, frozen=True, kw_only=True):
    """An adapter, step by step; ``furiko engine-test --json`` prints it."""

    engine: str
    conforms: bool  # no step is wrong, and the test came to its end
    steps: list[ConformanceStep]
