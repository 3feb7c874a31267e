# ruff: noqa: E501 -- tables stand on one line; one branch for each kind
"""Rows of equations of motion from a program whose language has a grammar."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any

from ....models.errors import InvalidInput
from ..traced import nodes
from ..traced.forms import Rows
from ..traced.known import Known
from ..traced.lost_steps import STEP
from ..traced.meaning import Meaning, Path, path_of, rendered
from ..traced.names import MARK, Scope
from ..traced.rows import TOO_DEEP, Reader, one_text, prefix_for
from ..traced.values import (
    Array,
    Broken,
    Doubtful,
    Formula,
    Local,
    NotFollowed,
    Outside,
    Record,
    Several,
    Value,
    formula,
)
from .follow import GrammarFollower
from .functions import Functions
from .languages.language import Language
from .parsed import parsed

DOWN = "g is a negative number here; give it without its sign, and the sign in the rows"
NO_FUNCTION = "no function with the equations of motion is found; give the text of the one that has them"
SEVERAL = "{} all give equations of motion; give the text of the one that is meant"


def from_grammars(data: dict[str, Any]) -> tuple[dict[str, Any], dict[str, str]] | None:
    """The fields with rows in place of a program, and the line that each definition is from; None for other texts.

    Raises InvalidInput where it is a program and cannot be taken as it is meant.
    """
    one = one_text(data)
    if one is None:
        return None
    label, text, found = one
    tree = parsed(text)
    if tree is None:
        return None
    language, root = tree
    try:
        reader = Functions(language, root)
        statements = reader.program()
        if not _is_program(statements):
            return None
        if found.is_downwards(text):
            raise NotFollowed(DOWN)
        made = GrammarReader(data, found, statements, language, prefix_for(text))
        made.follower.changed = frozenset(reader.changed)
        return made.read()
    except NotFollowed as error:
        raise InvalidInput(f"equations.{label:.40}: {error}") from None
    except RecursionError:
        raise InvalidInput(f"equations.{label:.40}: {TOO_DEEP}") from None


def _is_program(tree: Sequence[nodes.Statement]) -> bool:
    return any(isinstance(s, nodes.Define) for s in tree) or sum(isinstance(s, nodes.Assign) for s in tree) > 1


def _all(part: object) -> Iterator[nodes.At]:
    if isinstance(part, tuple):
        for one in part:
            yield from _all(one)
    elif is_dataclass(part) and not isinstance(part, type):
        if isinstance(part, nodes.At):
            yield part
        for one in fields(part):
            yield from _all(getattr(part, one.name))


def from_zero_key(key: str) -> str:
    """x[0] of 'x(0)' in [define]: Eigen and CasADi count from 0 in round brackets, too."""
    return re.sub(r"\(\s*(\d+)\s*\)$", r"[\1]", key)


def places_in(body: Sequence[nodes.Statement]) -> dict[str, set[int]]:
    """The entries that are used of each name, where they are written as numbers."""
    found: dict[str, set[int]] = {}
    for at in _all(tuple(body)):
        match at:
            case nodes.At(of=nodes.Word(name=name), places=(nodes.Number(text=text),)) if text.isdigit():
                found.setdefault(name, set()).add(int(text))
            case nodes.At(of=nodes.Word(name=name)):
                found.setdefault(name, set()).add(0)  # not known: counted from 0
    return found


def from_zero(part: Any, names: Collection[str]) -> Any:
    """The same with the entries of these names counted from 0."""
    match part:
        case tuple():
            return tuple(from_zero(one, names) for one in part)
        case nodes.At(of=nodes.Word(name=name), places=(nodes.Number(text=text),)) if name in names:
            return nodes.At(part.of, (nodes.Number(str(int(text) - 1)),))
    if is_dataclass(part) and not isinstance(part, type):
        return replace(part, **{f.name: from_zero(getattr(part, f.name), names) for f in fields(part)})
    return part


class GrammarReader(Reader):
    """``own_state``: the places of the state, where fields or steps of a simulation say them."""

    follower: GrammarFollower

    def __init__(
        self, data: dict[str, Any], found: Known, tree: Sequence[nodes.Statement], language: Language, prefix: str
    ) -> None:
        if language.grammar == "tree_sitter_cpp":
            found = replace(found, defined={from_zero_key(k): v for k, v in found.defined.items()})
        super().__init__(data, found, tree, matlab=False, prefix=prefix)
        self.follower = GrammarFollower(found, tree, language, prefix)
        self.own_state: list[Path] | None = None

    def _is_kept(self, name: str, value: Any, used: str) -> bool:
        return name.isidentifier() and super()._is_kept(name, value, used)

    def _of_text(self) -> tuple[Rows, Meaning] | None:
        """What stands outside functions, where there are none that may have the equations."""
        return None if any(isinstance(s, nodes.Define) for s in self.tree) else super()._of_text()

    def _of_functions(self) -> tuple[Rows, Meaning]:
        follower = self.follower
        found: list[tuple[str, tuple[Rows, Meaning]]] = []
        doubtful: list[tuple[str, str]] = []
        for name, locals_ in list(follower.overloads.items()):
            for local in locals_ if name != "__init__" else []:
                try:
                    result = self._try(lambda one=local: self._function(one))
                except Doubtful as error:
                    doubtful.append((name, str(error)))
                    continue
                if result is not None:
                    found.append((name, result))
        outer = [(name, one) for name, one in found if name not in follower.called] or found
        doubts = [why for name, why in doubtful if name not in follower.called or not outer]
        if doubts:
            raise NotFollowed(doubts[-1])
        if len({str(rows) for _, (rows, _) in outer}) > 1:
            raise NotFollowed(SEVERAL.format(", ".join(name for name, _ in outer)))
        if outer:
            return outer[0][1]
        by_function = self._by_functions()
        if by_function is not None:
            return by_function
        raise NotFollowed(self.refused[-1] if self.refused else NO_FUNCTION)

    def _by_functions(self) -> tuple[Rows, Meaning] | None:
        """double thetaAcc(…), double xAcc(…): one function for each acceleration."""
        made: dict[int, tuple[str, Scope]] = {}
        for name, locals_ in self.follower.overloads.items():
            k = self.known.of_rate(name, 2)
            if k is None:
                continue
            if k in made or len(locals_) != 1:
                raise NotFollowed(
                    f"which function has the acceleration of {self.known.coordinates[k]}? Give the one that is meant"
                )
            scope, value, _ = self.follower.of_function(locals_[0])
            if self.follower.doubts:
                raise NotFollowed(self.follower.doubts[0])
            if value is None:
                return None
            if isinstance(value, Broken):
                raise NotFollowed(value.why)
            made[k] = formula(value).text, scope
        if len(made) != self.count:
            return None
        texts = [made[k][0] for k in range(self.count)]
        scope = made[0][1]
        parameters = [p for locals_ in self.follower.overloads.values() for one in locals_ for p in one.parameters]
        meaning = self._meaning(parameters, [Formula(t) for t in texts], scope)
        return self._checked([(self._second(k), t) for k, t in enumerate(texts)], meaning)

    def _function(self, local: Local) -> tuple[Rows, Meaning] | None:
        self.own_state = None
        local = self._from_one(local)
        by_number = self._by_number(local)
        if by_number is not None:
            return by_number
        made = super()._function(local)
        if made is not None and self.follower.doubts:
            raise Doubtful(self.follower.doubts[0])
        return made

    def _from_one(self, local: Local) -> Local:
        """y[1] … y[4] of Numerical Recipes: the first entry of such a parameter is 1."""
        define = local.of
        assert isinstance(define, nodes.Define)
        places = places_in(define.body)
        names = {
            p for p in define.parameters if places.get(p) and min(places[p]) == 1 and max(places[p]) == 2 * self.count
        }
        if not names or self.follower.language.first:
            return local
        self.follower.names.first = 1
        return Local(local.parameters, replace(define, body=from_zero(define.body, names)), local.given)

    def _by_number(self, local: Local) -> tuple[Rows, Meaning] | None:
        """switch (i) { case 0: return … }: each derivative by its number."""
        define = local.of
        assert isinstance(define, nodes.Define)
        name = next((s.test.left.name for s in define.body if isinstance(s, nodes.Choice) and isinstance(s.test, nodes.Binary)
                     and isinstance(s.test.left, nodes.Word) and s.test.left.name in define.parameters
                     and isinstance(s.test.right, nodes.Number)), None)  # fmt: skip
        if name is None:
            return None
        values: list[Value] = []
        self.follower.fresh()
        given: list[Value] = [Outside((p,)) for p in local.parameters]
        for k in range(2 * self.count):
            given[local.parameters.index(name)] = Formula(str(k))
            values.append(self.follower.followed(local, list(given), {}))
        return self._try(
            lambda: self._from_value(Several(values), self.follower.top, define.parameters, (define.name,))
        )

    def _by_parameter(self, scope: Scope, define: nodes.Define) -> tuple[Rows, Meaning] | None:
        """A parameter that is filled is what the function gives back; it is as long as what is filled."""
        for name in define.parameters:
            value = scope.names.get(name)
            if isinstance(value, Broken):
                self.refused.append(value.why)
            if not isinstance(value, Array) or not value.is_vector:
                continue
            entries = list(value.entries)
            while entries and entries[-1].text == Outside((name, len(entries) - 1)).mark:
                entries.pop()
            missing = [k for k, e in enumerate(entries) if e.text == Outside((name, k)).mark]
            if missing:
                self.refused.append(f"{name}: entry {missing[0] + self.follower.names.first} is not given")
            elif len(entries) in (self.count, 2 * self.count):
                filled = Array(entries, (len(entries),), value.kind)
                found = self._try(lambda v=filled, n=name: self._from_value(v, scope, define.parameters, (n,)))
                if found is not None:
                    return found
        return None

    # what a value says

    def _from_value(
        self, value: Value, scope: Scope, parameters: Sequence[str], names: Sequence[str] = ()
    ) -> tuple[Rows, Meaning] | None:
        self.own_state = None
        if isinstance(value, Record):
            self._require_steps(value)
            return self._from_record(value, scope, parameters)
        parts = self.follower.expressions.parts(value)
        if parts and len(parts) == 2 * self.count + 1 and isinstance(parts[-1], Formula) and parts[-1].whole == 1:
            value = Several(parts[:-1])  # the rate of time itself
        return super()._from_value(value, scope, parameters, names)

    def _require_steps(self, value: Record) -> None:
        """{ theta: s.theta + s.omega*dt, … }: Raises Doubtful where a next state is not that of a step forwards."""
        for name, held in value.fields.items():
            is_place = self.known.coordinate(name) is not None or self.known.of_rate(name, 1) is not None
            if (
                is_place
                and isinstance(held, Formula)
                and re.search(r"«(?:[^«»]*\|)?(?:dt|h|step|deltaTime)»", held.text)
            ):
                found = re.fullmatch(r"«(?:[^«»]*\|)?(?P<of>[^«»|]+)» \+ (?P<x>[^-+]+)\*«[^«»]+»", held.text)
                if found is None or found["of"] != name:
                    raise Doubtful(
                        f"{name} of what is given back is no step of it forwards; give the accelerations alone"
                    )

    def _from_record(self, value: Record, scope: Scope, parameters: Sequence[str]) -> tuple[Rows, Meaning] | None:
        """Named accelerations; a thing with the derivative of each field of the state."""
        second = {k: v for name, v in value.fields.items() if (k := self.known.of_rate(name, 2)) is not None}
        if len(second) == self.count:
            entries = [formula(second[k]) for k in range(self.count)]
            meaning = self._meaning(parameters, entries, scope)
            return self._checked([(self._second(k), e.text) for k, e in enumerate(entries)], meaning)
        if len(value.fields) != 2 * self.count:
            raise NotFollowed("which fields are the accelerations is not plain; give them names such as theta_ddot")
        entries = [formula(v) for v in value.fields.values()]
        paths = self._paths(entries)
        self.own_state = [next((p for p in paths if p[-1] == name), (name,)) for name in value.fields]
        return self._of_state(entries, scope, parameters)

    def _state(self, meaning: Meaning, parameters: Sequence[str], entries: Sequence[Formula]) -> list[Path] | None:
        return self.own_state or super()._state(meaning, parameters, entries)

    def _by_names(self, scope: Scope, parameters: Sequence[str] = ()) -> tuple[Rows, Meaning] | None:
        moved = self._by_steps(scope, parameters)
        if moved is not None:
            return moved
        changed = self.follower.expressions.changed
        fields = {f"{name}.{field}": v for name, held in scope.names.items() if isinstance(held, Record)
                  for field, v in held.fields.items()}  # fmt: skip
        self.follower.expressions.members = {".".join(map(str, path)): v for path, v in changed.items()} | fields
        return super()._by_names(self._explicit(scope), parameters)

    def _explicit(self, scope: Scope) -> Scope:
        """Without acc, where xacc is there: a name with the coordinate in it says more."""
        says: dict[int, list[str]] = {}
        for name in scope.names:
            k = self.known.of_rate(name, 2)
            if k is not None:
                says.setdefault(k, []).append(name)
        general = {name for k, names in says.items() for name in names if len(names) > 1
                   and any(self.known.coordinates[k] in n.lower() for n in names)
                   and self.known.coordinates[k] not in name.lower()}  # fmt: skip
        kept = {name: value for name, value in scope.names.items() if name not in general}
        return Scope(scope.around, kept, scope.parameters)

    def _by_steps(self, scope: Scope, parameters: Sequence[str]) -> tuple[Rows, Meaning] | None:
        """theta += omega*dt; omega += acceleration*dt."""
        moved = self.follower.moved
        if self._says_accelerations():  # a step of another order, as velocity Verlet's, says nothing more
            moved = {}
        places: dict[int, tuple[Path, Path]] = {}
        for path, values in moved.items():
            k = self._coordinate_at(path)
            if k is None or isinstance(values[0], Broken):
                continue
            mark = MARK.fullmatch(formula(values[0]).text)
            if mark is None and not MARK.fullmatch(formula(values[0]).text.removeprefix("-")):
                continue
            if mark is None or self._is_no_rate(path_of(mark[1]), k):
                raise Doubtful(f"{path[-1]} is changed by something else than its rate; give the equations alone")
            if len(values) > 1 or k in places:
                raise Doubtful(f"{path[-1]} is changed more than once; give the equations alone")
            places[k] = path, path_of(mark[1])
        if len(places) != self.count or any(rate not in moved for _, rate in places.values()):
            stepped = [str(p[-1]) for p in moved if self._coordinate_at(p) is not None]
            if stepped:
                raise Doubtful(
                    f"{stepped[0]} is stepped, and what its rate's step is, is not plain; give the equations alone"
                )
            return None
        accelerations: list[Formula] = []
        for k in range(self.count):
            values = moved[places[k][1]]
            if len(values) > 1:
                raise Doubtful(f"{places[k][1][-1]} is changed more than once; give the equations alone")
            accelerations.append(self._in_the_end(formula(values[0]), scope))
            mark = MARK.fullmatch(accelerations[-1].text)
            if mark and STEP.fullmatch(mark[1].split("|")[-1]) and not self.known.is_quantity(mark[1].split("|")[-1]):
                raise Doubtful(f"{places[k][1][-1]} is changed by the step alone; give the equations alone")
        rates = [places[k][1] for k in range(self.count)]
        self.own_state = [places[k][0] for k in range(self.count)] + rates
        entries = [*(Formula(Outside(rate).mark) for rate in rates), *accelerations]
        return self._of_state(entries, scope, parameters)

    def _in_the_end(self, value: Formula, scope: Scope) -> Formula:
        """omega += alpha*dt; …; alpha = …: what the name comes to behind the step, for the next one."""
        mark = MARK.fullmatch(value.text)
        path = path_of(mark[1]) if mark else ()
        held = scope.find(str(path[0])) if len(path) == 1 else self.follower.expressions.changed.get(path)
        if isinstance(held, Broken):
            raise Doubtful(held.why)
        return held if isinstance(held, Formula) else value

    def _says_accelerations(self) -> bool:
        """Whether [define] has a name for each acceleration, and one of these is a field or name that is stepped with."""
        said = [self.known.of_rate(name, 2) for name, text in self.known.defined.items() if text.strip().endswith("''")]
        return {k for k in said if k is not None} == set(range(self.count))

    def _coordinate_at(self, path: Path) -> int | None:
        """The coordinate that a name or a field is: as [define] says of the field, or by its own name."""
        said = self.known.defined.get(rendered(path, self.follower.names.first))
        return self.known.coordinate(str(path[-1]) if said is None else said.replace("\\", ""))

    def _is_no_rate(self, path: Path, k: int) -> bool:
        """Whether what a coordinate is changed by is a step alone, or another coordinate's rate by its name."""
        last = str(path[-1])
        of = self.known.of_rate(self.known.defined.get(rendered(path, self.follower.names.first), last), 1)
        return (of is not None and of != k) or (STEP.fullmatch(last) is not None and not self.known.is_quantity(last))

    def _has_all(self, value: Value) -> bool:
        return isinstance(value, Array) and len(value.entries) in (self.count, 2 * self.count)
