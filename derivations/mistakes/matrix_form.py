"""Mistakes in putting the rows together: one side scaled, signs lost in moving terms, wrong matrices."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from flint import fmpq

from ..algebra.notation import sub
from ..algebra.symbols import Symbols
from ..algebra.trig import HALF, NOTHING, Formula, Space, digit, unit
from ..steps.derivation import Derivation, Mistake, Row
from .changes import everywhere
from .row_terms import replace


def _is_acceleration(s: Space, q: int) -> bool:
    return any(digit(q, k) for k in range(s.n))


def row_mistakes(m: Symbols, i: int) -> Iterator[Mistake]:
    """Row i divided, or multiplied, by something on one side of the equals sign only."""
    s = m.space
    factors: list[tuple[str, Formula, tuple[int, ...]]] = [(f"l{sub(i)}", s.l(i), (i,))]
    if m.kind == "n-leg":
        factors.append((f"m{sub(i)}", s.m(i), (i, i)))
    for name, factor, places in factors:
        for left in (True, False):
            side, seite = ("left", "左辺") if left else ("right", "右辺")

            def scaled(d: Derivation, factor: Formula = factor, left: bool = left) -> None:
                d.rows[i] = {q: f * factor if _is_acceleration(s, q) != left else f for q, f in d.rows[i].items()}

            yield Mistake(
                f"divided-on-the-{side}-only", "matrix", places,
                f"Row {i + 1} is divided by {name} only on the {side}, the side of the "
                f"{'accelerations' if left else 'rates and gravity'}.",
                f"第{i + 1}式で {name} による割り算が{seite}だけになっています。", scaled,
            )  # fmt: skip

    def other_side(d: Derivation) -> None:
        d.rows[i] = {q: f if _is_acceleration(s, q) else -f for q, f in d.rows[i].items()}

    yield Mistake(
        "side-change-without-sign", "matrix", (i,),
        f"Row {i + 1}: the terms with rates and with gravity change sides without changing sign.",
        f"第{i + 1}式：速度と重力の項を移項したときに符号を変えていません。", other_side,
    )  # fmt: skip


def matrix_mistakes(m: Symbols) -> Iterator[Mistake]:
    """Mistakes in all rows together, and in the matrices that the documents give for each mechanism."""
    s, n = m.space, m.n

    def other_side(d: Derivation, i: int) -> None:
        d.rows[i] = {q: f if _is_acceleration(s, q) else -f for q, f in d.rows[i].items()}

    def velocity_sign(d: Derivation, i: int) -> None:
        d.rows[i] = {q: -f if q and not _is_acceleration(s, q) else f for q, f in d.rows[i].items()}

    def diagonal(d: Derivation, i: int) -> None:
        d.rows[i] = {q: f for q, f in d.rows[i].items() if not _is_acceleration(s, q) or digit(q, i)}

    def transposed(which: int) -> Callable[[Derivation], None]:
        """Columns for rows, of the matrix of accelerations (0) or of squared rates (1)."""

        def apply(d: Derivation) -> None:
            places = [unit(k) if which == 0 else 2 * unit(n + k) for k in range(n)]
            table = [[row.get(q, NOTHING) for q in places] for row in d.rows]
            for i in range(n):
                row = {q: f for q, f in d.rows[i].items() if q not in places}
                d.rows[i] = row | {q: table[j][i] for j, q in enumerate(places) if table[j][i]}

        return apply

    yield everywhere(
        "sides-changed-without-sign", "matrix",
        "In every row, the terms with rates and with gravity change sides without changing sign.",
        "すべての式で、速度と重力の項を移項したときに符号を変えていません。", other_side,
    )  # fmt: skip
    yield everywhere(
        "velocity-terms-sign", "matrix", "Every term with squared rates has the wrong sign.",
        "速度の2乗の項の符号がすべて逆です。", velocity_sign,
    )  # fmt: skip
    if n == 1:
        return
    yield everywhere(
        "coupling-missing", "matrix", "The matrix of the accelerations has only its diagonal.",
        "加速度の行列が対角成分だけになっています。", diagonal,
    )  # fmt: skip
    yield Mistake(
        "matrix-transposed", "matrix", (0,),
        "The matrix of the accelerations is transposed: l_i and l_j change places.",
        "加速度の行列が転置されています（l_i と l_j が入れ替わっています）。", transposed(0),
    )  # fmt: skip
    yield Mistake(
        "matrix-transposed", "matrix", (1,), "The matrix of the squared rates is transposed.",
        "速度の2乗の行列が転置されています。", transposed(1),
    )  # fmt: skip
    yield from (_chain_matrix(m) if m.kind == "rod-chain" else _star_matrix(m))


def _star_matrix(m: Symbols) -> Iterator[Mistake]:
    s, n = m.space, m.n
    for i in range(1, n):
        for j in range(1, n):
            if i == j:
                continue

            def coupled(d: Derivation, i: int = i, j: int = j) -> None:
                replace(d, i, unit(j), d.rows[i].get(unit(j), NOTHING) + s.m(j) * s.l(j) * s.cos({i: 1, j: -1}))

            yield Mistake(
                "legs-coupled", "matrix", (i, j),
                f"A[{i + 1},{j + 1}] is not 0: legs act on link 1, not on each other.",
                f"A[{i + 1},{j + 1}] が 0 ではありません。足どうしは直接には影響しません。", coupled,
            )  # fmt: skip


def _chain_matrix(m: Symbols) -> Iterator[Mistake]:
    """Takeno's L_j = l_j/2 + Σ_{i>j} l_i and α_jk = L_max(j,k) - δ_jk l_j/6, put together wrongly."""
    s, n = m.space, m.n

    def below(j: int, own: fmpq = HALF, start: int = 1) -> Formula:
        total = s.l(j).times(own)
        for i in range(j + start, n):
            total = total + s.l(i)
        return total

    def rebuilt(
        length: Callable[[int], Formula], pick: Callable[[int, int], int], delta: fmpq
    ) -> Callable[[Derivation], None]:
        def apply(d: Derivation) -> None:
            for j in range(n):
                row: Row = {0: length(j) * s.g * s.sin({j: 1})}
                for k in range(n):
                    alpha = (length(pick(j, k)) - (s.l(j).times(delta) if j == k else NOTHING)) * s.l(k)
                    between = {j: 1, k: -1} if j != k else {}
                    row[unit(k)] = alpha * s.cos(between)
                    row[2 * unit(n + k)] = alpha * s.sin(between)
                d.rows[j] = {q: f for q, f in row.items() if f}

        return apply

    sixth = fmpq(1, 6)
    kinds: list[tuple[str, Callable[[Derivation], None], str, str]] = [
        ("smaller-for-larger-index", rebuilt(below, min, sixth),
         "L has the smaller of the two indices, expected the larger, for the rods below both",
         "L の添字が小さい方になっています。両方より下にあるのは大きい方の添字です"),
        ("own-length-whole", rebuilt(lambda j: below(j, fmpq(1)), max, sixth),
         "L_j has the rod's own length in full, expected half of it, to the centre of mass",
         "L_j で自分の長さを全部数えています。重心までの半分です"),
        ("own-length-missing", rebuilt(lambda j: below(j, fmpq(0)), max, sixth),
         "L_j leaves out l_j/2", "L_j に l_j/2 が抜けています"),
        ("delta-sign", rebuilt(below, max, -sixth),
         "δ_jk l_j/6 is added; it is subtracted", "δ_jk l_j/6 を足しています。引きます"),
        ("delta-missing", rebuilt(below, max, fmpq(0)), "δ_jk l_j/6 is left out", "δ_jk l_j/6 が抜けています"),
        ("sum-index-own", rebuilt(lambda j: s.l(j).times(HALF) + s.l(j).times(n - 1 - j), max, sixth),
         "the sum in L_j adds l_j repeatedly; its index must run over the rods below (Takeno's (12) prints l_m)",
         "L_j の和で l_j ばかり足しています。添字は下の棒を動きます（(12) の印刷では l_m）"),
        ("sum-index-last", rebuilt(lambda j: s.l(j).times(HALF) + s.l(n - 1).times(n - 1 - j), max, sixth),
         "the sum in L_j adds l_n repeatedly; its index must run over the rods below (Takeno's (12) prints l_m)",
         "L_j の和で l_n ばかり足しています。添字は下の棒を動きます（(12) の印刷では l_m）"),
        ("delta-third", rebuilt(below, max, fmpq(1, 3)),
         "found δ_jk l_j/3, expected δ_jk l_j/6", "δ_jk l_j/6 とすべき所が l_j/3 です"),
    ]  # fmt: skip
    for code, apply, english, japanese in kinds:
        yield Mistake(code, "matrix", (), f"In the matrices, {english}.", f"行列で、{japanese}。", apply)
