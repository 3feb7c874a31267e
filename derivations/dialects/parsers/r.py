"""R's text as a tree, as deSolve and phaseR have it. Nothing is run."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import ClassVar

from ..grammars.languages.language import Language
from ..traced import nodes
from ..traced.values import NotFollowed
from .parser import NoProgram, Parser, Token, changed_in, counted, from_one, tokens_of

CUE = re.compile(r"(?:<-|=)\s*function\s*\(|^\s*function\s*\(", re.MULTILINE)
ARROW = re.compile(r"<-|\blist\s*\(|\bc\s*\(")
OTHERS = re.compile(r"\b(?:const|let|var|local|end)\b|=>|//|\\")
REMARK = re.compile(r"#[^\n]*")
TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?L?)"
    r"|(?P<word>(?:[^\W\d_]|\.(?![0-9]))[\w.]*)"
    r"|(?P<text>\"[^\"\n]*\"|'[^'\n]*')"
    r"|(?P<sign>%[^%\s]{0,8}%|<<-|<-|->|\[\[|\]\]|==|!=|<=|>=|&&|\|\||\*\*|::?:?|[-+*/^<>=!&|(){}\[\],;$@~?\n])"
)
R = Language("R", "own", re.compile("$^"), whole=False, powers=frozenset({"^"}), first=1, declares=False)
SAME = ("as.list", "as.numeric", "as.vector", "unlist", "unname", "invisible", "drop", "as.double", "identity")
EMPTY = ("numeric", "vector", "double", "rep")
SIGN_FIRST = "{!r}: the statement ends with the line before it; put its sign there"


def r_tree(text: str) -> tuple[nodes.Statement, ...] | None:
    """The statements; None where the text is no R. Raises NotFollowed where a line begins with a sign."""
    bare = REMARK.sub("", text)
    if not CUE.search(bare) or not ARROW.search(bare) or OTHERS.search(bare):
        return None
    try:
        parser = _R(bare, tokens_of(bare, TOKEN, lambda c, depth: c.isspace() and (c != "\n" or depth > 0)))
        made = parser.block_to("")
    except (NoProgram, RecursionError):
        return None
    return tuple(made)


class _R(Parser):
    binds: ClassVar = {
        "~": 1, "||": 2, "|": 2, "&&": 3, "&": 3, "==": 5, "!=": 5, "<": 5, ">": 5, "<=": 5, ">=": 5, "+": 6, "-": 6,
        "*": 7, "/": 7, "%*%": 8, "%o%": 8, "%%": 8, "%/%": 8, ":": 9, "^": 11, "**": 11,
    }  # fmt: skip
    right = frozenset(("^", "**"))
    unary: ClassVar = {"-": 10, "+": 10, "!": 4}

    def past_line_ends(self) -> None:
        while self.is_sign("\n"):
            self.at += 1

    def block_to(self, closing: str) -> list[nodes.Statement]:
        """Statements up to a closing brace, or to the end."""
        made: list[nodes.Statement] = []
        while True:
            while self.is_sign("\n", ";"):
                self.at += 1
            if self.token.kind == "end":
                if closing:
                    raise NoProgram
                return made
            if closing and self.took(closing):
                return made
            start = self.token
            if self.is_sign("-", "+") and made and self.tokens[self.at - 1].text == "\n":
                raise NotFollowed(SIGN_FIRST.format(self.source[start.at :].partition("\n")[0].strip()[:30]))
            made += self.statement()
            if not self.is_sign("\n", ";", "}") and self.token.kind != "end":
                raise NoProgram

    def statement(self) -> list[nodes.Statement]:  # noqa: PLR0911 -- one for each kind
        start = self.at
        if self.took("{"):
            return self.block_to("}")
        if self.is_word("if"):
            return [self.choice()]
        if self.is_word("for"):
            return [self.loop()]
        if self.is_word("while", "repeat"):
            return [self.past(start)]
        if self.is_word("break", "next"):
            kind = "break" if self.next().text == "break" else "continue"
            return [nodes.Leave(kind, self.line(start))]
        if self.is_word("library", "require", "rm", "set.seed", "source", "par", "plot"):
            self.expression()
            return []
        if self.is_word("with", "within") and self.tokens[self.at + 1].text == "(":
            return self.within()
        if self.is_word("return") and self.tokens[self.at + 1].text == "(":
            self.at += 2
            values = self.closed(")")
            return [nodes.Return(values[0][1] if values else None, self.line(start))]
        target = self.expression()
        if self.is_sign("<-", "<<-", "="):
            outer = self.next().text == "<<-"
            self.past_line_ends()
            if self.is_word("function"):
                return [self.function(nodes.dotted(target) or "")]
            value = self.value_of_assignment()
            return [nodes.Assign(target, value, self.line(start), outer=outer)]
        if self.took("->"):
            return [nodes.Assign(self.expression(), target, self.line(start))]
        return [nodes.Do(target, self.line(start))]

    def value_of_assignment(self) -> nodes.Node:
        value = self.expression()
        if self.is_sign("<-", "="):  # a <- b <- 1
            raise NotFollowed("two assignments in one; give each a line of its own")
        return value

    def within(self) -> list[nodes.Statement]:
        """with(as.list(c(state, parms)), {…}): the names are those of the file."""
        self.at += 2
        self.expression()
        self.expect(",")
        self.past_line_ends()
        made: list[nodes.Statement]
        if self.took("{"):
            made = self.block_to("}")
        else:
            start = self.at
            made = [nodes.Do(self.expression(), self.line(start))]
        self.past_line_ends()
        self.expect(")")
        return made

    def function(self, name: str) -> nodes.Define:
        """function(t, y, p) {…}: what is said last is given back."""
        self.expect("function")
        parameters = [n if n else nodes.dotted(v) or "" for n, v in self.parameters()]
        self.past_line_ends()
        body = self.block_to("}") if self.took("{") else self.statement()
        return nodes.Define(name, tuple(p for p in parameters if p), (), tuple(given_back(body)))

    def parameters(self) -> list[tuple[str, nodes.Node]]:
        self.expect("(")
        return self.closed(")")

    def choice(self) -> nodes.Statement:
        """if (…) {…} else {…}"""
        start = self.at
        self.at += 1
        self.expect("(")
        test = self.expression()
        self.expect(")")
        self.past_line_ends()
        body = self.statement()
        behind = self.at
        self.past_line_ends()
        otherwise: list[nodes.Statement] = []
        if self.took("else"):
            self.past_line_ends()
            otherwise = self.statement()
        else:
            self.at = behind
        return nodes.Choice(test, tuple(body), tuple(otherwise), self.line(start), changed_in([*body, *otherwise]))

    def loop(self) -> nodes.Statement:
        """for (k in 1:n) {…}"""
        start = self.at
        self.at += 1
        self.expect("(")
        name = self.next()
        self.expect("in")
        over = self.expression()
        self.expect(")")
        self.past_line_ends()
        return nodes.Repeat(name.text.replace(".", "_"), over, tuple(self.statement()), self.line(start))

    def past(self, start: int) -> nodes.Statement:
        """A loop whose turns are not counted."""
        self.at += 1
        if self.took("("):
            self.expression()
            self.expect(")")
        self.past_line_ends()
        self.statement()
        return nodes.Unfollowed(self.line(start), self.words(start))

    def words(self, start: int) -> tuple[str, ...]:
        """All names, and what leaves a function or a loop."""
        found = [w.replace(".", "_") for w in super().words(start)]
        return tuple(dict.fromkeys("continue" if w in ("next", "break") else w for w in found))

    # expressions

    def combined(self, sign: str, left: nodes.Node, right: nodes.Node) -> nodes.Node:
        """Two parts with a sign between them."""
        if sign == ":":
            return counted(left, right)
        if sign in ("%o%", "%%", "%/%", "~"):
            return nodes.Strange(sign)
        return nodes.Binary({"%*%": "@", "**": "^"}.get(sign, sign), left, right)

    def postfix(self) -> nodes.Node:
        node = self.primary()
        while True:
            if self.is_sign("("):
                self.at += 1
                node = called(node, self.closed(")"))
            elif self.is_sign("[", "[["):
                closing = {"[": "]", "[[": "]]"}[self.next().text]
                places = self.places(closing)
                if len(places) == 1 and isinstance(places[0], nodes.Text):
                    node = nodes.Member(node, places[0].text.replace(".", "_"))
                else:
                    node = nodes.At(node, tuple(p if isinstance(p, nodes.Span) else from_one(p) for p in places))
            elif self.is_sign("$", "@") and self.tokens[self.at + 1].kind in ("word", "text"):
                self.at += 1
                node = nodes.Member(node, self.next().text.strip("\"'").replace(".", "_"))
            elif self.is_sign("::", ":::"):
                self.at += 1
                node = self.primary()
            else:
                return node

    def places(self, closing: str) -> tuple[nodes.Node, ...]:
        """Indices; one that is left out is a whole row or column. ]] of x[y[1]] closes two brackets."""
        made: list[nodes.Node] = []
        while True:
            if self.is_sign(",", closing):
                made.append(nodes.Span())
            else:
                made.append(self.span())
            if self.took(","):
                continue
            if closing == "]" and self.is_sign("]]"):
                here = self.token
                self.tokens[self.at : self.at + 1] = [Token("sign", "]", here.at), Token("sign", "]", here.at + 1)]
            self.expect(closing)
            return tuple(made)

    def span(self) -> nodes.Node:
        """1:2 as a part of a vector."""
        node = self.expression()
        match node:
            case nodes.Call(of=nodes.Word(name="range"), arguments=(first, last)):
                return nodes.Span(from_one(first), from_one(last))
        return node

    def closed(self, closing: str) -> list[tuple[str, nodes.Node]]:
        """Arguments, each with its name or none."""
        made: list[tuple[str, nodes.Node]] = []
        while not self.took(closing):
            name = ""
            if self.token.kind in ("word", "text") and self.tokens[self.at + 1].text == "=":
                name = self.next().text.strip("\"'").replace(".", "_")
                self.at += 1
            if self.is_sign(",", closing) and name:  # function(x =)
                made.append((name, nodes.Text("None")))
            else:
                made.append((name, self.expression()))
            if not self.took(",") and not self.is_sign(closing):
                raise NoProgram
        return made

    def primary(self) -> nodes.Node:  # noqa: PLR0911 -- one for each kind
        if self.is_word("function"):
            made = self.function("")
            match made.body:
                case (nodes.Return(value=value),) if value is not None:
                    return nodes.Nameless(made.parameters, value)
            return nodes.Nameless(made.parameters, nodes.Text("None"), made.body)
        token = self.next()
        if token.kind == "number":
            return nodes.Number(token.text.rstrip("L"))
        if token.kind == "text":
            return nodes.Text(token.text[1:-1])
        if token.kind == "word":
            if token.text in ("if", "else", "for", "while", "in", "repeat"):
                raise NoProgram
            if token.text in ("NULL", "NA", "TRUE", "FALSE", "T", "F"):
                follows = self.tokens[self.at].text
                if token.text not in ("T", "F") or follows in (",", ")"):
                    return nodes.Text(token.text)
            return nodes.Word(token.text.replace(".", "_"))
        if token.text == "(":
            node = self.expression()
            self.expect(")")
            return node
        if token.text == "{":
            body = self.block_to("}")
            if len(body) == 1 and isinstance(body[0], nodes.Do):
                return body[0].value
        raise NoProgram


def given_back(body: Sequence[nodes.Statement]) -> list[nodes.Statement]:
    """A function's statements, the last of which is what it gives back."""
    if not body:
        return []
    *before, last = body
    match last:
        case nodes.Do(value=value, line=line):
            return [*before, nodes.Return(value, line)]
        case nodes.Assign(target=target, line=line):
            return [*before, last, nodes.Return(target, line)]
        case nodes.Choice(test=test, body=inner, otherwise=otherwise, line=line, names=names):
            made = tuple(tuple(given_back(part)) for part in (inner, otherwise))
            return [*before, nodes.Choice(test, made[0], made[1], line, (*names, "return"))]
    return list(body)


