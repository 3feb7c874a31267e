"""Every check, in the order in which a cell runs them. A new one: a file in ``comparisons/`` and an entry here."""

from __future__ import annotations

from ..engines import OWN_EQUATIONS, EngineInfo
from ..models import AnyScene, TreeScene
from .check import Check, OfTrees

NOT_OFFERED = "the engine's adapter offers neither derivatives of its accelerations nor an inverse mass matrix"


def _no_duration(scene: AnyScene, _info: EngineInfo) -> str:
    return "" if scene.duration else "the scene has no duration: nothing moves in it"


def _no_model_file(scene: AnyScene, info: EngineInfo) -> str:
    if not isinstance(scene, TreeScene):
        return ""
    if not scene.model:
        return "the scene has no model file: engines are given a tree body by body"
    from ..engines.model_files.robot import ROBOT_READERS  # numpy, which a plan without model files need not wait for

    return "" if info.name in ROBOT_READERS else f"no model file is given to {info.name}"


def _no_images(_scene: AnyScene, info: EngineInfo) -> str:
    return "the equations are those of this mechanism, not of its images" if info == OWN_EQUATIONS else ""


def _no_runs(scene: AnyScene, _info: EngineInfo) -> str:
    if isinstance(scene, TreeScene) and "spring of a ball" in scene.system.features:
        return "the force of a ball's spring jumps at half a turn, which a run may pass: no scheme has its order there"
    return ""


def _no_motion(scene: AnyScene, info: EngineInfo) -> str:
    if isinstance(scene, TreeScene) and not scene.starts:
        return "the scene has no state for a trajectory to start from"
    return _no_duration(scene, info) or _no_runs(scene, info)


def _no_derivatives(scene: AnyScene, info: EngineInfo) -> str:
    if not isinstance(scene, TreeScene):
        return "" if info.offers else "; ".join(dict.fromkeys(info.lacks.values())) or NOT_OFFERED
    if {"ball", "free"} & scene.system.features:
        return "derivatives are compared of trees of hinges and slides alone"
    if info.tree is None or not {"derivatives", "inverse_mass"} & set(info.tree.offers):
        lacks = {one: why for one, why in info.tree.lacks.items() if one != "joint_forces"} if info.tree else {}
        return "; ".join(dict.fromkeys(lacks.values())) or NOT_OFFERED
    return ""


def _no_joint_forces(scene: AnyScene, info: EngineInfo) -> str:
    if not isinstance(scene, TreeScene) or info.tree is None or "joint_forces" in info.tree.offers:
        return ""
    return info.tree.lacks.get("joint_forces", "the engine's adapter does not offer the forces in a tree's joints")


def _not_chaotic(scene: AnyScene, info: EngineInfo) -> str:
    if "chaotic" not in scene.tags:
        return "the scene is not tagged 'chaotic': its divergence time is not asked"
    if isinstance(scene, TreeScene):
        if {"ball", "free"} & scene.system.features:
            return "motions are followed in quadruple precision of trees of hinges and slides alone"
        return _no_motion(scene, info)
    return "" if scene.starts else "the scene has no state for a trajectory to start from"


CHECKS = {
    check.name: check
    for check in (
        Check(
            name="model fields",
            needs="fields",
            module="model_fields",
            meaning="The masses, centres, inertias and joints that the engine compiled are those of the scene.",
            bound="rounding of what the engine's reader computes from the file's numbers",
            trees=OfTrees("model_file", "accelerations"),
            why_not=_no_model_file,
            explained=True,
        ),
        Check(
            name="accelerations",
            needs="accelerations",
            module="accelerations",
            meaning="The engine's forward dynamics solve the document's equations of motion.",
            bound="backward error: residual over the sum of the magnitudes of the row's terms",
            trees=OfTrees("accelerations", "accelerations"),
            explained=True,
        ),
        Check(
            name="symmetry",
            needs="accelerations",
            module="symmetries",
            meaning="The engine answers alike where the mechanism looks alike: mirrored, turned, scaled, exchanged.",
            bound="rounding of both answers",
            trees=OfTrees("symmetries", "accelerations"),
            why_not=_no_images,
        ),
        Check(
            name="terms",
            needs="inverse_dynamics",
            module="terms",
            meaning="Mass matrix, velocity terms and gravity terms agree entry by entry.",
            bound="rounding of the magnitudes that make up each entry",
            trees=OfTrees("terms", "mass_matrix"),
            explained=True,
        ),
        Check(
            name="derivatives",
            needs="accelerations",
            module="derivatives",
            meaning="The engine's ∂a/∂q, ∂a/∂v and M⁻¹ are the exact derivatives of the equations of motion.",
            bound="rounding of the magnitudes that make up each entry, through the solution with the mass matrix",
            trees=OfTrees("derivatives", "accelerations"),
            why_not=_no_derivatives,
        ),
        Check(
            name="joint forces",
            needs="joint_forces",
            module="joint_forces",
            meaning="The joint reaction forces are those of Newton's law for all that hangs below.",
            bound="rounding of the sum of the magnitudes of the forces",
            trees=OfTrees("joint_forces", "accelerations"),
            why_not=_no_joint_forces,
        ),
        Check(
            name="energy",
            needs="energy",
            module="energy",
            meaning="Kinetic and potential energy agree, up to one constant of the potential.",
            bound="rounding of the sum of the magnitudes of the links' energies",
            trees=OfTrees("energy", "energy"),
        ),
        Check(
            name="step map",
            needs="trajectory",
            module="step_map",
            meaning="One step of each of the engine's integrators is one step of a textbook scheme.",
            bound="rounding of the accelerations, handed on through one step",
            trees=OfTrees("step_map", "trajectory"),
        ),
        Check(
            name="trajectory",
            needs="trajectory",
            module="trajectories",
            meaning="Each integrator converges to the true motion with its order.",
            bound="Richardson extrapolation's own uncertainty, and rounding grown along the motion",
            trees=OfTrees("trajectories", "trajectory"),
            why_not=_no_motion,
        ),
        Check(
            name="invariant",
            needs="trajectory",
            module="invariants",
            meaning="Energy, angular momentum and the way back hold in the limit of small steps.",
            bound="Richardson extrapolation's own uncertainty, and rounding along the run",
            trees=OfTrees("invariants", "trajectory"),
            why_not=_no_runs,
            long=True,
        ),
        Check(
            name="horizon",
            needs="trajectory",
            module="horizon",
            meaning="Trajectories of a chaotic motion diverge when their errors predict it, and no earlier.",
            bound="the predicted divergence time, from local errors and the tangent flow",
            trees=OfTrees("horizon", "trajectory"),
            why_not=_not_chaotic,
            long=True,
        ),
    )
}
