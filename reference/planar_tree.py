"""Equations of motion of any planar tree of hinged links, O(n), in absolute angles; both documents' are special cases.

Derived here from Newton and Euler for each link. With R(θ) the rotation, h_i the hinge of link i in its parent's frame,
s_i its centre of mass, u_i the acceleration of its hinge, × the plane's cross product and J a quarter turn:

    u_i = u_p + θ̈_p J R(θ_p) h_i − θ̇_p² R(θ_p) h_i            (1)  acceleration of hinge i, on its parent p
    f_i = m_i (u_i + θ̈_i J R(θ_i) s_i − θ̇_i² R(θ_i) s_i − g)   (2)  force that moves link i
    F_i = f_i + Σ_c F_c                                         (3)  force through hinge i: all that it carries
    τ_i = I_i θ̈_i + R(θ_i) s_i × f_i + Σ_c R(θ_i) h_c × F_c      (4)  row of the equations of motion
    t_i = a_i φ̈_i + d_i φ̇_i + k_i φ_i − κ_i + r_i sign φ̇_i       (5)  hinge i's own torque, φ_i = θ_i − θ_p,

t_i being added to row i and taken from row p. Equations are written with arrays whose last axis counts links, so that
they run in floats, any batch of parameters against any batch of states, and in balls alike.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..models.mechanism import Mechanism
from ..models.tree import SUPPORT
from .arithmetic import Arithmetic, Array, arithmetic_of

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Parameters:
    """A mechanism's numbers, the last axis counting links, with any axes before it.

    ``hinge_along``, ``hinge_across``, ``com_along``, ``com_across`` [m]; ``mass`` [kg]; ``inertia`` about the centre
    of mass [kg m²]; each hinge's ``armature`` [kg m²], ``damping`` [N m s], ``stiffness`` [N m], ``preload``
    κ = stiffness × rest angle [N m], ``friction`` [N m]; ``gravity_along``, ``gravity_across`` [m/s²], last axis 1.
    """

    mass: Array
    inertia: Array
    com_along: Array
    com_across: Array
    hinge_along: Array
    hinge_across: Array
    gravity_along: Array
    gravity_across: Array
    armature: Array
    damping: Array
    stiffness: Array
    preload: Array
    friction: Array

    def items(self) -> dict[str, Array]:
        """Every parameter by its name."""
        return {name: getattr(self, name) for name in NAMES}


NAMES = tuple(f.name for f in fields(Parameters))


def parameters(mechanism: Mechanism, xp: Arithmetic | None = None) -> Parameters:
    """The mechanism's numbers, in floats or in the arithmetic given."""
    links, hinges = mechanism.links, mechanism.hinges
    numbers = {
        "mass": [link.mass for link in links],
        "inertia": [link.inertia for link in links],
        "com_along": [link.com[0] for link in links],
        "com_across": [link.com[1] for link in links],
        "hinge_along": [link.hinge[0] for link in links],
        "hinge_across": [link.hinge[1] for link in links],
        "gravity_along": [mechanism.gravity[0]],
        "gravity_across": [mechanism.gravity[1]],
        "armature": [hinge.armature for hinge in hinges],
        "damping": [hinge.damping for hinge in hinges],
        "stiffness": [hinge.stiffness for hinge in hinges],
        "preload": [hinge.stiffness * hinge.rest for hinge in hinges],
        "friction": [hinge.friction for hinge in hinges],
    }
    make = np.array if xp is None else xp.array
    return Parameters(**{name: make(values) for name, values in numbers.items()})


