"""One rung of a ladder on one subject: accelerations against the proven ones, and what one ulp of the input does.

Subjects are the engines, ``document`` (the literal equations in double precision) and ``kernels`` (furiko's own O(n)
accelerations in all their forms). The typical error of a rung (the median over its states) decides whether half the
digits are lost: the largest of a few would depend on which states were drawn. The kernels are held to more: in every
state to 1e-13 of the largest acceleration or, where the problem itself is that sensitive, to ten times of what one ulp
in each of its numbers does, or of what numbers below the normal range may do.

Beside the error stands the residual over what rounding may do to it, in the worst state: above 1 no rounding explains
the error, however small it is; below, half the digits are lost because the mechanism multiplies rounding, or because
numbers are subnormal.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...engines import cannot, engine_info, load_engine
from ...models import NLegPendulum, RodChain
from ...records.check import Result
from ...records.stress import HALF_THE_DIGITS
from ...reference import literal_accelerations
from ...reference.kernels.forward_dynamics import accelerations as kernel_accelerations
from ...reference.kernels.forward_dynamics import kernel_of, plain_accelerations
from ...reference.rounding.bounds import EPSILON, amplitudes, condition
from ...reference.truth.enclosures import Enclosure
from ...reference.truth.newton_euler import close_accelerations, enclosed_accelerations
from .axes import Mechanism, find_axes
from .case import RungCase
from .failures import Failure, of_answer
from .over_bound import DOCUMENT, KERNELS, OWN, over_bound, underflow

Array = NDArray[np.float64]

PROMISED = 1e-13  # of the kernels, norm-wise, where the problem's own conditioning allows it
TIMES_ULP = 10.0  # and where it does not
NEIGHBOURS = 2  # states with one ulp more or less in each number, with which a state is compared
HEAVY = 200  # links
MOST_FOR_CONDITION = 300  # links: the matrices are dense


@dataclass(frozen=True)
class AccelerationCase(RungCase):
    """A case: it says under which names its result stands, and makes it."""

    @property
    def heavy(self) -> bool:
        """Whether it takes seconds rather than milliseconds."""
        (ladder,) = find_axes((self.ladder,))
        return ladder.recipe(self.rung).n > HEAVY

    @property
    def compiles(self) -> bool:
        """Whether a process has machine code compiled for it: where none is kept, that takes ten seconds and more."""
        return self.engine == KERNELS

    @property
    def takes(self) -> float:
        """Seconds that it may well take: proofs for ten thousand rods, or compiling the kernels."""
        return 120.0 if self.engine == KERNELS or self.heavy else 0.0

    def run(self) -> Result:
        """Measure. An engine's exceptions are the caller's to catch."""
        (ladder,) = find_axes((self.ladder,))
        recipe = ladder.recipe(self.rung)
        system = recipe.system()
        where = {"rung": self.rung, "value": ladder.value(self.rung), "at": ladder.label(self.rung), "n": system.n}
        if self.engine not in OWN and (why_not := cannot(engine_info(self.engine), system)):
            return self.result("skipped", reason=why_not, details={**where, "failure": "refused"})
        problem = problem_on(self.ladder, self.rung, self.seed)
        with np.errstate(all="ignore"):
            answers = ask(self.engine, system, problem.theta, problem.omega)
        errors = np.max([relative_error(problem.truth, answer) for answer in answers], axis=0)
        typical, worst = float(np.median(errors)), float(np.max(errors))
        over = self._over_bound(system, problem, answers)
        failure = of_answer(np.array(answers), typical, over)
        cond = condition_number(self.engine, system, problem)
        details = {
            **where,
            "failure": failure,
            "states": len(problem.theta),
            "error": finite(typical),
            "worst error": finite(worst),
            "digits": digits(typical),
            "one ulp does": finite(float(np.median(problem.ulp))),
            "condition": finite(cond),
            "error over ε·cond": finite(typical / (EPSILON * cond)) if cond else None,
            "error over bound": finite(over),
        }
        if self.engine == KERNELS:
            return self._kernels(errors, problem, details)
        return self.result(
            "differs" if failure else "agrees",
            measured=finite(typical),
            allowed=HALF_THE_DIGITS,
            unit="of the largest acceleration",
            reason=told(failure, typical, over),
            details=details,
        )

    def _over_bound(self, system: Mechanism, problem: Problem, answers: list[Array]) -> float | None:
        """Of the worst answer; None for mechanisms whose dense matrices take too long."""
        if system.n > MOST_FOR_CONDITION:
            return None
        state = problem.theta, problem.omega, problem.truth
        return max(over_bound(self.engine, system, *state, answer) for answer in answers)

    def _kernels(self, errors: Array, problem: Problem, details: dict[str, object]) -> Result:
        system = find_axes((self.ladder,))[0].recipe(self.rung).system()
        lost: Array | float = 0.0
        if system.n <= MOST_FOR_CONDITION:
            lost = underflow(system, problem.theta, problem.omega, problem.truth)
        allowed = np.maximum(np.maximum(PROMISED, TIMES_ULP * problem.ulp), lost)
        state = int(np.argmax(errors / allowed))
        broken = not errors[state] <= allowed[state]
        beyond = bool((errors > PROMISED).any())
        details["exception"] = beyond
        if broken:
            reason = f"more than {PROMISED:g}, than ten times of what one ulp of the input does, and than underflow"
        elif beyond and allowed[state] > TIMES_ULP * problem.ulp[state]:
            reason = f"more than {PROMISED:g}, but numbers below the normal range may do {allowed[state]:.2g}"
        elif beyond:
            reason = f"more than {PROMISED:g}, but one ulp of the input does {problem.ulp[state]:.2g} itself"
        else:
            reason = ""
        return self.result(
            "differs" if broken else "agrees",
            measured=finite(float(errors[state])),
            allowed=float(allowed[state]),
            unit="of the largest acceleration",
            reason=reason,
            details=details,
        )


@dataclass(frozen=True)
class Problem:
    """States (B, n), the truth in them, and what one ulp of the input does to each, relative to its largest, (B,)."""

    theta: Array
    omega: Array
    truth: Enclosure
    ulp: Array


@lru_cache(maxsize=256)
def problem_on(ladder: str, rung: int, seed: int) -> Problem:
    """The problem of a rung; kept, since every subject of this process is asked the same."""
    (found,) = find_axes((ladder,))
    recipe = found.recipe(rung)
    system = recipe.system()
    theta, omega = recipe.draw(f"{seed} {ladder} {rung}")
    random = np.random.Generator(np.random.PCG64([seed, rung]))
    ulp = np.array([ulp_effect(system, t, w, random) for t, w in zip(theta, omega, strict=True)])
    return Problem(theta, omega, enclosed_accelerations(system, theta, omega), ulp)


def ask(subject: str, system: Mechanism, theta: Array, omega: Array) -> list[Array]:
    """A subject's accelerations; those of every form of the kernels."""
    if subject == DOCUMENT:
        return [literal_accelerations(system, theta, omega)]
    if subject == KERNELS:
        kernel = kernel_of(system)
        single = np.array([kernel_accelerations(system, t, w) for t, w in zip(theta, omega, strict=True)])
        return [single, kernel.batch(theta, omega), plain_accelerations(system, theta, omega)]
    return [load_engine(subject, system).accelerations(theta, omega)]


