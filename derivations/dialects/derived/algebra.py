"""Derivatives and solutions of values: by time, by quantities, Lagrange's equations, linear equations."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from ..traced.expressions import Expressions
from ..traced.library import from_items
from ..traced.names import Names
from ..traced.values import (
    ONE,
    ZERO,
    Array,
    Formula,
    NotFollowed,
    Outside,
    Record,
    Several,
    Value,
    formula,
    negative,
    subtracted,
)
from .derivatives import Derivatives
from .values import TIMES, Made, entries_of, equations_in, is_equation, mark_of, marks_of

COUNTED = re.compile(r"(?P<base>.*?)\(?(?P<first>[0-9]*):(?P<last>[0-9]+)\)?")
MOST = 16


class Algebra:
    """``moving``: marks of what is a function of time; ``solved_for``: all that was solved, and for what."""

    def __init__(self, names: Names) -> None:
        self.names, self.known = names, names.known
        self.derivatives = Derivatives(names)
        self.expressions: Expressions | None = None  # set by the follower that has both
        self.moving: set[str] = set()
        self.integrated: list[Value] = []  # equations that are given to a solver of differential equations
        self.rates: dict[str, Formula] = {}  # what gradef(th, t, w) says
        self.kind = "array"  # of sympy's matrices: "matrix"
        self.solved_for: list[tuple[list[Formula], list[str]]] = []

    # names

    def names_in(self, text: str) -> list[str]:
        """The names that symbols('m1 m2 l1:3') makes, without LaTeX's signs."""
        made: list[str] = []
        for word in re.sub(r"[\\{}]", "", text).replace(",", " ").split():
            found = COUNTED.fullmatch(word)
            if found is None:
                made.append(word)
                continue
            first, last = int(found["first"] or 0), int(found["last"])
            if last - first > MOST:
                raise NotFollowed(f"{word}: more than {MOST} quantities")
            made += [f"{found['base']}{k}" for k in range(first, last)]
        return made

    def moves(self, value: Outside) -> Outside:
        """A quantity that is a function of time from here on."""
        self.moving.add(value.mark[1:-1])
        return value

    def rate(self, mark: str) -> Formula:
        """The rate of what a mark stands for. Raises NotFollowed for a coordinate that was made a constant."""
        if mark in TIMES:
            return ONE
        if mark in self.rates:
            return self.rates[mark]
        bare = mark.rstrip("'")
        if bare in self.moving:
            made = Outside((*mark.split("|")[:-1], f"{mark.rsplit('|', maxsplit=1)[-1]}'"))
            self._labelled(mark, made)
            return Formula(made.mark)
        last = bare.split("|")[-1]
        said = [last, *self.names.labels.get((bare,), [])]
        if any(self.known.coordinate(s) is not None or self.known.of_rate(s, 1) is not None for s in said):
            raise NotFollowed(f"{last} is no function of time in this script, and its derivative by time is taken; "
                              "make it one")  # fmt: skip
        return ZERO

    def _labelled(self, mark: str, made: Outside) -> None:
        """th' for the rate of what the author calls th."""
        path = tuple(mark.split("|"))
        for label in self.names.labels.get(path, []):
            mine = self.names.labels.setdefault(made.path, [])
            if f"{label}'" not in mine:
                mine.append(f"{label}'")

    # derivatives

    def entrywise(self, value: Value, of: Callable[[Formula], Formula]) -> Value:
        """An operation on each formula of a value."""
        if isinstance(value, Array):
            return Array([of(e) for e in value.entries], value.shape, value.kind)
        if isinstance(value, Several):
            return from_items([self.entrywise(v, of) for v in value.items])
        if isinstance(value, Record) and is_equation(value):
            return Record({k: self.entrywise(v, of) for k, v in value.fields.items()})
        return of(formula(value))

    def by_time(self, value: Value, times: int = 1) -> Value:
        """The derivative by time."""
        for _ in range(times):
            value = self.entrywise(
                value, lambda f: self.derivatives.along(f, self.rate, f"by time {len(self.moving)} {len(self.rates)}")
            )
        return value

    def diff(self, value: Value, by: Value) -> Value:
        """The derivative by one quantity, or by time."""
        mark = mark_of(by)
        if mark is None:
            raise NotFollowed("a derivative by something that is no name alone; give it a name")
        if mark in TIMES:
            return self.by_time(value)
        return self.entrywise(value, lambda f: self.derivatives.by(f, mark))

    def jacobian(self, value: Value, by: Value) -> Value:
        """Rows of the entries' derivatives by each quantity."""
        marks = marks_of(by)
        entries = entries_of(value)
        made = [self.derivatives.by(e, m) for e in entries for m in marks]
        if len(made) == 1:
            return Array(made, (1, 1), _kind(value))
        return Array(made, (len(entries), len(marks)), _kind(value))

    def gradient(self, value: Value, by: Value) -> Array:
        """A column of derivatives."""
        marks = marks_of(by)
        return Array([self.derivatives.by(formula(value), m) for m in marks], (len(marks), 1), _kind(by))

    def put_in(self, given: Sequence[Value]) -> Value:
        """Formulas in place of quantities; one behind another where they are given so, else all at once."""
        if len(given) < 2:
            return given[0]
        pairs = self._pairs(given[1:])
        value = given[0]
        marks = {old for old, _ in pairs}
        for old, new in pairs:
            if self.derivatives.marks_in(new) & (marks - {old}):
                raise NotFollowed("what is put in has names that are put in themselves; write it out")
            self._require_last(old, pairs, value)
        new_values = {old: new for old, new in pairs if not self._is_number_of_quantity(old, new)}
        return self.entrywise(value, lambda f: self.derivatives.put_in(f, new_values))

    def _pairs(self, given: Sequence[Value]) -> list[tuple[str, Formula]]:
        if len(given) == 1 and is_equation(given[0]):
            made = [self._sides(given[0])]
        elif len(given) == 1 and isinstance(given[0], Record) and "solution" in given[0].fields:
            held = {k: v for k, v in given[0].fields.items() if k != "solution"}
            made = [[Formula(k), formula(v)] for k, v in held.items()]
        elif len(given) == 1 and isinstance(given[0], Several):
            made = [self._sides(item) for item in given[0].items]
        elif len(given) == 1 and isinstance(given[0], Array) and given[0].shape[-1] == 2:
            made = given[0].rows
        elif len(given) >= 2:
            old, new = entries_of(given[0]), entries_of(given[1])
            new = new * len(old) if len(new) == 1 else new
            made = [list(pair) for pair in zip(old, new, strict=False)]
        else:
            raise NotFollowed("what is put in for what? Say it as pairs")
        if len({mark_of(pair[0]) for pair in made}) < len(made):
            raise NotFollowed("something is put in for one name twice")
        if any(len(pair) != 2 or mark_of(pair[0]) is None for pair in made):
            raise NotFollowed("something is put in for more than a name; give it a name of its own")
        return [(mark_of(a) or "", b) for a, b in made]

    @staticmethod
    def _sides(value: Value) -> list[Formula]:
        """What is put in for what: a pair, or the sides of an equation."""
        if isinstance(value, Record) and is_equation(value):
            return [*entries_of(value.fields["lhs"]), *entries_of(value.fields["rhs"])]
        return entries_of(value)

    def _require_last(self, old: str, pairs: Sequence[tuple[str, Formula]], value: Value) -> None:
        """Raises NotFollowed where a coordinate gets another name and its rates do not: those would be 0 then."""
        if old not in self.moving:
            return
        gone = {o for o, _ in pairs}
        left = {m for e in self._entries(value) for m in self.derivatives.marks_in(e)}
        if any(m.startswith(old + "'") and m not in gone for m in left):
            raise NotFollowed(f"something is put in for {old}, and not for its rates; put these in first")

    def _entries(self, value: Value) -> list[Formula]:
        if isinstance(value, Record):
            return [e for v in value.fields.values() for e in self._entries(v)]
        return entries_of(value)

    def _is_number_of_quantity(self, old: str, new: Formula) -> bool:
        """m1 = 1.0: what is right for every value is right for it."""
        last = old.rsplit("|", maxsplit=1)[-1]
        is_one = self.known.is_quantity(last) and self.known.coordinate(last) is None
        return (is_one or last in ("g", "G", "grav", "gravity")) and not self.derivatives.marks_in(new)

    def applied(self, of: Made, given: Sequence[Value]) -> Value:
        """A function of formulas, for these values."""
        if len(given) == len(of.arguments):
            pairs = [p for a, v in zip(of.arguments, given, strict=True) for p in self._matched(a, v)]
        else:
            raise NotFollowed(f"a function of {len(of.arguments)} formulas is called with {len(given)} values")
        for out in of.outs:
            left = {m for e in self._entries(out) for m in self.derivatives.marks_in(e)} - {old for old, _ in pairs}
            if any(m.rstrip("'") in self.moving for m in left):
                raise NotFollowed("a function of formulas has functions of time that are no arguments of it")
        new = {old: value for old, value in pairs if not self._is_number_of_quantity(old, value)}
        made = [self.entrywise(out, lambda f: self.derivatives.put_in(f, new)) for out in of.outs]
        return made[0] if of.alone else Several(made)

    def _matched(self, argument: Value, given: Value) -> list[tuple[str, Formula]]:
        if isinstance(argument, Several):
            assert self.expressions is not None
            parts = self.expressions.parts(given)
            if isinstance(given, Outside):
                parts = [Outside((*given.path, k)) for k in range(len(argument.items))]
            if parts is None or len(parts) != len(argument.items):
                raise NotFollowed("a function of formulas is called with other values than it has names")
            return [p for a, v in zip(argument.items, parts, strict=True) for p in self._matched(a, v)]
        if isinstance(argument, Array) and len(argument.entries) > 1:
            size = len(argument.entries)
            values = [Formula(Outside((*given.path, k)).mark) for k in range(size)] if isinstance(given, Outside) \
                else entries_of(given)  # fmt: skip
            if len(values) != size:
                raise NotFollowed("a function of formulas is called with a vector of another length")
            return list(zip(marks_of(argument), values, strict=True))
        mark = mark_of(argument)
        if mark is None:
            raise NotFollowed("a function of formulas whose argument is no name")
        return [(mark, formula(given))]

    # equations

    def zeros(self, value: Value) -> list[Formula]:
        """What equations say to be zero: left side minus right side."""
        made: list[Formula] = []
        for one in equations_in(value):
            if isinstance(one, Record) and is_equation(one):
                left, right = entries_of(one.fields["lhs"]), entries_of(one.fields["rhs"])
                right = right * len(left) if len(right) == 1 else right
                made += [subtracted(a, b) for a, b in zip(left, right, strict=True)]
            else:
                made.append(formula(one))
        return [self.names.line(e, "an equation") for e in made]

    def matrices(self, equations: Value, unknown: Value) -> tuple[Array, Array]:
        """A and b of A x = b. Raises NotFollowed where the equations are not linear."""
        rows, marks = self.zeros(equations), marks_of(unknown)
        self.solved_for.append((rows, marks))
        made = [self.derivatives.linear(row, marks) for row in rows]
        left = [self.names.line(e, "an equation") for coefficients, _ in made for e in coefficients]
        right = [self.names.line(negative(rest), "an equation") for _, rest in made]
        return Array(left, (len(rows), len(marks)), self.kind), Array(right, (len(rows), 1), self.kind)

    def solved(self, equations: Value, unknown: Value) -> Value:
        """The solution, by the names of what is solved for and in their order."""
        matrix, right = self.matrices(equations, unknown)
        assert self.expressions is not None
        if len(matrix.rows) != len(matrix.rows[0]):
            raise NotFollowed("as many equations as unknown quantities are needed")
        if len(right.entries) == 1:
            whole = self.names.line(matrix.entries[0], "what an equation is divided by")
            values = [self.expressions.combined("/", right.entries[0], whole)]
        else:
            found = self.expressions.solved(matrix, right)
            values = list(entries_of(found))
        kept = [self.names.line(formula(v), "the solution of equations") for v in values]
        marks = marks_of(unknown)
        return Record({f"«{m}»": v for m, v in zip(marks, kept, strict=True)} | {"solution": from_items(kept)})

    # Lagrange's equations

    def lagranges_equations(self, lagrangian: Value, coordinates: Value) -> Array:
        """d/dt ∂L/∂q' - ∂L/∂q, for each coordinate."""
        whole = self.names.line(formula(lagrangian), "the Lagrangian")
        made: list[Formula] = []
        for mark in marks_of(coordinates):
            if mark not in self.moving:
                raise NotFollowed(f"{mark} is no function of time in this script, and a coordinate of its Lagrangian")
            rate = mark_of(self.rate(mark)) or ""
            momentum = self.names.line(self.derivatives.by(whole, rate), "a momentum")
            change = formula(self.by_time(momentum))
            made.append(
                self.names.line(subtracted(change, self.derivatives.by(whole, mark)), "an equation of Lagrange")
            )
        return Array(made, (len(made), 1))

    def lagranges_method(self, lagrangian: Value, coordinates: Value) -> Record:
        """sympy's LagrangesMethod."""
        return Record({
            "lagrangian": formula(lagrangian), "coordinates": coordinates,
            "equations": self.lagranges_equations(lagrangian, coordinates),
        })  # fmt: skip

    def of_method(self, method: Record, name: str) -> Value:
        """form_lagranges_equations(), mass_matrix, forcing, rhs()."""
        equations = method.fields["equations"]
        rates = [self.rate(m) for m in marks_of(method.fields["coordinates"])]
        seconds = from_items([self.rate(mark_of(r) or "") for r in rates])
        if name in ("form_lagranges_equations", "eom"):
            self.solved_for.append((entries_of(equations), marks_of(seconds)))
            return equations
        matrix, right = self.matrices(equations, seconds)
        assert self.expressions is not None
        match name:
            case "mass_matrix":
                return matrix
            case "forcing":
                return right
            case "rhs":
                solved = self.expressions.solved(matrix, right) if len(rates) > 1 else self.expressions.combined(
                    "/", right, matrix)  # fmt: skip
                made = [*rates, *(self.names.line(e, "the solution of equations") for e in entries_of(solved))]
                return Array(made, (len(made), 1))
        raise NotFollowed(f".{name} of LagrangesMethod is not followed; give the equations")


def _kind(value: Value) -> str:
    return value.kind if isinstance(value, Array) and value.kind == "matrix" else "array"
