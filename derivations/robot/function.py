"""Accelerations that a Python function computes, from its text: it is followed line by line, and never run.

    def accelerations(state, m=0.1):
        x, theta, v, omega = state
        ...
        return a_x, a_theta

Assignments, arithmetic, sin, cos, tan and sign are followed, loops over ranges and lists whose length the text says,
and lists of lists; nothing else. Coordinates and rates come in the order of the joints: as one state, as two lists, or
each by itself.
"""

from __future__ import annotations

import ast
from typing import NoReturn, TypeAlias

from flint import fmpq

from ...models.errors import InvalidInput
from ..algebra.signs import without_squares
from ..algebra.trig import Formula
from ..dialects.names import plain_name
from ..reading.evaluation import Evaluation
from ..reading.matrices import Grid
from ..reading.nodes import Call, Name, Node, Number, Power, Product, Sum, Symbol

Value: TypeAlias = "Node | list[Value]"

LARGEST_TEXT = 20_000
MOST_NODES = 5_000
FUNCTIONS = {"sin": "sin", "cos": "cos", "tan": "tan", "sign": "sgn", "abs": "abs", "fabs": "abs"}
MODULES = ("math", "np", "numpy", "sympy", "sp", "jnp")
LISTS = ("array", "asarray", "stack", "hstack", "Matrix", "float")
GRAVITY = ("g", "gravity", "G")
LARGEST_EXPONENT = 12
MOST_ZEROS = 16
MOST_STEPS = 2_000  # statements and entries of lists, with loops as often as they run


def names_in_function(text: str) -> list[str]:
    """The names that it reads and never assigns, without those of modules."""
    tree = _tree(text)
    assigned = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
    read = [node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)]
    read += [node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)]
    return [name for name in dict.fromkeys(read) if name not in assigned and name not in MODULES]


def function_rows(text: str, evaluation: Evaluation, names: tuple[str, ...]) -> list[Formula]:
    """A row for each joint: its acceleration less what the function returns, without denominators."""
    tree = _tree(text)
    functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    if len(functions) != 1:
        raise InvalidInput(f"function: one function is needed, got {len(functions)}")
    follower = _Follower(evaluation, names)
    for statement in tree.body:
        if statement is not functions[0] and not isinstance(statement, ast.Import | ast.ImportFrom):
            follower.statement(statement)
    try:
        follower.parameters(functions[0])
        return follower.rows(follower.body(functions[0].body))
    except RecursionError:
        raise InvalidInput("function: an expression is nested too deeply") from None


def _tree(text: str) -> ast.Module:
    if len(text) > LARGEST_TEXT:
        raise InvalidInput(f"function: longer than {LARGEST_TEXT} characters")
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise InvalidInput(f"function: this is no Python: {error}") from None
    if sum(1 for _ in ast.walk(tree)) > MOST_NODES:
        raise InvalidInput("function: it is too long")
    return tree


def _fail(node: ast.AST, message: str) -> NoReturn:
    raise InvalidInput(f"function: line {getattr(node, 'lineno', 1)}: {message}")


