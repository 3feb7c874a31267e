"""Why an engine's trajectory is not what its integrator gives for the theory, while its accelerations agree.

One or two steps from a few states are enough: they are compared with textbook schemes applied to the theory, as they
are, one step late, with damping treated implicitly, or with additional damping of the rates. A run with a step far too
large shows whether the engine reports instability. A step that agrees with a scheme of the order that the engine's
authors give is that of the same mechanism; two such runs diverge by chaos only.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..engines import Integrator
from ..models.coordinates import forces_to_relative, to_absolute
from ..models.mechanism import Mechanism
from ..reference import planar_tree as planar
from ..reference.integration.schemes import SCHEMES, Scheme
from ..reference.planar_tree import Parameters
from ..reference.rounding.bounds import EPSILON
from ..reference.rounding.stepped import step_bound
from .compiled import mechanism_from
from .finding import Finding
from .measurement import Array, acceleration_error, probe_states

STATE_COUNT = 4
RELATIVE_STEP = 0.06  # times the fastest rate
NUDGE = 2.0**-20  # of an angle [rad] and of a rate [rad/s]: slopes by differences, known to some digits
EPSILON_SINGLE = 2.0**-24


@dataclass(frozen=True)
class _Runs:
    """States at the start, after one and after two steps of ``step`` [s], (2, S, n): angles [rad], then rates [rad/s].

    ``fastest`` [1/s]: the rate at which nearby states part; ``off`` [rad/s²]: the error of the engine's accelerations
    by rounding and by iterations that end early; ``sums``: the magnitudes that are added up to angles and rates.
    """

    step: float
    start: Array
    once: Array
    twice: Array
    fastest: float
    off: Array
    sums: Array

    def bound(self, scheme: Scheme) -> Array:
        """What rounding may change in a step of this scheme, (2, S, n)."""
        return step_bound(scheme, self.step, self.fastest, self.off, *self.sums)


def explain_motion(
    engine: Any, expected: Any, integrator: Integrator, *, who: str = "the engine", diverged: bool = False
) -> list[Finding]:
    """Why runs with ``integrator`` do not follow ``expected``, given that the accelerations do.

    ``engine``: with ``trajectory(theta, omega, integrator, step, steps)`` → (θ, ω), (n,) each, absolute angles [rad];
    ``expected``: a system, a planar tree or a mechanism; ``who``: the engine's name in messages. ``diverged``: two long
    runs were seen to diverge; if nothing is wrong the finding is then ``chaos-only``, otherwise there is none.
    """
    mechanism = mechanism_from(expected)
    p = planar.parameters(mechanism)
    reset = _silent_reset(engine, mechanism, integrator, who)
    return [*reset, *_of_steps(engine, mechanism, p, integrator, who, diverged and not reset)]


def _of_steps(
    engine: Any, mechanism: Mechanism, p: Parameters, integrator: Integrator, who: str, diverged: bool
) -> list[Finding]:
    """What one or two steps of a sensible length show."""
    runs = _run(engine, mechanism, p, integrator)
    if not np.isfinite(runs.once).all():
        return [Finding("unexplained", who, None, None, f"{who}: {integrator.name}: NaN after one step")]

    def accelerations(theta: Any, omega: Any) -> Any:
        return planar.forward_dynamics(mechanism.parents, p, theta, omega)

    scheme = _matching_scheme(runs, accelerations, integrator.order)
    if scheme is not None:
        return _of_scheme(scheme, integrator, who, diverged)
    return _not_a_scheme(engine, mechanism, p, runs, accelerations, integrator, who, diverged)


def _not_a_scheme(
    engine: Any,
    mechanism: Mechanism,
    p: Parameters,
    runs: _Runs,
    accelerations: Any,
    integrator: Integrator,
    who: str,
    diverged: bool,
) -> list[Finding]:
    """Why a step is not that of a textbook scheme."""
    for hypothesis in (_late, _implicit_damping, _hidden_damping, _single_precision):
        found = list(hypothesis(runs, accelerations, mechanism, p, integrator, who))
        if found:
            return found
    if _converges(engine, mechanism, accelerations, runs, integrator):
        return [_chaos(integrator, "its steps converge to the theory's motion", who)] if diverged else []
    found = list(_dissipation(runs, accelerations, mechanism, p, integrator, who))
    if found:
        return found
    distance, scheme = min(((_distance(runs, s, accelerations), s.name) for s in SCHEMES), key=lambda pair: pair[0])
    says = (
        f"{who}: {integrator.name}: a step is not that of a textbook scheme; the nearest is {scheme}, at "
        f"{distance:.3g} times the tolerance"
    )
    return [Finding("unexplained", f"{who}, {integrator.name}", distance, 1.0, says)]


def _run(engine: Any, m: Mechanism, p: Parameters, integrator: Integrator) -> _Runs:
    theta, omega = (values[:STATE_COUNT] for values in probe_states(m, 8, seed=11))
    alpha = planar.forward_dynamics(m.parents, p, theta, omega)
    parting = _parting(m, p, theta, omega)
    fastest = max(float(np.abs(omega).max()), math.sqrt(float(np.abs(alpha).max())), parting, 1e-3)
    step = 2.0 ** round(math.log2(RELATIVE_STEP / fastest))
    ends = []
    for steps in (1, 2):
        rows = [engine.trajectory(t, w, integrator.name, step, steps) for t, w in zip(theta, omega, strict=True)]
        ends.append(np.array(rows).swapaxes(0, 1))
    off = acceleration_error(m.parents, p, theta, omega, alpha, integrator.tolerance)
    rates = np.abs(omega) + step * np.abs(alpha)
    sums = np.stack([_conversion(m.parents, values) for values in (np.abs(theta) + step * rates, rates)])
    return _Runs(step, np.stack([theta, omega]), ends[0], ends[1], fastest, off, sums)


def _parting(m: Mechanism, p: Parameters, theta: Array, omega: Array) -> float:
    """The fastest rate [1/s] at which nearby states part: √(largest row of ∂α/∂θ) + largest row of ∂α/∂ω."""

    def largest_row(turned: float, hastened: float) -> float:
        nudges = np.eye(m.n)[:, None, :]
        there, back = (
            planar.forward_dynamics(m.parents, p, theta + sign * turned * nudges, omega + sign * hastened * nudges)
            for sign in (1, -1)
        )
        return float(np.abs((there - back) / (2 * (turned + hastened))).sum(axis=0).max())

    return math.sqrt(largest_row(NUDGE, 0.0)) + largest_row(0.0, NUDGE)


def _conversion(parents: tuple[int, ...], absolute: Array) -> Array:
    """Sums of magnitudes where values of such magnitudes (S, n) are had from differences to the parent's."""
    relative = absolute.copy()
    for i, parent in enumerate(parents):
        if parent >= 0:
            relative[:, i] += absolute[:, parent]
    return np.asarray(to_absolute(parents, relative))


