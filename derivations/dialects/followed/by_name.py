# ruff: noqa: E501 -- patterns stand on one line
"""A function whose state is in names, theta1 and omega1, as games and animations have it."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ....models.errors import InvalidInput
from ..languages.program import RETURN, Function, Program, Statement
from ..markup.calls import parts_of
from ..names import plain_name
from .rate_words import accelerations_of, derivatives_of, rates_of
from .steps import Steps, check_changes, per_step, steps_of, without_steps
from .writer import Writer, locals_of

if TYPE_CHECKING:
    from .neutral import Asked

USUAL = r"(?:theta|th|phi|q|angle|ang|a|t|alpha|psi|x)_?{k}"
Outer = Callable[[Program, Function, "Asked"], list[Statement]]


@dataclass(frozen=True)
class _Motion:
    """What the names of a coordinate are: its own, its rate's and the expression of its acceleration."""

    name: str
    rate: str
    acceleration: str


def named_state(program: Program, function: Function, asked: Asked, outer: Outer) -> tuple[str, dict[str, str]]:
    """The function as Python's. Raises InvalidInput where a rate or an acceleration is not plain."""
    outside = outer(program, function, asked)
    statements = _of_fields([_bare(s) for s in function.statements], function, asked)
    words = list(dict.fromkeys(re.findall(r"[^\W\d]\w*", " ".join(f"{s.target} {s.value}" for s in statements)
                                          + " " + " ".join(p.name for p in function.parameters))))  # fmt: skip
    coordinates = _coordinates(asked, words)
    n = len(coordinates)
    if n != asked.count:
        raise InvalidInput(
            f"coordinates: {n} of the {asked.count} declared are found in the function, {', '.join(coordinates)}; declare the "
            "mechanism that it is about, and use the names of its coordinates"
        )
    steps = steps_of(statements)
    rates = [_rate(c, coordinates, words, steps, statements, asked) for c in coordinates]
    changed = {*coordinates, *rates}
    if len(set(rates)) < len(rates):
        raise InvalidInput("one name for the rates of two coordinates; give each a name of its own")
    check_changes(statements, steps, changed)
    outside = [s for s in outside if s.target not in changed]  # where it starts from
    kept = without_steps(statements, steps, rates, changed, asked.known)
    writer = Writer(program, function, asked.known, asked.given, "", "y", locals_of(function, [*outside, *kept]) - changed,
                    first=program.first)  # fmt: skip
    for one in [*outside, *kept]:
        if one.target != RETURN or one.value.strip() not in ("", "this"):
            writer.statement(one)
    accelerations = [_acceleration(k, coordinates, rates, steps, writer, asked) for k in range(len(coordinates))]
    lines = [f"    {name} = y[{k}]" for k, name in enumerate([*coordinates, *rates])]
    lines += [f"    {target} = {value}" for target, value in writer.lines]
    lines.append(f"    return [{', '.join([*rates, *accelerations])}]")
    return "\n".join(["def rhs(t, y):", *lines]), {}


def _bare(one: Statement) -> Statement:
    def without(text: str) -> str:
        return re.sub(r"(?<![\w.])(?:\(\s*\*\s*this\s*\)\.|this\s*(?:->|\.)|self\s*\.|@(?=[A-Za-z]))\s*", "", text)

    return Statement(without(one.target), without(one.value), one.op, without(one.added))


def _of_fields(statements: list[Statement], function: Function, asked: Asked) -> list[Statement]:
    """state.theta as theta, of a parameter with the coordinates; what is returned by name as fields of one struct."""
    text = " ".join(s.value for s in statements)
    owner = ""
    for parameter in function.parameters:
        fields = re.findall(rf"(?<![\w.]){re.escape(parameter.name)}\s*(?:->|\.)\s*(\w+)", text)
        if any(
            (plain_name(f.strip("_")) or f) in asked.coordinates or re.fullmatch(USUAL.format(k="1?"), f)
            for f in fields
        ):
            owner = parameter.name
    made = []
    before = rf"(?<![\w.]){re.escape(owner)}\s*(?:->|\.)\s*(?=\w)" if owner else r"$^"
    for one in statements:
        s = Statement(one.target, re.sub(before, "", one.value), one.op, one.added)
        built = re.fullmatch(r"\(?\s*\{(?P<of>.*)\}\s*\)?", s.value, re.DOTALL) if s.target == RETURN else None
        pairs = (
            [
                re.match(r"\s*(?:\.\s*)?(?P<key>\w+)\s*(?::|=)\s*(?P<value>.+)$", part, re.DOTALL)
                for part in parts_of(built["of"], ",")
                if part
            ]
            if built
            else []
        )
        if pairs and all(pairs):
            made += [Statement(f"given.{m['key']}", m["value"].strip()) for m in pairs if m]
        else:
            made.append(s)
    return made


