"""What an adapter's numbers mean: units, signs, order, absolute or relative, one question at a time.

For accelerations the hypotheses of :mod:`furiko.diagnosis` are tried; for the other questions each hypothesis here is
the right answer with one thing mixed up, and is named where it gives what the adapter gave.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...diagnosis.explain import explanation
from ...diagnosis.explanation import Explanation
from ...models.coordinates import absolute_from_relative
from ...models.systems import DocumentSystem
from ...records.listings import ConformanceStep
from ...reference import centrifugal_matrix, energies, gravity_vector, joint_forces, literal_accelerations, mass_matrix
from .subject import GROSS, MECHANISMS, Array, Subject, Wrong, apart, array, right, states

SINGLE = 2.0**-23
# Causes that lie in how an adapter asks and answers, with what to change.
ADAPTERS_OWN = {
    "angle-convention": "furiko's angles, rates and accelerations are absolute, from the downward vertical, counter-"
    "clockwise positive: furiko.engines.coordinates.RelativeCoordinates converts.",
    "degree-vs-radian": "All angles are in rad, both ways.",
    "joint-order": "Index i is link i of system.tree().links, parents before children: look joints up by name.",
    "stale-derived-state": "Compute, then read: the engine's data are those of the state before.",
    "joint-dropped-by-parser": "Look at what the engine compiled: it has fewer joints than system.tree().links.",
    "joint-added": "Look at what the engine compiled: it has more joints than system.tree().links.",
    "massless-link": "A mass does not reach the engine.",
    "gravity": "Set the engine's gravity from system.gravity.",
    "gravity-turned": "Gravity is along -z; the plane of motion is x-z.",
    "velocity-terms-forgotten": "The rates do not reach the engine: set them, and see that they are not reset.",
    "damping": "Switch off what the engine adds: the mechanism has no damping.",
    "dry-friction": "Switch off what the engine adds: the mechanism has no friction.",
    "armature": "Switch off what the engine adds: the mechanism has no rotors.",
    "joint-limit": "Switch off joint limits.",
    "colliding-geoms": "Switch off contacts.",
    "accelerations-scaled": "Is it a force, or another unit of time?",
}


def accelerations(subject: Subject) -> ConformanceStep:
    """The accelerations are the theory's, in its order, signs, units and angles."""
    for name, engine in subject.engines.items():
        system = MECHANISMS[name]
        theta, omega = states(system.n)
        got = array("accelerations", engine.accelerations(theta.copy(), omega.copy()), theta.shape)
        wanted = literal_accelerations(system, theta, omega)
        if apart(got, wanted) <= GROSS:
            continue
        found = explanation(_Silent(engine), system, who="it", accuracy=max(subject.info.accuracy, 1e-9), slight=False)
        raise _accused(found, name, apart(got, wanted))
    return right("accelerations", "they are the theory's, in order, sign and units, to six digits and more")


class _Silent:
    """An engine that is asked for accelerations and nothing else: what else it says is not to be trusted yet."""

    def __init__(self, engine: object) -> None:
        self._engine = engine

    def accelerations(self, theta: Array, omega: Array) -> Array:
        return np.array(self._engine.accelerations(theta.copy(), omega.copy()))  # type: ignore[attr-defined]


def _accused(found: Explanation, name: str, off: float) -> Wrong:
    size = f"for {name} they are off by {off:.3g} of the largest"
    if not found.explained:
        return Wrong(
            f"{size}, and no usual mistake of an adapter explains it",
            "Compare one rod at rest first: θ̈ = -(3/2)(g/l) sin θ for a uniform rod.",
        )
    says = "; or ".join(finding.says.removeprefix("it: ") for finding in found.all[:2])
    helps = [ADAPTERS_OWN[finding.cause] for finding in found.all[:2] if finding.cause in ADAPTERS_OWN]
    return Wrong(f"{size}: {says}", " ".join(dict.fromkeys(helps)) or "Look at how the adapter builds the model.")


def precision(subject: Subject) -> ConformanceStep:
    """The accuracy that is declared is the one there is."""
    digits = 0.0
    for name, engine in subject.engines.items():
        system = MECHANISMS[name]
        theta, omega = states(system.n, 20)
        got = array("accelerations", engine.accelerations(theta.copy(), omega.copy()), theta.shape)
        found = explanation(_Silent(engine), system, who="it", accuracy=subject.info.accuracy, slight=False)
        if any(finding.cause == "float32" for finding in found.all):
            raise Wrong(
                f"for {name} it has single precision, and {subject.info.accuracy:.2g} is declared",
                "accuracy=2.0**-23 in its EngineInfo, with accuracy_reason; or ask the engine for double precision.",
            )
        digits = max(digits, apart(got, literal_accelerations(system, theta, omega)))
    if subject.info.accuracy >= SINGLE / 2 and digits < SINGLE / 1e4:
        return right(
            "precision",
            f"{subject.info.accuracy:.2g} is declared, and its error is {digits:.2g}: mistakes would pass",
            "note",
            "Leave accuracy out: 2.0**-52 is the default.",
        )
    return right("precision", f"off by {digits:.2g} at most; {subject.info.accuracy:.2g} for one operation is declared")


