r"""Shorthand by a rule: c_{ij} = \cos(\theta_i - \theta_j), s_i = \sin\theta_i; each use is defined by it."""

from __future__ import annotations

import re
from typing import Any

from ..names import plain_name
from .every_text import lines_of, rows_of

_BLANK = r"(?:\s|\\[,;:! ]|\\q?quad(?![A-Za-z])|~)*"
_INDEX = r"_\s*(?:\{\s*(?P<ij>[i-n](?:\s*,?\s*[i-n])?)\s*\}|(?P<i>[i-n]))"
RULE = re.compile(
    rf"(?P<before>[,;.]?{_BLANK}(?:\\(?:text|mbox|textrm)\s*\{{\s*(?:where|with|and|mit|und|où|avec|et)\s*\}}|\b(?:where|with|and|mit|und|où|avec|et)\b)?{_BLANK})"
    rf"(?<![A-Za-z\\])(?P<x>\\?[A-Za-z]{{1,10}})\s*{_INDEX}{_BLANK}(?::=|=|\\equiv|\\coloneqq){_BLANK}"
    rf"(?P<wave>\\?(?:cos|sin)){_BLANK}(?P<of>(?:\\left)?\s*\([^()=]{{1,60}}\)|\\?[A-Za-z]{{1,10}}\s*_\s*[i-n](?![A-Za-z]))"
)
MOST_RULES, MOST_USES = 6, 80


def by_rule(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with a definition for each use of such a shorthand, and without the rule."""
    define, rows = data.get("define", {}), rows_of(data)
    found: dict[tuple[str, int], tuple[str, str, str]] = {}
    made: list[tuple[str, str]] = []
    for label, line in rows:
        text = line
        for match in list(RULE.finditer(line))[:MOST_RULES]:
            letters = re.sub(r"[\s,]", "", match["ij"] or match["i"])
            inner = match["of"].strip()
            used = set(re.findall(r"_\s*\{?\s*([i-n])(?![A-Za-z])", inner))
            if len(set(letters)) != len(letters) or used != set(letters):
                return data  # another index than is counted: what is meant is not certain
            found[match["x"], len(letters)] = (letters, match["wave"], inner)
            text = text.replace(match[0], " ", 1)
        made.append((label, text))
    if not found or not isinstance(define, dict):
        return data
    kept = [
        (label, text) for label, text in made if re.sub(r"[\s.,;]|\\q?quad|\\\\|&|\\(?:begin|end)\{\w+\*?\}", "", text)
    ]
    rest = data | {"equations": dict(kept)}
    taken = {plain_name(str(name)) for name in define}
    new = {name: text for name, text in _uses(rest, found).items() if plain_name(name) not in taken}
    return rest | {"define": {**new, **define}} if new else data


def _uses(data: dict[str, Any], rules: dict[tuple[str, int], tuple[str, str, str]]) -> dict[str, str]:
    new: dict[str, str] = {}
    lines = lines_of(data)
    for (x, _), (letters, wave, inner) in rules.items():
        use = re.compile(
            rf"(?<![A-Za-z\\_]){re.escape(x)}\s*_\s*(?:\{{\s*(?P<ij>[1-9](?:\s*,?\s*[1-9])?)\s*\}}|(?P<i>[1-9]))"
        )
        for match in (m for line in lines for m in use.finditer(line)):
            figures = re.sub(r"[\s,]", "", match["ij"] or match["i"])
            if len(figures) != len(letters) or len(new) > MOST_USES:
                continue
            value = inner
            for letter, figure in zip(letters, figures, strict=True):
                value = re.sub(rf"_\s*(?:\{{\s*{letter}\s*\}}|{letter}(?![A-Za-z]))", f"_{{{figure}}}", value)
            new[f"{x}_{{{figures}}}"] = f"{wave}{value}" if value[:1] in "(\\" else f"{wave}({value})"
    return new
