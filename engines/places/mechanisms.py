"""Mechanisms as the protocol's JSON has them, both ways. SI units, the fields of the classes that they stand for."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...models.spatial import Inertial
from ...models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from ...models.systems import NLegPendulum, RodChain, System

_JOINT_NUMBERS = ("ref", "armature", "damping", "friction", "stiffness", "springref")
_TENSOR = ([0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2])  # xx, yy, zz, xy, xz, yz


def planar(system: System) -> dict[str, Any]:
    """A document's mechanism: its links, and its numbers as the document has them.

    A link's ``parent`` counts from 0 and is -1 for the support; ``hinge`` in the parent's frame and ``com`` in its own
    are (along, across) [m], along the link and towards +x when it hangs; ``inertia`` is about ``com`` [kg m²].
    """
    tree = system.tree()
    links = [
        {
            "parent": link.parent,
            "hinge": list(link.hinge),
            "length": link.length,
            "com": list(link.com),
            "mass": link.mass,
            "inertia": link.inertia,
        }
        for link in tree.links
    ]
    found = {"kind": system.kind, "gravity": system.gravity, "lengths": list(system.lengths)}
    if isinstance(system, RodChain):
        found["density"] = system.density
    return {**found, "masses": list(system.masses), "links": links}


def system_of(content: Mapping[str, Any]) -> System:
    """The mechanism that :func:`planar` wrote, to the last bit."""
    if content["kind"] == "rod-chain":
        return RodChain(tuple(content["lengths"]), content["density"], content["gravity"])
    return NLegPendulum(tuple(content["lengths"]), tuple(content["masses"]), content["gravity"])


def spatial(mechanism: SpatialMechanism) -> dict[str, Any]:
    """A mechanism in space, in the coordinates of :mod:`furiko.models.spatial_mechanism`."""
    bodies = [
        {
            "name": body.name,
            "parent": body.parent,
            "position": _plain(body.position),
            "quaternion": _plain(body.quaternion),
            "mass": float(body.inertial.mass),
            "centre": _plain(body.inertial.centre),
            "inertia": _plain(np.asarray(body.inertial.tensor)[_TENSOR]),
            "joints": [_joint(joint) for joint in body.joints],
        }
        for body in mechanism.bodies
    ]
    return {"kind": "tree", "gravity": _plain(mechanism.gravity), "bodies": bodies}


def mechanism_of(content: Mapping[str, Any]) -> SpatialMechanism:
    """The mechanism that :func:`spatial` wrote, to the last bit. Raises what a missing or wrong field raises."""
    bodies = []
    for body in content["bodies"]:
        xx, yy, zz, xy, xz, yz = map(float, body["inertia"])
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        bodies.append(
            RigidBody(
                str(body["name"]),
                int(body["parent"]),
                _vector(body["position"], 3),
                _vector(body["quaternion"], 4),
                tuple(map(_joint_of, body["joints"])),
                Inertial(float(body["mass"]), _vector(body["centre"], 3), tensor),
            )
        )
    return SpatialMechanism(tuple(bodies), _vector(content["gravity"], 3))


def _joint(joint: Joint) -> dict[str, Any]:
    return {
        "name": joint.name,
        "kind": joint.kind,
        "axis": _plain(joint.axis),
        "anchor": _plain(joint.anchor),
        # No number of JSON is infinite: a limit that is, is null.
        "limits": None if joint.limits is None else [x if np.isfinite(x) else None for x in map(float, joint.limits)],
        **{name: float(getattr(joint, name)) for name in _JOINT_NUMBERS},
    }


def _joint_of(content: Mapping[str, Any]) -> Joint:
    limits = content["limits"]
    if limits is not None:
        low, high = limits
        limits = (-np.inf if low is None else float(low), np.inf if high is None else float(high))
    numbers: dict[str, Any] = {name: float(content[name]) for name in _JOINT_NUMBERS}
    return Joint(
        str(content["name"]),
        str(content["kind"]),
        _vector(content["axis"], 3),
        _vector(content["anchor"], 3),
        limits=limits,
        **numbers,
    )


def _plain(values: Any) -> list[float]:
    return [float(value) for value in values]


def _vector(values: Any, size: int) -> Any:
    found = np.array(values, dtype=np.float64)
    if found.shape != (size,):
        raise ValueError(f"{size} numbers are needed, got {found.shape}")
    return found
