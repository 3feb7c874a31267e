r"""What a text itself says of a motion that is given, y(t) = A\cos\omega t: said as [define] says it."""

from __future__ import annotations

import re
from typing import Any

from ..names import plain_name
from ..statements import is_program
from .every_text import is_fit, rows_of

# A display, a formula of a sentence, or a line of its own
PIECE = re.compile(
    r"\$\$(?P<a>[^$]+)\$\$|\\\[(?P<b>[^\[\]]+?)\\\]|(?<!\$)\$(?P<c>[^$\n]+)\$(?!\$)|^[ \t]*(?P<d>[^\n$]+)$",
    re.MULTILINE,
)
_GAP = r"(?:\s|&|\\[,;:! ])*"
SAID = re.compile(
    rf"{_GAP}(?P<x>\\?[A-Za-z]+(?:\s*_\s*(?:\{{\s*\w{{1,8}}\s*\}}|\w))?|[α-ω][₀-₉]?){_GAP}(?:(?:\\left)?\(\s*t\s*(?:\\right)?\))?{_GAP}(?::=|=){_GAP}(?P<value>[^=]+?){_GAP}[.,;]?\s*"
)
WAVE = re.compile(r"(?:cos|sin)[^=]{0,40}t")


def with_said_motions(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with such an equation among the definitions, where nothing there says the motion already."""
    bodies, define = data.get("bodies"), data.get("define", {})
    if not isinstance(bodies, list) or not isinstance(define, dict):
        return data
    own = {plain_name(re.sub(r"\(t\)", "", str(name))) for name in define}
    moved = {plain_name(str(b.get("coordinate", ""))): str(b["coordinate"]) for b in bodies
             if isinstance(b, dict) and b.get("motion") == "given" and "coordinate" in b}  # fmt: skip
    rows = rows_of(data)
    if not moved.keys() - own or not rows or any(is_program(text) for _, text in rows):
        return data
    found: dict[str, str] = {}

    def one(piece: re.Match[str]) -> str:
        said = SAID.fullmatch(next(piece[k] for k in "abcd" if piece[k] is not None))
        name = plain_name(said["x"]) if said else None
        if said is None or name not in moved or name in own or not WAVE.search(said["value"]):
            return piece[0]
        if moved[name] in found:  # twice: which is meant is for the reader of notes to ask
            return piece[0]
        found[moved[name]] = said["value"]
        return "\n"

    left = [(label, PIECE.sub(one, text) if is_fit(text) else text) for label, text in rows]
    left = [(label, text) for label, text in left if text.strip()]
    if not found or not left:
        return data
    return data | {"equations": dict(left), "define": {**define, **found}}
