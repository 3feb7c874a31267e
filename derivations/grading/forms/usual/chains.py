"""Chains of two or more: double pendulums, arms with torques, and a pendulum with a wheel."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .letters import Letters
from .poles import poles
from .roles import CENTRE, INERTIA, LENGTH, LOSS, MASS, SPRING, TORQUE, Bodies, all_but_last, indexed, named, pairs

FEW = 3


def chains(letters: Letters, angles: Sequence[str]) -> Iterator[Bodies]:
    """Each hung on the one before, with these angles."""
    n = len(angles)
    ends = [str(k) for k in range(1, n + 1)]
    masses = indexed(letters, MASS, ends)
    masses += pairs(letters, MASS, (("m", "M"),))[:2] if n == 2 else []
    for mass in masses[:FEW] or [("1",) * n]:
        lengths = [x for x in indexed(letters, LENGTH, ends) if not set(x) & {*mass, *angles}]
        lengths += (
            [x for x in pairs(letters, LENGTH, (("l", "L"), ("a", "b"))) if not set(x) & {*mass, *angles}][:2]
            if n == 2
            else []
        )
        for length in [*lengths[:4], *all_but_last(letters, LENGTH, n)[:2]] or [("1",) * n]:
            for links in _links(letters, mass, length):
                for more in _more(letters, n, (*angles, *mass, *length, *(v for x in links for v in x.values()))):
                    yield [
                        {"name": f"link {k + 1}", "coordinate": angles[k], "mass": mass[k], **links[k], **more[k]}
                        for k in range(n)
                    ]
    if n == 2:
        yield from _wheels(letters, angles)


def _links(letters: Letters, masses: Sequence[str], lengths: Sequence[str]) -> Iterator[Sequence[dict[str, str]]]:
    n = len(masses)
    ends = [str(k) for k in range(1, n + 1)]
    for inertias in (*indexed(letters, INERTIA, ends)[:2], None):
        centres = [x for x in indexed(letters, CENTRE, ends) if not set(x) & {*lengths, *masses}]
        for centre in (*centres[:FEW], *(() if "" in lengths else (None,))):
            ways = [
                list(poles(lengths[k], masses[k], centre[k] if centre else None, inertias[k] if inertias else None))
                for k in range(n)
            ]
            yield from zip(*ways, strict=True)


def _more(letters: Letters, n: int, taken: Sequence[str]) -> Iterator[list[dict[str, str]]]:
    """Drives at all joints, or one at one; losses and springs at all."""
    ends = [str(k) for k in range(1, n + 1)]
    gone = set(taken)
    drives: list[Sequence[str | None]] = [(None,) * n]
    drives += [x for x in indexed(letters, TORQUE, ends) if len(set(x)) == n and not set(x) & gone][:2]
    for one in named(letters, TORQUE, but=taken)[:2]:
        if not letters.is_code:
            drives.append(tuple(f"{one}_{k}" for k in ends))  # of a column
        drives += [tuple(one if j == k else None for j in range(n)) for k in reversed(range(n))]
    losses = [(None,) * n, *(x for x in indexed(letters, LOSS, ends) if not set(x) & gone)][: 1 + FEW]
    springs = [(None,) * n, *(x for x in indexed(letters, SPRING, ends) if not set(x) & gone)][:2]
    for drive in drives:
        for loss in losses:
            for spring in springs:
                names = [{y for y in x if y is not None} for x in (drive, loss, spring)]
                if names[0] & names[1] or names[1] & names[2] or names[0] & names[2]:
                    continue
                yield [
                    {
                        name: value
                        for name, value in (("drive", drive[k]), ("damping", loss[k]), ("spring", spring[k]))
                        if value
                    }
                    for k in range(n)
                ]


def _wheels(letters: Letters, angles: Sequence[str]) -> Iterator[Bodies]:
    """A pendulum with a wheel at its end: the wheel's mass is the pendulum's, or its own."""
    inertias = pairs(letters, INERTIA, (("I1", "I2"), ("Ip", "Iw"), ("Jp", "Jw"), ("J1", "J2")))
    one_of_wheel = [(None, x) for x in named(letters, INERTIA)[:2]]
    masses = [*pairs(letters, MASS, (("m1", "m2"), ("mp", "mw"))), *((x, "0") for x in named(letters, MASS)[:2])]
    for own, of_wheel in [*inertias, *one_of_wheel]:
        for mass, wheel in masses[:4]:
            for length in named(letters, LENGTH, but=[*angles, mass, wheel])[:2]:
                for centre in (*named(letters, CENTRE, but=[*angles, mass, wheel, length])[:2], length):
                    for drive in (None, *named(letters, TORQUE, but=[*angles, mass, wheel, length, centre])[:2]):
                        for about in ("centre", "pivot") if own else ("centre",):
                            rod = {
                                "name": "pendulum",
                                "coordinate": angles[0],
                                "mass": mass,
                                "length": length,
                                "centre": centre,
                            }
                            rod |= {"inertia": own, "about": about} if own else {}
                            disk = {
                                "name": "wheel",
                                "coordinate": angles[1],
                                "mass": wheel,
                                "length": "0",
                                "centre": "0",
                                "inertia": of_wheel,
                            }
                            yield [rod, {**disk, **({"drive": drive} if drive else {})}]
