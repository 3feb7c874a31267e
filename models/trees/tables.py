"""A scene of an open mechanism: ``kind = "tree"`` in a scene file, with links and joints, or a model file, in it.

A file with everything that it may have::

    [system]
    kind = "tree"
    gravity = [0.0, 0.0, -9.81]          # or a number: along -z

    [[system.links]]
    name = "cart"                        # parent = "…": a link before it; none: the world
    position = [0.0, 0.0, 0.0]           # of its frame in the parent's, in the reference configuration
    quaternion = [1.0, 0.0, 0.0, 0.0]    # w first, of any length but zero
    mass = 1.0
    centre = [0.0, 0.0, 0.0]             # of mass, in its own frame
    inertia = [0.01, 0.01, 0.01]         # about the centre: xx, yy, zz, or those and xy, xz, yz

    [[system.links.joints]]              # none: fixed to its parent
    name = "track"
    kind = "slide"                       # hinge, slide, ball or free
    axis = [1.0, 0.0, 0.0]               # anchor, ref, armature, damping, stiffness, springref, limits

    [state]
    q = { track = 0.1 }                  # by joint; the others as in the reference configuration
    v = { track = [0.5] }                # the others at rest
    duration = 2.0

In the place of links ``model = "file.xml"`` names an MJCF or URDF file, beside the scene file or below it; at the top
of the file it stands for the whole [system]. A user's own equations are those of :mod:`.own`. Coordinates are those of
:mod:`furiko.models.spatial_mechanism`. ``limits`` bound the random states of a scene, and act on nothing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import msgspec

from ..errors import InvalidInput, nearest
from ..readers.toml_fields import fitted
from .own import own_equations, split_off
from .scene import NAMED_STATES, RANDOM_STATES, TreeScene
from .system import COORDINATES, RATES, Kind, TreeJoint, TreeLink, TreeSystem, Vector

MOST_FREEDOMS = 1_000
LARGEST = 1e9  # of any number: products of several of them stay far from overflow
LEAST = 1e-12  # of a mass, a moment of inertia or the length of an axis that is not zero
MOST_STATES = 100_000


class _Joint(msgspec.Struct, forbid_unknown_fields=True):
    name: str
    kind: Kind = "hinge"
    axis: list[float] = msgspec.field(default_factory=lambda: [0.0, 0.0, 1.0])
    anchor: list[float] = msgspec.field(default_factory=lambda: [0.0] * 3)
    ref: float = 0.0
    armature: float = 0.0
    damping: float = 0.0
    stiffness: float = 0.0
    springref: float = 0.0
    limits: list[float] | None = None


class _Link(msgspec.Struct, forbid_unknown_fields=True):
    name: str
    parent: str | None = None
    position: list[float] = msgspec.field(default_factory=lambda: [0.0] * 3)
    quaternion: list[float] = msgspec.field(default_factory=lambda: [1.0, 0.0, 0.0, 0.0])
    mass: float = 0.0
    centre: list[float] = msgspec.field(default_factory=lambda: [0.0] * 3)
    inertia: list[float] = msgspec.field(default_factory=lambda: [0.0] * 3)
    joints: list[_Joint] = []


class _System(msgspec.Struct, forbid_unknown_fields=True):
    kind: Literal["tree"]
    links: list[_Link] = []
    gravity: float | list[float] = 9.81
    model: str | None = None


class _State(msgspec.Struct, forbid_unknown_fields=True):
    q: dict[str, float | list[float]] = {}
    v: dict[str, float | list[float]] = {}
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


def tree_scene(tables: dict[str, Any], name: str, folder: Path) -> TreeScene:
    """The scene that a file's tables describe; ``folder``: where it is. Raises :class:`InvalidInput`."""
    tables, own = split_off(tables)
    file = fitted(tables, _File)
    system = _system(file.system, folder, gravity_given="gravity" in tables["system"])
    samples = file.samples
    if not 0 <= samples.random <= MOST_STATES:
        raise InvalidInput(f"samples.random: from 0 to {MOST_STATES} states, got {samples.random}")
    for word in samples.named:
        if word not in NAMED_STATES:
            raise InvalidInput(
                f"samples.named: {word!r} is none of {', '.join(NAMED_STATES)}{nearest(word, NAMED_STATES)}"
            )
    if file.state is None and not samples.random and not samples.named:
        raise InvalidInput("samples: no state is left to look at; give a [state], or ask for some random or named ones")
    q = v = None
    if file.state is not None:
        q = _by_joint("state.q", file.state.q, system, COORDINATES, system.reference)
        v = _by_joint("state.v", file.state.v, system, RATES, (0.0,) * system.n)
    duration = 0.0 if file.state is None else file.state.duration
    if not (math.isfinite(duration) and duration >= 0):
        raise InvalidInput(f"state.duration: must be zero or positive and finite, in s, got {duration!r}")
    return TreeScene(
        name=name,
        system=system,
        q=q,
        v=v,
        duration=duration,
        random=samples.random,
        named=tuple(samples.named),
        tags=tuple(file.tags),
        equations=tuple(file.equations),
        description=file.description,
        model="" if file.system.model is None else str((folder / file.system.model).resolve()),
        own=own_equations(own, system),
    )


