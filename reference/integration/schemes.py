"""Textbook schemes that carry a state over one step of time, for whatever gives accelerations.

A step takes θ and ω of shape (…, n) in any float type and gives both after ``h`` seconds. All of these schemes commute
with a linear change of coordinates: applied to relative angles q = S⁻¹ θ they give the same θ = S q. Results
therefore do not show in which angles an engine applies a scheme; they do show maximal coordinates
(:mod:`furiko.reference.maximal_coordinates`).

Sources: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I* (tableaux; II.1, II.5); Butcher 1964, "On
Runge-Kutta processes of high order" (order six needs seven stages); Hairer, Lubich, Wanner,
*Geometric Numerical Integration* (I.1, VI.3); Chung, Hulbert 1993 and Arnold, Brüls 2007 (generalized-α).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
Acceleration = Callable[[Array, Array], Array]
Step = Callable[[Acceleration, Array, Array, Any], tuple[Array, Array]]
Between = Callable[[Array, Array], tuple[Array, Array]]

ITERATIONS = 200  # of an implicit step; each at least halves the error


@dataclass(frozen=True)
class Scheme:
    """One step of a scheme.

    ``reach``: an error of at most 1 in every acceleration it evaluates, with accelerations that do not depend on the
    state, moves the rates by at most ``reach`` times the step. ``stages``: accelerations that follow on each other.
    ``remembers``: where a step hands on more than angles and rates to the next, what takes several.
    ``implicit``: a step is solved for, by many evaluations. ``tableau``: what it is an explicit Runge-Kutta scheme by.
    """

    name: str
    order: int
    step: Step
    reach: float = 1.0
    stages: int = 1
    remembers: AlphaScheme | None = None
    implicit: bool = False
    tableau: Tableau | None = None


@dataclass(frozen=True)
class Tableau:
    """A Butcher tableau: stage i uses the slopes before it with the weights ``rows[i]``; ``weights`` end the step.

    Raises ValueError where a step would not be exact for constant slopes: weights that do not sum to one.
    """

    rows: tuple[tuple[Any, ...], ...]
    weights: tuple[Any, ...]

    def __post_init__(self) -> None:
        if abs(sum(self.weights) - 1) > 1e-15:
            raise ValueError(f"weights sum to {sum(self.weights)}, not 1")
        if [len(row) for row in self.rows] != list(range(len(self.weights))):
            raise ValueError("row i of an explicit tableau has i entries")

    def step(self, accelerations: Acceleration, theta: Array, omega: Array, h: Any) -> tuple[Array, Array]:
        """One step."""
        return self.step_along(lambda _angles, rates: rates, accelerations, theta, omega, h)

    def step_along(
        self, along: Acceleration, accelerations: Acceleration, places: Array, rates: Array, h: Any
    ) -> tuple[Array, Array]:
        """One step of places whose rate of change ``along`` gives, and which need not be as many as the rates."""
        moving: list[Array] = []
        speeding: list[Array] = []
        for row in self.rows:
            at = places + h * _weighed(row, moving, places), rates + h * _weighed(row, speeding, rates)
            moving.append(along(*at))
            speeding.append(accelerations(*at))
        return places + h * _weighed(self.weights, moving, places), rates + h * _weighed(self.weights, speeding, rates)

    def scheme(self, name: str, order: int) -> Scheme:
        """The tableau as a scheme of this name and order."""
        return Scheme(name, order, self.step, float(sum(map(abs, self.weights))), len(self.weights), tableau=self)


def _weighed(weights: tuple[Any, ...], slopes: list[Array], like: Array) -> Array:
    number = like.dtype.type  # coefficients have more digits than a double: they must not widen it
    return sum((number(w) * slope for w, slope in zip(weights, slopes, strict=True) if w != 0), np.zeros_like(like))


def explicit_euler(a: Acceleration, theta: Array, omega: Array, h: Any) -> tuple[Array, Array]:
    """θ₁ = θ + h ω, ω₁ = ω + h a(θ, ω)."""
    return theta + h * omega, omega + h * a(theta, omega)


def semi_implicit_euler(a: Acceleration, theta: Array, omega: Array, h: Any) -> tuple[Array, Array]:
    """ω₁ = ω + h a(θ, ω), θ₁ = θ + h ω₁: symplectic Euler, rates first."""
    rates = omega + h * a(theta, omega)
    return theta + h * rates, rates


def drift_kick_euler(a: Acceleration, theta: Array, omega: Array, h: Any) -> tuple[Array, Array]:
    """θ₁ = θ + h ω, ω₁ = ω + h a(θ₁, ω): symplectic Euler, angles first."""
    angles = theta + h * omega
    return angles, omega + h * a(angles, omega)


def implicit_euler(a: Acceleration, theta: Array, omega: Array, h: Any) -> tuple[Array, Array]:
    """θ₁ = θ + h ω₁, ω₁ = ω + h a(θ₁, ω₁)."""

    def state(acceleration: Array) -> tuple[Array, Array]:
        rates = omega + h * acceleration
        return theta + h * rates, rates

    return state(_fixed_point(a, state, a(theta, omega)))


def velocity_verlet(a: Acceleration, theta: Array, omega: Array, h: Any) -> tuple[Array, Array]:
    """Half a kick, a drift, half a kick with a(θ₁, ω½); of first order where accelerations depend on rates."""
    half = omega + h / 2 * a(theta, omega)
    angles = theta + h * half
    return angles, half + h / 2 * a(angles, half)


def implicit_midpoint(a: Acceleration, theta: Array, omega: Array, h: Any) -> tuple[Array, Array]:
    """y₁ = y + h f((y + y₁)/2)."""

    def middle(acceleration: Array) -> tuple[Array, Array]:
        rates = omega + h / 2 * acceleration
        return theta + h / 2 * rates, rates

    acceleration = _fixed_point(a, middle, a(theta, omega))
    angles, rates = middle(acceleration)
    return 2 * angles - theta, 2 * rates - omega


def newmark(beta: Any, gamma: Any) -> AlphaScheme:
    """θ₁ = θ + h ω + h²((½-β) a + β a₁), ω₁ = ω + h((1-γ) a + γ a₁); β = ¼, γ = ½: the trapezoidal rule."""
    return AlphaScheme(beta, gamma, 0, 0)


def generalized_alpha(radius: Any) -> AlphaScheme:
    """Chung and Hulbert's, ``radius`` their ρ∞, in Arnold and Brüls' form, from a state whose accelerations are true.

    (1-α_m) ã₁ + α_m ã = (1-α_f) a₁ + α_f a, and Newmark's formulas with ã in place of a.
    """
    return AlphaScheme(*alpha_parameters(radius))


def alpha_parameters(radius: Any) -> tuple[Any, Any, Any, Any]:
    """β, γ, α_m, α_f of the generalized-α scheme whose spectral radius at infinite frequency is ρ∞."""
    alpha_m, alpha_f = (2 * radius - 1) / (radius + 1), radius / (radius + 1)
    gamma = 0.5 + alpha_f - alpha_m
    return (gamma + 0.5) ** 2 / 4, gamma, alpha_m, alpha_f


@dataclass(frozen=True)
class AlphaScheme:
    """Newmark's formulas with algorithmic accelerations ã, which a step hands on to the next besides the true ones."""

    beta: Any
    gamma: Any
    alpha_m: Any
    alpha_f: Any

    def algorithmic(self, after: Array, before: Array, kept: Array) -> Array:
        """ã₁ of the accelerations ``after`` and ``before`` a step and ã, ``kept`` from the last."""
        weighed: Array = (1 - self.alpha_f) * after + self.alpha_f * before - self.alpha_m * kept
        return np.asarray(weighed / (1 - self.alpha_m))

    def moved(self, x: Array, v: Array, h: Any, kept: Array, end: Array) -> tuple[Array, Array]:
        """Coordinates and rates after a step, from ã and ã₁."""
        beta, gamma = self.beta, self.gamma
        moved: Array = x + h * v + h * h * ((0.5 - beta) * kept + beta * end)
        return moved, v + h * ((1 - gamma) * kept + gamma * end)

    def step(self, a: Acceleration, theta: Array, omega: Array, h: Any) -> tuple[Array, Array]:
        """One step from a state whose accelerations are true."""
        return self.run(a, theta, omega, h, 1, _as_it_is)

    def run(
        self, a: Acceleration, theta: Array, omega: Array, h: Any, steps: int, then: Between
    ) -> tuple[Array, Array]:
        """As :func:`run`."""
        before = kept = a(theta, omega)
        for _ in range(steps):

            def state(
                after: Array, x: Array = theta, v: Array = omega, before: Array = before, kept: Array = kept
            ) -> tuple[Array, Array]:
                return self.moved(x, v, h, kept, self.algorithmic(after, before, kept))

            after = _fixed_point(a, state, before)
            theta, omega = then(*state(after))
            before, kept = after, self.algorithmic(after, before, kept)
        return theta, omega


