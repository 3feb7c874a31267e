"""For every test: nothing is kept from run to run, the same examples in every run, and one cell run in this process."""

from dataclasses import replace

import pytest
from hypothesis import settings

from furiko.checks.cell import Cell
from furiko.checks.facts import scene_facts
from furiko.checks.jobs import CellJob, Facts, TruthJob, messages_of
from furiko.checks.plan import make_plan
from furiko.engines import AnyShape, load_engine
from furiko.models import find_scene
from furiko.models.states import states
from furiko.records.check import Result

# A verdict on one commit is the same wherever and whenever it is asked for. `--hypothesis-profile search` tries others
# at every run; what it finds is mended and, as an @example, tried ever after.
settings.register_profile("same", derandomize=True, deadline=None)
settings.register_profile("search", deadline=None)
settings.load_profile("same")


@pytest.fixture(autouse=True)
def own_cache(tmp_path_factory, monkeypatch):
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path_factory.mktemp("cache")))


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
        (truth,) = (m for m in messages_of(TruthJob(task.scene, random_states)) if isinstance(m, Facts))
        job = CellJob(replace(task, random_states=random_states), truth.content)
        results = [*plan.settled, *(message for message in messages_of(job) if isinstance(message, Result))]
        return {result.check: result for result in results}

    return run