def relative_error(truth: Enclosure, answer: Array) -> Array:
    """Largest error over largest acceleration, (B,); infinite where something came of nothing."""
    error = truth.error(answer).max(axis=-1)
    size = np.abs(truth.high).max(axis=-1)
    error = np.where(np.isfinite(answer).all(axis=-1), error, np.inf)
    return np.asarray(np.divide(error, size, out=np.where(error > 1e-290, np.inf, 0.0), where=size > 0))


def ulp_effect(system: Mechanism, theta: Array, omega: Array, random: np.random.Generator) -> float:
    """How far accelerations move, relative to the largest, when every number of the input moves by one ulp."""
    here = close_accelerations(system, theta, omega)
    size = max(abs(float(a)) for a in here)
    moved = 0.0
    for _ in range(NEIGHBOURS):
        there = close_accelerations(
            moved_system(system, random), moved_by_ulp(theta, random), moved_by_ulp(omega, random)
        )
        moved = max(moved, *(abs(float(a - b)) for a, b in zip(here, there, strict=True)))
    return moved / size if size else 0.0


def moved_system(system: Mechanism, random: np.random.Generator) -> Mechanism:
    """The mechanism with every number one ulp more or less."""
    lengths = tuple(moved_by_ulp(np.array(system.lengths), random).tolist())
    gravity = float(moved_by_ulp(np.array(system.gravity), random)) if system.gravity else 0.0
    if isinstance(system, RodChain):
        return RodChain(lengths, system.density, gravity)
    return NLegPendulum(lengths, tuple(moved_by_ulp(np.array(system.masses), random).tolist()), gravity)


def moved_by_ulp(values: Array, random: np.random.Generator) -> Array:
    """Each number's neighbour on one side or the other."""
    return np.asarray(np.nextafter(values, np.where(random.random(values.shape) < 0.5, -np.inf, np.inf)))


def condition_number(subject: str, system: Mechanism, problem: Problem) -> float | None:
    """Median over the states of the accelerations' condition in the subject's coordinates; None where not computed."""
    if system.n > MOST_FOR_CONDITION:
        return None
    relative = subject not in OWN and engine_info(subject).coordinates == "relative"
    try:
        with np.errstate(all="ignore"):
            amplitude = amplitudes(system, "relative" if relative else "absolute")
            found = condition(system, problem.theta, amplitude, problem.truth.high, problem.omega)
    except np.linalg.LinAlgError:
        return None
    middle = float(np.median(found))
    return middle if np.isfinite(middle) and middle > 0 else None


def told(failure: Failure | None, error: float, over: float | None) -> str:
    """The failure in a sentence."""
    if failure is None:
        return ""
    if failure == "NaN":
        return "NaN or infinity among the accelerations"
    share = "" if over is None else f", {over:.2g} of what rounding may do to its equation"
    return f"{failure}: a typical error of {error:.2g} of the largest acceleration{share}"


def digits(error: float) -> float | None:
    """Correct decimal digits, 0 … 16."""
    if not np.isfinite(error):
        return 0.0
    return round(float(min(16.0, max(0.0, -np.log10(max(error, 1e-16))))), 2)


def finite(value: float | None) -> float | None:
    """JSON has no infinity."""
    return value if value is not None and np.isfinite(value) else None
