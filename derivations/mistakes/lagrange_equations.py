"""Mistakes on the way from the Lagrangian to the rows: d/dt ∂L/∂ω - ∂L/∂θ."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ..algebra.notation import sub
from ..algebra.symbols import Symbols
from ..algebra.trig import HALF, NOTHING, Formula, digit
from ..steps.derivation import Derivation, Mistake, Stage, add
from .changes import at, everywhere

Change = Callable[[Derivation, int], None]


def lagrange_mistakes(m: Symbols) -> Iterator[Mistake]:
    """All of them, for one mechanism."""
    for i in range(m.n):
        yield from _one_row(i)
        for j in _coupled(m, i):
            yield from _one_pair(m, i, j)
    yield from _all_rows(m)


def _coupled(m: Symbols, i: int) -> list[int]:
    """The angles whose difference from θ_i occurs in the Lagrangian."""
    if m.kind == "rod-chain":
        return [j for j in range(m.n) if j != i]
    return list(range(1, m.n)) if i == 0 else [0]


def _with(f: Formula, j: int) -> Formula:
    """The terms whose angle contains θ_j."""
    return Formula({key: c for key, c in f.terms.items() if digit(key[1], j)})


def _swap_waves(f: Formula) -> Formula:
    return Formula({(e, h, 1 - phase): c for (e, h, phase), c in f.terms.items() if h})


# Changes that mistakes make -------------------------------------------------------------------------------------------


def _no_convection(d: Derivation, i: int) -> None:
    d.convective[i] = {}


def _others_held(d: Derivation, i: int) -> None:
    d.convective[i] = {k: f for k, f in d.convective[i].items() if k == i}


def _own_held(d: Derivation, i: int) -> None:
    d.convective[i] = {k: f for k, f in d.convective[i].items() if k != i}


def _convection_sign(d: Derivation, i: int) -> None:
    d.convective[i] = {k: -f for k, f in d.convective[i].items()}


def _no_kinetic_slope(d: Derivation, i: int) -> None:
    d.kinetic_slope[i] = NOTHING


def _kinetic_slope_sign(d: Derivation, i: int) -> None:
    d.kinetic_slope[i] = -d.kinetic_slope[i]


def _slope_sign(d: Derivation, i: int) -> None:
    d.kinetic_slope[i], d.potential_slope[i] = -d.kinetic_slope[i], -d.potential_slope[i]


def _potential_slope_sign(d: Derivation, i: int) -> None:
    d.potential_slope[i] = -d.potential_slope[i]


def _potential_not_differentiated(d: Derivation, i: int) -> None:
    d.potential_slope[i] = -_swap_waves(d.potential_slope[i])


def _square_not_doubled(d: Derivation, i: int) -> None:
    s = d.space
    own = add([s.by_rate(d.momentum[i], i) * s.w(i)])
    d.momentum[i] = d.momentum[i] - own.times(HALF)


# (code, stage, change, English and Japanese for one row, the same for all rows or None where nobody does it throughout)
ROWS: list[tuple[str, Stage, Change, str, str]] = [
    ("velocity-terms-forgotten", "derivative", _no_convection,
     "d/dt of ∂L/∂θ̇ differentiates only the rates: the cosines change in time too (product rule; the Coriolis "
     "and centrifugal terms come from there)",
     "∂L/∂θ̇ の時間微分で cos の微分（積の微分の片方、コリオリ・遠心力の項）が抜けています"),
    ("other-angles-held", "derivative", _others_held,
     "cos(θ_i - θ_j) is differentiated as if the other angle were constant: its derivative is "
     "-(θ̇_i - θ̇_j) sin(θ_i - θ_j)",
     "cos(θ_i - θ_j) を相手の角が定数であるかのように微分しています。微分は -(θ̇_i - θ̇_j) sin(θ_i - θ_j) です"),
    ("own-angle-held", "derivative", _own_held,
     "cos(θ_i - θ_j) is differentiated as if the row's own angle were constant: its derivative is "
     "-(θ̇_i - θ̇_j) sin(θ_i - θ_j)",
     "cos(θ_i - θ_j) をその行の角が定数であるかのように微分しています。微分は -(θ̇_i - θ̇_j) sin(θ_i - θ_j) です"),
    ("cosine-time-derivative-sign", "derivative", _convection_sign,
     "the time derivative of cos(θ_i - θ_j) has the wrong sign: d cos = -sin",
     "cos(θ_i - θ_j) の時間微分の符号が逆です。cos の微分は -sin です"),
    ("kinetic-slope-missing", "derivative", _no_kinetic_slope,
     "∂T/∂θ is left out: the kinetic energy depends on the angles too",
     "∂T/∂θ が抜けています。運動エネルギーも角によります"),
    ("kinetic-slope-sign", "derivative", _kinetic_slope_sign,
     "∂T/∂θ has the wrong sign", "∂T/∂θ の符号が逆です"),
    ("lagrange-sign", "derivative", _slope_sign,
     "Lagrange's equation is written with d/dt ∂L/∂θ̇ + ∂L/∂θ = 0; the sign between them is minus",
     "ラグランジュの方程式が d/dt ∂L/∂θ̇ + ∂L/∂θ = 0 になっています。間の符号は − です"),
    ("potential-slope-sign", "derivative", _potential_slope_sign,
     "∂U/∂θ has the wrong sign: the derivative of -cos θ is +sin θ",
     "∂U/∂θ の符号が逆です。-cos θ の微分は +sin θ です"),
    ("potential-not-differentiated", "derivative", _potential_not_differentiated,
     "cos θ of the potential energy is not differentiated: the gravity term has sin θ",
     "位置エネルギーの cos θ が微分されていません。重力の項は sin θ です"),
    ("square-not-doubled", "momentum", _square_not_doubled,
     "the derivative of θ̇² is taken as θ̇; it is 2 θ̇, which cancels the ½",
     "θ̇² の微分を θ̇ としています。2 θ̇ で、½ と打ち消し合います"),
]  # fmt: skip


def _one_row(i: int) -> Iterator[Mistake]:
    for code, stage, change, english, japanese in ROWS:
        yield Mistake(
            code, stage, (i,), f"Row {i + 1}: {english}.", f"第{i + 1}式：{japanese}。",
            at(change, i),
        )  # fmt: skip


def _all_rows(m: Symbols) -> Iterator[Mistake]:
    if m.n == 1:
        return
    for code, stage, change, english, japanese in ROWS:
        yield everywhere(code, stage, f"In every row, {english}.", f"すべての式：{japanese}。", change)


def _one_pair(m: Symbols, i: int, j: int) -> Iterator[Mistake]:
    difference, en = f"cos(θ{sub(i)} - θ{sub(j)})", f"Row {i + 1}"
    derivative = f"-(θ̇{sub(i)} - θ̇{sub(j)}) sin(θ{sub(i)} - θ{sub(j)})"

    def convective(keep_own: bool, keep_other: bool, sign: int = 1) -> Callable[[Derivation], None]:
        def apply(d: Derivation) -> None:
            changed = {}
            for k, f in d.convective[i].items():
                pair = _with(f, j)
                kept = pair.times(sign) if (keep_own if k == i else keep_other) else NOTHING
                changed[k] = f - pair + kept
            d.convective[i] = changed

        return apply

    def slope(factor: int) -> Callable[[Derivation], None]:
        def apply(d: Derivation) -> None:
            pair = _with(d.kinetic_slope[i], j)
            d.kinetic_slope[i] = d.kinetic_slope[i] - pair + pair.times(factor)

        return apply

    def no_cross_momentum(d: Derivation) -> None:
        d.momentum[i] = d.momentum[i] - _with(d.momentum[i], j)

    if len(_coupled(m, i)) > 1:  # with a single partner it is the mistake of the whole row
        yield Mistake(
            "velocity-term-forgotten", "derivative", (i, j),
            f"{en}: in d/dt of ∂L/∂θ̇{sub(i)}, {difference} is not differentiated (only one half of the product rule).",
            f"第{i + 1}式：∂L/∂θ̇{sub(i)} の時間微分で {difference} が微分されていません（積の微分の片方だけ）。",
            convective(False, False),
        )  # fmt: skip
        yield Mistake(
            "other-angle-held", "derivative", (i, j),
            f"{en}: {difference} is differentiated as if θ{sub(j)} were constant; its derivative is {derivative}.",
            f"第{i + 1}式：{difference} を θ{sub(j)} が定数であるかのように微分しています。微分は {derivative} です。",
            convective(True, False),
        )  # fmt: skip
        yield Mistake(
            "own-angle-held-in-pair", "derivative", (i, j),
            f"{en}: {difference} is differentiated as if θ{sub(i)} were constant; its derivative is {derivative}.",
            f"第{i + 1}式：{difference} を θ{sub(i)} が定数であるかのように微分しています。微分は {derivative} です。",
            convective(False, True),
        )  # fmt: skip
        yield Mistake(
            "cosine-time-derivative-sign-in-pair", "derivative", (i, j),
            f"{en}: the time derivative of {difference} has the wrong sign; it is {derivative}.",
            f"第{i + 1}式：{difference} の時間微分の符号が逆です。微分は {derivative} です。",
            convective(True, True, -1),
        )  # fmt: skip
        yield Mistake(
            "kinetic-slope-term-missing", "derivative", (i, j),
            f"{en}: ∂T/∂θ{sub(i)} leaves out the term with {difference}.",
            f"第{i + 1}式：∂T/∂θ{sub(i)} に {difference} の項が抜けています。", slope(0),
        )  # fmt: skip
        yield Mistake(
            "kinetic-slope-term-sign", "derivative", (i, j),
            f"{en}: in ∂T/∂θ{sub(i)}, the term with {difference} has the wrong sign.",
            f"第{i + 1}式：∂T/∂θ{sub(i)} で {difference} の項の符号が逆です。", slope(-1),
        )  # fmt: skip
    yield Mistake(
        "cross-momentum-missing", "momentum", (i, j),
        f"{en}: ∂L/∂θ̇{sub(i)} leaves out what comes from θ̇{sub(i)} θ̇{sub(j)} {difference}.",
        f"第{i + 1}式：∂L/∂θ̇{sub(i)} で θ̇{sub(i)} θ̇{sub(j)} {difference} から出る項が抜けています。",
        no_cross_momentum,
    )  # fmt: skip
