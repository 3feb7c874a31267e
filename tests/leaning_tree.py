"""A planar tree with everything that a hinge may have but friction."""

from furiko.models.mechanism import Hinge, Mechanism
from furiko.models.tree import SUPPORT, Link


def general():
    """A tree with links to the side, armature, damper and spring."""
    links = (
        Link(SUPPORT, (0.0, 0.0), 1.0, (0.5, 0.1), 1.2, 0.1),
        Link(0, (0.9, -0.2), 1.0, (0.4, 0.05), 0.7, 0.05),
        Link(0, (0.3, 0.25), 1.0, (0.6, 0.0), 0.4),
    )
    hinges = (Hinge(armature=0.02), Hinge(damping=0.3, armature=0.01), Hinge(stiffness=2.0, rest=0.4))
    return Mechanism(links, hinges, (9.81, 0.3), ("a", "b", "c"))
