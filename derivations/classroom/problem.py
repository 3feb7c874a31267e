"""A problem file: the mechanism, coordinates, forms, points and hints that a teacher pins.

    title = "Double pendulum"
    system = "n-leg"             # or any other mechanism that a derivation can name or declare
    links = 2
    angles = "absolute"          # with from, sense: what is given is pinned, the rest is left to the submission
    equal = ["masses"]           # m without an index may stand for all masses; "lengths" likewise
    forms = ["equations"]        # what is taken as an answer: also "solved", "lagrangian", "hamiltonian", "energies"
    [points]
    total = 10
    rows = [4, 6]                # left out: each row the same
    stages = { kinetic = 3, potential = 2, equations = 5 }   # in place of rows: a derivation stated stage by stage
    each_term = 1                # off for a wrong term; each_mistake = 2: off for a mistake, whatever terms it hits
    [feedback]
    hints = 2                    # 0 right or wrong, 1 which row, 2 which term, 3 the cause, 4 the solution
    solution = false             # true: the solution is shown whatever the hints
    [limits]
    seconds = 10                 # a submission

A submission may leave out what is pinned; where it states it, it has to be the same. Nothing is assumed of it.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

from ...models.errors import InvalidInput, nearest
from ...models.readers.bounded_file import read_text, shown
from ...models.readers.toml_text import parse_toml
from ..grading.hypotheses import Hypothesis, hypotheses
from ..reading.declaration import PRESETS, WORDS
from ..reading.motion.convention import ORIGINS
from ..reading.submission import Submission, read_table
from ..steps.stages import STAGES, StageName

LARGEST_FILE = 100_000  # bytes
PINNED = ("system", "links", "bodies", "angles", "from", "sense")
FIELDS = (*PINNED, "title", "equal", "forms", "points", "feedback", "limits")
FORMS = ("equations", "solved", "lagrangian", "hamiltonian", "energies", "positions")
ASKED = ("equations", "solved", "lagrangian", "hamiltonian", "energies")  # unless forms says otherwise
EQUAL = ("lengths", "masses")
MOST_POINTS = 10_000
MOST_SECONDS = 600.0
DEFAULT_SECONDS = 10.0
LEVELS = ("right or wrong", "which row", "which term", "the cause", "the solution")


@dataclass(frozen=True)
class Points:
    """What is worth how much. ``rows``: of each right row; empty: each the same; ``stages``: of each that is asked."""

    total: Fraction = Fraction(1)
    rows: tuple[Fraction, ...] = ()
    each_term: Fraction | None = None
    each_mistake: Fraction | None = None
    stages: tuple[tuple[StageName, Fraction], ...] = ()

    def sentence(self) -> str:
        """How points are taken off, in plain words."""
        if self.each_mistake is not None:
            return (
                f"A wrong derivation loses {shown_points(self.each_mistake)} for each mistake that is named, however "
                "many terms it makes wrong; where none can be named, it loses points by its terms."
            )
        worth = "its points divided by the number of its terms" if self.each_term is None else shown_points(
            self.each_term)  # fmt: skip
        if self.stages:
            worth = worth.replace("its points divided by the number of its terms", "its points divided by its terms")
            return (f"A stage loses {worth} for each term that is wrong; what follows correctly from an earlier stage "
                    "that is wrong loses nothing. A stage that is not there has no points.")  # fmt: skip
        return (f"A row (or the Lagrangian) loses {worth} for each term that is wrong, missing or too many, and never "
                "more than it is worth. A row that is not there has no points.")  # fmt: skip


@dataclass(frozen=True)
class Problem:
    """A problem. ``pinned``: the fields of a derivation that are fixed, as the file has them."""

    pinned: dict[str, Any]
    title: str = ""
    equal: frozenset[str] = frozenset()
    forms: tuple[str, ...] = ASKED
    points: Points = field(default_factory=Points)
    hints: int = 3
    shows_solution: bool = False
    seconds: float = DEFAULT_SECONDS

    def held(self, data: dict[str, Any]) -> dict[str, Any]:
        """A submission's fields with the pinned ones. Raises InvalidInput where it states another problem."""
        for name, fixed in self.pinned.items():
            if name in data and not _same(name, self.pinned, data):
                what = "" if name == "bodies" else f" is {fixed!r:.80}, and this file says {data[name]!r:.80}"
                raise InvalidInput(f"{name}: the problem's{what}; a submission cannot change it")
        if "bodies" in data and "bodies" not in self.pinned:
            raise InvalidInput("bodies: the problem has a mechanism of its own; a submission cannot change it")
        return {**data, **self.pinned}

    def checked(self, s: Submission) -> Submission:
        """The submission with equal lengths and masses as one symbol. Raises InvalidInput where it takes more as equal
        than the problem does.
        """
        n = s.space.n
        places: dict[int, int] = {}
        for letter, name, start, used in (("l", "lengths", 2, s.equal_lengths), ("m", "masses", 3, s.equal_masses)):
            if name in self.equal:
                places |= {start * n + k: start * n for k in range(1, n)}
            elif used:
                every = ", ".join(f"{letter}{k}" for k in range(1, min(n, 3) + 1)) + (", …" if n > 3 else "")
                raise InvalidInput(f"{letter} without an index: this problem has {every}; write which one is meant")
        return s.renamed(places) if places and s.mechanism is None else s

    @property
    def what(self) -> Submission:
        """The mechanism, its symbols and convention: as a submission with nothing in it."""
        nothing = {"equations": {"1": "0 = 0"}}
        return self.checked(read_table({**nothing, **self.pinned}))

    def truth(self, s: Submission) -> Hypothesis:
        """What is right, in the convention and the symbols of a submission."""
        return next(hypotheses(s, pinned=True))


