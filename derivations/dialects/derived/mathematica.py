# ruff: noqa: E501 -- patterns and tables stand on one line
"""Mathematica's text as a tree. Nothing is run."""

from __future__ import annotations

import re

from ..parsers.parser import MOST_TOKENS, NoProgram, Parser, Token, counted, from_one
from ..traced import nodes

TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+(?:\.(?!\w)[0-9]*|\.[0-9]+)?|\.[0-9]+)(?:\*\^-?[0-9]+)?)"
    r"|(?P<word>[^\W\d_][^\W_]*(?:\$[^\W_]*)*_?|#[0-9]?)"
    r"|(?P<text>\"(?:[^\"\\]|\\.){0,400}\")"
    r"|(?P<sign>\[\[|\]\]|:=|:>|->|==|//\.|//@|//|/\.|/@|@@|@|&&|\|\||<=|>=|!=|[-+*/^.=;,(){}\[\]'&<>!\n])"
)
REMARK = re.compile(r"\(\*(?:[^*]|\*(?!\))){0,4000}\*\)")
LETTER = re.compile(r"\\\[(?:Curly)?(?P<word>[A-Z][a-z]+)\]")
LABEL = re.compile(r"(?m)^[ \t]*In\[[0-9]{1,3}\]:?=[ \t]*")
SIGNS = {"\\[Equal]": "==", "\\[Rule]": "->", "\\[Prime]": "'", "\\[InvisibleTimes]": " ", "\\[Times]": "*"}
CUE = re.compile(r"\b(?:Sin|Cos|D|Sum|Table|Sqrt|Solve|Simplify)\s*\[")
OTHERS = re.compile(r"(?m)^\s*(?:def|class|import|function|syms|end)\b|:=\s*proc|\\(?:frac|begin|left|dot|cos|sin)")
RULES, SAME, SUM, PRODUCT, DOT, POWER = 2, 4, 5, 6, 7, 9
BINDS = {"->": 3, ":>": 3, "/.": RULES, "&&": 3, "==": SAME, "+": SUM, "-": SUM, "*": PRODUCT, "/": PRODUCT, ".": DOT,
         "^": POWER, "/@": 10, "@": 11}  # fmt: skip
FUNCTIONS = {
    "Sin": "sin", "Cos": "cos", "Tan": "tan", "Sqrt": "sqrt", "Abs": "abs", "Sign": "sign", "Inverse": "inv", "Det": "det",
    "LinearSolve": "solve·", "Transpose": "transpose", "Total": "sum", "Length": "len", "Grad": "gradient",
    "DiagonalMatrix": "diag", "Dot": "dot",
}  # fmt: skip
SCOPES = ("Module", "With", "Block")
DEEPEST = 60


def plain_letters(text: str) -> str:
    r"""\[Theta] as theta, and signs that have names as signs."""
    for sign, plain in SIGNS.items():
        text = text.replace(sign, plain)
    return LETTER.sub(lambda m: m["word"].lower() if m["word"] not in ("Omega", "Gamma", "Delta") else m["word"], text)


def mathematica_tree(text: str) -> tuple[nodes.Statement, ...] | None:
    """The statements; None where the text is no Mathematica."""
    if not CUE.search(text) or OTHERS.search(text):
        return None
    try:
        plain = LABEL.sub("", REMARK.sub(" ", plain_letters(text)))
        return _Parser(plain, tokens_of(plain)).text_of()
    except (NoProgram, RecursionError):
        return None


def tokens_of(text: str) -> list[Token]:
    """The tokens; line ends within brackets are none. Raises NoProgram where the text is none."""
    found: list[Token] = []
    at = depth = 0
    while True:
        while at < len(text) and text[at].isspace() and not (text[at] == "\n" and depth == 0):
            at += 1
        if at >= len(text):
            return [*found, Token("end", "", at)]
        match = TOKEN.match(text, at)
        if match is None or len(found) > MOST_TOKENS:
            raise NoProgram
        sign = match[0]
        if sign == "]]" and not _opened_twice(found):
            sign = "]"
        depth += sign in ("[", "(", "{") or 2 * (sign == "[[")
        depth -= sign in ("]", ")", "}") or 2 * (sign == "]]")
        found.append(Token(match.lastgroup or "sign", sign, at))
        at += len(sign)


def _opened_twice(found: list[Token]) -> bool:
    """Whether the bracket that is open last is [[."""
    depth = 0
    for token in reversed(found):
        if token.kind != "sign":
            continue
        depth += token.text in ("]", ")", "}") or token.text == "]]"
        if token.text in ("[", "(", "{", "[["):
            if depth == 0:
                return token.text == "[["
            depth -= 1
    return False


