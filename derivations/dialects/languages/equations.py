# ruff: noqa: E501 -- patterns stand on one line
"""Programs that state equations: FeenoX's phase space with .=, and Julia's ModelingToolkit with Differential and ~."""

from __future__ import annotations

import re
from collections.abc import Collection

from ....models.errors import InvalidInput
from ..markup.calls import closing, parts_of

PHASE = re.compile(r"(?m)^[ \t]*PHASE_SPACE\b(?P<names>[^\n]*)$")
SETTING = re.compile(r"(?:end_time|min_dt|max_dt|dt|dae_\w+|dae_rtol|static_steps|step_\w+|t|rel_error|time_\w+|pi)$")
OPERATOR = re.compile(
    r"(?m)^[ \t]*(?:const\s+)?(?P<name>\w+)\s*=\s*(?:Differential\s*\(\s*t\s*\)(?P<two>\s*\^\s*2)?|(?P<of>\w+)\s*(?:\^\s*2|[*∘]\s*(?P=of)))[ \t]*;?[ \t]*$"
)
TOOLKIT = re.compile(
    r"\bDifferential\s*\(|@mtkmodel\b|\bD_nounits\b|@(?:variables|parameters|independent_variables)\b|@equations\b|\bODE(?:System|Problem)\b"
)
BEGINS = re.compile(
    r"@equations\s+begin\b(?P<a>.*?)\n\s*end\b|\b(?:(?P<name>\w+)\s*=\s*(?:Equation)?|ODESystem\s*\(\s*)\[(?=[^\]]*~)",
    re.DOTALL,
)
XPP = re.compile(r"(?m)^[ \t]*(?:[A-Za-z]\w*'|d[A-Za-z]\w*/dt)[ \t]*=")
XPP_PAR = re.compile(r"(?mi)^[ \t]*(?:par(?:am(?:eter)?s?)?[ \t]+\w+[ \t]*=|done[ \t]*$|@[ \t]|init[ \t]+\w+)")
MOST_ROWS = 24
Stated = tuple[list[str], dict[str, str]]


def stated(text: str, known: Collection[str]) -> Stated | None:
    """The rows, and what other names are; None for a text of another kind. ``known``: what the file declares."""
    if PHASE.search(text):
        return _feenox(text, known)
    if XPP.search(text) and XPP_PAR.search(text) and "{" not in text:
        return _xpp(text, known)
    if "~" in text and TOOLKIT.search(text) and "\\" not in text:
        return _toolkit(text)
    return None


def _feenox(text: str, known: Collection[str]) -> Stated:
    bare = re.sub(r"\\[ \t]*\n", " ", re.sub(r"#[^\n]*", "", text))
    places = [name for m in PHASE.finditer(bare) for name in m["names"].split()]
    rows: list[str] = []
    said: dict[str, str] = {}
    for line in (part.strip() for part in bare.split("\n")):
        if not line or re.match(r"[A-Z][A-Z_]+\b", line):
            if re.match(r"(?:IF|ELSE|WHEN|FIT|M4|FUNCTION)\b", line):
                raise InvalidInput(f"{line[:30]!r}: write out the equations that hold")
            continue
        left, sign, right = line.partition(".=")
        if sign:
            rows.append(f"{left.strip()} = {right.strip()}")
            continue
        name, sign, value = (part.strip() for part in line.partition("="))
        if not sign or not re.fullmatch(r"[A-Za-z]\w*", name):
            raise InvalidInput(f"{line[:40]!r}: neither an equation with .= nor what a name is")
        is_number = re.fullmatch(r"[-+*/().0-9eE\s]+", value) is not None
        if (
            SETTING.fullmatch(name)
            or name.removesuffix("_0") in places
            or (is_number and (name in known or name == "g"))
        ):
            continue
        said[name] = value
    rates = {}
    for row in list(rows):
        for rate, dot in (row.split(" = "), row.split(" = ")[::-1]):
            if rate in places and dot.endswith("_dot") and dot.removesuffix("_dot") in places and row in rows:
                rates[rate] = dot.removesuffix("_dot")
                rows.remove(row)
    primed = {f"{rate}_dot": f"({x}'')" for rate, x in rates.items()} | {rate: f"({x}')" for rate, x in rates.items()}
    primed |= {f"{x}_dot": f"({x}')" for x in places if x not in rates} | {f"{x}_dot_dot": f"({x}'')" for x in places}
    pattern = re.compile(rf"(?<![\w.])(?:{'|'.join(sorted(map(re.escape, primed), key=len, reverse=True))})(?!\w)")

    def one(line: str) -> str:
        return pattern.sub(lambda m: primed[m[0]], line)

    return [one(row) for row in rows], {
        name: one(value) for name, value in said.items() if _used(name, [*rows, *said.values()])
    }


