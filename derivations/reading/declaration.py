"""Reads the mechanism that a file declares, body by body, or by one of the usual words (``PRESETS``).

    system = "mechanism"
    [[bodies]]
    name = "cart"; coordinate = "x"; joint = "slide"; along = "right"; mass = "M"
    [[bodies]]
    name = "pole"; coordinate = "theta"; joint = "hinge"; on = "cart"; length = "l"; mass = "m"

Every quantity is an expression in the author's own names. Left out: ``on`` is the body before, ``centre`` the length of
a body on a hinge (a point mass at its end) and 0 on a slide, everything else nothing.
"""

from __future__ import annotations

import re
from typing import Any

from ...models.errors import InvalidInput, nearest
from ..algebra.trig import NOTHING, Formula, Space
from ..steps.declared import Declared, Joined, pivot_to_centre
from .evaluation import Evaluation
from .meaning import Meaning
from .parser import parse_expression
from .vocabulary import ANGLES, FUNCTIONS, LETTERS, Vocabulary

MOST_BODIES = 8
QUANTITIES = ("mass", "length", "centre", "inertia", "at", "spring", "rest", "damping", "drive")
FIELDS = ("name", "on", "coordinate", "joint", "along", "about", *QUANTITIES)
NAME = re.compile(r"[A-Za-z][A-Za-z0-9]{0,15}")
PARAMETER = re.compile(r"(?<![A-Za-z0-9\\])[A-Za-z][A-Za-z0-9]*")
COORDINATE = re.compile(r"(?P<base>[A-Za-z]+?)(?P<index>[0-9]{0,2})")
BASES = ("theta", "phi", "psi", "alpha", "beta", "gamma", "q", "x", "y", "z", "r", "s", "u")

_CART = {"name": "cart", "coordinate": "x", "joint": "slide", "along": "right", "mass": "M"}
PRESETS: dict[str, list[dict[str, str]]] = {
    "cart-pole": [_CART, {"name": "pole", "coordinate": "theta", "length": "l", "mass": "m"}],
    "cart-rod": [
        _CART,
        {"name": "rod", "coordinate": "theta", "length": "2*l", "centre": "l", "mass": "m", "inertia": "I"},
    ],
    "cart-double-pole": [
        _CART,
        {"name": "bob 1", "coordinate": "theta1", "length": "l1", "mass": "m1"},
        {"name": "bob 2", "coordinate": "theta2", "length": "l2", "mass": "m2"},
    ],
    "elastic-pendulum": [
        {"name": "spring", "coordinate": "theta", "mass": "0"},
        {"name": "bob", "coordinate": "r", "joint": "slide", "along": "link", "mass": "m", "spring": "k", "rest": "l0"},
    ],
}  # fmt: skip


def declared(data: dict[str, Any]) -> tuple[Declared, dict[str, Formula], Vocabulary] | None:
    """The mechanism that a file declares, its symbols, and the words of its coordinates; None where it names one."""
    system = data.get("system")
    if isinstance(system, str) and system in PRESETS and "bodies" not in data:
        bodies: object = PRESETS[system]
    elif system == "mechanism":
        bodies = data.get("bodies")
    else:
        return None
    if (
        not isinstance(bodies, list)
        or not 1 <= len(bodies) <= MOST_BODIES
        or not all(isinstance(b, dict) for b in bodies)
    ):
        raise InvalidInput(f"bodies: from 1 to {MOST_BODIES} tables [[bodies]] are needed")
    for place, body in enumerate(bodies, 1):
        for name, value in body.items():
            if name not in FIELDS:
                raise InvalidInput(f"bodies {place}: {name!r:.40} is not known{nearest(name, FIELDS)}")
            if not isinstance(value, str) or len(value) > 200:
                raise InvalidInput(f"bodies {place}: {name}: a text in quotes is needed, got {value!r:.40}")
    names = sorted({x for b in bodies for q in QUANTITIES for x in PARAMETER.findall(b.get(q, ""))} - {"g"})
    for name in names:
        if not NAME.fullmatch(name) or name in FUNCTIONS:
            raise InvalidInput(f"bodies: {name!r:.40} is no name of a quantity; letters, then figures")
    space = Space.general(len(bodies), tuple(names))
    symbols = {name: space.own(name) for name in names}
    coordinates = tuple(_coordinate(b, place) for place, b in enumerate(bodies, 1))
    if len(set(coordinates)) < len(coordinates) or set(coordinates) & set(names):
        raise InvalidInput("bodies: every coordinate needs a name of its own")
    made = tuple(_body(b, place, bodies, symbols, space) for place, b in enumerate(bodies))
    return Declared(space, made, coordinates), symbols, _words(coordinates)


