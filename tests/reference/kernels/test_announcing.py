"""The first call says on a terminal what it waits for, and how long; a pipe stays empty."""

import os
import pty
import subprocess
import sys
import time

import pytest

pytest.importorskip("numba")
from furiko.reference.kernels import announcing, forward_dynamics_compiled
from furiko.reference.kernels.ahead import announcing as words
from furiko.reference.kernels.ahead import load
from furiko.reference.kernels.ahead.kernels import KERNELS

# Nine calls of one state: from the ninth on numba compiles, where nothing is written ahead, for some seconds.
CALLS = """
import furiko
from furiko.reference.kernels.ahead import load
load.is_ahead = lambda name: False
for _ in range(9):
    furiko.accelerations(furiko.RodChain([1.0, 0.8]), [0.1, 0.2], [0.0, 0.0])
"""


@pytest.mark.slow
def test_a_terminal_is_told_and_a_pipe_is_not(tmp_path):
    ours, theirs = pty.openpty()
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "terminal")}
    told = subprocess.Popen([sys.executable, "-c", CALLS], stderr=theirs, env=environment)
    piped = subprocess.run(
        [sys.executable, "-c", CALLS], capture_output=True, check=True, timeout=300,
        env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "pipe")},
    )  # fmt: skip
    assert (piped.stdout, piped.stderr) == (b"", b"")
    assert told.wait(timeout=300) == 0
    os.close(theirs)
    said = os.read(ours, 1000).decode()
    os.close(ours)
    assert said == "furiko: numba compiles accelerations of rods, about 2 s, once: the result is kept\r\n"


def test_every_kernel_that_is_compiled_is_in_the_list():
    """The kernels that are called from Python; numba's dispatchers of all others are compiled into these."""
    from furiko.reference.integration import taylor_compiled, taylor_flips, taylor_lanes, taylor_tangents

    found = {
        name
        for module in (forward_dynamics_compiled, taylor_compiled, taylor_lanes, taylor_tangents, taylor_flips)
        for name, value in vars(module).items()
        if type(value).__name__ == "CPUDispatcher" and type(value._cache).__name__ == "FunctionCache"
    }
    assert found == set(announcing.SECONDS) == set(KERNELS)


class Terminal:
    def __init__(self, is_one):
        self.is_one, self.said = is_one, ""

    def isatty(self):
        return self.is_one

    def write(self, text):
        self.said += text

    def flush(self):
        pass


@pytest.mark.parametrize("is_one", [True, False])
def test_where_nothing_is_kept_it_says_so(is_one, monkeypatch):
    stream = Terminal(is_one)
    monkeypatch.setattr(sys, "stderr", stream)
    words.say(announcing.line("run_rods", kept=False))
    said = (
        "furiko: numba compiles simulations of rods, about 6 s, in each process: there is no folder to keep the result"
    )
    assert stream.said == (f"{said} in\n" if is_one else "")


@pytest.mark.parametrize("waits", [True, False])
def test_machine_code_that_takes_a_while_is_told(waits, monkeypatch):
    stream = Terminal(True)
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(words, "LONG", 0.01 if waits else 60)
    monkeypatch.setattr(load, "_loaded", {})
    monkeypatch.setattr(load, "is_ahead", lambda name: True)

    def slow(name):
        deadline = time.monotonic() + (30 if waits else 0)
        while not stream.said and time.monotonic() < deadline:
            time.sleep(0.01)
        return len

    monkeypatch.setattr(load, "made", slow)
    load.kernel("run_rod_tangents")
    said = "furiko: machine code is made for the growth of small differences of rods, about a second in each process\n"
    assert stream.said == (said if waits else "")
