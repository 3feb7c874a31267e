"""Time that a file calls time or tau, cos(w*time), in a drive or a given motion: called t, there and in the text."""

from __future__ import annotations

import re
from typing import Any

from ..names import plain_name
from ..table import known_of
from .every_text import everywhere, lines_of

WAVE = re.compile(r"(?:cos|sin)\s*\([^()]{0,60}(?<!\w)(?P<time>time|tau)(?!\w)[^()]{0,60}\)")


def with_one_time(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with t for time; as they are where t is anything there already."""
    bodies, define = data.get("bodies"), data.get("define", {})
    if not isinstance(bodies, list) or not isinstance(define, dict):
        return data
    bodies = [b for b in bodies if isinstance(b, dict)]
    moved = {plain_name(str(b.get("coordinate", ""))) for b in bodies if b.get("motion") == "given"}
    said = [str(b["drive"])[:200] for b in bodies if "drive" in b]
    said += [str(v)[:200] for k, v in define.items() if plain_name(str(k)) in moved]
    found = {m["time"] for text in said for m in WAVE.finditer(text)}
    own = {w for b in bodies for k, v in b.items() if k != "drive" for w in re.findall(r"\w+", str(v))}
    if len(found) != 1 or found & {*known_of(data).coordinates, *own, *map(str, define)}:
        return data
    name = found.pop()
    others = [str(v) for b in bodies for v in b.values()]
    if any(re.search(r"(?<![\w\\])t(?!\w)", text) for text in (*lines_of(data), *map(str, define), *others)):
        return data
    return everywhere(data, lambda text: re.sub(rf"(?<![\w\\]){name}(?!\w)", "t", text))
