"""sympy's ``srepr`` as the text that sympy prints otherwise: read as data, never run.

``Mul(Integer(2), Symbol('m'))`` becomes ``(2*m)``; what is no known constructor of sympy's is refused.
"""

from __future__ import annotations

import ast
import re
import warnings

from ...models.errors import InvalidInput
from .lines import LONGEST_LINE

STARTS = re.compile(r"\s*(?:Equality|Eq|Add|Mul|Pow|(?:Mutable|Immutable)DenseMatrix)\((?=.*\bSymbol\()", re.DOTALL)
NAME = re.compile(r"[A-Za-zα-ωΑ-Ωϑϕ\\][\w\\{}^]{0,39}")
DEEPEST = 80  # brackets in one another; Python's own parser has 200
FUNCTIONS = frozenset({"sin", "cos", "tan", "sqrt", "exp", "log", "sign", "Abs"})
EXPECTED = "of sympy's srepr, Equality, Add, Mul, Pow, Symbol, Function, Derivative, numbers and matrices are read"


def from_srepr(line: str) -> str:
    """``line`` with sympy's own spelling, where it is an ``srepr``; any other line as it is.

    Raises :class:`InvalidInput` where a part of it is not known.
    """
    if len(line) > LONGEST_LINE or not STARTS.match(line):
        return line
    left, equals, right = line.partition(" = ")  # no srepr has an equals sign with blanks
    if equals:
        return f"{from_srepr(left)} = {from_srepr(right)}"
    if _depth(line) > DEEPEST:
        raise InvalidInput(f"column 1: more than {DEEPEST} brackets in one another")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(line.strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise InvalidInput(f"column 1: this is no srepr that sympy prints; {EXPECTED}") from None
    return _text(tree.body)


def _depth(line: str) -> int:
    depth = deepest = 0
    for character in line:
        depth += (character in "([") - (character in ")]")
        deepest = max(deepest, depth)
    return deepest


def _text(node: ast.AST) -> str:
    if isinstance(node, ast.Name) and node.id == "pi":
        return "pi"
    if not isinstance(node, ast.Call):
        raise _refused(node)
    if isinstance(node.func, ast.Call):  # Function('theta1')(Symbol('t'))
        _require(_called(node.func) == "Function" and len(node.args) == 1, node)
        return f"{_name(node.func)}({_text(node.args[0])})"
    called, parts = _called(node), node.args
    if called in ("Integer", "Rational", "Float", "Symbol"):
        return _atom(called, node)
    if called.endswith("DenseMatrix"):
        return f"Matrix([{', '.join(_row(row) for row in _list(parts[0] if parts else node))}])"
    if called == "Derivative":
        return _derivative(node)
    return _operation(called, [_text(part) for part in parts]) or _unknown(node)


def _operation(called: str, texts: list[str]) -> str:
    """The operation on texts; an empty one where it is not known."""
    if called in ("Add", "Mul") and texts:
        return "(" + (" + " if called == "Add" else "*").join(texts) + ")"
    match called, texts:
        case ("Equality" | "Eq", [left, right]):
            return f"{left} = {right}"
        case ("Pow", [base, "(1/2)"]):
            return f"sqrt({base})"
        case ("Pow", [base, power]):
            return f"({base})**{power}"
        case (_, [of]) if called in FUNCTIONS:
            return f"{called}({of})"
    return ""


def _unknown(node: ast.AST) -> str:
    raise _refused(node)


def _atom(called: str, node: ast.Call) -> str:
    if called == "Symbol":
        return _name(node)
    numbers = [_number(part) for part in node.args]
    _require(len(numbers) == (2 if called == "Rational" else 1), node)
    return "(" + "/".join(numbers) + ")" if called == "Rational" or numbers[0].startswith("-") else numbers[0]


def _derivative(node: ast.Call) -> str:
    """With respect to a symbol, ``Tuple(Symbol('t'), Integer(2))``."""
    _require(len(node.args) == 2, node)
    by = node.args[1]
    _require(isinstance(by, ast.Call) and _called(by) == "Tuple" and len(by.args) == 2, node)
    assert isinstance(by, ast.Call)
    time, times = map(_text, by.args)
    return f"Derivative({_text(node.args[0])}, {time if times == '1' else f'({time}, {times})'})"


def _row(node: ast.AST) -> str:
    return "[" + ", ".join(map(_text, _list(node))) + "]"


def _list(node: ast.AST) -> list[ast.expr]:
    _require(isinstance(node, ast.List), node)
    assert isinstance(node, ast.List)
    return node.elts


def _called(node: ast.Call) -> str:
    return node.func.id if isinstance(node.func, ast.Name) else ""


def _name(node: ast.Call) -> str:
    """The first argument, a text that is a name; assumptions such as ``positive=True`` say nothing of an equation."""
    given = node.args[0].value if node.args and isinstance(node.args[0], ast.Constant) else None
    if not isinstance(given, str) or not NAME.fullmatch(given):
        raise _refused(node)
    return given


def _number(node: ast.expr) -> str:
    sign = ""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        sign, node = "-", node.operand
    value = node.value if isinstance(node, ast.Constant) else None
    text = str(value) if isinstance(value, int | str) and not isinstance(value, bool) else ""
    if not re.fullmatch(r"-?\d{1,40}(?:\.\d{0,40})?(?:e[+-]?\d{1,3})?", text):
        raise _refused(node)
    return sign + text


def _require(sound: bool, node: ast.AST) -> None:
    if not sound:
        raise _refused(node)


def _refused(node: ast.AST) -> InvalidInput:
    column = getattr(node, "col_offset", 0) + 1
    return InvalidInput(f"column {column}: {ast.unparse(node)[:40]!r} is not known; {EXPECTED}")
