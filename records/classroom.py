"""The document of ``furiko grade --problem``: every submission's points, and who made which mistake."""

from __future__ import annotations

from typing import Literal

import msgspec

from .findings import GradeDocument, WrongTerm


class MarkedPart(msgspec.Struct, frozen=True, kw_only=True):
    """A row of the equations of motion, or the Lagrangian, with its points."""

    name: str
    name_ja: str
    outcome: Literal["right", "wrong", "missing"]
    points: float
    of: float
    terms: list[WrongTerm]


class Assessed(msgspec.Struct, frozen=True, kw_only=True):
    """One submission. ``grade``, ``solution``: for the teacher; ``feedback``: for the author, as far as hints go."""

    who: str
    outcome: Literal["correct", "wrong", "undecided", "not read", "not graded"]
    points: float
    of: float
    parts: list[MarkedPart]
    feedback: list[str]
    feedback_ja: list[str]
    solution: list[tuple[str, str]]
    grade: GradeDocument | None
    why: str  # it was not read, or not graded
    seconds: float


class CommonMistake(msgspec.Struct, frozen=True, kw_only=True):
    """A mistake, and who made it."""

    says: str
    says_ja: str
    who: list[str]


class ClassDocument(msgspec.Struct, frozen=True, kw_only=True):
    """All submissions to one problem. ``rule``: how points are taken off; ``hints``: what authors are told, 0 to 4."""

    title: str
    rule: str
    hints: int
    submissions: list[Assessed]
    mistakes: list[CommonMistake]
