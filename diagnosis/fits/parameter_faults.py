"""Numbers of the mechanism, or terms of the engine's code, that are not what was expected: one, all of one kind, two,
or a few at once, by fits.

A hypothesis is named only if its fit leaves nothing that rounding does not explain, neither in the states of the fit
nor in others; where several fit equally well, all are named.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ...reference.planar_tree import Parameters
from ..explanation import Explanation
from ..finding import Finding
from ..measurement import has_inverse_dynamics
from ..question import Question
from .fitting import FittedHypothesis, fit, refit, screen, screened
from .hypotheses import Hypothesis, combined, factors, groups, singles
from .term_faults import term_hypotheses
from .wording import findings_of_fit

FITTED = 14  # hypotheses fitted in full, out of all that were screened
FITTED_PAIRS = 24
REFITTED = 10  # of those, at most, with the terms of the numbers fitted
FITTED_BESIDE_OTHERS = 5  # the same when one is added to others
MOST_AT_ONCE = 4  # hypotheses in one explanation
MOST_ALTERNATIVES = 6  # pairs that are named where several explain the same
AS_GOOD = 20.0  # a fit whose residual is this many times the best fit's is not as good
ROUNDING_RESIDUAL = 0.02  # residual of every right fit, in units of what rounding may
MOST_LINKS = 60  # up to which parameters are fitted; the cost grows with their cube
MOST_LINKS_OF_PAIRS = 20
IMPLAUSIBLE_FACTOR = 1e-6  # a factor beyond this or its inverse leaves another mechanism, not a faulty one
CLEAR_IMPROVEMENT = 8.0  # by this factor one number must lessen the residual to be no accident
BLUNTER = 100.0  # a fit with tolerances larger by more than this shows nothing
CLEARLY_CHANGED = 30  # standard deviations by which a value is off


def slight_fault(q: Question) -> Explanation:
    """One number that is off by so little that only all states together show it: rounding has no such pattern.

    Only where the largest residual is below 1 but above :data:`ROUNDING_RESIDUAL`.
    """
    if q.m.n > MOST_LINKS or q.measured.worst(q.p) <= ROUNDING_RESIDUAL:
        return Explanation()
    residuals = q.measured.residuals(q.p, q.measured.tolerances(q.p))
    before = float(np.sqrt(np.mean(residuals**2)))
    hypotheses = singles(q.m, q.p)
    ranked = screened(hypotheses, q.p, q.measured)[:FITTED]
    promising = [hypothesis for after, hypothesis in ranked if after * CLEAR_IMPROVEMENT < before]
    fits = [fit(hypothesis, q.p, q.measured) for hypothesis in promising]
    clear = [
        f
        for f in fits
        if f.residual <= ROUNDING_RESIDUAL and (np.abs(f.values) > np.maximum(f.uncertainty, 1e-300)).any()
    ]
    return _explanation(_as_good(clear), hypotheses, q)


def wrong_numbers(q: Question) -> Explanation:
    """One number, one factor for all links, one term of the code, or all numbers of a kind, that explain the motion."""
    if q.m.n > MOST_LINKS:
        return Explanation()
    hypotheses = singles(q.m, q.p)
    found = _explanation(_as_good(_explaining(_best(hypotheses, q), q)), hypotheses, q)
    if found:
        return found
    every = factors(q.m, q.p)
    found = _explanation(_as_good(_explaining((fit(h, q.p, q.measured) for h in every), q)), every, q)
    if found:
        return found
    terms = term_hypotheses(q.m, _two_ways(q))
    found = _explanation(_named_first(_as_good(_explaining(_best(terms, q), q)), q.p), terms, q)
    if found:
        return found
    fits = _explaining((fit(hypothesis, q.p, q.measured) for hypothesis in groups(q.m, q.p)), q)
    good = _as_good(fits)
    if not good:
        return Explanation()
    fewest = min(good, key=_changed)
    # Two numbers of one kind: there may be two of different kinds that explain it as well.
    pairs = two_at_once(q) if _changed(fewest) == 2 else Explanation()
    return pairs if pairs.explained else _explanation([fewest], [], q)


def two_at_once(q: Question) -> Explanation:
    """Two numbers or terms at once, whichever of all pairs leave nothing."""
    if q.m.n > MOST_LINKS_OF_PAIRS:
        return Explanation()
    hypotheses = [*singles(q.m, q.p), *factors(q.m, q.p), *term_hypotheses(q.m, _two_ways(q))]
    pairs = screen(hypotheses, q.p, q.measured).pairs(FITTED_PAIRS)
    fits = _explaining(_refitted([fit(combined(pair), q.p, q.measured) for pair in pairs], q), q)
    clear = [f for f in fits if all(_any_clearly_changed(part) for part in f.parts())]
    good = _named_first(_as_good(clear), q.p)
    place = {id(hypothesis): i for i, hypothesis in enumerate(hypotheses)}
    good.sort(key=lambda f: sum(place[id(part)] for part in f.hypothesis.parts))
    return _explanation(good[:MOST_ALTERNATIVES], [], q)


def several_at_once(q: Question) -> Explanation:
    """A few numbers or terms at once: the one that leaves the least, then the next beside it, fitted together."""
    if q.m.n > MOST_LINKS:
        return Explanation()
    hypotheses = [*singles(q.m, q.p), *factors(q.m, q.p), *term_hypotheses(q.m, _two_ways(q))]
    chosen: list[Hypothesis] = []
    at = q.p
    for _ in range(MOST_AT_ONCE):
        ranked = screened(hypotheses, at, q.measured)[:FITTED_BESIDE_OTHERS]
        fits = [fit(combined([*chosen, added]), q.p, q.measured) for _, added in ranked if added not in chosen]
        if not fits:
            return Explanation()
        best = min(fits, key=lambda f: f.residual)
        explaining = _explaining(fits, q)
        if explaining:
            good = _named_first(_as_good(explaining), q.p)
            good.sort(key=lambda f: hypotheses.index(f.hypothesis.parts[-1]))
            return _explanation(good, [], q)
        chosen = list(best.hypothesis.parts)
        at = best.hypothesis.apply(q.p, best.values)
    return Explanation()


def _refitted(fits: list[FittedHypothesis], q: Question) -> list[FittedHypothesis]:
    """The fits, the best of those of a number and a term continued."""
    mixed = [f for f in fits if len({part.basis is None for part in f.hypothesis.parts}) == 2]
    promising = sorted(mixed, key=lambda f: f.residual)[:REFITTED]
    return [refit(f, q.p, q.measured) if f in promising else f for f in fits]


def _two_ways(q: Question) -> bool:
    return has_inverse_dynamics(q.engine) and bool((~q.measured.forward).any())


def _best(hypotheses: Sequence[Hypothesis], q: Question) -> list[FittedHypothesis]:
    return [fit(hypothesis, q.p, q.measured) for _, hypothesis in screened(hypotheses, q.p, q.measured)[:FITTED]]


def _explaining(fits: Iterable[FittedHypothesis], q: Question) -> list[FittedHypothesis]:
    """Those that are possible and leave nothing, in the states of the fit and in others."""
    possible = [f for f in fits if f.explains and not _impossible(f, q.p)]
    return [f for f in possible if _as_sharp(f, q) and f.worst(q.p, q.again) <= 1]


def _as_sharp(f: FittedHypothesis, q: Question) -> bool:
    """Whether rounding explains about as much as before: with numbers large enough it explains any difference.

    Nor may a hinge be left with nothing to move, whose equation any acceleration then solves.
    """
    with np.errstate(all="ignore"):
        tolerances = q.measured.tolerances(f.hypothesis.apply(q.p, f.values))
        before = q.measured.tolerances(q.p)
    forward = q.measured.forward
    least = IMPLAUSIBLE_FACTOR * np.median(before[forward], axis=0)
    moves = bool((np.median(tolerances[forward], axis=0) >= least).all()) if forward.any() else True
    return moves and float(np.median(tolerances)) <= BLUNTER * q.scale


def _as_good(fits: list[FittedHypothesis]) -> list[FittedHypothesis]:
    """Those whose residual is about as small as the best one's, with as few values as any of them."""
    if not fits:
        return []
    best = min(f.residual for f in fits)
    good = [f for f in fits if f.residual <= max(AS_GOOD * best, ROUNDING_RESIDUAL)]
    fewest = min(f.hypothesis.d for f in good)
    return [f for f in good if f.hypothesis.d == fewest]


