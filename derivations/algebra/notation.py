"""Writes formulas and the names of their terms: in ASCII, which a derivation may contain, and with Greek letters."""

from __future__ import annotations

import math
import re

from flint import fmpq

from .symbols import Symbols
from .trig import COS, Formula, Space, digits, unit

SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def sub(k: int) -> str:
    """The number of link k (counted from 0) as a subscript."""
    return str(k + 1).translate(SUBSCRIPTS)


def text(space: Space, f: Formula) -> str:
    """A formula in the ASCII notation, common factors of terms with the same angle taken out; "0" for nothing."""
    groups: dict[tuple[tuple[int, ...], int], list[tuple[tuple[int, ...], fmpq]]] = {}
    for powers, halves, phase, c in space.monomials(f):
        if next((h < 0 for h in halves if h), False):  # the first angle is written with a plus
            groups.setdefault((tuple(-h for h in halves), phase), []).append((powers, c if phase == COS else -c))
        else:
            groups.setdefault((halves, phase), []).append((powers, c))
    written = [
        part
        for (halves, phase), terms in sorted(
            groups.items(), key=lambda item: [[-abs(h) for h in item[0][0]], item[0][1]]
        )
        for part in _parts(space, halves, phase, terms)
    ]
    line = " ".join(("- " if negative else "+ ") + body for negative, body in written)
    return line.removeprefix("+ ").replace("- ", "-", 1) if line.startswith("- ") else line.removeprefix("+ ") or "0"


def _parts(
    space: Space, halves: tuple[int, ...], phase: int, terms: list[tuple[tuple[int, ...], fmpq]]
) -> list[tuple[bool, str]]:
    """Sign and text of the terms with one angle: together, or one by one where they have nothing in common."""
    if any(halves) or _common(terms):
        return [_group(space, halves, phase, terms)]
    return [_group(space, halves, phase, [term]) for term in sorted(terms, key=lambda term: tuple(-p for p in term[0]))]


def _common(terms: list[tuple[tuple[int, ...], fmpq]]) -> bool:
    """Whether the terms have a symbol in common."""
    return any(min(powers) > 0 or max(powers) < 0 for powers in zip(*(powers for powers, _ in terms), strict=True))


def _group(
    space: Space, halves: tuple[int, ...], phase: int, terms: list[tuple[tuple[int, ...], fmpq]]
) -> tuple[bool, str]:
    """Sign and text of all terms with one angle: (sum)·monomial·wave."""
    common = tuple(min(powers) for powers in zip(*(powers for powers, _ in terms), strict=True))
    content = fmpq(math.gcd(*(int(abs(c.p)) for _, c in terms)), math.lcm(*(int(c.q) for _, c in terms)))
    terms = sorted(terms, key=lambda term: tuple(-p for p in term[0]))
    if all(c < 0 for _, c in terms) or terms[0][1] < 0:
        content = -content
    wave = "" if not any(halves) else f"{'cos' if phase == COS else 'sin'}({angle_text(halves)})"
    if len(terms) == 1:
        return content < 0, _product(space, abs(content), common, "", wave)
    inner = " ".join(
        ("- " if c / content < 0 else "+ ")
        + _product(space, abs(c / content), tuple(p - q for p, q in zip(powers, common, strict=True)), "", "")
        for powers, c in terms
    ).removeprefix("+ ")
    return content < 0, _product(space, abs(content), common, f"({inner})", wave)


def _product(space: Space, c: fmpq, powers: tuple[int, ...], inner: str, wave: str) -> str:
    above = [inner] if inner else []
    below: list[str] = []
    for place in _order(space):
        power = powers[place]
        if power:
            name = space.names[place] + (f"^{abs(power)}" if abs(power) > 1 else "")
            (above if power > 0 else below).append(name)
    if wave:
        above.append(wave)
    if c.p != 1 or not above:
        above.insert(0, str(int(c.p)))
    if c.q != 1:
        below.insert(0, str(int(c.q)))
    if below and above[0].isdigit() and c.q != 1:  # 1/2*m1 rather than m1/2
        above[0] = f"{above[0]}/{below.pop(0)}"
    elif below and c.q != 1:
        above.insert(0, f"1/{below.pop(0)}")
    return "*".join(above) + "".join(f"/{name}" for name in below)


