"""Single precision, as it shows in an engine's accelerations."""

from __future__ import annotations

import numpy as np

from ..models.coordinates import to_relative
from ..models.mechanism import Mechanism
from ..reference.rounding.bounds import EPSILON
from .explanation import Explanation, together
from .finding import Finding
from .measurement import Measurement
from .question import Question

SINGLE_OVER_DOUBLE = 2.0**-23 / EPSILON  # machine epsilon of single precision over that of double
LEAST_SHARE = 1e-4  # of that: a smaller residual is not single precision's


def visible_single_precision(q: Question) -> Explanation:
    """Single precision where the accelerations themselves are numbers of 24 bits."""
    return single_precision(q) if _has_24_bits(q.m, q.measured) else Explanation()


def single_precision(q: Question) -> Explanation:
    """Single precision where all agrees as well as numbers of 24 bits can."""
    worst, visible = q.measured.worst(q.p), _has_24_bits(q.m, q.measured)
    if worst > SINGLE_OVER_DOUBLE or (not visible and worst < LEAST_SHARE * SINGLE_OVER_DOUBLE):
        return Explanation()
    why = "its accelerations are numbers of 24 bits" if visible else "the residual is that of numbers of 24 bits"
    says = f"{q.who}: single precision: {why}; {worst:.3g} times the residual of double precision"
    return together([Finding("float32", q.who, worst * EPSILON, EPSILON, says)])


def _has_24_bits(m: Mechanism, measured: Measurement) -> bool:
    """Whether accelerations, absolute or relative, are numbers of 24 bits."""
    forward = measured.only(measured.forward)
    own = to_relative(m.parents, forward.alpha)
    largest = np.abs(forward.alpha).max(axis=1, keepdims=True)
    kept = np.abs(own - own.astype(np.float32)) <= 8 * EPSILON * largest
    return bool(kept.all() or (forward.alpha == forward.alpha.astype(np.float32)).all())
