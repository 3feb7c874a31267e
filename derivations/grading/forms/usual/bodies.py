"""Mechanisms, body by body, that have all their letters in a text."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import chain, islice, permutations
from typing import Any

from ....dialects.names import plain_name
from ...hypotheses import Said
from .carts import carts, supports
from .chains import chains
from .letters import ANGLES, NAME, SLIDES, Letters, letters_of
from .pendulums import elastic, pendulums
from .roles import Bodies, used
from .sliders import sliders

MOST = 60  # mechanisms
MOST_MADE = 800  # with the same coordinates, from which the most fitting are taken
MOST_COORDINATES = 4
MOST_CHOICES = 12
MOMENTA = re.compile(r"p(?!hi|si)\w{0,6}")
LIKELY = re.compile(r"th|phi|varphi|psi|alpha|alfa|q\d|tilt|ang|x$|pos|s$|p$|z$|x\d?$")
Choice = tuple[Sequence[str], Sequence[str]]  # what slides, and what turns
RATES = re.compile(r"(?:w|v|omega|Omega)[a-zA-Z0-9]{0,3}")  # they have dots as well, where rows are of first order


def usual_bodies(data: Mapping[str, Any]) -> tuple[frozenset[int], list[dict[str, Any]]]:
    """How many coordinates these fields of a derivation may have, none where that is not plain; and mechanisms.

    As fields, system and bodies. Those with most of the text's letters come first.
    """
    letters = letters_of(data)
    choices = _coordinates(letters)
    made = _made(letters, choices)
    if not letters.is_code and (not made or made[0][0]):
        made = sorted([*made, *_made(letters, _with_one_more(letters, choices))], key=lambda one: one[0])
    mechanisms = [bodies for left, bodies in made if left <= made[0][0] + 1]
    counts = (
        frozenset(len(slides) + len(angles) for slides, angles in choices)
        if letters.dotted and not letters.is_code
        else frozenset()
    )
    return counts, [{"system": "mechanism", "bodies": bodies} for bodies in mechanisms[:MOST]]


def _made(letters: Letters, choices: Sequence[Choice]) -> list[tuple[int, Bodies]]:
    """Mechanisms, and how many of the text's letters each leaves aside; the fewest first."""
    made = chain.from_iterable(islice(_mechanisms(letters, *choice), MOST_MADE) for choice in choices)
    return sorted(((len(letters.unsaid - _plain(used(x))), x) for x in made), key=lambda one: one[0])


def _with_one_more(letters: Letters, choices: Sequence[Choice]) -> list[Choice]:
    """An angle that has no dots, where those of others are in velocities."""
    found: list[Choice] = [
        (slides, [*angles, written])
        for slides, angles in choices[:1]
        for name, written in letters.names.items()
        if ANGLES.fullmatch(name) and written not in angles and name in letters.unsaid
    ]
    return found[:2]


def said_of_bodies(bodies: Bodies) -> Said:
    """What they are, with every quantity."""
    english = "; ".join(f"{_name(body)} with {', '.join(_quantities(body))}" for body in bodies)
    japanese = "；".join(f"{_name(body)}、{'、'.join(_quantities(body))}" for body in bodies)
    return f"it is about a {english}", f"次の機構についての式である：{japanese}"


def _name(body: Mapping[str, str]) -> str:
    ways = {"right": ", to the right", "up": ", upwards", "link": ", along the one before"}
    way = ways[body.get("along", "right")] if body.get("joint") == "slide" else ""
    on = f", on the {body['on']}" if "on" in body else ""
    return f"{body['name']} ({_shown(body['coordinate'])}{way}{on})"


def _quantities(body: Mapping[str, str]) -> list[str]:
    about = f" about the {body.get('about', 'centre')}"
    named = ("mass", "length", "centre", "inertia", "spring", "rest", "damping", "drive", "motion")
    is_last = body.get("length") == body.get("centre")  # then its length says nothing
    names = [name for name in named if name in body and not (is_last and name == "length")]
    return [f"{name} {_shown(body[name])}{about if name == 'inertia' else ''}" for name in names]


