"""A scene: a mechanism, the states in which it is compared, and the duration of its motion; read from a TOML file.

The scenes of the catalogue are in ``catalogue/`` beside this file, one a file, in the same format as a user's own:
those of the documents' two mechanisms, and in ``catalogue/trees/`` those of open mechanisms (:mod:`.trees.tables`).
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal

import msgspec

from .errors import InvalidInput, nearest
from .readers.bounded_file import read_text, shown
from .readers.toml_fields import fitted
from .readers.toml_text import parse_toml
from .systems import NLegPendulum, RodChain, number
from .trees.scene import TreeScene

CATALOGUE = Path(__file__).parent / "catalogue"
TREES = CATALOGUE / "trees"
LARGEST_FILE = 2_000_000  # bytes; ten thousand links fit several times over
LARGEST_N = 10_000
LARGEST_ANGLE = 1e15  # beyond it neighbouring doubles are more than a tenth of a radian apart
NAMED_STATES = ("hanging", "horizontal", "inverted", "small", "whirling", "straight")
RANDOM_STATES = 200


@dataclass(frozen=True)
class Scene:
    """One scene of a document's mechanism, of the catalogue or of a user's file.

    ``theta`` [rad] and ``omega`` [rad/s], (n,) each: the state that a trajectory starts from, or None where the file
    gives none; ``duration`` [s], 0 for no trajectory. ``random``: number of random states, ``named``: names of further
    states, in which accelerations, forces and energies are compared (:func:`furiko.models.states.states`).
    ``equations``: the documents' equations that this scene exercises.
    """

    name: str
    system: NLegPendulum | RodChain
    theta: tuple[float, ...] | None = None
    omega: tuple[float, ...] | None = None
    duration: float = 0.0
    random: int = RANDOM_STATES
    named: tuple[str, ...] = NAMED_STATES
    tags: tuple[str, ...] = ()
    equations: tuple[str, ...] = ()
    description: str = ""

    @property
    def starts(self) -> bool:
        """Whether the file gives a state."""
        return self.theta is not None


AnyScene = Scene | TreeScene


class _System(msgspec.Struct, forbid_unknown_fields=True):
    kind: Literal["n-leg", "rod-chain", "tree"]  # a tree's tables are another module's
    lengths: list[Any]  # numbers: the mechanism's own check names the one that is not
    masses: list[Any] | None = None
    density: Any = None
    gravity: Any = 9.81


class _State(msgspec.Struct, forbid_unknown_fields=True):
    theta: list[Any]
    omega: list[Any] | None = None
    duration: float = 0.0


class _Samples(msgspec.Struct, forbid_unknown_fields=True):
    random: int = RANDOM_STATES
    named: list[str] = msgspec.field(default_factory=lambda: list(NAMED_STATES))


class _File(msgspec.Struct, forbid_unknown_fields=True):
    system: _System
    state: _State | None = None
    samples: _Samples = msgspec.field(default_factory=_Samples)
    tags: list[str] = []
    equations: list[str] = []
    description: str = ""


@cache
def catalogue() -> tuple[str, ...]:
    """Names of the catalogue's scenes: those of the documents, smaller systems first, then those of trees."""
    return document_catalogue() + tuple(sorted((path.stem for path in TREES.glob("*.toml")), key=_natural))


@cache
def document_catalogue() -> tuple[str, ...]:
    """Names of the catalogue's scenes of the documents' mechanisms."""
    return tuple(sorted((path.stem for path in CATALOGUE.glob("*.toml")), key=_natural))


def find_scene(name: str) -> AnyScene:
    """The catalogue's scene of this name, or the scene in this TOML file. Raises :class:`InvalidInput`."""
    if name in catalogue():
        return read_scene(_file_of(name))
    if name.endswith(".toml") or "/" in name:
        return read_scene(Path(name))
    raise InvalidInput(f"scene {name!r}: not in the catalogue{nearest(name, catalogue())}; 'furiko scenes' lists all")


def _file_of(name: str) -> Path:
    """The file of a scene of the catalogue."""
    return (CATALOGUE if name in document_catalogue() else TREES) / f"{name}.toml"


def tagged_scenes(tag: str) -> tuple[AnyScene, ...]:
    """The catalogue's scenes with this tag. Others' files are looked into, not read: that takes most of the time."""
    names = [name for name in catalogue() if f'"{tag}"' in read_text(_file_of(name), LARGEST_FILE)]
    return tuple(scene for scene in find_scenes(names) if tag in scene.tags)


def document_scenes() -> tuple[Scene, ...]:
    """The catalogue's scenes of the documents' mechanisms."""
    return tuple(scene for scene in find_scenes(document_catalogue()) if isinstance(scene, Scene))