def _matching_scheme(runs: _Runs, accelerations: Any, order: int) -> Scheme | None:
    """The scheme whose step it is; of several with the same step, one of the order that is expected.

    Of a very short step more than one may be right to rounding. Explicit ones are tried first: an implicit step takes
    ten times as long to compute.
    """
    expected = [s for s in SCHEMES if s.order == order]
    for schemes in (
        [s for s in expected if not s.implicit],
        [s for s in expected if s.implicit],
        [s for s in SCHEMES if s.order > order],
        [s for s in SCHEMES if s.order < order],
    ):
        distances = {_distance(runs, s, accelerations): s for s in schemes}
        if distances and min(distances) <= 1:
            return distances[min(distances)]
    return None


def _distance(runs: _Runs, scheme: Scheme, accelerations: Any) -> float:
    """The largest difference of the engine's first step from the scheme's, over its tolerance."""
    with np.errstate(all="ignore"):
        try:
            made = _made(runs, scheme, accelerations)
        except (ArithmeticError, RuntimeError):
            return math.inf
        off = np.abs(runs.once - made)
        worst = float(np.max(off / runs.bound(scheme)))
    return worst if math.isfinite(worst) else math.inf


def _made(runs: _Runs, scheme: Scheme, accelerations: Any) -> Array:
    """The scheme's own step from the same states, (2, S, n), in extended precision."""
    theta, omega = runs.start.astype(np.longdouble)
    return np.stack(scheme.step(accelerations, theta, omega, np.longdouble(runs.step))).astype(np.float64)


def _of_scheme(scheme: Scheme, integrator: Integrator, who: str, diverged: bool) -> list[Finding]:
    where = f"{who}, {integrator.name}"
    if scheme.order < integrator.order:
        orders = f"found order {scheme.order}, expected {integrator.order}"
        says = f"{who}: {integrator.name}: its step is {scheme.name}: {orders}"
        return [Finding("first-order-integrator", where, scheme.order, integrator.order, says)]
    if not diverged:
        return []
    return [_chaos(integrator, f"its step is that of {scheme.name}, to rounding", who)]


def _chaos(integrator: Integrator, shown: str, who: str) -> Finding:
    says = (
        f"{who}: {integrator.name}: accelerations agree and {shown}: the same mechanism; neighbouring runs diverge "
        "by the motion's own growth of small errors"
    )
    return Finding("chaos-only", f"{who}, {integrator.name}", None, None, says)