class _Follower:
    """``here``: what each of the function's names stands for: an expression, or a list.

    ``made``: the lists that the function makes itself, whose entries it may change.
    """

    def __init__(self, evaluation: Evaluation, names: tuple[str, ...]) -> None:
        self.evaluation, self.n = evaluation, len(names)
        self.here: dict[str, Value] = {}
        self.made: list[list[Value]] = []
        self.count = self.steps = 0
        self.letters = {plain_name(name) or name: k for k, name in enumerate(names, 1)}

    def parameters(self, function: ast.FunctionDef) -> None:
        """Coordinates and rates, in the joints' order; others are constants, of the file or with a value here."""
        arguments = [argument.arg for argument in function.args.args if argument.arg != "self"]
        if function.args.vararg or function.args.kwarg:
            _fail(function, "parameters are needed by name, not *args or **kwargs")
        defaults = function.args.defaults
        for name, value in zip(arguments[len(arguments) - len(defaults) :], defaults, strict=True):
            if name not in self.evaluation.meaning.named:
                self.here[name] = self.expression(value)
        free = [name for name in arguments if name not in self.here and not self._is_constant(name)]
        used = {node.id for node in ast.walk(function) if isinstance(node, ast.Name)}
        free = [name for name in free if name in used or name not in ("t", "time")]  # as solvers of ODEs call it
        state: list[Node] = [Symbol(letter, k, 0) for letter in "tw" for k in range(1, self.n + 1)]
        listed = _listed(function, free)
        if len(free) == 1:
            self.here[free[0]] = [*state]
        elif len(free) == 2 and (self.n > 1 or listed):
            self.here |= {free[0]: [*state[: self.n]], free[1]: [*state[self.n :]]}
        elif len(free) == 2 * self.n:
            self.here |= dict(zip(free, state, strict=True))
        else:
            _fail(function, f"its parameters {', '.join(free) or '(none)'} are not {self.n} coordinates and {self.n} "
                            "rates; give constants among them a value in [symbols]")  # fmt: skip

    def _is_constant(self, name: str) -> bool:
        return name in GRAVITY or (plain_name(name) or name) in self.evaluation.meaning.named

    def body(self, statements: list[ast.stmt]) -> list[Node]:
        """What is returned."""
        for statement in statements:
            if isinstance(statement, ast.Return):
                if statement.value is None:
                    _fail(statement, "nothing is returned")
                found = self.value(statement.value)
                return [self._number(statement, x) for x in (found if isinstance(found, list) else [found])]
            self.statement(statement)
        raise InvalidInput("function: it returns nothing")

    def statement(self, statement: ast.stmt) -> None:
        """An assignment, a loop, or a remark in quotes."""
        self._step(statement)
        if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant):
            return
        if isinstance(statement, ast.For) and not statement.orelse:
            for value in self._values(statement.iter):
                self._assign(statement.target, value)
                for inner in statement.body:
                    self.statement(inner)
            return
        if isinstance(statement, ast.While):
            _fail(statement, "how often a while loop runs is not known from the text; write for i in range(…)")
        if isinstance(statement, ast.AugAssign) and isinstance(statement.target, ast.Name | ast.Subscript):
            before = ast.Subscript(statement.target.value, statement.target.slice, ast.Load()) if isinstance(
                statement.target, ast.Subscript) else ast.Name(statement.target.id, ast.Load())  # fmt: skip
            made = ast.copy_location(ast.BinOp(before, statement.op, statement.value), statement)
            self._assign(statement.target, self.expression(ast.fix_missing_locations(made)))
            return
        if isinstance(statement, ast.Expr) and self._appended(statement.value):
            return
        if isinstance(statement, ast.AnnAssign) and statement.value is not None:
            self._assign(statement.target, self.value(statement.value))
        elif isinstance(statement, ast.Assign) and len(statement.targets) == 1:
            self._assign(statement.targets[0], self.value(statement.value))
        else:
            what = type(statement).__name__
            _fail(statement, f"{what}: assignments, loops over ranges and one return are followed, and nothing else")

    def _step(self, node: ast.AST) -> None:
        self.steps += 1
        if self.steps > MOST_STEPS:
            _fail(node, f"more than {MOST_STEPS} steps, with loops as often as they run")

    def _appended(self, node: ast.expr) -> bool:
        """Whether it is x.append(…), of a list that the function made; then it is done."""
        match node:
            case ast.Call(func=ast.Attribute(value=ast.Name(id=name), attr="append"), args=[entry], keywords=[]):
                values = self.here.get(name)
                if isinstance(values, list) and any(values is own for own in self.made):
                    values.append(self.value(entry))
                    return True
        return False

    def _values(self, node: ast.expr) -> list[Value]:
        """What a loop runs over: a range, a list, or several of them side by side."""
        called = _called(node) if isinstance(node, ast.Call) and not node.keywords else ""
        arguments = node.args if isinstance(node, ast.Call) else []
        if called == "range" and 1 <= len(arguments) <= 3:
            bounds = [self._whole(x) for x in arguments]
            if None not in bounds and bounds[2:] != [0]:
                numbers = range(*[bound for bound in bounds if bound is not None])
                if len(numbers) <= MOST_STEPS:
                    return [Number(fmpq(k), 0) for k in numbers]
            _fail(node, "the bounds of this range are not known from the text, or too far apart")
        if called == "enumerate" and len(arguments) == 1:
            return [[Number(fmpq(k), 0), value] for k, value in enumerate(self._values(arguments[0]))]
        if called == "zip" and arguments:
            return [[*values] for values in zip(*map(self._values, arguments), strict=False)]
        found = self.value(node)
        return found if isinstance(found, list) else _fail(node, "a range or a list is needed here")

    def _made(self, values: list[Value]) -> list[Value]:
        self.made.append(values)
        return values

    def _number(self, node: ast.AST, value: Value) -> Node:
        return value if not isinstance(value, list) else _fail(node, "a list stands where a number is needed")

    def _entries(self, node: ast.ListComp | ast.GeneratorExp, generators: list[ast.comprehension]) -> list[Value]:
        """The entries of a list that a loop makes."""
        if not generators:
            self._step(node)
            return [self.value(node.elt)]
        first, *others = generators
        if first.ifs or first.is_async:
            _fail(node, "a condition in a list is not followed")
        kept, found = dict(self.here), []
        for value in self._values(first.iter):
            self._assign(first.target, value)
            found += self._entries(node, others)
        self.here = kept
        return found

    def _entry(self, node: ast.Subscript) -> Value | None:
        """An entry of a list: x[i], x[i, j], x[i][j]; None where there is none."""
        values: Value | None = self.value(node.value)
        for place in node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]:
            index = self._whole(place)
            if not isinstance(values, list) or index is None or not -len(values) <= index < len(values):
                return None
            values = values[index]
        return values

    def _put(self, target: ast.Subscript, value: Value) -> None:
        """x[i] = …, of a list that the function made."""
        places = target.slice.elts if isinstance(target.slice, ast.Tuple) else [target.slice]
        values = self.value(target.value)
        for place in places:
            index = self._whole(place)
            own = isinstance(values, list) and any(values is x for x in self.made)
            if not isinstance(values, list) or not own or index is None or not -len(values) <= index < len(values):
                _fail(target, "this entry is not followed; only those of lists that the function makes are changed")
            if place is places[-1]:
                values[index] = value if isinstance(value, list) else self._named(value)
            else:
                values = values[index]

    def _whole(self, node: ast.expr | None) -> int | None:
        """A whole number that is known from the text, as a loop's variable."""
        match node:
            case ast.Name(id=name):
                value = self.here.get(name)
                return int(value.value.p) if isinstance(value, Number) and value.value.q == 1 else None
            case ast.Call() if _called(node) == "len" and len(node.args) == 1:
                values = self.value(node.args[0])
                return len(values) if isinstance(values, list) else None
            case ast.BinOp(left=left, op=ast.Add() | ast.Sub() | ast.Mult() | ast.FloorDiv() | ast.Mod(), right=right):
                one, other = self._whole(left), self._whole(right)
                if one is None or other is None or max(abs(one), abs(other)) > MOST_STEPS:
                    return None
                return _calculated(node, one, other)
        return _whole(node)

    def _assign(self, target: ast.expr, value: Value) -> None:
        if isinstance(target, ast.Name):
            self.here[target.id] = value if isinstance(value, list) else self._named(value)
        elif isinstance(target, ast.Tuple | ast.List) and isinstance(value, list):
            if len(target.elts) != len(value):
                _fail(target, f"{len(target.elts)} names for {len(value)} values")
            for one, part in zip(target.elts, value, strict=True):
                self._assign(one, part)
        elif isinstance(target, ast.Subscript):
            self._put(target, value)
        else:
            _fail(target, "this is not followed on the left of an assignment")

    def _named(self, node: Node) -> Node:
        """Worked out once, however often it stands in what follows."""
        if isinstance(node, Symbol | Number | Name):
            return node
        self.count += 1
        name = f"line {self.count}"  # no name of an author's
        self.evaluation.definitions[name] = node
        return Name(name, node.at)

    def value(self, node: ast.expr) -> Value:  # noqa: PLR0911 -- one for each kind
        """An expression, or several."""
        if isinstance(node, ast.Tuple | ast.List):
            return self._made([self.value(part) for part in node.elts])
        if isinstance(node, ast.ListComp):
            return self._made(self._entries(node, node.generators))
        if isinstance(node, ast.Name) and isinstance(self.here.get(node.id), list):
            return self.here[node.id]
        if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Slice):
            values, part = self.value(node.value), node.slice
            if isinstance(values, list) and part.step is None:
                return values[slice(self._whole(part.lower), self._whole(part.upper))]
        if isinstance(node, ast.Subscript):
            entry = self._entry(node)
            if entry is not None:
                return entry
        if isinstance(node, ast.Call) and _called(node) in LISTS and len(node.args) == 1:
            found = self.value(node.args[0])
            return self._made([*found]) if isinstance(found, list) else found
        if isinstance(node, ast.Call) and _called(node) == "zeros" and len(node.args) == 1:
            return self._zeros(node, node.args[0])
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult) and isinstance(node.left, ast.List):
            count, values = self._whole(node.right), [self.value(part) for part in node.left.elts]
            if count is not None and count * len(values) <= MOST_STEPS:
                return self._made(values * count)
        return self.expression(node)

    def _zeros(self, node: ast.AST, shape: ast.expr) -> list[Value]:
        sizes = [self._whole(x) for x in (shape.elts if isinstance(shape, ast.Tuple) else [shape])]
        if len(sizes) > 2 or any(size is None or not 0 <= size <= MOST_ZEROS for size in sizes):
            _fail(node, f"zeros of one or two sizes that are known from the text, up to {MOST_ZEROS}")
        rows, *columns = [size for size in sizes if size is not None]
        zero = Number(fmpq(0), 0)
        return self._made([self._made([zero] * columns[0]) if columns else zero for _ in range(rows)])

    def expression(self, node: ast.expr) -> Node:  # noqa: PLR0911, PLR0912 -- one for each kind
        """A number's expression."""
        at = node.col_offset
        match node:
            case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
                return Number(_exact(node, number), at)
            case ast.Name(id=name):
                return self._name(node, name)
            case ast.UnaryOp(op=ast.USub() | ast.UAdd(), operand=operand):
                return Sum(((-1 if isinstance(node.op, ast.USub) else 1, self.expression(operand)),), at)
            case ast.BinOp(left=left, op=ast.Add() | ast.Sub(), right=right):
                sign = -1 if isinstance(node.op, ast.Sub) else 1
                return Sum(((1, self.expression(left)), (sign, self.expression(right))), at)
            case ast.BinOp(left=left, op=ast.Mult() | ast.Div(), right=right):
                above = isinstance(node.op, ast.Mult)
                return Product(((True, self.expression(left)), (above, self.expression(right))), at)
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return Power(self.expression(left), self._exponent(right), at)
            case ast.Call() if _called(node) in FUNCTIONS and len(node.args) == 1:
                return Call(FUNCTIONS[_called(node)], self.expression(node.args[0]), at)
            case ast.Call() if _called(node) == "square" and len(node.args) == 1:
                return Power(self.expression(node.args[0]), 2, at)
            case ast.Call() if _called(node) == "float" and len(node.args) == 1:
                return self.expression(node.args[0])
            case ast.Call() if _called(node) == "sum" and len(node.args) == 1:
                return self._sum(node.args[0])
            case ast.Subscript():
                entry = self._entry(node)
                if entry is not None:
                    return self._number(node, entry)
            case ast.Attribute(value=ast.Name(id="self"), attr=name):
                return self._name(node, name)
        _fail(node, f"{ast.unparse(node)[:60]!r} is not followed; arithmetic, sin, cos, tan and the sign of a rate are")

    def _sum(self, node: ast.expr) -> Node:
        values = self._entries(node, node.generators) if isinstance(node, ast.GeneratorExp) else self._values(node)
        parts = tuple((1, self._number(node, value)) for value in values)
        return Sum(parts, node.col_offset) if parts else Number(fmpq(0), node.col_offset)

    def _name(self, node: ast.expr, name: str) -> Node:
        if name in self.here:
            found = self.here[name]
            return found if not isinstance(found, list) else _fail(node, f"{name} is a list where a number is needed")
        plain = plain_name(name) or name
        if plain in self.evaluation.meaning.named:
            return Name(plain, node.col_offset)
        if name in GRAVITY:
            return Symbol("g", 0, node.col_offset)
        if plain in self.letters:
            return Symbol("t", self.letters[plain], node.col_offset)
        _fail(node, f"{name!r} is not known; give it a value in [symbols]")

    def _exponent(self, node: ast.expr) -> int:
        value = self._whole(node)
        if value is None or abs(value) > LARGEST_EXPONENT:
            _fail(node, f"a power that is no whole number up to {LARGEST_EXPONENT}")
        return value

    def rows(self, returned: list[Node]) -> list[Formula]:
        """a_k less the k-th number returned; where as many rates come first, these must be the rates."""
        if len(returned) == 2 * self.n:
            for k, node in enumerate(returned[: self.n], 1):
                rate = Sum(((1, node), (-1, Symbol("w", k, 0))), 0)
                if self.evaluation.scalar(rate).numerator:
                    raise InvalidInput(f"function: number {k} of what it returns is not the rate of coordinate {k}")
            returned = returned[self.n :]
        if len(returned) != self.n:
            raise InvalidInput(f"function: it returns {len(returned)} numbers; {self.n} accelerations are needed, or "
                               f"{self.n} rates before them")  # fmt: skip
        found = []
        for k, node in enumerate(returned, 1):
            value = self.evaluation.value(Sum(((1, Symbol("a", k, 0)), (-1, node)), 0))
            assert not isinstance(value, Grid)  # no matrix is followed
            found.append(without_squares(self.evaluation.space, value.numerator))
        return found


