"""Whether all terms of an equation have the same units: what a teacher looks at first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ...algebra.notation import SUPERSCRIPTS, pretty, text
from ...algebra.signs import signs_in
from ...algebra.trig import Formula, Space, digits
from ...algebra.trig import unit as unit_at
from ...reading.submission import Submission
from ...steps.declared import Declared, Joined
from ..differences import authors
from ..hypotheses import Said

Units = tuple[int, int, int]  # powers of kg, m and s
NONE: Units = (0, 0, 0)
LENGTH, MASS = (0, 1, 0), (1, 0, 0)
NAMES: dict[Units, tuple[str, str]] = {
    (1, 1, -2): ("a force", "力"), (1, 2, -2): ("a torque or an energy", "トルクまたはエネルギー"),
    (0, 1, -2): ("an acceleration", "加速度"), (0, 0, -2): ("an angular acceleration", "角加速度"),
    (0, 1, -1): ("a velocity", "速度"), (0, 0, -1): ("an angular rate", "角速度"), NONE: ("a number", "無次元"),
}  # fmt: skip
MOST_SHOWN = 80  # characters of the terms that are named


def units_notes(s: Submission) -> list[Said]:
    """One remark for each equation whose terms do not have one unit; none where that cannot be told.

    Where no length or no g is written, they may be meant as one, and nothing is said.
    """
    letters = {letter for letter, _ in s.used}
    if s.mechanism is None and not {"l", "g"} <= letters:
        return []
    known = _known(s)
    notes = []
    for where, wo, f in _formulas(s):
        found = {key: _units(s.space, key[0], known) for key in f.terms}
        if None in found.values():
            continue
        counts = Counter(found.values())
        if len(counts) < 2:
            continue
        usual, most = counts.most_common(1)[0]
        if 2 * most <= len(found) or usual is None:
            continue
        odd = Formula({key: c for key, c in f.terms.items() if found[key] != usual})
        shown = pretty(authors(s, text(s.space, odd)))
        others = {found[key] for key in odd.terms}
        (unit,) = others if len(others) == 1 else (None,)
        (en, ja), (usual_en, usual_ja) = _said(unit), _said(usual)
        shown = shown if len(shown) <= MOST_SHOWN else shown[:MOST_SHOWN] + " …"
        notes.append((f"Units do not fit in {where}: {shown} is {en}, the other terms are {usual_en}.",
                      f"{wo}の単位が合いません：{shown} は{ja}、ほかの項は{usual_ja}です。"))  # fmt: skip
    return notes


def _formulas(s: Submission) -> Iterator[tuple[str, str, Formula]]:
    """What is written, with where in English and Japanese."""
    if s.first_order is not None:
        if s.first_order.hamiltonian is None:
            for label, f in (*s.first_order.relations, *s.first_order.slopes):
                yield f"row {label}", f"第{label}行", f
        return
    if s.stages is not None:
        for name, part in (("T", s.stages.kinetic), ("U", s.stages.potential), ("L", s.stages.lagrangian)):
            if part is not None:
                yield name, f" {name} ", part
        for table in (s.stages.positions, s.stages.velocities):
            for (axis, b), part in table.items():
                yield f"{axis}{b + 1}", f" {axis}{b + 1} ", part
    if s.lagrangian is not None:
        yield "the Lagrangian", "ラグランジアン", s.lagrangian
    for label, f in (*s.rows, *(s.stages.equations if s.stages else ()), *(s.stages.solved if s.stages else ())):
        yield f"row {label}", f"第{label}行", f


def _units(space: Space, e: int, known: dict[int, Units]) -> Units | None:
    total = [0, 0, 0]
    for place, power in enumerate(digits(e, space.symbol_count)):
        if not power:
            continue
        unit = known.get(place)
        if unit is None:
            return None
        total = [x + power * y for x, y in zip(total, unit, strict=True)]
    return total[0], total[1], total[2]


def _known(s: Submission) -> dict[int, Units]:
    """The units of all symbols that are known, by place."""
    space, n = s.space, s.space.n
    slides = [
        s.mechanism is not None and body.slide is not None for body in (s.mechanism.bodies if s.mechanism else ())
    ]
    slides = slides or [False] * n
    known: dict[int, Units] = {4 * n: (0, 1, -2), 4 * n + 1: (1, -1, 0)}
    for k, slide in enumerate(slides):
        own = LENGTH if slide else NONE
        known |= {k: _times(own, (0, 0, -2)), n + k: _times(own, (0, 0, -1)), 2 * n + k: LENGTH, 3 * n + k: MASS,
                  4 * n + 2 + k: own}  # fmt: skip
        if s.first_order is not None:  # action over the coordinate
            at = s.first_order.at
            momentum = (1, 1, -1) if slide else (1, 2, -1)
            known |= {at.momenta[k]: momentum, at.slopes[k]: _times(momentum, (0, 0, -1))}
    known |= dict.fromkeys(signs_in(space), NONE)
    if s.mechanism is None:
        for k in range(n):
            known |= {space.names.index(f"I{k + 1}"): (1, 2, 0), space.names.index(f"lc{k + 1}"): LENGTH}
        return known
    return _own(space, s.mechanism, known)


def _own(space: Space, mechanism: Declared, known: dict[int, Units]) -> dict[int, Units]:
    """With the author's own symbols, as far as their places in the mechanism tell."""
    fields = [pair for body in mechanism.bodies for pair in _fields(body)]
    for _ in range(len(fields) + 1):
        before = len(known)
        for f, unit in fields:
            for e in {e for e, _, _ in f.terms}:
                powers = {place: power for place, power in enumerate(digits(e, space.symbol_count)) if power}
                unknown = [place for place in powers if place not in known]
                if len(unknown) == 1 and powers[unknown[0]] == 1:
                    rest = _units(space, e - unit_at(unknown[0]), known)
                    if rest is not None:
                        known[unknown[0]] = _times(unit, rest, -1)
        if len(known) == before:
            break
    return known


def _fields(body: Joined) -> list[tuple[Formula, Units]]:
    force = (1, 1, -2) if body.slide is not None else (1, 2, -2)
    own = LENGTH if body.slide is not None else NONE
    fields = [(body.friction, force),
              (body.mass, MASS), (body.length, LENGTH), (body.centre, LENGTH), (body.inertia, (1, 2, 0)),
              (body.stiffness, _times(force, own, -1)), (body.rest, own), (body.drive, force),
              (body.damping, _times(force, _times(own, (0, 0, -1)), -1))]  # fmt: skip
    return fields if body.at is None else [*fields, (body.at, LENGTH)]


def _times(one: Units, other: Units, sign: int = 1) -> Units:
    return one[0] + sign * other[0], one[1] + sign * other[1], one[2] + sign * other[2]


def _said(unit: Units | None) -> tuple[str, str]:
    if unit is None:
        return "of other units", "別の単位"
    if unit in NAMES:
        return NAMES[unit]
    parts = [name + (str(power).translate(SUPERSCRIPTS) if power != 1 else "")
             for name, power in zip(("kg", "m", "s"), unit, strict=True) if power]  # fmt: skip
    return "in " + " ".join(parts), " ".join(parts)
