# ruff: noqa: PLR0911 -- one branch for each kind
"""What a name is that is declared by its type, with values in brackets or without."""

from __future__ import annotations

import re
from functools import cached_property
from typing import TYPE_CHECKING

from ..traced import nodes
from .expressions import Expressions

if TYPE_CHECKING:
    from tree_sitter import Node

RENAMED = re.compile(
    r"\btypedef\s+(?P<kind>[\w:]{1,40}\s*(?:<[^;<>]{1,60}>)?)\s+(?P<name>\w{1,40})\s*;"
    r"|\busing\s+(?P<new>\w{1,40})\s*=\s*(?P<old>[\w:]{1,40}\s*(?:<[^;<>]{1,60}>)?)\s*;"
)


def is_count(value: nodes.Node) -> bool:
    """Whether a value is how many entries another one has, x.rows()."""
    return isinstance(value, nodes.Call) and isinstance(value.of, nodes.Member) and value.of.name in ("rows", "size")


class Declared(Expressions):
    """Declarations of C++'s arrays, vectors, matrices and structs."""

    @cached_property
    def called(self) -> dict[str, str]:
        """typedef Eigen::Matrix<double, 2, 1> Vector; using Vector = …: what a type's name stands for."""
        found: dict[str, set[str]] = {}
        for one in RENAMED.finditer(self.source.decode("utf-8", "replace")):
            found.setdefault(one["name"] or one["new"], set()).add(one["kind"] or one["old"])
        return {name: kinds.pop() for name, kinds in found.items() if len(kinds) == 1}

    def unfilled(self, name: Node, kind: str, kind_node: Node | None) -> nodes.Node | None:
        """What a name stands for that is declared without a value: an array of a known size, or nothing yet."""
        sizes = self.sizes_of(name) or (self.sizes_of(kind_node) if kind_node is not None else [])
        if sizes:
            return self.filled(sizes)
        made = self.of_type(kind, kind_node)
        if made is not None:
            return made
        if kind_node is not None and self.last(kind_node) in self.structs:
            return nodes.Fields((), ())
        return None

    def of_type(self, kind: str, kind_node: Node | None) -> nodes.Node | None:
        """Eigen's Matrix2d and Vector3d, std::array<double, 4>, and names that the text gives to them."""
        kind = self.called.get(kind.split("&", maxsplit=1)[0].replace("const", "").strip(), kind)
        found = re.search(r"\b(?P<what>Matrix|Vector|mat|vec|dvec)(?P<n>[2-9])[df]?\b", kind)
        if found:
            n = nodes.Number(found["n"])
            if found["what"] in ("Matrix", "mat"):
                zeros = nodes.Call(nodes.Word("zeros"), (nodes.Listed((n, n)),))
                return nodes.Call(nodes.Word("matrix"), (zeros,))
            return self.filled([n])
        found = re.search(r"\b(?:Matrix|SMatrix)\s*<\s*\w+\s*,\s*(\d)\s*,\s*(\d)\s*>", kind)
        if found and found[2] == "1":
            return self.filled([nodes.Number(found[1])])
        if found:
            zeros = nodes.Call(nodes.Word("zeros"), (nodes.Listed((nodes.Number(found[1]), nodes.Number(found[2]))),))
            return nodes.Call(nodes.Word("matrix"), (zeros,))
        found = re.search(r"\barray\s*<\s*[\w:]+\s*,\s*(\d)\s*>", kind)
        return self.filled([nodes.Number(found[1])]) if found else None

    def initial(self, kind: str, kind_node: Node | None, value: Node) -> nodes.Node | None:
        """State s{1, 2}, Vector2d v(a, b), double x{1}, std::vector<double> v(4)."""
        values = tuple(self.expression(v) for v in self.parts(value) if v.type != "initializer_pair")
        name = self.last(kind_node) if kind_node is not None else ""
        if name in self.structs and values:
            return self.struct(name, values, (), value)
        pairs = self.listed(value)
        if isinstance(pairs, nodes.Fields):
            return pairs
        if not values:
            return self.unfilled(value, kind, kind_node)
        if name in ("vector", "VectorXd", "valarray", "ArrayXd") and value.type == "argument_list":
            return self.filled([values[0]])
        is_size = isinstance(values[0], nodes.Number) and re.fullmatch(r"[\w:]*\bVector\s*<\s*\w+\s*>", kind)
        if is_size and value.type == "argument_list" and len(values) == 1:
            return self.filled([values[0]])
        sized = self.of_type(kind, kind_node)
        if len(values) == 1 and is_count(values[0]) and sized is not None:  # Vector4d v{x.rows()}
            return sized
        rows = [v for v in values if isinstance(v, nodes.Listed)]
        if len(rows) == len(values) > 1:  # of Eigen: rows in braces
            is_column = name.startswith("Vector") or re.search(r"\bMatrix\s*<\s*\w+\s*,\s*\d\s*,\s*1\s*>", kind)
            if all(len(row.items) == 1 for row in rows) and is_column:
                return nodes.Listed(tuple(row.items[0] for row in rows))
            return self.matrix((nodes.Listed(values),), name) if "atrix" in name else nodes.Listed(values)
        if name in ("MatrixXd",) or name.startswith("Matrix"):
            return self.matrix(values, name)
        if len(values) == 1 and value.type == "argument_list":
            return values[0]
        is_list = value.type == "initializer_list" and len(values) > 1
        return (
            nodes.Listed(values)
            if is_list or name.startswith(("Vector", "vec", "array", "RowVector"))
            else next(iter(values))
        )
