# ruff: noqa: E501, PLR0911, PLR0912 -- tables stand on one line; one branch for each kind
"""Calls of a syntax tree as the follower's nodes: functions, methods, and what makes lists, vectors and matrices."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..traced import nodes
from .patterns import Patterns
from .words import CASTS, DATA, DEGREES, EMPTY, ITH, LISTS, MATRICES, MODULES, SAME, SOLVERS, plain_call

if TYPE_CHECKING:
    from tree_sitter import Node

NAMES = frozenset((
    "identifier", "field_identifier", "property_identifier", "shorthand_property_identifier", "type_identifier",
    "simple_identifier", "qualified_identifier", "scoped_identifier", "namespace_identifier", "operator_name",
    "shorthand_field_identifier", "predefined_type", "primitive_type", "scoped_type_identifier", "template_type",
    "generic_name", "generic_type", "template_function", "generic_function", "user_type", "dependent_name", "qualified_name",
))  # fmt: skip
MEMBERS = frozenset(("field_expression", "member_expression", "field_access", "member_access_expression",
                     "selector_expression", "navigation_expression"))  # fmt: skip


class Made(Patterns):
    """What calls make."""

    def expression(self, node: Node) -> nodes.Node:
        """What stands there."""
        raise NotImplementedError

    def strange(self, node: Node) -> nodes.Node:
        """An expression that is not followed."""
        return nodes.Strange(" ".join(self.text(node).split())[:60])

    def filled(self, sizes: list[nodes.Node], of: Node | None = None) -> nodes.Node:
        """An array of one value."""
        raise NotImplementedError

    def place(self, made: nodes.Node) -> nodes.Node:
        """A place counted from 0."""
        raise NotImplementedError

    def arguments(self, node: Node) -> tuple[list[Node], list[tuple[str, Node]]]:
        """What a call is given, and by which names."""
        given = node.child_by_field_name("arguments") or next(
            (c for c in node.children if c.type in ("argument_list", "value_arguments", "arguments", "call_suffix")),
            None,
        )
        plain, named = [], []
        for one in self.parts(given) if given is not None else []:
            inner = self.parts(one) if one.type in ("argument", "value_argument", "named_argument") else [one]
            is_named = one.type == "named_argument" or (one.type in ("argument", "value_argument") and len(inner) == 2)
            if is_named and inner[0].type in NAMES:
                named.append((self.text(inner[0]), inner[-1]))
            else:
                plain.append(one)
        plain += [c for c in node.children if c.type in ("annotated_lambda", "lambda_literal")]
        return plain, named

    def call(self, node: Node) -> nodes.Node:
        """A function, a method, or what makes a list."""
        if node.children[0].type == "operator" and self.text(node.children[0]) in ("-", "+"):  # -(a + b) of Julia
            given, _ = self.arguments(node)
            return (
                nodes.Unary(self.text(node.children[0]), self.expression(given[0]))
                if len(given) == 1
                else self.strange(node)
            )
        of = node.child_by_field_name("function") or self.parts(node)[0]
        given, named = self.arguments(node)
        if node.type == "method_invocation":
            of_object, name = node.child_by_field_name("object"), self.field(node, "name")
            if of_object is None or (of_object.type in NAMES and self.last(of_object) in MODULES):
                return self.function(name, given, named, node)
            return self.method(of_object, name, given, named, node)
        if of.type == "generic_function" and self.parts(of)[0].type in MEMBERS:
            of = self.parts(of)[0]
        if of.type in MEMBERS:
            parts = self.parts(of)
            if parts[0].type in NAMES and self.last(parts[0]) in MODULES and self.last(parts[0]) not in self.declared:
                return self.function(self.last(parts[-1]), given, named, node, module=self.last(parts[0]))
            return self.method(parts[0], self.last(parts[-1]), given, named, node)
        if of.type == "parametrized_type_expression":
            return self.function(self.text(of).split("{")[0].split(".")[-1], given, named, node)
        if of.type in NAMES:
            path = self.text(of).replace("<", "::<").split("::")
            owner = path[-2] if len(path) > 1 and "<" not in path[-2] else path[0] if len(path) > 1 else ""
            return self.function(self.last(of), given, named, node, owner=owner)
        return nodes.Call(self.expression(of), tuple(map(self.expression, given)))

    def function(
        self, name: str, given: list[Node], named: list[tuple[str, Node]], node: Node, owner: str = "", module: str = ""
    ) -> nodes.Node:
        """A call of a function by its name, or of what makes a struct, a vector, a matrix."""
        values = tuple(map(self.expression, given))
        keys = tuple((k, self.expression(v)) for k, v in named)
        if name in self.functions or (name in self.declared and name not in self.structs):
            return nodes.Call(nodes.Word(self.renamed(name)), values, keys)
        if name in self.structs and owner not in MODULES:
            return self.struct(name, values, keys, node)
        if name in DATA and len(values) == 1:
            return values[0]
        if name in ITH and len(values) == 2:  # SUNDIALS; Ith of its examples counts from 1
            place = values[1] if ITH[name] == 0 else nodes.Binary("-", values[1], nodes.Number("1"))
            return nodes.At(values[0], (place,))
        if name == "view" and len(given) == 2 and self.language.first:
            return nodes.At(values[0], (self.place(values[1]),))
        if DEGREES.fullmatch(name):
            return nodes.Call(nodes.Word("degrees"), values)
        if name in CASTS and len(values) == 1:
            return values[0]
        kind = owner if name in ("new", "from", "of", "zeros", "from_row_slice", "from_vec", "from_slice", "zero", "Zero",
                                 "from_rows", "identity") else name  # fmt: skip
        if module in ("math", "mathjs", "numeric") and self.language.name == "JavaScript":
            plain = {"multiply": "matmul", "dot": "dot", "matrix": "array"}.get(name)
            if plain:
                return nodes.Call(nodes.Word(plain), values)
        if EMPTY.fullmatch(name) and values and name != "similar":
            shape = values[0] if len(values) == 1 else nodes.Listed(values)
            made: nodes.Node = nodes.Call(nodes.Word("zeros"), (shape,))
            return nodes.Call(nodes.Word("matrix"), (made,)) if MATRICES.fullmatch(kind) else made
        if EMPTY.fullmatch(name) or name == "similar":
            size = next((int(c) for c in kind if c.isdigit()), 0)
            return self.filled([nodes.Number(str(size))]) if size else nodes.Call(nodes.Word("zeros_like"), values)
        if MATRICES.fullmatch(kind) and values:
            return self.matrix(values, kind)
        if LISTS.fullmatch(kind):
            return self.vector(values, kind, node)
        if SOLVERS.fullmatch(name) and values:
            return values[0]
        if name == "len" and self.language.name == "Go":
            return nodes.Call(nodes.Word("len"), values)
        if name == "make" and len(given) > 1:
            return self.filled([values[1]])
        return nodes.Call(nodes.Word(plain_call(name)), values, keys)

    def struct(self, name: str, values: tuple[nodes.Node, ...], keys: tuple[tuple[str, nodes.Node], ...], node: Node
               ) -> nodes.Node:  # fmt: skip
        """A struct of the text, its values in its own order."""
        names = self.structs[name]
        if len(values) + len(keys) > len(names):
            return self.strange(node)
        return nodes.Fields((*names[: len(values)], *(k for k, _ in keys)), (*values, *(v for _, v in keys)))

    def vector(self, values: tuple[nodes.Node, ...], kind: str, node: Node) -> nodes.Node:
        """vec4(a, b, c, d), Vector2d(a, b): their entries one behind another."""
        size = next((int(c) for c in kind if c.isdigit()), 0)
        if len(values) == 1 and isinstance(values[0], nodes.Listed | nodes.Call | nodes.Binary):
            return values[0]
        if len(values) == 1 and size > 1:
            return nodes.Listed(values * size) if not isinstance(values[0], nodes.Word) else values[0]
        if len(values) == 1 and isinstance(values[0], nodes.Number) and kind not in ("SA", "listOf", "doubleArrayOf"):
            return self.filled([values[0]])
        if size and self.language.by_columns and len(values) < size:
            return nodes.Call(nodes.Word("hstack"), (nodes.Listed(values),))
        return (
            nodes.Listed(values) if values else self.filled([nodes.Number(str(size))]) if size else self.strange(node)
        )

    def matrix(self, values: tuple[nodes.Node, ...], kind: str) -> nodes.Node:
        """A matrix of its entries, row by row, or of rows."""
        n = {4: 2, 9: 3, 16: 4}.get(len(values), 0)
        if n:
            values = (nodes.Listed(tuple(nodes.Listed(values[k : k + n]) for k in range(0, len(values), n))),)
        elif len(values) == 2 and all(isinstance(v, nodes.Number) for v in values):
            return nodes.Call(nodes.Word("matrix"), (nodes.Call(nodes.Word("zeros"), (nodes.Listed(values),)),))
        made = nodes.Call(nodes.Word("matrix"), values)
        return nodes.Turned(made) if self.language.by_columns else made

    def method(self, of: Node, name: str, given: list[Node], named: list[tuple[str, Node]], node: Node) -> nodes.Node:
        """A method of a value, or a function of its first argument, x.sin()."""
        values = tuple(map(self.expression, given))
        if name not in self.functions and name in SAME:
            return self.expression(of)
        if name in ("coeff", "at", "get", "getEntry", "coeffRef", "operator[]", "element") and values:
            return nodes.At(self.expression(of), values)
        if name in ("head", "tail", "segment") and name not in self.functions:
            return self.part(of, name, given, node)
        plain = name if name in self.functions else plain_call(name)
        keys = tuple((k, self.expression(v)) for k, v in named)
        return nodes.Call(nodes.Member(self.expression(of), plain), values, keys)

    def part(self, of: Node, name: str, given: list[Node], node: Node) -> nodes.Node:
        """x.head(2), x.tail<2>(), x.segment(1, 2) of Eigen."""
        sizes = [int(c) for c in self.text(node).split(name)[-1].replace("<", " ").replace(">", " ").replace("(", " ")
                 .replace(")", " ").replace(",", " ").split() if c.isdigit()]  # fmt: skip
        made = self.expression(of)
        if name == "head" and len(sizes) == 1:
            return nodes.At(made, (nodes.Span(nodes.Number("0"), nodes.Number(str(sizes[0]))),))
        if name == "tail" and len(sizes) == 1:
            return nodes.At(made, (nodes.Span(nodes.Unary("-", nodes.Number(str(sizes[0])))),))
        if name == "segment" and len(sizes) == 2:
            start, size = (sizes[1], sizes[0]) if "<" in self.text(node).split(name)[-1] else (sizes[0], sizes[1])
            return nodes.At(made, (nodes.Span(nodes.Number(str(start)), nodes.Number(str(start + size))),))
        return self.strange(node)

    def made(self, node: Node) -> nodes.Node:
        """new Vector(1, 2), new State { A = 1 }."""
        kind = node.child_by_field_name("type") or node.child_by_field_name("constructor")
        initial = node.child_by_field_name("initializer")
        if initial is not None:
            return self.expression(initial)
        given, named = self.arguments(node)
        name = self.last(kind) if kind is not None else ""
        return self.function(name, given, named, node)

    def array(self, node: Node) -> nodes.Node:
        """new double[2][2], new double[N, N], new[] {1, 2}."""
        value = node.child_by_field_name("value") or next(
            (c for c in node.children if c.type in ("initializer_expression", "array_initializer")), None
        )
        if value is not None:
            return self.expression(value)
        sizes = [self.expression(p) for c in node.children if c.type == "dimensions_expr" for p in self.parts(c)]
        if not sizes:
            ranks = [c for c in self.walk(node) if c.type == "array_rank_specifier"]
            sizes = [self.expression(p) for r in ranks for p in self.parts(r)]
        return self.filled(sizes) if sizes else self.strange(node)
