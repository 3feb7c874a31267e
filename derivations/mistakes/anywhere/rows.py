"""Mistakes on the way from the energies of any planar mechanism to its rows, each as what it adds to each row."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from flint import fmpq

from ...algebra.notation import text
from ...algebra.signs import switches
from ...algebra.trig import COS, HALF, NOTHING, ONE, SIN, Formula, Key, Space, digits, unit
from ...steps.conventions import Convention
from ...steps.declared import Declared
from ...steps.derivation import Stage, add, lagrange_rows
from ...steps.mechanism import Mechanism
from .parts import AnyMistake, Words, shown


def derivative_mistakes(s: Space, kinetic: Formula, potential: Formula, words: Words) -> Iterator[AnyMistake]:
    """Mistakes in Lagrange's derivatives of T and U: in one row, and the same in all rows."""
    n = s.n
    momenta = [s.by_rate(kinetic, i) for i in range(n)]
    through = [
        [s.by_angle(p, j) * s.w(j) for j in range(n)] for p in momenta
    ]  # d/dt of ∂T/∂q̇ by way of each coordinate
    slope = [s.by_angle(kinetic, i) for i in range(n)]
    height = [s.by_angle(potential, i) for i in range(n)]
    whole = [add(parts) for parts in through]
    inertial = [add(s.by_rate(p, j) * s.a(j) for j in range(n)) for p in momenta]
    kinds: list[tuple[str, str, str, list[Formula]]] = [
        (
            "velocity-terms-forgotten",
            "in d/dt ∂T/∂q̇ the angles are held: the terms with products of rates are missing",
            "d/dt ∂T/∂q̇ で角を定数とみなし、速度の項が抜けています",
            [-f for f in whole],
        ),
        (
            "other-angles-held",
            "in d/dt ∂T/∂q̇ only the row's own coordinate changes; the others do too",
            "d/dt ∂T/∂q̇ で自分の座標の変化しか入っていません",
            [through[i][i] - whole[i] for i in range(n)],
        ),
        (
            "own-angle-held",
            "in d/dt ∂T/∂q̇ the row's own coordinate is held",
            "d/dt ∂T/∂q̇ で自分の座標の変化が抜けています",
            [-through[i][i] for i in range(n)],
        ),
        (
            "inner-derivative-of-cosine",
            "the inner derivative is forgotten in d/dt of cos or sin in ∂T/∂q̇",
            "d/dt cos の中身の微分が抜けています",
            [by_argument(s, p, 1) - f for p, f in zip(momenta, whole, strict=True)],
        ),
        (
            "inner-derivative-of-cosine",
            "the inner derivative is forgotten in d/dt of cos or sin in ∂T/∂q̇",
            "d/dt cos の中身の微分が抜けています",
            [by_argument(s, p, -1) - f for p, f in zip(momenta, whole, strict=True)],
        ),
        (
            "cosine-time-derivative-sign",
            "d/dt of cos or sin in ∂T/∂q̇ has the wrong sign",
            "d/dt cos の符号が逆です",
            [f.times(-2) for f in whole],
        ),
        ("kinetic-slope-missing", "∂T/∂q is left out", "∂T/∂q が抜けています", slope),
        ("kinetic-slope-sign", "∂T/∂q has the wrong sign", "∂T/∂q の符号が逆です", [f.times(2) for f in slope]),
        (
            "lagrange-sign",
            "∂L/∂q is added; it is subtracted",
            "∂L/∂q が足されています。引きます",
            [(f - u).times(2) for f, u in zip(slope, height, strict=True)],
        ),
        ("potential-slope-sign", "∂U/∂q has the wrong sign", "∂U/∂q の符号が逆です", [f.times(-2) for f in height]),
        ("potential-slope-missing", "∂U/∂q is left out", "∂U/∂q が抜けています", [-f for f in height]),
        (
            "square-not-doubled",
            "the derivative of a squared rate lacks its factor 2",
            "角速度の2乗の微分に 2 がありません",
            [_own(s, i, inertial[i]).times(-HALF) for i in range(n)],
        ),
    ]
    for code, english, japanese, changes in kinds:
        yield from _by_row(code, "derivative", english, japanese, changes, words)
    for i in range(n):
        for j in range(n):
            if j != i and through[i][j]:
                c = words.coordinates[j]
                yield AnyMistake(
                    "other-angle-held",
                    "derivative",
                    f"In row {i + 1}, in d/dt ∂T/∂q̇ {c} is held.",
                    f"第{i + 1}式：d/dt ∂T/∂q̇ で {c} の変化が抜けています。",
                    rows={i: -through[i][j]},
                )


