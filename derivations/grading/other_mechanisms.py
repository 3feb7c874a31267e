"""Whether wrong equations are the right ones of another mechanism: then their author is to be told that first."""

from __future__ import annotations

import re
from dataclasses import replace

from ..reading.submission import Submission
from ..steps.families import Choices, family, sentence
from .hypotheses import Hypothesis, Said, Variant, merged
from .judge import Judge

MOST_LINKS = 6


def right_for(s: Submission) -> Said | None:
    """The mechanism that these are the right equations of, in the declared convention; None where none is known."""
    n, space = s.space.n, s.space
    if n > MOST_LINKS or s.mechanism is not None or {"I", "c"} & {letter for letter, _ in s.used}:
        return None
    densities = {3 * n + k: space.rho * space.l(k) for k in range(n)}
    for kind in ("point-masses", "n-leg", "rods"):
        if kind == s.kind or (kind != "rods" and s.kind in ("point-masses", "n-leg") and n < 3):
            continue
        for density in (False, True):
            if kind == "rods" and density and s.kind == "rod-chain":
                continue
            variant = Variant(Choices(density=density), densities if density else {})
            mechanism = family(kind, space, s.convention, variant.choices).with_values(merged(s, variant))
            h = Hypothesis(mechanism, s.convention, variant)
            if Judge(replace(s, kind=kind)).holds(h).answer in ("same", "not proved"):
                english, japanese = sentence("rod-chain" if kind == "rods" and density else kind, n)
                return english, japanese
    return None


SUBSCRIPTS = "₁₂₃₄₅₆₇₈₉"


def in_relative_angles(text: str, kind: str, n: int) -> str:
    """A sentence about absolute angles and rates, said with angles that are measured from the link above."""

    def path(k: int) -> list[int]:
        return ([1, k] if k > 1 else [1]) if kind == "n-leg" else list(range(1, k + 1))

    def difference(found: re.Match[str]) -> str:
        one, two = (SUBSCRIPTS.index(found[i]) + 1 for i in (1, 2))
        left = [k for k in path(one) if k not in path(two)]
        right = [k for k in path(two) if k not in path(one)]
        parts = [("+", k) for k in left] + [("-", k) for k in right]
        if right and not left:  # cos is even
            parts = [("+", k) for k in right]
        inner = " ".join(f"{sign} θ{SUBSCRIPTS[k - 1]}" for sign, k in parts).removeprefix("+ ")
        return f"cos⟦{inner}⟧"

    def whole(found: re.Match[str]) -> str:
        k = SUBSCRIPTS.index(found[2]) + 1
        parts = [f"θ{found[1]}{SUBSCRIPTS[j - 1]}" for j in path(k)] if k <= n else [found[0]]
        return parts[0] if len(parts) == 1 else f"({' + '.join(parts)})"

    marked = re.sub(r"cos\(θ([₁-₉]) ?[-−] ?θ([₁-₉])\)", difference, text)
    pieces = re.split(r"(⟦[^⟧]*⟧)", marked)
    said = [piece if piece.startswith("⟦") else re.sub(r"θ([\u0307\u0308]?)([₁-₉])", whole, piece) for piece in pieces]
    return "".join(said).replace("⟦", "(").replace("⟧", ")")
