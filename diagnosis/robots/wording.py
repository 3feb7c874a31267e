"""Differences between an engine and a file as findings: one a cause, with the numbers, the place and what to write."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from ..finding import Finding
from .numbers import FieldDifference

MOST_PLACES = 6  # named in one finding
DIGITS = (6, 9, 12, 17)  # of numbers: the first at which what was found and expected can be told apart
APPLIED = "apply the damping in your own code, or, if it comes from a default class only, write <freejoint>"
# What to write so that all engines read the file alike, by the mistake that is made otherwise.
INSTEAD: Mapping[str, str] = {
    "first_root_only": "put all bodies of the world without a free joint into one body, and free ones into other files",
    "geoms_without_contact_weigh_nothing": "give the body an <inertial>",
    "pose_of_first_fixed_body_dropped": "leave the body out and place what it carries in the world",
    "mesh_weighs_one_kilogram": "give the body an <inertial>",
    "inertial_without_inertia_is_unit": "write diaginertia or fullinertia",
    "first_worldbody_again": "put all bodies into one <worldbody>",
    "default_joint_pos_dropped": "write pos on the joint itself",
    "default_geom_mass_dropped": "write mass on the geom itself, or give the body an <inertial>",
    "total_mass_ignored": "write the scaled masses and inertias into <inertial> elements and leave settotalmass out",
    "inertia_group_ignored": "give the body an <inertial>",
    "balance_inertia_ignored": "write the balanced inertia into <inertial>",
    "bound_inertia_on_given_axes": "write the inertia that is meant into <inertial>",
    "bound_ignored": "write the mass and inertia that are meant into <inertial>",
    "upper_euler_as_lower": "write quat in place of euler",
    "axis_not_normalised": "write quat in place of axisangle, or the axis with all its digits, of length one",
    "include_not_followed": "write the included elements into the file",
    "later_sections_ignored": "put all that several <compiler> or <default> say into the first",
    "late_sections_ignored": "put <compiler> and <default> before <worldbody>",
    "bodies_in_frames_lost": "leave the <frame> out and write each body's own pose",
    "bare_bodies_lost": "give each body a name",
    "unnamed_sibling_twice": "give each body a name",
    "first_ref_ignored": "write ref='0' and the pose at zero into the body",
    "springdamper_ignored": "write the joint's stiffness and damping",
    "damping_dropped_on_free_and_ball": APPLIED,
    "damping_dropped_on_free": APPLIED,
    "pos_of_last_joint_for_all": "put each joint into a body of its own",
    "armature_needs_actuator": "add an actuator to the joint, or set the armature in the engine",
    "nested_class_inherits_nothing": "repeat the element in the nested class",
    "space_behind_number_rejected": "write the number without the space behind it",
    "align_ignored": "write align='false', and the body's frame at its centre of mass, along its principal axes",
    "frame_ignored": "write each body's own pose in place of <frame>, and the copies in place of <replicate>",
    "attach_ignored": "write the bodies out in place of <attach>",
}


@dataclass(frozen=True)
class Places:
    """Where a file has its joints and bodies: element and line by the ``where`` of a difference."""

    lines: Mapping[str, str]

    def of(self, difference: FieldDifference) -> str:
        """The element and line, or nothing where the file has none."""
        return self.lines.get(difference.where, "")


def mistake_finding(engine: str, flag: str, says: str, changes: Sequence[FieldDifference], places: Places) -> Finding:
    """A mistake in reading, which furiko's own reader has made to read what the engine holds."""
    first = changes[0]
    line = places.of(first)
    at = f" ({line})" if line else ""
    sentence = f"{engine} {says}: {_numbers(changes)}{at}" + instead(flag)
    return Finding(
        flag.replace("_", "-"), f"{engine}: {first.where}", _plain(first.found), _plain(first.expected), sentence
    )


def instead(flag: str) -> str:
    """What to write so that no engine makes this mistake, as the end of a sentence; nothing where that is not known."""
    return f". Instead, {INSTEAD[flag]}" if flag in INSTEAD else ""


def field_findings(
    engine: str, differences: Iterable[FieldDifference], places: Places, asked: str = "the file"
) -> list[Finding]:
    """Numbers that no known mistake explains, one finding a cause. ``asked``: what says how they should be."""
    by_cause: dict[str, list[FieldDifference]] = {}
    for difference in differences:
        by_cause.setdefault(difference.cause, []).append(difference)
    found = []
    for cause, alike in by_cause.items():
        first = alike[0]
        line = places.of(first)
        says = f"{engine}: {_numbers(alike, asked)}" + (f" ({line})" if line else "")
        found.append(Finding(cause, f"{engine}: {first.where}", _plain(first.found), _plain(first.expected), says))
    return found


def _numbers(differences: Sequence[FieldDifference], asked: str = "the file") -> str:
    """What was found and expected, place by place."""
    shown = [_one(difference, asked) for difference in differences[:MOST_PLACES]]
    more = len(differences) - len(shown)
    return "; ".join(shown) + (f"; and {more} more" if more > 0 else "")


def _one(difference: FieldDifference, asked: str) -> str:
    if difference.cause == "joint-dropped-by-parser":
        return f"{difference.where} ({difference.expected}) is missing"
    if difference.cause == "joint-added":
        return f"{difference.where} ({difference.found}) is not in {asked}"
    unit = f" {difference.unit}" if difference.unit else ""
    digits = next((n for n in DIGITS if _shown(difference.found, n) != _shown(difference.expected, n)), DIGITS[0])
    found, expected = _shown(difference.found, digits), _shown(difference.expected, digits)
    return f"{difference.where}: {difference.field} {found}{unit}, {asked} says {expected}{unit}"


def _shown(value: object, digits: int) -> str:
    if isinstance(value, float):
        return f"{value:.{digits}g}"
    if isinstance(value, list):
        return "(" + ", ".join(f"{v:.{digits}g}" for v in value) + ")"
    return str(value)


def _plain(value: object) -> float | str | None:
    if isinstance(value, float | int) and not isinstance(value, bool):
        return float(value)
    if isinstance(value, list):
        return "(" + ", ".join(f"{v!r}" for v in value) + ")"
    return None if value is None else str(value)
