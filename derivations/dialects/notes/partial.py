# ruff: noqa: E501 -- patterns stand on one line
r"""What ∂L/∂q̇ and ∂L/∂q are said to be: the equations that follow from these, to be held against those printed."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from ....models.errors import InvalidInput
from ..names import plain_name
from .displays import Statement
from .letters import NAME, Names, spelled

_L = r"(?:\\(?:mathcal|mathscr|mathrm)\s*\{?\s*)?[L𝓛ℒ]\s*\}?"
_P = r"(?:\\partial|∂)"
_X = rf"(?:\\dot\s*(?:\{{\s*(?P<a>{NAME})\s*\}}|(?P<b>{NAME}))(?P<i>\s*_\s*\{{?\w\}}?)?|(?P<c>{NAME}))(?:\s*\(t\))?"
_BY = rf"(?:\\[dt]?frac\s*\{{\s*{_P}\s*{_L}\s*\}}\s*\{{\s*{_P}\s*{_X}\s*\}}|{_P}\s*{_L}\s*/\s*{_P}\s*{_X.replace('<a>', '<a2>').replace('<b>', '<b2>').replace('<c>', '<c2>').replace('<i>', '<i2>')})"
_D = r"(?:\\mathrm\s*\{?\s*d\s*\}?|d)"
BY = re.compile(
    rf"^\s*(?P<time>(?:\\[dt]?frac\s*\{{\s*{_D}\s*\}}\s*\{{\s*{_D}\s*t\s*\}}|d\s*/\s*dt))?\s*(?:\\left|\\[bB]igg?l?)?\s*[(\[{{]?\s*{_BY}\s*(?:\\right|\\[bB]igg?r?)?\s*[)\]}}]?\s*$"
)


def rows_of_partial(
    statements: Sequence[Statement], names: Names, data: Mapping[str, Any]
) -> tuple[list[str], list[tuple[str, str]]]:
    """Rows that these make, and pairs that must be equal. Raises InvalidInput where they say less than a row."""
    rates: dict[str, str] = {}
    slopes: dict[str, str] = {}
    derived: dict[str, str] = {}
    steps: list[tuple[str, str]] = []
    for sides in statements:
        found = [BY.match(side) for side in sides]
        plain = [side for side, by in zip(sides, found, strict=True) if by is None]
        by = next((m for m in found if m), None)
        if (
            by is None
            or not plain
            or len([m for m in found if m]) > 1
            or any(re.search(r"\\partial|∂", side) for side in plain)
        ):
            raise _refusal(sides)
        dotted = next((by[g] for g in ("a", "b", "a2", "b2") if by[g]), None)
        own = plain_name((dotted or by["c"] or by["c2"] or "") + (by["i"] or by["i2"] or ""))
        if own not in names.coordinates or (by["time"] and dotted is None):
            raise _refusal(sides)
        table = derived if by["time"] else rates if dotted else slopes
        if own in table:
            raise InvalidInput(f"{sides[0].strip()[:40]} is said twice; give each once")
        table[own] = plain[-1]
        steps += [(side, plain[-1]) for side in plain[:-1]]
    rows = []
    for own in names.coordinates:
        if own not in {**rates, **derived, **slopes}:
            continue
        if own not in slopes or not (own in rates or own in derived):
            raise InvalidInput(
                f"of {own}, one of ∂L/∂{own} and ∂L/∂({own})' alone is said; give both, or leave both out"
            )
        by_time = rf"\frac{{d}}{{dt}}\left({rates[own]}\right)" if own in rates else ""
        if own in rates and own in derived:
            steps.append((by_time, derived[own]))
        rows.append(f"{derived.get(own, by_time)} - \\left({slopes[own]}\\right) = {_force(own, names, data)}")
    return rows, steps


def is_law(sides: Sequence[str]) -> bool:
    r"""Whether sides are Lagrange's equation for some letter, d/dt ∂L/∂q̇ - ∂L/∂q = 0 or d/dt ∂L/∂q̇ = ∂L/∂q."""
    for side in sides:
        for minus in re.finditer(r"[-−]", side):
            if _are_one_coordinate(side[: minus.start()], side[minus.end() :]):
                return True
    return any(_are_one_coordinate(one, two) for one, two in pairwise(sides))


def _are_one_coordinate(by_rate: str, by_place: str) -> bool:
    one, two = BY.match(by_rate), BY.match(by_place)
    if one is None or two is None or not one["time"] or two["time"]:
        return False
    dotted = next((one[g] for g in ("a", "b", "a2", "b2") if one[g]), None)
    rate = plain_name((dotted or "") + (one["i"] or one["i2"] or ""))
    return rate is not None and rate == plain_name(two["c"] or two["c2"] or "")


def _refusal(sides: Statement) -> InvalidInput:
    return InvalidInput(f"{' = '.join(sides).strip()[:50]!r}: a derivative of an energy; give the Lagrangian in a field of its own, "
                        "and the equations that follow")  # fmt: skip


def _force(own: str, names: Names, data: Mapping[str, Any]) -> str:
    """What stands on the right of Lagrange's equation of a coordinate."""
    bodies = [b for b in data.get("bodies", []) if isinstance(b, dict)]
    if not names.driven:
        return "0"
    simple = all(
        "friction" not in b and "motion" not in b
        and (k == 0 or names.relative or b.get("joint") == "slide" or not {"drive", "damping"} & b.keys() or not any(
            not slide for slide in names.slides[:k]))
        for k, b in enumerate(bodies)
    )  # fmt: skip
    if not simple:
        raise InvalidInput(
            "derivatives of the Lagrangian beside forces: give the Lagrangian in a field of its own, and the equations"
        )
    body = bodies[names.coordinates.index(own)]
    drive = f"({body['drive']})" if "drive" in body else "0"
    return drive + (f" - ({body['damping']}) \\dot{{{spelled(own)}}}" if "damping" in body else "")
