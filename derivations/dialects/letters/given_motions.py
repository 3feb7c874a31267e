r"""What [define] says of a motion that is given, h = h_0 \cos\omega t, where the rows have h and its rates."""

from __future__ import annotations

import re
from typing import Any

from ....models.errors import InvalidInput
from ..names import GREEK, plain_name, spelling
from ..table import known_of
from ..times import motion_of, names_in, rate_of
from .every_text import lines_of

OF_TIME = re.compile(r"\s*(?:\\left\s*)?\(\s*t\s*(?:\\right\s*)?\)\s*$")

WORD = re.compile(rf"\\[A-Za-z]+|{'|'.join(sorted(GREEK, key=len, reverse=True))}|cos|sin|tan|sqrt")


def without_given_motions(data: dict[str, Any]) -> dict[str, Any]:
    r"""The fields without h = h_0 \cos\omega t and h = h(t) of a support whose motion is given.

    With h_0 and ω free, h, h' and h'' are free: a row in these is right for this motion where it is right for each.
    Raises InvalidInput where the rows have h_0 or ω as well, or these are numbers, so that it need not be so.
    """
    bodies, define = data.get("bodies"), data.get("define")
    if not isinstance(bodies, list) or not isinstance(define, dict):
        return data
    moved = {plain_name(str(b.get("coordinate", ""))) for b in bodies if isinstance(b, dict) and "motion" in b}
    said = {name: line for name, line in define.items() if _coordinate(str(name)) in moved and isinstance(line, str)}
    if not said:
        return data
    others = data | {"define": {name: line for name, line in define.items() if name not in said}}
    known = known_of(data).quantities
    texts = lines_of(others)
    rates: set[str] = set()
    for name, line in said.items():
        if _coordinate(line) == _coordinate(str(name)):
            continue
        amplitude, rate, own = _parts(str(name), line)
        held = any(_stands(x, text) for x in own for text in texts) or own & known
        if not names_in(amplitude) or rate is None or rate in rates or held:
            raise InvalidInput(
                f"define.{name!s:.20}: the rows may have this motion under two names; write them with {name!s:.20} "
                "and its rates alone, or with cos and sin of time alone"
            )
        rates.add(rate)
    return others


def _coordinate(text: str) -> str | None:
    """The plain name of h, h(t)."""
    return plain_name(OF_TIME.sub("", text))


def _parts(name: str, line: str) -> tuple[str, str | None, set[str]]:
    """The amplitude, the rate's name, None for a number, and all names of a given motion."""
    amplitude, found = motion_of(name, line)
    rate = plain_name(rate_of(found))
    written = [*names_in(amplitude), rate_of(found), found["shift"] or ""]
    return amplitude, rate, {plain for x in written if (plain := plain_name(x))}


def _stands(name: str, text: str) -> bool:
    """Whether a name stands in a text, where a is no letter of frac and theta."""
    others = WORD.sub(lambda found: found[0] if name.startswith(plain_name(found[0]) or " ") else " ", text)
    return spelling(name).search(others) is not None
