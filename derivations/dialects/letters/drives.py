r"""A drive with a cosine of an angle that is no coordinate, A cos(phi): whatever it is of time, it is a quantity."""

from __future__ import annotations

import re
from typing import Any

from ..names import GREEK, plain_name
from ..table import known_of
from .every_text import everywhere

_GREEK = "|".join(sorted(GREEK, key=len, reverse=True))
_NAME = rf"\\?(?:{_GREEK})(?![A-Za-z])|[{''.join(GREEK.values())}]"
WAVE = re.compile(
    rf"\\?(?P<wave>cos|sin)\s*(?:\(\s*(?P<a>{_NAME})\s*\)|\{{\s*(?P<b>{_NAME})\s*\}}|(?P<c>{_NAME}))(?!\s*_)"
)
FAMILY = {"vartheta": "theta", "varphi": "phi"}


def with_phases(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with a name for each such cosine or sine of a drive, there and in the rows."""
    bodies, define = data.get("bodies"), data.get("define", {})
    if not isinstance(bodies, list) or not isinstance(define, dict):
        return data
    drives = [str(body["drive"])[:200] for body in bodies if isinstance(body, dict) and "drive" in body]
    taken = {*known_of(data).coordinates, *(plain_name(str(name)) for name in define)}
    taken = {FAMILY.get(name, name) for name in taken if name}
    found = [
        _key(m) for drive in drives for m in WAVE.finditer(drive) if FAMILY.get(_key(m)[1], _key(m)[1]) not in taken
    ]
    names = {key: f" {key[0][0]}turn{k} " for k, key in enumerate(dict.fromkeys(found), 1)}
    return everywhere(data, lambda text: WAVE.sub(lambda m: names.get(_key(m), m[0]), text)) if names else data


def _key(found: re.Match[str]) -> tuple[str, str]:
    return found["wave"], plain_name(found["a"] or found["b"] or found["c"]) or ""
