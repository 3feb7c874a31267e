"""An engine's name and capabilities, as plain data: known without importing the engine or numpy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

Quantity = Literal["fields", "accelerations", "inverse_dynamics", "joint_forces", "energy", "trajectory"]
TreeQuantity = Literal["accelerations", "mass_matrix", "bias", "passive", "energy", "trajectory"]
Algorithm = Literal["aba", "crba", "other", "unknown"]
Moments = Literal["hinge", "tree", "world", "unknown"]
Ordering = Literal["bodies", "colamd", "pivoted", "unknown"]
# Asked of engines whose ``offers`` names them, of the documents' mechanisms and of trees.
Offer = Literal["derivatives", "inverse_mass"]
# Of trees alone: of the documents' mechanisms joint forces are a quantity that every engine gives or is missing.
TreeOffer = Literal["derivatives", "inverse_mass", "joint_forces"]
# What a tree may have that an engine cannot hold. "several joints": of one link; "spring of a ball": or of a free one;
# "massless link": that moves, and nothing with mass is fixed to it; "ball before a rotation": on one link;
# "free beside others": a link with a free joint is not the only one on the world.
TreeFeature = Literal[
    "hinge",
    "slide",
    "ball",
    "free",
    "several joints",
    "several joints, the first with ref",
    "armature",
    "armature of a free joint",
    "damping",
    "spring",
    "spring of a ball",
    "massless link",
    "ball before a rotation",
    "free beside others",
]


@dataclass(frozen=True)
class Integrator:
    """One of an engine's own integrators with a fixed step: its name in the engine, and its order of convergence.

    ``tolerance``: the residual, relative to that of the first guess, at which an implicit scheme's iterations end; 0
    for an explicit scheme. ``remembers``: the scheme has a state besides angles and rates (accelerations, violated
    constraints), so that n runs of one step are not one run of n steps. ``turning``: its order where balls or free
    joints turn, 0 where that is no other; ``lone_body``: why a free body on which nothing moves has no textbook step.
    """

    name: str
    order: int
    tolerance: float = 0.0
    remembers: bool = False
    turning: int = 0
    lone_body: str = ""


@dataclass(frozen=True)
class TreeInfo:
    """What an engine does with open mechanisms (scenes of ``kind = "tree"``).

    ``adapter``: the class for them, ``module:Class`` (:class:`~furiko.engines.protocol.TreeEngine`); ``missing``: by
    name of each quantity that it cannot give, and ``cannot_hold``: by name of each feature that it cannot have, a
    sentence that says why. ``offers``, ``lacks``: as the engine's, and ``joint_forces``; ``cannot_differentiate``: as
    ``cannot_hold``, for the derivatives alone. ``together``: whether the joints of one link are one joint of the
    engine's, whose block of the mass matrix it inverts. The largest system, integrators and ways to compute are the
    engine's.
    """

    adapter: str
    missing: Mapping[TreeQuantity, str] = field(default_factory=dict)
    cannot_hold: Mapping[TreeFeature, str] = field(default_factory=dict)
    offers: tuple[TreeOffer, ...] = ()
    lacks: Mapping[TreeOffer, str] = field(default_factory=dict)
    cannot_differentiate: Mapping[TreeFeature, str] = field(default_factory=dict)
    together: bool = False


@dataclass(frozen=True)
class EngineInfo:
    """An engine's name and capabilities.

    * ``formulation``: a phrase that tells two adapters of one engine apart; ``adapter``: its class, ``module:Class``;
      ``module``: the module it imports; ``package``: the package to pip install; ``homepage``: its address.
    * ``tested``: versions of the package that furiko was tested with, the latest last; empty: nothing is known of any.
    * ``integrators``: with a fixed step; ``adaptive``: names of schemes that choose their steps from a tolerance.
    * ``missing``: by name of each quantity that it cannot give, a sentence that says why.
    * ``offers``: which of ``derivatives`` and ``inverse_mass`` it can be asked; ``lacks``: by name of one that it does
      not offer, a sentence that says why.
    * ``tree``: what it does with open mechanisms; None: it takes the documents' alone.

    Limits: ``largest_n`` links, ``least_mass`` [kg] and ``least_inertia`` [kg m²] about the hinge for each link;
    ``no_point_masses``: why a link without inertia about its own centre cannot be taken, empty where it can. The
    reasons for the others are half sentences that follow "takes at most … links:" and "takes masses from …:".

    How it computes, from which bounds on its rounding errors are derived:

    * ``coordinates``: those in which it forms and solves the equations of motion: joint angles (``relative``), absolute
      angles, or all coordinates of free bodies (``maximal``).
    * ``moments``: the point about which it takes moments: each link's ``hinge``, the centre of mass of the ``tree``, or
      the origin of the ``world``; ``moments_of_offers``: the same in derivatives and the inverse mass matrix, where it
      is another.
    * ``placed``: whether its model has a link's place in the frame of the ``parent``, as it is given, or as the
      difference of two places in the ``world``.
    * ``interchanges``: whether its linear solver interchanges rows (partial pivoting, without scaling them); None where
      it is not known.
    * ``ordering``: in maximal coordinates, the order in which unknowns are eliminated: the ``bodies`` first, each for
      itself, and then the multipliers from a dense matrix; all of them by a sparse solver that interchanges rows, in
      the order of ``colamd`` or in another (``pivoted``); or ``unknown``.
    * ``accuracy``: relative accuracy of one operation, with ``accuracy_reason`` where it is not the unit roundoff.
    * ``algorithm``: how accelerations are solved for: articulated bodies (``aba``), or a mass matrix that is formed and
      factorised (``crba``), as the engines do it whose usual rounding was measured; ``other``: in another way, or in
      three dimensions with rounding of their own: nothing is said of the usual rounding, of the worst alone;
      ``inverse``: how inverse dynamics and joint forces are computed: link by link (``rnea``), link by link but for a
      mass matrix of composite bodies times the accelerations (``crba``), or in a way that is not known (``matrix``).
      They tell the usual rounding, not the worst.

    Of what is ``unknown`` the way with the most rounding counts: see :attr:`ways`.
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
    no_point_masses: str = ""
    accuracy: float = 2.0**-52
    accuracy_reason: str = ""
    moments: Moments = "unknown"
    moments_of_offers: Literal["", "world"] = ""
    placed: Literal["parent", "world", "unknown"] = "unknown"
    interchanges: bool | None = None
    ordering: Ordering = "unknown"
    algorithm: Algorithm = "unknown"
    inverse: Literal["rnea", "crba", "matrix"] = "matrix"
    tree: TreeInfo | None = None
    tested: tuple[str, ...] = ()
    offers: tuple[Offer, ...] = ()
    lacks: Mapping[Offer, str] = field(default_factory=dict)

    @property
    def factorises(self) -> bool:
        """Whether its accelerations may come from a mass matrix that is factorised."""
        return self.algorithm != "aba"

    @property
    def inverts(self) -> bool:
        """Whether they may come joint by joint, so that the block of a joint of several freedoms is inverted."""
        return self.algorithm != "crba"

    @property
    def ways(self) -> tuple[EngineInfo, ...]:
        """What the engine may be as to its rounding: itself where all is known, else each way to compute.

        Places in the world are less exact than those on the parent; articulated bodies need neither moments of a matrix
        nor a linear solver.
        """
        if self.coordinates == "maximal":
            orderings: tuple[Ordering, ...] = ("bodies", "pivoted") if self.ordering == "unknown" else (self.ordering,)
            return tuple(replace(self, ordering=ordering) for ordering in orderings)
        if self.algorithm == "other":
            return (self,)
        algorithms: tuple[Algorithm, ...] = ("aba", "crba") if self.algorithm == "unknown" else (self.algorithm,)
        moments: tuple[Moments, ...] = (self.moments,)
        if self.moments == "unknown":  # in absolute angles no moments are taken about another point
            moments = ("hinge", "tree", "world") if self.coordinates == "relative" else ("hinge",)
        solvers = (False, True) if self.interchanges is None else (self.interchanges,)
        known = replace(self, placed="world" if self.placed == "unknown" else self.placed)
        return tuple(
            replace(known, algorithm=algorithm, moments=about, interchanges=interchanges)
            for algorithm in algorithms
            for about in (moments if algorithm == "crba" else moments[:1])
            for interchanges in (solvers if algorithm == "crba" else solvers[:1])
        )
