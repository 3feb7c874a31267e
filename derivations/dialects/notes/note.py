# ruff: noqa: E501 -- patterns stand on one line
"""A whole file as a note: its fields with the formulas alone, names that it says among the definitions."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from ....models.errors import InvalidInput
from ..letters.every_text import is_fit, lines_of, rows_of
from ..letters.indices import plain_indices
from ..lines import FULL_WIDTH
from ..markup.prose import is_whole
from ..names import plain_name
from ..statements import is_program
from ..worksheets.definitions import in_order
from .columns import dotted_columns, with_columns, with_momenta
from .counted import by_rule
from .declarations import plain_declarations
from .derivatives import plain_derivatives
from .displays import Statement, has_arrow, statements_of
from .energies import Energy, energy, evident_rates
from .entries import with_columns_apart, with_entries, with_points, without_arguments
from .letters import Names, alone, names_of, with_accents, with_bold_apart
from .momentum_rates import with_momentum_rates
from .partial import rows_of_partial
from .points import of_squared_speeds, of_unknown_points, with_evident_accelerations
from .products import apart, index_first, with_transposes
from .sorting import ACCELERATION, Sorted, is_abstract, sorted_statements
from .states import with_states
from .words import formulas_of

ENERGIES = ("kinetic", "potential", "lagrangian", "hamiltonian")
MOST_ROWS = 16
ROOT = re.compile(r"^\s*\\sqrt\s*\{(?P<inner>.*)\}\s*$", re.DOTALL)
SAID_L = re.compile(r"(?<![A-Za-z0-9_\\])L(?=\s*=[^=\n]*(?:\\dot|[\u0307]|(?<=[\w}])['′]))")
IN_FONT = re.compile(r"\\math(?:cal|scr)\s*(?:\{\s*L\s*\}|L(?![A-Za-z]))")
WORDED = re.compile(
    r"\$|\\[\[(]|```|(?<![^\W\d_])[^\W\d_]{3,40} [^\W\d_]{2,40} [^\W\d_]{2}|[\u3040-\u30ff\u4e00-\u9fff]{3}|(?<![\w)\]'])\*\*"
)

INITIAL = re.compile(  # θ(0) = θ_0
    r"^\s*(?:\\dot\s*)?\{?\s*\\?[^\W\d_]+[\u0307]?\s*(?:_\s*(?:\{\w{1,4}\}|\w)|[₀-₉]|[0-9])?\s*\}?(?:_\w|_\{\w\})?['′]{0,2}\s*(?:\\left\s*)?\(\s*(?:t\s*=\s*)?0\s*(?:\\right\s*)?\)\s*$"
)
STEP = re.compile(r"(?:\\Delta|[Δ∆])\s*\{?\s*t(?![A-Za-z])")  # of a numerical method, in which time goes on by Δt
JOINED = re.compile(r"(?<!\\)\\\\(?=[A-Za-z])")  # a row's end at once before a letter
DIFFERENCE = re.compile(
    r"(?:\\Delta|Δ|∆)\s*(?P<x>\\(?:var)?(?:theta|phi)(?![A-Za-z])|\\psi(?![A-Za-z])|[θϑφϕψ])(?:\s*_\s*(?:\{\s*(?P<i>\w{1,4})\s*\}|(?P<j>\w)))?"
)
SAID_DIFFERENCE = re.compile(rf"{DIFFERENCE.pattern}\s*&?\s*(?::?=|\\equiv|≡)")


def as_note(data: dict[str, Any], usual: list[dict[str, str]] | None = None) -> dict[str, Any] | None:
    """The fields with formulas alone; None where they are no note. Raises InvalidInput with what to write.

    ``usual``: the bodies of a usual mechanism, where the file declares none.
    """
    made = plain_declarations(plain_indices(data))
    names = names_of({**made, "bodies": usual} if usual else made)
    if not names.coordinates or any(is_program(text) or "Symbol(" in text for _, text in rows_of(made)):
        return made if made != data else None
    new: dict[str, str] = {}
    steps: dict[str, str] = {}
    passed: list[str] = []
    for kind in ENERGIES:
        if is_fit(made.get(kind)):
            made = _with_energy(made, kind, names, new, steps, passed)
    if is_fit_table(made):
        made = _with_equations(made, names, new, steps, passed)
    if not new and not steps and made == data:
        return None
    define = made.get("define", {})
    if new:
        if not isinstance(define, dict):
            return None
        ordered = in_order({**{k: v for k, v in new.items() if plain_name(k) not in map(plain_name, define)}})
        if ordered is None:
            raise InvalidInput(
                "the names that are said need each other in a circle; write the equations with these put in"
            )
        made = made | {"define": {**define, **ordered}}
    return (
        made
        | ({"steps": steps} if steps else {})
        | ({"passed": [*data.get("passed", ()), *dict.fromkeys(passed)]} if passed else {})
    )


def is_worded(data: Mapping[str, Any]) -> bool:
    """Whether a text has words, or marks of formulas, as notes have."""
    return any(WORDED.search(text) for text in lines_of(data))


def _step(one: str, two: str) -> str:
    """Two sides that must be equal; of two roots, what stands in them, which is the same question."""
    roots = [ROOT.match(side) for side in (one, two)]
    if all(m and is_whole(m["inner"]) for m in roots):
        one, two = (m["inner"] for m in roots if m)
    return f"{one} = {two}"


def _texts(define: object) -> dict[str, str]:
    """The definitions that are texts."""
    return {str(k): v for k, v in define.items() if is_fit(v)} if isinstance(define, dict) else {}


def is_fit_table(data: Mapping[str, Any]) -> bool:
    """Whether there are equations to be looked at."""
    return bool(rows_of(data))


def _statements(text: str, names: Names, passed: list[str]) -> list[Statement]:
    """The equations of a text. ``passed``: to it, steps of a numerical method are added."""
    text = JOINED.sub(lambda m: f"{m[0]} ", _with_differences(text.translate(FULL_WIDTH), names))
    text = apart(index_first(plain_derivatives(text)), names)
    found: list[Statement] = []
    for formula in formulas_of(with_bold_apart(with_accents(text), names)):
        said = statements_of(formula.text)
        passed += [" = ".join(sides).strip() for sides in said if STEP.search(" ".join(sides))]
        said = [sides for sides in said if not _is_mention(sides) and not STEP.search(" ".join(sides))]
        found += [s for s in said if not formula.inline or _is_said(s, names)]
    return [sides for sides in found if not (len(sides) == 2 and INITIAL.match(sides[0]))]


def _is_mention(sides: Statement) -> bool:
    """Whether it is a letter alone, which a sentence is about."""
    return len(sides) == 1 and alone(sides[0]) is not None


def _with_differences(text: str, names: Names) -> str:
    r"""The text with a name for \Delta\theta, where it says what that is, and Δ is nothing else."""
    if "Delta" in names.all or not SAID_DIFFERENCE.search(text):
        return text
    return DIFFERENCE.sub(lambda m: f"\\Delta_{{{(plain_name(m['x']) or '') + (m['i'] or m['j'] or '')}}} ", text)


def _is_said(sides: Statement, names: Names) -> bool:
    """Whether a formula in a sentence states something; a letter alone is only mentioned, and so is g = 9.81."""
    if len(sides) < 2 or ("\\sum" in sides[0] and is_abstract(sides, set(), names)):
        return False
    name, value = alone(sides[0]), sides[-1].strip()
    if (
        name is None
        or name not in names.all
        or name in names.seconds
        or (name in names.quantities and ACCELERATION.search(value))
    ):
        return True
    if name in names.coordinates:
        raise InvalidInput(f"{' = '.join(sides).strip()[:40]}: a sentence says what a coordinate is; is that part of the "
                           "derivation? Leave it out")  # fmt: skip
    if name == "g" and re.fullmatch(
        r"(?:\\\\approx)?\s*(?:9[.,][78][0-9]{0,4}|10)(?:\s*(?:\\,|~|\\ )?\s*(?:\\(?:mathrm|text|rm)\s*\{[^{}]{0,20}\}|[A-Za-z/^0-9]{0,8}))?",
        value,
    ):
        return False
    raise InvalidInput(f"a sentence between the equations has formulas too, {' = '.join(sides).strip()[:40]}: {name} is declared "
                       "already; leave one of the two out")  # fmt: skip


def _with_energy(
    data: dict[str, Any], kind: str, names: Names, new: dict[str, str], steps: dict[str, str], passed: list[str]
) -> dict[str, Any]:
    text = data[kind]
    try:
        if kind == "hamiltonian":
            text = with_momenta(text, names)
        if kind == "lagrangian" and "L" in names.all:  # L is a length, and the letter in a font the Lagrangian
            text = IN_FONT.sub("ℒ ", text)
            if "ℒ" not in text and len(SAID_L.findall(text)) == 1:  # or in no font, where it is said with rates
                text = SAID_L.sub("ℒ", text)
        said = of_squared_speeds(with_points(by_rule(_statements(text, names, passed)), names), names)
        found: Energy = energy(kind, of_unknown_points(said, names), names)
    except InvalidInput as error:
        raise InvalidInput(f"{kind}: {error}") from None
    if kind in ("kinetic", "lagrangian"):
        new |= {k: v for k, v in evident_rates([found.value, *found.defined.values()], names).items()
                if plain_name(k) not in {plain_name(x) for x in found.defined}}  # fmt: skip
    for name, value in found.defined.items():
        if new.get(name, value) != value:
            raise InvalidInput(f"{kind}: {name} is said to be two things")
        new[name] = value
    for k, (one, two) in enumerate(found.steps, 1):
        steps[f"{kind}, step {k}"] = _step(one, two)
    made = data | {kind: found.value}
    if found.positions and "positions" not in data:
        made["positions"] = found.positions
    return made


def _with_equations(
    data: dict[str, Any], names: Names, new: dict[str, str], steps: dict[str, str], passed: list[str]
) -> dict[str, Any]:
    rows = rows_of(data)
    statements: list[Statement] = []
    for label, text in rows:
        try:
            statements += _statements(text, names, passed)
        except InvalidInput as error:
            raise InvalidInput(f"equations.{label:.40}: {error}") from None
    try:
        statements = with_evident_accelerations(statements, names)
        statements = with_transposes(with_columns_apart(dotted_columns(by_rule(statements), names), names), names)
        statements = with_momentum_rates(with_points(statements, names), names)
        statements = with_states(without_arguments(statements, names), names, _texts(data.get("define")))
        statements = with_entries(of_unknown_points(dotted_columns(statements, names), names), names)
        found: Sorted = sorted_statements(with_columns(statements, names), names)
        more, equal = rows_of_partial(found.partial, names, data)
        found.rows, found.steps = more + found.rows, found.steps + equal
    except InvalidInput as error:
        raise InvalidInput(f"equations: {error}") from None
    if len(found.rows) <= len(names.coordinates) and any(
        has_arrow(f.text) for _, text in rows for f in formulas_of(text)
    ):
        raise InvalidInput("equations: an arrow between two equations: is the first one a premise? Give one row for each "
                           "angle")  # fmt: skip
    if not found.rows or len(found.rows) > MOST_ROWS:
        raise InvalidInput(
            f"equations: {len(found.rows)} equations of motion are found among the words; give them alone"
        )
    new |= found.defined
    passed += found.passed
    if any(ACCELERATION.search(row) for row in found.rows):
        pass
    elif re.search(r"\\omega|ω", " ".join(found.rows)):
        new |= evident_rates(found.rows, names)
    for k, (one, two) in enumerate(found.steps, 1):
        steps[f"equations, step {k}"] = _step(one, two)
    labels = (
        [label for label, _ in rows]
        if len(rows) == len(found.rows)
        else [str(k) for k in range(1, len(found.rows) + 1)]
    )
    clash = next((stage for stage in found.stages if stage in data), None)
    if clash:
        raise InvalidInput(f"{clash}: it is said in [equations] as well; leave one of the two out")
    return {**data, **found.stages, "equations": dict(zip(labels, found.rows, strict=True))}
