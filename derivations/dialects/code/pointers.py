"""C and C++: a function object of a struct, and accelerations put where pointers show, *theta_ddot = …"""

from __future__ import annotations

import re
from collections.abc import Sequence

from ....models.errors import InvalidInput
from ..names import plain_name
from ..statements import split

REMARK = re.compile(r"/\*(?:[^*]|\*(?!/)){0,2000}\*/|//[^\n]*")
STRUCT = re.compile(r"^\s*(?:struct|class)\s+\w+[^{]{0,100}\{(?P<inner>.*)\}\s*;?\s*$", re.DOTALL)
OPERATOR = re.compile(
    r"\bvoid\s+operator\s*\(\s*\)\s*(?P<arguments>\([^()]*\))\s*(?:const\s*)?(?:noexcept\s*)?\{(?P<body>[^{}]*)\}\s*$",
    re.DOTALL,
)
MEMBERS = re.compile(
    r"(?:\s*(?:public|private)\s*:|\s*(?:const\s+|static\s+|constexpr\s+){0,3}(?:double|float|real_t|value_type)\s+[\w\s,=.{}e+-]{1,200};)*\s*$"
)
POINTED = re.compile(
    r"^\s*(?:static\s+|inline\s+|extern\s+){0,3}void\s+\w+\s*\((?P<arguments>[^()]*)\)\s*\{(?P<body>[^{}]*)\}\s*$",
    re.DOTALL,
)
ARGUMENT = re.compile(r"^(?:const\s+)?(?:double|float|real_t)\s*(?:const\s+)?(?P<star>[*&])?\s*(?P<name>\w{1,40})$")
PUT = re.compile(r"^(?P<target>\*?\s*\w{1,40})\s*=(?!=)\s*(?P<value>.+)$", re.DOTALL)
TYPE = re.compile(r"^(?:const\s+|auto\s+|double\s+|float\s+|real_t\s+){1,3}")
SINGLE = re.compile(r"\b(sin|cos|tan|sqrt|pow|fabs)f\s*\(")
NUMBER = re.compile(r"(?<![\w.])([0-9]+(?:\.[0-9]*)?|\.[0-9]+)[fF]\b")
SECOND = re.compile(r"(?:_?ddot|_dd|dd|_acc|acc|_ddt2)$")
Pair = tuple[list[str], dict[str, str]]


def from_struct(text: str) -> str:
    """The function object of a struct as a function; any other text as it is."""
    found = STRUCT.match(REMARK.sub(" ", text))
    body = OPERATOR.search(found["inner"]) if found else None
    if found is None or body is None:
        return text
    if not MEMBERS.fullmatch(found["inner"][: body.start()]):
        raise InvalidInput(
            "a struct with more than numbers and one operator(): give the function with the equations alone"
        )
    parts = [part.strip() for part in body["arguments"][1:-1].split(",")]
    named = [
        part if re.search(r"[\s&*]\w+$", part) and not re.fullmatch(r"(?:const\s+)?double", part) else part + " t"
        for part in parts
    ]
    return f"void rhs({', '.join(named)}) {{{body['body']}}}"


def from_pointers(text: str, coordinates: Sequence[str]) -> Pair | None:
    """Rows and definitions of a C function that writes accelerations to pointers; None where it is none."""
    found = POINTED.match(REMARK.sub(" ", text))
    arguments = [ARGUMENT.match(part.strip()) for part in found["arguments"].split(",")] if found else []
    if found is None or not arguments or not all(arguments):
        return None
    given = [m for m in arguments if m]
    outs = [m["name"] for m in given if m["star"]]
    owners = {out: plain_name(SECOND.sub("", out)) for out in outs if SECOND.search(out)}
    if not outs or len(owners) < len(outs) or {*owners.values()} != set(coordinates):
        return None
    rows: list[str] = []
    lines: dict[str, str] = {}
    own: dict[str, str] = {}
    prefix = next(word for word in ("val", "line", "part", "quantity") if word not in text)
    for statement in (part for part in found["body"].split(";") if part.strip()):
        for target, value in _assigned(statement.strip()):
            if target in own or (target in {m["name"] for m in given} and target not in outs):
                raise InvalidInput(f"{target} is changed; give each value a name of its own")
            early = next((out for out in outs if out not in own and re.search(rf"\b{out}\b", value)), None)
            if early:
                raise InvalidInput(f"*{early} is read before it is written")
            written = re.sub(r"(?<![\w.])[A-Za-z_]\w*", lambda m: own.get(m[0], m[0]), value)
            if target in outs:
                rows.append(f"{target} = {written}")
                own[target] = target
            elif not re.fullmatch(r"[0-9.]+", written):
                own[target] = f"{prefix}{len(lines) + 1}"
                lines[own[target]] = written
    if len(rows) != len(outs):
        raise InvalidInput(f"{len(rows)} of {len(outs)} accelerations are written; write each once")
    return rows, lines


def _assigned(statement: str) -> list[tuple[str, str]]:
    bare = TYPE.sub("", statement)
    parts = split(bare, ",") if bare != statement else [bare]
    made = []
    for part in parts:
        found = PUT.match(part)
        if found is None:
            raise InvalidInput(f"{part[:40]!r}: assignments are followed, and nothing else")
        value = NUMBER.sub(r"\1", SINGLE.sub(r"\1(", found["value"].strip()))
        value = re.sub(r"^\*\s*(?=[A-Za-z_])", "", value)
        value = re.sub(r"\(\s*\*\s*(\w+)\s*\)", r"\1", value)
        value = (
            re.sub(r"(?<=[-+*/(,])(\s*)\*\s*(\w+)", r"\1\2", value)
            if re.search(r"[-+*/(,]\s*\*\s*\w", value)
            else value
        )
        made.append((found["target"].replace("*", "").strip(), value))
    return made
