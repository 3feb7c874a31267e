"""What the parsers of this folder share: tokens, operators by how they bind, brackets."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar

from ..traced import nodes

MOST_TOKENS, DEEPEST = 8000, 50


class NoProgram(ValueError):
    """The text is none of the language."""


@dataclass(frozen=True)
class Token:
    """``kind``: number, word, text, sign or end."""

    kind: str
    text: str
    at: int


def tokens_of(text: str, pattern: re.Pattern[str], is_blank: Callable[[str, int], bool] = lambda c, _: c.isspace()
              ) -> list[Token]:  # fmt: skip
    """The tokens. ``is_blank``: of a character and how deep it stands in round and square brackets."""
    found: list[Token] = []
    at = 0
    opened: list[str] = []
    while True:
        while at < len(text) and is_blank(text[at], 0 if not opened or opened[-1] == "{" else 1):
            at += 1
        if at >= len(text):
            return [*found, Token("end", "", len(text))]
        match = pattern.match(text, at)
        if match is None or len(found) > MOST_TOKENS:
            raise NoProgram
        sign = match[0]
        if sign in ("(", "[", "{", "[["):
            opened.append(sign)
        elif sign in (")", "]", "}", "]]") and opened:
            is_two = sign == "]]" and opened.pop() != "[["  # x[y[1]]
            if opened and (is_two or sign != "]]"):
                opened.pop()
        found.append(Token(match.lastgroup or "sign", sign, at))
        at = match.end()


class Parser:
    """``binds``: how strongly each sign between two parts binds; ``right``: those that bind to the right."""

    binds: ClassVar[Mapping[str, int]] = {}
    right: frozenset[str] = frozenset()
    unary: ClassVar[Mapping[str, int]] = {}  # signs in front, and how strongly what stands behind is bound

    def __init__(self, source: str, tokens: list[Token]) -> None:
        self.source, self.tokens = source, tokens
        self.at = self.depth = 0

    @property
    def token(self) -> Token:
        return self.tokens[self.at]

    def next(self) -> Token:
        """This token; the next stands here then."""
        self.at += 1
        return self.tokens[self.at - 1]

    def is_sign(self, *signs: str) -> bool:
        """Whether one of these signs stands here."""
        return self.token.kind == "sign" and self.token.text in signs

    def is_word(self, *words: str) -> bool:
        """Whether one of these words stands here."""
        return self.token.kind == "word" and self.token.text in words

    def expect(self, text: str) -> None:
        """Past a sign or a word. Raises NoProgram where it does not stand here."""
        if self.token.kind not in ("sign", "word") or self.token.text != text:
            raise NoProgram
        self.at += 1

    def took(self, text: str) -> bool:
        """Whether this sign or word stands here; past it then."""
        found = self.token.kind in ("sign", "word") and self.token.text == text
        self.at += found
        return found

    def line(self, start: int) -> str:
        """The text from a token on, up to here."""
        return " ".join(self.source[self.tokens[start].at : self.token.at].split())[:60]

    def words(self, start: int) -> tuple[str, ...]:
        """All names from a token on, up to here: what a statement that is not followed may change."""
        return tuple(dict.fromkeys(t.text for t in self.tokens[start : self.at] if t.kind == "word"))

    def expression(self, least: int = 0) -> nodes.Node:
        """An expression whose signs bind at least so strongly."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise NoProgram
        sign = self.token.text if self.token.kind in ("sign", "word") else ""
        if sign in self.unary:
            self.at += 1
            left = self.with_sign(sign, self.expression(max(least, self.unary[sign])))
        else:
            left = self.postfix()
        while self.token.kind in ("sign", "word") and self.binds.get(self.token.text, -1) >= max(least, 1):
            sign = self.next().text
            self.past_line_ends()
            strength = self.binds[sign]
            left = self.combined(sign, left, self.expression(strength if sign in self.right else strength + 1))
        self.depth -= 1
        return left

    def past_line_ends(self) -> None:
        """Behind a sign an expression goes on, on the next line too."""

    def with_sign(self, sign: str, of: nodes.Node) -> nodes.Node:
        """A sign in front."""
        return nodes.Unary(sign, of) if sign in "+-" else nodes.Strange(sign)

    def combined(self, sign: str, left: nodes.Node, right: nodes.Node) -> nodes.Node:
        """Two parts with a sign between them."""
        return nodes.Binary(sign, left, right)

    def postfix(self) -> nodes.Node:
        """A name, a number, brackets, and what stands behind these."""
        raise NotImplementedError


def from_one(place: nodes.Node) -> nodes.Node:
    """A place that is counted from 1, counted from 0."""
    if isinstance(place, nodes.Number) and place.text.isdigit():
        return nodes.Number(str(int(place.text) - 1))
    return nodes.Binary("-", place, nodes.Number("1"))


def counted(first: nodes.Node, last: nodes.Node) -> nodes.Node:
    """first, …, last"""
    return nodes.Call(nodes.Word("range"), (first, nodes.Binary("+", last, nodes.Number("1"))))


def changed_in(body: Iterable[nodes.Statement]) -> tuple[str, ...]:
    """What statements may change; "return" and "continue" where they may leave a function or a loop."""
    found: list[str] = []
    for one in body:
        match one:
            case nodes.Assign(target=target):
                found += nodes.set_by(target)
            case nodes.Choice(names=names) | nodes.Unfollowed(names=names):
                found += names
            case nodes.Repeat(body=inner):
                found += changed_in(inner)
            case nodes.Return():
                found.append("return")
            case nodes.Leave():
                found.append("continue")
            case nodes.Do(value=nodes.Call(arguments=arguments)):
                found += [a.name for a in arguments if isinstance(a, nodes.Word)]
    return tuple(dict.fromkeys(found))
