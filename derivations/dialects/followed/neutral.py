"""One function with the equations of motion, whatever its language, as a function that Python would have."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ....models.errors import InvalidInput
from ..languages.program import ALLOCATED, RETURN, Function, Program, Statement
from ..markup.calls import parts_of
from ..names import plain_name
from .by_name import named_state
from .words import PUT
from .writer import Writer, locals_of

TIMES = ("t", "time", "_t", "dt", "_", "tt", "tau_t", "times", "ts", "unused")
STATE_NAMES = ("y", "state", "S", "statevector", "places")


@dataclass(frozen=True)
class Asked:
    """What a file says: how many coordinates, which ones, what turns, its quantities, and entries in [define]."""

    count: int
    coordinates: tuple[str, ...]
    slides: frozenset[str]
    known: frozenset[str]
    given: Mapping[str, str]


def neutral(program: Program, function: Function, asked: Asked) -> tuple[str, dict[str, str]]:
    """The function as Python's, and what [define] has to say of its state's entries.

    Raises InvalidInput where it does not have the equations of motion, or is not plain.
    """
    if function.refused:
        raise InvalidInput(function.refused)
    state = state_of(function, asked)
    return _of_arrays(program, function, asked, state) if state else named_state(program, function, asked, outer_lines)


def _of_arrays(program: Program, function: Function, asked: Asked, state: str) -> tuple[str, dict[str, str]]:
    first = _first(program, function, state)
    text = " ".join(f"{s.target} {s.value}" for s in (*function.statements, *program.outside))
    name = next(word for word in STATE_NAMES if word == state or not re.search(rf"\b{word}\b", text))
    if any(s.target == state and s.op == "" for s in function.statements):
        name = next(word for word in STATE_NAMES if not re.search(rf"\b{word}\b", text))
    outside = [s for s in outer_lines(program, function, asked) if s.target not in TIMES]
    places = locals_of(function, [*outside, *function.statements])
    writer = Writer(program, function, asked.known, asked.given, state, name, places, first=first, size=2 * asked.count)
    for one in outside:
        writer.statement(one)
    if state[:1] == "[":
        writer.lines.append((", ".join(writer.local(part) for part in parts_of(state[1:-1], ",")), name))
    for one in function.statements:
        writer.statement(one)
        if one.target == state and isinstance(one.value, str):
            writer.state = ""  # from here on the name is another thing
    returned = _returned(writer, function, asked)
    lines = [f"    {target} = {value}" for target, value in writer.lines]
    made = "\n".join([f"def rhs(t, {name}):", *lines, f"    return {returned}"])
    said = {}
    for key, value in asked.given.items():
        found = re.fullmatch(r"(\w+)\[(\d{1,2})\]", key)
        if found and found[1] == state:
            said[f"{name}[{int(found[2]) - first}]"] = value
    return made, said


def _returned(writer: Writer, function: Function, asked: Asked) -> str:
    """The list that the function gives back, or fills."""
    text = writer.returned
    if text is None:
        filled = [name for name in writer.entries if writer.parameter(name) and writer.entries[name]]
        own = [name for name, held in writer.entries.items() if len(held) >= asked.count * 2]
        names = filled or own
        if len(names) != 1:
            raise InvalidInput(
                "what the function gives back is not plain: give one array with the rates and the accelerations"
            )
        text = writer.whole(names[0])
    inner = text.strip()
    held = writer_value(writer, inner)
    inner = held if held[:1] == "[" else inner
    if len(parts_of(inner, ",")) > 1:
        inner = f"[{inner}]"
    parts = parts_of(inner[1:-1], ",") if inner[:1] == "[" and inner[-1:] == "]" else []
    if len(parts) == 2 * asked.count + 1 and writer_value(writer, parts[-1]) in ("1", "1.0", "1."):
        return "[" + ", ".join(parts[:-1]) + "]"  # the time's own rate
    return inner


def writer_value(writer: Writer, name: str) -> str:
    """What a name was set to last; the name where it was not."""
    return next((value.strip() for target, value in reversed(writer.lines) if target == name.strip()), name.strip())


def state_of(function: Function, asked: Asked) -> str:
    """The parameter that is the state: an array that is read, and is neither the time nor filled."""
    used = " ".join(s.value for s in function.statements)
    puts = {m["name"] for s in function.statements if (m := PUT.fullmatch(s.target))}
    fills = {s.target for s in function.statements if s.value.startswith("<<")}
    names = [p for p in function.parameters if p.name not in TIMES and p.kind not in ("number", "fields")]
    fields = {m[1] for m in re.finditer(r"(\w+)\s*(?:->|\.)\s*[^\W\d]\w*", used)}
    for one in names:
        if one.name[:1] == "[":
            if len(parts_of(one.name[1:-1], ",")) == 2 * asked.count:
                return one.name
            continue
        name = re.escape(one.name)
        aliases = {s.target for s in function.statements if re.fullmatch(rf"[\w(]*\(?\s*[&*]?\s*{name}\s*\)*", s.value)}
        words = "|".join([name, *(re.escape(a) for a in aliases if a.isidentifier())])
        if one.name in puts | fills or aliases & (puts | fills):
            continue
        indexed = re.search(
            rf"(?<![\w.])(?:{words})\s*(?:\[|\(\s*\d\s*\)|\.at\(|\.(?:get|getEntry|head|tail|segment|x\b|y\b)|\s*,\s*\d\s*\))",
            used,
        )
        apart = any(
            s.target[:1] == "(" and re.fullmatch(rf"[&*]?\s*(?:{words})(?:\.\w+\(\))?", s.value.strip())
            for s in function.statements
        )
        if indexed or apart:
            return one.name
        if one.kind == "array" and one.name not in fields and re.search(rf"(?<![\w.]){name}\b", used):
            continue
    return ""


def _first(program: Program, function: Function, state: str) -> int:
    """What entries are counted from: 1 where Numerical Recipes' arrays are read so."""
    if program.first:
        return program.first
    text = " ".join(f"{s.target} {s.value}" for s in function.statements)
    places = [int(k) for k in re.findall(rf"(?<![\w.]){re.escape(state)}\s*\[\s*(\d)\s*\]", text)]
    filled: dict[str, list[int]] = {}
    for s in function.statements:
        m = PUT.fullmatch(s.target)
        if m and not m["j"]:
            filled.setdefault(m["name"], []).append(int(m["i"]))
    counted = next((v for v in filled.values() if min(v) == 1), None)
    if any(0 in v for v in filled.values()):
        return 0
    if counted and 0 not in places and sorted(counted) == list(range(1, len(counted) + 1)) and len(counted) % 2 == 0:
        return 1
    return 0


