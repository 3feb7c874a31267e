"""MATLAB's and Octave's text as a tree. Nothing is run."""

from __future__ import annotations

import re

from . import nodes
from .matlab_tokens import BLOCK_REMARK, NoMatlab, Token, tokens_of

# Python's and Julia's functions, and C's braces
OTHERS = re.compile(
    r"(?m)^\s*(?:def|class)\s|^\s*(?:@\w+\s+)*function\s+[\w!]+\s*\((?!.*=)|\)\s*(?:const\s*)?\{\s*$|^\s*(?:double|float|auto|const|let|var)\s"
)
OPENS = ("if", "while", "switch", "try", "parfor", "unwind_protect")
ENDS = ("end", "endfunction", "endfor", "endif", "endwhile", "end_try_catch", "endswitch")
SILENT = (
    "clc",
    "clear",
    "clearvars",
    "close",
    "format",
    "global",
    "persistent",
    "hold",
    "syms",
    "warning",
    "more",
    "pkg",
    "figure",
    "import",
    "addpath",
)
DEEPEST = 40


def matlab_tree(text: str) -> tuple[nodes.Statement, ...] | None:
    """The statements; None where the text is no MATLAB."""
    if "\\begin" in text or "\\frac" in text or OTHERS.search(text):
        return None
    try:
        parser = _Parser(text)
        return parser.body(top=True)
    except (NoMatlab, RecursionError):
        return None


def is_guard(inside: list[Token]) -> bool:
    """Whether a condition only tests the arguments: if nargin < 3, error(…), end."""
    return any(t.text in ("error", "nargin", "warning") for t in inside) and not any(
        t.text == "=" and inside[k - 1].kind == "word" and not any(n.text == "nargin" for n in inside)
        for k, t in enumerate(inside)
    )


