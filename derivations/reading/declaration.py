"""Reads the mechanism that a file declares, body by body, or by one of the usual words (``PRESETS``).

    system = "mechanism"
    [[bodies]]
    name = "cart"; coordinate = "x"; joint = "slide"; along = "right"; mass = "M"
    [[bodies]]
    name = "pole"; coordinate = "theta"; joint = "hinge"; on = "cart"; length = "l"; mass = "m"

Every quantity is an expression in the author's own names; ``motion = "given"`` of a support that is moved, whose own
equation is not asked for. Left out: ``on`` is the body before, ``centre`` the length of
a body on a hinge (a point mass at its end) and 0 on a slide, everything else nothing.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from ...models.errors import InvalidInput, nearest
from ..algebra.signs import sign_symbols
from ..algebra.symbols import KINDS
from ..algebra.trig import NOTHING, Formula, Space
from ..dialects.lines import LONGEST_LINE
from ..dialects.names import GREEK, WRITTEN, base_and_index, is_joined, plain_name, spelling, splits
from ..steps.declared import Declared, Joined, pivot_to_centre
from .evaluation import Evaluation
from .layout import laid_out
from .meaning import Meaning, momentum_symbols
from .momenta import Variable, has_momenta, variable
from .parser import parse_expression
from .vocabulary import ANGLES, FUNCTIONS, LETTERS, Vocabulary

MOST_BODIES = 8
QUANTITIES = ("mass", "length", "centre", "inertia", "at", "spring", "rest", "damping", "friction", "drive")
FIELDS = ("name", "on", "coordinate", "joint", "along", "about", "motion", *QUANTITIES)
FRACTION = re.compile(r"\\(?:[dt]?frac|cdot|times|left|right|over|pi)(?![A-Za-z])|[0-9.]+(?:[eE][+-]?[0-9]+)?")
GLYPHS_APART = {"vartheta": "theta", "th": "theta", "varphi": "phi"}  # one letter, unless both are used
TAKEN = ("g", "t", "pi", *FUNCTIONS)

_CART = {"name": "cart", "coordinate": "x", "joint": "slide", "along": "right", "mass": "M"}
MOST_LINKS = 20
SYSTEMS = (*KINDS, "rods", "point-masses", "links")
WORDS: dict[str, tuple[str, int]] = {  # usual names, with how many links they have
    "simple-pendulum": ("point-masses", 1), "double-pendulum": ("point-masses", 2),
    "triple-pendulum": ("point-masses", 3), "physical-pendulum": ("links", 1), "acrobot": ("links", 2),
    "double-rod-pendulum": ("rods", 2),
}  # fmt: skip
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


@dataclass(frozen=True)
class Own:
    """A mechanism that a file declares, its symbols, the words of its coordinates, and a variable of its author's."""

    mechanism: Declared
    symbols: dict[str, Formula]
    words: Vocabulary
    variable: Variable | None


def declared(
    data: dict[str, Any], texts: Sequence[str] = (), constants: Sequence[str] = (), *, has_signs: bool = False
) -> Own | None:
    """The mechanism that a file declares; None where it names one.

    ``texts``: its lines of mathematics; ``constants``: names of quantities besides those of the bodies; ``has_signs``:
    signs of rates may be written, though no body has friction.
    """
    system = data.get("system")
    if isinstance(system, str) and system in PRESETS and "bodies" not in data:
        bodies: object = [_with_rest(body, data) for body in PRESETS[system]]
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
    names, apart = _names([*(b[q] for b in bodies for q in QUANTITIES if q in b), *constants])
    coordinates = tuple(_coordinate(b, place) for place, b in enumerate(bodies, 1))
    places = data.get("positions", {})
    defined = (*map(str, data.get("define", {})), *(map(str, places) if isinstance(places, dict) else ()))
    taken = frozenset({*names, *(base for base, _ in coordinates), *defined})
    taken |= {found[0] for name in defined if (found := base_and_index(name)) and found[1]}
    names += [_reaction(k) for k, body in enumerate(bodies) if _is_given(body, k)]
    letter = variable(texts, len(bodies), momenta=has_momenta(data), coordinates=coordinates, taken=taken)
    signs = has_signs or any("friction" in b for b in bodies)
    own = (*names, *(sign_symbols(len(bodies)) if signs else ()), *momentum_symbols(letter, len(bodies)))
    space = Space.general(len(bodies), own)
    symbols = {name: space.own(name) for name in names}
    plain = [base + index for base, index in coordinates]
    twice = sorted(set(plain) & set(names))
    if twice and len(set(plain)) == len(plain):
        raise InvalidInput(
            f"bodies: {twice[0]} is a coordinate, and what a body has is made of other letters; every coordinate needs "
            "a name of its own"
        )
    if len(set(plain)) < len(plain):
        raise InvalidInput("bodies: every coordinate needs a name of its own")
    words = _words(coordinates, frozenset(names), apart)
    made = tuple(_body(b, place, bodies, symbols, space, words) for place, b in enumerate(bodies))
    return Own(Declared(space, made, tuple(plain)), symbols, words, letter)


