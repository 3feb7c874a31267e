# ruff: noqa: E501 -- tables stand on one line; one branch for each kind
"""What a syntax tree says of names: which a function declares, of what types they are, and what is taken apart."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..traced import nodes
from .languages.language import Language

if TYPE_CHECKING:
    from tree_sitter import Node

REMARKS = frozenset(("comment", "line_comment", "block_comment", "multiline_comment", "shebang"))
WHOLE_TYPES = re.compile(
    r"(?:const |static |unsigned |final |constexpr |signed )*(?:int|long|short|char|byte|size_t|uint|Int|Long|u?int\d*(?:_t)?|"
    r"[ui](?:8|16|32|64|size)|std::size_t|integer|unsigned|unsigned int|long long|index_t|Eigen::Index|uint\d+)"
)
WHOLE_NUMBER = re.compile(r"[0-9][0-9_]*(?:[uUlL]*|usize|i32|u32|i64|u64)")
NO_TYPE = re.compile(r"(?:auto|var|val|let|const|implicit)?")
PATTERNS = frozenset((
    "array_pattern", "tuple_pattern", "slice_pattern", "open_tuple", "tuple_expression", "multi_variable_declaration",
    "structured_binding_declarator", "expression_list", "parenthesized_variable_declaration",
))  # fmt: skip
FIELDS = frozenset(("object_pattern", "struct_pattern"))
OPERATORS = frozenset(("operator", "mutable_specifier", "type_annotation", "modifiers", "modifier"))


class Patterns:
    """``declared``: names with values in the functions that are read now, the innermost last; ``structs``: the fields
    of each; ``functions``: the names of the text's functions; ``wholes``: names of whole numbers."""

    language: Language
    source: bytes
    structs: dict[str, tuple[str, ...]]
    functions: set[str]
    is_by_entries = False

    def __init__(self) -> None:
        self.frames: list[list[set[str]]] = [[set()]]
        self.wholes: set[str] = set()
        self.shadowed: set[str] = set()

    # the tree

    def text(self, node: Node | None) -> str:
        """What is written there."""
        return node.text.decode(errors="replace") if node is not None and node.text is not None else ""

    def line(self, node: Node) -> str:
        """A statement on one line."""
        return " ".join(self.text(node).split())

    def parts(self, node: Node) -> list[Node]:
        """What a node is made of, without remarks and signs."""
        return [c for c in node.children if c.is_named and c.type not in REMARKS and c.type not in OPERATORS]

    def field(self, node: Node, name: str) -> str:
        """The text of a part by its name."""
        return self.text(node.child_by_field_name(name))

    def walk(self, node: Node) -> Iterator[Node]:
        """A node and all within it."""
        waiting = [node]
        while waiting:
            one = waiting.pop()
            yield one
            waiting += reversed(one.children)

    def last(self, node: Node) -> str:
        """The last word of a path, std::sin, without what stands in <…>."""
        bare = re.sub(r"<[^<>]*(?:<[^<>]*>[^<>]*)*>", "", self.text(node)).strip()
        return re.split(r"::|\.", bare)[-1].strip()

    # names

    @property
    def declared(self) -> set[str]:
        """All names that have values here."""
        return {name for frame in self.frames for block in frame for name in block}

    def declare(self, name: str) -> None:
        """A name that gets a value of its own here."""
        if any(name in block for block in self.frames[-1][:-1]) and len(self.frames) > 1 and self.language.declares:
            self.shadowed.add(name)
        self.frames[-1][-1].add(name)

    def is_own(self, name: str) -> bool:
        """Whether a name is the innermost function's own."""
        return not self.language.declares or len(self.frames) == 1 or any(name in block for block in self.frames[-1])

    def renamed(self, name: str) -> str:
        """A name as the follower has it."""
        return name

    # whole numbers

    def is_whole_type(self, text: str) -> bool:
        """Whether a type is one of whole numbers."""
        return WHOLE_TYPES.fullmatch(" ".join(text.split())) is not None

    def is_whole(self, node: Node) -> bool:
        """Whether an expression is of a whole number's type."""
        parts = self.parts(node)
        if node.type in ("parenthesized_expression", "unary_expression", "prefix_unary_expression", "prefix_expression",
                         "argument", "value_argument"):  # fmt: skip
            return bool(parts) and self.is_whole(parts[-1])
        if node.type == "binary_expression":
            return all(self.is_whole(part) for part in parts) and len(parts) == 2
        if node.type in ("cast_expression", "type_cast_expression"):
            return self.is_whole_type(self.field(node, "type"))
        if node.type in ("call_expression", "invocation_expression", "method_invocation"):
            name = re.split(r"::|\.", re.sub(r"\(.*", "", self.text(node), flags=re.DOTALL))[-1].lower()
            inside = [p for c in node.children if "argument" in c.type for p in self.parts(c)]
            return name in ("max", "min", "abs") and bool(inside) and all(self.is_whole(p) for p in inside)
        text = self.text(node)
        return WHOLE_NUMBER.fullmatch(text) is not None or (text in self.wholes and not parts)

    def note_type(self, name: str, kind: str, value: Node | None) -> None:
        """Whether a declared name is one of a whole number."""
        bare = kind.strip()
        by_value = NO_TYPE.fullmatch(bare) is not None and value is not None and self.is_whole(value)
        if self.is_whole_type(bare) or by_value:
            self.wholes.add(name)
        else:
            self.wholes.discard(name)

    # what is taken apart

    def sizes_of(self, kind: Node) -> list[nodes.Node]:
        """The sizes in a type: [3][3]float64, double A[3][3]."""
        found = []
        for one in self.walk(kind):
            size = one.child_by_field_name("length") or one.child_by_field_name("size")
            if one.type in ("array_type", "array_declarator") and size is not None:
                found.append(self.expression(size))  # type: ignore[attr-defined]
        return found[::-1] if kind.type == "array_declarator" else found

    def target(self, node: Node, *, new: bool) -> nodes.Node:
        """What stands on the left; ``new``: its names are declared there."""
        if node.type in PATTERNS:
            return nodes.Listed(tuple(self.target(part, new=new) for part in self.parts(node)))
        if new:
            inner = self.named(node)
            if inner is not None and inner.type in PATTERNS:
                return self.target(inner, new=True)
            name = self.text(inner) if inner is not None else self.text(node)
            self.declare(name)
            return nodes.Word(name)
        made: nodes.Node = self.expression(node)  # type: ignore[attr-defined]
        if isinstance(made, nodes.Call) and not isinstance(made.of, nodes.Nameless):  # M(0, 1) = …
            return nodes.At(made.of, made.arguments)
        return made

    def named(self, node: Node) -> Node | None:
        """The name within a declarator, a pattern or a parameter."""
        while True:
            inner = (node.child_by_field_name("declarator") or node.child_by_field_name("pattern")
                     or node.child_by_field_name("name"))  # fmt: skip
            if inner is None and node.type in ("reference_declarator", "reference_pattern", "ref_pattern", "mut_pattern",
                                               "variable_declaration", "typed_expression", "captured_pattern",
                                               "rest_pattern", "implicit_parameter_of"):  # fmt: skip
                parts = self.parts(node)
                inner = parts[0] if parts else None
            if inner is None or inner == node:
                return node
            node = inner

    def taken_apart(self, pattern: Node, value: nodes.Node, line: str) -> list[nodes.Statement]:
        """const {a, b: c} = s, let P { a, b } = s: one assignment each."""
        made: list[nodes.Statement] = []
        for part in self.parts(pattern):
            if part.type in ("type_identifier", "scoped_type_identifier"):
                continue
            inside = self.parts(part)
            if part.type == "field_pattern" and len(inside) == 2:
                key, name = self.text(inside[0]), self.text(self.named(inside[1]))
            elif part.type == "pair_pattern":
                key, name = self.text(inside[0]), self.text(self.named(inside[-1]))
            elif part.type in ("shorthand_property_identifier_pattern", "field_pattern", "identifier"):
                key = name = self.text(part).removeprefix("mut ").removeprefix("ref ").strip()
            else:
                made.append(nodes.Unfollowed(line, (self.text(part).split("=")[0].strip(),)))
                continue
            self.declare(name)
            made.append(nodes.Assign(nodes.Word(name), nodes.Member(value, key), line))
        return made
