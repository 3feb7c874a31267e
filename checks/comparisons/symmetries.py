"""Symmetries: what an engine must answer alike, whoever is right; no truth is needed.

Each symmetry turns a mechanism and a state into another whose accelerations follow from the first one's. The engine is
asked both, and its two answers are held together; so are the two of the documents' own formula. All changes are exact
in floating point (powers of two, signs, permutations) but for the turn by 2π, whose rounding is carried through the
accelerations' derivatives. Two answers may therefore differ by the rounding of each, backward error times |M⁻¹|.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...engines import cannot
from ...models import NLegPendulum, RodChain
from ...models.systems import DocumentSystem
from ...records.check import Result
from ...reference import literal_accelerations, mass_matrix
from ...reference.integration.variation import variation
from ...reference.kernels.forward_dynamics import plain_accelerations
from ...reference.rounding import spread
from ...reference.rounding.bounds import EPSILON, Amplitudes, allowed, amplitudes, turns
from .. import sharp
from ..cell import Cell, Worst, quotient, worst
from .accelerations import SINGULAR

Array = NDArray[np.float64]
Accelerations = Callable[[DocumentSystem, Array, Array], Array]
AmplitudeOf = Callable[[DocumentSystem], Amplitudes]

NAME = "symmetry"

STATES = 3  # random ones; every symmetry is asked for in each
TURN = 0.75  # [rad], of the support

# 2π lies within 2.45e-16 of its double.
TWO_PI_ERROR = 2.45e-16


@dataclass(frozen=True)
class Image:
    """The image of a mechanism and its states under a symmetry: ``before`` and ``after`` must answer alike.

    ``back``: the first accelerations, from the second's; ``moved``: rounding of the angles in making the image [rad];
    ``alike``: nothing but signs and powers of two are changed, so that the image's rounding is the same but for these.
    """

    before: DocumentSystem
    after: DocumentSystem
    theta: Array
    omega: Array
    back: Callable[[Array], Array]
    moved: float = 0.0
    alike: bool = False

    def by_angles(self, theta: Array, omega: Array) -> Array | float:
        """What the rounding of the image's angles does to its accelerations at most [rad/s²], (B, n)."""
        if not self.moved:
            return 0.0
        return np.asarray(self.moved * np.abs(variation(self.before, theta, omega).by_theta).sum(-1))


@dataclass(frozen=True)
class Difference:
    """Of the two answers [rad/s²], and what rounding explains of it at most, (B, n) each."""

    difference: Array
    bound: Array

    @property
    def worst(self) -> Worst:
        """The largest part of the bound."""
        return worst(quotient(self.difference, self.bound))


@dataclass(frozen=True)
class Symmetry:
    """``says`` what it is, in words; ``image`` is None for mechanisms that do not have it."""

    name: str
    says: str
    image: Callable[[DocumentSystem, Array, Array], Image | None]


def compare(cell: Cell) -> Iterator[Result]:
    """One result for each symmetry that the mechanism has."""
    cell = cell.regular
    system = cell.scene.system
    theta, omega = cell.states.theta[-STATES:], cell.states.omega[-STATES:]
    if not len(theta):
        yield cell.result(NAME, "skipped", reason=f"in every state {SINGULAR}")
        return

    def engine(other: DocumentSystem, angles: Array, rates: Array) -> Array:
        asked = cell.engine if other == system else cell.engine.of(other)
        return cell.answer("accelerations", asked.accelerations(angles, rates), angles.shape)

    images = _images(system, theta, omega)
    refused = {name: why for name, image in images.items() if (why := cannot(cell.info, image.after))}
    taken = {name: image for name, image in images.items() if name not in refused}
    found = differences(taken, theta, omega, engine, cell.amplitude_of, cell.info.accuracy)
    theory = _theory(system, theta.tobytes(), omega.tobytes())
    lines = sharp_lines(cell, taken, found, theta, omega)
    for symmetry in SYMMETRIES:
        if symmetry.name in refused:
            yield cell.result(f"{NAME} {symmetry.name}", "skipped", reason=f"the image: {refused[symmetry.name]}")
        elif symmetry.name in found:
            line = lines.get(symmetry.name)
            yield _result(cell, symmetry, found[symmetry.name].worst, theory[symmetry.name].worst.value, line)


def _images(system: DocumentSystem, theta: Array, omega: Array) -> dict[str, Image]:
    found = {symmetry.name: symmetry.image(system, theta, omega) for symmetry in SYMMETRIES}
    return {name: image for name, image in found.items() if image is not None}


