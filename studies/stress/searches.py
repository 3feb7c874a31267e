"""The stress test: searches that ask for cases, workers that run them, a budget, and results that may be gone on from.

What has been found is in the results alone, each under a name of its own. A search is a function of them: it says which
case it needs next, or that it knows. So a run that was cut off goes on where it stood, nothing is lost and nothing is
done twice, and the order in which cases come in changes nothing. Families of searches (frontiers of accelerations,
frontiers of the step, …) share the time by weight; within a family cheap cases come first, then
a frontier that is caught between two rungs, then one search after the other: the time goes where the frontiers are.
"""

from __future__ import annotations

import subprocess
import time
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Protocol

import msgspec

from ...checks.workers.messages import Case, CaseJob, Done, Failed
from ...checks.workers.processes import Workshop, death, end, give, workshop
from ...engines import EngineInfo, engine_info
from ...records.check import Result
from .accelerations import DOCUMENT, KERNELS, AccelerationCase
from .axes import Ladder, Pair
from .chain import chain_runs, listed_cases
from .condition import condition_cases
from .failures import Failure
from .frontier import Frontier, frontier, next_rung
from .stability import CHUNKS, STRESSES, TOP, LongRunCase, StabilityCase, Stress

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

    def caught(self, results: Results) -> bool:
        """Whether it is between two rungs."""
        ...


@dataclass(frozen=True)
class AccelerationSearch:
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

    def answers(self, results: Results) -> dict[int, bool]:
        """What is known of each rung."""
        found = ((rung, results.get(key(self.case(rung)))) for rung in range(self.top + 1))
        return {rung: holds(result) for rung, result in found if result is not None}

    def next(self, results: Results) -> tuple[Case | None, int]:
        answers = self.answers(results)
        rung = next_rung(answers, self.top)
        return None if rung is None else self.case(rung), len(answers)

    def caught(self, results: Results) -> bool:
        return frontier(self.answers(results), self.top).fails is not None

    def frontier(self, results: Results) -> Frontier:
        """What is known so far."""
        return frontier(self.answers(results), self.top)


@dataclass(frozen=True)
class StabilitySearch:
    """The largest step that an engine's integrator survives, in one place of what is put under stress."""

    engine: str
    integrator: str
    stress: Stress
    value: float
    seed: int

    family = "steps"

    def case(self, rung: int) -> StabilityCase:
        """The case of a rung."""
        return StabilityCase(self.engine, self.integrator, self.stress, self.value, rung, self.seed)

    def answers(self, results: Results) -> dict[int, bool]:
        """What is known of each rung."""
        found = ((rung, results.get(key(self.case(rung)))) for rung in range(TOP + 1))
        return {rung: holds(result) for rung, result in found if result is not None}

    def next(self, results: Results) -> tuple[Case | None, int]:
        answers = self.answers(results)
        rung = next_rung(answers, TOP)
        return None if rung is None else self.case(rung), len(answers)

    def caught(self, results: Results) -> bool:
        return frontier(self.answers(results), TOP).fails is not None


@dataclass(frozen=True)
class LongRun:
    """A long run of one integrator, a hundredth at a time."""

    engine: str
    integrator: str
    steps: int

    family = "long runs"

    def parts(self, results: Results) -> list[Result]:
        """What has been run, in order."""
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

    def caught(self, results: Results) -> bool:
        return False


@dataclass(frozen=True)
class Listed:
    """Cases that are known beforehand, in order."""

    family: str
    cases: tuple[Case, ...]

    def next(self, results: Results) -> tuple[Case | None, int]:
        left = [case for case in self.cases if key(case) not in results]
        return (left[0] if left else None), len(self.cases) - len(left)

    def caught(self, results: Results) -> bool:
        return False


# What share of the time each family gets while others have something left to ask.
WEIGHTS = {"accelerations": 6.0, "steps": 2.0, "condition": 1.0, "chain": 2.0, "pairs": 2.0, "long runs": 1.0}
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
) -> list[Search]:
    """Every question of a run about these engines and, of furiko's own, ``document`` and ``kernels``."""
    subjects = [*own, *(info.name for info in engines)]
    found: list[Search] = [AccelerationSearch(subject, ladder, seed) for ladder in ladders for subject in subjects]
    for info in engines:
        for integrator in info.integrators if "trajectory" not in info.missing else ():
            found += [
                StabilitySearch(info.name, integrator.name, stress, value, seed)
                for stress, (_, values) in STRESSES.items()
                for value in values
            ]
            found.append(LongRun(info.name, integrator.name, long_steps))
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
    with workshop() as place:
        pool = _Pool(searches, results, time.monotonic() + budget, timeout, place, watch)
        yield from pool.run(jobs)


@dataclass(eq=False)
class _Worker:
    """A worker process, and the case that it runs."""

    process: subprocess.Popen[bytes]
    connection: Connection
    case: Case | None = None
    search: Search | None = None
    begun: float = 0.0
    result: Result | None = None


