"""Mistakes in the squared speeds and the energies of any planar mechanism, and in its Lagrangian."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from ...algebra.trig import HALF, Formula
from ...steps.derivation import add
from ...steps.mechanism import Body, Segment
from .parts import AnyMistake, Parts, angle_name, rate_name


def energy_mistakes_anywhere(p: Parts) -> Iterator[AnyMistake]:
    """Body by body: speeds, energies; then the same for all, and the Lagrangian."""
    for b, body in enumerate(p.m.bodies):
        yield from _speeds(p, b)
        yield from _energies(p, b, body)
    yield from _together(p)


def _speeds(p: Parts, b: int) -> Iterator[AnyMistake]:
    """The square of a speed that is made of several velocities."""
    way, name, mass = p.ways[b], p.words.bodies[b], p.m.bodies[b].mass
    for i, j in combinations(range(len(way)), 2):
        cross = p.cross(b, i, j)
        if not cross:
            continue
        pair = f"{angle_name(p, way[i].direction)}, {angle_name(p, way[j].direction)}"
        where = f"In the speed of {name}, the product of the velocities along {pair}"
        wo = f"{name} の速度の2乗で、{pair} の積"
        yield AnyMistake("cross-term-missing", "speed", f"{where} is left out.", f"{wo}が抜けています。", -cross)
        yield AnyMistake(
            "cross-term-halved",
            "speed",
            f"{where} lacks its factor 2.",
            f"{wo}に 2 が掛かっていません。",
            cross.times(-HALF),
        )
        yield AnyMistake(
            "cross-term-sign", "speed", f"{where} has the wrong sign.", f"{wo}の符号が逆です。", cross.times(-2)
        )
        speeds = [_speed(p, x) for x in (way[i], way[j])]
        if None not in speeds:
            one, two = (f for f in speeds if f is not None)
            yield AnyMistake(
                "speeds-added",
                "speed",
                f"{where}: speeds are added as numbers; velocities are vectors.",
                f"{wo}：速さを数として足しています。速度はベクトルです。",
                mass * one * two - cross,
            )


def _speed(p: Parts, x: Segment) -> Formula | None:
    """The speed of a segment by itself, where it is one product: a turning rod's, or a slide's."""
    slow = p.space.by_time(x.length)
    if not slow:
        return x.length * p.rate(x.direction.turns)
    return slow if not any(x.direction.turns) else None


def _energies(p: Parts, b: int, body: Body) -> Iterator[AnyMistake]:
    name = p.words.bodies[b]
    t, omega = p.kinetic(b, p.velocities[b]), p.rate(body.turns)
    spin = body.inertia.times(HALF) * omega * omega
    u = p.weight(b) * add(p.heights[b])

    def made(code: str, english: str, japanese: str, energy: Formula) -> Iterator[AnyMistake]:
        if energy:
            said = english.replace("{name}", name)  # no format: an angle's name may have braces of its own
            yield AnyMistake(code, "energy", f"The {said}.", f"{name} の{japanese}。", energy)

    yield from made(
        "half-missing", "kinetic energy of {name} is missing its factor ½", "運動エネルギーの ½ が抜けています", t
    )
    yield from made(
        "kinetic-energy-missing",
        "kinetic energy of the motion of {name} is left out",
        "並進の運動エネルギーが抜けています",
        -t,
    )
    yield from made(
        "inertia-missing", "rotational energy of {name} is left out", "回転のエネルギーが抜けています", -spin
    )
    yield from made(
        "inertia-half-missing",
        "rotational energy of {name} is missing its factor ½",
        "回転のエネルギーの ½ が抜けています",
        spin,
    )
    last = max((k for k, c in enumerate(body.turns) if c), default=-1)
    above = max((k for k, c in enumerate(body.turns[:last]) if c), default=last - 1)
    if body.inertia and last > 0:
        summed = sum(map(abs, body.turns)) > 1
        own = p.rate([c if k == last else 0 for k, c in enumerate(body.turns)])
        rate = own if summed else own - p.space.w(above)
        expected = rate_name(p, body.turns)
        other = p.words.rates[last] if summed else f"{p.words.rates[last]} − {p.words.rates[above]}"
        yield from made(
            "inertia-relative-rate",
            f"rotational energy of {{name}} has the rate {other}, expected {expected}",
            f"回転のエネルギーの角速度が {other} です。{expected} です",
            body.inertia.times(HALF) * (rate * rate - omega * omega),
        )
    if body.inertia and body.way:
        arm = body.way[-1].length
        yield from made(
            "inertia-about-end",
            "inertia of {name} is that about its joint; with the speed of the centre of "
            "mass it is that about the centre",
            "慣性モーメントが関節まわりです。重心の速度と組むのは重心まわりです",
            (body.mass * arm * arm).times(HALF) * omega * omega,
        )
    yield from made(
        "potential-energy-missing", "potential energy of {name} is left out", "位置エネルギーが抜けています", u
    )
    yield from made(
        "potential-energy-sign",
        "potential energy of {name} has the wrong sign",
        "位置エネルギーの符号が逆です",
        u.times(2),
    )
    for k, (x, height) in enumerate(zip(p.ways[b], p.heights[b], strict=True)):
        along = x.direction.vector(p.space, x.length)[0]
        angle = angle_name(p, x.direction)
        if any(x.direction.turns):
            for sign in (1, -1):
                yield from made(
                    "height-sine",
                    f"height of {{name}} has sin for cos of {angle}",
                    f"高さで {angle} の cos が sin です",
                    p.weight(b) * (height - along.times(sign)),
                )
        if len(p.ways[b]) > 1:
            yield from made(
                "height-incomplete",
                f"height of {{name}} leaves out the part along {angle}",
                f"高さに {angle} の部分が抜けています",
                p.weight(b) * height,
            )
        if k == len(p.ways[b]) - 1 and body.inertia:
            yield from made(
                "height-of-end",
                "height of {name} is that of its end, expected that of its centre of mass",
                "高さが重心でなく端のものです",
                -(p.weight(b) * height),
            )
    for c, other_body in enumerate(p.m.bodies):
        if c != b and body.mass and body.mass.is_monomial() and other_body.mass != body.mass:
            ratio = other_body.mass * body.mass.inverse_monomial()
            kinetic = f"kinetic energy of {{name}} has the mass of {p.words.bodies[c]}"
            yield from made("wrong-mass-in-kinetic-energy", kinetic, "運動エネルギーの質量が違います", t * ratio - t)
            yield from made(
                "wrong-mass-in-potential-energy",
                kinetic.replace("kinetic", "potential"),
                "位置エネルギーの質量が違います",
                u - u * ratio,
            )
    yield from made("mass-left-out", "Lagrangian leaves {name} out", "項がラグランジアンにありません", u - t - spin)


def _together(p: Parts) -> Iterator[AnyMistake]:
    """The same mistake for every body, springs, and T + U."""
    bodies = range(len(p.m.bodies))
    t = add(p.kinetic(b, p.velocities[b]) for b in bodies)
    u = add(p.weight(b) * add(p.heights[b]) for b in bodies)
    spring = p.m.elastic
    cross = add(p.cross(b, i, j) for b in bodies for i, j in combinations(range(len(p.ways[b])), 2))
    if len(p.m.bodies) > 1:
        yield AnyMistake(
            "half-missing-everywhere",
            "energy",
            "Every kinetic energy is missing its factor ½.",
            "すべての運動エネルギーの ½ が抜けています。",
            t + p.m.rotation,
        )
        yield AnyMistake(
            "potential-energy-sign",
            "energy",
            "The potential energy has the wrong sign.",
            "位置エネルギーの符号が逆です。",
            u.times(2),
        )
        yield AnyMistake(
            "gravity-missing", "energy", "Gravity is left out everywhere.", "重力がまったく入っていません。", u
        )
    if cross:
        yield AnyMistake(
            "binomial-without-middle",
            "speed",
            "The products of velocities are left out: (a + b)² is a² + 2ab + b².",
            "速度の積の項が抜けています。(a + b)² = a² + 2ab + b² です。",
            -cross,
        )
    if spring:
        yield AnyMistake(
            "spring-half-missing",
            "energy",
            "The springs' energy is missing its factor ½.",
            "ばねのエネルギーの ½ が抜けています。",
            -spring,
        )
        yield AnyMistake(
            "spring-sign",
            "energy",
            "The springs' energy has the wrong sign.",
            "ばねのエネルギーの符号が逆です。",
            spring.times(2),
        )
        yield AnyMistake(
            "spring-missing", "energy", "The springs' energy is left out.", "ばねのエネルギーが抜けています。", spring
        )
    yield AnyMistake(
        "sum-for-difference",
        "lagrangian",
        "The Lagrangian is T + U; it must be T - U.",
        "ラグランジアンが T + U です。T - U です。",
        (u + spring).times(2),
    )
