"""The grader asked about equations of a model file's mechanism, where it can be said in the author's own letters."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

from flint import fmpq

from ..algebra.trig import NOTHING, Formula, constant
from ..grading.grade import graded
from ..reading.submission import Submission
from ..steps.conventions import Convention
from ..steps.declared import Along, Declared, Joined
from ..steps.mechanism import QUARTERS, Origin
from .plane import PARALLEL, Plane
from .quantities import Quantity
from .reading import RobotDerivation

FOUND = tuple[str, str, str, str, str]  # cause, row, found, expected, sentence
KINDS = {"mass": "mM", "length": "lL", "centre": "lLra", "inertia": "IJ", "damping": "bcd", "stiffness": "k"}
SLIDES: dict[tuple[float, float], Along] = {(1.0, 0.0): "right", (0.0, 1.0): "up", (0.0, -1.0): "down"}


def wrong_terms(d: RobotDerivation) -> list[FOUND]:
    """The wrong terms or mistakes that the grader names; none where the mechanism has no letters of the author's."""
    mechanism = _declared(d)
    convention = None if mechanism is None or d.plane is None else _convention(d, d.plane)
    if mechanism is None or convention is None:
        return []
    submission = replace(d.submission, mechanism=mechanism, convention=convention)
    if d.own.function:
        submission = replace(submission, lines=tuple((label, "") for label, _ in submission.rows))

    def read(slashes: int) -> Submission:
        return submission

    grade, _ = graded(read, pinned=True)
    if grade.verdict != "wrong":
        return []
    if grade.mistakes:
        return [(m.cause, "", "", "", m.says) for m in grade.mistakes]
    return [(f.cause, f.row, f.found, f.expected, f.says) for f in grade.findings]


def _declared(d: RobotDerivation) -> Declared | None:
    """The mechanism with the author's symbols for the file's numbers; None where some number has no symbol."""
    plane, space = d.plane, d.submission.space
    if plane is None or not plane.gravity:
        return None
    symbols = _symbols(d)
    places = set().union(*map(space.places, d.rows))
    used = {name for name in d.values if space.own_place(name) in places}
    if not used <= set(symbols.values()):
        return None

    def formula(kind: str, k: int, value: float) -> Formula:
        name = symbols.get((kind, k))
        if name is not None and value >= 0:
            return space.own(name)
        return _decimal(value)

    bodies = [_joined(d, plane, k, formula) for k in range(space.n)]
    made = tuple(body for body in bodies if body is not None)
    return Declared(space, made, d.names) if len(made) == len(bodies) else None


def _joined(d: RobotDerivation, plane: Plane, k: int, formula: Callable[[str, int, float], Formula]) -> Joined | None:
    """One body as the grader has them; None where its mass is beside its line, or it slides another way."""
    body, joint = plane.bodies[k], plane.bodies[k].joint
    before = plane.hinges(body.parent)
    line = plane.reaches(k if body.turns else before[-1]) if body.turns or before else (0.0, 0.0)
    along = None if body.turns else _slide(body.slide, line if before else None)
    if line is None or joint.armature or (along is None) != body.turns:
        return None
    centre: float | None = 0.0
    way: float | None = 0.0
    if body.mass and any(line):
        centre = _along(line, body.centre, body.anchor)
    if before:
        carrier = plane.bodies[body.parent]
        way = _along(plane.reaches(before[-1]) or (0.0, 0.0), body.anchor, carrier.anchor)
        if way is not None and not body.turns:
            way -= joint.ref  # its coordinate is the distance, if there is nothing else
        if not carrier.turns and way:
            return None
    slack = _slack(d, plane, k)
    if centre is None or way is None or slack is None:
        return None
    return Joined(
        joint.name, body.parent, along, formula("mass", k, body.mass), NOTHING, formula("centre", k, centre),
        formula("inertia", k, body.inertia), formula("length", body.parent, way) if way else NOTHING,
        formula("stiffness", k, joint.stiffness), _decimal(slack),
        NOTHING if d.is_lagrangian else formula("damping", k, joint.damping),
    )  # fmt: skip


