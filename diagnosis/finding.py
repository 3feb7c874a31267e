"""A finding: a cause, where it is, and what was measured; and the causes by their stable codes."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from ..models.mechanism import Mechanism
from ..models.readers.rules import mistakes_in

CAUSES: dict[str, str] = {
    "armature": "a rotor's inertia on the hinge, which resists the relative acceleration",
    "damping": "a torque proportional to the hinge's relative rate, and against it",
    "damping-ignored": "the model has damping, the engine's equations of motion have none",
    "dry-friction": "a torque of constant magnitude against the hinge's relative rate",
    "friction-ignored": "the model has dry friction, the engine's equations of motion have none",
    "stiffness": "a spring on the hinge",
    "stiffness-ignored": "the model has a spring, the engine's equations of motion have none",
    "spring-reference": "a spring at rest at another angle",
    "joint-limit": "another range of a joint, or a limit where none is expected",
    "mass": "another mass",
    "density": "all masses and inertias by one factor",
    "rods-as-point-masses": "point masses at the links' ends in place of rods",
    "point-masses-as-rods": "uniform rods in place of point masses",
    "massless-link": "a link without mass",
    "length": "another length",
    "inertia": "another inertia",
    "gravity": "another strength of gravity",
    "gravity-turned": "another direction of gravity",
    "com-displaced": "another centre of mass",
    "inertial-com-rotated": "the centre of mass is rotated together with the axes of the inertia tensor",
    "urdf-inertial-rpy-lost": "the rotation of the inertia tensor is ignored",
    "fused-static-frame": "bodies that are fixed to each other are merged in the wrong frame",
    "inertia-from-geoms": "mass and inertia come from the geoms, not from the inertial",
    "inertial-ignored": "the inertial is ignored and default values are used",
    "point-mass-patched": "a point mass has been given an inertia",
    "inertia-rejected": "the engine refuses an inertial",
    "degree-vs-radian": "degrees are used as radians, or radians as degrees",
    "angle-convention": "relative angles are used as absolute ones, or angles have another zero or another sign",
    "joint-order": "the joints' coordinates are in another order",
    "joint-dropped-by-parser": "an expected joint is missing",
    "joint-type": "a joint of another kind",
    "joint-axis": "another axis of a joint",
    "joint-placement": "another place of a joint",
    "joint-orientation": "another orientation of the body that a joint moves",
    "joint-reference": "another coordinate of a joint in the reference configuration",
    "body-placement": "another place of a body that is fixed to its link",
    "body-orientation": "another orientation of a body that is fixed to its link",
    "file-refused": "the engine refuses the file",
    "joint-added": "there is a joint that is not expected",
    "continuous-joint-not-normalised": "the pair (cos, sin) of a joint is not of length one",
    "colliding-geoms": "geoms are in contact and push each other",
    "velocity-terms-sign": "every term with squared rates has the wrong sign",
    "velocity-terms-forgotten": "the terms with squared rates are missing",
    "accelerations-scaled": "accelerations are a multiple of the right ones",
    "derivative-sign": "a matrix of derivatives, or an inverse, has the opposite sign",
    "derivative-transposed": "a matrix of derivatives is transposed",
    "derivative-of-forces": "derivatives of forces stand where those of accelerations are expected",
    "derivative-lacks-term": "a share of the derivatives is missing",
    "derivatives-of-others": "derivatives are not those of the engine's own accelerations, which are right",
    "derivatives-exchanged": "derivatives by rates stand where those by positions are expected, or the reverse",
    "mass-matrix-for-inverse": "the mass matrix stands where its inverse is expected",
    "one-acceleration-wrong": "one acceleration is wrong, the others are right",
    "sign": "a term has the wrong sign",
    "term-missing": "a term is missing",
    "term-wrong": "a term has a wrong factor",
    "factor-two": "a term has a factor 2 too many",
    "factor-half": "a term has a factor ½ too many",
    "length-missing": "a term lacks a length",
    "length-too-many": "a term has a length too many",
    "mass-missing": "a term lacks a mass",
    "mass-too-many": "a term has a mass too many",
    "g-missing": "a gravity term lacks g",
    "sin-for-cos": "sin stands where cos is expected",
    "cos-for-sin": "cos stands where sin is expected",
    "angle-sum": "the sum of two angles stands where their difference is expected",
    "rate-product": "a product of two rates stands where a square is expected",
    "square-missing": "a rate stands where its square is expected",
    "wrong-rate": "another link's rate is squared",
    "wrong-acceleration": "another link's acceleration is multiplied",
    "free-armature-in-body-axes": "the armature of a free joint acts along the body's axes, not the world's",
    "joints-out-of-order": "joints are not numbered subtree by subtree, and the mass matrix lacks entries",
    "servo": "an actuator pulls although its control is zero",
    "coarse-time-step": "the file's time step is too long for its integrator",
    "float32": "single precision",
    "implicit-damping": "the time step treats damping implicitly",
    "first-order-integrator": "the integration scheme is of first order",
    "constraint-dissipation": "energy is lost, or lengths drift, where constraints are enforced",
    "stale-derived-state": "results are one time step late",
    "silent-reset": "the engine resets the state after an instability and does not report it",
    "theory-is-wrong": "all engines agree with one another and differ from furiko's reading",
    "chaos-only": "the same equations of motion; small errors grow",
    "unexplained": "no known cause fits",
}


# A mistake in reading a file, by the flag of furiko's own reader that makes it.
CAUSES |= {
    flag.replace("_", "-"): f"an engine that {says}"
    for flag, says in [*mistakes_in("mjcf").items(), *mistakes_in("urdf").items()]
}


@dataclass(frozen=True)
class Finding:
    """``cause``: a code of :data:`CAUSES`; ``where``: joint, link or engine; ``measured`` and ``expected``: numbers in
    SI units where possible, else words; ``says``: all of it in one sentence."""

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
    "stiffness": "N m/rad",
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
