"""Which joint of an engine is which joint of a mechanism: by name, by the body that it moves, by order.

Files leave joints and bodies unnamed. furiko's readers then call them ``furiko_joint_k`` and ``furiko_body_k``, MuJoCo
nothing, Pinocchio and Drake something of their own. What has no name on either side is matched by order, which is the
document's, depth first, in the file and in every engine.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from ...models.spatial_mechanism import PlacedJoint, RigidBody, SpatialMechanism

UNNAMED_JOINT, UNNAMED_BODY = "furiko_joint_", "furiko_body_"  # how furiko's readers name what has no name
PLANAR = ("_TX", "_TY", "_RZ")  # what MuJoCo appends for the three joints that it makes of a planar one


@dataclass(frozen=True)
class HeldJoint:
    """A joint in an engine: its ``name`` and the ``body`` that it moves, "" where the engine has no name of the file's.

    ``shown``: what the engine calls it, for messages. ``made``: its name may be the engine's own, for want of one.
    """

    name: str
    kind: str
    body: str
    shown: str
    made: bool = False

    @property
    def unnamed(self) -> bool:
        """Whether the file may leave it unnamed."""
        return self.made or not self.name


def joints_of(kinds: Sequence[str], held: HeldJoint) -> tuple[HeldJoint, ...]:
    """An engine's joint ``held`` as joints of a mechanism: itself, or the three of a planar one."""
    if len(kinds) == 1:
        return (replace(held, kind=kinds[0]),)
    return tuple(
        replace(held, name=held.name + end, kind=kind, shown=held.shown + end, made=True)
        for kind, end in zip(kinds, PLANAR, strict=True)
    )


def match(mechanism: SpatialMechanism, held: Sequence[HeldJoint], engine: str) -> tuple[int, ...]:
    """For each joint of the mechanism, its index in ``held``.

    Raises ValueError where a joint is left over on either side, or is of another kind.
    """
    found, lost, additional = _pairs(mechanism, held)
    if lost or additional:
        raise ValueError(
            "; ".join(
                [f"{engine} has no joint {mechanism.joints[i].joint.name!r}" for i in lost]
                + [f"{engine} has a joint {held[j].shown!r} that the file has not" for j in additional]
            )
        )
    for i, j in sorted(found.items()):
        joint = mechanism.joints[i].joint
        if joint.kind != held[j].kind:
            raise ValueError(f"joint {joint.name!r} is a {joint.kind} in the file, {engine} has a {held[j].kind}")
    return tuple(found[i] for i in range(len(mechanism.joints)))


def _pairs(mechanism: SpatialMechanism, held: Sequence[HeldJoint]) -> tuple[dict[int, int], list[int], list[int]]:
    """Indices of the mechanism's joints with those of ``held``, and what is left over of both."""
    placed = mechanism.joints
    by_name = {joint.name: j for j, joint in reversed([*enumerate(held)]) if joint.name}  # the first of one name
    found = {i: by_name[p.joint.name] for i, p in enumerate(placed) if p.joint.name in by_name}
    used = set(found.values())
    for j, name in enumerate(unique(joint.shown for joint in held)):  # what a mechanism made of the engine calls them
        i = next((i for i, p in enumerate(placed) if i not in found and p.joint.name == name), None)
        if i is not None and j not in used:
            found[i] = j
            used.add(j)
    unnamed = [j for j, joint in enumerate(held) if joint.unnamed and j not in used]
    for body in {held[j].body for j in unnamed} - {""}:
        ours = [i for i, p in enumerate(placed) if i not in found and mechanism.bodies[p.body].name == body]
        theirs = [j for j in unnamed if held[j].body == body]
        if len(ours) == len(theirs):
            found.update(zip(ours, theirs, strict=True))
            used.update(theirs)
    theirs = [j for j in unnamed if j not in used]
    further = [i for i, p in enumerate(placed) if i not in found and _may_be_unnamed(mechanism, p)]
    without_name = [i for i in further if placed[i].joint.name.startswith(UNNAMED_JOINT)]
    for ours in (further, without_name):
        if len(ours) >= len(theirs) and _same_kinds(mechanism, ours, [held[j] for j in theirs]):
            found.update(zip(ours, theirs, strict=False))  # one that reads only the first bodies has the first joints
            used.update(theirs)
            break
    lost = [i for i in range(len(placed)) if i not in found]
    return found, lost, [j for j in range(len(held)) if j not in used]


def _same_kinds(mechanism: SpatialMechanism, ours: Sequence[int], theirs: Sequence[HeldJoint]) -> bool:
    """Whether as many of our joints as there are of theirs, the first ones, are of the kinds of theirs."""
    if len(ours) == len(theirs):
        return True  # one for one: another kind is a finding
    return all(mechanism.joints[i].joint.kind == joint.kind for i, joint in zip(ours, theirs, strict=False))


def _may_be_unnamed(mechanism: SpatialMechanism, placed: PlacedJoint) -> bool:
    """Unnamed in the file, or a further joint of its body: Pinocchio names one joint a body."""
    joints = mechanism.bodies[placed.body].joints
    return placed.joint.name.startswith(UNNAMED_JOINT) or placed.joint is not joints[0]


def named_alike(bodies: Iterable[RigidBody], held: Sequence[HeldJoint], like: SpatialMechanism) -> list[RigidBody]:
    """An engine's bodies, whose joints are ``held`` in order, with the names of ``like`` where they correspond.

    A body corresponds to another by a joint that moves it; without joints by its name; unnamed ones without joints by
    their order, if there are as many of them.
    """
    found, _, _ = _pairs(like, held)
    ours = {j: like.joints[i] for i, j in found.items()}
    named: list[RigidBody] = []
    at = 0
    for body in bodies:
        partners = [ours.get(at + k) for k in range(len(body.joints))]
        at += len(body.joints)
        joints = tuple(
            joint if partner is None else replace(joint, name=partner.joint.name)
            for joint, partner in zip(body.joints, partners, strict=True)
        )
        name = next((like.bodies[partner.body].name for partner in partners if partner is not None), body.name)
        named.append(replace(body, name=name, joints=joints))
    open_names = [b.name for b in like.bodies if not b.joints and b.name.startswith(UNNAMED_BODY)]
    unnamed = [k for k, body in enumerate(named) if not body.joints and not body.name]
    if len(unnamed) == len(open_names):
        for k, name in zip(unnamed, open_names, strict=True):
            named[k] = replace(named[k], name=name)
    return named


def unique(names: Iterable[str]) -> list[str]:
    """The names, a repeated one with a number: an engine may have two joints of one name."""
    seen: dict[str, int] = {}
    made = []
    for name in names:
        seen[name] = seen.get(name, 0) + 1
        made.append(name if seen[name] == 1 else f"{name} ({seen[name]})")
    return made
