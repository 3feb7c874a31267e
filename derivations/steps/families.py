"""Mechanisms that a derivation can name: the two documents', and the usual ones with masses of their own.

Every family is built from first principles in any convention. ``Choices`` are what an author may mean by his letters.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

from flint import fmpq

from ..algebra.trig import HALF, NOTHING, Formula, Space
from .conventions import Convention
from .mechanism import Body, Mechanism, Segment

Family = Literal["n-leg", "rod-chain", "rods", "point-masses", "links"]
SENTENCES: dict[str, tuple[str, str]] = {
    "n-leg": (
        "a pendulum of {n} massless rods with point masses at their ends, rods 2 … {n} all hung at the end of rod 1",
        "質点を先端に持つ質量のない棒 {n} 本（2 本目以降はすべて 1 本目の先端に付く）",
    ),
    "rod-chain": ("a chain of {n} uniform rods of one line density", "線密度の等しい一様な棒 {n} 本の鎖"),
    "rods": ("a chain of {n} uniform rods, each with a mass of its own", "それぞれの質量を持つ一様な棒 {n} 本の鎖"),
    "point-masses": (
        "a chain of {n} massless rods with a point mass at the end of each",
        "質点を先端に持つ質量のない棒 {n} 本の鎖",
    ),
    "links": (
        "a chain of {n} links, each with a mass, a centre of mass and a moment of inertia of its own",
        "それぞれの質量・重心・慣性モーメントを持つリンク {n} 本の鎖",
    ),
}
ONE_LINK = {
    "n-leg": ("a point mass on a massless rod", "質量のない棒の先の質点"),
    "point-masses": ("a point mass on a massless rod", "質量のない棒の先の質点"),
    "rod-chain": ("a uniform rod hung at its end", "端でつるした一様な棒"),
    "rods": ("a uniform rod hung at its end", "端でつるした一様な棒"),
    "links": ("a body hung at a pivot (a physical pendulum)", "軸でつるした剛体（物理振り子）"),
}


@dataclass(frozen=True)
class Choices:
    """What an author's letters mean.

    ``density``: m_k stands for ρ l_k. ``inertia``: the moment of inertia is worked out from m and l ("value"), or I_k
    is a symbol, about the centre of mass or about the pivot. ``centre``: l_c is a symbol.
    """

    density: bool = False
    inertia: Literal["value", "centre", "pivot"] = "value"
    centre: bool = False


@lru_cache(maxsize=512)
def family(kind: str, space: Space, convention: Convention, choices: Choices = Choices()) -> Mechanism:
    """The mechanism of this kind with ``space.n`` links. Own symbols: I1 … In, lc1 … lcn where choices name them."""
    n = space.n
    bodies = []
    for b in range(n):
        path = ((0, b) if b else (0,)) if kind == "n-leg" else tuple(range(b + 1))
        carriers = [Segment(space.l(k), convention.direction(path[: i + 1], n)) for i, k in enumerate(path[:-1])]
        last = convention.direction(path, n)
        mass, arm, inertia = _body(kind, space, b, choices)
        bodies.append(Body(mass, inertia, (*carriers, Segment(arm, last)), last.turns))
    return Mechanism(space, tuple(bodies))


def _body(kind: str, space: Space, b: int, choices: Choices) -> tuple[Formula, Formula, Formula]:
    """Mass, distance of the centre of mass from the joint, and moment of inertia about the centre."""
    l, mass = space.l(b), space.rho * space.l(b) if choices.density else space.m(b)
    if kind in ("n-leg", "point-masses"):
        return mass, l, NOTHING
    arm = space.own(f"lc{b + 1}") if choices.centre else l.times(HALF)
    if choices.inertia == "value":
        return mass, arm, (mass * l * l).times(fmpq(1, 12))
    own = space.own(f"I{b + 1}")
    return mass, arm, own if choices.inertia == "centre" else own - mass * arm * arm


def sentence(kind: str, n: int) -> tuple[str, str]:
    """What the mechanism is, in English and Japanese."""
    english, japanese = ONE_LINK[kind] if n == 1 else SENTENCES[kind]
    if kind == "n-leg" and n == 2:
        english, japanese = SENTENCES["point-masses"]
    return english.format(n=n), japanese.format(n=n)
