"""A language whose blocks end by indentation, in braces: GDScript."""

from __future__ import annotations

import re
from dataclasses import replace

from .braces import from_braces
from .program import Program

SCRIPT = re.compile(r"(?m)^\s*(?:static\s+)?func\s+\w+\s*\([^\n]*\)\s*(?:->\s*[\w\[\]]+\s*)?:\s*(?:#[^\n]*)?$")


def from_words(text: str) -> Program | None:
    """A program of GDScript; None for any other."""
    if SCRIPT.search(text):
        return replace(from_braces(_indented(text), by_lines=True), whole=True, powers=("**",))
    return None


def _indented(text: str) -> str:
    """Blocks in braces, by how far their lines stand to the right."""
    made: list[str] = []
    open_at: list[int] = []
    depth = 0
    for line in text.split("\n"):
        bare = line.partition("#")[0].rstrip()
        if not bare.strip():
            continue
        blank = len(bare.expandtabs(4)) - len(bare.expandtabs(4).lstrip())
        if depth <= 0:
            while open_at and blank <= open_at[-1]:
                made.append("}")
                open_at.pop()
        depth += sum((c in "([{") - (c in ")]}") for c in bare)
        if depth <= 0 and bare.endswith(":"):
            head = re.sub(r"^(\s*)(if|for|while|elif|match)\b(.*)$", r"\1\2 (\3)", bare[:-1])
            made.append(head.replace("elif", "else if") + " {")
            open_at.append(blank)
        else:
            made.append(re.sub(r"^(\s*)(?:@\w+\s+)*(?:export\s+|onready\s+)?", r"\1", bare))
    return "\n".join([*made, *("}" for _ in open_at)])
