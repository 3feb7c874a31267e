"""Named lines as series of a plot: colours and marks by number."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from .plot import KINDS, Series

Points = Sequence[tuple[float, float]]


def to_series(lines: Mapping[str, Points], *, marked: bool = False, order: Sequence[str] = ()) -> list[Series]:
    """A series for each line; its colour, and its mark if ``marked``, by its place in ``order``, else in ``lines``."""
    places = {name: i % KINDS for i, name in enumerate(order or lines)}
    return [
        Series(
            name,
            [(x, y, f"{name}: {x:.4g}, {y:.3g}" if marked else "") for x, y in points],
            places[name],
            places[name] if marked else None,
        )
        for name, points in lines.items()
    ]