def called(  # noqa: PLR0911 -- one for each function
    of: nodes.Node, given: list[tuple[str, nodes.Node]]
) -> nodes.Node:
    """A call; vectors, lists and matrices as such."""
    name = (nodes.dotted(of) or "").replace("_", ".")
    values = tuple(value for _, value in given)
    match name:
        case "c":
            return vector(given)
        case "list" if values:
            return values[0] if not given[0][0] or isinstance(values[0], nodes.Listed | nodes.Fields) else vector(given)
        case "matrix" if values:
            return matrix(given)
        case "cbind":
            return nodes.Call(nodes.Word("column_stack"), (nodes.Listed(values),))
        case "rbind":
            return nodes.Call(nodes.Word("vstack"), (nodes.Listed(values),))
        case "diag" if len(values) == 1 and isinstance(values[0], nodes.Number):
            return nodes.Call(nodes.Word("eye"), values)
        case "solve" if len(values) == 1:
            return nodes.Call(nodes.Word("inv"), values)
        case "length" if len(values) == 1:
            return nodes.Call(nodes.Word("len"), values)
        case "t" if len(values) == 1:
            return nodes.Turned(values[0])
        case _ if name in SAME and values:
            return values[0]
        case _ if name in EMPTY and values:
            return nodes.Call(nodes.Word("zeros"), (values[-1],))
        case "ifelse":
            return nodes.Strange("ifelse(…)")
    return nodes.Call(of, values)


