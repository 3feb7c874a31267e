"""Audits both documents: each of the 57 numbered equations, as printed, against first principles.

Exactly (in symbols) for few angles, in ball arithmetic at random points for many. ``furiko audit`` prints it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from functools import lru_cache
from typing import Any, Literal

import numpy as np

from ...reference import EQUATIONS, SLIPS, Equation
from ..algebra.symbols import symbols_of
from ..algebra.trig import constant
from .claims import SOLVES, differences
from .cost import costs_of
from .exact import array, exact_values
from .open_questions import Question, open_questions

Judgement = Literal["holds", "holds-if", "misprint"]
BITS = 256
EXACT_SIZES, BALL_SIZES, POINTS = (2, 3, 4), (6, 10), 2


@dataclass(frozen=True)
class JudgedEquation:
    """One equation. ``evidence`` says how it was judged; the rest is for misprints and conditions."""

    document: str
    number: str
    judgement: Judgement
    says: str
    formula: str
    evidence: dict[str, Any]
    condition: str = ""
    printed: str = ""
    correction: str = ""
    costs: tuple[dict[str, Any], ...] = ()


@dataclass(frozen=True)
class Audit:
    """The whole audit. ``slips`` stand outside the numbered formulas and were found by reading, not by computing."""

    equations: tuple[JudgedEquation, ...]
    slips: tuple[dict[str, str], ...]
    open_questions: tuple[Question, ...] = field(default=())

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "equations": [asdict(judged) for judged in self.equations],
            "slips": list(self.slips),
            "open_questions": [question.to_dict() for question in self.open_questions],
        }

    @property
    def counts(self) -> dict[str, int]:
        """How many equations were judged how."""
        kinds = [judged.judgement for judged in self.equations]
        return {kind: kinds.count(kind) for kind in ("holds", "holds-if", "misprint")}

    def text(self) -> str:
        """For a terminal."""
        return "\n".join(_lines(self))


def audit() -> Audit:
    """Judge all 57 equations, and settle what the documents leave open."""
    return Audit(
        tuple(judge(equation) for equation in EQUATIONS),
        tuple({"found": "by reading", **asdict(slip)} for slip in SLIPS),
        tuple(open_questions()),
    )


def judge(equation: Equation) -> JudgedEquation:
    """Judge one equation by what is printed; where that fails, its correction must hold."""
    evidence = _evidence(equation, as_printed=True)
    misprint = not evidence["holds"]
    if misprint:
        evidence["corrected"] = _evidence(equation, as_printed=False)
        if not evidence["corrected"]["holds"]:
            raise AssertionError(f"{equation.label}: neither what is printed nor its correction holds")
    condition = equation.condition and _condition_needed(equation)
    judgement: Judgement = "misprint" if misprint else "holds-if" if condition else "holds"
    return JudgedEquation(
        equation.document, equation.number, judgement, _says(equation, judgement), equation.formula, evidence,
        equation.condition if condition else "", equation.printed_formula, equation.correction if misprint else "",
        tuple(cost.to_dict() for cost in costs_of(_key(equation))) if misprint else (),
    )  # fmt: skip


def _key(equation: Equation) -> str:
    return f"{equation.document} {equation.number}"


def _says(equation: Equation, judgement: Judgement) -> str:
    if judgement == "misprint":
        return f"{equation.says}: misprint: {equation.correction}"
    return f"{equation.says}: holds" + (f" if {equation.condition}" if judgement == "holds-if" else "")


# Evidence -------------------------------------------------------------------------------------------------------------


def _evidence(equation: Equation, as_printed: bool) -> dict[str, Any]:
    """Whether the equation holds, and how that is known."""
    exact = [n for n in _sizes(equation, EXACT_SIZES) if _key(equation) not in SOLVES]
    symbols = {n: _holds_exactly(equation, n, as_printed) for n in exact}
    points = [_at_point(equation, n, seed, as_printed) for n in _sizes(equation, BALL_SIZES) for seed in range(POINTS)]
    refuted = [point for point in points if not point["holds"]]
    evidence: dict[str, Any] = {
        "holds": all(symbols.values()) and not refuted,
        "in symbols": {str(n): holds for n, holds in symbols.items()},
        "in balls": {
            "angles": sorted({point["n"] for point in points}), "points": len(points),
            "largest enclosure of a difference": max(point["largest"] for point in points if point["holds"])
            if len(refuted) < len(points) else None,
        },
    }  # fmt: skip
    if refuted:
        evidence["proof that it fails"] = refuted[0]["proof"]
    else:
        evidence["probability of error"] = (
            "none for the sizes in symbols; for the others a false equation would have to agree with first "
            f"principles to more than 200 bits at {len(points)} random points of 40 bits a symbol: below 1e-30"
        )
    return evidence


def _sizes(equation: Equation, sizes: tuple[int, ...]) -> tuple[int, ...]:
    """The numbers of angles that an equation is about."""
    if equation.document == "shiki":
        return {"1": (2,), "2": (3,), "3": sizes}[equation.number[0]]
    return (2,) if equation.number == "19" else sizes


def _holds_exactly(equation: Equation, n: int, as_printed: bool) -> bool:
    values = _exact(equation.document, n, equation.number == "19" and equation.document == "takeno")
    members = equation.printed_members(values) if as_printed else equation.members(values)
    return all(x.vanishes() for x in differences(_key(equation), members, values))


@lru_cache(maxsize=16)
def _exact(document: str, n: int, equal_lengths: bool) -> dict[str, Any]:
    values = exact_values(symbols_of(_kind(document), n), equal_lengths)
    return values | {"e": array([constant(1)] * n), "index": 0}


def _kind(document: str) -> str:
    return "n-leg" if document == "shiki" else "rod-chain"


def _at_point(equation: Equation, n: int, seed: int, as_printed: bool) -> dict[str, Any]:
    from .balls import ball_values

    with _precision():
        values = ball_values(_kind(equation.document), n, seed, _key(equation) == "takeno 19", _key(equation) in SOLVES)
        members = equation.printed_members(values) if as_printed else equation.members(values)
        balls = differences(_key(equation), members, values)
        wrong = next((ball for ball in balls if not ball.contains(0)), None)
        largest = max(float(abs(ball).upper()) for ball in balls)
        proof = "" if wrong is None else f"at a random point, a difference that must vanish lies in {wrong.str(8)}"
    return {"n": n, "holds": wrong is None, "largest": largest, "proof": proof}


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


# For a terminal -------------------------------------------------------------------------------------------------------


def _lines(result: Audit) -> Iterator[str]:
    counts = result.counts
    yield (
        f"{len(result.equations)} equations: {counts['holds']} hold, {counts['holds-if']} hold with a condition left "
        f"unsaid, {counts['misprint']} are misprinted."
    )
    for judged in result.equations:
        mark = {"holds": " ", "holds-if": "?", "misprint": "!"}[judged.judgement]
        yield f"{mark} {judged.document.title():6s} {'(' + judged.number + ')':7s} {judged.says}"
        if judged.judgement == "misprint":
            yield f"         printed: {judged.printed}"
            yield f"         right:   {judged.formula}"
        for cost in judged.costs:
            yield (
                f"         as printed ({cost['reading']}): accelerations off by {cost['median_error']:.1%} (median), "
                f"{cost['largest_error']:.1%} (most); 0.1 rad off after {_time(cost['divergence_small'])} from a small "
                f"swing, {_time(cost['divergence_large'])} from a large one"
            )
    yield f"Slips outside the numbered formulas ({len(result.slips)}, found by reading):"
    for slip in result.slips:
        yield f"  {slip['document'].title()}, {slip['where']}: {slip['printed']} → {slip['right']} ({slip['says']})"
    for question in result.open_questions:
        yield f"{question.question}\n  {question.answer}\n  {question.argument}"
        for name, value in question.numbers.items():
            rows = value if isinstance(value, list) else [value]
            yield f"  {name}:"
            yield from (f"    {row}" for row in rows)


def _time(seconds: float | None) -> str:
    return "more than 20 s" if seconds is None else f"{seconds:.2f} s"
