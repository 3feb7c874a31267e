"""Real engines that were given another mechanism, or are asked in another convention.

Each function of :data:`OF_ENGINES` returns (engine, expected mechanism); the engine answers in absolute angles, as
adapters do.
"""

from __future__ import annotations

import math
from dataclasses import replace

import mujoco
import numpy as np
import pinocchio

from furiko.engines import load_engine
from furiko.models import PlanarTree, to_urdf
from furiko.models.tree import SUPPORT

from .mechanisms import Shape, free, fused, off, random_tree, with_link

NAMES = ("mujoco", "pinocchio-aba", "exudyn-tree", "pinocchio-crba")


class WrappedEngine:
    """An engine behind an adapter that may hide what it compiled."""

    def __init__(self, engine, shows):
        self._engine = engine
        self.shows = shows
        if shows and "fields" not in engine.info.missing:
            self.fields = engine.fields

    def accelerations(self, theta, omega):
        return self._engine.accelerations(theta, omega)

    def inverse_dynamics(self, theta, omega, alpha):
        return self._engine.inverse_dynamics(theta, omega, alpha)

    def trajectory(self, *given):
        return self._engine.trajectory(*given)


def engine(rng, tree, name=None, shows=None):
    name = str(rng.choice(NAMES)) if name is None else name
    shows = bool(rng.random() < 0.7) if shows is None else shows
    return WrappedEngine(load_engine(name, Shape(tree)), shows)


def adapter(given_engine):
    return given_engine._engine._engine


def chain_or_more(rng, least=1, **given):
    return random_tree(rng, n=int(rng.integers(least, 11)), **given)


# --- Numbers ----------------------------------------------------------------------------------------------------------


def on_other(rng, wanted, other):
    """A real engine on another mechanism."""
    tree = PlanarTree(other.links, other.gravity[0])
    return engine(rng, tree), wanted


def mass(rng):
    wanted = free(chain_or_more(rng))
    i = int(rng.integers(wanted.n))
    return on_other(rng, wanted, with_link(wanted, i, mass=wanted.links[i].mass * off(rng)))


def inertia(rng):
    wanted = free(chain_or_more(rng, bobs=False))
    i = int(rng.integers(wanted.n))
    return on_other(rng, wanted, with_link(wanted, i, inertia=wanted.links[i].inertia * off(rng)))


def point_mass(rng):
    wanted = free(chain_or_more(rng, bobs=True))
    i = int(rng.integers(wanted.n))
    return on_other(rng, wanted, with_link(wanted, i, inertia=float(10 ** rng.uniform(-6, -3))))


def com(rng):
    wanted = free(chain_or_more(rng, bobs=False))
    i = int(rng.integers(wanted.n))
    a, b = wanted.links[i].com
    return on_other(rng, wanted, with_link(wanted, i, com=(a + 0.1, b + float(rng.uniform(0.05, 0.2)))))


def length(rng):
    wanted = free(chain_or_more(rng, 2, kind=str(rng.choice(["chain", "star"]))))
    i = wanted.links[int(rng.integers(1, wanted.n))].parent
    factor, other = off(rng), wanted
    for c in range(wanted.n):
        if wanted.links[c].parent == i:
            other = with_link(other, c, hinge=tuple(factor * x for x in wanted.links[c].hinge))
    return on_other(rng, wanted, other)


def gravity(rng):
    wanted = free(chain_or_more(rng))
    return on_other(rng, wanted, replace(wanted, gravity=(wanted.gravity[0] * off(rng), 0.0)))


def gravity_turned(rng):
    tree = chain_or_more(rng)
    given_engine = engine(rng, tree, str(rng.choice(["mujoco", "pinocchio-aba"])))
    angle = float(rng.choice([-1, 1]) * rng.uniform(0.05, 1))
    vector = tree.gravity * np.array([math.sin(angle), 0.0, -math.cos(angle)])
    model = adapter(given_engine)._model
    if hasattr(model, "opt"):
        model.opt.gravity[:] = vector
    else:
        model.gravity.linear = vector
    return given_engine, free(tree)


def hidden(rng, attribute, everywhere=False):
    tree = chain_or_more(rng)
    given_engine = engine(rng, tree, "mujoco")
    model = adapter(given_engine)._model
    value = float(10 ** rng.uniform(-3, 0))
    which = slice(None) if everywhere or rng.random() < 0.3 else int(rng.integers(tree.n))
    getattr(model, attribute)[which] = value
    return given_engine, free(tree)


