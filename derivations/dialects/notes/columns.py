# ruff: noqa: E501 -- patterns stand on one line
r"""A letter for the column of all coordinates, \ddot q, \dot{\mathbf q}; and p^\top M^{-1} p of a Hamiltonian."""

from __future__ import annotations

import re
from collections.abc import Sequence
from unicodedata import normalize

from ....models.errors import InvalidInput
from ..names import GREEK, plain_name, spelling
from .displays import Statement
from .letters import Names, alone, spelled, unfonted, used

TRANSPOSED = r"\s*\^\s*(?:\{\s*)?(?:\\(?:top|intercal|mathsf|mathrm|rm|text|sf)\s*)?\{?\s*(?:T|t|⊤)?\s*\}?(?:\s*\})?"
SIGN = r"\s*(?:\^\s*(?:\{\s*)?(?:\\top|\\intercal|\\mathsf\s*\{?\s*T\s*\}?|\\mathrm\s*\{?\s*T\s*\}?|\\text\s*\{\s*T\s*\}|\\rm\s+T|T|⊤)\s*\}?|ᵀ|⊤)(?![A-Za-z])"
LIST = re.compile(
    r"^\s*(?:\\left\s*)?(?:\\begin\s*\{[a-zA-Z]*(?:matrix|array)\}(?:\{[clr|]*\})?(?P<matrix>.*?)\\end\s*\{[a-zA-Z]*(?:matrix|array)\}|[(\[](?P<list>[^()\[\]]*?)(?:\\right\s*)?[)\]])\s*"
    rf"(?:{SIGN})?\s*$",
    re.DOTALL,
)
DOTTED = re.compile("(?<![A-Za-z\\\\])(?P<x>[qxz])(?P<dots>[\u0307\u0308]{1,2})(?![0-9₀-₉_])")
DOUBLE = ("\u0308", "\u0307\u0307")
MATRIX = re.compile(r"\\begin\s*\{[a-zA-Z]*matrix\}")


def listed(side: str) -> list[str]:
    """The plain names in a row or column; none where it has anything else."""
    found = LIST.match(side)
    if found is None:
        return []
    inner = found["matrix"] if found["matrix"] is not None else found["list"]
    names = [plain_name(part.strip()) or "" for part in re.split(r"\\\\|&|,|;|\\quad", inner) if part.strip()]
    return names if all(names) else []


def with_columns(statements: Sequence[Statement], names: Names) -> list[Statement]:
    r"""The statements with columns in place of \ddot q, where q is no coordinate; and without q = (x, θ)."""
    kept: list[Statement] = []
    letters: dict[str, list[str]] = {}
    for sides in statements:
        name = alone(sides[0].replace("^T", "")) if len(sides) == 2 else None
        order = listed(sides[1]) if name else []
        if name and order and sorted(order) == sorted(names.coordinates):
            letters[name] = order
        else:
            kept.append(sides)
    own = {re.sub(r"[0-9]", "", c) for c in names.coordinates}
    said = {name for sides in kept if (name := alone(sides[0]))}
    for letter in ("q", "x", "theta", "xi", "z"):
        if letter in letters or letter in names.all or letter in own:
            continue
        text = unfonted(" ".join(" ".join(sides) for sides in kept if not _of_others(sides, letter, said, names)))
        if _pattern(letter, "ddot").search(text) and len(names.coordinates) > 1:
            letters[letter] = _order(list(names.coordinates), letter, kept, names)
    for letter, order in letters.items():
        kept = [tuple(_put(unfonted(side), letter, order) for side in sides) for sides in kept]
    return kept


def dotted_columns(statements: Sequence[Statement], names: Names) -> list[Statement]:
    r"""The statements with \ddot{q} for q̈, where q is no coordinate."""

    def one(found: re.Match[str]) -> str:
        dots = "ddot" if found["dots"] in DOUBLE else "dot"
        return found[0] if found["x"] in names.all else f"\\{dots}{{{found['x']}}}"

    return [tuple(DOTTED.sub(one, normalize("NFD", side)) for side in sides) for sides in statements]


def _of_others(sides: Statement, letter: str, said: set[str], names: Names) -> bool:
    """Whether an equation has letters besides this one that nobody says, so that nothing can be read of it."""
    return any(x not in names.all and x not in said and x not in (letter, "d", "e", "T") for x in used(" ".join(sides)))