def torques(parents: tuple[int, ...], p: Parameters, theta: Array, omega: Array, alpha: Array) -> Array:
    """Generalised forces [N m] of the absolute angles that the motion needs, (1) to (5); shape (…, n)."""
    xp = arithmetic_of(theta, omega, alpha)
    cos, sin = xp.cos_sin(theta)
    swirl, pull = alpha, omega * omega
    n = len(parents)
    u: list[tuple[Any, Any]] = []
    f: list[tuple[Any, Any]] = []
    rows: list[Any] = []
    for i, parent in enumerate(parents):
        if parent == SUPPORT:
            ux, uy = -p.gravity_along[..., 0], -p.gravity_across[..., 0]  # the support, falling up
        else:
            ux, uy = _arm(p.hinge_along[..., i], p.hinge_across[..., i], cos, sin, parent)
            ux, uy = _accelerated(u[parent], (ux, uy), swirl[..., parent], pull[..., parent])
        u.append((ux, uy))
        arm = _arm(p.com_along[..., i], p.com_across[..., i], cos, sin, i)
        cx, cy = _accelerated(u[i], arm, swirl[..., i], pull[..., i])
        force = (p.mass[..., i] * cx, p.mass[..., i] * cy)
        f.append(force)
        rows.append(p.inertia[..., i] * swirl[..., i] + _cross(arm, force))
    for i in range(n - 1, -1, -1):
        own = hinge_torque(p, i, parents[i], theta, omega, alpha)
        if own is not None:
            rows[i] = rows[i] + own
        parent = parents[i]
        if parent == SUPPORT:
            continue
        if own is not None:
            rows[parent] = rows[parent] - own
        arm = _arm(p.hinge_along[..., i], p.hinge_across[..., i], cos, sin, parent)
        rows[parent] = rows[parent] + _cross(arm, f[i])
        f[parent] = (f[parent][0] + f[i][0], f[parent][1] + f[i][1])
    return np.stack(np.broadcast_arrays(*rows), axis=-1)


def hinge_torque(p: Parameters, i: int, parent: int, theta: Array, omega: Array, alpha: Array | None) -> Any | None:
    """(5), or None where hinge i is ideal; without ``alpha`` the armature's part is left out."""
    held = (p.armature[..., i], p.damping[..., i], p.stiffness[..., i], p.preload[..., i], p.friction[..., i])
    a, d, k, preload, friction = held
    if not any(_anything(part) for part in held):
        return None
    angle, rate = _relative(theta, i, parent), _relative(omega, i, parent)
    torque = d * rate + k * angle - preload
    if alpha is not None:
        torque = torque + a * _relative(alpha, i, parent)
    if _anything(friction):
        torque = torque + friction * np.sign(rate)
    return torque


def accelerations(parents: tuple[int, ...], p: Parameters, theta: Array, omega: Array) -> Array:
    """θ̈ [rad/s²] with nothing driving the mechanism, by eliminating link after link from the tips; shape (…, n).

    With u the acceleration of its hinge, what link i and all it carries do there is a force F = q θ̈_i + W u + b and a
    torque about the hinge N = j θ̈_i + q·u + c. The hinge passes on N = −t_i of (5), so that θ̈_i follows from u_i and,
    through the armature alone, from θ̈_p.
    """
    xp = arithmetic_of(theta, omega)
    cos, sin = xp.cos_sin(theta)
    pull = omega * omega
    n = len(parents)
    j, q, w, b, c = _links_alone(p, n, cos, sin, pull)
    for i in range(n - 1, -1, -1):
        parent = parents[i]
        if parent == SUPPORT:
            continue
        a, own = p.armature[..., i], hinge_torque(p, i, parent, theta, omega, None)
        own = 0 if own is None else own
        held = j[i] + a
        # Eliminated: θ̈_i = (a θ̈_p − q·u − c − own)/held. Left over: a force and a torque on the parent.
        qx, qy = q[i]
        wxx, wxy, wyy = w[i]
        kx, ky = qx / held, qy / held
        wxx, wxy, wyy = wxx - kx * qx, wxy - kx * qy, wyy - ky * qy
        free = (c[i] + own) / held
        fx, fy = b[i][0] - qx * free, b[i][1] - qy * free
        sx, sy = kx * a, ky * a  # force for each θ̈_p, and torque on the parent for each u
        back = a - a * a / held
        reaction = own - a * free  # torque that the hinge takes from the parent, less what depends on u and θ̈_p
        hx, hy = _arm(p.hinge_along[..., i], p.hinge_across[..., i], cos, sin, parent)
        ex, ey = -hy, hx  # u_i = u_p + θ̈_p e − θ̇_p² h
        still_x, still_y = -pull[..., parent] * hx, -pull[..., parent] * hy
        # Force on the parent's hinge and torque about it, in terms of u_p and θ̈_p.
        gx, gy = wxx * ex + wxy * ey + sx, wxy * ex + wyy * ey + sy
        ox, oy = fx + wxx * still_x + wxy * still_y, fy + wxy * still_x + wyy * still_y
        j[parent] = j[parent] + ex * gx + ey * gy + back + (sx * ex + sy * ey)
        q[parent] = (q[parent][0] + gx, q[parent][1] + gy)
        w[parent] = (w[parent][0] + wxx, w[parent][1] + wxy, w[parent][2] + wyy)
        b[parent] = (b[parent][0] + ox, b[parent][1] + oy)
        c[parent] = c[parent] + ex * ox + ey * oy - reaction + (sx * still_x + sy * still_y)
    found: list[Any] = []
    u: list[tuple[Any, Any]] = []
    for i, parent in enumerate(parents):
        a = p.armature[..., i]
        own = hinge_torque(p, i, parent, theta, omega, None)
        if parent == SUPPORT:
            ux, uy = -p.gravity_along[..., 0], -p.gravity_across[..., 0]
            carried = 0
        else:
            arm = _arm(p.hinge_along[..., i], p.hinge_across[..., i], cos, sin, parent)
            ux, uy = _accelerated(u[parent], arm, found[parent], pull[..., parent])
            carried = a * found[parent]
        u.append((ux, uy))
        driven = carried - (q[i][0] * ux + q[i][1] * uy) - c[i] - (0 if own is None else own)
        found.append(driven / (j[i] + a))
    return np.stack(np.broadcast_arrays(*found), axis=-1)


