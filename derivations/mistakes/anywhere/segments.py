"""Mistakes in positions and velocities of any planar mechanism: one segment of the way to a body is changed.

Each is made for one body, for its velocity and its turning alike, and for every body that the segment carries.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...algebra.trig import CONSTANT_ONE, NOTHING
from ...steps.derivation import Stage, add
from ...steps.mechanism import Direction, Segment
from .parts import AnyMistake, Change, Made, Parts, angle_name, rate_name


def segment_mistakes(p: Parts) -> Iterator[AnyMistake]:
    """All of them, positions first."""
    for code, stage, change, english, japanese in _segment_changes(p):
        yield from _everywhere(p, code, stage, change, english, japanese)


def _everywhere(p: Parts, code: str, stage: Stage, change: Change, english: str, japanese: str) -> Iterator[AnyMistake]:
    """A change of one segment: for one body, and for all that it carries."""
    seen: list[Segment] = []
    for b, way in enumerate(p.ways):
        for at, x in enumerate(way):
            made = change(x)
            if made is None:
                continue
            name, where = p.words.bodies[b], angle_name(p, x.direction)
            en = english.format(angle=where, rate=rate_name(p, x.direction.turns))
            ja = japanese.format(angle=where, rate=rate_name(p, x.direction.turns))
            places = p.carried(x)
            if len(places) > 1 and x not in seen:
                seen.append(x)
                total = add(p.changed(c, k, made) for c, k in places)
                hidden = all(_is_half_hidden(p, c, k, made) for c, k in places)
                yield AnyMistake(
                    code,
                    stage,
                    f"In the {_what(stage)} of every body: {en}.",
                    f"すべての{_was(stage)}：{ja}。",
                    total,
                    half_hidden=hidden,
                )
            own = p.changed(b, at, made)
            last = made.rate is not None and at == len(way) - 1
            spin = p.turned(b, made.rate) if last and made.rate is not None else NOTHING
            both, also_ja = f"In the {_what(stage)} and the turning of {name}", f"{name} の{_was(stage)}と回転"
            if spin:
                yield AnyMistake(code, stage, f"{both}: {en}.", f"{also_ja}：{ja}。", own + spin)
            yield AnyMistake(
                code,
                stage,
                f"In the {_what(stage)} of {name}: {en}.",
                f"{name} の{_was(stage)}：{ja}。",
                own,
                half_hidden=_is_half_hidden(p, b, at, made),
            )


def _is_half_hidden(p: Parts, b: int, at: int, made: Made) -> bool:
    """Whether a wrong position shows in only one of the two energies."""
    if made.vector is None or made.height is None:
        return False
    return not p.changed(b, at, Made(made.vector)) or not p.changed(b, at, Made(None, made.height))


def _segment_changes(p: Parts) -> Iterator[tuple[str, Stage, Change, str, str]]:
    space, n = p.space, p.space.n

    def moved(x: Segment, direction: Direction) -> Made:
        other = Segment(x.length, direction)
        return Made(p.velocity(other), direction.vector(space, x.length)[1], p.rate(direction.turns))

    def own_angle(x: Segment) -> Made | None:
        turns = x.direction.turns
        last = max((k for k, c in enumerate(turns) if c), default=-1)
        alone = tuple(c if k == last else 0 for k, c in enumerate(turns))
        return None if alone == turns else moved(x, Direction(alone, x.direction.quarters))

    def angle_sum(x: Segment) -> Made | None:
        turns = x.direction.turns
        last = max((k for k, c in enumerate(turns) if c), default=0)
        if not last or any(turns[:last]):
            return None
        return moved(x, Direction((*(turns[last],) * (last + 1), *turns[last + 1 :]), x.direction.quarters))

    def swapped(x: Segment) -> Made:
        along, up = x.direction.vector(space, x.length)
        return Made((space.by_time(-up), space.by_time(-along)), -along)

    yield (
        "angle-not-added",
        "position",
        own_angle,
        "the angle of the link above is not added to the last one ({angle})",
        "上のリンクの角が足されていません（{angle}）",
    )
    yield (
        "relative-angle",
        "position",
        angle_sum,
        "angles are added, though {angle} is absolute",
        "{angle} は絶対角ですが、角が足されています",
    )
    yield (
        "sine-cosine-swapped",
        "position",
        swapped,
        "sin and cos of {angle} are swapped",
        "{angle} の sin と cos が逆です",
    )
    yield (
        "segment-missing",
        "position",
        lambda x: Made((NOTHING, NOTHING), NOTHING),
        "the part that turns with {angle} is left out",
        "{angle} で動く部分が抜けています",
    )
    for k in range(n):

        def other(x: Segment, k: int = k) -> Made | None:
            turns = x.direction.turns
            if not any(turns) or p.rate(turns) == space.w(k):
                return None
            grown = x.direction.vector(space, space.by_time(x.length))
            turned = p.turning(x, space.w(k))
            return Made((grown[0] + turned[0], grown[1] + turned[1]), rate=space.w(k))

        def forgotten(x: Segment, k: int = k, other: Change = other) -> Made | None:
            turns = x.direction.turns
            return other(x) if turns[k] and sum(map(abs, turns)) > 1 else None

        def wrong(x: Segment, k: int = k, other: Change = other) -> Made | None:
            return other(x) if not x.direction.turns[k] else None

        rate = p.words.rates[k]
        yield (
            "rate-sum-forgotten",
            "velocity",
            forgotten,
            f"found the rate {rate} alone, expected {{rate}}",
            f"角速度が {rate} だけです。{{rate}} です",
        )
        yield (
            "wrong-rate-in-velocity",
            "velocity",
            wrong,
            f"found the rate {rate}, expected {{rate}}",
            f"角速度が {rate} です。{{rate}} です",
        )

    def no_rate(x: Segment) -> Made | None:
        return Made(p.turning(x, CONSTANT_ONE)) if _plain(x) else None

    def lengths_rate(x: Segment) -> Made | None:
        slow = space.by_time(x.length)
        return Made(p.turning(x, p.rate(x.direction.turns))) if slow and any(x.direction.turns) else None

    def no_turning(x: Segment) -> Made | None:
        slow = space.by_time(x.length)
        return Made(x.direction.vector(space, slow)) if slow and any(x.direction.turns) else None

    def sign(x: Segment) -> Made | None:
        along, up = p.velocity(x)
        return Made((along, -up)) if _plain(x) else None

    yield (
        "inner-derivative-missing",
        "velocity",
        no_rate,
        "the inner derivative {rate} is missing",
        "{rate} が掛かっていません",
    )
    yield (
        "length-rate-missing",
        "velocity",
        lengths_rate,
        "the change of the length along {angle} is left out",
        "{angle} 方向の長さの変化が抜けています",
    )
    yield (
        "turning-missing",
        "velocity",
        no_turning,
        "the part from the turning {rate} is left out",
        "回転 {rate} による部分が抜けています",
    )
    yield (
        "cosine-derivative-sign",
        "velocity",
        sign,
        "the derivative of cos {angle} has the wrong sign",
        "cos {angle} の微分の符号が逆です",
    )


def _plain(x: Segment) -> bool:
    """Whether it turns, and has a length that is one symbol times a number."""
    return any(x.direction.turns) and x.length.is_monomial()


def _what(stage: Stage) -> str:
    return "position" if stage == "position" else "velocity"


def _was(stage: Stage) -> str:
    return "位置" if stage == "position" else "速度"
