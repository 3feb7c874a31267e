"""Which of three is alone in a scene with a user's own equations: they, the model, or an engine."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

from ..models.trees.own import IN_MODEL, OWN
from ..records.check import Alone, Diagnosis
from .words import count, listed

if TYPE_CHECKING:
    from .report import Report

MOST_SAID = 3  # causes


def alone_in(report: Report) -> tuple[Alone, ...]:
    """One for each scene in which a user's own equations were compared, in the scenes' order."""
    return tuple(
        _alone(report, scene)
        for scene in report.scenes
        if OWN in report.engines and report.table[scene, OWN].outcome in ("agrees", "differs")
    )


def _alone(report: Report, scene: str) -> Alone:
    outcomes = {name: report.table[scene, name].outcome for name in report.engines if name != OWN}
    agree = [name for name, outcome in outcomes.items() if outcome == "agrees"]
    differ = [name for name, outcome in outcomes.items() if outcome == "differs"]
    if report.table[scene, OWN].outcome == "agrees":
        return _equations_right(report, scene, agree, differ)
    diagnosis = _diagnosis(report, scene, OWN)
    why = _said(diagnosis)
    if differ:
        who: Literal["several", "model", "equations"] = "several"
        start = f"your equations and {listed(differ)} differ from the theory of the model: none is alone"
    elif diagnosis is not None and diagnosis.findings and all(x.where.startswith(IN_MODEL) for x in diagnosis.findings):
        who = "model"
        read_so = f", as the theory{_and(agree)} have it," if agree else ""
        start = f"the model{read_so} is alone: your equations are right for another"
    else:
        who = "equations"
        start = f"your equations are alone: the theory of the model{_and(agree)} agree"
        if not agree:
            start = "your equations differ from the theory of the model; no engine was compared"
    return Alone(scene=scene, who=who, names=[OWN] if who == "equations" else differ, says=f"{scene}: {start}. {why}")


def _equations_right(report: Report, scene: str, agree: Sequence[str], differ: Sequence[str]) -> Alone:
    all_right = f"your equations{',' if agree else ' and'} the theory of the model{_and(agree)}"
    if not differ:
        return Alone(scene=scene, who="nobody", names=[], says=f"{scene}: {all_right} agree.")
    why = " ".join(said for name in differ if (said := _said(_diagnosis(report, scene, name))))
    verb = "is" if len(differ) == 1 else "are"
    says = f"{scene}: {listed(differ)} {verb} alone: {all_right} agree. {why}"
    return Alone(scene=scene, who="engine", names=list(differ), says=says.strip())


def _and(agree: Sequence[str]) -> str:
    """The engines that agree, behind something; empty if there are none."""
    return f" and {count(len(agree), 'engine')}" if agree else ""


def _diagnosis(report: Report, scene: str, engine: str) -> Diagnosis | None:
    return next((x for x in report.diagnoses if (x.scene, x.engine) == (scene, engine)), None)


def _said(diagnosis: Diagnosis | None) -> str:
    found = [] if diagnosis is None else [*diagnosis.findings, *diagnosis.alternatives]
    said = [x.says.rstrip(".") for x in found[:MOST_SAID]]
    more = f"; and {len(found) - MOST_SAID} more" if len(found) > MOST_SAID else ""
    return f"Why: {'; '.join(said)}{more}." if said else ""
