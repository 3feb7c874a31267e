"""Steps of a simulation: theta += omega*dt says what the rate is, omega += … what moves it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cached_property

from ..traced import nodes
from ..traced.lost_steps import STEP
from ..traced.names import Scope
from ..traced.values import Array, Broken, Formula, NotFollowed, Outside, Record, Value
from .places import Places

STALE = "{0} is computed from what was changed before; compute first, step then"


def assigned_in(part: object) -> Iterator[nodes.Assign]:
    """All assignments of a text, of its functions and branches too."""
    if isinstance(part, tuple | list):
        for one in part:
            yield from assigned_in(one)
    elif is_dataclass(part) and not isinstance(part, type):
        if isinstance(part, nodes.Assign):
            yield part
        for one in fields(part):
            yield from assigned_in(getattr(part, one.name))


def words_in(part: object, kind: type | tuple[type, ...] = (nodes.Word, nodes.Member)) -> Iterator[nodes.Node]:
    """All parts of one kind of an expression, the whole among them."""
    if isinstance(part, tuple | list):
        for one in part:
            yield from words_in(one, kind)
    elif is_dataclass(part) and not isinstance(part, type):
        if isinstance(part, kind):
            yield part  # type: ignore[misc]
        for one in fields(part):
            yield from words_in(getattr(part, one.name), kind)


def _entries(value: Value) -> list[Formula]:
    return value.entries if isinstance(value, Array) else [value] if isinstance(value, Formula) else []


def step_name(node: nodes.Node) -> str:
    """dt, this.dt, clock.step()"""
    if isinstance(node, nodes.Call) and not node.arguments and not node.named:
        of = nodes.dotted(node.of)
        return f"{of}()" if of else ""
    return nodes.dotted(node) or ""


class Steps(Places):
    """``moved``: what is added to each name that comes from outside."""

    moved: dict[tuple[str | int, ...], list[Value]]

    def _holder(self, name: str, scope: Scope) -> Scope:
        """The names around a function that have this one; those of the text where none has."""
        return next((s for s in scope.all[1:] if name in s.names or name in s.parameters), self.top)

    def _steps_of(self, statement: nodes.Assign, target: nodes.Node, scope: Scope) -> bool:
        """theta += omega*dt: a step of what comes from outside, kept apart; behind it the name is another thing."""
        if not self.inside or not isinstance(target, nodes.Word | nodes.Member):
            return False
        path = self._path(target, scope)
        if path is None:
            return False
        added = self._added(statement, target)
        if added is None:
            return False
        if path[-1] in ("t", "time") or self._is_wrapped(added[1], target):
            return True
        before = self._before(target, scope)
        is_stale = path in self.moved
        if not is_stale and not (isinstance(before, Outside) and self._is_state(path)):
            return False
        sign, node = added
        bare = self._per_step(node)
        source = self._path(bare, scope) if isinstance(bare, nodes.Word | nodes.Member) else None
        try:
            made: Value = Outside(source) if source in self.moved else self.expressions.value(bare, scope)
            if sign == "-":
                made = self.expressions.combined("-", Formula("0"), made)
            if isinstance(made, Formula):
                made = self.names.line(made, statement.line)
        except NotFollowed as error:
            made = Broken(str(error))
        self.moved.setdefault(path, []).append(made)
        if statement.sign not in ("+", "-", ""):
            self.doubts.append(f"{path[-1]} is changed more than once; give the equations alone")
        is_kept = self._has_step(node) and not self._is_held(path, scope)
        self._forget(target, scope, Outside(path) if is_kept else Broken(STALE.format(path[-1])))
        return True

    def _is_wrapped(self, node: nodes.Node, target: nodes.Node) -> bool:
        """theta -= floor(theta/(2π))*2π: the angle is the same."""
        return any(
            isinstance(one, nodes.Call)
            and (nodes.dotted(one.of) or "").split(".")[-1] in ("floor", "round", "trunc", "rint")
            and any(self._plain(part, self.top) == target for part in words_in(one.arguments))
            for one in words_in(node, nodes.Call)
        )

    def _has_step(self, node: nodes.Node) -> bool:
        """Whether a step of time stands in what is added: then the old value and the new one are one in the limit."""
        return any(self._is_step(one) for one in words_in(node, object))

    def _is_held(self, path: tuple[str | int, ...], scope: Scope) -> bool:
        """Whether another name has the old value, x_old = x: the new one is another thing then."""
        mark = Outside(path).mark
        held = [value for one in scope.all for value in one.names.values()]
        return any(value == Outside(path) or mark in (e.text for e in _entries(value)) for value in held)

    def _path(self, node: nodes.Node, scope: Scope) -> tuple[str | int, ...] | None:
        """Where a quantity from outside stands."""
        node = self._plain(node, scope)
        if isinstance(node, nodes.Word):
            found = scope.find(node.name)
            if isinstance(found, Outside):
                return found.path
            return (node.name,) if found is None or (node.name,) in self.moved else None
        if isinstance(node, nodes.Member):
            try:
                of = self.expressions.value(node.of, scope)
            except NotFollowed:
                return None
            if isinstance(of, Record) and isinstance(node.of, nodes.Word) and self.top.names.get(node.of.name) is of:
                return (node.of.name, node.name)  # of a thing that the class has
            return (*of.path, node.name) if isinstance(of, Outside) else None
        return None

    def _is_state(self, path: tuple[str | int, ...]) -> bool:
        last = str(path[-1])
        return (
            not (self.known.is_quantity(last) and self.known.coordinate(last) is None) and last not in self.known.drives
        )

    def _added(self, statement: nodes.Assign, target: nodes.Node) -> tuple[str, nodes.Node] | None:
        if statement.sign:
            return statement.sign, statement.value
        match statement.value:
            case nodes.Binary(sign="+" | "-" as sign, left=left, right=right) if self._plain(left, self.top) == target:
                return sign, right
            case nodes.Binary(sign="+", left=left, right=right) if self._plain(right, self.top) == target:
                return "+", left
        return None

    def _before(self, target: nodes.Node, scope: Scope) -> Value | None:
        if isinstance(target, nodes.Word):
            found = scope.find(target.name)
            return Outside((target.name,)) if found is None else found
        try:
            return self.expressions.value(target, scope)
        except NotFollowed as error:
            return Broken(str(error))

    def _forget(self, target: nodes.Node, scope: Scope, value: Value) -> None:
        if isinstance(target, nodes.Word):
            holder = (
                scope
                if target.name in scope.names or target.name in scope.parameters
                else self._holder(target.name, scope)
            )
            holder.names[target.name] = value
            return
        of = self.expressions.value(target.of, scope) if isinstance(target, nodes.Member) else None
        if isinstance(of, Outside) and isinstance(target, nodes.Member):
            self.expressions.changed[(*of.path, target.name)] = value
        elif isinstance(of, Record) and isinstance(target, nodes.Member):
            of.fields[target.name] = value

    @cached_property
    def _own_steps(self) -> set[str]:
        """Other names of the step: H where x += v*H and v += a*H are there, and nothing sets H from there on."""
        factors: dict[str, set[str]] = {}
        set_later: set[str] = set()
        for one in assigned_in(self.statements):
            target = nodes.dotted(one.target) or ""
            added = self._added(one, one.target) if target else None
            if added is not None and isinstance(added[1], nodes.Binary) and added[1].sign == "*":
                factors[target] = {step_name(added[1].left), step_name(added[1].right)}
            if factors:
                set_later |= set(nodes.set_by(one.target))
        found = {
            step for two in factors.values() for rate in two & factors.keys() for step in (two - {rate}) & factors[rate]
        }
        return {step for step in found - set_later if step and not self._is_declared(step)}

    def _is_declared(self, name: str) -> bool:
        """Whether a name, or a field's, is a quantity of the mechanism."""
        last = name.rpartition(".")[2]
        return self.known.is_quantity(last) or last in self.known.drives or self.known.of_rate(last, 1) is not None

    def _is_step(self, node: nodes.Node) -> bool:
        name = step_name(node)
        last = name.rpartition(".")[2]  # env.conf.h
        is_named = STEP.fullmatch(name) is not None or STEP.fullmatch(last) is not None
        return (is_named and not self.known.is_quantity(last)) or name in self._own_steps

    def _per_step(self, node: nodes.Node) -> nodes.Node:
        """omega of omega*dt. Raises NotFollowed for a sum, of which not every part may have the step."""
        match node:
            case nodes.Binary(sign="*", left=left, right=right):
                if self._is_step(right):
                    return left
                if self._is_step(left):
                    return right
            case nodes.Unary(sign="-", of=of):
                return nodes.Unary("-", self._per_step(of))
        return node
