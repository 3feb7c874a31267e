"""Mistakes in the kinetic and potential energies of the masses, and in the Lagrangian."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from flint import fmpq

from ..algebra.notation import sub
from ..algebra.symbols import Symbols
from ..algebra.trig import NOTHING, Formula
from ..steps.derivation import ROTATION, Derivation, Mistake, segment_position
from .changes import body, instead, put, times


def energy_mistakes(m: Symbols, b: int) -> Iterator[Mistake]:
    """Mistakes in the kinetic or the potential energy of mass b."""
    s, (en, ja) = m.space, body(m, b)
    mass = m.mass(b)

    def kinetic(code: str, english: str, japanese: str, factor: Formula, *more: int) -> Mistake:
        def apply(d: Derivation) -> None:
            d.kinetic[b] = {k: v if k == ROTATION else v * factor for k, v in d.kinetic[b].items()}

        return Mistake(code, "energy", (b, *more), english, japanese, apply)

    def potential(code: str, english: str, japanese: str, change: Callable[[Formula], Formula], *more: int) -> Mistake:
        def apply(d: Derivation) -> None:
            d.potential[b] = {k: change(v) for k, v in d.potential[b].items()}

        return Mistake(code, "energy", (b, *more), english, japanese, apply)

    two = Formula({(0, 0, 0): fmpq(2)})
    yield kinetic(
        "half-missing", f"The kinetic energy of {en} is missing its factor ½: it is ½ m v².",
        f"{ja}の運動エネルギーの ½ が抜けています。½ m v² です。", two,
    )  # fmt: skip
    yield kinetic(
        "kinetic-energy-missing", f"The kinetic energy of the motion of {en} is left out.",
        f"{ja}の並進の運動エネルギーが抜けています。", NOTHING,
    )  # fmt: skip
    yield potential(
        "potential-energy-missing", f"The potential energy of {en} is left out: gravity acts on it too.",
        f"{ja}の位置エネルギーが抜けています。重力は{ja}にも働きます。", instead(NOTHING),
    )  # fmt: skip
    yield potential(
        "potential-energy-sign", f"The potential energy of {en} has the wrong sign: it grows with height.",
        f"{ja}の位置エネルギーの符号が逆です。高いほど大きくなります。", lambda f: -f,
    )  # fmt: skip
    yield potential(
        "gravity-factor-missing", f"The potential energy of {en} is missing its factor g.",
        f"{ja}の位置エネルギーに g が掛かっていません。", lambda f: f * s.g.inverse_monomial(),
    )  # fmt: skip
    for j in range(m.n):
        if j == b:
            continue
        ratio = m.mass(j) * mass.inverse_monomial()
        other = body(m, j)
        yield kinetic(
            "wrong-mass-in-kinetic-energy",
            f"The kinetic energy of {en} has the mass of {other[0]}.",
            f"{ja}の運動エネルギーに{other[1]}の質量が使われています。", ratio, j,
        )  # fmt: skip
        yield potential(
            "wrong-mass-in-potential-energy",
            f"The potential energy of {en} has the mass of {other[0]}.",
            f"{ja}の位置エネルギーに{other[1]}の質量が使われています。", times(ratio), j,
        )  # fmt: skip
    for k, fraction in m.path(b):
        yield from _height(m, b, k, fraction)


def _height(m: Symbols, b: int, k: int, fraction: fmpq) -> Iterator[Mistake]:
    s, (en, ja) = m.space, body(m, b)
    th = f"θ{sub(k)}"

    def height(code: str, english: str, japanese: str, change: Callable[[Formula], Formula], *more: int) -> Mistake:
        def apply(d: Derivation) -> None:
            if k in d.potential[b]:
                put(d.potential, b, k, change(d.potential[b][k]))

        return Mistake(code, "energy", (b, k, *more), english, japanese, apply)

    weight = m.mass(b) * m.space.g
    x, _ = segment_position(m, k, fraction)
    if len(m.path(b)) > 1:
        yield height(
            "height-incomplete",
            f"The potential energy of {en} leaves out the height of link {k + 1}, -l{sub(k)} cos {th}.",
            f"{ja}の位置エネルギーにリンク{k + 1}の高さ -l{sub(k)} cos {th} が抜けています。", instead(NOTHING),
        )  # fmt: skip
    yield height(
        "height-sine", f"In the potential energy of {en}: found sin {th}, expected cos {th}.",
        f"{ja}の位置エネルギーで cos {th} とすべき所が sin {th} です。", lambda f: -(weight * x),
    )  # fmt: skip
    for j in range(m.n):
        if j == k:
            continue
        ratio = s.l(j) * s.l(k).inverse_monomial()
        yield height(
            "wrong-length-in-height", f"In the potential energy of {en}: found l{sub(j)}, expected l{sub(k)}.",
            f"{ja}の位置エネルギーで l{sub(k)} とすべき所が l{sub(j)} です。", times(ratio), j,
        )  # fmt: skip
        turned = weight * s.l(k) * s.cos({j: 1}).times(-fraction)
        yield height(
            "wrong-angle-in-height", f"In the potential energy of {en}: found θ{sub(j)}, expected {th}.",
            f"{ja}の位置エネルギーで {th} とすべき所が θ{sub(j)} です。", instead(turned), j,
        )  # fmt: skip


def lagrangian_mistakes(m: Symbols, b: int) -> Iterator[Mistake]:
    """Mistakes in how often mass b enters the Lagrangian."""
    en, ja = body(m, b)

    def shared(times: int) -> Callable[[Derivation], None]:
        def apply(d: Derivation) -> None:
            t, u = d.share[b]
            d.share[b] = (t * times, u * times)

        return apply

    yield Mistake(
        "mass-left-out", "lagrangian", (b,), f"The Lagrangian leaves {en} out, kinetic and potential energy both.",
        f"ラグランジアンに{ja}の項（運動・位置エネルギー）が入っていません。", shared(0),
    )  # fmt: skip
    yield Mistake(
        "mass-counted-twice", "lagrangian", (b,), f"The Lagrangian counts {en} twice.",
        f"ラグランジアンで{ja}の項を2回数えています。", shared(2),
    )  # fmt: skip
