"""What [define] says of g: a letter of the author's own (G), a number (9.8), or a product (ω_0²)."""

from __future__ import annotations

import re
from typing import Any

from ..names import WRITTEN, base_and_index, plain_name
from ..table import known_of

PLAIN = re.compile(r"\\[dt]?frac|\\(?:cdot|times|left|right)(?![A-Za-z])|(?<![\w{])[0-9.]+|\^\s*\{?\s*[0-9]+\s*\}?")
FUNCTION = ("sqrt", "cos", "sin", "tan", "pi", "g")


SQUARE = re.compile(r"(?P<name>[^\^²]{1,24}?)\s*(?:\^\s*(?:\{\s*2\s*\}|2)|\*\*\s*2|²)\s*")


def said_of_squares(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with ω = sqrt(g/l) for ω^2 = g/l among the definitions."""
    define = data.get("define")
    if not isinstance(define, dict):
        return data
    made = {}
    for name, line in define.items():
        found = SQUARE.fullmatch(str(name)[:40].strip().strip("$"))
        is_name = found is not None and plain_name(found["name"]) is not None and isinstance(line, str)
        made[found["name"].strip() if found and is_name else name] = f"sqrt({line})" if is_name else line
    return data | {"define": made} if len(made) == len(define) else data


def said_of_gravity(data: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """The fields, and the names of quantities that are said of g alone. ``g = 'G'`` says that G is what g is."""
    define = data.get("define")
    line = define.get("g") if isinstance(define, dict) else None
    if not isinstance(define, dict) or not isinstance(line, str) or len(line) > 200:
        return data, []
    known = known_of(data)
    taken = {*known.coordinates, *known.quantities, *(plain_name(str(name)) for name in define)}
    letter = plain_name(line)
    if letter is not None and base_and_index(line) is not None:
        if letter in taken or letter == "g" or letter.isdigit():
            return data, []
        return data | {"define": {line.strip(): "g", **{k: v for k, v in define.items() if k != "g"}}}, []
    if not known.coordinates:
        return data, []
    names = [m[0] for m in WRITTEN.finditer(PLAIN.sub(" ", line))]
    return data, [n for n in dict.fromkeys(names) if (p := plain_name(n)) and p not in taken and p not in FUNCTION]
