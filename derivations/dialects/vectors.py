r"""Vectors of all coordinates by one letter: \dot{\mathbf q}^T M \dot{\mathbf q}, with q = (q_1, q_2) said or not.

The reader takes a bare \dot q for the column of all rates; its transpose is written out as a row here, and a definition
that says what the column is, is left out where it lists the coordinates in their order.
"""

from __future__ import annotations

import re
from typing import Any

from .names import base_and_index, plain_name

FONT = r"(?:\\(?:mathbf|boldsymbol|bm|vec|mathrm|underline)\s*)?"
TRANSPOSE = r"\s*\^\s*(?:\{?\s*(?:\\(?:mathsf|mathrm|rm|text|sf)\s*\{?\s*)?(?:T|t|\\top|\\intercal)"
TRANSPOSE += r"\s*\}{0,2}(?![A-Za-z])|ᵀ)|\s*ᵀ"
LISTED = re.compile(
    r"\\begin\{[a-zA-Z]*(?:matrix|array)\}(?:\{[clr|]*\})?(?P<matrix>.*?)\\end\{[a-zA-Z]*(?:matrix|array)\}|[(\[](?P<list>[^()\[\]]*)[)\]]",
    re.DOTALL,
)
LETTER = re.compile(rf"^\s*{FONT}\{{?\s*(?P<x>\\?[A-Za-z]+|[θϕφq])\s*\}}?\s*(?:\(t\))?\s*$")


def with_vectors(data: dict[str, Any], count: int) -> dict[str, Any]:
    """The fields with rows in place of transposed columns of rates. ``count``: the coordinates, 0 if not known."""
    define = data.get("define", {})
    energies = [name for name in ("kinetic", "lagrangian") if isinstance(data.get(name), str)]
    if not isinstance(define, dict) or not energies or not 2 <= count <= 8:
        return data
    made, kept = dict(data), dict(define)
    letters = ["q", "\\theta", "θ"]
    for name, line in define.items():
        letter = LETTER.match(str(name)[:40])
        names = _listed(line) if letter and isinstance(line, str) and len(line) < 400 else []
        x = plain_name(letter["x"]) if letter else None
        if (
            x
            and len(names) == count
            and [base_and_index(n) for n in names] == [(x, str(k)) for k in range(1, count + 1)]
        ):
            kept.pop(name)
            letters.append(letter["x"] if letter else "")
    for field in energies:
        for x in dict.fromkeys(letters):
            made[field] = _row(made[field], x, count)
    if "define" in data:
        made["define"] = kept
    return made


def _listed(line: str) -> list[str]:
    """The names in a column or a row."""
    bare = re.sub(rf"(?:{TRANSPOSE})\s*[.,;]?\s*$", "", line.strip())
    found = LISTED.fullmatch(bare.replace("\\left", "").replace("\\right", "").strip())
    if found is None:
        return []
    inner = found["matrix"] if found["matrix"] is not None else found["list"]
    return [part.strip() for part in re.split(r"\\\\|&|,|;", inner) if part.strip()]


def _row(line: str, x: str, count: int) -> str:
    r"""\dot{x}^T as a row of rates, and \dot{\mathbf x} as the reader's \dot x."""
    letter = re.escape(x)
    over = (
        rf"\\dot\s*(?:\{{\s*{FONT}\s*\{{?\s*{letter}\s*\}}?\s*\}}|{FONT}\s*\{{?\s*{letter}(?![A-Za-z_])\s*\}}?)(?!\s*_)"
    )
    row = r"\begin{bmatrix} " + " & ".join(rf"\dot{{{x}}}_{k}" for k in range(1, count + 1)) + r" \end{bmatrix}"
    line = re.sub(rf"{over}(?:{TRANSPOSE})", lambda _: row, line)
    if row in line:
        line = re.sub(over, lambda _: rf"\dot{{{x}}}", line.replace(row, "\0")).replace("\0", row)
    return line
