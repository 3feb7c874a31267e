"""Every text of a file changed by one function, its names among them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..lines import BLANKS, LONGEST_LINE
from ..table import ENERGIES, TABLES

MOST_LINES, MOST_BODIES = 50, 8
WORDS = ("name", "on", "joint", "along", "about", "motion")  # of a body, which are no mathematics


def is_fit(value: object) -> bool:
    """Whether a value is a text that patterns may look at."""
    return isinstance(value, str) and len(value) <= LONGEST_LINE and not BLANKS.search(value)


def lines_of(data: Mapping[str, Any]) -> list[str]:
    """All lines of mathematics, those of the bodies left out."""
    found = [data.get(name) for name in ENERGIES]
    for name in TABLES:
        table = data.get(name)
        found += table.values() if isinstance(table, dict) else table if isinstance(table, list) else []
    return [line for line in found if isinstance(line, str) and is_fit(line)]


def rows_of(data: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The equations with their labels; none where some are no texts, or too many."""
    table = data.get("equations")
    entries = list(table.items()) if isinstance(table, dict) else []
    entries = [(str(k), x) for k, x in enumerate(table, 1)] if isinstance(table, list) else entries
    return (
        [(str(k), x) for k, x in entries] if len(entries) <= MOST_LINES and all(is_fit(x) for _, x in entries) else []
    )


def everywhere(data: Mapping[str, Any], change: Callable[[str], str]) -> dict[str, Any]:
    """The fields with every text and every name changed; what is too large is left for the reader to refuse."""

    def one(value: Any) -> Any:
        return change(value) if is_fit(value) else value

    made = dict(data)
    for name in TABLES:
        table = data.get(name)
        if isinstance(table, dict) and len(table) <= MOST_LINES:
            changed = {one(key): one(value) for key, value in table.items()}
            made[name] = changed if len(changed) == len(table) else table
        elif isinstance(table, list) and len(table) <= MOST_LINES:
            made[name] = [one(value) for value in table]
    for name in ENERGIES:
        if name in data:
            made[name] = one(data[name])
    bodies = data.get("bodies")
    if isinstance(bodies, list) and len(bodies) <= MOST_BODIES and all(isinstance(b, dict) for b in bodies):
        made["bodies"] = [{k: v if k in WORDS else one(v) for k, v in b.items()} for b in bodies]
    return made