class _Pool:
    """Who asks next, who runs it, and what became of it."""

    def __init__(
        self,
        searches: Sequence[Search],
        results: dict[Key, Result],
        until: float,
        timeout: float,
        place: Workshop,
        watch: Watch,
    ) -> None:
        self.asking = {search: search.next(results) for search in searches}
        self.results, self.until, self.timeout, self.place, self.watch = results, until, timeout, place, watch
        self.spent: defaultdict[str, float] = defaultdict(float)
        self.workers: list[_Worker] = []

    def run(self, jobs: int) -> Iterator[Result]:
        """Until all is known or the time is up."""
        try:
            for _ in range(jobs):
                self._start()
            while self._employ():
                for worker in self._heard():
                    yield from self._listen(worker)
                yield from self._overdue()
        finally:
            for worker in list(self.workers):
                self._stop(worker)

    def _start(self) -> None:
        self.workers.append(_Worker(*self.place.worker()))

    def _stop(self, worker: _Worker) -> None:
        self.workers.remove(worker)
        end(worker.process, worker.connection)

    def _employ(self) -> bool:
        """Give idle workers cases while there is time; whether any is at work."""
        for worker in self.workers:
            if worker.case is None and time.monotonic() < self.until:
                chosen = self._choose()
                if chosen is not None:
                    worker.search, worker.case = chosen
                    worker.begun, worker.result = time.monotonic(), None
                    self.watch(worker.case, sum(case is not None for case, _ in self.asking.values()))
                    give(worker.connection, CaseJob(worker.case))
        return any(worker.case is not None for worker in self.workers)

    def _choose(self) -> tuple[Search, Case] | None:
        """The next case of the family that has had least of its share; it may have none while others run its last."""
        running = {worker.search for worker in self.workers if worker.case is not None}
        asked: dict[str, list[tuple[tuple[bool, bool, int], Search, Case]]] = {}
        for place, (search, (case, _)) in enumerate(self.asking.items()):
            if case is not None and search not in running:
                urgency = (getattr(case, "heavy", False), not search.caught(self.results), place)
                asked.setdefault(search.family, []).append((urgency, search, case))
        if not asked:
            return None
        family = min(asked, key=lambda name: (self.spent[name] / WEIGHTS[name], FAMILIES.index(name)))
        _, search, case = min(asked[family], key=lambda one: one[0])
        return search, case

    def _heard(self) -> list[_Worker]:
        """Workers that have something to say; a moment later, those there are."""
        busy = [worker for worker in self.workers if worker.case is not None]
        patience = max(0.0, min(self._deadline(worker) for worker in busy) - time.monotonic())
        ready = wait([worker.connection for worker in busy], patience)
        return [worker for worker in busy if worker.connection in ready]

    def _deadline(self, worker: _Worker) -> float:
        return min(worker.begun + self._allowed(worker.case), max(self.until, worker.begun) + GRACE)

    def _allowed(self, case: Case | None) -> float:
        """Seconds for a case: some are known to take long."""
        return max(self.timeout, getattr(case, "takes", 0.0))

    def _listen(self, worker: _Worker) -> Iterator[Result]:
        case = worker.case
        if case is None:
            return
        try:
            message = worker.connection.recv()
        except (EOFError, ConnectionError):
            reason = death(worker.process)
            yield self._over(worker, failed(case, "crash", reason))
            self._stop(worker)
            self._start()
            return
        if isinstance(message, Result):
            worker.result = message
        elif isinstance(message, Failed):
            worker.result = failed(case, "exception", message.reason, message.trace)
        elif isinstance(message, Done):
            found = worker.result or failed(case, "exception", "the worker gave no result")
            yield self._over(worker, found)

    def _overdue(self) -> Iterator[Result]:
        """Cases that have run out of their own time hang; those that have run out of the run's are only cut off."""
        now = time.monotonic()
        for worker in list(self.workers):
            case = worker.case
            if case is None or now < self._deadline(worker):
                continue
            allowed = self._allowed(case)
            if now >= worker.begun + allowed:
                yield self._over(worker, failed(case, "hang", f"no answer within {allowed:g} s"))
            worker.case = None
            self._stop(worker)
            self._start()

    def _over(self, worker: _Worker, result: Result) -> Result:
        seconds = time.monotonic() - worker.begun
        found = msgspec.structs.replace(result, seconds=round(seconds, 3))
        self.results[key(found)] = found
        if worker.search is not None:
            self.spent[worker.search.family] += seconds
            self.asking[worker.search] = worker.search.next(self.results)
        worker.case = worker.search = None
        return found


def failed(case: Case, failure: Failure, reason: str, trace: str = "") -> Result:
    """The result of a case that came to no result of its own."""
    details: dict[str, object] = {"failure": failure}
    if trace:
        details["traceback"] = trace
    return Result(
        scene=case.scene, engine=case.engine, check=case.check, outcome="error", reason=reason, details=details
    )
