"""The effect of rounding on angles and rates in one step of an engine's integrator: bounds from
:mod:`furiko.reference.rounding.bounds`'.

Every acceleration the engine evaluates has a backward error of at most that which
:mod:`furiko.reference.rounding.bounds` allows, hence a forward error of |M⁻¹| times it. An implicit scheme's iterations
leave a residual of their tolerance on top, and in maximal coordinates the joints are held together no better than that.

For the sharp line the same is sampled (:mod:`furiko.reference.rounding.stepped`): the accelerations' spread, the last
digits of angles and rates, and of the joints' constraints; what iterations leave comes besides, as large as their
tolerance allows it. Of the joints' positions they mostly leave far less, since the last iteration ends well below the
tolerance, and at times as much as that. How much, the engine shows: :func:`joints_left_apart`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...engines import Integrator
from ...models.units import in_units, units_of
from ...reference import mass_matrix
from ...reference.integration.schemes import RADIUS, alpha_parameters
from ...reference.maximal_coordinates import MaximalCoordinates
from ...reference.rounding import spread
from ...reference.rounding.bounds import EPSILON, allowed, turns
from ...reference.rounding.iterations import left_in_accelerations, left_in_maximal_coordinates
from ...reference.rounding.maximal_elimination import joint_spread
from ...reference.rounding.monte_carlo import ONE_ROUNDING
from ...reference.rounding.norms import norm
from ...reference.rounding.stepped import Ends, stepped
from .. import sharp
from ..cell import Cell, EngineFault
from .textbook import MAXIMAL, Candidate

Array = NDArray[np.float64]


def acceleration_error(cell: Cell, integrator: Integrator, theta: Array, omega: Array, alpha: Array) -> Array:
    """Forward error [rad/s²] of the accelerations that a step is made of at each state, (B,)."""
    return rounding_error(cell, theta, omega, alpha) + iterations_error(cell, integrator, theta, omega, alpha)


def rounding_error(cell: Cell, theta: Array, omega: Array, alpha: Array) -> Array:
    """Forward error [rad/s²] of the engine's accelerations at each state, (B,): backward error times |M⁻¹|."""
    backward = EPSILON * allowed(cell.scene.system.n, cell.info.accuracy) * _rows(cell, theta, omega, alpha)
    return _answer(cell, theta, backward)


def iterations_error(cell: Cell, integrator: Integrator, theta: Array, omega: Array, alpha: Array) -> Array:
    """The residual that an implicit scheme's iterations leave in the accelerations [rad/s²], (B,); 0 for others."""
    if not integrator.tolerance:
        return np.zeros(len(theta))
    # The residual is a norm over all rows, hence of any row; what Exudyn calls one is the largest link's torque.
    system = cell.scene.system
    units = units_of(system.tree())
    torque = [system.n * units.fitting(system.gravity, rates).energy for rates in omega]
    left = np.maximum(np.linalg.norm(_rows(cell, theta, omega, alpha), axis=-1), torque)
    return _answer(cell, theta, integrator.tolerance * left[:, None] + np.zeros_like(theta))


def _rows(cell: Cell, theta: Array, omega: Array, alpha: Array) -> Array:
    return np.asarray(cell.amplitude.rows(alpha, omega, mass_matrix(cell.scene.system, theta)) * turns(theta)[:, None])


def _answer(cell: Cell, theta: Array, backward: Array) -> Array:
    """The largest acceleration that these torques in the engine's own coordinates may make, (B,)."""
    return np.asarray(cell.amplitude.acceleration_errors(mass_matrix(cell.scene.system, theta), backward).max(axis=-1))


def conversion(cell: Cell, absolute: Array) -> Array:
    """Largest sum of magnitudes when absolute values are had from the engine's own coordinates, (B,)."""
    to_absolute = cell.amplitude.to_absolute
    own = absolute @ np.abs(np.linalg.inv(to_absolute)).T
    return np.asarray((own @ np.abs(to_absolute).T).max(axis=-1))


def joints_apart(cell: Cell, integrator: Integrator, theta: Array) -> Array:
    """How far the joints' own rounding moves the angles [rad] in maximal coordinates, (B,).

    Positions of the size of the whole mechanism are known to ε, and held to the iterations' tolerance of that size.
    Moving the hinges by c moves the angles by P c, P from M and the constraints' Jacobian.
    """
    system = cell.scene.system
    units = units_of(system.tree())  # or a matrix of kilograms and metres may have no inverse in double precision
    bodies = MaximalCoordinates(in_units(system.tree(), units))
    gap = (allowed(system.n) * EPSILON + integrator.tolerance) * sum(system.lengths) / units.length
    found, k = [], 3 * system.n
    for angles in theta:
        q, _ = bodies.state(angles, np.zeros_like(angles))
        answer = np.linalg.inv(bodies.kkt_matrix(bodies.jacobian(q)))[2:k:3, k:]
        found.append(float(np.abs(answer).sum(-1).max()) * gap)
    return np.array(found)