def outer_lines(program: Program, function: Function, asked: Asked) -> list[Statement]:
    """What stands outside the function and is more than a number or a name, in order, where the function needs it."""
    inside = {s.target for s in function.statements} | {p.name for p in function.parameters}
    wanted = set(re.findall(r"[^\W\d]\w*", " ".join(s.value for s in function.statements)))
    for helper in program.functions:
        if helper.name in wanted:
            wanted |= set(re.findall(r"[^\W\d]\w*", " ".join(s.value for s in helper.statements)))
    values: dict[str, list[Statement]] = {}
    order: list[str] = []
    for other in program.functions:  # constructors, setup()
        if other is function or other.refused:
            continue
        for s in other.statements:
            if re.match(r"(?:this\s*(?:->|\.)|self\s*\.)", s.target):
                name = re.sub(r"^(?:this\s*(?:->|\.)|self\s*\.)\s*", "", s.target)
                values.setdefault(name, []).append(Statement(name, s.value, s.op, s.added))
                order.append(name)
    for s in program.outside:
        name = re.sub(r"^(?:this\s*(?:->|\.)|self\s*\.)\s*", "", s.target)
        values.setdefault(name, []).append(Statement(name, s.value, s.op, s.added))
        order.append(name)
    made: list[Statement] = []
    for name in dict.fromkeys(reversed(order)):
        given = [s for s in values[name] if not s.value.startswith(ALLOCATED)]
        if name not in wanted or name in inside or not given or not name.isidentifier() or name == RETURN:
            continue
        if name in asked.coordinates or all(_is_plain(s.value) for s in given):
            number = next((s for s in given if re.fullmatch(r"[-+0-9.eEfFdDlL]+", s.value.strip())), None)
            declared = {name, plain_name(name.strip("_")), name.strip("_")} & (asked.known | {"g"})
            if number and not declared and len(given) == 1 and name not in asked.coordinates:
                made.append(number)
            continue
        if len({s.value for s in given}) > 1:
            raise InvalidInput(f"{name} is given more than one value; give the function with the equations alone")
        made.append(given[0])
        wanted |= set(re.findall(r"[^\W\d]\w*", given[0].value))
    return _in_order(made)


def _in_order(statements: Sequence[Statement]) -> list[Statement]:
    """Each behind those that it needs."""
    left, made = {s.target: s for s in reversed(statements)}, []
    while left:
        ready = [n for n, s in left.items() if not (set(re.findall(r"[^\W\d]\w*", s.value)) & (left.keys() - {n}))]
        if not ready:
            raise InvalidInput("quantities outside the function say each other; give the function alone")
        made += [left.pop(n) for n in ready]
    return made


def _is_plain(value: str) -> bool:
    """A number, a name, or what a call or a field gives: it says nothing of mechanics."""
    return (
        re.fullmatch(r"[-+0-9.eEfFdDlL]+|[^\W\d][\w.>-]*|[\w.>-]+\s*[\[(][\w\s.,\"]*[\])]", value.strip()) is not None
    )
