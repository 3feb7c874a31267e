"""Lua's text as a tree. Nothing is run."""

from __future__ import annotations

import re
from typing import ClassVar

from ..grammars.languages.language import Language
from ..traced import nodes
from .parser import NoProgram, Parser, changed_in, counted, from_one, tokens_of

CUE = re.compile(r"(?m)^\s*(?:local\s+)?(?:[\w.:]+\s*=\s*)?function\b")
WORD = re.compile(r"\blocal\s|\bmath\.(?:sin|cos|pow)|\bthen\b|--")
OTHERS = re.compile(
    r"\\begin|\\frac|::|=>|(?m:^\s*function\s+(?:\[[^\]]*\]|\w+)\s*=)|\bend(?:function|if|for)\b|%|~(?!=)"
)
REMARK = re.compile(r"--\[\[.{0,4000}?\]\]|--[^\n]*", re.DOTALL)
TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<word>[^\W\d]\w*)"
    r"|(?P<text>\"[^\"\n]*\"|'[^'\n]*')"
    r"|(?P<sign>\.\.\.?|==|~=|<=|>=|[-+*/^#<>=(){}\[\];:,.])"
)
LUA = Language("Lua", "own", re.compile("$^"), whole=False, powers=frozenset({"^"}), first=1)
ENDS = ("end", "else", "elseif", "until")


def lua_tree(text: str) -> tuple[nodes.Statement, ...] | None:
    """The statements; None where the text is no Lua."""
    if not CUE.search(text) or not WORD.search(text) or not re.search(r"\bend\b", text):
        return None
    bare = REMARK.sub(lambda m: " " * len(m[0]), text)
    if OTHERS.search(bare):
        return None
    try:
        parser = _Lua(bare, tokens_of(bare, TOKEN))
        made = parser.body()
    except (NoProgram, RecursionError):
        return None
    return made if parser.token.kind == "end" else None


