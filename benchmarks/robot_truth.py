"""Ten robots in MuJoCo, Pinocchio and Drake: how far each engine's numbers are from the proven ones.

    python benchmarks/robot_truth.py FOLDER … [--states 8] [--robots NAME …]

FOLDERs hold the published sample of model files (``robot_files.py`` says from which wheels), unpacked. For each robot
and engine that is installed and takes the file: the largest difference of mass matrix, bias and accelerations, relative
to the largest number of the state; in brackets the worst entry in units of what furiko allows for rounding, where more
than 1 would be a difference. An engine is held against the truth of what it holds; a robot that it reads otherwise than
the file says is marked ``*``. The last column is the processor time a state of the truth: the three, proved.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from furiko.diagnosis.robots.answer import acting
from furiko.diagnosis.robots.fields import field_differences
from furiko.diagnosis.robots.measures import measured
from furiko.diagnosis.robots.states import probe_states, random_torques
from furiko.engines.model_files.robot import ROBOT_READERS, BoundRobot, RobotReader
from furiko.models.readers.model_file import ModelFile, read_model
from furiko.models.spatial_mechanism import SpatialMechanism
from furiko.reference.truth.spatial import spatial_truth

# Arms, quadrupeds, humanoids; the smallest first. By the end of the path, the first that is found.
ROBOTS = (
    "ur_description/urdf/ur5_robot.urdf",
    "xarm_description/urdf/xarm7.urdf",
    "panda_description/urdf/panda.urdf",
    "suite/cheetah.xml",
    "go2_description/urdf/go2.urdf",
    "suite/humanoid.xml",
    "g1_description/urdf/g1_29dof_rev_1_0.urdf",
    "talos_data/robots/talos_full_v2.urdf",
    "suite/humanoid_CMU.xml",
    "suite/dog.xml",
)


@dataclass(frozen=True)
class Errors:
    """Of one engine on one robot: the largest relative errors of M, bias and accelerations, the worst entry in units of
    what is allowed, and whether the engine holds what the file says."""

    relative: tuple[float, float, float]
    ratio: float
    as_written: bool

    def __str__(self) -> str:
        """As in the table."""
        numbers = " / ".join(f"{error:.0e}" for error in self.relative)
        return f"{numbers} [{self.ratio:.0e}]{'' if self.as_written else '*'}"


def main() -> int:
    """Print the table; 1 where an engine is beyond what rounding explains."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--states", type=int, default=8)
    parser.add_argument("--robots", nargs="*", help="only those whose path has one of these words")
    chosen = parser.parse_args()
    beyond = False
    print(f"{'robot':24}{'n':>4}  " + "".join(f"{name + ': M / bias / a [units]':42}" for name in ROBOT_READERS) + "ms")
    for path in paths(chosen.folders, chosen.robots):
        file = read_model(path)
        cells = []
        for reader in ROBOT_READERS.values():
            found = errors(reader, file, path.resolve(), chosen.states)
            beyond = beyond or (isinstance(found, Errors) and not found.ratio <= 1)
            cells.append(f"{found!s:42}")
        spent = milliseconds(file.spatial, chosen.states)
        print(f"{path.stem:24}{file.spatial.nv:4}  {''.join(cells)}{spent:.1f}", flush=True)
    return int(beyond)


def paths(folders: list[Path], words: list[str] | None) -> Iterator[Path]:
    """The robots' files, in their order. Exits where one is not there."""
    for robot in ROBOTS:
        if words and not any(word in robot for word in words):
            continue
        found = sorted(path for folder in folders for path in folder.rglob(Path(robot).name) if robot in str(path))
        if not found:
            sys.exit(f"{robot}: not below {', '.join(map(str, folders))}")
        yield found[0]


def errors(reader: RobotReader, file: ModelFile, path: Path, states: int) -> Errors | str:
    """One engine's errors, or why there are none."""
    with contextlib.redirect_stderr(io.StringIO()):
        try:
            engine = reader.load(path, file.language)
            holds = engine.compiled(file.spatial)
            bound = engine.bind(holds)
        except ImportError:
            return "not installed"
        except (ValueError, RuntimeError) as error:
            return f"refuses: {' '.join(str(error).split()).removeprefix(str(path))[:30]}"
    differ = field_differences(holds, file.spatial, ignored=reader.not_held, mesh_axes=reader.mesh_axes)
    mechanism = acting(holds, reader.leaves_to_caller)
    ratios = [one.ratio for one in measured(bound, mechanism, factorised=reader.factorises)]
    return Errors(relative_errors(bound, mechanism, states), max(ratios), not differ)


def relative_errors(bound: BoundRobot, mechanism: SpatialMechanism, states: int) -> tuple[float, float, float]:
    """Of mass matrix, bias, and accelerations under random torques, each over the largest number of its state."""
    q, v = probe_states(mechanism, states)
    truths = [spatial_truth(mechanism, q[k], v[k]) for k in range(len(q))]
    matrix, bias = (np.array([getattr(t, name).float for t in truths]) for name in ("mass_matrix", "bias"))
    torque = random_torques(matrix, bias)
    driven = [spatial_truth(mechanism, q[k], v[k], torque[k]).accelerations.float for k in range(len(q))]
    pairs = (
        (bound.mass_matrix(q), matrix),
        (bound.bias(q, v), bias),
        (bound.accelerations(q, v, torque), np.array(driven)),
    )
    worst = [float(max(np.abs(a - b).max() / np.abs(b).max() for a, b in zip(*pair, strict=True))) for pair in pairs]
    return worst[0], worst[1], worst[2]


def milliseconds(mechanism: SpatialMechanism, states: int) -> float:
    """Processor time a state of mass matrix, bias and accelerations, the least of the states."""
    q, v = probe_states(mechanism, states)
    taken = []
    for k in range(len(q)):
        begun = time.process_time()
        truth = spatial_truth(mechanism, q[k], v[k])
        truth.mass_matrix, truth.bias, truth.accelerations  # noqa: B018
        taken.append(time.process_time() - begun)
    return 1000 * min(taken)


if __name__ == "__main__":
    sys.exit(main())
