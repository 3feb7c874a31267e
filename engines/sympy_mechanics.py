"""Sympy's mechanics: equations of motion derived anew for each mechanism, by Kane's method or Lagrange's.

No code is shared with any engine, nor with furiko's own derivations: sympy takes points and frames and derives. The
mechanism's numbers are in the formulas, which keeps them short; gravity stays a symbol.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np

from ..models import System
from .protocol import Array

# Sympy's types say little: Any, here and nowhere else.
sympy: Any = import_module("sympy")
mechanics: Any = import_module("sympy.physics.mechanics")
SUPPORT = -1


@dataclass(frozen=True)
class _Parts:
    """What a method derives from: a frame, angles q and rates u, bodies, their weights, T and U."""

    world: Any
    q: Any
    u: Any
    bodies: Any
    forces: Any
    kinetic: Any
    potential: Any


class _Mechanics:
    """Points and frames of a mechanism in absolute angles, and what both methods have in common."""

    def __init__(self, system: System) -> None:
        tree = system.tree()
        self._gravity, self._n = tree.gravity, len(tree.links)
        g = sympy.Symbol("g")
        q, u = (mechanics.dynamicsymbols(f"{name}:{self._n}") for name in "qu")
        world, support = mechanics.ReferenceFrame("N"), mechanics.Point("O")
        support.set_vel(world, 0)
        bodies: list[Any] = []
        frames: list[Any] = []
        hinges: list[Any] = []
        for i, link in enumerate(tree.links):
            # Along the link at angle zero is down, -z; a hinge turns about -y.
            frame = world.orientnew(f"A{i}", "Axis", (q[i], -world.y))
            frame.set_ang_vel(world, -u[i] * world.y)
            root = link.parent == SUPPORT
            before, carrier = (support, world) if root else (hinges[link.parent], frames[link.parent])
            hinge = before.locatenew(f"H{i}", _place(carrier, link.hinge))
            hinge.v2pt_theory(before, world, carrier)
            centre = hinge.locatenew(f"C{i}", _place(frame, link.com))
            centre.v2pt_theory(hinge, world, frame)
            about = mechanics.inertia(frame, 0, sympy.Float(link.inertia), 0)
            bodies.append(mechanics.RigidBody(f"B{i}", centre, frame, sympy.Float(link.mass), (about, centre)))
            frames.append(frame)
            hinges.append(hinge)
        forces = [(body.masscenter, -body.mass * g * world.z) for body in bodies]
        kinetic = sum(body.kinetic_energy(world) for body in bodies)
        potential = sum(body.mass * g * body.masscenter.pos_from(support).dot(world.z) for body in bodies)
        mass, forcing = self._derive(_Parts(world, q, u, bodies, forces, kinetic, potential))
        self._terms = _compiled(q, u, g, [*mass, *forcing])
        self._energies = _compiled(q, u, g, [kinetic, potential])

    def _derive(self, parts: _Parts) -> tuple[Any, Any]:
        """M and f of M du/dt = f."""
        raise NotImplementedError

    def accelerations(self, theta: Array, omega: Array) -> Array:
        mass, forcing = self._mass_and_forcing(theta, omega, self._gravity)
        return np.asarray(np.linalg.solve(mass, forcing[..., None])[..., 0], dtype=np.float64)

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        mass, forcing = self._mass_and_forcing(theta, omega, self._gravity if gravity else 0.0)
        return np.asarray((mass @ alpha[..., None])[..., 0] - forcing)

    def energy(self, theta: Array, omega: Array) -> Array:
        return self._energies(theta, omega, self._gravity)

    def _mass_and_forcing(self, theta: Array, omega: Array, gravity: float) -> tuple[Array, Array]:
        n, found = self._n, self._terms(theta, omega, gravity)
        return found[:, : n * n].reshape(-1, n, n), found[:, n * n :]


class SympyKane(_Mechanics):
    """Kane's method: partial velocities, no energies."""

    def _derive(self, parts: _Parts) -> tuple[Any, Any]:
        same = [angle.diff() - rate for angle, rate in zip(parts.q, parts.u, strict=True)]
        method = mechanics.KanesMethod(parts.world, q_ind=parts.q, u_ind=parts.u, kd_eqs=same)
        method.kanes_equations(parts.bodies, parts.forces)
        return method.mass_matrix, method.forcing


class SympyLagrange(_Mechanics):
    """Lagrange's method: T − U, differentiated."""

    def _derive(self, parts: _Parts) -> tuple[Any, Any]:
        rates = {rate: angle.diff() for angle, rate in zip(parts.q, parts.u, strict=True)}
        method = mechanics.LagrangesMethod((parts.kinetic - parts.potential).xreplace(rates), parts.q)
        method.form_lagranges_equations()
        back = {derivative: rate for rate, derivative in rates.items()}
        return method.mass_matrix.xreplace(back), method.forcing.xreplace(back)


def _compiled(q: Any, u: Any, g: Any, formulas: list[Any]) -> Callable[[Array, Array, float], Array]:
    """A function of θ (B, n), ω (B, n) and gravity → (B, number of formulas); common parts are computed once."""
    function = sympy.lambdify([*q, *u, g], formulas, modules="numpy", cse=True)

    def values(theta: Array, omega: Array, gravity: float) -> Array:
        found = function(*theta.T, *omega.T, gravity)
        return np.stack([np.broadcast_to(np.asarray(value, dtype=np.float64), (len(theta),)) for value in found], -1)

    return values


def _place(frame: Any, point: tuple[float, float]) -> Any:
    """A point (along, across) of a link's frame, as a vector."""
    along, across = map(sympy.Float, point)
    return -along * frame.z + across * frame.x
