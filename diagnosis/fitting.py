"""Hypotheses fitted to measurements by least squares on the residual torques, by Gauss-Newton.

Most hypotheses are linear in their values, then one step is exact. One explains a measurement when every residual is
within what rounding explains.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..reference.planar_tree import NAMES, Parameters
from .hypotheses import Hypothesis
from .measurement import Array, Measurement

MOST_STEPS = 12  # of Gauss-Newton; two or three are the rule
BATCH_NUMBERS = 400_000  # numbers in one batch of perturbed mechanisms


@dataclass(frozen=True)
class FittedHypothesis:
    """A hypothesis with its best values (d,), their uncertainty from rounding (d,), and the largest residual torque in
    units of what rounding explains."""

    hypothesis: Hypothesis
    values: Array
    uncertainty: Array
    residual: float

    @property
    def explains(self) -> bool:
        """Whether every residual is within what rounding explains."""
        return self.residual <= 1

    def parts(self) -> list[FittedHypothesis]:
        """The values of each part of a combined hypothesis, with the residual of the whole."""
        fits, start = [], 0
        for part in self.hypothesis.parts:
            end = start + part.d
            fits.append(FittedHypothesis(part, self.values[start:end], self.uncertainty[start:end], self.residual))
            start = end
        return fits


def fit(hypothesis: Hypothesis, p: Parameters, measured: Measurement) -> FittedHypothesis:
    """The hypothesis with the values that leave the least residual, by Gauss-Newton from zero.

    ``p``: the expected parameters, at which the values are zero.
    """
    with np.errstate(all="ignore"):
        return _gauss_newton(hypothesis, p, measured)


def _gauss_newton(hypothesis: Hypothesis, p: Parameters, measured: Measurement) -> FittedHypothesis:
    x, sizes = np.zeros(hypothesis.d), hypothesis.sizes
    best: FittedHypothesis | None = None
    without_gain = 0
    for _ in range(MOST_STEPS):
        at = hypothesis.apply(p, x)
        scale = measured.tolerances(at)
        residuals = measured.residuals(at, scale)
        worst = float(np.max(np.abs(residuals)))
        columns = _columns(hypothesis, p, x, sizes, measured, scale)
        if not (np.isfinite(worst) and np.isfinite(columns).all()):
            break
        step, spread = _solve(columns, residuals.ravel())
        without_gain = without_gain + 1 if best is not None and worst > 0.5 * best.residual else 0
        if best is None or worst < best.residual:
            best = FittedHypothesis(hypothesis, x.copy(), spread * sizes, worst)
        if without_gain > (0 if best.explains else 2):
            break
        x = x + step * sizes
        if not np.isfinite(x).all():
            break
    return best if best is not None else FittedHypothesis(hypothesis, x, x, np.inf)


def screened(hypotheses: Sequence[Hypothesis], p: Parameters, measured: Measurement) -> list[tuple[float, Hypothesis]]:
    """(residual, hypothesis) after one linear step of each: root mean square over tolerance, least first.

    All hypotheses are perturbed in a few large batches.
    """
    scale = measured.tolerances(p)
    residuals = measured.residuals(p, scale).ravel()
    perturbations = [(h, k, sign) for h in hypotheses for k in range(h.d) for sign in (1.0, -1.0)]
    per_batch = max(2, BATCH_NUMBERS // residuals.size // 2 * 2)
    responses = []
    for begin in range(0, len(perturbations), per_batch):
        part = perturbations[begin : begin + per_batch]
        stacked = _stack([h.apply(p, sign * h.sizes[k] * np.eye(h.d)[k]) for h, k, sign in part])
        responses.append(measured.residuals(stacked, scale).reshape(len(part), -1))
    every = np.concatenate(responses)
    derivative = (every[0::2] - every[1::2]) / 2
    found, column = [], 0
    for hypothesis in hypotheses:
        columns = derivative[column : column + hypothesis.d].T
        column += hypothesis.d
        step, _ = _solve(columns, residuals)
        found.append((float(np.sqrt(np.mean((residuals + columns @ step) ** 2))), hypothesis))
    return sorted(found, key=lambda item: item[0])


def _columns(
    hypothesis: Hypothesis, p: Parameters, x: Array, sizes: Array, measured: Measurement, scale: Array
) -> Array:
    points = [x + sign * sizes[k] * 1e-3 * np.eye(hypothesis.d)[k] for k in range(hypothesis.d) for sign in (1.0, -1.0)]
    found = measured.residuals(_stack([hypothesis.apply(p, point) for point in points]), scale).reshape(
        2 * hypothesis.d, -1
    )
    return np.asarray((found[0::2] - found[1::2]).T / 2e-3)


def _solve(columns: Array, residuals: Array) -> tuple[Array, Array]:
    """−columns⁺ · residuals, and the standard deviation of the solution for residuals of variance one."""
    if not (np.isfinite(columns).all() and np.isfinite(residuals).all()):  # numbers out of range: no step from here
        return np.zeros(columns.shape[1]), np.full(columns.shape[1], np.inf)
    size = np.linalg.norm(columns, axis=0)
    size = np.where(size > 0, size, 1.0)
    inverse = np.linalg.pinv(columns / size, rcond=1e-12)
    return -(inverse @ residuals) / size, np.linalg.norm(inverse, axis=1) / size


def _stack(parameters: Sequence[Parameters]) -> Parameters:
    """Mechanisms along a new first axis, broadcast against states."""
    return Parameters(**{name: np.stack([p.items()[name] for p in parameters])[:, None, :] for name in NAMES})
