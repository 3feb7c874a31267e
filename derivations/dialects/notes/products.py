r"""m_32l_2 as LaTeX prints it, m₃2l₂: one figure is an index, the next a factor, where no other name can be meant."""

from __future__ import annotations

import re

from .letters import Names

RUN = re.compile(r"(?<![A-Za-z\\])(?P<x>[A-Za-z]|\\[a-z]+)_(?P<index>[0-9])(?P<factor>[0-9])(?=[A-Za-z\\(])")

# p^2_{\\theta_1}, whose power stands before its index
POWER_FIRST = re.compile(
    r"(?P<power>\^\s*(?:\{\s*\d\s*\}|\d))\s*(?P<index>_\s*(?:\{(?:[^{}]|\{[^{}]*\}){1,24}\}|[0-9A-Za-z](?![0-9A-Za-z])))"
)


def index_first(text: str) -> str:
    """The text with indices before powers."""
    return POWER_FIRST.sub(lambda m: f"{m['index']}{m['power']}", text)


def apart(text: str, names: Names) -> str:
    """The text with a blank before such a factor: m_3 is a declared quantity, and no quantity has two figures."""
    if "\\" not in text:
        return text

    def one(found: re.Match[str]) -> str:
        letter = found["x"].removeprefix("\\")
        others = any(re.fullmatch(rf"{letter}[0-9]{{2}}", name) for name in names.all)
        if others or letter + found["index"] not in names.quantities:
            return found[0]
        return f"{found['x']}_{found['index']} {found['factor']} "

    return RUN.sub(one, text)
