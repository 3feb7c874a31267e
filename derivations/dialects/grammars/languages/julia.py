"""Julia."""

import re

from .language import Language

JULIA = Language(
    "Julia", "tree_sitter_julia",
    re.compile(r"(?m)^\s*(?:@[\w.]+\s+)*(?:function\b|\w+!?\([^()\n]*\)\s*=[^=]|\w+\s*=\s*\([^()]*\)\s*->|\w+\s*=\s*@\w+)"),
    not_if=re.compile(r"\{\s*$|\bfunction\s*\[|\blocal\b|\bthen\b|%|\bfunction\s+\w+\s*=|\bfunction\s*[\w.]*\([^)]*\)\s*\{|\bdef\s|\bvar\s|~|:=|<-",
                      re.MULTILINE),
    whole=False, powers=frozenset({"^"}), first=1, declares=False, is_linear=True,
    spaced=re.compile(r"(?<=[0-9.])(\.?[*/^]|[-+])\("),
)  # fmt: skip
