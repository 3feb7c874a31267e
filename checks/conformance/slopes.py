"""What an adapter's derivatives and its inverse mass matrix are: rows, columns, signs, angles."""

from __future__ import annotations

import numpy as np

from ...diagnosis.slopes import Mistake, conventions, mistakes
from ...models.coordinates import absolute_from_relative
from ...models.systems import DocumentSystem
from ...records.listings import ConformanceStep
from ...reference import mass_matrix
from ...reference.truth.derivatives import enclosed_derivatives
from ..facts import stacked
from .subject import GROSS, MECHANISMS, Array, Subject, Wrong, apart, array, right, states

HELP = "Row i is that of the acceleration of link i, column k that of the angle, rate or force of link k, all absolute."
RATES = "derivatives by rates"


def derivatives(subject: Subject) -> ConformanceStep:
    """∂θ̈/∂θ and ∂θ̈/∂θ̇ are those of the theory."""
    for name, engine in subject.engines.items():
        system = MECHANISMS[name]
        theta, omega = states(system.n)
        answer = engine.derivatives(theta.copy(), omega.copy())
        if not isinstance(answer, tuple) or len(answer) != 2:
            raise Wrong(
                f"derivatives: the answer is {type(answer).__name__}, and two matrices for each state are due",
                "Return (∂θ̈/∂θ, ∂θ̈/∂θ̇), shape (B, n, n) each.",
            )
        true = stacked(enclosed_derivatives(system, theta, omega))[0]
        for part, words in enumerate(("derivatives by angles", RATES)):
            _compare(words, name, array(words, answer[part], true[:, part].shape), part, true, system, theta)
    return right("derivatives", "they are the theory's, row by row and column by column")


def inverse_mass(subject: Subject) -> ConformanceStep:
    """M⁻¹ is that of absolute angles."""
    for name, engine in subject.engines.items():
        system = MECHANISMS[name]
        theta, omega = states(system.n)
        true = stacked(enclosed_derivatives(system, theta, omega))[0]
        got = array("inverse_mass", engine.inverse_mass(theta.copy()), true[:, 2].shape)
        _compare("inverse mass matrix", name, got, 2, true, system, theta)
    return right("inverse mass matrix", "it is that of absolute angles")


def _compare(words: str, name: str, got: Array, part: int, true: Array, system: DocumentSystem, theta: Array) -> None:
    """One rod has no derivatives by rates: an engine's rounding is held beside the rod's natural rate there."""
    wanted = true[:, part]
    least = float(np.sqrt(np.abs(true[:, 0]).max())) if words == RATES else 0.0
    if apart(got, wanted, least) <= GROSS:
        return
    size = f"{words}: for {name} off by {apart(got, wanted, least):.3g} of the largest"
    candidates: list[Mistake] = [
        *mistakes(part, true, mass_matrix(system, theta)),
        *conventions(part, wanted, np.asarray(absolute_from_relative(system.tree().parents))),
    ]
    for mistake in candidates:
        if apart(got, mistake.gives, least) <= GROSS:
            raise Wrong(f"{size}: {mistake.says}", HELP)
    raise Wrong(f"{size}, and no usual mistake of an adapter explains it", HELP)
