"""A text as it stands: what it states, and which cells of a notebook do."""

from __future__ import annotations

import json
import re
from typing import Any

from ....models.errors import InvalidInput
from .marked_up import from_code, without_underlines

ACCELERATION = re.compile(r"\\ddot|''|″|[¨\u0308]|dd|def |return")
LAGRANGIAN = re.compile(r"(?<![A-Za-z])(?:L|\\math(?:cal|scr)\s*\{?\s*L\}?)\s*&?=")
FORMULA = re.compile(r"\$|\\begin\{|\\\[")
FUNCTION = re.compile(r"\b(?:def|function|fn|lambda|return|=>|->)\b|=>|@\s*\(")
# What a program's language sets a remark apart with, by how its file's name ends
REMARK = {
    ".py": re.compile(r'"""(?P<a>.*?)"""|#[ \t]?(?P<b>[^\n]*)', re.DOTALL),
    ".jl": re.compile(r'"""(?P<a>.*?)"""|#=(?P<c>.*?)=#|#[ \t]?(?P<b>[^\n]*)', re.DOTALL),
    ".m": re.compile(r"%\{(?P<a>.*?)%\}|%+[ \t]?(?P<b>[^\n]*)", re.DOTALL),
} | dict.fromkeys(
    (".c", ".cpp", ".h", ".hpp", ".js", ".ts", ".java", ".cs", ".rs", ".go", ".kt"),
    re.compile(r"/\*+(?P<a>.*?)\*/|//+[!/]?[ \t]?(?P<b>[^\n]*)", re.DOTALL),
)  # fmt: skip


def fields_of_text(text: str, suffix: str) -> dict[str, Any]:
    """A derivation's fields of the whole text of a file whose name ends in ``suffix``.

    It is equations of motion, unless it has a Lagrangian and no acceleration.
    """
    text = text_of_notebook(text) if suffix.lower() == ".ipynb" else text_of_remarks(text, suffix.lower())
    text = text if suffix.lower() in (*REMARK, ".tex") else from_code(without_underlines(text))
    alone = LAGRANGIAN.search(text) and not ACCELERATION.search(text)
    return {"lagrangian" if alone else "equations": text}


def text_of_remarks(text: str, suffix: str) -> str:
    """The remarks of a program that states its equations in these alone; any other text as it stands."""
    remark = REMARK.get(suffix)
    if remark is None:
        return text
    code = remark.sub(" ", text)
    if FUNCTION.search(code) or ACCELERATION.search(code):
        return text
    said = "\n".join(next((x for x in m.groups() if x is not None), "") for m in remark.finditer(text))
    return said if "=" in said and (ACCELERATION.search(said) or LAGRANGIAN.search(said)) else text


def text_of_notebook(text: str) -> str:
    """The cells of words, where a formula is in one; else the cells of code. Raises InvalidInput for another file."""
    try:
        notebook = json.loads(text)
        cells = [(str(cell["cell_type"]), _source(cell["source"])) for cell in notebook["cells"]]
    except (ValueError, TypeError, KeyError, RecursionError):
        raise InvalidInput("not a notebook: JSON with cells is needed") from None
    words = [source for kind, source in cells if kind == "markdown"]
    if any(FORMULA.search(source) for source in words):
        return "\n\n".join(words)
    return "\n".join(source for kind, source in cells if kind == "code")


def _source(source: Any) -> str:
    return source if isinstance(source, str) else "".join(map(str, source))