class _Parser(Parser):
    # statements

    def text_of(self) -> tuple[nodes.Statement, ...]:
        made: list[nodes.Statement] = []
        while self.token.kind != "end":
            if self.is_sign(";", "\n"):
                self.at += 1
                continue
            made += self.statement()
            if not self.is_sign(";", "\n") and self.token.kind != "end":
                raise NoProgram
        return tuple(made)

    def statement(self) -> list[nodes.Statement]:
        start = self.at
        target = self.postfixed()
        if self.is_sign("=", ":="):
            self.at += 1
            self.skip()
            return [self.set_to(target, start)]
        if isinstance(target, nodes.Call) and target.of == nodes.Word("Do"):
            return [self.done(target, start)]
        return [nodes.Do(target, self.line(start))]

    def skip(self) -> None:
        while self.is_sign("\n"):
            self.at += 1

    def set_to(self, target: nodes.Node, start: int) -> nodes.Statement:
        """name = value, f[x_] := value, x[1] = value"""
        match target:
            case nodes.Call(of=nodes.Word(name=name), arguments=(nodes.Number(text=k),)) if k.isdigit():
                return nodes.Assign(nodes.Word(f"{name}__{k}"), self.value_of_assignment(), self.line(start))
            case nodes.Call(of=nodes.Word(name=name), arguments=parameters):
                names = tuple(p.name.rstrip("_") for p in parameters if isinstance(p, nodes.Word))
                if len(names) == len(parameters) and all(
                    isinstance(p, nodes.Word) and p.name.endswith("_") for p in parameters
                ):
                    return nodes.Define(name, names, (), self.body(start))
                if parameters == (nodes.Word("t"),):  # x[t] = …: what it is for this name of time
                    return nodes.Define(name, ("t",), (), self.body(start))
            case nodes.Word() | nodes.Listed():
                return nodes.Assign(target, self.value_of_assignment(), self.line(start))
        raise NoProgram

    def value_of_assignment(self) -> nodes.Node:
        value = self.postfixed()
        if self.is_sign("=", ":="):
            raise NoProgram
        return value

    def body(self, start: int) -> tuple[nodes.Statement, ...]:
        """What a function gives back; the last statement of Module[{…}, …]."""
        if self.token.kind == "word" and self.token.text in SCOPES and self.tokens[self.at + 1].text == "[":
            self.at += 2
            first = self.locals_of(start)
            self.expect(",")
            made = [*first, *self.sequence("]")]
        elif self.is_sign("("):
            at = self.at
            value = self.postfixed()
            if not self.is_sign(";") or self.depth:
                return (nodes.Return(value, self.line(start)),)
            self.at = at
            raise NoProgram
        else:
            return (nodes.Return(self.postfixed(), self.line(start)),)
        *before, last = made or [nodes.Return(None, "")]
        return (*before, nodes.Return(last.value, last.line) if isinstance(last, nodes.Do) else last)

    def locals_of(self, start: int) -> list[nodes.Statement]:
        """{a, b = 1} of Module."""
        self.expect("{")
        made: list[nodes.Statement] = []
        while not self.is_sign("}"):
            name = self.postfixed()
            if self.is_sign("="):
                self.at += 1
                made.append(nodes.Assign(name, self.postfixed(), self.line(start)))
            if self.is_sign(","):
                self.at += 1
        self.at += 1
        return made

    def sequence(self, closing: str) -> list[nodes.Statement]:
        made: list[nodes.Statement] = []
        while not self.is_sign(closing):
            if self.is_sign(";", "\n"):
                self.at += 1
                continue
            if self.token.kind == "end":
                raise NoProgram
            made += self.statement()
        self.at += 1
        return made

    def done(self, call: nodes.Call, start: int) -> nodes.Statement:
        """Do[…] is not followed: what it sets is not known."""
        names = tuple(dict.fromkeys(t.text for t in self.tokens[start : self.at] if t.kind == "word"))
        return nodes.Unfollowed(self.line(start), names)

    # expressions

    def postfixed(self) -> nodes.Node:
        """a // Simplify"""
        node = self.expression()
        while self.is_sign("//"):
            self.at += 1
            node = called(self.expression(POWER), (node,))
        return node

    def expression(self, least: int = 0) -> nodes.Node:
        self.depth += 1
        if self.depth > DEEPEST:
            raise NoProgram
        left = self.signed(least)
        while True:
            if self.is_sign("&") and least <= 1:
                self.at += 1
                left = nodes.Nameless(("slot",), left)
                continue
            sign = self.token.text if self.token.kind == "sign" else ""
            strength = BINDS.get(sign, -1)
            if strength < 0 and self.starts() and least <= PRODUCT:
                left = nodes.Binary("*", left, self.expression(PRODUCT + 1))
                continue
            if strength < max(least, 1):
                break
            self.at += 1
            self.skip()
            right = self.expression(strength if sign in ("^", "@", "/@") else strength + 1)
            left = combined(sign, left, right)
        self.depth -= 1
        return left

    def starts(self) -> bool:
        """Whether a factor begins here, with no sign before it."""
        token = self.token
        return token.kind in ("number", "word", "text") or (token.kind == "sign" and token.text in ("(", "{"))

    def signed(self, least: int) -> nodes.Node:
        if self.is_sign("+", "-"):
            sign = self.next().text
            return nodes.Unary(sign, self.expression(max(least, PRODUCT)))
        return self.postfix()

    def postfix(self) -> nodes.Node:
        node = self.primary()
        while True:
            if self.is_sign("[["):
                node = nodes.At(node, tuple(from_one(p) for p in self.arguments("]]")))
            elif self.is_sign("["):
                arguments = self.arguments("]")
                if isinstance(node, nodes.Primed):
                    node = nodes.Primed(called(node.of, arguments), node.order)
                elif isinstance(node, nodes.Call) and node.of == nodes.Word("Derivative·"):
                    node = nodes.Primed(arguments[0], int(node.arguments[0].text))  # type: ignore[union-attr]
                else:
                    node = called(node, arguments)
            elif self.is_sign("'"):
                self.at += 1
                node = (
                    nodes.Primed(node.of, node.order + 1) if isinstance(node, nodes.Primed) else nodes.Primed(node, 1)
                )
            else:
                return node

    def arguments(self, closing: str) -> tuple[nodes.Node, ...]:
        self.at += 1
        made: list[nodes.Node] = []
        while not self.is_sign(closing):
            made.append(self.postfixed())
            if self.is_sign(","):
                self.at += 1
            elif not self.is_sign(closing):
                raise NoProgram
        self.at += 1
        return tuple(made)

    def primary(self) -> nodes.Node:
        token = self.token
        if token.kind == "number":
            if "*^" in token.text:
                raise NoProgram
            return nodes.Number(self.next().text)
        if token.kind == "text":
            return nodes.Text(self.next().text[1:-1])
        if token.kind == "word":
            self.at += 1
            if token.text.startswith("#"):
                return nodes.Word("slot")
            return nodes.Word({"Pi": "pi"}.get(token.text, token.text))
        if self.is_sign("{"):
            return nodes.Listed(self.arguments("}"))
        if self.is_sign("("):
            items = self.arguments(")")
            if len(items) == 1:
                return items[0]
        raise NoProgram