def read_problem(source: str | os.PathLike[str]) -> Problem:
    """Read a problem file. Raises InvalidInput, with the place, where it is none."""
    path = Path(source)
    try:
        return parse_problem(read_text(path, LARGEST_FILE))
    except InvalidInput as error:
        raise InvalidInput(str(error) if str(error).startswith(shown(path)) else f"{shown(path)}: {error}") from None


def parse_problem(text: str) -> Problem:
    """Read the text of a problem file."""
    return problem_of(parse_toml(text))


def problem_fields(source: str | os.PathLike[str]) -> dict[str, Any]:
    """The fields of a problem file, as they stand there."""
    return parse_toml(read_text(Path(source), LARGEST_FILE))


def problem_of(data: dict[str, Any]) -> Problem:
    """A problem from its fields, as the file has them."""
    _known(data, FIELDS, "")
    pinned = {name: data[name] for name in PINNED if name in data}
    if "system" not in pinned:
        raise InvalidInput("system: a problem names its mechanism")
    equal, forms = data.get("equal", []), data.get("forms", list(ASKED))
    _choice(equal, EQUAL, "equal")
    _choice(forms, FORMS, "forms")
    if not forms:
        raise InvalidInput(f"forms: at least one of {', '.join(FORMS)} is needed")
    feedback, limits = _table(data, "feedback", ("hints", "solution")), _table(data, "limits", ("seconds",))
    hints, solution = feedback.get("hints", 3), feedback.get("solution", False)
    if type(hints) is not int or not 0 <= hints < len(LEVELS):
        said = ", ".join(f"{k} ({level})" for k, level in enumerate(LEVELS))
        raise InvalidInput(f"feedback.hints: {hints!r:.40}; give one of {said}")
    if not isinstance(solution, bool):
        raise InvalidInput("feedback.solution: true or false")
    seconds = limits.get("seconds", DEFAULT_SECONDS)
    if isinstance(seconds, bool) or not isinstance(seconds, int | float) or not 0.5 <= seconds <= MOST_SECONDS:
        raise InvalidInput(f"limits.seconds: from 0.5 to {MOST_SECONDS:g}, got {seconds!r:.40}")
    title = data.get("title", "")
    if not isinstance(title, str) or len(title) > 200:
        raise InvalidInput("title: a text of at most 200 characters")
    problem = Problem(pinned, title, frozenset(equal), tuple(forms), Points(), hints, solution, float(seconds))
    links = problem.what.space.n  # raises where the mechanism is none
    return Problem(
        pinned, title, problem.equal, problem.forms, _points(data.get("points", {}), links), hints, solution,
        float(seconds),
    )  # fmt: skip


