# ruff: noqa: E501 -- patterns stand on one line
r"""An energy among words: the last thing that T, V, L or H is said to be, and the names that it needs."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ....models.errors import InvalidInput
from ..names import GREEK, spelling
from .displays import Statement
from .letters import Names, alone, is_abbreviation, spelled, unfonted, used, uses, written_alone
from .points import derived
from .sorting import PARTIAL, rooted

_FONT = r"(?:\\(?:mathcal|mathscr|mathrm|mathit|mathfrak|text|rm|operatorname)\s*)?"
_INDEX = r"(?:\s*_\s*(?:\{[^{}]{0,20}(?:\{[^{}]{0,12}\}[^{}]{0,6})?\}|\\?[A-Za-z]+))?"
_OF = r"\s*(?:\\left\s*)?(?:\([^=()]{0,200}(?:\([^=()]{0,40}\)[^=()]{0,80}){0,6}\))?\s*"
LEFT = {
    "kinetic": re.compile(rf"^\s*(?:{_FONT}\{{?\s*[TKEW]\s*\}}?{_INDEX}|KE|EK|E_?kin){_OF}$"),
    "potential": re.compile(rf"^\s*(?:{_FONT}\{{?\s*[UVEWP]\s*\}}?{_INDEX}|\\Pi|PE|EP|E_?pot){_OF}$"),
    "lagrangian": re.compile(rf"^\s*(?:{_FONT}\{{?\s*L\s*\}}?{_INDEX}|ℒ|𝓛|\\mathcal\s*L){_OF}$"),
    "hamiltonian": re.compile(rf"^\s*(?:{_FONT}\{{?\s*H\s*\}}?{_INDEX}|ℋ|\\mathcal\s*H){_OF}$"),
}
OTHERS = {"kinetic": re.compile(r"pot|_\s*\{?\s*p\b"), "potential": re.compile(r"kin|_\s*\{?\s*[kc]\b")}
WHOLE = re.compile(
    r"_\s*\{?\s*(?:\\?(?:text|mathrm|rm)\s*\{?\s*)?(?:k|p|c|K|P|kin|pot|kinetic|potential|tot|total|g|ges|s|sys)\b"
)
_LETTER = rf"{_FONT}\{{?\s*[TKEUVW]\s*\}}?{_INDEX}{_OF}"
SUMS = {
    "lagrangian": re.compile(
        rf"^\s*{_LETTER}\+\s*{_LETTER}$|^\s*{_FONT}\{{?\s*[UVW]\s*\}}?{_INDEX}{_OF}[-−]\s*{_LETTER}$"
    ),
    "hamiltonian": re.compile(rf"^\s*{_LETTER}[-−]\s*{_LETTER}$"),
}
MOST_DEFINITIONS = 30


@dataclass
class Energy:
    """What a field says: the value, names that it needs, and pairs of expressions that must be equal."""

    value: str = ""
    defined: dict[str, str] = field(default_factory=dict)
    steps: list[tuple[str, str]] = field(default_factory=list)
    positions: dict[str, str] = field(default_factory=dict)


MOTION, HEIGHT = re.compile(r"T|K|E_?k(?:in)?|KE|Ttot"), re.compile(r"V|U|E_?p(?:ot)?|PE|Vtot|Utot")


def energy(kind: str, statements: Sequence[Statement], names: Names) -> Energy:
    """What the statements of one field say. Raises InvalidInput where none says the energy, or more than is needed."""
    said, values, moved = _sorted(kind, [rooted(sides, names) for sides in statements], names)
    if kind == "lagrangian":  # T and V of a page that says L as well: their difference is what L must be
        said = [*(side for side in _difference(values) if said != [side]), *said]
    wrong = next((side for side in said[:-1] if kind in SUMS and SUMS[kind].match(side)), None)
    if wrong:
        raise InvalidInput(f"{wrong.strip()[:20]}: the Lagrangian is T - U, and the Hamiltonian T + U; which is meant? Where U "
                           "is a force's function, -V, leave this side out")  # fmt: skip
    found = Energy(said[-1])
    found.steps += [(sides[0], side) for sides in moved for side in sides[1:]]
    needed, texts = dict[str, None](), said + [side for sides in moved for side in sides]
    while texts:
        new = [name for name in values if name not in needed and uses(name, texts)]
        needed |= dict.fromkeys(new)
        texts = [side for name in new for side in values[name][1]]
    for name, (written, sides) in values.items():
        if name in needed:
            found.defined[written] = sides[-1]
            found.steps += [(side, sides[-1]) for side in sides[:-1] if _is_step(side, names, set(values))]
        elif re.fullmatch(r"[xyXY][1-9]?", name) and len(sides) == 1:
            found.positions[name] = sides[0]
        elif not _only_names(name, sides, names, set(values)) and not all(
            is_abbreviation(name, x, names) for x in sides
        ):
            raise InvalidInput(f"{written[:30]} = … is said, and the {kind} does not need it: leave it out, or give it in a "
                               "field of its own (positions, kinetic, potential)")  # fmt: skip
    found.steps += [(side, found.value) for side in said[:-1] if _is_step(side, names, set(values))]
    if len(found.defined) > MOST_DEFINITIONS:
        raise InvalidInput(f"more than {MOST_DEFINITIONS} names are said; put them in")
    return found


def _sorted(
    kind: str, statements: Sequence[Statement], names: Names
) -> tuple[list[str], dict[str, tuple[str, list[str]]], list[Statement]]:
    r"""All that the energy is said to be, and what names are: as they are written, and all that these are said to be.

    And what the rates of such names come to, \dot x_1 = …, which are steps.
    """
    said: list[str] = []
    moved: list[Statement] = []
    first = {alone(sides[0]) for sides in statements if len(sides) > 1}
    values: dict[str, tuple[str, list[str]]] = {}
    bare = any(len(sides) > 1 and _is_whole(kind, sides[0]) and not _has_index(sides[0]) for sides in statements)
    for sides in statements:
        if len(sides) == 1:
            continue
        name = alone(sides[0])
        whole = _is_whole(kind, sides[0]) and not (bare and _has_index(sides[0]))
        if whole and (name is None or name not in names.all):
            said += sides[1:]
        elif PARTIAL.search(" ".join(sides)):
            raise InvalidInput("a derivative of an energy: give the energy, and the equations in [equations]")
        elif name and name not in names.all:
            written, before = values.get(name, (written_alone(sides[0]), []))
            values[name] = (written, [*before, *sides[1:]])
        elif (of := derived(sides[0])) and of[0] in first and of[0] not in names.all:
            moved.append(sides)
        else:
            raise InvalidInput(
                f"{' = '.join(sides).strip()[:60]!r} is no name's value: give the energy, and what its letters are"
            )
    single = [sides[0] for sides in statements if len(sides) == 1]
    if kind == "lagrangian" and not said and not single:
        said = _difference(values)
    if not said and len(single) == 1:
        return single, values, moved
    if not said or single:
        raise InvalidInput(f"which of these is the {kind}{' energy' if kind in ('kinetic', 'potential') else ''}? Write it "
                           f"as {'TVLH'[list(LEFT).index(kind)]} = …")  # fmt: skip
    return said, values, moved


def _difference(values: Mapping[str, tuple[str, list[str]]]) -> list[str]:
    """T - V, where both are said and L is not; nothing else."""
    parts = [
        [written for name, (written, _) in values.items() if pattern.fullmatch(name)] for pattern in (MOTION, HEIGHT)
    ]
    return [" - ".join(part[0] for part in parts)] if all(len(part) == 1 for part in parts) else []


def _has_index(side: str) -> bool:
    return "_" in side.partition("(")[0]


def _only_names(name: str, sides: Sequence[str], names: Names, said: set[str]) -> bool:
    """Whether an energy is only named by others, as in L = T - V."""
    return side_is_energy(name) and not any(_is_step(side, names, said) for side in sides)


def side_is_energy(name: str) -> bool:
    """Whether a name is one of energies'."""
    return re.fullmatch(r"[TKUVELH]\w{0,4}", name) is not None