def armature(rng):
    return hidden(rng, "dof_armature")


def damping(rng):
    return hidden(rng, "dof_damping")


def stiffness(rng):
    given_engine, wanted = hidden(rng, "jnt_stiffness")
    adapter(given_engine)._model.qpos_spring[:] = rng.uniform(-1, 1, wanted.n)
    return given_engine, wanted


class WithDryFriction(WrappedEngine):
    """MuJoCo with a torque of constant size against each hinge's relative rate."""

    def __init__(self, inner, sizes, parents):
        super().__init__(inner._engine, inner.shows)
        self.sizes, self.parents = sizes, parents

    def _push(self, omega):
        relative = omega - np.array([omega[p] if p != SUPPORT else 0.0 for p in self.parents])
        data, columns = adapter(self)._data, adapter(self)._model.jnt_dofadr[adapter(self)._hinges]
        data.qfrc_applied[columns] = -self.sizes * np.sign(relative)

    def accelerations(self, theta, omega):
        found = np.empty_like(theta)
        for row, (t, w) in enumerate(zip(theta, omega, strict=True)):
            self._push(w)
            found[row] = super().accelerations(t[None], w[None])[0]
        return found

    def inverse_dynamics(self, theta, omega, alpha):
        found = super().inverse_dynamics(theta, omega, alpha)
        relative = omega - np.stack([omega[:, p] if p != SUPPORT else 0 * omega[:, 0] for p in self.parents], axis=1)
        torque = self.sizes * np.sign(relative)
        found += torque
        for i, p in enumerate(self.parents):
            if p != SUPPORT:
                found[:, p] -= torque[:, i]
        return found


def friction(rng):
    tree = chain_or_more(rng)
    sizes = np.zeros(tree.n)
    sizes[int(rng.integers(tree.n))] = 10 ** rng.uniform(-3, 0)
    return WithDryFriction(engine(rng, tree, "mujoco"), sizes, tree.parents), free(tree)


def limit(rng):
    tree = chain_or_more(rng)
    given_engine = engine(rng, tree, "mujoco", shows=False)
    model = adapter(given_engine)._model
    i = int(rng.integers(tree.n))
    model.jnt_limited[i], model.jnt_range[i] = 1, [-rng.uniform(0.5, 2.5), rng.uniform(0.5, 2.5)]
    model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    return given_engine, free(tree)


# --- Other conventions ------------------------------------------------------------------------------------------------


class InOtherConvention(WrappedEngine):
    """The adapter changes angles, rates and accelerations on the way by the wrong matrices."""

    def __init__(self, inner, angles, rates=None, answers=None, offset=0.0):
        super().__init__(inner._engine, inner.shows)
        self.angles, self.offset = angles, offset
        self.rates = angles if rates is None else rates
        self.answers = np.linalg.inv(self.rates) if answers is None else answers

    def accelerations(self, theta, omega):
        return super().accelerations(theta @ self.angles.T + self.offset, omega @ self.rates.T) @ self.answers.T

    def inverse_dynamics(self, theta, omega, alpha):
        back = np.linalg.inv(self.answers)
        given = super().inverse_dynamics(theta @ self.angles.T + self.offset, omega @ self.rates.T, alpha @ back.T)
        return given @ back


def sums(tree):
    s = np.eye(tree.n)
    for i, p in enumerate(tree.parents):
        if p != SUPPORT:
            s[i] += s[p]
    return s


def convention(rng):
    tree = chain_or_more(rng, 2, kind=str(rng.choice(["chain", "star"])))
    inner, s, same = engine(rng, tree), sums(tree), np.eye(tree.n)
    way = int(rng.integers(5))
    if way == 0:
        return InOtherConvention(inner, s), free(tree)
    if way == 1:
        return InOtherConvention(inner, same, same, np.linalg.inv(s)), free(tree)
    if way == 2:
        return InOtherConvention(inner, np.linalg.inv(s)), free(tree)
    if way == 3:
        return InOtherConvention(inner, -same, offset=math.pi), free(tree)
    return InOtherConvention(inner, -same, same, same), free(tree)


