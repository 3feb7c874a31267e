"""Rows of equations of motion from what a followed program comes to."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from ....models.errors import InvalidInput
from ..letters.every_text import rows_of
from . import nodes
from .follow import Follower
from .forms import Forms, Rows, needed
from .known import Known, known, readable
from .library import modules_of
from .lost_steps import require_steps, stepped
from .matlab import matlab_tree
from .meaning import ADVICE, Meaning, path_of
from .names import MARK, Scope
from .python import python_tree
from .values import Array, Broken, Doubtful, Local, NotFollowed, Outside, Several, Value, formula

LONGEST_TEXT = 20_000
LONG_SCRIPT = 6  # statements
STATE_RATES = re.compile(
    r"(?i)(?:d_?)?(?:x|y|z|s|state|states|q|stav)_?(?:dot|p|prime|der|deriv|derivs|derivatives?)|d_?(?:x|y|z|s|u|state|states|q|ydt|xdt|sdt|zdt|stateds?|statedt|dt)|"
    r"d(?:x|y|z|s|state)_?dt|f|rhs|f_?expl|f_?expr|ode|xdot|dae|derivs?|out|res|vet_x_dot|f_?cont|dX|dY|ret|result|f_expl_expr|f_nonlinear|dxdy|dstate_dt"
)


TOO_DEEP = "expressions within expressions, too deep; give parts names"


def one_text(data: dict[str, Any]) -> tuple[str, str, Known] | None:
    """The label of a derivation's only text, the text, and what is declared; None for what can be no program."""
    rows = rows_of(data)
    found = known(data)
    if len(rows) != 1 or not 1 <= len(found.coordinates) <= 8 or not all(found.coordinates):
        return None
    return *rows[0], found


def prefix_for(text: str) -> str:
    """What names of ours begin with: a word that the text does not have."""
    return next((word for word in ("val", "line", "part", "piece") if word not in text), "quantity")


def traced(data: dict[str, Any]) -> tuple[dict[str, Any], dict[str, str]] | None:
    """The fields with rows in place of a program, and the line that each definition is from; None for other texts.

    Raises InvalidInput where it is a program and cannot be taken as it is meant.
    """
    one = one_text(data)
    if one is None:
        return None
    label, text, found = one
    if found.is_downwards(text):
        return None  # refused where functions are read
    if len(text) > LONGEST_TEXT or "Symbol(" in text:
        return None
    prefix = prefix_for(text)
    refused: list[str] = []
    for tree, matlab in ((python_tree(text), False), (matlab_tree(text), True)):
        if tree is None or not _is_program(tree):
            continue
        try:
            return Reader(data, found, tree, matlab=matlab, prefix=prefix).read()
        except NotFollowed as error:
            if any(isinstance(s, nodes.Define) for s in tree) or len(tree) >= LONG_SCRIPT:
                refused.append(str(error))  # fewer are formulas, which other readers know
        except RecursionError:
            refused.append(TOO_DEEP)
    if refused:
        raise InvalidInput(f"equations.{label:.40}: {refused[0]}")
    return None


def _is_program(tree: Sequence[nodes.Statement]) -> bool:
    """Whether statements are more than one formula."""
    assigned = [s for s in tree if isinstance(s, nodes.Assign)]
    values = [s.value for s in tree if isinstance(s, nodes.Assign | nodes.Do)]
    values += [a for v in values if isinstance(v, nodes.Call) for a in (*v.arguments, *(x for _, x in v.named))]
    nameless = any(isinstance(v, nodes.Nameless) for v in values)
    return nameless or len(assigned) > 1 or any(isinstance(s, nodes.Define) for s in tree)