def inverse_dynamics(subject: Subject) -> ConformanceStep:
    """Torques conjugate to absolute angles, with gravity and without."""
    for name, engine in subject.engines.items():
        system = MECHANISMS[name]
        theta, omega = states(system.n)
        alpha = states(system.n, seed=9)[0]
        for gravity in (True, False):
            got = array(
                "inverse_dynamics",
                engine.inverse_dynamics(theta.copy(), omega.copy(), alpha.copy(), gravity=gravity),
                theta.shape,
            )
            wanted = _torques(system, theta, omega, alpha, gravity)
            _compare("inverse_dynamics", name, got, wanted, _torque_mistakes(system, theta, omega, alpha, gravity))
    return right("inverse dynamics", "torques are conjugate to absolute angles, with gravity and without")


def _torques(system: DocumentSystem, theta: Array, omega: Array, alpha: Array, gravity: bool = True) -> Array:
    torque = (
        mass_matrix(system, theta) @ alpha[..., None] + centrifugal_matrix(system, theta) @ omega[..., None] ** 2
    )[..., 0]
    return np.asarray(torque + gravity_vector(system, theta) if gravity else torque)


Mistake = tuple[str, str, Array]


def _torque_mistakes(
    system: DocumentSystem, theta: Array, omega: Array, alpha: Array, gravity: bool
) -> Iterator[Mistake]:
    wanted = _torques(system, theta, omega, alpha, gravity)
    turned = absolute_from_relative(system.tree().parents)
    weight = gravity_vector(system, theta)
    yield "they have the opposite sign", "τ is what the accelerations need: M θ̈ + … = τ.", -wanted
    yield (
        "they are the relative joint torques",
        "RelativeCoordinates.absolute_forces makes them those of absolute angles.",
        wanted @ turned,
    )
    yield "they are converted twice", "Convert them once.", wanted @ np.linalg.inv(turned)
    if gravity:
        yield "gravity is left out", "With gravity=True it is in.", wanted - weight
        yield "gravity has the wrong sign", "The gravity terms are +m g l sin θ on the left.", wanted - 2 * weight
    else:
        yield "gravity is in, although gravity=False", "Leave it out: the keyword is not looked at.", wanted + weight
    yield "the accelerations are not in", "M θ̈ is a part.", _torques(system, theta, omega, 0 * alpha, gravity)
    yield "the rates are not in", "All terms with ω² are a part.", _torques(system, theta, 0 * omega, alpha, gravity)
    yield (
        "alpha is taken for relative accelerations",
        "Convert alpha as theta and omega.",
        _torques(system, theta, omega, alpha @ turned.T, gravity),
    )


def forces(subject: Subject) -> ConformanceStep:
    """The force of each link on its parent, (x, z)."""
    for name, engine in subject.engines.items():
        system = MECHANISMS[name]
        theta, omega = states(system.n)
        alpha = literal_accelerations(system, theta, omega)
        got = array("joint_forces", engine.joint_forces(theta.copy(), omega.copy(), alpha.copy()), (*theta.shape, 2))
        wanted = joint_forces(system, theta, omega, alpha)
        _compare("joint_forces", name, got, wanted, _force_mistakes(system, theta, wanted))
    return right("joint forces", "each is that of a link on its parent, as (x, z) in the world")


def _force_mistakes(system: DocumentSystem, theta: Array, wanted: Array) -> Iterator[Mistake]:
    yield "they have the opposite sign", "It is the force that the link exerts on its parent.", -wanted
    yield "x and z are exchanged", "The last axis is (x, z).", wanted[..., ::-1]
    yield "they come in the reverse order", "Row i is the hinge of link i.", wanted[:, ::-1]
    yield "x has the wrong sign", "x is to the right, z up.", wanted * [-1.0, 1.0]
    yield "z has the wrong sign", "x is to the right, z up.", wanted * [1.0, -1.0]
    cos, sin = np.cos(theta), np.sin(theta)
    x, z = wanted[..., 0], wanted[..., 1]
    for sign in (1.0, -1.0):
        turned = np.stack([cos * x + sign * sin * z, cos * z - sign * sin * x], axis=-1)
        for flip in (turned, -turned):
            yield "they are in the links' own frames", "Turn them into the world's axes.", flip


