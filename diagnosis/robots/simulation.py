"""What a simulation of the user's file adds to its dynamics: servos, contacts at the start, time steps too long.

None of these is a difference between an engine and the file: they change no verdict, and are said beside it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from ...engines.model_files.robot import RobotEngine
from ...models.spatial_mechanism import SpatialMechanism
from ..finding import Finding
from .states import probe_states

if TYPE_CHECKING:
    from ...engines.model_files.robot_simulation import Simulation

# Of the kinetic energy, lost or won in a run that keeps its energy: a tenth of this is seen in no plot.
COARSE = 0.01
MOST_PAIRS = 3  # of touching geoms, named
MOST_SERVOS = 6  # named


def simulation_findings(engine: RobotEngine, mechanism: SpatialMechanism) -> list[Finding]:
    """Contacts at the start and a time step too long for the file, from MuJoCo's own run of it.

    The run starts at rest in a configuration inside the joints' ranges, without contacts, limits, dry friction,
    dampers and actuators. Empty for another engine, and where MuJoCo cannot run it.
    """
    from ...engines.model_files.robot_mujoco import MujocoRobot
    from ...engines.model_files.robot_simulation import simulate  # which imports MuJoCo

    if not isinstance(engine, MujocoRobot):
        return []

    q, _ = probe_states(mechanism, 2)
    try:
        run = simulate(engine, q[1], 0.0 * mechanism.per_freedom("armature"))
    except (ValueError, RuntimeError):
        return []
    return list(_said(run))


def _said(run: Simulation) -> Iterator[Finding]:
    if run.touching:
        more = len(run.touching) - MOST_PAIRS
        pairs = "; ".join(run.touching[:MOST_PAIRS]) + (f"; and {more} more pairs" if more > 0 else "")
        says = f"mujoco: geoms touch in the file's initial configuration and push each other: {pairs}"
        yield Finding("colliding-geoms", "mujoco", len(run.touching), 0, says)
    start, end = run.energy
    stable = math.isfinite(end)
    if not run.drift <= COARSE:
        words = f"from {start:.6g} to {end:.6g} J" if stable else "to no finite number: it is unstable"
        says = (
            f"mujoco: {run.integrator} with the file's time step of {run.timestep:g} s is too coarse: in "
            f"{run.seconds:.3g} s without friction and contacts the energy goes {words}"
        )
        if stable:
            says += f", {100 * run.drift:.2g} % of the kinetic energy; use a shorter step or integrator='RK4'"
        yield Finding("coarse-time-step", "mujoco", end if stable else None, start, says)


def servo_findings(servos: tuple[tuple[str, str], ...]) -> list[Finding]:
    """Actuators that pull although their control is zero, (actuator, joint), in one sentence."""
    if not servos:
        return []
    shown = ", ".join(f"{actuator!r} at joint {joint!r}" for actuator, joint in servos[:MOST_SERVOS])
    more = f" and {len(servos) - MOST_SERVOS} more" if len(servos) > MOST_SERVOS else ""
    count, them = ("1 actuator pulls", "it") if len(servos) == 1 else (f"{len(servos)} actuators pull", "them")
    says = (
        f"mujoco: {count} at ctrl = 0, wherever a joint is not at its target or moves: {shown}{more}; the comparison "
        f"is without {them}"
    )
    return [Finding("servo", f"actuator {servos[0][0]!r}", None, None, says)]
