"""An open question of a document, answered."""

from __future__ import annotations

from typing import Any

from msgspec import Struct


class Question(Struct, frozen=True):
    """The question, the answer, the argument for it, and measurements by name.

    A measurement is a table, a list of records with the same fields, or one record.
    """

    question: str
    answer: str
    argument: str
    numbers: dict[str, Any]
