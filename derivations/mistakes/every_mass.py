"""Mistakes that are made for every mass alike, up to the Lagrangian."""

from __future__ import annotations

from collections.abc import Iterator

from ..algebra.symbols import Symbols
from ..algebra.trig import HALF
from ..steps.derivation import Derivation, Mistake
from .changes import body, everywhere, put
from .positions import relative_segment


def every_mass_mistakes(m: Symbols) -> Iterator[Mistake]:
    """The same mistake for every mass, from positions to the Lagrangian; and gravity on one mass only."""
    s = m.space

    def swap(d: Derivation, b: int) -> None:
        d.position[b] = {k: (-y, -x) for k, (x, y) in d.position[b].items()}

    def relative(d: Derivation, b: int) -> None:
        d.position[b] = {k: relative_segment(m, k, f) for k, f in m.path(b)}

    def binomial(d: Derivation, b: int) -> None:
        d.square[b] = {pair: f for pair, f in d.square[b].items() if pair[0] == pair[1]}

    def halved(d: Derivation, b: int) -> None:
        d.square[b] = {(j, k): f if j == k else f.times(HALF) for (j, k), f in d.square[b].items()}

    def no_half(d: Derivation, b: int) -> None:
        d.kinetic[b] = {k: f.times(2) for k, f in d.kinetic[b].items()}

    def no_weight(d: Derivation, b: int) -> None:
        d.potential[b] = {}

    def added(d: Derivation, b: int) -> None:
        d.share[b] = (d.share[b][0], -d.share[b][1])

    def moved_zero(d: Derivation, b: int) -> None:
        put(d.potential, b, -1, m.mass(b) * s.g * s.l(0))

    yield everywhere(
        "angles-from-horizontal", "position",
        "All positions have sin and cos swapped, as if the angles were measured from the horizontal.",
        "すべての位置で sin と cos が逆です。角を水平から測ったことになっています。", swap,
    )  # fmt: skip
    yield everywhere(
        "relative-angles", "position",
        "All angles are taken as measured from the link above; they are measured from the vertical.",
        "すべての角を上のリンクから測った角としています。鉛直線から測った角です。", relative,
    )  # fmt: skip
    yield everywhere(
        "binomial-without-middle", "speed",
        "Every squared speed leaves out its cross terms: (A + B)² is A² + 2AB + B².",
        "すべての速度の2乗で交差項が抜けています。(A + B)² = A² + 2AB + B² です。", binomial,
    )  # fmt: skip
    yield everywhere(
        "cross-terms-halved", "speed",
        "Every cross term of the squared speeds is missing its factor 2: (A + B)² is A² + 2AB + B².",
        "すべての交差項の 2 が抜けています。(A + B)² = A² + 2AB + B² です。", halved,
    )  # fmt: skip
    yield everywhere(
        "half-missing-everywhere", "energy", "Every kinetic energy is missing its factor ½.",
        "すべての運動エネルギーの ½ が抜けています。", no_half,
    )  # fmt: skip
    yield everywhere(
        "gravity-missing", "energy", "Gravity is left out everywhere.", "重力がまったく入っていません。", no_weight,
    )  # fmt: skip
    yield everywhere(
        "sum-for-difference", "lagrangian", "The Lagrangian is T + U; it must be T - U.",
        "ラグランジアンが T + U になっています。T - U です。", added,
    )  # fmt: skip
    yield everywhere(
        "zero-of-height-moved", "energy", "The zero of height is elsewhere, which changes nothing.",
        "高さの基準が別の所にあります（運動方程式は変わりません）。", moved_zero,
    )  # fmt: skip
    for j in range(m.n):
        en, ja = body(m, j)

        def only(d: Derivation, j: int = j) -> None:
            d.potential = [f if b == j else {} for b, f in enumerate(d.potential)]

        yield Mistake(
            "gravity-on-one-mass-only", "energy", (j,), f"Gravity is applied to {en} only; it acts on every mass.",
            f"重力が{ja}だけに働くことになっています。すべてに働きます。", only,
        )  # fmt: skip