def _coordinate(body: dict[str, str], place: int) -> str:
    name = body.get("coordinate", "")
    match = COORDINATE.fullmatch(name)
    if match is None or match["base"] not in BASES:
        raise InvalidInput(f"bodies {place}: coordinate: {name!r:.40} is not known; one of {', '.join(BASES)}, "
                           "with a number if you like")  # fmt: skip
    return name


def _body(
    body: dict[str, str], place: int, bodies: list[dict[str, str]], symbols: dict[str, Formula], space: Space
) -> Joined:
    names = [b.get("name", f"body {k}") for k, b in enumerate(bodies, 1)]
    on = body.get("on", names[place - 1] if place else "support")
    if on != "support" and on not in names[:place]:
        raise InvalidInput(f"bodies {place + 1}: on: {on!r:.40} is no body before it; give its name, or 'support'")
    joint, along = body.get("joint", "hinge"), body.get("along", "right")
    if joint not in ("hinge", "slide") or along not in ("right", "up", "down", "link"):
        raise InvalidInput(f"bodies {place + 1}: joint is 'hinge' or 'slide', along is 'right', 'up', 'down' or 'link'")
    if body.get("about", "centre") not in ("centre", "pivot"):
        raise InvalidInput(f"bodies {place + 1}: about is 'centre' or 'pivot'")

    def value(field: str, otherwise: Formula = NOTHING) -> Formula:
        if field not in body:
            return otherwise
        evaluation = Evaluation(Meaning("mechanism", space, symbols))
        try:
            found = evaluation.scalar(parse_expression(body[field], frozenset(symbols)))
        except InvalidInput as error:
            raise InvalidInput(f"bodies {place + 1}: {field}: {error}") from None
        if found.denominator:
            raise InvalidInput(f"bodies {place + 1}: {field}: a sum in a denominator")
        return found.numerator

    length, mass = value("length"), value("mass")
    centre = value("centre", length if joint == "hinge" else NOTHING)
    inertia = value("inertia")
    if body.get("about") == "pivot":
        inertia = pivot_to_centre(inertia, mass, centre)
    return Joined(
        names[place], names.index(on) if on != "support" else -1,
        None if joint == "hinge" else along,  # type: ignore[arg-type]
        mass, length, centre, inertia, value("at") if "at" in body else None, value("spring"), value("rest"),
        value("damping"), value("drive"),
    )  # fmt: skip


def _words(coordinates: tuple[str, ...]) -> Vocabulary:
    """The words of the coordinates, in Greek, LaTeX and ASCII; dots and primes make their rates."""
    letters = {word: kind for word, kind in LETTERS.items() if kind not in "twarI" and kind not in "lm"}
    fixed: dict[str, tuple[str, int]] = {}
    numbers: dict[str, dict[int, int]] = {}
    for k, name in enumerate(coordinates, 1):
        match = COORDINATE.fullmatch(name)
        assert match is not None
        for word in _spellings(match["base"]):
            if match["index"]:
                letters[word] = "t"
                numbers.setdefault(word, {})[int(match["index"])] = k
            else:
                fixed[word] = ("t", k)
    for word in fixed.keys() & letters.keys():
        raise InvalidInput(f"bodies: the coordinate {word} stands with a number and without one")
    return Vocabulary(letters, fixed, numbers=numbers, declared=True)


def _spellings(base: str) -> tuple[str, ...]:
    return next((words for words in ANGLES.values() if base in words), (base,))
