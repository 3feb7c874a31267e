"""Reads a derivation in any form: equations of motion, a Lagrangian, a Hamiltonian, equations with momenta, stages."""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any
from unicodedata import normalize

from ...models.errors import InvalidInput
from ..dialects.blocks import rows_of_blocks
from ..dialects.code.programs import plain_programs
from ..dialects.derived.rows import from_scripts
from ..dialects.followed.chosen import from_languages
from ..dialects.functions import whole_functions
from ..dialects.grammars.rows import from_grammars
from ..dialects.letters.angle_t import require_no_time
from ..dialects.letters.by_rule import by_rule
from ..dialects.letters.drives import with_phases
from ..dialects.letters.every_text import lines_of
from ..dialects.letters.given_motions import without_given_motions
from ..dialects.letters.gravity import said_of_gravity, said_of_squares
from ..dialects.letters.indices import plain_indices
from ..dialects.letters.left_sides import without_left_sides
from ..dialects.letters.members import without_low_lines, without_owners, without_pointers
from ..dialects.letters.odd_waves import with_odd_waves
from ..dialects.letters.said_motions import with_said_motions
from ..dialects.letters.said_zeros import with_said_zeros
from ..dialects.letters.time_names import with_one_time
from ..dialects.markup.asciimath import without_ticks
from ..dialects.markup.environments import plain_environments
from ..dialects.markup.macros import plain_macros
from ..dialects.markup.named_apart import named_apart
from ..dialects.markup.pages import from_pages
from ..dialects.markup.printed import plainly_printed
from ..dialects.markup.prose import FormulasInWords
from ..dialects.markup.wrapped import unwrapped
from ..dialects.names import plain_name
from ..dialects.notes.declarations import without_sums_below
from ..dialects.notes.note import as_note, is_worded
from ..dialects.parsers.rows import from_parsers
from ..dialects.table import translated
from ..dialects.times import with_times
from ..dialects.traced.known import known
from ..dialects.traced.rows import traced
from ..dialects.vectors import with_vectors
from ..dialects.worksheets.sessions import from_worksheets
from .declaration import PRESETS, WORDS
from .forces import constraint_forces
from .forms.hamilton import read_hamilton
from .forms.stages import is_staged, read_stages
from .submission import Reader, Submission, known_fields, opened, read_fields

MOST_POSITIONS, MOST_NAMED = 16, 8
SUM_BELOW = "a sum in a denominator"
ANGLES = {  # letters of angles, the likeliest first, and how they are written
    "theta": r"theta|θ|ϑ", "varphi": r"varphi|φ", "phi": r"phi|ϕ", "psi": r"psi|ψ",
    "alpha": r"\\ddot\s*\{?\s*\\alpha|α̈", "q": r"\\ddot\s*\{?\s*q|\bq",
}  # fmt: skip


def read_derivation(data: dict[str, Any], slashes: int = 0) -> Submission:
    """Read the fields of a derivation. ``slashes``: how 3g/2l is read, as in :class:`Slashes`.

    Raises InvalidInput, with the place, where it is none.
    """
    known_fields(data)
    return replace(_read(data, slashes), cut=isinstance(data.get("equations"), str))


def _read(data: dict[str, Any], slashes: int) -> Submission:
    """Read a derivation whose fields are known."""
    data = with_said_zeros(without_owners(with_one_time(_of_one_text(data))))
    data = with_said_motions(
        named_apart(plain_macros(plainly_printed(plain_environments(without_ticks(unwrapped(without_pointers(data)))))))
    )
    require_no_time(data)
    data = with_phases(data)
    unread: InvalidInput | None = None
    try:
        script = from_scripts(data)
        if script is not None:
            return _as_program(*script, slashes)
    except InvalidInput as error:
        unread = error
    try:
        return _read_others(data, slashes)
    except InvalidInput:
        if unread is not None:
            raise unread from None
        raise


