"""MJCF's joints: hinge, slide, ball and free, with their springs, dampers, dry friction and limits."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ...spatial_mechanism import Joint
from ..attributes import Array, not_negative, number, numbers, word
from ..placement import Placement
from ..xml_file import Element
from .options import Compiler, Options

KINDS = ("hinge", "slide", "ball", "free")


def read_joint(full: Element, given: Element, frame: Placement, compiler: Compiler, options: Options) -> Joint:
    """The joint ``given``, which has a name; ``full`` is the same element with its defaults.

    ``frame``: where the frames that it stands in are in its body. Raises :class:`InvalidInput`.
    """
    kind = "free" if given.tag == "freejoint" else word(full, "type", KINDS, "hinge")
    _refuse_what_is_not_linear(full, given)
    turns = kind == "hinge"
    single = kind in ("hinge", "slide")
    joint = Joint(
        name=given.get("name"),
        kind=kind,
        axis=frame.pose.rotation @ _axis(full) if single else np.array([0.0, 0.0, 1.0]),
        anchor=frame.pose.point(numbers(full, "pos", 3, (0.0,) * 3)) if kind != "free" else np.zeros(3),
        ref=_coordinate(full, "ref", turns, compiler) if single else 0.0,
        armature=not_negative(full, "armature"),
        damping=options.enabled(_coefficient(full, "damping"), "damper", "passive"),
        friction=options.enabled(not_negative(full, "frictionloss"), "frictionloss", "constraint"),
        stiffness=options.enabled(_coefficient(full, "stiffness"), "spring", "passive"),
        springref=_coordinate(full, "springref", turns, compiler) if single else 0.0,
        limits=None if options.disabled & {"limit", "constraint"} else _limits(full, kind, compiler),
        where=str(given),
    )
    rules = compiler.rules
    if rules.damping_dropped_on_free_and_ball and not single:
        joint = replace(joint, damping=0.0, friction=0.0)
    if rules.damping_dropped_on_free and kind == "free":
        joint = replace(joint, damping=0.0)
    if rules.springs_not_held:
        joint = replace(joint, stiffness=0.0)
    return joint


def spring_damper(full: Element) -> tuple[float, float] | None:
    """``springdamper``: time constant [s] and damping ratio; None where the joint does not have one."""
    values = numbers(full, "springdamper", 2, (0.0, 0.0))
    if not values.any():
        return None
    if (values <= 0).any():
        raise full.wrong(f"springdamper={full.get('springdamper')!r}: two positive numbers needed")
    return float(values[0]), float(values[1])


def _axis(full: Element) -> Array:
    axis = numbers(full, "axis", 3, (0.0, 0.0, 1.0))
    if math.hypot(*axis) < 1e-10:
        raise full.wrong(f"axis={full.get('axis')!r}: a direction is needed, not zero")
    return axis


def _coordinate(full: Element, attribute: str, turns: bool, compiler: Compiler) -> float:
    value = number(full, attribute)
    return compiler.angle(value) if turns else value


def _limits(joint: Element, kind: str, compiler: Compiler) -> tuple[float, float] | None:
    if kind == "free":
        return None
    limited = word(joint, "limited", ("true", "false", "auto"), "auto")
    ends = numbers(joint, "range", 2, (0.0, 0.0))
    if limited == "false" or (limited == "auto" and ("range" not in joint.attributes or not ends.any())):
        return None
    if limited == "auto" and not compiler.autolimits:
        raise joint.wrong("range without limited='true', and autolimits is off; MuJoCo refuses that: say limited")
    low, high = (float(end) if kind == "slide" else compiler.angle(float(end)) for end in ends)
    if kind == "ball":
        return 0.0, high
    if low >= high:
        raise joint.wrong(f"range={joint.get('range')!r}: the lower limit must be the smaller")
    return low, high


def _coefficient(element: Element, attribute: str) -> float:
    """The linear coefficient of a spring or damper; coefficients of higher powers after it must be zero."""
    values = numbers(element, attribute, (1, 3), (0.0,))
    if values[0] < 0:
        raise element.wrong(f"{attribute}={element.get(attribute)!r}: a number that is not negative is needed")
    if values[1:].any():
        what = {"stiffness": "spring", "damping": "damper"}[attribute]
        raise element.wrong(
            f"{attribute}={element.get(attribute)!r}: a {what} that is not linear (the numbers after the first are "
            f"coefficients of higher powers), which furiko does not have; write {attribute}='{values[0]:g}' to compare "
            "the rest"
        )
    return float(values[0])


def _refuse_what_is_not_linear(full: Element, given: Element) -> None:
    if number(full, "springyield") > 0:
        raise given.wrong("springyield: a spring that yields; its force depends on what was before")
