# ruff: noqa: E501 -- patterns and tables stand on one line
"""Fortran's expressions as a tree: entries and functions, whole numbers, arrays by columns."""

from __future__ import annotations

import re
from typing import ClassVar

from ..traced import nodes
from .parser import NoProgram, Parser, from_one, tokens_of

TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+\.(?![a-zA-Z]{2,4}\.)[0-9]*|\.[0-9]+|[0-9]+)(?:[eEdD][+-]?[0-9]+)?(?:_\w+)?)"
    r"|(?P<word>[^\W\d]\w*)"
    r"|(?P<text>\"[^\"\n]*\"|'[^'\n]*')"
    r"|(?P<sign>\.(?:and|or|not|eq|ne|lt|le|gt|ge|true|false|AND|OR|NOT|EQ|NE|LT|LE|GT|GE|TRUE|FALSE)\."
    r"|\*\*|\(/|/\)|//|==|/=|<=|>=|=>|[-+*/=<>(),:%\[\]])"
)
PLAIN = {
    "dsin": "sin", "dcos": "cos", "dtan": "tan", "dsqrt": "sqrt", "dabs": "abs", "dble": "float", "real": "float",
    "dot_product": "dot", "sngl": "float", "dfloat": "float", "float": "float",
}  # fmt: skip
INTRINSIC = frozenset((
    "sin", "cos", "tan", "sqrt", "abs", "matmul", "transpose", "sum", "size", "mod", "max", "min", "atan2", "sign", "exp",
    "log", "reshape", "acos", "asin", "atan", "present", "merge", "spread", "int", "nint", "floor", "dmod", "dmax1", "dmin1",
    "datan2", "dsign", "dexp", "aint", "norm2", "product", "shape", "minval", "maxval", "any", "all", "kind", *PLAIN,
))  # fmt: skip
COMPARED = {".and.": "&&", ".or.": "||", ".eq.": "==", ".ne.": "!=", ".lt.": "<", ".le.": "<=", ".gt.": ">", ".ge.": ">=",
            "/=": "!="}  # fmt: skip


class FortranExpressions:
    """``functions``: those of the text; ``whole``: names of whole numbers."""

    def __init__(self, functions: frozenset[str]) -> None:
        self.functions = functions
        self.whole: frozenset[str] = frozenset()

    def read(self, text: str, *, is_call: bool = False) -> nodes.Node:
        """An expression. Raises NoProgram where it is none."""
        parser = _Expression(text, self)
        node = parser.expression()
        if parser.token.kind != "end":
            raise NoProgram
        if is_call and isinstance(node, nodes.At) and isinstance(node.of, nodes.Word | nodes.Member):
            return _Expression(text, self, of_any=True).expression()
        return nodes.Call(node, ()) if is_call and isinstance(node, nodes.Word | nodes.Member) else node

    def sides(self, text: str) -> tuple[nodes.Node, nodes.Node]:
        """The two sides of an assignment."""
        parser = _Expression(text, self)
        target = parser.target()
        parser.expect("=")
        value = parser.expression()
        if parser.token.kind != "end":
            raise NoProgram
        return target, value

    def bracket(self, text: str) -> tuple[nodes.Node, str]:
        """What stands in the bracket that begins here, and the text behind it."""
        depth = 0
        for at, c in enumerate(text):
            depth += (c == "(") - (c == ")")
            if depth == 0:
                return self.read(text[1:at]), text[at + 1 :].strip()
        raise NoProgram

    def parts(self, text: str) -> list[str]:
        """The parts of a list, at commas outside brackets."""
        made, depth, start = [], 0, 0
        for at, c in enumerate(text):
            depth += (c in "([") - (c in ")]")
            if c == "," and depth == 0:
                made.append(text[start:at])
                start = at + 1
        return [part.strip() for part in [*made, text[start:]] if part.strip()]

    def words(self, text: str) -> tuple[str, ...]:
        """All names in a line."""
        return tuple(dict.fromkeys(re.findall(r"[A-Za-z_]\w*", text)))


