"""The effect of rounding on each entry of a result in a state: its root mean square, by the algorithm's class.

The proven bounds (:mod:`.bounds`) have room for the worst of everything at once. Here every rounding is an independent
random number of the size that it has in this very state, so that errors add up as the root of the sum of their squares.

* Articulated bodies (ABA) and RNEA in link frames are run in Monte-Carlo arithmetic: :mod:`.sampled`.
* Engines that put together the mass matrix M of their own coordinates and factorise it: with x the accelerations, b the
  bias and F_ij what meets in entry ij of M and of its factors (:mod:`.entries`), δM_ij = F_ij u and δb_i = β_i u,

      δx = M⁻¹ (δM x + δb),        spread²  =  (M⁻¹)∘² (F∘² x∘² + β∘²) · (rms of one rounding)².

  β is the sum over all that a joint carries of the bias' terms in absolute angles, Σ_j W_ij ω_j² + g-terms, with every
  sine one (an angle known to ε makes a sine near zero known to ε, not to ε of itself), diagonal included: in relative
  coordinates v × I v leaves it as a difference. There m v_h v_c comes besides, with v_h and v_c the speeds of a link's
  hinge and centre of mass: in the moment of v × m v about the hinge it cancels but for its rounding.
* Maximal coordinates: the same with the matrix (M, Gᵀ; G, 0), :mod:`.maximal_elimination`, or :mod:`.bodies_first`.

No entry is known better than the last digits of what is summed up for it: the relative accelerations on the way, and
what the loss of digits below the smallest normal number does. These are added everywhere, so that an entry that is
exactly zero (at rest, stretched out straight) has a spread unless the engine adds up nothing but zeros for it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ...models import DocumentSystem
from .. import gravity_vector, mass_matrix
from .bodies_first import bodies_first_spread
from .bounds import EPSILON, Amplitudes, turns
from .entries import entries, reach, speeds
from .lever_arms import from_support
from .maximal_elimination import maximal_spread
from .monte_carlo import ONE_ROUNDING
from .norms import product, vector_product
from .sampled import aba_accelerations, crba_matrix, energies, rnea

Array = NDArray[np.float64]


class Formulation(Protocol):
    """The facts of an engine that matter to its rounding; ``engines.EngineInfo`` has them."""

    @property
    def coordinates(self) -> str: ...
    @property
    def algorithm(self) -> str: ...
    @property
    def inverse(self) -> str: ...
    @property
    def moments(self) -> str: ...
    @property
    def placed(self) -> str: ...
    @property
    def interchanges(self) -> bool | None: ...
    @property
    def ordering(self) -> str: ...
    @property
    def accuracy(self) -> float: ...


def accelerations(
    how: Formulation, system: DocumentSystem, amplitude: Amplitudes, theta: Array, omega: Array, alpha: Array
) -> Array:
    """Spread of θ̈ [rad/s²], (B, n), in states (B, n) whose true accelerations are ``alpha``."""
    mass = mass_matrix(system, theta)
    if how.coordinates == "maximal":
        found = _maximal(how, system, theta, omega)[0] * _coarser(how)
    elif how.algorithm == "aba":
        found = aba_accelerations(system.tree(), theta, omega, alpha, accuracy=how.accuracy, placed=how.placed)
    else:
        met = entries(how, system, amplitude, theta, mass)
        rows = np.hypot(vector_product(met, amplitude.own(alpha)), bias(how, system, amplitude, theta, omega))
        found = vector_product(amplitude.solution(mass), rows) * ONE_ROUNDING * _coarser(how)
    summed = ONE_ROUNDING * _coarser(how) * amplitude.path_sums(alpha)
    lost = amplitude.acceleration_errors(mass, EPSILON * amplitude.solution_underflow(omega, alpha) + 0 * theta)
    return np.hypot(found, summed) * turns(theta)[:, None] + lost


def bias(how: Formulation, system: DocumentSystem, amplitude: Amplitudes, theta: Array, omega: Array) -> Array:
    """β: the magnitudes of velocity and gravity terms in rows of the engine's coordinates, (B, n) [N m]."""
    straight = np.zeros_like(theta[:1])
    velocity = omega**2 @ np.abs(mass_matrix(system, straight)[0]).T
    if how.coordinates == "relative":
        hinge, centre = speeds(system.tree(), theta, omega)
        velocity = velocity + amplitude.mass * hinge * centre
    return np.asarray((velocity + _weights(system, theta)) @ amplitude.to_absolute)


