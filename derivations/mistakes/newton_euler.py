"""Mistakes on the way by forces and moments (Newton–Euler)."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ..algebra.symbols import Symbols
from ..algebra.trig import NOTHING, Formula, digit
from ..steps.derivation import Derivation, Mistake
from .changes import at, body, everywhere

Change = Callable[[Derivation, int], None]


def newton_euler_mistakes(m: Symbols) -> Iterator[Mistake]:
    """All of them, for one mechanism."""
    yield from _forces(m)
    if m.kind == "rod-chain":
        yield from _moments(m)


def _forces(m: Symbols) -> Iterator[Mistake]:
    s = m.space

    def weightless(d: Derivation, b: int) -> None:
        x, y = d.force[b]
        d.force[b] = (x, y - m.mass(b) * s.g)

    def centripetal(factor: int) -> Change:
        def change(d: Derivation, b: int) -> None:
            x, y = d.force[b]
            d.force[b] = (_centripetal_scaled(m, x, factor), _centripetal_scaled(m, y, factor))

        return change

    kinds: list[tuple[str, Change, str, str]] = [
        ("weight-missing", weightless,
         "the weight is left out of Newton's equation", "ニュートンの運動方程式に重力が入っていません"),
        ("centripetal-missing", centripetal(0),
         "the acceleration leaves out its centripetal part, -θ̇² p(θ)",
         "加速度に向心成分 -θ̇² p(θ) が抜けています"),
        ("centripetal-sign", centripetal(-1),
         "the centripetal part -θ̇² p(θ) of the acceleration has the wrong sign", "加速度の -θ̇² p(θ) の符号が逆です"),
    ]  # fmt: skip
    for code, change, english, japanese in kinds:
        for b in range(m.n):
            en, ja = body(m, b)
            yield Mistake(
                code, "force", (b,), f"{en.capitalize()}: {english}.", f"{ja}：{japanese}。",
                at(change, b),
            )  # fmt: skip
        if m.n > 1:
            every = "rod" if m.kind == "rod-chain" else "mass"
            yield everywhere(
                code, "force", f"Every {every}: {english}.",
                f"すべての{'棒' if m.kind == 'rod-chain' else '質点'}：{japanese}。", change,
            )  # fmt: skip


def _centripetal_scaled(m: Symbols, f: Formula, factor: int) -> Formula:
    """The terms with ω² times a factor."""
    n = m.n
    kept = {}
    for key, c in f.terms.items():
        centripetal = any(digit(key[0], n + k) for k in range(n))
        if centripetal and not factor:
            continue
        kept[key] = c * factor if centripetal else c
    return Formula(kept)


def _moments(m: Symbols) -> Iterator[Mistake]:
    def lower(factor: int) -> Change:
        def change(d: Derivation, j: int) -> None:
            d.lower[j] = d.lower[j].times(factor)

        return change

    def upper(factor: int) -> Change:
        def change(d: Derivation, j: int) -> None:
            d.upper[j] = d.upper[j].times(factor)

        return change

    def whole_arm(d: Derivation, j: int) -> None:
        d.lower[j], d.upper[j] = d.lower[j].times(2), d.upper[j].times(2)

    def about_joint(d: Derivation, j: int) -> None:
        d.upper[j] = NOTHING
        d.lower[j] = d.lower[j].times(2)

    kinds: list[tuple[str, Change, str, str, bool]] = [
        ("lower-joint-force-missing", lower(0),
         "the moment leaves out the force at the lower joint", "モーメントに下の継ぎ目の力が抜けています", True),
        ("upper-joint-force-missing", upper(0),
         "the moment leaves out the force at the upper joint: it turns the rod about its centre too",
         "モーメントに上の継ぎ目の力が抜けています。これも重心のまわりに棒を回します", False),
        ("joint-forces-subtracted", lower(-1),
         "the moments of the two joint forces are subtracted; arms and reactions both change sign, so that they add: "
         "T_j + T_{j-1}",
         "上下の継ぎ目の力のモーメントを引いています。腕も反作用も逆なので T_j + T_{j-1} です", True),
        ("arm-whole-length", whole_arm,
         "the arm of the joint forces is l; from the centre it is l/2",
         "継ぎ目の力の腕の長さが l です。重心からは l/2 です", False),
        ("moment-about-joint-with-central-inertia", about_joint,
         "moments are taken about the joint, with the inertia about the centre and without the weight's and the "
         "acceleration's moment",
         "継ぎ目のまわりのモーメントに重心のまわりの慣性モーメントを組み合わせています", True),
    ]  # fmt: skip
    for code, change, english, japanese, needs_lower in kinds:
        for j in range(m.n):
            if needs_lower and j == m.n - 1 and code != "moment-about-joint-with-central-inertia":
                continue  # no force acts on the lower end of the last rod
            en, ja = body(m, j)
            yield Mistake(
                code, "moment", (j,), f"{en.capitalize()}: {english}.", f"{ja}：{japanese}。",
                at(change, j),
            )  # fmt: skip
        if m.n > 1:
            yield everywhere(code, "moment", f"Every rod: {english}.", f"すべての棒：{japanese}。", change)
