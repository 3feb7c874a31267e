"""What both Exudyn adapters need: a quiet, fileless solver, and runs of its integrators."""

from __future__ import annotations

from typing import Any

import exudyn
import numpy as np

from .protocol import Array

Initial = exudyn.ConfigurationType.Initial
Current = exudyn.ConfigurationType.Current

# Exudyn prints from C++, past sys.stdout; there is no other switch than this one, which is the whole process's.
exudyn.config.printToConsole = False


def quiet_settings(linear_solver: Any) -> Any:
    """Settings that print nothing and write nothing (the defaults make a folder ``solution``)."""
    settings = exudyn.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.restart.write = False
    settings.solution.sensors.active = False
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.verboseModeFile = 0
    settings.linearSolver.solverType = linear_solver
    return settings


def run(mbs: Any, linear_solver: Any, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
    """Coordinates and their rates after ``steps`` steps of ``step`` [s] from the initial state.

    NaN where an implicit scheme's Newton iterations find no next state, as where an explicit one overflows. They end
    where rounding does: with the default tolerances (relative 1e-8) they add a fifth to the error of 25 000 steps.
    """
    settings = quiet_settings(linear_solver)
    integration = settings.timeIntegration
    integration.numberOfSteps = steps
    integration.endTime = step * steps
    integration.automaticStepSize = False
    integration.adaptiveStep = False
    integration.newton.relativeTolerance = 1e-12
    integration.newton.absoluteTolerance = 1e-13
    data = mbs.systemData
    try:
        exudyn.SolveDynamic(mbs, settings, solverType=getattr(exudyn.DynamicSolverType, integrator))
    except exudyn.SolverError:
        return np.full(data.ODE2Size(), np.nan), np.full(data.ODE2Size(), np.nan)
    return np.array(data.GetODE2Coordinates(Current)), np.array(data.GetODE2Coordinates_t(Current))
