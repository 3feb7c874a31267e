"""What acts in an MJCF document besides its bodies and joints, and is left out where engines are compared."""

from __future__ import annotations

from collections.abc import Sequence

from ...spatial_mechanism import RigidBody
from ..xml_file import Element
from .actuators import Actuators
from .defaults import Defaults
from .options import Options

TENDON_FORCES = ("stiffness", "damping", "frictionloss", "armature", "springlength", "range", "limited")


def left_out(
    roots: Sequence[tuple[Element, Defaults]],
    bodies: Sequence[RigidBody],
    options: Options,
    actuators: Actuators,
    colliding: int,
) -> list[str]:
    """Short names of what acts and is left out. ``colliding``: how many geoms may touch others.

    ``roots``: the document and those that are attached, with their default classes.
    """
    constrained = "constraint" not in options.disabled
    contacts = [section for root, _ in roots for section in root.all("contact")]
    pairs = any(pair.tag == "pair" for section in contacts for pair in section.children)
    joints = [joint for body in bodies for joint in body.joints]
    acts = {
        "contacts": constrained and "contact" not in options.disabled and (colliding > 1 or pairs),
        "joint limits": any(joint.limits is not None for joint in joints),
        "dry friction": any(joint.friction > 0 for joint in joints),
        "actuators": actuators.count > 0 and "actuation" not in options.disabled,
        "equality constraints": constrained
        and "equality" not in options.disabled
        and any(_equality(*one) for one in roots),
        "tendons (springs, limits, armature)": any(_tendons(*one) for one in roots),
        "fluid forces (density, viscosity)": options.fluid,
        "bodies that bend (flex)": any(
            s.first("flex") is not None for root, _ in roots for s in root.all("deformable")
        ),
    }
    return [what for what, does in acts.items() if does]


def _equality(root: Element, defaults: Defaults) -> bool:
    for section in root.all("equality"):
        for constraint in section.children:
            behind = [at for at in defaults.chain(constraint) if at.tag == "equality"]
            active = "true"
            for at in (*behind, constraint):
                active = at.get("active", active)
            if active != "false":
                return True
    return False


def _tendons(root: Element, defaults: Defaults) -> bool:
    for section in root.all("tendon"):
        for tendon in section.children:
            behind = [at for at in defaults.chain(tendon) if at.tag == "tendon"]
            given: dict[str, str] = {}
            for at in (*behind, tendon):
                given |= at.attributes
            if any(_says(given.get(name, "0")) for name in TENDON_FORCES):
                return True
    return False


def _says(value: str) -> bool:
    """Whether an attribute's text is other than zeros, ``false`` and ``auto``."""
    return any(word not in ("0", "0.0", "false", "auto") for word in value.split())