def _converges(engine: Any, m: Mechanism, accelerations: Any, runs: _Runs, integrator: Integrator) -> bool:
    """Whether the error of a run over a fixed time falls with the step as the scheme's order says.

    For schemes in other coordinates, whose step is not a textbook scheme's in these.
    """
    theta, omega = runs.start
    finest = max(SCHEMES, key=lambda s: s.order)
    state, errors = (theta, omega), []
    for _ in range(16):
        made = finest.step(accelerations, state[0], state[1], runs.step)
        state = np.asarray(made[0], dtype=np.float64), np.asarray(made[1], dtype=np.float64)
    for finer in (1, 4):
        steps = 16 * finer
        step, starts = runs.step / finer, zip(theta, omega, strict=True)
        ends = [engine.trajectory(t, w, integrator.name, step, steps)[0] for t, w in starts]
        errors.append(float(np.abs(np.array(ends) - state[0]).max()))
    return errors[0] < 0.1 and errors[1] * 4 ** (integrator.order - 0.5) <= errors[0]


def _late(
    runs: _Runs, accelerations: Any, m: Mechanism, p: Parameters, integrator: Integrator, who: str
) -> Iterator[Finding]:
    """After one step the state at the start, or part of it; after two steps what one step should give."""
    stayed = np.abs(runs.once - runs.start) <= runs.bound(_longest())
    parts = [name for name, part in zip(("angles", "rates"), stayed, strict=True) if part.all()]
    if not parts:
        return
    second = [s for s in SCHEMES if _late_distance(runs, s, accelerations, parts) <= 1]
    if second:
        says = (
            f"{who}: {integrator.name}: {' and '.join(parts)} are one step late: after two steps they are what "
            f"{second[0].name} gives after one"
        )
        yield Finding("stale-derived-state", f"{who}, {integrator.name}", -1.0, 0.0, says)


def _longest() -> Scheme:
    """The scheme of most stages, whose bound is no less than any other's: for a step of no known scheme."""
    return max(SCHEMES, key=lambda scheme: scheme.stages)


def _late_distance(runs: _Runs, scheme: Scheme, accelerations: Any, parts: list[str]) -> float:
    made = _made(runs, scheme, accelerations)
    rows = [row for row, name in enumerate(("angles", "rates")) if name in parts]
    return float(np.max((np.abs(runs.twice - made) / runs.bound(scheme))[rows]))


def _implicit_damping(
    runs: _Runs, accelerations: Any, m: Mechanism, p: Parameters, integrator: Integrator, who: str
) -> Iterator[Finding]:
    """ω⁺ = ω + h (M + h D)⁻¹ M α, θ⁺ = θ + h ω⁺."""
    if not p.damping.any():
        return
    theta, omega = runs.start
    mass = planar.mass_matrix(m.parents, p, theta)
    damping = np.zeros_like(mass)
    for i, parent in enumerate(m.parents):
        d = p.damping[i]
        damping[:, i, i] += d
        if parent >= 0:
            damping[:, parent, parent] += d
            damping[:, i, parent] -= d
            damping[:, parent, i] -= d
    force = (mass @ accelerations(theta, omega)[..., None])[..., 0]
    rates = omega + runs.step * np.linalg.solve(mass + runs.step * damping, force[..., None])[..., 0]
    ends = np.stack([theta + runs.step * rates, rates])
    if float(np.max(np.abs(runs.once - ends) / runs.bound(_longest()))) <= 1:
        says = (
            f"{who}: {integrator.name}: its step is semi-implicit Euler with damping at the end of the step, "
            "(M + h D)⁻¹; the difference vanishes with the step"
        )
        yield Finding("implicit-damping", f"{who}, {integrator.name}", runs.step, 0.0, says)


def _hidden_damping(
    runs: _Runs, accelerations: Any, m: Mechanism, p: Parameters, integrator: Integrator, who: str
) -> Iterator[Finding]:
    """Every step reduces all rates by the same share, or each hinge's relative rate by a torque."""
    where = f"{who}, {integrator.name}"
    theta, omega = runs.start
    for scheme in (s for s in SCHEMES if s.order >= integrator.order):
        made = _made(runs, scheme, accelerations)
        off = runs.once[1] - made[1]
        clear = np.abs(off) > 10 * runs.bound(scheme)[1]
        if clear.mean() < 0.5:
            continue
        shares = [(off / (runs.step * rates))[clear] for rates in (made[1], omega)]  # taken at the end, or all along
        share = min(shares, key=lambda share: float(np.median(np.abs(share / np.median(share) - 1))))
        middle = float(np.median(share))
        if float(np.quantile(np.abs(share - middle), 0.9)) <= 0.1 * abs(middle) and middle < 0:
            rate = -middle
            says = (
                f"{who}: {integrator.name}: rates are damped by {rate:.4g} 1/s in each step, which accelerations "
                "do not show"
            )
            yield Finding("damping", where, rate, 0.0, says)
            return
        torque = (planar.mass_matrix(m.parents, p, theta) @ (off / runs.step)[..., None])[..., 0]
        own = forces_to_relative(m.parents, torque)
        relative = omega.copy()
        for i, parent in enumerate(m.parents):
            if parent >= 0:
                relative[:, i] -= omega[:, parent]
        coefficients = -own / relative
        spread = coefficients.std(axis=0)
        if (spread <= 0.2 * np.abs(coefficients.mean(axis=0))).all() and (coefficients > 0).all():
            worst = int(coefficients.mean(axis=0).argmax())
            value = float(np.median(coefficients[:, worst]))
            says = (
                f"{who}: {integrator.name}: joint {worst + 1} is damped by about {value:.4g} N m s in each step, which "
                "accelerations do not show"
            )
            yield Finding("damping", where, value, 0.0, says)
            return


