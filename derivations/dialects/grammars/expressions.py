# ruff: noqa: E501, PLR0911, PLR0912 -- tables stand on one line; one branch for each kind
"""Expressions of a syntax tree as the follower's nodes, whatever the language."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from ..traced import nodes
from .made import MEMBERS, NAMES, Made
from .patterns import REMARKS
from .words import MODULES, NUMBER, plain_call

if TYPE_CHECKING:
    from tree_sitter import Node

NUMBERS = frozenset((
    "number_literal", "number", "decimal_integer_literal", "decimal_floating_point_literal", "integer_literal",
    "float_literal", "real_literal", "int_literal", "long_literal",
))  # fmt: skip
INNER = frozenset((  # the first of their parts is what counts
    "parenthesized_expression", "await_expression", "non_null_expression", "as_expression", "try_expression",
    "satisfies_expression", "checked_expression", "argument", "value_argument", "reference_expression", "expression_element",
    "collection_element", "literal_element", "condition_clause", "parenthesized_statement",
    "expression_list_of_one", "ref_expression", "move_expression", "typed_expression", "compound_expression_of_one",
))  # fmt: skip
BINARY = frozenset(("binary_expression", "infix_expression", "comparison_expression", "multiplicative_expression",
                    "additive_expression"))  # fmt: skip
UNARY = frozenset(("unary_expression", "prefix_unary_expression", "pointer_expression", "prefix_expression"))
LISTED = frozenset(("initializer_list", "array_initializer", "initializer_expression", "array", "array_expression",
                    "vector_expression", "collection_expression", "tuple_expression", "literal_value", "open_tuple",
                    "expression_list", "collection_literal"))  # fmt: skip
ENTRIES = frozenset(("subscript_expression", "array_access", "element_access_expression", "index_expression"))
CALLS = frozenset(("call_expression", "method_invocation", "invocation_expression", "broadcast_call_expression"))
NEW = frozenset(("object_creation_expression", "new_expression", "implicit_object_creation_expression"))
ARRAYS = frozenset(("array_creation_expression", "implicit_array_creation_expression"))
CLOSURES = frozenset(("arrow_function", "lambda_expression", "closure_expression", "func_literal", "function_expression",
                      "lambda_literal", "arrow_function_expression", "anonymous_function", "function",
                      "anonymous_method_expression"))  # fmt: skip
EITHER = frozenset(("conditional_expression", "ternary_expression", "if_expression"))
HOLDERS = frozenset(("subscript_argument_list", "bracketed_argument_list", "vector_expression", "tuple_expression",
                     "indexing_suffix", "value_arguments"))  # fmt: skip
RANGES = frozenset(("range_expression",))
SUFFIXES = ("", "f", "F", "d", "D", "l", "L", "f64", "f32", "m", "u", "U", "usize", "i32", "f0")
SIGNS = {"===": "==", "!==": "!=", "and": "&&", "or": "||", "÷": "div", "∘": "∘"}
FOLLOWED = frozenset((
    "+", "-", "*", "/", "==", "!=", "<", "<=", ">", ">=", "&&", "||", ".*", "./", ".+", ".-", ".^", "\\", "div", "//",
))  # fmt: skip


def entries_of(row: str) -> list[str]:
    """Julia's entries of a row: a blank ends one, unless a sign with blanks on both sides, or none, goes on."""
    made: list[str] = []
    depth, start, at = 0, 0, 0
    while at < len(row):
        c = row[at]
        depth += (c in "([{") - (c in ")]}")
        if c.isspace() and depth == 0 and row[start:at].strip():
            rest, before = row[at:].lstrip(), row[start:at].rstrip()
            goes_on = re.match(r"[*/^\\?:]|[-+](?=\s)", rest) or re.search(r"[-+*/^\\?:]$", before)
            if rest and not goes_on:
                made.append(before.strip())
                start = at
        at += 1
    return [*made, row[start:].strip()] if row[start:].strip() else made