def _system(given: _System, folder: Path, *, gravity_given: bool) -> TreeSystem:
    if given.model is not None:
        if given.links or gravity_given:
            raise InvalidInput("system.model: links and gravity are those of the model file; give one or the other")
        system = _from_file(given.model, folder)
    else:
        system = TreeSystem(_links(given.links), _gravity(given.gravity))
    if not system.n:
        raise InvalidInput("system.links: no joint moves anything; at least one is needed")
    if system.n > MOST_FREEDOMS:
        raise InvalidInput(f"system.links: at most {MOST_FREEDOMS} degrees of freedom, got {system.n}")
    names = [joint.name for joint in system.joints]
    for name in names:
        if names.count(name) > 1:
            raise InvalidInput(f"system.links: two joints are called {name!r}; names must be unique")
    _require_inertia(system)
    return system


def _from_file(model: str, folder: Path) -> TreeSystem:
    from ..readers.model_file import read_model  # needs numpy
    from .system import tree_of

    inside = Path(model)
    if inside.is_absolute() or ".." in inside.parts:
        raise InvalidInput(f"system.model: {model!r}: a file beside the scene file, or in a folder below it, is needed")
    try:
        return tree_of(read_model(folder / inside).spatial)
    except InvalidInput as error:
        raise InvalidInput(f"system.model: {error}") from None


def _links(given: list[_Link]) -> tuple[TreeLink, ...]:
    found: list[TreeLink] = []
    index: dict[str, int] = {}
    for i, link in enumerate(given):
        where = f"system.links[{i}]"
        if link.name in index:
            raise InvalidInput(f"{where}.name: two links are called {link.name!r}; names must be unique")
        if link.parent is not None and link.parent not in index:
            raise InvalidInput(
                f"{where}.parent: {link.parent!r} is no link before it{nearest(link.parent, index)}; "
                "a parent comes before its children"
            )
        index[link.name] = i
        found.append(_link(link, -1 if link.parent is None else index[link.parent], where))
    return tuple(found)


def _link(link: _Link, parent: int, where: str) -> TreeLink:
    made = TreeLink(
        name=link.name,
        parent=parent,
        position=_numbers(f"{where}.position", link.position, (3,)),
        quaternion=_direction(f"{where}.quaternion", link.quaternion, 4),
        mass=_size(f"{where}.mass", link.mass, "kg"),
        centre=_numbers(f"{where}.centre", link.centre, (3,)),
        inertia=_inertia(f"{where}.inertia", link.inertia),
        joints=tuple(_joint(joint, f"{where}.joints[{k}]") for k, joint in enumerate(link.joints)),
    )
    if any(made.inertia) and not made.mass:
        raise InvalidInput(f"{where}.mass: a link that has inertia has a mass, too")
    if any(joint.kind == "free" for joint in made.joints) and (parent != -1 or len(made.joints) > 1):
        raise InvalidInput(f"{where}.joints: a free joint must be alone, on a link of the world")
    return made


def _joint(joint: _Joint, where: str) -> TreeJoint:
    limits = None
    if joint.limits is not None:
        low, high = _numbers(f"{where}.limits", joint.limits, (2,))
        if not low < high:
            raise InvalidInput(f"{where}.limits: the lower one comes first, got {joint.limits}")
        if joint.kind not in ("hinge", "slide"):
            raise InvalidInput(f"{where}.limits: a {joint.kind} joint has none here")
        limits = low, high
    numbers = {name: getattr(joint, name) for name in ("ref", "springref")}
    for name, value in numbers.items():
        _numbers(f"{where}.{name}", [value], (1,))
    return TreeJoint(
        name=joint.name,
        kind=joint.kind,
        axis=_direction(f"{where}.axis", joint.axis, 3),
        anchor=_numbers(f"{where}.anchor", joint.anchor, (3,)),
        armature=_size(f"{where}.armature", joint.armature, "kg m² or kg"),
        damping=_size(f"{where}.damping", joint.damping, "N m s or N s/m"),
        stiffness=_size(f"{where}.stiffness", joint.stiffness, "N m/rad or N/m"),
        limits=limits,
        **numbers,
    )


