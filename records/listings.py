"""The documents of ``furiko scenes``, ``engines``, ``engine-test`` and ``cache`` with ``--json``."""

from __future__ import annotations

from typing import Literal

import msgspec

StepOutcome = Literal["right", "wrong", "note", "skipped"]


class SceneRow(msgspec.Struct, frozen=True, kw_only=True):
    """One scene of the catalogue; ``furiko scenes --json`` prints a list of these."""

    name: str
    system: str  # n-leg, rod-chain or tree
    n: int  # degrees of freedom
    duration: float  # of its motion [s]; 0: it has none
    description: str
    equations: list[str]  # of the documents, that it exercises
    tags: list[str]


class IntegratorRow(msgspec.Struct, frozen=True, kw_only=True):
    """One of an engine's own time-stepping schemes."""

    name: str
    order: int


class EngineRow(msgspec.Struct, frozen=True, kw_only=True):
    """One engine; ``furiko engines --json`` prints a list of these."""

    name: str
    formulation: str
    package: str  # to pip install
    version: str | None  # None: not installed
    coordinates: Literal["relative", "absolute", "maximal"]
    integrators: list[IntegratorRow]
    missing: dict[str, str]  # quantities that it cannot compute, and why
    largest_n: int  # links
    homepage: str
    named: bool = False  # it runs only where it is named


class EnvironmentRow(msgspec.Struct, frozen=True, kw_only=True):
    """An environment made for a version of an engine; ``furiko environments --json`` prints a list of these."""

    name: str
    folder: str
    requirements: list[str]  # what was asked for
    packages: dict[str, str]  # what is installed, with versions
    python: str
    made: str  # ISO 8601, UTC
    by: str  # what installed it
    bytes: int


class CacheKind(msgspec.Struct, frozen=True, kw_only=True):
    """The cache's entries of one kind."""

    entries: int
    bytes: int
    least_recently_used: str | None  # ISO 8601, UTC: when the entry that would be deleted first was last used
    most_recently_used: str | None


class CacheContents(msgspec.Struct, frozen=True, kw_only=True):
    """The results kept from earlier runs, before anything is deleted; ``furiko cache --json`` prints it."""

    folder: str
    entries: int
    bytes: int
    limit: int  # bytes; beyond it the entries that were used least recently are deleted
    kinds: dict[str, CacheKind]  # results: of one scene on one engine; truths: of one scene
    deleted: int | msgspec.UnsetType = msgspec.UNSET  # entries; only with --clear


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
