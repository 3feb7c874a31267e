"""Accelerations of robots: furiko beside Pinocchio's compiled ABA and MuJoCo's batch, a state, on one thread.

    python benchmarks/trees.py FOLDER … [--states 2048] [--runs 61] [--robots NAME …] [--json FILE]

FOLDERs hold the published sample of model files (``robot_files.py`` says from which wheels), unpacked. Each robot is
the mechanism that Pinocchio holds after reading the file, so that both have the same, dampers apart; MuJoCo reads the
file itself. *Pinocchio* is its own compiled loop over a batch, ``abaInParallel`` with one thread: no call from Python
is in it. *MuJoCo* is ``mujoco.batch.Batch.forward`` with one thread, without contacts, limits, and actuators.

One run of each is timed after the other, again and again, in processor time, since other work on the machine comes and
goes; each run follows one that is not timed, so that the cache is its own. A ratio is the median over the pairs of
runs, with the middle half of them in brackets. Nanoseconds are the least of all runs.
Errors are those of a few states, against the proven accelerations: relative to the largest acceleration, and the
backward error, of a row over its terms' magnitudes, in ε. Exit status 1 where what is asked for is missed.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import mujoco.batch
import numpy as np
import pinocchio
from robot_truth import paths

from furiko.diagnosis.robots.answer import acting
from furiko.diagnosis.robots.states import probe_states, random_torques
from furiko.engines.model_files.robot import ROBOT_READERS
from furiko.models.readers.model_file import read_model
from furiko.models.spatial_mechanism import Array, SpatialMechanism
from furiko.reference.kernels.forward_dynamics import accelerations
from furiko.reference.rounding.spatial import Magnitudes
from furiko.reference.truth.spatial import spatial_truth

EPSILON = 2.0**-52
ROBOTS = ("xarm7", "suite/humanoid.xml", "g1_", "talos", "CMU")  # 7 to 62 degrees of freedom
ASKED, ASKED_BACKWARD, ASKED_ERROR = 8.0, 4.0, 3.0
ASKED_TO = 50  # degrees of freedom


@dataclass(frozen=True)
class Row:
    """One robot. Times in ns a state; ratios: median, and the quartiles; errors of a few states, the worst."""

    robot: str
    freedoms: int
    furiko: float
    pinocchio: float
    mujoco: float
    over_pinocchio: tuple[float, float, float]
    over_mujoco: tuple[float, float, float]
    backward: float
    error: float
    pinocchio_error: float

    @property
    def missed(self) -> bool:
        """Whether it is slower or less exact than asked."""
        slow = self.freedoms <= ASKED_TO and self.over_pinocchio[0] < ASKED
        return slow or self.backward > ASKED_BACKWARD or self.error > ASKED_ERROR * self.pinocchio_error

    def __str__(self) -> str:
        """As in the table."""
        ratios = (f"{r[0]:5.1f} [{r[1]:.1f}, {r[2]:.1f}]" for r in (self.over_pinocchio, self.over_mujoco))
        times = f"{self.furiko:8.0f}{self.pinocchio:11.0f}{self.mujoco:9.0f}"
        errors = f"{self.backward:6.2f} ε {self.error:9.0e}{self.pinocchio_error:11.0e}"
        return f"{self.robot:22}{self.freedoms:4}{times}   {'   '.join(f'{r:19}' for r in ratios)}{errors}"


def main() -> int:
    """Print the table; 1 where what is asked for is missed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--states", type=int, default=2048)
    parser.add_argument("--runs", type=int, default=61)
    parser.add_argument("--robots", nargs="*", default=list(ROBOTS), help="those whose path has one of these words")
    parser.add_argument("--json", type=Path, help="write the numbers there")
    chosen = parser.parse_args()
    compiling = first_call()
    print(f"compiling, once in a process, for every robot: {compiling:.2f} s of a processor")
    print(f"{'ns a state':22}{'n':>4}{'furiko':>8}{'pinocchio':>11}{'mujoco':>9}   {'pinocchio/furiko':19}   "
          f"{'mujoco/furiko':18}backward    error  pinocchio's")  # fmt: skip
    rows = []
    for path in paths(chosen.folders, chosen.robots):
        rows.append(measured(path.resolve(), chosen.states, chosen.runs))
        print(rows[-1], flush=True)
    if chosen.json:
        document = {"compiling": compiling, "states": chosen.states, "robots": [asdict(row) for row in rows]}
        chosen.json.write_text(json.dumps(document, indent=2) + "\n")
    return int(any(row.missed for row in rows))


