"""Mechanisms of any shape, and their equations of motion from virtual work, in ball arithmetic."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import pytest

from furiko.engines import ENGINES
from furiko.models import Link, PlanarTree


@dataclass(frozen=True)
class Mechanism:
    """Any planar tree as a system."""

    links: tuple[Link, ...]
    gravity: float = 9.81
    kind: str = field(default="any-tree")

    @property
    def n(self):
        return len(self.links)

    @property
    def lengths(self):
        return tuple(link.length for link in self.links)

    @property
    def masses(self):
        return tuple(link.mass for link in self.links)

    def tree(self):
        return PlanarTree(self.links, self.gravity)


def random_tree(seed: int, n: int) -> Mechanism:
    """Branching below the first link, hinges and centres of mass off the axis, some point masses."""
    rng = np.random.default_rng(seed)
    links = []
    for i in range(n):
        along, across, com_along, com_across = rng.uniform([0.3, -0.3, 0.3, -0.2], [1.0, 0.3, 0.8, 0.2])
        parent = int(rng.integers(0, i)) if i else -1
        inertia = float(rng.choice([0.0, rng.uniform(0.01, 0.1)]))
        hinge = (0.0, 0.0) if parent < 0 else (float(along), float(across))
        mass = float(rng.uniform(0.2, 2))
        links.append(Link(parent, hinge, float(along), (float(com_along), float(com_across)), mass, inertia))
    return Mechanism(tuple(links))


def equations(tree: PlanarTree, theta, omega) -> SimpleNamespace:
    """Virtual work, 200 bits: M α + bias = τ, the energies, and what the joints carry, for one state.

    A link's centre of mass is a sum of arms, one for each link from the support to it, each turned by that link's
    angle: r = Σ R(θ_a) p_a, dr/dθ_a = e_a, r̈ = Σ e_a α_a - R(θ_a) p_a ω_a².
    """
    import flint

    flint.ctx.prec = 200
    arb = flint.arb
    n = tree.n
    angles = [arb(float(x)) for x in theta]
    rates = [arb(float(x)) for x in omega]
    turned = [(angle.cos(), angle.sin()) for angle in angles]

    def arm(link, point):  # (x, z) of a point of the link's frame, and its derivative by the angle
        (c, s), along, across = turned[link], arb(point[0]), arb(point[1])
        return (along * s + across * c, across * s - along * c), (along * c - across * s, across * c + along * s)

    arms = []
    for i, link in enumerate(tree.links):
        path = {i: arm(i, link.com)}
        child = i
        while tree.links[child].parent >= 0:
            path[tree.links[child].parent] = arm(tree.links[child].parent, tree.links[child].hinge)
            child = tree.links[child].parent
        arms.append(path)

    g = arb(tree.gravity)
    mass_matrix = [[arb(0)] * n for _ in range(n)]
    velocity_terms, weight_terms = [arb(0)] * n, [arb(0)] * n
    kinetic, potential = arb(0), arb(0)
    for i, link in enumerate(tree.links):
        m = arb(link.mass)
        mass_matrix[i][i] += arb(link.inertia)
        centripetal = [-sum((p[axis] * rates[a] ** 2 for a, (p, _) in arms[i].items()), arb(0)) for axis in (0, 1)]
        speed = [sum((e[axis] * rates[a] for a, (_, e) in arms[i].items()), arb(0)) for axis in (0, 1)]
        kinetic += (m * (speed[0] ** 2 + speed[1] ** 2) + arb(link.inertia) * rates[i] ** 2) / 2
        potential += m * g * sum((p[1] for p, _ in arms[i].values()), arb(0))
        for a, (_, e) in arms[i].items():
            velocity_terms[a] += m * (e[0] * centripetal[0] + e[1] * centripetal[1])
            weight_terms[a] += m * g * e[1]
            for b, (_, f) in arms[i].items():
                mass_matrix[a][b] += m * (e[0] * f[0] + e[1] * f[1])

    def joint_forces(alpha):
        loads = [[arb(0), arb(0)] for _ in range(n)]
        for i in reversed(range(n)):
            link = tree.links[i]
            for axis in (0, 1):
                pushed = sum(
                    (e[axis] * arb(float(alpha[a])) - p[axis] * rates[a] ** 2 for a, (p, e) in arms[i].items()), arb(0)
                )
                loads[i][axis] -= arb(link.mass) * (pushed + (g if axis else 0))
                if link.parent >= 0:
                    loads[link.parent][axis] += loads[i][axis]
        return np.array([[float(x) for x in load] for load in loads])

    matrix = flint.arb_mat(mass_matrix)
    right = flint.arb_mat([[-(v + w)] for v, w in zip(velocity_terms, weight_terms, strict=True)])
    solved = matrix.solve(right)
    return SimpleNamespace(
        mass_matrix=np.array([[float(x) for x in row] for row in mass_matrix]),
        velocity_terms=np.array([float(x) for x in velocity_terms]),
        weight_terms=np.array([float(x) for x in weight_terms]),
        accelerations=np.array([float(solved[i, 0]) for i in range(n)]),
        energy=np.array([float(kinetic), float(potential)]),
        joint_forces=joint_forces,
    )


@pytest.fixture
def virtual_work() -> Callable[..., SimpleNamespace]:
    return equations


@pytest.fixture
def any_tree() -> Callable[[int, int], Mechanism]:
    return random_tree


@pytest.fixture(params=list(ENGINES))
def engine(request) -> str:
    return request.param