def _slack(d: RobotDerivation, plane: Plane, k: int) -> float | None:
    """Where the joint's spring is slack, in the author's coordinates; None where these begin elsewhere."""
    joint, convention, said = plane.bodies[k].joint, d.coordinates.convention, d.coordinates
    if convention is None or not plane.bodies[k].turns or not joint.stiffness:
        return joint.springref
    counted = [k] if convention.relative else plane.hinges(k)[-2:]
    if joint.ref or any(said.quarters[j] or said.rest[j] for j in counted):
        return None
    return joint.springref * convention.sense(k) * plane.bodies[k].sense


def _decimal(value: float) -> Formula:
    """A number as a file prints it, which is how an author would write it: 0.6 is 3/5."""
    digits = Fraction(repr(value))
    return constant(fmpq(digits.numerator, digits.denominator))


def _slide(slide: tuple[float, float], line: tuple[float, float] | None) -> Along | None:
    """Along the link that carries it, whose direction is ``line``; else, where no hinge turns it, in a direction."""
    if line is None:
        return SLIDES.get((round(slide[0], 9), round(slide[1], 9)))
    size = math.hypot(*line)
    straight = size > 0 and math.dist((line[0] / size, line[1] / size), slide) <= PARALLEL
    return "link" if straight else None


def _symbols(d: RobotDerivation) -> dict[tuple[str, int], str]:
    """The author's symbol for each number of the file: by its usual name, else the only one of the kind and value."""
    found: dict[tuple[str, int], str] = {}
    for name, value in d.values.items():
        usual = d.usual.get(name)
        those = [usual] if usual is not None and usual.value == value else [
            q for q in d.quantities if name[:1] in KINDS[q.kind] and q.value == value
        ]  # fmt: skip
        if len({q.joint for q in those}) == 1:  # one link: its length and its centre may be one number, of a point mass
            found |= {(q.kind, q.joint): name for q in _same_number(d, those) if (q.kind, q.joint) not in found}
    return found


def _same_number(d: RobotDerivation, those: list[Quantity]) -> list[Quantity]:
    """With them, the other kind of length where it is the same number: a point mass at the end."""
    lengths = [q for q in those if q.kind in ("length", "centre")]
    more = [
        q for q in d.quantities for one in lengths
        if q.joint == one.joint and q.kind in ("length", "centre") and q.value == one.value
    ]  # fmt: skip
    return [*those, *more]


def _along(reach: tuple[float, float], point: tuple[float, float], start: tuple[float, float]) -> float | None:
    """How far along a direction a point is; None where it is beside it."""
    x, y, size = point[0] - start[0], point[1] - start[1], math.hypot(*reach)
    if not size:
        return 0.0 if math.hypot(x, y) <= PARALLEL else None
    along, beside = (x * reach[0] + y * reach[1]) / size, (x * reach[1] - y * reach[0]) / size
    return None if abs(beside) > PARALLEL * (abs(along) + size) else along


def _convention(d: RobotDerivation, plane: Plane) -> Convention | None:
    """The author's; of the joints' own coordinates: relative, if all links are straight on where those are zero."""
    if d.coordinates.convention is not None:
        return d.coordinates.convention
    quarters = set()
    for k, body in enumerate(plane.bodies):
        if not body.turns:
            continue
        path = plane.hinges(k)
        offset = plane.angle(k) - body.sense * body.joint.ref - (plane.angle(path[-2]) if len(path) > 1 else 0.0)
        near = round(offset / (math.pi / 2))
        if abs(offset - near * math.pi / 2) > PARALLEL or (len(path) > 1 and near % 4):
            return None
        if len(path) == 1:
            quarters.add(near % 4)
    if len(quarters) > 1:
        return None
    # The grader measures the first angle from there in its own sense, positive as the hinge turns.
    quarter = next(iter(quarters), 0)
    origin: Origin = next(name for name, q in QUARTERS.items() if q == quarter)
    return Convention(True, origin, tuple(body.sense for body in plane.bodies))