@dataclass(frozen=True)
class Disturbed:
    """What disturbs a step in each state, (B, n) each.

    ``accelerations``: rounding's root mean square [rad/s²]; ``left`` in them by iterations, and in rates (``speeds``
    [rad/s]) and angles (``turned`` [rad]) that joints hold together; ``angles`` [rad] and ``rates`` [rad/s]: by the
    rounding of the joints' own constraints.
    """

    accelerations: Array
    left: Array
    speeds: Array
    turned: Array
    angles: Array
    rates: Array

    def worst(self) -> Disturbed:
        """The largest of all states in each entry, (1, n)."""
        return Disturbed(*(values.max(axis=0, keepdims=True) for values in vars(self).values()))


def disturbed(
    cell: Cell, integrator: Integrator, theta: Array, omega: Array, alpha: Array, h: float, steps: int = 1
) -> Disturbed:
    """What disturbs this integrator's steps of ``h`` seconds, so many of them, from states (B, n) of this cell."""
    system, nothing = cell.scene.system, np.zeros_like(theta)
    accelerations = sharp.widest(cell, spread.accelerations, theta, omega, alpha)
    left, speeds, turned, angles, rates = (nothing,) * 5
    if cell.info.coordinates == "maximal":
        angles, rates = joint_spread(system, theta, omega)
        if integrator.tolerance:
            found = left_in_maximal_coordinates(system, theta, omega, integrator.tolerance)
            left, speeds = found.accelerations, found.rates
            turned = found.with_joints_apart(joints_left_apart(cell, integrator, theta, omega, h, steps))
    elif integrator.tolerance:
        left = left_in_accelerations(system, cell.amplitude, theta, omega, alpha, integrator.tolerance)
    return Disturbed(accelerations, left, speeds, turned, angles, rates)


def joints_left_apart(cell: Cell, integrator: Integrator, theta: Array, omega: Array, h: float, steps: int) -> Array:
    """The largest distance [m] of two points that a joint holds together, after the first and the last step, (B,).

    As the engine has its bodies then; infinite where it does not say. A gap is gone with the next step, which holds the
    joints together anew: those in between do not matter.
    """
    found = np.zeros(len(theta))
    for row, state in enumerate(zip(theta, omega, strict=True)):
        for count in {1, steps}:
            try:
                cell.trajectory(*state, integrator, h, count)
                gap = cell.engine.gap()
            except EngineFault:
                gap = None
            found[row] = max(found[row], np.inf if gap is None or np.isnan(gap) else gap)
    return found


def in_a_step(candidate: Candidate, by: Disturbed, h: float) -> tuple[Array, Array]:
    """About what disturbs angles [rad] and rates [rad/s] in one step of ``h`` seconds of a scheme, (B, n) each."""
    rates = h * (by.accelerations + by.left)
    if candidate.held:
        rates = rates + by.speeds + by.rates
    angles = h / 2 * rates
    if candidate.held == "positions":
        held = by.angles + by.turned
        angles, rates = angles + held, rates + rate_of_positions(h) * held
    return angles, rates


def rate_of_positions(h: float) -> float:
    """By how much a rate is off where an angle is held elsewhere [1/s]: γ/(βh).

    The angle has been there in one step of the generalized-α scheme, and the rate follows.
    """
    beta, gamma, _, _ = map(float, alpha_parameters(RADIUS))
    return gamma / (beta * h)


def sharp_steps(
    cell: Cell, candidate: Candidate, theta: Array, omega: Array, by: Disturbed, h: float, steps: int = 1
) -> Ends:
    """How far rounding, as it really is, and iterations take an engine from a scheme's steps of ``h`` seconds.

    Raises ArithmeticError where the steps are too long.
    """
    state, system, held = (theta, omega), cell.scene.system, candidate.held
    apart = by.angles if held == "positions" else 0.0
    found = stepped(
        candidate.scheme, system, cell.amplitude, state, h, steps, by.accelerations, left=by.left, apart=apart
    )
    rates = by.rates if held else np.zeros_like(theta)
    if held == "positions":
        rates = np.hypot(rates, rate_of_positions(h) * by.angles)
    # Differences to the parent's angle, and sums along the tree, when coordinates are changed at both ends.
    changed = ONE_ROUNDING * np.sqrt(2.0) * np.stack([cell.amplitude.path_sums(values) for values in state])
    rounding = norm(np.stack([found.rounding, changed, np.stack([np.zeros_like(theta), rates])]), 0)
    left = found.left
    if held == "velocities":
        left = left + np.stack([h / 2 * by.speeds, by.speeds])
    if held == "positions":
        left = left + np.stack([by.turned, rate_of_positions(h) * by.turned])
    exact = found.exact if candidate.coordinates != MAXIMAL else np.stack(candidate.end(theta, omega, h, steps))
    return Ends(exact, rounding, left)
