"""The claim of each of the 57 equations, as differences from first principles that must vanish.

A claim is about any motion, not only a true one: an equation of motion must be, side minus side, Lagrange's row times
the stated factor for every value of θ, θ̇ and θ̈ (and Takeno's, made from forces, must be the same rows).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
Members = tuple[Any, ...]
Values = Mapping[str, Any]
Claim = Callable[[Members, Values], list[Any]]


def is_(name: str, pick: Callable[[Any], Any] = lambda x: x) -> Claim:
    """Every member is the first-principles quantity."""
    return lambda members, v: [member - pick(v[name]) for member in members]


def sides(factor: Callable[[Values], Any]) -> Claim:
    """(left - right) · factor is Lagrange's row."""
    return lambda members, v: [(members[0] - members[1]) * factor(v) - v["row"]]


def momenta(members: Members, v: Values) -> list[Any]:
    """Momenta and their rates, stacked."""
    return [members[0][0] - v["momentum"], members[0][1] - v["momentum_rate"]]


def matrices(members: Members, v: Values) -> list[Any]:
    """Shiki (3.12): row i of Lagrange over l_i; B has gravity on its diagonal, squared rates beside it."""
    l, n = v["l"], len(v["l"])
    differences = []
    for i in range(n):
        for j in range(n):
            differences.append(members[0][0][i, j] * l[i] - v["mass_matrix"][i, j])
            expected = v["gravity"][i] if i == j else v["rate_matrix"][i, j] * v["omega"][j] ** 2
            differences.append(members[0][1][i, j] * l[i] - expected)
    return differences


def solved(members: Members, v: Values) -> list[Any]:
    """θ̈ on the left equals the right side."""
    return [members[0] - members[1]]


def joint_force_sums(members: Members, v: Values) -> list[Any]:
    """T_j + T_{j-1}."""
    return [member - (v["T"][1:] + v["T"][:-1]) for member in members]


def chain_matrices(members: Members, v: Values) -> list[Any]:
    """Takeno (21)."""
    return [members[0][0] - v["A"], members[0][1] - v["B"]]


def weights(members: Members, v: Values) -> list[Any]:
    """m_j + 2 Σ m_i over the rods below, added up one by one."""
    m = v["m"]
    expected = [m[j] + sum((m[i] * 2 for i in range(j + 1, len(m))), m[j] * 0) for j in range(len(m))]
    return [member[j] - expected[j] for member in members for j in range(len(m))]


def _one(v: Values) -> Any:
    return np.array([v["l"][0] * 0 + 1] * len(v["l"]), dtype=object)


def _l(v: Values) -> Any:
    return v["l"]


def _rho_l(v: Values) -> Any:
    return v["l"] * v["rho"]


def _rho_l3(v: Values) -> Any:
    return v["l"] ** 3 * v["rho"]


CLAIMS: dict[str, Claim] = {
    "shiki 1.1": is_("position"), "shiki 1.2": is_("speed_squared", lambda v: v[0]),
    "shiki 1.3": is_("speed_squared", lambda v: v[1]), "shiki 1.4": is_("lagrangian"), "shiki 1.5": sides(_one),
    "shiki 1.6": momenta, "shiki 1.7": is_("dL_dtheta"), "shiki 1.8": sides(_one), "shiki 1.9": sides(_l),
    "shiki 1.10": sides(_l), "shiki 1.11": solved,
    "shiki 2.1": is_("position"), "shiki 2.2": is_("speed_squared", lambda v: v[0]),
    "shiki 2.3": is_("speed_squared", lambda v: v[1]), "shiki 2.4": is_("speed_squared", lambda v: v[2]),
    "shiki 2.5": is_("lagrangian"), "shiki 2.6": sides(_one), "shiki 2.7": momenta, "shiki 2.8": is_("dL_dtheta"),
    "shiki 2.9": sides(_one), "shiki 2.10": sides(_l), "shiki 2.11": sides(_l), "shiki 2.12": solved,
    "shiki 3.1": is_("position"), "shiki 3.2": is_("speed_squared", lambda v: v[0]),
    "shiki 3.3": is_("speed_squared", lambda v: v[1:]), "shiki 3.4": is_("lagrangian"), "shiki 3.5": sides(_one),
    "shiki 3.6": momenta, "shiki 3.7": is_("dL_dtheta"), "shiki 3.8": sides(_one), "shiki 3.9": sides(_l),
    "shiki 3.10": solved, "shiki 3.11": lambda members, v: [members[0][0] - v["alpha"], members[0][1] - v["e"]],
    "shiki 3.12": matrices,
    "takeno 1": is_("r_hat"), "takeno 2": is_("r"), "takeno 3": solved, "takeno 4": sides(_one), "takeno 5": is_("I"),
    "takeno 6": sides(_l), "takeno 7": solved, "takeno 8": is_("T", lambda v: v[:-1]), "takeno 9": joint_force_sums,
    "takeno 10": is_("r"), "takeno 11": is_("a"), "takeno 12": is_("L"), "takeno 13": weights,
    "takeno 14": is_("carried"), "takeno 15": is_("b"), "takeno 16": joint_force_sums, "takeno 17": sides(_rho_l),
    "takeno 18": sides(_rho_l), "takeno 19": sides(_rho_l3), "takeno 20": is_("alpha_jk"), "takeno 21": chain_matrices,
    "takeno 22": sides(_rho_l),
}  # fmt: skip