def _xpp(text: str, known: Collection[str]) -> Stated:
    """XPPAUT: x' = …, with parameters, initial values and settings in lines of their own."""
    bare = re.sub(r"\\[ \t]*\n", " ", re.sub(r"(?m)^[ \t]*#[^\n]*", "", text))
    rows: list[str] = []
    said: dict[str, str] = {}
    for line in (part.strip() for part in bare.split("\n")):
        if not line or re.match(
            r"(?i)(?:par(?:am(?:eter)?s?)?|init|aux|@|done|number|p|i|global|set|options|bdry|wiener|markov|table|only)\b|@|\"",
            line,
        ):
            if re.match(r"(?i)global\b", line):
                raise InvalidInput(f"{line[:30]!r}: a jump; write out the equations that hold")
            continue
        left, sign, value = (part.strip() for part in line.partition("="))
        rate = re.fullmatch(r"(?P<a>\w+)'|d(?P<b>\w+)/dt", left)
        if rate and sign:
            rows.append(f"{rate['a'] or rate['b']}' = {value}")
        elif sign and re.fullmatch(r"!?[A-Za-z]\w*", left):
            said[left.lstrip("!")] = value
        elif not re.match(r"\w+\(0\)", left):
            raise InvalidInput(f"{line[:40]!r}: neither a row x' = … nor what a name is")
    rates = {m[2]: m[1] for row in rows if (m := re.fullmatch(r"(\w+)' = (\w+)", row)) and m[2] not in known}
    primed = {rate: f"({x}')" for rate, x in rates.items()}
    left_rows = [row for row in rows if not (re.fullmatch(r"(\w+)' = (\w+)", row) and row.split(" = ")[1] in rates)]
    pattern = re.compile(rf"(?<![\w.])(?P<x>{'|'.join(map(re.escape, primed)) or '$^'})(?P<prime>'?)(?!\w)")

    def one(line: str) -> str:
        return pattern.sub(lambda m: primed[m["x"]][:-1] + "'" * len(m["prime"]) + ")", line)

    return [one(row) for row in left_rows], {
        name: one(value) for name, value in said.items() if _used(name, [*rows, *said.values()])
    }


def _used(name: str, texts: Collection[str]) -> bool:
    return any(re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text) for text in texts)


def _toolkit(text: str) -> Stated:
    bare = re.sub(r"#=.{0,2000}?=#|\"\"\".{0,2000}?\"\"\"|#[^\n]*", "", text, flags=re.DOTALL)
    bare = re.sub(r";[ \t]*(?=\w+\s*=)", "\n", bare)
    orders = {"D": 1} if re.search(r"D_nounits\s+as\s+D|@derivatives\s+D'|@mtkmodel|@equations", bare) else {}
    for found in OPERATOR.finditer(bare):
        if found["of"] and found["of"] not in orders:
            continue
        orders[found["name"]] = 2 if found["two"] or found["of"] else 1
    lists = list(BEGINS.finditer(bare))
    if len(lists) != 1:
        raise InvalidInput(f"{len(lists)} lists of equations with ~; give the one with the equations of motion")
    found = lists[0]
    end = closing(bare, found.end() - 1) if found["a"] is None else found.end()
    inner = found["a"] if found["a"] is not None else bare[found.end() : end]
    rows = [row for part in parts_of(inner, ",") for row in _lines(part)]
    if not rows or len(rows) > MOST_ROWS or any(row.count("~") != 1 for row in rows):
        raise InvalidInput(f"up to {MOST_ROWS} equations with one ~ each are read here, separated by commas or lines")
    outside = bare[: found.start()] + bare[end:]
    said = {}
    for line in re.finditer(r"(?m)^[ \t]*(?P<name>[^\W\d]\w*)\s*=(?!=)\s*(?P<value>[^\n=~@\[]{1,400})$", outside):
        if (
            _used(line["name"], [*rows])
            and "Differential" not in line["value"]
            and not re.fullmatch(r"\w+\s*(?:\^\s*2|[*∘]\s*\w+)", line["value"].strip())
            and not re.match(r"\s*[-0-9.]+\s*$", line["value"])
        ):
            said[line["name"]] = _primes(line["value"].strip().rstrip(";"), orders)
    return [_primes(row.replace("~", "="), orders) for row in rows], said


def _lines(part: str) -> list[str]:
    """Equations of several lines; those that end in a sign, or in an open bracket, go on."""
    rows: list[str] = []
    for line in part.split("\n"):
        if not line.strip():
            continue
        is_open = rows and (
            sum((c in "([{") - (c in ")]}") for c in rows[-1]) > 0
            or re.search(r"[-+*/~^=]\s*$", rows[-1])
            or "~" not in rows[-1]
            or "~" not in line
        )
        if is_open:
            rows[-1] += " " + line.strip()
        else:
            rows.append(line.strip())
    return rows


def _primes(line: str, orders: dict[str, int]) -> str:
    """D(D(θ)), DDt(θ) and Differential(t)(θ) as primes."""
    line = re.sub(
        r"(?<=\w)\s*\(\s*t\s*\)(?!\s*\()",
        "",
        re.sub(r"\bDifferential\s*\(\s*t\s*\)\s*\^\s*2\s*(?=\()", "DDofTime", line),
    )
    line = re.sub(r"\bDifferential(?:\s*\(\s*t\s*\))?\s*(?=\()", "DofTime", line)
    names = {**orders, "DDofTime": 2, "DofTime": 1}
    words = "|".join(sorted(map(re.escape, names), key=len, reverse=True))
    for _ in range(4):
        line = re.sub(
            rf"(?<![\w.])(?P<of>{words})\s*\(\s*(?P<x>[^\W\d]\w*)(?P<primes>'*)\s*\)",
            lambda m: f"{m['x']}{m['primes']}" + "'" * names[m["of"]],
            line,
        )
    return line
