"""One proved step: Taylor polynomials over a ball of states, and how far the motion is from them.

The coefficients are enclosed over the ball, so that for every state in it there are polynomials among them which its
motion's series begins with. :mod:`.defect` bounds how far such a polynomial is from solving the equations of motion,
:mod:`.tube` how far the motion is from the polynomial because of that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from . import tube
from .clouds import Cloud, Stretch, spread_series
from .defect import Defect
from .form import Form
from .series import Numbers
from .sizes import log2_largest

LOW_BITS = 64  # of bounds, of which a few digits matter
MOST_PIECES = 64  # that a step's tube is cut into
MOST_TRIES = 60  # of one step; each is shorter, or in more pieces


@dataclass
class Walk:
    """Steps one after another. Remembered from step to step: ``ratio``, of the length that was proved to what the
    coefficients promise, ``pieces`` of the tube, and ``pace``: log₂ of how fast the motion is [1/s], the inverse of its
    series' radius. They are guesses: what is proved rests on none of them.
    """

    ratio: float = 0.7
    pieces: int = 1
    pace: int = 0
    tries: int = 0

    def step(
        self, form: Form, cloud: Cloud, order: int, wanted: float, span: tuple[float, float], shortest: float
    ) -> tuple[Stretch | None, float]:
        """A proved stretch of the motions from ``cloud`` over ``span`` [s] or as much as is shown, and where it ends.

        ``order``: degree of the polynomials; ``wanted``: log₂ of how far they may be from solving the equations, at
        the end; no stretch shorter than ``shortest`` [s] is tried, and None is the answer where none was shown.
        """
        import flint

        start, end = span
        try:
            spread = spread_series(form, cloud, order)
        except ZeroDivisionError:
            return None, start
        series = spread.whole
        promised = _promised(series.x, series.v, order, wanted)
        self.pace = min(60, max(-60, round(wanted / order - math.log2(promised)))) if promised < math.inf else 0
        to_go = abs(end - start)
        length = min(promised * self.ratio, to_go)
        with flint.ctx.workprec(LOW_BITS):
            defect = Defect(form, series)
            width = flint.arb(2) ** math.floor(wanted / 2)
            unit = flint.arb(2) ** math.floor(wanted)
            for _ in range(MOST_TRIES):
                self.tries += 1
                finish = end if length >= to_go else start + math.copysign(length, end - start)
                if abs(finish - start) < shortest or finish == start:
                    return None, start
                exact = flint.arb(finish) - start  # doubles: exact, or a ball around the exact difference
                grown = tube.radius(form, series, defect.rows(exact), exact, width, unit, self.pieces)
                if grown is None and self.pieces < MOST_PIECES:
                    self.pieces *= 2
                    continue
                if grown is None:
                    length *= 0.5
                    continue
                x_off, v_off = grown
                size = log2_largest(grown)
                if size > wanted:
                    length *= max(0.5, 0.98 * 2.0 ** ((wanted - size - 1) / order))
                else:
                    if length < to_go:
                        self.ratio = length / promised * min(1.25, 2.0 ** ((wanted - size - 2) / order))
                    self.pieces -= self.pieces // 4
                    break
            else:
                return None, start
        return spread.stretch(x_off, v_off, flint.arb(finish) - start), finish


def _promised(x: list[Numbers], v: list[Numbers], order: int, wanted: float) -> float:
    """The length [s] at which the last two terms are as small as wanted."""
    lengths = []
    for k in (order - 1, order):
        size = log2_largest(c[k] for c in (*x, *v))
        if size > -math.inf:
            lengths.append((wanted - size) / k)
    return 2.0 ** min(1000.0, *lengths) if lengths else math.inf
