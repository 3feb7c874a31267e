# ruff: noqa: E501 -- patterns stand on one line
"""Julia: function … end, static arrays, macros, views, products by juxtaposition, arrays counted from 1."""

from __future__ import annotations

import re
from dataclasses import replace
from unicodedata import normalize

from ....models.errors import InvalidInput
from ..markup.calls import closing, parts_of
from ..names import FIGURES
from .braces import from_braces
from .by_words import no_leading_signs
from .program import Program

HEAD = re.compile(r"(?m)^(?P<blank>[ \t]*)(?:@\w+\s+)*function\s+(?P<name>[\w.!]*)\s*(?=\()")
NOT_JULIA = re.compile(
    r"\blocal\s+function\b|\bthen\b|\bmath\.|=>|\bconst\s+\w+\s*=\s*\(|;\s*\n\s*\}|^\s*%", re.MULTILINE
)
REMARK = re.compile(r"#=.{0,2000}?=#|\"\"\".{0,2000}?\"\"\"|#[^\n]*", re.DOTALL)
TYPE = re.compile(
    r"::\s*(?:<:)?[A-Za-z_][\w.]*(?:\{(?:[^{}]|\{[^{}]*\})*\})?|\bwhere\s*(?:\{[^{}]*\}|\w+(?:\s*<:\s*\w+)?)"
)
STATIC = re.compile(
    r"@?(?:[SM](?:Vector|Matrix|Array)|SA_?F?\d*|Vector|Matrix)(?:\{[^{}]*\})?\s*(?=[(\[])|\bcollect\s*(?=\()"
)
MACRO = re.compile(
    r"@(?:inline|inbounds|views|view|fastmath|muladd|simd|noinline|assert[^\n]*|propagate_inbounds|__dot__|\.|turbo|boundscheck)(?!\w)\s*"
)
SINCOS = re.compile(r"(?m)^(?P<blank>[ \t]*)(?P<s>\w+)\s*,\s*(?P<c>\w+)\s*=\s*sincos\s*\((?P<of>[^\n]{1,200})\)[ \t]*$")
APART = re.compile(r"(?m)^[ \t]*(?:@unpack\s+[^\n]{1,200}|\(\s*;[^()\n]{1,200}\)\s*=\s*\w+)[ \t]*$")
BESIDE = re.compile(r"(?<![\w.])(?P<n>[0-9]+(?:\.[0-9]+)?)(?=[^\W\d_]|\()(?![eE][-+]?[0-9])")
MARKED = re.compile("(?P<x>[A-Za-zα-ωΑ-Ωϕ])(?P<index>[₀-₉0-9]*)(?P<dots>[\u0307\u0308]+)(?P<behind>[₀-₉0-9]*)")
ONE_LINE = re.compile(
    r"(?m)^[ \t]*(?P<name>[A-Za-z_]\w*)!?\((?P<of>[^()\n]*)\)\s*=(?!=)\s*(?P<body>[^\n]+(?:\n[ \t]+[^\n]+)*)$"
)
PICKED = re.compile(r"(?P<x>[^\W\d]\w*)\[\s*\[(?P<of>\s*\d(?:\s*,\s*\d)*)\s*\]\s*\]")  # x[SA[1, 2]]
BEGINS = re.compile(
    r"^\s*(?:(?:Base\.)?@\w+\s+)*(?P<of>function|if|for|while|let|begin|struct|mutable\s+struct|abstract\s+type|module|quote|try|macro)\b(?P<rest>.*)$"
)


def from_julia(text: str) -> Program | None:
    """A program of Julia; None for any other, and for equations of ModelingToolkit."""
    if not HEAD.search(text) or not re.search(r"\bend\b", text) or NOT_JULIA.search(text) or "~" in text:
        return None
    if re.search(r"(?m)^\s*function\s+(?:\[[^\]]*\]|\w+)\s*=", text):
        return None  # MATLAB
    text = STATIC.sub("", REMARK.sub("", normalize("NFD", text)))
    text = re.sub(r"\bview\s*\(\s*(\w+)\s*,\s*([^()]+)\)", r"\1[\2]", TYPE.sub("", text))
    text = MACRO.sub("", APART.sub("", text))
    text = SINCOS.sub(lambda m: f"{m['blank']}{m['s']} = sin({m['of']})\n{m['blank']}{m['c']} = cos({m['of']})", text)
    text = MARKED.sub(lambda m: f"{m['x']}{'d' * len(m['dots'])}ot{m['index']}{m['behind']}", text).translate(FIGURES)
    text = BESIDE.sub(lambda m: m["n"] + "*", text)
    text = re.sub(r"(?<=[\w)\]\s])\.(?=[-+*/^=])", "", re.sub(r"\b(vcat|hcat)\s*\(", r"\1(", text))
    text = PICKED.sub(lambda m: "[" + ", ".join(f"{m['x']}[{k}]" for k in re.findall(r"\d", m["of"])) + "]", text)
    text = re.sub(r"\[\s*:\s*\]", "", text).replace("\\", "⧵")
    text = _lists(text)
    no_leading_signs(text)
    return replace(from_braces(_braced(text), by_lines=True), first=1, whole=False, powers=("^",))