def vector(given: list[tuple[str, nodes.Node]]) -> nodes.Node:
    """c(a, b), c(x = a, y = b)"""
    names = tuple(name for name, _ in given)
    values = tuple(value for _, value in given)
    if all(names) and len(set(names)) == len(names) and names:
        return nodes.Fields(names, values)
    return nodes.Listed(values)


def matrix(given: list[tuple[str, nodes.Node]]) -> nodes.Node:
    """matrix(c(…), nrow = 2): column by column unless it says byrow."""
    said = {name: value for name, value in given if name}
    plain = [value for name, value in given if not name]
    data = said.get("data", plain[0] if plain else None)
    entries = list(data.items) if isinstance(data, nodes.Listed) else None
    if data is not None and entries is None and isinstance(data, nodes.Number):
        raise NotFollowed("a matrix of one value; write out its entries")
    if entries is None:
        return nodes.Strange("matrix(…)")
    numbers = [
        v.text for v in (*plain[1:], *(said[k] for k in ("nrow", "ncol") if k in said)) if isinstance(v, nodes.Number)
    ]
    n = len(entries)
    rows = int(said["nrow"].text) if isinstance(said.get("nrow"), nodes.Number) else 0  # type: ignore[union-attr]
    columns = int(said["ncol"].text) if isinstance(said.get("ncol"), nodes.Number) else 0  # type: ignore[union-attr]
    rows = rows or (int(numbers[0]) if len(plain) > 1 and numbers else n // columns if columns else 0)
    if not rows or n % rows:
        return nodes.Strange("matrix(…)")
    columns = n // rows
    by_row = said.get("byrow", plain[3] if len(plain) > 3 else nodes.Text("FALSE"))
    if not isinstance(by_row, nodes.Text):
        return nodes.Strange("matrix(…)")
    if by_row.text in ("TRUE", "T"):
        made = [entries[k * columns : (k + 1) * columns] for k in range(rows)]
    else:
        made = [[entries[i + rows * j] for j in range(columns)] for i in range(rows)]
    return nodes.Call(nodes.Word("array"), (nodes.Listed(tuple(nodes.Listed(tuple(row)) for row in made)),))
