"""Why a user's own equations and the mechanism of a model file differ: what is different in the one or in the other.

One hypothesis after another; each is named only if with it the accelerations are the same in all states.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations, product

import numpy as np

from ...models.errors import InvalidInput
from ...models.trees.own import IN_MODEL
from ...models.trees.system import TreeSystem
from ..algebra.signs import switches
from ..algebra.trig import Formula
from .coordinates import coordinates_in, other_conventions
from .graded import wrong_terms
from .quantities import Quantity, joint_unit
from .reading import RobotDerivation
from .rows import SAME, Floats, TrueTerms, alignment, rows_same, same, true_terms

KINDS = {"m": ("mass",), "M": ("mass",), "l": ("length", "centre"), "L": ("length", "centre"), "r": ("centre",),
         "a": ("centre", "length"), "I": ("inertia",), "J": ("inertia",), "b": ("damping",), "c": ("damping",),
         "d": ("damping",), "k": ("stiffness",)}  # fmt: skip
MOST_PAIRS = 400  # of two constants with other values
PASSIVE = {"damping": "damping", "armature": "armature", "stiffness": "a spring"}


@dataclass(frozen=True)
class Reason:
    """``in_model``: the equations are right for another mechanism than the model file's; else they are wrong.

    ``cause``: a code of the grader's or of ``furiko diagnose``; ``measured``: what is there, ``expected``: what would
    have to be, numbers in SI units or formulas.
    """

    in_model: bool
    cause: str
    where: str
    measured: float | str | None
    expected: float | str | None
    says: str


def reasons(d: RobotDerivation, system: TreeSystem, true: TrueTerms) -> list[Reason]:
    """Why the equations do not give the mechanism's accelerations, the first that explains all; never empty."""
    smooth = _without_friction(d)
    if smooth is not d:
        right = _right(smooth, true)
        says = ("the equations have dry friction, and the truth that they are held against is that of the model "
                "without it" + ("; without it they are right" if right else ""))  # fmt: skip
        reason = Reason(True, "dry-friction", "equations", None, None, says)
        return [reason] if right else [reason, *reasons(smooth, system, true)]
    return (
        _numbers(d, true) or _left_out(d, system, true) or _convention(d, true) or _graded(d) or _terms(d, system, true)
    )


def _without_friction(d: RobotDerivation) -> RobotDerivation:
    """The same without all terms with the sign of a rate; itself, where it has none."""
    space = d.submission.space
    if not any(switches(space, e) for row in d.rows for e, _, _ in row.terms):
        return d
    rows = [Formula({key: c for key, c in row.terms.items() if not switches(space, key[0])}) for row in d.rows]
    labelled = tuple((label, row) for (label, _), row in zip(d.submission.rows, rows, strict=False))
    return replace(d, rows=tuple(rows), submission=replace(d.submission, rows=labelled))


def _right(d: RobotDerivation, true: TrueTerms, values: dict[str, float] | None = None) -> bool:
    try:
        return rows_same(d.motion(values).accelerations(true.q, true.v), true.accelerations)
    except InvalidInput:
        return False


def _numbers(d: RobotDerivation, true: TrueTerms) -> list[Reason]:
    """Constants that the user gave, with the model file's values in their place."""
    choices = {
        name: [q for q in d.quantities if q.kind in KINDS.get(name[:1], ()) and _differ(q.value, value)]
        for name, value in d.values.items()
        if name not in d.inferred
    }
    for count in (1, 2):
        tried = 0
        for names in combinations([name for name in choices if choices[name]], count):
            for there in product(*(choices[name] for name in names)):
                tried += 1
                if tried > MOST_PAIRS:
                    return []
                if _right(d, true, {name: q.value for name, q in zip(names, there, strict=True)}):
                    return [_other_number(name, d.values[name], q) for name, q in zip(names, there, strict=True)]
    return []


def _differ(one: float, other: float) -> bool:
    return abs(one - other) > SAME * max(abs(one), abs(other))


def _other_number(name: str, value: float, q: Quantity) -> Reason:
    unit = q.unit
    says = (f"the equations are right, and {q.words} is {q.value:.9g} {unit} in the model, where {name} is "
            f"{value:.9g} {unit} in the equations")  # fmt: skip
    return Reason(True, q.kind if q.kind != "centre" else "com-displaced", f"{IN_MODEL}{q.of!r}", q.value, value, says)


def _left_out(d: RobotDerivation, system: TreeSystem, true: TrueTerms) -> list[Reason]:
    """What the mechanism has and the equations have not."""
    mine = d.motion().accelerations(true.q, true.v)
    for changed, what in _without(system, true):
        if rows_same(mine, _accelerations(changed, true)):
            return [
                Reason(True, cause, f"{IN_MODEL}{of!r}", value, 0.0,
                       f"the model has {words} at {of!r} ({value:.9g} {unit}), and the equations, which are right "
                       "without it, have none")
                for cause, of, value, words, unit in what
            ]  # fmt: skip
    return []


Had = tuple[str, str, float, str, str]  # cause, joint or link, value, words, unit


