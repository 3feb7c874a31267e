"""A user's own equations as one more engine: they answer, term by term, what engines are asked, without rounding."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import cast

import numpy as np
from numpy.typing import NDArray

from ...derivations.robot.reading import RobotDerivation, read_robot
from ...derivations.robot.rows import TrueTerms, alignment, true_terms
from ...derivations.robot.why import reasons
from ...diagnosis.finding import Finding
from ...engines import OWN_EQUATIONS, EngineInfo, TreeEngine, TreeQuantity, TreeShape
from ...models import TreeScene
from ...models.trees.states import random_states

Array = NDArray[np.float64]

STATES = 6  # in which rows are told apart and causes looked for
COMBINED: dict[TreeQuantity, str] = dict.fromkeys(
    ("mass_matrix", "bias", "passive"),
    "the rows are combined otherwise than those of Lagrange's equations: their accelerations are compared",
)


class OwnEquationsTree:
    """The equations of a scene, asked in the joints' coordinates; raises InvalidInput where they are not read."""

    def __init__(self, scene: TreeScene) -> None:
        assert scene.own is not None
        self.system = scene.system
        self.derivation: RobotDerivation = read_robot(scene.system, scene.own)
        self.motion = self.derivation.motion()
        states = random_states(f"rows of {scene.name}", scene.system, STATES)
        q, v = (np.array([state[k] for state in states]) for k in (0, 1))
        self.true: TrueTerms = true_terms(scene.system.mechanism(), q, v)

    @cached_property
    def scale(self) -> Array | None:
        """What makes rows of the joints' coordinates of the author's; None where nothing does."""
        return alignment(self.motion, self.true)

    def accelerations(self, q: Array, v: Array) -> Array:
        return self.motion.accelerations(q, v)

    def mass_matrix(self, q: Array) -> Array:
        assert self.scale is not None
        return np.asarray(self.scale @ self.motion.floats(q, np.zeros_like(q))[0])

    def bias(self, q: Array, v: Array) -> Array:
        velocity, gravity, _ = self._rest(q, v)
        return velocity + gravity

    def passive(self, q: Array, v: Array) -> Array:
        return -self._rest(q, v)[2]

    def _rest(self, q: Array, v: Array) -> tuple[Array, Array, Array]:
        assert self.scale is not None
        rest = self.motion.floats(q, v)[1] @ self.scale.T
        return rest[:, 0], rest[:, 1], rest[:, 2]

    def findings(self) -> list[Finding]:
        """Why they differ from the mechanism, as causes of an engine."""
        found = reasons(self.derivation, self.system, self.true)
        return [Finding(x.cause, x.where, x.measured, x.expected, x.says) for x in found]


def own_equations(scene: TreeScene) -> tuple[OwnEquationsTree, TreeShape, EngineInfo]:
    """The equations of a scene, as an engine, and what it can be asked."""
    own = OwnEquationsTree(scene)
    info = OWN_EQUATIONS
    if own.scale is None:
        assert info.tree is not None
        info = replace(info, tree=replace(info.tree, missing={**info.tree.missing, **COMBINED}))
    # Energies and trajectories are left out, as an adapter may: the information says that they are missing.
    return own, TreeShape(cast(TreeEngine, own), info, scene.system.mechanism()), info
