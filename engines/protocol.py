"""The protocol between furiko and a physics engine. Whoever writes an adapter reads this file first.

An adapter is a class that is made for one mechanism and answers up to six questions about it: the methods ``fields``,
``accelerations``, ``inverse_dynamics``, ``joint_forces``, ``energy`` and ``trajectory`` of :class:`Engine`.

Conventions, the same for all questions:

* SI units; angles in rad. The plane of motion is x-z, x to the right, z up; gravity is along -z. A hinge turns about
  the axis (0, -1, 0).
* ``theta`` and ``omega`` = dθ/dt are **absolute** angles and rates: θ_i is the angle of link i from the downward
  vertical, whatever its parent does, counter-clockwise positive, so that a positive angle moves the tip to +x. An
  engine whose joint coordinates are relative to the parent converts with
  :class:`~furiko.engines.coordinates.RelativeCoordinates`.
* Index i of the last axis is link i of ``system.tree().links``, parents before children: for an N-leg pendulum the
  first rod, then the legs; for a rod chain the rods from the support on. n is ``system.n``.
* Arrays are C-contiguous float64 and belong to the caller: do not write to them, and return new ones. States come in
  batches, shape (B, n), B ≥ 0; row b of an answer belongs to row b of the question. Only ``trajectory``, ``path`` and
  ``adaptive`` are given one state, (n,).
* All forces are those of the ideal mechanism: no damping, friction, contact, joint limits or actuators. Switch off what
  the engine has of them.
* NaN or infinity is an answer, and is compared as such. An exception is reported as an error of the engine, with its
  traceback. An answer of another shape is an error, too: see :class:`~furiko.engines.shapes.AnyShape`, which checks
  input and answers, so that an adapter need not.

The class attribute ``info``, an :class:`~furiko.engines.info.EngineInfo`, says what furiko must know before it
imports the engine: its integrators, its largest system, how it solves. **What may be left out:** a question that the
engine cannot answer goes into ``info.missing`` with the sentence that the report shows as the reason, and its method
may then be left out. ``derivatives`` and ``inverse_mass`` are asked where ``info.offers`` names them. ``path``,
``bare_calls``, ``native``, ``lighter`` and ``gap`` are optional: leave the method out, nothing else. ``adaptive`` is
needed only where ``info.adaptive`` names schemes.

**Open mechanisms** (scenes of ``kind = "tree"``) are asked of a second class, a :class:`TreeEngine`, which
``info.tree`` names. It is made for a :class:`~furiko.models.spatial_mechanism.SpatialMechanism` and answers in that
one's coordinates, which are MuJoCo's: ``q`` and ``v`` by joint, in the mechanism's order, not absolute angles. In the
example below, ``tree=TreeInfo("my_adapter:MyTree", missing={"energy": "…"}, cannot_hold={"ball": "…"})`` would name it.

A complete adapter, ``my_adapter.py``; ``furiko engine-test my_adapter.py`` says what is wrong with it, and
``furiko check -e my_adapter.py`` runs the engine::

    import mujoco
    import numpy as np
    from furiko.engines import EngineInfo
    from furiko.engines.coordinates import RelativeCoordinates
    from furiko.models import to_mjcf

    OTHERS = ("fields", "inverse_dynamics", "joint_forces", "energy", "trajectory")

    class MyMujoco:
        info = EngineInfo(
            name="my-mujoco", formulation="mj_forward on furiko's MJCF", adapter="my_adapter:MyMujoco",
            module="mujoco", package="mujoco", homepage="https://mujoco.org", coordinates="relative",
            missing=dict.fromkeys(OTHERS, "this adapter computes accelerations only"),
        )

        def __init__(self, system):
            self.model = mujoco.MjModel.from_xml_string(to_mjcf(system))
            self.data = mujoco.MjData(self.model)
            self.coordinates = RelativeCoordinates(system.tree().parents)

        def accelerations(self, theta, omega):
            found = np.empty_like(theta)
            for row, (q, v) in enumerate(zip(*map(self.coordinates.relative, (theta, omega)))):
                self.data.qpos[:], self.data.qvel[:] = q, v
                mujoco.mj_forward(self.model, self.data)
                found[row] = self.data.qacc
            return self.coordinates.absolute(found)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..models import System
from ..models.spatial_mechanism import SpatialMechanism

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ModelFields:
    """The model as the engine holds it after it has read or built it, in the order of the mechanism's links.

    Read it back from the engine, not from the system: it is compared with the system. ``dofs``: degrees of freedom;
    ``parents``: index of each link's parent, -1 for the support; ``hinges`` (n, 2): each hinge in the frame of the
    parent, ``centres`` (n, 2): each centre of mass in the link's own frame, as (along, across) [m] of
    :mod:`furiko.models.tree`; ``masses`` (n,) [kg]; ``inertias`` (n,) about the centre of mass and the hinge axis
    [kg m²]; ``gravity`` (3,): the vector (x, y, z) [m/s²] in the world where z is up and y into the plane; ``armature``
    (n,) [kg m²] and ``damping`` (n,) [N m s] of each hinge.
    """

    dofs: int
    parents: tuple[int, ...]
    hinges: Array
    centres: Array
    masses: Array
    inertias: Array
    gravity: Array
    armature: Array
    damping: Array


@dataclass(frozen=True)
class BareCall:
    """One call of the engine's own interface that computes the accelerations of ``states`` states; its input is set."""

    states: int
    call: Callable[[], object]


