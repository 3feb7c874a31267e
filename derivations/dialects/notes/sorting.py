# ruff: noqa: E501 -- patterns stand on one line
r"""What the statements of a note are: equations of motion, what a name is, a rate's name, steps that must be equal."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

from ....models.errors import InvalidInput
from ..names import plain_name, spelling
from .displays import Statement
from .letters import NAME, Names, alone, is_abbreviation, used, uses, written_alone
from .partial import is_law
from .points import derived, named_rate

RATE = re.compile(r"\\d?dot|''|'|″|[\u0307\u0308]|\\frac\{d\}\{dt\}")
ACCELERATION = re.compile(r"\\ddot|''|″|\u0308|\\frac\{d\}\{dt\}")
PARTIAL = re.compile(r"\\partial|∂|\\nabla|\\int(?![A-Za-z])")
SQUARED = re.compile(rf"^\s*(?P<name>{NAME})\s*(?:\^\s*(?:\{{\s*2\s*\}}|2)|²)\s*$")
MATRIX = re.compile(r"matrix\}|array\}")
ZERO = re.compile(r"^\s*(?:0|\\mathbf\s*\{?0\}?|\\vec\s*\{?0\}?)\s*$")
MOST_DEFINITIONS = 30
Values = dict[str, tuple[str, Statement]]


@dataclass
class Sorted:
    """Rows and definitions as they were written; ``steps``: pairs of expressions that must be equal."""

    rows: list[str] = field(default_factory=list)
    defined: dict[str, str] = field(default_factory=dict)
    steps: list[tuple[str, str]] = field(default_factory=list)
    partial: list[Statement] = field(default_factory=list)  # what a derivative of the Lagrangian is
    stages: dict[str, Any] = field(default_factory=dict)  # positions and energies that no row needs
    passed: list[str] = field(default_factory=list)  # what names are said to be that nothing needs


def sorted_statements(statements: Sequence[Statement], names: Names) -> Sorted:
    """Statements of equations of motion, sorted. Raises InvalidInput where one is neither."""
    sorter = _Sorter(names)
    statements = [rooted(sides, names) for sides in _once(statements)]
    first = {alone(sides[0]) for sides in statements}
    for sides in statements:
        sorter.take(sides, first)
    said = {*sorter.values, *(plain_name(name) or name for name in sorter.found.defined)}
    sorter.left = _without_abstract(sorter.left, said, names)
    sorter.left = [sides for sides in sorter.left if not _is_derived(sides, sorter.values, sorter.found)]
    sorter.partials()
    sorter.rows_of_drives()
    sorter.definitions()
    for sides in sorter.left:
        if _is_product(sides, sorter.values):
            sorter.found.steps += pairwise(sides)
        else:
            _sort_row(sides, sorter.found)
    _require_rows(sorter.found, names)
    return sorter.found


def _require_rows(found: Sorted, names: Names) -> None:
    """Raises InvalidInput where something is passed over and rows are missing: it may be meant as one."""
    whole = len(found.rows) >= len(names.coordinates) or any(MATRIX.search(row) for row in found.rows)
    if found.passed and not whole and not found.partial:
        raise InvalidInput(
            f"{found.passed[0].partition(' = ')[0][:30]} = … is said, and no equation needs it: leave it out, or give it "
            "in a field of its own (positions, kinetic, potential, lagrangian)"
        )


class _Sorter:
    """``values``: names that stand alone on a left side, plain: as written, and all that they are said to be."""

    def __init__(self, names: Names) -> None:
        self.names, self.found = names, Sorted()
        self.values: Values = {}
        self.left: list[Statement] = []

    def take(self, sides: Statement, first: set[str | None]) -> None:
        """A rate's name, what a name is, or another equation. ``first``: what stands alone on left sides."""
        rate = named_rate(sides, self.names)
        if rate and rate[0] not in self.names.all:
            self._name_rate(*rate)
            return
        name, turned = alone(sides[0]), alone(sides[1])
        is_turned = name is None and turned is not None and turned not in self.names.all and turned not in first
        if len(sides) == 2 and is_turned and not ACCELERATION.search(sides[0]):  # … = Δ
            sides, name = sides[::-1], turned
        if name is None or name in self.names.all:
            self.left.append(sides)
            return
        if name == "L" and "L" not in self.values and uses("L", sides[1:]) and RATE.search(sides[-1]):
            _put_stage(name, sides, self.found)  # the Lagrangian, of a mechanism with a length L
            return
        before = self.values[name][1] if name in self.values else ()
        self.values[name] = (written_alone(sides[0]), (*before, *sides[1:]))

    def _name_rate(self, name: str, written: str, rate: str) -> None:
        before = next((value for key, value in self.found.defined.items() if plain_name(key) == name), None)
        if before is None:
            self.found.defined[written] = rate
        else:
            self.found.steps.append((before, rate))

    def _others(self, name: str) -> list[str]:
        """All that is said besides what this name is."""
        sides = [x for other, (_, x) in self.values.items() if other != name]
        return [" ".join(x) for x in (*self.left, *sides)]

    def partials(self) -> None:
        """p = ∂L/∂q̇ = …: what the derivative is, and the name where it is used."""
        for name, (written, sides) in list(self.values.items()):
            if len(sides) > 1 and any(PARTIAL.search(side) for side in sides):
                self.found.partial.append(sides)
                self.values[name] = (written, sides[-1:])
                if not uses(name, self._others(name)):
                    del self.values[name]

    def rows_of_drives(self) -> None:
        """τ = M q̈ + …, which is a row though a name stands alone."""
        for name, (written, sides) in list(self.values.items()):
            if ACCELERATION.search(sides[-1]) and not uses(name, self._others(name)):
                self.left.append((written, *sides))
                del self.values[name]

    def definitions(self) -> None:
        """What names are, those that equations or stages need; others are passed over."""
        # a law of derivatives of L needs no L: what L is said to be is judged as a stage
        texts = [side for sides in self.left for side in sides if not PARTIAL.search(side)]
        needed = _needed(texts, self.values)
        stages = {name for name, (_, sides) in self.values.items() if name not in needed and _stage(name, sides)}
        stages = {name for name in stages if not self._is_of_names_alone(self.values[name][1])}
        below = _needed([" ".join(self.values[name][1]) for name in stages], self.values)
        for name, (written, sides) in self.values.items():
            if name in needed | below:
                self.found.defined[written] = sides[-1]
            elif name not in stages and not all(
                is_abbreviation(name, side, self.names) or _is_beside(name, side, needed | below, self.names)
                for side in sides
            ):
                self.found.passed.append(" = ".join((written, *sides)))
                continue
            if name in stages:
                _put_stage(name, sides, self.found)
            known = set(self.values)
            self.found.steps += [(side, sides[-1]) for side in sides[:-1] if _is_step(side, self.names, known)]
        if len(self.found.defined) > MOST_DEFINITIONS:
            raise InvalidInput(f"more than {MOST_DEFINITIONS} names are said; give the equations with these put in")

    def _is_of_names_alone(self, sides: Statement) -> bool:
        """Whether L = T - V says no more than these names, of which none is said."""
        found = {name for side in sides for name in used(side)}
        return bool(found) and not found & (self.names.all | self.values.keys())