class Reader(Forms):
    """The program of one file: its rows, from the text itself or from one of its functions."""

    def __init__(self, data: dict[str, Any], found: Known, tree: Sequence[nodes.Statement], *, matlab: bool, prefix: str
                 ) -> None:  # fmt: skip
        self.data, self.known = data, found
        self.follower = Follower(found, tree, matlab=matlab, prefix=prefix)
        self.follower.expressions.modules = modules_of("\n".join(text for _, text in rows_of(data)))
        self.tree = tree
        self.refused: list[str] = []

    def read(self) -> tuple[dict[str, Any], dict[str, str]]:
        """The rows of the text itself, or of the one function that gives equations of motion."""
        self.follower.run()
        found = self._alone(self._of_text)
        if found is None:
            found = self._of_functions()
        rows, meaning = found
        require_steps(self.tree, self.known)
        return self._fields(rows, meaning)

    # which part of the text

    def _of_text(self) -> tuple[Rows, Meaning] | None:
        """What stands outside functions."""
        follower, scope = self.follower, self.follower.top
        own = [s for s in self.tree if isinstance(s, nodes.Assign)]
        if not own:
            return None
        equations = [e for e in follower.equations if self._has_accelerations(e[1]) or self._has_accelerations(e[0])]
        if equations:
            return self._equations(equations)
        targets = [s.target.name for s in own if isinstance(s.target, nodes.Word)]
        for name in dict.fromkeys(reversed(targets)):
            value = scope.names.get(name)
            if isinstance(value, Broken):
                self.refused.append(value.why)
            if isinstance(value, Local):
                found = self._try_nameless(value, (name,))
                if found is not None:
                    return found
                continue
            if value is None or isinstance(value, Broken):
                continue
            vector = self.known.is_vector(name)
            is_rate = STATE_RATES.fullmatch(name) or (vector is not None and vector[0])
            found = self._try(lambda v=value, n=name: self._from_value(v, scope, (), (n,))) if is_rate else None
            if found is not None:
                return found
        return self._by_names(scope) or self._of_arguments()

    def _of_arguments(self) -> tuple[Rows, Meaning] | None:
        """solve_ivp(lambda t, y: [y[1], …], …): a function without a name among the arguments of a call."""
        for statement in self.tree:
            value = statement.value if isinstance(statement, nodes.Assign | nodes.Do) else None
            if isinstance(value, nodes.Call):
                for argument in (*value.arguments, *(v for _, v in value.named)):
                    if isinstance(argument, nodes.Nameless):
                        return self._try_nameless(Local(argument.parameters, argument))
        return None

    def _try_nameless(self, value: Local, names: Sequence[str] = ()) -> tuple[Rows, Meaning] | None:
        """``names``: what the text calls it."""
        if not isinstance(value.of, nodes.Nameless):
            return None
        define = value.of

        def read() -> tuple[Rows, Meaning] | None:
            scope = Scope(self.follower.top, parameters=frozenset(define.parameters))
            value = self.follower.expressions.value(define.value, scope)
            return self._from_value(value, scope, define.parameters, names)

        return self._try(read)

    def _alone(self, read: Any) -> tuple[Rows, Meaning] | None:
        """What one part of the program says; what is doubtful in it says nothing of the others."""
        try:
            return self._try(read)
        except Doubtful as error:
            self.refused.append(str(error))
            return None

    def _of_functions(self) -> tuple[Rows, Meaning]:
        follower = self.follower
        found: list[tuple[str, tuple[Rows, Meaning]]] = []
        for name, local in list(follower.functions.items()):
            if name == "__init__" or not isinstance(local.of, nodes.Define):
                continue
            result = self._alone(lambda one=local: self._function(one))
            if result is not None:
                found.append((name, result))
        outer = [(name, one) for name, one in found if name not in follower.called] or found
        different = {str(rows) for _, (rows, _) in outer}
        if len(outer) > 1 and len(different) > 1:
            listed = ", ".join(name for name, _ in outer)
            raise NotFollowed(f"{listed} all give equations of motion; give the text of the one that is meant")
        if outer:
            return outer[0][1]
        if self.refused:
            raise NotFollowed(self.refused[-1])
        raise NotFollowed(f"no equations of motion are found in this program; {ADVICE}")

    def _function(self, local: Local) -> tuple[Rows, Meaning] | None:  # noqa: PLR0911, PLR0912 -- one for each way
        follower = self.follower
        before = len(follower.equations)
        scope, value, returned = follower.of_function(local)
        define = local.of
        assert isinstance(define, nodes.Define)
        given_back = scope.names.get("return")
        if isinstance(given_back, Broken):
            raise NotFollowed(given_back.why)
        names: tuple[str, ...] = (define.name,)
        if define.outs:
            outs = [scope.names.get(name, Broken(f"{name} is given back, and has no value")) for name in define.outs]
            if len(outs) > 1:
                matrix = self._by_matrices(dict(zip(define.outs, outs, strict=True)), scope, define.parameters)
                if matrix is not None:
                    return matrix
                broken = next((v.why for v in outs if isinstance(v, Broken)), None)
                if broken is not None:
                    raise Doubtful(broken)
                several = self._try(lambda: self._from_value(Several(outs), scope, define.parameters, define.outs))
                if several is not None:
                    return several
                return self._by_names(scope, define.parameters) or self._try(
                    lambda: self._from_value(outs[0], scope, define.parameters, define.outs[:1])
                )
            value, names = outs[0], (define.outs[0], define.name)
        elif returned is not None and isinstance(returned.value, nodes.Word):
            names = (returned.value.name, define.name)
        elif returned is not None and isinstance(returned.value, nodes.Listed):
            items = returned.value.items
            words = tuple(i.name for i in items if isinstance(i, nodes.Word))
            names = (
                words
                if len(words) == len(items) == self.count and self.known.of_rate(words[0], 2) is not None
                else names
            )
            named = {i.name: scope.find(i.name) for i in items if isinstance(i, nodes.Word)}
            if len(named) == len(items) and all(v is not None for v in named.values()):
                matrix = self._by_matrices({k: v for k, v in named.items() if v is not None}, scope, define.parameters)
                if matrix is not None:
                    return matrix
        if isinstance(value, Broken):
            raise Doubtful(value.why)
        if isinstance(value, Local) and isinstance(value.of, nodes.Define) and value.of is not define:
            return self._function(value)  # a function that makes the one that is meant
        found = None if value is None else self._try(lambda: self._from_value(value, scope, define.parameters, names))
        if found is not None:
            return found
        reasons = list(self.refused)
        equations = [e for e in follower.equations[before:] if self._has_accelerations(e[1])]
        if equations and value is not None:
            return self._equations(equations)
        stepped_ones = None if value is None else self._of_new_values(define, value, scope)
        if stepped_ones is not None:
            return stepped_ones
        if value is not None and self._is_derivative(value):
            raise NotFollowed(reasons[-1] if reasons else ADVICE)
        made = self._by_parameter(scope, define) or self._by_names(scope, define.parameters)
        if made is None and reasons:
            raise NotFollowed(reasons[-1])
        return made

    def _of_new_values(self, define: nodes.Define, value: Value, scope: Scope) -> tuple[Rows, Meaning] | None:
        """new_w = w + alpha*dt; new_th = th + new_w*dt; return [new_th, new_w]: a step that changes nothing."""
        steps = [s for one in define.body if isinstance(one, nodes.Assign) and (s := stepped(one, self.known))]
        rates = {k: s for s in steps if (k := self.known.of_rate(s[1], 1)) is not None}
        places = {k: s for s in steps if (k := self.known.coordinate(s[1])) is not None}
        if not steps or not isinstance(value, Array | Several):
            return None
        entries = self._flat(value)
        if not len(steps) == len(entries) == 2 * self.count == len(rates) + len(places):
            return None
        for k, (new, old, bare) in places.items():
            if not isinstance(bare, nodes.Word) or bare.name not in rates[k][:2]:
                raise Doubtful(
                    f"{new}: {old} is stepped with something else than its rate; give the accelerations alone"
                )
        for new, old, _ in steps:
            mark = MARK.fullmatch(formula(scope.find(old) or Outside((old,))).text)
            place = next((p for p in reversed(path_of(mark[1]) if mark else ()) if isinstance(p, int)), None)
            own = [k for k, e in enumerate(entries) if e == formula(scope.names[new])]
            if mark is None or not own or (isinstance(place, int) and place not in own):
                raise Doubtful(f"{new} is not given back where {old} stands in the state; give the accelerations alone")
        seconds = [formula(self.follower.expressions.value(rates[k][2], scope)) for k in range(self.count)]
        meaning = self._meaning(define.parameters, seconds, scope)
        return self._checked([(self._second(k), e.text) for k, e in enumerate(seconds)], meaning)

    def _is_derivative(self, value: Value) -> bool:
        """Whether a value is a state's derivative, with rates in it: then it alone counts, whatever names there are."""
        try:
            entries = self._flat(value)
        except NotFollowed:
            return False
        return len(entries) == 2 * self.count and any(MARK.fullmatch(e.text) for e in entries)

    def _by_parameter(self, scope: Scope, define: nodes.Define) -> tuple[Rows, Meaning] | None:
        """A parameter that is filled, dydt[0] = …, is what the function gives back."""
        for name in define.parameters:
            value = scope.names.get(name)
            if isinstance(value, Broken):
                self.refused.append(value.why)
            if isinstance(value, Array) and len(value.entries) in (self.count, 2 * self.count):
                found = self._try(lambda v=value: self._from_value(v, scope, define.parameters))
                if found is not None:
                    return found
        return None

    def _fields(self, rows: Rows, meaning: Meaning) -> tuple[dict[str, Any], dict[str, str]]:
        names = self.follower.names
        lines = needed(names.lines, " ".join(left + " " + right for left, right in rows))
        made = {name: self._said(line, meaning) for name, line in lines.items()}
        texts = [f"{left} = {right}" for left, right in rows]
        made, texts = shortened(made, texts)
        define = self.data.get("define", {})
        used = " ".join([*texts, *made.values()])
        define = {k: self.known.defined.get(str(k), v) for k, v in define.items()} if isinstance(define, dict) else {}
        kept = {k: v for k, v in define.items() if self._is_kept(str(k), v, used)}
        bodies = self.data.get("bodies")
        if isinstance(bodies, list):
            bodies = [self._renamed(b) for b in bodies]
        fields = self.data | {
            "equations": {str(k): row for k, row in enumerate(texts, 1)},
            "define": {**kept, **made},
            "bodies": bodies,
        }
        return fields, {name: names.said[name] for name in made}

    def _renamed(self, body: Any) -> Any:
        """A body with its coordinate as the rows have it."""
        declared = str(body.get("coordinate", "")) if isinstance(body, dict) else ""
        bare = declared.replace("\\", "").strip("_")
        if not declared or "motion" in body or bare == declared.replace("\\", "") in self.known.written:
            return body
        return {**body, "coordinate": readable(bare, self.known.quantities)}

    def _is_kept(self, name: str, value: Any, used: str) -> bool:
        if (re.search(r"[\[({]", name) and not name.endswith("(t)")) or name.endswith("_"):
            return False
        if isinstance(value, str) and (name == f"{value.strip()}(t)" or name == value.strip().strip("_") != value):
            return False  # f(t) is f, and g_ is g
        return not (isinstance(value, str) and "[" in value and not re.search(rf"(?<!\w){re.escape(name)}(?!\w)", used))


MOST_LINES, LONGEST_ROW = 38, 8000


def shortened(lines: dict[str, str], rows: list[str]) -> tuple[dict[str, str], list[str]]:
    """Lines that are used once stand where they are used, while there are too many."""
    made = dict(lines)
    for name in list(made):
        if len(made) <= MOST_LINES:
            break
        pattern = re.compile(rf"(?<![A-Za-z0-9]){name}(?![0-9])")
        uses = [len(pattern.findall(t)) for t in (*made.values(), *rows)]
        if sum(uses) != 1:
            continue
        text = made.pop(name)
        made = {k: pattern.sub(lambda _, t=text: f"({t})", v) for k, v in made.items()}  # type: ignore[misc]
        rows = [pattern.sub(lambda _, t=text: f"({t})", row) for row in rows]  # type: ignore[misc]
    return made, rows