def _order(space: Space) -> list[int]:
    """Symbols as people write them: ρ, m, l, g, then rates, then accelerations."""
    n = space.n
    own = range(4 * n + 2 + n, space.symbol_count)  # the author's own symbols stand before lengths, coordinates after g
    outside = range(4 * n + 2, min(5 * n + 2, space.symbol_count))
    numbers = [4 * n + 1, *range(3 * n, 4 * n), *own, *range(2 * n, 3 * n), 4 * n]
    return [*numbers, *outside, *range(n, 2 * n), *range(n)]


def angle_text(halves: tuple[int, ...]) -> str:
    """Σ halves[k]·θ_k/2 in ASCII."""
    whole = all(h % 2 == 0 for h in halves)
    parts = ""
    for k, half in enumerate(halves):
        factor = half // 2 if whole else half
        if factor:
            size = "" if abs(factor) == 1 else f"{abs(factor)}*"
            parts += ("-" if factor < 0 else "+") + f"{size}t{k + 1}"
    parts = parts.removeprefix("+")
    return parts if whole else f"({parts})/2"


def motion_text(space: Space, q: int) -> str:
    """A product of accelerations and rates, packed, in ASCII; "1" where there is none."""
    powers = digits(q, 2 * space.n)
    parts = [space.names[place] + (f"^{power}" if power != 1 else "") for place, power in enumerate(powers) if power]
    return "*".join(parts) or "1"


def pretty(ascii_text: str) -> str:
    """The ASCII notation with Greek letters, dots, subscripts and superscripts, for people."""
    letters = {"t": "θ", "w": "θ̇", "a": "θ̈", "l": "l", "m": "m"}
    out = re.sub(r"\b([twalm])(\d+)", lambda found: letters[found[1]] + found[2].translate(SUBSCRIPTS), ascii_text)
    out = re.sub(r"\^(-?\d+)", lambda found: found[1].translate(SUPERSCRIPTS), out)
    out = re.sub(r"\brho\b", "ρ", out)
    return out.replace("*", " ").replace("-", "−")


def term_name(m: Symbols, i: int, q: int) -> str:
    """The place of a term in the documents' matrix form.

    ``A[i,j]`` multiplies θ̈_j and ``B[i,j]`` θ̇_j²; gravity is ``B[i,i]`` in Shiki's (3.12), and here ``G[i]`` for
    Takeno's (22), which gives it no letter. A term that the right equations do not have is named by its product.
    """
    n = m.n
    place = {place: power for place, power in enumerate(digits(q, 2 * n)) if power}
    match list(place.items()):
        case []:
            return f"B[{i + 1},{i + 1}]" if m.kind == "n-leg" else f"G[{i + 1}]"
        case [(j, 1)] if j < n:
            return f"A[{i + 1},{j + 1}]"
        case [(j, 2)] if j >= n and not (m.kind == "n-leg" and j - n == i):
            return f"B[{i + 1},{j - n + 1}]"
    return f"{motion_text(m.space, q)} in row {i + 1}"


def solved_term_name(m: Symbols, i: int, q: int) -> str:
    """The name of a term in a row that is solved for α_i."""
    if q == unit(i):
        return f"a{i + 1}: denominator"
    return f"a{i + 1}: {motion_text(m.space, q) if q else 'g'}"


def equation_number(m: Symbols) -> str:
    """The documents' number of the matrix form that :func:`term_name` speaks of."""
    if m.kind == "rod-chain":
        return "18"
    return {2: "1.10", 3: "2.11"}.get(m.n, "3.12")
