# ruff: noqa: E501 -- tables stand on one line; one branch for each kind
"""Loops, conditions and choices by number, as the follower's nodes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from ..traced import nodes
from .statements import SWITCHES, Statements

if TYPE_CHECKING:
    from tree_sitter import Node

GUARDS = re.compile(r"(?:throw_|assert|return_statement|return_expression)")
CASES = frozenset(("case_statement", "switch_block_statement_group", "switch_section", "switch_case", "switch_default",
                   "expression_case", "default_case", "match_arm", "switch_expression_arm", "switch_rule"))  # fmt: skip
LABELS = frozenset(("switch_label", "case_switch_label", "default_switch_label", "constant_pattern", "match_pattern",
                    "case_pattern_switch_label", "discard"))  # fmt: skip


class Control(Statements):
    """What decides which statements count."""

    def choice(self, node: Node) -> list[nodes.Statement]:
        """if, with what is done otherwise; one that only guards, or gives a default, says nothing."""
        line = self.line(node).split("{")[0].strip()[:60]
        if self.is_guard(node) or self.is_default(node):
            return []
        test = node.child_by_field_name("condition")
        parts = self.parts(node)
        if test is None:
            test = parts[0]
        others = [p for k, p in enumerate(node.children) if node.field_name_for_child(k) == "alternative"]
        rest = [p for p in parts if p not in others and p.start_byte >= test.end_byte]
        first = node.child_by_field_name("consequence") or node.child_by_field_name("body")
        if self.language.name == "Julia":
            inside = rest
        elif first is not None:
            inside = [first]
        else:  # Kotlin has no names for these
            inside, others = rest[:1], rest[1:2]
        body = tuple(s for one in inside for s in self.body_of(one))
        otherwise: tuple[nodes.Statement, ...] = ()
        for one in reversed(others):
            if one.type in ("elseif_clause", "else_if_clause"):
                otherwise = (self.elseif(one, otherwise),)
            else:
                otherwise = tuple(self.body_of(one))
        return [nodes.Choice(self.expression(test), body, otherwise, line, self.names_in(node))]

    def elseif(self, node: Node, otherwise: tuple[nodes.Statement, ...]) -> nodes.Choice:
        """Julia's elseif."""
        parts = self.parts(node)
        body = tuple(s for one in parts[1:] for s in self.body_of(one))
        return nodes.Choice(self.expression(parts[0]), body, otherwise, self.line(node)[:60], self.names_in(node))

    def body_of(self, node: Node) -> list[nodes.Statement]:
        """The statements of a block, or the one that stands without."""
        inner = self.parts(node)
        if node.type == "else_clause" and len(inner) == 1:
            return self.body_of(inner[0])
        if node.type in ("if_statement", "if_expression"):
            return self.choice(node)
        if node.type.endswith(("block", "compound_statement", "control_structure_body", "else_clause")):
            return self.body(node)
        return self.statement(node)

    def is_guard(self, node: Node) -> bool:
        """Whether nothing is done there but to leave with nothing, or to complain."""
        blocks = [c for c in self.walk(node) if c.type in ("compound_statement", "block", "statement_block")]
        text = self.text(node)
        inner = [p for b in blocks for p in self.parts(b)] if blocks else self.parts(node)[1:]
        inner = [p for one in inner for p in (self.parts(one) if one.type == "statement_list" else [one])]
        if re.search(r"\bNaN\b|\bnan\b", text):
            return False
        return (
            bool(inner)
            and all(
                "throw" in p.type
                or re.match(
                    r"return\s*;?$|return\s+(?:-?\d+|[A-Z_]{3,}|null|nil|false);?$|(?:throw|panic|error|assert)\b",
                    self.line(p),
                )
                for p in inner
            )
            and not re.search(r"\belse\b", text)
            and "double" not in self.returns
        )

    returns = ""  # the type of the function that is read now

    def is_default(self, node: Node) -> bool:
        """if g == 0 { g = 9.81 }: what the name is otherwise is what counts."""
        found = re.fullmatch(
            r"if\s*\(?\s*!?(?P<x>[\w.>-]+)\s*(?:={2,3}\s*(?:0(?:\.0*)?f?|null|nil|undefined|nothing))?\s*\)?\s*\{?\s*(?P<y>[\w.>-]+)\s*=\s*[-\w.]+\s*;?\s*\}?",
            self.line(node),
        )
        return found is not None and found["x"] == found["y"]

    def loop(self, node: Node) -> list[nodes.Statement]:
        """for of each kind."""
        body = node.child_by_field_name("body")
        clause = next((c for c in node.children if c.type in ("for_clause", "range_clause")), None)
        if self.language.name == "Julia":
            return self.of_julia(node)
        if self.language.name == "Kotlin":
            parts = self.parts(node)
            return self.each(node, parts[0], parts[1], parts[-1])
        if clause is not None and clause.type == "range_clause":
            return self.of_range(node, clause, body)
        holder = clause or node
        test = holder.child_by_field_name("condition")
        first = holder.child_by_field_name("initializer") or holder.child_by_field_name("init")
        after = holder.child_by_field_name("update") or holder.child_by_field_name("increment")
        if node.type == "for_statement" and (test is not None or first is not None):
            self.frames[-1].append(set())
            started = self.statement(first) if first is not None else []
            ended = self.statement(after) if after is not None else []
            made = [*started, *self.turns(node, test, ended, body)]
            self.frames[-1].pop()
            return made
        pattern = node.child_by_field_name("left") or node.child_by_field_name("name") or node.child_by_field_name("pattern") \
            or node.child_by_field_name("declarator")  # fmt: skip
        over = node.child_by_field_name("right") or node.child_by_field_name("value")
        if pattern is None or over is None or body is None:
            return [nodes.Unfollowed(self.line(node)[:60], self.names_in(node))]
        return self.each(node, pattern, over, body)

    def of_range(self, node: Node, clause: Node, body: Node | None) -> list[nodes.Statement]:
        """Go's for i, b := range bs."""
        left, over = clause.child_by_field_name("left"), clause.child_by_field_name("right")
        names = [self.text(n) for n in self.parts(left)] if left is not None else ["_"]
        if over is None or body is None or len(names) > 2:
            return [nodes.Unfollowed(self.line(node)[:60], self.names_in(node))]
        self.frames[-1].append(set(names))
        self.wholes.add(names[0])
        value = self.expression(over)
        inner = self.body(body)
        if len(names) == 2 and names[1] != "_":
            inner.insert(
                0, nodes.Assign(nodes.Word(names[1]), nodes.At(value, (nodes.Word(names[0]),)), self.line(node))
            )
        self.frames[-1].pop()
        counted = nodes.Call(nodes.Word("places·"), (value,))
        return [nodes.Repeat(names[0], counted, tuple(inner), self.line(node)[:60])]

    def each(self, node: Node, pattern: Node, over: Node, body: Node) -> list[nodes.Statement]:
        """for (const b of bs), for i in 0..3."""
        name = self.text(self.named(pattern)).split(":")[0].strip()
        if not name.isidentifier():
            return [nodes.Unfollowed(self.line(node)[:60], self.names_in(node))]
        self.frames[-1].append({name})
        is_range = over.type in ("range_expression", "infix_expression") or "indices" in self.text(over)
        self.wholes = self.wholes | {name} if is_range else self.wholes - {name}
        made = nodes.Repeat(name, self.expression(over), tuple(self.body(body)), self.line(node)[:60])
        self.frames[-1].pop()
        return [made]

    def of_julia(self, node: Node) -> list[nodes.Statement]:
        """for i in 1:3, j in 1:3 … end."""
        parts = self.parts(node)
        bindings = [p for p in parts if p.type == "for_binding"]
        made: list[nodes.Statement] = []
        for b in bindings:
            self.frames[-1][-1].add(self.text(self.parts(b)[0]))
        for one in (p for p in parts if p.type != "for_binding"):
            made += self.statement(one)
        for binding in reversed(bindings):
            inside = self.parts(binding)
            made = [nodes.Repeat(self.text(inside[0]), self.expression(inside[-1]), tuple(made), self.line(node)[:60])]
        return made

    def turns(
        self, node: Node, test: Node | None, after: list[nodes.Statement], body: Node | None
    ) -> list[nodes.Statement]:
        """while, and for with its three parts."""
        line = self.line(node).split("{")[0][:60]
        if test is None or body is None or test.type == ";":
            return [nodes.Unfollowed(line, self.names_in(node))]
        inner = tuple(self.body_of(body))
        return [nodes.Loop(self.expression(test), tuple(after), inner, line)]

    def switch(self, node: Node) -> list[nodes.Statement]:
        """switch and match on a whole number, as one condition after another."""
        line = self.line(node).split("{")[0][:60]
        value = node.child_by_field_name("value") or node.child_by_field_name("condition") or self.parts(node)[0]
        of = self.expression(value)
        cases = [c for c in self.walk(node) if c.type in CASES and self.owner(c) == node]
        made: list[tuple[list[nodes.Node], list[nodes.Statement]]] = []
        labels: list[nodes.Node] = []
        for case in cases:
            own, is_default = self.labels(case)
            labels += own
            statements = [s for p in self.inside(case) for s in self.statement(p)]
            if not statements and not is_default and case.type != "match_arm":
                continue  # falls through to the next
            ended = statements and isinstance(statements[-1], nodes.Return | nodes.Leave)
            if not ended and case != cases[-1] and self.language.name not in ("Go", "Rust"):
                return [nodes.Unfollowed(line, self.names_in(node))]
            if statements and isinstance(statements[-1], nodes.Leave) and statements[-1].kind == "break":
                statements.pop()
            if any(isinstance(s, nodes.Leave) for s in statements):
                return [nodes.Unfollowed(line, self.names_in(node))]
            made.append(([] if is_default else labels, statements))
            labels = []
        otherwise: tuple[nodes.Statement, ...] = next((tuple(s) for k, s in made if not k), ())
        for keys, body in reversed([m for m in made if m[0]]):
            test = nodes.Binary("==", of, keys[0])
            for key in keys[1:]:
                test = nodes.Binary("||", test, nodes.Binary("==", of, key))
            otherwise = (nodes.Choice(test, tuple(body), otherwise, line, self.names_in(node)),)
        return list(otherwise)

    def owner(self, node: Node) -> Node | None:
        """The switch that a case is of."""
        one = node.parent
        while one is not None and one.type not in SWITCHES:
            one = one.parent
        return one

    def labels(self, case: Node) -> tuple[list[nodes.Node], bool]:
        """The numbers of a case, and whether it is what is done otherwise."""
        head = self.text(case).lstrip()
        if head.startswith(("default", "_")):
            return [], True
        found = [c for c in case.children if c.type in LABELS]
        value = case.child_by_field_name("value")
        if not found and value is not None:
            return [
                self.expression(p) for p in (self.parts(value) if value.type == "expression_list" else [value])
            ], False
        if not found:
            return [self.expression(self.parts(case)[0])], False
        return [self.expression(p) for label in found for p in self.parts(label)], False

    def inside(self, case: Node) -> list[Node]:
        """The statements of a case."""
        colon = next((k for k, c in enumerate(case.children) if self.text(c) in (":", "=>", "->")), -1)
        return [
            c for c in case.children[colon + 1 :] if c.is_named and "comment" not in c.type and c.type not in LABELS
        ]