def _links_alone(p: Parameters, n: int, cos: Array, sin: Array, pull: Array) -> tuple[list[Any], ...]:
    """j, q, W, b and c of each link by itself, about its own hinge."""
    j, q, w, b, c = [], [], [], [], []
    for i in range(n):
        sx, sy = _arm(p.com_along[..., i], p.com_across[..., i], cos, sin, i)
        m = p.mass[..., i]
        s = p.com_along[..., i] ** 2 + p.com_across[..., i] ** 2
        j.append(p.inertia[..., i] + m * s)
        q.append((-m * sy, m * sx))
        w.append((m, m * 0, m))
        b.append((-m * pull[..., i] * sx, -m * pull[..., i] * sy))
        c.append(m * 0)  # R s × (−θ̇² R s) = 0
    return j, q, w, b, c


def mass_matrix(parents: tuple[int, ...], p: Parameters, theta: Array) -> Array:
    """M(θ) [kg m²] of the absolute angles, shape (…, n, n): column k is (4) and (5) for θ̈ = e_k alone."""
    rest = theta * 0
    weightless = _without(p, "gravity_along", "gravity_across", "stiffness", "preload", "friction", "damping")
    units = rest[..., None, :] + arithmetic_of(theta).array(np.eye(len(parents)))
    repeated = theta[..., None, :] + units * 0
    return np.swapaxes(torques(parents, _one_more_axis(weightless), repeated, repeated * 0, units), -1, -2)


def velocity_terms(parents: tuple[int, ...], p: Parameters, theta: Array, omega: Array) -> Array:
    """What is quadratic in the rates [N m], (…, n)."""
    still = _without(p, "gravity_along", "gravity_across", "stiffness", "preload", "friction", "damping")
    return torques(parents, still, theta, omega, omega * 0)


def gravity_terms(parents: tuple[int, ...], p: Parameters, theta: Array) -> Array:
    """G(θ) [N m], (…, n)."""
    only = _without(p, "stiffness", "preload", "friction", "damping", "armature")
    return torques(parents, only, theta, theta * 0, theta * 0)


