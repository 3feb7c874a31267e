"""Inverse and forward dynamics of any planar tree of hinged links, O(n), in absolute angles.

Inverse dynamics is the recursive Newton-Euler algorithm (RNEA), forward dynamics the articulated-body algorithm (ABA);
Featherstone, *Rigid Body Dynamics Algorithms*, chapters 5 and 7. Both documents' mechanisms are special cases. The
equations of each link are Newton's and Euler's. With R(θ) the rotation, h_i the hinge of link i in its parent's frame,
s_i its centre of mass, u_i the acceleration of its hinge, × the plane's cross product and J a quarter turn:

    u_i = u_p + θ̈_p J R(θ_p) h_i − θ̇_p² R(θ_p) h_i            (1)  acceleration of hinge i, on its parent p
    f_i = m_i (u_i + θ̈_i J R(θ_i) s_i − θ̇_i² R(θ_i) s_i − g)   (2)  force that moves link i
    F_i = f_i + Σ_c F_c                                         (3)  joint reaction force at hinge i, over its subtree
    τ_i = I_i θ̈_i + R(θ_i) s_i × f_i + Σ_c R(θ_i) h_c × F_c      (4)  row of the equations of motion
    t_i = a_i φ̈_i + d_i φ̇_i + k_i φ_i − κ_i + r_i sign φ̇_i       (5)  hinge i's own torque, φ_i = θ_i − θ_p,

t_i being added to row i and subtracted from row p; the sums run over the children c of link i. Everything is written
with arrays whose last axis counts links, so that it runs in floats and balls, for any batch of parameters and states.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..models.coordinates import to_absolute, to_relative
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

    @cached_property
    def ideal(self) -> bool:
        """Whether no hinge has a torque of its own."""
        own = (self.armature, self.damping, self.stiffness, self.preload, self.friction)
        return not any(_anything(values) for values in own)


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


def inverse_dynamics(parents: tuple[int, ...], p: Parameters, theta: Array, omega: Array, alpha: Array) -> Array:
    """Inverse dynamics: the generalised forces τ [N m] of the absolute angles for this motion; shape (…, n).

    The recursive Newton-Euler algorithm (RNEA), (1) to (5): accelerations from the support to the tips, forces back.
    ``theta`` [rad], ``omega`` [rad/s], ``alpha`` [rad/s²]: absolute, (…, n).
    """
    xp = arithmetic_of(theta, omega, alpha)
    cos, sin = xp.cos_sin(theta)
    squared = omega * omega
    n = len(parents)
    u: list[tuple[Any, Any]] = []
    f: list[tuple[Any, Any]] = []
    rows: list[Any] = []
    for i, parent in enumerate(parents):
        if parent == SUPPORT:
            ux, uy = -p.gravity_along[..., 0], -p.gravity_across[..., 0]  # in place of weights
        else:
            ux, uy = _arm(p.hinge_along[..., i], p.hinge_across[..., i], cos, sin, parent)
            ux, uy = _accelerated(u[parent], (ux, uy), alpha[..., parent], squared[..., parent])
        u.append((ux, uy))
        arm = _arm(p.com_along[..., i], p.com_across[..., i], cos, sin, i)
        cx, cy = _accelerated(u[i], arm, alpha[..., i], squared[..., i])
        force = (p.mass[..., i] * cx, p.mass[..., i] * cy)
        f.append(force)
        rows.append(p.inertia[..., i] * alpha[..., i] + _cross(arm, force))
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
    """(5), the torque [N m] of hinge i, shape (…); None where it is ideal. No armature term without ``alpha``."""
    if p.ideal:
        return None
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


def forward_dynamics(parents: tuple[int, ...], p: Parameters, theta: Array, omega: Array) -> Array:
    """Forward dynamics: θ̈ [rad/s²] with no applied forces, shape (…, n); ``theta``, ``omega`` absolute, (…, n).

    The articulated-body algorithm (ABA). With u the acceleration of hinge i, its subtree needs there the force
    F = q θ̈_i + W u + b and the torque about the hinge N = j θ̈_i + q·u + c: j, q and W are the articulated-body
    inertia, b and c the bias force. The hinge transmits N = −t_i of (5), so that θ̈_i follows from u_i and, through the
    armature alone, from θ̈_p.
    """
    xp = arithmetic_of(theta, omega)
    cos, sin = xp.cos_sin(theta)
    squared = omega * omega
    n = len(parents)
    j, q, w, b, c = _rigid_body_inertias(p, n, cos, sin, squared)
    for i in range(n - 1, -1, -1):
        parent = parents[i]
        if parent == SUPPORT:
            continue
        a, own = p.armature[..., i], hinge_torque(p, i, parent, theta, omega, None)
        own = 0 if own is None else own
        held = j[i] + a
        # Eliminated: θ̈_i = (a θ̈_p − q·u − c − own)/held. What remains acts on the parent as a force and a torque.
        qx, qy = q[i]
        wxx, wxy, wyy = w[i]
        kx, ky = qx / held, qy / held
        wxx, wxy, wyy = wxx - kx * qx, wxy - kx * qy, wyy - ky * qy
        free = (c[i] + own) / held
        fx, fy = b[i][0] - qx * free, b[i][1] - qy * free
        sx, sy = kx * a, ky * a  # force for each θ̈_p, and torque on the parent for each u
        back = a - a * a / held
        reaction = own - a * free  # torque of the hinge on the parent, without the terms in u and θ̈_p
        hx, hy = _arm(p.hinge_along[..., i], p.hinge_across[..., i], cos, sin, parent)
        ex, ey = -hy, hx  # u_i = u_p + θ̈_p e − θ̇_p² h
        bias_x, bias_y = -squared[..., parent] * hx, -squared[..., parent] * hy
        # Force on the parent's hinge and torque about it, in terms of u_p and θ̈_p.
        gx, gy = wxx * ex + wxy * ey + sx, wxy * ex + wyy * ey + sy
        ox, oy = fx + wxx * bias_x + wxy * bias_y, fy + wxy * bias_x + wyy * bias_y
        j[parent] = j[parent] + ex * gx + ey * gy + back + (sx * ex + sy * ey)
        q[parent] = (q[parent][0] + gx, q[parent][1] + gy)
        w[parent] = (w[parent][0] + wxx, w[parent][1] + wxy, w[parent][2] + wyy)
        b[parent] = (b[parent][0] + ox, b[parent][1] + oy)
        c[parent] = c[parent] + ex * ox + ey * oy - reaction + (sx * bias_x + sy * bias_y)
    found: list[Any] = []
    u: list[tuple[Any, Any]] = []
    for i, parent in enumerate(parents):
        a = p.armature[..., i]
        own = hinge_torque(p, i, parent, theta, omega, None)
        if parent == SUPPORT:
            ux, uy = -p.gravity_along[..., 0], -p.gravity_across[..., 0]
            coupled = 0
        else:
            arm = _arm(p.hinge_along[..., i], p.hinge_across[..., i], cos, sin, parent)
            ux, uy = _accelerated(u[parent], arm, found[parent], squared[..., parent])
            coupled = a * found[parent]
        u.append((ux, uy))
        torque = coupled - (q[i][0] * ux + q[i][1] * uy) - c[i] - (0 if own is None else own)
        found.append(torque / (j[i] + a))
    return np.stack(np.broadcast_arrays(*found), axis=-1)


def _rigid_body_inertias(p: Parameters, n: int, cos: Array, sin: Array, squared: Array) -> tuple[list[Any], ...]:
    """j, q, W, b and c of each link alone, about its own hinge."""
    j, q, w, b, c = [], [], [], [], []
    for i in range(n):
        sx, sy = _arm(p.com_along[..., i], p.com_across[..., i], cos, sin, i)
        m = p.mass[..., i]
        s = p.com_along[..., i] ** 2 + p.com_across[..., i] ** 2
        j.append(p.inertia[..., i] + m * s)
        q.append((-m * sy, m * sx))
        w.append((m, m * 0, m))
        b.append((-m * squared[..., i] * sx, -m * squared[..., i] * sy))
        c.append(m * 0)  # R s × (−θ̇² R s) = 0
    return j, q, w, b, c


def mass_matrix(parents: tuple[int, ...], p: Parameters, theta: Array) -> Array:
    """Joint-space inertia matrix M(θ) [kg m²] of the absolute angles, shape (…, n, n), with the armatures.

    Column k is the inverse dynamics of θ̈ = e_k, at rest and without weight, springs, damping or friction.
    """
    rest = theta * 0
    weightless = _without(p, "gravity_along", "gravity_across", "stiffness", "preload", "friction", "damping")
    units = rest[..., None, :] + arithmetic_of(theta).array(np.eye(len(parents)))
    repeated = theta[..., None, :] + units * 0
    return np.swapaxes(inverse_dynamics(parents, _one_more_axis(weightless), repeated, repeated * 0, units), -1, -2)


def velocity_terms(parents: tuple[int, ...], p: Parameters, theta: Array, omega: Array) -> Array:
    """Generalised forces quadratic in the rates, in absolute angles [N m], shape (…, n)."""
    still = _without(p, "gravity_along", "gravity_across", "stiffness", "preload", "friction", "damping")
    return inverse_dynamics(parents, still, theta, omega, omega * 0)


def gravity_terms(parents: tuple[int, ...], p: Parameters, theta: Array) -> Array:
    """Generalised forces of gravity, in absolute angles [N m], shape (…, n)."""
    only = _without(p, "stiffness", "preload", "friction", "damping", "armature")
    return inverse_dynamics(parents, only, theta, theta * 0, theta * 0)


def magnitudes(parents: tuple[int, ...], p: Parameters, theta: Floats, omega: Floats, alpha: Floats) -> Floats:
    """Σ|terms| of each *relative* row of the equations of motion, every sine and cosine one; shape (…, n).

    The unit of rounding errors. An engine in relative coordinates adds up an absolute rate from those of the hinges on
    the path from the support, so that their magnitudes are added here.
    """
    phi, phi_dot, phi_ddot = (np.abs(to_relative(parents, values)) for values in (theta, omega, alpha))
    angular = to_absolute(parents, phi_ddot) + to_absolute(parents, phi_dot) ** 2
    g = np.hypot(p.gravity_along[..., 0], p.gravity_across[..., 0])
    hinge, com = np.hypot(p.hinge_along, p.hinge_across), np.hypot(p.com_along, p.com_across)
    acceleration: list[Any] = []
    force: list[Any] = []
    rows: list[Any] = []
    for i, parent in enumerate(parents):
        at = g if parent == SUPPORT else acceleration[parent] + hinge[..., i] * angular[..., parent]
        acceleration.append(at)
        force.append(p.mass[..., i] * (at + com[..., i] * angular[..., i]))
        rows.append(p.inertia[..., i] * angular[..., i] + com[..., i] * force[i])
    for i in range(len(parents) - 1, -1, -1):
        parent = parents[i]
        if parent != SUPPORT:
            rows[parent] = rows[parent] + rows[i] + hinge[..., i] * force[i]
            force[parent] = force[parent] + force[i]
    own = p.armature * phi_ddot + p.damping * phi_dot + p.stiffness * phi + np.abs(p.preload) + p.friction
    return np.asarray(np.stack(np.broadcast_arrays(*rows), axis=-1) + own)


def stretched_inertias(parents: tuple[int, ...], p: Parameters) -> Floats:
    """Inertia [kg m²] of each hinge's subtree about the hinge, stretched out in a straight line; shape (n,).

    The diagonal of the mass matrix of relative angles with every cosine one. With μ, σ and J the mass, first moment
    and inertia of hinge i's subtree about it, the distance h to the parent's hinge adds to the parent's μ, σ + μ h and
    J + 2 h σ + μ h².
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