RESTS = ("l0", "L0", "r0", "R0", "l", "L", "a")


def _with_rest(body: dict[str, str], data: dict[str, Any]) -> dict[str, str]:
    """A usual mechanism's spring, whose length at rest has the name that the author gives it."""
    if "rest" not in body:
        return body
    tables = [data.get("define"), data.get("equations")]
    lines = [line for table in tables if isinstance(table, dict) for line in table.values()]
    lines += [data.get("lagrangian"), *(data["equations"] if isinstance(data.get("equations"), list) else [])]
    text = " ".join(laid_out(line) for line in lines if isinstance(line, str) and len(line) <= LONGEST_LINE)
    text = re.sub(r"\\(?!ell)[A-Za-z]+|cos|sin|tan|theta", " ", text)
    there = [name for name in RESTS if re.search(rf"(?<![A-Za-z_]){spelling(name).pattern}", text)]
    return {**body, "rest": there[0]} if len(there) == 1 else body


def _names(texts: list[str]) -> tuple[list[str], frozenset[str]]:
    """The names of all quantities, plain; and those that as one word are two of them side by side."""
    alone = {plain: text for text in texts if (plain := plain_name(text)) is not None}
    known, joined = set(alone), {plain for plain, text in alone.items() if is_joined(text)}
    for text in texts:
        if plain_name(text) is None:
            for written in _written(text):
                plain = plain_name(written)
                if plain is None:
                    raise InvalidInput(f"bodies: {written!r:.40} is no name of a quantity")
                if is_joined(written) and (plain not in joined) and splits(plain, frozenset(known | {"g"})):
                    continue  # mL is m times L where these are names
                known.add(plain)
                joined |= {plain} if is_joined(written) else set()
    names = sorted(known - {"g"})
    for name in names:
        if name in TAKEN or not name.isalnum():
            raise InvalidInput(f"bodies: {name!r:.40} is no name of a quantity; letters, then figures")
    return names, frozenset(n for n in names if n not in joined and splits(n, frozenset({*names, "g"})))


def _written(text: str) -> list[str]:
    """The names in an expression, as they are written."""
    at, found = 0, []
    while at < len(text):
        skipped = FRACTION.match(text, at)
        if skipped:
            at = skipped.end()
            continue
        name = WRITTEN.match(text, at)
        if name:
            found.append(name[0])
        at = name.end() if name else at + 1
    return found


def _coordinate(body: dict[str, str], place: int) -> tuple[str, str]:
    """The letter or word of a coordinate and its index, "" for none."""
    written = body.get("coordinate", "")
    found = base_and_index(written)
    if (
        found is None
        or (found[0] in TAKEN and written.strip() != "t")
        or not found[1].isalnum() * len(found[1]) == len(found[1])
    ):
        raise InvalidInput(f"bodies {place}: coordinate: {written!r:.40} is not known; a letter or a Greek one, "
                           "with an index if you like")  # fmt: skip
    base, index = found
    if not index and (figures := re.search(r"[0-9]+$", base)):
        base, index = base[: figures.start()], figures[0]
    return base, index


