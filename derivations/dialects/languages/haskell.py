# ruff: noqa: E501 -- patterns stand on one line
"""Haskell: definitions in any order under where or let, functions applied without brackets, Hamilton's equations."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass

from ....models.errors import InvalidInput
from ..markup.calls import closing, parts_of
from .program import RETURN, Function, Parameter, Program, Statement

REMARK = re.compile(r"\{-.{0,2000}?-\}|--[^\n]*", re.DOTALL)
RECORD = re.compile(r"(?m)^\s*(?:data|newtype)\s[^{}\n]*(?:\n\s*)?\{[^{}]*\}[^\n]*(?:\n\s*deriving[^\n]*)?|\{\.\.\}")
HASKELL = re.compile(
    r"(?m)^\s*where\b|\bwhere\s*$|\blet\b.*\n?.*\bin\b|^\s*[a-z]\w*'*\s*::\s*[^\n]*->|^\s*[a-z]\w*\s+[\[(][\w\s,']+[\])][^\n=]*=(?!=)"
)
APPLIED = re.compile(r"\b(?:sin|cos)\s+(?:[a-z(]|\$)")
SAID = re.compile(
    r"^(?P<name>[a-z_θφωψα]\w*'*|[\[(][\w\s,']+[\])])(?P<of>(?:\s+(?:[A-Za-z_]\w*'*|[\[(][^=]*?[\])]|_))*)\s*=(?!=)\s*(?P<value>.*)$",
    re.DOTALL,
)
FUNCTIONS = ("sin", "cos", "tan", "sqrt", "negate", "fromIntegral", "realToFrac", "abs")
DERIVATIVE = re.compile(r"d(?P<a>\w+?)dt|d(?P<b>\w+)|(?P<c>\w+?)(?:Dot|_dot|prime)")
LIST = re.compile(
    r"^(?:pure|return|fromList|vector|V\.fromList|listToVector|Just)?\s*(?P<list>[\[(].*[\])])$", re.DOTALL
)


@dataclass(frozen=True)
class _Definition:
    name: str
    patterns: str
    value: str
    indent: int


def from_haskell(text: str, known: Collection[str], coordinates: Collection[str]) -> Program | list[str] | None:
    """A program of Haskell, or rows of its Hamilton's equations; None for any other text."""
    if (
        not HASKELL.search(text)
        or not APPLIED.search(text)
        or "\\" in text
        or "{" in RECORD.sub("", REMARK.sub("", text))
        or ";\n" in text
        or ("return " in text and ":" in text)
    ):
        return None
    found = _definitions(RECORD.sub("", REMARK.sub("", text)))
    if not found:
        return None
    heads = [d for d in found if d.patterns or d.name == RETURN]
    lists = [d for d in heads if _listed(d.value)]
    numbers = {
        d.name
        for d in found
        if re.fullmatch(r"-?[0-9.]+(?:e-?\d+)?", d.value.strip()) and (d.name in known or d.name == "g")
    }
    if len(lists) == 1:
        return _function(lists[0], found, heads, numbers)
    rows = []
    for d in found:
        m = DERIVATIVE.fullmatch(d.name.replace("'", "prime"))
        name = (m["a"] or m["b"] or m["c"]) if m else ""
        if name:
            rows.append(f"{name}' = {_expression(d.value)}")
    if len(rows) >= 2:
        others = [
            d
            for d in found
            if not DERIVATIVE.fullmatch(d.name.replace("'", "prime")) and not d.patterns and d.name not in numbers
        ]
        if any(d.name in coordinates for d in others):
            raise InvalidInput("a coordinate is given a value here; give the equations alone")
        return [f"{d.name} = {_expression(d.value)}" for d in others] + rows
    raise InvalidInput("no definition with the equations of motion is found; give one that returns a list [w1, w2, a1, a2], "
                       "with what it needs under where")  # fmt: skip


def _definitions(text: str) -> list[_Definition]:
    made: list[_Definition] = []
    for raw in text.split("\n"):
        line = raw.expandtabs(8)
        if not line.strip() or re.match(
            r"\s*(?:module|import|data|type|newtype|deriving|instance|class)\b|^\s*\S+\s*(?:,\s*\S+\s*)*::", line
        ):
            continue
        bare = re.sub(r"^(\s*)(?:where|let)\b", lambda m: m[1] + " " * (len(m[0]) - len(m[1])), line)
        if not bare.strip():
            continue
        if re.match(r"\s*\|", bare):
            raise InvalidInput(f"{bare.strip()[:30]!r}: write out what a guard comes to")
        behind = re.match(r"\s*in\b(?P<value>.*)$", bare)
        indent = len(bare) - len(bare.lstrip())
        if behind:
            made.append(_Definition(RETURN, "", behind["value"].strip(), indent))
            continue
        for part in (re.sub(r"\s+where\s*$", "", each) for each in parts_of(bare.strip(), ";")):
            found = SAID.match(part) if part else None
            is_new = found is not None and not (made and _is_open(made[-1].value))
            if is_new and found:
                value = re.sub(r"^let\b", "", found["value"]).strip()
                made.append(_Definition(found["name"], found["of"].strip(), value, indent))
                if found["value"].startswith("let"):
                    inner = SAID.match(value)
                    made[-1] = _Definition(found["name"], found["of"].strip(), "", indent)
                    if inner:
                        made.append(_Definition(inner["name"], inner["of"].strip(), inner["value"], indent))
            elif made and part:
                last = made[-1]
                made[-1] = _Definition(last.name, last.patterns, f"{last.value} {part}", last.indent)
            elif part:
                raise InvalidInput(f"{part[:30]!r}: definitions are read here, and nothing else")
    return made