def _is_product(sides: Statement, values: Values) -> bool:
    r"""C(q, \dot q) \dot q = a column: what a product of a matrix that is said comes to, and no row."""
    if any(ACCELERATION.search(side) for side in sides) or not MATRIX.search(sides[-1]):
        return False
    matrices = [name for name, (_, said) in values.items() if MATRIX.search(said[-1])]
    return any(uses(name, [sides[0]]) for name in matrices)


def _is_beside(name: str, side: str, needed: set[str], names: Names) -> bool:
    """Whether a constant is said beside its like, l_{c1} with the l_{c2} that rows need, or is a matrix of numbers."""
    like = re.sub(r"[0-9]+$", "", name)
    numbers = MATRIX.search(side) and not used(re.sub(r"\\(?:begin|end)\s*\{[a-z]+\}", " ", side))
    return bool(numbers) or (
        like != name and _is_constant(side, names) and any(re.sub(r"[0-9]+$", "", x) == like for x in needed)
    )


def _is_constant(side: str, names: Names) -> bool:
    """Whether it is made of the mechanism's own quantities and numbers."""
    found = used(re.sub(r"\\(?:begin|end)\s*\{[a-z]+\}", " ", side))
    return all(x in names.quantities and x not in names.coordinates for x in found) and not RATE.search(side)


def _without_abstract(left: list[Statement], said: set[str], names: Names) -> list[Statement]:
    r"""Without M q̈ + h = τ or Σ F = m a of letters that nobody says, where there are rows enough besides."""
    abstract = [sides for sides in left if is_abstract(sides, said, names)]
    rows = [sides for sides in left if sides not in abstract]
    enough = len(rows) >= len(names.coordinates) or any(
        MATRIX.search(" ".join(row)) and ACCELERATION.search(" ".join(row)) for row in rows
    )
    return rows if enough else left


def is_abstract(sides: Statement, said: set[str], names: Names) -> bool:
    """Whether an equation has no coordinate, no number, and a letter that nobody says what it is."""
    text = " ".join(sides)
    if (
        any(spelling(c).search(text) for c in names.coordinates)
        or re.search(r"(?<![_^{])[1-9]", text)
        or PARTIAL.search(text)
    ):
        return False
    return any(x not in names.all and x not in said and x not in ("d", "e") for x in used(text))


