"""The mechanism that an engine says it holds, and whether that explains its motion."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ..engines import ModelFields
from ..models import Link, PlanarTree
from ..models.mechanism import Hinge, Mechanism, mechanism_of
from ..reference import planar_tree as planar
from .differences import differences
from .explanation import Explanation, together
from .question import Question


def mechanism_from(expected: Any) -> Mechanism:
    """A mechanism from a system, a planar tree, or a mechanism."""
    if isinstance(expected, Mechanism):
        return expected
    return mechanism_of(expected if isinstance(expected, PlanarTree) else expected.tree())


def compiled_by(engine: Any, mechanism: Mechanism) -> Mechanism | None:
    """The mechanism that the engine says it holds; None where it does not say. Names are those of ``mechanism``."""
    if hasattr(engine, "compiled"):
        found: Mechanism = engine.compiled()
        return found
    missing = getattr(getattr(engine, "info", None), "missing", {})
    if not hasattr(engine, "fields") or "fields" in missing:
        return None
    return mechanism_of_fields(engine.fields(), mechanism)


def mechanism_of_fields(fields: ModelFields, like: Mechanism) -> Mechanism:
    """The mechanism that an adapter's model fields describe, in the links' own frames; names as ``like`` has them."""
    n = len(fields.masses)
    links = tuple(
        Link(
            parent=int(fields.parents[i]),
            hinge=tuple(map(float, fields.hinges[i])),  # type: ignore[arg-type]
            length=1.0,
            com=tuple(map(float, fields.centres[i])),  # type: ignore[arg-type]
            mass=float(fields.masses[i]),
            inertia=float(fields.inertias[i]),
        )
        for i in range(n)
    )
    names = [hinge.name for hinge in like.hinges] + [""] * n
    hinges = tuple(
        Hinge(name=names[i], armature=float(fields.armature[i]), damping=float(fields.damping[i])) for i in range(n)
    )
    x, _, z = (float(v) for v in fields.gravity)
    link_names = (like.link_names + ("",) * n)[:n]
    if fields.dofs != n:  # fewer coordinates than links
        links, hinges, link_names = links[: fields.dofs], hinges[: fields.dofs], link_names[: fields.dofs]
        links = tuple(replace(k, parent=min(k.parent, i - 1)) for i, k in enumerate(links))
    return Mechanism(links, hinges, (-z, x), link_names, tuple(map(float, fields.gravity)))


def compiled_differences(q: Question) -> Explanation:
    """How the mechanism that the engine holds differs from the one expected, where it explains the engine's motion."""
    if q.compiled is None or not explains(q.compiled, q):
        return Explanation()
    return together(differences(q.compiled, q.m, q.who))


def explains(other: Mechanism, q: Question) -> bool:
    """Whether the engine moves as another mechanism."""
    p = planar.parameters(other)
    return q.measured.worst(p) <= 1 and q.again.worst(p) <= 1
