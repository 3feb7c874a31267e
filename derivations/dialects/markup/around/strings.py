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
    r"^\s*(?:\w{1,20}\s*=\s*)?(?:display|print|Markdown|Math|Latex|Tex|MathTex|st\.(?:latex|markdown|write)|plt\.(?:title|text)|ax\.set_title)?\s*\(*\s*(?P<raw>[rR]|L|raw|md|tex|latex|@R_str)?(?P<q>\"\"\"|\"|')(?P<inner>(?:(?!(?P=q)).)+)(?P=q)\s*\)*\s*;?\s*$",
    re.DOTALL,
)
BESIDE = re.compile(
    r"^\s*(?:[\"']?\w{1,20}[\"']?\s*[:=])?\s*\((?P<inner>(?:\s*[rR]?\"(?:[^\"\\\n]|\\.)*\"){2,40}\s*)\)\s*,?;?\s*$"
)
LITERAL = re.compile(r"\"(?P<of>(?:[^\"\\\n]|\\.)*)\"")
OBJECT = re.compile(r"^\s*\{\s*\"(?:[^\"\\]|\\.)*\"\s*:.*\}\s*,?\s*$", re.DOTALL)
FORMULA_KEY = re.compile(
    r"(?i)^(?:\w{0,12}_?(?:equations?|formulas?|latex|tex|math|eom|odes?|dynamics|source|content)\w{0,4}|[a-z]{1,8}_?[0-9]?)$"
)
WRONG_KEY = re.compile(r"(?i)wrong|incorrect|false|bad|mistake|error|falsch|not")
TICKED = re.compile(r"(?<!`)``(?P<inner>[^`]*[=\\][^`]*)``(?!`)")  # mathematics in Julia's Markdown
# Every backslash twice, as in a string that is not raw
DOUBLED = re.compile(
    r"(?<!\\)\\\\(?:d?dot|frac|dfrac|tfrac|theta|varphi|phi|sin|cos|alpha|left|begin|partial|omega)(?![A-Za-z])"
)
SINGLE = re.compile(r"(?<!\\)\\(?:\\\\)*[A-Za-z]")


def undoubled(text: str) -> str:
    r"""The text with \ddot for \\ddot, where no command has a backslash alone; any other as it is."""
    return text.replace("\\\\", "\\") if DOUBLED.search(text) and not SINGLE.search(text) else text


def _of_object(text: str) -> str:
    """The formulas of an object of JSON, a line each; the text where it is none."""
    try:
        found = json.loads(text.strip().rstrip(","))
    except ValueError:
        return text
    if not isinstance(found, dict) or not all(FORMULA_KEY.match(x) and not WRONG_KEY.search(x) for x in found):
        return text
    values = found.values()
    lines = [x for value in values for x in (value if isinstance(value, list) else [value])]
    return "\n".join(x for x in lines if "=" in x) if all(isinstance(x, str) for x in lines) else text


def from_strings(text: str) -> str:
    """What such strings hold; any other text as it is."""
    text = TICKED.sub(lambda m: f"${m['inner']}$", text)
    beside = BESIDE.match(text)
    if beside and "=" in beside["inner"]:  # strings that a program puts together
        return "".join(m["of"] for m in LITERAL.finditer(beside["inner"]))
    string = PRINTED.match(text)
    if string and "=" in string["inner"]:
        return undoubled(string["inner"]) if not string["raw"] or string["raw"] == "md" else string["inner"]
    if OBJECT.match(text):
        return _of_object(text)
    found = SOURCE.match(text)
    listed = found["list"] if found else f"[{text.strip().rstrip(',')}]" if LISTED.match(text) else None
    if listed is None:
        return text
    try:
        lines = json.loads(listed)
    except ValueError:
        return text
    return "".join(lines) if isinstance(lines, list) and all(isinstance(x, str) for x in lines) else text
