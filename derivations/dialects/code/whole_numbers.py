"""Whole-number expressions of loops and indices, n - max(i, j), by Python's own parser; nothing is run."""

from __future__ import annotations

import ast
from collections.abc import Mapping

from ....models.errors import InvalidInput

LONGEST, LARGEST = 60, 64


def whole_number(text: str, names: Mapping[str, int]) -> int | None:
    """What it comes to; None where it is no such expression. Raises InvalidInput where it is too large."""
    if len(text) > LONGEST:
        return None
    try:
        tree = ast.parse(text.strip(), mode="eval").body
        value = _value(tree, names)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
    if value is not None and abs(value) > LARGEST:
        raise InvalidInput(f"{text.strip()[:30]!r} comes to {value}; counts up to {LARGEST} are followed")
    return value


def _value(node: ast.AST, names: Mapping[str, int]) -> int | None:  # noqa: PLR0911 -- one for each kind
    match node:
        case ast.Constant(value=value) if type(value) is int and abs(value) <= LARGEST:
            return value
        case ast.Name(id=name):
            return names.get(name)
        case ast.UnaryOp(op=ast.USub(), operand=of):
            inner = _value(of, names)
            return None if inner is None else -inner
        case ast.BinOp(left=left, op=op, right=right):
            one, two = _value(left, names), _value(right, names)
            if one is None or two is None:
                return None
            return _combined(op, one, two)
        case ast.Call(func=ast.Name(id="max" | "min" as of), args=args, keywords=[]) if args:
            values = [_value(a, names) for a in args]
            known = [v for v in values if v is not None]
            return None if len(known) < len(values) else (max(known) if of == "max" else min(known))
    return None


def _combined(op: ast.operator, one: int, two: int) -> int | None:
    match op:
        case ast.Add():
            return one + two
        case ast.Sub():
            return one - two
        case ast.Mult() if max(abs(one), abs(two)) <= LARGEST:
            return one * two
    return None