def _is_open(value: str) -> bool:
    return sum((c in "([") - (c in ")]") for c in value) > 0


def _listed(value: str) -> list[str] | None:
    """The parts of a list, a tuple, or what a constructor is applied to."""
    bare = value.strip()
    found = LIST.match(bare)
    if found and closing(found["list"], 0) == len(found["list"]) - 1:
        parts = parts_of(found["list"][1:-1], ",")
        return parts if len(parts) > 1 else None
    built = re.match(r"[A-Z]\w*\s+(?P<of>.+)$", bare, re.DOTALL)
    atoms = _atoms(built["of"]) if built else []
    return (
        atoms
        if len(atoms) > 1
        and not re.search(r"^[-+*/]|\s[-+*/]\s", re.sub(r"\([^()]*(?:\([^()]*\)[^()]*)*\)", "x", bare))
        else None
    )


def _atoms(text: str) -> list[str]:
    """What stands side by side: names, numbers and brackets."""
    return [m[0] for m in re.finditer(r"\((?:[^()]|\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\))*\)|[\w.']+", text)]


def _function(
    head: _Definition, found: list[_Definition], heads: list[_Definition], numbers: Collection[str]
) -> Program:
    parts = _listed(head.value) or []
    statements = []
    for d in found:
        if d in heads or d.name in numbers or not d.value:
            continue
        target = d.name.replace("'", "p")
        if target[:1] in "[(":
            target = "(" + target[1:-1] + ")"
        statements.append(Statement(target, _expression(d.value)))
    owner = next((d for d in reversed(found[: found.index(head) + 1]) if d.patterns), head)
    parameters = []
    for pattern in re.findall(r"[\[(][^\[\]()]*[\])]|[\w']+", owner.patterns.replace("@", " ")):
        if pattern[0] in "[(":
            names = parts_of(pattern[1:-1], ",")
            names = names if len(names) > 1 else pattern[1:-1].split()[1:]
            parameters.append(Parameter("[" + ", ".join(n.strip().replace("'", "p") for n in names) + "]", "array"))
        else:
            parameters.append(Parameter(pattern.replace("'", "p")))
    ordered = _in_order(statements)
    made = Function(
        head.name,
        tuple(parameters),
        (*ordered, Statement(RETURN, "[" + ", ".join(_expression(p) for p in parts) + "]")),
    )
    return Program((made,), (), 0, whole=False, powers=("**", "^"))


def _in_order(statements: list[Statement]) -> list[Statement]:
    """Each behind those that it needs: the order of definitions means nothing here."""
    names = {s: set(re.findall(r"[^\W\d]\w*", s.target)) for s in statements}
    left, made = list(statements), []
    while left:
        missing = set().union(*(names[s] for s in left))
        ready = [s for s in left if not set(re.findall(r"[^\W\d]\w*", s.value)) & missing]
        if not ready:
            raise InvalidInput("definitions that need each other in a circle")
        made += ready
        left = [s for s in left if s not in ready]
    return made


def _expression(text: str) -> str:
    """sin q as sin(q), sin $ a - b as sin(a - b); primes in names as p."""
    text = re.sub(r"\s+", " ", text).strip()
    text = re.sub(r"(?<=[\w)])'+", lambda m: "p" * len(m[0]), text).replace("^^", "^")
    while "$" in text:
        before, _, behind = text.rpartition("$")
        text = f"{before.rstrip()} ({behind.strip()})"
    for _ in range(100):
        found = re.search(rf"\b(?P<f>{'|'.join(FUNCTIONS)})\s+(?P<x>[\w.]+|\()", text)
        if found is None:
            break
        if found["x"] in FUNCTIONS:
            raise InvalidInput(f"{found[0][:30]!r}: put brackets around what a function is applied to")
        end = closing(text, found.end() - 1) + 1 if found["x"] == "(" else found.end()
        if end <= 0:
            raise InvalidInput("a bracket is opened and not closed")
        inner = text[found.start("x") : end]
        inner = inner if inner[0] == "(" else f"({inner})"
        name = {"negate": "-1*", "fromIntegral": "", "realToFrac": ""}.get(found["f"], found["f"])
        text = f"{text[: found.start()]}{name}{inner}{text[end:]}"
    beside = re.search(r"(?<![\w.])(?!(?:sin|cos|tan|sqrt|abs)\b)[\w.]+ (?=[\w(])|\) (?=[\w(])", text)
    if beside and not re.match(r"^\s*[\[(]", text):
        raise InvalidInput(f"{text[beside.start() :][:30]!r}: a function that is applied; write out what it comes to")
    return text
