"""How a derivation counts its angles: from where, from which link, in which sense; and the truth in that way."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

from .mechanism import QUARTERS, Direction, Origin

FROM_EN: dict[Origin, str] = {
    "down": "the downward vertical", "up": "the upward vertical", "right": "the horizontal", "left": "the horizontal"
}  # fmt: skip
FROM_JA: dict[Origin, str] = {"down": "鉛直下向き", "up": "鉛直上向き", "right": "水平", "left": "水平"}
ZEROS: tuple[Origin, ...] = ("down", "up", "right")
SIDEWAYS: tuple[Origin, ...] = ("right", "left")
MOST_SENSES = 3  # angles whose senses are tried one by one


@dataclass(frozen=True)
class Convention:
    """``relative``: all angles but the first are measured from the link above. ``senses``: -1 for clockwise."""

    relative: bool = False
    origin: Origin = "down"
    senses: tuple[int, ...] = ()

    def direction(self, path: tuple[int, ...], n: int) -> Direction:
        """The direction of the last link of a path from the support."""
        turns = [0] * n
        for k in path if self.relative else path[-1:]:
            turns[k] = self.sense(k)
        return Direction(tuple(turns), QUARTERS[self.origin])

    def sense(self, k: int) -> int:
        """The sense of angle k."""
        return self.senses[k] if k < len(self.senses) else 1

    @property
    def words(self) -> str:
        """ "angles are measured from …", in English."""
        first = "the first angle is" if self.relative else "angles are"
        return f"{first} measured from {FROM_EN[self.origin]}{self._sense_en()}{self._rest_en()}"

    @property
    def words_ja(self) -> str:
        """The same in Japanese."""
        first = "最初の角を" if self.relative else "角を"
        rest = "、ほかの角を一つ前のリンクから" if self.relative else ""
        senses = (
            "、向きは " + " ".join("反時計回り" if s > 0 else "時計回り" for s in self.senses) if self.senses else ""
        )
        return f"{first}{FROM_JA[self.origin]}から{rest}測る{senses}"

    def _sense_en(self) -> str:
        if self.origin in ("right", "left") and set(self.senses) == {-1}:
            return ", downwards positive"
        if self.origin in ("right", "left") and not self.senses:
            return ", upwards positive"
        return ", clockwise" if set(self.senses) == {-1} else ""

    def _rest_en(self) -> str:
        rest = ", the others from the link above" if self.relative else ""
        if len(set(self.senses)) > 1:
            senses = ", ".join("counter-clockwise" if s > 0 else "clockwise" for s in self.senses)
            rest += f", in the senses {senses}"
        return rest


def conventions(
    first: Convention, n: int, *, free_frame: bool, free_origin: bool, has_sides: bool = False
) -> Iterator[Convention]:
    """``first``, then those that people use where they may be meant: the likeliest first.

    ``free_frame``: absolute or relative is not declared; ``free_origin``: nor is the zero. ``has_sides``: clockwise
    from the vertical is another thing than counter-clockwise, as where something slides to one side.
    """
    yield first
    frames = (first.relative, not first.relative) if free_frame and n > 1 else (first.relative,)
    zeros: tuple[Origin, ...] = ZEROS if free_origin else (first.origin,)
    both: tuple[Origin, ...] = zeros if has_sides else tuple(origin for origin in SIDEWAYS if origin in zeros)
    origins: list[tuple[Origin, int]] = [*((origin, 1) for origin in zeros), *((origin, -1) for origin in both)]
    seen = {first}
    mixed = list(product((1, -1), repeat=n - 1)) if n <= MOST_SENSES else [(1,) * (n - 1)]
    for rest in mixed:
        for relative in frames:
            for origin, sense in origins:
                senses = (sense, *(sense * r for r in rest))
                if -1 in rest and (not relative or origin == "right"):
                    continue  # nobody turns absolute angles two ways
                convention = Convention(relative, origin, () if set(senses) == {1} else senses)
                if convention not in seen:
                    seen.add(convention)
                    yield convention