def magnitudes(parents: tuple[int, ...], p: Parameters, theta: Floats, omega: Floats, alpha: Floats) -> Floats:
    """Σ|terms| of each *relative* row of the equations of motion, every sine and cosine one; shape (…, n).

    An engine in relative coordinates adds up an absolute rate from those of the hinges on the way, whose magnitudes are
    added here. The measure of rounding, not of motion.
    """
    rate, swing = (
        _felt(parents, np.abs(_relative_rows(parents, omega))),
        _felt(parents, np.abs(_relative_rows(parents, alpha))),
    )
    swirl = swing + rate * rate
    g = np.hypot(p.gravity_along[..., 0], p.gravity_across[..., 0])
    hinge, com = np.hypot(p.hinge_along, p.hinge_across), np.hypot(p.com_along, p.com_across)
    carried: list[Any] = []
    force: list[Any] = []
    rows: list[Any] = []
    for i, parent in enumerate(parents):
        at = g if parent == SUPPORT else carried[parent] + hinge[..., i] * swirl[..., parent]
        carried.append(at)
        force.append(p.mass[..., i] * (at + com[..., i] * swirl[..., i]))
        rows.append(p.inertia[..., i] * swirl[..., i] + com[..., i] * force[i])
    for i in range(len(parents) - 1, -1, -1):
        parent = parents[i]
        if parent != SUPPORT:
            rows[parent] = rows[parent] + rows[i] + hinge[..., i] * force[i]
            force[parent] = force[parent] + force[i]
    relative = (_relative_rows(parents, part) for part in (theta, omega, alpha))
    phi, phi_dot, phi_ddot = map(np.abs, relative)
    own = p.armature * phi_ddot + p.damping * phi_dot + p.stiffness * phi + np.abs(p.preload) + p.friction
    return np.asarray(np.stack(np.broadcast_arrays(*rows), axis=-1) + own)


def stretched_inertias(parents: tuple[int, ...], p: Parameters) -> Floats:
    """Inertia about each hinge of all that it carries, stretched out straight away from it [kg m²]; shape (n,).

    The diagonal of the mass matrix of relative angles with every cosine one. With μ, σ and J the mass, first moment
    and inertia about hinge i of all that it carries, moving it out by the distance h to the parent's hinge gives the
    parent μ, σ + μ h and J + 2 h σ + μ h².
    """
    reach = np.hypot(p.com_along, p.com_across)
    hinge = np.hypot(p.hinge_along, p.hinge_across)
    mass, moment = p.mass.copy(), p.mass * reach
    inertia = p.inertia + p.mass * reach**2
    for i in range(len(parents) - 1, -1, -1):
        parent, h = parents[i], hinge[i]
        if parent != SUPPORT:
            inertia[parent] += inertia[i] + 2 * h * moment[i] + mass[i] * h**2
            moment[parent] += moment[i] + mass[i] * h
            mass[parent] += mass[i]
    return np.asarray(inertia + p.armature)


def relative_rows(parents: tuple[int, ...], absolute: Floats) -> Floats:
    """Generalised forces of the relative angles: each link's and all that it carries, added up; shape (…, n)."""
    rows = absolute.copy()
    for i in range(len(parents) - 1, -1, -1):
        if parents[i] != SUPPORT:
            rows[..., parents[i]] += rows[..., i]
    return rows


def _relative_rows(parents: tuple[int, ...], values: Floats) -> Floats:
    """φ = θ − θ of the parent."""
    found = values.copy()
    for i, parent in enumerate(parents):
        if parent != SUPPORT:
            found[..., i] = values[..., i] - values[..., parent]
    return found


def _felt(parents: tuple[int, ...], relative: Floats) -> Floats:
    felt = relative.copy()
    for i, parent in enumerate(parents):
        if parent != SUPPORT:
            felt[..., i] += felt[..., parent]
    return felt


def _relative(values: Array, i: int, parent: int) -> Any:
    return values[..., i] if parent == SUPPORT else values[..., i] - values[..., parent]


def _arm(along: Any, across: Any, cos: Array, sin: Array, i: int) -> tuple[Any, Any]:
    """R(θ_i) applied to a point of link i's frame."""
    return along * cos[..., i] - across * sin[..., i], along * sin[..., i] + across * cos[..., i]


def _accelerated(at: tuple[Any, Any], arm: tuple[Any, Any], swirl: Any, pull: Any) -> tuple[Any, Any]:
    """The acceleration at the end of an arm, (1)."""
    x, y = arm
    return at[0] - swirl * y - pull * x, at[1] + swirl * x - pull * y


def _cross(arm: tuple[Any, Any], force: tuple[Any, Any]) -> Any:
    return arm[0] * force[1] - arm[1] * force[0]


def _anything(values: Any) -> bool:
    return bool(np.any(np.asarray(values) != 0))


def _without(p: Parameters, *names: str) -> Parameters:
    items = p.items()
    return Parameters(**{name: value * 0 if name in names else value for name, value in items.items()})


def _one_more_axis(p: Parameters) -> Parameters:
    return Parameters(**{name: value[..., None, :] for name, value in p.items().items()})
