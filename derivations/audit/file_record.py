"""The result of judging a document's list of equations, as plain data."""

from __future__ import annotations

from typing import Any, Literal

import msgspec
from msgspec import Struct

FileJudgement = Literal["holds", "holds-if", "wrong"]


class JudgedEntry(Struct, frozen=True):
    """One entry: its ``number`` and what it ``says`` it is; ``told``, ``told_ja``: why, empty where it simply holds.

    ``grade``: the whole result of :mod:`..grading`, as JSON has it.
    """

    number: str
    says: str
    judgement: FileJudgement
    told: tuple[str, ...]
    told_ja: tuple[str, ...]
    grade: dict[str, Any]


class FileAudit(Struct, frozen=True):
    """All entries of a file."""

    title: str
    entries: tuple[JudgedEntry, ...]

    @property
    def counts(self) -> dict[str, int]:
        """How many entries were judged how."""
        kinds = [entry.judgement for entry in self.entries]
        return {kind: kinds.count(kind) for kind in ("holds", "holds-if", "wrong")}

    @property
    def exit_status(self) -> int:
        """0 where all hold, on a condition or not; else 1."""
        return int(any(entry.judgement == "wrong" for entry in self.entries))

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        content: dict[str, Any] = msgspec.to_builtins(self)
        return content
