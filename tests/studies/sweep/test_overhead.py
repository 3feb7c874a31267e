"""What the main process does for a cell: counted, not timed, so that a busy machine changes nothing."""

import cProfile
import importlib.metadata
import pstats

import pytest

from furiko.studies.sweep.chunk import Lane, Work, do
from furiko.studies.sweep.declaration import sweep_from_toml

pytest.importorskip("pyarrow")
pytest.importorskip("mujoco")
FEW, MANY = 2, 12  # scenes
CALLS = 1_500  # of Python functions for a cell: at 0.2 µs each 0.3 ms, of the 0.5 ms that a cell may take


def swept(scenes):
    head = f'engines = ["mujoco"]\nseeds = {scenes}\nstates = 2\nchunk = {scenes}\n'
    return sweep_from_toml(f'{head}[[random]]\nkind = "rod-chain"\nlinks = 2\n')


def test_the_main_process_does_little_for_a_cell_and_reads_no_metadata_for_it(monkeypatch):
    reads = []
    real = importlib.metadata.distribution
    monkeypatch.setattr(importlib.metadata, "distribution", lambda name: reads.append(name) or real(name))

    def cost(scenes, lane):
        profile, before = cProfile.Profile(), len(reads)
        profile.runcall(do, swept(scenes), "", Work(0, ("mujoco",)), lane)
        return pstats.Stats(profile).total_calls, len(reads) - before

    with Lane(None) as lane:
        do(swept(1), "", Work(0, ("mujoco",)), lane)  # imports, and what is kept from the first on
        (few, read_few), (many, read_many) = cost(FEW, lane), cost(MANY, lane)
    assert (many - few) / (MANY - FEW) < CALLS
    assert read_few == read_many == 0
