"""The steps of the test, in their order, and the job that runs them in a process of its own.

A step that finds the adapter wrong may make later ones meaningless: those are skipped, and say so.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from ...engines import engine_adapter, engine_info
from ...engines.workers.messages import Failed, Send, Step
from ...engines.workers.pool import Lost, Pool, Said
from ...engines.workers.processes import worker_processes
from ...models import EngineMissing, InvalidInput
from ...records.listings import ConformanceStep, EngineTest
from . import conventions, handling, runs
from .subject import Subject, Wrong

Look = Callable[[Subject], ConformanceStep]


@dataclass(frozen=True)
class Part:
    """``needs``: the question that the adapter must offer; ``ends``: whether what follows is meaningless if wrong."""

    step: str
    look: Look
    needs: str = "accelerations"
    ends: bool = False


PARTS = (
    Part("class", handling.declared, ends=True),
    Part("building", handling.builds, ends=True),
    Part("shapes", handling.shapes, ends=True),
    Part("arguments", handling.arguments, ends=True),
    Part("buffers", handling.buffers, ends=True),
    Part("memory", handling.memory, ends=True),
    Part("batches", handling.batches, ends=True),
    Part("accelerations", conventions.accelerations, ends=True),
    Part("precision", conventions.precision),
    Part("fields", conventions.fields, "fields"),
    Part("inverse dynamics", conventions.inverse_dynamics, "inverse_dynamics"),
    Part("joint forces", conventions.forces, "joint_forces"),
    Part("energy", conventions.energy, "energy"),
    Part("trajectories", runs.trajectories, "trajectory"),
    Part("paths", runs.paths, "path"),
)


def steps(name: str) -> Iterator[ConformanceStep]:
    """Test an adapter in this process, step by step; ``name`` as for :func:`~furiko.engines.engine_info`."""
    try:
        info = engine_info(name)
        subject = Subject(name, engine_adapter(name), info)
    except (InvalidInput, EngineMissing) as error:
        yield ConformanceStep(step="class", outcome="wrong", says=str(error), help="See furiko.engines.protocol.")
        return
    ended = ""
    for part in PARTS:
        if ended:
            says = f"nothing can be said before {ended!r} is right"
            yield ConformanceStep(step=part.step, outcome="skipped", says=says)
        elif not subject.has(part.needs):
            yield ConformanceStep(step=part.step, outcome="skipped", says=_why_missing(subject, part.needs))
        else:
            found = _look(part, subject)
            ended = part.step if part.ends and found.outcome == "wrong" else ""
            yield found


def _why_missing(subject: Subject, quantity: str) -> str:
    return subject.info.missing.get(quantity) or f"the adapter has no method {quantity}, and need not have one"


def _look(part: Part, subject: Subject) -> ConformanceStep:
    try:
        return part.look(subject)
    except Wrong as wrong:
        return ConformanceStep(step=part.step, outcome="wrong", says=wrong.says, help=wrong.help)
    except Exception as error:
        says = f"it raises {type(error).__name__}: {' '.join(str(error).split())[:300]}"
        return ConformanceStep(step=part.step, outcome="wrong", says=says, help=_place(error))


def _place(error: Exception) -> str:
    """The last line of the adapter's own file in the traceback."""
    import traceback

    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if "conformance" not in frame.filename] or frames
    return f"At {own[0].filename.rpartition('/')[2]}, line {own[0].lineno}: {own[0].line}" if own else ""


@dataclass(frozen=True)
class ConformanceJob:
    """The test of one adapter, for a worker."""

    name: str

    def run(self, send: Send) -> None:
        """Send each step's record as it comes."""
        send(Step("class", engine=True))
        for found in steps(self.name):
            send(found)
            send(Step(found.step, engine=True))


def engine_test(name: str, timeout: float, on_step: Callable[[ConformanceStep], object] = lambda _: None) -> EngineTest:
    """Test an adapter in a process of its own, with ``timeout`` seconds for each step.

    ``on_step``: called with each step's record as it comes. A crash or a hang is the step's outcome.
    """
    found: list[ConformanceStep] = []

    def take(step: ConformanceStep) -> None:
        found.append(step)
        on_step(step)

    with worker_processes(ahead=1) as source:
        pool = Pool(source, 1)
        pool.give(pool.workers[0], ConformanceJob(name), timeout)
        while pool.busy:
            for event in pool.events():
                if isinstance(event, Said) and isinstance(event.message, ConformanceStep):
                    take(event.message)
                elif isinstance(event, Said) and isinstance(event.message, Failed):
                    take(_broken_off(found, event.message.reason))
                elif isinstance(event, Lost):
                    hangs = ": it hangs; --timeout gives more" if event.overdue else ": the engine takes it along"
                    take(_broken_off(found, event.reason + hangs))
    conforms = len(found) == len(PARTS) and all(step.outcome != "wrong" for step in found)
    return EngineTest(engine=name, conforms=conforms, steps=found)


def _broken_off(found: list[ConformanceStep], reason: str) -> ConformanceStep:
    step = PARTS[min(len(found), len(PARTS) - 1)].step
    return ConformanceStep(step=step, outcome="wrong", says=reason)
