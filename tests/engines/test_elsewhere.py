"""Adapters of other people: what a class has no method for is skipped with its reason, whether it says so or not."""

import subprocess
import sys
from typing import get_args

import pytest
from package_rooms import ROOT

from furiko.engines import Quantity, engine_info
from furiko.models import InvalidInput

BARE = """
import numpy as np
from furiko.engines import EngineInfo

class Bare:
    info = EngineInfo(name="bare", formulation="", adapter="bare:Bare", module="", package="", homepage="",
                      coordinates="absolute"{missing})

    def __init__(self, system):
        self.system = system

    def accelerations(self, theta, omega):
        from furiko import accelerations
        return accelerations(self.system, theta, omega)
"""


def test_what_a_class_has_no_method_for_is_missing(tmp_path):
    path = tmp_path / "bare.py"
    path.write_text(BARE.format(missing=", missing={'energy': 'it has none'}"))
    missing = engine_info(str(path)).missing
    assert set(missing) == set(get_args(Quantity)) - {"accelerations"}
    assert missing["energy"] == "it has none"  # the author's own reason stays
    assert missing["fields"] == "the adapter has no method fields"


def test_a_class_with_accelerations_alone_is_checked(tmp_path):
    (tmp_path / "bare.py").write_text(BARE.format(missing=""))
    done = subprocess.run(
        [sys.executable, "-m", "furiko", "check", "rods-2", "-e", "bare.py"], cwd=tmp_path, capture_output=True,
        text=True, check=False, env={"PYTHONPATH": str(ROOT), "PATH": "", "FURIKO_CACHE": str(tmp_path / "cache")},
    )  # fmt: skip
    assert done.returncode == 0, done
    assert done.stdout.startswith("All ")
    assert "AttributeError" not in done.stdout
    assert "energy: the adapter has no method energy" in done.stdout


def test_a_file_without_an_adapter_is_told_where_to_see_one(tmp_path):
    path = tmp_path / "nothing.py"
    path.write_text("class Nothing:\n    pass\n")
    with pytest.raises(InvalidInput, match="furiko engine-test --help"):
        engine_info(str(path))
    with pytest.raises(InvalidInput, match="furiko engine-test --help"):
        engine_info(f"{path}:Nothing")