def _order(order: list[str], letter: str, statements: Sequence[Statement], names: Names) -> list[str]:
    """The order of the bodies, where the mass matrix bears it out. Raises InvalidInput where it does not."""
    if len(set(names.slides)) == 1:
        return order
    entries = _diagonal(statements)
    if len(entries) != len(order):
        raise InvalidInput(
            f"{letter} stands for all coordinates: in which order? Write {letter} = ({', '.join(order)})^T before"
        )
    lengths = {q for q in names.quantities if re.match(r"(?:l|L|r|R|a|d|I|J|ell)", q)}
    for entry, is_slide in zip(entries, names.slides, strict=True):
        has_length = any(spelling(q).search(entry) for q in lengths)
        if has_length == is_slide:
            raise InvalidInput(
                f"{letter} stands for all coordinates: in which order? Write {letter} = ({', '.join(order)})^T before"
            )
    return order


def _diagonal(statements: Sequence[Statement]) -> list[str]:
    """The diagonal of the matrix that is called M, or B, D or H of robotics."""
    for sides in statements:
        if (alone(sides[0]) or "").removesuffix("9") in ("M", "D", "H", "B", "A"):
            matrix = re.search(
                r"\\begin\s*\{[a-zA-Z]*(?:matrix|array)\}(?:\{[clr|]*\})?(.*?)\\end", sides[-1], re.DOTALL
            )
            rows = [row.split("&") for row in re.split(r"\\\\", matrix[1]) if row.strip()] if matrix else []
            if rows and all(len(row) == len(rows) for row in rows) and len(rows) > 1:
                return [row[k] for k, row in enumerate(rows)]
    said = {name: sides[-1] for sides in statements if (name := alone(sides[0])) and len(sides) > 1}
    for letter in "MDHBA":  # or entry by entry, M_{11} = …
        found = [said[f"{letter}{k}{k}"] for k in range(1, 10) if f"{letter}{k}{k}" in said]
        if len(found) > 1:
            return found
    return []


def _pattern(letter: str, dots: str) -> re.Pattern[str]:
    x = rf"\\?{letter}" if letter in GREEK else letter
    return re.compile(rf"\\{dots}\s*(?:\{{\s*{x}\s*\}}|{x}(?![A-Za-z]))(?!\s*_|\^)")


def _put(side: str, letter: str, order: list[str]) -> str:
    for dots in ("ddot", "dot"):
        column = " \\begin{bmatrix} " + " \\\\ ".join(f"\\{dots}{{{spelled(c)}}}" for c in order) + " \\end{bmatrix} "
        side = _pattern(letter, dots).sub(lambda _, column=column: column, side)  # type: ignore[misc]
    x = rf"\\?{letter}" if letter in GREEK else letter
    # (q, \dot q), before and behind the change above
    inner = rf"(?:{x}|\\begin\{{bmatrix\}}[^()]*?\\end\{{bmatrix\}})"
    return re.sub(rf"(?<=[A-Za-z}}])\s*\(\s*{inner}\s*(?:,\s*{inner}\s*){{0,2}}\)", " ", side)


def with_momenta(text: str, names: Names) -> str:
    r"""p^\top … p of a Hamiltonian, as a row and a column of momenta."""
    found = re.search(
        rf"(?<![A-Za-z\\])(?:\\(?:mathbf|boldsymbol|bm|vec)\s*\{{?\s*)?(?P<p>[pP])\s*\}}?(?:{SIGN})", text
    )
    if found is None or len(names.coordinates) < 2:
        return text
    p = found["p"]
    entries = [f"{p}_{{{_momentum_index(c, names.coordinates)}}}" for c in names.coordinates]
    text = unfonted(text)
    text = re.sub(r"(\^\s*\{\s*-\s*1\s*\})\s*\(\s*q\s*\)", r"\1 ", text)
    text = re.sub(
        rf"(?<![A-Za-z\\]){p}(?:{SIGN})",
        lambda _: " \\begin{bmatrix} " + " & ".join(entries) + " \\end{bmatrix} ",
        text,
    )
    return re.sub(
        rf"(?<![A-Za-z\\]){p}(?![A-Za-z])(?!\s*[_^(,)])(?=\s*(?:$|[+\-−,.=]|\\))",
        lambda _: " \\begin{bmatrix} " + " \\\\ ".join(entries) + " \\end{bmatrix} ",
        text,
    )


def _momentum_index(coordinate: str, coordinates: Sequence[str]) -> str:
    figures = re.search(r"[0-9]+$", coordinate)
    return figures[0] if figures and all(re.search(r"[0-9]+$", c) for c in coordinates) else spelled(coordinate)