def combined(sign: str, left: nodes.Node, right: nodes.Node) -> nodes.Node:  # noqa: PLR0911 -- one for each sign
    """Two parts with a sign between them."""
    match sign:
        case "/.":
            return nodes.Call(nodes.Word("subs"), (left, right))
        case "->" | ":>":
            return nodes.Binary("==", left, right)
        case "@":
            return called(left, (right,))
        case "/@":
            return nodes.Each(called(left, (nodes.Word("each"),)), "each", right)
        case "&&":
            return nodes.Listed((left, right))
        case ".":
            return nodes.Binary("@", left, right)
    return nodes.Binary(sign, left, right)


def called(of: nodes.Node, arguments: tuple[nodes.Node, ...]) -> nodes.Node:  # noqa: PLR0911 -- one for each function
    """A call; sums and tables over numbers as lists."""
    name = of.name if isinstance(of, nodes.Word) else ""
    match name, arguments:
        case (("Sum" | "Table"), (value, *ranges)) if ranges:
            node = value
            for one in reversed(ranges):
                node = _each(node, one)
            if name == "Sum":
                return nodes.Call(nodes.Word("sum"), (node,))
            return node
        case "Derivative", (nodes.Number(text="1" | "2" as order),):
            return nodes.Call(nodes.Word("Derivative·"), (nodes.Number(order),))
        case "Subscript", (nodes.Word(name=base), nodes.Number(text=k)):
            return nodes.Word(f"{base}{k}")
        case (("First" | "Flatten" | "Evaluate" | "Normal" | "Thread"), (value,)):
            return nodes.At(value, (nodes.Number("0"),)) if name == "First" else value
        case (("Simplify" | "FullSimplify" | "Expand"), (value, *_)):
            return value
        case "LinearSolve", (matrix, right):
            return nodes.Call(nodes.Member(nodes.Word("linalg"), "solve"), (matrix, right))
        case "Array", _:
            return nodes.Strange("Array[…]")
    if isinstance(of, nodes.Nameless):
        return nodes.Call(of, arguments)
    return nodes.Call(nodes.Word(FUNCTIONS.get(name, name)) if name else of, arguments)


def _each(value: nodes.Node, of: nodes.Node) -> nodes.Node:
    match of:
        case nodes.Listed(items=(nodes.Word(name=name), nodes.Listed() as over)):
            return nodes.Each(value, name, over)
        case nodes.Listed(items=(nodes.Word(name=name), last)):
            return nodes.Each(value, name, counted(nodes.Number("1"), last))
        case nodes.Listed(items=(nodes.Word(name=name), first, last)):
            return nodes.Each(value, name, counted(first, last))
    raise NoProgram
