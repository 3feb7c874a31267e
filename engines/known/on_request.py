"""Engines that furiko has adapters for and that run only where they are named, as data.

Each is an extra of its own (``pip install 'furiko[dart]'``), large or slow to build. A run that names no engine leaves
them out.
"""

from __future__ import annotations

from typing import Any

from ..info import EngineInfo, TreeInfo

_NO_RUNS: Any = {"trajectory": "its adapter asks for dynamics alone, not for time steps"}
_NO_INVERSE: Any = {"inverse_mass": "it forms the mass matrix, and an inverse of it would be NumPy's"}
_DRAKE: dict[str, Any] = {
    "module": "pydrake",
    "package": "drake",
    "tested": ("1.51.1",),
    "homepage": "https://drake.mit.edu",
    "coordinates": "relative",
    "moments": "hinge",
    "placed": "parent",
    "inverse": "rnea",
    "missing": _NO_RUNS | {"joint_forces": "its reaction forces belong to its own accelerations and have their errors"},
    "largest_n": 200,
    "largest_n_reason": "longer chains were not tried",
}
_SYMPY: dict[str, Any] = {
    "module": "sympy",
    "package": "sympy",
    "tested": ("1.14.0",),
    "homepage": "https://www.sympy.org",
    "coordinates": "absolute",
    "moments": "hinge",
    "placed": "parent",
    "lacks": _NO_INVERSE | {"derivatives": "its formulas are compiled for accelerations alone"},
    "algorithm": "other",
    "largest_n": 5,
    "largest_n_reason": "deriving the equations takes 2 s for five links and 40 s for ten",
    "missing": _NO_RUNS
    | {
        "fields": "it compiles no model: the mechanism's numbers are in its formulas",
        "joint_forces": "neither method forms the forces in the joints",
    },
}
_COMPILED_BY_MUJOCO: dict[str, Any] = {
    "least_mass": 1e-15,
    "least_inertia": 1e-15,
    "least_reason": "MuJoCo's compiler, which makes its model, puts 1e-15 in the place of anything less",
}
_NOT_COMPILED: Any = {
    "massless link": "MuJoCo's compiler, which makes its model, refuses a moving link without mass",
    "ball before a rotation": "MuJoCo's compiler, which makes its model, refuses a ball before another rotation",
}
_MJX: dict[str, Any] = {
    "module": "mujoco.mjx",
    "package": "mujoco-mjx",
    "tested": ("3.17.0",),
    "homepage": "https://mujoco.readthedocs.io/en/stable/mjx.html",
    "coordinates": "relative",
    "inverse": "crba",
    "moments": "tree",
    "placed": "parent",
    "interchanges": False,
    "algorithm": "other",  # as MuJoCo, in an order that a compiler chooses anew
    "missing": _NO_RUNS
    | {
        "fields": "its model is the one that MuJoCo compiles, whose fields are compared there",
        "joint_forces": "it forms no forces in hinges without sensors",
        "energy": "its energies are computed in steps alone",
    },
    "largest_n": 100,
    "largest_n_reason": "compiling takes 1 to 2 s a link and question, 5 of derivatives: 50 links take six minutes",
    **_COMPILED_BY_MUJOCO,
}
_NO_ENERGY: Any = {"energy": "its energies are computed in steps alone"}
_NO_JOINT_FORCES: Any = {"joint_forces": "it forms no forces in hinges without sensors"}
_WARP_LACKS: Any = {
    "derivatives": "it differentiates no accelerations",
    "inverse_mass": "it has a function for M⁻¹ times a vector, which accelerations test",
}

