"""The records of the index: an equation of a document, and a slip in its text."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from ..arithmetic import Array

Document = Literal["shiki", "takeno"]
Stage = Literal["position", "velocity", "energy", "lagrange", "force", "motion", "matrix"]
Members = tuple[Array, ...]  # the expressions between the equals signs, in printed order


@dataclass(frozen=True)
class Equation:
    """One numbered equation of a document.

    ``function`` returns its members: the expressions between its equals signs, in printed order, each as an array; a
    name that the equation only introduces (x₁ = …) is left out. ``formula``: the equation to read. Where the document
    has a misprint, ``function`` and ``formula`` are the corrected equation, ``printed`` and ``printed_formula`` the
    equation as printed. ``condition``: a condition that the equation needs and the document does not state.
    """

    document: Document
    number: str
    stage: Stage
    says: str
    formula: str
    function: Callable[..., Members]
    printed: Callable[..., Members] | None = None
    printed_formula: str = ""
    correction: str = ""
    condition: str = ""

    @property
    def label(self) -> str:
        """The equation's name for readers: ``Shiki (3.4)``."""
        return f"{self.document.title()} ({self.number})"

    @property
    def symbols(self) -> tuple[str, ...]:
        """Names of the function's arguments: the symbols in the equation."""
        return tuple(inspect.signature(self.function).parameters)

    def members(self, values: Mapping[str, Any]) -> Members:
        """The members for these values of its symbols (other values are ignored). Raises KeyError for a missing one."""
        return _call(self.function, values)

    def printed_members(self, values: Mapping[str, Any]) -> Members:
        """The members as printed, misprint and all."""
        return _call(self.printed or self.function, values)


@dataclass(frozen=True)
class Slip:
    """A slip outside the numbered formulas: the place, the text as printed, and the right one."""

    document: Document
    where: str
    printed: str
    right: str
    says: str


def _call(function: Callable[..., Members], values: Mapping[str, Any]) -> Members:
    return function(**{name: values[name] for name in inspect.signature(function).parameters})
