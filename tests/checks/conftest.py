"""Helpers of these tests: the zoo on the path, and one cell run in this process."""

from pathlib import Path

import pytest

from furiko.checks.messages import CellJob, Facts, FactsJob
from furiko.checks.plan import make_plan
from furiko.checks.worker import cell, facts
from furiko.models.result import Result

TESTS = Path(__file__).parent.parent


@pytest.fixture(autouse=True)
def zoo_on_path(monkeypatch):
    monkeypatch.syspath_prepend(str(TESTS))


@pytest.fixture
def run_cell():
    """Results of one scene on one engine, without worker processes, by name of the check."""

    def run(engine, scene="double-pendulum", profile="quick", random_states=30):
        plan = make_plan([scene], [engine], profile)
        (task,) = plan.tasks
        truth = facts(FactsJob(task.scene, random_states))
        assert isinstance(truth, Facts)
        from dataclasses import replace

        job = CellJob(replace(task, random_states=random_states), truth.content)
        results = [*plan.settled, *(message for message in cell(job) if isinstance(message, Result))]
        return {result.check: result for result in results}

    return run
