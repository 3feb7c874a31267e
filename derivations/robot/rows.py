"""Which joint each of an author's rows belongs to, and by what factor: then their terms can be held side by side."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...models.spatial_mechanism import SpatialMechanism
from ...reference.truth.spatial import spatial_truth
from .motion import OwnMotion

Floats = NDArray[np.float64]
SAME = 1e-9  # relative: rows are told apart, not judged; numbers of files and equations are rounded to fewer digits


@dataclass(frozen=True)
class TrueTerms:
    """M (B, n, n); velocity and gravity terms and, with the opposite sign, passive forces, (B, 3, n); a (B, n)."""

    q: Floats
    v: Floats
    mass_matrix: Floats
    rest: Floats
    accelerations: Floats


def true_terms(mechanism: SpatialMechanism, q: Floats, v: Floats) -> TrueTerms:
    """The nearest doubles of the truth in some states, (B, n) each."""
    truths = [spatial_truth(mechanism, *state) for state in zip(q, v, strict=True)]
    rest = [[t.velocity.float, t.gravity.float, -t.passive.float] for t in truths]
    return TrueTerms(
        q, v, _cleaned(np.array([t.mass_matrix.float for t in truths])), _cleaned(np.array(rest)),
        np.array([t.accelerations.float for t in truths]),
    )  # fmt: skip


def _cleaned(terms: Floats) -> Floats:
    """Zero for what is a ball about zero: less than rounding of the largest in its state."""
    largest = np.abs(terms).max(axis=(1, 2), keepdims=True)
    return np.where(np.abs(terms) <= 2.0**-52 * largest, 0.0, terms)


def alignment(motion: OwnMotion, true: TrueTerms) -> Floats | None:
    """S (n, n): S times the author's rows are rows of the joints' coordinates, scaled like M; None where none are.

    A row belongs to the joint, or to the author's coordinate, with which most of its terms agree up to one factor, if
    these are half of them. Rows that give the right accelerations have all terms right, or are combined.
    """
    if motion.dampers is not None:
        return np.eye(motion.n)
    matrix, rest = motion.floats(true.q, true.v)
    given = np.concatenate([matrix, rest.transpose(0, 2, 1)], axis=2)  # (B, row, n columns and 3 parts)
    right = np.concatenate([true.mass_matrix, true.rest.transpose(0, 2, 1)], axis=2)
    turns = np.array(motion.coordinates.turns, dtype=np.float64)
    best: tuple[int, Floats] | None = None
    for mixed in (np.eye(motion.n), np.linalg.inv(turns).T):
        found = _paired(given, mixed @ right)
        if found is not None and (best is None or found[0] > best[0]):
            best = found[0], np.linalg.inv(mixed) @ found[1]
    if best is None:
        return None
    scaled = best[1] @ given
    right_in_sum = rows_same(motion.accelerations(true.q, true.v), true.accelerations)
    return None if right_in_sum and not same(scaled, right) else best[1]


def _paired(given: Floats, right: Floats) -> tuple[int, Floats] | None:
    """How many terms agree, and the matrix with each row's factor at the place of its partner."""
    n = given.shape[1]
    pairs = [(-votes, abs(i - j), i, j, factor) for i in range(n) for j in range(n)
             for votes, factor in [_factor(given[:, i], right[:, j])] if votes]  # fmt: skip
    scale, total = np.zeros((n, n)), 0
    for votes, _, i, j, factor in sorted(pairs):
        if not scale[:, i].any() and not scale[j].any():
            scale[j, i] = factor
            total -= votes
    return (total, scale) if np.count_nonzero(scale) == n else None


def _factor(given: Floats, right: Floats) -> tuple[int, float]:
    """The factor that most terms of a row bear out in all states, (B, terms) each; and how many do."""
    best = 0, 0.0
    for k in range(given.shape[1]):
        there = np.abs(given[:, k]) > 0
        if not there.any():
            continue
        factor = float(np.median(right[there, k] / given[there, k]))
        if not factor:
            continue
        there_too = [j for j in range(given.shape[1]) if np.any(given[:, j]) or np.any(right[:, j])]
        votes = sum(same(factor * given[:, j], right[:, j]) for j in there_too)
        if votes > best[0] and 2 * votes >= len(there_too):
            best = int(votes), factor
    return best


def rows_same(one: Floats, other: Floats) -> bool:
    """The same of each row: of the accelerations in each state."""
    return all(same(a, b) for a, b in zip(one, other, strict=True))


def same(one: Floats, other: Floats) -> bool:
    """Whether two series of numbers are equal but for the rounding of what is in the files."""
    size = np.abs(other).max(initial=0.0)
    return bool(np.isfinite(one).all() and np.abs(one - other).max(initial=0.0) <= SAME * (size or 1e-300))