def degrees(rng):
    tree = chain_or_more(rng)
    same, factor = np.eye(tree.n), float(rng.choice([180 / math.pi, math.pi / 180]))
    way = int(rng.integers(3))
    inner = engine(rng, tree)
    if way == 0:
        return InOtherConvention(inner, factor * same), free(tree)
    if way == 1:
        return InOtherConvention(inner, factor * same, same), free(tree)
    return InOtherConvention(inner, same, same, factor * same), free(tree)


def order(rng):
    tree = chain_or_more(rng, 2)
    n = tree.n
    way = rng.permutation(n)
    while (way == np.arange(n)).all():
        way = rng.permutation(n)
    shuffled, s = np.eye(n)[way], sums(tree)
    matrix = s @ shuffled @ np.linalg.inv(s) if rng.random() < 0.7 else shuffled
    if matrix is shuffled:  # an absolute order is only tried for usual ways to confuse it
        a, b = rng.choice(n, 2, replace=False)
        swapped = np.arange(n)
        swapped[a], swapped[b] = b, a
        matrix = np.eye(n)[swapped]
    return InOtherConvention(engine(rng, tree), matrix), free(tree)


class Unnormalised:
    """Pinocchio with continuous joints, one or more of which are given a pair (cos, sin) that is not of length one."""

    def __init__(self, tree, joint, factor):
        self.tree, self.factor = tree, factor
        self.joints = {joint} if isinstance(joint, int) else set(joint)
        text = to_urdf(Shape(tree)).replace('type="revolute"', 'type="continuous"')
        self.model = pinocchio.buildModelFromXML(text)
        self.model.gravity.linear = np.array([0, 0, -tree.gravity])
        self.data = self.model.createData()
        ids = [self.model.getJointId(name) for name in tree.names("hinge")]
        self.q, self.v = [self.model.idx_qs[j] for j in ids], [self.model.idx_vs[j] for j in ids]
        self.s = sums(tree)

    def accelerations(self, theta, omega):
        back = np.linalg.inv(self.s)
        found = np.empty_like(theta)
        for row, (phi, rate) in enumerate(zip(theta @ back.T, omega @ back.T, strict=True)):
            q, v = np.empty(self.model.nq), np.empty(self.model.nv)
            for i in range(self.tree.n):
                r = self.factor if i in self.joints else 1.0
                q[self.q[i]], q[self.q[i] + 1] = r * math.cos(phi[i]), r * math.sin(phi[i])
                v[self.v[i]] = rate[i]
            a = pinocchio.aba(self.model, self.data, q, v, np.zeros(self.model.nv))
            found[row] = self.s @ a[self.v]
        return found


def unnormalised(rng):
    tree = chain_or_more(rng, 2)
    carried = [i for i in range(tree.n) if tree.parents[i] >= 0]
    joint = int(rng.choice(carried or [0]))
    return Unnormalised(tree, joint, off(rng)), free(tree)


class InSinglePrecision(WrappedEngine):
    """Takes and gives numbers of 24 bits."""

    def accelerations(self, theta, omega):
        given = theta.astype(np.float32).astype(float), omega.astype(np.float32).astype(float)
        return super().accelerations(*given).astype(np.float32).astype(float)

    def inverse_dynamics(self, theta, omega, alpha):
        given = (x.astype(np.float32).astype(float) for x in (theta, omega, alpha))
        return super().inverse_dynamics(*given).astype(np.float32).astype(float)


def single(rng):
    tree = chain_or_more(rng)
    inner = engine(rng, tree)
    return InSinglePrecision(inner._engine, inner.shows), free(tree)


def dropped(rng):
    wanted = free(chain_or_more(rng, 2))
    leaves = [i for i in range(wanted.n) if all(k.parent != i for k in wanted.links)]
    less = fused(wanted, int(rng.choice(leaves)))
    return engine(rng, PlanarTree(less.links, less.gravity[0]), shows=True), wanted


OF_ENGINES = {
    "mass": mass,
    "inertia": inertia,
    "point-mass-patched": point_mass,
    "com-displaced": com,
    "length": length,
    "gravity": gravity,
    "gravity-turned": gravity_turned,
    "armature": armature,
    "damping": damping,
    "dry-friction": friction,
    "stiffness": stiffness,
    "joint-limit": limit,
    "angle-convention": convention,
    "degree-vs-radian": degrees,
    "joint-order": order,
    "continuous-joint-not-normalised": unnormalised,
    "float32": single,
    "joint-dropped-by-parser": dropped,
}
