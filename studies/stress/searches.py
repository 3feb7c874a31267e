"""The stress test: searches that ask for cases, workers that run them, a budget, and resumed runs.

What has been found is in the results alone, each under a name of its own. A search is a function of them: it says which
case it needs next, or that it knows. So a run that was cut off goes on where it stood, nothing is lost and nothing is
done twice, and the order in which cases come in changes nothing. Every search has a first answer before any has two;
then families of searches (frontiers of accelerations, frontiers of the step, …) share the time by weight, and within a
family every search is asked as often as the others, from coarse to fine (:mod:`.questions`): a run that is cut off has
something to say of each.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from time import monotonic as now
from typing import Protocol

import msgspec

from ...engines import EngineInfo, engine_info
from ...engines.workers.messages import Failed
from ...engines.workers.pool import Event, Lost, Pool, Said, Worker
from ...engines.workers.processes import worker_processes
from ...models import TreeScene
from ...records.check import Result
from .accelerations import AccelerationCase
from .axes import Ladder, Pair
from .case import Case, CaseJob
from .chain import chain_runs, listed_cases
from .condition import condition_cases
from .failures import Failure
from .frontier import Frontier, frontier, next_rung
from .over_bound import DOCUMENT, KERNELS
from .questions import Questions
from .stability import CHUNKS, STRESSES, TOP, LongRunCase, StabilityCase, Stress
from .trees.axes import TreeLadder, tree_ladders
from .trees.case import TreeCase
from .trees.motions import known_motions
from .trees.runs import STEPS, TreeRunCase
from .trees.runs import TOP as LAST_TIME

TIMEOUT = 30.0  # [s] for one case; those that may take longer say so
GRACE = 5.0  # [s] that cases under way are given when the time is up

Watch = Callable[["Case", int], None]
Key = tuple[str, str, str]  # scene, engine, check: what a result goes by
Results = Mapping[Key, Result]

DENSE_LIMIT = 400  # links: the document's matrix is dense, and solving it costs n³


def key(case: Case | Result) -> Key:
    """The name of a case and of its result."""
    return case.scene, case.engine, case.check


def holds(result: Result) -> bool:
    """Whether nothing failed on this rung."""
    return result.details.get("failure") is None and result.outcome != "error"


class Search(Protocol):
    """One question: its family, and which case its answer needs next."""

    @property
    def family(self) -> str: ...
    def next(self, results: Results) -> tuple[Case | None, int]:
        """The next case (None: all is known), and how many of its cases there are results of."""
        ...


class UpRungs(ABC):
    """A search up the rungs of a ladder, for the last that holds."""

    @property
    @abstractmethod
    def top(self) -> int:
        """The last rung."""

    @abstractmethod
    def case(self, rung: int) -> Case:
        """The case of a rung."""

    def answers(self, results: Results) -> dict[int, bool]:
        """The known answers, by rung."""
        found = ((rung, results.get(key(self.case(rung)))) for rung in range(self.top + 1))
        return {rung: holds(result) for rung, result in found if result is not None}

    def next(self, results: Results) -> tuple[Case | None, int]:
        answers = self.answers(results)
        rung = next_rung(answers, self.top)
        return None if rung is None else self.case(rung), len(answers)

    def frontier(self, results: Results) -> Frontier:
        """The frontier known so far."""
        return frontier(self.answers(results), self.top)


@dataclass(frozen=True)
class AccelerationSearch(UpRungs):
    """How far up a ladder a subject's accelerations keep half their digits."""

    subject: str
    ladder: Ladder
    seed: int

    @property
    def family(self) -> str:
        return "pairs" if isinstance(self.ladder, Pair) else "accelerations"

    @property
    def top(self) -> int:
        """The last rung for this subject."""
        most = {KERNELS: 10_001, DOCUMENT: DENSE_LIMIT}.get(self.subject)
        return self.ladder.top_for(most or engine_info(self.subject).largest_n, kernels=self.subject == KERNELS)

    def case(self, rung: int) -> AccelerationCase:
        """The case of a rung."""
        return AccelerationCase(self.ladder.name, self.subject, rung, self.seed)