def differences(
    images: dict[str, Image], theta: Array, omega: Array, ask: Accelerations, amplitude: AmplitudeOf, accuracy: float
) -> dict[str, Difference]:
    """For each symmetry: the difference of the two answers, and what rounding explains of it."""
    answers: dict[DocumentSystem, tuple[Array, Array]] = {}
    found = {}
    for name, image in images.items():
        if image.before not in answers:
            answers[image.before] = _answer(image.before, theta, omega, ask, amplitude, accuracy)
        first, bound = answers[image.before]
        second, error = map(image.back, _answer(image.after, image.theta, image.omega, ask, amplitude, accuracy))
        found[name] = Difference(first - second, bound + np.abs(error) + image.by_angles(theta, omega))
    return found


def sharp_lines(
    cell: Cell, images: dict[str, Image], found: dict[str, Difference], theta: Array, omega: Array
) -> dict[str, sharp.Line]:
    """Each difference against what rounding really does to the two answers, in as many states as that is quick for."""
    info = cell.info
    most = sharp.states_for_symmetries(info, cell.scene.system.n)
    if not most:
        return {}
    states = cell.states.at(np.arange(len(cell.states))[-len(theta) :][:most])
    factor = sharp.for_accelerations(info)

    def size(system: DocumentSystem, angles: Array, rates: Array) -> Array:
        exact = plain_accelerations(system, angles, rates)
        return sharp.widest(cell, spread.accelerations, angles, rates, exact, system=system)

    firsts: dict[DocumentSystem, Array] = {}
    lines = {}
    for name, image in images.items():
        error = found[name].difference[:most]
        if not error.any():  # two answers that are the same are so whatever rounding does
            lines[name] = sharp.line(error, np.ones_like(error), factor, states, len(theta))
            continue
        if image.before not in firsts:
            firsts[image.before] = size(image.before, theta[:most], omega[:most])
        first = firsts[image.before]
        second = first if image.alike else image.back(size(image.after, image.theta[:most], image.omega[:most]))
        besides = image.by_angles(theta[:most], omega[:most])
        lines[name] = sharp.line(error, np.hypot(first, second), factor, states, len(theta), besides)
    return lines


@lru_cache(maxsize=4)
def _theory(system: DocumentSystem, theta: bytes, omega: bytes) -> dict[str, Difference]:
    """The same of the documents' own formula; the states as bytes, so that every engine's cell can share it."""
    angles, rates = (np.frombuffer(values).reshape(-1, system.n) for values in (theta, omega))

    def absolute(other: DocumentSystem) -> Amplitudes:
        return amplitudes(other, "absolute")

    images = _images(system, angles, rates)
    return differences(images, angles, rates, literal_accelerations, absolute, EPSILON)


def _result(cell: Cell, symmetry: Symmetry, found: Worst, theory: float, line: sharp.Line | None) -> Result:
    state, angle = found.index
    label = cell.states.labels[-STATES:][state]
    if theory > 1:
        reason = f"the documents' own formula does not have this symmetry: {symmetry.says}"
    elif found.value > 1:
        reason = f"it should be that {symmetry.says}; angle {angle + 1} in state {label!r} answers otherwise"
    else:
        reason = symmetry.says
    return cell.result(
        f"{NAME} {symmetry.name}",
        **sharp.verdict(max(found.value, theory) <= 1, line, reason),
        measured=found.value,
        allowed=1.0,
        unit="×",
        details={"states": STATES, "state": label, "angle": angle + 1, "documents' formula": theory}
        | (line.details() if line else {}),
    )


def _answer(
    system: DocumentSystem, theta: Array, omega: Array, ask: Accelerations, amplitude: AmplitudeOf, accuracy: float
) -> tuple[Array, Array]:
    """Accelerations, and how far rounding may leave them from the exact ones [rad/s²], (B, n) each."""
    alpha = ask(system, theta, omega)
    return alpha, allowed(system.n, accuracy) * rounding(system, theta, omega, alpha, amplitude(system))


def rounding(system: DocumentSystem, theta: Array, omega: Array, alpha: Array, amplitude: Amplitudes) -> Array:
    """How far accelerations are from the exact ones by a backward error of one ε [rad/s²], (B, n)."""
    mass = mass_matrix(system, theta)
    return EPSILON * amplitude.acceleration_errors(mass, amplitude.rows(alpha, omega, mass) * turns(theta)[:, None])