def _is_whole(kind: str, side: str) -> bool:
    """Whether a side names the energy itself, and not that of one body, T_1."""
    if not LEFT[kind].match(side):
        return False
    head = side.partition("(")[0]
    other = OTHERS.get(kind)
    if other and other.search(re.sub(r"\\[a-z]+", " ", head)):
        return False
    return "_" not in head or WHOLE.search(head) is not None


def _is_step(side: str, names: Names, defined: set[str]) -> bool:
    """Whether a side before the last is an expression that can be held against it; T - V only names things."""
    found = {x for x in used(side) if x not in ("d", "e")}
    if PARTIAL.search(side) or "\\sum" in side or "\\int" in side:
        return False
    unknown = {x for x in found if x not in names.all and x not in defined}
    known = {x for x in found if x in names.coordinates or x in names.quantities}
    if unknown and known and not _of_speeds(side, names):
        raise InvalidInput(f"{side.strip()[:40]!r}: {', '.join(sorted(unknown))[:40]} is not known; say what it is, or leave "
                           "this step out")  # fmt: skip
    return not unknown


def _of_speeds(side: str, names: Names) -> bool:
    """Whether it is a sum of ½ m v², ½ m (ẋ² + ẏ²) or m g y, whose speeds and heights only have names here."""
    low = r"(?:_?\{?[0-9A-Za-z]{1,3}\}?)?"
    two = r"(?:\^\{?2\}?|²)"
    half = r"(?:\\[dt]?frac\{?1\}?\{?2\}?|½|1/2|\(1/2\)|\{1\\over2\})"
    bare = re.sub(r"\\left|\\right|\\[,;:! ]|\\cdot|·|\*|\s", "", unfonted(side))
    masses = "|".join(spelling(q).pattern for q in names.quantities if re.match(r"[mM]", q)) or "m"
    bar = r"(?:\\[lr]?[vV]ert|\\\||\|)"
    whole = rf"(?:\\dot\{{{{0,2}}[rRpP]\}}{{0,2}}{low}\}}?|[vVu]{low})"
    square = rf"(?:[vVu]{low}{two}|[vVu]{two}{low}|{bar}{whole}{bar}{two}|{whole}{two})"
    dotted = r"\\dot(?:\{\s*[xyz](?:_\{?\w\}?)?\}|[xyz])(?:_\{?\w\}?)?"
    both = rf"[(\[](?:{dotted}{two}\+{dotted}{two}|v{low}{two}\+v{low}{two})[)\]]"
    motion = rf"{half}(?:{masses})(?:{square}|{both})"
    height = rf"(?:{masses})g[yhz]{low}"
    return any(re.fullmatch(rf"{sign}{part}(?:\+{part}){{0,7}}", bare) for sign, part in (("", motion), ("-?", height)))


def evident_rates(texts: Sequence[str], names: Names) -> dict[str, str]:
    r"""ω_1 for \dot θ_1 where no text has rates otherwise: an energy of motion has some."""
    joined = "\n".join(texts)
    angles = [c for c, slide in zip(names.coordinates, names.slides, strict=True) if not slide]
    if re.search(r"\\dot|[\u0307]|(?<=[\w}])['′](?!['′])", joined) or (names.relative and len(angles) > 1):
        return {}
    found: dict[str, str] = {}
    for c in angles:
        index = re.search(r"[0-9A-Za-z]?$", c[len(_base(c)) :])
        name = "omega" + c[len(_base(c)) :]
        if index is None or name in names.all:
            return {}
        if spelling(name).search(joined):
            written = "\\omega" + (f"_{{{c[len(_base(c)) :]}}}" if c[len(_base(c)) :] else "")
            found[written] = f"\\dot{{{spelled(c)}}}"
    return found if len(found) == len(angles) and len(angles) == len(names.coordinates) else {}


def _base(name: str) -> str:
    return next((w for w in sorted(GREEK, key=len, reverse=True) if name.startswith(w)), name[:1])
