"""The plan of a sweep: every cell has a number, and what is in it is a function of that number alone.

Scenes are never listed: the scene of a number is made where it is needed. Of a source (a scene, or a kind and size of
random mechanism) come all points of its grid, and of each point all seeds, one after the other.
"""

from __future__ import annotations

import hashlib
import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate

from ...models import AnyScene, Scene, TreeScene, TreeSystem
from .generators import GeneratorKind, random_system
from .parameters import varied


@dataclass(frozen=True)
class Axis:
    """A parameter and its values."""

    name: str
    values: tuple[float, ...]


@dataclass(frozen=True)
class RandomMechanism:
    """A kind of random mechanism, and how many links it has."""

    kind: GeneratorKind
    links: int


@dataclass(frozen=True)
class Source:
    """What is varied: a scene, or random mechanisms of one kind and size; ``axes`` span the grid."""

    label: str
    base: AnyScene | RandomMechanism
    axes: tuple[Axis, ...] = ()

    @cached_property
    def points(self) -> int:
        """Number of points of the grid."""
        return math.prod(len(axis.values) for axis in self.axes)

    def values(self, point: int) -> dict[str, float]:
        """The parameters at a point; the last axis changes fastest."""
        found = []
        for axis in reversed(self.axes):
            point, index = divmod(point, len(axis.values))
            found.append((axis.name, axis.values[index]))
        return dict(reversed(found))


@dataclass(frozen=True)
class Place:
    """Where in the plan a scene stands: its number, its source, its parameters, its seed."""

    number: int
    source: Source
    values: dict[str, float]
    seed: int

    @property
    def name(self) -> str:
        """A name that no other scene of the sweep has; its random states are drawn from it."""
        chosen = [f"{name}={value:.12g}" for name, value in self.values.items()]
        return ", ".join([self.source.label, *chosen, f"seed {self.seed}"])


@dataclass(frozen=True)
class Sweep:
    """A declared sweep. ``states``: random states in each scene, ``named``: those besides.

    ``chunk``: scenes in a chunk; ``seconds``: for one call of an engine; ``memory``: bytes that its process may
    allocate, None for any number.
    """

    sources: tuple[Source, ...]
    seeds: Sequence[int]
    engines: tuple[str, ...]
    checks: tuple[str, ...]
    states: int
    named: tuple[str, ...] | None
    chunk: int
    seconds: float
    memory: int | None

    @cached_property
    def _ends(self) -> list[int]:
        return list(accumulate(source.points * len(self.seeds) for source in self.sources))

    @property
    def scenes(self) -> int:
        """Number of scenes."""
        return self._ends[-1]

    @property
    def cells(self) -> int:
        """Number of cells: each scene on each engine."""
        return self.scenes * len(self.engines)

    @property
    def chunks(self) -> int:
        """Number of chunks."""
        return -(-self.scenes // self.chunk)

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """Names of all parameters, in the order in which they are declared."""
        return tuple(dict.fromkeys(axis.name for source in self.sources for axis in source.axes))

    def numbers(self, chunk: int) -> range:
        """Numbers of the scenes of a chunk."""
        return range(chunk * self.chunk, min((chunk + 1) * self.chunk, self.scenes))

    def cell(self, number: int, engine: str) -> int:
        """Number of the cell of a scene and an engine."""
        return number * len(self.engines) + self.engines.index(engine)

    def place(self, number: int) -> Place:
        """Where a scene stands."""
        at = bisect_right(self._ends, number)
        source = self.sources[at]
        point, seed = divmod(number - (self._ends[at - 1] if at else 0), len(self.seeds))
        return Place(number, source, source.values(point), self.seeds[seed])

    def scene(self, place: Place) -> AnyScene:
        """The scene that stands there. Raises :class:`furiko.InvalidInput` where the parameters make no mechanism."""
        base = place.source.base
        if isinstance(base, RandomMechanism):
            system = random_system(base.kind, base.links, place.seed)
            scene: AnyScene = (
                TreeScene("", system, named=()) if isinstance(system, TreeSystem) else Scene("", system, named=())
            )
        else:
            scene = base
        found = replace(varied(scene, place.values), name=place.name, random=self.states)
        return found if self.named is None else replace(found, named=self.named)

    def digest(self, code: str) -> str:
        """SHA-256 of all that decides what is in a cell and which cells are in a file; ``code``: furiko's own."""
        parts = (code, self.sources, self.seeds, self.engines, self.checks, self.states, self.named, self.chunk)
        limits = (self.seconds, self.memory)
        return hashlib.sha256(repr((parts, limits)).encode()).hexdigest()
