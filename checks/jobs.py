"""The jobs of a cross-check: a scene's truth, and one scene on one engine."""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, cast

import msgspec

from ..engines.workers.messages import Held, Send, Step
from ..engines.workers.worker import one_line
from ..models import AnyScene, EngineMissing, LibraryMissing, System, TreeScene
from .check import Check
from .plan import Task
from .registry import CHECKS

if TYPE_CHECKING:
    from ..engines import EngineInfo
    from ..models.spatial_mechanism import SpatialMechanism
    from ..records.check import Diagnosis, Outcome, Result
    from .causes import Causes
    from .cell import Cell
    from .trees.cell import TreeCell


@dataclass(frozen=True)
class Facts:
    """A scene's truth, as :meth:`SceneFacts.to_bytes` writes it."""

    content: bytes


@dataclass(frozen=True)
class Compared:
    """A check is over, and this is how many results it gave."""

    check: str
    results: int


@dataclass(frozen=True)
class TruthJob:
    """Compute a scene's truth in the states that its cells look at.

    ``slopes``: derivatives are compared, too; ``followed``: and when trajectories part.
    """

    scene: AnyScene
    random_states: int
    slopes: bool = True
    followed: bool = False

    def run(self, send: Send) -> None:
        send(Step("truth"))
        send(Facts(self._content()))

    def _content(self) -> bytes:
        if isinstance(self.scene, TreeScene):
            from ..models.trees.states import tree_states
            from .trees.facts import tree_facts

            return tree_facts(self.scene, tree_states(self.scene, self.random_states), slopes=self.slopes).to_bytes()
        from ..models.states import states
        from .facts import scene_facts

        looked_at = states(self.scene, self.random_states)
        return scene_facts(self.scene, looked_at, slopes=self.slopes, followed=self.followed).to_bytes()


@dataclass(frozen=True)
class CellJob:
    """Run a task's checks, one after the other; ``facts`` as they came from the scene's :class:`TruthJob`.

    ``differs``: the accelerations are known to differ, by a worker that was lost after that check.
    """

    task: Task
    facts: bytes
    differs: bool = False

    def run(self, send: Send) -> None:
        from .causes import Causes

        check = self.task.checks[0]
        send(Step(check))
        asking = Asking(send, check)
        cell = self._cell(asking)
        causes = Causes(cell)
        differs = self.differs
        diagnosis: Diagnosis | None = None
        for check in self.task.checks:
            send(Step(check))
            asking.check = check
            results = 0
            for result in self._results(CHECKS[check], cell, differs, causes, asking):
                differs = differs or accelerations_differ(check, result)
                send(Held(msgspec.structs.replace(result, comparison=check)))
                results += 1
            send(Held(Compared(check, results)))
            if causes.diagnosis() != diagnosis:  # each is whole; the next check may take this process along
                diagnosis = causes.diagnosis()
                send(Held(diagnosis))

    def _cell(self, announce: Callable[[bool], None]) -> Cell | TreeCell:
        from ..engines import engine_info

        info = replace(engine_info(self.task.engine), name=self.task.engine)  # as the plan calls it
        scene = self.task.scene
        if isinstance(scene, TreeScene):
            return self._tree_cell(scene, info, announce)
        from ..engines import AnyShape, load_engine
        from ..models.states import states
        from .cell import Cell
        from .facts import SceneFacts

        announce(True)
        engine = load_engine(self.task.engine, scene.system)
        announce(False)
        looked_at = states(scene, self.task.random_states)
        facts = SceneFacts.from_bytes(self.facts)
        return Cell(scene, info, cast(AnyShape, Announced(engine, announce)), looked_at, facts, self.task.few_steps)

    def _tree_cell(self, scene: TreeScene, info: EngineInfo, announce: Callable[[bool], None]) -> TreeCell:
        from ..engines import OWN_EQUATIONS, TreeShape, load_tree_engine
        from ..models.trees.states import tree_states
        from .trees.cell import TreeCell
        from .trees.facts import TreeFacts

        looked_at = tree_states(scene, self.task.random_states)
        facts, few = TreeFacts.from_bytes(self.facts), self.task.few_steps
        if info.name == OWN_EQUATIONS.name:
            from .trees.own import own_equations

            own, shape, info = own_equations(scene)
            return TreeCell(scene, info, shape, looked_at, facts, own.findings, few_steps=few)
        announce(True)
        engine = load_tree_engine(self.task.engine, scene.system)
        announce(False)
        return TreeCell(scene, info, cast(TreeShape, Announced(engine, announce)), looked_at, facts, few_steps=few)

    def _results(self, check: Check, cell: Cell | TreeCell, differs: bool, causes: Causes, asking: Asking) -> Any:
        """The results of one check; a failure ends this check alone."""
        if check.moves and differs:
            yield cell.result(check.name, "skipped", reason="the accelerations differ already: no trajectory can agree")
            return
        begun = time.perf_counter()
        asking.taken()
        try:
            for result in check.compare(cell):
                now, in_engine = time.perf_counter(), asking.taken()
                yield msgspec.structs.replace(causes.named(result, check), seconds=now - begun, in_engine=in_engine)
                begun = now
        except LibraryMissing as error:
            outcome: Outcome = "error" if isinstance(error, EngineMissing) else "skipped"
            yield cell.result(check.name, outcome, reason=one_line(error))
        except Exception as error:
            details = {"traceback": traceback.format_exc()}
            yield cell.result(check.name, "error", reason=one_line(error), details=details)


def accelerations_differ(check: str, result: Result) -> bool:
    """Whether this result of a check says that no trajectory can agree."""
    return check == "accelerations" and result.outcome == "differs"


def messages_of(job: TruthJob | CellJob) -> list[object]:
    """Everything that a job sends, run in this process; its exceptions come through."""
    found: list[object] = []
    job.run(lambda message: found.append(message.message if isinstance(message, Held) else message))
    return found


class Asking:
    """Announces when a cell begins and ends to ask its engine in a ``check``, and sums up how long the engine took."""

    def __init__(self, send: Send, check: str) -> None:
        self._send, self.check = send, check
        self._begun = self._seconds = 0.0

    def __call__(self, asked: bool) -> None:
        """``asked``: the engine is being asked from now on; else it is no longer."""
        self._send(Step(self.check, engine=asked))
        now = time.perf_counter()
        if not asked:
            self._seconds += now - self._begun
        self._begun = now

    def taken(self) -> float:
        """Seconds in the engine since this was asked last."""
        found, self._seconds = self._seconds, 0.0
        return found


class Announced:
    """An engine whose every call is announced before and after, so that the engine's time is the engine's alone."""

    def __init__(self, engine: Any, announce: Callable[[bool], None]) -> None:
        self._engine, self._announce = engine, announce

    def of(self, system: System | SpatialMechanism) -> Announced:
        """The same engine with another mechanism, announced as well."""
        return Announced(self.__getattr__("of")(system), self._announce)

    def __getattr__(self, name: str) -> Any:
        found = getattr(self._engine, name)
        if not callable(found):
            return found

        def call(*arguments: Any, **named: Any) -> Any:
            self._announce(True)
            try:
                return found(*arguments, **named)
            finally:
                self._announce(False)

        return call
