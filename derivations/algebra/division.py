"""Exact division of one formula by another: as Laurent polynomials in the symbols and in z_k = exp(iθ_k/2)."""

from __future__ import annotations

from collections.abc import Sequence

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx
from flint.utils.flint_exceptions import DomainError

from .trig import BITS, COS, HALF, SIN, Formula, Key, Space, digits

MOST_TERMS = 20_000  # of a formula that is divided; a second at most
Powers = tuple[int, ...]


def exact_quotient(space: Space, f: Formula, by: Formula) -> Formula | None:
    """f / by where it is a formula; None where it is none, or where ``by`` has sines, or too many terms.

    cos and sin of an angle are (z + 1/z)/2 and (z - 1/z)/2i. The parts of f with cosines and with sines are divided
    each for itself, so that i cancels and all coefficients stay rational.
    """
    if not f:
        return f
    if not by or len(f) > MOST_TERMS or len(by) > MOST_TERMS or any(phase == SIN for _, _, phase in by.terms):
        return None
    places = sorted(space.places(f) | space.places(by))
    names = [f"x{place}" for place in places] + [f"z{k}" for k in range(space.n)]
    context = fmpq_mpoly_ctx.get(names, Ordering.degrevlex)
    divisor, low = _polynomial(context, _powers(space, places, by, COS))
    total: dict[Key, fmpq] = {}
    for phase in (COS, SIN):
        part = _powers(space, places, f, phase)
        if not part:
            continue
        dividend, lowest = _polynomial(context, part)
        try:
            quotient = dividend / divisor
        except DomainError:
            return None
        total |= _terms(space, places, quotient, [x - y for x, y in zip(lowest, low, strict=True)], phase)
    return Formula(total)


def _powers(space: Space, places: Sequence[int], f: Formula, phase: int) -> dict[Powers, fmpq]:
    """The part of f with this phase by powers of the symbols and of z, without the 1/i of a sine."""
    out: dict[Powers, fmpq] = {}
    for (e, h, s), c in f.terms.items():
        if s != phase:
            continue
        powers, halves = digits(e, space.symbol_count), digits(h, space.n)
        outer = tuple(powers[place] for place in places)
        if not h:
            out[*outer, *halves] = c
            continue
        out[*outer, *halves] = c * HALF
        out[*outer, *(-x for x in halves)] = c * (-HALF if phase == SIN else HALF)
    return out


def _polynomial(context: fmpq_mpoly_ctx, powers: dict[Powers, fmpq]) -> tuple[fmpq_mpoly, Powers]:
    """With the lowest power of each symbol taken out, and these."""
    low = tuple(map(min, zip(*powers, strict=True)))
    return context.from_dict({
        tuple(x - y for x, y in zip(key, low, strict=True)): c for key, c in powers.items()
    }), low  # fmt: skip


def _terms(
    space: Space, places: Sequence[int], quotient: fmpq_mpoly, low: Sequence[int], phase: int
) -> dict[Key, fmpq]:
    terms: dict[Key, fmpq] = {}
    count = len(places)
    for key, c in quotient.to_dict().items():
        powers = [int(x) + y for x, y in zip(key, low, strict=True)]
        e = sum(power << (BITS * place) for power, place in zip(powers[:count], places, strict=True))
        h = sum(half << (BITS * k) for k, half in enumerate(powers[count:]))
        if h > 0:  # the term with -h is its mirror image
            terms[e, h, phase] = fmpq(c) * 2
        elif h == 0 and phase == COS:
            terms[e, 0, COS] = fmpq(c)
    return terms
