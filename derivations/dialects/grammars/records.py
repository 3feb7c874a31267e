# ruff: noqa: PLR0911, PLR0912 -- tables stand on one line; one branch for each kind
"""What expressions of these languages come to, besides Python's: things with named parts, closures, whole divisions."""

from __future__ import annotations

import re

from ..traced import nodes
from ..traced.arrays import product
from ..traced.expressions import Caller, Expressions, Member
from ..traced.library import from_items
from ..traced.names import Names, Scope
from ..traced.nodes import dotted
from ..traced.values import (
    Array,
    Broken,
    Local,
    NotFollowed,
    Outside,
    Reach,
    Record,
    Several,
    Value,
    formula,
    number,
)
from .languages.language import Language

SWIZZLE = re.compile(r"[xyzw]{1,4}|[rgba]{1,4}")
COUNTS = frozenset(("length", "size", "Length", "Count", "len", "count", "nrows", "ncols", "rows", "cols"))


class GrammarExpressions(Expressions):
    """``changed``: what a function has put into what comes from outside; ``top``: the names of the text itself."""

    def __init__(self, names: Names, language: Language, *, calls: Caller, free: Member, top: Scope) -> None:
        super().__init__(names, matlab=False, calls=calls, free=free)
        self.language, self.top = language, top
        self.early: set[str] = set()  # what is read as it comes from outside
        self.changed: dict[tuple[str | int, ...], Value] = {}

    def value(self, node: nodes.Node, scope: Scope) -> Value:
        """What an expression stands for."""
        match node:
            case nodes.Fields():
                return self.record(node, scope)
            case nodes.Nameless(parameters=parameters):
                return Local(parameters, node, {}, scope)
            case nodes.Unary(sign="&", of=of):
                return self.value(of, scope)
            case nodes.Binary(sign="=="):
                return super().value(node, scope)
        found = super().value(node, scope)
        if isinstance(found, Outside) and found.path in self.changed:
            found = self.changed[found.path]
            if isinstance(found, Broken):
                raise NotFollowed(found.why)
        return found

    def record(self, node: nodes.Fields, scope: Scope) -> Value:
        """{a, b: c, ...s}"""
        fields = {name: self.value(value, scope) for name, value in zip(node.names, node.values, strict=True)}
        if node.base is None:
            return Record(fields)
        base = self.value(node.base, scope)
        if isinstance(base, Record):
            return Record({**base.fields, **fields}, base.path)
        if isinstance(base, Outside):
            return Record(fields, base.path)
        raise NotFollowed("…s of something that has no fields")

    def word(self, name: str, scope: Scope) -> Value:
        """A name; a property is what its function gives back."""
        found = super().word(name, scope)
        if found == Outside((name,)):
            self.early.add(name)
        if isinstance(found, Local) and not found.parameters and isinstance(found.of, nodes.Define):
            return self.calls(nodes.Call(nodes.Word(name), ()), scope)
        return found

    def member(self, node: nodes.Member, scope: Scope) -> Value:
        """this.m1, s->q, v.x, M.T, bobs[0].m."""
        if node.of == nodes.Word("self"):
            found = self.top.names.get(node.name)
            if isinstance(found, Broken):
                raise NotFollowed(found.why)
            if found is not None:
                return found
            given = self.free(node.name, self.top)
            if isinstance(given, Local) and not given.parameters:
                return self.calls(nodes.Call(nodes.Word(node.name), ()), self.top)
            self.names.read.add(node.name)
            return given if given is not None and not isinstance(given, Local) else Outside((node.name,))
        of = self.value(node.of, scope)
        if isinstance(of, Record):
            found = of.fields.get(node.name)
            if isinstance(found, Broken):
                raise NotFollowed(found.why)
            if found is not None:
                return found
            if not of.path and isinstance(node.of, nodes.Word) and self.top.names.get(node.of.name) is of:
                return Outside((node.of.name, node.name))  # of a thing that the class or the text has
            if not of.path:
                raise NotFollowed(f"{dotted(node) or node.name} is read before it is given a value")
            return Outside((*of.path, node.name))
        if isinstance(of, Outside):
            path = (*of.path, node.name)
            found = self.changed.get(path)
            if isinstance(found, Broken):
                raise NotFollowed(found.why)
            if found is not None:
                return found
            declared = any(key.endswith(f".{node.name}") for key in self.names.known.defined)
            if node.name in COUNTS and not declared and not self.names.known.is_quantity(node.name):
                return self.count(of)
            own = self.free(node.name, scope) if node.name not in self.names.known.defined else None
            if isinstance(own, Local) and not own.parameters and of.path == ("self",):
                return self.calls(nodes.Call(node, ()), scope)
            return Outside(path)
        if isinstance(of, Array) and SWIZZLE.fullmatch(node.name) and of.is_vector:
            return self.swizzled(of, node.name)
        if node.name in COUNTS:
            return self.count(of)
        if node.name in ("T", "transpose"):
            return super().member(node, scope)
        raise NotFollowed(f".{node.name}: this is not followed; write out what it is")

    def swizzled(self, of: Array, name: str) -> Value:
        """v.x, v.xy"""
        letters = "xyzw" if name[0] in "xyzw" else "rgba"
        places = [letters.index(c) for c in name]
        if max(places) >= len(of.entries):
            raise NotFollowed(f".{name} of a vector of {len(of.entries)}")
        if len(places) == 1:
            return of.entries[places[0]]
        return Array([of.entries[k] for k in places], (len(places),))

    def count(self, of: Value) -> Value:
        """How many entries there are."""
        if isinstance(of, Array):
            return number(of.shape[0])
        if isinstance(of, Several):
            return number(len(of.items))
        if isinstance(of, Outside):
            length = self.length(of)
            if length:
                return number(length)
        raise NotFollowed("how many entries there are is not known; write the number")

    def length(self, of: Outside) -> int:
        """How many entries of a thing from outside [define] has: bobs[0].m, bobs[1].m are two."""
        known = self.names.known
        pattern = re.compile(rf"(?:\w+\.)*{re.escape(str(of.path[-1]))}\[(\d+)\]")
        found = {int(m[1]) for key in known.defined if (m := pattern.match(key))}
        return len(found) if found and found == set(range(self.language.first, len(found) + self.language.first)) else 0

    def elements(self, value: Value) -> list[Value]:
        """What a loop goes over: numbers, or the entries of a list."""
        if isinstance(value, Reach) and value.first is not None and value.last is not None:
            if not -100 < value.last - value.first < 100:
                raise NotFollowed("a loop of more than a hundred turns; write out what it comes to")
            return [number(k) for k in range(value.first, value.last, value.step)]
        if isinstance(value, Outside):
            length = self.length(value)
            if length:
                return [Outside((*value.path, k)) for k in range(length)]
        parts = self.parts(value)
        if parts is None:
            raise NotFollowed("a loop over something else than whole numbers; write it out")
        return parts

    def each(self, node: nodes.Each, scope: Scope) -> Value:
        """[f(i) for i in 1:3]"""
        each = self.elements(self.value(node.over, scope))
        made = [self.value(node.value, Scope(scope, {node.name: k})) for k in each]
        return from_items(made) if made else Several([])

    def span(self, node: nodes.Span, scope: Scope) -> Value:
        """Places from one to another."""
        first, last, step = (None if x is None else self._place(x, scope) for x in (node.first, node.last, node.step))
        return Reach(first, last, 1 if step is None else step)

    def combined(self, sign: str, left: Value, right: Value) -> Value:
        """What an operator makes of two values."""
        if sign == "div":
            return self.divided_whole(left, right)
        for value in (left, right):
            if isinstance(value, Record):
                raise NotFollowed("things with fields are put together; write out what each field comes to")
        if sign == "*" and self.language.is_linear:
            is_array = [isinstance(x, Array) and len(x.entries) > 1 for x in (left, right)]
            if any(is_array):
                return product(self._numbers(left), self._numbers(right))
        return super().combined(sign, left, right)

    def divided_whole(self, left: Value, right: Value) -> Value:
        """A quotient of whole numbers, without its rest."""
        a, b = formula(left).whole, formula(right).whole
        if a is not None and b and a % b == 0:
            return number(a // b)
        if a is not None and b:
            raise NotFollowed(f"{a}/{b} is a division of whole numbers, {int(a / b)} in this language; write "
                              f"{a}.0/{b}.0 if the fraction is meant")  # fmt: skip
        shown = f"{formula(left).text[:20]}/{formula(right).text[:20]}"
        raise NotFollowed(
            f"{shown} is a division of whole numbers in this language; write a cast if the fraction is meant"
        )