def _own(s: Space, i: int, f: Formula) -> Formula:
    """The part with the row's own acceleration."""
    return Formula({key: c for key, c in f.terms.items() if s.accelerations(key[0]) == unit(i)})


def _by_row(
    code: str, stage: Stage, english: str, japanese: str, changes: list[Formula], words: Words
) -> Iterator[AnyMistake]:
    """The mistake in all rows, and in each."""
    made = {i: f for i, f in enumerate(changes) if f}
    if len(made) > 1:
        yield AnyMistake(code, stage, f"In every row, {english}.", f"すべての式：{japanese}。", rows=made)
    for i, f in made.items():
        yield AnyMistake(
            code,
            stage,
            f"In row {i + 1} ({words.coordinates[i]}), {english}.",
            f"第{i + 1}式（{words.coordinates[i]}）：{japanese}。",
            rows={i: f},
        )


def by_argument(s: Space, f: Formula, sign: int) -> Formula:
    """The derivative of every cos and sin by its whole argument, with ``sign`` for how a difference is written."""
    out: dict[Key, fmpq] = {}
    for (e, h, phase), c in f.terms.items():
        if h:
            is_difference = min(digits(h, s.n)) < 0
            out[e, h, 1 - phase] = c * (sign if is_difference else 1) * (1 if phase == SIN else -1)
    return Formula(out)


def carried_mistakes(m: Mechanism, words: Words) -> Iterator[AnyMistake]:
    """The moments on a link without the force of what it carries."""
    s, n = m.space, m.space.n
    if len(m.bodies) != n:
        return
    alone = []
    for i, body in enumerate(m.bodies):
        one = Mechanism(s, (body,), weight=m.weight, values=m.values)
        alone.append(one.free_rows[i])
    free = lagrange_rows(s, m.lagrangian + m.springs)
    changes = [mine - all_ for mine, all_ in zip(alone, free, strict=True)]
    yield from _by_row(
        "carried-force-missing",
        "force",
        "the force of the next link is left out: what it carries acts on it",
        "次のリンクからの力が抜けています",
        changes,
        words,
    )


def force_mistakes(m: Mechanism, declared: Declared, convention: Convention, words: Words) -> Iterator[AnyMistake]:
    """Drives, dampers and springs: signs, relative and absolute motion, the reaction on the carrier."""
    s = m.space
    for k, body in enumerate(declared.bodies):
        form = declared.own_motion(k, convention)
        rate, name = add(s.w(i).times(c) for i, c in form.items()), words.bodies[k]
        sums = [
            ("drive", "the drive", "駆動力", body.drive, body.drive),
            ("damping", "the damping", "減衰", -(body.damping * rate), -(body.damping * s.w(k).times(form[k]))),
            (
                "friction",
                "the dry friction",
                "乾性摩擦",
                -declared.dry_friction(k, form),
                -declared.dry_friction(k, {k: form[k]}),
            ),
        ]
        for code, what, was, force, own in sums:
            if not force:
                continue
            on = {i: force.times(c) for i, c in form.items()}  # what stands on the right of each row
            yield AnyMistake(
                f"{code}-sign",
                "force",
                f"The sign of {what} at {name} is wrong: virtual work is force times displacement.",
                f"{name} の{was}の符号が逆です。",
                rows={i: f.times(2) for i, f in on.items()},
            )
            yield AnyMistake(
                f"{code}-missing",
                "force",
                f"{what.capitalize()} at {name} is left out.",
                f"{name} の{was}が抜けています。",
                rows=on,
            )
            for i, f in on.items():
                yield AnyMistake(
                    f"{code}-sign",
                    "force",
                    f"In row {i + 1}, the sign of {what} at {name} is wrong.",
                    f"第{i + 1}式：{name} の{was}の符号が逆です。",
                    rows={i: f.times(2)},
                )
            if len(form) > 1:
                above = next(i for i in form if i != k)
                yield AnyMistake(
                    f"{code}-reaction-missing",
                    "force",
                    f"{what.capitalize()} at {name} acts on what carries it too, the other way; that is left out.",
                    f"{name} の{was}の反作用が抜けています。",
                    rows={above: on[above]},
                )
                if own != force:
                    pulled = force - own
                    yield AnyMistake(
                        f"{code}-rate",
                        "force",
                        f"{what.capitalize()} at {name} has the absolute rate; it is "
                        "that of the joint, relative to what carries it.",
                        f"{name} の{was}の速度が絶対値です。関節の相対速度です。",
                        rows={i: pulled.times(c) for i, c in form.items()},
                    )
                    for i, c in form.items():
                        yield AnyMistake(
                            f"{code}-rate",
                            "force",
                            f"In row {i + 1}, {what} at {name} has the absolute rate; it is that of the joint.",
                            f"第{i + 1}式：{name} の{was}の速度が絶対値です。",
                            rows={i: pulled.times(c)},
                        )
                    yield AnyMistake(
                        f"{code}-rate",
                        "force",
                        f"{what.capitalize()} at {name} has the absolute rate, and no reaction on what carries it.",
                        f"{name} の{was}の速度が絶対値で、反作用もありません。",
                        rows={k: pulled.times(form[k]), above: on[above]},
                    )
            elif k and declared.bodies[k].on >= 0:
                on_ = declared.bodies[k].on
                yield AnyMistake(
                    f"{code}-reaction-added",
                    "force",
                    f"{what.capitalize()} at {name} stands in the row of what "
                    "carries it as well; in joint angles it does no work there.",
                    f"{name} の{was}が上のリンクの式にもあります。",
                    rows={on_: force},
                )
                if code == "damping" and s.w(on_) != rate:
                    other = body.damping * (rate - s.w(on_))
                    yield AnyMistake(
                        f"{code}-rate",
                        "force",
                        f"{what.capitalize()} at {name} has a difference of rates; the joint's own rate is meant.",
                        f"{name} の{was}の速度が差になっています。",
                        rows={k: other + force},
                    )
        if body.friction:
            constant = declared.dry_friction(k, form) - body.friction
            yield AnyMistake(
                "friction-without-sign",
                "force",
                f"The dry friction at {name} has no sign of the rate: it is against the motion, whichever way that is.",
                f"{name} の乾性摩擦に速度の符号がありません。摩擦は運動と逆向きに働きます。",
                rows={i: (-constant).times(c) for i, c in form.items()},
            )
        elastic = body.stiffness * (add(s.q(i).times(c) for i, c in form.items()) - body.rest)
        if elastic:
            yield from _spring(s, k, form, body.stiffness, elastic, name)


