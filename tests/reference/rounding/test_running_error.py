"""The proven bounds against a second derivation: running error analysis of the operations themselves.

What each operation may add at worst, operation by operation, is never more than the bound that is derived from
magnitudes alone; and never less than a tenth of it in all of these mechanisms, so that a bound that is ten times too
wide or too narrow is noticed. Short mechanisms only: running errors are turned from frame to frame as their magnitudes,
which grows with each link.
"""

from functools import cache

import numpy as np
import pytest
from running_error import Running

from furiko.checks.comparisons.energy import energy_amplitudes
from furiko.models import NLegPendulum, RodChain
from furiko.reference import literal_accelerations
from furiko.reference.rounding import link_frames, tree_frame
from furiko.reference.rounding.bounds import EPSILON, allowed, amplitudes

SYSTEMS = (
    RodChain((0.7,)),
    RodChain((1.0, 0.6)),
    RodChain((1.0, 0.6, 0.8)),
    NLegPendulum((1.0, 0.5), (1.0, 2.0)),
    NLegPendulum((1.0, 0.5, 0.8), (1.0, 2.0, 0.3)),
)
STATES = 60


def relative(tree, absolute):
    return [
        value - (absolute[parent] if parent >= 0 else 0) for value, parent in zip(absolute, tree.parents, strict=True)
    ]


def error(number):
    """Absolute, at worst."""
    return number.error * EPSILON / 2 if isinstance(number, Running) else 0.0


def inverse_dynamics(tree, moments, theta, omega, alpha, gravity):
    """Torques about the hinges, forces through them, and places of the links, each with what it may be off by."""
    angles = [Running.rounded(q) for q in relative(tree, theta)]
    rates, accelerations = (
        [Running.rounded(x) if x else 0.0 for x in relative(tree, values)] for values in (omega, alpha)
    )
    if moments == "tree":
        at = tree_frame.Placed(tree, [((0.5 * q).sin(), (0.5 * q).cos()) for q in angles])
        torques, forces = tree_frame.inverse_dynamics(tree, at, rates, accelerations, gravity=Running(gravity))
        return torques, forces, at
    turns = link_frames.joint_turns(angles, [link.hinge for link in tree.links])
    forces = link_frames.inverse_dynamics(
        tree, turns, rates, accelerations, gravity=Running(gravity), rounded=Running.rounded
    )
    return [force.w for force in forces], forces, turns


def in_absolute_angles(tree, torques):
    found = list(torques)
    for i, parent in enumerate(tree.parents):
        if parent >= 0:
            found[parent] = found[parent] - torques[i]
    return np.array([error(torque) for torque in found])


def energies(tree, moments, at, omega):
    """Kinetic energy (0.0 where it is had from the mass matrix) and potential energy."""
    kinetic, depths = Running(0.0), at.depths if moments == "tree" else link_frames.depths(tree, at)
    if moments == "hinge":
        rates = [Running.rounded(rate) for rate in relative(tree, omega)]
        for i, v in enumerate(link_frames.velocities(tree, at, rates)):
            force = link_frames.rigid_inertia(tree, i, Running.rounded).times(v)
            kinetic = kinetic + (v.w * force.w + v.x * force.x + v.y * force.y)
    weight = Running(0.0)
    for link, depth in zip(tree.links, depths, strict=True):
        weight = weight + link.mass * depth
    return 0.5 * kinetic, tree.gravity * weight


def quotients(system, moments, theta, omega):
    """By quantity: the largest of its entries' worst errors over their bounds, in one state."""
    tree, n = system.tree(), system.n
    amplitude, bound = amplitudes(system, "relative", moments=moments), EPSILON * allowed(n)
    alpha, rest = literal_accelerations(system, theta, omega), np.zeros(n)

    def torques(omega, alpha, gravity):
        return in_absolute_angles(tree, inverse_dynamics(tree, moments, theta, omega, alpha, gravity)[0])

    own, forces, at = inverse_dynamics(tree, moments, theta, omega, alpha, system.gravity)
    units, velocity = np.eye(n), amplitude.absolute_rows(amplitude.velocity_terms(np.eye(n))).T
    pairs = {
        "residual": ([error(torque) for torque in own], amplitude.rows(alpha[None], omega[None])[0]),
        "joint forces": (
            [np.hypot(error(force.x), error(force.y)) for force in forces],
            amplitude.forces(alpha[None], omega[None])[0],
        ),
        "M": (np.transpose([torques(rest, unit, 0.0) for unit in units]), amplitude.entries()),
        "C": (np.transpose([torques(unit, rest, 0.0) for unit in units]), velocity),
        "G": (torques(rest, rest, system.gravity), amplitude.absolute_rows(amplitude.weights)),
        "velocity": (
            torques(omega, rest, 0.0),
            amplitude.absolute_rows(amplitude.velocity_terms(omega[None]))[0],
        ),
    }
    kinetic, potential = energies(tree, moments, at, omega)
    scale = energy_amplitudes(tree, amplitude, omega[None])[0]
    pairs["potential energy"] = error(potential), scale[1]
    if moments == "hinge":
        pairs["kinetic energy"] = error(kinetic), scale[0]
    return {name: float((np.array(worst) / (bound * np.array(size))).max()) for name, (worst, size) in pairs.items()}


@cache
def worst(moments):
    random = np.random.default_rng(5)
    found = {}
    for system in SYSTEMS:
        for _ in range(STATES):
            theta, omega = random.uniform(-np.pi, np.pi, system.n), random.normal(0, 3, system.n)
            for name, value in quotients(system, moments, theta, omega).items():
                found[name] = max(found.get(name, 0.0), value)
    return found


QUANTITIES = ("residual", "joint forces", "M", "C", "G", "velocity", "potential energy")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("moments", "quantity"),
    [(moments, name) for moments in ("hinge", "tree") for name in QUANTITIES] + [("hinge", "kinetic energy")],
)
def test_no_bound_is_ten_times_too_wide_or_too_narrow(moments, quantity):
    assert 0.1 < worst(moments)[quantity] <= 1
