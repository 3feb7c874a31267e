# ruff: noqa: E501 -- patterns stand on one line
r"""Chains: A \Leftrightarrow B states its rows twice; q̇ = ∂H/∂p = … names what the right side is."""

from __future__ import annotations

import re
from typing import Any

from ..letters.every_text import rows_of

_GAP = r"(?:\s|\\[,;:! ]|\\q?quad(?![A-Za-z])|~)*"
ARROWS = re.compile(
    rf"{_GAP}(?:\\(?:Longl|L|l)eftrightarrow|\\iff|\\(?:Longr|R)ightarrow|\\implies|⇔|⇒|⟺|⟹)(?![A-Za-z]){_GAP}"
)
_P = r"(?:\\partial|∂)"
_DOT = r"\\dot\s*(?:\{\s*(?P<x>\\?[A-Za-z]+)\s*(?P<xi>_\s*\{?\s*\w+\s*\}?)?\s*\}|(?P<y>\\?[A-Za-z]+))\s*(?P<i>_\s*(?:\{[^{}]{1,16}\}|\w))?"
HAMILTON = re.compile(
    rf"(?P<left>{_DOT}){_GAP}&?{_GAP}={_GAP}&?{_GAP}(?P<sign>[-−+])?{_GAP}\\[dt]?frac\s*\{{\s*{_P}\s*\\?(?:mathcal\s*)?\{{?\s*H\s*\}}?\s*\}}"
    rf"\s*\{{\s*{_P}\s*(?P<of>\\?[A-Za-z]+)\s*(?P<oi>_\s*(?:\{{[^{{}}]{{1,16}}\}}|\w))?\s*\}}{_GAP}&?{_GAP}="
)


def hamiltons_signs(text: str) -> str:
    r"""\dot q = ∂H/∂p = … without its middle, where that is Hamilton's equation for this letter; else as it is."""

    def one(found: re.Match[str]) -> str:
        letter = (found["x"] or found["y"]).replace("\\", "")
        of = found["of"].replace("\\", "")
        index, other = (re.sub(r"[_{}\s]", "", found[a] or "") for a in ("i", "oi"))
        index = index or re.sub(r"[_{}\s]", "", found["xi"] or "")
        is_momentum, minus = letter in ("p", "P"), found["sign"] in ("-", "−")
        same = other in (index, f"\\{letter}{index}") or index == f"\\{of}{other}"  # p_{\\theta_1}
        right = is_momentum == minus and (of in ("p", "P")) != is_momentum and same
        return f"{found['left']} =" if right else found[0]

    return HAMILTON.sub(one, text)


def two_statements(data: dict[str, Any], count: int) -> dict[str, Any]:
    """``A ⇔ B`` for one coordinate: A as its equation, and B as the stage after it; both are judged."""
    rows = rows_of(data)
    if count != 1 or len(rows) != 1 or "solved" in data:
        return data
    label, text = rows[0]
    text = re.sub(
        r"\\(?:boxed|fbox)\s*\{(?P<x>(?:[^{}]|\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\})*)\}", r" \g<x> ", text
    )
    parts = ARROWS.split(text)
    if len(parts) != 2 or any(part.count("=") != 1 for part in parts):
        return data
    return data | {"equations": {label: parts[0]}, "solved": {label: parts[1]}}
