"""With the user's own package index: a release is installed and computes; one that is not there is one line."""

import numpy as np
import pytest

import furiko
from furiko.engines import engine_version, why_missing
from furiko.engines.places.environments import all_kept
from furiko.engines.places.index import NoIndex, releases

pytestmark = pytest.mark.slow


@pytest.fixture
def index(tmp_path, monkeypatch):
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path))
    try:
        return releases("mujoco")
    except NoIndex as error:
        pytest.skip(str(error))


def test_a_release_is_installed_once_and_computes(index):
    assert "3.3.7" in index
    assert why_missing("mujoco@3.3.7") == ""
    assert engine_version("mujoco@3.3.7") == "3.3.7"
    assert len(all_kept()) == 1
    engine = furiko.load_engine("mujoco@3.3.7", furiko.RodChain((0.7,), 2.0))
    # A rod that hangs level falls with 3 g / 2 l, whatever its density.
    assert engine.accelerations([-np.pi / 2], [0.0]) == pytest.approx([1.5 * 9.81 / 0.7], rel=1e-13)


def test_one_that_is_not_there_is_one_line_with_its_neighbours(index):
    words = why_missing("mujoco@3.3.99")
    assert words.startswith("mujoco 3.3.99 cannot be installed: ")
    assert "3.3.7, 3.4.0" in words
    assert "\n" not in words
    assert all_kept() == []