@dataclass(frozen=True)
class TreeSearch(UpRungs):
    """The same of an open mechanism in space; ``base``: the user's own scene that the ladder stands on, if any."""

    subject: str
    ladder: TreeLadder
    seed: int
    base: TreeScene | None = None

    family = "trees"

    @property
    def top(self) -> int:
        """The last rung."""
        return self.ladder.top

    def case(self, rung: int) -> TreeCase:
        """The case of a rung."""
        return TreeCase(self.ladder.name, self.subject, rung, self.seed, self.base)


@dataclass(frozen=True)
class StabilitySearch(UpRungs):
    """The largest step that an engine's integrator survives, in one place of what is put under stress."""

    engine: str
    integrator: str
    stress: Stress
    value: float
    seed: int

    family = "steps"

    @property
    def top(self) -> int:
        """The last rung."""
        return TOP

    def case(self, rung: int) -> StabilityCase:
        """The case of a rung."""
        return StabilityCase(self.engine, self.integrator, self.stress, self.value, rung, self.seed)


@dataclass(frozen=True)
class TreeRunSearch(UpRungs):
    """How long an engine's integrator keeps to a motion of an open mechanism that is known for ever."""

    engine: str
    integrator: str
    motion: str
    step: float

    family = "tree runs"

    @property
    def top(self) -> int:
        """The last rung."""
        return LAST_TIME

    def case(self, rung: int) -> TreeRunCase:
        """The case of a rung."""
        return TreeRunCase(self.engine, self.integrator, self.motion, self.step, rung)


@dataclass(frozen=True)
class LongRun:
    """A long run of one integrator, a hundredth at a time."""

    engine: str
    integrator: str
    steps: int

    family = "long runs"

    def parts(self, results: Results) -> list[Result]:
        """The parts that have been run, in order."""
        found: list[Result] = []
        while len(found) < CHUNKS:
            result = results.get(key(LongRunCase(self.engine, self.integrator, len(found), self.steps)))
            if result is None:
                break
            found.append(result)
        return found

    def next(self, results: Results) -> tuple[Case | None, int]:
        parts = self.parts(results)
        if len(parts) == CHUNKS or (parts and not holds(parts[-1])):
            return None, len(parts)
        start = (tuple(parts[-1].details["theta"]), tuple(parts[-1].details["omega"])) if parts else None
        return LongRunCase(self.engine, self.integrator, len(parts), self.steps, start), len(parts)


@dataclass(frozen=True)
class Listed:
    """Cases that are known beforehand, in order."""

    family: str
    cases: tuple[Case, ...]

    def next(self, results: Results) -> tuple[Case | None, int]:
        left = [case for case in self.cases if key(case) not in results]
        return (left[0] if left else None), len(self.cases) - len(left)


# What share of the time each family gets while others have something left to ask.
WEIGHTS = {
    "accelerations": 6.0,
    "steps": 2.0,
    "condition": 1.0,
    "chain": 2.0,
    "trees": 2.0,
    "tree runs": 2.0,
    "pairs": 2.0,
    "long runs": 1.0,
}
FAMILIES = tuple(WEIGHTS)
LONG_STEPS = 10_000_000


def make_searches(
    ladders: Sequence[Ladder],
    engines: Sequence[EngineInfo],
    own: Sequence[str],
    *,
    seed: int,
    families: Sequence[str] = FAMILIES,
    long_steps: int = LONG_STEPS,
    trees: Sequence[TreeLadder] | None = None,
) -> list[Search]:
    """Every question of a run about these engines and, of furiko's own, ``document`` and ``kernels``.

    ``trees``: ladders of open mechanisms, None for all.
    """
    subjects = [*own, *(info.name for info in engines)]
    of_trees = [name for name in own if name == KERNELS] + [info.name for info in engines if info.tree]
    climbed = tuple(tree_ladders().values()) if trees is None else trees
    found: list[Search] = [AccelerationSearch(subject, ladder, seed) for ladder in ladders for subject in subjects]
    found += [TreeSearch(subject, ladder, seed) for ladder in climbed for subject in of_trees]
    for info in engines:
        for integrator in info.integrators if "trajectory" not in info.missing else ():
            found += [
                StabilitySearch(info.name, integrator.name, stress, value, seed)
                for stress, (_, values) in STRESSES.items()
                for value in values
            ]
            found.append(LongRun(info.name, integrator.name, long_steps))
    for info in engines:
        for integrator in info.integrators if info.tree and "trajectory" not in info.tree.missing else ():
            found += [
                TreeRunSearch(info.name, integrator.name, motion, step) for motion in known_motions() for step in STEPS
            ]
    if own:
        found.append(Listed("condition", condition_cases(seed)))
        found.append(Listed("chain", tuple(listed_cases())))
        found += chain_runs()
    return [search for search in found if search.family in families]