def _named_first(fits: list[FittedHypothesis], p: Parameters) -> list[FittedHypothesis]:
    """Where some are mistakes with a name, those alone: a factor without one is rather an accident."""
    named = [f for f in fits if all(_has_name(part, p) for part in f.parts() or [f])]
    return named or fits


def _has_name(f: FittedHypothesis, p: Parameters) -> bool:
    return f.hypothesis.known is None or f.hypothesis.known(float(f.values[0]), p)


def _changed(f: FittedHypothesis) -> int:
    """How many values are clearly not zero."""
    return int((np.abs(f.values) > CLEARLY_CHANGED * np.maximum(f.uncertainty, 1e-300)).sum())


def _any_clearly_changed(f: FittedHypothesis) -> bool:
    return _changed(f) > 0


def _explanation(fits: Sequence[FittedHypothesis], order: Sequence[Hypothesis], q: Question) -> Explanation:
    """A set of findings for each fit, in the hypotheses' ``order``; each set once."""
    place = {id(hypothesis): i for i, hypothesis in enumerate(order)}
    sets: dict[frozenset[tuple[str, str]], tuple[Finding, ...]] = {}
    for found in sorted(fits, key=lambda f: place.get(id(f.hypothesis), 0)):
        parts = found.parts() or [found]
        changed = [part for part in parts if _any_clearly_changed(part)] or parts
        findings = tuple(finding for part in changed for finding in findings_of_fit(part, q.m, q.p, q.who))
        sets.setdefault(frozenset((finding.cause, finding.where) for finding in findings), findings)
    return Explanation(tuple(sets.values()))


