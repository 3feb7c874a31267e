"""For every test: nothing is kept from run to run, and the same examples are tried in every run."""

import pytest
from hypothesis import settings

# A verdict on one commit is the same wherever and whenever it is asked for. `--hypothesis-profile search` tries others
# at every run; what it finds is mended and, as an @example, tried ever after.
settings.register_profile("same", derandomize=True, deadline=None)
settings.register_profile("search", deadline=None)
settings.load_profile("same")


@pytest.fixture(autouse=True)
def own_cache(tmp_path_factory, monkeypatch):
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path_factory.mktemp("cache")))
