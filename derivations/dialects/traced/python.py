"""Python's text as a tree, by Python's own parser; nothing is run."""

from __future__ import annotations

import ast
import re
import textwrap

from ....models.errors import InvalidInput
from . import nodes

SIGNS: dict[type[ast.operator], str] = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "^", ast.MatMult: "@",
    ast.FloorDiv: "//",
}  # fmt: skip
PRINTED = re.compile(r"(?m)^([ \t]*)print[ \t]+[^(=\n][^\n]*$")
PROMPT = re.compile(r"(?m)^(?:>>>|\.\.\.) ?|^In \[[0-9]{1,3}\]: ?")
COMPARED: dict[type[ast.cmpop], str] = {
    ast.Eq: "==", ast.NotEq: "!=", ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=",
}  # fmt: skip
HEAD = re.compile(r"^(?P<blank>[ \t]*)(?:def|class)\b.*:\s*(?:#.*)?$")
MATLAB = re.compile(r"(?m)^\s*function\b|^\s*end\s*;?\s*$")
NOT_SELF = ("self", "cls", "this")
DEEPEST = 60


def python_tree(text: str) -> tuple[nodes.Statement, ...] | None:
    """The statements; None where the text is no Python."""
    if "\\begin" in text or "\\frac" in text or MATLAB.search(text):
        return None
    text = PRINTED.sub(r"\1pass", PROMPT.sub("", text))
    whole = textwrap.dedent(text.expandtabs()).strip("\n")
    for version in (whole, whole.strip(), _indented(whole)):
        try:
            tree = ast.parse(version)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            continue
        reader = _Reader(version.split("\n"))
        try:
            return reader.body(tree.body)
        except RecursionError:
            return None
    return None


def _indented(text: str) -> str:
    """A function whose body has lost its indentation."""
    lines = text.split("\n")
    start = next((k for k, line in enumerate(lines) if HEAD.match(line)), None)
    if start is None:
        return text
    return "\n".join([*lines[: start + 1], *("    " + line for line in lines[start + 1 :])])


class _Reader:
    def __init__(self, lines: list[str]) -> None:
        self.lines = lines

    def line(self, node: ast.stmt) -> str:
        return self.lines[node.lineno - 1].strip()

    def body(self, body: list[ast.stmt], of: str = "") -> tuple[nodes.Statement, ...]:
        return tuple(one for statement in body for one in self.statement(statement, of))

    def statement(self, node: ast.stmt, of: str) -> list[nodes.Statement]:  # noqa: PLR0911, PLR0912 -- one for each kind
        line = self.line(node)
        match node:
            case ast.FunctionDef(name=name, args=args, body=body):
                return [nodes.Define(name, _parameters(args), (), self.body(body), of)]
            case ast.ClassDef(name=name, body=body):
                return list(self.body(body, of=name))
            case ast.Assign(targets=targets, value=value):
                return [nodes.Assign(_tree(target), _tree(value), line) for target in targets]
            case ast.AnnAssign(target=target, value=value):
                return [nodes.Assign(_tree(target), _tree(value), line)] if value else []
            case ast.AugAssign(target=target, op=op, value=value):
                sign = SIGNS.get(type(op))
                return [
                    nodes.Assign(_tree(target), _tree(value), line, sign)
                    if sign
                    else nodes.Unfollowed(line, _names(node))
                ]
            case ast.Return(value=value):
                return [nodes.Return(_tree(value) if value else None, line)]
            case (
                ast.Expr(value=ast.Constant())
                | ast.Pass()
                | ast.Import()
                | ast.ImportFrom()
                | ast.Global()
                | ast.Assert()
            ):
                return []
            case ast.Expr(value=value):
                return [nodes.Do(_tree(value), line)]
            case ast.Nonlocal() | ast.Raise():
                return []
            case ast.If(test=test, body=body, orelse=otherwise):
                if (_only_guards(body) and _only_guards(otherwise)) or _is_default(test, body, otherwise):
                    return []
                if _is_main(test):
                    return []
                return [nodes.Choice(_tree(test), self.body(body), self.body(otherwise), line, _names(node))]
            case ast.For(target=target, iter=over, body=body, orelse=[]) if _bound(target):
                return [nodes.Repeat(_bound(target), _tree(over), self.body(body), line)]
            case ast.Continue() | ast.Break():
                return [nodes.Leave("continue" if isinstance(node, ast.Continue) else "break", line)]
        return [nodes.Unfollowed(line, _names(node))]


def _names(node: ast.stmt) -> tuple[str, ...]:
    """What a statement may change; "return" and "continue" where it may be the last of a function, or of a loop."""
    found = [ast.unparse(n) for n in ast.walk(node) if isinstance(n, ast.Attribute | ast.Name)]
    found += ["return" for n in ast.walk(node) if isinstance(n, ast.Return)]
    inside = [n for one in ast.walk(node) if isinstance(one, ast.For | ast.While) for n in ast.walk(one)]
    leaves = [n for n in ast.walk(node) if isinstance(n, ast.Continue | ast.Break) and n not in inside]
    return tuple(dict.fromkeys([*found, *("continue" for _ in leaves)]))