def _impossible(found: FittedHypothesis, p: Parameters) -> bool:
    """No mass is left, so that nothing has a residual; or a part that cannot be: see :func:`_cannot_be`."""
    left = float(np.sum(found.hypothesis.apply(p, found.values).mass))
    if left <= IMPLAUSIBLE_FACTOR * float(np.sum(p.mass)):
        return True
    return any(_cannot_be(part, p) for part in found.parts() or [found])


def _cannot_be(found: FittedHypothesis, p: Parameters) -> bool:
    """A hinge that drives itself, a negative mass, a factor that leaves a link without size, half another function."""
    hypothesis = found.hypothesis
    if hypothesis.wanted is not None:
        off = max(1e-6, CLEARLY_CHANGED * float(found.uncertainty[0]))
        return abs(float(found.values[0]) - hypothesis.wanted) > off
    if hypothesis.basis is not None or hypothesis.cause == "gravity":
        return False
    if hypothesis.relative:
        factor, spread = 1 + float(found.values[0]), float(found.uncertainty[0])
        one_of_several = hypothesis.links[0] >= 0 and len(p.mass) > 1  # without any mass nothing has a residual
        without_mass = one_of_several and hypothesis.cause == "mass" and abs(factor) <= max(1e-9, 30 * spread)
        return not without_mass and not IMPLAUSIBLE_FACTOR < factor < 1 / IMPLAUSIBLE_FACTOR
    for name, i, value, spread in zip(hypothesis.names, hypothesis.links, found.values, found.uncertainty, strict=True):
        if name not in ("armature", "damping", "friction", "stiffness", "mass", "inertia"):
            continue
        if float(p.items()[name][i]) + value < -CLEARLY_CHANGED * spread:
            return True
    return False
