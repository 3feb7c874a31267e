"""No sound engine is called different, on random mechanisms: a few of those that score_sound.py takes."""

import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.slow
@pytest.mark.parametrize(("spread", "seed"), [("mild", 5), ("wide", 6)])
def test_no_engine_is_called_different_for_its_mechanisms_numbers(spread, seed, tmp_path):
    script = Path(__file__).with_name("score_sound.py")
    options = ["--scenes", "6", "--spread", spread, "--seed", str(seed), "--out", str(tmp_path)]
    done = subprocess.run([sys.executable, script, *options], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "comparisons agree" in done.stdout
