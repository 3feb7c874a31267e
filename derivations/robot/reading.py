"""Reads a user's own equations of a mechanism: what its symbols are, and the rows, exactly, with numbers in them."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

from flint import fmpq

from ...models.errors import InvalidInput
from ...models.trees.own import OwnEquations
from ...models.trees.system import TreeSystem
from ..algebra.trig import Formula, constant
from ..dialects.names import GREEK, plain_name, spelling
from ..reading.submission import Reader, Submission, opened
from ..reading.tokens import SIGNS
from ..steps.derivation import lagrange_rows
from .coordinates import Coordinates, read_coordinates
from .function import function_rows, names_in_function
from .motion import OwnMotion
from .plane import Plane, plane_of
from .quantities import Quantity, quantities, usual_names

MOST_JOINTS = 8  # of equations that a person writes
BY_ORDER = ("q", "theta", "phi", "x")  # letters that count joints where nothing is declared
COMMANDS = re.compile(r"\\(?!ell|var)[A-Za-z]+|cos|sin|tan")


@dataclass(frozen=True)
class RobotDerivation:
    """``rows``: each to be zero, in the symbols of ``submission``, coordinate k being that of joint k.

    ``names``: of the coordinates, ``joints``: of theirs; ``values``: of the constants, by name; ``inferred``: those of
    them that are the model file's; ``quantities``: the file's numbers, and ``usual``: those that usual names mean;
    ``damping`` of the joints; ``why_not``: why there is no ``plane``.
    """

    own: OwnEquations
    submission: Submission
    rows: tuple[Formula, ...]
    names: tuple[str, ...]
    joints: tuple[str, ...]
    values: dict[str, float]
    inferred: dict[str, Quantity]
    quantities: tuple[Quantity, ...]
    usual: dict[str, Quantity]
    coordinates: Coordinates
    gravity: float
    damping: tuple[float, ...]
    plane: Plane | None
    why_not: str

    @property
    def is_lagrangian(self) -> bool:
        """Whether the rows are Lagrange's, of a Lagrangian that the file gives."""
        return bool(self.own.lagrangian)

    @property
    def said(self) -> tuple[str, ...]:
        """What was taken from the model file, and how coordinates are counted, in sentences."""
        joints = dict(zip(self.names, self.joints, strict=True))
        said = [", ".join(f"{name} is joint {joint!r}" for name, joint in joints.items())]
        convention = self.coordinates.convention
        said.append("in the joints' own coordinates" if convention is None else convention.words)
        taken = [f"{name} = {q.value:g} {q.unit}, {q.words}" for name, q in self.inferred.items()]
        said += [f"taken from the model: {'; '.join(taken)}"] if taken else []
        if self.is_lagrangian and any(self.damping):
            said.append("a Lagrangian has no dampers: their forces are those of the model")
        return tuple(said)

    @property
    def typeset(self) -> tuple[str, ...]:
        """The equations as they were read, in the author's letters; none of a function."""
        return tuple(f"{label}: {text}" for label, text in self.submission.lines)

    def motion(self, values: dict[str, float] | None = None, coordinates: Coordinates | None = None) -> OwnMotion:
        """The equations in numbers; with other values of some constants, or with angles counted in another way."""
        rows = self.numeric(self.values if values is None else self.values | values)
        dampers = self.damping if self.is_lagrangian else None
        return OwnMotion(self.submission.space, rows, coordinates or self.coordinates, self.gravity, dampers)

    def numeric(self, values: dict[str, float]) -> tuple[Formula, ...]:
        """The rows with these values of the constants, taken as exact; g stays a symbol."""
        space = self.submission.space
        formulas = {space.own_place(name): constant(fmpq(*value.as_integer_ratio())) for name, value in values.items()}
        try:
            return tuple(space.replace(row, formulas) for row in self.rows)
        except ValueError:
            zero = ", ".join(name for name, value in values.items() if not value)
            raise InvalidInput(f"equations: {zero} is zero, and the equations divide by it") from None


