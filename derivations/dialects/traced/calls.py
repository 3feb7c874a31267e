"""Functions that a program calls: those of its text are followed, those of numpy and its kin are known."""

from __future__ import annotations

from collections.abc import Callable

from . import library, nodes
from .arrays import determinant, entrywise, product, spread, turned, vector
from .expressions import LONGEST_STATE, Expressions
from .names import Scope
from .nodes import dotted
from .values import (
    SCALAR,
    Array,
    Broken,
    Formula,
    Local,
    NotFollowed,
    Outside,
    Reach,
    Several,
    Value,
    Words,
    formula,
    number,
    power,
)

Body = Callable[[Local, list[Value], dict[str, Value]], Value]
UNKNOWN = frozenset((
    "rand", "randn", "random", "normal", "uniform", "interp1", "clip", "saturate", "min", "max", "minimum", "maximum",
    "where", "heaviside", "mod", "fmod", "atan2", "arctan2", "round", "floor",
))  # fmt: skip
TYPES = frozenset((
    "self", "obj", "this",
))  # fmt: skip


class Calls:
    """``follow``: follows a function of the text; ``functions``: those, by name."""

    def __init__(self, expressions: Expressions, functions: dict[str, Local], follow: Body) -> None:
        self.expressions, self.functions, self.follow = expressions, functions, follow
        self.unknown = 0

    def call(self, node: nodes.Call, scope: Scope) -> Value:  # noqa: PLR0911 -- one for each kind
        """What a call comes to; in MATLAB an entry, where its name is no function's."""
        of, path = node.of, dotted(node.of)
        name = path.split(".")[-1] if path else of.name if isinstance(of, nodes.Member) else ""
        if isinstance(of, nodes.Nameless):
            return self.follow(Local(of.parameters, of), self.given(node, scope), {})
        if isinstance(of, nodes.Word):
            found = scope.find(of.name)
            if found is not None:
                return self.of_value(found, node, scope)
            if of.name in self.functions:
                return self.follow(self.functions[of.name], self.given(node, scope), self.named(node, scope))
            if self.is_entry(of.name, node, scope):
                return self.expressions.entry(Outside((of.name,)), self.given(node, scope), 1)
            return self.of_time(of.name, node) or self.known(of.name, self.given(node, scope), node, scope)
        if isinstance(of, nodes.Member):
            return self.method(of, name, path, node, scope)
        return self.of_value(self.expressions.value(of, scope), node, scope)

    def of_time(self, name: str, node: nodes.Call) -> Value | None:
        """f(t) of a drive f, or of what [define] says: whatever it is of time, it is that quantity."""
        if len(node.arguments) != 1 or node.arguments[0] not in (nodes.Word("t"), nodes.Word("time")):
            return None
        known = self.expressions.names.known
        if known.defined.get(f"{name}(t)", name).strip() != name:
            return Outside((f"{name}(t)",))
        return Outside((name,)) if name in known.drives else None

    def is_entry(self, name: str, node: nodes.Call, scope: Scope) -> bool:
        """Whether q(1) is an entry of what comes from outside."""
        if not self.expressions.matlab or name in (*library.WAVES, *library.EMPTY):
            return False
        while scope.around is not None and name not in scope.parameters:
            scope = scope.around
        plain = all(
            isinstance(a, nodes.Number | nodes.Span | nodes.Binary) or _counts(a, scope) for a in node.arguments
        )
        return plain and bool(node.arguments) and (name in scope.parameters or not _is_known(name))

    def of_value(self, found: Value, node: nodes.Call, scope: Scope) -> Value:
        """A local function, or an entry of a local value."""
        if isinstance(found, Broken):
            raise NotFollowed(found.why)
        if isinstance(found, Local):
            return self.follow(found, self.given(node, scope), self.named(node, scope))
        if isinstance(found, Outside) and not self.expressions.matlab:
            return Outside((*found.path, f"({len(node.arguments)})"))
        if self.expressions.matlab:
            return self.expressions.entry(found, self.given(node, scope), 1)
        raise NotFollowed("something is called that is no function of this text")

    def method(  # noqa: PLR0911 -- one for each kind
        self, of: nodes.Member, name: str, path: str | None, node: nodes.Call, scope: Scope
    ) -> Value:
        """np.sin(x), self.f(x), M.dot(v), M.inv()."""
        root = path.split(".")[0] if path else ""
        if root in self.expressions.modules and scope.find(root) is None:
            return self.known(name, self.given(node, scope), node, scope)
        if root in (*TYPES, "cls") and path is not None and path.count(".") == 1 and name in self.functions:
            return self.follow(self.functions[name], self.given(node, scope), self.named(node, scope))
        if path is not None and path in self.expressions.members:
            return self.of_value(self.expressions.members[path], node, scope)
        receiver = self.expressions.value(of.of, scope)
        if isinstance(receiver, Outside) and name in self.functions:
            return self.follow(self.functions[name], self.given(node, scope), self.named(node, scope))
        if isinstance(receiver, Outside) and self.expressions.matlab and name not in library.SAME:
            return self.expressions.entry(Outside((*receiver.path, name)), self.given(node, scope), 1)
        if name in ("T", "transpose"):
            return turned(receiver)
        if name in library.PRODUCTS:
            return product(receiver, self.given(node, scope)[0])
        if name in library.SOLVES and isinstance(receiver, Array):
            return self.expressions.solved(receiver, self.given(node, scope)[0])
        if name == "get" and isinstance(receiver, Outside):
            return self.expressions.outside(receiver, self.given(node, scope)[:1], 0)
        scalar = name in (*library.WAVES, "pow", "square")
        if (
            isinstance(receiver, Outside)
            and name not in library.SAME
            and name not in ("reshape", "unsqueeze")
            and not scalar
        ):
            return Outside((*receiver.path, f"{name}()"))
        if name in ("reshape", "unsqueeze", "view"):
            return self.reshaped(receiver, self.given(node, scope))
        return self.known(name, [receiver, *self.given(node, scope)], node, scope)

    def reshaped(self, value: Value, sizes: list[Value]) -> Value:
        """A vector as a column or a row."""
        if not isinstance(value, Array):
            return value
        given = (
            sizes[0].entries if sizes and isinstance(sizes[0], Array) else [s for s in sizes if isinstance(s, Formula)]
        )
        shape = [f.whole for f in given]
        n = len(value.entries)
        if shape in ([-1], [n]):
            return Array(list(value.entries), (n,))
        if shape in ([-1, 1], [n, 1]):
            return Array(list(value.entries), (n, 1), value.kind)
        if shape in ([1, -1], [1, n]):
            return Array(list(value.entries), (1, n), value.kind)
        if len(shape) == 2 and None not in shape and shape[0] * shape[1] == n and not self.expressions.matlab:  # type: ignore[operator]
            return Array(list(value.entries), (shape[0], shape[1]), value.kind)  # type: ignore[arg-type]
        raise NotFollowed("reshape to this shape; write out the array")

    def given(self, node: nodes.Call, scope: Scope) -> list[Value]:
        """The arguments."""
        made: list[Value] = []
        for argument in node.arguments:
            value = self.expressions.value(argument, scope)
            parts = (
                self.expressions.parts(value) if isinstance(argument, nodes.Unary) and argument.sign == "*" else None
            )
            if isinstance(argument, nodes.Unary) and argument.sign == "*":
                if parts is None and isinstance(value, Outside):
                    parts = []  # *args: parameters by their names
                made += parts or []
            else:
                made.append(value)
        return made

    def named(self, node: nodes.Call, scope: Scope) -> dict[str, Value]:
        """Arguments by name."""
        return {name: self.expressions.value(value, scope) for name, value in node.named if name}

    def known(self, name: str, given: list[Value], node: nodes.Call, scope: Scope) -> Value:  # noqa: PLR0911, PLR0912, PLR0915
        """A function of numpy, MATLAB and their kin."""
        expressions = self.expressions
        for value in given:
            if isinstance(value, Broken):
                raise NotFollowed(value.why)
        if name in (*library.WAVES, "fabs", "absolute", "Abs", "sind", "cosd") and len(given) >= 1:
            if name in ("sind", "cosd"):
                raise NotFollowed(f"{name}: degrees; angles are in radians here")
            return library.wave(name, given[0])
        if name in library.MADE and given:
            kind = (
                "matrix"
                if name in ("matrix", "mat", "asmatrix", "Matrix", "ImmutableMatrix", "MutableDenseMatrix")
                else "array"
            )
            if name.endswith("Matrix") and len(given) == 3:
                return library.by_sizes(given, kind)
            return self.matrix(name, library.as_array(given[0], kind), kind)
        if name in library.EMPTY:
            return self.empty(name, given)
        if name in library.JOINED:
            return self.joined(name, given, node, scope)
        if name in library.PRODUCTS and len(given) >= 2:
            return product(library.as_array(given[0]), library.as_array(given[1]))
        if name in library.INVERSES and given:
            return expressions.inverted(library.as_array(given[0]))
        if name in library.SOLVES and len(given) >= 2:
            matrix = library.as_array(given[0])
            if not isinstance(matrix, Array):
                raise NotFollowed(f"{name} of a matrix that is not in this text; say it in [define]")
            found = expressions.solved(matrix, library.as_array(given[1]))
            return Several([found]) if name == "lstsq" else found
        if name == "det" and given:
            matrix = library.as_array(given[0])
            return determinant(matrix) if isinstance(matrix, Array) else formula(matrix)
        if name == "adjoint" and given:
            raise NotFollowed("adjoint: write out the matrix, or inv(…)")
        if name in ("pow", "power", "float_power") and len(given) == 2:
            return entrywise(given[0], given[1], power)
        if name == "square" and given:
            return library.squared(given[0])
        if name in ("transpose", "t") and given:
            return turned(library.as_array(given[0]))
        if (
            name in ("add", "subtract", "multiply", "divide", "true_divide", "times", "plus", "minus", "rdivide")
            and len(given) == 2
        ):
            sign = {"add": "+", "plus": "+", "subtract": "-", "minus": "-", "multiply": "*", "times": "*"}.get(
                name, "/"
            )
            return entrywise(given[0], given[1], SCALAR[sign])
        if name in ("negative", "uminus") and given:
            return expressions.combined("*", number(-1), given[0])
        if name in ("diag", "diagflat") and given:
            return library.diagonal(library.as_array(given[0]))
        if name == "sum" and given:
            return library.total(library.as_array(given[0]))
        if name in ("reshape",) and given:
            return self.reshaped(library.as_array(given[0]), given[1:])
        if name == "expand_dims" and given:
            return self.spread(given[0], [*given[1:], *self.named(node, scope).values()])
        if name == "unsqueeze" and given:
            return given[0]
        if name in ("split", "chunk") and len(given) == 2 and isinstance(given[0], Outside):
            return self.halves(name, given[0], given[1], dotted(node.of) or "")
        if name == "deal":
            return Several(given) if len(given) > 1 else given[0]
        if name in ("len", "length", "numel", "size"):
            return self.length(given, name)
        if name == "range":
            return self.reach(given)
        if name == "int" and given:
            return given[0]
        if name in ("Rational", "Fraction") and len(given) == 2:
            return SCALAR["/"](formula(given[0]), formula(given[1]))
        if name in ("S", "Integer", "sympify") and given and not isinstance(given[0], Words):
            return given[0]
        if name == "sincos" and given:
            return Several([library.wave("sin", given[0]), library.wave("cos", given[0])])
        if name in ("radians", "deg2rad", "degrees", "rad2deg"):
            raise NotFollowed(f"{name}: angles are in radians here; leave it out")
        if name in library.SAME and given:
            return library.as_array(given[0]) if not isinstance(given[0], Outside) else given[0]
        if name in ("MX", "SX", "sym", "symbols", "dynamicsymbols", "variable", "parameter"):
            return self.symbols(given)
        if name in ("max", "min") and len(given) > 1:
            numbers = [f.whole for f in given if isinstance(f, Formula)]
            if len(numbers) == len(given) and None not in numbers:
                known_numbers = [k for k in numbers if k is not None]
                return number(max(known_numbers) if name == "max" else min(known_numbers))
        if name in UNKNOWN:
            raise NotFollowed(f"{name}(…) is no part of equations of motion here; leave it out")
        self.unknown += 1
        return Outside((f"{name}({self.unknown})",))

    def spread(self, value: Value, axes: list[Value]) -> Array:
        """np.expand_dims(x, 1); x from outside has as many entries as [define] says."""
        if isinstance(value, Outside):
            said = [k for k in range(LONGEST_STATE) if f"{value.path[-1]}[{k}]" in self.expressions.names.known.defined]
            if not said or said != list(range(len(said))):
                raise NotFollowed(f"{value.path[-1]}: how many entries it has is not said; write them out")
            value = Array([Formula(Outside((*value.path, k)).mark) for k in said], (len(said),))
        if not isinstance(value, Array) or len(axes) != 1:
            raise NotFollowed("an axis more of something that is no vector; write out its entries")
        return spread(value, formula(axes[0]).whole or 0)

    def halves(self, name: str, state: Outside, count: Value, path: str) -> Value:
        """np.split(state, 2), torch.chunk(state, 2): its two halves. torch.split counts entries, not parts."""
        size = self.expressions.size
        parts = count.whole if isinstance(count, Formula) else None
        counts_parts = name == "chunk" or path.startswith(("np.", "numpy.", "jnp.", "anp.", "onp."))
        if parts != 2 or not (counts_parts or size == 2 * parts):
            raise NotFollowed(f"{name} into other parts than halves of the state; write x[:2], x[2:]")
        half = size // 2
        first = Array([Formula(Outside((*state.path, k)).mark) for k in range(half)], (half,), "loose")
        second = Array([Formula(Outside((*state.path, k)).mark) for k in range(half, size)], (half,), "loose")
        return Several([first, second])

    def matrix(self, name: str, value: Value, kind: str) -> Value:
        """sympy's Matrix of a list is a column; numpy's a row."""
        if name.endswith("Matrix") and isinstance(value, Array) and len(value.shape) == 2 and value.shape[0] == 1:
            return Array(value.entries, (len(value.entries), 1), kind)
        if isinstance(value, Several):
            raise NotFollowed("an array whose rows are of different length, or hold something else than numbers")
        return value

    def empty(self, name: str, given: list[Value]) -> Value:
        """np.zeros(4), zeros(2), np.zeros_like(x)."""
        first = given[0] if given else None
        if name.endswith("_like") or (isinstance(first, Outside) and len(given) == 1):
            if isinstance(first, Array):
                return library.empty(name, first.shape)
            made = library.empty(name, (self.expressions.size,))
            made.is_state = True
            return made
        shape = library.sizes(given)
        if shape is None:
            size = self.expressions.size
            if any(isinstance(a, Formula) and a.whole == size for a in given) or isinstance(first, Several | Outside):
                made = library.empty(name, (size,))
                made.is_state = True
                return made
            raise NotFollowed(f"{name}: of what shape? Write the numbers")
        if len(shape) == 1 and (self.expressions.matlab or name in ("eye", "identity")):
            shape = (shape[0], shape[0])
        if len(shape) == 2 and name in ("eye", "identity") and shape[0] != shape[1]:
            raise NotFollowed(f"{name} that is not square")
        made = library.empty(name, shape)
        if (
            self.expressions.matlab
            and len(shape) == 2
            and 1 not in shape
            and shape[0] == shape[1] == self.expressions.size
        ):
            made = library.empty(name, (shape[0], 1)) if name == "zeros" and len(given) == 1 else made
        return made

    def joined(self, name: str, given: list[Value], node: nodes.Call, scope: Scope) -> Value:
        """np.concatenate((a, b)), ca.vertcat(a, b), np.append(a, b)."""
        axis = next(
            (v.whole for k, v in self.named(node, scope).items() if k in ("axis", "dim") and isinstance(v, Formula)),
            None,
        )
        parts = given
        if name not in ("vertcat", "horzcat", "append", "veccat") and given:
            first = self.expressions.parts(given[0])
            parts = first if first is not None else given
            if axis is None and len(given) > 1 and isinstance(given[1], Formula):
                axis = given[1].whole
        parts = [self.said_vector(part) for part in parts]
        if name == "cat" and self.expressions.matlab:
            axis, parts = (formula(given[0]).whole or 1) - 1, given[1:]
        return library.joined(name, parts, axis)

    def said_vector(self, value: Value) -> Value:
        """q_dot as a vector, where [define] says what 'q_dot[0]' and 'q_dot[1]' are."""
        if not isinstance(value, Outside):
            return value
        said = self.expressions.names.known.defined
        count = next(k for k in range(LONGEST_STATE + 1) if f"{value.path[-1]}[{k}]" not in said)
        return vector(value, count) if count > 1 else value

    def length(self, given: list[Value], name: str) -> Value:
        """len(y)"""
        first = given[0] if given else None
        if isinstance(first, Array):
            if name == "size":
                return Array([number(k) for k in first.shape], (len(first.shape),))
            return number(first.shape[0] if name == "len" else len(first.entries))
        if isinstance(first, Several):
            return number(len(first.items))
        if isinstance(first, Outside):
            return Outside((*first.path, "size")) if name == "size" else number(self.expressions.size)
        raise NotFollowed(f"{name} of something that is no list")

    def reach(self, given: list[Value]) -> Value:
        """range(a, b, c)"""
        ends = [f.whole for f in given if isinstance(f, Formula)]
        if not ends or None in ends or len(ends) != len(given):
            raise NotFollowed("range of something else than whole numbers; write the loop out")
        numbers = [k for k in ends if k is not None]
        first, last = (0, numbers[0]) if len(numbers) == 1 else (numbers[0], numbers[1])
        return Reach(first, last, numbers[2] if len(numbers) == 3 and numbers[2] else 1)

    def symbols(self, given: list[Value]) -> Value:
        """SX.sym('x'), symbols('m1 m2'): quantities by the names in quotes."""
        first = given[0] if given else None
        if not isinstance(first, Words):
            raise NotFollowed("symbols without names in quotes")
        names = first.text.replace(",", " ").split()
        sizes = [f.whole for f in given[1:] if isinstance(f, Formula)]
        if len(names) == 1:
            if sizes and sizes[0] and 1 < sizes[0] <= 16:
                return Outside((names[0],))
            return Outside((names[0],))
        return Several([Outside((name,)) for name in names])


def _counts(node: nodes.Node, scope: Scope) -> bool:
    """Whether a name stands for a whole number here."""
    value = scope.find(node.name) if isinstance(node, nodes.Word) else None
    return isinstance(value, Formula) and value.whole is not None


def _is_known(name: str) -> bool:
    """Whether a name is a function's of a library."""
    return name in {
        *library.WAVES, *library.MADE, *library.EMPTY, *library.JOINED, *library.PRODUCTS, *library.INVERSES,
        *library.SOLVES, *library.SAME, "det", "pow", "power", "square", "transpose", "diag", "sum", "reshape", "deal",
        "length", "numel", "size", "range", "times", "plus", "minus", "rdivide", "deg2rad", "sym", "exp", "log",
        "sind", "cosd", *UNKNOWN,
    }  # fmt: skip
