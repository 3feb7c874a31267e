"""A whole file in the reader's notation: each line by itself first, and then what one line says of another.

Of another: names that their author wrote with accents or arguments, a rate that has a name of its own, what stands
behind "where", c_1 and s_{12} of robotics, and a vector of all drives.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from .bracketed import in_brackets
from .given_names import shorter_names
from .lines import BLANKS, FULL_WIDTH, LONGEST_LINE
from .names import GREEK, base_and_index, plain_name, require_one_meaning
from .pasted import pasted
from .programs import program
from .rates import named_rates, prefixed, suffixed
from .short_waves import short_waves
from .sums import sums

TABLES = ("define", "positions", "velocities", "momenta", "equations", "solved", "steps")
ENERGIES = ("kinetic", "potential", "lagrangian", "hamiltonian")
MOST_LINES, MOST_BODIES, LONGEST_NAME = 50, 8, 80
# Behind a name, in a declared mechanism, where no coordinate is called t
OF_TIME = re.compile(
    r"(?<=[A-Za-z0-9_}α-ωΑ-Ωϑϕϵ₀-₉\u0307\u0308'])(?<!sin)(?<!cos)(?<!tan)\s*(?:\\left\s*)?\(\s*t\s*(?:\\right\s*)?\)"
)
GRAVITY = re.compile(r"(?<![A-Za-z\\])g(?![A-Za-z])")
DRIVE_OF_TIME = re.compile(r"(?<=[A-Za-z0-9_}α-ωΑ-Ωϑϕϵ₀-₉])(?<!sin)(?<!cos)\s*\(\s*t\s*\)")
NUMBER = re.compile(r"\s*([0-9]{1,3}(?:\.[0-9]{0,8})?)\s*;?\s*(?:m\s*/\s*s(?:\^2|²|\*\*2))?\s*$")
WHERE = re.compile(
    r"(?:[,;.]|\\[,;]|\\q?quad|\s){0,20}(?:\\q?quad|\\(?:text|mbox|textrm|mathrm)\s*\{\s*(?:where|with|mit|wobei|où|avec|ただし)(?:\s[^{}$=\\]{0,60})?\s*:?\s*\}|[,;]\s*(?:where|with))"
    r"(?:\\[,; ]|\\q?quad|\s|,){0,20}(?P<name>[^=<>&]{1,30}?)\s*(?::=|=|\\equiv|\\coloneqq)\s*(?P<value>[^=]+)$"
)

SAID = re.compile(r"\b(?:where|with|mit|wobei|où|avec)\b[^=]{0,60}=|ただし[^=]{0,60}=")
ALSO = re.compile(
    r"(?:[,;]|\\[,;]|\band\b|\\text\s*\{\s*and\s*\})(?:\\[,; ]|\\q?quad|\s|and\b|\\text\s*\{\s*and\s*\}){0,12}"
    r"(?P<name>\\?[A-Za-zΔδα-ω]{1,12}(?:\s*_\s*\{?\w{1,4}\}?)?)\s*(?::=|=)\s*(?P<value>[^=]+)$"
)


@dataclass(frozen=True)
class Known:
    """What a file declares: its coordinates and quantities, plain, in order."""

    coordinates: tuple[str, ...]
    quantities: frozenset[str]
    drives: tuple[str, ...]
    relative: bool


def known_of(data: Mapping[str, Any]) -> Known:
    """What the fields declare; nothing where they name a usual mechanism."""
    bodies = data.get("bodies")
    bodies = [b for b in bodies if isinstance(b, dict)] if isinstance(bodies, list) else []
    coordinates = [plain_name(str(b.get("coordinate", "")).translate(FULL_WIDTH)) or "" for b in bodies]
    texts = [str(value) for b in bodies for name, value in b.items()
             if name not in ("name", "on", "coordinate", "joint", "along", "about", "motion")]  # fmt: skip
    words = [w for text in texts for w in re.findall(r"\\?[A-Za-zα-ωΑ-Ωℓ]+(?:_\{\w+\}|_?\w+)?", text)]
    drives = [plain_name(str(b["drive"])) or "" for b in bodies if "drive" in b]
    quantities = frozenset(plain for w in words if (plain := plain_name(w)))
    return Known(tuple(coordinates), quantities, tuple(drives), data.get("angles") == "relative")


def translated(data: dict[str, Any], count: int = 0) -> dict[str, Any]:
    """The fields of a derivation with all their mathematics in the reader's notation.

    ``count``: its angles, 0 where that is not known.
    """
    if not _is_small(data):
        return data
    data = _of_no_time(data)
    known = known_of(data)
    define = data.get("define")
    names = frozenset(map(str, define)) if isinstance(define, dict) else frozenset()
    made = _mapped(data, lambda line: _line(sums(line, count), names))
    made = _mapped(made, by_letters([str(made.get(name)) for name in (*TABLES, *ENERGIES)], known))
    if known.coordinates and "t" not in known.coordinates:
        made = _mapped(made, lambda line: OF_TIME.sub(lambda found: " " * len(found[0]), line))
    made = shorter_names(_with_any_gravity(made), _mapped)
    made = _mapped(made, lambda line: suffixed(line, known.coordinates, known.quantities | set(made.get("define", {}))))
    made = _mapped(made, prefixed(_texts(made), known.coordinates, known.quantities | set(made.get("define", {}))))
    made = _said_behind(made)
    made = named_rates(made, known.coordinates, known.quantities)
    return short_waves(made, known)


def _texts(data: Mapping[str, Any]) -> list[str]:
    """All lines of mathematics."""
    tables = [t for name in TABLES if isinstance(t := data.get(name), dict | list)]
    lines = [line for table in tables for line in (table.values() if isinstance(table, dict) else table)]
    return [line for line in (*lines, *(data.get(name) for name in ENERGIES)) if isinstance(line, str)]


def by_letters(texts: list[str], known: Known) -> Callable[[str], str]:
    """What puts primes for d and dd behind a coordinate of one letter, ed and edd, where d is nothing of its own."""
    text = "\n".join(texts)
    own = [c for c in known.coordinates if len(c) == 1 and c.isascii()]
    read = [c for c in own if re.search(rf"(?<![\w\\]){c}dd(?!\w)", text)]
    free = known.quantities.isdisjoint({"d", *(c + d for c in own for d in ("d", "dd"))})
    if not read or not free or re.search(r"(?<![\w\\])d(?![\w])", text):
        return lambda line: line
    pattern = re.compile(rf"(?<![\w\\])(?P<x>{'|'.join(read)})(?P<d>dd?)(?!\w)")
    return lambda line: pattern.sub(lambda found: found["x"] + "'" * len(found["d"]), line)


def _of_no_time(data: dict[str, Any]) -> dict[str, Any]:
    """M(t) of a body is M: which function of time it is, the equations do not ask."""
    bodies = data.get("bodies")
    if not isinstance(bodies, list) or not all(isinstance(b, dict) for b in bodies):
        return data
    made = [{k: _bare_drive(v, bodies) if k == "drive" and isinstance(v, str) else v for k, v in b.items()}
            for b in bodies]  # fmt: skip
    return data | {"bodies": made}


def _bare_drive(drive: str, bodies: list[dict[str, Any]]) -> str:
    bare = DRIVE_OF_TIME.sub("", drive)
    if bare != drive:
        require_one_meaning(drive, bare, bodies)
    return bare


def _with_any_gravity(data: dict[str, Any]) -> dict[str, Any]:
    """Without g = 9.81, where no line counts on that number: what is right for every g is right for this one."""
    define = data.get("define")
    if not isinstance(define, dict):
        return data
    value = define.get("g")
    number = NUMBER.match(value) if isinstance(value, str) else None
    if number is None or not float(number[1]):
        return data
    others = {name: line for name, line in define.items() if name != "g"}
    digits = number[1].rstrip("0").rstrip(".")
    held = str([data.get(name) for name in (*TABLES[1:], *ENERGIES)]) + str(others)
    if digits in held or not GRAVITY.search(held):  # the number itself, or what it went into
        return data
    return data | {"define": others}


def _is_small(data: Mapping[str, Any]) -> bool:
    """Whether it is of a size that the reader takes; what is larger, it refuses itself."""
    tables = [t for name in TABLES if isinstance(t := data.get(name), dict | list)]
    bodies = data.get("bodies", ())
    names = [name for t in tables if isinstance(t, dict) for name in t]
    small = isinstance(bodies, list | tuple) and len(bodies) <= MOST_BODIES
    return small and all(len(t) <= MOST_LINES for t in tables) and all(len(str(name)) <= LONGEST_NAME for name in names)


def _line(line: str, names: frozenset[str]) -> str:
    if "Symbol(" in line:
        return line
    line = line.translate(FULL_WIDTH)
    for change in (pasted, lambda x: program(x, names), lambda x: in_brackets(x, names)):
        line = line if BLANKS.search(line) else change(line)
    return line


def _mapped(data: Mapping[str, Any], change: Callable[[str], str]) -> dict[str, Any]:
    """Each line of mathematics changed; what is none, or too long, is left for the reader to refuse."""

    def one(value: Any) -> Any:
        fit = isinstance(value, str) and len(value) <= LONGEST_LINE and not BLANKS.search(value)
        return change(value) if fit else value

    made = dict(data)
    for name in TABLES:
        found = data.get(name)
        if isinstance(found, dict):
            made[name] = {key: one(value) for key, value in found.items()}
        elif isinstance(found, list):
            made[name] = [one(value) for value in found]
    for name in ENERGIES:
        if name in data:
            made[name] = one(data[name])
    return made


def _said_behind(data: dict[str, Any]) -> dict[str, Any]:
    """``row, where Δ = θ1 − θ2``: a name that the file defines."""
    found: dict[str, str] = {}

    def without(line: str) -> str:
        for _ in range(8):  # where s = …, c = …: the last of several first
            last = ALSO.search(line)
            if last is None or not SAID.search(line[: last.start()]) or plain_name(last["name"]) is None:
                break
            found.setdefault(last["name"].strip(), last["value"].rstrip(" .,;\n"))
            line = line[: last.start()]
        match = WHERE.search(line)
        name = plain_name(match["name"]) if match else None
        if match is None or name is None or "=" not in line[: match.start()]:
            return line
        if base_and_index(match["name"]) is None or not (name in GREEK or name.isalnum()):
            return line
        found.setdefault(match["name"].strip(), match["value"].rstrip(" .,;\n"))
        return line[: match.start()]

    define = data.get("define", {})
    if not isinstance(define, dict):
        return data
    kept = {name: data[name] for name in ("define",) if name in data}
    made = _mapped({k: v for k, v in data.items() if k != "define"}, without) | kept
    taken = {plain_name(str(name)) for name in define}
    new = {name: value for name, value in found.items() if plain_name(name) not in taken}
    return made | {"define": {**define, **new}} if new else made
