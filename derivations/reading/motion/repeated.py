"""Rows that say again what others say, as the steps of a derivation do: each equation is kept once, as it comes last.

That a row is a combination of the rows kept is found at one random point of a finite field, as in ``fingerprint``. A
row that is none contradicts them, and which of the two is meant is asked.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from ....models.errors import InvalidInput
from ...algebra.fingerprint import PRIME, point_of
from ...algebra.trig import Formula, Key, Space, digit, unit

Row = tuple[str, Formula]  # its label, and left side minus right side


def stated_once(space: Space, rows: Sequence[Row], forces: Sequence[str]) -> list[Row]:
    """The last rows that say all of it, in their order. ``forces``: names of unknowns besides the accelerations.

    Raises InvalidInput where two rows contradict each other.
    """
    unknowns = [*range(space.n), *(space.own_place(name) for name in forces)]
    lines = [_line(space, f, unknowns) for _, f in rows]
    if None in lines:
        return list(rows)
    kept: list[tuple[int, list[int]]] = []  # places of rows, and these reduced by the others
    for place in reversed(range(len(rows))):
        line = _reduced(lines[place] or [], [reduced for _, reduced in kept])
        if not any(line):
            continue
        if not any(line[:-1]):
            raise InvalidInput(
                f"equations: row {place + 1} contradicts those behind it, and all are taken to say the same motion: "
                "correct it, or give one row for each angle"
            )
        kept.append((place, line))
    return [rows[place] for place, _ in sorted(kept)]


def _line(space: Space, f: Formula, unknowns: list[int]) -> list[int] | None:
    """The values of a row's coefficients of the unknowns, and of the rest; None where these are not linear."""
    point = point_of(space)
    parts: list[dict[Key, fmpq]] = [{} for _ in range(len(unknowns) + 1)]
    for (e, h, s), c in f.terms.items():
        powers = [(k, digit(e, place)) for k, place in enumerate(unknowns) if digit(e, place)]
        if len(powers) > 1 or any(power != 1 for _, power in powers):
            return None
        k = powers[0][0] if powers else len(unknowns)
        parts[k][e - unit(unknowns[k]) if powers else e, h, s] = c
    return [point.value(Formula(part)) if part else 0 for part in parts]


def _reduced(line: list[int], kept: list[list[int]]) -> list[int]:
    """The row minus what the rows kept make of it; each of these begins at a place of its own."""
    for row in kept:
        first = next(k for k, value in enumerate(row) if value)
        if line[first]:
            factor = line[first] * pow(row[first], -1, PRIME)
            line = [(x - factor * y) % PRIME for x, y in zip(line, row, strict=True)]
    return line
