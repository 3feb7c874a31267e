"""The ways in which people write a hanging body: a point mass, a rod of one density, a body with a centre of mass."""

from __future__ import annotations

from collections.abc import Iterator

Pole = dict[str, str]


def poles(length: str, mass: str, centre: str | None, inertia: str | None) -> Iterator[Pole]:
    """The plainest first. ``centre``, ``inertia``: names, where the text has some; ``length``: "" where it has none."""
    if not length and centre:
        length = centre
    if inertia is not None:
        for about in ("centre", "pivot"):
            for at in (centre,) if centre else (length, f"{length}/2"):
                yield {
                    "length": length,
                    **({"centre": at} if at != length or at == centre else {}),
                    "inertia": inertia,
                    "about": about,
                }
        return
    if centre is not None:
        yield {"length": length, "centre": centre}
        return
    yield {"length": length}
    yield {"length": length, "centre": f"{length}/2", "inertia": f"{mass}*{length}^2/12"}
    yield {"length": f"2*{length}", "centre": length, "inertia": f"{mass}*{length}^2/3"}
