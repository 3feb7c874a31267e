"""Mistakes in the velocities of the masses and in their squared speeds."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ..algebra.notation import sub
from ..algebra.symbols import Symbols
from ..algebra.trig import HALF, NOTHING, Formula
from ..steps.derivation import Derivation, Mistake, Pair, segment_position
from .changes import body, instead, put, times


def _scaled(factor: Formula) -> Callable[[Pair], Pair]:
    """Both components times a factor."""
    return lambda v: (v[0] * factor, v[1] * factor)


def _x_instead(x: Formula) -> Callable[[Pair], Pair]:
    """Replacement of x."""
    return lambda v: (x, v[1])


def _y_instead(y: Formula) -> Callable[[Pair], Pair]:
    """Replacement of y."""
    return lambda v: (v[0], y)


def velocity_mistakes(m: Symbols, b: int) -> Iterator[Mistake]:
    """Mistakes in the velocity of mass b."""
    s, (en, ja) = m.space, body(m, b)
    for k, fraction in m.path(b):
        x, y = segment_position(m, k, fraction)
        rate, inverse = s.w(k), s.w(k).inverse_monomial()
        th, l = f"θ{sub(k)}", f"l{sub(k)}"

        def changed(
            code: str, english: str, japanese: str, change: Callable[[Pair], Pair],
            k: int = k, more: tuple[int, ...] = (),
        ) -> Mistake:  # fmt: skip
            return Mistake(
                code, "velocity", (b, k, *more), english, japanese,
                lambda d: put(d.velocity, b, k, change(d.velocity[b].get(k, (NOTHING, NOTHING)))),
            )  # fmt: skip

        yield changed(
            "inner-derivative-missing",
            f"In the velocity of {en}, sin {th} and cos {th} are differentiated "
            f"without the inner derivative θ̇{sub(k)}.",
            f"{ja}の速度で sin {th}, cos {th} を時間で微分したときの θ̇{sub(k)} が抜けています。",
            _scaled(inverse),
        )  # fmt: skip
        yield changed(
            "cosine-derivative-sign",
            f"In the velocity of {en}, the derivative of -{l} cos {th} has the wrong sign: "
            f"it is +{l} θ̇{sub(k)} sin {th}.",
            f"{ja}の速度で -{l} cos {th} の微分の符号が逆です。+{l} θ̇{sub(k)} sin {th} になります。",
            lambda v: (v[0], -v[1]),
        )  # fmt: skip
        yield changed(
            "sine-not-differentiated",
            f"In the velocity of {en}, sin {th} stays sin {th}; its derivative is θ̇{sub(k)} cos {th}.",
            f"{ja}の速度で sin {th} がそのまま残っています。微分すると θ̇{sub(k)} cos {th} です。",
            _x_instead(x * rate),
        )  # fmt: skip
        yield changed(
            "cosine-not-differentiated",
            f"In the velocity of {en}, cos {th} stays cos {th}; its derivative is -θ̇{sub(k)} sin {th}.",
            f"{ja}の速度で cos {th} がそのまま残っています。微分すると -θ̇{sub(k)} sin {th} です。",
            _y_instead(-(y * rate)),
        )  # fmt: skip
        for j in range(m.n):
            if j != k:
                ratio = s.w(j) * inverse
                yield changed(
                    "wrong-rate-in-velocity",
                    f"In the velocity of {en}: found θ̇{sub(j)}, expected θ̇{sub(k)}.",
                    f"{ja}の速度で θ̇{sub(k)} とすべき所が θ̇{sub(j)} になっています。",
                    _scaled(ratio),
                    more=(j,),
                )  # fmt: skip
    for axis, name in enumerate("xy"):

        def without(d: Derivation, axis: int = axis) -> None:
            d.velocity[b] = {
                k: (NOTHING, v[1]) if axis == 0 else (v[0], NOTHING) for k, v in d.velocity[b].items()
            }  # fmt: skip

        yield Mistake(
            f"{name}-velocity-missing", "velocity", (b,),
            f"The squared speed of {en} leaves out its {name} component.",
            f"{ja}の速度の2乗に {name} 成分が入っていません。",
            without,
        )  # fmt: skip


# Squared speeds -------------------------------------------------------------------------------------------------------


def speed_mistakes(m: Symbols, b: int) -> Iterator[Mistake]:
    """Mistakes in the squared speed of mass b."""
    s, (en, ja) = m.space, body(m, b)
    path = [k for k, _ in m.path(b)]
    for k in path:
        own, l, w = f"l{sub(k)}² θ̇{sub(k)}²", s.l(k).inverse_monomial(), s.w(k).inverse_monomial()
        yield _part(
            b, (k, k), "own-term-missing",
            f"The squared speed of {en} leaves out {own}.",
            f"{ja}の速度の2乗に {own} が抜けています。", instead(NOTHING),
        )  # fmt: skip
        yield _part(
            b, (k, k), "length-not-squared",
            f"In the squared speed of {en}: found l{sub(k)}, expected l{sub(k)}².",
            f"{ja}の速度の2乗で l{sub(k)}² とすべき所が l{sub(k)} です。", times(l),
        )  # fmt: skip
        yield _part(
            b, (k, k), "length-missing-in-speed",
            f"In the squared speed of {en}, l{sub(k)}² is missing beside θ̇{sub(k)}².",
            f"{ja}の速度の2乗で θ̇{sub(k)}² に l{sub(k)}² が掛かっていません。", times(l * l),
        )  # fmt: skip
        yield _part(
            b, (k, k), "rate-not-squared",
            f"In the squared speed of {en}: found θ̇{sub(k)}, expected θ̇{sub(k)}².",
            f"{ja}の速度の2乗で θ̇{sub(k)}² とすべき所が θ̇{sub(k)} です。", times(w),
        )  # fmt: skip
    for place, j in enumerate(path):
        for k in path[place + 1 :]:
            yield from _cross(m, b, (j, k))


def _part(
    b: int, pair: tuple[int, int], code: str, english: str, japanese: str, change: Callable[[Formula], Formula]
) -> Mistake:
    places = (b, pair[0]) if pair[0] == pair[1] else (b, *pair)
    return Mistake(
        code, "speed", places, english, japanese,
        lambda d: put(d.square, b, pair, change(d.square[b].get(pair, NOTHING))),
    )  # fmt: skip


def _cross(m: Symbols, b: int, pair: tuple[int, int]) -> Iterator[Mistake]:
    s, (en, ja), (j, k) = m.space, body(m, b), pair
    cross = f"2 l{sub(j)} l{sub(k)} θ̇{sub(j)} θ̇{sub(k)} cos(θ{sub(j)} - θ{sub(k)})"
    cosine, sine, plus = s.cos({j: 1, k: -1}), s.sin({j: 1, k: -1}), s.cos({j: 1, k: 1})

    def replaced(wave: Formula) -> Callable[[Formula], Formula]:
        """cos(θ_j - θ_k) replaced by another function; its coefficient stays."""
        return lambda f: _coefficient_of(f, cosine) * wave

    yield _part(
        b, pair, "cross-term-missing",
        f"The squared speed of {en} leaves out the cross term: (A + B)² also has 2AB, here {cross}.",
        f"{ja}の速度の2乗に交差項 {cross} が抜けています。(A + B)² には 2AB があります。", instead(NOTHING),
    )  # fmt: skip
    yield _part(
        b, pair, "cross-term-halved",
        f"In the squared speed of {en}, the cross term is missing its factor 2: (A + B)² has 2AB, here {cross}.",
        f"{ja}の速度の2乗で交差項の 2 が抜けています。正しくは {cross} です。", lambda f: f.times(HALF),
    )  # fmt: skip
    yield _part(
        b, pair, "cross-term-sign",
        f"In the squared speed of {en}, the cross term {cross} has the wrong sign.",
        f"{ja}の速度の2乗で交差項 {cross} の符号が逆です。", lambda f: -f,
    )  # fmt: skip
    yield _part(
        b, pair, "cross-term-sine",
        f"In the squared speed of {en}, the cross term has sin, expected cos(θ{sub(j)} - θ{sub(k)}).",
        f"{ja}の速度の2乗の交差項で cos(θ{sub(j)} - θ{sub(k)}) とすべき所が sin です。", replaced(sine),
    )  # fmt: skip
    yield _part(
        b, pair, "cross-term-angle-sum",
        f"In the squared speed of {en}, the cross term has cos(θ{sub(j)} + θ{sub(k)}); "
        "cos A cos B + sin A sin B is cos(A - B).",
        f"{ja}の速度の2乗の交差項が cos(θ{sub(j)} + θ{sub(k)}) です。"
        "cos A cos B + sin A sin B = cos(A - B) です。", replaced(plus),
    )  # fmt: skip


def _coefficient_of(f: Formula, wave: Formula) -> Formula:
    ((_, h, phase),) = wave.terms
    return Formula({(e, 0, 0): c for (e, h2, s2), c in f.terms.items() if (h2, s2) == (h, phase)})
