"""Mechanisms in space drawn at random, with everything that a joint and a body may have."""

import numpy as np

from furiko.models.spatial import Inertial
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism


def inertial(rng, scale=1.0):
    """A body of twenty points, so that its tensor is one that matter can have."""
    points = rng.normal(size=(20, 3)) * rng.uniform(0.02, 0.3, 3) * scale
    masses = rng.uniform(0.01, 0.3, 20)
    centre = masses @ points / masses.sum()
    apart = points - centre
    tensor = np.einsum("k,kij->ij", masses, [r @ r * np.eye(3) - np.outer(r, r) for r in apart])
    return Inertial(float(masses.sum()), centre + rng.normal(size=3) * 0.1 * scale, (tensor + tensor.T) / 2)


def joint(rng, name, kind):
    """Everything but limits and friction, which the equations of motion leave out."""
    passive = {key: float(rng.uniform(0, 2)) for key in ("armature", "damping", "stiffness")}
    if kind in ("hinge", "slide"):
        passive |= {"ref": rng.normal(), "springref": rng.normal()}
    anchor = np.zeros(3) if kind == "free" else rng.normal(size=3) * 0.3
    return Joint(name, kind, axis=rng.normal(size=3), anchor=anchor, **passive)


def joints(rng, name, most=3):
    """Up to ``most`` joints of one body: at most one ball, and no hinge after it."""
    found = []
    for k in range(rng.integers(0, most + 1)):
        kinds = ["slide"] if any(j.kind == "ball" for j in found) else ["hinge", "hinge", "slide", "ball"]
        found.append(joint(rng, f"{name} {k}", str(rng.choice(kinds))))
    return tuple(found)


def tree(rng, bodies, free=False):
    """A tree of so many bodies, depth first, some fixed to their parents, under a gravity of any direction."""
    found = []
    way = []  # from the world to the last body
    for i in range(bodies):
        del way[int(rng.integers(max(0, len(way) - 2), len(way) + 1)) :]
        parent = way[-1] if way else -1
        own = (joint(rng, "free", "free"),) if free and i == 0 else joints(rng, f"joint {i}")
        pose = rng.normal(size=3) * 0.5, rng.normal(size=4)
        found.append(RigidBody(f"body {i}", parent, *pose, own, inertial(rng)))
        way.append(i)
    return SpatialMechanism(tuple(found), rng.normal(size=3) * 6)


def chain(rng, n, branching=0.0):
    """n bodies on hinges in any directions; with this probability one hangs on one before the last."""
    found = []
    way = []  # from the world to the last body
    for i in range(n):
        if rng.random() < branching:
            del way[-int(rng.integers(1, 10)) :]
        hinge = Joint(f"joint {i}", "hinge", axis=rng.normal(size=3))
        pose = rng.normal(size=3) * 0.2, rng.normal(size=4)
        found.append(RigidBody(f"body {i}", way[-1] if way else -1, *pose, (hinge,), inertial(rng, 0.5)))
        way.append(i)
    return SpatialMechanism(tuple(found), np.array([0.0, 0.0, -9.81]))


def state(rng, mechanism):
    """q, v and torque; quaternions of any length."""
    return rng.normal(size=mechanism.nq), rng.normal(size=mechanism.nv) * 2, rng.normal(size=mechanism.nv) * 5