def _shown(written: str) -> str:
    return written.replace("\\", "")


def in_ones(about: Mapping[str, Any]) -> bool:
    """Whether masses or lengths are taken as one, for which the text has no letters."""
    return any("1" in (body.get("mass"), body.get("length")) for body in about.get("bodies", []))


def _plain(values: set[str]) -> set[str]:
    return {plain for value in values for plain in _names_in(value)}


@lru_cache(maxsize=1000)
def _names_in(value: str) -> tuple[str, ...]:
    return tuple(plain for found in NAME.finditer(value) if (plain := plain_name(found[0])))


def _coordinates(letters: Letters) -> list[Choice]:
    """What may slide and what may turn, the likeliest first."""
    dotted = [name for name in letters.dotted if not RATES.fullmatch(plain_name(name) or "w")]
    if not all(MOMENTA.fullmatch(plain_name(name) or "") for name in dotted):
        dotted = [name for name in dotted if not MOMENTA.fullmatch(plain_name(name) or "")]
    known = list(_sorted_out(dotted)) if 0 < len(dotted) <= MOST_COORDINATES else []
    if known and not letters.is_code:
        return known
    angles = _likely([x for x in letters.names if ANGLES.fullmatch(x)], letters)
    slides = _likely([x for x in letters.names if SLIDES.fullmatch(x)], letters)
    chains = [list(names) for n in (2, 3) for names in permutations(angles, n) if _numbered(names)]
    found: list[Choice] = [([], names) for names in chains]
    found += [([x], names) for x in slides[:2] for names in chains if len(names) == 2 and x not in names]
    found += [([], [x]) for x in angles[:3]]
    found += [([x], [y]) for y in angles[:3] for x in slides[:3] if x != y]
    return [*known, *(x for x in found if x not in known)][:MOST_CHOICES]


def _likely(names: Sequence[str], letters: Letters) -> list[str]:
    """Those that mostly are coordinates; the others where there are none of them."""
    likely = [x for x in names if LIKELY.match(x)]
    return [letters.names[x] for x in likely or names]


def _numbered(names: Sequence[str]) -> bool:
    """Whether they are counted: theta1 and theta2, th0 and th1, qa and qb."""
    plain = [plain_name(name) or " " for name in names]
    ends = "".join(x[-1] for x in plain)
    return len({x[:-1] for x in plain}) == 1 and ends in ("12", "01", "ab", "123", "012", "abc", "23")


def _sorted_out(names: Sequence[str]) -> Iterator[Choice]:
    """Which slide and which turn; those that may do both turn first."""
    plain = {name: plain_name(name) or "" for name in names}
    angles = [x for x in names if ANGLES.fullmatch(plain[x])]
    slides = [x for x in names if x not in angles and SLIDES.fullmatch(plain[x])]
    if len(angles) + len(slides) < len(names):
        angles = [x for x in names if x not in slides]
    by_number = sorted(angles, key=lambda x: plain[x])
    by_number = by_number if _numbered(by_number) else angles
    yield sorted(slides, key=lambda x: plain[x]), by_number
    if len(angles) == 2 and not _numbered(by_number):
        yield slides, by_number[::-1]
    both = [x for x in by_number if SLIDES.fullmatch(plain[x])]
    for x in both[:2]:
        if len(names) > 1:
            yield [*slides, x], [y for y in by_number if y != x]
    if both and len(both) == len(angles) > 1:
        yield by_number, []


def _mechanisms(letters: Letters, slides: Sequence[str], angles: Sequence[str]) -> Iterator[Bodies]:
    if not slides and len(angles) == 1:
        yield from pendulums(letters, angles[0])
    elif not slides:
        yield from chains(letters, angles)
    elif not angles:
        yield from sliders(letters, slides)
    elif len(slides) == 1 and len(angles) <= 2:
        yield from carts(letters, slides[0], angles)
        if len(angles) == 1:
            yield from elastic(letters, angles[0], slides[0])
            yield from supports(letters, slides, angles[0])
    elif len(slides) == 2 and len(angles) == 1:
        yield from supports(letters, slides, angles[0])
