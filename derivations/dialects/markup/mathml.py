"""Presentation MathML, by the standard library's parser: no document type, no entities, known elements alone."""

from __future__ import annotations

import html
import re
import xml.etree.ElementTree as Tree

from ....models.errors import InvalidInput

BLOCK = re.compile(r"<(?:\w+:)?math\b.*?</(?:\w+:)?math\s*>", re.DOTALL)
NAMED = re.compile(r"&(?!(?:lt|gt|amp|quot|apos);)[A-Za-z]{2,32};")
BETWEEN = re.compile(r"(?:\s|[,;.]|\band\b|\bund\b|\bet\b|</?(?:p|div|br)\s*/?>)*")
SIGNS = {"\u2062": " ", "\u2061": " ", "\u2064": " ", "⋅": "*", "·": "*", "×": "*", "∗": "*", "−": "-", "–": "-",
         "′": "'", "″": "''", "\u2009": " ", ",": " , ", ";": " ; "}  # fmt: skip
DOTS = {"˙": "'", "\u0307": "'", ".": "'", "¨": "''", "\u0308": "''", "..": "''", "⋅": "'", "∙": "'"}
LEAVES = re.compile(r"[\w\s.+\-*/=()\[\]',;∂∑∫≈|]{0,40}")
DEEPEST, MOST_ELEMENTS, MOST_BLOCKS = 40, 3000, 200
HINT = "give the rows as plain text or LaTeX"


def from_mathml(text: str) -> str:
    """The formulas of a text with MathML, a row a line; any other text as it is."""
    if text.count("math") > MOST_BLOCKS:
        return text
    blocks = list(BLOCK.finditer(text))
    if not blocks:
        return text
    if re.search(r"<!\s*(?:DOCTYPE|ENTITY)|<\?|<!\[CDATA", text, re.IGNORECASE):
        raise InvalidInput("MathML without a document type, entities of its own or instructions is read")
    outside = [
        text[a:b]
        for a, b in zip([0, *(m.end() for m in blocks)], [*(m.start() for m in blocks), len(text)], strict=True)
    ]
    if not all(BETWEEN.fullmatch(part) for part in outside):
        raise InvalidInput(f"words between <math> and <math>: give each row's formula alone, or {HINT}")
    return "\n".join(_formula(m[0]) for m in blocks)


def _formula(block: str) -> str:
    try:
        root = Tree.fromstring(NAMED.sub(lambda m: html.unescape(m[0]), block))
    except (Tree.ParseError, ValueError, RecursionError):
        raise InvalidInput(f"this MathML is not well-formed; {HINT}") from None
    if sum(1 for _ in root.iter()) > MOST_ELEMENTS:
        raise InvalidInput(f"more than {MOST_ELEMENTS} elements of MathML; {HINT}")
    return re.sub(r" {2,}", " ", _text(root, 0)).strip()


def _kind(element: Tree.Element) -> str:
    return element.tag.rpartition("}")[2]


def _children(element: Tree.Element, count: int) -> list[Tree.Element]:
    children = list(element)
    if len(children) != count:
        raise InvalidInput(f"<{_kind(element)[:20]}> of MathML with {len(children)} parts; {HINT}")
    return children


def _text(element: Tree.Element, depth: int) -> str:  # noqa: PLR0911, PLR0912 -- one for each element
    kind = _kind(element)
    if depth > DEEPEST:
        raise InvalidInput(f"more than {DEEPEST} elements of MathML in one another; {HINT}")
    match kind:
        case "math" | "mrow" | "mstyle":
            return _row(element, depth)
        case "semantics":
            return _text(next(iter(element), element), depth + 1) if len(element) else ""
        case "mi" | "mn" | "mo":
            return _leaf(element)
        case "mspace":
            return " "
        case "mtext":
            if (element.text or "").strip() in ("", ",", ".", ";"):
                return " "
        case "mfrac":
            return _fraction(element, depth)
        case "msqrt":
            return f" sqrt({_row(element, depth)}) "
        case "msub" | "msup" | "msubsup" | "mover":
            base, index, primes, power = _scripted(element, depth)
            return f" {base}{index}{primes}{power} "
        case "mfenced":
            opened, closed = element.get("open", "("), element.get("close", ")")
            if (opened, closed) in (("(", ")"), ("[", "]")) and len(element) == 1:
                return f" {opened}{_row(element, depth)}{closed} "
        case "mtable":
            return "\n".join(_cells(row, depth) for row in element)
    raise InvalidInput(f"<{kind[:20]}> of MathML is not read here; {HINT}")


