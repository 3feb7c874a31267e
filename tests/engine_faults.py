"""Planted faults of engines and adapters: a real engine that was given something else, or is asked wrongly.

Each function makes (cause, engine, what is expected); the engine answers in absolute angles as adapters do.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import pinocchio
from model_faults import Shape, free, fused, off, random_style, random_tree, with_hinge, with_link, written

from furiko.engines import Integrator, load_engine
from furiko.engines.model_files.adapter import READERS, Reader
from furiko.models import PlanarTree, to_urdf
from furiko.models.readers.model_file import model_from_text
from furiko.models.tree import SUPPORT

NAMES = ("mujoco", "pinocchio-aba", "exudyn-tree", "pinocchio-crba")


class Asked:
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
    return Asked(load_engine(name, Shape(tree)), shows)


def adapter(asked):
    return asked._engine._engine


def chain_or_more(rng, least=1, **given):
    return random_tree(rng, n=int(rng.integers(least, 11)), **given)


# --- Numbers --------------------------------------------------------------------------------------------------------


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
    asked = engine(rng, tree, str(rng.choice(["mujoco", "pinocchio-aba"])))
    angle = float(rng.choice([-1, 1]) * rng.uniform(0.05, 1))
    vector = tree.gravity * np.array([math.sin(angle), 0.0, -math.cos(angle)])
    model = adapter(asked)._model
    if hasattr(model, "opt"):
        model.opt.gravity[:] = vector
    else:
        model.gravity.linear = vector
    return asked, free(tree)


def hidden(rng, attribute, everywhere=False):
    tree = chain_or_more(rng)
    asked = engine(rng, tree, "mujoco")
    model = adapter(asked)._model
    value = float(10 ** rng.uniform(-3, 0))
    which = slice(None) if everywhere or rng.random() < 0.3 else int(rng.integers(tree.n))
    getattr(model, attribute)[which] = value
    return asked, free(tree)


def armature(rng):
    return hidden(rng, "dof_armature")


def damping(rng):
    return hidden(rng, "dof_damping")


def stiffness(rng):
    asked, wanted = hidden(rng, "jnt_stiffness")
    adapter(asked)._model.qpos_spring[:] = rng.uniform(-1, 1, wanted.n)
    return asked, wanted


class Rubbing(Asked):
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
    return Rubbing(engine(rng, tree, "mujoco"), sizes, tree.parents), free(tree)


def limit(rng):
    tree = chain_or_more(rng)
    asked = engine(rng, tree, "mujoco", shows=False)
    model = adapter(asked)._model
    i = int(rng.integers(tree.n))
    model.jnt_limited[i], model.jnt_range[i] = 1, [-rng.uniform(0.5, 2.5), rng.uniform(0.5, 2.5)]
    model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    return asked, free(tree)


# --- Asked wrongly --------------------------------------------------------------------------------------------------


class Turned(Asked):
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
        return Turned(inner, s), free(tree)
    if way == 1:
        return Turned(inner, same, same, np.linalg.inv(s)), free(tree)
    if way == 2:
        return Turned(inner, np.linalg.inv(s)), free(tree)
    if way == 3:
        return Turned(inner, -same, offset=math.pi), free(tree)
    return Turned(inner, -same, same, same), free(tree)


def degrees(rng):
    tree = chain_or_more(rng)
    same, factor = np.eye(tree.n), float(rng.choice([180 / math.pi, math.pi / 180]))
    way = int(rng.integers(3))
    inner = engine(rng, tree)
    if way == 0:
        return Turned(inner, factor * same), free(tree)
    if way == 1:
        return Turned(inner, factor * same, same), free(tree)
    return Turned(inner, same, same, factor * same), free(tree)


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
    return Turned(engine(rng, tree), matrix), free(tree)


class Unnormalised:
    """Pinocchio with continuous joints, one of which is given a pair (cos, sin) that is not of length one."""

    def __init__(self, tree, joint, factor):
        self.tree, self.joint, self.factor = tree, joint, factor
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
                r = self.factor if i == self.joint else 1.0
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


class Single(Asked):
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
    return Single(inner._engine, inner.shows), free(tree)


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


# --- Engines that misread a file ------------------------------------------------------------------------------------


def misread(reader, change):
    """A reader to whom the file's text comes changed: what an engine with a faulty parser makes of it."""

    class Misreading:
        def __init__(self, given):
            self.given = given

        def load(self, model):
            return self.given.load(replace(model, text=change(model.text)))

        def __getattr__(self, name):
            return getattr(self.given, name)

    return Misreading(reader)


def no_rotation(text):
    """Inertials without their orientation."""
    return re.sub(r"(<inertial[^>]*?) quat='[^']*'", r"\1", re.sub(r'(<inertial[^>]*?) quat="[^"]*"', r"\1", text))


