"""MuJoCo with runs that are tampered with."""

from __future__ import annotations

import math

import mujoco
import numpy as np

from furiko.engines import Integrator, load_engine

from .engines import WrappedEngine, adapter, chain_or_more
from .mechanisms import Shape, free, with_hinge


class TamperedRuns(WrappedEngine):
    """MuJoCo, whose runs are tampered with."""

    def __init__(self, tree, run):
        super().__init__(load_engine("mujoco", Shape(tree)), False)
        self.run = run

    def trajectory(self, theta, omega, integrator, step, steps):
        return self.run(super().trajectory, theta, omega, integrator, step, steps)


RK4, EULER = Integrator("RK4", 4), Integrator("Euler", 1)


def runs_late(rng):
    tree = chain_or_more(rng)
    only_rates = rng.random() < 0.5

    def run(inner, theta, omega, name, step, steps):
        before = inner(theta, omega, name, step, steps - 1) if steps > 1 else (theta, omega)
        return (inner(theta, omega, name, step, steps)[0], before[1]) if only_rates else before

    return TamperedRuns(tree, run), free(tree), RK4, False


def runs_first_order(rng):
    tree = chain_or_more(rng)
    return TamperedRuns(tree, lambda inner, t, w, _, h, k: inner(t, w, "Euler", h, k)), free(tree), RK4, False


def runs_damped(rng):
    return runs_damped_by(rng, float(10 ** rng.uniform(-4, -1)))


def runs_damped_by(rng, share):
    """All rates lose this share of themselves in a second."""
    tree = chain_or_more(rng)

    def run(inner, theta, omega, name, step, steps):
        for _ in range(steps):
            theta, omega = inner(theta, omega, name, step, 1)
            omega = omega * (1 - share * step)
        return theta, omega

    return TamperedRuns(tree, run), free(tree), RK4, False


def runs_dissipating(rng):
    """Rates are put right for the constraints after each step: the harder they pull, the more is lost."""
    tree = chain_or_more(rng)
    loss = float(10 ** rng.uniform(-6, -3))

    def run(inner, theta, omega, name, step, steps):
        for _ in range(steps):
            theta, omega = inner(theta, omega, name, step, 1)
            omega = omega * (1 - loss * abs(math.sin(theta.sum())))
        return theta, omega

    return TamperedRuns(tree, run), free(tree), RK4, False


def runs_single(rng):
    tree = chain_or_more(rng)

    def run(inner, theta, omega, name, step, steps):
        for _ in range(steps):
            theta, omega = inner(theta, omega, name, step, 1)
            theta, omega = theta.astype(np.float32).astype(float), omega.astype(np.float32).astype(float)
        return theta, omega

    return TamperedRuns(tree, run), free(tree), RK4, False


def runs_reset(rng):
    """MuJoCo as it comes: after a NaN it begins anew. (One link alone stays stable: its torque is bounded.)"""
    tree = chain_or_more(rng, 2, kind="chain")
    runs = TamperedRuns(tree, lambda inner, *given: inner(*given))
    adapter(runs)._model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    return runs, free(tree), EULER, False


def runs_implicit(rng):
    """MuJoCo's Euler as it comes, on hinges with damping."""
    tree = chain_or_more(rng)
    wanted = free(tree)
    for i in range(tree.n):
        wanted = with_hinge(wanted, i, damping=float(rng.uniform(0.05, 1)))
    runs = TamperedRuns(tree, lambda inner, *given: inner(*given))
    # MuJoCo's own order is depth first.
    adapter(runs)._model.dof_damping[adapter(runs)._hinges] = [hinge.damping for hinge in wanted.hinges]
    return runs, wanted, EULER, False


def runs_chaotic(rng):
    tree = chain_or_more(rng)
    runs = TamperedRuns(tree, lambda inner, *given: inner(*given))
    return runs, free(tree), RK4 if rng.random() < 0.5 else EULER, True


OF_RUNS = {
    "stale-derived-state": runs_late,
    "first-order-integrator": runs_first_order,
    "damping": runs_damped,
    "constraint-dissipation": runs_dissipating,
    "float32": runs_single,
    "silent-reset": runs_reset,
    "implicit-damping": runs_implicit,
    "chaos-only": runs_chaotic,
}
