"""Another convention, or a buffer that is not renewed, together with a wrong number or a wrong term."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, islice

import numpy as np

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
LIKELY_VIEWS = 12  # looked at with one wrong number
FITTED_VIEWS = 4  # fitted in full
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
    before = float(np.sqrt(np.mean(q.measured.residuals(q.p, q.measured.tolerances(q.p)) ** 2)))
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
    candidates.sort(key=lambda found: found[0])
    hypotheses = [*singles(q.m, q.p), *factors(q.m, q.p), *term_hypotheses(q.m, scopes=False, shapes=False)]
    likely = [(_after(q.seen_as(view), hypotheses), view, each) for _, view, each in candidates[:LIKELY_VIEWS]]
    likely.sort(key=lambda found: found[0])
    for after, view, each in likely[:FITTED_VIEWS]:
        if after > CLEAR * before:
            break
        found = wrong_numbers(q.seen_as(view))
        if found.explained:
            return with_more(found, [each.finding(q.who)])
    return Explanation()


def _size(q: Question) -> float:
    """The median of the residuals over what rounding explains."""
    with np.errstate(all="ignore"):
        return float(np.median(np.abs(q.measured.residuals(q.p, q.measured.tolerances(q.p)))))


def _after(q: Question, hypotheses: list[Hypothesis]) -> float:
    """The residuals left after one step of the best of the hypotheses."""
    ranked = screen(hypotheses, q.p, q.measured).ranked()
    return ranked[0][0] if ranked else np.inf
