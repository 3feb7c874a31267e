"""Hypotheses fitted to measurements by least squares on the residual torques, by Gauss-Newton.

Most hypotheses are linear in their values, then one step is exact. One explains a measurement when every residual is
within what rounding explains.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...models.coordinates import forces_to_relative
from ...reference.planar_tree import NAMES, Parameters
from ..measurement import Array, Measurement
from .hypotheses import Hypothesis

MOST_STEPS = 12  # of Gauss-Newton; two or three are the rule
BATCH_NUMBERS = 400_000  # numbers in one batch of perturbed mechanisms
PARALLEL = 1e-9  # squared sine of the angle of two hypotheses that cannot be told apart


@dataclass(frozen=True, eq=False)
class FittedHypothesis:
    """A hypothesis with its best values (d,), their uncertainty from rounding (d,), and the largest residual torque in
    units of what rounding explains."""

    hypothesis: Hypothesis
    values: Array
    uncertainty: Array
    residual: float
    moving: bool = False  # its terms are those of its own numbers, not of the expected ones

    @property
    def explains(self) -> bool:
        """Whether every residual is within what rounding explains."""
        return self.residual <= 1

    def parts(self) -> list[FittedHypothesis]:
        """The values of each part of a combined hypothesis, with the residual of the whole.

        A fault of one term beside a factor on all terms of its kind is told of the term as that factor leaves it.
        """
        fits, start = [], 0
        for part in self.hypothesis.parts:
            end = start + part.d
            shared = self._factor_on_all(part)
            values, spread = self.values[start:end] / shared, self.uncertainty[start:end] / abs(shared)
            fits.append(FittedHypothesis(part, values, spread, self.residual))
            start = end
        return fits

    def _factor_on_all(self, part: Hypothesis) -> float:
        """The factor on all terms that this part is one of, as other parts have found it; 1 where there is none."""
        start, found = 0, 1.0
        for other in self.hypothesis.parts:
            if other.place and other.place in part.within:
                found *= 1 + float(self.values[start])
            start += other.d
        return found or 1.0  # of terms that are missing, one cannot have a factor

    def worst(self, p: Parameters, measured: Measurement) -> float:
        """The largest residual of another measurement with these values, over its tolerance."""
        at = self.hypothesis.apply(p, self.values)
        basis = basis_of(self.hypothesis, at if self.moving else p, measured)
        with np.errstate(all="ignore"):
            left = _residuals([at], self.values[None], measured, measured.tolerances(at), basis)
        return float(np.max(np.abs(left), initial=0.0))


def basis_of(hypothesis: Hypothesis, p: Parameters, measured: Measurement) -> Array | None:
    """The torques that values of one add besides, (d, S, n); None where the parameters alone change."""
    return None if hypothesis.basis is None else hypothesis.basis(p, measured)


def fit(hypothesis: Hypothesis, p: Parameters, measured: Measurement) -> FittedHypothesis:
    """The hypothesis with the values that leave the least residual, by Gauss-Newton from zero.

    ``p``: the expected parameters, at which the values are zero.
    """
    with np.errstate(all="ignore"):
        return _gauss_newton(hypothesis, p, measured)


def refit(found: FittedHypothesis, p: Parameters, measured: Measurement) -> FittedHypothesis:
    """A fit of numbers and terms at once, continued with the terms that belong to the other numbers.

    A sign that is wrong is −1 times the term of the mechanism that the engine has, not of the one expected.
    """
    with np.errstate(all="ignore"):
        return _gauss_newton(found.hypothesis, p, measured, found.values, moving=True)


def _gauss_newton(
    hypothesis: Hypothesis, p: Parameters, measured: Measurement, start: Array | None = None, *, moving: bool = False
) -> FittedHypothesis:
    """``moving``: terms are those of the numbers as they are fitted, not of the expected ones."""
    x, sizes = np.zeros(hypothesis.d) if start is None else start, hypothesis.sizes
    basis = basis_of(hypothesis, p, measured)
    best: FittedHypothesis | None = None
    without_gain = 0
    for _ in range(MOST_STEPS):
        at = hypothesis.apply(p, x)
        scale = measured.tolerances(at)
        if moving:
            basis = basis_of(hypothesis, at, measured)
        residuals = _residuals([at], x[None], measured, scale, basis)[0]
        worst = float(np.max(np.abs(residuals)))
        columns = _columns(hypothesis, p, x, measured, scale, basis, moving=moving)
        if not (np.isfinite(worst) and np.isfinite(columns).all()):
            break
        step, spread = _solve(columns, residuals)
        without_gain = without_gain + 1 if best is not None and worst > 0.5 * best.residual else 0
        if best is None or worst < best.residual:
            best = FittedHypothesis(hypothesis, x.copy(), spread * sizes, worst, moving)
        if without_gain > (0 if best.explains else 2):
            break
        x = x + step * sizes
        if not np.isfinite(x).all():
            break
    return best if best is not None else FittedHypothesis(hypothesis, x, x, np.inf)


@dataclass(frozen=True)
class Screen:
    """The first step of every hypothesis.

    ``responses``: an orthonormal base of what it changes in the residuals, (2, N) each, the second row zero where it
    has one value; ``shares``: the residuals' part along it, (2,) each.
    """

    hypotheses: tuple[Hypothesis, ...]
    total: float  # mean square of the residuals
    responses: Array  # (H, 2, N)
    shares: Array  # (H, 2)

    def ranked(self) -> list[tuple[float, Hypothesis]]:
        """(root mean square of the residual after one step, hypothesis), least first."""
        left = np.sqrt(np.maximum(self.total - (self.shares**2).sum(axis=1), 0.0))
        order = np.argsort(left, kind="stable")
        return [(float(left[k]), self.hypotheses[k]) for k in order]

    def pairs(self, most: int) -> list[tuple[Hypothesis, Hypothesis]]:
        """The pairs that leave the least residual after one step, least first."""
        found: list[tuple[float, int, int]] = []
        count = len(self.hypotheses)
        two = np.asarray(self.responses[:, 1].any(axis=1), dtype=np.bool_)
        for h in range(count - 1):
            others = slice(h + 1, count)
            mixed = np.einsum("an,kbn->kab", self.responses[h], self.responses[others])  # (K, 2, 2)
            own = self.shares[others] - np.einsum("kab,a->kb", mixed, self.shares[h])
            left = np.eye(2) - np.einsum("kab,kac->kbc", mixed, mixed)
            left[~two[others], 1, 1] = 1.0
            determinant = left[:, 0, 0] * left[:, 1, 1] - left[:, 0, 1] ** 2
            gain = (
                left[:, 1, 1] * own[:, 0] ** 2
                + left[:, 0, 0] * own[:, 1] ** 2
                - 2 * left[:, 0, 1] * own[:, 0] * own[:, 1]
            )
            gain = np.divide(gain, determinant, out=np.zeros_like(gain), where=determinant > PARALLEL)
            after = self.total - (self.shares[h] ** 2).sum() - gain
            kept = np.argsort(after, kind="stable")[: min(most, len(after))]
            found += [(float(after[k]), h, h + 1 + int(k)) for k in kept]
        found.sort()
        return [(self.hypotheses[a], self.hypotheses[b]) for _, a, b in found[:most]]


def screen(hypotheses: Sequence[Hypothesis], p: Parameters, measured: Measurement) -> Screen:
    """One linear step of each hypothesis of one or two values; those that change nothing are left out.

    All that change parameters are perturbed in a few large batches.
    """
    with np.errstate(all="ignore"):
        scale = measured.tolerances(p)
        residuals = measured.residuals(p, scale).ravel()
        size = 1 / np.sqrt(residuals.size)
        kept, responses, shares = [], [], []
        for hypothesis, columns in zip(hypotheses, _responses(hypotheses, p, measured, scale), strict=True):
            base = _orthonormal(columns)
            if base is None:
                continue
            kept.append(hypothesis)
            responses.append(base)
            shares.append(base @ residuals * size)
    empty = np.zeros((0, 2, residuals.size))
    return Screen(
        tuple(kept),
        float(np.mean(residuals**2)),
        np.stack(responses) if responses else empty,
        np.stack(shares) if shares else np.zeros((0, 2)),
    )


def screened(hypotheses: Sequence[Hypothesis], p: Parameters, measured: Measurement) -> list[tuple[float, Hypothesis]]:
    """(residual, hypothesis) after one linear step of each: root mean square over tolerance, least first."""
    return screen(hypotheses, p, measured).ranked()


def _orthonormal(columns: Array) -> Array | None:
    """(2, N) from (N, d), d ≤ 2; None where the first column is zero or something is not finite."""
    if not np.isfinite(columns).all():
        return None
    base = np.zeros((2, len(columns)))
    row = 0
    for column in columns.T:
        length = float(np.linalg.norm(column))
        if not length:
            continue
        rest = column / length
        for before in base[:row]:
            rest = rest - before * (before @ rest)
        left = float(np.linalg.norm(rest))
        if left > 1e-6:
            base[row] = rest / left
            row += 1
    return base if row else None


def _responses(hypotheses: Sequence[Hypothesis], p: Parameters, measured: Measurement, scale: Array) -> list[Array]:
    """Changes of the residuals by each hypothesis' values, (N, d) each."""
    perturbations = [(h, k, sign) for h in hypotheses if h.basis is None for k in range(h.d) for sign in (1.0, -1.0)]
    per_batch = max(2, BATCH_NUMBERS // scale.size // 2 * 2)
    batches = []
    for begin in range(0, len(perturbations), per_batch):
        part = perturbations[begin : begin + per_batch]
        stacked = _stack([h.apply(p, sign * h.sizes[k] * np.eye(h.d)[k]) for h, k, sign in part])
        batches.append(measured.residuals(stacked, scale).reshape(len(part), -1))
    every = np.concatenate(batches) if batches else np.zeros((0, scale.size))
    derivative = (every[0::2] - every[1::2]) / 2
    found, column = [], 0
    for hypothesis in hypotheses:
        basis = basis_of(hypothesis, p, measured)
        if basis is None:
            found.append(derivative[column : column + hypothesis.d].T)
            column += hypothesis.d
        else:
            found.append((forces_to_relative(measured.parents, basis) / scale).reshape(hypothesis.d, -1).T)
    return found


def _residuals(at: Sequence[Parameters], x: Array, measured: Measurement, scale: Array, basis: Array | None) -> Array:
    """Residuals over ``scale`` with parameters ``at`` and values ``x`` (K, d), (K, N)."""
    found = measured.residuals(_stack(at) if len(at) > 1 else at[0], scale)
    if basis is not None:
        found = found + forces_to_relative(measured.parents, np.tensordot(x, basis, 1)) / scale
    return np.asarray(found.reshape(len(at), -1))


def _columns(
    hypothesis: Hypothesis,
    p: Parameters,
    x: Array,
    measured: Measurement,
    scale: Array,
    basis: Array | None,
    *,
    moving: bool,
) -> Array:
    sizes = hypothesis.sizes
    points = [x + sign * sizes[k] * 1e-3 * np.eye(hypothesis.d)[k] for k in range(hypothesis.d) for sign in (1.0, -1.0)]
    at = [hypothesis.apply(p, point) for point in points]
    if moving:
        each = zip(at, points, strict=True)
        bases = [(one, point, basis_of(hypothesis, one, measured)) for one, point in each]
        found = np.concatenate([_residuals([one], point[None], measured, scale, b) for one, point, b in bases])
    else:
        found = _residuals(at, np.array(points), measured, scale, basis)
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
    return Parameters(**{name: np.stack([getattr(p, name) for p in parameters])[:, None, :] for name in NAMES})
