"""A finding: a cause, where it is, and what was measured; and the causes by their stable codes."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from ..models.mechanism import Mechanism

CAUSES: dict[str, str] = {
    "armature": "a rotor's inertia on the hinge, which resists the relative acceleration",
    "damping": "a torque against the hinge's relative rate",
    "damping-ignored": "the model says damping and the engine's equations of motion have none",
    "dry-friction": "a torque of constant size against the hinge's relative rate",
    "friction-ignored": "the model says dry friction and the engine's equations of motion have none",
    "stiffness": "a spring on the hinge",
    "stiffness-ignored": "the model says a spring and the engine's equations of motion have none",
    "spring-reference": "a spring that rests at another angle",
    "joint-limit": "a hinge that stops",
    "mass": "a mass of another value",
    "length": "a length of another value",
    "inertia": "an inertia of another value",
    "gravity": "gravity of another strength",
    "gravity-turned": "gravity in another direction",
    "com-displaced": "a centre of mass elsewhere",
    "inertial-com-rotated": "a centre of mass turned along with the inertia tensor's axes",
    "urdf-inertial-rpy-lost": "an inertia tensor whose rotation was dropped",
    "fused-static-frame": "bodies fixed together, fused in the wrong frame",
    "inertia-from-geoms": "mass and inertia taken from the geoms, not from the inertial",
    "inertial-ignored": "inertials passed over for default ones",
    "point-mass-patched": "a point mass that was given an inertia",
    "inertia-rejected": "an inertial that the engine refuses",
    "degree-vs-radian": "degrees taken for radians, or radians for degrees",
    "angle-convention": "relative angles taken for absolute ones, or angles counted from elsewhere or the other way",
    "joint-order": "the coordinates of joints exchanged",
    "joint-dropped-by-parser": "a joint that the engine does not have",
    "joint-added": "a joint that is not asked for",
    "continuous-joint-not-normalised": "a joint's (cos, sin) pair that is not of length one",
    "colliding-geoms": "geoms that touch and push",
    "float32": "single precision",
    "implicit-damping": "a time step that treats damping implicitly",
    "first-order-integrator": "a time stepping scheme of first order",
    "constraint-dissipation": "energy that is lost, or lengths that drift, in keeping constraints",
    "stale-derived-state": "one time step late",
    "silent-reset": "a state that was put back to the start after instability",
    "theory-is-wrong": "all engines agree, and the theory alone differs",
    "chaos-only": "the same equations of motion; small errors grow",
    "unexplained": "none of the known causes fits",
}


@dataclass(frozen=True)
class Finding:
    """``cause``: a code of :data:`CAUSES`; ``where``: joint, link or engine; ``measured`` and ``expected``: numbers
    where they are, else words; ``says``: the whole in a sentence."""

    cause: str
    where: str
    measured: float | str | None
    expected: float | str | None
    says: str

    def to_json(self) -> dict[str, Any]:
        """For ``furiko diagnose --json``."""
        return asdict(self)


UNITS = {
    "mass": "kg",
    "inertia": "kg m²",
    "armature": "kg m²",
    "damping": "N m s",
    "friction": "N m",
    "stiffness": "N m",
    "preload": "N m",
    "rest": "rad",
    "com": "m",
    "length": "m",
    "gravity": "m/s²",
}


def joint_label(mechanism: Mechanism, i: int) -> str:
    """A hinge by its number and, where that is not the same, the file's name."""
    name = mechanism.hinges[i].name
    own = name.removeprefix("hinge").lstrip("0") == str(i + 1) or not name
    return f"joint {i + 1}" if own else f"joint {i + 1} ({name!r})"


def link_label(mechanism: Mechanism, i: int) -> str:
    """A link by its number and, where that is not the same, the file's name."""
    name = mechanism.link_names[i]
    own = name.removeprefix("link").lstrip("0") == str(i + 1) or not name
    return f"link {i + 1}" if own else f"link {i + 1} ({name!r})"


def rounded(value: float, spread: float = 0.0) -> str:
    """A number with the digits that its uncertainty leaves."""
    if not math.isfinite(value) or value == 0:
        return f"{value:g}"
    if spread <= 0 or spread < 1e-15 * abs(value):
        return _plain(value)
    digits = max(3, min(15, math.ceil(math.log10(abs(value) / spread)) + 1))
    return f"{value:.{digits}g} ± {spread:.1g}"


def _plain(value: float) -> str:
    short = f"{value:.4f}"
    if 1e-3 <= abs(value) < 1e6 and abs(float(short) - value) <= 1e-12 * abs(value):
        return short
    return f"{value:.12g}"


DEGREE = 180 / math.pi


def degrees_for_radians(ratio: float) -> bool:
    """Whether a ratio is that of a radian to a degree, or the inverse."""
    return any(abs(abs(ratio) / unit - 1) < 1e-6 for unit in (DEGREE, 1 / DEGREE))
