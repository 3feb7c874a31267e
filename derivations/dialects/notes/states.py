r"""The state and its derivative as columns: \dot{\mathbf x} = f(x) + g(x) u, d/dt (x_1, x_2)^T = …, with x_1 = θ, x_2 = \dot θ.

Each entry of the derivative is written out as a coordinate's rate or acceleration, so that the column equation is rows.
"""
# ruff: noqa: E501 -- patterns stand on one line

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from ....models.errors import InvalidInput
from ..names import plain_name
from .displays import ROW_END, Statement, cut
from .letters import Names, alone, spelled, uses
from .points import derived

_MATRIX = r"\\begin\s*\{(?P<of>[pbBvV]?(?:small)?matrix|array)\}(?:\s*\{[clr|]*\})?(?P<inner>.*?)\\end\s*\{(?P=of)\}"
_TURNED = r"\s*(?:\^\s*\{?\s*(?:\\top|\\intercal|\\(?:mathrm|mathsf|text|rm)\s*\{?\s*T\s*\}?|T)\s*\}?|ᵀ)"
COLUMN = re.compile(
    rf"^\s*(?:\\left\s*[(\[]\s*)?{_MATRIX}(?:\s*\\right\s*[)\]])?(?:{_TURNED})?\s*$|^\s*(?:\\left\s*)?[(\[](?P<list>[^()\[\]]*?)(?:\\right\s*)?[)\]](?:{_TURNED})?\s*$",
    re.DOTALL,
)
BY_TIME = re.compile(
    r"^\s*(?:\\[dt]?frac\s*\{\s*(?:\\mathrm\s*\{?\s*d\s*\}?|d)\s*\}\s*\{\s*(?:\\mathrm\s*\{?\s*d\s*\}?|d)\s*t\s*\}|d\s*/\s*dt)\s*(?=\S)"
)
BOLD = re.compile(r"\\(?:mathbf|boldsymbol|bm|pmb|vec|underline)")
BOLD_WHOLE = re.compile(r"^\s*\{(?P<x>[^{}]*(?:\{[^{}]*\}[^{}]*)?)\}\s*$")  # the braces of \\mathbf{\\dot x}
OUTPUT = re.compile(r"^\s*(?:\\(?:mathbf|boldsymbol|bm|vec)\s*\{?\s*)?[yz]\s*\}?\s*(?:\(\s*t\s*\))?\s*$")
MOST_STATES = 16
RATES = re.compile(r"\\d?dot|[\u0307\u0308'′]|\b(?:sin|cos)")


def entries(side: str) -> list[str]:
    """The entries of a column or a row, each as it is written; none where a side is more than that."""
    found = COLUMN.match(side)
    if found is None:
        return []
    inner = found["inner"] if found["inner"] is not None else found["list"]
    for separator in (ROW_END, re.compile("&"), re.compile("[,;]")):
        parts = [part.strip() for part in cut(inner, separator) if part.strip()]
        if len(parts) > 1:
            return parts if len(parts) <= MOST_STATES and not any("&" in part for part in parts) else []
    return []


def with_states(statements: Sequence[Statement], names: Names, define: Mapping[str, str]) -> list[Statement]:
    """The statements with rates and accelerations for a state's derivative, where its entries are said.

    ``define``: what the file itself says of names. A text without such a derivative stays as it is.
    """
    statements = _by_entries(statements, names, {p for name in define if (p := plain_name(name))})
    # what the file says is a place of its own, y_2 = y_1 + s, has rates as a coordinate has
    places = tuple(p for name, value in define.items() if (p := plain_name(name)) and p not in names.coordinates
                   and uses_any(names.coordinates, value) and not derived(value) and not RATES.search(value))  # fmt: skip
    names = replace(names, coordinates=(*names.coordinates, *places))
    said = {plain: value for name, value in define.items() if (plain := plain_name(name)) and _motion(value, names)}
    kept: list[Statement] = []
    for sides in statements:
        listed = _said(sides, names)
        other = next((x for x, v in listed.items() if x in said and _motion(said[x], names) != _motion(v, names)), None)
        if other:
            raise InvalidInput(f"{other} of the state is said to be two things; which is meant?")
        said |= listed
        if not listed or (len(sides) == 2 and alone(sides[0]) in listed):
            kept.append(sides)
    made = [_derived(sides, said, names) for sides in _of_matrices(kept, said, names)]
    if made == kept or not said:
        return list(statements)
    made = [sides for sides in made if alone(sides[0]) not in said]
    texts = [" ".join(sides) for sides in made]
    own = {plain_name(name) for name in define}
    return made + [(spelled(name), value) for name, value in said.items() if name not in own and uses(name, texts)]


