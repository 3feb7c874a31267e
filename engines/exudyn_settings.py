"""Shared by both Exudyn adapters: settings that print and write nothing, and runs of Exudyn's integrators."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np

from .protocol import Array

# Exudyn's type stubs do not fit its own interface: Any, here and nowhere else.
exudyn: Any = import_module("exudyn")
items: Any = import_module("exudyn.itemInterface")

Initial = exudyn.ConfigurationType.Initial
Current = exudyn.ConfigurationType.Current

# Exudyn prints from C++, past sys.stdout; its only switch is this one, for the whole process.
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


def run(
    mbs: Any,
    linear_solver: Any,
    integrator: str,
    step: float,
    steps: int,
    *,
    accelerations: Array | None = None,
    all_states: bool = False,
) -> tuple[Array, Array]:
    """Coordinates and their rates after ``steps`` steps of ``step`` [s] from the initial state, (1, coordinates) each.

    With ``all_states`` those of the start and of every step, (steps + 1, coordinates). ``accelerations``: those of the
    initial state, where Exudyn is not to compute them itself.

    NaN where an implicit scheme's Newton iterations do not converge, as where an explicit scheme overflows. Their
    tolerance is at the level of rounding: the default one (relative 1e-8) adds a fifth to the error of 25 000 steps.
    """
    settings = quiet_settings(linear_solver)
    integration = settings.timeIntegration
    integration.numberOfSteps = steps
    integration.endTime = step * steps
    integration.automaticStepSize = False
    integration.adaptiveStep = False
    integration.newton.relativeTolerance = 1e-12
    data = mbs.systemData
    # The numbers are near one (:mod:`furiko.models.units`), each equation has a rounding error: this is the smallest
    # tolerance that the iterations reach.
    integration.newton.absoluteTolerance = 1e-13 * data.ODE2Size()
    if accelerations is not None:
        integration.generalizedAlpha.computeInitialAccelerations = False
        data.SetODE2Coordinates_tt(accelerations, Initial)
    states: list[tuple[Array, Array]] = []

    def record(_mbs: Any = None, _time: float = 0.0) -> bool:
        states.append((np.array(data.GetODE2Coordinates(Current)), np.array(data.GetODE2Coordinates_t(Current))))
        return True

    if all_states:
        mbs.SetPreStepUserFunction(record)
    try:
        exudyn.SolveDynamic(mbs, settings, solverType=getattr(exudyn.DynamicSolverType, integrator))
        record()
    except exudyn.SolverError:
        no_state = np.full(data.ODE2Size(), np.nan)
        states += [(no_state, no_state)] * (steps + 1 - len(states) if all_states else 1)
    finally:
        if all_states:
            mbs.SetPreStepUserFunction(0)
    coordinates, rates = zip(*states, strict=True)
    return np.array(coordinates), np.array(rates)


def run_adaptive(mbs: Any, linear_solver: Any, scheme: str, duration: float, tolerance: float) -> tuple[Array, Array]:
    """Coordinates and their rates after ``duration`` [s] in steps that the scheme chooses; NaN where it fails.

    ``tolerance``: relative and absolute, of one step. The first step is a thousandth of the whole.
    """
    settings = quiet_settings(linear_solver)
    integration = settings.timeIntegration
    integration.numberOfSteps = 1  # its longest step is the duration over this
    integration.endTime = duration
    integration.initialStepSize = 1e-3 * duration
    integration.minimumStepSize = 1e-12 * duration
    integration.relativeTolerance = integration.absoluteTolerance = tolerance
    data = mbs.systemData
    try:
        exudyn.SolveDynamic(mbs, settings, solverType=getattr(exudyn.DynamicSolverType, scheme))
    except exudyn.SolverError:
        no_state = np.full(data.ODE2Size(), np.nan)
        return no_state, no_state
    return np.array(data.GetODE2Coordinates(Current)), np.array(data.GetODE2Coordinates_t(Current))
