# ruff: noqa: E501 -- patterns stand on one line
"""What Julia's functions say besides: @inline, sincos, named tuples taken apart, du .= …, SVector, 2x, ω̇₁."""

from __future__ import annotations

import re

from ..names import FIGURES

JULIA = re.compile(r"(?m)^\s*(?:@\w+\s+)*function\s+[\w!]+\s*\(.*?\)\s*$|^\s*@\w+\s+function\b")
MACRO = re.compile(r"(?<![\w])@(?:inline|inbounds|views|fastmath|muladd|simd|noinline)\s+")
TAKEN_APART = re.compile(r"(?m)^[ \t]*\(\s*;[^()\n]{1,200}\)\s*=\s*\w+[ \t]*$|^[ \t]*@unpack\s[^\n]{1,200}$")
SINCOS = re.compile(
    r"(?m)^(?P<blank>[ \t]*)(?P<s>[^\s,=]{1,20})\s*,\s*(?P<c>[^\s,=]{1,20})\s*=\s*sincos\s*\((?P<of>[^\n]{1,200})\)[ \t]*$"
)
NOTHING = re.compile(r"(?m)^[ \t]*(?:return\s+)?nothing[ \t]*;?[ \t]*$")
WHOLE = re.compile(
    r"(?m)^(?P<blank>[ \t]*)(?P<name>\w{1,20})\s*(?:\.=|\[\s*:\s*\]\s*\.?=)\s*(?P<value>[(\[][^\n]{1,2000}[)\]])[ \t]*$"
)
VECTOR = re.compile(r"@?(?:S|M)Vector(?:\{[^{}\n]{0,30}\})?\s*(?P<open>[(\[])|@?SA(?:\[|\{[^{}]{0,20}\}\[)")
BESIDE = re.compile(r"(?<![\w.])(?P<n>[0-9]+(?:\.[0-9]+)?)(?=[A-Za-zα-ωΑ-Ω_(])(?![eE][-+]?[0-9])")
MARKED = re.compile("(?P<x>[A-Za-zα-ωΑ-Ω])(?P<dots>[\u0307\u0308]+)(?P<index>[₀-₉0-9]*)")
HEAD = re.compile(r"(?m)^(?P<front>\s*function\s+\w+)!?\s*\(\s*(?P<out>\w+)\s*,(?P<rest>[^)\n]{1,120}\))")


def plain_julia(text: str) -> str:
    """The function in words that other programs have too; any other text as it is."""
    if not JULIA.search(text):
        return text
    text = re.sub(r"(?<!\w)#[^\n]*", "", MACRO.sub("", text))
    text = NOTHING.sub("", TAKEN_APART.sub("", text))
    text = SINCOS.sub(lambda m: f"{m['blank']}{m['s']} = sin({m['of']})\n{m['blank']}{m['c']} = cos({m['of']})", text)
    text = _without_vectors(text)
    text = MARKED.sub(lambda m: f"rate{len(m['dots'])}{ord(m['x'])}_{m['index'].translate(FIGURES)}", text)
    text = BESIDE.sub(lambda m: m["n"] + "*", text)
    whole, head = WHOLE.search(text), HEAD.search(text)
    if whole and head and whole["name"] == head["out"] and len(WHOLE.findall(text)) == 1:
        rest = text[whole.end() :]
        if rest.strip() == "end" and not re.search(rf"\b{head['out']}\s*\[", text[: whole.start()]):
            text = f"{text[: whole.start()]}{whole['blank']}return [{whole['value'][1:-1]}]{rest}"
            text = HEAD.sub(lambda m: f"{m['front']}({m['rest'].strip()}", text)
    return text


def _without_vectors(text: str) -> str:
    """SVector(a, b) as [a, b]."""
    for _ in range(20):
        found = VECTOR.search(text)
        if found is None:
            return text
        opened = found.end() - 1
        depth = 0
        for at in range(opened, len(text)):
            depth += (text[at] in "([") - (text[at] in ")]")
            if depth == 0:
                text = f"{text[: found.start()]}[{text[opened + 1 : at]}]{text[at + 1 :]}"
                break
        else:
            return text
    return text
