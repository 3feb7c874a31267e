"""Kotlin."""

import re

from .language import Language

KOTLIN = Language(
    "Kotlin", "tree_sitter_kotlin",
    re.compile(r"\bfun\s+\w+|\bdata\s+class\b"),
)  # fmt: skip
