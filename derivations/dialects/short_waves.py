r"""c_1, s_{12} and s_{1+2} of robotics, which their author leaves undefined; and \tau for a column of all drives."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .names import GREEK, base_and_index, plain_name

if TYPE_CHECKING:
    from .table import Known

SHORT = re.compile(
    r"(?:(?<![A-Za-z\\])|(?<=(?<![A-Za-z])g)(?=._))(?<!_)(?<!_\{)(?P<wave>[csCS])(?:_\s*\{\s*(?P<braced>[1-9](?:\s*[-+]?\s*[1-9])?)\s*\}|_(?P<low>[1-9]{1,2})|(?P<bare>[1-9]{1,2}))(?![0-9A-Za-z_\[({])"
)
MOST_ANGLES = 9  # of one figure each
USUAL = {"double-pendulum": 2, "triple-pendulum": 3, "double-rod-pendulum": 2, "acrobot": 2}


def short_waves(data: dict[str, Any], known: Known) -> dict[str, Any]:
    """The fields with what these letters stand for among the definitions, so that it is said back."""
    define = data.get("define", {})
    links = data.get("links") or USUAL.get(str(data.get("system")), 0)
    counted = links if type(links) is int and links <= MOST_ANGLES else 0
    angles = known.coordinates or tuple(f"t{k}" for k in range(1, counted + 1))
    if not isinstance(define, dict) or not angles:
        return data
    lines = list(_lines(data))
    taken = {plain_name(str(name)) for name in define} | known.quantities
    new: dict[str, str] = {}
    if not _is_robotics(lines, taken):
        column = _column(known, lines, taken)
        return data | {"define": {**column, **define}} if column else data
    by_index = {(base_and_index(a) or ("", ""))[1] or re.sub(r"\D", "", a): a for a in angles}
    for found in (m for line in lines for m in SHORT.finditer(line)):
        figures = re.sub(r"\s", "", found["braced"] or found["low"] or found["bare"])
        name = f"{found['wave']}_{{{figures}}}"
        if plain_name(name) in taken or plain_name(name) in {plain_name(x) for x in new}:
            continue
        angle = _angle(figures, by_index, known.relative)
        if angle is not None:
            new[name] = f"{'cos' if found['wave'] in 'cC' else 'sin'}({angle})"
    column = _column(known, lines, taken)
    return data | {"define": {**new, **column, **define}} if new or column else data


def _is_robotics(lines: list[str], taken: set[str | None]) -> bool:
    """Whether c and s stand there with one index: c_1 alone may be a damper."""
    found: dict[str, set[str]] = {"c": set(), "s": set()}
    for match in (m for line in lines for m in SHORT.finditer(line)):
        figures = re.sub(r"\s", "", match["braced"] or match["low"] or match["bare"])
        if plain_name(f"{match['wave']}_{{{figures}}}") not in taken:
            found[match["wave"].lower()].add(figures)
    return bool(found["c"] & found["s"])


def _lines(data: dict[str, Any]) -> Iterable[str]:
    for name in ("define", "equations", "solved", "positions", "velocities", "momenta"):
        found = data.get(name)
        entries = found.values() if isinstance(found, dict) else found if isinstance(found, list) else ()
        yield from (line for line in entries if isinstance(line, str))
    for name in ("lagrangian", "kinetic", "potential", "hamiltonian"):
        if isinstance(data.get(name), str):
            yield data[name]


def _angle(figures: str, by_index: dict[str, str], relative: bool) -> str | None:
    """The angle of c_{12}: the sum where angles are relative; otherwise that is not certain."""
    numbers = re.findall(r"[1-9]", figures)
    if any(n not in by_index for n in numbers):
        return None
    if len(numbers) == 1:
        return by_index[numbers[0]]
    sign = next((c for c in figures if c in "+-"), "+" if relative else "")
    return f"{by_index[numbers[0]]} {sign} {by_index[numbers[1]]}" if sign else None


def _column(known: Known, lines: list[str], taken: set[str | None]) -> dict[str, str]:
    r"""\tau without an index, where each joint has its own: all of them, one above the other."""
    n = len(known.coordinates)
    base = known.drives[0].rstrip("0123456789") if known.drives else ""
    if n < 2 or not base or list(known.drives) != [f"{base}{k}" for k in range(1, n + 1)] or base in taken:
        return {}
    word = rf"(?:\\{base}|{base}|[{GREEK[base]}])" if base in GREEK else re.escape(base)
    used = any(re.search(rf"(?<![A-Za-z\\]){word}(?!\s*_|[0-9A-Za-z₀-₉])", line) for line in lines)
    return {base: "[" + ", ".join(known.drives) + "]"} if used else {}