class _Parser:
    def __init__(self, text: str) -> None:
        self.text = BLOCK_REMARK.sub("", text)
        self.tokens = tokens_of(text)
        self.at = 0
        self.depth = 0
        self.in_block: list[bool] = [False]

    # statements

    @property
    def token(self) -> Token:
        return self.tokens[self.at]

    def next(self) -> Token:
        token = self.token
        self.at += 1
        return token

    def is_sign(self, *signs: str) -> bool:
        return self.token.kind == "sign" and self.token.text in signs

    def expect(self, sign: str) -> None:
        if not self.is_sign(sign):
            raise NoMatlab
        self.at += 1

    def skip(self) -> None:
        while self.is_sign("\n", ";", ","):
            self.at += 1

    def line(self, start: int) -> str:
        begun = self.tokens[start].at
        return " ".join(self.text[begun : self.text.find("\n", begun) if "\n" in self.text[begun:] else None].split())[
            :60
        ]

    def body(self, *, top: bool = False) -> tuple[nodes.Statement, ...]:
        made: list[nodes.Statement] = []
        while True:
            self.skip()
            token = self.token
            if token.kind == "end":
                return tuple(made)
            if token.kind == "word" and token.text in ENDS:
                self.at += 1
                if not top:
                    return tuple(made)
                continue  # of a classdef, or one too many
            if token.kind == "word" and token.text in ("else", "elseif") and not top:
                return tuple(made)
            if token.kind == "word" and token.text == "function":
                if not top:
                    return tuple(made)  # functions of a file need no end
                made.append(self.function())
                continue
            made += self.statement()

    def statement(self) -> list[nodes.Statement]:  # noqa: PLR0911 -- one for each kind
        start, token = self.at, self.token
        if (
            token.kind == "word"
            and token.text in SILENT
            and not (self.tokens[start + 1].text in ("=", "(") and token.text not in ("warning", "figure", "addpath"))
        ):
            while not self.is_sign("\n", ";") and self.token.kind != "end":
                self.at += 1
            return self.moving(start) if token.text == "syms" else []
        if token.kind == "word" and token.text in ("classdef", "properties", "methods", "events"):
            while not self.is_sign("\n") and self.token.kind != "end":
                self.at += 1
            return []
        if token.kind == "word" and token.text == "return":
            self.at += 1
            return []
        if token.kind == "word" and token.text in ("break", "continue"):
            self.at += 1
            return [nodes.Leave(token.text, self.line(start))]
        if token.kind == "word" and token.text == "for":
            return [self.loop(start)]
        if token.kind == "word" and token.text in OPENS:
            self.at += 1
            self.past_block()
            inside = self.tokens[start : self.at]
            if is_guard(inside):
                return []
            return [self.choice(start, inside)]
        line = self.line(start)
        target = self.targets() or self.expression()
        if self.is_sign("="):
            self.at += 1
            value = self.expression()
            self.finish()
            return [nodes.Assign(target, value, line)]
        if self.is_sign("+=", "-=", "*=", "/="):
            sign = self.next().text[0]
            value = self.expression()
            self.finish()
            return [nodes.Assign(target, value, line, sign)]
        self.finish()
        return [nodes.Do(target, line)]

    def moving(self, start: int) -> list[nodes.Statement]:
        """syms th1(t) m1: what is a function of time."""
        inside = self.tokens[start : self.at]
        names = [a.text for a, b, c in zip(inside, inside[1:], inside[2:], strict=False)
                 if a.kind == "word" and b.text == "(" and c.text in ("t", "time", "tau")]  # fmt: skip
        declared = nodes.Call(nodes.Word("syms·"), tuple(map(nodes.Word, names)))
        return [nodes.Do(declared, self.line(start))] if names else []

    def finish(self) -> None:
        if not self.is_sign("\n", ";", ",") and self.token.kind != "end":
            raise NoMatlab

    def past_block(self) -> None:
        depth = 1
        while depth and self.token.kind != "end":
            token = self.next()
            if token.kind == "word" and token.text in (*OPENS, "for"):
                depth += 1
            elif token.kind == "word" and token.text in ENDS:
                depth -= 1

    def choice(self, start: int, inside: list[Token]) -> nodes.Statement:
        """if … elseif … else … end; any other block, and one that is no MATLAB, is not followed. It is behind here."""
        behind, depth, blocks = self.at, self.depth, list(self.in_block)
        names = list(dict.fromkeys(t.text for t in inside if t.kind == "word"))
        if {"break", "continue"} & set(names) and "for" not in names and "while" not in names:
            names.append("continue")
        if self.tokens[start].text == "if":
            self.at = start
            try:
                made = self.branches(tuple(names))
                if self.at == behind:
                    return made
            except NoMatlab:
                pass
        self.at, self.depth, self.in_block = behind, depth, blocks
        return nodes.Unfollowed(self.line(start), tuple(names))

    def branches(self, names: tuple[str, ...]) -> nodes.Choice:
        """From if or elseif to the end that closes it."""
        line = self.line(self.at)
        self.at += 1
        test = self.expression()
        body = self.body()
        otherwise: tuple[nodes.Statement, ...] = ()
        if self.token.text == "elseif":
            otherwise = (self.branches(names),)
        elif self.token.text == "else":
            self.at += 1
            otherwise = self.body()
        return nodes.Choice(test, body, otherwise, line, names)

    def loop(self, start: int) -> nodes.Statement:
        line = self.line(start)
        self.at += 1
        bracket = self.is_sign("(")
        self.at += bracket
        name = self.next()
        self.expect("=")
        over = self.expression()
        self.at += bracket and self.is_sign(")")
        body = self.body()
        return nodes.Repeat(name.text, over, body, line)

    def targets(self) -> nodes.Node | None:
        """[a, b] = in front of an equals sign; None where there is none."""
        if not self.is_sign("["):
            return None
        depth, at = 0, self.at
        while self.tokens[at].kind != "end":
            depth += (self.tokens[at].text == "[") - (self.tokens[at].text == "]")
            at += 1
            if depth == 0:
                break
        if self.tokens[at].text != "=":
            return None
        inner = self.tokens[self.at + 1 : at - 1]
        items: list[nodes.Node] = []
        for token in inner:
            if token.kind == "word":
                items.append(nodes.Word(token.text))
            elif token.text == "~":
                items.append(nodes.Word("_"))
            elif token.text != ",":
                raise NoMatlab
        self.at = at
        return nodes.Listed(tuple(items))

    def function(self) -> nodes.Statement:
        self.at += 1
        outs: tuple[str, ...] = ()
        start = self.at
        found = self.targets()
        if isinstance(found, nodes.Listed):
            outs = tuple(item.name for item in found.items if isinstance(item, nodes.Word))
            self.expect("=")
        elif self.tokens[start + 1].text == "=" and self.token.kind == "word":
            outs = (self.token.text,)
            self.at += 2
        name = self.next()
        while self.is_sign("."):
            self.at += 1
            name = self.next()
        if name.kind != "word":
            raise NoMatlab
        parameters: list[str] = []
        if self.is_sign("("):
            self.at += 1
            while not self.is_sign(")"):
                token = self.next()
                if token.kind == "word":
                    parameters.append(token.text)
                elif token.text == "~":
                    parameters.append("_")
                elif token.text != ",":
                    raise NoMatlab
            self.at += 1
        return nodes.Define(
            name.text, tuple(p for p in parameters if p not in ("obj", "self", "this")), outs, self.body()
        )

    # expressions

    def expression(self) -> nodes.Node:
        self.depth += 1
        if self.depth > DEEPEST:
            raise NoMatlab
        node = self.span()
        self.depth -= 1
        return node

    def span(self) -> nodes.Node:
        if self.is_sign(":") and self.tokens[self.at + 1].text in (")", ",", "}"):
            self.at += 1
            return nodes.Span()
        first = self.compared()
        if not self.is_sign(":"):
            return first
        self.at += 1
        second = self.compared()
        if not self.is_sign(":"):
            return nodes.Span(first, second)
        self.at += 1
        return nodes.Span(first, self.compared(), second)

    def compared(self) -> nodes.Node:
        left = self.sum()
        while self.is_sign("==", "<", ">", "<=", ">=", "~=", "!=", "&", "|", "&&", "||"):
            sign = self.next().text
            right = self.sum()
            left = nodes.Binary(sign, left, right)
        return left

    def apart(self) -> bool:
        """Whether a sign begins the next entry of a matrix: [a -b]."""
        return self.in_block[-1] and self.token.gap and not self.token.after

    def sum(self) -> nodes.Node:
        left = self.product()
        while self.is_sign("+", "-") and not self.apart():
            sign = self.next().text
            left = nodes.Binary(sign, left, self.product())
        return left

    def product(self) -> nodes.Node:
        left = self.signed()
        while self.is_sign("*", "/", "\\", ".*", "./", ".\\"):
            sign = self.next().text
            left = nodes.Binary(sign, left, self.signed())
        return left

    def signed(self) -> nodes.Node:
        if self.is_sign("+", "-"):
            sign = self.next().text
            return nodes.Unary(sign, self.signed())
        if self.is_sign("~", "!"):
            self.at += 1
            self.signed()
            return nodes.Strange("~")
        return self.power()

    def power(self) -> nodes.Node:
        base = self.postfix()
        while self.is_sign("^", ".^"):
            sign = self.next().text
            negative = ""
            while self.is_sign("+", "-"):
                negative = "-" if (self.next().text == "-") != (negative == "-") else ""
            exponent = self.postfix()
            base = nodes.Binary(sign, base, nodes.Unary("-", exponent) if negative else exponent)
        return base

    def postfix(self) -> nodes.Node:
        node = self.primary()
        while True:
            split = self.in_block[-1] and self.token.gap
            if self.is_sign("(") and not split:
                node = nodes.Call(node, self.arguments(")"))
            elif self.is_sign("{") and not split:
                node = nodes.At(node, self.arguments("}"))
            elif self.is_sign("'", ".'"):
                self.at += 1
                node = nodes.Turned(node)
            elif self.is_sign(".") and not split and self.tokens[self.at + 1].kind == "word":
                self.at += 1
                node = nodes.Member(node, self.next().text)
            else:
                return node

    def arguments(self, closing: str) -> tuple[nodes.Node, ...]:
        self.at += 1
        self.in_block.append(False)
        made: list[nodes.Node] = []
        while not self.is_sign(closing):
            made.append(self.expression())
            if self.is_sign(","):
                self.at += 1
            elif not self.is_sign(closing):
                raise NoMatlab
        self.at += 1
        self.in_block.pop()
        return tuple(made)

    def primary(self) -> nodes.Node:  # noqa: PLR0911 -- one for each kind
        token = self.next()
        if token.kind == "number":
            return nodes.Number(token.text.replace("d", "e").replace("D", "e"))
        if token.kind == "word":
            return nodes.Word(token.text)
        if token.kind == "text":
            return nodes.Text(token.text)
        if token.text == "(":
            self.in_block.append(False)
            node = self.expression()
            self.in_block.pop()
            self.expect(")")
            return nodes.Listed((node,)) if isinstance(node, nodes.Span) else node
        if token.text == "[":
            return self.block("]")
        if token.text == "{":
            return self.cells()
        if token.text == "@":
            return self.handle()
        raise NoMatlab

    def cells(self) -> nodes.Node:
        """{a, b}: a list, and no matrix."""
        made = self.block("}")
        assert isinstance(made, nodes.Block)
        return nodes.Listed(tuple(one for row in made.rows for one in row))

    def handle(self) -> nodes.Node:
        if self.token.kind == "word":
            return nodes.Word(self.next().text)
        names: list[str] = []
        self.expect("(")
        while not self.is_sign(")"):
            token = self.next()
            if token.kind == "word" or token.text == "~":
                names.append(token.text if token.kind == "word" else "_")
            elif token.text != ",":
                raise NoMatlab
        self.at += 1
        return nodes.Nameless(tuple(names), self.expression())

    def block(self, closing: str) -> nodes.Node:
        self.in_block.append(True)
        rows: list[tuple[nodes.Node, ...]] = []
        row: list[nodes.Node] = []
        while not self.is_sign(closing):
            if self.is_sign(";", "\n"):
                if row:
                    rows.append(tuple(row))
                row = []
                self.at += 1
            elif self.is_sign(","):
                self.at += 1
            else:
                row.append(self.expression())
        self.at += 1
        if row:
            rows.append(tuple(row))
        self.in_block.pop()
        return nodes.Block(tuple(rows))
