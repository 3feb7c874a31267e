"""Ladders of open mechanisms in space: one rung on one engine, accelerations against the proven ones.

As :mod:`.accelerations` has it for the documents' mechanisms: the typical error of a rung (the median over its states)
decides whether half the digits are lost.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...engines import cannot, engine_info, load_tree_engine
from ...models import TreeSystem
from ...models.trees.states import random_states
from ...models.trees.system import TreeJoint, TreeLink
from ...records.check import Result
from ...records.stress import HALF_THE_DIGITS
from ...reference.truth.enclosures import Enclosure
from ...reference.truth.spatial import spatial_truth
from .accelerations import digits, finite, relative_error, told
from .case import RungCase
from .failures import of_answer

Array = NDArray[np.float64]

STATES = 3
HEAVY = 100  # degrees of freedom: a state's truth takes a tenth of a second
AXES_OF_HINGES = ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.3, 1.0))  # in turn, so that a chain moves in space


@dataclass(frozen=True)
class TreeLadder:
    """``values`` of what is varied, from harmless to extreme; ``system`` and ``speed`` (a factor of rates) of each."""

    name: str
    says: str
    unit: str
    values: tuple[float, ...]
    system: Callable[[float], TreeSystem]
    speed: Callable[[float], float] = lambda _: 1.0

    def value(self, rung: int) -> float:
        """In ``unit``."""
        return self.values[rung]

    def label(self, rung: int) -> str:
        """The value with its unit."""
        return f"{self.values[rung]:g}{self.unit and ' '}{self.unit}"


def chain(n: int, *, last_mass: float = 1.0, last_length: float = 1.0) -> TreeSystem:
    """Rods of 2 m and 2 kg in all, on hinges whose axes are not parallel; the last one lighter or shorter."""
    links = []
    for i in range(n):
        last = i == n - 1
        length, mass = 2.0 / n * (last_length if last else 1.0), 2.0 / n * (last_mass if last else 1.0)
        moment = mass * length**2 / 12
        links.append(
            TreeLink(
                name=f"rod {i + 1}",
                parent=i - 1,
                position=(0.0, 0.0, -2.0 / n if i else 0.0),
                mass=mass,
                centre=(0.0, 0.0, -length / 2),
                inertia=(moment, moment, moment / 50, 0.0, 0.0, 0.0),
                joints=(TreeJoint(f"hinge {i + 1}", axis=AXES_OF_HINGES[i % 3]),),
            )
        )
    return TreeSystem(tuple(links))


def floating(ratio: float) -> TreeSystem:
    """A body that moves freely, with two limbs lighter than it by ``ratio`` on ball joints."""
    trunk = TreeLink(
        "trunk", -1, mass=10.0, inertia=(0.4, 0.5, 0.3, 0.0, 0.0, 0.0), joints=(TreeJoint("float", "free"),)
    )
    mass = 10.0 * ratio
    limbs = tuple(
        TreeLink(
            f"limb {k}",
            0,
            position=(0.2 * side, 0.1, 0.0),
            mass=mass,
            centre=(0.0, 0.0, -0.25),
            inertia=(0.02 * mass, 0.02 * mass, 0.001 * mass, 0.0, 0.0, 0.0),
            joints=(TreeJoint(f"ball {k}", "ball"),),
        )
        for k, side in ((1, 1.0), (2, -1.0))
    )
    return TreeSystem((trunk, *limbs))


_DECADES = tuple(10.0**-k for k in range(11))

TREE_LADDERS = {
    ladder.name: ladder
    for ladder in (
        TreeLadder(
            "tree freedoms",
            "a chain in space, of more and more links",
            "degrees of freedom",
            (2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0),
            lambda n: chain(int(n)),
        ),
        TreeLadder(
            "tree tip mass",
            "a chain of six links in space, the last one lighter and lighter",
            "of the others' mass",
            _DECADES,
            lambda ratio: chain(6, last_mass=ratio),
        ),
        TreeLadder(
            "tree tip length",
            "a chain of six links in space, the last one shorter and shorter",
            "of the others' length",
            _DECADES[:6],
            lambda ratio: chain(6, last_length=ratio),
        ),
        TreeLadder(
            "tree limb mass",
            "a free body with two limbs on ball joints, lighter and lighter",
            "of the body's mass",
            _DECADES,
            floating,
        ),
        TreeLadder(
            "tree speed",
            "a free body with two limbs on ball joints, faster and faster",
            "times as fast as it falls",
            tuple(10.0**k for k in range(9)),
            lambda _: floating(0.1),
            lambda speed: speed,
        ),
    )
}


@dataclass(frozen=True)
class TreeCase(RungCase):
    """A case: it says under which names its result stands, and makes it."""

    @property
    def heavy(self) -> bool:
        """Whether it takes seconds rather than milliseconds."""
        return self.ladder == "tree freedoms" and TREE_LADDERS[self.ladder].value(self.rung) > HEAVY

    def run(self) -> Result:
        """Measure. An engine's exceptions are the caller's to catch."""
        ladder = TREE_LADDERS[self.ladder]
        system = ladder.system(ladder.value(self.rung))
        details = {
            "rung": self.rung,
            "value": ladder.value(self.rung),
            "at": ladder.label(self.rung),
            "n": system.n,
        }
        if why_not := cannot(engine_info(self.engine), system):
            return self.result("skipped", reason=why_not, details=details | {"failure": "refused"})
        problem = tree_problem(self.ladder, self.rung, self.seed)
        with np.errstate(all="ignore"):
            answer = load_tree_engine(self.engine, system).accelerations(problem.q, problem.v)
        errors = relative_error(problem.truth, answer)
        typical = float(np.median(errors))
        failure = of_answer(answer, typical)
        return self.result(
            "differs" if failure else "agrees",
            measured=finite(typical),
            allowed=HALF_THE_DIGITS,
            unit="of the largest acceleration",
            reason=told(failure, typical),
            details=details
            | {
                "failure": failure,
                "states": len(problem.q),
                "error": finite(typical),
                "worst error": finite(float(np.max(errors))),
                "digits": digits(typical),
            },
        )


@dataclass(frozen=True)
class TreeProblem:
    """States, q (B, nq) and v (B, nv), and the truth in them."""

    q: Array
    v: Array
    truth: Enclosure


@lru_cache(maxsize=64)
def tree_problem(ladder: str, rung: int, seed: int) -> TreeProblem:
    """The problem of a rung; kept, since every engine of this process is asked the same."""
    found = TREE_LADDERS[ladder]
    value = found.value(rung)
    system = found.system(value)
    rows = [(q, found.speed(value) * v) for q, v in random_states(f"{seed} {ladder} {rung}", system, STATES)]
    mechanism = system.mechanism()
    truths = [spatial_truth(mechanism, *row).accelerations.enclosure for row in rows]
    return TreeProblem(
        np.array([q for q, _ in rows]),
        np.array([v for _, v in rows]),
        Enclosure(*(np.array([getattr(truth, part) for truth in truths]) for part in ("high", "low", "radius"))),
    )