def _single_precision(
    runs: _Runs, accelerations: Any, m: Mechanism, p: Parameters, integrator: Integrator, who: str
) -> Iterator[Finding]:
    """The states are numbers of 24 bits."""
    if (runs.once == runs.once.astype(np.float32)).all():
        says = f"{who}: {integrator.name}: its states are numbers of 24 bits: single precision"
        yield Finding("float32", f"{who}, {integrator.name}", EPSILON_SINGLE, EPSILON / 2, says)


def _dissipation(
    runs: _Runs, accelerations: Any, m: Mechanism, p: Parameters, integrator: Integrator, who: str
) -> Iterator[Finding]:
    """Far more energy is lost than by the scheme, and not in proportion to the rates alone."""
    theta, omega = runs.start
    scheme = next(s for s in SCHEMES if s.order >= integrator.order)
    made = _made(runs, scheme, accelerations)
    before = _energy(m, p, theta, omega)
    change = _energy(m, p, *runs.once) - before
    due = _energy(m, p, *made) - before
    size = np.abs(_kinetic(m, p, theta, omega)) + 1e-300
    loss = (change - due) / size
    if (loss < -1e3 * EPSILON).all():
        says = (
            f"{who}: {integrator.name}: accelerations agree, but a step of {runs.step:g} s loses "
            f"{float(-np.median(loss)):.3g} of the kinetic energy, where constraints are enforced"
        )
        yield Finding("constraint-dissipation", f"{who}, {integrator.name}", float(np.median(loss)), 0.0, says)


def _energy(m: Mechanism, p: Parameters, theta: Array, omega: Array) -> Array:
    kinetic = _kinetic(m, p, theta, omega)
    hinge_x, hinge_y = np.zeros_like(theta), np.zeros_like(theta)
    potential = np.zeros(len(theta))
    for i, parent in enumerate(m.parents):
        if parent >= 0:
            c, s = np.cos(theta[:, parent]), np.sin(theta[:, parent])
            a, b = m.links[i].hinge
            hinge_x[:, i] = hinge_x[:, parent] + a * c - b * s
            hinge_y[:, i] = hinge_y[:, parent] + a * s + b * c
        c, s = np.cos(theta[:, i]), np.sin(theta[:, i])
        a, b = m.links[i].com
        x, y = hinge_x[:, i] + a * c - b * s, hinge_y[:, i] + a * s + b * c
        potential -= m.links[i].mass * (m.gravity[0] * x + m.gravity[1] * y)
    return kinetic + potential


def _kinetic(m: Mechanism, p: Parameters, theta: Array, omega: Array) -> Array:
    return np.asarray(np.einsum("si,sij,sj->s", omega, planar.mass_matrix(m.parents, p, theta), omega) / 2)


def _silent_reset(engine: Any, m: Mechanism, integrator: Integrator, who: str) -> list[Finding]:
    """A reset after an instability: with a step far too large, different starts end in the same state."""
    theta, omega = (values[:2] for values in probe_states(m, 4, seed=17))
    alpha = planar.forward_dynamics(m.parents, planar.parameters(m), theta, omega)
    period = 1.0 / max(math.sqrt(float(np.abs(alpha).max())), 1e-3)
    for times, steps in ((20.0, 3), (20.0, 30), (1e3, 100), (1e5, 100)):
        step = times * period
        with np.errstate(all="ignore"):
            try:
                ends = [
                    np.array(engine.trajectory(t, 30 * w, integrator.name, step, steps))
                    for t, w in zip(theta, omega, strict=True)
                ]
            except (ArithmeticError, RuntimeError, ValueError):
                return []
        if all(np.isfinite(end).all() for end in ends) and (ends[0] == ends[1]).all():
            says = (
                f"{who}: {integrator.name}: after {steps} steps of {step:.3g} s, far too long, two different starts end"
                " in the same state: the engine resets the state and does not report it"
            )
            return [Finding("silent-reset", f"{who}, {integrator.name}", steps, None, says)]
    return []