@dataclass(frozen=True)
class Terms:
    """Spreads of the terms of the equations of motion that inverse dynamics gives, in absolute angles.

    ``mass``, (B, n, n) [kg m²]; ``coriolis``: coefficients of the squared rates, (B, n, n) [kg m²]; ``gravity``, (B, n)
    [N m]; ``velocity``: the velocity terms with all rates at once, (B, n) [N m].
    """

    mass: Array
    coriolis: Array
    gravity: Array
    velocity: Array


def terms(how: Formulation, system: DocumentSystem, amplitude: Amplitudes, theta: Array, omega: Array) -> Terms:
    """The effect of rounding on each entry of the terms in states (B, n), each row asked for by itself.

    Added to what the algorithm does: two roundings of each entry with every sine and cosine one. An angle is known
    to ε, so that a cosine near zero is not known better. Squares of slow rates lose digits below the smallest normal
    number, twice in a row of absolute angles, which is the difference of two of joints'.
    """
    known = 2 * ONE_ROUNDING * _coarser(how) * np.abs(mass_matrix(system, np.zeros_like(theta[:1])))
    weights = ONE_ROUNDING * _coarser(how) * _weights(system, theta)
    found = (
        _terms_unknown(how, system, amplitude, theta, omega)
        if how.inverse == "matrix"
        else _terms(how, system, theta, omega)
    )
    last = Terms(known, known, weights, omega**2 @ known[0].T)
    more = turns(theta)
    return Terms(
        np.hypot(found.mass, last.mass) * more[:, None, None],
        np.hypot(found.coriolis, last.coriolis) * more[:, None, None],
        np.hypot(found.gravity, last.gravity) * more[:, None],
        np.hypot(found.velocity, last.velocity) * more[:, None] + 2 * EPSILON * amplitude.underflow(omega),
    )


def _terms(how: Formulation, system: DocumentSystem, theta: Array, omega: Array) -> Terms:
    """Of an algorithm that is sampled: all rows of inverse dynamics at once, unit rates and accelerations too."""
    (count, n), tree = theta.shape, system.tree()
    facts: dict[str, Any] = {"accuracy": how.accuracy, "placed": how.placed, "moments": how.moments}
    units = np.tile(np.eye(n), (count, 1))
    rest, idle = np.zeros_like(units), np.zeros_like(theta)
    columns = np.repeat(theta, n, axis=0)
    # angles, rates, accelerations, and whether there is gravity, of each part
    parts = [(columns, units, rest, 0.0), (theta, omega, idle, 0.0), (theta, idle, idle, 1.0)]
    if how.inverse == "rnea":
        parts.append((columns, rest, units, 0.0))
    at, rates, accelerations = (np.concatenate([part[k] for part in parts]) for k in range(3))
    pulled = np.concatenate([np.full(len(part[0]), system.gravity * part[3]) for part in parts])
    found, _ = rnea(tree, at, rates, accelerations, gravity=pulled, **facts)
    coriolis, velocity, gravity, *mass = np.split(found, np.cumsum([len(part[0]) for part in parts[:-1]]))
    return Terms(
        _columns(mass[0], count) if mass else crba_matrix(tree, theta, **facts),
        _columns(coriolis, count),
        gravity,
        velocity,
    )


def _terms_unknown(
    how: Formulation, system: DocumentSystem, amplitude: Amplitudes, theta: Array, omega: Array
) -> Terms:
    """Where it is not known how they are computed: magnitudes in rows of the engine's coordinates, put together."""
    n = system.n
    met = np.abs(amplitude.own_matrix(mass_matrix(system, theta)))
    mass = product(met, amplitude.from_absolute)  # of each row, for each unit acceleration
    units = np.broadcast_to(np.eye(n), (len(theta), n, n))
    coriolis = np.stack([velocity_bias(how, system, amplitude, theta, units[:, k]) for k in range(n)], axis=-1)
    gravity = reach(how, system, amplitude, theta) @ (amplitude.mass * system.gravity)
    velocity = velocity_bias(how, system, amplitude, theta, omega)
    rows = (_rows(how, amplitude, own) for own in (mass, coriolis, gravity[..., None], velocity[..., None]))
    mass, coriolis, gravity, velocity = rows
    return Terms(mass, coriolis, gravity[..., 0], velocity[..., 0])


