"""What an expression of a program comes to, as formulas. Nothing is run."""

from __future__ import annotations

from collections.abc import Callable
from operator import eq, ge, gt, le, lt, ne

from . import nodes
from .arrays import entrywise, product, turned
from .known import GRAVITY
from .library import MODULES, as_array, from_items, reach, stacked
from .names import Names, Scope
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
    Record,
    Several,
    Value,
    Words,
    formula,
    negative,
    number,
)

Caller = Callable[[nodes.Call, Scope], Value]
Member = Callable[[str, Scope], "Value | None"]
COMPARED: dict[str, Callable[[int, int], bool]] = {
    "==": eq, "!=": ne, "~=": ne, "<": lt, "<=": le, ">": gt, ">=": ge,
    "&&": lambda a, b: bool(a and b), "||": lambda a, b: bool(a or b),
    "&": lambda a, b: bool(a and b), "|": lambda a, b: bool(a or b),
}  # fmt: skip
NUMBERS = {"pi": "pi", "PI": "pi", "Pi": "pi"}
LONGEST_STATE = 16


class Expressions:
    """``matlab``: indices count from 1, and * multiplies matrices; ``calls``: what does a function's work."""

    def __init__(self, names: Names, *, matlab: bool, calls: Caller, free: Member) -> None:
        self.names, self.matlab, self.calls, self.free = names, matlab, calls, free
        self.size = 2 * len(names.known.coordinates)
        self.members: dict[str, Value] = {}
        self.modules: frozenset[str] = MODULES
        self.entered: set[tuple[str | int, ...]] = set()  # whose entries are read

    def value(self, node: nodes.Node, scope: Scope) -> Value:  # noqa: PLR0911, PLR0912 -- one for each kind
        """What an expression stands for."""
        match node:
            case nodes.Number(text=text):
                return Formula(_plain(text))
            case nodes.Text(text=text):
                return Words(text)
            case nodes.Word(name=name):
                return self.word(name, scope)
            case nodes.Member():
                return self.member(node, scope)
            case nodes.At(of=of, places=places):
                return self.entry(self.value(of, scope), [self.value(p, scope) for p in places], 0)
            case nodes.Call():
                return self.calls(node, scope)
            case nodes.Unary(sign="*", of=of):
                return self.value(of, scope)
            case nodes.Unary(sign=sign, of=of):
                value = self.value(of, scope)
                if sign == "+":
                    return value
                if isinstance(value, Array):
                    return Array([negative(e) for e in value.entries], value.shape, value.kind)
                return negative(formula(value))
            case nodes.Binary():
                return self.binary(node, scope)
            case nodes.Turned(of=of):
                return turned(self.value(of, scope))
            case nodes.Listed(items=items):
                return self.listed(items, scope)
            case nodes.Block(rows=rows):
                return self.block(rows, scope)
            case nodes.Span():
                return self.span(node, scope)
            case nodes.Nameless(parameters=parameters):
                return Local(parameters, node)
            case nodes.Either(test=test, value=first, otherwise=second):
                return self.value(first if self.holds(test, scope) else second, scope)
            case nodes.Each():
                return self.each(node, scope)
            case nodes.Dots():
                return Reach(None, None)
            case nodes.Pairs(keys=keys, values=values) if all(isinstance(k, nodes.Text) for k in keys):
                return self.record_of({k.text: self.value(v, scope) for k, v in zip(keys, values, strict=True)
                                       if isinstance(k, nodes.Text)})  # fmt: skip
        text = node.text if isinstance(node, nodes.Strange | nodes.Pairs) else ""
        raise NotFollowed(f"{text[:40]!r}: this expression is not followed; write out what it comes to")

    def record_of(self, values: dict[str, Value]) -> Record:
        """{'m1': 1.0}: a quantity by its name, whatever its number; of another name the number is not taken."""
        return Record({name: self.names.kept(name, value, f"'{name}': …") for name, value in values.items()})

    def holds(self, test: nodes.Node, scope: Scope) -> bool:
        """Whether a test of whole numbers holds. Raises NotFollowed where it is one of anything else."""
        value = self.value(test, scope)
        if not isinstance(test, nodes.Binary) or test.sign not in COMPARED or not isinstance(value, Formula):
            raise NotFollowed("a condition on something else than whole numbers; write out what it comes to")
        return value.whole == 1

    def each(self, node: nodes.Each, scope: Scope) -> Value:
        """[l*sin(th[i]) for i in range(n)]"""
        made: list[Value] = []
        if "," in node.name:
            raise NotFollowed("a list over several names at once; write it out")
        for k in reach(self.value(node.over, scope)):
            inner = Scope(scope, {node.name: number(k)})
            if all(self.holds(test, inner) for test in node.tests):
                made.append(self.value(node.value, inner))
        return from_items(made) if made else Several([])

    def word(self, name: str, scope: Scope) -> Value:
        """A name: of the function, of the text around it, or of a quantity from outside."""
        found = scope.find(name)
        if found is None:
            found = self.free(name, scope)
        if isinstance(found, Broken):
            raise NotFollowed(found.why)
        if found is not None:
            return found
        if name in NUMBERS and not self.names.known.is_quantity(name):
            return Formula("pi")
        self.names.read.add(name)
        return Outside((name,))

    def member(self, node: nodes.Member, scope: Scope) -> Value:  # noqa: PLR0911 -- one for each kind
        """np.pi, self.m1, p.carro.m."""
        if isinstance(node.of, nodes.Word) and node.of.name in self.modules and scope.find(node.of.name) is None:
            if node.name in NUMBERS:
                return Formula("pi")
            return Outside((node.of.name, node.name))
        path = dotted(node)
        if path is not None and path in self.members:
            found = self.members[path]
            if isinstance(found, Broken):
                raise NotFollowed(found.why)
            return found
        if path is not None and path.split(".")[0] in ("self", "obj", "this", "cls"):
            own = self.free(node.name, scope) if path.count(".") == 1 and not self.matlab else None
            if isinstance(own, Local) and not own.parameters:  # a property
                return self.calls(nodes.Call(node, ()), scope)
            return Outside(tuple(path.split(".")))
        of = self.value(node.of, scope)
        if isinstance(of, Outside):
            return Outside((*of.path, node.name))
        if node.name in ("T", "transpose") and isinstance(of, Array):
            return turned(of)
        if node.name == "shape" and isinstance(of, Array):
            return Array([number(k) for k in of.shape], (len(of.shape),))
        if node.name in ("I", "H") and isinstance(of, Array):
            raise NotFollowed(f".{node.name} of a matrix; write inv(…) or .T")
        raise NotFollowed(f".{node.name}: this is not followed; write out what it is")

    def binary(self, node: nodes.Binary, scope: Scope) -> Value:
        """Two values and an operator."""
        left, right = self.value(node.left, scope), self.value(node.right, scope)
        return self.combined(node.sign, left, right)

    def combined(self, sign: str, left: Value, right: Value) -> Value:  # noqa: PLR0911 -- one for each operator
        """What an operator makes of two values."""
        left, right = self._numbers(left), self._numbers(right)
        is_entrywise = sign.startswith(".")
        bare = sign.lstrip(".")
        matrices = self.matlab or any(isinstance(x, Array) and x.kind == "matrix" for x in (left, right))
        if sign == "@" or (sign == "*" and matrices):
            return product(left, right)
        if sign == "\\" and isinstance(left, Array) and not is_entrywise and len(left.entries) > 1:
            return self.solved(left, right)
        if sign == "\\" and isinstance(left, Outside) and isinstance(right, Array) and len(right.entries) > 1:
            raise NotFollowed(f"{left.path[-1]}: the matrix is not in this text; say it in [define]")
        if sign == "/" and matrices and isinstance(right, Array) and len(right.entries) > 1:
            return turned(self.solved(_full(turned(right)), turned(left)))
        if bare == "^" and isinstance(left, Array) and len(left.entries) > 1 and not is_entrywise and matrices:
            if formula(right).text == "-1":
                return self.inverted(left)
            raise NotFollowed("a power of a matrix; write out the product")
        if bare == "//":
            return number(_whole(left) // _whole(right))
        if bare in COMPARED:
            return number(int(COMPARED[bare](_whole(left), _whole(right))))
        if bare not in SCALAR:
            raise NotFollowed(f"{sign}: this operator is not followed; write out what it comes to")
        if bare == "+" and isinstance(left, Several) and isinstance(right, Several):
            return Several([*left.items, *right.items])
        return entrywise(left, right, SCALAR[bare])

    def _numbers(self, value: Value) -> Value:
        if isinstance(value, Outside) and self.is_scalar(value):
            return Formula(value.mark)
        return as_array(value) if isinstance(value, Several) else value

    def is_scalar(self, value: Outside) -> bool:
        """Whether what comes from outside is surely one number."""
        last = value.path[-1]
        known = self.names.known
        is_drive = isinstance(last, str) and last in known.drives
        return isinstance(last, int) or is_drive or last in GRAVITY or last == "t" or known.is_quantity(last)

    def solved(self, matrix: Array, right: Value) -> Value:
        """matrix x = right, by cofactors; the determinant has a name of its own."""
        return product(self.inverted(matrix), right)

    def inverted(self, matrix: Value) -> Array:
        """The inverse, by cofactors."""
        from .arrays import adjugate, determinant, over

        if not isinstance(matrix, Array):
            raise NotFollowed("the inverse of something that is no matrix here; say what it is in [define]")
        if len(matrix.entries) == 1:
            return Array([SCALAR["/"](Formula("1"), matrix.entries[0])], matrix.shape, matrix.kind)
        whole = self.names.line(determinant(matrix), "the determinant of a matrix")
        made = over(adjugate(matrix), whole)
        assert isinstance(made, Array)
        return made

    def listed(self, items: tuple[nodes.Node, ...], scope: Scope) -> Value:
        """A list, with *x taken apart."""
        values: list[Value] = []
        for item in items:
            value = self.value(item, scope)
            if isinstance(item, nodes.Unary) and item.sign == "*":
                parts = self.parts(value)
                if parts is None:
                    raise NotFollowed("*… of something whose entries are not known; write them out")
                values += parts
            else:
                values.append(value)
        if self.matlab and len(values) == 1:
            return values[0]
        return from_items(values) if values else Several([])

    def parts(self, value: Value) -> list[Value] | None:
        """The entries of a list or a vector; rows of a matrix."""
        if isinstance(value, Several):
            return list(value.items)
        if isinstance(value, Array):
            if len(value.shape) == 1 or (self.matlab and value.is_vector):
                return list(value.entries)
            return [Array(row, (len(row),)) for row in value.rows]
        return None

    def block(self, rows: tuple[tuple[nodes.Node, ...], ...], scope: Scope) -> Value:
        """MATLAB's brackets."""
        if not rows:
            return Several([])
        made = [stacked([self._grid(self.value(x, scope)) for x in row], across=True) for row in rows]
        return stacked(made, across=False)

    def _grid(self, value: Value) -> Array:
        if isinstance(value, Array):
            if len(value.shape) == 1:  # a vector from outside: MATLAB's state is a column
                return Array(value.entries, (len(value.entries), 1), "array")
            return value
        return Array([formula(value)], (1, 1))

    def span(self, node: nodes.Span, scope: Scope) -> Value:
        """first:last, of MATLAB with the last."""
        first, last, step = (None if x is None else self._place(x, scope) for x in (node.first, node.last, node.step))
        if self.matlab:
            step = 1 if step is None else step
            return Reach(first, None if last is None else last + (1 if step > 0 else -1), step)
        return Reach(first, last, 1 if step is None else step)

    def _place(self, node: nodes.Node, scope: Scope) -> int | None:
        if isinstance(node, nodes.Word) and node.name == "end":
            return None
        return _whole(self.value(node, scope))

    def entry(self, of: Value, places: list[Value], first: int) -> Value:
        """Entries of a list, a matrix, or what comes from outside. ``first``: what is counted from."""
        if isinstance(of, Broken):
            raise NotFollowed(of.why)
        if isinstance(of, Outside):
            return self.outside(of, places, first)
        if isinstance(of, Record) and len(places) == 1 and isinstance(places[0], Words):
            found = of.fields.get(places[0].text)
            if found is None or isinstance(found, Formula):
                raise NotFollowed(f"{places[0].text}: give it the name that a body has for it")
            return found
        if isinstance(of, Several):
            if len(places) == 1 and isinstance(places[0], Reach):
                return Several(of.items[places[0].first : places[0].last])
            k = _whole(places[0]) - first
            if len(places) != 1 or not -len(of.items) <= k < len(of.items):
                raise NotFollowed("an entry of a list that is not there")
            return of.items[k]
        if isinstance(of, Array):
            chosen, shape = chosen_of(of, places, first)
            if not shape:
                return of.entries[chosen[0]]
            return Array([of.entries[k] for k in chosen], shape, of.kind)
        raise NotFollowed("an entry of something that is no list")

    def outside(self, of: Outside, places: list[Value], first: int) -> Value:
        """An entry of the state or of parameters."""
        if len(places) == 1 and isinstance(places[0], Words):
            return Outside((*of.path, places[0].text))
        self.entered.add(of.path)
        if len(places) == 2:  # x[:, 0], x[..., 0], z(1,:), q[0, 0]
            a, b = places
            if _all(a) or (_is_first(a, first) and not _all(b)):
                places = [b]
            elif _all(b) or _is_first(b, first):
                places = [a]
            else:
                return Outside((*of.path, _whole(a) - first, _whole(b) - first))
        if len(places) != 1:
            raise NotFollowed(f"{of.path[-1]} with three indices; write out its entries")
        (place,) = places
        if isinstance(place, Reach):
            start = 0 if place.first is None else place.first - first
            end = self.size if place.last is None else place.last - first
            start, end = (k + self.size if k < 0 else k for k in (start, end))
            if _all(place):
                return of
            if not 0 <= start < end <= LONGEST_STATE:
                raise NotFollowed(f"{of.path[-1]}: a part that is not there")
            return Array([Formula(Outside((*of.path, k)).mark) for k in range(start, end, place.step)],
                         (len(range(start, end, place.step)),), "loose")  # fmt: skip
        if isinstance(place, Array):
            return Array([Formula(Outside((*of.path, _whole(k) - first)).mark) for k in place.entries],
                         (len(place.entries),), "loose")  # fmt: skip
        k = _whole(place)
        k = k + self.size if k < 0 else k - first
        if not 0 <= k < LARGEST_INDEX:
            raise NotFollowed(f"{of.path[-1]}: an entry that is not there")
        return Outside((*of.path, k))


LARGEST_INDEX = 32


def chosen_of(  # noqa: PLR0911 -- one for each way to count
    of: Array, places: list[Value], first: int
) -> tuple[list[int], tuple[int, ...]]:
    """The places of entries within an array, and the shape of what they make; () for one entry."""
    if of.is_state and len(places) == 2:
        places = [places[1] if _all(places[0]) else places[0]]
    if len(places) == 2 and len(of.shape) == 1:
        a, b = places
        places = [b] if _all(a) or (_is_first(a, first) and not _is_first(b, first) and not _all(b)) else [a]
    if len(places) == 1:
        (place,) = places
        if len(of.shape) == 2 and not of.is_vector and not first:  # a row
            width = of.shape[1]
            rows, many = _places(place, of.shape[0], first)
            chosen = [r * width + c for r in rows for c in range(width)]
            return chosen, (len(rows), width) if many else (width,)
        if len(of.shape) == 2 and not of.is_vector:  # MATLAB counts down the columns
            height, width = of.shape
            counted = [r * width + c for c in range(width) for r in range(height)]
            rows, many = _places(place, len(counted), first)
            chosen = [counted[k] for k in rows]
            return chosen, (len(chosen), 1) if many else ()
        found, many = _places(place, len(of.entries), first)
        if not many and len(of.shape) == 2 and not first and of.shape[1] > 1:  # the row of a matrix of one row
            return list(range(len(of.entries))), (len(of.entries),)
        if not many and len(of.shape) == 2 and of.shape[1] == 1 and of.kind == "matrix" and not first:
            return found, ()
        if not many:
            return found, ()
        return found, (len(found),) if len(of.shape) == 1 else (len(found), 1) if of.shape[1] == 1 else (1, len(found))
    if len(places) != 2 or len(of.shape) != 2:
        raise NotFollowed("an entry with more indices than the array has")
    rows, many_rows = _places(places[0], of.shape[0], first)
    across, many_columns = _places(places[1], of.shape[1], first)
    chosen = [r * of.shape[1] + c for r in rows for c in across]
    if not many_rows and not many_columns:
        return chosen, ()
    if first or of.kind == "matrix" or (many_rows and many_columns):
        return chosen, (len(rows), len(across))
    return chosen, (len(chosen),)


def _places(place: Value, size: int, first: int) -> tuple[list[int], bool]:
    if isinstance(place, Reach):
        start = None if place.first is None else place.first - first if place.first >= 0 else place.first
        end = None if place.last is None else place.last - first if place.last >= 0 else place.last
        return list(range(size))[start : end : place.step], True
    if isinstance(place, Array):
        return [_inside(_whole(k) - first, size) for k in place.entries], True
    k = _whole(place)
    return [_inside(k - first if k >= 0 else k + size, size)], False


def _inside(k: int, size: int) -> int:
    if not 0 <= k < size:
        raise NotFollowed(f"entry {k + 1} of {size}; it is not there")
    return k


def _all(value: Value) -> bool:
    return isinstance(value, Reach) and value.first is None and value.last is None


def _is_first(value: Value, first: int) -> bool:
    return isinstance(value, Formula) and value.whole == first


def _whole(value: Value) -> int:
    if isinstance(value, Array) and len(value.entries) == 1:
        value = value.entries[0]
    found = value.whole if isinstance(value, Formula) else None
    if found is None:
        raise NotFollowed("an index that is no whole number; write the number")
    return found


def _full(value: Value) -> Array:
    assert isinstance(value, Array)
    return value


def _plain(text: str) -> str:
    """A number without a zero fraction that says nothing: 2.0 and 2 are one."""
    bare = text.lower()
    if "e" not in bare and "." in bare:
        bare = bare.rstrip("0").rstrip(".") or "0"
    if "e" in bare:
        mantissa, _, exponent = bare.partition("e")
        value = int(exponent)
        if abs(value) > 30:
            raise NotFollowed(f"{text[:20]}: a number too large or too small")
        whole, _, part = mantissa.partition(".")
        figures = (whole or "0") + part
        shift = value - len(part)
        bare = (
            figures + "0" * shift
            if shift >= 0
            else figures.rjust(1 - shift, "0")[:shift] + "." + figures.rjust(1 - shift, "0")[shift:]
        )
        bare = bare.lstrip("0") if not bare.startswith("0.") else bare
        bare = bare or "0"
        bare = "0" + bare if bare.startswith(".") else bare
    return "0" + bare if bare.startswith(".") else bare