def unit_inertials(text):
    return re.sub(r"<inertial[^>]*/>", '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>', text)


def fixed_not_turned(text):
    """Bodies fixed to others as if they were not turned."""
    return re.sub(r'(<body name="[^"]*_fixed0"[^>]*?) quat="[^"]*"', r"\1", text)


def geoms_rule(text):
    return text.replace("<compiler ", '<compiler inertiafromgeom="true" ', 1)


def other_gravity(text):
    return re.sub(r'gravity="[^"]*"', 'gravity="0 0 -3.7"', text)


def misreading(cause, rng):
    """(file, readers, cause): one engine of three misreads the file, or all do."""
    style = random_style(rng, "mjcf")
    style.full, style.turn_inertials, style.split = False, True, False
    wanted = free(random_tree(rng, kind="chain", bobs=False))
    change = {
        "urdf-inertial-rpy-lost": no_rotation,
        "fused-static-frame": fixed_not_turned,
        "inertial-ignored": unit_inertials,
        "inertia-from-geoms": geoms_rule,
        "gravity": other_gravity,
        "theory-is-wrong": unit_inertials,
    }[cause]
    if cause == "fused-static-frame":
        style.split = True
    if cause == "gravity":
        style.turn_world = False
    if cause == "inertia-from-geoms":
        for i, link in enumerate(wanted.links):
            style.geoms[i] = f"<geom type='capsule' size='0.03 {link.length / 2!r}' contype='0' conaffinity='0'/>"
    file = model_from_text(written(wanted, style, rng), "planted.xml")
    readers: dict[str, Reader | Any] = dict(READERS)
    names = ("mujoco", "pinocchio-aba") if cause == "theory-is-wrong" else ("mujoco",)
    for name in names:
        readers[name] = misread(READERS[name], change)
    return file, readers


OF_READERS = ("urdf-inertial-rpy-lost", "fused-static-frame", "inertial-ignored", "inertia-from-geoms", "gravity",
              "theory-is-wrong")  # fmt: skip


# --- Runs -----------------------------------------------------------------------------------------------------------


class Runs(Asked):
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

    return Runs(tree, run), free(tree), RK4, False


def runs_first_order(rng):
    tree = chain_or_more(rng)
    return Runs(tree, lambda inner, t, w, _, h, k: inner(t, w, "Euler", h, k)), free(tree), RK4, False


def runs_damped(rng):
    tree = chain_or_more(rng)
    share = float(10 ** rng.uniform(-4, -1))

    def run(inner, theta, omega, name, step, steps):
        for _ in range(steps):
            theta, omega = inner(theta, omega, name, step, 1)
            omega = omega * (1 - share * step)
        return theta, omega

    return Runs(tree, run), free(tree), RK4, False


def runs_dissipating(rng):
    """Rates are put right for the constraints after each step: the harder they pull, the more is lost."""
    tree = chain_or_more(rng)
    loss = float(10 ** rng.uniform(-6, -3))

    def run(inner, theta, omega, name, step, steps):
        for _ in range(steps):
            theta, omega = inner(theta, omega, name, step, 1)
            omega = omega * (1 - loss * abs(math.sin(theta.sum())))
        return theta, omega

    return Runs(tree, run), free(tree), RK4, False


def runs_single(rng):
    tree = chain_or_more(rng)

    def run(inner, theta, omega, name, step, steps):
        for _ in range(steps):
            theta, omega = inner(theta, omega, name, step, 1)
            theta, omega = theta.astype(np.float32).astype(float), omega.astype(np.float32).astype(float)
        return theta, omega

    return Runs(tree, run), free(tree), RK4, False


def runs_reset(rng):
    """MuJoCo as it comes: after a NaN it begins anew. (One link alone stays stable: its torque is bounded.)"""
    tree = chain_or_more(rng, 2, kind="chain")
    runs = Runs(tree, lambda inner, *given: inner(*given))
    adapter(runs)._model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    return runs, free(tree), EULER, False


def runs_implicit(rng):
    """MuJoCo's Euler as it comes, on hinges with damping."""
    tree = chain_or_more(rng)
    wanted = free(tree)
    for i in range(tree.n):
        wanted = with_hinge(wanted, i, damping=float(rng.uniform(0.05, 1)))
    runs = Runs(tree, lambda inner, *given: inner(*given))
    # MuJoCo's own order is depth first.
    adapter(runs)._model.dof_damping[adapter(runs)._hinges] = [hinge.damping for hinge in wanted.hinges]
    return runs, wanted, EULER, False


def runs_chaotic(rng):
    tree = chain_or_more(rng)
    return Runs(tree, lambda inner, *given: inner(*given)), free(tree), RK4 if rng.random() < 0.5 else EULER, True


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
