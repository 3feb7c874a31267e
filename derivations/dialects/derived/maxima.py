"""Maxima's text as a tree. Nothing is run."""

from __future__ import annotations

import re

from ..parsers.parser import NoProgram, Parser, from_one, tokens_of
from ..traced import nodes

TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eEbB][+-]?[0-9]+)?)"
    r"|(?P<word>%?[^\W\d][\w%?]*|%(?![\w]))"
    r"|(?P<text>\"(?:[^\"\\]|\\.){0,400}\")"
    r"|(?P<sign>:=|::?|\*\*|<=|>=|''|[-+*/^.=#<>()\[\]{},;$'!])"
)
REMARK = re.compile(r"/\*(?:[^*]|\*(?!/)){0,4000}\*/")
LABEL = re.compile(r"(?m)^[ \t]*\(%i[0-9]{1,3}\)[ \t]*")
# A name that is set by a colon, and a statement that ends as none of another language does
CUE = re.compile(r"(?m)^\s*(?:\(%i[0-9]+\)\s*)?[^\W\d]\w*(?:\[\w+\])?\s*:(?![:=])[^\n]*|^\s*depends\s*\(|:=")
ENDS = re.compile(r"[$;]\s*(?:\n|$)")
BINDS = {"=": 3, "#": 3, "<": 3, ">": 3, "<=": 3, ">=": 3, "+": 4, "-": 4, "*": 5, "/": 5, ".": 6, "^": 8, "**": 8}
COUNTED = {"sum": "sum", "makelist": "", "create_list": "", "lsum": "sum"}
DEEPEST = 40


def maxima_tree(text: str) -> tuple[nodes.Statement, ...] | None:
    """The statements; None where the text is no Maxima."""
    if "\\begin" in text or not CUE.search(text) or not ENDS.search(text):
        return None
    try:
        plain = LABEL.sub("", REMARK.sub(lambda m: " " * len(m[0]), text))
        return _Parser(plain, tokens_of(plain, TOKEN)).text_of()
    except (NoProgram, RecursionError):
        return None


class _Parser(Parser):
    # statements

    def text_of(self) -> tuple[nodes.Statement, ...]:
        made: list[nodes.Statement] = []
        while self.token.kind != "end":
            if self.is_sign(";", "$"):
                self.at += 1
                continue
            made += self.statement()
            if not self.is_sign(";", "$") and self.token.kind != "end":
                raise NoProgram
        return tuple(made)

    def statement(self) -> list[nodes.Statement]:
        start = self.at
        if self.is_word("for"):
            return [self.loop(start)]
        if self.is_word("if", "while", "unless", "do"):
            return [self.unfollowed(start)]
        target = self.expression()
        if self.is_sign(":"):
            self.at += 1
            value = self.value_of_assignment()
            return [nodes.Assign(target, value, self.line(start))]
        if self.is_sign(":="):
            self.at += 1
            return [self.definition(target, start)]
        return [nodes.Do(target, self.line(start))]

    def value_of_assignment(self) -> nodes.Node:
        """What stands behind the colon; a: b: c is not followed."""
        value = self.expression()
        if self.is_sign(":", ":="):
            raise NoProgram
        return value

    def definition(self, target: nodes.Node, start: int) -> nodes.Statement:
        match target:
            case nodes.Call(of=nodes.Word(name=name), arguments=parameters):
                names = tuple(p.name for p in parameters if isinstance(p, nodes.Word))
                if len(names) == len(parameters):
                    return nodes.Define(name, names, (), self.body(start))
        raise NoProgram

    def body(self, start: int) -> tuple[nodes.Statement, ...]:
        """What a function gives back: an expression, or the last of a block."""
        if self.is_word("block") and self.tokens[self.at + 1].text == "(":
            self.at += 2
            if self.is_sign("["):
                self.expression()
                self.expect(",")
        elif self.is_sign("("):
            self.at += 1
        else:
            return (nodes.Return(self.expression(), self.line(start)),)
        inside = self.sequence()
        *before, last = inside or [nodes.Return(None, "")]
        if isinstance(last, nodes.Do):
            last = nodes.Return(last.value, last.line)
        return (*before, last)

    def sequence(self) -> list[nodes.Statement]:
        """Statements with commas between them, up to the closing bracket."""
        made: list[nodes.Statement] = []
        while not self.is_sign(")"):
            made += self.statement()
            if self.is_sign(","):
                self.at += 1
            elif not self.is_sign(")"):
                raise NoProgram
        self.at += 1
        return made

    def loop(self, start: int) -> nodes.Statement:
        """for x in xs do (…), for i: 1 thru n do (…)"""
        self.at += 1
        name = self.next()
        if self.is_word("in"):
            self.at += 1
            over = self.expression()
        else:
            first: nodes.Node = nodes.Number("1")
            if self.is_sign(":") or self.is_word("from"):
                self.at += 1
                first = self.expression()
            if not self.is_word("thru"):
                raise NoProgram
            self.at += 1
            over = counted(first, self.expression())
        if name.kind != "word" or not self.is_word("do"):
            raise NoProgram
        self.at += 1
        if self.is_sign("("):
            self.at += 1
            body = self.sequence()
        else:
            body = self.statement()
        return nodes.Repeat(name.text, over, tuple(body), self.line(start))

    def unfollowed(self, start: int) -> nodes.Statement:
        """Up to the end of the statement: what it may change is not known."""
        depth = 0
        while self.token.kind != "end" and not (depth <= 0 and self.is_sign(";", "$", ",", ")")):
            depth += self.is_sign("(", "[") - self.is_sign(")", "]")
            self.at += 1
        inside = self.tokens[start : self.at]
        names = tuple(dict.fromkeys(t.text for t in inside if t.kind == "word"))
        return nodes.Unfollowed(self.line(start), names)

    # expressions

    def expression(self, least: int = 0) -> nodes.Node:
        self.depth += 1
        if self.depth > DEEPEST:
            raise NoProgram
        left = self.signed(least)
        while self.token.kind == "sign" and BINDS.get(self.token.text, -1) >= max(least, 1):
            sign = self.next().text
            strength = BINDS[sign]
            right = self.expression(strength if sign in ("^", "**") else strength + 1)
            left = nodes.Binary({"=": "==", "**": "^", ".": "@"}.get(sign, sign), left, right)
        self.depth -= 1
        return left

    def signed(self, least: int) -> nodes.Node:
        if self.is_sign("+", "-"):
            sign = self.next().text
            return nodes.Unary(sign, self.expression(max(least, BINDS["*"])))
        if self.is_sign("'", "''"):
            self.at += 1
        return self.postfix()

    def postfix(self) -> nodes.Node:
        node = self.primary()
        while True:
            if self.is_sign("("):
                node = called(node, self.arguments(")"))
            elif self.is_sign("["):
                places = self.arguments("]")
                node = nodes.At(node, tuple(from_one(p) for p in places))
            else:
                return node

    def arguments(self, closing: str) -> tuple[nodes.Node, ...]:
        self.at += 1
        made: list[nodes.Node] = []
        while not self.is_sign(closing):
            made.append(self.expression())
            if self.is_sign(","):
                self.at += 1
            elif not self.is_sign(closing):
                raise NoProgram
        self.at += 1
        return tuple(made)

    def primary(self) -> nodes.Node:
        token = self.token
        if token.kind == "number":
            return nodes.Number(self.next().text.replace("b", "e").replace("B", "e"))
        if token.kind == "text":
            return nodes.Text(self.next().text[1:-1])
        if token.kind == "word":
            if token.text in ("if", "for", "while", "do", "then", "else", "thru", "lambda") or token.text == "%":
                raise NoProgram
            self.at += 1
            return nodes.Word("pi" if token.text == "%pi" else token.text)
        if self.is_sign("["):
            return nodes.Listed(self.arguments("]"))
        if self.is_sign("("):
            items = self.arguments(")")
            if len(items) != 1:
                raise NoProgram
            return items[0]
        raise NoProgram