def _as_it_is(theta: Array, omega: Array) -> tuple[Array, Array]:
    return theta, omega


def run(
    scheme: Scheme,
    a: Acceleration,
    theta: Array,
    omega: Array,
    h: Any,
    steps: int,
    then: Between = _as_it_is,
) -> tuple[Array, Array]:
    """θ and ω after so many steps of ``h`` seconds; ``then`` may change both after each step, as rounding does."""
    if scheme.remembers is not None:
        return scheme.remembers.run(a, theta, omega, h, steps, then)
    for _ in range(steps):
        theta, omega = then(*scheme.step(a, theta, omega, h))
    return theta, omega


def _fixed_point(a: Acceleration, state: Callable[[Array], tuple[Array, Array]], guess: Array) -> Array:
    """The acceleration x with x = a(state(x)), to rounding. Raises ArithmeticError where it is not found."""
    x, smallest = guess, np.inf
    for _ in range(ITERATIONS):
        found = a(*state(x))
        change = float(np.max(np.abs(found - x), initial=0.0))
        x = found
        rounding = 1e3 * float(np.finfo(x.dtype).eps) * float(np.max(np.abs(x), initial=0.0))
        if change == 0 or smallest / 2 <= change <= rounding:
            return x
        if not change <= 1e3 * smallest:
            break
        smallest = min(smallest, change)
    raise ArithmeticError("the implicit step's equations were not solved: the step is too long")


