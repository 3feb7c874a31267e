r"""Lines of text as strings of a notebook's JSON, "source": ["…\n", …], or of a program, r"…": what they hold."""

from __future__ import annotations

import json
import re

SOURCE = re.compile(
    r"^\s*\{?(?:\s*\"\w+\":\s*(?:\"[^\"]*\"|\{[^{}]*\}|null)\s*,)*\s*\"source\":\s*(?P<list>\[.*\])\s*,?\s*\}?\s*,?\s*$",
    re.DOTALL,
)
LISTED = re.compile(r"^\s*\"(?:[^\"\\\n]|\\.)*\"\s*,?\s*(?:\n\s*\"(?:[^\"\\\n]|\\.)*\"\s*,?\s*)+$")
PRINTED = re.compile(
    r"^\s*(?:display|print|Markdown|Math|Latex|Tex|MathTex|st\.(?:latex|markdown|write)|plt\.(?:title|text)|ax\.set_title)?\s*\(*\s*[rR](?P<q>\"|')(?P<inner>(?:(?!(?P=q)).)*\\(?:(?!(?P=q)).)*)(?P=q)\s*\)*\s*;?\s*$",
    re.DOTALL,
)


# Every backslash twice, as in a string that is not raw
DOUBLED = re.compile(
    r"(?<!\\)\\\\(?:d?dot|frac|dfrac|tfrac|theta|varphi|phi|sin|cos|alpha|left|begin|partial|omega)(?![A-Za-z])"
)
SINGLE = re.compile(r"(?<!\\)\\(?:\\\\)*[A-Za-z]")


def undoubled(text: str) -> str:
    r"""The text with \ddot for \\ddot, where no command has a backslash alone; any other as it is."""
    return text.replace("\\\\", "\\") if DOUBLED.search(text) and not SINGLE.search(text) else text


def from_strings(text: str) -> str:
    """What such strings hold; any other text as it is."""
    raw = PRINTED.match(text)
    if raw:
        return raw["inner"]
    found = SOURCE.match(text)
    listed = found["list"] if found else f"[{text.strip().rstrip(',')}]" if LISTED.match(text) else None
    if listed is None:
        return text
    try:
        lines = json.loads(listed)
    except ValueError:
        return text
    return "".join(lines) if isinstance(lines, list) and all(isinstance(x, str) for x in lines) else text
