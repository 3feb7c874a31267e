"""Of which scenes of a run ``furiko advise`` has more to say: which engine, integrator and step to trust there.

Those where a result is loose, where a motion differs, and where one agrees and is limited by its step. Elsewhere
nothing is said. A scene of the documents needs a motion for that; an open mechanism does not.
"""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

from ..models.trees.own import OWN
from ..records.check import Advisable, Result
from .words import listed, one_line, word

if TYPE_CHECKING:
    from .report import Report

MOTIONS = ("trajectory", "horizon")  # comparisons that rest on an integrator's step
PARTED = 1e-3  # [rad] apart, two trajectories have parted, as the horizon has it
MOST_SAID = 3  # other scenes
Why = Literal["differs", "loose", "limited by its step"]
SAID: dict[Why, str] = {"differs": "differs", "loose": "is loose", "limited by its step": "is limited by its step"}


def advisable_in(report: Report) -> tuple[Advisable, ...]:
    """One for each such scene, those that differ first, then the loose, then those limited by a step."""
    ranked: list[tuple[Result, Why]] = [
        (result, why)
        for chosen in (report.having("differs"), report.loose, report.having("agrees"))
        for result in chosen
        if (why := why_of(result)) and result.engine != OWN and _helped(report, result.scene)
    ]
    first: dict[str, tuple[Result, Why]] = {}
    for result, why in ranked:
        first.setdefault(result.scene, (result, why))
    return tuple(
        Advisable(scene=scene, engine=result.engine, check=result.check, why=why, command=_command(report, scene))
        for scene, (result, why) in first.items()
    )


def why_of(result: Result) -> Why | None:
    """Why advice on its scene helps; None where it does not."""
    if word(result) == "loose":
        return "loose"
    if result.comparison not in MOTIONS:
        return None
    if result.outcome == "differs":
        return "differs"
    return "limited by its step" if result.outcome == "agrees" and _limited(result) else None


def advice_line(found: Sequence[Advisable]) -> str:
    """All of it in one sentence; empty where there is nothing to say."""
    if not found:
        return ""
    first, *others = found
    more = f"; so with {listed([one.scene for one in others], MOST_SAID)}" if others else ""
    return one_line(
        f"{first.command} says which engine, integrator and step keep an error that you ask for "
        f"({first.scene} × {first.engine}, {first.check} {SAID[first.why]}{more})."
    )


def _limited(result: Result) -> bool:
    """Whether a motion that agrees parts from the true one, or is known to no better than that, by its steps alone."""
    if result.comparison == "horizon":
        return result.details.get("parts, measured") is not None
    return result.allowed is not None and result.allowed > PARTED


def _helped(report: Report, scene: str) -> bool:
    """Whether ``furiko advise`` takes the scene: it has a motion, or is an open mechanism."""
    entry = report.scene(scene)
    return entry is not None and (entry.duration > 0 or entry.system == "tree")


def _command(report: Report, scene: str) -> str:
    """What to type: the scene as it was given, and engines that were named, those that integrate."""
    entry = report.scene(scene)
    asked = [engine.name for engine in report.header.engines if engine.asked and engine.name != OWN]
    moving = [name for name in asked if any(_moves(result) for result in report.table[scene, name].results)]
    options = [word for name in moving for word in ("-e", name)]
    return shlex.join(["furiko", "advise", (entry.source if entry else "") or scene, *options])


def _moves(result: Result) -> bool:
    return result.comparison in MOTIONS and result.outcome in ("agrees", "differs")