def _read_others(data: dict[str, Any], slashes: int) -> Submission:
    """Read what derives nothing by computer algebra."""
    spelled = _spelled(data)
    program = from_grammars(spelled)
    if program is not None:
        return _as_program(*program, slashes)
    refused: InvalidInput | None = None
    try:
        program = from_parsers(spelled)
        if program is None:
            program = traced(spelled)
        if program is not None:
            return _as_program(*program, slashes)
    except InvalidInput as error:
        refused = error
    try:
        return _rows_or_note(data, spelled, slashes, notes=refused is None)
    except InvalidInput:
        if refused is not None:
            raise refused from None
        raise


def _of_one_text(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with a table for rows that are given as one text."""
    return data | {name: {"1": data[name]} for name in ("equations", "solved") if isinstance(data.get(name), str)}


def _as_program(data: dict[str, Any], lines: Mapping[str, str], slashes: int) -> Submission:
    """Read a program that is followed line by line. ``lines``: what definitions of ours stand for."""
    try:
        try:
            return _of_program(data, slashes)
        except InvalidInput as error:
            if not str(error).endswith(SUM_BELOW):
                raise
            return _of_program(without_sums_below(data), slashes)
    except InvalidInput as error:
        found = re.match(r"define\.(\w+): (?:column [0-9]+: )?(.*)", str(error), re.DOTALL)
        line = lines.get(found[1]) if found else None
        if found is None or line is None:  # a column of ours says nothing
            raise InvalidInput(re.sub(r"column [0-9]+: ", "", str(error))) from None
        raise InvalidInput(f"equations.1: {line!r:.80}: {found[2]}") from None


def _of_program(data: dict[str, Any], slashes: int) -> Submission:
    data, odd = with_odd_waves(data, known(data).written)
    plain, constants, count = _plain(data)
    return _meant(plain, [*constants, *odd], count, slashes)


def _rows_or_note(data: dict[str, Any], spelled: dict[str, Any], slashes: int, *, notes: bool) -> Submission:
    """Read rows; where formulas among words (``notes``) are refused, or what the rows mean, as a note.

    A program that cannot be followed is refused before that: it is not looked through for formulas.
    """
    try:
        plain = _plain(spelled)
    except FormulasInWords as refusal:
        first: InvalidInput = refusal
    else:
        try:
            return _meant(*plain, slashes)
        except InvalidInput as refusal:
            first = refusal
        if str(first).endswith(SUM_BELOW):
            with suppress(InvalidInput):
                return _meant(*_plain(without_sums_below(spelled)), slashes)
    if not notes:
        raise first
    note = _as_note(data, first)
    try:
        return _meant(*_plain(_spelled(note)), slashes)
    except InvalidInput:
        if is_worded(data):
            raise
        raise first from None  # rows without a word are no note: what they lack as rows says more


def _as_note(data: dict[str, Any], first: InvalidInput) -> dict[str, Any]:
    """The fields as a note's. Raises the first refusal where they are none, else what the note lacks."""
    try:
        note = as_note(data, _bodies(data))
    except InvalidInput as error:
        # of a sum below the line in a quantity, a note's reading can make a name
        if is_worded(data) or str(error).startswith("bodies: ") or str(first).endswith(SUM_BELOW):
            raise
        raise first from None
    if note is None:
        raise first
    return note


def _spelled(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with names as the reader takes them."""
    return by_rule(without_left_sides(plain_indices(said_of_squares(without_low_lines(data)))))


def _plain(data: dict[str, Any]) -> tuple[dict[str, Any], list[str], int]:
    """The fields in the reader's notation, names of constants that these need, and how many coordinates there are."""
    count, coordinates = _shape(data)
    data = from_languages(data, count)
    data = from_worksheets(from_pages(plain_programs(data, count), count))
    free = _free(data, coordinates)
    data = whole_functions(data, len(free) or count, free)
    data = with_vectors(_with_positions(rows_of_blocks(data)), count)
    data, constants = with_times(data)
    data = without_given_motions(data)
    data = translated(data, count)
    data, of_gravity = said_of_gravity(data)
    return data, [*constants, *of_gravity], count


def _meant(data: dict[str, Any], constants: list[str], count: int, slashes: int) -> Submission:
    """What they mean."""
    forces = constraint_forces(data, count)
    reader = opened(data, slashes, [*constants, *forces], forces=forces)
    reader.hold(data.get("steps", {}))
    return replace(_read_form(data, reader), passed=tuple(data.get("passed", ())))


def _read_form(data: dict[str, Any], reader: Reader) -> Submission:
    """Stages, a Hamiltonian, equations or a Lagrangian."""
    if is_staged(data, reader.evaluation.space.n):
        return read_stages(data, reader)
    if "hamiltonian" in data or (reader.variable is not None and reader.variable.kind == "momentum"):
        return read_hamilton(data, reader)
    return read_fields(data, reader)


def _with_positions(data: dict[str, Any]) -> dict[str, Any]:
    """The fields with the positions as definitions, where an energy or another position is written in these."""
    positions, define = data.get("positions"), data.get("define", {})
    energies = [normalize("NFD", data[name]) for name in ("kinetic", "potential", "lagrangian")
                if isinstance(data.get(name), str)]  # fmt: skip
    if isinstance(positions, dict):
        energies += [normalize("NFD", text) for text in positions.values() if isinstance(text, str)]
    if not isinstance(positions, dict) or not isinstance(define, dict) or len(positions) > MOST_POSITIONS:
        return data
    used = [re.compile(rf"(?<![A-Za-z\\]){x}[\u0307\u0308]?\s*\}}?\s*_?\{{?[0-9a-z₀-₉]") for x in "xy"
            if any(str(name)[:1] == x for name in positions)]  # fmt: skip
    if not any(pattern.search(text) for pattern in used for text in energies):
        return data
    said = {plain_name(str(name)) for name in define}
    more = {name: text for name, text in positions.items() if name in define or plain_name(str(name)) not in said}
    return data | {"define": {**define, **more}}


def _free(data: dict[str, Any], coordinates: list[str]) -> list[str]:
    """The coordinates whose motion is asked for: those of a program's state."""
    bodies = data.get("bodies")
    given = [isinstance(b, dict) and "motion" in b for b in bodies] if isinstance(bodies, list) else []
    if len(given) != len(coordinates):
        return coordinates
    return [name for name, is_given in zip(coordinates, given, strict=True) if not is_given]


def _bodies(data: dict[str, Any]) -> list[dict[str, str]]:
    """The bodies of a usual mechanism, in the letters that its author has; none where a file declares its own."""
    system, bodies = data.get("system"), data.get("bodies")
    if not isinstance(system, str) or bodies is not None:
        return []
    if system in PRESETS:
        return PRESETS[system]
    count, _ = _shape(data)
    text = "\n".join(lines_of(data))
    letter = next((x for x, written in ANGLES.items() if re.search(written, text)), "theta")
    index = [""] if count == 1 else [f"_{k}" for k in range(1, min(count, MOST_NAMED) + 1)]
    return [{"coordinate": f"{letter}{k}", "mass": f"m{k}", "length": f"l{k}"} for k in index]


def _shape(data: dict[str, Any]) -> tuple[int, list[str]]:
    """How many coordinates these fields declare, 0 where that is not plain, and their names where bodies have them."""
    system, bodies = data.get("system"), data.get("bodies")
    if isinstance(system, str) and bodies is None and system in PRESETS:
        bodies = PRESETS[system]
    if isinstance(bodies, list):
        names = [str(body.get("coordinate", "")) for body in bodies if isinstance(body, dict)]
        return len(names), names
    links = data.get("links")
    if links is None and isinstance(system, str) and system in WORDS:
        links = WORDS[system][1]
    return (links if type(links) is int else 0), []
