"""Mistakes that only rods, or only point masses, invite: inertia, centre of mass, where a leg hangs."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from flint import fmpq

from ..algebra.symbols import Symbols
from ..algebra.trig import HALF
from ..steps.derivation import ROTATION, Derivation, Mistake, Stage, segment_position
from .changes import at, body, everywhere, put


def rod_mistakes(m: Symbols) -> Iterator[Mistake]:
    """Mistakes that only rods invite: in the inertia about the centre of mass, and in where that centre is."""
    s = m.space

    def scaled(factor: fmpq) -> Callable[[Derivation, int], None]:
        return lambda d, b: put(d.kinetic, b, ROTATION, d.kinetic[b][ROTATION].times(factor))

    def not_squared(d: Derivation, b: int) -> None:
        put(d.kinetic, b, ROTATION, d.kinetic[b][ROTATION] * s.l(b).inverse_monomial())

    def turning_relative(d: Derivation, b: int) -> None:
        if b:
            put(d.kinetic, b, ROTATION, m.inertia(b).times(HALF) * (s.w(b) - s.w(b - 1)).power(2))

    def at_end(d: Derivation, b: int) -> None:
        put(d.position, b, b, segment_position(m, b, fmpq(1)))

    def halves(d: Derivation, b: int) -> None:
        d.position[b] = {k: segment_position(m, k, fmpq(1, 2)) for k, _ in m.path(b)}

    def height_of_end(d: Derivation, b: int) -> None:
        if b in d.potential[b]:
            put(d.potential, b, b, d.potential[b][b].times(2))

    kinds: list[tuple[str, Stage, Callable[[Derivation, int], None], str, str]] = [
        ("inertia-missing", "energy", scaled(fmpq(0)),
         "the rotational energy is left out: a rod has ½ I θ̇² besides ½ m v², with I = m l²/12",
         "回転のエネルギー ½ I θ̇²（I = m l²/12）が抜けています"),
        ("inertia-about-end", "energy", scaled(fmpq(4)),
         "the inertia is m l²/3, about the end; with the speed of the centre of mass it is m l²/12",
         "慣性モーメントが端のまわりの m l²/3 です。重心の速度と組むのは m l²/12 です"),
        ("inertia-half-missing", "energy", scaled(fmpq(2)),
         "the rotational energy is missing its factor ½", "回転のエネルギー ½ I θ̇² の ½ が抜けています"),
        ("inertia-half-length", "energy", scaled(fmpq(1, 4)),
         "the inertia is taken with l/2 in place of l", "慣性モーメントで l の代わりに l/2 を使っています"),
        ("inertia-length-not-squared", "energy", not_squared,
         "the inertia has l, expected l²", "慣性モーメントの l² が l になっています"),
        ("inertia-relative-rate", "energy", turning_relative,
         "the rotational energy has the rate relative to the rod above, expected the absolute rate",
         "回転のエネルギーに上の棒に対する角速度が使われています。絶対角速度です"),
        ("centre-at-end", "position", at_end,
         "the centre of mass is put at the rod's end, l; it is at l/2",
         "重心が棒の端 (l) に置かれています。l/2 の所です"),
        ("carriers-halved", "position", halves,
         "the rods above are counted with half their length; only the rod's own is halved",
         "上の棒まで半分の長さにしています。半分にするのはその棒だけです"),
        ("height-of-end", "energy", height_of_end,
         "the potential energy has the height of the rod's end, expected that of its centre of mass",
         "位置エネルギーに棒の端の高さが使われています。重心の高さです"),
    ]  # fmt: skip
    for code, stage, change, english, japanese in kinds:
        for b in range(m.n):
            en, ja = body(m, b)
            yield Mistake(
                code, stage, (b,), f"{en.capitalize()}: {english}.", f"{ja}：{japanese}。",
                at(change, b),
            )  # fmt: skip
        if m.n > 1:
            yield everywhere(code, stage, f"Every rod: {english}.", f"すべての棒：{japanese}。", change)


def point_mass_mistakes(m: Symbols) -> Iterator[Mistake]:
    """Mistakes that only point masses invite: an inertia that they do not have, and a leg that hangs from a leg."""
    s = m.space

    def turning(share: fmpq) -> Callable[[Derivation, int], None]:
        def change(d: Derivation, b: int) -> None:
            inertia = (m.mass(b) * s.l(b).power(2)).times(share)
            put(d.kinetic, b, ROTATION, inertia.times(HALF) * s.w(b).power(2))

        return change

    kinds = [
        ("rod-inertia-for-point-mass", fmpq(1, 12),
         "a rod's m l²/12 is added; the rods are massless and the mass is a point",
         "棒の慣性モーメント m l²/12 が加えられています。棒の質量は 0 で、おもりは質点です"),
        ("inertia-counted-twice", fmpq(1),
         "½ m l² θ̇² is added as rotation; the speed of the point has it already",
         "½ m l² θ̇² が回転として加えられています。質点の速度に既に含まれています"),
    ]  # fmt: skip
    for code, share, english, japanese in kinds:
        change = turning(share)
        for b in range(m.n):
            en, ja = body(m, b)
            yield Mistake(
                code, "energy", (b,), f"{en.capitalize()}: {english}.", f"{ja}：{japanese}。",
                at(change, b),
            )  # fmt: skip
        yield everywhere(code, "energy", f"Every mass: {english}.", f"すべての質点：{japanese}。", change)
    for b in range(2, m.n):
        yield Mistake(
            "hung-from-a-leg", "position", (b,),
            f"Mass {b + 1} is hung from mass {b}; every leg hangs from mass 1.",
            f"質点{b + 1}が質点{b}から吊られています。どの足も質点1から吊られています。",
            at(lambda d, leg: put(d.position, leg, leg - 1, segment_position(m, leg - 1, fmpq(1))), b),
        )  # fmt: skip
