"""Follows a script of computer algebra: what the follower of programs does, and equations, pairs and lists besides."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress

from ..traced import nodes
from ..traced.expressions import COMPARED, Expressions
from ..traced.follow import NOT_FOLLOWED, Follower
from ..traced.known import Known
from ..traced.library import from_items, reach
from ..traced.names import Scope
from ..traced.values import (
    ZERO,
    Array,
    Broken,
    Formula,
    Local,
    NotFollowed,
    Outside,
    Record,
    Several,
    Value,
    number,
)
from .algebra import Algebra
from .calls import ScriptCalls
from .values import Made, equation, is_equation, mark_of

EVALUATED = ("form_lagranges_equations", "gradef", "NDSolve", "NDSolveValue", "Solve", "solve")


class ScriptExpressions(Expressions):
    """``algebra``: knows what is a function of time."""

    algebra: Algebra

    def value(self, node: nodes.Node, scope: Scope) -> Value:
        """What an expression stands for."""
        match node:
            case nodes.Pairs(keys=keys, values=values):
                made = [
                    from_items([self.value(k, scope), self.value(v, scope)]) for k, v in zip(keys, values, strict=True)
                ]
                return Several(made)
            case nodes.Primed(of=of, order=order):
                found = self.value(of, scope)
                found = self.algebra.moves(found) if isinstance(found, Outside) else found
                return self.algebra.by_time(found, order)
        return super().value(node, scope)

    def binary(self, node: nodes.Binary, scope: Scope) -> Value:
        """Two values and an operator; an equation where == stands between formulas."""
        left, right = self.value(node.left, scope), self.value(node.right, scope)
        if node.sign == "==" and not all(isinstance(x, Formula) and x.whole is not None for x in (left, right)):
            return equation(left, right)
        if node.sign in ("+", "-") and (is_equation(left) or is_equation(right)):
            raise NotFollowed("equations are put together; write out the one that they make")
        return self.combined(node.sign, left, right)

    def combined(self, sign: str, left: Value, right: Value) -> Value:
        """What an operator makes of two values."""
        if isinstance(left, Record) and isinstance(right, Record):
            raise NotFollowed("equations are put together; write out the one that they make")
        return super().combined(sign, left, right)

    def member(self, node: nodes.Member, scope: Scope) -> Value:
        """eq.rhs, LM.mass_matrix, sol.ddth1, dynamicsymbols._t."""
        if node.name == "_t":
            return Outside(("t",))
        if not self.is_of_module(node, scope):
            of = self.value(node.of, scope)
            if isinstance(of, Record):
                return self.of_record(of, node.name)
            if node.name == "T" and isinstance(of, Formula):
                return of
        return super().member(node, scope)

    def is_of_module(self, node: nodes.Member, scope: Scope) -> bool:
        """Whether what stands in front of the dot is no value."""
        root = nodes.dotted(node)
        return root is None or scope.find(root.split(".")[0]) is None

    def of_record(self, of: Record, name: str) -> Value:
        """A side of an equation, a matrix of LagrangesMethod, a solution by its name."""
        if name in of.fields:
            return of.fields[name]
        if "lagrangian" in of.fields:
            return self.algebra.of_method(of, name)
        if f"«{name}»" in of.fields:
            return of.fields[f"«{name}»"]
        raise NotFollowed(f".{name}: this is not followed; write out what it is")

    def entry(self, of: Value, places: list[Value], first: int) -> Value:
        """sol[a1]: a solution by what it was solved for; entries of anything else."""
        if isinstance(of, Record) and "solution" in of.fields and len(places) == 1:
            mark = mark_of(places[0])
            if mark is not None and f"«{mark}»" in of.fields:
                return of.fields[f"«{mark}»"]
            if isinstance(places[0], Formula) and places[0].whole == first:
                alone = super().parts(of.fields["solution"]) or [of.fields["solution"]]
                is_value = self.algebra.kind == "matrix" and len(alone) == 1
                return alone[0] if is_value else of  # the first of all solutions, which is the only one
        if isinstance(of, Local) and isinstance(of.of, Made):
            raise NotFollowed("an entry of a function; call it")
        return super().entry(of, places, first)

    def parts(self, value: Value) -> list[Value] | None:
        """The entries of a list or a vector; a solution's, in the order of what it was solved for."""
        if isinstance(value, Record) and "solution" in value.fields:
            return super().parts(value.fields["solution"])
        if isinstance(value, Array) and value.shape == (1, 1):
            return list(value.entries)
        if isinstance(value, Array) and len(value.shape) == 2 and value.shape[1] == 1:
            return list(value.entries)
        return super().parts(value)

    def elements(self, value: Value) -> list[Value]:
        """What a loop goes over."""
        found = self.parts(value)
        return found if found is not None else [number(k) for k in reach(value)]

    def each(self, node: nodes.Each, scope: Scope) -> Value:
        """[L.diff(q) for q in qs]"""
        made: list[Value] = []
        for one in self.elements(self.value(node.over, scope)):
            inner = Scope(scope, bound(node.name, one, self))
            if all(self.holds(test, inner) for test in node.tests):
                made.append(self.value(node.value, inner))
        return from_items(made) if made else Several([])

    def block(self, rows: tuple[tuple[nodes.Node, ...], ...], scope: Scope) -> Value:
        """[eq1; eq2] of equations."""
        if any(rows):
            values = [self.value(x, scope) for row in rows for x in row]
            if any(is_equation(v) for v in values):
                return Several(values)
        return super().block(rows, scope)


