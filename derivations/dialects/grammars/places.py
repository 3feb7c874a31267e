"""Where assignments put values: names, fields, entries of arrays, and entries of what comes from outside."""

from __future__ import annotations

from ..traced import nodes
from ..traced.expressions import chosen_of
from ..traced.follow import Follower
from ..traced.names import MARK, Scope
from ..traced.values import Array, Formula, NotFollowed, Outside, Reach, Record, Several, Value, formula
from .languages.language import Language
from .records import GrammarExpressions


class Places(Follower):
    """``inside``: how many functions are around; ``doubts``: why what a function says is not certain."""

    language: Language
    expressions: GrammarExpressions
    inside: int
    doubts: list[str]

    def _plain(self, target: nodes.Node, scope: Scope) -> nodes.Node:
        """self.x as x, where no parameter or local name is called so."""
        match target:
            case nodes.Member(of=nodes.Word(name="self"), name=name):
                return nodes.Word(name)
            case nodes.At(of=of, places=places):
                inner = self._plain(of, scope)
                if (
                    inner is not of
                    and isinstance(inner, nodes.Word)
                    and scope is not self.top
                    and (inner.name in scope.names or inner.name in scope.parameters)
                ):
                    raise NotFollowed(f"{inner.name} is two things here; give each a name of its own")
                return nodes.At(inner, places)
        return target

    def _put_at(self, target: nodes.Node, value: Value, line: str, scope: Scope, where: Scope) -> None:
        match target:
            case nodes.Word(name=name):
                self._put_name(name, value, line, where, in_place=False)
            case nodes.Member(of=of, name=name):
                self._put_field(of, name, value, line, scope)
            case nodes.Listed(items=items) if isinstance(value, Record) and len(items) == len(value.fields):
                for item, part in zip(items, list(value.fields.values()), strict=True):
                    self._put_at(item, part, line, scope, where)
            case nodes.At(of=of, places=places) if not isinstance(of, nodes.Word):
                self._put_within(of, places, value, line, scope)
            case nodes.At(of=nodes.Word(name=name), places=places):
                self._put_place(name, places, value, line, scope)
            case _:
                self._put(target, value, line, scope)

    def _put(self, target: nodes.Node, value: Value, line: str, scope: Scope, *, in_place: bool = False) -> None:
        if isinstance(target, nodes.Listed | nodes.Word) or in_place:
            super()._put(target, value, line, scope, in_place=in_place)
        else:
            self._put_at(target, value, line, scope, scope)

    def _put_name(self, name: str, value: Value, line: str, scope: Scope, *, in_place: bool) -> None:
        if name == "_":
            return
        is_given = self.inside > 0 and name in scope.parameters and name not in scope.names
        if is_given and name in scope.shared and name in self.expressions.early:
            self.doubts.append(f"{name} is read before it is written")
        elif is_given and name in self.known.drives and not self.marks(value):
            self.doubts.append(f"{name} is changed; give each value a name of its own")
        if isinstance(value, Array) and self.language.copies and not in_place:
            value = value.copied()
        if isinstance(value, Record) and self.language.copies:
            value = Record(dict(value.fields), value.path)
        super()._put_name(name, value, line, scope, in_place=in_place)

    def _put_place(self, name: str, places: tuple[nodes.Node, ...], value: Value, line: str, scope: Scope) -> None:
        """A[i] = …; of a pointer to a parameter, of that; the rate of time itself at the end says nothing."""
        if name in scope.parameters and len(places) == 1 and isinstance(value, Formula) and value.whole == 1:
            at = self.expressions.value(places[0], scope)
            if isinstance(at, Formula) and at.whole == self.expressions.size:
                return
        found = scope.find(name)
        if isinstance(found, Outside) and len(found.path) == 1 and found.path[0] != name:
            name = str(found.path[0])
        holder = scope if name in scope.names or name in scope.parameters or name not in self.top.names else self.top
        found = scope.find(name)
        if isinstance(found, Several) and len(places) > 1:
            self._put_within(nodes.At(nodes.Word(name), places[:-1]), places[-1:], value, line, scope)
            return
        if isinstance(found, Outside) and found.path == (name,) and name in scope.parameters:
            scope.names.pop(name, None)
        if found is None and name not in scope.parameters:
            self._put_within(nodes.Word(name), places, value, line, scope)
            return
        if (
            isinstance(found, Several)
            and found.items
            and isinstance(value, Record | Several | Outside | Array) is False
        ):
            self._listed_place(found, places, value, scope)
            return
        if (
            name in scope.parameters
            and (found is None or found == Outside((name,)))
            and (name,) not in self.expressions.entered
        ):
            marks = [Formula(Outside((name, k)).mark) for k in range(self.expressions.size)]
            scope.names[name] = found = Array(marks, (len(marks),), is_state=True)
        fixed = tuple(self._fixed(place, scope) for place in places)
        self._put_entry(nodes.Word(name), fixed, value, line, holder if found is not None else scope, first=0)

    def _fixed(self, place: nodes.Node, scope: Scope) -> nodes.Node:
        """A place as a number, whatever the names in it are elsewhere."""
        value = self.expressions.value(place, scope)
        if isinstance(value, Reach):
            ends = [None if k is None else nodes.Number(str(k)) for k in (value.first, value.last)]
            return nodes.Span(*ends)
        k = formula(value).whole if isinstance(value, Formula) else None
        if k is None:
            raise NotFollowed("an index that is no whole number; write the number")
        return nodes.Number(str(k)) if k >= 0 else nodes.Unary("-", nodes.Number(str(-k)))

    def _listed_place(self, found: Several, places: tuple[nodes.Node, ...], value: Value, scope: Scope) -> None:
        k = formula(self.expressions.value(places[0], scope)).whole
        if k is None or not 0 <= k < len(found.items) or len(places) != 1:
            raise NotFollowed("entries of a list of several things; write it out")
        found.items[k] = value

    def _put_within(
        self, of: nodes.Node, places: tuple[nodes.Node, ...], value: Value, line: str, scope: Scope
    ) -> None:
        """Entries of a field, and of rows of a matrix."""
        while isinstance(of, nodes.At):
            places = (*of.places, *places)
            of = of.of
        if isinstance(of, nodes.Word) and scope.find(of.name) is not None:
            self._put_place(of.name, places, value, line, scope)
            return
        held = self.expressions.value(self._plain(of, scope), scope)
        if isinstance(held, Array):
            chosen, shape = chosen_of(held, [self.expressions.value(p, scope) for p in places], 0)
            self._fill(held, chosen, shape, value, line)
            return
        if isinstance(held, Several):
            self._listed_place(held, places, value, scope)
            return
        if isinstance(held, Outside):
            numbers = [formula(self.expressions.value(p, scope)).whole for p in places]
            if None in numbers:
                raise NotFollowed("an index that is no whole number; write the number")
            self.expressions.changed[(*held.path, *(k for k in numbers if k is not None))] = (
                self.names.line(value, line) if isinstance(value, Formula) else value
            )
            return
        raise NotFollowed("entries of something that is no array")

    def _put_field(self, of: nodes.Node, name: str, value: Value, line: str, scope: Scope) -> None:
        """A field of a thing: of the text's own, or of what comes from outside."""
        if isinstance(value, Formula):
            value = self.names.line(value, line)
        held = self.expressions.value(of, scope)
        if isinstance(held, Record):
            held.fields[name] = value
        elif isinstance(held, Outside):
            name_of = of.name if isinstance(of, nodes.Word) else ""
            is_copy = name_of in scope.names or (name_of in scope.parameters and name_of not in scope.shared)
            if self.language.copies and is_copy and name_of not in scope.shared:
                scope.names[name_of] = Record({name: value}, held.path)
            else:
                self.expressions.changed[(*held.path, name)] = value
        elif isinstance(held, Array) and name in "xyzw" and "xyzw".index(name) < len(held.entries):
            held.entries["xyzw".index(name)] = self.names.line(formula(value), line)
        else:
            raise NotFollowed("a field of something that has none")

    def marks(self, value: Value) -> bool:
        """Whether a value is a quantity from outside, and nothing else."""
        return isinstance(value, Outside) or (isinstance(value, Formula) and MARK.fullmatch(value.text) is not None)
