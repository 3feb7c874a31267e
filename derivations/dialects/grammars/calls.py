# ruff: noqa: E501, PLR0911 -- tables stand on one line; one branch for each kind
"""Calls of these languages, besides Python's: overloads, what a function fills, closures over lists."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..traced import library, nodes
from ..traced.calls import Calls
from ..traced.names import Scope
from ..traced.values import (
    Array,
    Broken,
    Formula,
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
from .records import COUNTS, GrammarExpressions

if TYPE_CHECKING:
    from .follow import GrammarFollower

OVER = frozenset(
    ("map", "forEach", "reduce", "slice", "sum", "fold", "each", "mapIndexed", "forEachIndexed", "Sum", "Select")
)


class GrammarCalls(Calls):
    """``follower``: knows what a function has filled when it is through."""

    expressions: GrammarExpressions

    def __init__(self, expressions: GrammarExpressions, functions: dict[str, Local], follow: object, follower: GrammarFollower
                 ) -> None:  # fmt: skip
        super().__init__(expressions, functions, follow)  # type: ignore[arg-type]
        self.expressions = expressions
        self.follower = follower

    def call(self, node: nodes.Call, scope: Scope) -> Value:
        """What a call comes to."""
        of = node.of
        if isinstance(of, nodes.Word):
            special = self.special(of.name, node, scope)
            if special is not None:
                return special
            found = scope.find(of.name)
            if isinstance(found, Local):
                return self.through(found, node, scope)
            if found is None and of.name in self.functions:
                return self.through(self.chosen(of.name, node), node, scope)
            if found is None and self.is_vector_of(of.name, scope) and len(node.arguments) == 1:
                return self.expressions.entry(Outside((of.name,)), self.given(node, scope), 0)  # x(1)
        if isinstance(of, nodes.Member) and of.of == nodes.Word("self") and of.name in self.functions:
            return self.through(self.chosen(of.name, node), node, scope)
        if isinstance(of, nodes.Member):
            return self.of_member(of, node, scope)
        return super().call(node, scope)

    def is_vector_of(self, name: str, scope: Scope) -> bool:
        """Whether a parameter of C++ is called, as Eigen's and CasADi's vectors are."""
        is_cpp = self.follower.language.grammar == "tree_sitter_cpp"
        return is_cpp and any(name in one.parameters for one in scope.all)

    def of_member(self, of: nodes.Member, node: nodes.Call, scope: Scope) -> Value:
        """A method of a value."""
        receiver = self.expressions.value(of.of, scope)
        if of.name in OVER and not isinstance(receiver, Record):
            found = self.over(of.name, receiver, node, scope)
            if found is not None:
                return found
        if of.name in COUNTS and not node.arguments:
            return self.expressions.count(receiver)
        if of.name in self.functions and isinstance(receiver, Outside | Record):
            return self.through(self.chosen(of.name, node), node, scope)
        path = nodes.dotted(of)
        texts = [a.text for a in node.arguments if isinstance(a, nodes.Text)]
        if isinstance(receiver, Outside) and len(texts) == len(node.arguments) == 1:  # s.X("theta1")
            key = f'{path}("{texts[0]}")'
            said = self.expressions.names.known.defined.get(key)
            if said is not None:
                return Outside((*receiver.path, f'{of.name}("{texts[0]}")'))
        if isinstance(receiver, Formula | Outside) and of.name in ("sincos", "max", "min"):
            return self.known(of.name, [receiver, *self.given(node, scope)], node, scope)
        if isinstance(receiver, Outside) and of.name in library.SOLVES and len(node.arguments) == 2:
            return self.known("solve", self.given(node, scope), node, scope)
        if isinstance(receiver, Array) and of.name in ("mul", "times", "multiply", "dot", "Multiply", "mult"):
            return self.expressions.combined("@", receiver, self.given(node, scope)[0])
        if isinstance(receiver, Array) and of.name in ("add", "plus", "sub", "subtract", "minus"):
            sign = "+" if of.name in ("add", "plus") else "-"
            return self.expressions.combined(sign, receiver, self.given(node, scope)[0])
        if of.name in library.INVERSES and isinstance(receiver, Array) and not node.arguments:
            return self.expressions.inverted(receiver)
        if isinstance(receiver, Record):
            raise NotFollowed(f".{of.name}(…) of a thing with fields is not followed; write out what it comes to")
        return super().call(node, scope)

    def chosen(self, name: str, node: nodes.Call) -> Local:
        """The function of this name that takes as many arguments. Raises NotFollowed where that is not one."""
        size = len(node.arguments) + len(node.named)
        fitting = [one for one in self.follower.overloads.get(name, []) if self.takes(one, size)]
        if len(fitting) != 1 and name in self.follower.overloads:
            raise NotFollowed(f"{name}(…) of {size}: {len(fitting) or 'no'} functions of this name take so many")
        return fitting[0] if fitting else self.functions[name]

    @staticmethod
    def takes(one: Local, size: int) -> bool:
        """Whether a function may be given so many values."""
        optional = one.of.optional if isinstance(one.of, nodes.Define) else ()
        return len(one.parameters) - len(optional) <= size <= len(one.parameters)

    def through(self, local: Local, node: nodes.Call, scope: Scope) -> Value:
        """What a function of the text gives back; what it fills or changes of its arguments is so here, too."""
        given, named = self.given(node, scope), self.named(node, scope)
        size = len(given) + len(named)
        if isinstance(local.of, nodes.Define) and not self.takes(local, size):
            raise NotFollowed(f"{local.of.name}(…) is called with {size} values for {len(local.parameters)}")
        value = self.follow(local, given, named)
        inner = self.follower.last_scope
        shared = local.of.shared if isinstance(local.of, nodes.Define) else ()
        for name, argument, before in zip(local.parameters, node.arguments, given, strict=False):
            after = inner.names.get(name) if inner is not None else None
            if after is None or after is before:
                continue
            place = argument.of if isinstance(argument, nodes.Unary) and argument.sign == "&" else argument
            is_filled = isinstance(after, Array) and after.is_state and isinstance(before, Outside)
            if is_filled or (name in shared and not isinstance(before, Array)):
                if isinstance(place, nodes.Word):
                    holder = scope if place.name in scope.names or place.name in scope.parameters else self.follower.top
                    holder.names[place.name] = after
                elif isinstance(place, nodes.Member):
                    self.follower._put_at(place, after, "", scope, scope)
        return value

    def special(self, name: str, node: nodes.Call, scope: Scope) -> Value | None:
        """What the tree itself makes: arrays that are not filled, places of a list, degrees."""
        if name == "degrees":
            raise NotFollowed("degrees; angles are in radians here")
        if name == "unfilled·":
            first, shape = node.arguments
            assert isinstance(first, nodes.Text)
            zeros = self.expressions.value(shape, scope)
            if not isinstance(zeros, Array):
                return Outside((first.text,))
            sizes = zeros.shape
            places = [(k,) for k in range(sizes[0])] if len(sizes) == 1 else [
                (i, j) for i in range(sizes[0]) for j in range(sizes[1])]  # fmt: skip
            return Array([Formula(Outside((first.text, *p)).mark) for p in places], sizes, zeros.kind)
        if name in library.INVERSES and len(node.arguments) == 1 and name not in self.functions:
            value = self.expressions.value(node.arguments[0], scope)
            if isinstance(value, Array):
                return self.expressions.inverted(value)
        if name == "places·":
            value = self.expressions.value(node.arguments[0], scope)
            if isinstance(value, Formula) and value.whole is not None:
                return Reach(0, value.whole)
            return Reach(0, len(self.expressions.elements(value)))
        return None

    def of_value(self, found: Value, node: nodes.Call, scope: Scope) -> Value:
        """A local function, or entries of Eigen's M(0, 1)."""
        if isinstance(found, Array | Outside | Several) and self.expressions.language.grammar == "tree_sitter_cpp":
            return self.expressions.entry(found, self.given(node, scope), 0)
        if isinstance(found, Local):
            return self.through(found, node, scope)
        if isinstance(found, Outside) and self.expressions.language.grammar != "tree_sitter_cpp":
            return self.known(str(found.path[-1]), self.given(node, scope), node, scope)
        return super().of_value(found, node, scope)

    def known(self, name: str, given: list[Value], node: nodes.Call, scope: Scope) -> Value:
        """A function of a library; what one that is not known may have changed is not known behind it."""
        found = super().known(name, given, node, scope)
        if isinstance(found, Outside) and str(found.path[-1]).startswith(f"{name}("):
            self.follower._touched(node, scope, name)
        return found

    def over(self, name: str, receiver: Value, node: nodes.Call, scope: Scope) -> Value | None:
        """bs.map(b => …), bs.reduce((sum, b) => …, 0), m[1..].iter().sum()."""
        try:
            items = self.expressions.elements(receiver)
        except NotFollowed:
            return None
        given = self.given(node, scope)
        if name in ("sum", "Sum") and not given:
            return self.total(items)
        if name == "slice":
            ends = [formula(g).whole for g in given]
            return Several(items[ends[0] if ends else 0 : ends[1] if len(ends) > 1 else None])
        call = next((g for g in given if isinstance(g, Local)), None)
        if call is None:
            return None
        if name in ("reduce", "fold"):
            start = next((g for g in given if not isinstance(g, Local)), None)
            total: Value = items.pop(0) if start is None else start
            for k, item in enumerate(items):
                total = self.follow(call, [total, item, number(k)][: max(2, len(call.parameters))], {})
            return total
        is_indexed = name.endswith("Indexed")
        made = [self.follow(call, [number(k), item] if is_indexed else [item, number(k)][: max(1, len(call.parameters))], {})
                for k, item in enumerate(items)]  # fmt: skip
        if name in ("forEach", "each", "forEachIndexed"):
            return Several([])
        return library.from_items(made)

    def total(self, items: list[Value]) -> Value:
        """The sum of all."""
        total: Value = Formula("0")
        for item in items:
            if isinstance(item, Broken):
                raise NotFollowed(item.why)
            total = self.expressions.combined("+", total, item)
        return total
