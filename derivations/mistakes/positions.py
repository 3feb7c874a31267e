"""Mistakes in the positions of the masses."""

from __future__ import annotations

from collections.abc import Iterator

from flint import fmpq

from ..algebra.notation import sub
from ..algebra.symbols import Symbols
from ..algebra.trig import Formula
from ..steps.derivation import Mistake, segment_position
from .changes import at, body, drop, put


def position_mistakes(m: Symbols, b: int) -> Iterator[Mistake]:
    """Mistakes in the position of mass b."""
    s, (en, ja) = m.space, body(m, b)
    fractions = dict(m.path(b))
    for k, fraction in fractions.items():
        x, y = segment_position(m, k, fraction)

        def moved(code: str, english: str, japanese: str, *segment: Formula, k: int = k, more: tuple[int, ...] = ()):  # type: ignore[no-untyped-def]
            pair = (segment[0], segment[1])
            return Mistake(code, "position", (b, k, *more), english, japanese, lambda d: put(d.position, b, k, pair))

        if len(fractions) > 1:
            yield Mistake(
                "segment-missing", "position", (b, k),
                f"The position of {en} leaves out link {k + 1}: "
                f"l{sub(k)} sin θ{sub(k)}, -l{sub(k)} cos θ{sub(k)} are missing.",
                f"{ja}の位置にリンク{k + 1}の分 l{sub(k)} sin θ{sub(k)}, -l{sub(k)} cos θ{sub(k)} が抜けています。",
                at(lambda d, link: drop(d.position, b, link), k),
            )  # fmt: skip
        yield moved(
            "sine-cosine-swapped",
            f"In the position of {en}, sin θ{sub(k)} and cos θ{sub(k)} are swapped: "
            "from the downward vertical, x goes with sin.",
            f"{ja}の位置で sin θ{sub(k)} と cos θ{sub(k)} が逆です。鉛直下向きから測るので x が sin です。",
            -y, -x,
        )  # fmt: skip
        yield moved(
            "x-sign",
            f"In the position of {en}, x has l{sub(k)} sin θ{sub(k)} with the wrong sign.",
            f"{ja}の位置で x の l{sub(k)} sin θ{sub(k)} の符号が逆です。",
            -x, y,
        )  # fmt: skip
        yield moved(
            "y-sign",
            f"In the position of {en}, y has l{sub(k)} cos θ{sub(k)} with the wrong sign: it hangs below the support.",
            f"{ja}の位置で y の l{sub(k)} cos θ{sub(k)} の符号が逆です。支点より下にあります。",
            x, -y,
        )  # fmt: skip
        for j in range(m.n):
            if j == k:
                continue
            ratio = s.l(j) * s.l(k).inverse_monomial()
            yield moved(
                "wrong-length-in-position",
                f"In the position of {en}: found l{sub(j)}, expected l{sub(k)}.",
                f"{ja}の位置で l{sub(k)} とすべき所が l{sub(j)} になっています。",
                x * ratio, y * ratio, more=(j,),
            )  # fmt: skip
            back = s.l(k) * s.l(j).inverse_monomial()
            turned = [part * back for part in segment_position(m, j, fraction)]
            yield moved(
                "wrong-angle-in-position",
                f"In the position of {en}: found θ{sub(j)}, expected θ{sub(k)}.",
                f"{ja}の位置で θ{sub(k)} とすべき所が θ{sub(j)} になっています。",
                *turned, more=(j,),
            )  # fmt: skip
    if m.parent(b) >= 0:
        yield Mistake(
            "relative-angle", "position", (b,),
            f"In the position of {en}, θ{sub(b)} is taken as measured from the link above it; "
            "it is measured from the vertical.",
            f"{ja}の位置で θ{sub(b)} を上のリンクからの角としています。鉛直線からの角です。",
            lambda d: put(d.position, b, b, relative_segment(m, b, fractions[b])),
        )  # fmt: skip


def relative_segment(m: Symbols, k: int, fraction: fmpq) -> tuple[Formula, Formula]:
    """The segment of link k if every angle were measured from the link above."""
    s, angle, link = m.space, {}, k
    while link >= 0:
        angle[link] = 1
        link = m.parent(link)
    return (s.l(k) * s.sin(angle)).times(fraction), (s.l(k) * s.cos(angle)).times(-fraction)
