"""How angles are counted, as the fields angles, from and sense say."""

from __future__ import annotations

from typing import Any

from ....models.errors import InvalidInput, nearest
from ...steps.conventions import Convention
from ...steps.mechanism import Origin

ANGLES = ("absolute", "relative")
ORIGINS: dict[str, Origin] = {"down": "down", "up": "up", "horizontal": "right", "right": "right", "left": "left"}
SENSES = {"counter-clockwise": 1, "clockwise": -1}


def convention_of(data: dict[str, Any], n: int) -> Convention:
    """As the fields angles, from and sense declare it, for n angles. Raises InvalidInput with the field."""
    angles, origin, sense = data.get("angles", "absolute"), data.get("from", "down"), data.get("sense", ())
    if angles not in ANGLES:
        raise InvalidInput(f"angles: {angles!r:.40} is not known; give 'absolute' (from the vertical) or 'relative'")
    if not isinstance(origin, str) or origin not in ORIGINS:
        close = nearest(origin, ORIGINS) if isinstance(origin, str) and len(origin) < 100 else ""
        raise InvalidInput(f"from: {origin!r:.40} is not known{close}; give one of {', '.join(ORIGINS)}")
    senses = [sense] * n if isinstance(sense, str) else sense
    if not isinstance(senses, list | tuple) or (senses and len(senses) != n) or any(s not in SENSES for s in senses):
        raise InvalidInput(f"sense: {sense!r:.60} is not known; give 'counter-clockwise' or 'clockwise', or a list")
    signs = tuple(SENSES[s] for s in senses)
    return Convention(angles == "relative", ORIGINS[origin], () if set(signs) <= {1} else signs)
