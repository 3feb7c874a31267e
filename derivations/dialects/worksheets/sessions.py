# ruff: noqa: E501 -- patterns stand on one line
"""A session's statements as rows and definitions, whatever program it is of."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from ....models.errors import InvalidInput
from ..bracketed import GREEK_LETTER, SUBSCRIPT
from ..letters.every_text import everywhere, rows_of
from ..markup.calls import closing, parts_of
from ..names import GREEK, LOWS, plain_name
from ..statements import is_program
from ..table import known_of
from .definitions import Definitions, in_order, split_statements, with_definitions
from .modelica import from_modelica

_NAME = r"[A-Za-zα-ωΑ-Ω]\w{0,30}"
COMMENT = {"mathematica": re.compile(r"\(\*.{0,400}?\*\)", re.DOTALL), "sympy": re.compile(r"#[^\n]*"),
           "matlab": re.compile(r"%[^\n]*"), "maple": re.compile(r"#[^\n]*"),
           "maxima": re.compile(r"/\*.{0,400}?\*/", re.DOTALL)}  # fmt: skip
LABEL = re.compile(
    r"(?m)^[ \t]*\(%i[0-9]{1,3}\)[ \t]*|^[ \t]*In\[[0-9]{1,3}\]:?=[ \t]*|^[ \t]*>>>?[ \t]*|^[ \t]*In \[[0-9]{1,3}\]:[ \t]*"
)
ANSWER = re.compile(r"(?m)^[ \t]*(?:\(%o[0-9]{1,3}\)|Out\[[0-9]{1,3}\])")
ASSIGNED = {
    "mathematica": re.compile(rf"^(?P<name>{_NAME})\s*:?=(?!=)\s*(?P<value>.+)$", re.DOTALL),
    "maple": re.compile(rf"^(?P<name>{_NAME})\s*:=\s*(?P<value>.+)$", re.DOTALL),
    "maxima": re.compile(rf"^(?P<name>{_NAME})\s*:(?!=)\s*(?P<value>.+)$", re.DOTALL),
    "sympy": re.compile(rf"^(?P<name>{_NAME})\s*=(?!=)\s*(?P<value>.+)$", re.DOTALL),
    "matlab": re.compile(rf"^(?P<name>{_NAME})(?:\(t\))?\s*=(?!=)\s*(?P<value>.+)$", re.DOTALL),
}
ENDS = {"mathematica": ";\n", "maple": ";\n", "maxima": "$;\n", "sympy": ";\n", "matlab": ";\n"}
SILENT = re.compile(
    r"^(?:restart|with\s*\(|alias\s*\(|interface\s*\(|assume\s*\(|assumptions?\b|Clear\w*\[|Needs\[|Remove\[|\$Assumptions\b|kill\s*\(|depends\s*\("
    r"|load\s*\(|declare\s*\(|ratprint\b|from\s+sympy|import\s|init_printing|syms\b|symvar\b|clear\b|clc\b|close\b|format\b|pretty\s*\(|disp\s*\("
    r"|latex\s*\(|simplify\s*\(\s*eq\w*\s*\)$|print\s*\(|pprint\s*\(|display\s*\(|assume\b|sympref\b|dynamicsymbols\b|end$)"
)
SOLVED = re.compile(
    r"\b(?:odeToVectorField|matlabFunction|vpasolve|solve|dsolve|linsolve|symbols|dynamicsymbols|Function|Symbol|equationsToMatrix|ode45|Plot|plot"
    r"|reduceDifferentialOrder|massMatrixForm|Manipulate|LaplaceTransform|subs)\s*[(\[]"
)
SOLVER = re.compile(r"\b(?:ND|D|PD)Solve(?:Value)?\s*\[|\bParametricNDSolve(?:Value)?\s*\[|\bdsolve\s*\(")
INITIAL = re.compile(r"^(?P<left>.{1,60}?)(?:==|=)[^=]*$", re.DOTALL)
AT_ZERO = re.compile(r"[\[(]\s*0(?:\.0*)?\s*[\])]")
SYMPY_EQ = re.compile(r"(?<![A-Za-z.])(?:sp\.|sympy\.|sm\.)?(?:Eq|Equality)\s*\(")
NUMBER = re.compile(r"\s*[0-9]{1,12}(?:\.[0-9]{0,12})?\s*")  # what is right for every value is right for it
MOST_STATEMENTS, MOST_LISTS = 40, 3  # lists in one another


def from_worksheets(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with rows in place of a session."""
    rows = rows_of(data)
    known = known_of(data)
    if not rows or any("Symbol(" in text for _, text in rows):
        return data
    data = everywhere(data, lambda text: text if is_program(text) else _functions(text))
    rows = rows_of(data)
    made: list[str] = []
    said: Definitions = {}
    for label, text in rows:
        try:
            found = from_modelica(text) or _session(text)
        except InvalidInput as error:
            raise InvalidInput(f"equations.{label:.40}: {error}") from None
        made += found[0] if found else [text]
        said |= found[1] if found else {}
    if made != [text for _, text in rows] or said:
        define = data.get("define", {})
        taken = {*known.coordinates, *known.quantities} | (
            {plain_name(str(x)) for x in define} if isinstance(define, dict) else set()
        )
        said = {n: v for n, v in said.items() if not (NUMBER.fullmatch(v) and plain_name(n) in known.quantities)}
        clash = next((name for name in said if plain_name(name) in taken), None)
        if clash:
            raise InvalidInput(
                f"equations: {clash} is said again by the session; leave it out of [define], or out of the session"
            )
        ordered = in_order(said)
        if ordered is None or not isinstance(define, dict):
            raise InvalidInput("equations: the session's names say each other; write the rows out")
        keys = [label for label, _ in rows] if len(made) == len(rows) else [str(k) for k in range(1, len(made) + 1)]
        data = (
            data
            | {"equations": dict(zip(keys, made, strict=True))}
            | ({"define": {**define, **ordered}} if said else {})
        )
    data = everywhere(data, lambda text: text if is_program(text) else _derivatives(text, known.coordinates))
    return with_definitions(data)