def _without(system: TreeSystem, true: TrueTerms) -> Iterator[tuple[TreeSystem, list[Had]]]:
    """The mechanism with some of it left out that matters, the least first; and what was."""
    there: list[tuple[str, int, int]] = []
    for i, link in enumerate(system.links):
        there += [(name, i, j) for j, joint in enumerate(link.joints) for name in PASSIVE if getattr(joint, name)]
        there += [("inertia", i, -1)] if any(link.inertia) else []
    there = [x for x in there if not rows_same(_accelerations(_stripped(system, [x]), true), true.accelerations)]
    kinds = [[x for x in there if x[0] == kind] for kind in (*PASSIVE, "inertia")]
    passive = [x for x in there if x[0] != "inertia"]
    chosen = [[x] for x in there] + [group for group in (*kinds, passive, there) if len(group) > 1]
    for group in chosen:
        yield _stripped(system, group), [_had(system, *x) for x in group]


def _had(system: TreeSystem, kind: str, i: int, j: int) -> Had:
    link = system.links[i]
    if kind == "inertia":
        return "inertia", link.name, max(link.inertia[:3]), "a moment of inertia", "kg m²"
    joint = link.joints[j]
    return kind, joint.name, getattr(joint, kind), PASSIVE[kind], joint_unit(kind, joint)


def _stripped(system: TreeSystem, group: list[tuple[str, int, int]]) -> TreeSystem:
    links = list(system.links)
    for kind, i, j in group:
        if kind == "inertia":
            links[i] = replace(links[i], inertia=(0.0,) * 6)
        else:
            joints = list(links[i].joints)
            joint = joints[j]
            kept = {name: 0.0 if name == kind else getattr(joint, name) for name in PASSIVE}
            joints[j] = replace(joint, damping=kept["damping"], armature=kept["armature"], stiffness=kept["stiffness"])
            links[i] = replace(links[i], joints=tuple(joints))
    return replace(system, links=tuple(links))


def _accelerations(system: TreeSystem, true: TrueTerms) -> Floats:
    try:
        return true_terms(system.mechanism(), true.q, true.v).accelerations
    except ArithmeticError:  # what was left out was all that a joint moves
        return np.full_like(true.accelerations, np.inf)


def _convention(d: RobotDerivation, true: TrueTerms) -> list[Reason]:
    """Angles counted in another way, where the file does not say how."""
    if d.plane is None or d.own.declares_angles:
        return []
    for convention in other_conventions(d.plane):
        try:
            motion = d.motion(coordinates=coordinates_in(d.plane, convention))
            found = motion.accelerations(true.q, true.v)
        except InvalidInput:
            return []
        if rows_same(found, true.accelerations):
            senses = ["clockwise" if s < 0 else "counter-clockwise" for s in convention.senses]
            sense = f'"{senses[0]}"' if len(set(senses)) == 1 else str(senses).replace("'", '"')
            declared = f'from = "{convention.origin}", sense = {sense}'
            if len(d.plane.bodies) > 1:
                declared = f'angles = "{"relative" if convention.relative else "absolute"}", ' + declared
            says = (f"they are right if {convention.words}, and not in the joints' own coordinates; if that is meant, "
                    f"write {declared}")  # fmt: skip
            otherwise = [said for *_, said in wrong_terms(d)]
            says += f"; if not: {otherwise[0]}" if otherwise else ""
            return [Reason(False, "angle-convention", "equations", "joint coordinates", convention.words, says)]
    return []


def _graded(d: RobotDerivation) -> list[Reason]:
    """What the grader says of them, in the author's own letters."""
    return [
        Reason(False, cause, f"equations, row {row}" if row else "equations", found, expected, says)
        for cause, row, found, expected, says in wrong_terms(d)
    ]


def _terms(d: RobotDerivation, system: TreeSystem, true: TrueTerms) -> list[Reason]:
    """The terms that differ, in numbers."""
    motion = d.motion()
    scale = alignment(motion, true)
    if scale is None:
        says = "no row of them is, up to a factor, a right one in half of its terms"
        return [Reason(False, "unexplained", "equations", None, None, says)]
    matrix, rest = motion.floats(true.q, true.v)
    matrix, rest = scale @ matrix, rest @ scale.T
    found = []
    for i, name in enumerate(system.freedoms):
        columns = [(f"the acceleration of {other!r}", matrix[:, i, j], true.mass_matrix[:, i, j])
                   for j, other in enumerate(system.freedoms)]  # fmt: skip
        parts = [(words, rest[:, k, i], true.rest[:, k, i]) for k, words in
                 enumerate(("the squared rates", "gravity", "dampers and springs"))]  # fmt: skip
        found += [_term(name, *column) for column in (*columns, *parts) if not same(*column[1:])]
    return found or [Reason(False, "unexplained", "equations", None, None, "their terms are right, their sum is not")]


def _term(name: str, words: str, given: Floats, right: Floats) -> Reason:
    where = f"equations, the row of {name!r}"
    start = f"in the row of {name!r} the term of {words}"
    if not given.any():
        return Reason(False, "term-missing", where, None, None, f"{start} is missing")
    there = np.abs(right) > 0
    ratios = given[there] / right[there]
    if there.all() and same(ratios, np.full_like(ratios, ratios[0])):
        factor = float(ratios[0])
        cause = {-1.0: "sign", 2.0: "factor-two", 0.5: "factor-half"}.get(round(factor, 9), "term-wrong")
        says = f"{start} has the wrong sign" if cause == "sign" else f"{start} is {factor:.9g} times the right one"
        return Reason(False, cause, where, factor, 1.0, says)
    return Reason(False, "term-wrong", where, None, None, f"{start} is another than the right one")
