"""The last questions of Takeno's section 6: the chain as n → ∞, and its violent tip, with a measurement of each."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...models.errors import LibraryMissing
from ...reference import gravity_vector, mass_matrix
from ...reference.chain import bow, chain, swing_errors
from ...reference.integration.schemes import classical_step
from .question import Question

Array = NDArray[np.float64]

SWINGS = (10, 20, 40, 100, 400)
TIP_RODS = (5, 10, 20, 40)
END, SMOOTH = 0.52, 0.4  # [s]; the whip cracks a little before the end
STEP = 4e-4  # [s]: a thirtieth of the fastest swing of 40 rods, which turn by less than 0.1 rad in a step


def limit() -> Question:
    """What the equations become for n → ∞ with the total length fixed."""
    rows: list[dict[str, Any]] = []
    try:
        for n in SWINGS:
            errors = swing_errors(n, "rods", 3)
            rows.append({"n": n} | {f"swing {k}": float(abs(e)) for k, e in enumerate(errors, 1)})
    except LibraryMissing:  # scipy finds a few swings of many rods
        pass
    return Question(
        "Takeno, section 6: what becomes of (22) for n → ∞, the total length being fixed?",
        "The hanging chain: its small swings converge to Bernoulli's, ω_k = (j₀,k/2) √(g/L), with errors that fall as "
        "1/n². Large motions converge, too, as measured, for as long as they are smooth.",
        "In the joints' displacements the linearised (18) is two tridiagonal matrices, of kinetic and potential "
        "energy; for l → 0 they are the finite elements of (T y′)′ = ρ ÿ with the tension T = ρ g (L − s), whose "
        "solutions are Bessel's J₀. That (22) is not explicit is no obstacle: the accelerations of n rods cost O(n)"
        " operations, by recursion from link to link.",
        {"relative error of the rates of the slowest swings": rows} if rows else {},
    )


def tip() -> Question:
    """Whether the violent motion of the tip is physics or numerics."""
    motions = {n: _motion(n) for n in TIP_RODS}
    smooth = round(SMOOTH / STEP)
    rows = [
        {
            "n": n,
            "largest speed of the tip [m/s]": float(speed.max()),
            "at [s]": float(speed.argmax() * STEP),
            "largest rate of a rod [rad/s]": fastest,
            f"tips of n and 2n rods apart until {SMOOTH:g} s [m]": _apart(place, motions.get(2 * n), smooth),
        }
        for n, (place, speed, fastest) in motions.items()
    ]
    return Question(
        "Takeno, section 6: why does the end of the chain move so violently when n is large?",
        "It is physics, not numerics: the chain cracks like a whip. Until then the tip converges as n grows; at the "
        "crack the curve has a kink at its free end, where the tension vanishes.",
        "Every n starts from rest in one curve, 1 m long. Before the crack the tips of n and of 2n rods come "
        "together; at the crack, at nearly the same time for all n, the rate of the last rod more than doubles "
        "whenever n does, while the speed of the tip gains little more than 1 m/s: what turns is ever shorter. An "
        "integrator needs steps that fall with n, because finer chains resolve more of the kink; with them it keeps"
        " the energy. A scheme without error control breaks there, and that looks like a fault of the equations.",
        {"from rest in one bow": rows},
    )


def _motion(n: int) -> tuple[Array, Array, float]:
    """Place (steps + 1, 2) [m] and speed (steps + 1,) [m/s] of the tip, and the largest rate of a rod [rad/s]."""
    system = chain(n)
    l = np.array(system.lengths)
    straight = mass_matrix(system, np.zeros(n))  # in (21) and (22) the angles are in cosines and sines alone
    weight = gravity_vector(system, np.full(n, np.pi / 2))

    def slope(_: float, y: Array) -> Array:
        theta, omega = y
        c, s = np.cos(theta), np.sin(theta)
        inertia = straight * (np.outer(c, c) + np.outer(s, s))
        squares = straight * (np.outer(s, c) - np.outer(c, s)) @ omega**2
        return np.stack([omega, np.linalg.solve(inertia, -squares - weight * s)])

    y = np.stack([bow(n), np.zeros(n)])
    states = [y]
    for _ in range(round(END / STEP)):
        y = classical_step(slope, y, STEP)
        states.append(y)
    theta, omega = np.array(states).transpose(1, 0, 2)
    place = np.stack([np.sin(theta) @ l, -(np.cos(theta) @ l)], axis=-1)
    rate = np.stack([(np.cos(theta) * omega) @ l, (np.sin(theta) * omega) @ l], axis=-1)
    return place, np.linalg.norm(rate, axis=-1), float(np.abs(omega).max())


def _apart(tips: Array, other: tuple[Array, Array, float] | None, until: int) -> float | None:
    if other is None:
        return None
    return float(np.linalg.norm(tips[: until + 1] - other[0][: until + 1], axis=-1).max())
