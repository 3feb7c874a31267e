"""Mistakes in one term of a finished row, as they happen in copying or collecting terms."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from flint import fmpq

from ..algebra.notation import motion_text, pretty, sub, term_name
from ..algebra.symbols import Symbols
from ..algebra.trig import COS, HALF, NOTHING, Formula, Key, Space, digits, unit
from ..steps.derivation import Derivation, Mistake, Row
from .changes import times

Change = Callable[[Formula], Formula]


def term_mistakes(m: Symbols, i: int, row: Row) -> Iterator[Mistake]:
    """Every mistake in one term of row i, whose right coefficients are given."""
    for q, coefficient in row.items():
        yield from _whole_term(m, i, q, coefficient)
        yield from _symbols(m, i, q, coefficient)
        yield from _parts(m, i, q, coefficient)
        yield from _motion(m, i, q)


def replace(d: Derivation, i: int, q: int, f: Formula, at: int | None = None) -> None:
    """Replace one coefficient of row i; ``at``: it now multiplies another product of rates and accelerations."""
    row: Row = {k: v for k, v in d.rows[i].items() if k != q}
    place = q if at is None else at
    sum_ = row.get(place, NOTHING) + f
    if sum_:
        row[place] = sum_
    else:
        row.pop(place, None)
    d.rows[i] = row


def _term_title(m: Symbols, i: int, q: int) -> tuple[str, str]:
    """The title of a term in English and Japanese: its row, what it multiplies, its place in the matrix form."""
    what = "g" if not q else pretty(motion_text(m.space, q))
    kind = ("the gravity term", "重力の項") if not q else (f"the {what} term", f"{what} の項")
    return f"Row {i + 1}, {kind[0]} ({term_name(m, i, q)})", f"第{i + 1}式の{kind[1]} ({term_name(m, i, q)})"


def _term(m: Symbols, i: int, q: int, code: str, english: str, japanese: str, change: Change, *more: int) -> Mistake:
    en, ja = _term_title(m, i, q)
    return Mistake(
        code, "equation", (i, *_places(m.space, q), *more), f"{en}: {english}.", f"{ja}：{japanese}。",
        lambda d: replace(d, i, q, change(d.rows[i].get(q, NOTHING))),
    )  # fmt: skip


def _places(s: Space, q: int) -> tuple[int, ...]:
    """A product of motion as places for a mistake's name: accelerations as they are, rates after them."""
    return tuple(place for place, power in enumerate(digits(q, 2 * s.n)) for _ in range(abs(power)))


def _whole_term(m: Symbols, i: int, q: int, f: Formula) -> Iterator[Mistake]:
    s = m.space
    yield _term(m, i, q, "sign", "the sign is wrong", "符号が逆です", lambda f: -f)
    yield _term(m, i, q, "term-missing", "it is missing", "抜けています", lambda f: NOTHING)
    yield _term(m, i, q, "factor-two", "it has an extra factor 2", "余分な 2 が掛かっています", lambda f: f.times(2))
    yield _term(
        m, i, q, "factor-half", "it has an extra factor ½", "余分な ½ が掛かっています", lambda f: f.times(HALF)
    )
    waves = {(h, phase) for _, h, phase in f.terms}
    if waves != {(0, COS)}:
        ((_, phase),) = {(0, p) for _, p in waves}
        old, new = ("cos", "sin") if phase == COS else ("sin", "cos")
        yield _term(
            m, i, q, f"{new}-for-{old}", f"found {new}, expected {old}", f"{old} とすべき所が {new} です",
            lambda f: _waves(s, f, lambda angle, phase: s.wave(angle, 1 - phase)),
        )  # fmt: skip
    angles = digits(next(iter(waves))[0], s.n)
    if sum(1 for a in angles if a) == 2:
        yield _term(
            m, i, q, "angle-sum", "found the sum of the angles, expected their difference",
            "角の和になっています。差です",
            lambda f: _waves(s, f, lambda angle, phase: s.wave({k: abs(a) for k, a in angle.items()}, phase)),
        )  # fmt: skip
    for old_angle in (k for k, a in enumerate(angles) if a):
        for k in range(m.n):
            if not angles[k]:
                yield _term(
                    m, i, q, "wrong-angle", f"found θ{sub(k)}, expected θ{sub(old_angle)}",
                    f"θ{sub(old_angle)} とすべき所が θ{sub(k)} です",
_other_angle(s, old_angle, k),
                    old_angle, k,
                )  # fmt: skip
    if q == 0:
        yield _term(m, i, q, "g-missing", "g is missing", "g が抜けています", lambda f: f * s.g.inverse_monomial())


def _other_angle(s: Space, old: int, new: int) -> Change:
    """θ_new inside cos and sin where θ_old stood."""

    def wave(angle: dict[int, int], phase: int) -> Formula:
        return s.wave({new if j == old else j: a for j, a in angle.items()}, phase)

    return lambda f: _waves(s, f, wave)


def _waves(s: Space, f: Formula, change: Callable[[dict[int, int], int], Formula]) -> Formula:
    """Each term's cos or sin, as it is written (first angle positive), replaced by another."""
    result = NOTHING
    for (e, h, phase), c in f.terms.items():
        angle = {k: a for k, a in enumerate(digits(h, s.n)) if a}
        flipped = bool(angle) and next(iter(angle.values())) < 0
        shown = {k: -a if flipped else a for k, a in angle.items()}
        factor = Formula({(e, 0, COS): -c if flipped and phase != COS else c})
        result = result + factor * (change(shown, phase) if angle else s.wave({}, phase))
    return result