def _functions(text: str) -> str:
    """Sin[w t] of Mathematica as sin(w t), before anything looks for cosines of time; Subscript[\\[Phi], 1] as φ_1."""
    if "[" not in text:
        return text
    text = GREEK_LETTER.sub(lambda m: GREEK[m["word"].lower()][0] + m["index"], text)
    text = SUBSCRIPT.sub(lambda m: f"{m['x']}_{m['i']}", text)
    at = 0
    for _ in range(400):
        found = re.compile(r"(?<![A-Za-z])(?P<of>Sin|Cos|Tan)\[").search(text, at)
        end = closing(text, found.end() - 1) if found else -1
        if found is None or end < 0:
            return text
        text = f"{text[: found.start()]}{found['of'].lower()}({text[found.end() : end]}){text[end + 1 :]}"
        at = found.start()
    return text


def _kind(text: str) -> str:  # noqa: PLR0911 -- one for each
    """Which program a session is of; an empty text for formulas alone."""
    bare = re.sub(r"^(?:\s*/\*.{0,400}?\*/)*\s*", "", text, flags=re.DOTALL).strip()
    if re.match(r"(?:kill|depends|load|declare)\s*\([^()]{0,80}\)\s*[;$]", bare) and re.search(
        rf"(?m)^\s*{_NAME}\s*:[^=]", bare
    ):
        return "maxima"
    if re.search(r"\(%i[0-9]", text) or (
        "\\" not in bare and re.search(r"\$\s*(?:$|\n)", text) and re.match(rf"{_NAME}\s*:[^=]", bare)
    ):
        return "maxima"
    if re.match(rf"{_NAME}\s*:=", bare) and not re.search(r"\w\[|==|\\", bare):
        return "maple"
    if re.search(r"(?m)^\s*(?:restart\b|with\s*\(|alias\s*\()", text) and ":=" in text:
        return "maple"
    if re.search(r"(?m)^\s*syms\b", text) or (
        re.search(rf"(?m)^\s*{_NAME}(?:\(t\))?\s*=[^=\n]*[^=<>~]==[^=]", text) and "[" not in text.partition("=")[2][:3]
    ):
        return "matlab" if not re.search(r"\w\s*'{0,2}\[\s*t\s*\]|(?:Sin|Cos)\[|\\\[", text) else "mathematica"
    if SYMPY_EQ.search(text):
        return "sympy"
    if (
        SOLVER.search(text)
        or (re.match(rf"(?:{_NAME}\s*:?=\s*)?\{{", bare) and "==" in text)
        or re.match(rf"In\[|{_NAME}\s*=[^=].*==", bare, re.DOTALL)
    ):
        return "mathematica"
    return ""


