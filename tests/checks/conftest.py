"""Helpers of these tests: the zoo on the path, and one cell run in this process."""

import sys
from pathlib import Path

import pytest

from furiko.checks.cell import Cell
from furiko.checks.facts import scene_facts
from furiko.checks.messages import CellJob, Facts, FactsJob
from furiko.checks.plan import make_plan
from furiko.checks.worker import cell, facts
from furiko.engines import AnyShape, load_engine
from furiko.models import find_scene
from furiko.models.result import Result
from furiko.models.states import states

TESTS = Path(__file__).parent.parent


sys.path.append(str(Path(__file__).parent))  # motion_zoo, which tests import by name


@pytest.fixture(autouse=True)
def zoo_on_path(monkeypatch):
    monkeypatch.syspath_prepend(str(TESTS))


@pytest.fixture
def make_cell():
    """A cell of one scene, by name or itself, and one engine, by name or a fake's class."""

    def make(engine, scene, random_states=5):
        scene = find_scene(scene) if isinstance(scene, str) else scene
        if isinstance(engine, str):
            loaded = load_engine(engine, scene.system)
        else:
            loaded = AnyShape(engine(scene.system), engine.about(), scene.system.n)
        looked_at = states(scene, random_states)
        return Cell(scene, loaded.info, loaded, looked_at, scene_facts(scene, looked_at))

    return make


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
