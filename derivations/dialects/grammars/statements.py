# ruff: noqa: E501, PLR0911, PLR0912 -- tables stand on one line; one branch for each kind
"""Statements of a syntax tree as the follower's nodes, whatever the language."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from ..traced import nodes
from ..traced.values import NotFollowed
from .declared import Declared
from .expressions import CLOSURES
from .patterns import FIELDS

if TYPE_CHECKING:
    from tree_sitter import Node

BLOCKS = frozenset(("compound_statement", "block", "statement_block", "statement_list", "declaration_list",
                    "control_structure_body", "function_body", "unsafe_block", "constructor_body", "lambda_body",
                    "expression_statement", "global_statement", "statements", "field_declaration_list_of",
                    "export_statement", "const_statement", "else_clause", "labeled_statement", "begin_statement"))  # fmt: skip
WRAPS = frozenset(("expression_statement", "global_statement", "export_statement", "const_statement", "labeled_statement",
                   "statement_list", "function_body", "declaration_list"))  # fmt: skip
GUARD = re.compile(r"#\s*(?:ifndef\s+\w*(?:_H|_HPP|_H_|_HPP_|_INCLUDED|_H__)|ifdef\s+__cplusplus|ifndef\s+M_PI\w*)\s*$")
ASSIGNED = frozenset(("assignment_expression", "augmented_assignment_expression", "assignment", "assignment_statement",
                      "compound_assignment_expr", "compound_assignment_expression", "short_var_declaration"))  # fmt: skip
DECLARED = frozenset(("declaration", "lexical_declaration", "variable_declaration", "local_variable_declaration",
                      "local_declaration_statement", "field_declaration", "let_declaration", "const_item", "static_item",
                      "var_declaration", "const_declaration", "property_declaration", "public_field_definition",
                      "field_definition", "const_spec", "var_spec", "variable_declarator"))  # fmt: skip
RETURNS = frozenset(("return_statement", "return_expression"))
IFS = frozenset(("if_statement", "if_expression", "else_if_clause", "elseif_clause", "when_expression_of"))
EACH = frozenset(
    ("for_in_statement", "enhanced_for_statement", "foreach_statement", "for_expression", "for_range_loop")
)
SWITCHES = frozenset(("switch_statement", "switch_expression", "expression_switch_statement", "match_expression"))
UPDATES = frozenset(("update_expression", "postfix_unary_expression", "prefix_unary_expression", "inc_statement",
                     "dec_statement", "postfix_expression"))  # fmt: skip
NOTHING = frozenset((
    "struct_item", "interface_declaration", "type_alias_declaration", "type_declaration", "import_statement",
    "import_declaration", "preproc_include", "using_directive", "use_declaration", "package_clause", "empty_statement",
    "using_declaration", "type_definition", "access_specifier", "preproc_call", "throw_statement", "package_header",
    "import_header", "import", "assert_statement", "attribute_item", "inner_attribute_item", "static_assert_declaration",
    "abstract_type", "primary_constructor", "delegation_specifiers", "type_alias", "module_declaration_of", "enum_declaration",
    "debugger_statement", "predefined_type", "base_list", "identifier", "type_identifier", "superclass", "class_heritage",
    "type_parameters", "super_interfaces", "string_literal", "line_comment", "template_parameter_list", "struct_definition",
    "annotation", "record_declaration_of", "accessor_list", "package_declaration", "goto_statement_of", "using_statement",
    "import_list", "macro_definition", "declaration_list_of", "throw_expression", "alias_declaration", "preproc_if_of",
    "friend_declaration", "enum_specifier", "enum_item", "export_statement_of", "string", "namespace_identifier",
))  # fmt: skip
HARMLESS_MACROS = frozenset(("assert", "debug_assert", "println", "print", "eprintln"))


class Statements(Declared):
    """The statements of a text. ``in_class``: how many classes are around."""

    in_class = 0

    def body(self, node: Node) -> list[nodes.Statement]:
        """The statements of a block, in a block of names of its own."""
        self.frames[-1].append(set())
        shadowed_before = set(self.shadowed)
        made = [one for part in self.parts(node) for one in self.statement(part)]
        made += [nodes.Unfollowed(f"{name} is another thing in a block of its own", (name, "return"))
                 for name in sorted(self.shadowed - shadowed_before)]  # fmt: skip
        self.frames[-1].pop()
        return made

    def statement(self, node: Node) -> list[nodes.Statement]:
        """What a statement is; several, where it sets several names."""
        kind, line = node.type, self.line(node)
        found = self.defined(node)  # type: ignore[attr-defined]
        if found is not None:
            return found  # type: ignore[no-any-return]
        if kind in NOTHING:
            return []
        if kind in BLOCKS:
            inner = self.parts(node)
            if len(inner) == 1 and kind in WRAPS:
                return self.statement(inner[0])
            return self.body(node) if kind not in ("export_statement", "const_statement") else [
                s for part in inner for s in self.statement(part)]  # fmt: skip
        if kind in ASSIGNED:
            return self.assigned(node)
        if kind in DECLARED:
            return self.declaration(node)
        if kind in RETURNS:
            parts = self.parts(node)
            return [nodes.Return(self.expression(parts[0]) if parts else None, line)]
        if kind in IFS:
            return self.choice(node)
        if kind in EACH or kind == "for_statement":
            return self.loop(node)
        if kind in ("while_statement", "while_expression"):
            return self.turns(node, node.child_by_field_name("condition"), [], node.child_by_field_name("body"))
        if kind in SWITCHES:
            return self.switch(node)
        if kind in UPDATES:
            return self.update(node)
        if kind in ("break_statement", "break_expression"):
            return [nodes.Leave("break", line)]
        if kind in ("continue_statement", "continue_expression"):
            return [nodes.Leave("continue", line)]
        if kind == "goto_statement":
            return [nodes.Unfollowed(line, ("return",))]
        if kind == "comma_expression":
            return self.comma(node)
        if kind == "binary_expression" and "<<" in self.text(node):
            return self.poured(node)
        if kind == "macrocall_expression":
            return self.macro_statement(node)
        if kind == "macro_invocation" and self.text(self.parts(node)[0]) in HARMLESS_MACROS:
            return []
        if kind in ("preproc_def", "preproc_function_def"):
            return self.defined_word(node)
        if kind.startswith("preproc_if"):
            return self.on_condition(node)
        made = self.expression(node)
        if isinstance(made, nodes.Strange):
            return [nodes.Unfollowed(line, self.names_in(node))]
        return [nodes.Do(made, line)]

    def names_in(self, node: Node) -> tuple[str, ...]:
        """What a part may change; "return" and "continue" where it may end a function, or a turn."""
        found = []
        for one in self.walk(node):
            if one.type in ("identifier", "field_identifier", "property_identifier"):
                found.append(self.text(one))
            if one.type in RETURNS:
                found.append("return")
            if one.type in ("continue_statement", "break_statement", "continue_expression", "break_expression"):
                found.append("continue")
        return tuple(dict.fromkeys(found))

    # assignments

    def put(self, target: nodes.Node, value: nodes.Node, line: str, sign: str = "") -> nodes.Assign:
        """An assignment, to a name of the function's own or of the text around it."""
        name = target.name if isinstance(target, nodes.Word) else None
        return nodes.Assign(target, value, line, sign, outer=name is not None and not self.is_own(name))

    def assigned(self, node: Node) -> list[nodes.Statement]:
        """a = b, a += b, a = b = c, a, b = c, d."""
        line = self.line(node)
        parts = self.parts(node)
        left, right = node.child_by_field_name("left") or parts[0], node.child_by_field_name("right") or parts[-1]
        between = [
            self.text(c) for c in node.children if c.start_byte >= left.end_byte and c.end_byte <= right.start_byte
        ]
        sign = next((x for x in between if "=" in x), "=").rstrip("=").rstrip(":").lstrip(".")
        if left.type == "expression_list" and len(self.parts(left)) == 1:
            left = self.parts(left)[0]
        if right.type == "expression_list" and len(self.parts(right)) == 1:
            right = self.parts(right)[0]
        made: list[nodes.Statement] = []
        if right.type in ASSIGNED and not sign:  # a = b = c
            made = self.assigned(right)
            inner = self.parts(right)
            value = self.expression(right.child_by_field_name("left") or inner[0])
        else:
            value = self.expression(right)
        if sign and sign not in ("+", "-", "*", "/"):
            return [nodes.Unfollowed(line, self.names_in(left))]
        if sign == "/" and self.language.whole and self.is_whole(left) and self.is_whole(right):
            sign = "div"
        is_new = node.type == "short_var_declaration"
        if left.type in FIELDS or (left.type == "tuple_expression" and ";" in self.text(left)):
            return made + self.taken_apart(left, value, line)
        if is_new:
            names = self.parts(left) if left.type == "expression_list" else [left]
            values = self.parts(right) if right.type == "expression_list" else [right]
            for k, one in enumerate(names):
                if not self.is_own(self.text(one)):
                    self.note_type(self.text(one), "", values[k] if len(values) == len(names) else None)
        target = self.target(left, new=is_new)
        if not self.language.declares and isinstance(target, nodes.Word | nodes.Listed):
            for name in nodes.set_by(target):
                self.frames[-1][-1].add(name)
        return [*made, self.put(target, value, line, sign)]

    def update(self, node: Node) -> list[nodes.Statement]:
        """i++, --i"""
        sign = "+" if "++" in self.text(node) else "-" if "--" in self.text(node) else ""
        if not sign:
            return []
        target = self.expression(self.parts(node)[0])
        return [self.put(target, nodes.Number("1"), self.line(node), sign)]

    def declaration(self, node: Node) -> list[nodes.Statement]:
        """Names with their types, and with values where they have them."""
        line = self.line(node)
        made: list[nodes.Statement] = []
        kind_node = node.child_by_field_name("type")
        kind = self.text(kind_node)
        inner = [
            c for c in self.parts(node) if c.type in ("const_spec", "var_spec", "var_spec_list", "variable_declaration")
        ]
        if inner and node.type != "property_declaration":
            return [s for one in inner for s in (self.declaration(one) if one.type != "var_spec_list" else
                                                 [s for x in self.parts(one) for s in self.declaration(x)])]  # fmt: skip
        declarators = [c for c in node.children if c.type in ("variable_declarator", "init_declarator")
                       or node.field_name_for_child(node.children.index(c)) == "declarator"]  # fmt: skip
        if node.type in ("const_spec", "var_spec"):
            return self.spec(node, kind_node)
        if (node.type == "property_declaration" and self.language.name == "Kotlin") or node.type in (
            "property_declaration",
            "public_field_definition",
            "field_definition",
            "let_declaration",
            "const_item",
            "static_item",
            "variable_declarator",
        ):
            declarators = [node]
        if kind == "goto":  # of C, where Java's grammar reads it
            return [nodes.Unfollowed(line, ("return",))]
        is_static = any(
            c.type in ("storage_class_specifier", "modifiers") and "static" in self.text(c) for c in node.children
        )
        if is_static and len(self.frames) > 1 and not re.search(r"\bconst\b|\bconstexpr\b|\bfinal\b", line):
            names = tuple(self.text(self.named(one)) for one in declarators)
            for name in names:
                self.declare(name)
            return [nodes.Unfollowed(line, names)]
        for one in declarators:
            if one.type == "function_declarator" and len(self.frames) > 1:  # Vector3d qd(y[3], y[4], y[5]);
                made += self.constructed(one, kind, kind_node, line)
                continue
            if one.type == "function_declarator" or "function_declarator" in {c.type for c in one.children}:
                continue
            made += self.declared_one(one, kind, kind_node, node, line)
        return made

    def constructed(self, one: Node, kind: str, kind_node: Node | None, line: str) -> list[nodes.Statement]:
        """A thing that is made of values in round brackets."""
        from .parsed import expression_of

        called = expression_of(self.language, self.text(one))
        given = called.child_by_field_name("arguments") if called is not None else None
        if given is None:
            return [nodes.Unfollowed(line, (self.text(self.named(one)),))]
        value = self.initial(kind, kind_node, given)
        name = self.text(self.named(one))
        self.declare(name)
        return [nodes.Assign(nodes.Word(name), value, line)] if value is not None else []

    def declared_one(
        self, one: Node, kind: str, kind_node: Node | None, whole: Node, line: str
    ) -> list[nodes.Statement]:
        """One name, or one pattern, that is declared."""
        value_node = one.child_by_field_name("value") or one.child_by_field_name("default_value")
        name_node = (
            one.child_by_field_name("declarator")
            or one.child_by_field_name("pattern")
            or one.child_by_field_name("name")
        )
        parts = self.parts(one)
        if one.type == "array_declarator":
            name_node = one
        if name_node is None:
            name_node = next((p for p in parts if p.type in ("variable_declaration", "multi_variable_declaration", "tuple_pattern",
                              "identifier", "field_identifier", "property_identifier")), one)  # fmt: skip
        if value_node is None and any(self.text(c) == "=" for c in one.children):
            equals = next(c for c in one.children if self.text(c) == "=")
            value_node = next((p for p in parts if p.start_byte >= equals.end_byte), None)
        if one == name_node and whole.child_by_field_name("default_value") is not None:
            value_node = whole.child_by_field_name("default_value")
        if kind_node is None and one.child_by_field_name("type") is not None:
            kind = self.text(one.child_by_field_name("type")).lstrip(": ")
        if name_node.type in FIELDS:
            return self.taken_apart(name_node, self.expression(value_node), line) if value_node is not None else []
        if value_node is not None and value_node.type in CLOSURES and name_node.type not in ("array_pattern",):
            name = self.text(self.named(name_node))
            self.functions.add(name)
            return [self.function_of(value_node, name)]  # type: ignore[attr-defined]
        value: nodes.Node | None
        if value_node is None:
            value = self.unfilled(name_node, kind, kind_node)
        elif value_node.type in ("argument_list", "initializer_list") and self.language.grammar == "tree_sitter_cpp":
            value = self.initial(kind, kind_node, value_node)
        else:
            value = self.expression(value_node)
        inner = self.named(name_node)
        if (
            value_node is not None
            and self.sizes_of(name_node)
            and isinstance(value, nodes.Listed)
            and not any(not isinstance(i, nodes.Number) or i.text.strip("0.") for i in value.items)
        ):
            value = self.filled(self.sizes_of(name_node))
        self.note_type(self.text(inner), kind, value_node)
        target = self.target(name_node, new=True)
        is_field = self.in_class > 0 and len(self.frames) == 1
        if (
            isinstance(value, nodes.Call)
            and value.of in (nodes.Word("zeros"), nodes.Word("matrix"))
            and (is_field or (value_node is None and self.language.grammar == "tree_sitter_cpp"))
        ):
            value = nodes.Call(nodes.Word("unfilled·"), (nodes.Text(self.text(inner)), value))
        if value is None:
            return []
        made: list[nodes.Statement] = []
        if value_node is not None and value_node.type in ("assignment_expression",):
            made = self.assigned(value_node)
            value = self.expression(self.parts(value_node)[0])
        return [*made, nodes.Assign(target, value, line)]

    def spec(self, node: Node, kind_node: Node | None) -> list[nodes.Statement]:
        """Go's var a, b = 1, 2."""
        names = [c for k, c in enumerate(node.children) if node.field_name_for_child(k) == "name" and c.is_named]
        value = node.child_by_field_name("value")
        values = self.parts(value) if value is not None else []
        made: list[nodes.Statement] = []
        sizes = self.sizes_of(kind_node) if kind_node is not None else []
        names += [c for c in self.parts(node) if c.type == "identifier" and c not in names]
        for k, name in enumerate(names):
            one = values[k] if k < len(values) and len(values) == len(names) else None
            if one is not None and one.type in CLOSURES:
                self.functions.add(self.text(name))
                made.append(self.function_of(one, self.text(name)))  # type: ignore[attr-defined]
                continue
            self.note_type(self.text(name), self.text(kind_node), one)
            target = self.target(name, new=True)
            if one is not None:
                made.append(nodes.Assign(target, self.expression(one), self.line(node)))
            elif sizes:
                made.append(nodes.Assign(target, self.filled(sizes), self.line(node)))
        if len(values) == 1 < len(names):
            listed = nodes.Listed(tuple(nodes.Word(self.text(n)) for n in names))
            made = [nodes.Assign(listed, self.expression(values[0]), self.line(node))]
        return made

    def comma(self, node: Node) -> list[nodes.Statement]:
        """a = 1, b = 2, and Eigen's M << a, b, c, d."""
        flat: list[Node] = []
        waiting = [node]
        while waiting:
            one = waiting.pop()
            if one.type == "comma_expression":
                waiting += reversed(self.parts(one))
            else:
                flat.append(one)
        if "<<" in self.text(flat[0]) and flat[0].type == "binary_expression":
            return self.poured(flat[0], flat[1:])
        return [s for one in flat for s in self.statement(one)]

    def poured(self, node: Node, rest: list[Node] | None = None) -> list[nodes.Statement]:
        """M << a, b, c, d fills what M is, row by row."""
        left, first = self.parts(node)
        if left.type not in ("identifier", "field_expression"):
            return []  # std::cout << …
        values = tuple(self.expression(v) for v in (first, *(rest or [])))
        return [nodes.Do(nodes.Call(nodes.Word("poured·"), (self.expression(left), *values)), self.line(node))]

    def defined_word(self, node: Node) -> list[nodes.Statement]:
        """#define of a value; put in brackets only where it needs none."""
        name, value = self.field(node, "name"), self.field(node, "value").split("//")[0].split("/*")[0].strip()
        return self.of_macro(name, self.field(node, "parameters").strip("()"), value, node)  # type: ignore[attr-defined,no-any-return]

    def on_condition(self, node: Node) -> list[nodes.Statement]:
        """#if … of headers says nothing; any other chooses what is not known."""
        text = self.text(node)
        if GUARD.match(text.splitlines()[0].strip()):
            return [s for part in self.parts(node)[1:] for s in self.statement(part)]
        raise NotFollowed(f"{text.splitlines()[0].strip()[:30]!r}: code on a condition; give the one that is meant")

    def macro_statement(self, node: Node) -> list[nodes.Statement]:
        """@unpack a, b = p; @inline function …; @. du = …"""
        parts = self.parts(node)
        name = self.text(parts[0]).lstrip("@").split(".")[-1]
        inner = self.parts(parts[-1]) if parts[-1].type == "macro_argument_list" else []
        if name in ("unpack", "unpack_"):
            return [s for one in inner for s in self.unpacked(one)]
        before = self.is_by_entries
        self.is_by_entries = before or name in ("", ".")
        made = [s for one in inner for s in self.statement(one)]
        self.is_by_entries = before
        return made

    def unpacked(self, node: Node) -> list[nodes.Statement]:
        """@unpack a, b = p: fields by their names."""
        parts = self.parts(node)
        return self.taken_apart(parts[0], self.expression(parts[-1]), self.line(node)) if len(parts) == 2 else []

    # what follow.py has to decide

    def choice(self, node: Node) -> list[nodes.Statement]:
        raise NotImplementedError

    loop = switch = choice

    def turns(
        self, node: Node, test: Node | None, after: list[nodes.Statement], body: Node | None
    ) -> list[nodes.Statement]:
        raise NotImplementedError