def read_robot(system: TreeSystem, own: OwnEquations) -> RobotDerivation:
    """Read them. Raises :class:`InvalidInput`, with the place and what would be read, where that cannot be done."""
    n = system.n
    if any(joint.kind not in ("hinge", "slide") for joint in system.joints):
        raise InvalidInput("equations: of mechanisms of hinges and slides alone; a ball or a free joint has no one "
                           "coordinate")  # fmt: skip
    if n > MOST_JOINTS:
        raise InvalidInput(f"equations: of at most {MOST_JOINTS} joints, the mechanism has {n}")
    plane, why_not = _plane(system)
    numbers = quantities(system, plane)
    usual = usual_names(system, numbers)
    text = _bare(own)
    names = _coordinates(system, own, text)
    values, inferred = _constants(own, usual, text, names)
    reader = _reader(system, own, names, tuple(values))
    if own.function:
        formulas, labels = function_rows(own.function, reader.evaluation, names), [str(k + 1) for k in range(n)]
        submission = reader.submission(tuple(zip(labels, formulas, strict=True)), None)
    elif own.lagrangian:
        lagrangian = reader.lagrangian(own.lagrangian)
        submission = reader.submission((), lagrangian)
        formulas = lagrange_rows(submission.space, lagrangian)
    else:
        rows = reader.rows(dict(own.rows))
        if len(rows) != n:
            raise InvalidInput(f"equations: {len(rows)} row{'s' * (len(rows) != 1)} for {n} joints; "
                               "one for each joint is needed")  # fmt: skip
        formulas = [formula for _, formula in rows]
        submission = reader.submission(rows, None)
    return RobotDerivation(
        own, submission, tuple(formulas), names, tuple(joint.name for joint in system.joints), values, inferred,
        tuple(numbers), usual, read_coordinates(system, own, plane, why_not), math.hypot(*system.gravity),
        tuple(joint.damping for joint in system.joints), plane, why_not,
    )  # fmt: skip


def _plane(system: TreeSystem) -> tuple[Plane | None, str]:
    try:
        return plane_of(system), ""
    except InvalidInput as error:
        return None, str(error)


def _bare(own: OwnEquations) -> str:
    """All texts without functions and commands, whose letters are no symbols."""
    text = "\n".join(own.texts) if not own.function else " ".join(names_in_function(own.function))
    for word in GREEK:
        text = re.sub(rf"\\{word}(?![A-Za-z])", f" {word}", text)
    return COMMANDS.sub(" ", text)


def _occurs(name: str, text: str) -> bool:
    return re.search(rf"(?<![A-Za-z_\\]){spelling(plain_name(name) or name).pattern}", text) is not None


def _coordinates(system: TreeSystem, own: OwnEquations, text: str) -> tuple[str, ...]:
    """A name for each joint: declared, the joint's own, or a letter with its number."""
    declared = {joint: name for name, joint in own.joints}
    names = [declared.get(joint.name, "") for joint in system.joints]
    for k, joint in enumerate(system.joints):
        if not names[k] and plain_name(joint.name) and _occurs(joint.name, text):
            names[k] = joint.name
    if all(names):
        return tuple(names)
    if not any(names):
        letters = [x for x in BY_ORDER if _occurs(f"{x}1", text) or (system.n == 1 and _occurs(x, text))]
        if len(letters) == 1 or own.function:
            letter = letters[0] if len(letters) == 1 else "q"
            single = system.n == 1 and not _occurs(f"{letter}1", text)
            return (letter,) if single else tuple(f"{letter}{k + 1}" for k in range(system.n))
    missing = next(joint.name for joint, name in zip(system.joints, names, strict=True) if not name)
    raise InvalidInput(f"symbols: which coordinate is joint {missing!r}? Write [symbols] x = {missing!r}, with your "
                       "letter")  # fmt: skip


def _constants(
    own: OwnEquations, usual: dict[str, Quantity], text: str, names: tuple[str, ...]
) -> tuple[dict[str, float], dict[str, Quantity]]:
    """The constants' values, and those that were taken from the file, where a usual name means one number of it."""
    values: dict[str, float] = {}
    for name, value in own.numbers:
        plain = plain_name(name)
        if plain is None:
            raise InvalidInput(f"symbols.{name!s:.40}: a letter or a word, with an index if you like, is needed")
        if plain in values:
            twin = next(other for other, _ in own.numbers if plain_name(other) == plain)
            raise InvalidInput(f"symbols.{name!s:.40}: {twin} and {name} are one symbol, and have two values; keep one")
        values[plain] = value
    if "g" in values:
        raise InvalidInput("symbols.g: gravity is the mechanism's; leave g out")
    taken = {plain_name(name) for name in (*names, *(name for name, _ in own.define))} | {"g"}
    inferred = {
        name: q for name, q in usual.items() if name not in values and name not in taken and _occurs(name, text)
    }
    return values | {name: q.value for name, q in inferred.items()}, inferred


def _reader(system: TreeSystem, own: OwnEquations, names: tuple[str, ...], constants: tuple[str, ...]) -> Reader:
    """The grader's own, told of coordinates and constants alone."""
    bodies = [
        {"name": f"body {k}", "coordinate": name, "joint": joint.kind}
        for k, (name, joint) in enumerate(zip(names, system.joints, strict=True), 1)
    ]
    data: dict[str, Any] = {"system": "mechanism", "bodies": bodies}
    try:
        defined = {"define": dict(own.define)} if own.define else {}
        return opened(data | defined, constants=constants, has_signs=any(SIGNS.search(text) for text in own.texts))
    except InvalidInput as error:
        raise InvalidInput(f"symbols: {error}" if str(error).startswith("bodies") else str(error)) from None
