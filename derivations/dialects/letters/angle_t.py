"""A coordinate that is called t: then t is no time, and what might be either is refused."""

from __future__ import annotations

import re
from typing import Any

from ....models.errors import InvalidInput
from ..table import known_of
from .every_text import lines_of

OF_T = re.compile(r"(?<!sin)(?<!cos)(?<!tan)(?<=[A-Za-z0-9_}α-ωΑ-Ω₀-₉])\s*\(\s*t\s*\)")
BY_T = re.compile(r"d\s*t(?![A-Za-z0-9_'])|\\partial\s*t(?![A-Za-z])|diff\s*\(|Derivative\s*\(")


def require_no_time(data: dict[str, Any]) -> None:
    """Raises InvalidInput where t is a coordinate and a text may have time as well: F(t), d/dt."""
    if "t" not in known_of(data).coordinates:
        return
    bodies = [str(value) for body in data.get("bodies", ()) if isinstance(body, dict) for value in body.values()]
    for text in (*lines_of(data), *bodies):
        found = OF_T.search(text) or BY_T.search(text)
        if found:
            raise InvalidInput(
                f"{found[0].strip()}: t is a coordinate here, and is it time as well? Give the angle another letter, "
                "and write * before (t) for a product"
            )