def _symbols(m: Symbols, i: int, q: int, f: Formula) -> Iterator[Mistake]:
    """Mistakes in what all terms of a coefficient have in common: l, m."""
    s, n = m.space, m.n
    exponents = [digits(e, s.symbol_count) for e, _, _ in f.terms]
    for letter, offset in (("l", 2 * n), ("m", 3 * n)):
        common = [k for k in range(n) if all(e[offset + k] > 0 for e in exponents)]
        for k in common:
            name, place = f"{letter}{sub(k)}", offset + k
            yield _term(
                m, i, q, f"{_WORDS[letter]}-missing", f"{name} is missing", f"{name} が抜けています",
                times(s.symbol(place).inverse_monomial()), k,
            )  # fmt: skip
            yield _term(
                m, i, q, f"{_WORDS[letter]}-too-many", f"it has an extra factor {name}",
                f"{name} が一つ多く掛かっています", times(s.symbol(place)), k,
            )  # fmt: skip
            for j in range(n):
                if j != k:
                    ratio = s.symbol(offset + j) * s.symbol(place).inverse_monomial()
                    yield _term(
                        m, i, q, f"wrong-{_WORDS[letter]}",
                        f"found {letter}{sub(j)}, expected {name}",
                        f"{name} とすべき所が {letter}{sub(j)} です", times(ratio), k, j,
                    )  # fmt: skip
        if letter == "l" and m.kind == "n-leg":
            for k in range(n):
                if k not in common:
                    yield _term(
                        m, i, q, "length-too-many", f"it has an extra factor l{sub(k)}",
                        f"l{sub(k)} が一つ多く掛かっています",
                        times(s.symbol(offset + k)), k,
                    )  # fmt: skip


_WORDS = {"l": "length", "m": "mass"}


def _parts(m: Symbols, i: int, q: int, f: Formula) -> Iterator[Mistake]:
    """Mistakes in a sum of masses or lengths: a summand missing, or taken without its fraction."""
    s = m.space
    if len(f) < 2:
        return
    for key, c in f.terms.items():
        summand = pretty(_summand(s, key))
        yield _term(
            m, i, q, "sum-incomplete", f"the sum leaves out {summand}", f"和に {summand} が入っていません",
            _summand_sized(key, 0), *_own(m, key),
        )  # fmt: skip
        if abs(c) != 1:
            yield _term(
                m, i, q, "fraction-missing", f"{summand} in the sum is missing its factor {abs(c)}",
                f"和の {summand} に {abs(c)} が掛かっていません",
                _summand_sized(key, 1), *_own(m, key),
            )  # fmt: skip


def _own(m: Symbols, key: Key) -> tuple[int, ...]:
    """The link that a summand is about, as a place for the mistake's name."""
    s, n = m.space, m.n
    powers = digits(key[0], s.symbol_count)
    offset = 3 * n if m.kind == "n-leg" else 2 * n
    return tuple(k for k in range(n) for _ in range(powers[offset + k]) if powers[offset + k] > 0)


def _summand(s: Space, key: Key) -> str:
    powers = digits(key[0], s.symbol_count)
    return " ".join(
        s.names[place] + (f"^{power}" if power != 1 else "")
        for place, power in enumerate(powers)
        if power and place != 4 * s.n
    )


def _summand_sized(key: Key, size: int) -> Change:
    """A summand left out (0), or without its fraction (1); its sign stays."""

    def change(f: Formula) -> Formula:
        c = f.terms.get(key)
        if c is None:
            return f
        return f + Formula({key: -c}) + (Formula({key: fmpq(size if c > 0 else -size)}) if size else NOTHING)

    return change


def _motion(m: Symbols, i: int, q: int) -> Iterator[Mistake]:
    """The right coefficient with the wrong rate or acceleration."""
    s, n = m.space, m.n
    powers = {place: power for place, power in enumerate(digits(q, 2 * n)) if power}
    if not powers:
        return
    ((place, power),) = powers.items()
    en, ja = _term_title(m, i, q)

    def moved(code: str, target: int, english: str, japanese: str) -> Mistake:
        return Mistake(
            code, "equation", (i, *_places(s, q), *_places(s, target)), f"{en}: {english}.", f"{ja}：{japanese}。",
            lambda d: replace(d, i, q, d.rows[i].get(q, NOTHING), at=target),
        )  # fmt: skip

    for k in range(n):
        if place < n and k != place:
            yield moved(
                "wrong-acceleration", unit(k), f"found θ̈{sub(k)}, expected θ̈{sub(place)}",
                f"θ̈{sub(place)} とすべき所が θ̈{sub(k)} です",
            )  # fmt: skip
        if place >= n and k != place - n:
            yield moved(
                "wrong-rate", 2 * unit(n + k), f"found θ̇{sub(k)}², expected θ̇{sub(place - n)}²",
                f"θ̇{sub(place - n)}² とすべき所が θ̇{sub(k)}² です",
            )  # fmt: skip
            yield moved(
                "rate-product", unit(n + k) + unit(place),
                f"found θ̇{sub(min(k, place - n))} θ̇{sub(max(k, place - n))}, expected θ̇{sub(place - n)}²",
                f"θ̇{sub(place - n)}² とすべき所が θ̇{sub(min(k, place - n))} θ̇{sub(max(k, place - n))} です",
            )  # fmt: skip
    if place >= n and power == 2:
        name = f"θ̇{sub(place - n)}"
        yield moved(
            "square-missing", unit(place), f"found {name}, expected {name}²", f"{name}² とすべき所が {name} です"
        )
