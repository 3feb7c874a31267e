"""For every test: nothing is kept from run to run."""

import pytest


@pytest.fixture(autouse=True)
def own_cache(tmp_path_factory, monkeypatch):
    monkeypatch.setenv("FURIKO_CACHE", str(tmp_path_factory.mktemp("cache")))
