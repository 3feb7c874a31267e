# ruff: noqa: E501 -- patterns stand on one line
"""Members: m_ and l1_ without the low line that C++ ends them by, s->m and (*s).m of C as m, and p.m as m."""

from __future__ import annotations

import re
from typing import Any

from ....models.errors import InvalidInput
from .every_text import everywhere, rows_of

NAME = re.compile(r"\s*(?P<name>[A-Za-z][A-Za-z0-9]{0,20})_\s*")
MEMBER = re.compile(r"(?<![\w\\])(?P<name>[A-Za-z][A-Za-z0-9]{0,20})_(?=\s*(?:[-+*/^()=,;.\]]|$))")
POINTER = re.compile(
    r"(?<![\w.>])(?:\(\s*\*\s*(?P<of>[A-Za-z]\w{0,20})\s*\)\s*\.|(?P<by>[A-Za-z]\w{0,20})->)(?P<name>[A-Za-z]\w{0,30})"
)
NAMED = re.compile(r"(?:(?:const|float|double|auto)\s+)*(?P<x>[A-Za-z]\w{0,30})\s*=\s*(?P=x)\s*(?=[;,\n]|$)")
OF_RATE = re.compile(r"\s*\(?\s*\w+\s*'{1,2}\s*\)?\s*")  # phi_ of "phi'": the name of a rate, and no member
WHOLE = re.compile(r"(?:^|[=(,+-])\s*(?P<of>[0-9]+\s*/\s*[0-9]+)(?![\w.])")


OWNED = re.compile(
    r"(?<![\w\\.])(?P<of>[A-Za-z]\w{0,20})(?:[(\[](?P<k>[0-9])[)\]])?\.(?P<name>[A-Za-z]\w{0,20})(?![\w.(])"
)
TAKEN = re.compile(
    r"(?m)(?:^|;)[ \t]*(?:const[ \t]+|double[ \t]+|float[ \t]+)?(?P<names>[A-Za-z]\w{0,20}(?:[ \t]*,[ \t]*[A-Za-z]\w{0,20}){0,9})[ \t]*=[ \t]*(?P<values>[\w.,()\[\] \t]{1,200}?)[ \t]*(?=;|$|[#%]|//)"
)
WORDS = ("name", "on", "joint", "along", "about", "motion")


