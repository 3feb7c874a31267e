"""Exudyn, which reads no robot files, asked about the mechanism that furiko read: whether it moves as theory has it."""

from __future__ import annotations

import importlib

import numpy as np

from ...engines.model_files.robot import BoundRobot, RobotReader
from ...models import InvalidInput
from ...models.errors import installing
from ...models.spatial_mechanism import SpatialMechanism
from .answer import Question, RobotAnswer, acting, computing_findings, failed, places_in
from .measures import measured, not_determined

HELD = ("hinge", "slide")
MOST_FREEDOMS = 200  # its solver is dense, and each state is one more start of it
BUILT = RobotReader(
    "exudyn-tree",
    "furiko.engines.trees.robot_exudyn:ExudynRobot",
    "exudyn",
    "exudyn",
    languages=(),
    not_held=("armature", "friction"),
    factorises=True,
)
NOT_DETERMINED = "its mass matrix comes from accelerations, which are not determined: {why}"
NOTE = "Exudyn reads neither format: the mechanism was built by furiko's reader"


def why_not_built(mechanism: SpatialMechanism) -> str:
    """Why Exudyn's kinematic tree cannot hold the mechanism; nothing where it can."""
    other = next((placed.joint for placed in mechanism.joints if placed.joint.kind not in HELD), None)
    if other is not None:
        return f"its kinematic tree has hinges and slides alone, and joint {other.name!r} is {other.kind}"
    if mechanism.nv > MOST_FREEDOMS:
        return f"{mechanism.nv} freedoms; at most {MOST_FREEDOMS} are put into its kinematic tree"
    return ""


def ask_built(question: Question) -> RobotAnswer:
    """What Exudyn makes of the mechanism of the file, without armature, which it does not have."""
    mechanism = question.file.spatial
    answer = RobotAnswer(BUILT.name, "agrees", notes=(NOTE,), native=False)
    why = why_not_built(mechanism)
    if why:
        answer.status, answer.says = "refused", why
        return answer
    module, _, name = BUILT.adapter.partition(":")
    try:
        adapter = getattr(importlib.import_module(module), name)
    except ImportError as error:
        answer.status, answer.says = "missing", f"{installing(BUILT.package)} [{error}]"
        return answer
    if mechanism.per_freedom("armature").any():
        answer.without = (f"armature in {BUILT.name}, whose kinematic tree has none",)
    answer.holds = acting(mechanism, BUILT.not_held)
    try:
        with np.errstate(all="ignore"):
            bound: BoundRobot = adapter(answer.holds)
            answer.measured = tuple(measured(bound, answer.holds, factorised=BUILT.factorises))
            answer.findings = computing_findings(BUILT, bound, answer, places_in(mechanism))
    except (ValueError, RuntimeError, InvalidInput, np.linalg.LinAlgError) as error:
        if why := not_determined(answer.holds):
            answer.status, answer.says = "refused", NOT_DETERMINED.format(why=why)
            return answer
        return failed(answer, error)
    if answer.findings:
        answer.status = "differs"
    return answer