def counted(first: nodes.Node, last: nodes.Node) -> nodes.Node:
    """first, …, last"""
    return nodes.Call(nodes.Word("range"), (first, nodes.Binary("+", last, nodes.Number("1"))))


def called(of: nodes.Node, arguments: tuple[nodes.Node, ...]) -> nodes.Node:  # noqa: PLR0911 -- one for each function
    """A call; those whose arguments stand in another order here than elsewhere as elsewhere."""
    name = of.name if isinstance(of, nodes.Word) else ""
    match name, arguments:
        case "matrix", rows:
            return nodes.Call(nodes.Word("array"), (nodes.Listed(rows),))
        case (("subst" | "ratsubst"), (new, old, value)):
            return nodes.Call(nodes.Word("subs"), (value, old, new))
        case (("subst" | "at"), (pairs, value)) if name == "subst":
            return nodes.Call(nodes.Word("subs"), (value, pairs))
        case "at", (value, pairs):
            return nodes.Call(nodes.Word("subs"), (value, pairs))
        case "ev", (value, *others):
            said = tuple(o for o in others if isinstance(o, nodes.Binary | nodes.Listed))
            if len(said) == 0:
                return value
            return nodes.Call(nodes.Word("subs"), (value, nodes.Listed(said) if len(said) > 1 else said[0]))
        case (("sum" | "makelist" | "create_list"), (value, nodes.Word(name=index), first, last)):
            each = nodes.Each(value, index, counted(first, last))
            return nodes.Call(nodes.Word("sum"), (each,)) if name == "sum" else each
        case (("makelist" | "create_list" | "lsum"), (value, nodes.Word(name=index), over)):
            each = nodes.Each(value, index, over)
            return nodes.Call(nodes.Word("sum"), (each,)) if name == "lsum" else each
        case "apply", (nodes.Text(text="+"), over):
            return nodes.Call(nodes.Word("sum"), (over,))
        case "invert", _:
            return nodes.Call(nodes.Word("inv"), arguments)
        case "determinant", _:
            return nodes.Call(nodes.Word("det"), arguments)
        case "coefmatrix" | "augcoefmatrix" | "coeff" | "integrate" | "limit" | "taylor", _:
            return nodes.Strange(f"{name}(…)")
    return nodes.Call(of, arguments)
