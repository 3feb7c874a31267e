"""The results that a run has promised, against those that arrived: one that is lost on the way is an error."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from ..records.check import Result
from .plan import Plan

Key = tuple[str, str, str]  # scene, engine, check


class Ledger:
    """The checks of a plan, and how many results each has given where it was made."""

    def __init__(self, plan: Plan) -> None:
        self._promised: dict[Key, int] = {}
        for result in plan.settled:
            self.promise(result.scene, result.engine, result.comparison)
        for task in plan.tasks:
            for check in task.checks:
                self.promise(task.scene.name, task.engine, check)

    def promise(self, scene: str, engine: str, check: str, results: int = 1) -> None:
        """This check has so many results; until it has run, it has at least one."""
        self._promised[scene, engine, check] = max(results, 1)

    def missing(self, results: Iterable[Result]) -> list[Result]:
        """An error for each check of which results did not arrive."""
        arrived = Counter((result.scene, result.engine, result.comparison) for result in results)
        return [
            _missing(key, promised, arrived[key]) for key, promised in self._promised.items() if arrived[key] < promised
        ]


def _missing(key: Key, promised: int, arrived: int) -> Result:
    scene, engine, check = key
    lost = f"{promised - arrived} of its {promised} results did not arrive" if arrived else "no result of it arrived"
    reason = f"the check was planned, and {lost}: this is a fault of furiko or of its surroundings, not of the engine"
    return Result(scene=scene, engine=engine, check=check, comparison=check, outcome="error", reason=reason)
