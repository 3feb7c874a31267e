"""Languages whose blocks end by a word or by indentation, in braces: Lua and GDScript; and what all of these share."""

from __future__ import annotations

import re
from dataclasses import replace

from ....models.errors import InvalidInput
from .braces import from_braces
from .program import Program

LUA = re.compile(r"(?m)^\s*(?:local\s+)?(?:\w[\w.:]*\s*=\s*)?function\b")
LUA_WORD = re.compile(r"(?m)\blocal\s|\bmath\.(?:sin|cos)|\bthen\b|--")
LUA_REMARK = re.compile(r"--\[\[.{0,2000}?\]\]|--[^\n]*", re.DOTALL)
LUA_HEAD = re.compile(r"(?m)^(?P<before>[^\n]*?)\bfunction\s*(?P<name>[\w.:]*)\s*\((?P<of>[^()\n]*)\)")
SCRIPT = re.compile(r"(?m)^\s*(?:static\s+)?func\s+\w+\s*\([^\n]*\)\s*(?:->\s*[\w\[\]]+\s*)?:\s*(?:#[^\n]*)?$")


def from_words(text: str) -> Program | None:
    """A program of Lua or GDScript; None for any other."""
    if LUA.search(text) and LUA_WORD.search(text) and re.search(r"\bend\b", text) and "::" not in text:
        return replace(from_braces(_lua(text), by_lines=True), first=1, whole=False, powers=("^",))
    if SCRIPT.search(text):
        return replace(from_braces(_indented(text), by_lines=True), whole=True, powers=("**",))
    return None


def _lua(text: str) -> str:
    text = LUA_REMARK.sub("", text)
    text = LUA_HEAD.sub(lambda m: f"{m['before']}function {re.sub(r'.*[.:]', '', m['name'])}({m['of']}) {{", text)
    text = re.sub(
        r"\b(?P<word>if|while|for|elseif)\b(?P<of>[^\n]*?)\b(?:then|do)\b",
        lambda m: ("} " if m["word"] == "elseif" else "") + f"{m['word'].replace('elseif', 'else if')} ({m['of']}) {{",
        text,
    )
    return re.sub(r"\bend\b", "\n}", re.sub(r"\belse\b(?!\s*if)", "} else {", text))


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


def no_leading_signs(text: str) -> None:
    """Raises InvalidInput where a line begins with a sign, and its language has ended the statement before."""
    depth = 0
    lines = text.split("\n")
    for line, behind in zip(lines, [*lines[1:], ""], strict=True):
        depth += sum((c in "([{") - (c in ")]}") for c in line.rstrip().removesuffix("{"))
        goes_on = re.search(r"[-+*/^=,(\[{&|<~]\s*$", line) is not None or not line.strip()
        if depth <= 0 and not goes_on and re.match(r"\s*[-+]", behind):
            raise InvalidInput(
                f"{behind.strip()[:30]!r}: the statement ends with the line before it; put its sign there"
            )
        depth = max(depth, 0)
