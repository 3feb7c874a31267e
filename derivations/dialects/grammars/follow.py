# ruff: noqa: E501 -- tables stand on one line; one branch for each kind
"""Follows statements of these languages: what Python's follower does, and what braces, structs and closures do besides."""

from __future__ import annotations

from collections.abc import Iterable

from ..traced import nodes
from ..traced.follow import NOT_FOLLOWED
from ..traced.known import Known
from ..traced.library import from_items
from ..traced.names import Scope, require_followed
from ..traced.values import (
    Array,
    Broken,
    Formula,
    Local,
    NotFollowed,
    Outside,
    Record,
    Several,
    Value,
    copied,
    formula,
)
from .calls import GrammarCalls
from .languages.language import Language
from .records import GrammarExpressions
from .steps import Steps
from .words import CHANGES, HARMLESS

MOST_TURNS = 400


class GrammarFollower(Steps):
    """``moved``: what is added to each name that comes from outside, a step of a simulation."""

    def __init__(self, known: Known, statements: Iterable[nodes.Statement], language: Language, prefix: str) -> None:
        super().__init__(known, statements, matlab=False, prefix=prefix)
        self.language = language
        self.names.first = language.first
        self.expressions: GrammarExpressions = GrammarExpressions(
            self.names, language, calls=self._call, free=self._free, top=self.top
        )
        self.calls: GrammarCalls = GrammarCalls(self.expressions, self.functions, self.followed, self)
        self.overloads: dict[str, list[Local]] = {}
        for one in self.statements:
            if isinstance(one, nodes.Define):
                self.overloads.setdefault(one.name, []).append(Local(one.parameters, one))
        self.changed: frozenset[str] = frozenset()  # what methods change
        self.moved: dict[tuple[str | int, ...], list[Value]] = {}
        self.doubts: list[str] = []
        self.inside = 0
        self.last_scope: Scope | None = None
        self.pristine: dict[str, Value] = {}

    def _free(self, name: str, scope: Scope) -> Value | None:
        """What a name stands for that nothing here gives a value; a parameter is no function of the text."""
        number = self.known.defined.get(name, "").strip()
        if number.isdigit() and len(number) < 3:
            return Formula(number)
        if any(name in s.parameters for s in scope.all):
            return None
        return super()._free(name, scope)

    # the text, and one function of it

    def run(self) -> None:
        """What the text itself says, and what it is before any of its functions has changed anything."""
        self.steps = 0
        for local in self.overloads.get("__init__", []):
            assert isinstance(local.of, nodes.Define)
            self._body(local.of.body, self._scope(local, [Outside((p,)) for p in local.parameters], {}))
        self._body(self.statements, self.top)
        self.pristine = {name: copied(value) for name, value in self.top.names.items()}

    def fresh(self) -> None:
        """As it was before the first function."""
        self.top.names.clear()
        self.top.names |= {name: copied(value) for name, value in self.pristine.items()}
        self.expressions.changed.clear()
        self.expressions.early.clear()
        self.moved.clear()
        self.doubts.clear()

    def of_function(self, local: Local) -> tuple[Scope, Value | None, nodes.Return | None]:
        """The names of a function at its end, and what it gives back."""
        self.fresh()
        self.inside += 1
        try:
            return super().of_function(local)
        finally:
            self.inside -= 1

    def followed(self, local: Local, given: list[Value], named: dict[str, Value]) -> Value:
        """What a function, or a closure with statements, gives back."""
        self.inside += 1
        self.depth += 1
        try:
            if self.depth > 12:
                raise NotFollowed("functions call each other more than twelve deep; write out what they come to")
            scope = self._scope(local, given, named)
            self.last_scope = scope
            if isinstance(local.of, nodes.Nameless) and not local.of.body:
                return self.expressions.value(local.of.value, scope)
            body = local.of.body if isinstance(local.of, nodes.Nameless | nodes.Define) else ()
            found = self._body(body, scope)
            require_followed(local.parameters, given, scope)
            self.last_scope = scope
            if isinstance(scope.names.get("return"), Broken):
                self.expressions.word("return", scope)
            if found is not None and found.value is not None:
                value = self._value_of(found, scope) or Several([])
                self.last_scope = scope
                return value
            outs = [self._out(scope, n) for n in local.of.outs] if isinstance(local.of, nodes.Define) else []
            return Several(outs) if len(outs) != 1 else outs[0]
        finally:
            self.inside -= 1
            self.depth -= 1

    def _scope(self, local: Local, given: list[Value], named: dict[str, Value]) -> Scope:
        scope = super()._scope(local, given, named)
        if isinstance(local.around, Scope):
            scope.around = local.around
        if isinstance(local.of, nodes.Define):
            scope.shared = frozenset(local.of.shared)
        return scope

    def _define(self, statement: nodes.Define, scope: Scope) -> None:
        """A function within another one sees the names around it, as they are when it is called."""
        if scope is self.top:
            return
        scope.names[statement.name] = Local(statement.parameters, statement, {}, scope)

    # statements

    def _one(self, statement: nodes.Statement, scope: Scope) -> nodes.Return | nodes.Leave | None:
        if isinstance(statement, nodes.Loop):
            return self._loop(statement, scope)
        return super()._one(statement, scope)

    def _loop(self, statement: nodes.Loop, scope: Scope) -> nodes.Return | None:
        for _ in range(MOST_TURNS):
            try:
                if not self.expressions.holds(statement.test, scope):
                    return None
            except NotFollowed as error:
                self._broken((*statement.body, *statement.after), scope, f"{statement.line[:40]!r}: {error}")
                return None
            found = self._part(statement.body, scope)
            if isinstance(found, nodes.Return):
                return found
            if isinstance(found, nodes.Leave) and not found.kind:
                self._broken(statement.body, scope, NOT_FOLLOWED.format(found.line[:40]))
                return None
            if isinstance(found, nodes.Leave) and found.kind == "break":
                return None
            self._part(statement.after, scope)
        raise NotFollowed(f"{statement.line[:40]!r}: more than {MOST_TURNS} turns; write out what the loop comes to")

    def _repeat(self, statement: nodes.Repeat, scope: Scope) -> nodes.Return | None:
        """A loop over numbers, or over what a list has."""
        try:
            each = self.expressions.elements(self.expressions.value(statement.over, scope))
        except NotFollowed as error:
            self._broken(statement.body, scope, f"{statement.line[:40]!r}: {error}")
            return None
        for value in each:
            scope.names[statement.name] = value
            found = self._part(statement.body, scope)
            if isinstance(found, nodes.Return):
                return found
            if isinstance(found, nodes.Leave) and not found.kind:
                self._broken(statement.body, scope, NOT_FOLLOWED.format(found.line[:40]))
            if isinstance(found, nodes.Leave) and found.kind != "continue":
                break
        return None

    def _broken(self, body: Iterable[nodes.Statement], scope: Scope, why: str) -> None:
        for statement in body:
            if isinstance(statement, nodes.Loop):
                self._broken((*statement.body, *statement.after), scope, why)
            elif isinstance(statement, nodes.Do):
                self._touched(statement.value, scope, statement.line) if isinstance(
                    statement.value, nodes.Call
                ) else None
            elif isinstance(statement, nodes.Assign) and statement.outer:
                for name in nodes.set_by(statement.target):
                    self._holder(name, scope).names[name] = Broken(why)
            else:
                super()._broken([statement], scope, why)

    def _set(self, name: str, value: Value, scope: Scope) -> None:
        """What a name stands for, where it was set last."""
        if name in ("return", "continue"):
            scope.names[name] = value
            return
        bare = name.removeprefix("self.")
        if bare != name and "." not in bare:
            self.top.names[bare] = value
        elif "." in name:
            of, _, last = name.rpartition(".")
            found = scope.find(of)
            if isinstance(found, Record):
                found.fields[last] = value
            else:
                self.expressions.changed[(*of.split("."), last)] = value
        elif name not in scope.names and name not in scope.parameters and self.language.declares:
            self._holder(name, scope).names[name] = value
        else:
            scope.names[name] = value

    def _unknown(self, name: str, why: str) -> Value:
        """A drive that a condition changes is not known."""
        return Broken(why)

    def _assign(self, statement: nodes.Assign, scope: Scope) -> None:
        target = self._plain(statement.target, scope)
        if self._is_start(target, scope):
            return
        if self._steps_of(statement, target, scope):
            return
        where = scope
        is_own = isinstance(target, nodes.Word) and isinstance(statement.target, nodes.Member)  # this.x
        if isinstance(target, nodes.At) and target.places == (nodes.Span(),) and isinstance(target.of, nodes.Word):
            target = target.of  # du[:] = …
        name = target.name if isinstance(target, nodes.Word) else ""
        if name and (statement.outer or is_own):
            where = self._holder(name, scope)
        value = self.expressions.value(statement.value, scope)
        if statement.sign:
            value = self.expressions.combined(statement.sign, self.expressions.value(target, scope), value)
            if isinstance(target, nodes.Word):
                self._put_name(name, value, statement.line, where, in_place=isinstance(value, Array))
                return
        self._put_at(target, value, statement.line, scope, where)

    def _put_name(self, name: str, value: Value, line: str, scope: Scope, *, in_place: bool) -> None:
        """A name gets a value; in Fortran an array that is there is filled."""
        held = scope.find(name) if self.language.fills else None
        if isinstance(held, Array):
            self._fill(held, list(range(len(held.entries))), held.shape, value, line)
            return
        super()._put_name(name, value, line, scope, in_place=in_place)

    def _is_start(self, target: nodes.Node, scope: Scope) -> bool:
        """Where a motion starts from: a coordinate or a rate that gets a value outside the equations."""
        name = target.name if isinstance(target, nodes.Word) else ""
        outside = not self.inside and bool(self.functions)
        return outside and bool(name) and (
            name in self.changed
            or self.known.coordinate(name) is not None
            or any(self.known.of_rate(name, order) is not None for order in (1, 2))
        )  # fmt: skip

    # what stands alone

    def _alone(self, value: nodes.Node, line: str, scope: Scope) -> None:
        if not isinstance(value, nodes.Call):
            return
        of = value.of
        name = of.name if isinstance(of, nodes.Word | nodes.Member) else ""
        if name == "poured·":
            self._poured(value, line, scope)
            return
        if isinstance(of, nodes.Member) and name in ("push", "push_back", "append"):
            self._grow(nodes.Call(nodes.Member(of.of, "append"), value.arguments), "append", scope)
            return
        if (
            isinstance(of, nodes.Member)
            and name in ("setZero", "setConstant", "fill", "zero")
            and (len(value.arguments) == 0 or value.arguments[0] in (nodes.Number("0"), nodes.Number("0.0")))
        ):
            held = self.expressions.value(of.of, scope)
            if isinstance(held, Array):
                held.entries[:] = [Formula("0")] * len(held.entries)
                return
        known = name in self.functions or isinstance(scope.find(name), Local) or name == "forEach"
        if known:
            try:
                self.expressions.value(value, scope)
            except NotFollowed as error:
                self._touched(value, scope, line)
                self.doubts.append(str(error))
            return
        if HARMLESS.fullmatch(name):
            return
        if CHANGES.search(name) and self.inside:
            self.doubts.append(f"{line[:40]!r}: what this changes is not known; write it as assignments")
        self._touched(value, scope, line)

    def _touched(self, call: nodes.Call, scope: Scope, line: str) -> None:
        """What a call may have changed: arrays, structs, and what is no single number from outside."""
        super()._touched(call, scope, line)
        for node in call.arguments:
            if isinstance(node, nodes.Unary) and node.sign == "&" and isinstance(node.of, nodes.Word):
                self._set(
                    node.of.name,
                    Broken(f"{line[:40]!r}: what this changes is not known; write it as an assignment"),
                    scope,
                )
            found = scope.find(node.name) if isinstance(node, nodes.Word) else None
            if isinstance(node, nodes.Word) and isinstance(found, Record):
                self._set(
                    node.name,
                    Broken(f"{line[:40]!r}: what this changes is not known; write it as an assignment"),
                    scope,
                )

    def _poured(self, call: nodes.Call, line: str, scope: Scope) -> None:
        """M << a, b, c, d."""
        target = self._plain(call.arguments[0], scope)
        values = [self.expressions.value(a, scope) for a in call.arguments[1:]]
        flat = [e for v in values for e in (v.entries if isinstance(v, Array) else [formula(v)])]
        held = self._before(target, scope)
        if isinstance(held, Array) and len(held.entries) == len(flat):
            held.entries[:] = [self.names.line(e, line) for e in flat]
            return
        if isinstance(held, Array):
            raise NotFollowed(f"{line[:40]!r}: {len(flat)} values for {len(held.entries)} entries")
        if isinstance(target, nodes.Word):
            scope.names[target.name] = from_items([self.names.line(e, line) for e in flat])
