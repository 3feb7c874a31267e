# ruff: noqa: E501 -- patterns and tables stand on one line
"""Derivatives of formulas that a program has made: by a quantity, by time; and formulas put in for quantities."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Collection, Mapping

from ..traced.names import MARK, Names
from ..traced.values import (
    ONE,
    ZERO,
    Formula,
    NotFollowed,
    added,
    divided,
    negative,
    number,
    power,
    subtracted,
    times,
)

Rate = Callable[[str], Formula]  # of what a mark stands for
WORD = re.compile(r"[^\W\d]\w*")
SUM, PRODUCT, FACTOR = 2, 1, 0
TWO = Formula("2")


class Derivatives:
    """``names``: whose lines stand for long formulas; what has been derived from a line is kept."""

    def __init__(self, names: Names) -> None:
        self.names = names
        self.trees: dict[str, tuple[ast.expr, tuple[str, ...]]] = {}
        self.kept: dict[tuple[str, str], Formula] = {}

    def by(self, value: Formula, mark: str) -> Formula:
        """The partial derivative by what a mark stands for."""
        return self.along(value, lambda one: ONE if one == mark else ZERO, f"by {mark}")

    def along(self, value: Formula, rate: Rate, kind: str) -> Formula:
        """The derivative where each mark has this rate. ``kind``: names the rates, for what is kept."""
        if not self.marks_in(value):
            return ZERO
        tree, marks = self._tree(value.text)
        return self._both(tree, marks, rate, kind)[1]

    def put_in(self, value: Formula, new: Mapping[str, Formula]) -> Formula:
        """The same with formulas in place of marks, all at once."""
        if not self.marks_in(value) & new.keys():
            return value
        tree, marks = self._tree(value.text)
        return self._put(tree, marks, new, f"with {sorted((k, v.text) for k, v in new.items())}")

    def marks_in(self, value: Formula) -> set[str]:
        """What a formula, and all lines that it uses, have from outside."""
        found: set[str] = set()
        left, seen = [value.text], set[str]()
        while left:
            text = left.pop()
            found |= set(MARK.findall(text))
            for word in WORD.findall(MARK.sub(" ", text)):
                if word in self.names.lines and word not in seen:
                    seen.add(word)
                    left.append(self.names.lines[word])
        return found

    def linear(self, value: Formula, marks: Collection[str]) -> tuple[list[Formula], Formula]:
        """The coefficients of these in a formula, and what is left. Raises NotFollowed where it is not linear in them."""
        made = [self.by(value, mark) for mark in marks]
        if any(self.marks_in(one) & set(marks) for one in made):
            raise NotFollowed("equations that are not linear in what they are solved for; write out the accelerations")
        return made, self.put_in(value, dict.fromkeys(marks, ZERO))

    # a formula's own tree

    def _tree(self, text: str) -> tuple[ast.expr, tuple[str, ...]]:
        found = self.trees.get(text)
        if found is None:
            marks: list[str] = []

            def named(one: re.Match[str]) -> str:
                marks.append(one[1])
                return f"mark__{len(marks) - 1}"

            bare = MARK.sub(named, text).replace("^", "**")
            try:
                tree = ast.parse(bare.strip(), mode="eval").body
            except (SyntaxError, ValueError, RecursionError, MemoryError):
                raise NotFollowed(f"the derivative of {text[:30]}: write it out") from None
            found = self.trees[text] = tree, tuple(marks)
        return found

    def _both(  # noqa: PLR0911 -- one for each kind
        self, node: ast.expr, marks: tuple[str, ...], rate: Rate, kind: str
    ) -> tuple[Formula, Formula]:
        """A part of a formula, and its derivative."""
        match node:
            case ast.Constant():
                return _constant(node), ZERO
            case ast.Name(id=name):
                if name.startswith("mark__"):
                    mark = marks[int(name[6:])]
                    return Formula(f"«{mark}»"), rate(mark)
                return Formula(name), self._of_line(name, rate, kind)
            case ast.UnaryOp(op=ast.USub(), operand=of):
                value, slope = self._both(of, marks, rate, kind)
                return negative(value), negative(slope)
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                value, slope = self._both(left, marks, rate, kind)
                exponent = _whole(right)
                factor = times(number(exponent), power(value, number(exponent - 1)) if exponent != 1 else ONE)
                return power(value, number(exponent)), times(factor, slope)
            case ast.BinOp(left=left, op=op, right=right):
                return _combined(op, self._both(left, marks, rate, kind), self._both(right, marks, rate, kind))
            case ast.Call(func=ast.Name(id=name), args=[of]):
                value, slope = self._both(of, marks, rate, kind)
                return Formula(f"{name}({value.text})"), _of_function(name, value, slope)
        raise NotFollowed("the derivative of such an expression is not followed; write it out")

    def _of_line(self, name: str, rate: Rate, kind: str) -> Formula:
        text = self.names.lines.get(name)
        if text is None:
            return ZERO  # pi
        key = (name, kind)
        if key not in self.kept:
            made = self.along(Formula(text, SUM), rate, kind)
            self.kept[key] = self.names.line(made, self.names.said.get(name, ""))
        return self.kept[key]

    def _put(  # noqa: PLR0911 -- one for each kind
        self, node: ast.expr, marks: tuple[str, ...], new: Mapping[str, Formula], kind: str
    ) -> Formula:
        match node:
            case ast.Constant():
                return _constant(node)
            case ast.Name(id=name) if name.startswith("mark__"):
                mark = marks[int(name[6:])]
                return new.get(mark, Formula(f"«{mark}»"))
            case ast.Name(id=name):
                text = self.names.lines.get(name)
                if text is None or not self.marks_in(Formula(name)) & new.keys():
                    return Formula(name)
                if (name, kind) not in self.kept:
                    made = self.put_in(Formula(text, SUM), new)
                    self.kept[name, kind] = self.names.line(made, self.names.said.get(name, ""))
                return self.kept[name, kind]
            case ast.UnaryOp(op=ast.USub(), operand=of):
                return negative(self._put(of, marks, new, kind))
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return power(self._put(left, marks, new, kind), number(_whole(right)))
            case ast.BinOp(left=left, op=op, right=right):
                first, second = self._put(left, marks, new, kind), self._put(right, marks, new, kind)
                return _combined(op, (first, ZERO), (second, ZERO))[0]
            case ast.Call(func=ast.Name(id=name), args=[of]):
                inner = self._put(of, marks, new, kind)
                return ONE if name == "cos" and inner.text == "0" else ZERO if inner.text == "0" else Formula(
                    f"{name}({inner.text})")  # fmt: skip
        raise NotFollowed("what stands in such an expression is not followed; write it out")


def _constant(node: ast.Constant) -> Formula:
    text = repr(node.value)
    if "e" in text.lower() or not isinstance(node.value, int | float) or isinstance(node.value, bool):
        raise NotFollowed(f"{text[:20]}: a number that is no decimal fraction")
    return Formula(text)


def _whole(node: ast.expr) -> int:
    match node:
        case ast.Constant(value=int() as value):
            return value
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() as value)):
            return -value
    raise NotFollowed("the derivative of a power that is no whole number; write it out")


def _combined(
    op: ast.operator, left: tuple[Formula, Formula], right: tuple[Formula, Formula]
) -> tuple[Formula, Formula]:
    """Two parts with a sign between them, and the derivative of this."""
    (a, da), (b, db) = left, right
    match op:
        case ast.Add():
            return added(a, b), added(da, db)
        case ast.Sub():
            return subtracted(a, b), subtracted(da, db)
        case ast.Mult():
            return times(a, b), added(times(da, b), times(a, db))
        case ast.Div():
            slope = divided(da, b)
            if db.text != "0":
                slope = subtracted(slope, divided(times(a, db), power(b, TWO)))
            return divided(a, b), slope
    raise NotFollowed("the derivative of such an expression is not followed; write it out")


def _of_function(name: str, value: Formula, slope: Formula) -> Formula:
    """The chain rule. Raises NotFollowed for what has no derivative everywhere."""
    if slope.text == "0":
        return ZERO
    inner = value.text
    match name:
        case "sin":
            return times(Formula(f"cos({inner})"), slope)
        case "cos":
            return negative(times(Formula(f"sin({inner})"), slope))
        case "tan":
            return divided(slope, Formula(f"cos({inner})^2"))
        case "sqrt":
            return divided(slope, times(TWO, Formula(f"sqrt({inner})")))
    raise NotFollowed(f"the derivative of {name} is not followed; write it out")
