"""Masses between springs, each counted from the support or from the one before."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .letters import Letters
from .roles import FORCE, LOSS, MASS, SPRING, Bodies, indexed, named

FEW = 2


def sliders(letters: Letters, slides: Sequence[str]) -> Iterator[Bodies]:
    """Carts in a row, with springs and losses between them, the first driven or the last."""
    n = len(slides)
    ends = [str(k) for k in range(1, n + 1)]
    for mass in indexed(letters, MASS, ends)[:FEW]:
        for spring in indexed(letters, SPRING, ends)[:FEW]:
            losses = [x for x in indexed(letters, LOSS, ends) if not set(x) & {*mass, *spring}]
            for loss in (None, *losses[:FEW]):
                for drive in (None, *named(letters, FORCE, but=[*slides, *mass, *spring, *(loss or ())])[:FEW]):
                    for at in {0, n - 1} if drive else {0}:
                        yield [
                            {
                                "name": f"cart {k + 1}", "coordinate": slides[k], "joint": "slide", "mass": mass[k],
                                "spring": spring[k], **({"damping": loss[k]} if loss else {}),
                                **({"drive": drive} if drive and k == at else {}),
                            }
                            for k in range(n)
                        ]  # fmt: skip
