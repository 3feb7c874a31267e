"""Go."""

import re

from .language import Language

GO = Language(
    "Go", "tree_sitter_go",
    re.compile(r"\bfunc\s*(?:\([^)\n]*\)\s*)?\w*\s*\(|:="),
    not_if=re.compile(r"->|\bfn\s|\blet\s|#include|\binit\s*\(|\bend\b"),
    wraps=(("", ""), ("func wrapped() {\n", "\n}")),
    copies=True,
)  # fmt: skip
