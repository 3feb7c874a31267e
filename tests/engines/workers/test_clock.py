"""A worker's clock: what one process shows another reads, whatever else is written there."""

import os
import time

import pytest

from furiko.engines.workers.clock import FIRST, NAME, ROOM, Clock, clock_file
from furiko.engines.workers.messages import Step


@pytest.fixture
def both(tmp_path):
    """The writer's clock and the reader's, of one memory."""
    file = clock_file(str(tmp_path))
    writer, reader = Clock(file), Clock(os.dup(file))
    yield writer, reader
    writer.close()
    reader.close()
    os.close(file)


def test_it_shows_nothing_before_the_first_step_and_the_last_one_then(both):
    writer, reader = both
    assert reader.last() is None
    for name, engine in [("truth", False), ("accelerations", True), ("joint forces", False), ("", True)]:
        before = time.monotonic()
        writer.show(Step(name, engine))
        begun, step = reader.last()
        assert step == Step(name, engine)
        assert before <= begun <= time.monotonic()


def test_a_long_name_is_cut(both):
    writer, reader = both
    writer.show(Step("é" * NAME, engine=True))
    _, step = reader.last()
    assert step.name[:40] == "é" * 40
    assert step.engine


def test_what_an_engine_scribbles_there_is_no_error(both):
    writer, reader = both
    writer.show(Step("energy"))
    for byte in range(256):
        writer._memory[FIRST : FIRST + 2 * ROOM] = bytes([byte]) * (2 * ROOM)
        begun, step = reader.last()
        assert isinstance(begun, float)
        assert isinstance(step, Step)


def test_it_leaves_no_file(tmp_path):
    file = clock_file(str(tmp_path))
    assert list(tmp_path.iterdir()) == []
    os.close(file)