def _session(text: str) -> tuple[list[str], Definitions] | None:
    kind = _kind(text)
    if not kind or "\\begin" in text:
        return None
    if ANSWER.search(text):
        raise InvalidInput("a session with its answers, (%o1) or Out[1]: give the inputs alone")
    bare = LABEL.sub("", COMMENT[kind].sub(" ", text))
    if kind == "maple":
        bare = re.sub(r":[ \t]*(?=\n|$)", ";", bare)
    if kind == "matlab":
        bare = re.sub(r"\.\.\.[^\n]{0,200}\n", " ", bare)
    statements = split_statements(bare, ENDS[kind])
    if len(statements) > MOST_STATEMENTS:
        raise InvalidInput(f"a session of more than {MOST_STATEMENTS} statements; give the equations alone")
    rows: list[str] = []
    said: Definitions = {}
    names: set[str] = set()
    for statement in statements:
        if SILENT.match(statement):
            continue
        found = ASSIGNED[kind].match(statement)
        name, value = (found["name"], found["value"].strip()) if found else ("", statement)
        if name and name in names:
            raise InvalidInput(f"{name} is said twice in this session; give the equations that are meant, alone")
        names |= {name} if name else set()
        equations = _equations(value, kind)
        if equations:
            rows += equations
        elif (
            (SOLVER.match(value) and rows)
            or SOLVED.search(value)
            or re.match(r"\[[\w,\s]+\]\s*=", statement)
            or _only_names(value, names)
        ):
            continue
        elif name:
            said[name] = value
        else:
            raise InvalidInput(
                f"{statement[:40]!r} of a session is neither an equation nor says what a name is; leave it out"
            )
    return (rows, _used(said, rows)) if rows else None


def _only_names(value: str, names: set[str]) -> bool:
    """[eq1, eq2]: nothing new."""
    inner = re.sub(r"^[\[({]|[\])}]$", "", value.strip())
    parts = [part.strip() for part in inner.split(",")]
    return bool(parts) and all(part in names for part in parts)


def _used(said: Definitions, rows: Sequence[str]) -> Definitions:
    """The definitions that rows use, or that one of these does: numbers for plots are none of the mechanics."""
    text, kept = " ".join(rows), {}
    for name, value in reversed(list(said.items())):
        if re.search(rf"(?<![A-Za-z0-9_]){re.escape(name)}(?![A-Za-z0-9_])", text):
            kept[name] = value
            text += " " + value
    return dict(reversed(list(kept.items())))


