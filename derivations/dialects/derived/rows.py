"""Rows of equations of motion, or the Lagrangian, from a script that derives them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from ....models.errors import InvalidInput
from ..letters.every_text import is_fit, rows_of
from ..statements import DOWNWARDS
from ..traced import nodes
from ..traced.forms import Rows
from ..traced.known import Known, known
from ..traced.library import modules_of
from ..traced.matlab import matlab_tree
from ..traced.meaning import Meaning
from ..traced.names import Scope
from ..traced.python import python_tree
from ..traced.rows import LONGEST_TEXT, TOO_DEEP, Reader, prefix_for, shortened
from ..traced.values import Broken, Formula, Local, NotFollowed, Outside, Value, formula
from .follow import ScriptFollower
from .mathematica import mathematica_tree, plain_letters
from .maxima import maxima_tree
from .values import entries_of, equations_in, is_equation

DERIVES = re.compile(
    r"\b(?:diff|jacobian|gradient|hessian|dynamicsymbols|LagrangesMethod|lambdify|Derivative|euler_equations|functionalDerivative"
    r"|linear_eq_to_matrix|equationsToMatrix|jtimes|depends)\s*\(|\.sym\s*\(|\bFunction\s*\(|\bD\[|\b(?:Parametric)?(?:ND)?Solve(?:Value)?\["
)
LAGRANGIAN = re.compile(r"(?:L|Lag|Lagr|LL|Lg|lag|lagrangian|Lagrangian|LAGRANGIAN|lagrange|L_total|Lagrange)")
_OF = r"(?:_?(?:[0-9xyqs]|th(?:eta)?_?[0-9]?|phi_?[0-9]?|alpha|beta|eqs?\w*))?"
EQUATION = re.compile(
    rf"(?i)eq\w*|e_?l{_OF}|l[em]{_OF}|lagr(?:ange)?{_OF}|euler\w*|eom\w*|odes?\w*|de_?[0-9]?|sys(?:tem)?|gl_?[0-9]?"
)
ONE_SIDE = re.compile(r"(?i)lhs|rhs|left|right|side")
INTEGRATED = re.compile(
    r"\b(?:odeint|solve_ivp|ode45|ode23|ode113|ode15s|RK45|solve_bvp|rk4|runge_kutta\w*|lsode)\s*\(\s*@?(?P<name>\w+)"
)
GIVE = "give the equations of motion alone, or the Lagrangian as L = T - V"


class NoEquations(NotFollowed):
    """A script that has none that are known as such: another reader may know better."""


def from_scripts(data: dict[str, Any]) -> tuple[dict[str, Any], dict[str, str]] | None:
    """The fields with rows, or with a Lagrangian, in place of a script, and the line that each definition is from.

    None for other texts. Raises InvalidInput where it is such a script and cannot be followed.
    """
    field, label, text = _only_text(data)
    if "\\[" in text and mathematica_tree(text) is not None:
        define = data.get("define")
        if isinstance(define, dict):
            data = data | {"define": {plain_letters(str(k)): v for k, v in define.items()}}
    found = known(data)
    if not text or len(text) > LONGEST_TEXT or not 1 <= len(found.coordinates) <= 8 or not all(found.coordinates):
        return None
    if "Symbol(" in text and not re.search(r"=\s*(?:\w+\.)?Symbol\(\s*['\"]", text):
        return None
    refused: list[str] = []
    for tree, matlab in trees_of(text):
        if not _is_script(tree, text, field):
            continue
        if DOWNWARDS.search(text):
            raise InvalidInput(
                f"{label}: g is a negative number here; give it without its sign, and the sign in the text"
            )
        try:
            return ScriptReader(data, found, tree, matlab=matlab, text=text).read_field(field)
        except NoEquations:
            continue
        except NotFollowed as error:
            refused.append(str(error))
        except RecursionError:
            refused.append(TOO_DEEP)
    if refused:
        raise InvalidInput(f"{label}: {refused[0]}")
    return None


def trees_of(text: str) -> list[tuple[tuple[nodes.Statement, ...], bool]]:
    """The statements of a text in each language that it may be of, and whether that is MATLAB's."""
    for read in (maxima_tree, mathematica_tree):
        tree = read(text)
        if tree is not None:
            return [(tree, False)]
    made = [(_of_start(python_tree(text)), False), (matlab_tree(text), True)]
    return [(tree, matlab) for tree, matlab in made if tree is not None]


