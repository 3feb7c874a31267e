"""The sign of a rate, or of the sum or difference of two, as dry friction has it: a symbol whose square is one.

While nothing rests, such a sign is a number that does not change, 1 or -1; derivatives take it as one.
"""

from __future__ import annotations

from collections.abc import Mapping

from .trig import Formula, Space, digit, unit

Form = tuple[tuple[int, int], ...]  # (k, c): Σ c·ω_k, the last c positive


def sign_symbols(n: int) -> tuple[str, ...]:
    """Names of all signs that are read, for a space's own symbols."""
    return tuple(_name(form) for form in _forms(n))


def sign_of(space: Space, form: Mapping[int, int]) -> Formula | None:
    """The sign of Σ form[k]·ω_k; None where there is no symbol for it."""
    ordered = tuple(sorted((k, c) for k, c in form.items() if c))
    if not ordered:
        return Formula()
    turned = ordered[-1][1] < 0
    name = _name(tuple((k, -c if turned else c) for k, c in ordered))
    if name not in space.extra:
        return None
    f = space.own(name)
    return -f if turned else f


def signs_in(space: Space) -> dict[int, Form]:
    """Place and form of each sign in a space."""
    return {space.own_place(name): form for form in _forms(space.n) if (name := _name(form)) in space.extra}


def switches(space: Space, e: int) -> int:
    """The packed exponents of signs alone."""
    places = range(space.first_sign, space.first_sign + space.n * space.n) if space.first_sign else ()
    return sum(digit(e, place) * unit(place) for place in places)


def without_squares(space: Space, f: Formula) -> Formula:
    """The same with the square of every sign as one."""
    if not space.first_sign:
        return f
    total = Formula()
    for (e, h, phase), c in f.terms.items():
        power = switches(space, e)
        if power:
            odd = sum(digit(power, place) % 2 * unit(place) for place in signs_in(space))
            total = total + Formula({(e - power + odd, h, phase): c})
        else:
            total = total + Formula({(e, h, phase): c})
    return total


def _forms(n: int) -> list[Form]:
    pairs = [((i, c), (k, 1)) for k in range(n) for i in range(k) for c in (-1, 1)]
    return [*(((k, 1),) for k in range(n)), *pairs]


def _name(form: Form) -> str:
    parts = "".join(("+" if c > 0 else "-") + f"w{k + 1}" for k, c in reversed(form))
    return f"sgn({parts.removeprefix('+')})"
