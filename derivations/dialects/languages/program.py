"""A program as data, whatever language it is in: functions with parameters and statements, and what stands outside."""

from __future__ import annotations

from dataclasses import dataclass, field

ALLOCATED = "allocated"  # the value of an array that is made and not filled yet
RETURN = "return"  # the target of what a function returns
CALL = "called"  # the target of a call that gives nothing back
LONGEST_PROGRAM = 20_000  # characters
MOST_STATEMENTS = 300


@dataclass(frozen=True)
class Statement:
    """``target`` is set to ``value``. ``op``: of a += b, which is kept beside the whole value a + (b)."""

    target: str
    value: str
    op: str = ""
    added: str = ""  # b of a += b


@dataclass(frozen=True)
class Parameter:
    """``kind``: "array", "number", or "" where its type does not say."""

    name: str  # or "[a, b]", names that are taken apart at once
    kind: str = ""


@dataclass(frozen=True)
class Function:
    """``refused``: why it cannot be followed; an empty text where it can."""

    name: str
    parameters: tuple[Parameter, ...]
    statements: tuple[Statement, ...]
    refused: str = ""


@dataclass(frozen=True)
class Program:
    """``first``: what entries are counted from; ``whole``: 1/2 is 0 in this language."""

    functions: tuple[Function, ...]
    outside: tuple[Statement, ...] = ()
    first: int = 0
    whole: bool = False
    powers: tuple[str, ...] = field(default=("**", "^"))  # how powers are written