def joint_forces(
    how: Formulation, system: DocumentSystem, amplitude: Amplitudes, theta: Array, omega: Array, alpha: Array
) -> Array:
    """Spread of the length of each joint's force, (B, n) [N], in the true motion."""
    if how.coordinates == "maximal":
        found = _maximal(how, system, theta, omega)[1] * _coarser(how)
    elif how.inverse != "matrix":
        facts: dict[str, Any] = {"accuracy": how.accuracy, "placed": how.placed, "moments": how.moments}
        found = rnea(system.tree(), theta, omega, alpha, gravity=np.full(len(theta), system.gravity), **facts)[1]
    else:
        levers = reach(how, system, amplitude, theta)
        rates = np.abs(amplitude.own(omega))
        swing = np.abs(amplitude.own(alpha)) + 2 * rates * amplitude.path_sums(omega)
        pull = system.gravity + (swing[:, None, :] @ levers)[:, 0]
        found = ONE_ROUNDING * _coarser(how) * ((amplitude.mass * pull) @ amplitude.carried)
    return np.asarray(found * turns(theta)[:, None] + EPSILON * amplitude.underflow(omega, alpha))


def energy(how: Formulation, system: DocumentSystem, amplitude: Amplitudes, theta: Array, omega: Array) -> Array:
    """Spread of kinetic and potential energy, (B, 2) [J].

    As sampled, and the last digits of the whole weight times its greatest depth: what is zero at the height of the
    support may be counted from elsewhere. And what the sum of equal legs' weights loses, which sampling does not see.
    """
    tree = system.tree()
    facts: dict[str, Any] = {"accuracy": how.accuracy, "placed": how.placed, "moments": how.moments}
    found = energies(tree, theta, omega, matrix=how.inverse == "crba", **facts)
    moments = from_support(tree)[1] * amplitude.mass
    last = np.array([0.0, math.hypot(moments.sum(), added_alike(moments)) * system.gravity])
    last *= ONE_ROUNDING * _coarser(how)
    return np.asarray(np.hypot(found, last) * turns(theta)[:, None] + EPSILON * amplitude.underflow(omega))


def added_alike(terms: Array) -> float:
    """Root mean square of what a running sum of ``terms`` (n,) loses for some being equal, over that of one rounding.

    Adding the same number again rounds to the same side for as long as the sum keeps its exponent: c equal terms w lose
    as much as w Σ k = w c²/2 would in one rounding, not the root of a sum of squares, as independent ones do.
    """
    values, counts = np.unique(np.abs(terms), return_counts=True)
    return float(np.max(np.where(counts > 1, values * counts**2 / 2, 0.0), initial=0.0))


def velocity_bias(how: Formulation, system: DocumentSystem, amplitude: Amplitudes, theta: Array, omega: Array) -> Array:
    """Magnitudes of the velocity terms in rows of the engine's coordinates, (B, n) [N m], as inverse dynamics has them.

    As β in :mod:`.bounds`, with the levers of this state: in relative coordinates F_k is the sum of the magnitudes of
    the rates on the way to link k, V_k that of velocities, and a row gets m_k 2 F_k V_k × lever + m_k V_k² + I_k F_k².
    """
    if how.coordinates != "relative":
        return amplitude.velocity_terms(omega)
    levers = reach(how, system, amplitude, theta)
    felt = amplitude.path_sums(omega)
    speed = (np.abs(amplitude.own(omega))[:, None, :] @ levers)[:, 0]
    force = (levers @ (2 * amplitude.mass * felt * speed)[..., None])[..., 0]
    return np.asarray(force + (amplitude.mass * speed**2 + amplitude.inertia * felt**2) @ amplitude.carried)


def _maximal(how: Formulation, system: DocumentSystem, theta: Array, omega: Array) -> tuple[Array, Array]:
    """Spreads of accelerations and of joints' forces in maximal coordinates."""
    if how.ordering == "bodies":
        return bodies_first_spread(system, theta, omega, how.placed)
    return maximal_spread(system, theta, omega, how.ordering)


def _columns(responses: Array, count: int) -> Array:
    """The matrix whose column k is the response to a unit of angle k, (B, n, n) from (B n, n)."""
    n = responses.shape[-1]
    return np.asarray(responses.reshape(count, n, n).swapaxes(1, 2))


def _rows(how: Formulation, amplitude: Amplitudes, own: Array) -> Array:
    """Spreads of rows of absolute angles, (B, n, m), from magnitudes in rows of the engine's coordinates, (B, n, m)."""
    found = product(amplitude.from_absolute.T, own)
    return np.asarray(ONE_ROUNDING * _coarser(how) * found)


def _weights(system: DocumentSystem, theta: Array) -> Array:
    """The gravity terms in absolute angles with every sine one, (1, n) [N m]."""
    return np.abs(gravity_vector(system, np.full_like(theta[:1], np.pi / 2)))


def _coarser(how: Formulation) -> float:
    return how.accuracy / EPSILON
