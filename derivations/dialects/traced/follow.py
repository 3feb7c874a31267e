"""A program's statements, one after another: what each name stands for in the end. Nothing is run."""

from __future__ import annotations

from collections.abc import Iterable

from . import nodes
from .arrays import grow
from .calls import Calls
from .expressions import Expressions, chosen_of
from .known import Known
from .library import empty as library_empty
from .library import filling, from_items, reach
from .names import Names, Scope, require_followed
from .nodes import dotted, set_by
from .values import Array, Broken, Formula, Local, NotFollowed, Outside, Several, Value, copied, outside_of

MOST_STEPS, DEEPEST, MOST_TURNS, GIVEN_BACK = 3000, 12, 100, "return"
NOT_FOLLOWED = "'{}': assignments and one return are followed; write out what a loop or condition comes to"
HARMLESS = frozenset((
    "print", "disp", "fprintf", "printf", "plot", "show", "figure", "title", "xlabel", "ylabel", "legend", "grid",
    "subplot", "savefig", "isinstance",
))  # fmt: skip


class Follower:
    """Follows a text. ``top``: the names of the text itself; ``functions``: those that it defines."""

    def __init__(self, known: Known, statements: Iterable[nodes.Statement], *, matlab: bool, prefix: str) -> None:
        self.known = known
        self.statements = tuple(statements)
        self.names = Names(known, prefix)
        self.functions: dict[str, Local] = {}
        self.expressions = Expressions(self.names, matlab=matlab, calls=self._call, free=self._free)
        self.calls = Calls(self.expressions, self.functions, self.followed)
        self.top = Scope()
        self.steps = self.depth = 0
        self.equations: list[tuple[Value, Value, str]] = []
        self.called: set[str] = set()
        self.looked: set[str] = set()
        for one in self.statements:
            if isinstance(one, nodes.Define):
                self.functions.setdefault(one.name, Local(one.parameters, one))

    def _call(self, node: nodes.Call, scope: Scope) -> Value:
        path = dotted(node.of)
        if path:
            self.called.add(path.split(".")[-1])
        return self.calls.call(node, scope)

    def _free(self, name: str, scope: Scope) -> Value | None:
        """What a name stands for that nothing in the text gives a value: the file's own, or what a function gives."""
        if name in self.functions:
            return self.functions[name]
        if any(name in s.parameters for s in scope.all) and name not in self.known.defined:
            return None
        text = self.known.defined.get(name)
        if text is not None and name not in self.looked:
            return self._defined(name, text)
        if scope is self.top and name not in self.looked and not self.known.is_quantity(name):
            return self._given_by_a_function(name)
        return None

    def _defined(self, name: str, text: str) -> Value | None:
        """[define] D = '[a, b; b, c]': only matrices are taken apart here."""
        if "[" not in text or "\\" in text:
            return None
        from .matlab import matlab_tree
        from .python import python_tree

        self.looked.add(name)
        for read in (python_tree, matlab_tree):
            tree = read(f"{name} = {text}")
            if tree and len(tree) == 1 and isinstance(tree[0], nodes.Assign):
                value = self.expressions.value(tree[0].value, Scope())
                if isinstance(value, Array) and value.is_vector:
                    value = Array(value.entries, (len(value.entries),), "loose")
                self.top.names[name] = value
                return value
        return None

    def _given_by_a_function(self, name: str) -> Value | None:
        """M of function [M, C, G] = f(q, dq), which the text has but does not call."""
        for local in self.functions.values():
            define = local.of
            if isinstance(define, nodes.Define) and name in define.outs and define.name not in self.called:
                self.looked.add(name)
                scope = self._scope(local, [Outside((p,)) for p in local.parameters], {})
                self._body(define.body, scope)
                for out in define.outs:
                    if out in scope.names:
                        self.top.names.setdefault(out, scope.names[out])
                return self.top.names.get(name)
        return None

    def run(self) -> None:
        """Follow the text's own statements; what fails is refused where it is needed."""
        self._start()
        self._body(self.statements, self.top)

    def _start(self) -> None:
        """What __init__ says of self."""
        local = self.functions.get("__init__")
        if local is not None and isinstance(local.of, nodes.Define):
            scope = self._scope(local, [Outside((p,)) for p in local.parameters], {})
            self._body(local.of.body, scope)

    def of_function(self, local: Local) -> tuple[Scope, Value | None, nodes.Return | None]:
        """The names of a function at its end, and what it gives back; its parameters come from outside."""
        define = local.of
        assert isinstance(define, nodes.Define)
        scope = self._scope(local, [Outside((p,)) for p in local.parameters], {})
        found = self._body(define.body, scope)
        if found is None:
            return scope, None, None
        try:
            return scope, self._value_of(found, scope), found
        except NotFollowed as error:
            return scope, Broken(str(error)), found

    def _value_of(self, found: nodes.Return, scope: Scope) -> Value | None:
        return None if found.value is None else self.expressions.value(found.value, scope)

    def followed(self, local: Local, given: list[Value], named: dict[str, Value]) -> Value:
        """What a function of the text gives back for these arguments."""
        if self.depth >= DEEPEST:
            raise NotFollowed("functions call each other more than twelve deep; write out what they come to")
        self.depth += 1
        try:
            scope = self._scope(local, given, named)
            if isinstance(local.of, nodes.Nameless):
                return self.expressions.value(local.of.value, scope)
            assert isinstance(local.of, nodes.Define)
            found = self._body(local.of.body, scope)
            require_followed(local.parameters, given, scope)
            if isinstance(scope.names.get(GIVEN_BACK), Broken):
                self.expressions.word(GIVEN_BACK, scope)  # refused: what is given back, a condition decides
            if found is not None and found.value is not None:
                return self._value_of(found, scope) or Several([])
            outs = [self._out(scope, name) for name in local.of.outs]
            return Several(outs) if len(outs) != 1 else outs[0]
        finally:
            self.depth -= 1

    def _out(self, scope: Scope, name: str) -> Value:
        return scope.names.get(name, Broken(f"{name} is given back, and has no value"))

    def _scope(self, local: Local, given: list[Value], named: dict[str, Value]) -> Scope:
        scope = Scope(self.top, parameters=frozenset(local.parameters))
        scope.names |= local.given
        for name, value in zip(local.parameters, given, strict=False):
            if not (isinstance(value, Outside) and value.path == (name,)):
                scope.names[name] = (
                    self.names.kept(name, value, f"{name} of a function") if isinstance(value, Outside) else value
                )
        scope.names |= named
        return scope

    def _body(self, body: Iterable[nodes.Statement], scope: Scope) -> nodes.Return | None:
        """Follow a function's statements, up to what it returns."""
        found = self._part(body, scope)
        return found if isinstance(found, nodes.Return) else None

    def _part(self, body: Iterable[nodes.Statement], scope: Scope) -> nodes.Return | nodes.Leave | None:
        for statement in body:
            self.steps += 1
            if self.steps > MOST_STEPS:
                raise NotFollowed(f"more than {MOST_STEPS} statements; give the function with the equations alone")
            if isinstance(statement, nodes.Return | nodes.Leave):
                return statement
            if isinstance(statement, nodes.Define):
                self._define(statement, scope)
                continue
            if (found := self._one(statement, scope)) is not None:
                return found
        return None

    def _define(self, statement: nodes.Define, scope: Scope) -> None:
        """A function within another one."""
        if scope is not self.top:
            scope.names[statement.name] = Local(statement.parameters, statement, dict(scope.names))
            self.functions.setdefault(statement.name, Local(statement.parameters, statement, scope.names))

    def _one(self, statement: nodes.Statement, scope: Scope) -> nodes.Return | nodes.Leave | None:
        if isinstance(statement, nodes.Repeat):
            return self._repeat(statement, scope)
        if isinstance(statement, nodes.Choice):
            return None if nodes.is_guard(statement) else self._choice(statement, scope)
        self._statement(statement, scope)
        return None

    def _choice(self, statement: nodes.Choice, scope: Scope) -> nodes.Return | nodes.Leave | None:
        """The body that a test of whole numbers chooses; what either changes is not known where it chooses neither."""
        try:
            body = statement.body if self.expressions.holds(statement.test, scope) else statement.otherwise
        except NotFollowed:
            self._unfollowed(nodes.Unfollowed(statement.line, statement.names), scope)
            return nodes.Leave("", statement.line) if "continue" in statement.names else None
        return self._part(body, scope)

    def _repeat(self, statement: nodes.Repeat, scope: Scope) -> nodes.Return | None:
        try:
            if "," in statement.name:
                raise NotFollowed("a loop over several names at once; write it out")
            value = self.expressions.value(statement.over, scope)
            numbers: list[Value] = [Formula(str(k)) for k in reach(value)]
            if len(numbers) > MOST_TURNS:
                raise NotFollowed(f"a loop of more than {MOST_TURNS} turns; write out what it comes to")
        except NotFollowed as error:
            self._broken(statement.body, scope, f"{statement.line[:40]!r}: {error}")
            return None
        for k in numbers:
            scope.names[statement.name] = k
            found = self._part(statement.body, scope)
            if isinstance(found, nodes.Return):
                return found
            if isinstance(found, nodes.Leave) and not found.kind:
                self._broken(statement.body, scope, NOT_FOLLOWED.format(found.line[:40]))
            if isinstance(found, nodes.Leave) and found.kind != "continue":
                break
        return None

    def _broken(self, body: Iterable[nodes.Statement], scope: Scope, why: str) -> None:
        """Every name that a part sets is not known behind it."""
        for statement in body:
            if isinstance(statement, nodes.Assign):
                for name in set_by(statement.target):
                    self._set(name, Broken(why), scope)
            elif isinstance(statement, nodes.Repeat):
                self._broken(statement.body, scope, why)
            elif isinstance(statement, nodes.Choice):
                self._broken((*statement.body, *statement.otherwise), scope, why)
            elif isinstance(statement, nodes.Unfollowed):
                self._unfollowed(statement, scope)
            elif isinstance(statement, nodes.Return):
                scope.names[GIVEN_BACK] = Broken(why)

    def _unfollowed(self, statement: nodes.Unfollowed, scope: Scope) -> None:
        why = NOT_FOLLOWED.format(statement.line[:40])
        for name in statement.names:
            self._set(name, self._unknown(name, why), scope)

    def _unknown(self, name: str, why: str) -> Value:
        """A drive is what it is for the body that it drives, whatever the program makes of it."""
        return Outside((name,)) if name in self.known.drives else Broken(why)

    def _set(self, name: str, value: Value, scope: Scope) -> None:
        if "." in name:
            self.expressions.members[name] = value
        else:
            scope.names[name] = value

    def _statement(self, statement: nodes.Statement, scope: Scope) -> None:
        match statement:
            case nodes.Unfollowed():
                self._unfollowed(statement, scope)
            case nodes.Do(value=value, line=line):
                self._alone(value, line, scope)
            case nodes.Assign(target=target, line=line):
                try:
                    self._assign(statement, scope)
                except NotFollowed as error:
                    why = str(error) if str(error).startswith("'") else f"{line[:50]!r}: {error}"
                    for name in set_by(target):
                        self._set(name, self._unknown(name, why), scope)

    def _alone(self, value: nodes.Node, line: str, scope: Scope) -> None:
        """An expression that stands alone: an equation, a list that grows, or nothing."""
        if isinstance(value, nodes.Binary) and value.sign == "==":
            try:
                left, right = self.expressions.value(value.left, scope), self.expressions.value(value.right, scope)
                self.equations.append((left, right, line))
            except NotFollowed:
                pass
            return
        if not isinstance(value, nodes.Call):
            return
        path = dotted(value.of) or ""
        name = path.split(".")[-1]
        if name == "__init__":
            return  # of the class that this one is made of: the text's own is followed at its start
        if isinstance(value.of, nodes.Member) and name in ("append", "extend"):
            self._grow(value, name, scope)
        elif name in self.functions:
            try:
                self.expressions.value(value, scope)
            except NotFollowed:
                self._touched(value, scope, line)
        elif name not in HARMLESS:
            self._touched(value, scope, line)

    def _touched(self, call: nodes.Call, scope: Scope, line: str) -> None:
        """What a call may have changed is not known behind it."""
        for node in (*call.arguments, *((call.of.of,) if isinstance(call.of, nodes.Member) else ())):
            name = node.name if isinstance(node, nodes.Word) else None
            if name and isinstance(scope.names.get(name), Array | Several):
                scope.names[name] = Broken(f"{line[:40]!r}: what this changes is not known; write it as an assignment")

    def _grow(self, call: nodes.Call, name: str, scope: Scope) -> None:
        assert isinstance(call.of, nodes.Member)
        path = dotted(call.of.of) or ""
        found = scope.find(path)
        parts = self.expressions.parts(found) if found is not None else None
        if parts is None or not call.arguments:
            return
        new = self.expressions.value(call.arguments[0], scope)
        more = (self.expressions.parts(new) or []) if name == "extend" else [new]
        scope.names[path] = from_items([*parts, *more])

    def _assign(self, statement: nodes.Assign, scope: Scope) -> None:
        target, line = statement.target, statement.line
        value = self.expressions.value(statement.value, scope)
        if statement.sign:
            value = self.expressions.combined(statement.sign, self.expressions.value(target, scope), value)
            self._put(target, value, line, scope, in_place=True)
            return
        self._put(target, value, line, scope)

    def _put(self, target: nodes.Node, value: Value, line: str, scope: Scope, *, in_place: bool = False) -> None:
        match target:
            case nodes.Word(name=name):
                self._put_name(name, value, line, scope, in_place=in_place)
            case nodes.Member():
                path = dotted(target)
                if path is None:
                    raise NotFollowed("a field of something that is no name; give it a name")
                self.expressions.members[path] = self.names.kept(target.name, value, line)
            case nodes.Listed(items=items):
                self._put_several(items, value, line, scope)
            case nodes.At(of=of, places=places):
                self._put_entry(of, places, value, line, scope, first=0)
            case nodes.Call(of=of, arguments=places):
                self._put_entry(of, places, value, line, scope, first=1)
            case nodes.Unary(sign="*"):
                raise NotFollowed("*rest = …: give each value a name of its own")
            case _:
                raise NotFollowed("a name is needed on the left of an assignment")

    def _put_name(self, name: str, value: Value, line: str, scope: Scope, *, in_place: bool) -> None:
        if isinstance(value, Array) and isinstance(value.kind, str) and not in_place:
            is_entry = any(value is other for other in scope.names.values())
            if not is_entry or self.expressions.matlab:
                value = value.copied()
        if in_place and isinstance(value, Array):
            before = scope.find(name)
            if isinstance(before, Array) and not self.expressions.matlab:  # whoever else holds it sees the change
                before.entries[:] = [self.names.line(e, line) for e in value.entries]
                return
        self._note(name, value, line)
        scope.names[name] = self.names.kept(name, value, line)

    def _note(self, name: str, value: Value, line: str) -> None:
        """tau = M*ddq + C: an equation, where the left side is a drive or a vector of drives."""
        if isinstance(value, Array | Formula) and (name in self.known.defined or name.strip("_") in self.known.drives):
            self.equations.append((self._said_outside(name), copied(value), line))

    def _said_outside(self, name: str) -> Value:
        found = self._defined(name, self.known.defined[name]) if name in self.known.defined else None
        return Outside((name,)) if found is None else copied(found)

    def _put_several(self, items: tuple[nodes.Node, ...], value: Value, line: str, scope: Scope) -> None:
        count = len(items)
        value = outside_of(value)
        if isinstance(value, Outside):
            declared = [isinstance(i, nodes.Word) and self.known.is_quantity(i.name) for i in items]
            parts: list[Value] = [Outside((*value.path, k)) for k in range(count)]
            if all(declared) and not any(
                isinstance(i, nodes.Word) and self.known.coordinate(i.name) is not None for i in items
            ):
                parts = [Outside((i.name,)) for i in items if isinstance(i, nodes.Word)]
        else:
            found: list[Value] | None = self.expressions.parts(value)
            if found is None and self.expressions.matlab and count == 1:
                found = [value]
            parts = list(found) if found is not None else []
            if len(parts) > count and self.expressions.matlab and isinstance(value, Several):
                parts = parts[:count]
            if self.expressions.matlab and isinstance(value, Array):
                parts = [value]
        if len(parts) != count:
            raise NotFollowed(f"{count} names, and not as many values behind the equals sign")
        whole = nodes.all_entries(items, self.expressions.size)
        if whole in scope.parameters:  # y[0], y[1] = y[1], -y[0]; return y
            items, parts = (nodes.Word(whole),), [from_items(parts)]
        for item, part in zip(items, parts, strict=True):
            self._put(item, part, line, scope)

    def _put_entry(
        self, of: nodes.Node, places: tuple[nodes.Node, ...], value: Value, line: str, scope: Scope, *, first: int
    ) -> None:
        path = dotted(of)
        if path is None and isinstance(of, nodes.At) and not first:  # M[0][1] = …
            path, places = dotted(of.of), (*of.places, *places)
        if path is None:
            raise NotFollowed("entries of something that has no name")
        array = self.expressions.members.get(path) if "." in path else scope.find(path)
        if isinstance(array, Broken):
            raise NotFollowed(array.why)
        if isinstance(array, Several):
            array = self._list_entry(array, places, value, scope, path, first)
            if array is None:
                return
        is_new = path in scope.parameters and (path,) not in self.expressions.entered
        if array is None and is_new and not first:  # out[0] = … of a parameter that is filled
            array = library_empty("zeros", (self.expressions.size,))
            array.is_state = True
            scope.names[path] = array
        if array is None and first and (is_new or path not in scope.parameters):
            array = self._grown(path, None, places, scope)
        if isinstance(array, Array) and first:
            array = self._grown(path, array, places, scope)
        if array is None or isinstance(array, Outside):
            raise NotFollowed(
                f"{path}: an entry of what comes from outside is changed; give each value a name of its own"
            )
        if not isinstance(array, Array):
            raise NotFollowed(f"{path}: entries of something that is no array")
        chosen, shape = chosen_of(array, [self.expressions.value(p, scope) for p in places], first)
        self._fill(array, chosen, shape, value, line)

    def _list_entry(
        self, found: Several, places: tuple[nodes.Node, ...], value: Value, scope: Scope, path: str, first: int
    ) -> Array | None:
        """An entry of a list of lists; a list without values that MATLAB fills."""
        if not found.items:
            return self._grown(path, None, places, scope) if first else None
        k = self.expressions.value(places[0], scope)
        index = k.whole if isinstance(k, Formula) else None
        if index is None or not 0 <= index - first < len(found.items) or len(places) != 1:
            raise NotFollowed(f"{path}: entries of a list of several things; write it out")
        found.items[index - first] = value
        return None

    def _grown(self, path: str, array: Array | None, places: tuple[nodes.Node, ...], scope: Scope) -> Array:
        """MATLAB makes an array as large as what is put there."""
        values = [self.expressions.value(p, scope) for p in places]
        wanted = [v.whole if isinstance(v, Formula) else None for v in values]
        if array is None:
            sizes = [1 if w is None else w for w in wanted]
            shape = (sizes[0], 1) if len(sizes) == 1 else (sizes[0], sizes[1])
            scope.names[path] = array = Array([Formula("0")] * (shape[0] * shape[1]), shape)
            return array
        if array.is_state or len(array.shape) == 1 or any(w is None for w in wanted):
            return array
        grow(array, [w or 1 for w in wanted], path)
        return array

    def _fill(self, array: Array, chosen: list[int], shape: tuple[int, ...], value: Value, line: str) -> None:
        for k, entry in zip(chosen, filling(value, len(chosen), is_part=bool(shape)), strict=True):
            array.entries[k] = self.names.line(entry, line)
