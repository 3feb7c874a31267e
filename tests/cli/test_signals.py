"""A signal at any moment of a command's start ends it with the signal's status, and never with a traceback."""

import os
import signal
import subprocess
import sys

import pytest

# The command line, with a signal to itself when Python imports its k-th module.
START = """
import os, sys
number, left = int(sys.argv.pop(1)), int(sys.argv.pop(1))
def hook(event, _):
    global left
    if event == "import":
        left -= 1
        if left == 0:
            os.kill(os.getpid(), number)
sys.addaudithook(hook)
from furiko.cli import main
main()
"""
COMMANDS = {
    "advise": ["advise", "rods-2", "-e", "mujoco", "--budget", "1"],
    "audit": ["audit"],
    "bench": ["bench", "rods-2", "-e", "mujoco", "--budget", "1"],
    "check": ["check", "rods-2", "-e", "mujoco", "--no-cache"],
    "diagnose": ["diagnose", "no-such-file.xml"],
    "engines": ["engines"],
    "grade": ["grade", "no-such-file.toml"],
    "lesson": ["lesson"],
    "scenes": ["scenes"],
    "stress": ["stress", "-a", "legs", "-e", "kernels", "--budget", "1"],
}
OURS = 5  # imports until the signals are caught: furiko, its command line, process and what that needs
ENDED = b"furiko: interrupted by"


def ended(command, number, imports, folder):
    return subprocess.run(
        [sys.executable, "-c", START, str(int(number)), str(imports), *COMMANDS[command]],
        cwd=folder, capture_output=True, check=False, timeout=120, env=os.environ,
        # a shell's background job, and what it starts, ignore Ctrl-C
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("imports", [1, 2, 3, 4, OURS, 6, 8, 12, 20, 35, 60, 90, 130, 200, 300, 420])
def test_bench_is_ended_at_every_early_moment(imports, tmp_path):
    done = ended("bench", signal.SIGTERM, imports, tmp_path)
    assert done.returncode in (-signal.SIGTERM, 128 + signal.SIGTERM)
    assert imports <= OURS or done.returncode > 0
    assert done.stderr.strip() == b"" or done.stderr.lstrip().startswith(ENDED), done.stderr.decode()


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize("command", sorted(COMMANDS))
def test_each_command_is_ended_by_each_signal(command, number, tmp_path):
    for imports in (15, 40):
        done = ended(command, number, imports, tmp_path)
        assert done.returncode == 128 + number, (imports, done)
        assert done.stderr.strip() == b"" or done.stderr.lstrip().startswith(ENDED), done.stderr.decode()