def energy(subject: Subject) -> ConformanceStep:
    """Kinetic energy, and potential energy with its zero at the support's height."""
    for name, engine in subject.engines.items():
        system = MECHANISMS[name]
        theta, omega = states(system.n)
        got = array("energy", engine.energy(theta.copy(), omega.copy()), (len(theta), 2))
        kinetic, potential = energies(system, theta, omega)
        wanted = np.stack([kinetic, potential], axis=-1)
        _compare("energy", name, got, wanted, _energy_mistakes(got, kinetic, potential))
    return right("energy", "kinetic and potential, the latter zero at the support's height")


def _energy_mistakes(got: Array, kinetic: Array, potential: Array) -> Iterator[Mistake]:
    def pair(one: Array, other: Array) -> Array:
        return np.stack([one, other], axis=-1)

    total = kinetic + potential
    yield "kinetic and potential energy are exchanged", "Kinetic comes first.", pair(potential, kinetic)
    yield "the potential energy has the wrong sign", "It grows with height.", pair(kinetic, -potential)
    yield "the second is the total energy", "It is the potential energy alone.", pair(kinetic, total)
    yield "the first is the total energy", "It is the kinetic energy alone.", pair(total, potential)
    yield "the second is the Lagrangian", "It is the potential energy alone.", pair(kinetic, kinetic - potential)
    for factor in (2.0, 0.5):
        yield f"the kinetic energy is {factor:g} times what it is", "½ ω·M ω.", pair(factor * kinetic, potential)
    yield (
        "the potential energy is off by a constant",
        "It is zero where all mass is at the support's height, z = 0.",
        pair(kinetic, potential + (got[:, 1] - potential).mean()),
    )


def _compare(quantity: str, name: str, got: Array, wanted: Array, mistakes: Iterator[Mistake]) -> None:
    if apart(got, wanted) <= GROSS:
        return
    size = f"{quantity}: for {name} off by {apart(got, wanted):.3g} of the largest"
    for says, help_, mistaken in mistakes:
        if apart(got, mistaken) <= GROSS:
            raise Wrong(f"{size}: {says}", help_)
    raise Wrong(
        f"{size}, and no usual mistake of an adapter explains it",
        f"See {quantity} in furiko.engines.protocol; or name it in info.missing until it is right.",
    )


def fields(subject: Subject) -> ConformanceStep:
    """The model as it was compiled, in the terms that furiko asks for."""
    for name, engine in subject.engines.items():
        tree, got = MECHANISMS[name].tree(), engine.fields()
        n, links = len(tree.links), tree.links
        if got.dofs != n:
            raise Wrong(f"fields: for {name} there are {got.dofs} degrees of freedom, and {n} links", "One a link.")
        if tuple(got.parents) != tree.parents:
            raise Wrong(
                f"fields: for {name} parents are {tuple(map(int, got.parents))}, expected {tree.parents}",
                "Index of each link's parent among the links, -1 for the support.",
            )
        each: dict[str, tuple[Array, tuple[int, ...], str]] = {
            "hinges": (np.array([link.hinge for link in links]), (n, 2), "in the frame of the parent, (along, across)"),
            "centres": (np.array([link.com for link in links]), (n, 2), "in the link's own frame, (along, across)"),
            "masses": (np.array([link.mass for link in links]), (n,), "in kg"),
            "inertias": (np.array([link.inertia for link in links]), (n,), "about the centre of mass, in kg m²"),
            "gravity": (np.array([0.0, 0.0, -MECHANISMS[name].gravity]), (3,), "the vector (x, y, z), z up"),
            "armature": (np.zeros(n), (n,), "0 for every hinge"),
            "damping": (np.zeros(n), (n,), "0 for every hinge"),
        }
        for field, (wanted, shape, what) in each.items():
            values = array(f"fields: {field}", getattr(got, field), shape)
            if np.abs(values - wanted).max() > GROSS * max(float(np.abs(wanted).max()), 1e-3):
                raise Wrong(
                    f"fields: for {name} {field} are {_short(values)}, expected {_short(wanted)}",
                    f"They are {what}.{_about_hinge(field, values, name)}",
                )
    return right("fields", "the compiled model is the mechanism")


def _about_hinge(field: str, values: Array, name: str) -> str:
    links = MECHANISMS[name].tree().links
    about = np.array([link.inertia + link.mass * (link.com[0] ** 2 + link.com[1] ** 2) for link in links])
    return " These are about the hinge." if field == "inertias" and apart(values, about) <= GROSS else ""


def _short(values: Array) -> str:
    return np.array2string(values, precision=4, separator=", ", max_line_width=200).replace("\n", "")