def run(
    searches: Sequence[Search],
    results: dict[Key, Result],
    *,
    budget: float,
    jobs: int,
    timeout: float = TIMEOUT,
    watch: Watch = lambda case, left: None,
) -> Iterator[Result]:
    """Every new result, put into ``results`` as well; ends when all is known or after ``budget`` seconds.

    ``jobs``: worker processes; ``timeout`` [s] for one case; ``watch`` is called with each case that begins,
    and how many questions are open.
    """
    with worker_processes() as source:
        running = _Run(searches, results, now() + budget, timeout, Pool(source, jobs), watch)
        yield from running.results()


class _Run:
    """Which search asks next, and what became of its case."""

    def __init__(
        self,
        searches: Sequence[Search],
        results: dict[Key, Result],
        until: float,
        timeout: float,
        pool: Pool,
        watch: Watch,
    ) -> None:
        self.known, self.until, self.timeout, self.pool, self.watch = results, until, timeout, pool, watch
        self.questions: Questions[Search, Case] = Questions(searches, lambda one: one.next(self.known), WEIGHTS)
        self.searches: dict[Worker, Search] = {}
        self.found: dict[Worker, Result] = {}

    def results(self) -> Iterator[Result]:
        """Until all is known or the time is up."""
        try:
            while self._employ():
                for event in self.pool.events(until=min(moment for moment in self._moments() if moment > now())):
                    yield from self._on(event)
                self._cut_off()
        finally:
            self.pool.close()

    def _moments(self) -> Iterator[float]:
        """When to look up from waiting: the end of the budget, and of the grace after it."""
        yield self.until
        yield from (max(self.until, worker.begun) + GRACE for worker in self.pool.busy)
        yield now() + GRACE

    def _employ(self) -> bool:
        """Give idle workers cases while there is time; whether any is at work."""
        for worker in self.pool.idle():
            chosen = self.questions.next() if now() < self.until else None
            if chosen is not None:
                self.searches[worker], case = chosen
                self.watch(case, self.questions.open)
                self.pool.give(worker, CaseJob(case), max(self.timeout, getattr(case, "takes", 0.0)))
        return bool(self.pool.busy)

    def _on(self, event: Event) -> Iterator[Result]:
        assert isinstance(event.job, CaseJob)
        case, worker = event.job.case, event.worker
        if isinstance(event, Said):
            if isinstance(event.message, Result):
                self.found[worker] = event.message
            elif isinstance(event.message, Failed):
                self.found[worker] = failed(case, "exception", event.message.reason, event.message.trace)
        elif isinstance(event, Lost):
            yield self._over(worker, failed(case, "hang" if event.overdue else "crash", event.reason))
        else:
            yield self._over(worker, self.found.pop(worker, failed(case, "exception", "the worker gave no result")))

    def _cut_off(self) -> None:
        """Stop cases that are still under way some seconds after the time is up: nothing is known of them."""
        for worker in self.pool.busy:
            if now() > max(self.until, worker.begun) + GRACE:
                self.searches.pop(worker)
                self.pool.stop(worker)

    def _over(self, worker: Worker, result: Result) -> Result:
        seconds = now() - worker.begun
        found = msgspec.structs.replace(result, seconds=round(seconds, 3))
        self.known[key(found)] = found
        self.questions.answered(self.searches.pop(worker), seconds)
        return found


def failed(case: Case, failure: Failure, reason: str, trace: str = "") -> Result:
    """The result of a case that came to no result of its own."""
    details: dict[str, object] = {"failure": failure}
    if trace:
        details["traceback"] = trace
    return Result(
        scene=case.scene, engine=case.engine, check=case.check, outcome="error", reason=reason, details=details
    )
