# ruff: noqa: E501, PLR0911 -- tables stand on one line; one branch for each kind
"""Functions, closures, classes and structs of a syntax tree, and the whole text as the follower's statements."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from ..traced import nodes
from ..traced.values import NotFollowed
from .control import Control
from .expressions import CLOSURES
from .languages.language import Language
from .patterns import FIELDS, PATTERNS
from .statements import ASSIGNED, DECLARED

if TYPE_CHECKING:
    from tree_sitter import Node

FUNCTIONS = frozenset(("function_definition", "method_declaration", "function_declaration", "local_function_statement",
                       "function_item", "method_definition", "constructor_declaration", "operator_declaration",
                       "short_function_definition", "generator_function_declaration", "secondary_constructor",
                       "function_signature_item", "inline_method_definition"))  # fmt: skip
CLASSES = frozenset(("class_declaration", "class_specifier", "struct_specifier", "struct_item", "impl_item",
                     "struct_declaration", "record_declaration", "namespace_definition", "object_declaration",
                     "namespace_declaration", "file_scoped_namespace_declaration", "trait_item", "mod_item",
                     "module_definition", "template_declaration", "linkage_specification", "companion_object", "class",
                     "internal_module", "anonymous_initializer", "abstract_class_declaration", "class_body",
                     "declaration_list", "field_declaration_list", "enum_class_body"))  # fmt: skip
PARAMETERS = ("parameter_list", "formal_parameters", "parameters", "function_value_parameters", "closure_parameters",
              "inferred_parameters", "argument_list", "lambda_parameters")  # fmt: skip
TRIVIAL = re.compile(
    r"-?\d|[A-Z][A-Z_0-9]+|nil|null|None|nothing|true|false|void|undefined|Ok\(\(\)\)|\(\s*\)|self|this|\*this"
)
START = "__init__"


def no_leading_signs(text: str) -> None:
    """Raises NotFollowed where a line begins with a sign, and its language has ended the statement before."""
    depth = 0
    lines = text.split("\n")
    for line, behind in zip(lines, [*lines[1:], ""], strict=True):
        depth += sum((c in "([{") - (c in ")]}") for c in line.rstrip().removesuffix("{"))
        goes_on = re.search(r"[-+*/^=,(\[{&|<~]\s*$", line) is not None or not line.strip()
        if depth <= 0 and not goes_on and re.match(r"\s*[-+]", behind):
            shown = behind.strip()[:30]
            raise NotFollowed(f"{shown!r}: the statement ends with the line before it; put its sign there")
        depth = max(depth, 0)


class Functions(Control):
    """A whole text. ``language``: what it is in."""

    def __init__(self, language: Language, root: Node) -> None:
        super().__init__()
        self.language = language
        self.structs: dict[str, tuple[str, ...]] = {}
        self.functions: set[str] = set()
        self.in_class = 0
        self.changed: set[str] = set()  # fields that methods change
        self.root = root
        self.source = b" " * root.start_byte + (root.text or b"")
        self._gather()

    def _gather(self) -> None:
        """The names of all functions and structs, wherever they stand."""
        for node in self.walk(self.root):
            if node.type in FUNCTIONS:
                self.functions.add(self.name_of(node))
            elif node.type == "assignment" and self.language.first and self.parts(node)[0].type == "call_expression":
                self.functions.add(self.text(self.parts(self.parts(node)[0])[0]))
            if node.type in ("struct_specifier", "struct_item", "type_spec", "class_declaration", "record_declaration",
                             "struct_definition", "class_specifier"):  # fmt: skip
                names = self.fields_of(node)
                name = self.field(node, "name") or next(
                    (self.last(p) for p in self.walk(node) if p.type in ("identifier", "type_identifier")), ""
                )
                if names:
                    self.structs[name.split("<")[0]] = names
        self.functions -= {"", "wrapped"}

    def fields_of(self, node: Node) -> tuple[str, ...]:
        """The fields of a struct in their order."""
        if node.type == "struct_definition":  # Julia
            inside = [p for p in self.parts(node)[1:] if p.type in ("identifier", "typed_expression")]
            return tuple(self.text(p).split("::")[0] for p in inside)
        found = []
        for one in self.walk(node):
            if one.type == "class_parameter" and re.search(r"\b(?:val|var)\b", self.text(one)):
                found += [self.text(p) for p in self.parts(one) if p.type == "identifier"][:1]
            elif one.type == "field_declaration" and node.type in ("struct_specifier", "struct_item", "type_spec"):
                names = [c for k, c in enumerate(one.children) if one.field_name_for_child(k) in ("declarator", "name")]
                found += [self.text(self.named(n)) for n in names if n.is_named and "function" not in n.type]
            elif one.type == "formal_parameter" and node.type == "record_declaration":
                found.append(self.field(one, "name"))
        return tuple(found)

    def program(self) -> list[nodes.Statement]:
        """All statements of the text; what methods change has no value of its own outside."""
        if self.language.name in ("Julia", "Kotlin"):
            no_leading_signs(self.text(self.root))
        made = [s for part in self.parts(self.root) for s in self.statement(part)]
        if len(made) == 1 and isinstance(made[0], nodes.Define) and made[0].name == "wrapped":
            made = list(made[0].body)
        return [s for s in made if not (isinstance(s, nodes.Assign) and set(nodes.set_by(s.target)) & self.changed)]

    # definitions

    def defined(self, node: Node) -> list[nodes.Statement] | None:
        """What a definition of a function or of a class is; None of any other statement."""
        if node.type in FUNCTIONS:
            if self.name_of(node) == "wrapped" and len(self.frames) == 1:
                return self.body(node.child_by_field_name("body") or node)
            return [self.function_of(node, self.name_of(node))]
        if (
            self.language.first
            and node.type == "assignment"
            and self.parts(node)[0].type in ("call_expression", "where_expression")
        ):
            return [self.function_of(node, self.text(self.parts(self.parts(node)[0])[0]))]
        if node.type in ("type_spec", "struct_item"):
            return []
        if node.type in CLASSES:
            self.in_class += 1
            inner = [
                p for p in self.parts(node) if p.type not in ("type_identifier", "identifier", "primary_constructor")
            ]
            made = (
                [s for part in inner for s in self.statement(part)]
                if node.type != "struct_specifier" or self.has_code(node)
                else []
            )
            self.in_class -= 1
            return made
        if node.type == "property_declaration" and self.language.name == "C#":
            return self.property(node)
        if node.type == "property_declaration" and any(c.type == "getter" for c in node.children):
            getter = next(c for c in node.children if c.type == "getter")
            name = self.text(self.named(next(p for p in self.parts(node) if p.type == "variable_declaration")))
            return [self.function_of(getter, name)]
        return None

    def has_code(self, node: Node) -> bool:
        """Whether a struct has functions of its own."""
        return any(c.type in FUNCTIONS for c in self.walk(node))

    def property(self, node: Node) -> list[nodes.Statement]:
        """C#'s double X => …, and get { … }."""
        name = self.field(node, "name")
        value = node.child_by_field_name("value")
        getter = next((c for c in self.walk(node) if c.type == "accessor_declaration" and self.parts(c)), None)
        source = getter or (value if value is not None and value.type == "arrow_expression_clause" else None)
        if source is None:
            return []
        self.functions.add(name)
        return [self.function_of(source, name)]

    def name_of(self, node: Node) -> str:
        """The name of a function; of a constructor, that of Python's."""
        if node.type in ("constructor_declaration", "secondary_constructor"):
            return START
        if node.type == "function_definition" and self.language.first:  # Julia
            called = next((c for c in self.walk(node) if c.type == "call_expression"), None)
            return self.text(self.parts(called)[0]) if called is not None else ""
        declarator = node.child_by_field_name("declarator")
        if declarator is not None:
            while declarator.type != "function_declarator" and self.parts(declarator):
                declarator = declarator.child_by_field_name("declarator") or self.parts(declarator)[-1]
            inner = declarator.child_by_field_name("declarator")
            name = self.last(inner) if inner is not None else self.last(declarator)
            is_first = node.child_by_field_name("type") is None and not name.startswith("~") and "operator" not in name
            return START if is_first else name
        name = self.field(node, "name")
        return START if name == "constructor" else name

    def initial_fields(self, node: Node) -> list[nodes.Statement]:
        """What stands behind the colon of C++'s constructor."""
        made: list[nodes.Statement] = []
        held = next((c for c in node.children if c.type == "field_initializer_list"), None)
        if held is None or self.name_of(node) != START:
            return made
        self.frames.append([set(self.parameters(node)[0])])
        for one in self.parts(held):
            parts = self.parts(one)
            given = self.parts(parts[-1]) if len(parts) == 2 else []
            if len(given) == 1:
                target = nodes.Member(nodes.Word("self"), self.text(parts[0]))
                made.append(nodes.Assign(target, self.expression(given[0]), self.line(one)))
        self.frames.pop()
        return made

    def closure(self, node: Node) -> nodes.Node:
        """A function without a name."""
        define = self.function_of(node, "")
        if len(define.body) == 1 and isinstance(define.body[0], nodes.Return) and define.body[0].value is not None:
            return nodes.Nameless(define.parameters, define.body[0].value)
        return nodes.Nameless(define.parameters, nodes.Text("None"), define.body)

    def function_of(self, node: Node, name: str) -> nodes.Define:
        """A function: its parameters, and its statements."""
        self.frames.append([set()])
        before, self.returns = self.returns, self.field(node, "type") + self.field(node, "returns")
        wholes, shadowed = set(self.wholes), set(self.shadowed)
        parameters, optional, shared, first = self.parameters(node)
        outs = self.outs(node)
        for out in outs:
            self.declare(out)
        statements = (*self.initial_fields(node), *first, *self.function_body(node))
        if outs:
            statements = tuple(self.with_outs(statements, outs))
        for one in sorted(self.shadowed - shadowed):
            why = f"{one} is another thing in a block of its own; give it a name of its own"
            statements = (nodes.Unfollowed(why, ("return",)), *statements)
        self.shadowed = shadowed
        if name != START:
            self.changed |= self.changes(statements)
        self.returns, self.wholes = before, wholes
        self.frames.pop()
        return nodes.Define(name, parameters, outs, statements, "", shared, optional)

    def changes(self, statements: tuple[nodes.Statement, ...]) -> set[str]:
        """The names around a function that it changes."""
        found: set[str] = set()
        for s in statements:
            if isinstance(s, nodes.Assign) and (s.outer or isinstance(s.target, nodes.Member)):
                found |= {n.removeprefix("self.") for n in nodes.set_by(s.target)}
            for part in ("body", "otherwise", "after"):
                found |= self.changes(getattr(s, part, ())) if not isinstance(s, nodes.Define) else set()
        return found

    def outs(self, node: Node) -> tuple[str, ...]:
        """Go's results that have names."""
        result = node.child_by_field_name("result")
        if result is None or result.type != "parameter_list":
            return ()
        return tuple(self.text(n) for p in self.parts(result) for k, n in enumerate(p.children)
                     if p.field_name_for_child(k) == "name" and n.is_named)  # fmt: skip

    def with_outs(self, statements: tuple[nodes.Statement, ...], outs: tuple[str, ...]) -> list[nodes.Statement]:
        """return a, b of a function whose results have names."""
        made: list[nodes.Statement] = []
        for s in statements:
            if isinstance(s, nodes.Return) and s.value is not None:
                target = nodes.Listed(tuple(map(nodes.Word, outs))) if len(outs) > 1 else nodes.Word(next(iter(outs)))
                made += [nodes.Assign(target, s.value, s.line), nodes.Return(None, s.line)]
            else:
                made.append(s)
        return made

    def parameters(self, node: Node) -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...], list[nodes.Statement]]:
        """Names; those that need not be given; those whose change is seen outside; what is taken apart at once."""
        names: list[str] = []
        optional: list[str] = []
        shared: list[str] = []
        first: list[nodes.Statement] = []
        for one in self.parameter_nodes(node):
            text = self.text(one)
            if one.type in ("self_parameter", "receiver_parameter") or text.strip() in ("void", ""):
                continue
            found = self.parameter_names(one)
            pattern = self.named(one)
            if pattern is not None and pattern.type in FIELDS | PATTERNS and not self.language.first:
                name = "state" if not names and "state" not in names else f"given{len(names)}"
                names.append(name)
                if pattern.type in FIELDS:
                    first += self.taken_apart(pattern, nodes.Word(name), self.line(one))
                else:
                    first.append(nodes.Assign(self.target(pattern, new=True), nodes.Word(name), self.line(one)))
                continue
            kind = self.field(one, "type")
            for name in found:
                names.append(name)
                self.frames[-1][0].add(name)
                self.note_type(name, kind, None) if kind else self.wholes.discard(name)
                if "default" in one.type or one.child_by_field_name("value") is not None or "=" in text or "?" in text:
                    optional.append(name)
                if (re.search(r"[&*]", text) and "const" not in text.split(name)[0]) or re.search(
                    r"\b(?:out|ref|mut)\b", text
                ):
                    shared.append(name)
        twice = {name for name in names if names.count(name) > 1 and name != "_"}
        if twice:
            raise NotFollowed(f"two parameters are called {min(twice)}; give each a name of its own")
        return tuple(names), tuple(optional), tuple(shared), first

    def parameter_nodes(self, node: Node) -> list[Node]:
        """The parameters of a function, as they stand."""
        holder = node.child_by_field_name("parameters") or node.child_by_field_name("parameter")
        if holder is None and self.language.first:
            called = next((c for c in self.walk(node) if c.type == "call_expression"), None)
            if node.type == "arrow_function_expression":
                head = self.parts(node)[0]
                return self.parts(head) if head.type in ("argument_list", "tuple_expression") else [head]
            holder = (
                next((c for c in called.children if c.type == "argument_list"), None) if called is not None else None
            )
        if holder is None:
            around = node.child_by_field_name("declarator") or node
            holder = next((c for c in self.walk(around) if c.type in PARAMETERS), None) if node.type not in (
                "getter", "accessor_declaration", "arrow_expression_clause") else None  # fmt: skip
        if holder is None:
            return []
        return self.parts(holder) if holder.type in PARAMETERS else [holder]

    def parameter_names(self, node: Node) -> list[str]:
        """One name; several of Go's a, b float64."""
        several = [c for k, c in enumerate(node.children) if node.field_name_for_child(k) == "name" and c.is_named]
        if several:
            return [self.text(c) for c in several]
        inner = self.named(node)
        if inner is not None and inner.type in ("parameter", "named_argument", "optional_parameter"):
            inner = next((p for p in self.parts(inner) if "identifier" in p.type), inner)
        text = self.text(inner).split("::")[0].split("=")[0].strip()
        if inner is not None and inner.type in ("parameter_declaration", "abstract_declarator"):
            return ["_"]
        return [re.split(r"[\s,:=()\[\]{}&*]", text.strip())[0] or "_"]

    # bodies

    def function_body(self, node: Node) -> list[nodes.Statement]:
        """A function's statements, with a return of its value where that stands last by itself."""
        body = node.child_by_field_name("body")
        if body is None and self.language.first:
            return self.of_julia_body(node)
        if body is None:
            body = next(
                (c for c in node.children if c.type in ("function_body", "block", "arrow_expression_clause")), None
            )
        if body is None and node.type == "lambda_literal":
            inner = [p for p in self.parts(node) if p.type not in ("lambda_parameters",)]
            return self.with_last(inner)
        if body is None:
            body = node if node.type == "arrow_expression_clause" else None
        if body is None:
            return []
        if body.type == "function_body":
            inner = self.parts(body)
            body = inner[0] if inner else body
        if body.type == "arrow_expression_clause":
            return self.value(self.parts(body)[0])
        is_block = body.type in ("compound_statement", "block", "statement_block", "constructor_body")
        if not is_block:
            return self.value(body)
        inner = [p for one in self.parts(body) for p in (self.parts(one) if one.type == "statement_list" else [one])]
        return self.with_last(inner) if self.language.name == "Rust" else self.returned(inner)

    def of_julia_body(self, node: Node) -> list[nodes.Statement]:
        parts = self.parts(node)
        if node.type in ("assignment", "arrow_function_expression"):
            return (
                self.value(parts[-1])
                if parts[-1].type not in ("compound_statement", "begin_statement")
                else self.with_last(self.parts(parts[-1]))
            )
        body = [p for p in parts if p.type != "signature"]
        if not body or body[-1].type not in FUNCTIONS:
            return self.with_last(body)
        name = self.name_of(body[-1])  # a function that stands last is what is given back
        return [*self.with_last(body), nodes.Return(nodes.Word(name), self.line(body[-1]))]

    def value(self, node: Node) -> list[nodes.Statement]:
        """An expression that is what a function gives back."""
        if node.type in ASSIGNED or "update" in node.type:
            return self.statement(node)
        if node.type in ("return_expression",):
            return self.statement(node)
        return [nodes.Return(self.expression(node), self.line(node))]

    def with_last(self, inner: list[Node]) -> list[nodes.Statement]:
        """Statements of which the last gives what the function gives back."""
        made = self.returned(inner[:-1])
        if not inner:
            return made
        last = inner[-1]
        bare = (
            self.parts(last)[0]
            if last.type == "expression_statement" and not self.text(last).rstrip().endswith(";")
            else last
        )
        is_value = bare.type not in (*ASSIGNED, *DECLARED, *FUNCTIONS, "for_statement", "for_expression", "while_statement", "macro_invocation",
                                     "return_statement", "return_expression", "expression_statement", "macrocall_expression")  # fmt: skip
        if bare.type in ("if_expression", "match_expression", "if_statement"):
            return [*made, *self.returned([last], last=True)]
        if bare.type == "macrocall_expression" and self.text(bare).startswith(
            ("@SVector", "@SMatrix", "@view", "@SArray")
        ):
            is_value = True
        if is_value and not TRIVIAL.fullmatch(self.text(bare)):
            return [*made, nodes.Return(self.expression(bare), self.line(bare))]
        if is_value:
            return made
        return [*made, *self.returned([last])]

    def returned(self, inner: list[Node], *, last: bool = False) -> list[nodes.Statement]:
        """Statements, without returns that give back nothing of mechanics."""
        made: list[nodes.Statement] = []
        for part in inner:
            made += [self.given_back(s) if last else self.bare_return(s) for s in self.statement(part)]
        return made

    def given_back(self, s: nodes.Statement) -> nodes.Statement:
        """The value of each branch, of Rust's if and match."""
        if isinstance(s, nodes.Choice):
            return replace(s, body=self._last_given(s.body), otherwise=self._last_given(s.otherwise))
        return nodes.Return(s.value, s.line) if isinstance(s, nodes.Do) else s

    def _last_given(self, body: tuple[nodes.Statement, ...]) -> tuple[nodes.Statement, ...]:
        return (*body[:-1], self.given_back(body[-1])) if body else body

    def bare_return(self, s: nodes.Statement) -> nodes.Statement:
        """return 0 of a function that gives back whether all went well."""
        if not isinstance(s, nodes.Return) or s.value is None:
            return s
        text = re.sub(r"^return\b\s*|;$", "", s.line).strip()
        text = text[1:-1].strip() if re.fullmatch(r"\(\s*\S+\s*\)", text) else text
        is_status = self.is_whole_type(self.returns) or not re.fullmatch(r"-?\d", text)
        return nodes.Return(None, s.line) if TRIVIAL.fullmatch(text) and is_status else s

    def of_macro(self, name: str, parameters: str, value: str, node: Node) -> list[nodes.Statement]:
        """#define g 9.81, #define SQ(x) ((x)*(x)). Refused without brackets where these change what is meant."""
        from .parsed import expression_of

        if not value:
            return []
        line = self.line(node)
        given = tuple(p.strip() for p in parameters.split(",") if p.strip())
        inner = re.sub(r"\([^()]*(?:\([^()]*(?:\([^()]*\)[^()]*)*\)[^()]*)*\)", "x", value)
        is_bare = re.search(r"(?<![eE(])\s*[-+*/](?!$)", inner[1:]) is not None
        bare_one = next((x for x in given if re.search(rf"(?<![\w(]){x}(?!\w)|(?<!\w){x}(?![\w)])", re.sub(r"\s", "", value))
                         and not re.fullmatch(rf"[\w:.]*\(\s*{x}\s*\)", value)), None)  # fmt: skip
        if is_bare or bare_one:
            why = f"#define {name} {value[:30]}: put brackets around it; without, what stands beside it binds first"
            return [nodes.Unfollowed(why, (name,))]
        tree = expression_of(self.language, value)
        if tree is None:
            return []
        self.frames.append([set(given)])
        made = self.expression(tree)
        self.frames.pop()
        if given:
            self.functions.add(name)
            return [nodes.Define(name, given, (), (nodes.Return(made, line),))]
        self.frames[0][0].add(name)
        return [nodes.Assign(nodes.Word(name), made, line)]


__all__ = ["CLOSURES", "Functions"]