def without_owners(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with m for p.m, as bodies and [define] call what a program has so; m1 for params(1).m, which is said.

    Raises InvalidInput where two of them have one name then.
    """
    bodies, define = data.get("bodies"), data.get("define", {})
    if not isinstance(bodies, list) or not all(isinstance(b, dict) for b in bodies) or not isinstance(define, dict):
        return data
    text = "\n".join(line for _, line in rows_of(data))
    declared = [str(v)[:200] for b in bodies for key, v in b.items() if key not in WORDS]
    said = [str(x)[:200] for pair in define.items() for x in pair]
    paths = {m[0]: _own(m, text) for x in declared for m in OWNED.finditer(x) if m[0] in text}
    if not paths:
        return data
    paths |= {m[0]: _own(m, text) for x in said for m in OWNED.finditer(x) if m[0] in text}
    paths = {path: name for path, name in paths.items() if not str(define.get(path, "'")).isidentifier()}
    for path, name in paths.items():
        other = next((x for x, y in paths.items() if y == name and x != path), None)
        if other is not None:
            raise InvalidInput(f"bodies: {path} and {other} are two quantities; say in [define] '{path}' = \"{name}a\"")

    def plain(value: Any) -> Any:
        return OWNED.sub(lambda m: paths.get(m[0], m[0]), value) if isinstance(value, str) else value

    made = {plain(str(key)): plain(value) for key, value in define.items()}
    return data | {
        "bodies": [{k: v if k in WORDS else plain(v) for k, v in b.items()} for b in bodies],
        "define": {k: v for k, v in made.items() if k != v},
    }


def _own(path: re.Match[str], text: str) -> str:
    """What the program calls p.m alone, as in mass = p.m or M, m = p.M, p.m; else m."""
    for line in TAKEN.finditer(text):
        names, values = ([x.strip() for x in line[side].split(",")] for side in ("names", "values"))
        if len(names) == len(values) and path[0] in values:
            return names[values.index(path[0])]
    return f"{path['name']}{path['k'] or ''}"


def without_pointers(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with m for s->m in lines of C without a function around them.

    Raises InvalidInput where two structs have a field of one name, or where 4/3 stands, which is 1 there.
    """
    rows = rows_of(data)
    text = "\n".join(line for _, line in rows)
    found = list(POINTER.finditer(text))
    if not found or re.search(r"[{\\]", text):
        return data
    owners: dict[str, set[str]] = {}
    for match in found:
        owners.setdefault(match["name"], set()).add(match["of"] or match["by"])
    bare = POINTER.sub(" ", text)
    if any(re.search(rf"(?<!\w){x}(?!\w)", bare) for of in owners.values() for x in of):
        return data  # Mathematica's rules, m->M
    twice = next((name for name, of in owners.items() if len(of) > 1), None)
    if twice is not None:
        listed = " and ".join(f"{of}->{twice}" for of in sorted(owners[twice]))
        raise InvalidInput(f"equations.{rows[0][0]:.40}: {listed} are two things; give each a name of its own")
    whole = WHOLE.search(text)
    if whole:
        raise InvalidInput(f"equations.{rows[0][0]:.40}: {whole['of']} is a division of whole numbers, "
                           f"{_divided(whole['of'])} in C; write 4.0/3.0 for a fraction")  # fmt: skip
    made = {label: NAMED.sub("", POINTER.sub(lambda m: m["name"], line)) for label, line in rows}
    return data | {"equations": made}


def _divided(text: str) -> str:
    above, below = (int(part) for part in text.split("/"))
    return str(above // below) if below else "undefined"


def without_low_lines(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with m for m_, of what bodies and [define] call so; programs keep their own names.

    Raises InvalidInput where m is another quantity besides m_.
    """
    bodies, define = data.get("bodies"), data.get("define")
    tables = [b for b in bodies if isinstance(b, dict)] if isinstance(bodies, list) else []
    texts = [str(v)[:200] for b in tables for v in b.values()]
    names = {m["name"] for text in texts for m in MEMBER.finditer(text)}
    if isinstance(define, dict):
        names |= {m["name"] for key in define if (m := NAME.fullmatch(str(key)[:40]))}
        names -= {name for name in names if OF_RATE.fullmatch(str(define.get(f"{name}_", "")), 0, 60)}
    if not names:
        return data
    for name in sorted(names):
        alone = re.compile(rf"(?<![\w\\]){name}(?![\w])")
        if any(alone.search(text) for text in texts):
            raise InvalidInput(f"bodies: {name} and {name}_ are two quantities here; give each a name of its own")
    pattern = re.compile(
        rf"(?<![\w\\])(?P<name>{'|'.join(sorted(names, key=len, reverse=True))})_(?=\s*(?:[-+*/^()=,;.\]]|$))"
    )
    kept = {name: data[name] for name in ("equations",) if name in data and _is_program(data[name])}
    made = everywhere({k: v for k, v in data.items() if k not in kept}, lambda text: pattern.sub(r"\g<name>", text))
    made |= kept
    if isinstance(made.get("define"), dict):
        made["define"] = {key: value for key, value in made["define"].items() if str(key).strip() != str(value).strip()}
    return made


def _is_program(table: object) -> bool:
    """Whether the equations are the text of a program, which has local names besides."""
    texts = list(table.values()) if isinstance(table, dict) else table if isinstance(table, list) else []
    return any(isinstance(text, str) and "{" in text and ";" in text for text in texts)
