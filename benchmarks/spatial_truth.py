"""What the theory in space costs a state: chains of hinges on a free base, each value proved.

    python benchmarks/spatial_truth.py [n ...]

prints, for each number of joints, the milliseconds of processor time for accelerations alone, and for the mass matrix,
bias and accelerations together (the least of several runs), and the radius of the accelerations relative to the
largest.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np

from furiko.models.spatial import Inertial
from furiko.models.spatial_mechanism import Joint, RigidBody, SpatialMechanism
from furiko.reference.truth.spatial import SpatialTruth, spatial_truth

JOINTS = (7, 30, 60, 300, 1000)
ASKED = {60: 20.0}  # ms


def chain(n: int) -> SpatialMechanism:
    """A free body and n − 1 more on hinges in random directions, one after the other."""
    rng = np.random.default_rng(n)
    bodies = []
    for i in range(n):
        joint = Joint(f"joint {i}", "hinge", axis=rng.normal(size=3)) if i else Joint("base", "free")
        tensor = np.diag(rng.uniform(0.01, 0.02, 3))
        inertial = Inertial(float(rng.uniform(0.5, 2)), rng.normal(size=3) * 0.1, tensor)
        bodies.append(RigidBody(f"body {i}", i - 1, rng.normal(size=3) * 0.2, rng.normal(size=4), (joint,), inertial))
    return SpatialMechanism(tuple(bodies), np.array([0.0, 0.0, -9.81]))


def accelerations(truth: SpatialTruth) -> None:
    """The accelerations alone."""
    truth.accelerations  # noqa: B018


def everything(truth: SpatialTruth) -> None:
    """All that an engine is compared with."""
    truth.mass_matrix, truth.bias, truth.accelerations  # noqa: B018


def cost(mechanism: SpatialMechanism, asked: Callable[[SpatialTruth], None]) -> float:
    """Milliseconds of processor time a state, the least of several: other work on the machine counts for little."""
    rng = np.random.default_rng(1)
    runs = max(2, 300 // mechanism.nv)
    taken = []
    for _ in range(min(runs, 15)):
        q, v = rng.normal(size=mechanism.nq), rng.normal(size=mechanism.nv)
        begun = time.process_time()
        asked(spatial_truth(mechanism, q, v))
        taken.append(time.process_time() - begun)
    return 1000 * min(taken)


def main(numbers: list[int]) -> int:
    """Print the table; 1 where a cost is above what is asked."""
    print("   n   accelerations   and M, bias   relative radius")
    missed = 0
    for n in numbers or JOINTS:
        mechanism = chain(n)
        alone, together = cost(mechanism, accelerations), cost(mechanism, everything)
        rng = np.random.default_rng(1)
        truth = spatial_truth(mechanism, rng.normal(size=mechanism.nq), rng.normal(size=mechanism.nv))
        radius = truth.accelerations.enclosure.relative_radius
        verdict = "" if n not in ASKED else f"   asked: ≤ {ASKED[n]:g} ms"
        missed += n in ASKED and together > ASKED[n]
        print(f"{n:4}   {alone:10.1f} ms  {together:9.1f} ms   {radius:.0e}{verdict}")
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main([int(argument) for argument in sys.argv[1:]]))