def classical_step(slope: Callable[[float, Array], Array], y: Array, h: Any) -> Array:
    """y after one step of the classical Runge-Kutta scheme for ẏ = slope(part, y), in y's own number type.

    ``part``: the fraction of the step, 0, ½ or 1, for slopes that depend on time. For states of any shape and slopes
    that are no accelerations; :data:`CLASSICAL` is the same scheme for θ and ω, with weights in extended precision.
    """
    first = slope(0.0, y)
    second = slope(0.5, y + h / 2 * first)
    third = slope(0.5, y + h / 2 * second)
    fourth = slope(1.0, y + h * third)
    return np.asarray(y + h / 6 * (first + 2 * second + 2 * third + fourth))


_third, _sixth = np.longdouble(1) / 3, np.longdouble(1) / 6
_root5 = np.sqrt(np.longdouble(5))
_half = np.longdouble(1) / 2

CLASSICAL = Tableau(((), (_half,), (0, _half), (0, 0, 1)), (_sixth, _third, _third, _sixth))
THREE_EIGHTHS = Tableau(((), (_third,), (-_third, 1), (1, -1, 1)), (_half / 4, 3 * _half / 4, 3 * _half / 4, _half / 4))
BUTCHER_6 = Tableau(
    (
        (),
        (_half - _root5 / 10,),
        (-_root5 / 10, _half + _root5 / 5),
        ((7 * _root5 - 15) / 20, (_root5 - 1) / 4, (15 - 7 * _root5) / 10),
        ((5 - _root5) / 60, 0, _sixth, (15 + 7 * _root5) / 60),
        ((5 + _root5) / 60, 0, (9 - 5 * _root5) / 12, _sixth, (3 * _root5 - 5) / 10),
        (_sixth, 0, (25 * _root5 - 55) / 12, -(25 + 7 * _root5) / 12, 5 - 2 * _root5, (5 + _root5) / 2),
    ),
    (_sixth / 2, 0, 0, 0, 5 * _sixth / 2, 5 * _sixth / 2, _sixth / 2),
)


def _fraction(numerator: int, denominator: int) -> Any:
    return np.longdouble(numerator) / denominator


DORMAND_PRINCE = Tableau(
    (
        (),
        (_fraction(1, 5),),
        (_fraction(3, 40), _fraction(9, 40)),
        (_fraction(44, 45), _fraction(-56, 15), _fraction(32, 9)),
        (_fraction(19372, 6561), _fraction(-25360, 2187), _fraction(64448, 6561), _fraction(-212, 729)),
        (
            _fraction(9017, 3168),
            _fraction(-355, 33),
            _fraction(46732, 5247),
            _fraction(49, 176),
            _fraction(-5103, 18656),
        ),
    ),
    (
        _fraction(35, 384),
        0,
        _fraction(500, 1113),
        _fraction(125, 192),
        _fraction(-2187, 6784),
        _fraction(11, 84),
    ),
)

RADIUS = _fraction(9, 10)  # Exudyn's default ρ∞


def _alpha(name: str, scheme: AlphaScheme, reach: float = 1.0) -> Scheme:
    return Scheme(name, 2, scheme.step, reach=reach, stages=3, remembers=scheme, implicit=True)


SCHEMES: tuple[Scheme, ...] = (
    Scheme("explicit Euler", 1, explicit_euler),
    Scheme("semi-implicit Euler", 1, semi_implicit_euler),
    Scheme("semi-implicit Euler, angles first", 1, drift_kick_euler),
    Scheme("implicit Euler", 1, implicit_euler, stages=2, implicit=True),
    Scheme("velocity Verlet with rates half a step late", 1, velocity_verlet, stages=2),
    Tableau(((), (_half,)), (0, 1)).scheme("explicit midpoint", 2),
    Tableau(((), (1,)), (_half, _half)).scheme("Heun's second order", 2),
    Scheme("implicit midpoint", 2, implicit_midpoint, stages=2, implicit=True),
    _alpha("trapezoidal rule (Newmark β = 1/4, γ = 1/2)", newmark(_half / 2, _half)),
    _alpha("generalized-α, ρ∞ = 0.9", generalized_alpha(RADIUS), reach=2.0),
    _alpha("generalized-α, ρ∞ = 1", generalized_alpha(np.longdouble(1)), reach=2.0),
    Tableau(((), (_third,), (0, 2 * _third)), (_half / 2, 0, 3 * _half / 2)).scheme("Heun's third order", 3),
    Tableau(((), (_half,), (-1, 2)), (_sixth, 2 * _third, _sixth)).scheme("Kutta's third order", 3),
    CLASSICAL.scheme("classical Runge-Kutta", 4),
    THREE_EIGHTHS.scheme("Runge-Kutta 3/8 rule", 4),
    DORMAND_PRINCE.scheme("Dormand-Prince, fifth order", 5),
    BUTCHER_6.scheme("Butcher's sixth order in seven stages", 6),
)
