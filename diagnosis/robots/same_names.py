"""What files leave unnamed, called alike in two readings of a file: furiko's numbers count what a reading has read.

With a mistake that loses elements the tenth joint without a name may be the first; it is the same joint all the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ...engines.model_files.robot_joints import UNNAMED_BODY, UNNAMED_JOINT
from ...models.spatial_mechanism import SpatialMechanism


def called_as(holds: SpatialMechanism, reading: SpatialMechanism) -> SpatialMechanism:
    """``holds`` with the names of ``reading`` for bodies and joints that have numbers for names.

    Bodies correspond by name; unnamed ones by order, where there are as many; their joints by order, where those of
    both are as many and of the same kinds. So do joints that the file leaves unnamed and those of which the reading has
    no such name, for which the engine has made one.
    """
    holds = _joints_without_name(holds, reading)
    names = _bodies(holds, reading)
    theirs = {body.name: body for body in reading.bodies}
    made = []
    for body in holds.bodies:
        name = names.get(body.name, body.name)
        other = theirs[name].joints if name in theirs else ()
        joints = body.joints
        if [joint.kind for joint in joints] == [joint.kind for joint in other]:
            joints = tuple(
                replace(ours, name=its.name) if _numbered(ours.name) and _numbered(its.name) else ours
                for ours, its in zip(joints, other, strict=True)
            )
        made.append(replace(body, name=name, joints=joints))
    renamed = [joint.name for body in made for joint in body.joints]
    if len(set(renamed)) < len(renamed):
        return holds  # a number is another joint's already
    return replace(holds, bodies=tuple(made))


def _joints_without_name(holds: SpatialMechanism, reading: SpatialMechanism) -> SpatialMechanism:
    """``holds`` with the numbers of the ``reading`` in place of names that only ``holds`` has: by order, if as many."""
    known = set(holds.joint_names), set(reading.joint_names)
    ours = [placed.joint for placed in reading.joints if placed.joint.name not in known[0]]
    theirs = [placed.joint for placed in holds.joints if placed.joint.name not in known[1]]
    alike = [joint.kind for joint in ours] == [joint.kind for joint in theirs]
    if not ours or not alike or not all(_numbered(joint.name) for joint in ours):
        return holds
    names = {its.name: joint.name for its, joint in zip(theirs, ours, strict=True)}
    bodies = [
        replace(body, joints=tuple(replace(joint, name=names.get(joint.name, joint.name)) for joint in body.joints))
        for body in holds.bodies
    ]
    return replace(holds, bodies=tuple(bodies))


def _numbered(joint: str) -> bool:
    return joint.startswith(UNNAMED_JOINT)


def _bodies(holds: SpatialMechanism, reading: SpatialMechanism) -> Mapping[str, str]:
    """For each unnamed body its name in the ``reading``; none where the two have not as many."""
    ours, theirs = ([b.name for b in m.bodies if b.name.startswith(UNNAMED_BODY)] for m in (holds, reading))
    return dict(zip(ours, theirs, strict=True)) if len(ours) == len(theirs) else {}
