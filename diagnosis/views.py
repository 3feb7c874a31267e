"""Another convention, or a buffer that is not renewed, together with a wrong number or a wrong term."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import chain, islice

import numpy as np

from ..models.coordinates import forces_to_relative
from ..reference import planar_tree as planar
from .buffers import Buffer, buffers
from .conventions import LARGE_RESIDUAL, Convention, conventions, fitting_conventions
from .explanation import Explanation, one_of, with_more
from .fits.fitting import screen
from .fits.hypotheses import Hypothesis, factors, singles
from .fits.parameter_faults import wrong_numbers
from .fits.term_faults import term_hypotheses
from .question import Question, View

MOST_LINKS = 20
MOST_VIEWS = 400  # looked at roughly
LIKELY_VIEWS = 16  # looked at with one wrong number
FITTED_VIEWS = 8  # fitted in full
OF_A_KIND = 2  # of these at most
NO_NAME = "term-wrong"  # the cause of a term with a factor that means nothing
CLEAR = 0.3  # of the residual as measured: what a view and one number must leave no more of


def wrong_convention(q: Question) -> Explanation:
    """The conventions that explain the engine's accelerations, and what its inverse dynamics has besides."""
    found = fitting_conventions(q)
    if not q.measured.forward.all() and q.m.n <= MOST_LINKS:
        for each in found:
            seen = q.seen_as(each.view_of_all)
            more = wrong_numbers(seen) if seen.measured.worst(q.p) > 1 else Explanation()
            if more.explained:
                return with_more(more, [each.finding(q.who)])
    return one_of([each.finding(q.who) for each in found])


def another_view(q: Question) -> Explanation:
    """The first of the views that leaves what one number or term explains."""
    if q.m.n > MOST_LINKS:
        return Explanation()
    before = float(np.sqrt(np.mean(q.measured.residuals(q.p, q.measured.tolerances(q.p)) ** 2))) * q.measured.accuracy
    candidates: list[tuple[float, View, Convention | Buffer]] = []
    known: Iterator[Convention | Buffer] = chain(buffers(q.measured), conventions(q.engine, q.m))
    if q.measured.only(q.measured.forward).worst(q.p) < LARGE_RESIDUAL:
        return Explanation()
    for each in islice(known, MOST_VIEWS):
        for view in [each.view_of_all, each.view] if isinstance(each, Convention) else [each.view]:
            seen = q.seen_as(view)
            size = _size(seen)
            if np.isfinite(size) and seen.measured.worst(q.p) > 1:
                candidates.append((size, view, each))
    # A view that explains most rows is the right one: the fault besides is in the others.
    candidates = [found for found in candidates if found[0] <= q.measured.accuracy] or candidates
    candidates.sort(key=lambda found: found[0])
    hypotheses = [*singles(q.m, q.p), *factors(q.m, q.p), *term_hypotheses(q.m, scopes=False, shapes=False)]
    likely = [(_after(q.seen_as(view), hypotheses), view, each) for _, view, each in candidates[:LIKELY_VIEWS]]
    likely.sort(key=lambda found: found[0])
    without_name: list[Explanation] = []
    for view, each in _best_of_each_kind([found for found in likely if found[0] <= CLEAR * before]):
        found = wrong_numbers(q.seen_as(view))
        if found.explained and isinstance(each, Convention) and view == each.view:
            whole = wrong_numbers(q.seen_as(each.view_of_all))  # what explains inverse dynamics, too, explains more
            found = whole if whole.explained else found
        if found.explained:
            both = with_more(found, [each.finding(q.who)])
            # Rates in degrees, and velocity terms with the square of a degree: the one with a name is the likelier.
            if all(finding.cause != NO_NAME for finding in found.all):
                return both
            without_name.append(both)
    return without_name[0] if without_name else Explanation()


def _best_of_each_kind(
    likely: list[tuple[float, View, Convention | Buffer]],
) -> Iterator[tuple[View, Convention | Buffer]]:
    """The best few, no more than two of a kind: angles in degrees leave little where one kind of term outgrows all, and
    accelerations alone less than with inverse dynamics."""
    kinds = Counter[object]()
    for _, view, each in likely:
        kind = (each.cause, view == each.view) if isinstance(each, Convention) else Buffer
        kinds[kind] += 1
        if kinds[kind] <= OF_A_KIND:
            yield view, each
        if sum(min(count, OF_A_KIND) for count in kinds.values()) == FITTED_VIEWS:
            return


def _size(q: Question) -> float:
    """The median of the residuals over what rounding explains, times ε: a view in which angles have lost digits gains
    nothing by that. Velocity terms of the wrong sign or missing are in every row: the least of the three."""
    seen = q.measured
    with np.errstate(all="ignore"):
        scale = seen.tolerances(q.p)
        velocity = planar.velocity_terms(seen.parents, q.p, seen.theta, seen.omega)
        rates = forces_to_relative(seen.parents, velocity) / scale
        residuals = seen.residuals(q.p, scale)
        return min(float(np.median(np.abs(residuals - times * rates))) for times in (0, 1, 2)) * seen.accuracy


def _after(q: Question, hypotheses: list[Hypothesis]) -> float:
    """The residuals left after one step of the best of the hypotheses, in the same unit."""
    with np.errstate(all="ignore"):
        shown = [hypothesis for hypothesis in hypotheses if not _scales_everything(hypothesis, q)]
    ranked = screen(shown, q.p, q.measured).ranked()
    return ranked[0][0] * q.measured.accuracy if ranked else np.inf


def _scales_everything(hypothesis: Hypothesis, q: Question) -> bool:
    """Whether it multiplies every residual by one factor, as a density does where no torque is given or asked for.

    One step of it leaves nothing of any residual, and shows nothing.
    """
    on_all = q.m.n == 1 or hypothesis.links == (-1,)
    if not hypothesis.relative or not on_all or not q.measured.forward.all():
        return False
    scale = q.measured.tolerances(q.p)
    before = q.measured.residuals(q.p, scale)
    after = q.measured.residuals(hypothesis.apply(q.p, hypothesis.sizes), scale)
    factor = float((after * before).sum() / (before**2).sum())
    return factor != 1 and bool(np.abs(after - factor * before).max() <= 1e-9 * np.abs(before).max())