class Expressions(Made):
    """The expressions of a text."""

    def expression(self, node: Node) -> nodes.Node:
        """What stands there."""
        kind = node.type
        if kind in NUMBERS:
            return self.number(node)
        if kind in ("this", "this_expression", "self"):
            return nodes.Word("self")
        if kind in NAMES:
            return self.name(node)
        if kind in INNER:
            parts = self.parts(node)
            return self.expression(parts[-1] if kind == "argument" else parts[0]) if parts else self.strange(node)
        if kind in ("cast_expression", "type_cast_expression"):
            return self.cast(node)
        if kind in BINARY:
            return self.binary(node)
        if kind in UNARY:
            return self.unary(node)
        if kind in ("adjoint_expression", "postfix_expression", "postfix_unary_expression"):
            parts = self.parts(node)
            return nodes.Turned(self.expression(parts[0])) if kind == "adjoint_expression" else self.strange(node)
        if kind == "juxtaposition_expression":
            first, second = self.parts(node)
            if second.type == "call_expression" and second.children[0].type == "operator":
                return self.strange(node)  # 2 -(a): the grammar has a product here
            return nodes.Binary("*", self.expression(first), self.expression(second))
        if kind in LISTED:
            return self.listed(node)
        if kind == "composite_literal":
            return self.composite(node)
        if kind in ("object", "struct_expression"):
            return self.fields(node)
        if kind in MEMBERS:
            return self.member(node)
        if kind in ENTRIES:
            return self.entry(node)
        if kind in CALLS:
            return self.call(node)
        if kind in NEW:
            return self.made(node)
        if kind in ARRAYS:
            return self.array(node)
        if kind in CLOSURES:
            return self.closure(node)  # type: ignore[attr-defined,no-any-return]
        if kind in EITHER:
            return self.either(node)
        if kind in RANGES:
            return self.span(node)
        if kind == "matrix_expression":
            return self.block(node)
        if kind in ("spread_element", "spread_expression", "splat_expression"):
            return nodes.Unary("*", self.expression(self.parts(node)[0]))
        if kind == "comprehension_expression":
            return self.comprehension(node)
        if kind in ("string_literal", "string", "template_string", "interpreted_string_literal", "raw_string_literal",
                    "character_literal", "char_literal", "multiline_string_literal"):  # fmt: skip
            return nodes.Text(self.text(node).strip("\"'`"))
        if kind in ("null", "null_literal", "nil", "none", "undefined", "true", "false", "boolean_literal"):
            return nodes.Text(kind)
        if kind == "macrocall_expression":
            return self.macro(node)
        if kind == "block" and len(self.parts(node)) == 1:  # of Rust's if
            return self.expression(self.parts(node)[0])
        return self.strange(node)

    def number(self, node: Node) -> nodes.Node:
        """Without suffixes, as 1.f and 2_000."""
        text = self.text(node).replace("_", "").replace("'", "")
        if text[:1] == "-":
            inner = NUMBER.fullmatch(text[1:])
            return (
                nodes.Unary("-", nodes.Number(inner["n"]))
                if inner and inner["suffix"] in SUFFIXES
                else self.strange(node)
            )
        found = NUMBER.fullmatch(text)
        is_octal = text[:1] == "0" and text.isdigit() and len(text) > 1
        if found is None or is_octal or found["suffix"] not in SUFFIXES:
            return self.strange(node)
        return nodes.Number(found["n"])

    def name(self, node: Node) -> nodes.Node:
        """A word; of a path with ::, its last."""
        text = self.last(node)
        if text in ("M_PI", "PI", "Pi", "π", "M_PIl") and text not in self.declared:
            return nodes.Word("pi")
        if text in ("M_PI_2", "HALF_PI", "M_PI_4", "QUARTER_PI", "TWO_PI", "TAU"):
            return self.strange(node)
        return nodes.Word(self.renamed(text))

    def cast(self, node: Node) -> nodes.Node:
        """(double) x; what makes a whole number of something else is not followed."""
        kind = node.child_by_field_name("type")
        value = node.child_by_field_name("value") or self.parts(node)[-1]
        inner = self.expression(value)
        if kind is not None and self.is_whole_type(self.text(kind)) and not self.is_whole(value):
            return self.strange(node)
        return inner

    def binary(self, node: Node) -> nodes.Node:
        """Two values; a division of whole numbers is one of its own."""
        parts = self.parts(node)
        left = node.child_by_field_name("left") or parts[0]
        right = node.child_by_field_name("right") or parts[-1]
        mark = node.child_by_field_name("operator")
        if mark is None:
            between = [c for c in node.children if c.start_byte >= left.end_byte and c.end_byte <= right.start_byte]
            mark = next((c for c in between if self.text(c).strip()), None)
        sign = SIGNS.get(self.text(mark).strip(), self.text(mark).strip()) if mark is not None else ""
        if sign in ("until", "downTo") and node.type == "infix_expression":
            return nodes.Span(self.expression(left), self.expression(right)) if sign == "until" else self.strange(node)
        if (
            sign in ("^", ".^")
            and left.type == "call_expression"
            and self.text(left).lstrip()[:1] == "-"
            and self.language.first
        ):
            inner = self.call(left)  # -(a + b)^2 of Julia is the square's negative
            base = inner.of if isinstance(inner, nodes.Unary) else inner
            return nodes.Unary("-", nodes.Binary("^", base, self.expression(right)))
        if sign in ("^", ".^") and left.type == "juxtaposition_expression":  # 2x^2 of Julia is 2*(x^2)
            factor, of = self.parts(left)
            return nodes.Binary(
                "*", self.expression(factor), nodes.Binary("^", self.expression(of), self.expression(right))
            )
        if sign in self.language.powers or (sign == ".^" and "^" in self.language.powers):
            return nodes.Binary("^", self.expression(left), self.expression(right))
        if sign not in FOLLOWED:
            return self.odd_sign(sign, node)
        if sign == "/" and self.language.whole and self.is_whole(left) and self.is_whole(right):
            sign = "div"
        if self.is_by_entries and sign in ("*", "/", "+", "-"):
            sign = f".{sign}"
        return nodes.Binary(sign, self.expression(left), self.expression(right))

    def odd_sign(self, sign: str, node: Node) -> nodes.Node:
        """A sign that means something else than it looks like."""
        if sign in ("^", "**"):
            return nodes.Strange(f"{sign} is no power in this language")
        return self.strange(node)

    def unary(self, node: Node) -> nodes.Node:
        """A sign in front; C's & and *, where they stand before what they point at."""
        parts = self.parts(node)
        of = node.child_by_field_name("argument") or node.child_by_field_name("operand") or parts[-1]
        sign = self.text(node.children[0])
        if sign == "&" and node.parent is not None and "argument" in node.parent.type:
            return nodes.Unary("&", self.expression(of))
        if sign in ("*", "&", "&mut"):
            return self.expression(of)
        return nodes.Unary(sign, self.expression(of)) if sign in ("-", "+") else self.strange(node)

    def listed(self, node: Node) -> nodes.Node:
        """A list; [0.0; 4] of Rust; {.m = 1} of C and {A = 1} of C#, things with names."""
        length = node.child_by_field_name("length")
        parts = self.parts(node)
        if length is not None:
            return self.filled([self.expression(length)], parts[0])
        pairs = [self.pair(part) for part in parts]
        if pairs and all(p is not None for p in pairs):
            made = [p for p in pairs if p is not None]
            return nodes.Fields(tuple(k for k, _ in made), tuple(v for _, v in made))
        if node.type == "expression_list" and len(parts) == 1:
            return self.expression(parts[0])
        if node.type == "vector_expression" and len(parts) == 1 and "," not in [c.type for c in node.children]:
            row = self.apart(self.text(parts[0]))
            if len(row) > 1:
                return nodes.Block((tuple(row),))
        if node.type == "vector_expression" and len(parts) == 1 and parts[0].type == "range_expression":
            return self.span(parts[0])
        return nodes.Listed(tuple(self.expression(part) for part in parts))

    def filled(self, sizes: list[nodes.Node], of: Node | None = None) -> nodes.Node:
        """An array of one value."""
        shape = sizes[0] if len(sizes) == 1 else nodes.Listed(tuple(sizes))
        value = self.expression(of) if of is not None else nodes.Number("0")
        if isinstance(value, nodes.Number) and not value.text.strip("0."):
            return nodes.Call(nodes.Word("zeros"), (shape,))
        if isinstance(value, nodes.Call) and value.of == nodes.Word("zeros"):  # [[0.0; 2]; 2]
            inner = value.arguments[0]
            rows = inner.items if isinstance(inner, nodes.Listed) else (inner,)
            return nodes.Call(nodes.Word("zeros"), (nodes.Listed((*sizes, *rows)),))
        return nodes.Binary("*", value, nodes.Call(nodes.Word("ones"), (shape,)))

    def pair(self, node: Node) -> tuple[str, nodes.Node] | None:
        """A part of a thing with names; None of a list's."""
        if node.type in ("pair", "keyed_element", "initializer_pair", "field_initializer", "assignment_expression",
                         "named_argument"):  # fmt: skip
            parts = self.parts(node)
            if node.type == "assignment_expression" and node.parent and node.parent.type != "initializer_expression":
                return None
            return self.text(parts[0]).lstrip(".").strip("\"'"), self.expression(parts[-1])
        if node.type in ("shorthand_property_identifier", "shorthand_field_initializer"):
            name = self.text(node)
            return name, nodes.Word(self.renamed(name))
        return None

    def fields(self, node: Node) -> nodes.Node:
        """{a, b: c, ...s} and State { a, b: c }."""
        body = node.child_by_field_name("body") if node.type == "struct_expression" else node
        base: nodes.Node | None = None
        names: list[str] = []
        values: list[nodes.Node] = []
        for part in self.parts(body or node):
            found = self.pair(part)
            if found is not None:
                names.append(found[0])
                values.append(found[1])
            elif part.type in ("spread_element", "base_field_initializer") and not names:
                base = self.expression(self.parts(part)[0])
            elif part.type != "method_definition":
                return self.strange(node)
        return nodes.Fields(tuple(names), tuple(values), base)

    def composite(self, node: Node) -> nodes.Node:
        """Go's []float64{1, 2} and P{m: 1}."""
        kind, body = node.child_by_field_name("type"), node.child_by_field_name("body")
        if kind is None or body is None:
            return self.strange(node)
        made = self.listed(body)
        sizes = self.sizes_of(kind)
        if isinstance(made, nodes.Listed) and not made.items and sizes:
            return self.filled(sizes)
        struct = self.structs.get(self.last(kind))
        if struct and isinstance(made, nodes.Listed) and len(struct) == len(made.items):
            return nodes.Fields(struct, made.items)
        return made

    def member(self, node: Node) -> nodes.Node:
        """A field of a thing; of a module, the name alone."""
        parts = self.parts(node)
        of, name = parts[0], self.text(parts[-1])
        if of.type in NAMES and self.last(of) in MODULES and self.last(of) not in self.declared:
            return nodes.Word("pi") if name in ("PI", "Pi", "pi") else nodes.Word(plain_call(name))
        return nodes.Member(self.expression(of), name)

    def entry(self, node: Node) -> nodes.Node:
        """Entries by their places."""
        parts = self.parts(node)
        places = parts[1:]
        while len(places) == 1 and places[0].type in HOLDERS:
            places = [c for c in places[0].children if c.is_named and c.type not in REMARKS]  # with Julia's colon
        made: list[nodes.Node] = []
        for one in places:
            if one.type == "identifier" and self.text(one) == "end" and self.language.first:
                made.append(nodes.Unary("-", nodes.Number("1")))
            elif one.type in ("operator", "colon"):
                made.append(nodes.Span())
            else:
                made.append(self.place(self.expression(one)))
        if (
            self.language.first
            and parts[0].type == "identifier"
            and self.text(parts[0]) in ("SA", "SA_F64", "Float64", "T")
        ):
            return nodes.Listed(tuple(self.expression(one) for one in places))  # typed lists
        first = made[0] if len(made) == 1 else None
        if isinstance(first, nodes.Text):
            return nodes.Member(self.expression(parts[0]), first.text)
        return nodes.At(self.expression(parts[0]), tuple(made))

    def place(self, made: nodes.Node) -> nodes.Node:
        """A place counted from 0."""
        if not self.language.first:
            return made
        match made:
            case nodes.Span(first=None, last=None):
                return made
            case nodes.Span(first=first, last=last):
                start = None if first is None else nodes.Binary("-", first, nodes.Number("1"))
                is_end = last == nodes.Word("end")
                return nodes.Span(start, None if is_end or last is None else nodes.Binary("-", last, nodes.Number("1")))
            case nodes.Listed(items=items):
                return nodes.Listed(tuple(self.place(item) for item in items))
        return nodes.Binary("-", made, nodes.Number("1"))

    def either(self, node: Node) -> nodes.Node:
        """a ? b : c, and if of Rust, Kotlin and Julia where it has a value."""
        parts = [p for p in self.parts(node) if p.type not in ("line_comment",)]
        if len(parts) != 3:
            return self.strange(node)
        test, one, other = parts
        if other.type == "else_clause":
            other = self.parts(other)[0]
        if any(p.type in ("block", "control_structure_body") and len(self.parts(p)) != 1 for p in (one, other)):
            return self.strange(node)
        return nodes.Either(*(self.expression(p) for p in (test, one, other)))

    def span(self, node: Node) -> nodes.Node:
        """From here to there; of Julia and of ..= with the last."""
        parts = self.parts(node)
        sign = next((self.text(c) for c in node.children if self.text(c) in ("..=", "..", ":", "..<")), "")
        before = [p for p in parts if p.type != "operator"]
        if len(before) == 1:
            alone = self.expression(before[0])
            is_first = self.text(node).strip().startswith(self.text(before[0]))
            return nodes.Span(alone) if is_first else nodes.Span(None, self.one_more(alone, sign))
        if len(before) == 3:
            return nodes.Span(self.expression(before[0]), self.expression(before[2]), self.expression(before[1]))
        if len(before) != 2:
            return nodes.Span()
        first, last = (self.expression(p) for p in before)
        if (self.language.name == "Kotlin" and sign == "..") or self.language.first:
            sign = "..="
        return nodes.Span(first, self.one_more(last, sign))

    @staticmethod
    def one_more(last: nodes.Node, sign: str) -> nodes.Node:
        """The end of what has its last."""
        return nodes.Binary("+", last, nodes.Number("1")) if sign == "..=" else last

    def block(self, node: Node) -> nodes.Node:
        """Julia's matrix; a column is a vector."""
        made = tuple(tuple(self.apart(self.text(row))) for row in self.parts(node))
        if all(len(row) == 1 for row in made):
            items = nodes.Listed(tuple(row[0] for row in made))
            return nodes.Call(nodes.Word("hstack"), (items,)) if len(made) > 1 else items
        if len(made) == 1:
            return nodes.Block(made)
        return nodes.Block(made)

    def apart(self, text: str) -> list[nodes.Node]:
        """The entries of a row of Julia's, each read by itself: blanks part them, which the grammar takes for products."""
        from .parsed import expression_of

        made = []
        for entry in entries_of(text):
            tree = expression_of(self.language, entry)
            made.append(self.expression(tree) if tree is not None else nodes.Strange(entry[:60]))
        return made

    def comprehension(self, node: Node) -> nodes.Node:
        """[f(i) for i in 1:3] of Julia."""
        parts = self.parts(node)
        clauses = [p for p in parts if p.type == "for_clause"]
        bindings = [b for c in clauses for b in self.parts(c) if b.type == "for_binding"]
        if len(bindings) != 1 or len(parts) != 2:
            return self.strange(node)
        inside = [p for p in self.parts(bindings[0]) if p.type != "operator"]
        over = self.expression(inside[-1])
        self.declare(self.text(inside[0]))
        return nodes.Each(self.expression(parts[0]), self.text(inside[0]), over)

    def macro(self, node: Node) -> nodes.Node:
        """@SVector [a, b], @view x[1:2]; @. multiplies entry by entry."""
        parts = self.parts(node)
        name = self.text(parts[0]).lstrip("@")
        inner = self.parts(parts[-1]) if parts[-1].type == "macro_argument_list" else []
        if len(inner) != 1 or name not in (
            "SVector",
            "SMatrix",
            "view",
            "inbounds",
            "MVector",
            "SArray",
            "fastmath",
            ".",
        ):
            return self.strange(node)
        before, self.is_by_entries = self.is_by_entries, self.is_by_entries or name == "."
        made = self.expression(inner[0])
        self.is_by_entries = before
        return made
