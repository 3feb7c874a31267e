"""Progress: what is counted at each result."""

import sys
from types import SimpleNamespace

from furiko.cli.progress import check_progress
from furiko.records.check import Result


class CountedPlan:
    """A plan that notes how often it is gone through."""

    def __init__(self, tasks):
        self._tasks, self.settled, self.looks = tasks, (), 0

    @property
    def tasks(self):
        self.looks += 1
        return self._tasks


def test_the_plan_is_not_gone_through_again_at_each_result(monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    scene = SimpleNamespace(name="s", system=SimpleNamespace(kind="rod-chain", n=1))
    plan = CountedPlan([SimpleNamespace(scene=scene, engine="e", checks=("accelerations",))])
    with check_progress() as watch:
        for _ in range(50):
            watch(plan, Result(scene="s", engine="e", check="accelerations", outcome="agrees"))
    assert plan.looks <= 2
