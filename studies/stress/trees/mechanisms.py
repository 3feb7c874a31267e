"""Mechanisms of the stress test's own, beside the catalogue's: a chain, a floating body, three hinges on one link."""

from __future__ import annotations

from ....models.trees.system import TreeJoint, TreeLink, TreeSystem

AXES_OF_HINGES = ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.3, 1.0))  # in turn, so that a chain moves in space


def chain(n: int) -> TreeSystem:
    """Rods of 2 m and 2 kg in all, on hinges whose axes are not parallel."""
    length = mass = 2.0 / n
    moment = mass * length**2 / 12
    return TreeSystem(
        tuple(
            TreeLink(
                name=f"rod {i + 1}",
                parent=i - 1,
                position=(0.0, 0.0, -length if i else 0.0),
                mass=mass,
                centre=(0.0, 0.0, -length / 2),
                inertia=(moment, moment, moment / 50, 0.0, 0.0, 0.0),
                joints=(TreeJoint(f"hinge {i + 1}", axis=AXES_OF_HINGES[i % 3]),),
            )
            for i in range(n)
        )
    )


def floating() -> TreeSystem:
    """A body of 10 kg that moves freely, with two limbs of 1 kg on ball joints."""
    trunk = TreeLink(
        "trunk", -1, mass=10.0, inertia=(0.4, 0.5, 0.3, 0.0, 0.0, 0.0), joints=(TreeJoint("float", "free"),)
    )
    limbs = tuple(
        TreeLink(
            f"limb {k}",
            0,
            position=(0.2 * side, 0.1, 0.0),
            mass=1.0,
            centre=(0.0, 0.0, -0.25),
            inertia=(0.02, 0.02, 0.001, 0.0, 0.0, 0.0),
            joints=(TreeJoint(f"ball {k}", "ball"),),
        )
        for k, side in ((1, 1.0), (2, -1.0))
    )
    return TreeSystem((trunk, *limbs))


def gimbal() -> TreeSystem:
    """An arm with a shoulder of three hinges at right angles on one link: with the middle one at a right angle, the
    outer two turn about one line, and nothing weighs what they turn against each other."""
    hinges = ("yaw", (0.0, 0.0, 1.0)), ("pitch", (0.0, 1.0, 0.0)), ("roll", (1.0, 0.0, 0.0))
    shoulder = TreeLink(
        "upper arm",
        -1,
        mass=2.0,
        centre=(0.02, 0.01, -0.15),
        inertia=(0.02, 0.018, 0.004, 0.001, 0.0, -0.001),
        joints=tuple(TreeJoint(name, axis=axis) for name, axis in hinges),
    )
    forearm = TreeLink(
        "forearm",
        0,
        position=(0.0, 0.0, -0.3),
        mass=1.2,
        centre=(0.0, 0.0, -0.13),
        inertia=(0.007, 0.007, 0.001, 0.0, 0.0, 0.0),
        joints=(TreeJoint("elbow", axis=(0.0, 1.0, 0.0)),),
    )
    return TreeSystem((shoulder, forearm))
