r"""m_32l_2 as LaTeX prints it, m₃2l₂: one figure is an index, the next a factor, where no other name can be meant."""

from __future__ import annotations

import re
from collections.abc import Sequence

from .columns import SIGN
from .displays import ROW_END, Statement
from .letters import Names, alone, unfonted, uses

RUN = re.compile(r"(?<![A-Za-z\\])(?P<x>[A-Za-z]|\\[a-z]+)_(?P<index>[0-9])(?P<factor>[0-9])(?=[A-Za-z\\(])")

# p^2_{\\theta_1}, whose power stands before its index
POWER_FIRST = re.compile(
    r"(?P<power>\^\s*(?:\{\s*\d\s*\}|\d))\s*(?P<index>_\s*(?:\{(?:[^{}]|\{[^{}]*\}){1,24}\}|[0-9A-Za-z](?![0-9A-Za-z])))"
)


WHOLE = re.compile(
    r"^\s*\\begin\s*\{[pbB]?(?:small)?matrix\}(?P<inner>.*)\\end\s*\{[pbB]?(?:small)?matrix\}\s*$", re.DOTALL
)


def with_transposes(statements: Sequence[Statement], names: Names) -> list[Statement]:
    r"""The statements with a matrix turned for S^\top, where S = … says what it is."""
    made = list(statements)
    for sides in statements:
        name = alone(sides[0]) if len(sides) == 2 else None
        found = WHOLE.match(sides[1]) if name and len(name) == 1 and name not in names.all else None
        rows = [row.split("&") for row in ROW_END.split(found["inner"]) if row.strip()] if found else []
        if not rows or "\\begin" in (found["inner"] if found else "") or len({len(row) for row in rows}) != 1:
            continue
        use = re.compile(rf"(?<![A-Za-z\\]){name}{SIGN}")
        if not any(use.search(unfonted(side)) for other in made for side in other):
            continue
        turned = " \\\\ ".join(" & ".join(column) for column in zip(*rows, strict=True))
        literal = f" \\begin{{bmatrix}} {turned} \\end{{bmatrix}} "
        made = [tuple(use.sub(lambda _, x=literal: x, unfonted(side)) for side in other) for other in made]  # type: ignore[misc]
        others = [side for other in made if alone(other[0]) != name for side in other]
        made = made if uses(str(name), others) else [other for other in made if alone(other[0]) != name]
    return made


def index_first(text: str) -> str:
    """The text with indices before powers."""
    return POWER_FIRST.sub(lambda m: f"{m['index']}{m['power']}", text)


def apart(text: str, names: Names) -> str:
    """The text with a sign before such a factor: m_3 is a declared quantity, and no quantity has two figures."""
    if "\\" not in text:
        return text

    def one(found: re.Match[str]) -> str:
        letter = found["x"].removeprefix("\\")
        others = any(re.fullmatch(rf"{letter}[0-9]{{2}}", name) for name in names.all)
        if others or letter + found["index"] not in names.quantities:
            return found[0]
        return f"{found['x']}_{found['index']} \\cdot {found['factor']} "

    return RUN.sub(one, text)
