# ruff: noqa: E501 -- patterns and tables stand on one line
"""Functions of computer algebra: derivatives, equations and their solutions, functions made of formulas."""

from __future__ import annotations

from collections.abc import Callable

from ..traced import library, nodes
from ..traced.calls import Calls
from ..traced.names import Scope
from ..traced.nodes import dotted
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
    Words,
    formula,
    negative,
    number,
    times,
)
from .algebra import Algebra
from .values import TIMES, Made, entries_of, equation, is_equation, mark_of

SAME = frozenset((
    "simplify", "expand", "trigsimp", "doit", "factor", "collect", "ratsimp", "fullratsimp", "trigreduce", "trigexpand",
    "cancel", "together", "powsimp", "radsimp", "nsimplify", "combsimp", "trigrat", "ev", "Simplify", "FullSimplify",
    "Expand", "TrigReduce", "TrigExpand", "Factor", "Collect", "Together", "Apart", "combine", "formula", "rewrite",
    "as_mutable", "as_immutable", "tomatrix", "full", "evalf", "vpa", "radcan", "map", "factorout", "Cancel", "FullForm",
    "as_explicit", "as_expr", "expand_trig", "apart", "densify", "sparsify", "Evaluate", "N", "sparse",
))  # fmt: skip
MADE_OF_FORMULAS = frozenset(("lambdify", "matlabFunction"))


