r"""M(q)\ddot q + C(q,\dot q)\dot q + g(q) = \tau whose entries are said one by one: M_{11} = …, g_1 = …."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ....models.errors import InvalidInput
from ..given_names import OF_COORDINATES
from ..markup.prose import is_whole
from ..names import plain_name, spelling
from .displays import Statement, cut
from .letters import Names, alone, unfonted, uses, written_alone
from .states import entries

ENTRY = re.compile(r"(?P<letter>[A-Za-z])(?P<index>[1-9]{1,2})")
LITERAL = re.compile(r"\s*(?:\\left\s*)?(?:\[|\\begin\s*\{[pbB]?(?:small)?matrix\})")
# Behind a matrix, the rates of all coordinates together
OF_ALL = r"\\d?dot\s*\{?\s*(?:\\(?:mathbf|bm|boldsymbol|vec)\s*\{?\s*)?q(?!\s*_)"
MOTION = re.compile(r"\\ddot")
RATE = re.compile(r"\\dot|[\u0307\u0308']")
VECTOR = re.compile(r"[rpPRA](?P<k>[1-8])")
POINT = re.compile(r"[xyzXYZ]\w{0,3}")
AS_BRACES = str.maketrans("([)]", "{{}}")
BRACKETED = re.compile(r"^\s*(?:\\left\s*)?[(\[](?P<inner>.*?)(?:\\right\s*)?[)\]]\s*$", re.DOTALL)


def with_entries(statements: Sequence[Statement], names: Names) -> list[Statement]:
    """The statements with a matrix or a column of entries in place of its letter, where each entry is said.

    M_{12} = M_{21} = … says both. A letter that is a quantity as well, as g, is meant only with arguments, g(q).
    """
    _require_names_once(statements, names)
    statements = [_value_last(sides) for sides in statements]
    count = len(names.coordinates)
    also = [s for sides in statements for s in _also(sides, statements)]
    made = [*statements, *also]
    said = {name for sides in made if (name := alone(sides[0])) and len(sides) > 1}
    literals: dict[str, str] = {}
    figures = range(1, count + 1)
    for letter in sorted({m["letter"] for name in said if (m := ENTRY.fullmatch(name))} - said):
        for rows in ([[f"{i}{j}" for j in figures] for i in figures], [[f"{i}"] for i in figures]):
            if count > 1 and all(letter + index in said for row in rows for index in row):
                literals[letter] = _literal(letter, rows)
    written = [_put(sides, literals, names) for sides in statements]
    texts = [side for sides in written for side in sides if alone(side) is None]
    return written + [sides for sides in also if uses(alone(sides[0]) or "", texts)]


def _value_last(sides: Statement) -> Statement:
    """M_{12} = … = M_{21} with what both are at the end."""
    first, *between = sides
    last = between.pop() if len(between) > 1 else ""
    return (first, last, *between) if all(ENTRY.fullmatch(alone(side) or "") for side in (first, last)) else sides


def _require_names_once(statements: Sequence[Statement], names: Names) -> None:
    """Raises InvalidInput where a column that only names what stands behind it has a name twice, (G_1, G_1) = …."""
    for side in (side for sides in statements for side in sides):
        listed = [alone(entry) for entry in entries(side)]
        twice = next((x for x in listed if x and x not in names.all and listed.count(x) > 1), None)
        if twice and None not in listed:
            raise InvalidInput(f"{twice} stands twice in one column: which entry is it? Give each a name of its own")


def with_columns_apart(statements: Sequence[Statement], names: Names) -> list[Statement]:
    r"""The statements with a name of its own for a column g, in which the number g may stand: \tau = M \ddot q + c + g.

    It is meant where it stands as a term alone, with (q) or before \ddot q in an equation of letters for matrices.
    """
    made = list(statements)
    for sides in statements:
        name = alone(sides[0]) if len(sides) == 2 else None
        if name is None or name not in names.all or name in names.coordinates or not LITERAL.match(sides[1]):
            continue
        x = f"(?:{spelling(name).pattern})"
        of = rf"\s*{OF_COORDINATES}"
        alone_in_sum = rf"(?<=[=+−-])\s*{x}(?=\s*(?:$|[=+−-]))|^\s*{x}(?=\s*(?:$|[=+−-]))"
        term = re.compile(rf"(?<![A-Za-z\\])(?:{x}{of}|{x}(?=\s*{OF_ALL}))|{alone_in_sum}")
        column = f"{name}_{{9}}" if len(name) == 1 else ""
        others = [other for other in made if MOTION.search(" ".join(other)) and "\\begin" not in " ".join(other)]
        if not column or not any(term.search(unfonted(side)) for other in others for side in other):
            continue
        made = [
            tuple(term.sub(f" {column} ", unfonted(side)) for side in other) if other in others else other
            for other in made
        ]
        made = [(column, sides[1]) if other == sides else other for other in made]
    return made


def with_points(statements: Sequence[Statement], names: Names) -> list[Statement]:
    """The statements with x_1 = … and y_1 = … for A_1 = (x_1, y_1) = (…, …)."""
    first = {alone(sides[0]) for sides in statements}
    made = [_of_vector(sides, first, names) or [sides] for sides in statements]
    points = [name for sides, new in zip(statements, made, strict=True) if len(new) > 1 and (name := alone(sides[0]))]
    texts = [side for new in made for sides in new for side in sides]
    if any(uses(name, texts) for name in points):
        made = [[sides] for sides in statements]
    return [one for new in made for sides in new for one in _of_point(sides, names)]


def _of_vector(sides: Statement, first: set[str | None], names: Names) -> list[Statement]:
    r"""x_1 = … and y_1 = … for \vec r_1 = (…, …), where nothing else says them."""
    found = VECTOR.fullmatch(alone(sides[0]) or "") if len(sides) == 2 else None
    listed = _listed(sides[1]) if found and found[0] not in names.all and not MOTION.search(sides[1]) else []
    if found is None or len(listed) != 2 or RATE.search(sides[1]):
        return []
    new = [(f"{x}_{{{found['k']}}}", value) for x, value in zip("xy", listed, strict=True)]
    taken = first | names.all
    return [] if any(alone(name) in taken for name, _ in new) else list(new)


def _of_point(sides: Statement, names: Names) -> list[Statement]:
    listed = [_listed(side) for side in sides]
    columns = [x for x in listed if x]
    if len(columns) < 2 or len({len(x) for x in columns}) != 1 or MOTION.search(" ".join(sides)):
        return [sides]
    own = [alone(x) or "" for x in columns[0]]
    others = [alone(side) or unfonted(side) for side, x in zip(sides, listed, strict=True) if not x]
    if not all(POINT.fullmatch(x) and x not in names.all for x in own) or any("=" in x or "+" in x for x in others):
        return [sides]
    return [tuple(parts) for parts in zip(*columns, strict=True)]


def _listed(side: str) -> list[str]:
    """The entries of a column, or of a list in brackets."""
    found = entries(side)
    inner = BRACKETED.match(side)
    if found or inner is None or not is_whole(inner["inner"].translate(AS_BRACES)):
        return found
    parts = [part.strip() for part in cut(inner["inner"], re.compile("[,;]"))]
    return parts if len(parts) > 1 and all(parts) else []


def without_arguments(statements: Sequence[Statement], names: Names) -> list[Statement]:
    """The statements with H in place of H(u), where H = [u, 0]ᵀ says that it is a column with u in it: no product."""
    made = list(statements)
    for sides in statements:
        name = alone(sides[0]) if len(sides) > 1 else None
        if name is None or name in names.all or not LITERAL.match(value := sides[len(sides) - 1]):
            continue
        sides_of_all = [side for other in statements for side in other]
        for m in {m[0]: m for side in sides_of_all for m in _call(name).finditer(side)}.values():
            argument = plain_name(m["u"])
            if argument in names.quantities and uses(argument, [value]):
                call = re.compile(re.escape(m[0]))
                made = [tuple(call.sub(f" {m['x']} ", side) for side in x) for x in made]
    return made


def _call(name: str) -> re.Pattern[str]:
    return re.compile(
        rf"(?<![A-Za-z\\])(?P<x>{spelling(name).pattern})\s*\(\s*(?P<u>\\?[A-Za-zα-ω]\w{{0,8}}(?:_\{{\w+\}})?)\s*\)"
    )


def _also(sides: Statement, statements: Sequence[Statement]) -> list[Statement]:
    """M_{21} = … of M_{12} = M_{21} = …."""
    first = {alone(other[0]) for other in statements}
    inner = [side for side in sides[1:-1] if (name := alone(side)) and ENTRY.fullmatch(name) and name not in first]
    return [(written_alone(side), sides[-1]) for side in inner]


def _literal(letter: str, rows: list[list[str]]) -> str:
    inner = " \\\\ ".join(" & ".join(f"{letter}_{{{index}}}" for index in row) for row in rows)
    return f" \\begin{{bmatrix}} {inner} \\end{{bmatrix}} "


def _put(sides: Statement, literals: dict[str, str], names: Names) -> Statement:
    if not MOTION.search(" ".join(sides)) or len(sides) != 2:
        return sides
    made = tuple(unfonted(side) for side in sides)
    for letter, literal in literals.items():
        of = rf"\s*{OF_COORDINATES}"
        x = re.compile(rf"(?<![A-Za-z\\_]){letter}(?![A-Za-z])(?:{of})" + ("" if letter in names.all else r"?(?!\s*_)"))
        made = tuple(x.sub(lambda _, literal=literal: literal, side) for side in made)  # type: ignore[misc]
    return made