def _numbers(field: str, values: list[float], lengths: tuple[int, ...]) -> Vector:
    if len(values) not in lengths:
        raise InvalidInput(f"{field}: {' or '.join(map(str, lengths))} numbers are needed, got {len(values)}")
    for k, value in enumerate(values):
        if not abs(value) <= LARGEST:
            raise InvalidInput(f"{field}[{k}]: must be finite, at most {LARGEST:g}, got {value!r}")
    return tuple(map(float, values))


def _direction(field: str, values: list[float], length: int) -> Vector:
    found = _numbers(field, values, (length,))
    if math.hypot(*found) < LEAST:
        raise InvalidInput(f"{field}: has no direction: its length must be at least {LEAST:g}")
    return found


def _size(field: str, value: float, unit: str) -> float:
    if value != 0 and not LEAST <= value <= LARGEST:
        raise InvalidInput(f"{field}: must be zero, or from {LEAST:g} to {LARGEST:g} {unit}, got {value!r}")
    return float(value)


def _inertia(field: str, values: list[float]) -> Vector:
    """Six components, of a tensor that a body can have: no moment is more than the sum of the two others."""
    found = _numbers(field, values, (3, 6))
    xx, yy, zz, xy, xz, yz = found if len(found) == 6 else (*found, 0.0, 0.0, 0.0)
    # Of ∫ r rᵀ dm, which has no negative eigenvalue for any body: twice its entries, and its principal minors.
    a, b, c = yy + zz - xx, xx + zz - yy, xx + yy - zz
    d, e, f = -2 * xy, -2 * xz, -2 * yz
    size = max(map(abs, found), default=0.0)
    minors = (
        (1, min(a, b, c)),
        (2, min(a * b - d * d, a * c - e * e, b * c - f * f)),
        (3, a * (b * c - f * f) - d * (d * c - e * f) + e * (d * f - b * e)),
    )
    # A plate or a rod has zeros there: as many roundings are forgiven as the minors have operations.
    if any(minor < -64 * 2.0**-52 * size**power for power, minor in minors):
        raise InvalidInput(
            f"{field}: no body has these moments: each is at most the sum of the two others, in any axes"
        )
    return xx, yy, zz, xy, xz, yz


def _gravity(given: float | list[float]) -> Vector:
    if isinstance(given, list):
        return _numbers("system.gravity", given, (3,))
    if not 0 <= given <= LARGEST:
        raise InvalidInput(
            f"system.gravity: must be zero or positive and finite (it points along -z: write 9.81, not -9.81), "
            f"got {given!r}"
        )
    return 0.0, 0.0, 0.0 - given


def _by_joint(
    field: str,
    given: Mapping[str, float | list[float]],
    system: TreeSystem,
    sizes: Mapping[Kind, int],
    otherwise: Vector,
) -> Vector:
    names = [joint.name for joint in system.joints]
    for name in given:
        if name not in names:
            raise InvalidInput(f"{field}.{name}: no joint is called {name!r}{nearest(name, names)}")
    found: list[float] = []
    for joint in system.joints:
        size, at = sizes[joint.kind], len(found)
        if joint.name not in given:
            found += otherwise[at : at + size]
            continue
        value = given[joint.name]
        numbers = _numbers(f"{field}.{joint.name}", value if isinstance(value, list) else [value], (size,))
        if sizes is COORDINATES and size >= 4:
            _direction(f"{field}.{joint.name}", list(numbers[-4:]), 4)
        found += numbers
    return tuple(found)


def _require_inertia(system: TreeSystem) -> None:
    """Refuse a joint behind which nothing has mass: its acceleration would be anything."""
    weighs = [link.mass > 0 for link in system.links]
    for i in range(len(system.links) - 1, -1, -1):
        link = system.links[i]
        if weighs[i] and link.parent >= 0:
            weighs[link.parent] = True
    for link, heavy in zip(system.links, weighs, strict=True):
        for joint in link.joints:
            if not heavy and not joint.armature:
                raise InvalidInput(f"joint {joint.name!r} moves nothing that has mass, and has no armature")