class ScriptCalls(Calls):
    """``algebra``: differentiates and solves. ``by_module``: whether Function('f', [x], [y]) is casadi's."""

    def __init__(self, expressions: object, functions: dict[str, Local], follow: object, algebra: Algebra) -> None:
        super().__init__(expressions, functions, follow)  # type: ignore[arg-type]
        self.algebra = algebra
        self.brackets = "("  # of a call
        self.methods: dict[str, Callable[[list[Value], dict[str, Value]], Value]] = {
            "diff": self.diff, "Derivative": self.diff, "derivative": self.diff, "D": self.diff, "fulldiff": self.diff,
            "jacobian": self.jacobian, "Jacobian": self.jacobian, "gradient": self.gradient, "hessian": self.hessian,
            "subs": self.subs, "xreplace": self.subs, "substitute": self.subs, "msubs": self.subs,
            "Eq": self.equal, "Equality": self.equal,
            "solve": self.solve, "linsolve": self.solve, "Solve": self.solve, "nonlinsolve": self.solve,
            "linear_eq_to_matrix": self.matrices, "equationsToMatrix": self.matrices,
            "lambdify": self.made, "matlabFunction": self.made,
            "LagrangesMethod": self.lagranges_method, "euler_equations": self.euler_equations,
            "functionalDerivative": self.functional_derivative,
            "Function": self.function, "symbols": self.quantities, "Symbol": self.quantities, "var": self.quantities,
            "dynamicsymbols": self.moving_quantities, "jtimes": self.jtimes, "rhs": self.right, "lhs": self.left,
            "gradef": self.gradef, "NDSolve": self.integrated, "NDSolveValue": self.integrated,
            "ParametricNDSolve": self.integrated, "ParametricNDSolveValue": self.integrated, "EulerEquations": self.euler_equations,
            "time_derivative": self.time_derivative, "dt": self.time_derivative,
        }  # fmt: skip

    def call(self, node: nodes.Call, scope: Scope) -> Value:  # noqa: PLR0911 -- one for each kind
        """What a call comes to."""
        of, path = node.of, dotted(node.of)
        name = path.split(".")[-1] if path else of.name if isinstance(of, nodes.Member) else ""
        root = path.split(".")[0] if path else ""
        if isinstance(of, nodes.Word) and len(node.arguments) == 1 and scope.find(of.name) is None:
            counted = self.counted(of.name, node, scope)
            if counted is not None:
                return counted
        is_own = name in self.functions or (isinstance(of, nodes.Word) and scope.find(name) is not None)
        if is_own or not name:
            return super().call(node, scope)
        if name == "pairs·":
            return Several([])
        of_module = isinstance(of, nodes.Word) or self.is_module(root, scope)
        if name not in (*self.methods, *SAME, "sym", "zip", "enumerate"):
            found = self.of_record(of, name, node, scope) if not of_module else None
            return super().call(node, scope) if found is None else found
        if name == "Function" and len(node.arguments) >= 3:
            return self.function_of(node, scope)
        if name in ("zip", "enumerate"):
            return self.beside(name, self.given(node, scope))
        given = [] if of_module or name == "sym" else [self.expressions.value(of.of, scope)]  # type: ignore[union-attr]
        given += self.given(node, scope)
        if any(isinstance(g, Broken) for g in given):
            raise NotFollowed(next(g.why for g in given if isinstance(g, Broken)))
        if name == "sym":
            return self.quantities(given, {})
        if name in SAME and name not in self.methods:
            return given[0] if given else Several([])
        if name == "solve" and self.is_of_matrices(given):
            return self.known(name, given, node, scope)
        return self.methods[name](given, self.named(node, scope))

    def counted(self, name: str, node: nodes.Call, scope: Scope) -> Value | None:
        """x[1] of Mathematica: what it was set to, or a quantity with a number."""
        if self.brackets != "[" or name in self.functions:
            return None
        try:
            k = self.expressions.value(node.arguments[0], scope)
        except NotFollowed:
            return None
        if not isinstance(k, Formula) or k.whole is None or k.whole < 0:
            return None
        found = scope.find(f"{name}__{k.whole}")
        if isinstance(found, Broken):
            raise NotFollowed(found.why)
        if found is not None:
            return found
        said = self.algebra.known.defined.get(f"{name}[{k.whole}]", "")
        return Outside((said,)) if said.isidentifier() else Outside((f"{name}{k.whole}",))

    def is_module(self, root: str, scope: Scope) -> bool:
        """Whether a name in front of a dot is that of a module."""
        return (
            root in self.expressions.modules or root in ("me", "mechanics", "MX", "SX", "S", "physics")
        ) and scope.find(root) is None

    @staticmethod
    def is_of_matrices(given: list[Value]) -> bool:
        """np.linalg.solve(A, b), and not the solution of equations for names."""
        first = given[0] if given else None
        return isinstance(first, Array) and len(first.shape) == 2 and 1 not in first.shape and len(given) == 2 and any(
            mark_of(e) is None for e in entries_of(given[1])
        )  # fmt: skip

    def of_record(self, of: nodes.Node, name: str, node: nodes.Call, scope: Scope) -> Value | None:
        """LM.form_lagranges_equations(), LM.rhs(), eq.row(0)."""
        assert isinstance(of, nodes.Member)
        value = self.expressions.value(of.of, scope)
        if isinstance(value, Record) and "lagrangian" in value.fields:
            return self.algebra.of_method(value, name)
        if isinstance(value, Array) and name in ("row", "col") and len(node.arguments) == 1:
            k = self.given(node, scope)
            places = [k[0], nodes_all()] if name == "row" else [nodes_all(), k[0]]
            return self.expressions.entry(value, places, 0)
        return None

    def of_value(self, found: Value, node: nodes.Call, scope: Scope) -> Value:
        """theta(t): a function of time; f(x) of one that is made of formulas."""
        if isinstance(found, Outside) and len(node.arguments) == 1 and self.is_time(node.arguments[0], scope):
            return self.algebra.moves(found)
        if isinstance(found, Formula | Array) and len(node.arguments) == 1 and self.is_time(node.arguments[0], scope):
            return found
        return super().of_value(found, node, scope)

    def is_time(self, node: nodes.Node, scope: Scope) -> bool:
        """Whether an argument is the time."""
        if isinstance(node, nodes.Member):
            path = dotted(node)
            found = self.expressions.members.get(path) if path else None
        else:
            found = scope.find(node.name) if isinstance(node, nodes.Word) else None
        name = node.name if isinstance(node, nodes.Word) and found is None else ""
        return name in TIMES or (isinstance(found, Outside) and found.path[-1] in TIMES)

    def is_entry(self, name: str, node: nodes.Call, scope: Scope) -> bool:
        """Whether q(1) is an entry of what comes from outside; th(t) is none."""
        return not (len(node.arguments) == 1 and self.is_time(node.arguments[0], scope)) and super().is_entry(
            name, node, scope
        )

    def method(self, of: nodes.Member, name: str, path: str | None, node: nodes.Call, scope: Scope) -> Value:
        """v.dot(w) and v.norm() of columns."""
        if name in ("dot", "norm") and not self.is_module((path or "").split(".")[0], scope):
            given = [self.expressions.value(of.of, scope), *self.given(node, scope)]
            if name == "norm" and len(given) == 1:
                return Formula(f"sqrt({self.dot(given[0], given[0]).text})")
            if len(given) == 2 and self.are_vectors(given):
                return self.dot(given[0], given[1])
        return super().method(of, name, path, node, scope)

    @staticmethod
    def are_vectors(given: list[Value]) -> bool:
        """Whether two values are columns, or rows, of one length."""
        a, b = given
        return (
            isinstance(a, Array) and isinstance(b, Array) and a.shape == b.shape and a.is_vector and len(a.shape) == 2
        )

    def dot(self, a: Value, b: Value) -> Formula:
        """The sum of the products of the entries."""
        return library.total(
            Array([times(x, y) for x, y in zip(entries_of(a), entries_of(b), strict=True)], (len(entries_of(a)),))
        )

    def known(self, name: str, given: list[Value], node: nodes.Call, scope: Scope) -> Value:
        """th1(t) of MATLAB's syms th1(t), and functions of libraries."""
        if len(node.arguments) == 1 and isinstance(node.of, nodes.Word) and self.is_time(node.arguments[0], scope):
            return self.algebra.moves(Outside((name,)))
        if name == "dot" and len(given) == 2 and self.are_vectors(given):
            return self.dot(given[0], given[1])
        return super().known(name, given, node, scope)

    # symbols

    def quantities(self, given: list[Value], named: dict[str, Value]) -> Value:
        """symbols('m1 m2'), Symbol('t'), SX.sym('q', 2)."""
        first = given[0] if given else None
        if not isinstance(first, Words):
            raise NotFollowed("symbols without names in quotes")
        sizes = [f.whole for f in given[1:] if isinstance(f, Formula) and f.whole]
        names = self.algebra.names_in(first.text)
        if len(names) == 1 and sizes and 1 < (sizes[0] or 0) <= 16 and (len(sizes) < 2 or sizes[1] == 1):
            size = sizes[0] or 0
            return Array([Formula(Outside((names[0], k)).mark) for k in range(size)], (size,), "loose")
        made: list[Value] = [Outside((name,)) for name in names]
        return made[0] if len(made) == 1 else Several(made)

    def moving_quantities(self, given: list[Value], named: dict[str, Value]) -> Value:
        """dynamicsymbols('q1 q2', 1)"""
        first = given[0] if given else None
        if not isinstance(first, Words):
            raise NotFollowed("symbols without names in quotes")
        level = given[1] if len(given) > 1 else named.get("level")
        order = formula(level).whole if level is not None else 0
        if order is None:
            raise NotFollowed("dynamicsymbols of which order? Write the number")
        made: list[Value] = []
        for name in self.algebra.names_in(first.text):
            value: Value = self.algebra.moves(Outside((name,)))
            made.append(self.algebra.by_time(value, order))
        return made[0] if len(made) == 1 else Several(made)

    def function(self, given: list[Value], named: dict[str, Value]) -> Value:
        """Function('theta')"""
        return self.quantities(given[:1], named)

    def function_of(self, node: nodes.Call, scope: Scope) -> Value:
        """casadi's Function('f', [x, y], [z])."""
        made: list[tuple[Value, ...]] = []
        for one in node.arguments[1:3]:
            items = one.items if isinstance(one, nodes.Listed) else (one,)
            made.append(tuple(self.expressions.value(item, scope) for item in items))
        return Local((), Made(made[0], made[1], len(made[1]) == 1))

    def beside(self, name: str, given: list[Value]) -> Value:
        """zip(a, b), enumerate(a): what a loop over several names goes over."""
        columns = [self.expressions.parts(v) for v in given]
        lists = [c for c in columns if c is not None]
        if len(lists) < len(columns) or not lists:
            raise NotFollowed(f"{name} of something whose entries are not known; write the loop out")
        if name == "enumerate":
            lists = [[number(k) for k in range(len(lists[0]))], lists[0]]
        return Several([Several(list(row)) for row in zip(*lists, strict=False)])

    def made(self, given: list[Value], named: dict[str, Value]) -> Value:
        """lambdify((x, y), x*y)"""
        if len(given) < 2:
            raise NotFollowed("a function of formulas without its arguments; say them")
        arguments = self.expressions.parts(given[0])
        marks = [mark_of(e) for e in entries_of(given[0])]
        if len(set(marks)) < len(marks):
            raise NotFollowed("a function of formulas has one name twice")
        return Local((), Made(tuple(arguments if arguments is not None else [given[0]]), (given[1],), True))

    # derivatives

    def diff(self, given: list[Value], named: dict[str, Value]) -> Value:
        """diff(x, t), diff(x, t, 2), diff(L, q, t), diff(x, (t, 2))."""
        mark = mark_of(given[0]) if given else None
        if (
            mark is not None
            and mark.rstrip("'") in self.algebra.moving
            and (len(given) == 1 or (isinstance(given[1], Formula) and given[1].whole is not None))
        ):  # diff(th), diff(th, 2)
            return self.algebra.by_time(given[0], (formula(given[1]).whole or 0) if len(given) > 1 else 1)
        if len(given) < 2:
            raise NotFollowed("a derivative by what? Say it")
        value, by = given[0], list(given[1:])
        while by:
            one = by.pop(0)
            times = 1
            if isinstance(one, Several | Array) and len(entries_of(one)) == 2 and entries_of(one)[1].whole:
                first, second = entries_of(one)
                one, times = first, second.whole or 1
            elif by and isinstance(by[0], Formula) and by[0].whole is not None:
                times = by.pop(0).whole or 0  # type: ignore[union-attr]
            if isinstance(one, Array) and len(one.entries) > 1:
                value = self.algebra.gradient(value, one)
                continue
            for _ in range(times):
                value = self.algebra.diff(value, one)
        return value

    def time_derivative(self, given: list[Value], named: dict[str, Value]) -> Value:
        """x.dt()"""
        return self.algebra.by_time(given[0], 1)

    def gradef(self, given: list[Value], named: dict[str, Value]) -> Value:
        """Maxima's gradef(th, t, w): what th's rate is called."""
        if len(given) != 3 or mark_of(given[1]) not in TIMES or mark_of(given[0]) is None:
            raise NotFollowed("gradef of a name, the time, and its rate is followed")
        self.algebra.rates[mark_of(given[0]) or ""] = formula(given[2])
        return given[0]

    def integrated(self, given: list[Value], named: dict[str, Value]) -> Value:
        """NDSolve[{eq1, eq2, th[0] == 1}, …]: the equations of motion among these."""
        self.algebra.integrated.append(given[0])
        raise NotFollowed("what a solver gives back")

    def jacobian(self, given: list[Value], named: dict[str, Value]) -> Value:
        """Each entry's derivative by each quantity."""
        if len(given) != 2:
            raise NotFollowed("jacobian of what by what? Say both")
        return self.algebra.jacobian(given[0], given[1])

    def gradient(self, given: list[Value], named: dict[str, Value]) -> Value:
        """The derivatives of a number, as a column."""
        if len(given) != 2:
            raise NotFollowed("gradient of what by what? Say both")
        return self.algebra.gradient(given[0], given[1])

    def hessian(self, given: list[Value], named: dict[str, Value]) -> Value:
        """Second derivatives."""
        made = self.algebra.jacobian(self.algebra.gradient(given[0], given[1]), given[1])
        assert isinstance(made, Array)
        return Array(made.entries, made.shape, self.algebra.kind)

    def jtimes(self, given: list[Value], named: dict[str, Value]) -> Value:
        """casadi's derivative of x by q, times v."""
        made = self.algebra.jacobian(given[0], given[1])
        return self.expressions.combined("@", made, given[2])

    def subs(self, given: list[Value], named: dict[str, Value]) -> Value:
        """x.subs(a, b), x.subs({a: b}), x.subs([(a, b), …]), subs(x, [a b], [c d])."""
        return self.algebra.put_in(given)

    # equations

    def equal(self, given: list[Value], named: dict[str, Value]) -> Value:
        """Eq(a, b)"""
        return equation(given[0], given[1] if len(given) > 1 else Formula("0"))

    def right(self, given: list[Value], named: dict[str, Value]) -> Value:
        """rhs(eq), LM.rhs()"""
        if is_equation(given[0]) and isinstance(given[0], Record):
            return given[0].fields["rhs"]
        if isinstance(given[0], Record) and "lagrangian" in given[0].fields:
            return self.algebra.of_method(given[0], "rhs")
        if isinstance(given[0], Record) and "solution" in given[0].fields and len(given[0].fields) == 2:
            return given[0].fields["solution"]
        raise NotFollowed("the right side of something that is no equation")

    def left(self, given: list[Value], named: dict[str, Value]) -> Value:
        """lhs(eq)"""
        if is_equation(given[0]) and isinstance(given[0], Record):
            return given[0].fields["lhs"]
        raise NotFollowed("the left side of something that is no equation")

    def solve(self, given: list[Value], named: dict[str, Value]) -> Value:
        """solve([eq1, eq2], [a1, a2]): by names, and in their order."""
        if len(given) < 2:
            raise NotFollowed("equations are solved for what? Say it")
        unknown = given[1] if len(given) == 2 else Several(list(given[1:]))
        return self.algebra.solved(given[0], unknown)

    def matrices(self, given: list[Value], named: dict[str, Value]) -> Value:
        """A x = b of linear equations."""
        if len(given) < 2:
            raise NotFollowed("equations that are linear in what? Say it")
        matrix, right = self.algebra.matrices(given[0], given[1])
        return Several([matrix, right])

    def lagranges_method(self, given: list[Value], named: dict[str, Value]) -> Value:
        """LagrangesMethod(L, [q1, q2])"""
        if any(not _is_none(v) for k, v in named.items() if k not in ("frame", "bodies")) or len(given) < 2:
            raise NotFollowed("LagrangesMethod with forces or constraints; give the equations that it makes")
        return self.algebra.lagranges_method(given[0], given[1])

    def euler_equations(self, given: list[Value], named: dict[str, Value]) -> Value:
        """∂L/∂q - d/dt ∂L/∂q' = 0"""
        if len(given) < 2:
            raise NotFollowed("euler_equations of L, its functions and the time are followed")
        made = self.algebra.lagranges_equations(given[0], given[1])
        return Several([equation(negative(e), Formula("0")) for e in made.entries])

    def functional_derivative(self, given: list[Value], named: dict[str, Value]) -> Value:
        """MATLAB's functionalDerivative(L, q): ∂L/∂q - d/dt ∂L/∂q'."""
        made = self.algebra.lagranges_equations(given[0], given[1])
        entries = [negative(e) for e in made.entries]
        return Array(entries, (len(entries), 1)) if len(entries) > 1 else entries[0]


def _is_none(value: Value) -> bool:
    return isinstance(value, Words) and value.text == "None"


def nodes_all() -> Value:
    """Every place of an axis."""
    from ..traced.values import Reach

    return Reach(None, None)