def uses_any(of: Iterable[str], text: str) -> bool:
    """Whether a text has one of these names."""
    return any(uses(name, [text]) for name in of)


def _by_entries(statements: Sequence[Statement], names: Names, own: set[str]) -> list[Statement]:
    r"""The statements with \dot x = v, \dot v = … for d/dt (x, v)^T = (v, …)^T, where nothing else says what v is."""
    said = own | {of for sides in statements if (of := _named(sides, names))}
    orders = {name: listed for sides in statements if len(sides) == 2 and (name := alone(sides[0]))
              and (listed := [alone(x) or "" for x in entries(sides[1])]) and all(listed)}  # fmt: skip
    made: list[Statement] = []
    used: set[str] = set()
    for sides in statements:
        listed, values = _listed(sides, orders) if len(sides) == 2 else [], entries(sides[-1])
        free = [name for name in listed if name not in names.all and name not in said]
        if len(listed) != len(values) or not free or set(names.coordinates) - set(listed):
            made.append(sides)
            continue
        used |= {name for name, order in orders.items() if order == listed}
        made += [(f"\\dot{{{spelled(name)}}}", value) for name, value in zip(listed, values, strict=True)]
    return [sides for sides in made if alone(sides[0]) not in used or len(sides) != 2]


def _named(sides: Statement, names: Names) -> str:
    """The name that a statement gives to a coordinate or a rate."""
    pairs = (sides, sides[::-1]) if len(sides) == 2 else ()
    return next(
        (name for one, two in pairs if (name := alone(one)) and name not in names.all and _motion(two, names)), ""
    )


def _listed(sides: Statement, orders: Mapping[str, list[str]]) -> list[str]:
    """The names whose derivatives the left side is, in order."""
    side = sides[0]
    by_time = BY_TIME.match(side)
    if by_time:
        return [alone(x) or "" for x in entries(side[by_time.end() :])] or orders.get(
            alone(side[by_time.end() :]) or "", []
        )
    of = [derived(x) for x in entries(side)]
    if of:
        return [m[0] if m and m[1] == 1 else "" for m in of]
    whole = derived(BOLD_WHOLE.sub(r" \g<x> ", re.sub(r"\{\s*\{([^{}]*)\}\s*\}", r"{\1}", BOLD.sub(" ", side))))
    return orders.get(whole[0], []) if whole and whole[1] == 1 else []


def _motion(side: str, names: Names) -> tuple[str, int] | None:
    """The coordinate that a side is, or is the rate of, and which of the two."""
    name = alone(side)
    if name in names.coordinates:
        return str(name), 0
    of = derived(side)
    return of if of and of[0] in names.coordinates and of[1] == 1 else None


def _said(sides: Statement, names: Names) -> dict[str, str]:
    """What a statement says of a state's entries, plain."""
    if len(sides) == 2 and (name := alone(sides[0])) and name not in names.all and _motion(sides[1], names):
        return {name: sides[1]}
    columns = [found for side in sides if (found := entries(side))]
    values = next((c for c in columns if all(_motion(x, names) for x in c)), None)
    whole = _letter(alone(sides[0]), sides)
    if values is None or len(columns) + (whole is not None) < len(sides):
        return {}
    others = [c for c in columns if c is not values and len(c) == len(values)]
    labels = [alone(x) for x in others[0]] if others else [f"{whole}{k}" for k in range(1, len(values) + 1)]
    if None in labels or (whole is None and not others):
        return {}
    free = {str(name): value for name, value in zip(labels, values, strict=True) if name not in names.all}
    return free if len(free) == len(values) else {}