def _of_start(tree: tuple[nodes.Statement, ...] | None) -> tuple[nodes.Statement, ...] | None:
    """The statements of a class whose only function is __init__, or of the only function, where it takes nothing, as if
    they stood alone; any other text as it is."""
    functions = [s for s in tree or () if isinstance(s, nodes.Define)]
    if tree is None or len(functions) != 1:
        return tree
    (only,) = functions
    if only.name == "__init__":
        return (*(s for s in tree if not isinstance(s, nodes.Define)), *only.body)
    if only.parameters or any(isinstance(s, nodes.Assign) and repr(nodes.Word(only.name)) in repr(s) for s in tree):
        return tree
    body = only.body[:-1] if isinstance(only.body[-1], nodes.Return) else only.body
    return (*(s for s in tree if not isinstance(s, nodes.Define)), *body)


def _only_text(data: dict[str, Any]) -> tuple[str, str, str]:
    """The field, its label and the text of a derivation's only text."""
    rows = rows_of(data)
    if len(rows) == 1 and "lagrangian" not in data:
        return "equations", f"equations.{rows[0][0]:.40}", rows[0][1]
    text = data.get("lagrangian")
    if not rows and isinstance(text, str) and is_fit(text) and not any(f in data for f in ("kinetic", "potential")):
        return "lagrangian", "lagrangian", text
    return "", "", ""


def _is_script(tree: Sequence[nodes.Statement], text: str, field: str) -> bool:
    """Whether statements derive something, or say a Lagrangian by several names."""
    assigned = [s for s in tree if isinstance(s, nodes.Assign)]
    has_function = any(isinstance(s, nodes.Define) for s in tree)
    if field == "lagrangian":
        return has_function or (len(assigned) > 1 and DERIVES.search(text) is not None)
    return DERIVES.search(text) is not None and (len(assigned) > 1 or has_function)