def first_call() -> float:
    """Processor seconds that compiling takes."""
    begun = time.process_time()
    from furiko.reference.kernels.trees.machine import machine

    machine()
    return time.process_time() - begun


def measured(path: Path, states: int, runs: int) -> Row:
    """The row of one robot."""
    file = read_model(path)
    reader = ROBOT_READERS["pinocchio-aba"]
    with contextlib.redirect_stderr(io.StringIO()):
        engine = reader.load(path, file.language)
        simulator = ROBOT_READERS["mujoco"].load(path, file.language)
    mechanism = acting(engine.compiled(file.spatial), reader.leaves_to_caller)
    q, v = (np.ascontiguousarray(part) for part in probe_states(mechanism, states))
    torque = np.random.default_rng(0).normal(size=v.shape)
    out = np.empty_like(v)
    calls = (
        lambda: accelerations(mechanism, q, v, torque, out=out, threads=1),
        in_pinocchio(vars(engine)["_model"], torque),
        in_mujoco(vars(simulator)["_model"], states),
    )
    taken = np.array([[spent(call) for call in calls] for _ in range(runs + 1)])[1:]  # the first warms up
    least = taken.min(axis=0) / states * 1e9
    ratios = [np.percentile(taken[:, k] / taken[:, 0], (50, 25, 75)) for k in (1, 2)]
    over = [(float(middle), float(low), float(high)) for middle, low, high in ratios]
    errors = worst_errors(mechanism, engine.bind(mechanism))
    return Row(path.stem, mechanism.nv, *(float(x) for x in least), over[0], over[1], *errors)


def spent(call: Callable[[], Any]) -> float:
    """Processor seconds of a call, on whatever thread it runs."""
    call()
    begun = time.process_time()
    call()
    return time.process_time() - begun


def in_pinocchio(model: Any, torque: Array) -> Callable[[], Any]:
    """Pinocchio's loop over as many states, in its own coordinates: what they are makes no difference."""
    pool = pinocchio.ModelPool(model, 1)
    rng = np.random.default_rng(0)
    rows = [pinocchio.integrate(model, pinocchio.neutral(model), rng.normal(size=model.nv)) for _ in torque]
    q, v, forces = (np.asfortranarray(np.array(part).T) for part in (rows, rng.normal(size=(len(torque), model.nv)),
                                                                     torque[:, : model.nv]))  # fmt: skip
    found = np.asfortranarray(np.empty(v.shape))
    return lambda: pinocchio.abaInParallel(1, pool, q, v, forces, found)


def in_mujoco(model: Any, states: int) -> Callable[[], Any]:
    """MuJoCo's forward dynamics of as many states."""
    batch = mujoco.batch.Batch(model, states, 1)
    rng = np.random.default_rng(0)
    batch.bind("qpos")[:] += 0.1 * rng.normal(size=(states, model.nq))
    batch.bind("qvel")[:] = rng.normal(size=(states, model.nv))
    forward: Callable[[], Any] = batch.forward
    return forward


def worst_errors(mechanism: SpatialMechanism, engine: Any, states: int = 8) -> tuple[float, float, float]:
    """Backward error [ε], and forward errors of furiko and Pinocchio, driven by random torques."""
    q, v = probe_states(mechanism, states)
    still = [spatial_truth(mechanism, q[k], v[k]) for k in range(states)]
    matrix, bias = (np.array([getattr(truth, name).float for truth in still]) for name in ("mass_matrix", "bias"))
    torque = random_torques(matrix, bias)
    ours, theirs = accelerations(mechanism, q, v, torque), engine.accelerations(q, v, torque)
    backward, error, other = 0.0, 0.0, 0.0
    for k in range(states):
        truth = spatial_truth(mechanism, q[k], v[k], torque[k])
        true = truth.accelerations.float
        lengths = Magnitudes(mechanism, q[k], v[k], world=False)
        unit = lengths.residual(ours[k], matrix[k], torque[k], factorised=False)
        backward = max(backward, float((np.abs(truth.residual(ours[k]).float) / (EPSILON * unit)).max()))
        error, other = (max(e, float(np.abs(a[k] - true).max() / np.abs(true).max()))
                        for e, a in ((error, ours), (other, theirs)))  # fmt: skip
    return backward, error, other


if __name__ == "__main__":
    sys.exit(main())