@dataclass(frozen=True)
class Native:
    """The engine's accelerations in its own coordinates q, v = dq/dt.

    ``accelerate``: q (n,), v (n,) → dv/dt (n,). ``from_absolute``: θ, or its rates, (B, n) → q, or its rates, (B, n);
    ``to_absolute``: the inverse. Both are linear.
    """

    accelerate: Callable[[Array, Array], Array]
    from_absolute: Callable[[Array], Array]
    to_absolute: Callable[[Array], Array]


class Engine(Protocol):
    """An adapter: see the module's docstring for the conventions and for what may be left out."""

    def __init__(self, system: System) -> None:
        """Build the engine's model of ``system``; ``system.tree()`` has its links, lengths, masses and gravity."""
        ...

    def fields(self) -> ModelFields:
        """The model as the engine compiled it."""
        ...

    def accelerations(self, theta: Array, omega: Array) -> Array:
        """Forward dynamics: θ̈ [rad/s²], shape (B, n), in the states ``theta``, ``omega`` (B, n)."""
        ...

    def inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        """Generalised forces τ [N m], shape (B, n), that the accelerations ``alpha`` [rad/s²] (B, n) need.

        τ_i is conjugate to the absolute angle θ_i: with relative joint torques τ_rel, τ = S⁻ᵀ τ_rel, which is
        :meth:`~furiko.engines.coordinates.RelativeCoordinates.absolute_forces`. With ``gravity`` false as if there
        were none: furiko obtains mass matrix, velocity terms and gravity terms from such calls.
        """
        ...

    def joint_forces(self, theta: Array, omega: Array, alpha: Array) -> Array:
        """Force (x, z) [N] that each link exerts on its parent, or on the support, at its hinge; shape (B, n, 2).

        In the motion with the accelerations ``alpha`` [rad/s²] (B, n). For a rod chain row j is Takeno's T_j,
        j = 0 … n-1: the force of A_{j+1} on A_j at their joint. An engine that has forces only along with its own
        accelerations may ignore ``alpha``.
        """
        ...

    def derivatives(self, theta: Array, omega: Array) -> tuple[Array, Array]:
        """∂θ̈/∂θ [1/s²] and ∂θ̈/∂θ̇ [1/s] of the engine's own accelerations, shape (B, n, n) each.

        Row i is that of θ̈_i, column k that of θ_k or of θ̇_k, all others held; all of them absolute. Not by differences
        of accelerations: they are held to rounding. Optional: for engines whose ``info.offers`` names it.
        """
        ...

    def inverse_mass(self, theta: Array) -> Array:
        """M⁻¹ [1/(kg m²)], shape (B, n, n): column k has the accelerations by a unit force on the absolute angle θ_k.

        Optional: for engines whose ``info.offers`` names it.
        """
        ...

    def energy(self, theta: Array, omega: Array) -> Array:
        """Kinetic and potential energy [J], shape (B, 2); the potential energy is zero at the height of the support."""
        ...

    def trajectory(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        """θ and ω, shape (n,) each, after ``steps`` ≥ 1 steps of ``step`` seconds from the one state (n,), (n,).

        ``integrator``: the name of one of ``info.integrators``. Every call starts anew: nothing is kept from earlier
        calls. Do not wrap angles into one turn. NaN where the engine fails to find a next state.
        """
        ...

    def path(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        """The same run with all its states, the first included: θ and ω, shape (steps + 1, n) each.

        Optional: without it furiko calls ``trajectory`` once for each point, which a scheme with a state of its own
        (``Integrator.remembers``) does not allow.
        """
        ...

    def adaptive(
        self, theta: Array, omega: Array, scheme: str, duration: float, tolerance: float
    ) -> tuple[Array, Array]:
        """θ and ω, shape (n,) each, after ``duration`` seconds from one state, in steps that the scheme chooses.

        ``scheme``: one of ``info.adaptive``; ``tolerance``: relative and absolute, of one step. Needed only where
        ``info.adaptive`` is not empty.
        """
        ...

    def bare_calls(self, theta: Array, omega: Array, threads: int) -> Mapping[str, BareCall]:
        """The engine's shortest ways to accelerations, by the names that its users know, prepared to be timed.

        Each works on all the states (B, n), with ``threads`` threads where it has them, or on the first state alone.
        Optional: for ``furiko bench``.
        """
        ...

    def native(self) -> Native:
        """The engine's accelerations in its own coordinates, one state a call. Optional: for ``furiko bench``."""
        ...

    def lighter(self) -> Mapping[str, Callable[[], AbstractContextManager[None]]]:
        """By name, contexts in which calls lack an overhead that only the engine's Python bindings add.

        Optional: for ``furiko bench``.
        """
        ...

    def gap(self) -> float:
        """Largest distance [m] between the two points that a joint holds together, at the end of the last run.

        Optional: only where joints are constraints (maximal coordinates), which a solver satisfies approximately.
        """
        ...


class TreeEngine(Protocol):
    """An adapter of an engine for open mechanisms; an engine without one takes the documents' mechanisms alone.

    States are ``q`` (B, nq) and ``v`` (B, nv), B ≥ 0, forces (B, nv), all in the coordinates of
    :mod:`furiko.models.spatial_mechanism`: joint after joint in the mechanism's order; a ball's or free joint's
    quaternion (w first) may have any length but zero and stands for the rotation of its direction; a free joint's
    velocity is that of its body's origin in the world's axes, then the angular velocity in the body's. An engine with
    other coordinates converts. Units are SI. With these signs the equation of motion is

        M(q) a + bias(q, v) = passive(q, v)

    where M has the armature, the bias gravity and all that is quadratic in v, and passive forces are those of dampers,
    −damping × v, and springs. Nothing else acts: no dry friction, limits, contacts, actuators.

    Arrays, NaN, exceptions and shapes as in the module's docstring. ``info.tree`` says what is missing.
    """

    def __init__(self, mechanism: SpatialMechanism) -> None:
        """Build the engine's model; raise ValueError where it cannot hold the mechanism."""
        ...

    def accelerations(self, q: Array, v: Array) -> Array:
        """The engine's own forward dynamics, springs and dampers included: a = dv/dt, (B, nv)."""
        ...

    def mass_matrix(self, q: Array) -> Array:
        """M, (B, nv, nv), both triangles."""
        ...

    def bias(self, q: Array, v: Array) -> Array:
        """Generalised forces that hold a = 0 without dampers and springs, (B, nv)."""
        ...

    def passive(self, q: Array, v: Array) -> Array:
        """Generalised forces of dampers and springs, (B, nv)."""
        ...

    def derivatives(self, q: Array, v: Array) -> tuple[Array, Array]:
        """∂a/∂q and ∂a/∂v, (B, nv, nv) each, of mechanisms of hinges and slides; springs and dampers included.

        As :meth:`Engine.derivatives`. Optional: where ``info.tree.offers`` names it.
        """
        ...

    def inverse_mass(self, q: Array) -> Array:
        """M⁻¹, (B, nv, nv), both triangles. Optional: where ``info.tree.offers`` names it."""
        ...

    def joint_forces(self, q: Array, v: Array, a: Array) -> Array:
        """Force [N], then moment [N m], of each moving link on its parent, or on the world, (B, links, 6).

        For the links that have joints, in the mechanism's order, in the motion with the accelerations ``a`` (B, nv);
        in the world's axes, the moment about the origin of the link's frame. It is what all of the link's joints hand
        on, springs, dampers and drives included: by Newton's and Euler's laws the weights of all that hangs there less
        the rates of its momenta. Rotors (armature) turn beside them and are left out. Optional: where
        ``info.tree.offers`` names it.
        """
        ...

    def energy(self, q: Array, v: Array) -> Array:
        """Kinetic energy, with the armatures', and potential energy, with the springs', [J], (B, 2).

        The potential energy may be off by one constant.
        """
        ...

    def trajectory(self, q: Array, v: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        """q (nq,) and v (nv,) after ``steps`` ≥ 1 steps of ``step`` seconds from the one state (nq,), (nv,).

        As :meth:`Engine.trajectory`. Quaternions, of any length in the state, are of length one at the end.
        """
        ...
