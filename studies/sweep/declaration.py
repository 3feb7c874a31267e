"""Reads the TOML file that declares a sweep::

    engines = ["mujoco", "pinocchio-aba"]    # whatever -e takes
    checks = ["accelerations"]               # this one if not given
    seeds = 5                                # 0, 1, 2, 3, 4; or a list
    states = 20                              # random states in each scene
    named = ["whirling"]                     # and those; as each scene has it if not given
    chunk = 50                               # scenes that are done, kept and taken up together

    [limits]
    seconds = 30.0                           # for one call of an engine
    memory = 4.0                             # of an engine's process [GiB]; 0: any

    [[scenes]]
    scenes = ["rods-3", "my-scene.toml"]     # names, or files beside this one
    [scenes.parameters]                      # of :mod:`.parameters`: a grid
    gravity = [1.62, 9.81]
    masses = { from = 0.1, to = 10.0, count = 3, spacing = "log" }

    [[random]]
    kind = "rod-chain"                       # n-leg, tree
    links = [2, 4, 8]                        # or a range

Every grid has its parameters' values in all combinations.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import msgspec

from ...checks.registry import CHECKS
from ...engines import all_of, engine_info
from ...models import AnyScene, InvalidInput, Scene, TreeScene, TreeSystem, find_scene
from ...models.errors import nearest
from ...models.readers.bounded_file import read_text, shown
from ...models.readers.toml_fields import fitted
from ...models.readers.toml_text import parse_toml
from ...models.systems import number
from .generators import GeneratorKind, random_system
from .parameters import varied
from .plan import Axis, RandomMechanism, Source, Sweep

LARGEST_FILE = 1_000_000  # bytes
MOST_VALUES = 100_000  # of a parameter; seeds
MOST_CELLS = 100_000_000
MOST_LINKS = {"rod-chain": 10_000, "n-leg": 10_000, "tree": 1_000}  # as in scene files
MOST_STATES = 100_000
LARGEST_CHUNK = 10_000  # scenes: a chunk's truths are held in memory
LARGEST_SEED = 2**62
FEWEST_LINKS = {"rod-chain": 1, "n-leg": 2, "tree": 1}


class _Range(msgspec.Struct, forbid_unknown_fields=True):
    first: Any = msgspec.field(name="from")
    last: Any = msgspec.field(name="to")
    count: int
    spacing: Literal["linear", "log"] = "linear"


class _Limits(msgspec.Struct, forbid_unknown_fields=True):
    seconds: float = 30.0
    memory: float = 4.0


class _Scenes(msgspec.Struct, forbid_unknown_fields=True):
    scenes: list[str]
    parameters: dict[str, Any] = {}


class _Random(msgspec.Struct, forbid_unknown_fields=True):
    kind: GeneratorKind
    links: Any
    parameters: dict[str, Any] = {}


class _File(msgspec.Struct, forbid_unknown_fields=True):
    engines: list[str]
    checks: list[str] = msgspec.field(default_factory=lambda: ["accelerations"])
    seeds: Any = 1
    states: int = 20
    named: list[str] | None = None
    chunk: int = 50
    limits: _Limits = msgspec.field(default_factory=_Limits)
    scenes: list[_Scenes] = []
    random: list[_Random] = []


def read_sweep(path: Path) -> tuple[Sweep, str]:
    """The sweep that a file declares, and the file's text. Raises :class:`InvalidInput`, the file's name in front."""
    text = read_text(path, LARGEST_FILE)
    try:
        return sweep_from_toml(text, path.parent), text
    except InvalidInput as error:
        raise InvalidInput(f"{shown(path)}: {error}") from None


def sweep_from_toml(text: str, folder: Path = Path()) -> Sweep:
    """The sweep that a TOML text declares; ``folder``: where its scene files are. Raises :class:`InvalidInput`."""
    file = fitted(parse_toml(text), _File)
    _require("states", file.states, 0, MOST_STATES)
    _require("chunk", file.chunk, 1, LARGEST_CHUNK)
    sources = [source for k, given in enumerate(file.scenes) for source in _of_scenes(given, f"scenes[{k}]", folder)]
    sources += [source for k, given in enumerate(file.random) for source in _of_random(given, f"random[{k}]")]
    if not sources:
        raise InvalidInput("scenes: missing; [[scenes]] or [[random]] says what is swept")
    labels = [source.label for source in sources]
    for label in labels:
        if labels.count(label) > 1:
            raise InvalidInput(f"{label}: there twice; put its parameters into one grid")
    found = Sweep(
        sources=tuple(sources),
        seeds=_seeds(file.seeds),
        engines=_engines(file.engines),
        checks=_checks(file.checks),
        states=file.states,
        named=None if file.named is None else tuple(file.named),
        chunk=file.chunk,
        seconds=_limit("seconds", file.limits.seconds, 0.01),
        memory=int(_limit("memory", file.limits.memory, 0.05) * 2**30) if file.limits.memory else None,
    )
    if found.cells > MOST_CELLS:
        raise InvalidInput(f"{found.cells:,} cells; {MOST_CELLS:,} are the most that a sweep may have")
    _require_states(found)
    return found


def _require(field: str, value: int, least: int, most: int) -> None:
    if not least <= value <= most:
        raise InvalidInput(f"{field}: from {least} to {most}, got {value}")


def _limit(field: str, value: float, least: float) -> float:
    if not (math.isfinite(value) and value >= least):
        raise InvalidInput(f"limits.{field}: a finite number from {least:g} is needed, got {value:g}")
    return value


def _engines(names: list[str]) -> tuple[str, ...]:
    if not names:
        raise InvalidInput("engines: at least one is needed, as for -e; 'furiko engines' lists them")
    found = tuple(all_of(names))
    for name in found:
        engine_info(name)
    return found


def _checks(names: list[str]) -> tuple[str, ...]:
    for name in names:
        if name not in CHECKS:
            raise InvalidInput(f"checks: {name!r} is none of {', '.join(CHECKS)}{nearest(name, CHECKS)}")
    if not names:
        raise InvalidInput(f"checks: at least one is needed, of {', '.join(CHECKS)}")
    return tuple(name for name in CHECKS if name in names)  # in the order in which a cell runs them


def _seeds(given: Any) -> Sequence[int]:
    if isinstance(given, int) and not isinstance(given, bool):
        _require("seeds", given, 1, MOST_VALUES)
        return range(given)
    if not isinstance(given, list) or not all(type(seed) is int and 0 <= seed <= LARGEST_SEED for seed in given):
        raise InvalidInput(f"seeds: how many, or a list of whole numbers from 0 to {LARGEST_SEED}, are needed")
    return _distinct("seeds", tuple(given))


def _distinct(field: str, values: tuple[Any, ...]) -> tuple[Any, ...]:
    if not values or len(values) > MOST_VALUES:
        raise InvalidInput(f"{field}: from 1 to {MOST_VALUES} values, got {len(values)}")
    if len(set(values)) < len(values):
        raise InvalidInput(f"{field}: a value is there twice")
    return values


def _of_scenes(given: _Scenes, where: str, folder: Path) -> list[Source]:
    if not given.scenes:
        raise InvalidInput(f"{where}.scenes: at least one name or file is needed")
    axes = _axes(given.parameters, f"{where}.parameters")
    found = []
    for name in given.scenes:
        is_file = name.endswith(".toml") or "/" in name
        scene = find_scene(str(folder / name) if is_file else name)
        _require_values(scene, axes, f"{where}.parameters")
        found.append(Source(scene.name, scene, axes))
    return found


def _of_random(given: _Random, where: str) -> list[Source]:
    axes = _axes(given.parameters, f"{where}.parameters")
    values = _values(given.links, f"{where}.links")
    counts = list(dict.fromkeys(map(round, values)))  # a range may come to one whole number twice
    for value, links in zip(values, map(round, values), strict=True):
        if value != links and not isinstance(given.links, dict):
            raise InvalidInput(f"{where}.links: whole numbers are needed, got {value:g}")
        _require(f"{where}.links", links, FEWEST_LINKS[given.kind], MOST_LINKS[given.kind])
    system = random_system(given.kind, min(counts), 0)
    scene: AnyScene = TreeScene("", system) if isinstance(system, TreeSystem) else Scene("", system)
    _require_values(scene, axes, f"{where}.parameters")
    return [Source(f"random {given.kind} of {links}", RandomMechanism(given.kind, links), axes) for links in counts]


def _axes(given: dict[str, Any], where: str) -> tuple[Axis, ...]:
    return tuple(Axis(name, _values(values, f"{where}.{name}")) for name, values in given.items())


def _values(given: Any, where: str) -> tuple[float, ...]:
    """Numbers: a list, one alone, or a range."""
    if isinstance(given, dict):
        try:
            return _distinct(where, _of_range(fitted(given, _Range), where))
        except InvalidInput as error:
            raise error if str(error).startswith(where) else InvalidInput(f"{where}.{error}") from None
    several = given if isinstance(given, list) else [given]
    values = tuple(number(f"{where}[{k}]", value) for k, value in enumerate(several))
    for value in values:
        if not math.isfinite(value):
            raise InvalidInput(f"{where}: must be finite, got {value!r}")
    return _distinct(where, values)


def _of_range(given: _Range, where: str) -> tuple[float, ...]:
    first, last = number("from", given.first), number("to", given.last)
    _require("count", given.count, 1, MOST_VALUES)
    if not (math.isfinite(first) and math.isfinite(last)):
        raise InvalidInput(f"{where}: from and to must be finite")
    if given.count == 1:
        return (first,)
    parts = [k / (given.count - 1) for k in range(1, given.count - 1)]
    if given.spacing == "linear":
        return (first, *(first + part * (last - first) for part in parts), last)
    if not (first > 0 and last > 0):
        raise InvalidInput(f"{where}: from and to must be above zero where the spacing is 'log'")
    return (first, *(first * (last / first) ** part for part in parts), last)


def _require_values(scene: AnyScene, axes: tuple[Axis, ...], where: str) -> None:
    """Each axis makes a mechanism from end to end, the others as they first are. Raises :class:`InvalidInput`.

    What a parameter may be is an interval: its smallest and its largest value tell.
    """
    first = {axis.name: axis.values[0] for axis in axes}
    for axis in axes:
        for value in (min(axis.values), max(axis.values)):
            try:
                varied(scene, first | {axis.name: value})
            except InvalidInput as error:
                raise InvalidInput(f"{where}: {error}") from None


def _require_states(sweep: Sweep) -> None:
    """Names of states are those of each source's kind, and no scene is left without any state."""
    from ...models.scene import NAMED_STATES
    from ...models.trees.scene import NAMED_STATES as OF_TREES

    for source in sweep.sources:
        base = source.base
        tree = isinstance(base, TreeScene) or (isinstance(base, RandomMechanism) and base.kind == "tree")
        known = OF_TREES if tree else NAMED_STATES
        for word in sweep.named or ():
            if word not in known:
                raise InvalidInput(f"named: {source.label} has no state {word!r}; it has {', '.join(known)}")
        given = not isinstance(base, RandomMechanism) and (base.starts or (sweep.named is None and base.named))
        if not (sweep.states or sweep.named or given):
            raise InvalidInput(f"states: none is left to look at in {source.label}; ask for some random or named ones")
