"""The document of ``furiko versions``: releases of an engine side by side, and which release changed what."""

from __future__ import annotations

from typing import Literal

import msgspec

FORMAT = 1
LookKind = Literal["theory", "accelerations", "fields", "reading"]
ChangeKind = Literal["verdict", "values", "rounding"]


class VersionLook(msgspec.Struct, frozen=True, kw_only=True):
    """One look at one engine in one release.

    ``probe``: a scene, or a model file that was made for this; ``of``: what is looked at: the checks' verdict against
    the ``theory``, the ``accelerations`` and compiled ``fields`` themselves, or the ``reading`` of a model file.
    ``digest``: of the answer's bytes, to hold releases against each other to the last bit; empty: there is no answer.
    """

    engine: str
    probe: str
    of: LookKind
    outcome: Literal["agrees", "differs", "skipped", "error"]
    says: str = ""
    digest: str = ""


class VersionRow(msgspec.Struct, frozen=True, kw_only=True):
    """One release. ``package``: what installs it; ``looked_at``: whether it was; ``missing``: why it could not be."""

    version: str
    package: str
    looked_at: bool
    missing: str = ""
    looks: list[VersionLook] = []


class VersionChange(msgspec.Struct, frozen=True, kw_only=True):
    """``release`` answers otherwise than ``before``; ``between``: releases between the two that were not looked at.

    ``kind``: another ``verdict`` or another reason for it, other ``values``, or other last digits (``rounding``).
    """

    engine: str
    probe: str
    of: LookKind
    before: str
    release: str
    between: int
    kind: ChangeKind
    says: str


class VersionsDocument(msgspec.Struct, frozen=True, kw_only=True):
    """What ``furiko versions --json`` prints, and ``versions.json``."""

    format: int = FORMAT
    furiko: str
    started: str  # ISO 8601, UTC
    command: str
    machine: dict[str, str]
    engines: list[str]
    package: str
    every: bool  # every release was to be looked at; else those that bisection needs
    releases: list[VersionRow]  # oldest first
    changes: list[VersionChange]
    seconds: float
