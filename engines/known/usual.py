"""The engines that run where none is named, as data."""

from __future__ import annotations

from typing import Any

from ..info import EngineInfo, Integrator, TreeInfo

_NO_TRAJECTORY: Any = {"trajectory": "Pinocchio computes dynamics; it has no integrator of its own"}
_NOT_HELD: Any = {
    "spring of a ball": "Pinocchio has no springs: the adapter adds those of hinges and slides",
    "armature of a free joint": "Pinocchio's armature of a free joint acts in the body's axes, not in the world's",
}
_NOT_READ: Any = {
    "several joints, the first with ref": "Pinocchio's reader of MJCF ignores the ref of the first of several joints",
    "free beside others": "Pinocchio's reader takes the world's first body alone, where a free one must be",
}
_DIFFERENCED: Any = {
    "derivatives": "MuJoCo has finite differences of a step and of inverse dynamics (mjd_transitionFD, mjd_inverseFD) "
    "and no derivatives of accelerations"
}
_BOTH: Any = {"offers": ("derivatives", "inverse_mass")}
_OF_TREES: Any = {"offers": ("derivatives", "inverse_mass", "joint_forces")}
_FACTORS_ALONE: Any = {
    "offers": ("inverse_mass",),
    "lacks": {"derivatives": "Pinocchio differentiates its articulated-body algorithm alone"},
}
_PINOCCHIO: dict[str, Any] = {
    "module": "pinocchio",
    "package": "pin",
    "tested": ("4.0.0", "4.1.0"),
    "homepage": "https://github.com/stack-of-tasks/pinocchio",
    "coordinates": "relative",
    "moments": "hinge",
    "interchanges": False,
    "inverse": "rnea",
    "missing": _NO_TRAJECTORY,
    "largest_n": 300,
    "least_mass": 2.0**-52,
    "least_reason": "it divides by 2.2e-16 (machine epsilon) in the place of any lesser mass where it adds inertias",
    "largest_n_reason": "its data hold second derivatives of the kinematics, which grow with n³: 1.8 GB at 300 links",
}
_NOT_DIFFERENTIATED: Any = dict.fromkeys(
    ("derivatives", "inverse_mass"), "Exudyn has neither derivatives of its accelerations nor an inverse mass matrix"
)
_NO_JOINT_FORCES = "a kinematic tree in minimal coordinates never forms the forces in its joints"
_EXUDYN: dict[str, Any] = {
    "lacks": _NOT_DIFFERENTIATED,
    "module": "exudyn",
    "package": "exudyn",
    "tested": ("1.13.6",),
    "homepage": "https://github.com/jgerstmayr/EXUDYN",
}