def _listed(function: ast.FunctionDef, names: list[str]) -> bool:
    """Whether a parameter is unpacked or has an index."""
    for node in ast.walk(function):
        unpacks = isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Tuple | ast.List)
        if unpacks or isinstance(node, ast.Subscript):
            value = node.value  # type: ignore[attr-defined]
            if isinstance(value, ast.Name) and value.id in names:
                return True
    return False


def _called(node: ast.Call) -> str:
    """The name of a function, with or without its module."""
    if isinstance(node.func, ast.Attribute) and isinstance(node.func.value, ast.Name):
        return node.func.attr if node.func.value.id in MODULES else ""
    return node.func.id if isinstance(node.func, ast.Name) else ""


def _calculated(node: ast.BinOp, one: int, other: int) -> int | None:
    match node.op:
        case ast.Add():
            return one + other
        case ast.Sub():
            return one - other
        case ast.Mult():
            return one * other
        case ast.FloorDiv() if other:
            return one // other
        case ast.Mod() if other:
            return one % other
    return None


def _whole(node: ast.expr | None) -> int | None:
    match node:
        case ast.Constant(value=int() as number) if not isinstance(number, bool):
            return number
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() as number)):
            return -number
    return None


def _exact(node: ast.expr, number: float) -> fmpq:
    """A number as it is printed: 9.81 is 981/100."""
    text = repr(number)
    mantissa, _, exponent = text.lower().partition("e")
    if not mantissa.replace(".", "").isdigit() or abs(int(exponent or 0)) > 40 or len(mantissa) > 40:
        _fail(node, f"the number {text[:30]} is not read")
    whole, _, decimals = mantissa.partition(".")
    shift = int(exponent or 0) - len(decimals)
    value = fmpq(int(whole + decimals))
    return value * (fmpq(10**shift) if shift >= 0 else fmpq(1, 10**-shift))