def _coordinates(asked: Asked, words: list[str]) -> list[str]:
    """The program's own names of the coordinates, in the declared order."""
    found: list[str] = []
    if asked.coordinates:
        for c in asked.coordinates:
            own = [w for w in words if plain_name(w.strip("_")) == c]
            found.append(own[0] if own else c)
        return found
    for k in range(1, asked.count + 1):
        pattern = USUAL.format(k=k if asked.count > 1 else "1?")
        own = [w for w in words if re.fullmatch(pattern, w)]
        if len(own) != 1:
            raise InvalidInput("which coordinate is which is not plain; declare the mechanism with [[bodies]] and the "
                               "program's names of the coordinates")  # fmt: skip
        found.append(own[0])
    return found


def _rate(
    name: str,
    coordinates: list[str],
    words: list[str],
    steps: Steps,
    statements: list[Statement],
    asked: Asked,
) -> str:
    """The program's name of a coordinate's rate."""
    own = [per_step(x, asked.known) for x in steps.get(name, [])]
    if len(own) > 1:
        raise InvalidInput(f"{name} is changed more than once; give the equations alone")
    if own and own[0].isidentifier():
        return own[0]
    if own:
        raise InvalidInput(f"{name} += {own[0][:30]}: the rate of {name} needs a name of its own")
    for s in statements:  # d.theta = y.omega
        path = re.fullmatch(r"\w+(?:->|\.)(?P<field>\w+)", s.target)
        if path and path["field"] == name and s.value.strip().isidentifier():
            return s.value.strip()
    said = derivatives_of(name, [s.target.split(".")[-1].split("->")[-1] for s in statements])
    for word in said:
        value = next(s.value for s in statements if s.target.split(".")[-1].split("->")[-1] == word)
        last = re.split(r"->|\.", value.strip())[-1]
        if last.isidentifier() and last not in coordinates:
            return last
    free = [w for w in words if w not in coordinates and (plain_name(w.strip("_")) or w) not in asked.known]
    computed = {
        s.target for s in statements if not re.fullmatch(r"[^\W\d][\w.>-]*|\w+\[\w+\]|[-+0-9.]+", s.value.strip())
    }
    free = [w for w in free if w not in computed or w in steps]
    turns = name not in asked.slides and (plain_name(name.strip("_")) or name) not in asked.slides
    alike = [c for c in coordinates if (c in asked.slides) != turns]
    found = rates_of(name, free, turns=turns, alone=len(alike) == 1)
    if len(found) != 1:
        of_others = {w for c in coordinates if c != name for w in rates_of(c, free, turns=True, alone=False)}
        left = [w for w in free if w not in of_others]
        if not found and not any(re.search(r"dot|vel|omega|rate|^d|^w|v$", w, re.IGNORECASE) for w in left):
            return f"{name}rateofitsown"  # no row has it
        which = " or ".join(found) if found else "which name"
        raise InvalidInput(
            f"the rate of {name} is {which}? Say it, as in {name}_dot, or give the function's state as a list"
        )
    return found[0]


def _acceleration(k: int, coordinates: list[str], rates: list[str], steps: Steps, writer: Writer, asked: Asked) -> str:
    """What the acceleration of a coordinate is, in names that are written."""
    name, rate = coordinates[k], rates[k]
    if rate in steps:
        return writer.local(f"moves{rate}")
    turns = name not in asked.slides
    alone = sum((c in asked.slides) != turns for c in coordinates) == 1
    listed = writer.returned
    if listed and listed[:1] == "[":
        parts = parts_of(listed[1:-1], ",")
        own = derivatives_of(rate, parts) or accelerations_of(name, parts, turns=turns, alone=alone)
        if len(own) == 1 and own[0] in {target for target, _ in writer.lines}:
            return own[0]
        rest = [part for part in parts if part not in rates]
        if len(rest) == asked.count and len(parts) in (asked.count, 2 * asked.count):
            if [part for part in parts if part in rates] not in ([], rates):
                raise InvalidInput(
                    "the rates are returned in another order than the coordinates; give the state as a list"
                )
            return rest[k]
    targets = {t: t for t, _ in writer.lines}
    fields = {t.rpartition("field")[2]: t for t in targets if "field" in t}
    for pool in (fields, targets):
        if rate in pool and pool is fields:
            return pool[rate]
        free = [t for t in pool if t not in (name, rate)]
        found = derivatives_of(rate, free) or accelerations_of(name, free, turns=turns, alone=alone)
        if len(found) == 1:
            return pool[found[0]]
        if len(found) > 1:
            raise InvalidInput(f"the acceleration of {name} is {' or '.join(found)}? Leave one out")
    if listed and asked.count == 1:
        return f"({listed})"
    raise InvalidInput(f"the acceleration of {name} is not found; give it a name such as {name}_ddot, or return the "
                       "rates and the accelerations in a list")  # fmt: skip