def _relative(values: Array, i: int, parent: int) -> Any:
    return values[..., i] if parent == SUPPORT else values[..., i] - values[..., parent]


def _arm(along: Any, across: Any, cos: Array, sin: Array, i: int) -> tuple[Any, Any]:
    """R(θ_i) applied to a point of link i's frame."""
    return along * cos[..., i] - across * sin[..., i], along * sin[..., i] + across * cos[..., i]


def _accelerated(at: tuple[Any, Any], arm: tuple[Any, Any], alpha: Any, squared: Any) -> tuple[Any, Any]:
    """The acceleration at the end of an arm, (1); ``squared``: the rate's square."""
    x, y = arm
    return at[0] - alpha * y - squared * x, at[1] + alpha * x - squared * y


def _cross(arm: tuple[Any, Any], force: tuple[Any, Any]) -> Any:
    return arm[0] * force[1] - arm[1] * force[0]


def _anything(values: Any) -> bool:
    return bool(np.any(np.asarray(values) != 0))


def _without(p: Parameters, *names: str) -> Parameters:
    items = p.items()
    return Parameters(**{name: value * 0 if name in names else value for name, value in items.items()})


def _one_more_axis(p: Parameters) -> Parameters:
    return Parameters(**{name: value[..., None, :] for name, value in p.items().items()})