class _Expression(Parser):
    binds: ClassVar = {
        ".or.": 1, ".and.": 2, "==": 4, "/=": 4, "<": 4, ">": 4, "<=": 4, ">=": 4, ".eq.": 4, ".ne.": 4, ".lt.": 4,
        ".le.": 4, ".gt.": 4, ".ge.": 4, "//": 5, "+": 6, "-": 6, "*": 7, "/": 7, "**": 9,
    }  # fmt: skip
    right = frozenset(("**",))
    unary: ClassVar = {"-": 7, "+": 7, ".not.": 3}

    def __init__(self, text: str, around: FortranExpressions, *, of_any: bool = False) -> None:
        lowered = re.sub(r"\.[A-Za-z]{2,5}\.", lambda m: m[0].lower(), text)
        super().__init__(lowered, tokens_of(lowered, TOKEN))
        self.around, self.of_any = around, of_any

    def combined(self, sign: str, left: nodes.Node, right: nodes.Node) -> nodes.Node:
        """Two parts with a sign between them; 1/2 is 0."""
        if sign == "/" and is_whole(left, self.around.whole) and is_whole(right, self.around.whole):
            return nodes.Binary("div", left, right)
        if sign == "//":
            return nodes.Strange("//")
        return nodes.Binary({"**": "^", **COMPARED}.get(sign, sign), left, right)

    def target(self) -> nodes.Node:
        """The left side of an assignment, whose brackets hold an entry."""
        node: nodes.Node = nodes.Word(self.next().text)
        while True:
            if self.took("("):
                node = nodes.At(node, self.places())
            elif self.took("%"):
                node = nodes.Member(node, self.next().text)
            else:
                return node

    def postfix(self) -> nodes.Node:
        token = self.next()
        if token.kind == "number":
            return nodes.Number(re.sub(r"_\w+$", "", token.text).lower().replace("d", "e"))
        if token.kind == "text":
            return nodes.Text(token.text[1:-1])
        if token.kind == "word":
            return self.named(token.text)
        if token.text == "(":
            node = self.expression()
            if self.took(","):  # a complex number, or a list that is no part of mechanics
                raise NoProgram
            self.expect(")")
            return node
        if token.text in ("(/", "["):
            return nodes.Listed(self.closed({"(/": "/)", "[": "]"}[token.text])[0])
        if token.text in (".true.", ".false."):
            return nodes.Text(token.text)
        raise NoProgram

    def named(self, name: str) -> nodes.Node:
        """A name, an entry of it, a member of it, or a function's value."""
        low = name.lower()
        is_function = name in self.around.functions or low in INTRINSIC or self.of_any
        node: nodes.Node = nodes.Word(name)
        if is_function and self.is_sign("("):
            self.at += 1
            self.of_any = False
            given, named = self.closed(")")
            if name not in self.around.functions and low in INTRINSIC:
                node = called(PLAIN.get(low, low), given, dict(named))
            else:
                node = nodes.Call(node, given, tuple(named))
        while True:
            if self.took("("):
                node = nodes.At(node, self.places())
            elif self.took("%"):
                node = nodes.Member(node, self.next().text)
            else:
                return node

    def places(self) -> tuple[nodes.Node, ...]:
        """Indices, counted from 1; 1:2 is a part."""
        made: list[nodes.Node] = []
        while True:
            first = None if self.is_sign(":", ",", ")") else self.expression()
            if self.took(":"):
                last = None if self.is_sign(",", ")") else self.expression()
                made.append(nodes.Span(None if first is None else from_one(first), last))
            elif first is not None:
                made.append(from_one(first))
            if self.took(","):
                continue
            self.expect(")")
            return tuple(made)

    def closed(self, closing: str) -> tuple[tuple[nodes.Node, ...], list[tuple[str, nodes.Node]]]:
        """Values up to a closing bracket, and those with names."""
        made: list[nodes.Node] = []
        named: list[tuple[str, nodes.Node]] = []
        while not self.took(closing):
            if self.token.kind == "word" and self.tokens[self.at + 1].text == "=":
                name = self.next().text
                self.at += 1
                named.append((name, self.expression()))
            else:
                made.append(self.expression())
            if not self.took(",") and not self.is_sign(closing):
                raise NoProgram
        return tuple(made), named


def is_whole(node: nodes.Node, names: frozenset[str]) -> bool:
    """Whether an expression is one of whole numbers: then what it is divided by leaves no fraction."""
    match node:
        case nodes.Number(text=text):
            return text.isdigit()
        case nodes.Word(name=name):
            return name in names
        case nodes.Unary(of=of):
            return is_whole(of, names)
        case nodes.Binary(sign="+" | "-" | "*" | "div" | "^", left=left, right=right):
            return is_whole(left, names) and is_whole(right, names)
    return False


def called(name: str, given: tuple[nodes.Node, ...], named: dict[str, nodes.Node]) -> nodes.Node:
    """A function of the language; reshape fills columns first."""
    if name == "reshape" and len(given) >= 2:
        order = named.get("order", given[3] if len(given) > 3 else None)
        entries, shape = given[0], given[1]
        sizes = (
            [int(s.text) for s in shape.items if isinstance(s, nodes.Number)] if isinstance(shape, nodes.Listed) else []
        )
        if not isinstance(entries, nodes.Listed) or len(sizes) != 2 or len(entries.items) != sizes[0] * sizes[1]:
            return nodes.Strange("reshape(…)")
        by_row = isinstance(order, nodes.Listed) and [getattr(o, "text", "") for o in order.items] == ["2", "1"]
        if order is not None and not by_row:
            return nodes.Strange("reshape(…)")
        height, width = sizes
        rows = [[entries.items[i * width + j] if by_row else entries.items[i + height * j] for j in range(width)]
                for i in range(height)]  # fmt: skip
        return nodes.Call(nodes.Word("array"), (nodes.Listed(tuple(nodes.Listed(tuple(row)) for row in rows)),))
    if named or name == "sign":
        return nodes.Strange(f"{name}(…)")
    return nodes.Call(nodes.Word(name), given)
