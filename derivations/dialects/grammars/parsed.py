"""The language of a text, and its syntax tree by that language's grammar. Nothing is run."""

from __future__ import annotations

import importlib
import re
from functools import cache
from typing import TYPE_CHECKING

from .languages.c import GLSL, C
from .languages.csharp import CSHARP
from .languages.go import GO
from .languages.java import JAVA
from .languages.julia import JULIA
from .languages.kotlin import KOTLIN
from .languages.language import Language
from .languages.rust import RUST
from .languages.typescript import SCRIPT

if TYPE_CHECKING:
    from tree_sitter import Node, Parser

LANGUAGES = (RUST, KOTLIN, GO, CSHARP, GLSL, SCRIPT, JULIA, JAVA, C)
LONGEST, DEEPEST, MOST_NODES = 20_000, 120, 40_000
OTHERS = re.compile(
    r"\\begin|\\frac|Symbol\(|(?m:^\s*(?:import|from)\s+[\w.]+\s*(?:$|import\b|as\b))|(?m:^\s*def\s+\w+\s*\(.*:\s*$)|\bimport\s+'dart"
)


@cache
def _parser(grammar: str, function: str) -> Parser:
    from tree_sitter import Language as Grammar
    from tree_sitter import Parser

    return Parser(Grammar(getattr(importlib.import_module(grammar), function)()))


def parsed(text: str) -> tuple[Language, Node] | None:
    """The first language whose grammar has all of the text; None where none has, or the text is too long or deep."""
    if len(text) > LONGEST or OTHERS.search(text):
        return None
    for language in LANGUAGES:
        if not language.cue.search(text) or (language.not_if and language.not_if.search(text)):
            continue
        bare = text if language.blank is None else language.blank.sub(lambda m: " " * len(m[0]), text)
        bare = bare if language.spaced is None else language.spaced.sub(r" \1 (", bare)
        parser = _parser(language.grammar, language.function)
        for before, behind in language.wraps:
            root = parser.parse((before + bare + behind).encode()).root_node
            if not root.has_error and _is_bounded(root):
                return language, root
    return None


def _is_bounded(root: Node) -> bool:
    """Whether a tree is neither too deep nor too large, without going down into it by calls."""
    cursor = root.walk()
    depth = count = 0
    while True:
        count += 1
        if depth > DEEPEST or count > MOST_NODES:
            return False
        if cursor.goto_first_child():
            depth += 1
            continue
        while not cursor.goto_next_sibling():
            if not cursor.goto_parent():
                return True
            depth -= 1


def expression_of(language: Language, text: str) -> Node | None:
    """The syntax tree of one expression of C, or of Julia."""
    before, behind = ("double wrapped = ", ";") if language.grammar == "tree_sitter_cpp" else ("wrapped = ", "")
    root = _parser(language.grammar, language.function).parse(f"{before}{text}{behind}".encode()).root_node
    if root.has_error or not root.children:
        return None
    if not behind:
        return root.children[0].children[-1]
    found = next((c for c in root.children[0].children if c.type == "init_declarator"), None)
    return found.child_by_field_name("value") if found is not None else None