def find_document_scene(name: str, what: str) -> Scene:
    """The same for ``what`` (a phrase) is there for the documents' mechanisms alone; others are refused."""
    scene = find_scene(name)
    if isinstance(scene, TreeScene):
        raise InvalidInput(f"scene {name!r}: {what} takes the documents' mechanisms, not a tree")
    return scene


def read_scene(path: Path) -> AnyScene:
    """Read one scene file. Raises :class:`InvalidInput` naming the file, the field, and what would be right."""
    text = read_text(path, LARGEST_FILE)
    name = path.stem.encode("utf-8", "backslashreplace").decode()  # a file's name need not be UTF-8, a scene's is
    try:
        return scene_from_toml(text, name, path.parent)
    except InvalidInput as error:
        raise InvalidInput(f"{shown(path)}: {error}") from None


def scene_from_toml(text: str, name: str, folder: Path = Path()) -> AnyScene:
    """The scene that a TOML text describes; ``folder``: where its model file is. Raises :class:`InvalidInput`."""
    tables = parse_toml(text)
    given = tables.get("system")
    if (isinstance(given, dict) and given.get("kind") == "tree") or (given is None and "model" in tables):
        from .trees.tables import tree_scene  # the documents' scenes need none of it

        return tree_scene(tables, name, folder)
    file = fitted(tables, _File)
    system = _system(file.system)
    theta, omega, duration = _state(file.state, system.n)
    if not 0 <= file.samples.random <= 100_000:
        raise InvalidInput(f"samples.random: from 0 to 100000 states, got {file.samples.random}")
    for word in file.samples.named:
        if word not in NAMED_STATES:
            raise InvalidInput(
                f"samples.named: {word!r} is none of {', '.join(NAMED_STATES)}{nearest(word, NAMED_STATES)}"
            )
    if theta is None and not file.samples.random and not file.samples.named:
        raise InvalidInput("samples: no state is left to look at; give a [state], or ask for some random or named ones")
    return Scene(
        name=name,
        system=system,
        theta=theta,
        omega=omega,
        duration=duration,
        random=file.samples.random,
        named=tuple(file.samples.named),
        tags=tuple(file.tags),
        equations=tuple(file.equations),
        description=file.description,
    )


def _system(given: _System) -> NLegPendulum | RodChain:
    if len(given.lengths) > LARGEST_N:
        raise InvalidInput(f"system.lengths: at most {LARGEST_N} links, got {len(given.lengths)}")
    try:
        if given.kind == "rod-chain":
            if given.masses is not None:
                raise InvalidInput("masses: a rod chain takes density [kg/m] instead, and m_j = density × l_j")
            density = 1.0 if given.density is None else given.density
            return RodChain(tuple(given.lengths), density, given.gravity)
        if given.density is not None:
            raise InvalidInput("density: an N-leg pendulum takes masses [kg] instead")
        if given.masses is None:
            raise InvalidInput("masses: missing; one mass [kg] for each length is needed")
        return NLegPendulum(tuple(given.lengths), tuple(given.masses), given.gravity)
    except InvalidInput as error:
        raise InvalidInput(f"system.{error}") from None


def _state(given: _State | None, n: int) -> tuple[tuple[float, ...] | None, tuple[float, ...] | None, float]:
    if given is None:
        return None, None, 0.0
    theta = _angles("theta", given.theta, n, "rad")
    omega = _angles("omega", [0.0] * n if given.omega is None else given.omega, n, "rad/s")
    if not (math.isfinite(given.duration) and given.duration >= 0):
        raise InvalidInput(f"state.duration: must be zero or positive and finite, in s, got {given.duration!r}")
    return theta, omega, given.duration


def _angles(field: str, values: list[Any], n: int, unit: str) -> tuple[float, ...]:
    if len(values) != n:
        raise InvalidInput(f"state.{field}: {len(values)} values given, the system has {n} angles")
    numbers = tuple(number(f"state.{field}[{i}]", value) for i, value in enumerate(values))
    for i, value in enumerate(numbers):
        if not abs(value) <= LARGEST_ANGLE:
            raise InvalidInput(f"state.{field}[{i}]: must be finite, at most {LARGEST_ANGLE:g} {unit}, got {value!r}")
    return numbers


def _natural(name: str) -> tuple[str | int, ...]:
    """Sort key that puts rods-2 before rods-10."""
    return tuple(int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name))


def find_scenes(names: Sequence[str] | None) -> tuple[AnyScene, ...]:
    """The scenes of these names and files, each once, in the order given; the whole catalogue for None."""
    chosen = dict.fromkeys(catalogue() if names is None else names)
    scenes = tuple(find_scene(name) for name in chosen)
    seen: dict[str, str] = {}
    for scene, given in zip(scenes, chosen, strict=True):
        if scene.name in seen:
            raise InvalidInput(f"two scenes are called {scene.name!r}: {seen[scene.name]} and {given}; rename one")
        seen[scene.name] = given
    return scenes
