"""A cart with a pole or two, and a pendulum whose support is moved as it is said to be."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .letters import Letters
from .poles import poles
from .roles import CENTRE, FORCE, INERTIA, LENGTH, LOSS, MASS, SPRING, Bodies, indexed, named, pairs

CARTS = (("M", "m"), ("mc", "mp"), ("Mc", "mp"), ("Mc", "Mp"), ("M", "mp"), ("m1", "m2"), ("m0", "m1"))
FEW = 3
Masses = Sequence[tuple[str, str]]


def carts(letters: Letters, slide: str, angles: Sequence[str]) -> Iterator[Bodies]:
    """A cart with a pole; with two, one after the other, or both on the cart."""
    if len(angles) == 2:
        yield from _two_poles(letters, slide, angles)
        return
    masses = [*pairs(letters, MASS, CARTS), *(("0", x) for x in named(letters, MASS)[:1])] or [("1", "1")]
    for cart, mass in masses:
        for length in (*named(letters, LENGTH, but=[slide, *angles, mass, cart])[:2], "1"):
            for pole in _poles(letters, length, mass):
                for one, other in _more(letters, (slide, *angles, mass, cart, *pole.values())):
                    yield [
                        {"name": "cart", "coordinate": slide, "joint": "slide", "mass": cart, **one},
                        {"name": "pole", "coordinate": angles[0], "mass": mass, **pole, **other},
                    ]


def _poles(letters: Letters, length: str, mass: str) -> Iterator[dict[str, str]]:
    for inertia in named(letters, INERTIA)[:2]:
        yield from poles(length, mass, None, inertia)
    yield from poles(length, mass, None, None)


def _more(letters: Letters, taken: tuple[str, ...]) -> Iterator[tuple[dict[str, str], dict[str, str]]]:
    """What a cart has, and what its pole: a force, losses of one and of both, a spring."""
    for drive in (None, *named(letters, FORCE, but=taken)[:2]):
        gone = (*taken, drive or "")
        losses = named(letters, LOSS, but=gone)[:FEW]
        both = [(None, None), *((x, None) for x in losses), *((None, x) for x in losses)]
        both += [(x, y) for x in losses for y in losses if x != y]
        for spring in (None, *named(letters, SPRING, but=gone)[:1]):
            for loss, of_pole in both:
                if spring is not None and spring in (loss, of_pole):
                    continue
                cart = {"drive": drive, "damping": loss, "spring": spring}
                yield _said(cart), _said({"damping": of_pole})
                if drive is not None and spring is not None:
                    yield _said({"damping": loss, "spring": spring}), _said({"damping": of_pole, "drive": drive})


def _said(parts: dict[str, str | None]) -> dict[str, str]:
    return {name: value for name, value in parts.items() if value is not None}


def _two_poles(letters: Letters, slide: str, angles: Sequence[str]) -> Iterator[Bodies]:
    ends = ("1", "2")
    masses = indexed(letters, MASS, ends) or [("1", "1")]
    for one, two in masses:
        cart = next((x for x in named(letters, MASS, but=[one, two, slide, *angles])), None)
        lengths = indexed(letters, LENGTH, ends)
        for first, second in lengths[:FEW]:
            for pole, other in _twin_poles(letters, (one, two), (first, second)):
                for drive in (None, *named(letters, FORCE, but=[slide, *angles])[:2]):
                    of_cart = _said({"mass": cart or one, "drive": drive})
                    base = {"name": "cart", "coordinate": slide, "joint": "slide", **of_cart}
                    upper = {"name": "pole 1", "coordinate": angles[0], "mass": one, **pole}
                    lower = {"name": "pole 2", "coordinate": angles[1], "mass": two, **other}
                    yield [base, upper, lower]
                    yield [base, upper, {**lower, "on": "cart"}]


def _twin_poles(
    letters: Letters, masses: tuple[str, str], lengths: tuple[str, str]
) -> Iterator[tuple[dict[str, str], dict[str, str]]]:
    for inertias in (*indexed(letters, INERTIA, ("1", "2"))[:1], None):
        for centres in (*(x for x in indexed(letters, CENTRE, ("1", "2"))[:FEW] if x != lengths), None):
            ways = [
                list(poles(length, mass, centre, inertia))
                for length, mass, centre, inertia in zip(
                    lengths, masses, centres or (None, None), inertias or (None, None), strict=True
                )
            ]
            yield from zip(*ways, strict=True)


def supports(letters: Letters, slides: Sequence[str], angle: str) -> Iterator[Bodies]:
    """A pendulum whose support moves to the right, upwards, or in both directions."""
    ways = [("right",), ("up",)] if len(slides) == 1 else [("right", "up")]
    for mass in (*named(letters, MASS, but=[*slides, angle])[:2], "1"):
        for length in (*named(letters, LENGTH, but=[*slides, angle, mass])[:2], "1"):
            for pole in _poles(letters, length, mass):
                losses = named(letters, LOSS, but=[*slides, angle, mass, *pole.values()])[:2]
                for loss in (None, *losses, *(f"{x}*{mass}*{length}^2" for x in losses)):
                    for way in ways:
                        moved = [
                            {
                                "name": f"support {k}",
                                "coordinate": x,
                                "joint": "slide",
                                "along": along,
                                "mass": "0",
                                "motion": "given",
                            }
                            for k, (x, along) in enumerate(zip(slides, way, strict=True), 1)
                        ]
                        yield [
                            *moved,
                            {"name": "pendulum", "coordinate": angle, "mass": mass, **pole, **_said({"damping": loss})},
                        ]
