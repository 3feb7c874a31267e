"""What is known of an engine without importing it or numpy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

Quantity = Literal["fields", "accelerations", "inverse_dynamics", "joint_forces", "energy", "trajectory"]


@dataclass(frozen=True)
class Integrator:
    """One of an engine's own time-stepping schemes: its name there, and the order its makers give it.

    ``tolerance``: the residual, relative to that of a first guess, at which an implicit scheme's iterations end.
    ``remembers``: a step starts from more than angles and rates (accelerations, joints that have come apart), so that
    n single steps are not a run of n steps.
    """

    name: str
    order: int
    tolerance: float = 0.0
    remembers: bool = False


@dataclass(frozen=True)
class EngineInfo:
    """An engine's name and capabilities, known without importing it.

    ``adapter``: where its class is, ``module:Class``; ``module``: what it imports; ``package``: what to pip install.
    ``coordinates``: those in which it forms and solves the equations, hence where its rounding arises; ``moments``: the
    point about which it takes moments then, each link's own hinge or the centre of mass of the whole tree.
    ``placed``: whether its reader has each link's place on its parent as it stands, or as a difference of two in the
    world. ``interchanges``: whether it solves for accelerations with rows interchanged, however large each one is.
    ``adaptive``: its schemes that choose their own steps from a tolerance. ``missing``: for each quantity it cannot
    give, the sentence that says why. ``accuracy``: relative accuracy of one operation, and ``accuracy_reason`` where
    that is more than double precision's rounding. ``largest_n`` links it takes, and a mass of ``least_mass`` [kg] or
    more and an inertia about the hinge of ``least_inertia`` [kg m²] or more for each link; the reasons say what stands
    in the way.

    Two facts tell what rounding does, not at worst but as a rule, and are trusted only where they promise less of it:
    ``algorithm``: how accelerations are solved for, articulated bodies (``aba``) or a mass matrix that is put together
    and factorised (``crba``); ``inverse``: how inverse dynamics and joint forces are computed, link by link (``rnea``,
    with moments about what ``moments`` says), so but for a mass matrix of composite bodies times the accelerations
    (``crba``), or in a way that is not known (``matrix``).
    """

    name: str
    formulation: str
    adapter: str
    module: str
    package: str
    homepage: str
    coordinates: Literal["relative", "absolute", "maximal"]
    integrators: tuple[Integrator, ...] = ()
    adaptive: tuple[str, ...] = ()
    missing: Mapping[str, str] = field(default_factory=dict)
    largest_n: int = 10_000
    largest_n_reason: str = ""
    least_mass: float = 0.0
    least_inertia: float = 0.0
    least_reason: str = ""
    accuracy: float = 2.0**-52
    accuracy_reason: str = ""
    moments: Literal["hinge", "tree"] = "hinge"
    placed: Literal["parent", "world"] = "parent"
    interchanges: bool = False
    algorithm: Literal["aba", "crba"] = "crba"
    inverse: Literal["rnea", "crba", "matrix"] = "matrix"
