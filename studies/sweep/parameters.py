"""Parameters: what of a scene's mechanism a sweep can set or scale.

``gravity`` [m/s²], ``density`` [kg/m] of a rod chain, ``l1``, ``l2``, … [m] and, of an N-leg pendulum, ``m1``, ``m2``,
… [kg] are set; ``lengths`` and ``masses`` are factors, of all of them. A tree has the first and the last two.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import replace

from ...models import AnyScene, InvalidInput, NLegPendulum, RodChain, TreeScene, TreeSystem
from ...models.errors import nearest
from ...models.trees.system import TreeJoint, TreeLink, Vector

OF_TREES = ("gravity", "lengths", "masses")
ONE_LINK = re.compile(r"([lm])([1-9][0-9]{0,3})")


def varied(scene: AnyScene, values: Mapping[str, float]) -> AnyScene:
    """The scene with these values put in; the scene itself for none. Raises :class:`InvalidInput`.

    A mechanism that was changed is no longer that of a model file, nor that of a user's own equations.
    """
    if not values:
        return scene
    if isinstance(scene, TreeScene):
        return replace(scene, system=_tree(scene.system, values), model="", own=None)
    return replace(scene, system=_document(scene.system, values))


def _document(system: NLegPendulum | RodChain, values: Mapping[str, float]) -> NLegPendulum | RodChain:
    lengths = list(system.lengths)
    masses = list(system.masses)
    density = system.density if isinstance(system, RodChain) else None
    gravity = system.gravity
    for name, value in values.items():
        link = ONE_LINK.fullmatch(name)
        if link and int(link[2]) <= system.n and (link[1] == "l" or density is None):
            (lengths if link[1] == "l" else masses)[int(link[2]) - 1] = value
        elif name == "gravity":
            gravity = value
        elif name == "density" and density is not None:
            density = value
        elif name not in ("lengths", "masses"):
            raise _unknown(name, _known(system))
    lengths = [values.get("lengths", 1.0) * length for length in lengths]
    if density is not None:
        return RodChain(tuple(lengths), values.get("masses", 1.0) * density, gravity)
    return NLegPendulum(tuple(lengths), tuple(values.get("masses", 1.0) * mass for mass in masses), gravity)


def _known(system: NLegPendulum | RodChain) -> tuple[str, ...]:
    several = ["gravity", "lengths", "masses", *(f"l{k + 1}" for k in range(system.n))]
    own = ["density"] if isinstance(system, RodChain) else [f"m{k + 1}" for k in range(system.n)]
    return (*several, *own)


def _unknown(name: str, known: tuple[str, ...]) -> InvalidInput:
    shown = ", ".join(known[:12]) + (", …" if len(known) > 12 else "")
    return InvalidInput(f"{name}: no parameter of this mechanism{nearest(name, known)}; there are {shown}")


def _tree(system: TreeSystem, values: Mapping[str, float]) -> TreeSystem:
    for name in values:
        if name not in OF_TREES:
            raise _unknown(name, OF_TREES)
    longer, heavier = values.get("lengths", 1.0), values.get("masses", 1.0)
    for name in ("lengths", "masses"):
        if not (math.isfinite(values.get(name, 1.0)) and values.get(name, 1.0) > 0):
            raise InvalidInput(f"{name}: a factor above zero is needed, got {values[name]:g}")
    links = tuple(_scaled(link, longer, heavier) for link in system.links)
    return TreeSystem(links, _gravity(system.gravity, values.get("gravity")))


def _scaled(link: TreeLink, longer: float, heavier: float) -> TreeLink:
    return replace(
        link,
        position=_times(link.position, longer),
        centre=_times(link.centre, longer),
        mass=heavier * link.mass,
        inertia=_times(link.inertia, heavier * longer**2),
        joints=tuple(_scaled_joint(joint, longer) for joint in link.joints),
    )


def _scaled_joint(joint: TreeJoint, longer: float) -> TreeJoint:
    along = longer if joint.kind == "slide" else 1.0  # its coordinate is a length
    limits = None if joint.limits is None else (along * joint.limits[0], along * joint.limits[1])
    anchor = _times(joint.anchor, longer)
    return replace(joint, anchor=anchor, ref=along * joint.ref, springref=along * joint.springref, limits=limits)


def _gravity(given: Vector, size: float | None) -> Vector:
    """As strong as asked for, in the direction that it has; along -z where it has none."""
    if size is None:
        return given
    if not (math.isfinite(size) and size >= 0):
        raise InvalidInput(f"gravity: must be zero or positive and finite (its direction stays), got {size:g}")
    strength = math.hypot(*given)
    return _times(given, size / strength) if strength else (0.0, 0.0, -size)


def _times(vector: Vector, factor: float) -> Vector:
    return tuple(factor * value for value in vector)