def directions(members: Members, v: Values) -> list[Any]:
    """l p(θ) leads from joint to joint; q is p turned by a right angle to the left: p·q = 0, p × q = q·q = 1."""
    p, q = members
    along = [v["l"][:, None] * p - (v["r_hat"][1:] - v["r_hat"][:-1])]
    return [*along, (p * q).sum(-1), _cross(p, q) - 1, (q * q).sum(-1) - 1]


def moments(joint: Callable[[Any], Any], force: Callable[[Any], Any]) -> Claim:
    """Every member is the moment (r̂ - r_j) × force."""
    return lambda members, v: [member - _cross(joint(v["r_hat"]) - v["r"], force(v["T"])) for member in members]


def pairs_of(name: str, below: bool) -> Claim:
    """Every member is the first-principles entry j, k for all j < k, or the one across the diagonal."""

    def claim(members: Members, v: Values) -> list[Any]:
        n = len(v["l"])
        places = [(j, k) if not below else (k, j) for j in range(n) for k in range(j + 1, n)]
        return [member - np.array([v[name][place] for place in places]) for member in members]

    return claim


def rotation(members: Members, v: Values) -> list[Any]:
    """Side minus side, times l, is Lagrange's row; the last two forms are the same."""
    return [(members[0] - members[1]) * v["l"] - v["row"], members[1] - members[2]]


def _cross(a: Any, b: Any) -> Any:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


UNNUMBERED_CLAIMS: dict[str, Claim] = {
    "takeno before 1": directions,
    "takeno before 4, first": moments(lambda r: r[1:], lambda T: T[1:]),
    "takeno before 4, second": moments(lambda r: r[:-1], lambda T: -T[:-1]),
    "takeno before 8": is_("T", lambda v: v[:-1]),
    "takeno before 15, first": is_("b"),
    "takeno before 15, k < j": pairs_of("b", below=True),
    "takeno before 15, k = j": is_("b", np.diagonal),
    "takeno before 15, k > j": pairs_of("b", below=False),
    "takeno before 17, first": is_("p_ddot"),
    "takeno before 17, second": solved,
    "takeno before 17, third": rotation,
    "takeno before 18": solved,
    "takeno before 19": is_("alpha_jk"),
    "takeno after 22": lambda members, v: [member - v[name] for member, name in zip(members, "AABB", strict=True)],
}

EQUAL_LENGTHS = ("takeno 19", "takeno before 19", "takeno after 22")
SOLVES = ("shiki 1.11", "shiki 2.12", "shiki 3.10")  # need a matrix inverted: judged in balls, on true motions


def differences(key: str, members: Members, values: Values) -> list[Any]:
    """All numbers that must vanish for the equation to hold, in one flat list."""
    return [
        x for part in (CLAIMS | UNNUMBERED_CLAIMS)[key](members, values) for x in np.asarray(part, dtype=object).ravel()
    ]