def _only_guards(body: list[ast.stmt]) -> bool:
    """Whether nothing is done but to raise, print or pass."""
    return all(
        isinstance(one, ast.Raise | ast.Pass | ast.Assert)
        or (isinstance(one, ast.Expr) and (isinstance(one.value, ast.Constant) or _only_says(one.value)))
        for one in body
    )


def _only_says(value: ast.expr) -> bool:
    """print(…), warnings.warn(…)"""
    name = value.func if isinstance(value, ast.Call) else None
    said = name.id if isinstance(name, ast.Name) else name.attr if isinstance(name, ast.Attribute) else ""
    return said in ("print", "warn", "info", "debug", "warning", "exit")


def _is_default(test: ast.expr, body: list[ast.stmt], otherwise: list[ast.stmt]) -> bool:
    """if u is None: u = 0; what the parameter is otherwise is what counts."""
    match test, body:
        case (
            ast.Compare(left=ast.Name(id=name), ops=[ast.Is()], comparators=[ast.Constant(value=None)]),
            [ast.Assign(targets=[ast.Name(id=target)])],
        ):
            return name == target and not otherwise
    return False


def _is_main(test: ast.expr) -> bool:
    """if __name__ == "__main__"."""
    return isinstance(test, ast.Compare) and isinstance(test.left, ast.Name) and test.left.id == "__name__"


def _bound(target: ast.expr) -> str:
    """The name that a loop sets, or several with commas; nothing of what is no name."""
    parts = target.elts if isinstance(target, ast.Tuple) else [target]
    names = [one.id for one in parts if isinstance(one, ast.Name)]
    return ",".join(names) if len(names) == len(parts) else ""


def _parameters(args: ast.arguments) -> tuple[str, ...]:
    names = [a.arg for a in (*args.posonlyargs, *args.args, *args.kwonlyargs)]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise InvalidInput(f"{twice} is the name of two parameters, which is an error in Python; give each its own")
    return tuple(name for name in names if name not in NOT_SELF)


def _tree(node: ast.expr) -> nodes.Node:  # noqa: PLR0911, PLR0912 -- one for each kind
    match node:
        case ast.Constant(value=bool()):
            return nodes.Text(str(node.value))
        case ast.Constant(value=int() | float() as value):
            return nodes.Number(repr(value))
        case ast.Constant(value=str() as value):
            return nodes.Text(value)
        case ast.Constant(value=None) | ast.Dict(keys=[]):
            return nodes.Text("None")
        case ast.Constant(value=value) if value is ...:
            return nodes.Dots()
        case ast.Name(id=name):
            return nodes.Word(name)
        case ast.Attribute(attr="T", value=of):
            return nodes.Turned(_tree(of))
        case ast.Attribute(attr=name, value=of):
            return nodes.Member(_tree(of), name)
        case ast.Subscript(value=ast.Attribute(attr="r_", value=of), slice=ast.Tuple(elts=parts)) if not any(
            isinstance(part, ast.Slice) for part in parts
        ):  # np.r_[a, b]
            return nodes.Call(nodes.Member(_tree(of), "concatenate"), (nodes.Listed(tuple(map(_tree, parts))),))
        case ast.Subscript(value=of, slice=ast.Tuple(elts=places)):
            return nodes.At(_tree(of), tuple(map(_tree, places)))
        case ast.Subscript(value=of, slice=place):
            return nodes.At(_tree(of), (_tree(place),))
        case ast.Slice(lower=first, upper=last, step=step):
            return nodes.Span(*(_tree(x) if x else None for x in (first, last, step)))
        case ast.Call(func=of, args=arguments, keywords=named):
            return nodes.Call(
                _tree(of), tuple(map(_tree, arguments)), tuple((k.arg or "", _tree(k.value)) for k in named)
            )
        case ast.UnaryOp(op=ast.USub() | ast.UAdd() as op, operand=of):
            return nodes.Unary("-" if isinstance(op, ast.USub) else "+", _tree(of))
        case ast.BinOp(left=left, op=op, right=right) if type(op) in SIGNS:
            return nodes.Binary(SIGNS[type(op)], _tree(left), _tree(right))
        case ast.List(elts=items) | ast.Tuple(elts=items):
            return nodes.Listed(tuple(_tree(item) for item in items))
        case ast.Starred(value=of):
            return nodes.Unary("*", _tree(of))
        case ast.Lambda(args=args, body=value):
            return nodes.Nameless(_parameters(args), _tree(value))
        case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in COMPARED:
            return nodes.Binary(COMPARED[type(op)], _tree(left), _tree(right))
        case ast.BoolOp(op=op, values=[first, *rest]):
            whole = _tree(first)
            for one in rest:
                whole = nodes.Binary("&&" if isinstance(op, ast.And) else "||", whole, _tree(one))
            return whole
        case ast.IfExp(test=test, body=value, orelse=otherwise):
            return nodes.Either(_tree(test), _tree(value), _tree(otherwise))
        case ast.ListComp(elt=of, generators=[one]) | ast.GeneratorExp(elt=of, generators=[one]) if _bound(one.target):
            return nodes.Each(_tree(of), _bound(one.target), _tree(one.iter), tuple(map(_tree, one.ifs)))
        case ast.Dict(keys=keys, values=values) if all(keys):
            return nodes.Pairs(tuple(_tree(k) for k in keys if k), tuple(map(_tree, values)), ast.unparse(node)[:60])
    return nodes.Strange(ast.unparse(node)[:60])