ON_REQUEST: dict[str, EngineInfo] = {
    info.name: info
    for info in (
        EngineInfo(
            name="dart",
            formulation="articulated-body algorithm; model from URDF",
            adapter="furiko.engines.dart:Dart",
            module="dartpy",
            package="dartpy",
            tested=("6.20.0",),
            homepage="https://dartsim.github.io",
            coordinates="relative",
            moments="hinge",
            placed="parent",
            interchanges=False,
            algorithm="other",
            inverse="rnea",
            offers=("inverse_mass",),
            lacks={"derivatives": "DART differentiates no accelerations"},
            missing=_NO_RUNS,
            largest_n=200,
            largest_n_reason="longer chains were not tried",
        ),
        EngineInfo(
            name="drake-aba",
            formulation="articulated-body algorithm; model from URDF",
            adapter="furiko.engines.drake:DrakeAba",
            offers=("derivatives",),
            lacks=_NO_INVERSE,
            interchanges=False,
            algorithm="other",  # articulated bodies in the world's axes, with rotations in three dimensions
            **_DRAKE,
        ),
        EngineInfo(
            name="drake-crba",
            lacks=_NO_INVERSE | {"derivatives": "those of Drake's accelerations are asked of drake-aba"},
            formulation="mass matrix, bias and gravity, then numpy's solution; model from URDF",
            adapter="furiko.engines.drake:DrakeCrba",
            interchanges=True,
            algorithm="crba",
            **_DRAKE,
        ),
        EngineInfo(
            name="mjx",
            formulation="MuJoCo's equations in JAX, in batches, double precision; model from MJCF",
            adapter="furiko.engines.mjx:Mjx",
            offers=("derivatives",),
            lacks={
                "inverse_mass": "it has a function for M⁻¹ times a vector, which derivatives and accelerations test"
            },
            tree=TreeInfo(
                "furiko.engines.trees.mjx:MjxTree",
                _NO_RUNS | _NO_ENERGY,
                _NOT_COMPILED,
                offers=("derivatives",),
                lacks=_NO_JOINT_FORCES
                | {"inverse_mass": "it has a function for M⁻¹ times a vector, which accelerations test"},
            ),
            **_MJX,
        ),
        EngineInfo(
            name="mjx-float32",
            formulation="MuJoCo's equations in JAX, in batches, single precision; model from MJCF",
            adapter="furiko.engines.mjx:MjxSingle",
            accuracy=2.0**-23,
            accuracy_reason="single precision, JAX's own: held to 2⁻²³ for one operation",
            lacks=dict.fromkeys(("derivatives", "inverse_mass"), "asked of mjx, in double precision"),
            tree=TreeInfo(
                "furiko.engines.trees.mjx:MjxSingleTree",
                _NO_RUNS | _NO_ENERGY,
                _NOT_COMPILED,
                lacks=dict.fromkeys(("derivatives", "inverse_mass"), "asked of mjx, in double precision")
                | _NO_JOINT_FORCES,
            ),
            **_MJX,
        ),
        EngineInfo(
            name="mujoco-warp",
            formulation="MuJoCo's equations in Warp, in batches, single precision; model from MJCF",
            adapter="furiko.engines.mujoco_warp:MujocoWarp",
            module="mujoco_warp",
            package="mujoco-warp",
            tested=("4.0.0",),
            homepage="https://github.com/google-deepmind/mujoco_warp",
            coordinates="relative",
            inverse="crba",
            moments="tree",
            placed="parent",
            interchanges=False,
            algorithm="other",  # as MuJoCo, in single precision, with a factorisation of its own for small matrices
            accuracy=2.0**-23,
            accuracy_reason="single precision, the only one it has: held to 2⁻²³ for one operation",
            missing=_NO_RUNS
            | {
                "fields": "its model is the one that MuJoCo compiles, whose fields are compared there",
                "joint_forces": "it forms no forces in hinges without sensors",
            },
            lacks=_WARP_LACKS,
            tree=TreeInfo(
                "furiko.engines.trees.mujoco_warp:MujocoWarpTree",
                _NO_RUNS,
                _NOT_COMPILED,
                lacks=_WARP_LACKS | _NO_JOINT_FORCES,
            ),
            largest_n=200,
            largest_n_reason="longer chains were not tried",
            **_COMPILED_BY_MUJOCO,
        ),
        EngineInfo(
            name="pybullet",
            lacks=_NO_INVERSE | {"derivatives": "PyBullet differentiates no accelerations"},
            formulation="mass matrix and bias, then numpy's solution; model from URDF",
            adapter="furiko.engines.pybullet:PyBullet",
            module="pybullet",
            package="pybullet",
            tested=("3.2.7",),
            homepage="https://pybullet.org",
            coordinates="relative",
            moments="hinge",
            placed="parent",
            interchanges=True,
            algorithm="crba",
            inverse="rnea",
            missing=_NO_RUNS
            | {
                "fields": "it does not give back all that it compiled",
                "joint_forces": "its reaction forces in motion are those of another motion",
                "energy": "it has no energies",
            },
            largest_n=100,
            largest_n_reason="its mass matrix of longer chains is wrong, without an error",
        ),
        EngineInfo(
            name="sympy-kane",
            formulation="derived by Kane's method for each mechanism, then numpy's solution",
            adapter="furiko.engines.sympy_mechanics:SympyKane",
            interchanges=True,
            **_SYMPY,
        ),
        EngineInfo(
            name="sympy-lagrange",
            formulation="derived by Lagrange's method for each mechanism, then numpy's solution",
            adapter="furiko.engines.sympy_mechanics:SympyLagrange",
            interchanges=True,
            **_SYMPY,
        ),
    )
}