def _braced(text: str) -> str:
    """Blocks in braces in place of words; functions of one line as others."""
    text = ONE_LINE.sub(lambda m: f"function {m['name']}({m['of']})\nreturn {m['body']}\nend", text)
    text = re.sub(r"(?m)^(\s*\w+\s*=\s*\([^()\n]*\))\s*->", r"\1 =>", text)
    made: list[str] = []
    depth = 0
    for line in text.split("\n"):
        found = BEGINS.match(line) if depth <= 0 else None
        if found:
            word, rest = found["of"].split()[-1], found["rest"].strip()
            closed = re.search(r"\bend\s*$", rest)
            if word == "function":
                head = rest.replace("!", "", 1) if "!" in rest.partition("(")[0] else rest
                at = head.find("(")
                end = closing(head, at)
                inside, body = head[: end + 1].replace(";", ","), head[end + 1 :]
                made.append(f"function {inside} {{\n{body.removesuffix('end') if closed else body}")
            else:
                made.append(
                    f"{'if' if word in ('quote', 'try', 'macro') else word if word != 'let' else ''} {rest if word in ('struct', 'module', 'if', 'for', 'while') and not closed else ''} {{"
                )
            made += ["}"] if closed else []
            continue
        if re.fullmatch(r"\s*(?:end|else|elseif\b.*)\s*", line) and depth <= 0:
            made.append("}" if "else" not in line else "} else {")
            continue
        depth += sum((c in "([{") - (c in ")]}") for c in line)
        made.append(line)
    return "\n".join(made)


def _lists(text: str) -> str:
    """[a b; c d] as [[a, b], [c, d]], [a; b] as [a, b]; blanks between entries as commas."""
    at = 0
    for _ in range(200):
        found = re.compile(r"(?<![\w)\]])\[|(?<=return)\[").search(text, at)
        end = closing(text, found.end() - 1) if found else -1
        if found is None or end < 0:
            return text
        inner = text[found.end() : end]
        at = found.end()
        if len(parts_of(inner, ",")) > 1 and not re.search(r";", inner):
            continue
        rows = [row for part in parts_of(inner, ";") for row in _rows(part)]
        entries = [_entries(row) for row in rows if row]
        if len({len(row) for row in entries}) > 1:
            raise InvalidInput(
                f"[{inner.strip()[:30]}…]: rows of different lengths; put commas or semicolons between all entries"
            )
        if not entries or (len(entries) == 1 and len(entries[0]) == 1):
            continue
        flat = ", ".join(row[0] for row in entries) if len(entries[0]) == 1 else ""
        made = flat or (", ".join("[" + ", ".join(row) + "]" for row in entries))
        text = f"{text[: found.start()]}[{made}]{text[end + 1 :]}"
    return text


def _rows(part: str) -> list[str]:
    """The rows of a matrix over several lines."""
    rows: list[str] = []
    depth = 0
    for line in part.split("\n"):
        if rows and depth > 0:
            rows[-1] += " " + line.strip()
        elif line.strip():
            rows.append(line.strip())
        depth = sum((c in "([{") - (c in ")]}") for c in rows[-1]) if rows else 0
    return rows


def _entries(row: str) -> list[str]:
    """The entries of a row: a blank ends one, unless a sign with blanks on both sides, or none, goes on."""
    if "," in row:
        return [part for part in parts_of(row, ",") if part]
    made: list[str] = []
    depth, start, at = 0, 0, 0
    while at < len(row):
        c = row[at]
        depth += (c in "([{") - (c in ")]}")
        if c.isspace() and depth == 0 and row[start:at].strip():
            rest = row[at:].lstrip()
            before = row[start:at].rstrip()
            binary = re.match(r"[*/^⧵]|[-+](?=\s)", rest) or re.search(r"[-+*/^⧵]$", before)
            if rest and not binary:
                made.append(before.strip())
                start = at
        at += 1
    return [*made, row[start:].strip()] if row[start:].strip() else made