def _same(alpha: Array) -> Array:
    return alpha


def mirrored(system: DocumentSystem, theta: Array, omega: Array) -> Image:
    """Left and right changed over: θ, ω → -θ, -ω."""
    return Image(system, system, -theta, -omega, np.negative, alike=True)


def reversed_rates(system: DocumentSystem, theta: Array, omega: Array) -> Image:
    """Time reversed: ω → -ω."""
    return Image(system, system, theta, -omega, _same, alike=True)


def turned_round(system: DocumentSystem, theta: Array, omega: Array) -> Image:
    """Every angle once round, this way and that in turn."""
    rounds = 2 * np.pi * (-1.0) ** np.arange(system.n)
    largest = float(np.abs(theta).max(initial=0.0)) + 2 * np.pi
    return Image(system, system, theta + rounds, omega, _same, moved=EPSILON / 2 * largest + TWO_PI_ERROR)


def legs_permuted(system: DocumentSystem, theta: Array, omega: Array) -> Image | None:
    """The legs, and their angles with them, one place on."""
    if not isinstance(system, NLegPendulum) or system.n < 3:
        return None
    order = np.array([0, *np.roll(np.arange(1, system.n), 1)])
    other = replace(
        system, lengths=tuple(system.lengths[i] for i in order), masses=tuple(system.masses[i] for i in order)
    )
    undo = np.argsort(order)
    return Image(system, other, theta[:, order], omega[:, order], lambda alpha: alpha[:, undo])


def leg_split(system: DocumentSystem, theta: Array, omega: Array) -> Image | None:
    """The last leg as two of half its mass that move together."""
    if not isinstance(system, NLegPendulum):
        return None
    half = system.masses[-1] / 2
    other = replace(system, lengths=(*system.lengths, system.lengths[-1]), masses=(*system.masses[:-1], half, half))
    index = [*range(system.n), system.n - 1]
    return Image(system, other, theta[:, index], omega[:, index], lambda alpha: alpha[:, :-1])


def masses_scaled(system: DocumentSystem, theta: Array, omega: Array) -> Image:
    """Eight times the mass everywhere."""
    return Image(system, _scaled(system, mass=8.0), theta, omega, _same, alike=True)


def lengths_scaled(system: DocumentSystem, theta: Array, omega: Array) -> Image:
    """Four times the length, and twice the time."""
    return Image(system, _scaled(system, length=4.0), theta, omega / 2, lambda alpha: 4 * alpha, alike=True)


def gravity_scaled(system: DocumentSystem, theta: Array, omega: Array) -> Image | None:
    """Four times gravity, and half the time."""
    if not system.gravity:
        return None
    return Image(system, _scaled(system, gravity=4.0), theta, 2 * omega, lambda alpha: alpha / 4, alike=True)


def support_turned(system: DocumentSystem, theta: Array, omega: Array) -> Image:
    """Without gravity there is no down: every angle turned by the same.

    With gravity turned along the same would hold, but its direction is no part of a system: every adapter's is down.
    """
    weightless = replace(system, gravity=0.0)
    return Image(weightless, weightless, theta + TURN, omega, _same)


def _scaled(system: DocumentSystem, mass: float = 1.0, length: float = 1.0, gravity: float = 1.0) -> DocumentSystem:
    lengths = tuple(length * l for l in system.lengths)
    g = gravity * system.gravity
    if isinstance(system, RodChain):  # a rod's mass goes with its length: the same at all lengths for m / length
        return RodChain(lengths, mass * system.density, g)
    return NLegPendulum(lengths, tuple(mass * m for m in system.masses), g)


SYMMETRIES = (
    Symmetry("mirror", "the mirror image moves as the mirror image of the motion", mirrored),
    Symmetry("reversal", "accelerations are the same when all rates are reversed", reversed_rates),
    Symmetry("2π", "an angle and the same once round are one place", turned_round),
    Symmetry("permutation", "legs may be counted in any order", legs_permuted),
    Symmetry("split leg", "two equal legs that move together are one of their mass", leg_split),
    Symmetry("mass scale", "eight times the mass everywhere changes no motion", masses_scaled),
    Symmetry("length scale", "four times the length takes twice the time", lengths_scaled),
    Symmetry("gravity scale", "four times gravity takes half the time", gravity_scaled),
    Symmetry("turned support", "without gravity no direction is down", support_turned),
)