def _derived(sides: Statement, said: Mapping[str, str], names: Names) -> Statement:
    """The statement with what a state's derivative is in place of all its names."""
    of = derived(sides[0])
    if len(sides) == 2 and of and of[1] == 1 and of[0] in said:
        return _rate(said[of[0]], names), sides[1]
    order = list(said)
    meant = [_state(side, order, names) for side in sides[:-1]]
    if len(sides) < 2 or not all(meant) or not ("\\begin" in sides[-1] or entries(sides[-1])):
        return sides
    listed = meant[0]
    if any(names_of != listed for names_of in meant) or any(name not in said for name in listed):
        return sides
    rates = [_rate(said[name], names) for name in listed]
    return " \\begin{bmatrix} " + " \\\\ ".join(rates) + " \\end{bmatrix} ", sides[-1]


def _of_matrices(statements: Sequence[Statement], said: Mapping[str, str], names: Names) -> list[Statement]:
    r"""The statements with the state's column for its letter in \dot x = A x + B u, and without the output y = C x + D u."""
    made = list(statements)
    for sides in statements:
        listed = _state(sides[0], list(said), names) if len(sides) == 2 else []
        letter = listed[0][:-1] if listed and all(name in said for name in listed) else ""
        if len(letter) != 1 or "\\begin" in sides[1]:
            continue
        bold = rf"{BOLD.pattern}\s*(?:\{{\s*{letter}\s*\}}|{letter}(?![A-Za-z]))(?!\s*_)"
        plain = "" if letter in names.all else rf"|(?<![A-Za-z\\_{{]){letter}(?!\s*_)(?![A-Za-z])"
        whole = re.compile(bold + plain)
        column = " \\begin{bmatrix} " + " \\\\ ".join(said[name] for name in listed) + " \\end{bmatrix} "
        parts = whole.split(sides[1])
        if len(parts) < 2:
            continue
        made = [other for other in made if other == sides or not (OUTPUT.match(other[0]) and whole.search(other[-1]))]
        made = [(sides[0], column.join(parts)) if other == sides else other for other in made]
    return made


def _state(side: str, order: list[str], names: Names) -> list[str]:
    r"""The names whose derivatives a side is: \frac{d}{dt} (x_1, x_2)^T, (\dot x_1, \dot x_2)^T, \dot{\mathbf x}; none."""
    by_time = BY_TIME.match(side)
    if by_time:
        listed = [alone(x) or "" for x in entries(side[by_time.end() :])]
        return listed if listed and all(listed) else []
    of = [derived(x) for x in entries(side)]
    if of:
        return [m[0] if m and m[1] == 1 else "" for m in of]
    is_bold = BOLD.search(side) is not None
    plain = re.sub(r"\{\s*\{([^{}]*)\}\s*\}", r"{\1}", BOLD.sub(" ", side)) if is_bold else side
    whole = derived(BOLD_WHOLE.sub(r" \g<x> ", plain) if is_bold else side)
    if whole is None or whole[1] != 1 or not (is_bold or whole[0] not in names.all):
        return []
    letter = _letter(whole[0], (side,))
    counted = sorted(name for name in order if re.fullmatch(rf"{re.escape(letter or ' ')}[1-9]", name))
    return counted if counted == [f"{letter}{k}" for k in range(1, len(counted) + 1)] else []


def _letter(name: str | None, sides: Sequence[str]) -> str | None:
    """x of x_{9}, which stands for a bold x beside a plain one."""
    return name[:-1] if name and len(name) == 2 and name[1] == "9" and "_{9}" in sides[0] else name


def _rate(value: str, names: Names) -> str:
    name, count = _motion(value, names) or ("", 0)
    return f"\\{'d' * (count + 1)}ot{{{spelled(name)}}}"
