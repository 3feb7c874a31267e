"""One question: why one engine does not move as one mechanism, with everything that was measured for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ..models.mechanism import Mechanism
from ..reference import planar_tree as planar
from ..reference.planar_tree import Parameters
from .measurement import Measurement, measure

View = Callable[[Measurement], Measurement]
AGAIN = 7  # the seed of the states in which a cause is tested that was found in others


def as_measured(measured: Measurement) -> Measurement:
    """The view that changes nothing."""
    return measured


@dataclass(frozen=True, eq=False)
class Question:
    """``m``: the mechanism expected; ``compiled``: what the engine says it holds, None where it does not say;
    ``measured``: what it was seen to do; ``who``: its name; ``view``: the convention or the buffer that is supposed to
    be wrong already, as a change of what was measured."""

    engine: Any
    m: Mechanism
    measured: Measurement
    compiled: Mechanism | None
    who: str
    view: View = as_measured

    @cached_property
    def p(self) -> Parameters:
        """The numbers expected."""
        return planar.parameters(self.m)

    @cached_property
    def again(self) -> Measurement:
        """The same in other states: a cause that is one removes the difference there, too."""
        return self.view(measure(self.engine, self.m, self.measured.accuracy, AGAIN))

    @cached_property
    def scale(self) -> float:
        """The median of what rounding explains [N m] with the numbers expected."""
        with np.errstate(all="ignore"):
            return float(np.median(self.measured.tolerances(self.p)))

    def seen_as(self, view: View) -> Question:
        """The same question with another view of what was measured."""
        return replace(self, measured=view(self.measured), view=view)

    def against(self, other: Mechanism) -> Question:
        """The same question with another mechanism expected."""
        return replace(self, m=other, compiled=None)