class _Lua(Parser):
    binds: ClassVar = {
        "or": 1, "and": 2, "<": 3, ">": 3, "<=": 3, ">=": 3, "~=": 3, "==": 3, "..": 4, "+": 5, "-": 5, "*": 6, "/": 6,
        "^": 8,
    }  # fmt: skip
    right = frozenset(("^", ".."))
    unary: ClassVar = {"-": 7, "not": 7, "#": 7}

    def body(self) -> tuple[nodes.Statement, ...]:
        """Statements up to what ends their block."""
        made: list[nodes.Statement] = []
        while self.token.kind != "end" and not self.is_word(*ENDS):
            if not self.took(";"):
                made += self.statement()
        return tuple(made)

    def statement(self) -> list[nodes.Statement]:  # noqa: PLR0911 -- one for each kind
        start = self.at
        is_local = self.took("local")
        if self.took("function"):
            return [self.function(self.name_of_function(), start)]
        if self.took("return"):
            values: tuple[nodes.Node, ...] = ()
            if self.token.kind != "end" and not self.is_word(*ENDS) and not self.is_sign(";"):
                values = self.several()
            self.took(";")
            value = None if not values else values[0] if len(values) == 1 else nodes.Listed(values)
            return [nodes.Return(value, self.line(start))]
        if self.took("for"):
            return [self.loop(start)]
        if self.took("if"):
            return [self.choice(start)]
        if self.took("do"):
            made = self.body()
            self.expect("end")
            return list(made)
        if self.is_word("while", "repeat", "goto", "break"):
            return [self.unfollowed(start)]
        targets = self.several()
        if self.took("="):
            return self.set_to(targets, self.several(), start, is_local=is_local)
        if is_local:
            return []
        if len(targets) == 1 and isinstance(targets[0], nodes.Call):
            return [nodes.Do(targets[0], self.line(start))]
        raise NoProgram

    def set_to(self, targets: tuple[nodes.Node, ...], values: tuple[nodes.Node, ...], start: int, *, is_local: bool
               ) -> list[nodes.Statement]:  # fmt: skip
        """a, b = 1, 2; a function that gets a name."""
        if len(targets) == 1 and isinstance(values[0], nodes.Nameless) and len(values) == 1:
            name = nodes.dotted(targets[0]) or ""
            made = values[0]
            return [nodes.Define(name.split(".")[-1], made.parameters, (), made.body)]
        target = targets[0] if len(targets) == 1 else nodes.Listed(targets)
        value = values[0] if len(values) == 1 else nodes.Listed(values)
        if value == nodes.Listed(()) and isinstance(target, nodes.Word):
            value = self.unfilled(target.name)
        outer = not is_local and isinstance(target, nodes.Word)
        return [nodes.Assign(target, value, self.line(start), outer=outer)]

    def unfilled(self, name: str) -> nodes.Node:
        """{} that is filled entry by entry: as long as the last place that is a number."""
        places = [int(k) for k in re.findall(rf"(?<![\w.]){name}\s*\[\s*([0-9]{{1,2}})\s*\]\s*=(?!=)", self.source)]
        if not places:
            is_named = re.search(rf"(?<![\w.]){name}\s*\.\s*[A-Za-z_]\w*\s*=(?!=)", self.source) is not None
            return nodes.Fields((), ()) if is_named else nodes.Listed(())
        zeros = nodes.Call(nodes.Word("zeros"), (nodes.Number(str(max(places))),))
        return nodes.Call(nodes.Word("unfilled·"), (nodes.Text(name), zeros))

    def several(self) -> tuple[nodes.Node, ...]:
        """Expressions with commas between them."""
        made = [self.expression()]
        while self.took(","):
            made.append(self.expression())
        return tuple(made)

    def name_of_function(self) -> str:
        """f, M.f, obj:f"""
        name = self.next()
        while self.took(".") or self.took(":"):
            name = self.next()
        if name.kind != "word":
            raise NoProgram
        return name.text

    def function(self, name: str, start: int) -> nodes.Define:
        """From its parameters to its end."""
        self.expect("(")
        parameters: list[str] = []
        while not self.took(")"):
            token = self.next()
            if token.kind != "word" and token.text != "...":
                raise NoProgram
            parameters.append(token.text)
            self.took(",")
        body = self.body()
        self.expect("end")
        return nodes.Define(name, tuple(p for p in parameters if p != "self"), (), body)

    def loop(self, start: int) -> nodes.Statement:
        """for i = 1, n do … end; other loops are not followed."""
        name = self.next()
        if not self.took("="):
            self.at = start
            return self.unfollowed(start)
        ends = self.several()
        self.expect("do")
        body = self.body()
        self.expect("end")
        if len(ends) != 2:
            return nodes.Unfollowed(self.line(start), self.words(start))
        return nodes.Repeat(name.text, counted(*ends), body, self.line(start))

    def choice(self, start: int) -> nodes.Statement:
        """if … then … elseif … else … end"""
        test = self.expression()
        self.expect("then")
        body = self.body()
        otherwise: tuple[nodes.Statement, ...] = ()
        if self.took("elseif"):
            otherwise = (self.choice(start),)
        elif self.took("else"):
            otherwise = self.body()
            self.expect("end")
        else:
            self.expect("end")
        return nodes.Choice(test, body, otherwise, self.line(start), changed_in([*body, *otherwise]))

    def unfollowed(self, start: int) -> nodes.Statement:
        """A loop whose turns are not counted: past its end."""
        if self.is_word("break", "goto"):
            self.at += 1 + self.is_word("goto")
            return nodes.Leave("break", self.line(start))
        depth = 0
        while self.token.kind != "end":
            word = self.next().text
            depth += word in ("do", "if", "function", "repeat")
            depth -= word in ("end", "until")
            if depth == 0 and word in ("end", "until"):
                break
        return nodes.Unfollowed(self.line(start), self.words(start))

    # expressions

    def combined(self, sign: str, left: nodes.Node, right: nodes.Node) -> nodes.Node:
        """Two parts with a sign between them."""
        return (
            nodes.Strange(sign)
            if sign == ".."
            else nodes.Binary({"and": "&&", "or": "||"}.get(sign, sign), left, right)
        )

    def postfix(self) -> nodes.Node:
        node = self.primary()
        while True:
            if self.is_sign("("):
                self.at += 1
                node = nodes.Call(node, self.closed(")"))
            elif self.took("["):
                place = self.expression()
                self.expect("]")
                is_key = isinstance(place, nodes.Text)
                node = nodes.Member(node, place.text) if is_key and isinstance(place, nodes.Text) else nodes.At(
                    node, (from_one(place),))  # fmt: skip
            elif self.token.kind == "text" and isinstance(node, nodes.Word | nodes.Member):  # require "x"
                node = nodes.Call(node, (nodes.Text(self.next().text[1:-1]),))
            elif self.is_sign(".", ":") and self.tokens[self.at + 1].kind == "word":
                self.at += 1
                node = nodes.Member(node, self.next().text)
            else:
                return node

    def closed(self, closing: str) -> tuple[nodes.Node, ...]:
        """Expressions up to a closing bracket."""
        made: list[nodes.Node] = []
        while not self.took(closing):
            made.append(self.expression())
            if not self.took(",") and not self.is_sign(closing):
                raise NoProgram
        return tuple(made)

    def primary(self) -> nodes.Node:  # noqa: PLR0911 -- one for each kind
        token = self.next()
        if token.kind == "number":
            return nodes.Number(token.text)
        if token.kind == "text":
            return nodes.Text(token.text[1:-1])
        if token.kind == "word":
            if token.text == "function":
                made = self.function("", self.at)
                return nodes.Nameless(made.parameters, nodes.Text("None"), made.body)
            if token.text in ("nil", "true", "false"):
                return nodes.Text(token.text)
            if token.text in (*ENDS, "then", "do", "local", "return", "if", "for", "while"):
                raise NoProgram
            return nodes.Word(token.text)
        if token.text == "(":
            node = self.expression()
            self.expect(")")
            return node
        if token.text == "{":
            return self.table()
        raise NoProgram

    def table(self) -> nodes.Node:
        """{a, b} or {x = a, y = b}"""
        names: list[str] = []
        values: list[nodes.Node] = []
        while not self.took("}"):
            if self.token.kind == "word" and self.tokens[self.at + 1].text == "=":
                names.append(self.next().text)
                self.at += 1
            values.append(self.expression())
            if not self.took(",") and not self.took(";") and not self.is_sign("}"):
                raise NoProgram
        if names and len(names) < len(values):
            return nodes.Strange("{…}")
        return nodes.Fields(tuple(names), tuple(values)) if names else nodes.Listed(tuple(values))
