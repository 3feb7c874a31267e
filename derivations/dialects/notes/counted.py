r"""Abbreviations by a rule, \Delta_{ij} = \theta_i - \theta_j: a definition for each use, \Delta_{21}."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ....models.errors import InvalidInput
from ..names import FIGURES
from .displays import Statement

_BLANK = r"(?:\s|\\[,;:! ])*"
RULE = re.compile(
    rf"^\s*(?P<x>\\?[A-Za-z]{{1,10}}|[A-Za-zα-ωΑ-Ω])\s*_\s*(?:\{{\s*(?P<ij>[i-n](?:{_BLANK},?{_BLANK}[i-n])?)\s*\}}|(?P<i>[i-n]))\s*$"
)
COUNTED = r"_\s*\{?\s*(?P<i>[i-n])(?![A-Za-z])"
MOST_USES = 80


def by_rule(statements: Sequence[Statement]) -> list[Statement]:
    """The statements with what a rule says of each figure that is used, in place of the rule."""
    rules = [(sides, found) for sides in statements if len(sides) == 2 and (found := RULE.match(sides[0]))]
    others = [sides for sides in statements if all(sides is not rule for rule, _ in rules)]
    # I_m of which no figure stands anywhere, I_1, is a name
    rules = [(sides, found) for sides, found in rules if any(_use(found).search(x) for other in others for x in other)]
    kept = [sides for sides in statements if all(sides is not rule for rule, _ in rules)]
    new: dict[str, Statement] = {}
    for sides, found in rules:
        letters = re.sub(r"[^i-n]", "", found["ij"] or found["i"])
        counted = set(re.findall(r"_\s*\{?\s*([i-n])(?![A-Za-z])", sides[1]))
        counted |= set(re.findall(r"_\s*\{\s*[i-n]\s*,?\s*([i-n])\s*\}", sides[1]))
        if len(set(letters)) != len(letters) or counted != set(letters) or "\\sum" in sides[1]:
            raise InvalidInput(
                f"{' = '.join(sides).strip()[:50]!r}: a rule with other indices than it counts; write out each"
            )
        use = _use(found)
        for m in (m for other in kept for side in other for m in use.finditer(side)):
            figures = re.sub(r"\D", "", (m["ij"] or m["i"] or m["low"]).translate(FIGURES))
            if len(figures) == len(letters) and len(new) < MOST_USES:
                name = f"{found['x']}_{{{figures}}}"
                new[name] = (name, _put(sides[1], dict(zip(letters, figures, strict=True))))
    said = {re.sub(r"[\s{}]", "", sides[0]) for sides in kept}
    return [*kept, *(sides for name, sides in new.items() if re.sub(r"[\s{}]", "", name) not in said)]


def _use(rule: re.Match[str]) -> re.Pattern[str]:
    """A rule's name with figures."""
    before = r"(?<![A-Za-z\\])" if len(rule["x"]) > 1 or not rule["x"].isascii() else r"(?<!\\)(?<![A-Za-z]{2})"
    return re.compile(
        rf"{before}{re.escape(rule['x'])}\s*(?:_\s*(?:\{{\s*(?P<ij>[1-9](?:\s*,?\s*[1-9])?)\s*\}}|(?P<i>[1-9]))|(?P<low>[₁-₉]{{1,2}}))"
    )


def _put(value: str, figures: dict[str, str]) -> str:
    def one(found: re.Match[str]) -> str:
        letters = re.sub(r"[^i-n]", "", found[0])
        return "_{" + "".join(figures.get(x, x) for x in letters) + "}"

    return re.sub(r"_\s*(?:\{\s*[i-n](?:\s*,?\s*[i-n])?\s*\}|[i-n](?![A-Za-z]))", one, value)
