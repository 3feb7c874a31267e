"""What holds for every test of ``furiko diagnose``."""

from dataclasses import replace

import pytest

from furiko.engines.model_files.robot import ROBOT_READERS


@pytest.fixture(autouse=True)
def without_drake(monkeypatch):
    """Drake, an optional extra, is not there, whether it is installed or not: these tests say what the others make of
    a file, and Drake has tests of its own (``tests/engines/model_files/test_robot_drake.py``)."""
    absent = replace(ROBOT_READERS["drake"], module="no_such_module", adapter=".no_such_adapter:Nothing")
    monkeypatch.setitem(ROBOT_READERS, "drake", absent)
