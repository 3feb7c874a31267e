"""A worker: a process of its own that runs engines, so that one that crashes or hangs takes nothing else along.

It is given a connection to take jobs from and to send messages to. Its standard streams lead nowhere, and it runs in a
temporary folder: whatever an engine prints or writes is nobody's nuisance.
"""

from __future__ import annotations

import sys
import time
import traceback
from collections.abc import Callable, Iterator
from dataclasses import replace
from importlib import import_module
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING, Any

import msgspec

from ...models import EngineMissing
from ...records.check import Result
from ..plan import CHECKS
from .messages import Answer, Begun, CallJob, CaseJob, CellJob, Done, Facts, FactsJob, Failed, Message

if TYPE_CHECKING:
    from ..cell import Cell


def main() -> None:
    """Serve until the other end closes: ``python -m furiko.checks.workers.worker FILE_DESCRIPTOR``."""
    connection = Connection(int(sys.argv[1]))
    sys.path += [path for path in connection.recv() if path not in sys.path]
    for module in ("..facts", "..cell"):  # most jobs need them: import them while the first is still being decided on
        import_module(module, __package__)
    while True:
        try:
            job = connection.recv()
        except EOFError:
            return
        for message in do(job):
            connection.send(message)
        connection.send(Done())


def do(job: FactsJob | CellJob | CaseJob | CallJob) -> Iterator[Message]:
    """Everything that a job has to say."""
    try:
        if isinstance(job, FactsJob):
            yield facts(job)
        elif isinstance(job, CaseJob):
            yield job.case.run()
        elif isinstance(job, CallJob):
            yield Answer(getattr(import_module(job.module, __package__), job.function)(*job.arguments))
        else:
            yield from cell(job)
    except Exception as error:
        yield Failed(one_line(error), traceback.format_exc())


def facts(job: FactsJob) -> Facts:
    """The scene's truth in the states that its cells will look at."""
    from ...models.states import states
    from ..facts import scene_facts

    return Facts(scene_facts(job.scene, states(job.scene, job.random_states)).to_bytes())


def cell(job: CellJob) -> Iterator[Message]:
    """The results of a task's checks, one check after the other; a failure ends its own check alone."""
    from ...engines import engine_info, load_engine
    from ...models.states import states
    from ..cell import Cell
    from ..facts import SceneFacts

    task = job.task
    yield Begun(task.checks[0])
    engine = load_engine(task.engine, task.scene.system)
    looked_at = states(task.scene, task.random_states)
    info = replace(engine_info(task.engine), name=task.engine)  # as the plan calls it
    this = Cell(task.scene, info, engine, looked_at, SceneFacts.from_bytes(job.facts))
    differ = False
    for check in task.checks:
        yield Begun(check)
        if CHECKS[check] == "trajectory" and differ:
            reason = "the accelerations differ already: no trajectory can agree"
            yield this.result(check, "skipped", reason=reason)
            continue
        begun = time.perf_counter()
        try:
            for result in comparison(check)(this):
                now = time.perf_counter()
                yield explained(msgspec.structs.replace(result, seconds=now - begun), check, this)
                begun = now
                differ = differ or (check == "accelerations" and result.outcome == "differs")
        except Exception as error:
            details = {"traceback": traceback.format_exc()}
            yield this.result(check, "error", reason=one_line(error), details=details)


def explained(result: Result, check: str, cell: Cell) -> Result:
    """A result that differs with the cause that measurements name; anything else as it is."""
    if result.outcome != "differs" or check not in EXPLAINED or result.cause is not None or not cell.findings:
        return result
    first = cell.findings[0]
    return msgspec.structs.replace(result, cause=first.cause, reason=f"{result.reason}; {first.cause}: {first.says}")


def comparison(check: str) -> Callable[[Any], Iterator[Result]]:
    """The function that makes this check's comparison, imported now."""
    compare: Callable[[Any], Iterator[Result]] = import_module(MODULES[check], __package__).compare
    return compare


EXPLAINED = ("model fields", "accelerations", "terms")  # instantaneous quantities of the model, which can be fitted
MODULES = {
    "model fields": "..comparisons.model_fields",
    "accelerations": "..comparisons.accelerations",
    "terms": "..comparisons.terms",
    "joint forces": "..comparisons.joint_forces",
    "energy": "..comparisons.energy",
    "symmetry": "..comparisons.symmetries",
    "step map": "..comparisons.step_map",
    "trajectory": "..comparisons.trajectories",
    "invariant": "..comparisons.invariants",
    "horizon": "..comparisons.horizon",
}


def one_line(error: BaseException) -> str:
    """An exception in one line: its own words for what users can mend, its type as well for the rest."""
    words = " ".join(str(error).split())[:500]
    return words if isinstance(error, EngineMissing) else f"{type(error).__name__}: {words}"


if __name__ == "__main__":
    main()
