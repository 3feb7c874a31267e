"""Mistakes on the way to the Lagrangian: in positions, velocities, squared speeds, energies, and in L = T - U."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeVar

from flint import fmpq

from ..algebra.notation import sub
from ..algebra.symbols import Symbols
from ..algebra.trig import HALF, NOTHING, Formula
from ..steps.derivation import ROTATION, Derivation, Mistake, Pair, Stage, segment_position

K = TypeVar("K")
V = TypeVar("V")


def put(parts: list[dict[K, V]], b: int, key: K, value: V) -> None:
    """Replace one part of mass b, leaving the shared original as it is."""
    parts[b] = {**parts[b], key: value}


def drop(parts: list[dict[K, V]], b: int, key: K) -> None:
    """Leave one part of mass b out."""
    parts[b] = {k: v for k, v in parts[b].items() if k != key}


def at(change: Callable[[Derivation, int], None], b: int) -> Callable[[Derivation], None]:
    """A change made at one place."""
    return lambda d: change(d, b)


def times(factor: Formula) -> Callable[[Formula], Formula]:
    """Multiplication by a factor."""
    return lambda f: f * factor


def instead(value: Formula) -> Callable[[Formula], Formula]:
    """Something else, whatever stood there."""
    return lambda f: value


def body(m: Symbols, b: int) -> tuple[str, str]:
    """What mass b is called, in English and Japanese."""
    return (f"rod {b + 1}", f"棒{b + 1}") if m.kind == "rod-chain" else (f"mass {b + 1}", f"質点{b + 1}")


def energy_mistakes(m: Symbols) -> Iterator[Mistake]:
    """All of them, for one mechanism."""
    for b in range(m.n):
        yield from _position(m, b)
        yield from _velocity(m, b)
        yield from _speed(m, b)
        yield from _energy(m, b)
        yield from _lagrangian(m, b)
    yield from _everywhere(m)
    if m.kind == "rod-chain":
        yield from _rods(m)
    else:
        yield from _point_masses(m)


# Positions ------------------------------------------------------------------------------------------------------------


def _position(m: Symbols, b: int) -> Iterator[Mistake]:
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
                f"l{sub(k)} sin θ{sub(k)}, -l{sub(k)} cos θ{sub(k)} belong to it.",
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
                f"In the position of {en} stands l{sub(j)} where l{sub(k)} belongs.",
                f"{ja}の位置で l{sub(k)} とすべき所が l{sub(j)} になっています。",
                x * ratio, y * ratio, more=(j,),
            )  # fmt: skip
            back = s.l(k) * s.l(j).inverse_monomial()
            turned = [part * back for part in segment_position(m, j, fraction)]
            yield moved(
                "wrong-angle-in-position",
                f"In the position of {en} stands θ{sub(j)} where θ{sub(k)} belongs.",
                f"{ja}の位置で θ{sub(k)} とすべき所が θ{sub(j)} になっています。",
                *turned, more=(j,),
            )  # fmt: skip
    if m.parent(b) >= 0:
        yield Mistake(
            "relative-angle", "position", (b,),
            f"In the position of {en}, θ{sub(b)} is taken as measured from the link above it; "
            "it is measured from the vertical.",
            f"{ja}の位置で θ{sub(b)} を上のリンクからの角としています。鉛直線からの角です。",
            lambda d: put(d.position, b, b, _relative(m, b, b, fractions[b])),
        )  # fmt: skip


def _relative(m: Symbols, b: int, k: int, fraction: fmpq) -> tuple[Formula, Formula]:
    """The segment of link k if every angle were measured from the link above."""
    s, angle, link = m.space, {}, k
    while link >= 0:
        angle[link] = 1
        link = m.parent(link)
    return (s.l(k) * s.sin(angle)).times(fraction), (s.l(k) * s.cos(angle)).times(-fraction)


# Velocities -----------------------------------------------------------------------------------------------------------


def scaled(factor: Formula) -> Callable[[Pair], Pair]:
    """Both components times a factor."""
    return lambda v: (v[0] * factor, v[1] * factor)


def x_instead(x: Formula) -> Callable[[Pair], Pair]:
    """Something else for x."""
    return lambda v: (x, v[1])


def y_instead(y: Formula) -> Callable[[Pair], Pair]:
    """Something else for y."""
    return lambda v: (v[0], y)


def _velocity(m: Symbols, b: int) -> Iterator[Mistake]:
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
            scaled(inverse),
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
            x_instead(x * rate),
        )  # fmt: skip
        yield changed(
            "cosine-not-differentiated",
            f"In the velocity of {en}, cos {th} stays cos {th}; its derivative is -θ̇{sub(k)} sin {th}.",
            f"{ja}の速度で cos {th} がそのまま残っています。微分すると -θ̇{sub(k)} sin {th} です。",
            y_instead(-(y * rate)),
        )  # fmt: skip
        for j in range(m.n):
            if j != k:
                ratio = s.w(j) * inverse
                yield changed(
                    "wrong-rate-in-velocity",
                    f"In the velocity of {en} stands θ̇{sub(j)} where θ̇{sub(k)} belongs.",
                    f"{ja}の速度で θ̇{sub(k)} とすべき所が θ̇{sub(j)} になっています。",
                    scaled(ratio),
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


def _speed(m: Symbols, b: int) -> Iterator[Mistake]:
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
            f"In the squared speed of {en}, l{sub(k)} stands where l{sub(k)}² belongs.",
            f"{ja}の速度の2乗で l{sub(k)}² とすべき所が l{sub(k)} です。", times(l),
        )  # fmt: skip
        yield _part(
            b, (k, k), "length-missing-in-speed",
            f"In the squared speed of {en}, l{sub(k)}² is missing beside θ̇{sub(k)}².",
            f"{ja}の速度の2乗で θ̇{sub(k)}² に l{sub(k)}² が掛かっていません。", times(l * l),
        )  # fmt: skip
        yield _part(
            b, (k, k), "rate-not-squared",
            f"In the squared speed of {en}, θ̇{sub(k)} stands where θ̇{sub(k)}² belongs.",
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
        """cos(θ_j - θ_k) replaced by something else, whatever stands before it."""
        return lambda f: _coefficient_of(f, cosine) * wave

    yield _part(
        b, pair, "cross-term-missing",
        f"The squared speed of {en} leaves out the cross term: (A + B)² also has 2AB, here {cross}.",
        f"{ja}の速度の2乗に交差項 {cross} が抜けています。(A + B)² には 2AB があります。", instead(NOTHING),
    )  # fmt: skip
    yield _part(
        b, pair, "cross-term-halved",
        f"In the squared speed of {en}, the cross term has lost its 2: (A + B)² has 2AB, here {cross}.",
        f"{ja}の速度の2乗で交差項の 2 が抜けています。正しくは {cross} です。", lambda f: f.times(HALF),
    )  # fmt: skip
    yield _part(
        b, pair, "cross-term-sign",
        f"In the squared speed of {en}, the cross term {cross} has the wrong sign.",
        f"{ja}の速度の2乗で交差項 {cross} の符号が逆です。", lambda f: -f,
    )  # fmt: skip
    yield _part(
        b, pair, "cross-term-sine",
        f"In the squared speed of {en}, the cross term has sin where cos(θ{sub(j)} - θ{sub(k)}) belongs.",
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


# Energies -------------------------------------------------------------------------------------------------------------


def _energy(m: Symbols, b: int) -> Iterator[Mistake]:
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
        "half-missing", f"The kinetic energy of {en} has lost its ½: it is ½ m v².",
        f"{ja}の運動エネルギーの ½ が抜けています。½ m v² です。", two,
    )  # fmt: skip
    yield kinetic(
        "kinetic-energy-missing", f"The kinetic energy of the motion of {en} is left out.",
        f"{ja}の並進の運動エネルギーが抜けています。", NOTHING,
    )  # fmt: skip
    yield potential(
        "potential-energy-missing", f"The potential energy of {en} is left out: gravity pulls on it too.",
        f"{ja}の位置エネルギーが抜けています。重力は{ja}にも働きます。", instead(NOTHING),
    )  # fmt: skip
    yield potential(
        "potential-energy-sign", f"The potential energy of {en} has the wrong sign: it grows with height.",
        f"{ja}の位置エネルギーの符号が逆です。高いほど大きくなります。", lambda f: -f,
    )  # fmt: skip
    yield potential(
        "gravity-factor-missing", f"The potential energy of {en} has lost its g.",
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
        "height-sine", f"The potential energy of {en} has sin {th} where cos {th} belongs.",
        f"{ja}の位置エネルギーで cos {th} とすべき所が sin {th} です。", lambda f: -(weight * x),
    )  # fmt: skip
    for j in range(m.n):
        if j == k:
            continue
        ratio = s.l(j) * s.l(k).inverse_monomial()
        yield height(
            "wrong-length-in-height", f"The potential energy of {en} has l{sub(j)} where l{sub(k)} belongs.",
            f"{ja}の位置エネルギーで l{sub(k)} とすべき所が l{sub(j)} です。", times(ratio), j,
        )  # fmt: skip
        turned = weight * s.l(k) * s.cos({j: 1}).times(-fraction)
        yield height(
            "wrong-angle-in-height", f"The potential energy of {en} has θ{sub(j)} where {th} belongs.",
            f"{ja}の位置エネルギーで {th} とすべき所が θ{sub(j)} です。", instead(turned), j,
        )  # fmt: skip


def _lagrangian(m: Symbols, b: int) -> Iterator[Mistake]:
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


# Mistakes that somebody makes throughout ------------------------------------------------------------------------------


def everywhere(
    code: str, stage: Stage, english: str, japanese: str, change: Callable[[Derivation, int], None]
) -> Mistake:
    """The same change made for every mass (or row)."""

    def apply(d: Derivation) -> None:
        for b in range(d.n):
            change(d, b)

    return Mistake(code, stage, (), english, japanese, apply)


def _everywhere(m: Symbols) -> Iterator[Mistake]:
    s = m.space

    def swap(d: Derivation, b: int) -> None:
        d.position[b] = {k: (-y, -x) for k, (x, y) in d.position[b].items()}

    def relative(d: Derivation, b: int) -> None:
        d.position[b] = {k: _relative(m, b, k, f) for k, f in m.path(b)}

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
        "Every cross term of the squared speeds has lost its 2: (A + B)² is A² + 2AB + B².",
        "すべての交差項の 2 が抜けています。(A + B)² = A² + 2AB + B² です。", halved,
    )  # fmt: skip
    yield everywhere(
        "half-missing-everywhere", "energy", "Every kinetic energy has lost its ½.",
        "すべての運動エネルギーの ½ が抜けています。", no_half,
    )  # fmt: skip
    yield everywhere(
        "gravity-missing", "energy", "Gravity is left out altogether.", "重力がまったく入っていません。", no_weight,
    )  # fmt: skip
    yield everywhere(
        "sum-for-difference", "lagrangian", "The Lagrangian is T + U; it must be T - U.",
        "ラグランジアンが T + U になっています。T - U です。", added,
    )  # fmt: skip
    yield everywhere(
        "zero-of-height-moved", "energy", "The zero of height is put elsewhere, which changes nothing.",
        "高さの基準が別の所にあります（運動方程式は変わりません）。", moved_zero,
    )  # fmt: skip
    for j in range(m.n):
        en, ja = body(m, j)

        def only(d: Derivation, j: int = j) -> None:
            d.potential = [f if b == j else {} for b, f in enumerate(d.potential)]

        yield Mistake(
            "gravity-on-one-mass-only", "energy", (j,), f"Gravity is taken to pull on {en} alone; it pulls on all.",
            f"重力が{ja}だけに働くことになっています。すべてに働きます。", only,
        )  # fmt: skip


# Mistakes that only rods, or only point masses, invite ----------------------------------------------------------------


def _rods(m: Symbols) -> Iterator[Mistake]:
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
         "the rotation is left out: a rod has ½ I θ̇² besides ½ m v², with I = m l²/12",
         "回転のエネルギー ½ I θ̇²（I = m l²/12）が抜けています"),
        ("inertia-about-end", "energy", scaled(fmpq(4)),
         "the inertia is m l²/3, about the end; with the speed of the centre belongs I = m l²/12",
         "慣性モーメントが端のまわりの m l²/3 です。重心の速度と組むのは m l²/12 です"),
        ("inertia-half-missing", "energy", scaled(fmpq(2)),
         "the rotation energy has lost its ½", "回転のエネルギー ½ I θ̇² の ½ が抜けています"),
        ("inertia-half-length", "energy", scaled(fmpq(1, 4)),
         "the inertia is taken with l/2 in place of l", "慣性モーメントで l の代わりに l/2 を使っています"),
        ("inertia-length-not-squared", "energy", not_squared,
         "the inertia has l where l² belongs", "慣性モーメントの l² が l になっています"),
        ("inertia-relative-rate", "energy", turning_relative,
         "the rotation energy has the rate relative to the rod above; the absolute rate belongs there",
         "回転のエネルギーに上の棒に対する角速度が使われています。絶対角速度です"),
        ("centre-at-end", "position", at_end,
         "the centre of mass is put at the rod's end, l; it is at l/2",
         "重心が棒の端 (l) に置かれています。l/2 の所です"),
        ("carriers-halved", "position", halves,
         "the rods above are counted with half their length; only the rod's own is halved",
         "上の棒まで半分の長さにしています。半分にするのはその棒だけです"),
        ("height-of-end", "energy", height_of_end,
         "the potential energy has the height of the rod's end; its centre belongs there",
         "位置エネルギーに棒の端の高さが使われています。重心の高さです"),
    ]  # fmt: skip
    for code, stage, change, english, japanese in kinds:
        for b in range(m.n):
            en, ja = body(m, b)
            yield Mistake(
                code, stage, (b,), f"Of {en}, {english}.", f"{ja}：{japanese}。",
                at(change, b),
            )  # fmt: skip
        if m.n > 1:
            yield everywhere(code, stage, f"Of every rod, {english}.", f"すべての棒：{japanese}。", change)


def _point_masses(m: Symbols) -> Iterator[Mistake]:
    s = m.space

    def turning(share: fmpq) -> Callable[[Derivation, int], None]:
        def change(d: Derivation, b: int) -> None:
            inertia = (m.mass(b) * s.l(b).power(2)).times(share)
            put(d.kinetic, b, ROTATION, inertia.times(HALF) * s.w(b).power(2))

        return change

    kinds = [
        ("rod-inertia-for-point-mass", fmpq(1, 12),
         "a rod's m l²/12 is added; the rods weigh nothing and the mass is a point",
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
                code, "energy", (b,), f"Of {en}, {english}.", f"{ja}：{japanese}。",
                at(change, b),
            )  # fmt: skip
        yield everywhere(code, "energy", f"Of every mass, {english}.", f"すべての質点：{japanese}。", change)
    for b in range(2, m.n):
        yield Mistake(
            "hung-from-a-leg", "position", (b,),
            f"Mass {b + 1} is hung from mass {b}; every leg hangs from mass 1.",
            f"質点{b + 1}が質点{b}から吊られています。どの足も質点1から吊られています。",
            at(lambda d, leg: put(d.position, leg, leg - 1, segment_position(m, leg - 1, fmpq(1))), b),
        )  # fmt: skip
