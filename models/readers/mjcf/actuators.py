"""MJCF's actuators: what they add to their joints for good, and which of them pull though nothing drives them."""

from __future__ import annotations

from collections.abc import Container, Iterable
from dataclasses import dataclass, field

from ..attributes import number, numbers
from ..xml_file import Element
from .defaults import Defaults

KINDS = (
    *("general", "motor", "position", "velocity", "intvelocity", "orientation", "pid", "damper", "cylinder", "muscle"),
    *("adhesion", "dcmotor", "plugin"),
)
TARGETS = ("joint", "jointinparent", "tendon", "site", "cranksite", "body")
MOST_COEFFICIENTS = 20


@dataclass
class Actuators:
    """What a document's actuators do.

    ``joints``: names of those that are there; ``servos``: names of actuators that pull at ctrl = 0, each with its joint
    (or tendon, site, body). By joint: ``armature`` [kg m² or kg] and ``damping`` [N m s or N s/m], reflected through
    the gear, which MuJoCo adds to the joint's own; ``driven``: joints with an actuator. ``count``: how many there are.
    """

    joints: Container[str]
    servos: list[tuple[str, str]] = field(default_factory=list)
    armature: dict[str, float] = field(default_factory=dict)
    damping: dict[str, float] = field(default_factory=dict)
    driven: set[str] = field(default_factory=set)
    count: int = 0

    def read(self, sections: Iterable[Element], defaults: Defaults, prefix: str | None = None) -> None:
        """Add the actuators of every ``<actuator>``. Raises :class:`InvalidInput`.

        ``prefix``: what goes before the names of a document that is attached: of its actuators those that drive a joint
        which is there.
        """
        for section in sections:
            for element in section.children:
                if element.tag not in KINDS:
                    raise element.wrong(f"no kind of actuator that MJCF has; one of {', '.join(KINDS)}")
                self._add(element, defaults, prefix)

    def _add(self, element: Element, defaults: Defaults, prefix: str | None) -> None:
        joint = element.get("joint") or element.get("jointinparent")
        before = prefix or ""
        if prefix is not None and joint and before + joint not in self.joints:
            return
        self.count += 1
        chain = [at for at in defaults.chain(element) if at.tag in KINDS] + [element]
        target = before + next((element.get(name) for name in TARGETS if element.get(name)), "")
        name = before + element.get("name") if element.get("name") else f"actuator {self.count}"
        if _pulls(chain):
            self.servos.append((name, target))
        if not joint:
            return
        joint = before + joint
        self.driven.add(joint)
        gear, armature, damping = 1.0, 0.0, 0.0
        for at in chain:
            gear = float(numbers(at, "gear", (1, 6), (gear,))[0])
            armature = number(at, "armature", armature)
            powers = numbers(at, "damping", (1, 3), (damping,))
            if powers[1:].any():
                raise element.wrong("damping: powers of the rate above the first are not modelled")
            damping = float(powers[0])
        self.armature[joint] = self.armature.get(joint, 0.0) + armature * gear * gear
        self.damping[joint] = self.damping.get(joint, 0.0) + damping * gear * gear


def _pulls(chain: list[Element]) -> bool:
    """Whether an actuator's force depends on the motion where its control is zero.

    Its force is gain·ctrl + bias; ``bias`` here: b₀ + b₁·length + b₂·velocity, of the last element's kind. Every kind
    of actuator writes into the same numbers, from the defaults' outermost class inwards.
    """
    gain, affine, bias = 1.0, False, [0.0, 0.0, 0.0]
    other = False  # a bias of a kind that is not affine
    for at in chain:
        kind = at.tag
        if kind == "general":
            gain = float(numbers(at, "gainprm", (1, MOST_COEFFICIENTS), (gain,))[0])
            given = numbers(at, "biasprm", (1, MOST_COEFFICIENTS), bias).tolist()[:3]
            bias = given + bias[len(given) :]
            named = at.get("biastype")
            if named:
                affine, other = named == "affine", named not in ("none", "affine")
        elif kind in ("position", "intvelocity", "orientation", "pid"):
            gain = number(at, "kp", -bias[1] if kind == "pid" else gain)
            ratio = number(at, "kv", number(at, "dampratio", -bias[2]))
            bias, affine, other = [bias[0], -gain, -ratio], True, False
        elif kind == "velocity":
            gain = number(at, "kv", gain)
            bias, affine, other = [0.0, 0.0, -gain], True, False
        elif kind == "cylinder":
            bias, affine, other = numbers(at, "bias", 3, bias).tolist(), True, False
        elif kind == "dcmotor":
            affine, other = False, other or bool(numbers(at, "motorconst", (1, 2), (0.0,)).any())
        else:
            gain = 1.0 if kind == "motor" else gain
            affine, other = False, kind in ("muscle", "plugin")
    return other or (affine and any(bias))