def _row(element: Tree.Element, depth: int) -> str:
    """The parts side by side; a table in brackets is a matrix."""
    children = list(element)
    if len(children) > 1 and any(_kind(c) == "mtable" for c in children):
        opened = [(c.text or "").strip() for c in children if _kind(c) == "mo"]
        if opened not in (["{"], ["{", ""]):
            raise InvalidInput(f"a table in brackets, or beside other parts, of MathML: is it a matrix? {HINT}")
        children = [c for c in children if _kind(c) == "mtable"]
    return "".join(_text(child, depth + 1) for child in children)


def _cells(row: Tree.Element, depth: int) -> str:
    if _kind(row) != "mtr" or any(_kind(cell) != "mtd" for cell in row):
        raise InvalidInput(f"a table of MathML with other parts than rows and cells; {HINT}")
    return " ".join(_row(cell, depth + 2) for cell in row)


def _leaf(element: Tree.Element) -> str:
    text = (element.text or "").strip()
    text = "".join(SIGNS.get(c, c) for c in text) or " "
    if len(element) or not LEAVES.fullmatch(text):
        raise InvalidInput(f"{text[:10]!r} in <{_kind(element)}> of MathML; {HINT}")
    if _kind(element) == "mi" and len(text) > 1 and text.isalpha():
        return f" {text} "
    return text if _kind(element) == "mo" else f" {text} "


def _fraction(element: Tree.Element, depth: int) -> str:
    if element.get("linethickness", "1") in ("0", "0pt", "0px"):
        raise InvalidInput(f"a fraction without a line; {HINT}")
    above, below = (_text(child, depth + 1).strip() for child in _children(element, 2))
    top = re.fullmatch(r"(?:d|∂)\s*(?P<two>\^2)?\s+(?P<x>\S{1,20})", above)
    bottom = re.fullmatch(r"(?:d|∂)\s*t\s*(?P<two>\^2)?", below)
    if top and bottom and bool(top["two"]) == bool(bottom["two"]) and "'" not in top["x"]:
        return f" {top['x']}{chr(39) * (2 if top['two'] else 1)} "
    if re.match(r"[d∂]\s", above) or re.match(r"[d∂]\s*t\b", below):
        raise InvalidInput(f"this derivative, {above[:20]} over {below[:20]}, is not read; write \\dot or primes")
    return f" (({above})/({below})) "


Scripted = tuple[str, str, str, str]  # base, index, primes, power


def _scripted(element: Tree.Element, depth: int) -> Scripted:
    """A letter with index, dots and power, in whatever order they are put on."""
    kind = _kind(element)
    first, *others = _children(element, 3 if kind == "msubsup" else 2)
    base, index, primes, power = _base(first, depth)
    if power:
        raise InvalidInput(f"a power with an index or a power on it; {HINT}")
    for which, other in zip({"msubsup": ("msub", "msup")}.get(kind, (kind,)), others, strict=True):
        dots = DOTS.get((other.text or "").strip()) if which == "mover" and _kind(other) == "mo" else None
        text = "" if dots else _text(other, depth + 1).strip()
        bare = re.sub(r"\s", "", text)
        if which == "msub" and not index and re.fullmatch(r"[0-9A-Za-z]{1,6}", bare):
            index = "_{" + bare + "}"
        elif dots:
            primes += dots
        elif which == "msup" and set(bare) == {"'"}:
            primes += bare
        elif which == "msup" and re.fullmatch(r"-?[0-9]", bare):
            power = f"^{bare}" if bare.isdigit() else f"^({bare})"
        else:
            raise InvalidInput(f"{text[:12]!r} above or below {base[:12]!r} in MathML is not read; {HINT}")
    return base, index, primes, power


def _base(element: Tree.Element, depth: int) -> Scripted:
    inner = element
    while _kind(inner) in ("mrow", "mstyle") and len(inner) == 1:
        inner = inner[0]
    if _kind(inner) in ("msub", "msup", "msubsup", "mover"):
        return _scripted(inner, depth + 1)
    text = _text(inner, depth + 1).strip()
    whole = _kind(inner) in ("mi", "mn") or text in (")", "]")
    return (text if whole else f"({text})"), "", "", ""