class ScriptReader(Reader):
    """``text``: the script as it stands."""

    follower: ScriptFollower

    def __init__(self, data: dict[str, Any], found: Known, tree: Sequence[nodes.Statement], *, matlab: bool, text: str
                 ) -> None:  # fmt: skip
        super().__init__(data, found, tree, matlab=matlab, prefix=prefix_for(text))
        self.follower = ScriptFollower(found, tree, matlab=matlab, prefix=prefix_for(text))
        self.follower.expressions.modules = modules_of(text)
        self.text = text
        self.follower.algebra.kind = "matrix" if re.search(r"\bsympy\b|\bMatrix\s*\(", text) else "array"
        self.follower.calls.brackets = "[" if mathematica_tree(text) is not None else "("

    def read_field(self, field: str) -> tuple[dict[str, Any], dict[str, str]]:
        """Rows where the script comes to equations; else its Lagrangian, where that is what is asked for."""
        self.follower.run()
        if field == "equations":
            return self._fields(*self._last_stage())
        rows = self._of_script()
        if rows is not None:
            self._require_drives()
            fields, lines = self._fields(*rows)
            return {k: v for k, v in fields.items() if k != "lagrangian"}, lines
        return self._lagrangian()

    def _last_stage(self) -> tuple[Rows, Meaning]:
        """What a script comes to in the end: a function for a solver, accelerations, or equations."""
        integrated = {m["name"] for m in INTEGRATED.finditer(self.text)}
        functions = {s.name for s in self.tree if isinstance(s, nodes.Define)}
        found = self._alone(self._of_functions_alone) if functions else None
        if found is None and integrated & functions:
            raise NotFollowed(self.refused[-1] if self.refused else GIVE)
        found = found or self._alone(self._of_text) or self._of_script()
        if found is None and self.refused:
            raise NotFollowed(self.refused[-1])
        if found is None:
            raise NoEquations("no equations of motion are found in this script")
        return found

    def _of_functions_alone(self) -> tuple[Rows, Meaning] | None:
        return self._of_functions()

    # equations

    def _by_names(self, scope: Scope, parameters: Sequence[str] = ()) -> tuple[Rows, Meaning] | None:
        """Accelerations by their names, where these are more than names for second derivatives."""
        made = super()._by_names(scope, parameters)
        return None if made is not None and any(re.fullmatch(r"\(?\w+'+\)?", right) for _, right in made[0]) else made

    def _of_script(self) -> tuple[Rows, Meaning] | None:
        """The equations that are solved, or that have such names."""
        algebra = self.follower.algebra
        for value in algebra.integrated:
            zeros = [e for one in equations_in(value) if is_equation(one) for e in self._equations_of(one)]
            if len(zeros) == self.count:
                return self._zeros(zeros)
            raise NotFollowed(f"{len(zeros)} equations of motion are integrated, for {self.count} coordinates; {GIVE}")
        for zeros, marks in reversed(algebra.solved_for):
            if len(zeros) == self.count == len(marks) and all(self._order_of(m) == 2 for m in marks):
                return self._zeros(zeros)
        named = [
            (name, v)
            for name, v in self.follower.top.names.items()
            if EQUATION.fullmatch(name) and (is_equation(v) or not ONE_SIDE.search(name))
        ]
        for value in (*self.follower.shown, *(v for name, v in named)):
            zeros = self._equations_of(value)
            if len(zeros) == self.count:
                return self._zeros(zeros)
        alone = [e for name, v in named for e in self._equations_of(v)] or [
            e for v in self.follower.shown for e in self._equations_of(v)]  # fmt: skip
        if len(alone) == self.count:
            return self._zeros(alone)
        broken = next((v.why for name, v in named if isinstance(v, Broken)), None)
        if broken is not None:
            raise NotFollowed(broken)
        if alone:
            raise NotFollowed(f"{len(alone)} equations for {self.count} coordinates; {GIVE}")
        return None

    def _equations_of(self, value: Value) -> list[Formula]:
        """Equations with accelerations, or expressions with accelerations that are zero, in one value."""
        if isinstance(value, Broken | Local | Outside):
            return []
        try:
            zeros = self.follower.algebra.zeros(value)
        except NotFollowed:
            return []
        said = any(is_equation(one) for one in equations_in(value))
        return zeros if zeros and all(said or self._accelerates(e) for e in zeros) and any(
            self._accelerates(e) for e in zeros) else []  # fmt: skip

    def _accelerates(self, value: Formula) -> bool:
        return any(self._order_of(m) == 2 for m in self.follower.algebra.derivatives.marks_in(value))

    def _order_of(self, mark: str) -> int:
        """How often a coordinate is differentiated in what a mark stands for; -1 of anything else."""
        path = tuple(int(p) if p.isdigit() else p for p in mark.split("|"))
        meaning = Meaning(self.known, self.follower.names)
        meaning.by_names([path])
        return meaning.order.get(path, (-1, 0))[0]

    def _zeros(self, zeros: Sequence[Formula]) -> tuple[Rows, Meaning]:
        meaning = self._meaning((), zeros, self.follower.top)
        return self._checked([(e.text, "0") for e in zeros], meaning, needs_second=False)

    def _require_drives(self) -> None:
        """Raises NotFollowed where bodies are driven or damped, and the equations behind a Lagrangian do not say so."""
        bodies = [b for b in self.data.get("bodies", ()) if isinstance(b, dict)]
        if any(force in b for b in bodies for force in ("drive", "damping", "friction")):
            raise NotFollowed("equations stand behind the Lagrangian, and bodies are driven or damped; give the "
                              "equations as [equations], or the Lagrangian alone")  # fmt: skip

    # a Lagrangian

    def _lagrangian(self) -> tuple[dict[str, Any], dict[str, str]]:
        """The value of the name, or of the function, that is the Lagrangian."""
        scope, value = self._lagrangians_value()
        if isinstance(value, Broken):
            raise NotFollowed(value.why)
        whole = formula(value)
        meaning = self._meaning((), [whole], scope)
        rows = [(whole.text, "0")]
        meaning.by_names(self._paths([whole]))
        text = self._said(whole.text, meaning)
        fields, lines = self._fields(rows, meaning)
        del fields["equations"]
        made = {k: v for k, v in fields["define"].items() if k in lines}
        made, (text,) = shortened(made, [text])
        kept = {k: v for k, v in fields["define"].items() if k not in lines}
        return fields | {"lagrangian": text, "define": {**kept, **made}}, lines

    def _moves(self, value: Value) -> bool:
        """Whether a value may be a Lagrangian: it has rates, and is no length that is called L."""
        if isinstance(value, Local | Outside):
            return False
        if isinstance(value, Broken):
            return True
        try:
            return any(
                self._order_of(m) == 1 for e in entries_of(value) for m in self.follower.algebra.derivatives.marks_in(e)
            )
        except NotFollowed:
            return False

    def _lagrangians_value(self) -> tuple[Scope, Value]:
        top = self.follower.top
        named = [n for n, v in top.names.items() if LAGRANGIAN.fullmatch(n) and self._moves(v)]
        if named:
            return top, _number(top.names[named[-1]])
        functions = [n for n in self.follower.functions if LAGRANGIAN.fullmatch(n)]
        if not functions and {*self.follower.functions} <= {"__init__", "__call__"}:
            functions = [n for n in self.follower.functions if n == "__call__"]
        if len(functions) == 1:
            scope, value, _ = self.follower.of_function(self.follower.functions[functions[0]])
            if value is None:
                raise NotFollowed(f"{functions[0]} gives nothing back")
            return scope, _number(value)
        raise NotFollowed("which name is the Lagrangian? Write it as L = T - V")


def _number(value: Value) -> Value:
    """A matrix of one entry, which has a Lagrangian in it."""
    return value if isinstance(value, Broken) else entries_of(value)[0] if len(entries_of(value)) == 1 else value
