"""Numbers of the mechanism that are not what was expected: one, all of one kind, or a few at once, by fits.

A hypothesis is named only if its fit leaves nothing that rounding does not explain; where several fit equally well,
all are named.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..models.mechanism import Mechanism
from ..reference.planar_tree import Parameters
from .finding import Finding
from .fitting import FittedHypothesis, fit, screened
from .hypotheses import Hypothesis, combined, groups, singles
from .measurement import Measurement
from .wording import findings_of_fit

FITTED = 14  # hypotheses fitted in full, out of all that were screened
FITTED_BESIDE_OTHERS = 5  # the same when one is added to others
MOST_AT_ONCE = 4  # hypotheses in one explanation
AS_GOOD = 20.0  # a fit whose residual is this many times the best fit's is not as good
ROUNDING_RESIDUAL = 0.02  # residual of every right fit, in units of what rounding may
MOST_LINKS = 60  # up to which parameters are fitted; the cost grows with their cube
IMPLAUSIBLE_FACTOR = 1e-6  # a factor beyond this or its inverse leaves another mechanism, not a faulty one
CLEAR_IMPROVEMENT = 8.0  # by this factor one number must lessen the residual to be no accident
CLEARLY_CHANGED = 30  # standard deviations by which a value is off


def slight_fault(m: Mechanism, p: Parameters, measured: Measurement, who: str) -> list[Finding]:
    """One number that is off by so little that only all states together show it: rounding has no such pattern.

    Only where the largest residual is below 1 but above :data:`ROUNDING_RESIDUAL`.
    """
    if m.n > MOST_LINKS or measured.worst(p) <= ROUNDING_RESIDUAL:
        return []
    residuals = measured.residuals(p, measured.tolerances(p))
    before = float(np.sqrt(np.mean(residuals**2)))
    hypotheses = singles(m, p)
    ranked = screened(hypotheses, p, measured)[:FITTED]
    promising = [hypothesis for after, hypothesis in ranked if after * CLEAR_IMPROVEMENT < before]
    fits = [fit(hypothesis, p, measured) for hypothesis in promising]
    clear = [
        f
        for f in fits
        if f.residual <= ROUNDING_RESIDUAL and (np.abs(f.values) > np.maximum(f.uncertainty, 1e-300)).any()
    ]
    return _findings(_as_good(clear), hypotheses, m, p, who) if clear else []


def wrong_parameters(
    engine: Any, m: Mechanism, p: Parameters, measured: Measurement, compiled: Mechanism | None, who: str
) -> list[Finding]:
    """Single parameters, all parameters of a kind, then several parameters that explain the engine's motion."""
    if m.n > MOST_LINKS:
        return []
    hypotheses = singles(m, p)
    fits = [fit(hypothesis, p, measured) for _, hypothesis in screened(hypotheses, p, measured)[:FITTED]]
    explaining = _as_good([f for f in fits if f.explains and not _impossible(f, p)])
    if explaining:
        return _findings(explaining, hypotheses, m, p, who)
    fits = [fit(hypothesis, p, measured) for hypothesis in groups(m, p)]
    explaining = _as_good([f for f in fits if f.explains and not _impossible(f, p)])
    if explaining:
        fewest = min(explaining, key=_changed)  # the first of those that change the fewest values
        return _findings([fewest], [], m, p, who)
    return _several(hypotheses, m, p, measured, who)


def _as_good(fits: list[FittedHypothesis]) -> list[FittedHypothesis]:
    """Those whose residual is about as small as the best one's, with as few values as any of them."""
    if not fits:
        return []
    best = min(f.residual for f in fits)
    good = [f for f in fits if f.residual <= max(AS_GOOD * best, ROUNDING_RESIDUAL)]
    fewest = min(f.hypothesis.d for f in good)
    return [f for f in good if f.hypothesis.d == fewest]


def _changed(f: FittedHypothesis) -> int:
    """How many values are clearly not zero."""
    return int((np.abs(f.values) > CLEARLY_CHANGED * np.maximum(f.uncertainty, 1e-300)).sum())


def _findings(
    fits: list[FittedHypothesis], order: Sequence[Hypothesis], m: Mechanism, p: Parameters, who: str
) -> list[Finding]:
    """Findings of fits that explain equally well, in the hypotheses' ``order``; one for each cause and place."""
    place = {id(hypothesis): i for i, hypothesis in enumerate(order)}
    findings: list[Finding] = []
    for found in sorted(fits, key=lambda f: place.get(id(f.hypothesis), 0)):
        for finding in findings_of_fit(found, m, p, who):
            if all((finding.cause, finding.where) != (other.cause, other.where) for other in findings):
                findings.append(finding)
    if len(fits) > 1 and len(findings) > 1:
        others = len(findings) - 1
        note = f"{others} other cause{'s' * (others > 1)} would explain it equally well"
        findings = [replace(f, says=f"{f.says}; {note}") for f in findings]
    return findings


def _impossible(found: FittedHypothesis, p: Parameters) -> bool:
    """A hinge that drives itself, a negative mass, or a factor that leaves a link without size."""
    hypothesis = found.hypothesis
    if hypothesis.relative and hypothesis.cause != "gravity":
        return not IMPLAUSIBLE_FACTOR < 1 + float(found.values[0]) < 1 / IMPLAUSIBLE_FACTOR
    for name, i, value, spread in zip(hypothesis.names, hypothesis.links, found.values, found.uncertainty, strict=True):
        if hypothesis.relative or name not in ("armature", "damping", "friction", "stiffness", "mass", "inertia"):
            continue
        if float(p.items()[name][i]) + value < -CLEARLY_CHANGED * spread:
            return True
    return False


def _several(
    hypotheses: Sequence[Hypothesis], m: Mechanism, p: Parameters, measured: Measurement, who: str
) -> list[Finding]:
    """A few parameters at once: the one that leaves the least residual, then the next beside it, fitted together."""
    chosen: list[Hypothesis] = []
    at = p
    for _ in range(MOST_AT_ONCE):
        ranked = screened(hypotheses, at, measured)[:FITTED_BESIDE_OTHERS]
        fits = [fit(combined([*chosen, added]), p, measured) for _, added in ranked if added not in chosen]
        if not fits:
            return []
        best = min(fits, key=lambda f: f.residual)
        fits = [f for f in fits if not _impossible(f, p)] or fits
        explaining = [f for f in fits if f.explains]
        if explaining:
            best = _as_good(explaining)[0]
        chosen = list(best.hypothesis.parts)
        at = best.hypothesis.apply(p, best.values)
        if best.explains:
            changed = [part for part in best.parts() if _any_clearly_changed(part)]
            return [finding for part in changed for finding in findings_of_fit(part, m, p, who)]
    return []


def _any_clearly_changed(f: FittedHypothesis) -> bool:
    return bool((np.abs(f.values) > CLEARLY_CHANGED * f.uncertainty).any())