def _needed(texts: list[str], values: Values) -> set[str]:
    """The names that these texts need, and those that these need in turn."""
    found: set[str] = set()
    while True:
        new = {name for name in values if name not in found and uses(name, texts)}
        if not new:
            return found
        found |= new
        texts = [" ".join(values[name][1]) for name in new]


def _is_derived(sides: Statement, values: Values, found: Sorted) -> bool:
    r"""\dot x_1 = … where x_1 itself is said: a step, which must be equal."""
    own = (derived(sides[0]) or ("", 0))[0]
    if own not in values:
        return False
    found.steps += [(sides[0], side) for side in sides[1:]]
    found.defined.setdefault(values[own][0], values[own][1][-1])
    return True


STAGES = (
    ("positions", re.compile(r"[xyXY][1-8]?")), ("velocities", re.compile(r"v[1-9]?")),
    ("kinetic", re.compile(r"T|K|Ek|Ekin|KE|Ttot|Ec")), ("potential", re.compile(r"V|U|Ep|Epot|PE")), ("lagrangian", re.compile(r"L")),
)  # fmt: skip


def _stage(name: str, sides: Statement) -> str:
    """The field of a name that no row needs; an empty text for none."""
    stage = next((stage for stage, pattern in STAGES if pattern.fullmatch(name)), "")
    moves = RATE.search(sides[-1]) is not None
    fits = {"positions": not moves, "velocities": "\\sqrt" in sides[-1], "potential": not moves}
    return stage if fits.get(stage, True) and not ACCELERATION.search(sides[-1]) else ""


def _put_stage(name: str, sides: Statement, found: Sorted) -> None:
    stage = _stage(name, sides)
    if stage == "positions":
        found.stages.setdefault(stage, {})[name] = sides[-1]
    elif stage == "velocities":
        found.stages.setdefault(stage, {})[f"{name}^2"] = re.sub(r"^\\sqrt\{(.*)\}$", r"\1", sides[-1])
    else:
        found.stages[stage] = sides[-1]


def _once(statements: Sequence[Statement]) -> list[Statement]:
    """Each statement once, as a page repeats what it has said."""
    seen: dict[str, Statement] = {}
    for sides in statements:
        if len(sides) == 1:
            raise InvalidInput(f"{sides[0].strip()[:40]!r} has no equals sign: give each equation with both its sides")
        seen.setdefault(re.sub(r"\s|\\[,;:! ]", "", "=".join(sides)), sides)
    return list(seen.values())


def rooted(sides: Statement, names: Names) -> Statement:
    r"""ω_0^2 = g/l as what ω_0 is: a root, of which squares alone are read."""
    found = SQUARED.match(sides[0]) if len(sides) == 2 else None
    name = plain_name(found["name"]) if found else None
    if found is None or name is None or name in names.all:
        return sides
    return (found["name"], f"\\sqrt{{{sides[1]}}}")


def _sort_row(sides: Statement, found: Sorted) -> None:
    """A row, or a chain of them: every side that is plain is equal to the last."""
    partial = [side for side in sides if PARTIAL.search(side)]
    plain = [side for side in sides if not PARTIAL.search(side)]
    law = bool(partial) and is_law(sides)
    if law and all(ZERO.match(side) or alone(side) for side in plain):
        return  # the law itself
    if partial and not law and len(plain) < 2:
        found.partial.append(sides)
        return
    if partial and not law:
        raise InvalidInput(f"{partial[0].strip()[:40]!r}: a derivative of the Lagrangian; write what it comes to, and leave "
                           "out the rest")  # fmt: skip
    found.rows += [f"{one} = {two}" for one, two in pairwise(plain)]


def _is_step(side: str, names: Names, defined: set[str]) -> bool:
    r"""Whether a side between says something that is known: not T - V, nor \dot M - F, which only name things."""
    found = used(side)
    if PARTIAL.search(side):
        raise InvalidInput(f"{side.strip()[:40]!r}: a derivative of the Lagrangian; write what it comes to")
    unknown = {x for x in found if x not in names.all and x not in defined and not _is_word(x)}
    known = {x for x in found if x in names.coordinates or x in names.quantities}
    if unknown and known:
        raise InvalidInput(f"{side.strip()[:40]!r}: {', '.join(sorted(unknown))[:40]} is not known; say what it is, or leave "
                           "this step out")  # fmt: skip
    return not unknown


def _is_word(name: str) -> bool:
    return name in ("d", "t", "e", "pi")
