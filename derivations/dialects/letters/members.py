"""Members of classes, m_ and l1_: the names of a file's quantities without the low line that C++ ends them by."""

from __future__ import annotations

import re
from typing import Any

from ....models.errors import InvalidInput
from .every_text import everywhere

NAME = re.compile(r"\s*(?P<name>[A-Za-z][A-Za-z0-9]{0,20})_\s*")
MEMBER = re.compile(r"(?<![\w\\])(?P<name>[A-Za-z][A-Za-z0-9]{0,20})_(?=\s*(?:[-+*/^()=,;.\]]|$))")


def without_low_lines(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with m for m_, of what bodies and [define] call so; programs keep their own names.

    Raises InvalidInput where m is another quantity besides m_.
    """
    bodies, define = data.get("bodies"), data.get("define")
    tables = [b for b in bodies if isinstance(b, dict)] if isinstance(bodies, list) else []
    texts = [str(v)[:200] for b in tables for v in b.values()]
    names = {m["name"] for text in texts for m in MEMBER.finditer(text)}
    if isinstance(define, dict):
        names |= {m["name"] for key in define if (m := NAME.fullmatch(str(key)[:40]))}
    if not names:
        return data
    for name in sorted(names):
        alone = re.compile(rf"(?<![\w\\]){name}(?![\w])")
        if any(alone.search(text) for text in texts):
            raise InvalidInput(f"bodies: {name} and {name}_ are two quantities here; give each a name of its own")
    pattern = re.compile(
        rf"(?<![\w\\])(?P<name>{'|'.join(sorted(names, key=len, reverse=True))})_(?=\s*(?:[-+*/^()=,;.\]]|$))"
    )
    kept = {name: data[name] for name in ("equations",) if name in data and _is_program(data[name])}
    made = everywhere({k: v for k, v in data.items() if k not in kept}, lambda text: pattern.sub(r"\g<name>", text))
    made |= kept
    if isinstance(made.get("define"), dict):
        made["define"] = {key: value for key, value in made["define"].items() if str(key).strip() != str(value).strip()}
    return made


def _is_program(table: object) -> bool:
    """Whether the equations are the text of a program, which has local names besides."""
    texts = list(table.values()) if isinstance(table, dict) else table if isinstance(table, list) else []
    return any(isinstance(text, str) and "{" in text and ";" in text for text in texts)