def _equations(value: str, kind: str, depth: int = 0) -> list[str]:
    """The equations of one statement: alone, in a list, or as a solver is given them; else none."""
    if depth > MOST_LISTS:
        return []
    solver = SOLVER.match(value)
    if solver:
        end = closing(value, solver.end() - 1)
        inner = parts_of(value[solver.end() : end], ",")[0] if end > 0 else ""
        return [one for one in _listed(inner) for one in _equations(one, kind, depth + 1) if not _is_initial(one)]
    listed = _listed(value)
    if len(listed) > 1 or (listed and listed[0] != value.strip()):
        made = [_equations(part, kind, depth + 1) for part in listed]
        return [one[0] for one in made] if all(len(one) == 1 for one in made) else []
    found = SYMPY_EQ.match(value)
    if found:
        end = closing(value, found.end() - 1)
        parts = parts_of(value[found.end() : end], ",") if end == len(value) - 1 else []
        if len(parts) == 3 and re.match(r"evaluate\s*=", parts[2]):
            parts = parts[:2]
        return [f"{parts[0]} = {parts[1]}"] if len(parts) == 2 else []
    signs = re.findall(r"(?<![=<>!:~])==?(?!=)", value)
    wanted = "==" if kind in ("mathematica", "matlab") else "="
    return [value.replace(wanted, "=")] if signs == [wanted] and kind != "sympy" else []


def _listed(value: str) -> list[str]:
    """The parts of {…}, […] or a tuple; the text alone where it is none."""
    bare = value.strip()
    if (
        bare[:1] in ("[", "{", "(")
        and closing(bare, 0) == len(bare) - 1
        and (bare[0] != "(" or len(parts_of(bare[1:-1], ",")) > 1)
    ):
        inner = [part for part in parts_of(bare[1:-1], ",") if part]
        columns = [part for part in parts_of(bare[1:-1], ";") if part]
        if bare[0] == "[" and len(columns) > 1:
            return columns if all("==" in part for part in columns) else [bare]
        return inner
    return [bare]


def _is_initial(equation: str) -> bool:
    """Whether an equation says a value at the start: θ[0] = 0.1."""
    found = INITIAL.match(equation)
    return found is not None and AT_ZERO.search(found["left"]) is not None


def _derivatives(text: str, coordinates: Sequence[str]) -> str:
    """diff(a(t), t, 2), Derivative(a(t), (t, 2)) and a''[t] of a declared coordinate as primes."""
    if "Symbol(" in text or not any(word in text for word in ("diff", "Derivative", "[t]", "D(", "D[")):
        return text
    for coordinate in coordinates:
        x = _spelled(coordinate)
        of = rf"(?<![A-Za-z0-9_\\])(?P<x>{x})\s*(?:[(\[]\s*t\s*[)\]])?"
        two = r"(?:t\s*,\s*2|t\s*\$\s*2|t\s*,\s*t|\(\s*t\s*,\s*2\s*\)|\{\s*t\s*,\s*2\s*\})"
        for pattern, primes in (
            (rf"'?(?<![A-Za-z])(?:diff|Derivative|D)\s*[(\[]\s*{of}\s*,\s*{two}\s*[)\]]", "''"),
            (rf"'?(?<![A-Za-z])(?:diff|Derivative|D)\s*[(\[]\s*{of}\s*,\s*t\s*(?:,\s*1\s*)?[)\]]", "'"),
        ):
            text = re.sub(pattern, lambda m, p=primes: m["x"] + p, text)  # type: ignore[misc]
    return text


def _spelled(coordinate: str) -> str:
    """A pattern of a coordinate's name: a word or its Greek letter, with an index or none."""
    word = next((w for w in sorted(GREEK, key=len, reverse=True) if coordinate.startswith(w)), "")
    base, index = (word, coordinate[len(word) :]) if word else (coordinate.rstrip("0123456789"), "")
    index = index or coordinate[len(base) :]
    letters = rf"(?:{base}|[{GREEK[word]}])" if word else re.escape(base)
    low = "".join(LOWS[int(c)] for c in index) if index.isdigit() else ""
    ends = rf"(?:_?{re.escape(index)}{'|' + low if low else ''})" if index else ""
    return letters + ends