def _spring(
    s: Space, k: int, form: dict[int, int], stiffness: Formula, elastic: Formula, name: str
) -> Iterator[AnyMistake]:
    on = {i: elastic.times(c) for i, c in form.items()}
    yield AnyMistake(
        "spring-sign",
        "force",
        f"The sign of the spring at {name} is wrong.",
        f"{name} のばねの符号が逆です。",
        rows={i: f.times(-2) for i, f in on.items()},
    )
    if len(form) > 1:
        above = next(i for i in form if i != k)
        yield AnyMistake(
            "spring-reaction-missing",
            "force",
            f"The spring at {name} acts on what carries it too; that is left out.",
            f"{name} のばねの反作用が抜けています。",
            rows={above: -on[above]},
        )
        own = stiffness * s.q(k).times(form[k])
        yield AnyMistake(
            "spring-angle",
            "force",
            f"The spring at {name} has the absolute angle; it is that of the joint.",
            f"{name} のばねの角が絶対角です。",
            rows={i: (own - elastic).times(c) for i, c in form.items()},
        )


def small_angle_mistakes(m: Mechanism) -> Iterator[AnyMistake]:
    """Small angles put in before the equations are exact; from the downward vertical."""
    s, n = m.space, m.space.n
    gravity = [s.by_angle(m.potential - m.springs, i) for i in range(n)]
    if not s.extra:
        return
    yield AnyMistake(
        "small-angle-early",
        "equation",
        "Gravity is taken for small angles: sin θ has become θ; the exact equations have sin θ.",
        "重力の項に小さい角の近似 sin θ ≈ θ が使われています。",
        rows={i: linear(s, f) - f for i, f in enumerate(gravity) if f},
    )
    yield AnyMistake(
        "small-angle-early",
        "equation",
        "Gravity is taken for small angles: sin θ has become θ; the exact equations have sin θ.",
        "重力の項に小さい角の近似 sin θ ≈ θ が使われています。",
        rows={i: linear(s, sines) - sines for i, f in enumerate(gravity) if (sines := _sines(f))},
    )
    rows = [f + force for f, force in zip(m.rows, m.driven, strict=True)]
    made = {}
    for i, row in enumerate(rows):
        kept = Formula({key: c for key, c in row.terms.items() if s.accelerations(key[0]) or not s.motion(key[0])})
        made[i] = linear(s, kept) - row
    yield AnyMistake(
        "small-angle-early",
        "equation",
        "The equations are those of small angles: cos is 1, sin θ is θ, and "
        "products of rates are left out; exact ones are asked for.",
        "小さい角の近似式です。厳密な式が求められています。",
        rows=made,
    )