ENGINES: dict[str, EngineInfo] = {
    info.name: info
    for info in (
        EngineInfo(
            name="mujoco",
            formulation="composite rigid bodies and factorised mass matrix; model from MJCF",
            adapter="furiko.engines.mujoco:Mujoco",
            module="mujoco",
            package="mujoco",
            tested=("3.3.7", "3.17.0", "4.0.0"),
            homepage="https://github.com/google-deepmind/mujoco",
            coordinates="relative",
            algorithm="crba",
            inverse="crba",
            placed="parent",
            interchanges=False,
            moments="tree",  # mjData.cinert, cdof, cvel and cacc are "com-based", about subtree_com of the root body
            offers=("inverse_mass",),
            lacks=_DIFFERENCED,
            tree=TreeInfo(
                "furiko.engines.trees.mujoco:MujocoTree",
                offers=("inverse_mass", "joint_forces"),
                lacks=_DIFFERENCED,
                cannot_hold={
                    "massless link": "MuJoCo's compiler refuses a moving link without mass",
                    "ball before a rotation": "MuJoCo's compiler refuses a ball before another rotation of its link",
                },
            ),
            integrators=(Integrator("Euler", 1), Integrator("implicitfast", 1), Integrator("RK4", 4)),
            largest_n=1000,
            largest_n_reason="its compiler fails on bodies nested 1024 deep",
            least_mass=1e-15,
            least_inertia=1e-15,
            least_reason="it puts 1e-15 (mjMINVAL) in the place of anything less in the mass matrix",
        ),
        EngineInfo(
            name="pinocchio-aba",
            formulation="articulated-body algorithm; model from URDF",
            adapter="furiko.engines.pinocchio:PinocchioAba",
            placed="parent",
            algorithm="aba",
            moments_of_offers="world",  # oYaba: computeMinverse and computeABADerivatives have inertias in the world
            tree=TreeInfo("furiko.engines.trees.pinocchio:PinocchioAbaTree", _NO_TRAJECTORY, _NOT_HELD, **_OF_TREES),
            **_PINOCCHIO,
            **_BOTH,
        ),
        EngineInfo(
            name="pinocchio-aba-mjcf",
            formulation="articulated-body algorithm; model from MJCF",
            adapter="furiko.engines.pinocchio:PinocchioAbaMjcf",
            placed="world",
            algorithm="aba",
            moments_of_offers="world",
            tree=TreeInfo(
                "furiko.engines.trees.pinocchio:PinocchioMjcfTree",
                _NO_TRAJECTORY,
                _NOT_HELD | _NOT_READ,
                cannot_differentiate={
                    "several joints": "of several joints on one link its reader makes a JointModelComposite, whose "
                    "derivatives are not those of its own accelerations"
                },
                together=True,
                **_OF_TREES,
            ),
            **_PINOCCHIO,
            **_BOTH,
        ),
        EngineInfo(
            name="pinocchio-crba",
            formulation="mass matrix by composite rigid bodies, then Cholesky; model from URDF",
            adapter="furiko.engines.pinocchio:PinocchioCrba",
            placed="parent",
            algorithm="crba",
            tree=TreeInfo(
                "furiko.engines.trees.pinocchio:PinocchioCrbaTree",
                _NO_TRAJECTORY,
                _NOT_HELD,
                **_FACTORS_ALONE | {"offers": ("inverse_mass", "joint_forces")},
            ),
            **_PINOCCHIO,
            **_FACTORS_ALONE,
        ),
        EngineInfo(
            name="exudyn-tree",
            formulation="kinematic tree in minimal coordinates, mass matrix and LU",
            adapter="furiko.engines.exudyn_tree:ExudynTree",
            tree=TreeInfo(
                "furiko.engines.trees.exudyn:ExudynMechanism",
                {"passive": "it gives the sum of all forces alone"},
                lacks=_NOT_DIFFERENTIATED | {"joint_forces": _NO_JOINT_FORCES},
                cannot_hold={
                    "ball": "Exudyn's kinematic tree has hinges and slides alone",
                    "free": "Exudyn's kinematic tree has hinges and slides alone",
                    "armature": "Exudyn's kinematic tree has no armature",
                },
            ),
            coordinates="relative",
            moments="hinge",
            placed="parent",
            interchanges=True,
            algorithm="crba",
            inverse="crba",
            integrators=(
                Integrator("RK44", 4),
                Integrator("RK67", 6),
                Integrator("GeneralizedAlpha", 2, tolerance=1e-12, remembers=True),
            ),
            adaptive=("DOPRI5",),
            missing={"joint_forces": _NO_JOINT_FORCES},
            largest_n=1000,
            largest_n_reason="a state costs n³ operations",
            **_EXUDYN,
        ),
        EngineInfo(
            name="exudyn-redundant",
            formulation="free bodies and revolute joints, constraints with Lagrange multipliers",
            adapter="furiko.engines.exudyn_redundant:ExudynRedundant",
            coordinates="maximal",
            moments="hinge",
            placed="parent",
            interchanges=False,
            algorithm="crba",
            integrators=(
                Integrator("GeneralizedAlpha", 2, tolerance=1e-12, remembers=True),
                Integrator("TrapezoidalIndex2", 2, tolerance=1e-12, remembers=True),
            ),
            missing={
                "inverse_dynamics": "in maximal coordinates Exudyn forms no generalised forces of the hinge angles"
            },
            largest_n=1000,
            largest_n_reason="three coordinates and two constraints a link",
            ordering="colamd",  # Eigen's SparseLU, whose columns COLAMD orders unless it is told otherwise
            accuracy=6 * 2.0**-52,
            accuracy_reason="three solutions combined with weights whose magnitudes sum to 5.7",
            **_EXUDYN,
        ),
    )
}