def _body(
    body: dict[str, str], place: int, bodies: list[dict[str, str]], symbols: dict[str, Formula], space: Space,
    words: Vocabulary,
) -> Joined:  # fmt: skip
    names = [b.get("name", f"body {k}") for k, b in enumerate(bodies, 1)]
    on = body.get("on", names[place - 1] if place else "support")
    on = "support" if on in ("world", "ground") and on not in names else on
    if on != "support" and on not in names[:place]:
        raise InvalidInput(f"bodies {place + 1}: on: {on!r:.40} is no body before it; give its name, or 'support'")
    joint, along = body.get("joint", "hinge"), body.get("along", "right")
    if joint not in ("hinge", "slide") or along not in ("right", "up", "down", "link"):
        raise InvalidInput(f"bodies {place + 1}: joint is 'hinge' or 'slide', along is 'right', 'up', 'down' or 'link'")
    if body.get("about", "centre") not in ("centre", "pivot"):
        raise InvalidInput(f"bodies {place + 1}: about is 'centre' or 'pivot'")

    quantities = replace(words, fixed={}, numbers={}, letters={"g": "g", "pi": "p", "\\pi": "p", "π": "p"})

    def value(field: str, otherwise: Formula = NOTHING) -> Formula:
        if field not in body:
            return otherwise
        evaluation = Evaluation(Meaning("mechanism", space, symbols))
        try:
            found = evaluation.scalar(parse_expression(body[field], frozenset(symbols), quantities))
        except InvalidInput as error:
            raise InvalidInput(f"bodies {place + 1}: {field}: {error}") from None
        if found.denominator:
            raise InvalidInput(f"bodies {place + 1}: {field}: a sum in a denominator")
        return found.numerator

    given = _is_given(body, place)
    length, mass = value("length"), value("mass")
    centre = value("centre", length if joint == "hinge" else NOTHING)
    inertia = value("inertia")
    if body.get("about") == "pivot":
        inertia = pivot_to_centre(inertia, mass, centre)
    return Joined(
        names[place], names.index(on) if on in names[:place] else -1,  # a body may be called "support" itself
        None if joint == "hinge" else along,  # type: ignore[arg-type]
        mass, length, centre, inertia, value("at") if "at" in body else None, value("spring"), value("rest"),
        value("damping"), value("friction"), symbols[_reaction(place)] if given else value("drive"), given,
    )  # fmt: skip


def _reaction(place: int) -> str:
    """The name of the force that brings a given motion about."""
    return f"reaction{place + 1}"


def _is_given(body: dict[str, str], place: int) -> bool:
    """Whether a body's motion is given. Raises InvalidInput where the file says that otherwise than so."""
    if "motion" not in body:
        return False
    if body["motion"] != "given":
        raise InvalidInput(f"bodies {place + 1}: motion: 'given', or leave it out")
    if "drive" in body:
        raise InvalidInput(f"bodies {place + 1}: a drive besides a given motion; its drive is what the motion needs")
    return True


def _words(coordinates: tuple[tuple[str, str], ...], names: frozenset[str], apart: frozenset[str]) -> Vocabulary:
    """The words of the coordinates, in Greek, LaTeX and ASCII; dots and primes make their rates."""
    letters = {word: kind for word, kind in LETTERS.items() if kind in "gp"}
    fixed: dict[str, tuple[str, int]] = {}
    numbers: dict[str, dict[str, int]] = {}
    used = {base for base, _ in coordinates} | names
    for k, (base, index) in enumerate(coordinates, 1):
        for word in _spellings(base, used):
            if index:
                letters[word] = "t"
                numbers.setdefault(word, {})[index] = k
            else:
                fixed[word] = ("t", k)
    for word in fixed.keys() & letters.keys():
        raise InvalidInput(f"bodies: the coordinate {word} stands with a number and without one")
    return Vocabulary(letters, fixed, numbers=numbers, declared=True, apart=apart)


def _spellings(base: str, used: set[str]) -> tuple[str, ...]:
    """Every way to write a letter; ϑ and θ are one where only one of the two is used."""
    letter = GLYPHS_APART.get(base, base)
    twins = {letter, *(glyph for glyph, of in GLYPHS_APART.items() if of == letter)}
    shared = [letter] if used & twins == {base} else []
    family = next((words for words in ANGLES.values() if letter in words), ()) if shared else ()
    own = (base, *GREEK.get(base, ()), *((f"\\{base}",) if base in GREEK else ()))
    own = (*own, "ℓ", "\\ell") if base == "l" else own
    return tuple(dict.fromkeys((*own, *family, *(("th",) if shared == ["theta"] else ()))))


def system_of(data: dict[str, Any]) -> tuple[str, int]:
    """The kind and the number of angles of a system that has a name. Raises InvalidInput with what is known."""
    kind, links = data.get("system"), data.get("links")
    if isinstance(kind, str) and kind in WORDS:
        kind, usual = WORDS[kind]
        links = usual if links is None else links
    if kind not in SYSTEMS:
        hint = (
            nearest(kind, (*SYSTEMS, *WORDS, *PRESETS, "mechanism"))
            if isinstance(kind, str) and len(kind) < 100
            else ""
        )
        known = ", ".join(f"'{name}'" for name in (*SYSTEMS, *WORDS, *PRESETS, "mechanism"))
        raise InvalidInput(f"system: {kind!r:.40} is not known{hint}; give one of {known}")
    if type(links) is not int or not 1 <= links <= MOST_LINKS:
        raise InvalidInput(f"links: the number of angles is needed, from 1 to {MOST_LINKS}, got {links!r:.40}")
    return kind, links
