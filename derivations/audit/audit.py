"""Audits both documents: each of the 57 numbered equations, and Takeno's other displays, against first principles.

Exactly (in symbols) for few angles, in ball arithmetic at random points for many. ``furiko audit`` prints it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from msgspec import UNSET, structs

from ...reference import EQUATIONS, SLIPS, UNNUMBERED, Equation
from ..algebra.symbols import symbols_of
from ..algebra.trig import constant
from .audit_record import Audit, BallEvidence, Evidence, FoundSlip, JudgedEquation, Judgement
from .claims import EQUAL_LENGTHS, SOLVES, differences
from .cost import costs_of
from .exact import array, exact_values
from .open_questions import open_questions

BITS = 256
EXACT_SIZES, BALL_SIZES, POINTS = (2, 3, 4), (6, 10), 2


@dataclass(frozen=True)
class PointResult:
    """One equation at one random point: whether all differences contain zero; the widest, or a proof that it fails."""

    n: int
    holds: bool
    largest: float
    proof: str


def audit() -> Audit:
    """Judge all 57 equations and the displays without a number, and settle what the documents leave open."""
    return Audit(
        tuple(judge(equation) for equation in EQUATIONS),
        tuple(
            FoundSlip("by reading", slip.document, slip.where, slip.printed, slip.right, slip.says) for slip in SLIPS
        ),
        tuple(open_questions()),
        tuple(judge(display) for display in UNNUMBERED),
    )


def judge(equation: Equation) -> JudgedEquation:
    """Judge one equation by what is printed; where that fails, its correction must hold."""
    evidence = _evidence(equation, as_printed=True)
    misprint = not evidence.holds
    if misprint:
        corrected = _evidence(equation, as_printed=False)
        evidence = structs.replace(evidence, corrected=corrected)
        if not corrected.holds:
            raise AssertionError(f"{equation.label}: neither what is printed nor its correction holds")
    condition = equation.condition and _condition_needed(equation)
    judgement: Judgement = "misprint" if misprint else "holds-if" if condition else "holds"
    return JudgedEquation(
        equation.document, equation.number, judgement, _says(equation, judgement), equation.formula, evidence,
        equation.condition if condition else "", equation.printed_formula, equation.correction if misprint else "",
        tuple(costs_of(_key(equation))) if misprint else (),
    )  # fmt: skip


def _key(equation: Equation) -> str:
    return f"{equation.document} {equation.number}"


def _says(equation: Equation, judgement: Judgement) -> str:
    if judgement == "misprint":
        return f"{equation.says}: misprint: {equation.correction}"
    return f"{equation.says}: holds" + (f" if {equation.condition}" if judgement == "holds-if" else "")


# Evidence -------------------------------------------------------------------------------------------------------------


def _evidence(equation: Equation, as_printed: bool) -> Evidence:
    """Whether the equation holds, and how that is known."""
    exact = [n for n in _sizes(equation, EXACT_SIZES) if _key(equation) not in SOLVES]
    symbols = {str(n): _holds_exactly(equation, n, as_printed) for n in exact}
    points = [_at_point(equation, n, seed, as_printed) for n in _sizes(equation, BALL_SIZES) for seed in range(POINTS)]
    refuted = [point for point in points if not point.holds]
    balls = BallEvidence(
        tuple(sorted({point.n for point in points})),
        len(points),
        max((point.largest for point in points if point.holds), default=None),
    )
    probability = (
        "none for the sizes in symbols; for the others a false equation would have to agree with first "
        f"principles to more than 200 bits at {len(points)} random points of 40 bits a symbol: below 1e-30"
    )
    return Evidence(
        all(symbols.values()) and not refuted,
        symbols,
        balls,
        refuted[0].proof if refuted else UNSET,
        UNSET if refuted else probability,
    )


def _sizes(equation: Equation, sizes: tuple[int, ...]) -> tuple[int, ...]:
    """The numbers of angles that an equation is about."""
    if equation.document == "shiki":
        return {"1": (2,), "2": (3,), "3": sizes}[equation.number[0]]
    return (2,) if equation.number == "19" else sizes


def _holds_exactly(equation: Equation, n: int, as_printed: bool) -> bool:
    values = _exact(equation.document, n, _key(equation) in EQUAL_LENGTHS)
    members = equation.printed_members(values) if as_printed else equation.members(values)
    return all(x.vanishes() for x in differences(_key(equation), members, values))


@lru_cache(maxsize=16)
def _exact(document: str, n: int, equal_lengths: bool) -> dict[str, Any]:
    values = exact_values(symbols_of(_kind(document), n), equal_lengths)
    return values | {"e": array([constant(1)] * n), "index": 0}


def _kind(document: str) -> str:
    return "n-leg" if document == "shiki" else "rod-chain"


def _at_point(equation: Equation, n: int, seed: int, as_printed: bool) -> PointResult:
    from .balls import ball_values

    with _precision():
        values = ball_values(
            _kind(equation.document), n, seed, _key(equation) in EQUAL_LENGTHS, _key(equation) in SOLVES
        )
        members = equation.printed_members(values) if as_printed else equation.members(values)
        balls = differences(_key(equation), members, values)
        wrong = next((ball for ball in balls if not ball.contains(0)), None)
        largest = max(float(abs(ball).upper()) for ball in balls)
        proof = "" if wrong is None else f"at a random point, a difference that must vanish lies in {wrong.str(8)}"
    return PointResult(n, wrong is None, largest, proof)


def _precision() -> Any:
    from flint import ctx

    return ctx.workprec(BITS)


# Conditions -----------------------------------------------------------------------------------------------------------


def _condition_needed(equation: Equation) -> bool:
    """Whether the equation fails where its unsaid condition is not met."""
    return _needs_ones(equation) if equation.number == "3.11" else _needs_leg(equation)


def _needs_ones(equation: Equation) -> bool:
    """(3.10) with another e than (1, …, 1)."""
    from .balls import ball_values

    final = next(e for e in EQUATIONS if e.document == equation.document and e.number == "3.10")
    with _precision():
        values = dict(ball_values("n-leg", 4, 0, False, True))
        values["e"] = values["e"] * 2
        balls = differences("shiki 3.10", final.members(values), values)
        return any(not ball.contains(0) for ball in balls)


def _needs_leg(equation: Equation) -> bool:
    """The row for i taken for link 1 itself: link 1 is given a second time, in the place of a leg."""
    from .balls import ball_values

    with _precision():
        values = dict(ball_values("n-leg", 4, 0))
        twice = {
            name: np.concatenate([values[name][:1], values[name][:1], values[name][2:]])
            for name in ("l", "m", "theta", "omega", "alpha")
        }
        members = equation.members(values | twice)
        if equation.number == "3.6":
            found, expected = members[0][1][1], values["momentum_rate"][0]
        elif equation.number == "3.7":
            found, expected = members[0][1], values["dL_dtheta"][0]
        else:
            factor = values["l"][0] if equation.number == "3.9" else 1
            found, expected = (members[0][1] - members[1][1]) * factor, values["row"][0]
        return not (found - expected).contains(0)