def _points(data: Any, links: int) -> Points:
    if isinstance(data, int | float) and not isinstance(data, bool):
        data = {"total": data}
    if not isinstance(data, dict):
        raise InvalidInput("points: a number, or a table [points]")
    _known(data, ("total", "rows", "stages", "each_term", "each_mistake"), "points.")
    rows, by_stage = data.get("rows", []), data.get("stages", {})
    if not isinstance(by_stage, dict):
        raise InvalidInput("points.stages: a table, as in { kinetic = 3, equations = 5 }")
    _known(by_stage, STAGES, "points.stages.")
    if rows and by_stage:
        raise InvalidInput("points: rows or stages; the equations are a stage")
    if not isinstance(rows, list) or (rows and len(rows) != links):
        raise InvalidInput(f"points.rows: a list of {links} numbers, one a row of the equations of motion")
    each = {
        name: _number(data[name], f"points.{name}") if name in data else None for name in ("each_term", "each_mistake")
    }
    worth = tuple(_number(x, "points.rows") for x in rows)
    stages: tuple[tuple[StageName, Fraction], ...] = tuple(
        (stage, _number(by_stage[stage], f"points.stages.{stage}")) for stage in STAGES if stage in by_stage
    )
    parts = sum(worth) + sum(x for _, x in stages)
    total = _number(data["total"], "points.total") if "total" in data else Fraction(parts or 1)
    if parts and parts != total:
        raise InvalidInput(f"points.total: {shown_points(total)}, and its parts are {shown_points(Fraction(parts))}")
    return Points(total, worth, each["each_term"], each["each_mistake"], stages)


def shown_points(points: Fraction) -> str:
    """Points as people write them: 2, 2.5, 3.33."""
    return f"{float(points):.2f}".rstrip("0").rstrip(".")


def _number(value: Any, where: str) -> Fraction:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 < value <= MOST_POINTS:
        raise InvalidInput(f"{where}: a number above 0 and up to {MOST_POINTS}, got {value!r:.40}")
    return Fraction(str(value))


def _table(data: dict[str, Any], name: str, known: tuple[str, ...]) -> dict[str, Any]:
    found = data.get(name, {})
    if not isinstance(found, dict):
        raise InvalidInput(f"{name}: a table [{name}]")
    _known(found, known, f"{name}.")
    return found


def _known(data: dict[str, Any], known: tuple[str, ...], where: str) -> None:
    for name in data:
        if name not in known:
            raise InvalidInput(
                f"{where}{name!s:.40}: no such field{nearest(name, known)}; known are {', '.join(known)}"
            )


def _choice(values: Any, known: tuple[str, ...], where: str) -> None:
    if not isinstance(values, list) or any(x not in known for x in values):
        raise InvalidInput(f"{where}: a list of {', '.join(known)}, got {values!r:.60}")


def _same(name: str, fixed: dict[str, Any], data: dict[str, Any]) -> bool:
    """Whether a submission states what is pinned; usual names of one mechanism are the same."""
    if name in ("system", "links"):
        return _mechanism(fixed) == _mechanism({"system": fixed["system"], "links": fixed.get("links"), **data})
    if name == "from":
        given = data[name]
        return isinstance(given, str) and ORIGINS.get(given) == ORIGINS.get(fixed[name])
    return bool(data[name] == fixed[name])


def _mechanism(data: dict[str, Any]) -> tuple[Any, Any]:
    kind, links = data.get("system"), data.get("links")
    if isinstance(kind, str) and kind in WORDS:
        kind, usual = WORDS[kind]
        links = usual if links is None else links
    if isinstance(kind, str) and (kind in PRESETS or kind == "mechanism"):
        links = None  # has as many as it has
    if kind == "n-leg" and isinstance(links, int) and links <= 2:
        kind = "point-masses"  # the same mechanism
    return kind, links