def bound(name: str, value: Value, expressions: ScriptExpressions) -> dict[str, Value]:
    """The names of a loop, one or several in a tuple."""
    names = name.split(",")
    if len(names) == 1:
        return {name: value}
    parts = expressions.parts(value)
    if parts is None or len(parts) != len(names):
        raise NotFollowed("a loop over several names at once; write it out")
    return dict(zip(names, parts, strict=True))


class ScriptFollower(Follower):
    """``algebra``: what is a function of time, and what has been solved."""

    def __init__(self, known: Known, statements: Iterable[nodes.Statement], *, matlab: bool, prefix: str) -> None:
        super().__init__(known, statements, matlab=matlab, prefix=prefix)
        self.algebra = Algebra(self.names)
        self.expressions = ScriptExpressions(self.names, matlab=matlab, calls=self._call, free=self._free)
        self.expressions.algebra = self.algebra
        self.algebra.expressions = self.expressions
        self.calls: ScriptCalls = ScriptCalls(self.expressions, self.functions, self.followed, self.algebra)
        self.shown: list[Value] = []  # what stands alone: equations

    def followed(self, local: Local, given: list[Value], named: dict[str, Value]) -> Value:
        """What a function gives back; of one that is made of formulas, these with the values put in."""
        if isinstance(local.of, Made):
            if named:
                raise NotFollowed("a function of formulas is called with names; give the values in their order")
            return self.algebra.applied(local.of, given)
        return super().followed(local, given, named)

    def _repeat(self, statement: nodes.Repeat, scope: Scope) -> nodes.Return | None:
        try:
            assert isinstance(self.expressions, ScriptExpressions)
            each = self.expressions.elements(self.expressions.value(statement.over, scope))
        except NotFollowed as error:
            self._broken(statement.body, scope, f"{statement.line[:40]!r}: {error}")
            return None
        for value in each:
            scope.names |= bound(statement.name, value, self.expressions)
            found = self._part(statement.body, scope)
            if isinstance(found, nodes.Return):
                return found
            if isinstance(found, nodes.Leave) and not found.kind:
                self._broken(statement.body, scope, NOT_FOLLOWED.format(found.line[:40]))
            if isinstance(found, nodes.Leave) and found.kind != "continue":
                break
        return None

    def _alone(self, value: nodes.Node, line: str, scope: Scope) -> None:
        """What stands alone: names that are declared, an equation, a list that grows."""
        name = (
            value.of.name if isinstance(value, nodes.Call) and isinstance(value.of, nodes.Word | nodes.Member) else ""
        )
        if name in ("syms·", "depends"):
            assert isinstance(value, nodes.Call)
            self._declare(value, scope)
            return
        if isinstance(value, nodes.Binary) and value.sign in COMPARED:
            with suppress(NotFollowed):
                self.shown.append(self.expressions.value(value, scope))
            return
        if name in EVALUATED:
            with suppress(NotFollowed):
                self.expressions.value(value, scope)
            return
        super()._alone(value, line, scope)

    def _declare(self, call: nodes.Call, scope: Scope) -> None:
        """syms th1(t) m1; depends([th1, th2], t): what is a function of time."""
        *of, last = call.arguments
        if isinstance(call.of, nodes.Word) and call.of.name == "depends":
            of = list(call.arguments[::2])
        else:
            of = list(call.arguments)
        del last
        for one in of:
            for item in one.items if isinstance(one, nodes.Listed) else (one,):
                if isinstance(item, nodes.Word):
                    self.algebra.moves(Outside((item.name,)))

    def _grown(self, path: str, array: Array | None, places: tuple[nodes.Node, ...], scope: Scope) -> Array:
        """A list of MATLAB that begins by its first entry is a row."""
        if array is not None and array.shape == (1, 1) and len(places) == 1:
            k = self.expressions.value(places[0], scope)
            size = min(k.whole or 1, 16) if isinstance(k, Formula) else 1
            array.entries += [ZERO] * (size - 1)
            array.shape = (1, size)
        return super()._grown(path, array, places, scope)

    def _put_several(self, items: tuple[nodes.Node, ...], value: Value, line: str, scope: Scope) -> None:
        """a, b = solve(…): in the order of what is solved for."""
        assert isinstance(self.expressions, ScriptExpressions)
        if isinstance(value, Record) and "solution" in value.fields:
            value = Several(self.expressions.parts(value) or [])
        elif isinstance(value, Array) and len(items) > 1 and len(value.entries) == len(items) and value.is_vector:
            value = Several(list(value.entries))
        super()._put_several(items, value, line, scope)


__all__ = ["Broken", "ScriptExpressions", "ScriptFollower"]
