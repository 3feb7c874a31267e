"""Answers to the questions that the documents leave open: an argument for each, and numbers over random states."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...models import NLegPendulum, RodChain
from ...reference import mass_matrix
from ..algebra.symbols import symbols_of
from ..grading.grade import grade_text
from ..mistakes.catalogue import catalogue
from ..steps.derivation import derive
from .chain_limit import limit, tip
from .cost import cost
from .question import Question

Array = NDArray[np.float64]


def open_questions(states: int = 200) -> list[Question]:
    """All five questions, answered; ``states``: random states for each system."""
    return [determinant(states), existence(states), limit(), tip(), wikipedia()]


def _chain(n: int) -> RodChain:
    draw = np.random.default_rng(n)
    return RodChain(tuple(draw.uniform(0.5, 1.5, n)))


def determinant(states: int = 200) -> Question:
    """Whether |A(θ)| ≠ 0 for every n, as Takeno's section 6 conjectures from n = 2, 3."""
    table = []
    for n in (1, 2, 3, 10, 80, 200):
        system = _chain(n)
        theta = np.random.default_rng(1).uniform(-np.pi, np.pi, (states if n < 80 else max(states // 20, 4), n))
        scale = system.density * np.array(system.lengths)
        sign, logarithm = np.linalg.slogdet(mass_matrix(system, theta) / scale[:, None])
        rest = np.linalg.slogdet(mass_matrix(system, np.zeros(n)) / scale[:, None])[1]
        table.append({
            "n": n, "states": len(theta), "all positive": bool((sign > 0).all()),
            "log|A| from": float(logarithm.min()), "to": float(logarithm.max()), "log|A(0)|": float(rest),
            "never below log|A(0)|": bool((logarithm >= rest - 1e-9 * n).all()),
        })  # fmt: skip
    return Question(
        "Takeno, section 6: is |A(θ)| ≠ 0 for every n?",
        "Yes, for every n, all lengths and all angles: det A(θ) > 0, and it is smallest where the chain is straight.",
        "With D = diag(ρ l_j), M(θ) = D A(θ) is the matrix of the kinetic energy, ½ θ̇ᵀ M θ̇ = Σ ½ ∫ |v|² dm. It is zero "
        "only if every point of every rod rests, that is if θ̇ = 0: M is positive definite and "
        "det A = det M / Π ρ l_j > 0. "
        "Entry by entry, M_jk(θ) = M_jk(0) · cos(θ_j - θ_k), and the matrix of cosines is c cᵀ + s sᵀ with "
        "c = (cos θ_j), s = (sin θ_j): positive semidefinite with ones on its diagonal. Oppenheim's inequality then "
        "gives det M(θ) ≥ det M(0) > 0.",
        {"random states": table},
    )


def existence(states: int = 200) -> Question:
    """Whether solutions exist for all times (Takeno, section 6)."""
    table = []
    systems: list[RodChain | NLegPendulum] = [_chain(2), _chain(5), _chain(20)]
    systems.append(NLegPendulum((1.0, 0.5, 0.8, 1.2), (1.0, 0.3, 2.0, 0.7)))
    for system in systems:
        theta = np.random.default_rng(2).uniform(-np.pi, np.pi, (states, system.n))
        smallest = np.linalg.eigvalsh(mass_matrix(system, theta))[:, 0].min()
        bound = np.linalg.eigvalsh(mass_matrix(system, np.zeros(system.n)))[0]
        energy = 2 * system.gravity * sum(m * _reach(system, j) for j, m in enumerate(system.masses))
        table.append({
            "system": system.kind, "n": system.n, "smallest eigenvalue of M(θ) met": float(smallest),
            "its bound, that of M(0)": float(bound), "holds": bool(smallest >= bound * (1 - 1e-9)),
            "no rate exceeds, released at rest from anywhere [rad/s]": float(np.sqrt(2 * energy / bound)),
        })  # fmt: skip
    return Question(
        "Takeno, section 6: do the solutions of (22) exist for all times?",
        "Yes: every solution exists for all times, past and future; so do those of Shiki's (3.10).",
        "A(θ) is invertible and smooth, so that θ̈ = f(θ, θ̇) with smooth f, and a solution can only end by leaving "
        "every bounded set of rates. It cannot: the energy E = ½ θ̇ᵀ M(θ) θ̇ + U(θ) is constant and U is bounded below, "
        "while the smallest eigenvalue of M(θ) is never below that of M(0) (M(θ) is the entrywise product of M(0) with "
        "a positive semidefinite matrix with ones on its diagonal). Hence |θ̇|² ≤ 2 (E - min U) / λ_min(M(0)) at all "
        "times; the squares of the rates in (22) do no harm.",
        {"random states": table},
    )


def _reach(system: RodChain | NLegPendulum, j: int) -> float:
    l = system.lengths
    return sum(l[: j + 1]) if isinstance(system, RodChain) else l[0] + (l[j] if j else 0.0)


COUPLING_1 = r"\frac{1}{2}\{\ddot{\theta}_2\cos(\theta_1-\theta_2) + (\dot{\theta}_2)^2\sin(\theta_1-\theta_2)\}"
COUPLING_2 = r"\frac{1}{2}\{\ddot{\theta}_1\cos(\theta_1-\theta_2) - (\dot{\theta}_1)^2\sin(\theta_1-\theta_2)\}"
WIKIPEDIA = rf"""
system = "rod-chain"
links = 2
[equations]
1 = '\frac{{5}}{{4}}\ddot{{\theta}}_1 + {COUPLING_1} + \frac{{3g}}{{2l}}\sin\theta_1 = 0'
2 = '{COUPLING_2} + \frac{{1}}{{4}}\ddot{{\theta}}_2 + \frac{{g}}{{2l}}\sin\theta_2 = 0'
"""


def wikipedia() -> Question:
    """Which coefficients Takeno's section 6 reports from Wikipedia in 2018: those without the rods' own inertia."""
    m = symbols_of("rod-chain", 2)
    mistake = next(x for x in catalogue(m) if x.name == "inertia-missing")
    answer = grade_text(WIKIPEDIA)
    forgotten = cost("rods' own inertia forgotten", m, derive(m, [mistake]).rows)
    return Question(
        "Takeno, section 6: which equations did Wikipedia give in November 2018?",
        "With the diagonal coefficients 5/4 and 1/4 in place of 4/3 and 1/3: each rod turned into a point mass at its "
        "middle (reconstructed from the remark; the other difference, the factor of g, is described there as a slip of "
        "writing and not what it was).",
        "Without ½ I θ̇², I = m l²/12, Lagrange's equations of two equal rods are (19) with 4/3 - 1/12 = 5/4 and "
        "1/3 - 1/12 = 1/4. Graded as a derivation, they are wrong, and only that mistake is named.",
        {
            "graded as a derivation": {
                "verdict": answer.verdict,
                "mistakes named": [named.cause for named in answer.mistakes],
            },
            "its terms": [{"term": f.term, "printed": f.found, "right": f.expected} for f in answer.findings],
            "what it costs": {
                "error of the accelerations, median": forgotten.median_error,
                "most": forgotten.largest_error,
                "0.1 rad off after [s], small swing": forgotten.divergence_small,
                "large swing": forgotten.divergence_large,
            },
            "small oscillations of two rods of 1 m [rad/s]": _frequencies(),
        },
    )


def _frequencies() -> list[dict[str, str | float]]:
    """Of two rods of 1 m: ω² from det(G - ω² A) = 0."""
    gravity = 9.81 * np.diag([1.5, 0.5])
    out: list[dict[str, str | float]] = []
    for name, (a, b) in {"right": (4 / 3, 1 / 3), "rods' own inertia forgotten": (5 / 4, 1 / 4)}.items():
        inertia = np.array([[a, 0.5], [0.5, b]])
        squares = np.linalg.eigvals(np.linalg.solve(inertia, gravity))
        slow, fast = sorted(float(np.sqrt(x.real)) for x in squares)
        out.append({"equations": name, "slow": slow, "fast": fast})
    return out
