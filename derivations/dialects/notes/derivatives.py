r"""Derivatives by time of whatever a note has names for: d²z/dt², \frac{d}{dt}\omega_1, d²/dt²(x + l sin θ), θ"."""

from __future__ import annotations

import re

from .letters import NAME

_D = r"(?:\\mathrm\s*\{\s*d\s*\}|\\mathrm\s*d|\{\s*\\rm\s+d\s*\}|\\text\s*\{\s*d\s*\}|\\operatorname\s*\{\s*d\s*\}|d)"
_TWO = r"(?:\^\s*\{\s*2\s*\}|\^\s*2|²|\^2)"
_T = r"\{?\s*t\s*\}?"
_X = rf"(?:\{{\s*)?(?P<x>{NAME})(?:\s*\}})?(?:\s*\(\s*t\s*\))?"
_OVER = rf"\\[dtc]?frac\s*\{{\s*{_D}\s*(?P<two>{_TWO})?\s*"
_BELOW = rf"\s*\}}\s*\{{\s*{_D}\s*{_T}\s*{_TWO}?\s*\}}"
WHOLE = re.compile(rf"{_OVER}{_X}{_BELOW}")
BEHIND = re.compile(rf"{_OVER}{_BELOW}\s*(?:\{{\s*(?P<y>{NAME})\s*\}}|(?P<x>{NAME}))(?:\s*\(\s*t\s*\))?(?![\w^(])")
IN_LINE = re.compile(
    rf"(?<![A-Za-z\\]){_D}(?P<two>{_TWO})?\s*(?P<x>{NAME})\s*(?:\(t\))?\s*/\s*{_D}\s*t\s*{_TWO}?(?![A-Za-z])"
)
TWICE = re.compile(
    rf"\\[dtc]?frac\s*\{{\s*{_D}\s*{_TWO}\s*\}}\s*\{{\s*{_D}\s*{_T}\s*{_TWO}\s*\}}|(?<![A-Za-z\\])d\s*{_TWO}\s*/\s*dt\s*{_TWO}"
)
# \\dot{x}_2, whose index stands outside of the braces
DOT_APART = re.compile(
    r"\\(?P<dots>d?dot)\s*(?:\{\s*(?P<x>\\?[A-Za-z]{1,8})\s*\}|(?P<y>\\[A-Za-z]+(?![A-Za-z])|(?<=\s)[A-Za-z](?![A-Za-z])))\s*(?P<i>_\s*(?:\{\s*\w{1,6}\s*\}|\w))"
)
FUNCTIONS = re.compile(r"\\?(?:sin|cos|tan|dot|ddot|frac|left|big)")
OPENS = re.compile(r"\s*(?:\\(?:left|[bB]igg?l?)\s*)?[(\[{]")
SECOND = re.compile(
    r"(?P<x>(?:[θϑφϕψα]|(?<![A-Za-z\\\"])(?:theta|phi|psi|[A-Za-z]))(?:_?[0-9]|[₀-₉]|_\{\w\})?)\s?(?:\"|''|”|″)"
)


def plain_derivatives(text: str) -> str:
    r"""The text with dots in place of these, or d/dt of a bracket; what is neither stays."""
    text = DOT_APART.sub(lambda m: f"\\{m['dots']}{{{(m['x'] or m['y']).strip()}{m['i'].strip()}}}", text)
    text = WHOLE.sub(_dotted, text)
    text = BEHIND.sub(_dotted, text)
    text = IN_LINE.sub(_dotted, text)
    text = _twice(text)
    return SECOND.sub(lambda m: f"{m['x']}''", text) if re.search(r"[\"”″]", text) else text


def _dotted(found: re.Match[str]) -> str:
    groups = found.groupdict()
    name = (groups.get("x") or groups.get("y") or "").strip()
    if FUNCTIONS.match(name) or name in ("t", "d"):
        return found[0]
    dots = "ddot" if groups.get("two") else "dot"
    return f"\\{dots}{{{name}}} " if "\\" in found.string else f"{name}{chr(39) * (2 if dots == 'ddot' else 1)} "


def _twice(text: str) -> str:
    """d²/dt²(…) as d/dt(d/dt(…))."""
    for _ in range(40):
        found = TWICE.search(text)
        opened = OPENS.match(text, found.end()) if found else None
        end = _closing(text, opened.end() - 1) if opened else -1
        if found is None or opened is None or end < 0:
            return text
        inner = text[opened.end() : end]
        inner = re.sub(r"\\(?:right|[bB]igg?r?)\s*$", "", inner)
        once = "\\frac{d}{dt}" if "\\" in found[0] else "d/dt"
        text = f"{text[: found.start()]}{once}({once}({inner})){text[end + 1 :]}"
    return text


def _closing(text: str, opened: int) -> int:
    depth = 0
    for at in range(opened, len(text)):
        depth += (text[at] in "([{") - (text[at] in ")]}")
        if depth == 0:
            return at
    return -1
