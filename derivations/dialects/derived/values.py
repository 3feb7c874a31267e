"""What scripts of computer algebra have besides formulas: equations, pairs, functions made of formulas."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ..traced.names import MARK
from ..traced.values import Array, Formula, NotFollowed, Outside, Record, Several, Value, formula

TIMES = ("t", "time", "tau")
TIME_MARKS = frozenset(TIMES)


@dataclass(frozen=True, eq=False)
class Made:
    """A function of formulas: lambdify((x, y), [x*y]). ``arguments``: what a call's values stand for."""

    arguments: tuple[Value, ...]
    outs: tuple[Value, ...]
    alone: bool  # it gives back its only value, and no list of it


def equation(left: Value, right: Value) -> Record:
    """left = right"""
    return Record({"lhs": left, "rhs": right})


def is_equation(value: Value) -> bool:
    """Whether a value is an equation."""
    return isinstance(value, Record) and set(value.fields) == {"lhs", "rhs"}


def mark_of(value: Value) -> str | None:
    """The mark of what a formula is alone."""
    if isinstance(value, Outside):
        return value.mark[1:-1]
    found = MARK.fullmatch(value.text) if isinstance(value, Formula) else None
    if found:
        return found[1]
    return mark_of(value.entries[0]) if isinstance(value, Array) and len(value.entries) == 1 else None


def entries_of(value: Value) -> list[Formula]:
    """All formulas in a value, one behind another."""
    if isinstance(value, Array):
        return list(value.entries)
    if isinstance(value, Several):
        return [e for item in value.items for e in entries_of(item)]
    return [formula(value)]


def marks_of(value: Value) -> list[str]:
    """The marks of what is a quantity each. Raises NotFollowed for anything else."""
    made = [mark_of(one) for one in entries_of(value)]
    if any(one is None for one in made):
        raise NotFollowed("a derivative by something that is no name alone; give it a name")
    return [one for one in made if one is not None]


def equations_in(value: Value) -> Iterator[Value]:
    """The equations, or expressions that are zero, of a value."""
    if isinstance(value, Several):
        for item in value.items:
            yield from equations_in(item)
    elif isinstance(value, Array):
        yield from value.entries
    else:
        yield value
