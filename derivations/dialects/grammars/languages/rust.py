"""Rust."""

import re

from .language import Language

RUST = Language(
    "Rust", "tree_sitter_rust",
    re.compile(r"\bfn\s+\w+|\blet\s+mut\b|\blet\s+\w+\s*=\s*\|"),
    wraps=(("", ""), ("fn wrapped() {\n", "\n}")),
    copies=True,
    blank=re.compile(r"(?<![\w:])(?:nd::|ndarray::|na::|nalgebra::)?(?:vec|array|dvector|vector)!(?=\s*\[)"),
)  # fmt: skip
