"""Each known defect is measured by running its own smallest input."""

import importlib.util

import pytest

from furiko.studies.defects import PROBES, Measured, run


@pytest.mark.parametrize("probe", PROBES, ids=lambda probe: probe.engine)
def test_the_smallest_input_shows_the_defect(probe):
    """Once an engine's release has mended it this fails, and the adapter's limits are to be looked at again."""
    if importlib.util.find_spec(probe.module) is None:
        pytest.skip(f"{probe.engine} is not installed")
    outcome = run(probe)
    assert outcome is not None
    assert outcome.shows, outcome
    assert outcome.version


def test_what_is_right_shows_nothing():
    probe = PROBES[0]
    assert not Measured(probe, "1", (1.0, -2.0), (1.0, -2.0 * (1 + 1e-9))).shows
    assert Measured(probe, "1", (1.0, -2.0), (1.0, 2.0)).shows
    assert Measured(probe, "1", (1.0, -2.0), (1.0, float("nan"))).shows