def _sines(f: Formula) -> Formula:
    return Formula({key: c for key, c in f.terms.items() if key[2] == SIN})


def linear(s: Space, f: Formula) -> Formula:
    """cos as 1 and sin as its argument."""
    total = NOTHING
    for (e, h, phase), c in f.terms.items():
        flat = Formula({(e, 0, COS): c})
        if phase == SIN:
            argument = add(s.q(k).times(half).times(HALF) for k, half in enumerate(digits(h, s.n)) if half)
            flat = flat * argument
        total = total + flat
    return total


def slip_mistakes(
    s: Space, rows: Mapping[int, Formula], lengths: Sequence[Formula], words: Words
) -> Iterator[AnyMistake]:
    """One term of one row: its sign, its factor, left out, sin for cos; named however the rows are combined.

    ``lengths``: those that a weight's moment may have lost.
    """
    for i, row in rows.items():
        yield from _lost_lengths(s, i, row, lengths, words)
        groups: dict[tuple[int, int, int], dict[Key, fmpq]] = {}
        for (e, h, phase), c in row.terms.items():
            groups.setdefault((s.motion(e) + s.outside(e) + switches(s, e), h, phase), {})[e, h, phase] = c
        for (q, h, phase), terms in groups.items():
            f = Formula(terms)
            term = shown(words, text(s, Formula({(q, h, phase): ONE}))).lstrip("-−") if q or h else "the constant"
            where, wo = f"In row {i + 1}, the term with {term}", f"第{i + 1}式の {term} の項"
            swapped = Formula({(e, h_, 1 - ph): c for (e, h_, ph), c in f.terms.items()}) if h else NOTHING
            for code, english, japanese, change in (
                ("sign", "has the wrong sign", "の符号が逆です", f.times(-2)),
                ("term-missing", "is left out", "が抜けています", -f),
                ("factor-two", "has an extra factor 2", "に余分な 2 が掛かっています", f),
                ("factor-half", "lacks its factor 2", "に 2 が足りません", f.times(-HALF)),
                (
                    "sine-and-cosine-swapped",
                    "has sin and cos swapped",
                    "の sin と cos が逆です",
                    swapped - f if h else NOTHING,
                ),
                (
                    "sine-and-cosine-swapped",
                    "has sin and cos swapped",
                    "の sin と cos が逆です",
                    -swapped - f if h else NOTHING,
                ),
            ):
                if change:
                    yield AnyMistake(code, "equation", f"{where} {english}.", f"{wo}{japanese}。", rows={i: change})
            if len(f) > 1:
                for key, c in f.terms.items():
                    part = Formula({key: c})
                    inner = shown(words, text(s, Formula({(key[0] - s.motion(key[0]), 0, COS): abs(c)})))
                    yield AnyMistake(
                        "part-missing",
                        "equation",
                        f"{where} lacks the part {inner}.",
                        f"{wo}に {inner} が抜けています。",
                        rows={i: -part},
                    )
                    yield AnyMistake(
                        "part-sign",
                        "equation",
                        f"{where}: the part {inner} has the wrong sign.",
                        f"{wo}：{inner} の符号が逆です。",
                        rows={i: part.times(-2)},
                    )
                    yield AnyMistake(
                        "part-factor",
                        "equation",
                        f"{where}: the part {inner} has an extra factor 2.",
                        f"{wo}：{inner} に余分な 2 が掛かっています。",
                        rows={i: part},
                    )
                    yield AnyMistake(
                        "part-factor",
                        "equation",
                        f"{where}: the part {inner} lacks its factor 2.",
                        f"{wo}：{inner} に 2 が足りません。",
                        rows={i: part.times(-HALF)},
                    )


def _lost_lengths(s: Space, i: int, row: Formula, lengths: Sequence[Formula], words: Words) -> Iterator[AnyMistake]:
    """All that neither moves nor is a spring's, or one wave of it, divided by a length."""
    waves: dict[tuple[int, int], dict[Key, fmpq]] = {}
    for key, c in row.terms.items():
        if key[1] and not s.motion(key[0]):
            waves.setdefault(key[1:], {})[key] = c
    parts = [Formula(terms) for terms in waves.values()]
    for f in (*([add(parts)] if len(parts) > 1 else ()), *parts):
        for length in lengths:
            lost = shown(words, text(s, length))
            yield AnyMistake(
                "factor-missing",
                "equation",
                f"In row {i + 1}, gravity lacks the factor {lost}.",
                f"第{i + 1}式の重力に {lost} が足りません。",
                rows={i: f * length.inverse_monomial() - f},
            )
